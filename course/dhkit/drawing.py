"""Drawings of the course: planar arms, workspaces, kinematic sketches and frames in three dimensions.

Every ``draw_*`` function takes lengths in metres and angles in radians, makes its own figure unless it is
given `ax`, and returns the Axes. Bad input raises `ValueError` with the awaited form in words. ``mark_*`` functions add
to a drawing.

One style for the whole course: x red and solid, y green and dashed, z blue and dash-dotted, all labelled, so
that a grey print and a colour-blind reader lose nothing. Links are grey; darker means a later posture.
"""

from __future__ import annotations

import numpy as np
import sympy
from matplotlib.collections import PolyCollection
from matplotlib.patches import Circle, Polygon, Rectangle

from . import strokes


def planar_points(lengths, q) -> np.ndarray:
    """Base, joints and hand of a planar arm, each angle measured from the link before it.

    Parameters
    ----------
    lengths : array-like, shape (n,), in metres
    q : array-like, shape (n,), in radians

    Returns
    -------
    ndarray, shape (n + 1, 2), in metres
    """
    lengths = strokes.as_numbers(lengths, "lengths", (None,))
    q = strokes.as_numbers(q, "joint angles", (len(lengths),))
    heading = np.cumsum(q)
    steps = lengths[:, None] * np.column_stack([np.cos(heading), np.sin(heading)])
    return np.vstack([[0, 0], np.cumsum(steps, axis=0)])


# ---------------------------------------------------------------- planar arms


@strokes.styled
def draw_planar_arm(lengths, q, ax=None, *, length_names=None, angle_names=None, hand="P", projections=False):
    """A planar arm of n revolute joints with its joint angles and link lengths.

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
    lengths = strokes.as_lengths(lengths, "lengths", (None,))
    points = planar_points(lengths, q)
    q = strokes.as_numbers(q, "joint angles", (len(lengths),))
    n = len(q)
    length_names = length_names or [f"L_{i + 1}" for i in range(n)]
    angle_names = angle_names or [rf"\theta_{i + 1}" for i in range(n)]
    ax = ax or strokes.new_axes()
    strokes.show_plane(ax)
    total, heading = lengths.sum(), np.concatenate([[0], np.cumsum(q)])
    strokes.arm(ax, points, strokes.POSTURE_SHADES[0])
    for i in range(n):
        reach = 0.42 * lengths[i]
        start = points[i]
        if i:
            ax.plot(
                *zip(start, start + 1.25 * reach * strokes.unit_vector(heading[i])),
                color=strokes.SOFT,
                lw=1,
                ls=strokes.CENTRE_LINE,
                zorder=2,
            )
        away = 1 + 0.1 * total / reach
        strokes.angle_arc(ax, start, reach * 0.8, heading[i], q[i], angle_names[i], away)
        side = np.sign(q[i] or 1) * strokes.unit_vector(heading[i + 1] + np.pi / 2)
        strokes.write(ax, (points[i] + points[i + 1]) / 2 + 0.075 * total * side, f"${length_names[i]}$")
    ax.plot(*points[-1], "o", ms=7, color=strokes.INK, zorder=6)
    if hand:
        strokes.write(ax, points[-1] + 0.08 * total * strokes.unit_vector(heading[-1]), f"${hand}$")
    if projections:
        x, y = points[-1]
        ax.plot([x, x, 0], [0, y, y], color=strokes.SOFT, lw=1, ls=(0, (2, 2)), zorder=1.5)
        strokes.write(ax, (x + 0.045 * total, 0.045 * total * np.sign(y or 1)), "$x$")
        strokes.write(ax, (0.045 * total * np.sign(x or 1), y + 0.045 * total), "$y$")
    _plane_axes(ax, total)
    strokes.leave_room(ax, 0.16 * total)
    return ax


def _plane_axes(ax, total):
    """The axes x0, y0 of the base."""
    for letter, angle in (("x", 0), ("y", np.pi / 2)):
        strokes.axis_arrow(ax, (0, 0), angle, 0.24 * total, letter, f"{letter}_0", away=0.22)


@strokes.styled
def draw_postures(lengths, solutions, target=None, ax=None, *, symmetry=False):
    """All postures of a planar 2R arm that reach one point, shaded differently and numbered at the elbow.

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
    lengths = strokes.as_lengths(lengths, "lengths", (2,))
    solutions = strokes.as_numbers(
        np.reshape(solutions, (0, 2)) if np.size(solutions) == 0 else solutions, "solutions", (None, 2)
    )
    goal = None if target is None else strokes.as_numbers(target, "target", (2,))
    ax = ax or strokes.new_axes()
    strokes.show_plane(ax)
    total = lengths.sum()
    shaded = []
    for k, (t1, t2) in enumerate(solutions):
        points = planar_points(lengths, (t1, t2))
        fill = strokes.POSTURE_SHADES[k % len(strokes.POSTURE_SHADES)]
        outline = strokes.arm(ax, points, fill, zorder=3 + k)
        outline.set_label(f"{k + 1}:  $t_1$ = {strokes.in_degrees(t1)},  $t_2$ = {strokes.in_degrees(t2)}")
        shaded.append((outline, fill))
        out = points[1] - 0.5 * points[2]
        out = out / (np.hypot(*out) or 1)
        strokes.write(ax, points[1] + 0.11 * total * out, str(k + 1), fontweight="bold")
    if symmetry and goal is not None:
        ax.plot(*zip((0, 0), 1.12 * goal), color=strokes.SOFT, lw=1.1, ls=strokes.CENTRE_LINE, zorder=2)
    if goal is not None:
        strokes.target_mark(ax, goal)
    ax.update_datalim([(0, 0)])
    strokes.leave_room(ax, 0.16 * total)
    if shaded:
        _posture_legend(ax, shaded)
    return ax


