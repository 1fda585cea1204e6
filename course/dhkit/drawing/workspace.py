"""Drawings of workspaces: the image of a grid of joint values, sheets, postures, singular boundaries, sections."""

from __future__ import annotations

import itertools

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap, to_rgb
from matplotlib.patches import Circle, Polygon, Rectangle, Wedge

from ..geometry import planar_joints
from .inputs import as_joint_limits, as_lengths, as_numbers
from .planar_2r import (
    count_postures,
    grid_points,
    hand_distance,
    solve_within_limits,
    split_at_straight_elbow,
    trace_rim,
)
from .strokes import draw_arm, draw_joint, draw_target, leave_room, new_axes, show_plane, write
from .style import AXIS_COLOURS, AXIS_DASHES, FAINT, HALO, INK, LIMIT_DASHES, POSTURE_SHADES, SOFT, styled

# No posture, one, two: white, light and darker, also in grey print.
COUNT_SHADES = ("#ffffff", "#dcdcdc", "#a6a6a6")
# The two elbow sheets: each has a tint and a hatch of its own, so that their overlap shows both.
SHEETS = {1: ("#F4C9AC", "///"), -1: ("#B3D3E8", "\\\\\\")}


# ---------------------------------------------------------------- joint values and their image


def _pair_of_axes(ax, figsize, widths=(1, 1.25)):
    """Two Axes side by side: joint values on the left, the plane on the right."""
    if ax is None:
        return plt.subplots(1, 2, figsize=figsize, width_ratios=widths, layout="constrained")[1]
    pair = np.ravel(ax)
    if len(pair) != 2:
        raise ValueError("ax: expected two Axes, joint values and plane")
    return pair


def _joint_plane(ax, limits, margin=0.12):
    """Axes of the joint values, in degrees."""
    low, high = np.degrees(limits).T
    pad = margin * (high - low)
    ax.set_xlim(low[0] - pad[0], high[0] + pad[0])
    ax.set_ylim(low[1] - pad[1], high[1] + pad[1])
    ax.set_xlabel(r"$\theta_1$ (degrees)")
    ax.set_ylabel(r"$\theta_2$ (degrees)")


@styled
def draw_joint_grid(lengths, limits, counts=(9, 7), chosen=(6, 4), ax=None, *, cells=False):
    """Draw a grid of joint values, and its image: the points that the hand of an RR arm reaches with them.

    One row and one column of the grid are drawn strongly, with their images: an arc about the base and an arc about
    the elbow. Their crossing is the pair (i, j), and the point p_ij.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
        Rows (min, max) of t1 and t2.
    counts : (n, m)
        Number of values of t1 and of t2, both ends included.
    chosen : (i, j)
        The pair to be marked, counted from 1.
    ax : two Axes, optional
    cells : bool
        Instead of the chosen pair and its lines, shade the cells between the values i and i + 1 of t1: equal on the
        left, and on the right as large as the determinant of the Jacobian makes them.

    Returns
    -------
    matplotlib Axes
        Of the plane; the joint values are in the Axes to its left.
    """
    lengths, limits = as_lengths(lengths, "lengths", (2,)), as_joint_limits(limits)
    n, m = counts = tuple(int(c) for c in as_numbers(counts, "counts", (2,)))
    i, j = (int(c) for c in as_numbers(chosen, "chosen", (2,)))
    if min(counts) < 2 or not (1 <= i <= n and 1 <= j <= m):
        raise ValueError("counts: at least 2 values per joint; chosen: a pair (i, j) of the grid, counted from 1")
    joints, plane = _pair_of_axes(ax, (8.6, 4.1))
    t1, t2 = (np.linspace(*limits[k], counts[k]) for k in (0, 1))
    fine = [np.linspace(*limits[k], 60) for k in (0, 1)]
    row, column = AXIS_COLOURS["x"], AXIS_COLOURS["z"]
    for k, values in enumerate((t1, t2)):
        for value in values:
            marked = value == (t1[i - 1], t2[j - 1])[k] and not cells
            ends = ([value], fine[1]) if k == 0 else (fine[0], [value])
            pen = (column if k == 0 else row, 2.2, AXIS_DASHES["z" if k == 0 else "x"]) if marked else (FAINT, 0.9, "-")
            style = {"color": pen[0], "lw": pen[1], "ls": pen[2], "zorder": 3 if marked else 1}
            joints.plot(*np.degrees(np.broadcast_arrays(*ends)), **style)
            plane.plot(*grid_points(lengths, *ends).reshape(-1, 2).T, **style)
    dots = {"ls": "none", "marker": "o", "ms": 3.2, "color": INK, "zorder": 4}
    joints.plot(*np.degrees([mesh.ravel() for mesh in np.meshgrid(t1, t2)]), **dots)
    plane.plot(*grid_points(lengths, t1, t2).reshape(-1, 2).T, **dots)
    if cells:
        _shade_cells(joints, plane, lengths, t1[i - 1 : i + 1] if i < n else t1[-2:], t2)
    else:
        _mark_pair(joints, plane, lengths, t1[i - 1], t2[j - 1])
    show_plane(plane)
    _joint_plane(joints, limits)
    joints.set_title("joint values", fontsize=10)
    plane.set_title("their image", fontsize=10)
    leave_room(plane, 0.08 * lengths.sum())
    return plane


