"""Drawings of the Adept s600, a SCARA whose fourth axis points down, in the letters of Khalil and Kleinfinger."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Circle, Polygon

from ..geometry import planar_joints, unit_vector
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
    draw_arrow,
    draw_axis_arrow,
    draw_dimension,
    draw_ground,
    draw_prolonged,
    new_axes,
    show_bare,
    write,
)
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, INK, POSTURE_SHADES, SOFT, styled

LENGTHS = (0.325, 0.275)


@styled
def draw_s600_side(d2=LENGTHS[0], d3=LENGTHS[1], r3=-0.1, r30=-0.08, ax=None, *, frames=True):
    """Draw kinematic sketch from the side, at t1 = t2 = t4 = 0: axes, frames 0 to 4, d2, d3, r3 and r30.

    Parameters
    ----------
    d2, d3 : float, in metres
        Distance of axes 1 and 2, and of axes 2 and 3.
    r3, r30 : float, in metres, positive upwards
        Joint variable of the quill, and the height of O_3 at r3 = 0 above the arm.
    frames : bool
        Draw the axes x and z of the frames.

    Returns
    -------
    matplotlib Axes
    """
    d2, d3 = as_lengths([d2, d3], "d2 and d3", (2,))
    r3, r30 = as_numbers([r3, r30], "r3 and r30", (2,))
    ax = ax or new_axes((6.8, 4.8))
    show_bare(ax)
    unit, reach = (d2 + d3) / 0.7, d2 + d3
    height = r3 + r30
    floor, top, low = -0.36 * unit, 0.3 * unit, min(-0.44 * unit, height - 0.24 * unit)
    for x, name in ((0, "z_0, z_1"), (d2, "z_2"), (reach, "z_3")):
        bottom = floor if x == 0 else min(height, 0) - 0.13 * unit
        ax.plot([x, x], [bottom, top - 0.04 * unit], color=SOFT, lw=1, ls=CENTRE_LINE, zorder=1)
        write(ax, (x, top), f"${name}$", color=AXIS_COLOURS["z"])
    draw_ground(ax, (0, floor), 0.24 * unit, 0.035 * unit)
    for start, end in (((0, floor), (0, 0)), ((0, 0), (d2, 0)), ((d2, 0), (reach, 0))):
        draw_bar(ax, start, end)
    hand = (reach, height)
    ax.plot([reach] * 2, [0.1 * unit, height], color=INK, lw=4, zorder=3.2, solid_capstyle="butt")
    draw_revolute(ax, (0, 0), unit)
    draw_revolute(ax, (d2, 0), unit)
    draw_prismatic(ax, (reach, 0), unit)
    draw_revolute(ax, hand, 0.8 * unit)
    draw_jaws(ax, hand, unit)
    if frames:
        for origin, x_name, origin_name in (
            ((0, 0), "x_0, x_1", "O_0, O_1"), ((d2, 0), "x_2", "O_2"), (hand, "x_3, x_4", "O_3, O_4")
        ):  # fmt: skip
            draw_frame_from_the_side(ax, origin, x_name, origin_name, unit)
        down = np.array(hand) - (0, 0.22 * unit)
        draw_arrow(ax, hand, down, AXIS_COLOURS["z"], dashes=AXIS_DASHES["z"])
        write(ax, down + (0, -0.04 * unit), "$z_4$", color=AXIS_COLOURS["z"])
    draw_dimension(ax, (0, 0), (d2, 0), "d_2", 0.2 * unit)
    draw_dimension(ax, (d2, 0), (reach, 0), "d_3", 0.2 * unit)
    for start, rise, name in ((0, r30, "r_{30}"), (r30, r3, "r_3")):
        draw_counted_length(ax, reach, start, rise, f"${name} {'<' if rise < 0 else '>'} 0$", unit)
    ax.set_xlim(-0.22 * unit, reach + 0.34 * unit)
    ax.set_ylim(low - 0.06 * unit, top + 0.06 * unit)
    return ax


@styled
def draw_s600_top(
    q=(np.radians(30), np.radians(50), np.radians(40)), d2=LENGTHS[0], d3=LENGTHS[1], ax=None, *, down=True
):
    """Draw the arm from above, with the angles t1, t2, t4 and the heading omega of x_4.

    Parameters
    ----------
    q : array-like, shape (3,), in radians
        t1, t2, t4.
    d2, d3 : float, in metres
    down : bool
        z_4 points down, as on the s600: seen from above, positive t4 turns clockwise. False: z_4 points up.

    Returns
    -------
    matplotlib Axes
    """
    t1, t2, t4 = as_numbers(q, "t1, t2, t4", (3,))
    lengths = as_lengths([d2, d3], "d2 and d3", (2,))
    points = planar_joints(lengths, (t1, t2))
    unit = lengths.sum()
    turn = -t4 if down else t4
    omega = t1 + t2 + turn
    ax = ax or new_axes((6.2, 5.4))
    show_bare(ax)
    draw_arm(ax, points, POSTURE_SHADES[0], width=15)
    hand = points[2]
    draw_quill_from_above(ax, hand, omega, unit)
    size = 0.24 * unit
    arcs = (
        (points[0], 0.0, t1, r"\theta_1", 0.62, 1.38),
        (points[1], t1, t2, r"\theta_2", 0.62, 1.38),
        (hand, t1 + t2, turn, r"\theta_4", 0.72, 1.3),
        (hand, 0.0, omega, r"\omega", 1.12, 1.2),
    )
    for centre, start, sweep, name, radius, away in arcs:
        draw_prolonged(ax, centre, start, 1.25 * size)
        draw_angle(ax, centre, radius * size, start, sweep, name, away)
    draw_axis_arrow(ax, (0, 0), 0, 1.5 * size, "x", "x_0")
    draw_axis_arrow(ax, (0, 0), np.pi / 2, 1.2 * size, "y", "y_0")
    draw_axis_arrow(ax, hand, t1 + t2, 1.35 * size, "x", "x_3", neck=0.93)
    draw_axis_arrow(ax, hand, omega, 1.35 * size, "x", "x_4", neck=0.93)
    _seen_along_z(ax, (-0.14 * unit, -0.1 * unit), "z_0", unit, towards=True)
    _seen_along_z(ax, hand + unit * np.array([0.06, -0.16]), "z_4", unit, towards=not down)
    draw_dimension(ax, points[0], points[1], "d_2", 0.13 * unit)
    draw_dimension(ax, points[1], points[2], "d_3", 0.13 * unit)
    ax.margins(0.08)
    return ax


def _seen_along_z(ax, at, name, unit, *, towards):
    """The sign of an axis seen along its own line: a dot for the tip of the arrow, a cross for its feathers."""
    radius, colour = 0.025 * unit, AXIS_COLOURS["z"]
    ax.add_patch(Circle(at, radius, facecolor="white", edgecolor=colour, lw=1.4, zorder=6))
    if towards:
        ax.add_patch(Circle(at, 0.3 * radius, color=colour, zorder=7))
    else:
        for s in (1, -1):
            ends = np.array(at) + 0.7 * radius * np.array([[-1, -s], [1, s]])
            ax.plot(*ends.T, color=colour, lw=1.4, zorder=7)
    write(ax, np.array(at) + (2.6 * radius, 0), f"${name}$", color=colour)


@styled
def draw_type8(
    q=(np.radians(30), np.radians(50)),
    lengths=LENGTHS,
    ax=None,
    *,
    names=("d_2", "d_3", r"\theta_1", r"\theta_2", "x", "y"),
):
    """Draw B_1 and B_2: the hand seen from the first link, ahead of its axis and to the left of it.

    Parameters
    ----------
    q : array-like, shape (2,), in radians
        t1 and t2.
    lengths : array-like, shape (2,), in metres
    names : six texts
        Names of the lengths, the angles and the coordinates of the hand, in mathematical notation.

    Returns
    -------
    matplotlib Axes
    """
    t1, t2 = as_numbers(q, "t1 and t2", (2,))
    lengths = as_lengths(lengths, "lengths", (2,))
    points = planar_joints(lengths, (t1, t2))
    ahead, left = unit_vector(t1), unit_vector(t1 + np.pi / 2)
    b1 = lengths[0] + lengths[1] * np.cos(t2)
    unit = lengths.sum()
    ax = ax or new_axes((6.0, 4.8))
    show_bare(ax)
    foot = b1 * ahead
    ax.add_patch(Polygon([(0, 0), foot, points[2]], facecolor="#f0f0f0", edgecolor="none", zorder=0))
    draw_arm(ax, points, POSTURE_SHADES[0])
    ax.plot(*points[2], "o", ms=7, color=INK, zorder=6)
    beyond = max(b1, lengths[0]) * ahead + 0.12 * unit * ahead
    ax.plot(*zip((0, 0), beyond), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=1.5)
    ax.plot(*zip(foot, points[2]), color=INK, lw=1.2, ls=(0, (4, 2)), zorder=2)
    ax.plot(*zip((0, 0), points[2]), color=INK, lw=1.2, ls=(0, (1, 1.5)), zorder=2)
    draw_axis_arrow(ax, (0, 0), 0, 0.32 * unit, "x", "x_0")
    draw_axis_arrow(ax, (0, 0), np.pi / 2, 0.3 * unit, "y", "y_0")
    draw_dimension(ax, (0, 0), foot, f"B_1 = {names[0]} + {names[1]}\\cos {names[3]}", -0.3 * unit)
    write(ax, (foot + points[2]) / 2 + 0.19 * unit * ahead, f"$B_2 = {names[1]}\\sin {names[3]}$")
    draw_angle(ax, (0, 0), 0.2 * unit, 0, t1, names[2], 1.3)
    draw_angle(ax, points[1], 0.14 * unit, t1, t2, names[3], 1.4)
    write(ax, points[1] / 2 + 0.07 * unit * left, f"${names[0]}$")
    write(ax, (points[1] + points[2]) / 2 + 0.08 * unit * unit_vector(t1 + t2 + np.pi / 2), f"${names[1]}$")
    write(ax, points[2] + (0, 0.07 * unit), f"$({names[4]}, {names[5]})$")
    ax.margins(0.08)
    return ax
