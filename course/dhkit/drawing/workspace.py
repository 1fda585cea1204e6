"""Drawings of workspaces: the image of a grid of joint values, sheets, postures, singular boundaries, sections."""

from __future__ import annotations

import itertools

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Circle, Polygon, Rectangle, Wedge
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .. import strokes

# No posture, one, two: white, light and darker, also in grey print.
COUNT_SHADES = ("#ffffff", "#dcdcdc", "#a6a6a6")
# The two elbow sheets: each has a tint and a hatch of its own, so that their overlap shows both.
SHEETS = {1: ("#F4C9AC", "///"), -1: ("#B3D3E8", "\\\\\\")}


def rr_points(lengths, t1, t2) -> np.ndarray:
    """Hand of the planar RR arm for every pair of the joint values: p_ij for t1 (n,) and t2 (m,), shape (n, m, 2)."""
    l1, l2 = strokes.as_lengths(lengths, "lengths", (2,))
    t1, t2 = np.meshgrid(strokes.as_numbers(t1, "t1", (None,)), strokes.as_numbers(t2, "t2", (None,)), indexing="ij")
    return np.stack([l1 * np.cos(t1) + l2 * np.cos(t1 + t2), l1 * np.sin(t1) + l2 * np.sin(t1 + t2)], axis=-1)


def count_postures(lengths, limits, points) -> np.ndarray:
    """How many postures of the planar RR arm reach each point within the joint limits: 0, 1 or 2.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
        Rows (min, max) of t1 and t2.
    points : array-like, shape (..., 2), in metres

    Returns
    -------
    ndarray of int, shape (...)
    """
    l1, l2 = strokes.as_lengths(lengths, "lengths", (2,))
    limits = _joint_limits(limits)
    x, y = np.moveaxis(np.asarray(points, float), -1, 0)
    cosine = (x**2 + y**2 - l1**2 - l2**2) / (2 * l1 * l2)
    bend = np.arccos(np.clip(cosine, -1, 1))
    found = np.zeros(x.shape, int)
    for t2 in (bend, -bend):
        t1 = np.arctan2(y, x) - np.arctan2(l2 * np.sin(t2), l1 + l2 * np.cos(t2))
        found += (np.abs(cosine) <= 1) & _within(t1, limits[0]) & _within(t2, limits[1])
    return found


def _within(angle, limits):
    return np.mod(angle - limits[0], 2 * np.pi) <= limits[1] - limits[0]


def _joint_limits(limits) -> np.ndarray:
    limits = strokes.as_numbers(limits, "limits", (2, 2))
    if (limits[:, 0] >= limits[:, 1]).any():
        raise ValueError("limits: each row is (min, max) with min below max")
    if (np.ptp(limits, axis=1) > 2 * np.pi + 1e-9).any():
        raise ValueError("limits: a range wider than a full turn repeats itself")
    return limits


def _is_full_turn(limits) -> bool:
    return np.ptp(limits) > 2 * np.pi - 1e-9


def _straight_angles(limits) -> list[float]:
    """Stretched (0) and folded (pi) elbow angles inside the range of joint 2, with their multiples."""
    first, last = np.ceil(limits[0] / np.pi - 1e-9), np.floor(limits[1] / np.pi + 1e-9)
    return [k * np.pi for k in np.arange(first, last + 1)]


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


