"""Drawings of the SCARA: side view, seen from above, and in three dimensions."""

from __future__ import annotations

import numpy as np

from ..geometry import planar_joints, rigid_transform, rotation, unit_vector
from .frames import add_frames
from .inputs import as_lengths, as_numbers
from .sketch import (
    draw_bar,
    draw_counted_length,
    draw_frame_from_the_side,
    draw_jaws,
    draw_prismatic,
    draw_quill_from_above,
    draw_revolute,
)
from .strokes import (
    draw_angle,
    draw_arm,
    draw_axis_arrow,
    draw_dimension,
    draw_ground,
    draw_prolonged,
    new_axes,
    show_bare,
    write,
)
from .strokes_3d import disc_outline, draw_arrow_3d, draw_dimension_3d, draw_prism, stadium_outline, write_3d
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, DASHED, FAINT, INK, POSTURE_SHADES, SOFT, styled
from .view import fit_3d, new_axes_3d


@styled
def draw_scara_side(a2=0.4, a3=0.3, d2=0.18, ax=None, *, frames=True):
    """Draw a kinematic sketch of the SCARA from the side, at t1 = t2 = t4 = 0: axes, frames 0 to 4, a2, a3 and d2.

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
    a2, a3 = as_lengths([a2, a3], "a2 and a3", (2,))
    d2 = float(as_numbers(d2, "d2", ()))
    ax = ax or new_axes((6.6, 4.6))
    show_bare(ax)
    unit = (a2 + a3) / 0.7
    floor, top, low = -0.36 * unit, 0.27 * unit, -0.42 * unit
    joints = np.array([0, a2, a2 + a3])
    names = ("Z_0, Z_1", "Z_2", "Z_3, Z_4")
    for x, name in zip(joints, names):
        bottom = floor if x == 0 else min(low, -d2 - 0.13 * unit)
        ax.plot([x, x], [bottom, top - 0.04 * unit], color=SOFT, lw=1, ls=CENTRE_LINE, zorder=1)
        write(ax, (x, top), f"${name}$", color=AXIS_COLOURS["z"] if frames else INK)
    draw_ground(ax, (0, floor), 0.24 * unit, 0.035 * unit)
    draw_bar(ax, (0, floor), (0, 0))
    draw_bar(ax, (0, 0), (a2, 0))
    draw_bar(ax, (a2, 0), (a2 + a3, 0))
    hand = (a2 + a3, -d2)
    ax.plot([hand[0]] * 2, [0.11 * unit, -d2], color=INK, lw=4, zorder=3.2, solid_capstyle="butt")
    draw_revolute(ax, (0, 0), unit)
    draw_revolute(ax, (a2, 0), unit)
    draw_prismatic(ax, (a2 + a3, 0), unit)
    draw_revolute(ax, hand, 0.8 * unit)
    draw_jaws(ax, hand, unit)
    if frames:
        for origin, x_name, origin_name in (
            ((0, 0), "X_0, X_1", "O_0, O_1"), ((a2, 0), "X_2", "O_2"), (hand, "X_3, X_4", "O_3, O_4")
        ):  # fmt: skip
            draw_frame_from_the_side(ax, origin, x_name, origin_name, unit)
    draw_dimension(ax, (0, 0), (a2, 0), "a_2", 0.2 * unit)
    draw_dimension(ax, (a2, 0), (a2 + a3, 0), "a_3", 0.2 * unit)
    draw_counted_length(ax, a2 + a3, 0, -d2, "$d_2$", unit)
    ax.set_xlim(-0.22 * unit, a2 + a3 + 0.3 * unit)
    ax.set_ylim(low - 0.06 * unit, top + 0.06 * unit)
    return ax


@styled
def draw_scara_top(q=(np.radians(35), np.radians(50), np.radians(-40)), a2=0.4, a3=0.3, ax=None, *, frames=True):
    """Draw the SCARA from above: the planar arm of joints 1 and 2, and the hand turned by joint 4.

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
    t1, t2, t4 = as_numbers(q, "t1, t2, t4", (3,))
    lengths = as_lengths([a2, a3], "a2 and a3", (2,))
    points = planar_joints(lengths, (t1, t2))
    unit = lengths.sum()
    ax = ax or new_axes((6.0, 5.0))
    show_bare(ax)
    draw_arm(ax, points, POSTURE_SHADES[0], width=15)
    heading = np.cumsum([t1, t2, t4])
    draw_quill_from_above(ax, points[2], heading[2], unit)
    size = 0.24 * unit
    for centre, start, sweep, name, radius in (
        (points[0], 0.0, t1, r"\theta_1", 0.62), (points[1], heading[0], t2, r"\theta_2", 0.62),
        (points[2], heading[1], t4, r"\theta_4", 0.72),
    ):  # fmt: skip
        draw_prolonged(ax, centre, start, 1.15 * size)
        draw_angle(ax, centre, radius * size, start, sweep, name, 1.38)
    if frames:
        _draw_x_axes(ax, points, heading, size)
    draw_dimension(ax, points[0], points[1], "a_2", -0.15 * unit)
    draw_dimension(ax, points[1], points[2], "a_3", -0.15 * unit)
    ax.margins(0.06)
    return ax