def _shade_cells(joints, plane, lengths, t1, t2):
    for k, values in enumerate(itertools.pairwise(t2)):
        shade = ("#9fc6de", "#f0b692")[k % 2]
        cell = np.array([t1, values])
        corner, (width, height) = np.degrees(cell[:, 0]), np.degrees(np.ptp(cell, axis=1))
        joints.add_patch(Rectangle(corner, width, height, facecolor=shade, edgecolor=INK, lw=0.8, zorder=2))
        plane.add_patch(Polygon(trace_rim(lengths, cell), facecolor=shade, edgecolor=INK, lw=0.8, zorder=2))


def _mark_pair(joints, plane, lengths, t1, t2):
    pair, point = np.degrees([t1, t2]), grid_points(lengths, [t1], [t2])[0, 0]
    for axes, at, name, aside in (
        (joints, pair, r"$(\theta_{1,i},\ \theta_{2,j})$", (10, 9)),
        (plane, point, "$p_{ij}$", (-30, 4)),
    ):
        axes.plot(*at, "o", ms=10, mfc="white", mec=INK, mew=1.6, zorder=6)
        axes.annotate(name, at, xytext=aside, textcoords="offset points", fontsize=12, path_effects=HALO, zorder=9)
    draw_arm(plane, planar_joints(lengths, [t1, t2]), POSTURE_SHADES[0], zorder=4.5, width=8)


@styled
def draw_clouds(clouds, lengths=None, limits=None, ax=None, *, size=2.0):
    """Draw clouds of points side by side at one scale, each over the workspace of an RR arm, if one is given.

    Parameters
    ----------
    clouds : dict from title to points, each array-like of shape (..., 2), in metres
    lengths : array-like, shape (2,), in metres, optional
    limits : array-like, shape (2, 2), in radians, optional
    ax : one Axes per cloud, optional
    size : float
        Size of a point, in points of print.

    Returns
    -------
    matplotlib Axes
        The last one.
    """
    clouds = {title: np.reshape(points, (-1, 2)) for title, points in clouds.items()}
    if ax is None:
        ax = plt.subplots(
            1, len(clouds), figsize=(1 + 3.4 * len(clouds), 3.9), sharex=True, sharey=True, layout="constrained"
        )[1]
    panels = np.ravel(ax)
    if not clouds or len(panels) != len(clouds):
        raise ValueError(f"ax: expected one Axes for each of the {len(clouds)} clouds, found {len(panels)}")
    for axes, (title, points) in zip(panels, clouds.items()):
        if lengths is not None:
            _fill_workspace(axes, lengths, limits)
        axes.plot(*as_numbers(points, title, (None, 2)).T, ".", ms=size, color=INK, zorder=4)
        axes.set_title(title, fontsize=10)
        show_plane(axes)
        draw_joint(axes, (0, 0), size=6)
        axes.margins(0.07)
    for axes in panels[1:]:
        axes.set_ylabel("")
    return panels[-1]