@strokes.styled
def draw_joint_grid(lengths, limits, counts=(9, 7), chosen=(6, 4), ax=None, *, cells=False):
    """A grid of joint values, and its image: the points that the hand of an RR arm reaches with them.

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
    lengths, limits = strokes.as_lengths(lengths, "lengths", (2,)), _joint_limits(limits)
    n, m = counts = tuple(int(c) for c in strokes.as_numbers(counts, "counts", (2,)))
    i, j = (int(c) for c in strokes.as_numbers(chosen, "chosen", (2,)))
    if min(counts) < 2 or not (1 <= i <= n and 1 <= j <= m):
        raise ValueError("counts: at least 2 values per joint; chosen: a pair (i, j) of the grid, counted from 1")
    joints, plane = _pair_of_axes(ax, (8.6, 4.1))
    t1, t2 = (np.linspace(*limits[k], counts[k]) for k in (0, 1))
    fine = [np.linspace(*limits[k], 60) for k in (0, 1)]
    row, column = strokes.AXIS_COLOURS["x"], strokes.AXIS_COLOURS["z"]
    for k, values in enumerate((t1, t2)):
        for value in values:
            marked = value == (t1[i - 1], t2[j - 1])[k] and not cells
            ends = ([value], fine[1]) if k == 0 else (fine[0], [value])
            pen = (
                (column if k == 0 else row, 2.2, strokes.AXIS_DASHES["z" if k == 0 else "x"])
                if marked
                else (strokes.FAINT, 0.9, "-")
            )
            style = {"color": pen[0], "lw": pen[1], "ls": pen[2], "zorder": 3 if marked else 1}
            joints.plot(*np.degrees(np.broadcast_arrays(*ends)), **style)
            plane.plot(*rr_points(lengths, *ends).reshape(-1, 2).T, **style)
    dots = {"ls": "none", "marker": "o", "ms": 3.2, "color": strokes.INK, "zorder": 4}
    joints.plot(*np.degrees([mesh.ravel() for mesh in np.meshgrid(t1, t2)]), **dots)
    plane.plot(*rr_points(lengths, t1, t2).reshape(-1, 2).T, **dots)
    if cells:
        _shade_cells(joints, plane, lengths, t1[i - 1 : i + 1] if i < n else t1[-2:], t2)
    else:
        _mark_pair(joints, plane, lengths, t1[i - 1], t2[j - 1])
    strokes.show_plane(plane)
    _joint_plane(joints, limits)
    joints.set_title("joint values", fontsize=10)
    plane.set_title("their image", fontsize=10)
    strokes.leave_room(plane, 0.08 * lengths.sum())
    return plane


def _shade_cells(joints, plane, lengths, t1, t2):
    for k, values in enumerate(itertools.pairwise(t2)):
        shade = ("#9fc6de", "#f0b692")[k % 2]
        cell = np.array([t1, values])
        corner, (width, height) = np.degrees(cell[:, 0]), np.degrees(np.ptp(cell, axis=1))
        joints.add_patch(Rectangle(corner, width, height, facecolor=shade, edgecolor=strokes.INK, lw=0.8, zorder=2))
        plane.add_patch(Polygon(_image_of_rim(lengths, cell), facecolor=shade, edgecolor=strokes.INK, lw=0.8, zorder=2))


def _mark_pair(joints, plane, lengths, t1, t2):
    pair, point = np.degrees([t1, t2]), rr_points(lengths, [t1], [t2])[0, 0]
    for axes, at, name, aside in (
        (joints, pair, r"$(\theta_{1,i},\ \theta_{2,j})$", (10, 9)),
        (plane, point, "$p_{ij}$", (-30, 4)),
    ):
        axes.plot(*at, "o", ms=10, mfc="white", mec=strokes.INK, mew=1.6, zorder=6)
        axes.annotate(
            name, at, xytext=aside, textcoords="offset points", fontsize=12, path_effects=strokes.halo(), zorder=9
        )
    elbow = lengths[0] * strokes.unit_vector(t1)
    strokes.arm(plane, [np.zeros(2), elbow, point], strokes.POSTURE_SHADES[0], zorder=4.5, width=8)


@strokes.styled
def draw_clouds(clouds, lengths=None, limits=None, ax=None, *, size=2.0):
    """Clouds of points side by side at one scale, each over the workspace of an RR arm, if one is given.

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
        axes.plot(*strokes.as_numbers(points, title, (None, 2)).T, ".", ms=size, color=strokes.INK, zorder=4)
        axes.set_title(title, fontsize=10)
        strokes.show_plane(axes)
        strokes.joint(axes, (0, 0), size=6)
        axes.margins(0.07)
    for axes in panels[1:]:
        axes.set_ylabel("")
    return panels[-1]


