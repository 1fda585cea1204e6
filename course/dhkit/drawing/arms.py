"""An arm from its axes in space, as a body: what a statement shows before there is a table."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..arms import EXTENDED, Arm, said_letter, said_sum
from ..curves import arm_path
from ..geometry import rigid_transform, rotation
from .bodies import HAND, JOINT, LINK, Bodies
from .frames import ask_for_frames, merge_axes
from .inputs import as_numbers
from .labels import Labels
from .strokes_3d import draw_arrow_3d
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, INK, SOFT, WANTED, styled
from .view import fit_3d, new_axes_3d, view_axes


@styled
def draw_arm(arm: Arm, q=None, *, end_effector=True, elev=22.0, azim=-60.0):
    """Draw an arm with its joint axes, its lengths, frame 0 and the frame of the end effector.

    Parameters
    ----------
    arm : Arm
    q : sequence of float, optional
        Joint values, radians and metres; by default turning joints stand at zero, sliding ones are drawn out a little.
    end_effector : bool
        Draw the frame of the end effector.
    elev, azim : float, in degrees
        From where it is seen.

    Returns
    -------
    matplotlib Axes (3D)
    """
    if q is None:
        q = [EXTENDED if joint.slides else 0.0 for joint in arm.joints]
    out = dict(zip((joint.name for joint in arm.joints), map(float, q), strict=True))
    moves = _moves(arm, out)
    ways = _ways(arm, out, moves)
    unit = sum(np.linalg.norm(end - start) for start, end, _ in ways) or 1.0
    ax = new_axes_3d(elev, azim)
    bodies, labels, size = Bodies(ax, unit), Labels(), 0.13 * unit
    radius = 0.022 * unit
    bodies.add_tube(np.array([0, 0, -0.8 * radius]), np.zeros(3), 4 * radius, LINK, caps=True)
    for start, end, _ in ways:
        bodies.add_tube(start, end, radius, LINK)
        bodies.add_ball(end, radius, LINK)
    lines = _lines(arm, out, moves, 2 * radius)
    for joint, (centre, along) in zip(arm.joints, lines):
        if joint.slides:
            bodies.add_box(centre, _axes_about(along), (1.6 * radius, 1.6 * radius, 2.2 * radius), JOINT)
        else:
            bodies.add_tube(centre - 2 * radius * along, centre + 2 * radius * along, 1.8 * radius, JOINT, caps=True)
    end = moves[-1] @ _end_frame(arm, out)
    bodies.add_ball(end[:3, 3], 1.3 * radius, HAND)
    bodies.draw(ax)
    extent = [bodies.points(), *_draw_axes(ax, labels, arm, lines, size)]
    frames, names = np.array([np.eye(4), end]), [0, arm.frame]
    shown = merge_axes(frames, names, "xyz") if end_effector else merge_axes(frames[:1], names[:1], "xyz")
    extent += ask_for_frames(ax, labels, [axis for axis in shown if axis.label not in _named(arm)], size, width=1.8)
    _name_lengths(ax, labels, ways)
    fit_3d(ax, np.vstack(extent), True, pad=0.42)
    labels.place(ax)
    return ax


def end_frame(arm: Arm, q) -> np.ndarray:
    """The frame of the end effector, (4, 4), for joint values in radians and metres."""
    values = dict(zip((joint.name for joint in arm.joints), map(float, q), strict=True))
    return _moves(arm, values)[-1] @ _end_frame(arm, values)


def arm_curve(shape: str, arm: Arm, count: int = 121) -> np.ndarray:
    """A curve on the surface that the end effector of an arm stays on: points (count, 3) in metres.

    `shape` is one of `dhkit.curves.ARM_CURVES`; of the three joints two do the same.
    """
    return np.array([end_frame(arm, q)[:3, 3] for q in arm_path(arm, shape, count)])


def mark_curve(ax, curve, trace=None):
    """Mark a wanted curve, shape (k, 3) in metres, broad and light; thin and dark what was drawn of it, the trace."""
    lines = [(as_numbers(curve, "curve", (None, 3)), {"color": WANTED, "lw": 4.5, "alpha": 0.7})]
    if trace is not None:
        lines.append((as_numbers(trace, "trace", (None, 3)), {"color": INK, "lw": 1.3}))
    for points, pen in lines:
        ax.plot(*points.T, zorder=9, **pen)
    corners = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()]).T
    fit_3d(ax, np.vstack([corners, *(points for points, _ in lines)]), True, pad=0.42)
    return ax


def joint_points(arm: Arm, q) -> np.ndarray:
    """The points by which the axes are known, then the end effector, (n + 1, 3), for joint values in radians and metres."""
    values = dict(zip((joint.name for joint in arm.joints), map(float, q), strict=True))
    stops = [*(joint.point for joint in arm.joints), arm.origin]
    return np.array([(move @ [*arm.at(point, values), 1])[:3] for move, point in zip(_moves(arm, values), stops)])


def _moves(arm: Arm, values) -> list[np.ndarray]:
    """What the turning joints have done to each link, from the base on, (4, 4) each: n + 1 of them."""
    moves = [np.eye(4)]
    for joint in arm.joints:
        axes, point = _axes_about(np.array(joint.direction, float)), arm.at(joint.point, values)
        turn = axes @ rotation("z", 0.0 if joint.slides else values[joint.name]) @ axes.T
        moves.append(moves[-1] @ rigid_transform(turn, point - turn @ point))
    return moves


def _ways(arm: Arm, values, moves) -> list[tuple[np.ndarray, np.ndarray, str]]:
    """The straight pieces of the links, with the length that each has in letters: to the next axis, then along it."""
    stops = [(joint.point, np.array(joint.direction, float)) for joint in arm.joints]
    stops.append((arm.origin, np.array(arm.z, float)))
    ways, before = [], ({}, {}, {})
    for (point, along), move in zip(stops, moves):
        # What the two points differ by, in letters, part by part: across the axis first.
        change = [_difference(after, earlier) for after, earlier in zip(point, before)]
        across = [{} if abs(direction) == 1 else entry for entry, direction in zip(change, along)]
        corner = tuple(_sum(earlier, step) for earlier, step in zip(before, across))
        for start, end in pairwise((before, corner, point)):
            steps = [_difference(after, earlier) for after, earlier in zip(end, start)]
            moved = [entry for entry in steps if entry]
            here, there = (move[:3, :3] @ arm.at(one, values) + move[:3, 3] for one in (start, end))
            if np.linalg.norm(there - here) > 1e-9:
                ways.append((here, there, said_sum(_positive(moved[0])) if len(moved) == 1 else ""))
        before = point
    return ways


def _difference(one, other) -> dict[str, float]:
    return _sum(one, {letter: -factor for letter, factor in other.items()})


def _sum(one, other) -> dict[str, float]:
    both = {letter: one.get(letter, 0) + other.get(letter, 0) for letter in (*one, *other)}
    return {letter: factor for letter, factor in both.items() if abs(factor) > 1e-12}


def _positive(entry) -> dict[str, float]:
    return {letter: abs(factor) for letter, factor in entry.items()} if len(entry) == 1 else dict(entry)


def _lines(arm: Arm, values, moves, half) -> list[tuple[np.ndarray, np.ndarray]]:
    """Where the bodies of the joints stand, and the directions of their axes.

    Joints that lie on one another are parted along their own axes.
    """
    lines: list[tuple[np.ndarray, np.ndarray]] = []
    for joint, move in zip(arm.joints, moves):
        # A guide stands where the sliding begins.
        point = arm.at(joint.point, values | {joint.name: 0.0} if joint.slides else values)
        centre, along = move[:3, :3] @ point + move[:3, 3], move[:3, :3] @ np.array(joint.direction, float)
        if any(np.linalg.norm(centre - other) < 1.6 * half for other, _ in lines):
            centre = centre + 2.4 * half * along
        lines.append((centre, along))
    return lines


def _axes_about(along: np.ndarray) -> np.ndarray:
    side = np.eye(3)[int(np.argmin(np.abs(along)))]
    side = side - (side @ along) * along
    side = side / np.linalg.norm(side)
    return np.column_stack([side, np.cross(along, side), along])


def _end_frame(arm: Arm, values) -> np.ndarray:
    return rigid_transform(np.column_stack([arm.x, np.cross(arm.z, arm.x), arm.z]), arm.at(arm.origin, values))


def _draw_axes(ax, labels, arm: Arm, lines, size) -> list[np.ndarray]:
    """Centre lines of the joints, with an arrow for the sense and the name of the joint."""
    ends, tips = [], []
    for number, (joint, (centre, along)) in enumerate(zip(arm.joints, lines), 1):
        reach = 1.35 * size
        while any(np.linalg.norm(centre + reach * along - tip) < 0.5 * size for tip in tips):
            reach += 0.8 * size  # joints on one line: each has an arrowhead of its own
        low, high = centre - 1.1 * size * along, centre + reach * along
        ax.plot(*zip(low, high), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=2)
        draw_arrow_3d(ax, high - 0.5 * size * along, high, AXIS_COLOURS["z"], AXIS_DASHES["z"], width=1.5)
        labels.ask(high, f"$Z_{{{number}}}\\ ({said_letter(joint.name)})$", along, AXIS_COLOURS["z"])
        tips.append(high)
        ends += [low[None], high[None]]
    return ends


def _named(arm: Arm) -> set[str]:
    """The axis of the end effector that the last joint's arrow names already."""
    return {f"$Z_{{{len(arm.joints)}}}$"} if tuple(arm.z) == tuple(arm.joints[-1].direction) else set()


def _name_lengths(ax, labels, ways) -> None:
    for start, end, text in ways:
        labels.avoid(start + np.outer(np.linspace(0, 1, 9), end - start))
        if text:
            side = np.cross(end - start, view_axes(ax)[2])
            side = side if np.linalg.norm(side) > 1e-9 else None
            labels.ask((start + end) / 2, f"${text}$", side, INK, gap=9)