def _posture_legend(ax, shaded):
    """Legend with a shaded box per posture (the link's outline alone would show as a black line)."""
    boxes = [Rectangle((0, 0), 1, 1, facecolor=fill, edgecolor=strokes.INK) for _, fill in shaded]
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


@strokes.styled
def draw_workspace_2r(lengths, limits=None, ax=None, *, names=True):
    """Workspace of a planar 2R arm: the ring between the inner and the outer limit.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians, optional
        Rows (min, max) of t1 and t2; the part of the ring that they leave is darker.
    names : bool
        Draw and name the two radii.

    Returns
    -------
    matplotlib Axes
    """
    lengths = strokes.as_lengths(lengths, "lengths", (2,))
    limits = None if limits is None else strokes.as_numbers(limits, "limits", (2, 2))
    inner, outer = abs(lengths[0] - lengths[1]), lengths.sum()
    ax = ax or strokes.new_axes((4.8, 4.8))
    strokes.show_plane(ax)
    ax.add_patch(Circle((0, 0), outer, facecolor="#eeeeee", edgecolor=strokes.INK, lw=1.6, zorder=1))
    if inner > 1e-9:
        ax.add_patch(
            Circle((0, 0), inner, facecolor="white", edgecolor=strokes.INK, lw=1.6, ls=(0, (5, 2)), zorder=1.6)
        )
    if limits is not None:
        ax.add_collection(_swept_area(lengths, limits))
    if names:
        _radius(ax, outer, np.radians(28), r"r_\mathrm{max} = L_1 + L_2")
    if names and inner > 1e-9:
        _radius(ax, inner, np.radians(-62), r"r_\mathrm{min} = |L_1 - L_2|", beyond=0.15 * outer)
    strokes.joint(ax, (0, 0))
    ax.set_xlim(-1.12 * outer, 1.12 * outer)
    ax.set_ylim(-1.12 * outer, 1.12 * outer)
    return ax