def _fill_workspace(ax, lengths, limits, colour="#e3e3e3"):
    limits = [(-np.pi, np.pi)] * 2 if limits is None else limits
    for piece in split_at_straight_elbow(limits):
        ax.add_patch(Polygon(trace_rim(lengths, piece), closed=True, facecolor=colour, edgecolor="none", zorder=1))


# ---------------------------------------------------------------- radius, area, sheets


@styled
def draw_radius(lengths, t2_limits=None, ax=None):
    """Draw the distance of the hand from the base against the elbow angle, with the range that the joint limits leave.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    t2_limits : array-like, shape (2,), in radians, optional

    Returns
    -------
    matplotlib Axes
    """
    l1, l2 = lengths = as_lengths(lengths, "lengths", (2,))
    ax = ax or new_axes((5.8, 3.5))
    turn = np.linspace(-np.pi, np.pi, 361)

    ax.plot(np.degrees(turn), hand_distance(lengths, turn), color=SOFT, lw=1.4, zorder=2)
    ax.set(xlabel=r"$\theta_2$ (degrees)", ylabel="distance $r$ from the base (m)", xlim=(-180, 180))
    ax.set_ylim(0, 1.15 * (l1 + l2))
    ax.set_xticks(range(-180, 181, 60))
    ax.grid(True)
    for r, name, clear in (
        (l1 + l2, "$L_1 + L_2$", -150),
        (abs(l1 - l2), "$|L_1 - L_2|$", 0),
    ):  # where the curve is far
        ax.axhline(r, color=SOFT, lw=0.9, ls=LIMIT_DASHES, zorder=1)
        ax.annotate(
            name, (clear, r), xytext=(0, 3), textcoords="offset points", ha="center", fontsize=9, color="#555555"
        )
    if t2_limits is not None:
        low, high = as_numbers(t2_limits, "t2_limits", (2,))
        if not -np.pi - 1e-9 <= low < high <= np.pi + 1e-9:
            raise ValueError("t2_limits: expected (min, max) between -pi and pi, min below max")
        inside = np.linspace(low, high, 200)
        r = hand_distance(lengths, np.append(inside, [s for s in (0.0,) if low <= s <= high]))
        ax.axvspan(*np.degrees([low, high]), color="#f1f1f1", zorder=0)
        ax.plot(np.degrees(inside), hand_distance(lengths, inside), color=INK, lw=3, zorder=3)
        for value, name in ((r.max(), r"r_\mathrm{max}"), (r.min(), r"r_\mathrm{min}")):
            ax.plot([np.degrees(low), 180], [value] * 2, color=INK, lw=1, ls=(0, (2, 2)), zorder=2)
            ax.annotate(
                f"${name}$ = {value:.3f} m",
                (180, value),
                xytext=(5, 0),
                textcoords="offset points",
                va="center",
                annotation_clip=False,
            )
    return ax


@styled
def draw_sheets(lengths, limits, ax=None):
    """Draw the workspace of an RR arm as one sheet per sense of the elbow; where both lie, their hatches cross.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
        Rows (min, max) of t1 and t2.

    Returns
    -------
    matplotlib Axes
    """
    lengths, limits = as_lengths(lengths, "lengths", (2,)), as_joint_limits(limits)
    ax = ax or new_axes((5.0, 4.6))
    shown = {}
    for piece in split_at_straight_elbow(limits)[::-1]:
        bend = 1 if np.sin(piece[1].mean()) > 0 else -1
        tint, hatch = SHEETS[bend]
        outline = trace_rim(lengths, piece)
        pen = {"closed": True, "hatch": hatch, "edgecolor": "#777777", "lw": 0, "zorder": 1.5}
        shown[bend] = ax.add_patch(Polygon(outline, facecolor=(*to_rgb(tint), 0.6), **pen))
        draw_rim(ax, lengths, piece, limits)
    ax.legend(
        shown.values(),
        [rf"$\theta_2 {'>' if bend > 0 else '<'} 0$" for bend in shown],
        loc="upper center",
        bbox_to_anchor=(0.5, -0.13),
        ncols=2,
    )
    show_plane(ax)
    draw_joint(ax, (0, 0))
    ax.autoscale_view()
    ax.margins(0.06)
    return ax


