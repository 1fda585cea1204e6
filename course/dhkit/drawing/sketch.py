"""Symbols of kinematic sketches of SCARA robots, from the side and from above.

Lengths are in metres, angles in radians; `unit` is the size of the robot.
"""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Polygon, Rectangle

from ..geometry import rotation_2d, unit_vector
from .strokes import (
    draw_arrow,
    write,
)
from .style import AXIS_COLOURS, INK, SOFT


def draw_bar(ax, start, end):
    """A link as a thick line."""
    ax.plot(*zip(start, end), color=INK, lw=3.2, zorder=2, solid_capstyle="butt")


def draw_revolute(ax, at, unit):
    """Revolute joint across its axis: a sleeve."""
    width, height = 0.05 * unit, 0.085 * unit
    _draw_white_box(ax, at, width, height, zorder=3.5)


def draw_prismatic(ax, at, unit):
    """Prismatic joint across its axis: a square guide, the rod passing through."""
    side = 0.085 * unit
    _draw_white_box(ax, at, side, side, zorder=3.1)
    for x in (-side / 2, side / 2):
        ax.plot([at[0] + x * 0.55] * 2, [at[1] - side / 2, at[1] + side / 2], color=INK, lw=0.8, zorder=3.15)


def draw_jaws(ax, at, unit):
    """A gripper that points down."""
    w, h = 0.045 * unit, 0.05 * unit
    x, y = at[0], at[1] - 0.034 * unit
    ax.plot([x, x], [y, y - 0.02 * unit], color=INK, lw=3.2, zorder=2)
    y -= 0.02 * unit
    ax.plot([x - w, x - w, x + w, x + w], [y - h, y, y, y - h], color=INK, lw=1.8, zorder=3, solid_joinstyle="miter")


def _draw_white_box(ax, at, width, height, zorder):
    corner = at[0] - width / 2, at[1] - height / 2
    ax.add_patch(Rectangle(corner, width, height, facecolor="white", edgecolor=INK, lw=1.5, zorder=zorder))


def draw_quill_from_above(ax, at, heading, unit):
    """Quill from above: a square (prismatic) with a bar across, the hand."""
    side = 0.045 * unit
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * side
    ax.add_patch(Polygon(at + corners @ rotation_2d(heading).T, facecolor="white", edgecolor=INK, lw=1.4, zorder=5))
    across = 1.7 * side * unit_vector(heading + np.pi / 2)
    ax.plot(*zip(at - across, at + across), color=INK, lw=2.4, zorder=5.2)
    ax.plot(*at, "o", ms=3, color=INK, zorder=6)


def draw_counted_length(ax, x, start, rise, label, unit):
    """A vertical coordinate beside the line at `x`: an arrow from the level `start` the way in which it is counted.

    Parameters
    ----------
    x, start, rise, unit : float, in metres
        Place of the line, level to count from, value of the coordinate, size of the robot.
    label : text
    """
    if abs(rise) < 0.02 * unit:
        return
    right = x + 0.2 * unit
    for y in (start, start + rise):
        ax.plot([x + 0.05 * unit, right + 0.025 * unit], [y, y], color=SOFT, lw=0.7, zorder=1)
    draw_arrow(ax, (right, start), (right, start + rise), width=1.2)
    write(ax, (right + 0.02 * unit, start + rise / 2), label, ha="left")


def draw_frame_from_the_side(ax, origin, x_name, origin_name, unit):
    """The axes x (to the right) and z (up) of a sketched frame with the names of x and of the origin."""
    size, at = 0.125 * unit, np.array(origin)
    draw_arrow(ax, at, at + (size, 0), AXIS_COLOURS["x"])
    write(ax, at + (size, 0.045 * unit), f"${x_name}$", color=AXIS_COLOURS["x"])
    draw_arrow(ax, at, at + (0, size), AXIS_COLOURS["z"])
    write(ax, at + (-0.05 * unit, -0.065 * unit), f"${origin_name}$", ha="right")
