"""Drawings for direct models: turns about a centre, in which order, and a six-axis arm in its reference position."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np

from .. import strokes
from .chains import JOINT, LINK, Bodies, Labels
from .planar import planar_points

GHOST = (0, (3, 2))


def turn_about(angle, centre) -> np.ndarray:
    """The rotation by `angle` (radians) about `centre`, shape (2,) in metres: [R, (I - R) p; 0, 1], shape (3, 3)."""
    R = np.column_stack([strokes.unit_vector(angle), strokes.unit_vector(angle + np.pi / 2)])
    K = np.eye(3)
    K[:2, :2], K[:2, 2] = R, centre - R @ centre
    return K


def _moved(K, points):
    return points @ K[:2, :2].T + K[:2, 2]


@strokes.styled
def draw_turn_about(angle=np.radians(55), centre=(0.6, 0.0), reach=0.5, ax=None):
    """A link turned about a centre p, in two steps: about the origin first, then moved over by (I - R) p.

    Parameters
    ----------
    angle : float, in radians
    centre : array-like, shape (2,), in metres
        The point p; the link begins there and points along x in its reference position.
    reach : float, in metres
        Length of the link.

    Returns
    -------
    matplotlib Axes
    """
    angle = float(strokes.as_numbers(angle, "angle", ()))
    p = strokes.as_numbers(centre, "centre", (2,))
    reach = float(strokes.as_lengths(reach, "length of the link", ()))
    ax = ax or strokes.new_axes((6.4, 5.0))
    strokes.show_plane(ax)
    before = np.array([p, p + (reach, 0)])
    about_origin, about_p = _moved(turn_about(angle, np.zeros(2)), before), _moved(turn_about(angle, p), before)
    unit = np.hypot(*p) + reach
    strokes.link(ax, *before, "#f4f4f4", width=11, zorder=2)
    ax.plot(*about_origin.T, color=strokes.SOFT, lw=11, solid_capstyle="round", zorder=2.2)
    ax.plot(*about_origin.T, color="white", lw=9, solid_capstyle="round", zorder=2.3)
    strokes.link(ax, *about_p, strokes.POSTURE_SHADES[1], width=11, zorder=4)
    for foot in (p, before[1]):
        sweep = np.linspace(0, angle, 60)
        path = np.array([_moved(turn_about(part, np.zeros(2)), foot) for part in sweep])
        ax.plot(*path.T, color=strokes.SOFT, lw=0.9, ls=GHOST, zorder=1.5)
    for start, end in zip(about_origin, about_p):
        if np.hypot(*(end - start)) > 0.02 * unit:
            strokes.arrow(ax, start, end, strokes.INK, width=1.5, zorder=7)
    strokes.joint(ax, p, zorder=8)
    if np.hypot(*(p - about_origin[0])) > 0.15 * unit:
        strokes.write(ax, (about_p[1] + about_origin[1]) / 2 + (0.13 * unit, 0), r"$(I - R)\,p$")
        strokes.write(ax, about_origin[0] + np.array([-0.06, 0.03]) * unit, "$R\\,p$")
    strokes.write(ax, p + np.array([0.0, -0.08]) * unit, "$p$")
    strokes.write(ax, before[1] + np.array([0.0, -0.08]) * unit, "$P$")
    strokes.write(ax, about_origin[1] + np.array([0.0, 0.08]) * unit, "$R\\,P$", color=strokes.SOFT)
    strokes.write(ax, about_p[1] + np.array([0.03, 0.08]) * unit, "$P'$", ha="left")
    if np.hypot(*p) > 0.05 * unit:
        strokes.angle_arc(ax, p, 0.42 * reach, 0, angle, r"\theta", 1.25)
        strokes.angle_arc(ax, (0, 0), 0.22 * unit, 0, angle, r"\theta", 1.25)
    for letter, heading in (("x", 0), ("y", np.pi / 2)):
        strokes.axis_arrow(ax, (0, 0), heading, 0.2 * unit, letter, f"{letter}_0")
    strokes.leave_room(ax, 0.14 * unit)
    return ax


@strokes.styled
def draw_turns(lengths=(0.5, 0.4, 0.2), q=(np.radians(40), np.radians(55), np.radians(-70)), *, hand_first=True):
    """The stretched arm brought to its joint angles by one turn per picture: from the hand, or from the base.

    From the hand every centre is still where it was in the reference position; from the base the centres move.

    Parameters
    ----------
    lengths : array-like, shape (3,), in metres
        L1, L2 and the length L4 of the tool.
    q : array-like, shape (3,), in radians
        t1, t2, t4.
    hand_first : bool

    Returns
    -------
    ndarray of 3 matplotlib Axes, in the order of the turns
    """
    lengths = strokes.as_lengths(lengths, "lengths", (3,))
    q = strokes.as_numbers(q, "t1, t2, t4", (3,))
    points = planar_points(lengths, np.zeros(3))
    reach = lengths.sum()
    _figure, panels = plt.subplots(1, 3, figsize=(10.5, 3.9), sharex=True, sharey=True, layout="constrained")
    centre_names = (
        ("[0, 0]", "[L_1, 0]", "[L_1 + L_2, 0]")
        if hand_first
        else ("[0, 0]", r"p_1(\theta_1)", r"p_2(\theta_1, \theta_2)")
    )
    seen = [points]
    for step, (ax, joint) in enumerate(zip(panels, (2, 1, 0) if hand_first else (0, 1, 2))):
        before, centre = points.copy(), points[joint]
        points = np.vstack([points[: joint + 1], _moved(turn_about(q[joint], centre), points[joint + 1 :])])
        seen.append(points)
        strokes.show_plane(ax, labels=("x (m)", "y (m)" if step == 0 else ""))
        ax.plot(*before[joint:].T, color=strokes.SOFT, lw=1.3, ls=GHOST, zorder=2)
        strokes.arm(ax, points, strokes.POSTURE_SHADES[0], width=9)
        ax.plot(*points[-1], "o", ms=5, color=strokes.INK, zorder=6)
        strokes.target_mark(ax, centre)
        heading = np.arctan2(*(before[joint + 1] - centre)[::-1])
        name = rf"\theta_{(1, 2, 4)[joint]}"
        strokes.angle_arc(ax, centre, 0.8 * lengths[joint], heading, q[joint], name, 1 + 0.09 * reach / lengths[joint])
        ax.set_title(rf"{step + 1}.  ${name}$ about ${centre_names[joint]}$")
    low, high = np.min(seen, axis=(0, 1)) - 0.12 * reach, np.max(seen, axis=(0, 1)) + 0.12 * reach
    panels[0].set_xlim(low[0], high[0])
    panels[0].set_ylim(low[1], high[1])
    return panels


SIX_AXES = "zxxzxz"


def six_centres(D3, L2, D4) -> np.ndarray:
    """A point on each axis of the six-axis arm in its reference position, shape (6, 3)."""
    return np.array([[0, 0, 0], [0, 0, 0], [0, 0, L2], [D3, 0, L2 + 0.4 * D4], [D3, 0, L2 + D4], [D3, 0, L2 + D4]])


def turn_in_space(letter, angle, centre) -> np.ndarray:
    """The rotation by `angle` (radians) about an axis along x or z through `centre`, shape (4, 4)."""
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[1, 0, 0], [0, c, -s], [0, s, c]] if letter == "x" else [[c, -s, 0], [s, c, 0], [0, 0, 1]])
    K = np.eye(4)
    K[:3, :3], K[:3, 3] = R, centre - R @ centre
    return K


@strokes.styled
def draw_six_axes(q=(0, 0, 0, 0, 0, 0), D3=0.2, L2=0.5, D4=0.6, h=0.2, ax=None):
    """The six-axis arm of the EPFL slides: axes, positive senses and, in the reference position, its dimensions.

    Parameters
    ----------
    q : array-like, shape (6,), in radians
        Joint angles; all zero is the reference position.
    D3, L2, D4, h : float, in metres
        Offset along axis 3, distance of axes 2 and 3, of axes 3 and 5, and from the wrist centre to the hand point.

    Returns
    -------
    matplotlib Axes (3D)
    """
    q = strokes.as_numbers(q, "t1 to t6", (6,))
    D3, L2, D4, h = strokes.as_lengths([D3, L2, D4, h], "D3, L2, D4, h", (4,))
    own, ax = ax is None, ax or strokes.new_axes_3d(elev=16, azim=-35)
    unit, moving = L2 + D4, bool(q.any())
    moved = six_axis_motions(q, D3, L2, D4)

    def at(link, point):
        return (moved[link] @ np.append(point, 1.0))[:3]

    floor = -0.3 * unit
    corners = 0.32 * unit * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]])
    ax.plot(*corners.T, floor, color=strokes.FAINT, lw=0.8, zorder=0)
    elbow, knee = np.array([0, 0, L2]), np.array([D3, 0, L2])
    sleeve, wrist, hand = np.array([D3, 0, L2 + 0.45 * D4]), np.array([D3, 0, L2 + D4]), np.array([D3, 0, L2 + D4 + h])
    bars = (
        (0, (0, 0, floor), (0, 0, 0)), (2, (0, 0, 0), elbow), (3, elbow, knee), (3, knee, sleeve), (4, sleeve, wrist),
        (6, wrist, hand),
    )  # fmt: skip
    bodies, labels = Bodies(ax, unit), Labels()
    for link, start, end in bars:
        bodies.tube(at(link, start), at(link, end), 0.02 * unit, LINK)
        bodies.ball(at(link, end), 0.02 * unit, LINK)
    points = [(*corner, floor) for corner in corners]
    # Where each joint's body sits, and where, seen from there along the axis, its angle is shown.
    middles = ((0, 0, -0.16 * unit), (0, 0, 0), elbow, sleeve, wrist, hand - (0, 0, 0.5 * h))
    shown_at = np.array([0.26, 0.24, 0.30, 0.15, 0.24, 0.24]) * unit
    for i, (letter, middle) in enumerate(zip(SIX_AXES, middles)):
        along = moved[i][:3, :3] @ np.eye(3)["xyz".index(letter)]
        aside = moved[i][:3, :3] @ np.eye(3)[1]
        middle = at(i, middle)
        ends = np.array([middle - 0.14 * unit * along, middle + 1.25 * shown_at[i] * along])
        ax.plot(*ends.T, color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=2)
        bodies.tube(middle - 0.045 * unit * along, middle + 0.045 * unit * along, 0.036 * unit, JOINT, caps=True)
        place, ring = middle + shown_at[i] * along, 0.055 * unit
        strokes.angle_arc_3d(ax, place, aside, np.cross(along, aside), ring, 1.6 * np.pi, "", 1)
        up = np.array([0, 0, 1.0]) if abs(along[2]) < 0.7 else aside
        labels.ask(place + 1.1 * ring * up, rf"$\theta_{i + 1}$", up)
        labels.avoid(place + ring * np.array(list((aside, -aside, np.cross(along, aside), np.cross(aside, along)))))
        points += list(ends)
    bodies.draw(ax, zorder=2.5)
    for link, point in ((6, wrist), (6, hand)):
        ax.plot(*at(link, point)[:, None], "o", ms=5, color=strokes.INK, zorder=8)
    for letter, direction in zip("xy", np.eye(3)):
        end = 0.3 * unit * direction + (0, 0, floor)
        strokes.arrow_3d(ax, (0, 0, floor), end, strokes.AXIS_COLOURS[letter], strokes.AXIS_DASHES[letter])
        strokes.write_3d(ax, end + 0.06 * unit * direction, f"${letter}$", color=strokes.AXIS_COLOURS[letter])
    strokes.write_3d(ax, (-0.05 * unit, -0.05 * unit, -0.02 * unit), "$O$", ha="right")
    if moving:  # the same view for all postures: the picture does not jump while a slider moves
        side, top = 0.55 * (unit + h), 0.68 * (unit + h)
        points = [(x, y, z) for x in (-side, side) for y in (-side, side) for z in (floor, top)]
    else:
        aside = np.array([0, 0.25 * unit, 0])
        for start, end, shift, name in (
            (np.zeros(3), elbow, -aside, "L_2"), (knee, wrist, 1.4 * aside, "D_4"), (wrist, hand, 1.4 * aside, "h")
        ):  # fmt: skip
            strokes.dimension_3d(ax, start, end, shift, name)
        # D3 is short: its name stands beside the arrow.
        for foot in (elbow, knee):
            ax.plot(*zip(foot, foot - (0, 0, 0.22 * unit)), color=strokes.SOFT, lw=0.7, zorder=4)
        strokes.arrow_3d(ax, *(foot - (0, 0, 0.2 * unit) for foot in (elbow, knee)), width=0.9, style="<|-|>", scale=8)
        strokes.write_3d(ax, (elbow + knee) / 2 - (0, 0, 0.26 * unit), "$D_3$")
        points += [hand + 1.6 * aside, -1.3 * aside]
    strokes.fit_3d(ax, points, own, width=5.6, height=6.0)
    labels.place(ax)
    return ax


def six_axis_motions(q, D3, L2, D4) -> list[np.ndarray]:
    """What moves the links 0 to 6 of the six-axis arm out of their reference position: I, K1, K1 K2, ..., 4x4 each."""
    motions = [np.eye(4)]
    for letter, angle, centre in zip(SIX_AXES, q, six_centres(D3, L2, D4)):
        motions.append(motions[-1] @ turn_in_space(letter, angle, centre))
    return motions
