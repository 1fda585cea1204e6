"""Strokes in the plane: labels, arrows, arcs, dimensions, links and joints.

Points are in metres, angles in radians; sizes of pens, markers and text are in points of print.
"""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Arc, FancyArrowPatch

from ..geometry import unit_vector
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, HALO, INK, SOFT


def new_axes(figsize=(5.2, 4.2)):
    """Axes in a figure of their own; `figsize` in inches."""
    return plt.subplots(figsize=figsize)[1]


def show_plane(ax, grid=True, labels=("x (m)", "y (m)")):
    """Equal scale, grid and named axes: for a plane with coordinates."""
    ax.set_aspect("equal")
    ax.grid(grid)
    ax.set_xlabel(labels[0])
    ax.set_ylabel(labels[1])


def show_bare(ax):
    """Equal scale, no axes: for a sketch."""
    ax.set_aspect("equal")
    ax.axis("off")


def write(ax, at, text, **options):
    """A label centred at the point `at`."""
    options = {"ha": "center", "va": "center", "fontsize": 11, "zorder": 9} | options
    return ax.text(*at, text, path_effects=HALO, **options)


def draw_arrow(ax, start, end, colour=INK, width=1.6, style="-|>", dashes="-", zorder=6, neck=0.9):
    """Arrow whose shaft may be dashed while its head stays clean."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    ax.plot(
        *zip(start, start + neck * (end - start)),
        color=colour,
        lw=width,
        ls=dashes,
        zorder=zorder,
        solid_capstyle="butt",
    )
    head = FancyArrowPatch(
        start + 0.8 * (end - start), end, arrowstyle=style, mutation_scale=11, shrinkA=0, shrinkB=0,
        color=colour, lw=width, zorder=zorder,
    )  # fmt: skip
    head.set_linestyle("none" if dashes != "-" else "-")
    ax.add_patch(head)


def draw_axis_arrow(ax, origin, angle, size, letter, label, away=0.2, neck=0.9):
    """Axis `letter` (x, y or z) of a frame, in its colour and dashes; the label stands `away` lengths past its tip."""
    end = np.asarray(origin) + size * unit_vector(angle)
    draw_arrow(ax, origin, end, AXIS_COLOURS[letter], dashes=AXIS_DASHES[letter], neck=neck)
    if label:
        write(ax, end + away * size * unit_vector(angle), f"${label}$", color=AXIS_COLOURS[letter])


def draw_dimension(ax, start, end, label, shift, beside=False):
    """Dimension line from `start` to `end`, moved by `shift` to the left of that direction.

    The label interrupts the line, or stands outside it, ``beside=True``, where the line is short.
    """
    start, end = np.asarray(start, float), np.asarray(end, float)
    along = (end - start) / np.hypot(*(end - start))
    side = np.array([-along[1], along[0]]) * np.sign(shift)
    a, b = start + abs(shift) * side, end + abs(shift) * side
    for point, foot in ((a, start), (b, end)):
        ax.plot(*zip(foot + 0.15 * (point - foot), point + 0.12 * (point - foot)), color=SOFT, lw=0.7, zorder=2)
    ax.add_patch(
        FancyArrowPatch(a, b, arrowstyle="<|-|>", mutation_scale=8, shrinkA=0, shrinkB=0, color=INK, lw=0.9, zorder=3)
    )
    middle = (a + b) / 2
    if beside:
        write(ax, middle + 0.25 * abs(shift) * side, f"${label}$", ha="right" if side[0] < -0.5 else "center")
    else:
        box = {"facecolor": "white", "edgecolor": "none", "pad": 1.2}
        ax.text(*middle, f"${label}$", ha="center", va="center", fontsize=11, bbox=box, zorder=9)


def draw_angle(ax, centre, radius, start, sweep, label, away=1.28, colour=INK):
    """Arc with an arrow head from direction `start` over `sweep` radians, labelled at its middle."""
    centre = np.asarray(centre, float)
    if abs(sweep) > 1e-6:
        tip = min(0.25, abs(sweep) * 0.9) * np.sign(sweep)
        sides = np.degrees(sorted((start, start + sweep - 0.7 * tip)))
        ax.add_patch(
            Arc(centre, 2 * radius, 2 * radius, theta1=sides[0], theta2=sides[1], color=colour, lw=1.1, zorder=5)
        )
        end, before = centre + radius * unit_vector(start + sweep), centre + radius * unit_vector(start + sweep - tip)
        ax.add_patch(
            FancyArrowPatch(
                before, end, arrowstyle="-|>", mutation_scale=8, shrinkA=0, shrinkB=0, color=colour, lw=1, zorder=5
            )
        )
    if label:
        write(ax, centre + away * radius * unit_vector(start + sweep / 2), f"${label}$", color=colour)


def draw_prolonged(ax, start, angle, length):
    """A centre line from the point `start` in the direction `angle`: what a joint angle is counted from."""
    ax.plot(*zip(start, start + length * unit_vector(angle)), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=2)


def draw_link(ax, start, end, fill, width=13.0, zorder=3.0):
    """A link with round ends: an ink line under a lighter and thinner one."""
    xs, ys = zip(start, end)
    outline = ax.plot(xs, ys, color=INK, lw=width, solid_capstyle="round", zorder=zorder)[0]
    ax.plot(xs, ys, color=fill, lw=width - 2.4, solid_capstyle="round", zorder=zorder + 0.01)
    return outline


def draw_joint(ax, at, zorder=4.5, size=8.0):
    """Revolute joint seen along its axis: a circle with a dot, the axis pointing to the reader."""
    ax.plot(*at, "o", ms=size, mfc="white", mec=INK, mew=1.3, zorder=zorder)
    ax.plot(*at, "o", ms=size * 0.26, color=INK, zorder=zorder)


def draw_ground(ax, at, width, depth):
    """Hatched ground under the point `at`."""
    x, y = at
    ax.plot([x - width / 2, x + width / 2], [y, y], color=INK, lw=1.4, zorder=2)
    for foot in np.linspace(x - width / 2 + depth, x + width / 2, 7):
        ax.plot([foot, foot - depth], [y, y - depth], color=INK, lw=0.8, zorder=2)


def draw_target(ax, at):
    """A cross in a circle."""
    ax.plot(*at, marker="o", ms=15, mfc="none", mec=INK, mew=1.3, zorder=7)
    ax.plot(*at, marker="+", ms=21, color=INK, mew=1.3, zorder=7)


def draw_arm(ax, points, fill, zorder=3.0, width=13.0):
    """Links and joints through `points`, base first; returns the outline of the first link, for a legend."""
    outline = None
    for start, end in zip(points[-2::-1], points[:0:-1]):
        outline = draw_link(ax, start, end, fill, width, zorder)
    for point in points[:-1]:
        draw_joint(ax, point, zorder + 0.5)
    return outline


def leave_room(ax, room):
    """Widen the view by `room` on each side, so that labels lie inside the grid."""
    ax.autoscale_view()
    for limits, setter in ((ax.dataLim.intervalx, ax.set_xlim), (ax.dataLim.intervaly, ax.set_ylim)):
        setter(limits[0] - room, limits[1] + room)


def keep_in_view(ax, at, room):
    """Widen the view, if need be, to hold the square of half side `room` around `at`."""
    for limits, setter, c in ((ax.get_xlim(), ax.set_xlim, at[0]), (ax.get_ylim(), ax.set_ylim, at[1])):
        setter(min(limits[0], c - room), max(limits[1], c + room))
