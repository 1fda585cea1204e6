"""Three nested hinges that make a set of Euler angles: two rings and, inside, the hand."""

from __future__ import annotations

import numpy as np

from ..geometry import rigid_transform
from .frames import add_frames
from .inputs import as_axis_letters, as_numbers
from .labels import Labels
from .orientation import ANGLE_NAMES, axis_direction, draw_brick, draw_grey_axes, draw_round_arrow, turn_in_steps
from .strokes_3d import arc_points, write_3d
from .style import AXIS_COLOURS, CENTRE_LINE, INK, styled
from .view import fit_3d, new_axes_3d, view_axes


@styled
def draw_gimbal(angles=(0.0, 0.0, 0.0), axes="zyx", ax=None, *, names=ANGLE_NAMES, captions=(), wanted=None):
    """Draw three nested hinges that make a set of Euler angles: two rings and, inside, the hand.

    The outer ring turns about an axis that is fixed, the inner ring about an axis of the outer one, the hand about
    an axis of the inner ring. Where two of the three axes fall on one line, a freedom is lost.

    Parameters
    ----------
    angles : array-like, shape (3,) or (n, 3), in radians
        The three angles, from the outer hinge to the inner one; several sets are drawn side by side.
    axes : str
        Three letters, in the same order; neighbours differ.
    names : three texts
        Names of the angles in mathematical notation.
    captions : n texts
        A line under each drawing.
    wanted : array-like, shape (3, 3) or (n, 3, 3), optional
        Orientations to compare the hand with: their axes x, y, z as grey arrows.

    Returns
    -------
    matplotlib Axes (3D)
    """
    as_axis_letters(axes, 3)
    if axes[0] == axes[1] or axes[1] == axes[2]:
        raise ValueError(f"axes: neighbours must differ, found {axes!r}")
    rows = np.atleast_2d(as_numbers(angles, "angles", (None,) * np.ndim(angles)))
    if rows.shape[1] != 3:
        raise ValueError(f"angles: expected n x 3 numbers, found {' x '.join(map(str, rows.shape))}")
    if wanted is not None:
        wanted = np.broadcast_to(as_numbers(wanted, "wanted", (None,) * np.ndim(wanted)), (len(rows), 3, 3))
    own, ax = ax is None, ax or new_axes_3d(elev=24, azim=-58)
    step = 3.9 * view_axes(ax)[0]
    points, labels = [], Labels()
    for k, row in enumerate(rows):
        centre = k * step
        _rings(ax, labels, centre, row, axes, names)
        if wanted is not None:
            draw_grey_axes(ax, centre, wanted[k])
        if k < len(captions):
            write_3d(ax, centre + (0, 0, -2.3), captions[k], fontsize=10)
        points += [centre + s * 1.75 * v for s in (1, -1) for v in np.eye(3)]
        points += [centre + (0, 0, -2.4)] if captions else []
        points += [centre + s * 0.48 * step for s in (1, -1)]
    fit_3d(ax, points, own, width=4.6 + 3.2 * (len(rows) - 1), height=4.8)
    labels.place(ax)
    return ax


def gimbal_axes(angles, axes) -> np.ndarray:
    """Directions of the three hinges in the base, shape (3, 3): one row per hinge."""
    states = turn_in_steps(angles, axes)
    return np.array([state @ axis_direction(letter) for state, letter in zip(states, axes)])