def _fill_workspace(ax, lengths, limits, colour="#e3e3e3"):
    limits = [(-np.pi, np.pi)] * 2 if limits is None else limits
    for piece in _one_bend(_joint_limits(limits)):
        ax.add_patch(Polygon(_image_of_rim(lengths, piece), closed=True, facecolor=colour, edgecolor="none", zorder=1))


def _one_bend(limits) -> list[np.ndarray]:
    """The limits cut where the elbow is straight: within each piece the map from joint values to points is one to one."""
    cuts = [limits[1, 0], *[s for s in _straight_angles(limits[1]) if limits[1, 0] < s < limits[1, 1]], limits[1, 1]]
    return [np.array([limits[0], piece]) for piece in itertools.pairwise(cuts)]


def _image_of_rim(lengths, limits, step=0.02) -> np.ndarray:
    """Image of the rim of the rectangle of joint values: the outline of one sheet, shape (k, 2)."""
    t1, t2 = (np.linspace(*row, max(2, int(np.ptp(row) / step))) for row in limits)
    sides = [
        rr_points(lengths, t1, t2[:1])[:, 0],
        rr_points(lengths, t1[-1:], t2)[0],
        rr_points(lengths, t1[::-1], t2[-1:])[:, 0],
        rr_points(lengths, t1[:1], t2[::-1])[0],
    ]
    return np.vstack(sides)


# ---------------------------------------------------------------- radius, area, sheets


@strokes.styled
def draw_radius(lengths, t2_limits=None, ax=None):
    """Distance of the hand from the base against the elbow angle, with the range that the joint limits leave.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    t2_limits : array-like, shape (2,), in radians, optional

    Returns
    -------
    matplotlib Axes
    """
    l1, l2 = strokes.as_lengths(lengths, "lengths", (2,))
    ax = ax or strokes.new_axes((5.8, 3.5))
    turn = np.linspace(-np.pi, np.pi, 361)

    def radius(t2):
        return np.sqrt(l1**2 + l2**2 + 2 * l1 * l2 * np.cos(t2))

    ax.plot(np.degrees(turn), radius(turn), color=strokes.SOFT, lw=1.4, zorder=2)
    ax.set(xlabel=r"$\theta_2$ (degrees)", ylabel="distance $r$ from the base (m)", xlim=(-180, 180))
    ax.set_ylim(0, 1.15 * (l1 + l2))
    ax.set_xticks(range(-180, 181, 60))
    ax.grid(True)
    for r, name in ((l1 + l2, "$L_1 + L_2$"), (abs(l1 - l2), "$|L_1 - L_2|$")):
        ax.axhline(r, color=strokes.SOFT, lw=0.9, ls=(0, (5, 2)), zorder=1)
        ax.annotate(name, (-176, r), xytext=(0, 3), textcoords="offset points", fontsize=9, color="#555555")
    if t2_limits is not None:
        low, high = strokes.as_numbers(t2_limits, "t2_limits", (2,))
        if not -np.pi - 1e-9 <= low < high <= np.pi + 1e-9:
            raise ValueError("t2_limits: expected (min, max) between -pi and pi, min below max")
        inside = np.linspace(low, high, 200)
        r = radius(np.append(inside, [s for s in (0.0,) if low <= s <= high]))
        ax.axvspan(*np.degrees([low, high]), color="#f1f1f1", zorder=0)
        ax.plot(np.degrees(inside), radius(inside), color=strokes.INK, lw=3, zorder=3)
        for value, name in ((r.max(), r"r_\mathrm{max}"), (r.min(), r"r_\mathrm{min}")):
            ax.plot([np.degrees(low), 180], [value] * 2, color=strokes.INK, lw=1, ls=(0, (2, 2)), zorder=2)
            ax.annotate(
                f"${name}$ = {value:.3f} m",
                (180, value),
                xytext=(5, 0),
                textcoords="offset points",
                va="center",
                annotation_clip=False,
            )
    return ax