def _swept_area(lengths, limits, cells=60) -> PolyCollection:
    """The image of the rectangle of allowed joint angles, as small patches."""
    t1 = np.linspace(*limits[0], cells)
    t2 = np.linspace(*limits[1], cells)
    t1, t2 = np.meshgrid(t1, t2, indexing="ij")
    x = lengths[0] * np.cos(t1) + lengths[1] * np.cos(t1 + t2)
    y = lengths[0] * np.sin(t1) + lengths[1] * np.sin(t1 + t2)
    corners = np.stack([x, y], axis=-1)
    patches = np.stack([corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:], corners[:-1, 1:]], axis=2)
    return PolyCollection(patches.reshape(-1, 4, 2), facecolor="#bdbdbd", edgecolor="#bdbdbd", lw=0.4, zorder=1.4)


def _radius(ax, radius, angle, label, beyond=0.0):
    end = radius * strokes.unit_vector(angle)
    strokes.arrow(ax, (0, 0), end, width=1.1, zorder=4)
    turn = (np.degrees(angle) + 90) % 180 - 90
    if beyond:
        strokes.write(ax, end + beyond * strokes.unit_vector(angle), f"${label}$", fontsize=10, ha="left")
    else:
        side = np.array([-np.sin(angle), np.cos(angle)])
        strokes.write(
            ax, end / 2 + 0.07 * radius * side, f"${label}$", fontsize=10, rotation=turn, rotation_mode="anchor"
        )


@strokes.styled
def draw_triangle_2r(lengths, q, ax=None):
    """The triangle behind "find q1": direction of the target, and the angle from link 1 to it.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    q : array-like, shape (2,), in radians
        t1 and t2, t2 not zero.

    Returns
    -------
    matplotlib Axes
    """
    lengths = strokes.as_lengths(lengths, "lengths", (2,))
    q = strokes.as_numbers(q, "joint angles", (2,))
    points = planar_points(lengths, q)
    elbow, hand = points[1], points[2]
    along, total = strokes.unit_vector(q[0]), lengths.sum()
    foot = along * (hand @ along)
    ax = ax or strokes.new_axes((5.4, 4.4))
    strokes.show_plane(ax)
    strokes.arm(ax, points, strokes.POSTURE_SHADES[0], width=11)
    ax.plot(*zip((0, 0), hand), color=strokes.INK, lw=1.2, ls=strokes.CENTRE_LINE, zorder=5)
    ax.plot(*zip(elbow, foot), color=strokes.INK, lw=1.1, ls=(0, (4, 2)), zorder=2)
    ax.plot(*zip(hand, foot), color=strokes.INK, lw=1.1, ls=(0, (4, 2)), zorder=2)
    corner = 0.035 * total
    across = (hand - foot) / np.hypot(*(hand - foot))
    inward = -along
    ax.plot(
        *zip(foot + corner * inward, foot + corner * (inward + across), foot + corner * across),
        color=strokes.INK,
        lw=0.9,
        zorder=2,
    )
    direction = np.arctan2(hand[1], hand[0])
    strokes.angle_arc(ax, (0, 0), 0.62 * lengths[0], 0, direction, "")
    strokes.write(ax, 0.68 * lengths[0] * strokes.unit_vector(0.17), r"$\mathrm{atan2}(y, x)$", ha="left")
    strokes.angle_arc(ax, (0, 0), 0.34 * lengths[0], 0, q[0], r"\theta_1", 1.3)
    strokes.angle_arc(ax, (0, 0), 0.85 * lengths[0], q[0], direction - q[0], r"\gamma", 1.1)
    strokes.angle_arc(ax, elbow, 0.22 * lengths[1], q[0], q[1], r"\theta_2", 1.5)
    strokes.write(
        ax,
        (elbow + foot) / 2 - 0.07 * total * across,
        r"$L_2 \cos\theta_2$",
        rotation=np.degrees(q[0]),
        rotation_mode="anchor",
    )
    strokes.write(
        ax,
        (hand + foot) / 2 + 0.05 * total * along,
        r"$L_2 \sin\theta_2$",
        rotation=np.degrees(q[0]) - 90,
        rotation_mode="anchor",
    )
    strokes.write(ax, 0.8 * elbow - 0.075 * total * across, "$L_1$")
    strokes.write(
        ax, (elbow + hand) / 2 + 0.07 * total * strokes.unit_vector(q[0] + q[1] + np.pi / 2) * np.sign(q[1]), "$L_2$"
    )
    strokes.write(ax, hand * (1 + 0.09 * total / np.hypot(*hand)), "$(x, y)$")
    _plane_axes(ax, total)
    strokes.leave_room(ax, 0.14 * total)
    return ax


