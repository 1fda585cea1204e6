"""The workspace of the elbow arm (3R): its section with a half-plane through axis 1, and that section turned."""

from __future__ import annotations

import itertools

import numpy as np
from matplotlib.patches import Polygon
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ..geometry import planar_joints, unit_vector
from .inputs import as_joint_limits, as_lengths, as_numbers
from .planar_2r import split_at_straight_elbow, trace_rim
from .strokes import draw_angle, draw_arm, draw_joint, draw_prolonged, new_axes, show_plane, write
from .strokes_3d import write_3d
from .style import AXIS_COLOURS, CENTRE_LINE, INK, LIMIT_DASHES, POSTURE_SHADES, SOFT, styled
from .view import fit_3d, new_axes_3d
from .workspace import draw_rim


@styled
def draw_section(lengths, limits, q=None, ax=None, *, names=True):
    """Draw section of the workspace of the elbow arm (3R) with a half-plane through axis 1: distance and height.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
        Upper arm and forearm.
    limits : array-like, shape (2, 2), in radians
        Rows (min, max) of t2 (elevation of the upper arm) and t3 (elbow).
    q : array-like, shape (2,), in radians, optional
        (t2, t3) of a posture to be drawn.
    names : bool
        Name the axis and the spheres.

    Returns
    -------
    matplotlib Axes
    """
    lengths, limits = as_lengths(lengths, "lengths", (2,)), as_joint_limits(limits)
    inner, outer = abs(lengths[0] - lengths[1]), lengths.sum()
    ax = ax or new_axes((4.9, 5.2))
    for piece in split_at_straight_elbow(limits):
        for part in _parts_in_front(lengths, piece):
            ax.add_patch(Polygon(part, closed=True, facecolor="#d6d6d6", edgecolor="none", zorder=1))
        draw_rim(ax, lengths, piece, limits)
    turn = np.linspace(-np.pi / 2, np.pi / 2, 200)
    for radius, name in ((outer, "stretched"), (inner, "folded")):
        if radius < 1e-9:
            continue
        ax.plot(*(radius * unit_vector(turn)).T, color=SOFT, lw=1, ls=LIMIT_DASHES, zorder=0.8)
        if names:
            write(
                ax,
                radius * unit_vector(-1.3) + (0.02 * outer, -0.05 * outer),
                name,
                fontsize=9,
                color="#555555",
                ha="left",
            )
    ax.plot([0, 0], [-1.08 * outer, 1.12 * outer], color=AXIS_COLOURS["z"], lw=1.4, ls=CENTRE_LINE, zorder=2)
    if names:
        write(ax, (0, 1.17 * outer), "axis 1", fontsize=10, color=AXIS_COLOURS["z"])
    if q is not None:
        q2, q3 = as_numbers(q, "q", (2,))
        points = planar_joints(lengths, (q2, q3))
        draw_arm(ax, points, POSTURE_SHADES[0], zorder=4, width=9)
        ax.plot(*points[-1], "o", ms=7, color=INK, zorder=6)
        ax.plot([0, 0.45 * lengths[0]], [0, 0], color=SOFT, lw=1, ls=CENTRE_LINE, zorder=3)
        draw_angle(ax, (0, 0), 0.36 * lengths[0], 0, q2, r"\theta_2", 1.35)
        draw_prolonged(ax, points[1], q2, 0.45 * lengths[1])
        draw_angle(ax, points[1], 0.36 * lengths[1], q2, q3, r"\theta_3", 1.4)
    show_plane(ax, labels=(r"distance $\rho$ from axis 1 (m)", "height $z$ (m)"))
    draw_joint(ax, (0, 0))
    ax.set_xlim(-0.12 * outer, 1.08 * outer)
    ax.set_ylim(-1.1 * outer, 1.24 * outer)
    return ax


def _parts_in_front(lengths, piece):
    """The outline of one sheet of the section; what falls behind axis 1 is turned round it to the front."""
    rim = trace_rim(lengths, piece)
    if (rim[:, 0] >= -1e-9).all():
        return [rim]
    front, back = rim.copy(), rim * (-1, 1)
    front[:, 0], back[:, 0] = np.maximum(front[:, 0], 0), np.maximum(back[:, 0], 0)
    return [front, back]


def _turn_about_axis_1(points, angle) -> np.ndarray:
    """Points (distance, height) of a section, shape (k, 2), in space at the angle t1: shape (k, 3)."""
    return np.column_stack([points[:, :1] * unit_vector(angle), points[:, 1]])


@styled
def draw_elbow_workspace(lengths, limits, t1_limits=(np.radians(-210), np.radians(60)), q=None, ax=None):
    """Draw the workspace of the elbow arm in space: its section turned about axis 1, cut open.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
        Upper arm and forearm.
    limits : array-like, shape (2, 2), in radians
        Rows (min, max) of t2 and t3; t3 without its straight angles inside, the arm in front of axis 1.
    t1_limits : (min, max), in radians
        Range of joint 1 that is drawn.
    q : array-like, shape (3,), in radians, optional
        (t1, t2, t3) of a posture to be drawn.

    Returns
    -------
    matplotlib Axes (3D)
    """
    lengths, limits = as_lengths(lengths, "lengths", (2,)), as_joint_limits(limits)
    low, high = as_numbers(t1_limits, "t1_limits", (2,))
    rim = trace_rim(lengths, limits, 0.09)
    own, ax = ax is None, ax or new_axes_3d(elev=28, azim=-62)
    turns = np.linspace(low, high, max(3, int((high - low) / 0.12)))

    strips = [_turn_about_axis_1(rim, angle) for angle in turns]
    walls = [
        [a[k], a[(k + 1) % len(rim)], b[(k + 1) % len(rim)], b[k]]
        for a, b in itertools.pairwise(strips)
        for k in range(len(rim))
    ]
    ax.add_collection3d(
        Poly3DCollection(walls, facecolors="#e4e4e4", edgecolors="#bcbcbc", linewidths=0.25, alpha=0.55, zorder=1),
        autolim=False,
    )
    for angle in (low, high):
        face = _turn_about_axis_1(rim, angle)
        ax.add_collection3d(
            Poly3DCollection([face], facecolors="#b5b5b5", edgecolors=INK, linewidths=1.3, alpha=0.8, zorder=1.5),
            autolim=False,
        )
    top = 1.15 * max(rim[:, 1].max(), 0.2 * lengths.sum())
    bottom = min(rim[:, 1].min(), -0.25 * lengths.sum())
    ax.plot([0, 0], [0, 0], [bottom, top], color=AXIS_COLOURS["z"], lw=1.3, ls=CENTRE_LINE, zorder=2)
    write_3d(ax, (0, 0, top + 0.06 * lengths.sum()), "axis 1", color=AXIS_COLOURS["z"], fontsize=10)
    if q is not None:
        t1, t2, t3 = as_numbers(q, "q", (3,))
        points = _turn_about_axis_1(planar_joints(lengths, (t2, t3)), t1)
        for pen, width in ((INK, 8), ("#f2f2f2", 5.5)):
            ax.plot(*points.T, color=pen, lw=width, solid_capstyle="round", solid_joinstyle="round", zorder=4)
        ax.plot(*points.T, "o", ms=4.5, color=INK, ls="none", zorder=5)
    fit_3d(ax, np.vstack([*strips, [(0, 0, bottom), (0, 0, top * 1.1)]]), own)
    return ax