@strokes.styled
def draw_sheets(lengths, limits, ax=None):
    """The workspace of an RR arm as one sheet per sense of the elbow; where both lie, their hatches cross.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
        Rows (min, max) of t1 and t2.

    Returns
    -------
    matplotlib Axes
    """
    lengths, limits = strokes.as_lengths(lengths, "lengths", (2,)), _joint_limits(limits)
    ax = ax or strokes.new_axes((5.0, 4.6))
    shown = {}
    for piece in _one_bend(limits)[::-1]:
        bend = 1 if np.sin(piece[1].mean()) > 0 else -1
        tint, hatch = SHEETS[bend]
        outline = _image_of_rim(lengths, piece)
        pen = {"closed": True, "hatch": hatch, "edgecolor": "#777777", "lw": 0, "zorder": 1.5}
        shown[bend] = ax.add_patch(Polygon(outline, facecolor=(*_rgb(tint), 0.6), **pen))
        _trace_rim(ax, lengths, piece, limits)
    ax.legend(
        shown.values(),
        [rf"$\theta_2 {'>' if bend > 0 else '<'} 0$" for bend in shown],
        loc="upper center",
        bbox_to_anchor=(0.5, -0.13),
        ncols=2,
    )
    strokes.show_plane(ax)
    strokes.joint(ax, (0, 0))
    ax.autoscale_view()
    ax.margins(0.06)
    return ax


def _rgb(colour):
    return tuple(int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))


@strokes.styled
def mark_edges(ax, lengths, limits):
    """Edges of the workspace of an RR arm, those inside it too: bold where the elbow is straight, thin at a stop.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
        Rows (min, max) of t1 and t2.
    """
    limits = _joint_limits(limits)
    for piece in _one_bend(limits):
        _trace_rim(ax, lengths, piece, limits)
    return ax


def _trace_rim(ax, lengths, piece, limits):
    """Edges of one sheet: singular arcs (straight elbow) bold, edges made by joint limits thin."""
    t1, t2 = (np.linspace(*row, 200) for row in piece)
    for value in piece[1]:
        straight = abs(np.sin(value)) < 1e-9
        ax.plot(*rr_points(lengths, t1, [value])[:, 0].T, color=strokes.INK, lw=2.6 if straight else 1.1, zorder=3)
    if not _is_full_turn(limits[0]):
        for value in piece[0]:
            ax.plot(*rr_points(lengths, [value], t2)[0].T, color=strokes.INK, lw=1.1, zorder=3)


# ---------------------------------------------------------------- postures and singularities


