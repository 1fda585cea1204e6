"""Drawings of planar arms: links, postures, reach, and marks on them."""

from __future__ import annotations

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Circle, Rectangle

from ..geometry import phasor, planar_joints, unit_vector
from .inputs import as_lengths, as_numbers, as_rows
from .strokes import (
    draw_angle,
    draw_arm,
    draw_arrow,
    draw_axis_arrow,
    draw_joint,
    draw_prolonged,
    draw_target,
    keep_in_view,
    leave_room,
    new_axes,
    show_plane,
    write,
)
from .style import AXIS_COLOURS, CENTRE_LINE, HALO, INK, POSTURE_SHADES, SOFT, in_degrees, styled


@styled
def draw_planar_arm(lengths, q, ax=None, *, length_names=None, angle_names=None, hand="P", projections=False):
    """Draw a planar arm of n revolute joints with its joint angles and link lengths.

    Each angle is drawn from the prolonged link before it, which is how the model counts it.

    Parameters
    ----------
    lengths : array-like, shape (n,), in metres
    q : array-like, shape (n,), in radians
    length_names, angle_names : sequences of n texts in LaTeX, optional
        By default L_1, L_2, ... and theta_1, theta_2, ...
    hand : str
        Name of the end point; empty for none.
    projections : bool
        Also drop the hand on both axes, marked x and y.

    Returns
    -------
    matplotlib Axes
    """
    lengths = as_lengths(lengths, "lengths", (None,))
    q = as_numbers(q, "joint angles", (len(lengths),))
    points = planar_joints(lengths, q)
    n = len(q)
    length_names = length_names or [f"L_{i + 1}" for i in range(n)]
    angle_names = angle_names or [rf"\theta_{i + 1}" for i in range(n)]
    ax = ax or new_axes()
    show_plane(ax)
    total, heading = lengths.sum(), np.concatenate([[0], np.cumsum(q)])
    draw_arm(ax, points, POSTURE_SHADES[0])
    for i in range(n):
        reach = 0.42 * lengths[i]
        start = points[i]
        if i:
            draw_prolonged(ax, start, heading[i], 1.25 * reach)
        away = 1 + 0.1 * total / reach
        draw_angle(ax, start, reach * 0.8, heading[i], q[i], angle_names[i], away)
        side = np.sign(q[i] or 1) * unit_vector(heading[i + 1] + np.pi / 2)
        write(ax, (points[i] + points[i + 1]) / 2 + 0.075 * total * side, f"${length_names[i]}$")
    ax.plot(*points[-1], "o", ms=7, color=INK, zorder=6)
    if hand:
        write(ax, points[-1] + 0.08 * total * unit_vector(heading[-1]), f"${hand}$")
    if projections:
        x, y = points[-1]
        ax.plot([x, x, 0], [0, y, y], color=SOFT, lw=1, ls=(0, (2, 2)), zorder=1.5)
        write(ax, (x + 0.045 * total, 0.045 * total * np.sign(y or 1)), "$x$")
        write(ax, (0.045 * total * np.sign(x or 1), y + 0.045 * total), "$y$")
    _plane_axes(ax, total)
    leave_room(ax, 0.16 * total)
    return ax


def _plane_axes(ax, total):
    """The axes x0, y0 of the base."""
    for letter, angle in (("x", 0), ("y", np.pi / 2)):
        draw_axis_arrow(ax, (0, 0), angle, 0.24 * total, letter, f"{letter}_0", away=0.22)


@styled
def draw_postures(lengths, solutions, target=None, ax=None, *, symmetry=False):
    """Draw all postures of a planar 2R arm that reach one point, shaded differently and numbered at the elbow.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    solutions : array-like, shape (k, 2), in radians
        Rows (t1, t2); an empty list draws the target only.
    target : array-like, shape (2,), in metres, optional
    symmetry : bool
        Also draw the line from the base to the target, about which the postures are mirror images.

    Returns
    -------
    matplotlib Axes
        With one legend entry per posture.
    """
    lengths = as_lengths(lengths, "lengths", (2,))
    solutions = as_rows(solutions, "solutions", 2)
    goal = None if target is None else as_numbers(target, "target", (2,))
    ax = ax or new_axes()
    show_plane(ax)
    total = lengths.sum()
    shaded = []
    for k, (t1, t2) in enumerate(solutions):
        alike = [j + 1 for j, q in enumerate(solutions) if np.abs(phasor(q) - phasor((t1, t2))).max() < 1e-6]
        points = planar_joints(lengths, (t1, t2))
        fill = POSTURE_SHADES[k % len(POSTURE_SHADES)]
        outline = draw_arm(ax, points, fill, zorder=3 + k)
        outline.set_label(f"{k + 1}:  $t_1$ = {in_degrees(t1)},  $t_2$ = {in_degrees(t2)}")
        shaded.append((outline, fill))
        out = points[1] - 0.5 * points[2]
        out = out / (np.hypot(*out) or 1)
        if alike[0] == k + 1:
            write(ax, points[1] + 0.11 * total * out, ", ".join(map(str, alike)), fontweight="bold")
    if symmetry and goal is not None:
        ax.plot(*zip((0, 0), 1.12 * goal), color=SOFT, lw=1.1, ls=CENTRE_LINE, zorder=2)
    if goal is not None:
        draw_target(ax, goal)
    ax.update_datalim([(0, 0)])
    leave_room(ax, 0.16 * total)
    if shaded:
        _posture_legend(ax, shaded)
    return ax


