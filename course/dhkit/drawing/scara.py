"""Drawings of the SCARA: side view, seen from above, and in three dimensions."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Polygon, Rectangle

from .. import strokes
from .frames import draw_frames
from .planar import planar_points


@strokes.styled
def draw_scara_side(a2=0.4, a3=0.3, d2=0.18, ax=None, *, frames=True):
    """Kinematic sketch of the SCARA from the side, at t1 = t2 = t4 = 0: axes, frames 0 to 4, a2, a3 and d2.

    Parameters
    ----------
    a2, a3 : float, in metres
        Distance of axes 1 and 2, and of axes 2 and 3.
    d2 : float, in metres
        Depth of the quill below the arm, positive downwards.
    frames : bool
        Draw the frames.

    Returns
    -------
    matplotlib Axes
    """
    a2, a3 = strokes.as_lengths([a2, a3], "a2 and a3", (2,))
    d2 = float(strokes.as_numbers(d2, "d2", ()))
    ax = ax or strokes.new_axes((6.6, 4.6))
    strokes.show_bare(ax)
    unit = (a2 + a3) / 0.7
    floor, top, low = -0.36 * unit, 0.27 * unit, -0.42 * unit
    joints = np.array([0, a2, a2 + a3])
    names = ("Z_0, Z_1", "Z_2", "Z_3, Z_4")
    for x, name in zip(joints, names):
        bottom = floor if x == 0 else min(low, -d2 - 0.13 * unit)
        ax.plot([x, x], [bottom, top - 0.04 * unit], color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=1)
        strokes.write(ax, (x, top), f"${name}$", color=strokes.AXIS_COLOURS["z"] if frames else strokes.INK)
    strokes.ground(ax, (0, floor), 0.24 * unit, 0.035 * unit)
    _bar(ax, (0, floor), (0, 0))
    _bar(ax, (0, 0), (a2, 0))
    _bar(ax, (a2, 0), (a2 + a3, 0))
    hand = (a2 + a3, -d2)
    ax.plot([hand[0]] * 2, [0.11 * unit, -d2], color=strokes.INK, lw=4, zorder=3.2, solid_capstyle="butt")
    _revolute_side(ax, (0, 0), unit)
    _revolute_side(ax, (a2, 0), unit)
    _prismatic_side(ax, (a2 + a3, 0), unit)
    _revolute_side(ax, hand, 0.8 * unit)
    _gripper(ax, hand, unit)
    if frames:
        size = 0.125 * unit
        for origin, index in (((0, 0), "0, 1"), ((a2, 0), "2"), (hand, "3, 4")):
            first, *rest = index.split(", ")
            x_name = ", ".join(f"X_{i}" for i in [first, *rest])
            side = np.array(origin)
            strokes.arrow(ax, side, side + (size, 0), strokes.AXIS_COLOURS["x"])
            strokes.write(ax, side + (size * 1.0, 0.045 * unit), f"${x_name}$", color=strokes.AXIS_COLOURS["x"])
            strokes.arrow(ax, side, side + (0, size), strokes.AXIS_COLOURS["z"])
            origin_name = ", ".join(f"O_{i}" for i in [first, *rest])
            strokes.write(ax, side + (-0.05 * unit, -0.065 * unit), f"${origin_name}$", ha="right")
    strokes.dimension(ax, (0, 0), (a2, 0), "a_2", 0.2 * unit)
    strokes.dimension(ax, (a2, 0), (a2 + a3, 0), "a_3", 0.2 * unit)
    if abs(d2) > 0.02 * unit:
        _depth(ax, a2 + a3, d2, unit)
    ax.set_xlim(-0.22 * unit, a2 + a3 + 0.3 * unit)
    ax.set_ylim(low - 0.06 * unit, top + 0.06 * unit)
    return ax


def _depth(ax, x, d2, unit):
    """The dimension d2: one arrow head, pointing the way in which d2 is counted."""
    right = x + 0.21 * unit
    for y in (0, -d2):
        ax.plot([x + 0.05 * unit, right + 0.025 * unit], [y, y], color=strokes.SOFT, lw=0.7, zorder=1)
    strokes.arrow(ax, (right, 0), (right, -d2), width=1.2)
    strokes.write(ax, (right + 0.05 * unit, -d2 / 2), "$d_2$")


def _bar(ax, start, end):
    ax.plot(*zip(start, end), color=strokes.INK, lw=3.2, zorder=2, solid_capstyle="butt")


def _revolute_side(ax, at, unit):
    """Revolute joint across its axis: a sleeve."""
    width, height = 0.05 * unit, 0.085 * unit
    ax.add_patch(
        Rectangle(
            (at[0] - width / 2, at[1] - height / 2),
            width,
            height,
            facecolor="white",
            edgecolor=strokes.INK,
            lw=1.5,
            zorder=3.5,
        )
    )


def _prismatic_side(ax, at, unit):
    """Prismatic joint across its axis: a square guide, the rod passing through."""
    side = 0.085 * unit
    ax.add_patch(
        Rectangle(
            (at[0] - side / 2, at[1] - side / 2),
            side,
            side,
            facecolor="white",
            edgecolor=strokes.INK,
            lw=1.5,
            zorder=3.1,
        )
    )
    for x in (-side / 2, side / 2):
        ax.plot([at[0] + x * 0.55] * 2, [at[1] - side / 2, at[1] + side / 2], color=strokes.INK, lw=0.8, zorder=3.15)


def _gripper(ax, at, unit):
    w, h = 0.045 * unit, 0.05 * unit
    x, y = at[0], at[1] - 0.034 * unit
    ax.plot([x, x], [y, y - 0.02 * unit], color=strokes.INK, lw=3.2, zorder=2)
    y -= 0.02 * unit
    ax.plot(
        [x - w, x - w, x + w, x + w], [y - h, y, y, y - h], color=strokes.INK, lw=1.8, zorder=3, solid_joinstyle="miter"
    )


@strokes.styled
def draw_scara_top(q=(np.radians(35), np.radians(50), np.radians(-40)), a2=0.4, a3=0.3, ax=None, *, frames=True):
    """The SCARA from above: the planar arm of joints 1 and 2, and the hand turned by joint 4.

    Parameters
    ----------
    q : array-like, shape (3,), in radians
        t1, t2, t4.
    a2, a3 : float, in metres
    frames : bool
        Draw the X axes; their labels name the frames.

    Returns
    -------
    matplotlib Axes
    """
    t1, t2, t4 = strokes.as_numbers(q, "t1, t2, t4", (3,))
    lengths = strokes.as_lengths([a2, a3], "a2 and a3", (2,))
    points = planar_points(lengths, (t1, t2))
    unit = lengths.sum()
    ax = ax or strokes.new_axes((6.0, 5.0))
    strokes.show_bare(ax)
    strokes.arm(ax, points, strokes.POSTURE_SHADES[0], width=15)
    heading = np.cumsum([t1, t2, t4])
    _hand_top(ax, points[2], heading[2], unit)
    size = 0.24 * unit
    lines = (
        (points[0], 0.0, t1, r"\theta_1"),
        (points[1], heading[0], t2, r"\theta_2"),
        (points[2], heading[1], t4, r"\theta_4"),
    )
    for k, (centre, start, sweep, name) in enumerate(lines):
        ax.plot(
            *zip(centre, centre + 1.15 * size * strokes.unit_vector(start)),
            color=strokes.SOFT,
            lw=1,
            ls=strokes.CENTRE_LINE,
            zorder=2,
        )
        strokes.angle_arc(ax, centre, (0.62, 0.62, 0.72)[k] * size, start, sweep, name, 1.38)
    if frames:
        strokes.axis_arrow(ax, (0, 0), 0, 1.35 * size, "x", "X_0")
        strokes.axis_arrow(ax, (0, 0), np.pi / 2, 1.1 * size, "y", "Y_0")
        strokes.axis_arrow(ax, points[0], heading[0], 1.1 * size, "x", "", away=0)
        strokes.write(
            ax,
            points[0]
            + size * strokes.unit_vector(heading[0])
            + 0.11 * unit * strokes.unit_vector(heading[0] + np.pi / 2),
            "$X_1$",
            color=strokes.AXIS_COLOURS["x"],
        )
        strokes.axis_arrow(ax, points[1], heading[1], 1.0 * size, "x", "", away=0)
        strokes.write(
            ax,
            points[1]
            + 0.8 * size * strokes.unit_vector(heading[1])
            + 0.11 * unit * strokes.unit_vector(heading[1] + np.pi / 2),
            "$X_2$",
            color=strokes.AXIS_COLOURS["x"],
        )
        strokes.axis_arrow(ax, points[2], heading[2], 1.2 * size, "x", "X_4")
        strokes.write(
            ax, points[2] + 1.32 * size * strokes.unit_vector(heading[1]), "$X_3$", color=strokes.AXIS_COLOURS["x"]
        )
    strokes.dimension(ax, points[0], points[1], "a_2", -0.15 * unit)
    strokes.dimension(ax, points[1], points[2], "a_3", -0.15 * unit)
    ax.margins(0.06)
    return ax


def _hand_top(ax, at, heading, unit):
    """Quill from above: a square (prismatic) with a bar across, the hand."""
    side = 0.045 * unit
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * side
    turn = np.array([strokes.unit_vector(heading), strokes.unit_vector(heading + np.pi / 2)])
    ax.add_patch(Polygon(at + corners @ turn, facecolor="white", edgecolor=strokes.INK, lw=1.4, zorder=5))
    across = 1.7 * side * strokes.unit_vector(heading + np.pi / 2)
    ax.plot(*zip(at - across, at + across), color=strokes.INK, lw=2.4, zorder=5.2)
    ax.plot(*at, "o", ms=3, color=strokes.INK, zorder=6)


@strokes.styled
def draw_scara_projections(q=(np.radians(62), np.radians(-38)), a2=0.4, a3=0.3, ax=None):
    """Top view of the SCARA with both links projected on the base axes: the geometric check of the model.

    O0A and AB add up to x, O0C and CD to y, as on the MECA 953 slides.

    Parameters
    ----------
    q : array-like, shape (2,), in radians
        t1 and t2, with the hand in the first quadrant.
    a2, a3 : float, in metres

    Returns
    -------
    matplotlib Axes
    """
    q = strokes.as_numbers(q, "t1 and t2", (2,))
    lengths = strokes.as_lengths([a2, a3], "a2 and a3", (2,))
    points = planar_points(lengths, q)
    elbow, hand = points[1], points[2]
    unit = lengths.sum()
    ax = ax or strokes.new_axes((6.4, 5.4))
    strokes.show_bare(ax)
    strokes.arm(ax, points, strokes.POSTURE_SHADES[0])
    ax.plot(*hand, "o", ms=7, color=strokes.INK, zorder=6)
    strokes.axis_arrow(ax, (0, 0), 0, hand[0] + 0.2 * unit, "x", "X_0", away=0.05, neck=0.97)
    strokes.axis_arrow(ax, (0, 0), np.pi / 2, hand[1] + 0.2 * unit, "y", "Y_0", away=0.06, neck=0.97)
    for point in (elbow, hand):
        ax.plot([point[0], point[0], 0], [0, point[1], point[1]], color=strokes.SOFT, lw=1, ls=(0, (3, 2)), zorder=1.5)
    for at, name, away in (
        ((elbow[0], 0), "A", (0.035, 0.035)), ((hand[0], 0), "B", (0.035, 0.035)),
        ((0, elbow[1]), "C", (0.035, -0.035)), ((0, hand[1]), "D", (0.035, 0.035)),
    ):  # fmt: skip
        ax.plot(*at, "o", ms=4, color=strokes.INK, zorder=7)
        strokes.write(ax, np.array(at) + unit * np.array(away), f"${name}$")
    low = -0.11 * unit
    strokes.dimension(ax, (0, 0), (elbow[0], 0), r"a_2 \cos\theta_1", low)
    strokes.dimension(ax, (elbow[0], 0), (hand[0], 0), r"a_3 \cos(\theta_1 + \theta_2)", low)
    strokes.dimension(ax, (0, 0), (0, elbow[1]), r"a_2 \sin\theta_1", 0.11 * unit, beside=True)
    strokes.dimension(ax, (0, elbow[1]), (0, hand[1]), r"a_3 \sin(\theta_1 + \theta_2)", 0.11 * unit, beside=True)
    ax.plot(
        *zip(elbow, elbow + 0.34 * unit * strokes.unit_vector(q[0])),
        color=strokes.SOFT,
        lw=1,
        ls=strokes.CENTRE_LINE,
        zorder=2,
    )
    ax.plot(*zip(elbow, elbow + (0.26 * unit, 0)), color=strokes.SOFT, lw=0.8, ls=(0, (3, 2)), zorder=1.5)
    strokes.angle_arc(ax, (0, 0), 0.17 * unit, 0, q[0], r"\theta_1", 1.4)
    strokes.angle_arc(ax, elbow, 0.24 * unit, q[0], q[1], r"\theta_2 < 0" if q[1] < 0 else r"\theta_2", 1.42)
    strokes.write(ax, elbow / 2 + 0.07 * unit * strokes.unit_vector(q[0] + np.pi / 2), "$a_2$")
    strokes.write(ax, (elbow + hand) / 2 - 0.075 * unit * strokes.unit_vector(q.sum() + np.pi / 2), "$a_3$")
    strokes.write(ax, (0, 0) + unit * np.array([-0.045, -0.04]), "$O_0$")
    ax.margins(0.05)
    return ax


def scara_frames(q, a2, a3) -> np.ndarray:
    """Frames 0 to 4 of the SCARA seen from the base, for drawing.

    Parameters
    ----------
    q : array-like, shape (4,)
        t1, t2 in radians, d2 in metres (positive downwards), t4 in radians.
    a2, a3 : float, in metres

    Returns
    -------
    ndarray, shape (5, 4, 4)
    """
    t1, t2, d2, t4 = strokes.as_numbers(q, "t1, t2, d2, t4", (4,))
    points = planar_points([a2, a3], (t1, t2))
    origins = [(*points[0], 0), (*points[0], 0), (*points[1], 0), (*points[2], -d2), (*points[2], -d2)]
    headings = [0, t1, t1 + t2, t1 + t2, t1 + t2 + t4]
    frames = np.tile(np.eye(4), (5, 1, 1))
    for frame, origin, heading in zip(frames, origins, headings):
        frame[:2, :2] = np.column_stack([strokes.unit_vector(heading), strokes.unit_vector(heading + np.pi / 2)])
        frame[:3, 3] = origin
    return frames


@strokes.styled
def draw_scara_3d(
    q=(np.radians(-25), np.radians(60), 0.2, np.radians(-55)), a2=0.4, a3=0.3, ax=None, *, frames=True, dimensions=True
):
    """The SCARA as a body: column, two links, quill; joint axes, frames and the dimensions a2, a3, d2.

    Parameters
    ----------
    q : array-like, shape (4,)
        t1, t2 in radians, d2 in metres (positive downwards), t4 in radians.
    a2, a3 : float, in metres
    frames, dimensions : bool
        Draw the frames 0 to 4; draw the dimensions.

    Returns
    -------
    matplotlib Axes (3D)
    """
    a2, a3 = strokes.as_lengths([a2, a3], "a2 and a3", (2,))
    transforms = scara_frames(q, a2, a3)
    unit = a2 + a3
    base, elbow, hand = transforms[1, :3, 3], transforms[2, :3, 3], transforms[4, :3, 3]
    wrist = hand * (1, 1, 0)
    floor = -0.55 * unit
    own, ax = ax is None, ax or strokes.new_axes_3d(elev=24, azim=-66)
    corners = unit * np.array([[-0.3, -0.3], [1.0, -0.3], [1.0, 0.9], [-0.3, 0.9]])
    ax.plot(*np.vstack([corners, corners[:1]]).T, floor, color=strokes.FAINT, lw=0.8, zorder=0)
    thick = 0.07 * unit
    strokes.solid(ax, strokes.disc(base[:2], 0.14 * unit), floor, floor + 0.04 * unit, 0.75, 0.5)
    strokes.solid(ax, strokes.disc(base[:2], 0.085 * unit), floor + 0.04 * unit, -thick, 0.85, 0.6)
    quill_top = 0.42 * unit
    if hand[2] < 0:
        strokes.solid(ax, strokes.disc(wrist[:2], 0.022 * unit), hand[2], 0, 0.7, 0.9)
    strokes.solid(ax, strokes.stadium(base[:2], elbow[:2], 0.085 * unit), -thick, 0, 0.92, 1.0)
    strokes.solid(ax, strokes.stadium(elbow[:2], wrist[:2], 0.07 * unit), 0, thick, 0.82, 1.2)
    if quill_top + hand[2] > thick:
        strokes.solid(ax, strokes.disc(wrist[:2], 0.022 * unit), thick, quill_top + hand[2], 0.7, 1.3)
    for foot, top, name in ((base, 0.36, "Z_0, Z_1"), (elbow, 0.36, "Z_2"), (wrist, 0.46, "Z_3, Z_4")):
        low = floor if foot is base else min(hand[2], 0) - 0.12 * unit
        ax.plot(
            *zip(foot * (1, 1, 0) + (0, 0, low), foot * (1, 1, 0) + (0, 0, top * unit)),
            color=strokes.SOFT,
            lw=0.9,
            ls=strokes.CENTRE_LINE,
            zorder=2,
        )
        strokes.write_3d(
            ax, foot * (1, 1, 0) + (0, 0, (top + 0.05) * unit), f"${name}$", color=strokes.AXIS_COLOURS["z"]
        )
    points = [corner + (floor,) for corner in map(tuple, corners)] + [wrist + (0, 0, 0.55 * unit)]
    if frames:
        size = 0.24 * unit
        draw_frames(ax, transforms, "01234", size, letters="x")
        for transform in transforms[[0, 2, 4]]:
            strokes.arrow_3d(
                ax,
                transform[:3, 3],
                transform[:3, 3] + (0, 0, size),
                strokes.AXIS_COLOURS["z"],
                strokes.AXIS_DASHES["z"],
            )
    if dimensions:
        level = 0.17 * unit
        strokes.dimension_3d(ax, base, elbow, (0, 0, level), "a_2")
        strokes.dimension_3d(ax, elbow, wrist, (0, 0, level), "a_3")
        if abs(hand[2]) > 0.03 * unit:
            aside = 0.44 * unit * np.array([*strokes.unit_vector(np.radians(ax.azim + 100)), 0])
            for point in (wrist, hand):
                ax.plot(*zip(point, point + 1.1 * aside), color=strokes.SOFT, lw=0.7, zorder=4)
            strokes.arrow_3d(ax, wrist + aside, hand + aside, width=1.2)
            strokes.write_3d(ax, (wrist + hand) / 2 + 1.14 * aside, "$d_2$")
    strokes.fit_3d(ax, points, own)
    return ax
