"""Drawings of what a printed table says: one table read in two conventions, joint origins of a description file."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle

from ..geometry import planar_joints, unit_vector
from .inputs import as_lengths, as_numbers
from .strokes import (
    draw_angle,
    draw_arm,
    draw_arrow,
    draw_axis_arrow,
    draw_joint,
    keep_in_view,
    new_axes,
    show_bare,
    show_plane,
    write,
)
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, DASHED, FAINT, INK, POSTURE_SHADES, SOFT, styled


@styled
def draw_two_readings(lengths=(0.5, 0.4), q=(np.radians(40), np.radians(55))):
    """Draw the planar table (L1, 0, 0, t1), (L2, 0, 0, t2) read as classic and as modified, side by side.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    q : array-like, shape (2,), in radians

    Returns
    -------
    list of 2 matplotlib Axes
    """
    l1, l2 = as_lengths(lengths, "lengths", (2,))
    t1, t2 = as_numbers(q, "t1 and t2", (2,))
    unit = l1 + l2
    figure, panels = plt.subplots(1, 2, figsize=(9.0, 4.4), sharey=True)
    for ax, title in zip(panels, ("read as classic: $a_i$", "read as modified: $a_{i-1}$")):
        show_bare(ax)
        ax.set_title(title)
        draw_axis_arrow(ax, (0, 0), 0, 0.26 * unit, "x", "")
        write(ax, (0.24 * unit, -0.055 * unit), "$x_0$", color=AXIS_COLOURS["x"])
        draw_axis_arrow(ax, (0, 0), np.pi / 2, 0.26 * unit, "y", "y_0", away=0.2)
    classic, modified = panels
    points = planar_joints((l1, l2), (t1, t2))
    draw_arm(classic, points, POSTURE_SHADES[0])
    _angle(classic, points[0], 0, t1, r"\theta_1", unit)
    _angle(classic, points[1], t1, t2, r"\theta_2", unit)
    _length(classic, points[0], points[1], "$L_1$", unit)
    _length(classic, points[1], points[2], "$L_2$", unit)
    classic.plot(*points[2], "o", ms=7, color=INK, zorder=8)
    write(classic, points[2] + 0.1 * unit * unit_vector(t1 + t2), "$O_2$")

    first = np.array([l1, 0])
    second = first + l2 * unit_vector(t1)
    modified.plot(*zip((0, 0), first), color=SOFT, lw=1.4, ls=(0, (4, 3)), zorder=2)
    write(modified, first / 2 - (0, 0.115 * unit), "$L_1$: part of the base")
    draw_arm(modified, np.array([first, second]), POSTURE_SHADES[0])
    draw_joint(modified, second)
    _angle(modified, first, 0, t1, r"\theta_1", unit)
    _angle(modified, second, t1, t2, r"\theta_2", unit)
    _length(modified, first, second, "$L_2$", unit)
    draw_axis_arrow(modified, second, t1 + t2, 0.24 * unit, "x", "x_2", away=0.2)
    write(modified, second + 0.11 * unit * unit_vector(t1 - 2.2), "$O_2$")
    ends = [*points, second, second + 0.3 * unit * unit_vector(t1 + t2), (0, 0.3 * unit)]
    low, high = np.min(ends, axis=0) - 0.14 * unit, np.max(ends, axis=0) + 0.14 * unit
    for ax in panels:
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    figure.subplots_adjust(wspace=0.02, left=0.01, right=0.99, top=0.92, bottom=0.01)
    return list(panels)


def _angle(ax, centre, start, sweep, name, unit):
    line = np.array([centre, np.asarray(centre) + 0.3 * unit * unit_vector(start)])
    ax.plot(*line.T, color=SOFT, lw=0.9, ls=DASHED, zorder=2)
    draw_angle(ax, centre, 0.17 * unit, start, sweep, name if abs(sweep) > 0.1 else "", 1.42)


def _length(ax, start, end, name, unit):
    heading = np.arctan2(*(end - start)[::-1])
    write(ax, (start + end) / 2 + 0.085 * unit * unit_vector(heading + np.pi / 2), name)


@styled
def draw_joint_origins(origins, axes, ax=None, *, names=None, frames=None, size=0.28):
    """Draw a robot at zero from the side, x to the right and z up: joint origins, joint axes, and DHm frames if given.

    Axes along y go into the page and are drawn as a circle with a cross.

    Parameters
    ----------
    origins : array-like, shape (n, 2) or (n, 3), in metres
        Origin of each joint (and of the hand) in the base frame; y is left out.
    axes : sequence of n texts
        Direction of each joint axis, "x", "y" or "z"; "" where no joint is.
    names : sequence of n texts, optional
        By default 1, 2, 3, ... Joint names give way to `frames`.
    frames : array-like, shape (m, 4, 4), optional
        Frames to draw over it, named 0 to m - 1. Frames in one place share a label.
    size : float, in metres
        Length of the frames' axes.

    Returns
    -------
    matplotlib Axes
    """
    points = as_numbers(origins, "origins", (len(origins), np.shape(origins)[-1]))
    points = points[:, [0, -1]]
    axes = list(axes)
    if len(axes) != len(points) or not set(axes) <= {"x", "y", "z", ""}:
        raise ValueError(f"axes: expected {len(points)} of x, y, z, found {axes}")
    names = [str(k + 1) for k in range(len(points))] if names is None else list(names)
    ax = ax or new_axes((8.4, 6.2))
    show_plane(ax, labels=("x (m)", "z (m)"))
    chain = np.vstack([(0, 0), points])
    ax.plot(*chain.T, color=INK, lw=8, solid_capstyle="round", solid_joinstyle="round", zorder=1.4)
    ax.plot(*chain.T, color=FAINT, lw=6, solid_capstyle="round", solid_joinstyle="round", zorder=1.5)
    reach = 0.9 * size
    for point, axis, name in zip(points, axes, names):
        if axis in ("x", "z"):
            along = np.array([1, 0]) if axis == "x" else np.array([0, 1])
            line = np.array([point - 1.1 * reach * along, point + 2.1 * reach * along])
            ax.plot(*line.T, color=INK, lw=1, ls=CENTRE_LINE, zorder=1.7)
        if axis:
            ax.plot(*point, "o", ms=11, mfc="white", mec=INK, mew=1.3, zorder=4)
        if axis == "y":
            ax.plot(*point, "x", ms=6, mew=1.5, color=INK, zorder=4.1)
        if not axis:
            ax.plot(*point, "D", ms=6, color=INK, zorder=4)
        aside = (-0.32, -0.42) if axis else (0.25, -0.42)
        if frames is None or not axis:
            write(ax, point + size * np.array(aside), name, fontsize=10, ha="center" if axis else "left")
    leave = 0.75 * size
    keep_in_view(ax, chain.min(axis=0), leave)
    keep_in_view(ax, chain.max(axis=0), leave + 1.0 * size)
    if frames is not None:
        _frames_from_the_side(ax, as_numbers(frames, "frames", (None, 4, 4)), size)
    return ax


def _frames_from_the_side(ax, frames, size):
    """The axes X and Z of each frame seen along y; an axis that points at the reader is a circle with a dot."""
    places: dict[tuple, list] = {}
    for k, frame in enumerate(frames):
        places.setdefault(tuple(np.round(frame[[0, 2], 3], 6)), []).append(k)
    for place, indices in places.items():
        at, drawn = np.array(place), {}
        for k in indices:
            for letter, column in (("x", 0), ("z", 2)):
                drawn.setdefault((letter, *np.round(frames[k][:3, column], 6) + 0.0), []).append(k)
        for (letter, *direction), owners in drawn.items():
            flat = np.array([direction[0], direction[2]])
            label = ", ".join(f"{letter.upper()}_{k}" for k in owners)
            colour = AXIS_COLOURS[letter]
            if np.hypot(*flat) > 0.5:
                draw_arrow(ax, at, at + size * flat, colour, dashes=AXIS_DASHES[letter], width=2, zorder=8)
                upright, one = abs(flat[1]) > 0.5, len(owners) == 1
                aside = np.array([0.3 if letter == "x" else -0.3, 0]) if upright and one else np.array([0, 0.24])
                write(ax, at + size * (flat * (1.0 if one else 1.08) + aside), f"${label}$", color=colour)
            else:
                toward = direction[1] < 0
                ax.add_patch(Circle(at, 0.13 * size, fc="white", ec=colour, lw=1.8, zorder=9))
                ax.plot(*at, "o" if toward else "x", ms=3.5 if toward else 6, color=colour, mew=1.6, zorder=9.1)
                write(ax, at + (0.3 * size, -0.3 * size), f"${label}$", color=colour)