# ---------------------------------------------------------------- kinematic sketches of the SCARA


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


# ---------------------------------------------------------------- three dimensions


def _merged_axes(transforms, names, letters):
    """Axis arrows of all frames; arrows that coincide are listed once with all their names."""
    merged: dict[tuple, list] = {}
    for transform, name in zip(transforms, names):
        for letter in letters:
            direction = transform[:3, "xyz".index(letter)]
            key = (letter, *np.round(transform[:3, 3], 6) + 0.0, *np.round(direction, 6) + 0.0)
            merged.setdefault(key, [letter, transform[:3, 3], direction, []])[3].append(name)
    return list(merged.values())


def _draw_frames(ax, transforms, names, size, letters="xyz"):
    for letter, origin, direction, owners in _merged_axes(transforms, names, letters):
        end = origin + size * direction
        strokes.arrow_3d(ax, origin, end, strokes.AXIS_COLOURS[letter], strokes.AXIS_DASHES[letter])
        label = ", ".join(f"{letter.upper()}_{{{name}}}" for name in owners)
        strokes.write_3d(ax, origin + 1.28 * size * direction, f"${label}$", color=strokes.AXIS_COLOURS[letter])


@strokes.styled
def draw_frames_3d(transforms, names=None, ax=None, *, size=None, links=True, letters="xyz"):
    """Frames in space, joined in their order by grey links.

    Axes of several frames that coincide are drawn once and carry all their names.

    Parameters
    ----------
    transforms : array-like, shape (n, 4, 4), lengths in metres
        Frames seen from the base.
    names : sequence of n texts, optional
        Indices of the frames, by default 0, 1, 2, ...
    size : float, in metres, optional
        Length of the axes; by default from the extent of the chain.
    links : bool
        Join the origins.
    letters : str
        Axes to draw, "xyz" or a part of it.

    Returns
    -------
    matplotlib Axes (3D)
    """
    transforms = strokes.as_numbers(
        [t.tolist() if isinstance(t, sympy.MatrixBase) else t for t in transforms], "transforms", (None, 4, 4)
    )
    names = [str(i) for i in range(len(transforms))] if names is None else list(names)
    if len(names) != len(transforms):
        raise ValueError(f"names: expected {len(transforms)}, found {len(names)}")
    origins = transforms[:, :3, 3]
    extent = np.ptp(origins, axis=0).max()
    size = size or (0.22 * extent if extent > 0 else 1.0)
    own, ax = ax is None, ax or strokes.new_axes_3d()
    if links:
        ax.plot(*origins.T, color=strokes.INK, lw=7, solid_capstyle="round", solid_joinstyle="round", zorder=1)
        ax.plot(*origins.T, color=strokes.FAINT, lw=5, solid_capstyle="round", solid_joinstyle="round", zorder=1.1)
    ax.plot(*origins.T, "o", ms=4, color=strokes.INK, ls="none", zorder=5)
    _draw_frames(ax, transforms, names, size, letters)
    ends = (origins[:, None, :] + 1.35 * size * transforms[:, :3, :3].swapaxes(1, 2)).reshape(-1, 3)
    strokes.fit_3d(ax, np.vstack([origins, ends]), own)
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
        _draw_frames(ax, transforms, "01234", size, letters="x")
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