@styled
def mark_edges(ax, lengths, limits):
    """Mark the edges of the sheets of an RR arm's workspace: bold where the elbow is straight, thin at a stop.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
        Rows (min, max) of t1 and t2.
    """
    limits = as_joint_limits(limits)
    for piece in split_at_straight_elbow(limits):
        draw_rim(ax, lengths, piece, limits)
    return ax


def draw_rim(ax, lengths, piece, limits):
    """Draw the edges of one sheet: singular arcs (straight elbow) bold, edges made by joint limits thin."""
    t1, t2 = (np.linspace(*row, 200) for row in piece)
    for value in piece[1]:
        straight = abs(np.sin(value)) < 1e-9
        ax.plot(*grid_points(lengths, t1, [value])[:, 0].T, color=INK, lw=2.6 if straight else 1.1, zorder=3)
    if np.ptp(limits[0]) < 2 * np.pi - 1e-9:
        for value in piece[0]:
            ax.plot(*grid_points(lengths, [value], t2)[0].T, color=INK, lw=1.1, zorder=3)


# ---------------------------------------------------------------- postures and singularities


@styled
def draw_posture_count(lengths, limits, point=None, ax=None):
    """Draw how many postures reach each point of the plane within the joint limits, and what the edges are made of.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
        Rows (min, max) of t1 and t2.
    point : array-like, shape (2,), in metres, optional
        A point whose postures are drawn.

    Returns
    -------
    matplotlib Axes
    """
    lengths, limits = as_lengths(lengths, "lengths", (2,)), as_joint_limits(limits)
    reach = 1.06 * lengths.sum()
    ax = ax or new_axes((5.0, 4.9))
    side = np.linspace(-reach, reach, 401)
    counts = count_postures(lengths, limits, np.stack(np.meshgrid(side, side), axis=-1))
    ax.imshow(
        counts,
        extent=(-reach, reach, -reach, reach),
        origin="lower",
        cmap=ListedColormap(COUNT_SHADES),
        vmin=0,
        vmax=2,
        zorder=0.5,
    )
    mark_edges(ax, lengths, limits)
    if point is not None:
        goal = as_numbers(point, "point", (2,))
        postures, reached = solve_within_limits(lengths, limits, goal)
        for k, q in enumerate(postures[reached]):
            draw_arm(ax, planar_joints(lengths, q), ("#f6f6f6", "#c4c4c4")[k], zorder=4 + k, width=8)
        draw_target(ax, goal)
    boxes = [Rectangle((0, 0), 1, 1, facecolor=shade, edgecolor=INK) for shade in COUNT_SHADES[1:]]
    lines = [plt.Line2D([], [], color=INK, lw=width) for width in (2.6, 1.1)]
    names = ["one configuration", "two configurations", "singular: elbow straight", "joint at its limit"]
    ax.legend([*boxes, *lines], names, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, handlelength=1.6)
    show_plane(ax)
    draw_joint(ax, (0, 0))
    ax.set_xlim(-reach, reach)
    ax.set_ylim(-reach, reach)
    return ax


