"""Drawings of the planar arms that are told as walks."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Polygon

from ..geometry import unit_vector
from ..planar_arms import JOINTS, describe, places, walk_of
from .planar import mark_frame_2d, mark_target
from .strokes import (
    draw_angle,
    draw_axis_arrow,
    draw_joint,
    draw_link,
    draw_prolonged,
    leave_room,
    new_axes,
    show_plane,
    write,
)
from .style import INK, POSTURE_SHADES, styled


@styled
def draw_walked_arm(arm, values, ax=None, *, letters=True, fill=POSTURE_SHADES[0], words=True):
    """Draw a planar arm with the letters of its joints and lengths.

    Parameters
    ----------
    arm : str
        A name of `dhkit.planar_arms.ARMS` or ``SLIDING``.
    values : dict
        Numbers for its letters, in metres and radians.
    letters : bool
        Write the letters, and draw the frames 0 and E.
    words : bool
        Tell the walk beside the picture.

    Returns
    -------
    matplotlib Axes
    """
    ax = ax or new_axes((5.6, 4.4))
    show_plane(ax)
    at, heading = places(arm, values)
    total = np.linalg.norm(np.diff(at, axis=0), axis=1).sum()
    for i, (do, letter) in enumerate(walk_of(arm)):
        start, end = at[i], at[i + 1]
        if do == "turn":
            draw_joint(ax, start)
            if letters:
                _turning(ax, start, heading[i], values[letter], letter, total)
            continue
        if letter in JOINTS:
            _draw_slide(ax, start, end, fill, total)
        else:
            draw_link(ax, start, end, fill)
        if letters:
            along = end - start
            side = np.array([-along[1], along[0]]) / (np.hypot(*along) or 1)
            write(ax, (start + end) / 2 + 0.075 * total * side, f"${_in_latex(letter)}$")
    if letters:
        for axis, angle in (("x", 0), ("y", np.pi / 2)):
            draw_axis_arrow(ax, (0, 0), angle, 0.2 * total, axis, f"{axis}_0", away=0.22)
        frame = np.eye(4)
        frame[:2, 0], frame[:2, 1], frame[:2, 3] = (
            unit_vector(heading[-1]),
            unit_vector(heading[-1] + np.pi / 2),
            at[-1],
        )
        mark_frame_2d(ax, frame, "E", 0.2 * total)
    if words:
        ax.text(1.04, 1.0, describe(arm), transform=ax.transAxes, va="top", fontsize=10, linespacing=1.6)
    leave_room(ax, 0.14 * total)
    return ax


def _turning(ax, at, start, sweep, letter, total):
    draw_prolonged(ax, at, start, 0.2 * total)
    draw_angle(ax, at, 0.13 * total, start, sweep, _in_latex(letter), 1.45)


def _in_latex(letter):
    return f"{letter[0]}_{letter[1]}" if letter in JOINTS else letter


def _draw_slide(ax, start, end, fill, total):
    """A rod that runs out of a sleeve."""
    along = end - start
    unit = along / (np.hypot(*along) or 1)
    side = np.array([-unit[1], unit[0]])
    ax.plot(*zip(start, end), color=INK, lw=4, zorder=3, solid_capstyle="butt")
    ax.plot(*zip(start, end), color=fill, lw=2, zorder=3.1, solid_capstyle="butt")
    half, wide = 0.06 * total, 0.03 * total
    corners = [
        start - half * unit - wide * side,
        start + half * unit - wide * side,
        start + half * unit + wide * side,
        start - half * unit + wide * side,
    ]
    ax.add_patch(Polygon(corners, closed=True, facecolor=fill, edgecolor=INK, lw=1.4, zorder=4))


@styled
def draw_walked_postures(arm, lengths, solutions, target):
    """Draw all joint solutions (k, 3) of a planar arm, and the pose (x, y, heading) that they should reach.

    Returns
    -------
    matplotlib Axes
    """
    ax = new_axes()
    for k, row in enumerate(solutions):
        values = dict(lengths) | dict(zip(JOINTS, row))
        draw_walked_arm(arm, values, ax, letters=False, words=False, fill=POSTURE_SHADES[k % len(POSTURE_SHADES)])
    show_plane(ax)
    x, y, phi = target
    mark_target(ax, (x, y), "target")
    frame = np.eye(4)
    frame[:2, 0], frame[:2, 1], frame[:2, 3] = unit_vector(phi), unit_vector(phi + np.pi / 2), (x, y)
    mark_frame_2d(ax, frame, "E", 0.15)
    ax.update_datalim([(0, 0)])
    leave_room(ax, 0.12)
    return ax