def _posture_legend(ax, shaded):
    """Legend with a shaded box per posture (the link's outline alone would show as a black line)."""
    boxes = [Rectangle((0, 0), 1, 1, facecolor=fill, edgecolor=INK) for _, fill in shaded]
    _legend_below(ax, boxes, [outline.get_label() for outline, _ in shaded])


def _legend_below(ax, handles, labels, columns=2):
    ax.legend(
        handles,
        labels,
        loc="upper center",
        bbox_to_anchor=(0.5, -0.16),
        ncols=columns,
        handlelength=1.4,
        columnspacing=1.6,
    )


@styled
def draw_workspace_2r(lengths, limits=None, ax=None, *, names=("L_1", "L_2")):
    """Draw the workspace of a planar 2R arm: the ring between the inner and the outer limit.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians, optional
        Rows (min, max) of t1 and t2; the part of the ring that they leave is darker.
    names : two texts, or () for none
        Names of the lengths, with which the two radii are drawn and named.

    Returns
    -------
    matplotlib Axes
    """
    lengths = as_lengths(lengths, "lengths", (2,))
    limits = None if limits is None else as_numbers(limits, "limits", (2, 2))
    inner, outer = abs(lengths[0] - lengths[1]), lengths.sum()
    ax = ax or new_axes((4.8, 4.8))
    show_plane(ax)
    ax.add_patch(Circle((0, 0), outer, facecolor="#eeeeee", edgecolor=INK, lw=1.6, zorder=1))
    if inner > 1e-9:
        ax.add_patch(Circle((0, 0), inner, facecolor="white", edgecolor=INK, lw=1.6, ls=(0, (5, 2)), zorder=1.6))
    if limits is not None:
        ax.add_collection(_swept_area(lengths, limits))
        ax.add_patch(Circle((0, 0), outer, fill=False, edgecolor=INK, lw=1.6, zorder=1.5))
    if names:
        first, second = names
        _radius(ax, outer, np.radians(28), rf"r_\mathrm{{max}} = {first} + {second}")
        if inner > 1e-9:
            _radius(ax, inner, np.radians(-62), rf"r_\mathrm{{min}} = |{first} - {second}|", beyond=0.15 * outer)
    draw_joint(ax, (0, 0))
    ax.set_xlim(-1.12 * outer, 1.12 * outer)
    ax.set_ylim(-1.12 * outer, 1.12 * outer)
    return ax


def _swept_area(lengths, limits, cells=60) -> PolyCollection:
    """The image of the rectangle of allowed joint angles, as small patches."""
    t1, t2 = (np.linspace(*row, cells) for row in limits)
    corners = planar_joints(lengths, np.stack(np.meshgrid(t1, t2, indexing="ij"), axis=-1))[..., -1, :]
    patches = np.stack([corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:], corners[:-1, 1:]], axis=2)
    return PolyCollection(patches.reshape(-1, 4, 2), facecolor="#bdbdbd", edgecolor="#bdbdbd", lw=0.4, zorder=1.4)


def _radius(ax, radius, angle, label, beyond=0.0):
    end = radius * unit_vector(angle)
    draw_arrow(ax, (0, 0), end, width=1.1, zorder=4)
    turn = (np.degrees(angle) + 90) % 180 - 90
    if beyond:
        write(ax, end + beyond * unit_vector(angle), f"${label}$", fontsize=10, ha="left")
    else:
        side = unit_vector(angle + np.pi / 2)
        write(ax, end / 2 + 0.07 * radius * side, f"${label}$", fontsize=10, rotation=turn, rotation_mode="anchor")