@strokes.styled
def draw_dh_parameters(a=1.0, alpha=np.radians(40), d=1.3, theta=np.radians(50), ax=None, *, frame=True):
    """The four parameters of the modified DH convention between frames i-1 and i, in space.

    Parameters
    ----------
    a, d : float, in metres
    alpha, theta : float, in radians
    frame : bool
        Draw the axes of frame i.

    Returns
    -------
    matplotlib Axes (3D)
    """
    a, alpha, d, theta = strokes.as_numbers([a, alpha, d, theta], "a, alpha, d, theta", (4,))
    z0, x0 = np.array([0, 0, 1.0]), np.array([1.0, 0, 0])
    z1 = np.array([0, -np.sin(alpha), np.cos(alpha)])
    side = np.array([0, np.cos(alpha), np.sin(alpha)])
    x1 = np.cos(theta) * x0 + np.sin(theta) * side
    foot = a * x0
    origin = foot + d * z1
    size = 0.55
    own, ax = ax is None, ax or strokes.new_axes_3d(elev=20, azim=-58)
    for base, axis, low, high in (((0, 0, 0), z0, -0.35, 1.25), (foot, z1, -0.4, d + 0.9)):
        ax.plot(*zip(base + low * axis, base + high * axis), color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=1)
    ax.plot(*zip(-0.2 * x0, foot + 0.75 * x0), color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=1)
    ax.plot(*zip((0, 0, 0), foot), color=strokes.INK, lw=3, zorder=3)
    ax.plot(*zip(foot, origin), color=strokes.INK, lw=3, zorder=3)
    for base, axis, letter, name in (
        ((0, 0, 0), z0, "z", "Z_{i-1}"), (foot * 0, x0, "x", "X_{i-1}"),
        (origin, z1, "z", "Z_i"), (origin, x1, "x", "X_i"),
    ):  # fmt: skip
        if name in ("Z_i", "X_i") and not frame:
            continue
        end = np.asarray(base) + size * axis
        strokes.arrow_3d(ax, base, end, strokes.AXIS_COLOURS[letter], strokes.AXIS_DASHES[letter], width=2.1)
        aside = 0.12 * z0 if name == "X_{i-1}" else 0.25 * size * axis
        strokes.write_3d(ax, end + aside, f"${name}$", color=strokes.AXIS_COLOURS[letter])
    ax.plot(*zip(foot, foot + 0.62 * z0), color=strokes.SOFT, lw=0.9, ls=(0, (3, 2)), zorder=2)
    ax.plot(*zip(origin, origin + 0.5 * x0), color=strokes.SOFT, lw=0.9, ls=(0, (3, 2)), zorder=2)
    strokes.angle_arc_3d(ax, foot, z0, -np.array([0, 1.0, 0]), 0.5, alpha, r"\alpha_{i-1}", 1.32)
    strokes.angle_arc_3d(ax, origin, x0, side, 0.36, theta, r"\theta_i")
    strokes.write_3d(ax, foot * 0.72 + (0, 0, -0.13), "$a_{i-1}$")
    strokes.write_3d(ax, foot + 0.62 * d * z1 - (0.12, 0, 0), "$d_i$")
    for at, name, away in (((0, 0, 0), "O_{i-1}", (-0.14, 0, -0.09)), (origin, "O_i", (-0.13, 0, 0.02))):
        ax.plot(*[[c] for c in at], "o", ms=5, color=strokes.INK, zorder=6)
        strokes.write_3d(ax, np.asarray(at) + away, f"${name}$")
    ends = [
        -0.2 * x0,
        foot + 0.75 * x0,
        -0.35 * z0,
        1.25 * z0,
        foot - 0.4 * z1,
        foot + (d + 0.9) * z1,
        origin + 1.3 * size * x1,
    ]
    strokes.fit_3d(ax, ends, own)
    return ax