def _draw_x_axes(ax, points, heading, size):
    """The base frame, and the X axes of the others; those along a link have their names beside them."""
    red = AXIS_COLOURS["x"]
    draw_axis_arrow(ax, (0, 0), 0, 1.35 * size, "x", "X_0")
    draw_axis_arrow(ax, (0, 0), np.pi / 2, 1.1 * size, "y", "Y_0")
    for at, angle, length, beyond, name in (
        (points[0], heading[0], 1.1, 1.0, "X_1"),
        (points[1], heading[1], 1.0, 0.8, "X_2"),
    ):
        draw_axis_arrow(ax, at, angle, length * size, "x", "", away=0)
        beside = beyond * size * unit_vector(angle) + 0.46 * size * unit_vector(angle + np.pi / 2)
        write(ax, at + beside, f"${name}$", color=red)
    draw_axis_arrow(ax, points[2], heading[2], 1.2 * size, "x", "X_4")
    write(ax, points[2] + 1.32 * size * unit_vector(heading[1]), "$X_3$", color=red)


@styled
def draw_scara_projections(q=(np.radians(62), np.radians(-38)), a2=0.4, a3=0.3, ax=None):
    """Draw the SCARA from above with both links projected on the base axes: the geometric check of the model.

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
    q = as_numbers(q, "t1 and t2", (2,))
    lengths = as_lengths([a2, a3], "a2 and a3", (2,))
    points = planar_joints(lengths, q)
    elbow, hand = points[1], points[2]
    unit = lengths.sum()
    ax = ax or new_axes((6.4, 5.4))
    show_bare(ax)
    draw_arm(ax, points, POSTURE_SHADES[0])
    ax.plot(*hand, "o", ms=7, color=INK, zorder=6)
    draw_axis_arrow(ax, (0, 0), 0, hand[0] + 0.2 * unit, "x", "X_0", away=0.05, neck=0.97)
    draw_axis_arrow(ax, (0, 0), np.pi / 2, hand[1] + 0.2 * unit, "y", "Y_0", away=0.06, neck=0.97)
    for point in (elbow, hand):
        ax.plot([point[0], point[0], 0], [0, point[1], point[1]], color=SOFT, lw=1, ls=DASHED, zorder=1.5)
    for at, name, away in (
        ((elbow[0], 0), "A", (0.035, 0.035)), ((hand[0], 0), "B", (0.035, 0.035)),
        ((0, elbow[1]), "C", (0.035, -0.035)), ((0, hand[1]), "D", (0.035, 0.035)),
    ):  # fmt: skip
        ax.plot(*at, "o", ms=4, color=INK, zorder=7)
        write(ax, np.array(at) + unit * np.array(away), f"${name}$")
    low = -0.11 * unit
    draw_dimension(ax, (0, 0), (elbow[0], 0), r"a_2 \cos\theta_1", low)
    draw_dimension(ax, (elbow[0], 0), (hand[0], 0), r"a_3 \cos(\theta_1 + \theta_2)", low)
    draw_dimension(ax, (0, 0), (0, elbow[1]), r"a_2 \sin\theta_1", 0.11 * unit, beside=True)
    draw_dimension(ax, (0, elbow[1]), (0, hand[1]), r"a_3 \sin(\theta_1 + \theta_2)", 0.11 * unit, beside=True)
    draw_prolonged(ax, elbow, q[0], 0.34 * unit)
    ax.plot(*zip(elbow, elbow + (0.26 * unit, 0)), color=SOFT, lw=0.8, ls=DASHED, zorder=1.5)
    draw_angle(ax, (0, 0), 0.17 * unit, 0, q[0], r"\theta_1", 1.4)
    draw_angle(ax, elbow, 0.24 * unit, q[0], q[1], r"\theta_2 < 0" if q[1] < 0 else r"\theta_2", 1.42)
    write(ax, elbow / 2 + 0.07 * unit * unit_vector(q[0] + np.pi / 2), "$a_2$")
    write(ax, (elbow + hand) / 2 - 0.075 * unit * unit_vector(q.sum() + np.pi / 2), "$a_3$")
    write(ax, (0, 0) + unit * np.array([-0.045, -0.04]), "$O_0$")
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
    t1, t2, d2, t4 = as_numbers(q, "t1, t2, d2, t4", (4,))
    points = planar_joints([a2, a3], (t1, t2))
    origins = [(*points[0], 0), (*points[0], 0), (*points[1], 0), (*points[2], -d2), (*points[2], -d2)]
    headings = [0, t1, t1 + t2, t1 + t2, t1 + t2 + t4]
    return rigid_transform(rotation("z", headings), origins)


@styled
def draw_scara_3d(
    q=(np.radians(-25), np.radians(60), 0.2, np.radians(-55)), a2=0.4, a3=0.3, ax=None, *, frames=True, dimensions=True
):
    """Draw the SCARA as a body: column, two links, quill; joint axes, frames and the dimensions a2, a3, d2.

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
    a2, a3 = as_lengths([a2, a3], "a2 and a3", (2,))
    transforms = scara_frames(q, a2, a3)
    unit = a2 + a3
    base, elbow, hand = transforms[[1, 2, 4], :3, 3]
    wrist = hand * (1, 1, 0)
    own, ax = ax is None, ax or new_axes_3d(elev=24, azim=-66)
    corners = _draw_body(ax, base, elbow, wrist, hand, unit)
    if frames:
        size = 0.24 * unit
        add_frames(ax, transforms, "01234", size, letters="x")
        for origin in transforms[[0, 2, 4], :3, 3]:
            draw_arrow_3d(ax, origin, origin + (0, 0, size), AXIS_COLOURS["z"], AXIS_DASHES["z"])
    if dimensions:
        _draw_dimensions(ax, base, elbow, wrist, hand, unit)
    fit_3d(ax, [*corners, wrist + (0, 0, 0.55 * unit)], own)
    return ax