@styled
def draw_triangle_2r(lengths, q, ax=None):
    """Draw the triangle behind "find q1": direction of the target, and the angle from link 1 to it.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    q : array-like, shape (2,), in radians
        t1 and t2, t2 not zero.

    Returns
    -------
    matplotlib Axes
    """
    lengths = as_lengths(lengths, "lengths", (2,))
    q = as_numbers(q, "joint angles", (2,))
    points = planar_joints(lengths, q)
    elbow, hand = points[1], points[2]
    along, total = unit_vector(q[0]), lengths.sum()
    foot = along * (hand @ along)
    ax = ax or new_axes((5.4, 4.4))
    show_plane(ax)
    draw_arm(ax, points, POSTURE_SHADES[0], width=11)
    ax.plot(*zip((0, 0), hand), color=INK, lw=1.2, ls=CENTRE_LINE, zorder=5)
    ax.plot(*zip(elbow, foot), color=INK, lw=1.1, ls=(0, (4, 2)), zorder=2)
    ax.plot(*zip(hand, foot), color=INK, lw=1.1, ls=(0, (4, 2)), zorder=2)
    corner = 0.035 * total
    across = (hand - foot) / np.hypot(*(hand - foot))
    inward = -along
    ax.plot(
        *zip(foot + corner * inward, foot + corner * (inward + across), foot + corner * across),
        color=INK,
        lw=0.9,
        zorder=2,
    )
    direction = np.arctan2(hand[1], hand[0])
    draw_angle(ax, (0, 0), 0.62 * lengths[0], 0, direction, "")
    write(ax, 0.68 * lengths[0] * unit_vector(0.17), r"$\mathrm{atan2}(y, x)$", ha="left")
    draw_angle(ax, (0, 0), 0.34 * lengths[0], 0, q[0], r"\theta_1", 1.3)
    draw_angle(ax, (0, 0), 0.85 * lengths[0], q[0], direction - q[0], r"\gamma", 1.1)
    draw_angle(ax, elbow, 0.22 * lengths[1], q[0], q[1], r"\theta_2", 1.5)
    write(
        ax,
        (elbow + foot) / 2 - 0.07 * total * across,
        r"$L_2 \cos\theta_2$",
        rotation=np.degrees(q[0]),
        rotation_mode="anchor",
    )
    write(
        ax,
        (hand + foot) / 2 + 0.05 * total * along,
        r"$L_2 \sin\theta_2$",
        rotation=np.degrees(q[0]) - 90,
        rotation_mode="anchor",
    )
    write(ax, 0.8 * elbow - 0.075 * total * across, "$L_1$")
    write(ax, (elbow + hand) / 2 + 0.07 * total * unit_vector(q[0] + q[1] + np.pi / 2) * np.sign(q[1]), "$L_2$")
    write(ax, hand * (1 + 0.09 * total / np.hypot(*hand)), "$(x, y)$")
    _plane_axes(ax, total)
    leave_room(ax, 0.14 * total)
    return ax


@styled
def mark_target(ax, at, label=""):
    """Mark a point of the plane, shape (2,) in metres, by a cross in a circle with a label beside it."""
    at = as_numbers(at, "point", (2,))
    draw_target(ax, at)
    if label:
        ax.annotate(label, at, xytext=(14, 10), textcoords="offset points", path_effects=HALO, zorder=9)
    keep_in_view(ax, at, 0.08 * max(np.ptp(ax.get_xlim()), np.ptp(ax.get_ylim())))
    return ax


@styled
def mark_frame_2d(ax, frame, name, size):
    """Mark the X and Y axes of a frame, shape (4, 4), seen from above; a tilted axis looks shorter."""
    frame = as_numbers(frame, "frame", (4, 4))
    for letter, column in (("x", 0), ("y", 1)):
        direction, length = frame[:2, column], np.hypot(*frame[:2, column])
        if length > 1e-9:
            draw_axis_arrow(
                ax, frame[:2, 3], np.arctan2(*direction[::-1]), size * length, letter, f"{letter.upper()}_{name}"
            )
    keep_in_view(ax, frame[:2, 3], 1.4 * size)
    return ax


@styled
def mark_hands(ax, lengths, solutions, headings, target, heading, notes, name=r"\theta"):
    """Mark directions of the hand over `draw_postures`: one arrow per posture, the wanted direction dashed.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    solutions : array-like, shape (k, 2), in radians
    headings : sequence of k floats, in radians
        Directions that the postures give.
    target : array-like, shape (2,), in metres
    heading : float, in radians
        Wanted direction.
    notes : sequence of k texts
        Added to the legend entries.
    name : text
        Name of the direction in mathematical notation.
    """
    total = sum(lengths)
    goal = as_numbers(target, "target", (2,))
    for row, direction in zip(solutions, headings):
        hand = planar_joints(lengths, row)[2]
        draw_arrow(
            ax,
            hand,
            hand + 0.3 * total * unit_vector(direction),
            AXIS_COLOURS["x"],
            width=2.2,
            zorder=8,
        )
    end = goal + 0.42 * total * unit_vector(heading)
    ax.plot(*zip(goal, end), color=INK, lw=1.2, ls=(0, (2, 2)), zorder=7)
    write(ax, end + 0.05 * total * unit_vector(heading), f"wanted ${name}$", fontsize=10)
    legend = ax.get_legend()
    if legend:
        labels = [f"{text.get_text()},  {note}" for text, note in zip(legend.get_texts(), notes)]
        _legend_below(ax, legend.legend_handles, labels, columns=1)
    ax.update_datalim([end])
    leave_room(ax, 0.16 * total)
    return ax