# ---------------------------------------------------------------- marks on a drawing


@strokes.styled
def mark_target(ax, at, label=""):
    """A cross in a circle at the point `at`, shape (2,), in metres, with a label beside it."""
    at = strokes.as_numbers(at, "point", (2,))
    strokes.target_mark(ax, at)
    if label:
        ax.annotate(label, at, xytext=(14, 10), textcoords="offset points", path_effects=strokes.halo(), zorder=9)
    strokes.keep_in_view(ax, at, 0.08 * max(np.ptp(ax.get_xlim()), np.ptp(ax.get_ylim())))
    return ax


@strokes.styled
def mark_frame_2d(ax, frame, name, size):
    """The X and Y axes of a frame, shape (4, 4), seen from above; a tilted axis looks shorter."""
    frame = strokes.as_numbers(frame, "frame", (4, 4))
    for letter, column in (("x", 0), ("y", 1)):
        direction, length = frame[:2, column], np.hypot(*frame[:2, column])
        if length > 1e-9:
            strokes.axis_arrow(
                ax, frame[:2, 3], np.arctan2(*direction[::-1]), size * length, letter, f"{letter.upper()}_{name}"
            )
    strokes.keep_in_view(ax, frame[:2, 3], 1.4 * size)
    return ax


@strokes.styled
def mark_frame(ax, frame, name, size):
    """A frame, shape (4, 4), in a 3D drawing, with axes of length `size` in metres."""
    frame = strokes.as_numbers(frame, "frame", (4, 4))
    ax.plot(*frame[:3, 3:], "o", ms=5, color=strokes.INK, zorder=7)
    _draw_frames(ax, [frame], [name], size)
    return ax


@strokes.styled
def mark_path(ax, frames, size, stations=6):
    """The path of a moving frame, shape (n, 4, 4), with its X and Y axes at some stations."""
    frames = strokes.as_numbers(frames, "frames", (None, 4, 4))
    ax.plot(*frames[:, :3, 3].T, color=strokes.INK, lw=1.6, zorder=5)
    for frame in frames[np.linspace(0, len(frames) - 1, stations).astype(int)]:
        for letter, column in (("x", 0), ("y", 1)):
            strokes.arrow_3d(
                ax,
                frame[:3, 3],
                frame[:3, 3] + size * frame[:3, column],
                strokes.AXIS_COLOURS[letter],
                strokes.AXIS_DASHES[letter],
            )
    return ax


@strokes.styled
def mark_hands(ax, lengths, solutions, headings, target, heading, notes):
    """Directions of the hand over `draw_postures`: one arrow per posture, the wanted direction dashed.

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
    """
    total = sum(lengths)
    goal = strokes.as_numbers(target, "target", (2,))
    for row, direction in zip(solutions, headings):
        hand = planar_points(lengths, row)[2]
        strokes.arrow(
            ax,
            hand,
            hand + 0.3 * total * strokes.unit_vector(direction),
            strokes.AXIS_COLOURS["x"],
            width=2.2,
            zorder=8,
        )
    end = goal + 0.42 * total * strokes.unit_vector(heading)
    ax.plot(*zip(goal, end), color=strokes.INK, lw=1.2, ls=(0, (2, 2)), zorder=7)
    strokes.write(ax, end + 0.05 * total * strokes.unit_vector(heading), r"wanted $\theta$", fontsize=10)
    legend = ax.get_legend()
    if legend:
        labels = [f"{text.get_text()},  {note}" for text, note in zip(legend.get_texts(), notes)]
        _legend_below(ax, legend.legend_handles, labels, columns=1)
    ax.update_datalim([end])
    strokes.leave_room(ax, 0.16 * total)
    return ax