def _draw_body(ax, base, elbow, wrist, hand, unit):
    """Column, links, quill and joint axes; returns the corners of the floor."""
    floor, thick, quill_top = -0.55 * unit, 0.07 * unit, 0.42 * unit
    corners = np.column_stack([unit * np.array([[-0.3, -0.3], [1.0, -0.3], [1.0, 0.9], [-0.3, 0.9]]), [floor] * 4])
    ax.plot(*np.vstack([corners, corners[:1]]).T, color=FAINT, lw=0.8, zorder=0)
    draw_prism(ax, disc_outline(base[:2], 0.14 * unit), floor, floor + 0.04 * unit, 0.75, 0.5)
    draw_prism(ax, disc_outline(base[:2], 0.085 * unit), floor + 0.04 * unit, -thick, 0.85, 0.6)
    if hand[2] < 0:
        draw_prism(ax, disc_outline(wrist[:2], 0.022 * unit), hand[2], 0, 0.7, 0.9)
    draw_prism(ax, stadium_outline(base[:2], elbow[:2], 0.085 * unit), -thick, 0, 0.92, 1.0)
    draw_prism(ax, stadium_outline(elbow[:2], wrist[:2], 0.07 * unit), 0, thick, 0.82, 1.2)
    if quill_top + hand[2] > thick:
        draw_prism(ax, disc_outline(wrist[:2], 0.022 * unit), thick, quill_top + hand[2], 0.7, 1.3)
    for foot, top, name in ((base, 0.36, "Z_0, Z_1"), (elbow, 0.36, "Z_2"), (wrist, 0.46, "Z_3, Z_4")):
        low = floor if foot is base else min(hand[2], 0) - 0.12 * unit
        ends = foot + (0, 0, low), foot + (0, 0, top * unit)
        ax.plot(*zip(*ends), color=SOFT, lw=0.9, ls=CENTRE_LINE, zorder=2)
        write_3d(ax, ends[1] + (0, 0, 0.05 * unit), f"${name}$", color=AXIS_COLOURS["z"])
    return corners


def _draw_dimensions(ax, base, elbow, wrist, hand, unit):
    level = 0.17 * unit
    draw_dimension_3d(ax, base, elbow, (0, 0, level), "a_2")
    draw_dimension_3d(ax, elbow, wrist, (0, 0, level), "a_3")
    if abs(hand[2]) > 0.03 * unit:
        aside = 0.44 * unit * np.array([*unit_vector(np.radians(ax.azim + 100)), 0])
        for point in (wrist, hand):
            ax.plot(*zip(point, point + 1.1 * aside), color=SOFT, lw=0.7, zorder=4)
        draw_arrow_3d(ax, wrist + aside, hand + aside, width=1.2)
        write_3d(ax, (wrist + hand) / 2 + 1.14 * aside, "$d_2$")