@strokes.styled
def draw_posture_count(lengths, limits, point=None, ax=None):
    """How many postures reach each point of the plane within the joint limits, and what the edges are made of.

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
    lengths, limits = strokes.as_lengths(lengths, "lengths", (2,)), _joint_limits(limits)
    reach = 1.06 * lengths.sum()
    ax = ax or strokes.new_axes((5.0, 4.9))
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
        goal = strokes.as_numbers(point, "point", (2,))
        for k, (t1, _t2) in enumerate(_postures(lengths, limits, goal)):
            elbow = lengths[0] * strokes.unit_vector(t1)
            strokes.arm(ax, [np.zeros(2), elbow, goal], ("#f6f6f6", "#c4c4c4")[k], zorder=4 + k, width=8)
        strokes.target_mark(ax, goal)
    boxes = [Rectangle((0, 0), 1, 1, facecolor=shade, edgecolor=strokes.INK) for shade in COUNT_SHADES[1:]]
    lines = [plt.Line2D([], [], color=strokes.INK, lw=width) for width in (2.6, 1.1)]
    names = ["one posture", "two postures", "singular: elbow straight", "joint at its limit"]
    ax.legend([*boxes, *lines], names, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, handlelength=1.6)
    strokes.show_plane(ax)
    strokes.joint(ax, (0, 0))
    ax.set_xlim(-reach, reach)
    ax.set_ylim(-reach, reach)
    return ax


def _postures(lengths, limits, goal) -> list[tuple[float, float]]:
    l1, l2 = lengths
    cosine = (goal @ goal - l1**2 - l2**2) / (2 * l1 * l2)
    if abs(cosine) > 1:
        return []
    found = []
    for t2 in (np.arccos(cosine), -np.arccos(cosine)):
        t1 = np.arctan2(goal[1], goal[0]) - np.arctan2(l2 * np.sin(t2), l1 + l2 * np.cos(t2))
        if _within(t1, limits[0]) and _within(t2, limits[1]):
            found.append((t1, t2))
    return found


@strokes.styled
def draw_posture_change(lengths, start, end, ax=None):
    """From one posture to another along a straight line of joint values: the aspects, and the way of the hand.

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
    lengths = strokes.as_lengths(lengths, "lengths", (2,))
    ends = [strokes.as_numbers(q, name, (2,)) for q, name in ((start, "start"), (end, "end"))]
    joints, plane = _pair_of_axes(ax, (8.6, 4.3))
    for low, bend in ((0, 1), (-180, -1)):
        tint, hatch = SHEETS[bend]
        joints.add_patch(
            Rectangle(
                (-180, low), 360, 180, facecolor=tint, edgecolor="#ffffff", hatch=hatch, lw=0, alpha=0.75, zorder=0
            )
        )
        strokes.write(joints, (-95, low + 90), rf"aspect $\sin\theta_2 {'>' if bend > 0 else '<'} 0$", fontsize=10)
    for value in (-180, 0, 180):
        joints.plot([-180, 180], [value] * 2, color=strokes.INK, lw=2.6, zorder=2, clip_on=False)
    inner, outer = abs(lengths[0] - lengths[1]), lengths.sum()
    plane.add_patch(Circle((0, 0), outer, facecolor="#eeeeee", edgecolor=strokes.INK, lw=2.6, zorder=1))
    plane.add_patch(Circle((0, 0), inner, facecolor="white", edgecolor=strokes.INK, lw=2.6, zorder=1.1))
    way = np.linspace(*ends, 120)
    hands = np.array([rr_points(lengths, [t1], [t2])[0, 0] for t1, t2 in way])
    pen = {"color": strokes.AXIS_COLOURS["z"], "lw": 2, "ls": strokes.AXIS_DASHES["z"], "zorder": 6}
    joints.plot(*np.degrees(way).T, **pen)
    plane.plot(*hands.T, **pen)
    if ends[0][1] * ends[1][1] < 0:
        k = int(np.argmin(np.abs(way[:, 1])))
        joints.plot(*np.degrees(way[k]), "D", ms=7, mfc="white", mec=strokes.INK, zorder=7)
        plane.plot(*hands[k], "D", ms=7, mfc="white", mec=strokes.INK, zorder=7)
    for k, (q, name) in enumerate(zip(ends, "AB")):
        elbow = lengths[0] * strokes.unit_vector(q[0])
        hand = hands[-k]
        strokes.arm(plane, [np.zeros(2), elbow, hand], ("#f6f6f6", "#b9b9b9")[k], zorder=3 + k, width=9)
        plane.annotate(name, elbow, xytext=(9 * np.sign(elbow[0] - 0.6 * hand[0]), 8), textcoords="offset points",
                       fontweight="bold", path_effects=strokes.halo(), zorder=9)  # fmt: skip
        joints.plot(*np.degrees(q), "o", ms=8, mfc=("#f6f6f6", "#b9b9b9")[k], mec=strokes.INK, mew=1.4, zorder=7)
        joints.annotate(
            name,
            np.degrees(q),
            xytext=(9, -4),
            textcoords="offset points",
            fontweight="bold",
            path_effects=strokes.halo(),
            zorder=9,
        )
    _joint_plane(joints, np.array([[-np.pi, np.pi]] * 2), 0.02)
    joints.set_xticks(range(-180, 181, 90))
    joints.set_yticks(range(-180, 181, 90))
    strokes.show_plane(plane)
    plane.set_xlim(-1.06 * outer, 1.06 * outer)
    plane.set_ylim(-1.06 * outer, 1.06 * outer)
    return plane