def _rings(ax, labels, centre, angles, axes, names):
    states = turn_in_steps(angles, axes)
    lines = gimbal_axes(angles, axes)
    tips = np.vstack([np.outer(np.linspace(0.3, 1.1, 7), axis) for axis in states[3].T])
    labels.avoid(centre + tips)
    _base_hinge(ax, centre, lines[0])
    for radius, shades, first, second in ((1.3, ("#ebebeb", "#b4b4b4"), 0, 1), (0.98, ("#cfcfcf", "#777777"), 1, 2)):
        _ring(ax, centre, radius, states[second] @ axis_direction(axes[first]), lines[second], shades)
    for line, inner, outer in ((lines[1], 0.98, 1.3), (lines[2], 0.3, 0.98)):
        for sense in (1, -1):
            _rod(ax, centre + sense * inner * line, centre + sense * outer * line, centre)
    draw_brick(ax, states[3], centre, (0.62, 0.46, 0.18), zorder=4)
    add_frames(ax, [rigid_transform(states[3], centre)], [""], 0.62)
    for group in _same_lines(lines):
        line, letter = lines[group[0]], axes[group[0]]
        ends = np.array([centre - 1.52 * line, centre + 1.52 * line])
        ax.plot(*ends.T, color=AXIS_COLOURS[letter], lw=1.1, ls=CENTRE_LINE, zorder=1.0)
        for hinge in group:
            draw_round_arrow(ax, centre + 1.5 * lines[hinge], lines[hinge], 0.12, AXIS_COLOURS[axes[hinge]])
        for sense in (1, -1):
            owners = [hinge for hinge in group if sense * (lines[hinge] @ line) > 0]
            if owners:
                text = ", ".join(f"{names[hinge]}\\;({axes[hinge]})" for hinge in owners)
                at, out = centre + sense * 1.58 * line, _outwards(ax, sense * line)
                labels.ask(at, f"${text}$", out, AXIS_COLOURS[axes[owners[0]]], gap=10)
                labels.avoid(at)


def _same_lines(lines) -> list[list[int]]:
    """Hinges grouped by the line they turn about."""
    groups: list[list[int]] = []
    for k, line in enumerate(lines):
        for group in groups:
            if abs(abs(line @ lines[group[0]]) - 1) < 1e-6:
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def _depth(ax, offset) -> float:
    """Drawing order of a piece at `offset` from the centre: nearer pieces later."""
    return 4 + 1.2 * float(offset @ view_axes(ax)[2])


def _ring(ax, centre, radius, first, second, shades, pieces=48):
    """A ring in the plane of two directions, in pieces, so that what is nearer hides what is farther.

    The half on the side of `second` has the darker shade, so that half a turn of the ring can be seen.
    """
    second = second - (second @ first) * first
    second = second / np.linalg.norm(second)
    for k in range(pieces):
        turn = 2 * np.pi * (k + np.array([-0.2, 0, 0.5, 1, 1.2])) / pieces
        arc = arc_points(np.zeros(3), radius, first, second, turn)
        depth = _depth(ax, arc[2])
        shade = shades[int(arc[2] @ second > 0)]
        # The outline is shorter than the filling: else its ends would show as seams between the pieces.
        ax.plot(*(centre + arc[1:-1]).T, color=INK, lw=6, solid_capstyle="butt", zorder=depth)
        ax.plot(*(centre + arc).T, color=shade, lw=4, solid_capstyle="butt", zorder=depth + 1e-3)


def _rod(ax, start, end, centre, width=4.0):
    depth = _depth(ax, (start + end) / 2 - centre) - 0.05
    ax.plot(*zip(start, end), color=INK, lw=width, solid_capstyle="butt", zorder=depth)


def _base_hinge(ax, centre, line):
    """The two bearings of the outer ring, hatched: they do not move."""
    right = view_axes(ax)[0]
    across = right if abs(line @ right) < 0.7 else np.array([0, 0, 1.0])
    across = across - (across @ line) * line
    across = across / np.linalg.norm(across)
    for sense in (1, -1):
        foot = centre + sense * 1.42 * line
        _rod(ax, centre + sense * 1.3 * line, foot, centre)
        ax.plot(*zip(foot - 0.16 * across, foot + 0.16 * across), color=INK, lw=1.4, zorder=3)
        for s in np.linspace(-0.12, 0.16, 5):
            ax.plot(
                *zip(foot + s * across, foot + (s - 0.06) * across + sense * 0.07 * line),
                color=INK,
                lw=0.8,
                zorder=3,
            )


def _outwards(ax, direction) -> np.ndarray:
    """Unit vector in the plane of the paper that points as `direction` is seen, or up where it is seen end on."""
    right, _, view = view_axes(ax)
    seen = direction - (direction @ view) * view
    seen = seen if np.linalg.norm(seen) > 0.05 else np.cross(view, right)
    return seen / np.linalg.norm(seen)