@styled
def draw_posture_change(lengths, start, end, ax=None):
    """Draw the way from one posture to another along a straight line of joint values, with the aspects.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    start, end : array-like, shape (2,), in radians
        Joint values (t1, t2) between -pi and pi.
    ax : two Axes, optional

    Returns
    -------
    matplotlib Axes
        Of the plane; the joint values are in the Axes to its left.
    """
    lengths = as_lengths(lengths, "lengths", (2,))
    ends = [as_numbers(q, name, (2,)) for q, name in ((start, "start"), (end, "end"))]
    joints, plane = _pair_of_axes(ax, (8.6, 4.3))
    for low, bend in ((0, 1), (-180, -1)):
        tint, hatch = SHEETS[bend]
        joints.add_patch(
            Rectangle(
                (-180, low), 360, 180, facecolor=tint, edgecolor="#ffffff", hatch=hatch, lw=0, alpha=0.75, zorder=0
            )
        )
        write(joints, (-95, low + 90), rf"aspect $\sin\theta_2 {'>' if bend > 0 else '<'} 0$", fontsize=10)
    for value in (-180, 0, 180):
        joints.plot([-180, 180], [value] * 2, color=INK, lw=2.6, zorder=2, clip_on=False)
    inner, outer = abs(lengths[0] - lengths[1]), lengths.sum()
    plane.add_patch(Circle((0, 0), outer, facecolor="#eeeeee", edgecolor=INK, lw=2.6, zorder=1))
    plane.add_patch(Circle((0, 0), inner, facecolor="white", edgecolor=INK, lw=2.6, zorder=1.1))
    way = np.linspace(*ends, 120)
    hands = planar_joints(lengths, way)[:, -1]
    pen = {"color": AXIS_COLOURS["z"], "lw": 2, "ls": AXIS_DASHES["z"], "zorder": 6}
    joints.plot(*np.degrees(way).T, **pen)
    plane.plot(*hands.T, **pen)
    if ends[0][1] * ends[1][1] < 0:
        k = int(np.argmin(np.abs(way[:, 1])))
        joints.plot(*np.degrees(way[k]), "D", ms=7, mfc="white", mec=INK, zorder=7)
        plane.plot(*hands[k], "D", ms=7, mfc="white", mec=INK, zorder=7)
    for k, (q, name) in enumerate(zip(ends, "AB")):
        points = planar_joints(lengths, q)
        _, elbow, hand = points
        draw_arm(plane, points, ("#f6f6f6", "#b9b9b9")[k], zorder=3 + k, width=9)
        plane.annotate(name, elbow, xytext=(9 * np.sign(elbow[0] - 0.6 * hand[0]), 8), textcoords="offset points",
                       fontweight="bold", path_effects=HALO, zorder=9)  # fmt: skip
        joints.plot(*np.degrees(q), "o", ms=8, mfc=("#f6f6f6", "#b9b9b9")[k], mec=INK, mew=1.4, zorder=7)
        joints.annotate(
            name,
            np.degrees(q),
            xytext=(9, -4),
            textcoords="offset points",
            fontweight="bold",
            path_effects=HALO,
            zorder=9,
        )
    _joint_plane(joints, np.array([[-np.pi, np.pi]] * 2), 0.02)
    joints.set_xticks(range(-180, 181, 90))
    joints.set_yticks(range(-180, 181, 90))
    show_plane(plane)
    plane.set_xlim(-1.06 * outer, 1.06 * outer)
    plane.set_ylim(-1.06 * outer, 1.06 * outer)
    return plane


@styled
def draw_dexterous(lengths, ax=None):
    """Draw where a planar arm with a hand reaches in some direction of the hand, and where in every direction.

    Parameters
    ----------
    lengths : array-like, shape (3,), in metres
        Upper arm, forearm, hand.

    Returns
    -------
    matplotlib Axes
    """
    l1, l2, l3 = lengths = as_lengths(lengths, "lengths", (3,))
    inner, outer = abs(l1 - l2), l1 + l2
    ax = ax or new_axes((5.0, 4.9))
    total = lengths.sum()
    r = np.linspace(0, total, 2001)
    # The wrist lies on a circle of radius l3 about the point: its distances run from |r - l3| to r + l3.
    some = (np.abs(r - l3) <= outer) & (r + l3 >= inner)
    every = (np.abs(r - l3) >= inner) & (r + l3 <= outer)
    kinds = ((some, "#e9e9e9", "reachable: in some direction"), (every, "#a6a6a6", "dexterous: in every direction"))
    for mask, shade, name in kinds:
        for k, (low, high) in enumerate(_runs(r, mask)):
            pen = {"facecolor": shade, "edgecolor": INK, "lw": 1.4, "zorder": 1}
            ring = ax.add_patch(Wedge((0, 0), high, 0, 360, width=high - low if low > 1e-6 else None, **pen))
            ring.set_label("_" + name if k else name)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, handlelength=1.6, columnspacing=1.2)
    show_plane(ax)
    draw_joint(ax, (0, 0))
    ax.set_xlim(-1.06 * total, 1.06 * total)
    ax.set_ylim(-1.06 * total, 1.06 * total)
    return ax


def _runs(values, mask) -> list[tuple[float, float]]:
    """Ends of the stretches of `values` on which `mask` holds, outermost first."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    return [(values[a], values[b - 1]) for a, b in zip(edges[::2], edges[1::2])][::-1]