@strokes.styled
def draw_dexterous(lengths, ax=None):
    """Planar arm with a hand: points reached in some direction of the hand, and those reached in every direction.

    Parameters
    ----------
    lengths : array-like, shape (3,), in metres
        Upper arm, forearm, hand.

    Returns
    -------
    matplotlib Axes
    """
    l1, l2, l3 = lengths = strokes.as_lengths(lengths, "lengths", (3,))
    inner, outer = abs(l1 - l2), l1 + l2
    ax = ax or strokes.new_axes((5.0, 4.9))
    total = lengths.sum()
    r = np.linspace(0, total, 2001)
    # The wrist lies on a circle of radius l3 about the point: its distances run from |r - l3| to r + l3.
    some = (np.abs(r - l3) <= outer) & (r + l3 >= inner)
    every = (np.abs(r - l3) >= inner) & (r + l3 <= outer)
    kinds = ((some, "#e9e9e9", "reachable: in some direction"), (every, "#a6a6a6", "dexterous: in every direction"))
    for mask, shade, name in kinds:
        for k, (low, high) in enumerate(_runs(r, mask)):
            pen = {"facecolor": shade, "edgecolor": strokes.INK, "lw": 1.4, "zorder": 1}
            ring = ax.add_patch(Wedge((0, 0), high, 0, 360, width=high - low if low > 1e-6 else None, **pen))
            ring.set_label("_" + name if k else name)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, handlelength=1.6, columnspacing=1.2)
    strokes.show_plane(ax)
    strokes.joint(ax, (0, 0))
    ax.set_xlim(-1.06 * total, 1.06 * total)
    ax.set_ylim(-1.06 * total, 1.06 * total)
    return ax


def _runs(values, mask) -> list[tuple[float, float]]:
    """Ends of the stretches of `values` on which `mask` holds, outermost first."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    return [(values[a], values[b - 1]) for a, b in zip(edges[::2], edges[1::2])][::-1]


# ---------------------------------------------------------------- spatial arms


def _arm_in_section(lengths, q2, q3):
    elbow = lengths[0] * strokes.unit_vector(q2)
    return [np.zeros(2), elbow, elbow + lengths[1] * strokes.unit_vector(q2 + q3)]


@strokes.styled
def draw_section(lengths, limits, q=None, ax=None, *, names=True):
    """Section of the workspace of the elbow arm (3R) with a half-plane through axis 1: distance and height.

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
    lengths, limits = strokes.as_lengths(lengths, "lengths", (2,)), _joint_limits(limits)
    inner, outer = abs(lengths[0] - lengths[1]), lengths.sum()
    ax = ax or strokes.new_axes((4.9, 5.2))
    for piece in _one_bend(limits):
        for t2 in _parts_in_front(lengths, piece):
            ax.add_patch(Polygon(t2, closed=True, facecolor="#d6d6d6", edgecolor="none", zorder=1))
        _trace_rim(ax, lengths, piece, limits)
    turn = np.linspace(-np.pi / 2, np.pi / 2, 200)
    for radius, name in ((outer, "stretched"), (inner, "folded")):
        if radius < 1e-9:
            continue
        ax.plot(radius * np.cos(turn), radius * np.sin(turn), color=strokes.SOFT, lw=1, ls=(0, (5, 2)), zorder=0.8)
        if names:
            strokes.write(
                ax,
                radius * strokes.unit_vector(-1.3) + (0.02 * outer, -0.05 * outer),
                name,
                fontsize=9,
                color="#555555",
                ha="left",
            )
    ax.plot(
        [0, 0], [-1.08 * outer, 1.12 * outer], color=strokes.AXIS_COLOURS["z"], lw=1.4, ls=strokes.CENTRE_LINE, zorder=2
    )
    if names:
        strokes.write(ax, (0, 1.17 * outer), "axis 1", fontsize=10, color=strokes.AXIS_COLOURS["z"])
    if q is not None:
        q2, q3 = strokes.as_numbers(q, "q", (2,))
        points = _arm_in_section(lengths, q2, q3)
        strokes.arm(ax, points, strokes.POSTURE_SHADES[0], zorder=4, width=9)
        ax.plot(*points[-1], "o", ms=7, color=strokes.INK, zorder=6)
        ax.plot([0, 0.45 * lengths[0]], [0, 0], color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=3)
        strokes.angle_arc(ax, (0, 0), 0.36 * lengths[0], 0, q2, r"\theta_2", 1.35)
        ax.plot(
            *zip(points[1], points[1] + 0.45 * lengths[1] * strokes.unit_vector(q2)),
            color=strokes.SOFT,
            lw=1,
            ls=strokes.CENTRE_LINE,
            zorder=3,
        )
        strokes.angle_arc(ax, points[1], 0.36 * lengths[1], q2, q3, r"\theta_3", 1.4)
    strokes.show_plane(ax, labels=(r"distance $\rho$ from axis 1 (m)", "height $z$ (m)"))
    strokes.joint(ax, (0, 0))
    ax.set_xlim(-0.12 * outer, 1.08 * outer)
    ax.set_ylim(-1.1 * outer, 1.24 * outer)
    return ax


def _parts_in_front(lengths, piece):
    """The outline of one sheet of the section; what falls behind axis 1 is turned round it to the front."""
    rim = _image_of_rim(lengths, piece)
    if (rim[:, 0] >= -1e-9).all():
        return [rim]
    front, back = rim.copy(), rim * (-1, 1)
    front[:, 0], back[:, 0] = np.maximum(front[:, 0], 0), np.maximum(back[:, 0], 0)
    return [front, back]


@strokes.styled
def draw_elbow_workspace(lengths, limits, t1_limits=(np.radians(-210), np.radians(60)), q=None, ax=None):
    """The workspace of the elbow arm in space: its section turned about axis 1, cut open.

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
    lengths, limits = strokes.as_lengths(lengths, "lengths", (2,)), _joint_limits(limits)
    low, high = strokes.as_numbers(t1_limits, "t1_limits", (2,))
    rim = _image_of_rim(lengths, limits, 0.09)
    own, ax = ax is None, ax or strokes.new_axes_3d(elev=28, azim=-62)
    turns = np.linspace(low, high, max(3, int((high - low) / 0.12)))

    def turned(points, angle):
        return np.column_stack([points[:, 0] * np.cos(angle), points[:, 0] * np.sin(angle), points[:, 1]])

    strips = [turned(rim, angle) for angle in turns]
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
        face = turned(rim, angle)
        ax.add_collection3d(
            Poly3DCollection(
                [face], facecolors="#b5b5b5", edgecolors=strokes.INK, linewidths=1.3, alpha=0.8, zorder=1.5
            ),
            autolim=False,
        )
    top = 1.15 * max(rim[:, 1].max(), 0.2 * lengths.sum())
    bottom = min(rim[:, 1].min(), -0.25 * lengths.sum())
    ax.plot([0, 0], [0, 0], [bottom, top], color=strokes.AXIS_COLOURS["z"], lw=1.3, ls=strokes.CENTRE_LINE, zorder=2)
    strokes.write_3d(ax, (0, 0, top + 0.06 * lengths.sum()), "axis 1", color=strokes.AXIS_COLOURS["z"], fontsize=10)
    if q is not None:
        t1, t2, t3 = strokes.as_numbers(q, "q", (3,))
        points = turned(np.array(_arm_in_section(lengths, t2, t3)), t1)
        for pen, width in ((strokes.INK, 8), ("#f2f2f2", 5.5)):
            ax.plot(*points.T, color=pen, lw=width, solid_capstyle="round", solid_joinstyle="round", zorder=4)
        ax.plot(*points.T, "o", ms=4.5, color=strokes.INK, ls="none", zorder=5)
    strokes.fit_3d(ax, np.vstack([*strips, [(0, 0, bottom), (0, 0, top * 1.1)]]), own)
    return ax
