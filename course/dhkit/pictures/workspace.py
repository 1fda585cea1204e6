"""A student's result on workspaces: clouds, limits of reach, areas, numbers of postures, a section."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.colors import ListedColormap
from matplotlib.patches import Polygon, Rectangle

from ..drawing.elbow_workspace import draw_section
from ..drawing.inputs import as_numbers
from ..drawing.planar import mark_target
from ..drawing.planar_2r import hand_distance
from ..drawing.strokes import show_plane
from ..drawing.style import AXIS_COLOURS, INK, SOFT
from ..drawing.workspace import COUNT_SHADES, draw_clouds, mark_edges
from ..planar_arms import stations
from .own_result import called, numbers, own_result

INDEXED = ("t1i", "t1j", "t2i", "t2j", "L1", "L2")


@own_result
def show_point_function(point, lengths, limits, count=24):
    """Show the cloud that a point function gives for all pairs (i, j), over the workspace of the arm.

    Parameters
    ----------
    point : 2 entries in t1i, t1j, t2i, t2j, L1, L2
    lengths : (float, float), in metres
    limits : rows (min, max) of t1 and t2, in radians
    count : int
        Number of values of each joint.

    Returns
    -------
    matplotlib Axes
    """
    numbers(point, "point", (2,), dict.fromkeys(INDEXED, 0.5))  # refuses another form in words
    entries = [sympy.sympify(entry) for entry in np.ravel(np.array(point, dtype=object))]
    values = [np.linspace(*row, count) for row in limits]
    given = [values[0][:, None], values[0][None], values[1][:, None], values[1][None], *lengths]
    functions = [sympy.lambdify([sympy.Symbol(name) for name in INDEXED], entry, "numpy") for entry in entries]
    cloud = np.stack([np.broadcast_to(function(*given), (count, count)) for function in functions], axis=-1)
    distinct = len(np.unique(cloud.reshape(-1, 2).round(9), axis=0))
    return draw_clouds({f"{count} x {count} pairs, {distinct} different points": cloud}, lengths, limits, size=3)


@own_result
def show_cloud(points, outline):
    """Show a cloud of points over the workspace of an arm.

    Parameters
    ----------
    points : array-like, shape (k, 2), in metres
    outline : array-like, shape (n, 2), in metres

    Returns
    -------
    matplotlib Axes
    """
    points = as_numbers(points, "cloud", (None, 2))
    ax = _with_outline(outline)
    ax.plot(*points.T, ".", ms=2, color=INK, zorder=3)
    ax.set_title(f"your {len(points)} points", fontsize=10)
    return ax


def _with_outline(outline):
    """A plane with the workspace in grey."""
    ax = plt.subplots(figsize=(6.4, 4.6))[1]
    show_plane(ax)
    ax.add_patch(Polygon(outline, facecolor="#e3e3e3", edgecolor=INK, lw=1.0, zorder=1))
    ax.plot(0, 0, "o", color=INK)
    ax.autoscale_view()
    ax.margins(0.06)
    return ax


@own_result
def show_reach_range(reach, lengths, ranges=((0.5, 2.4), (-1.2, 2.2), (1.8, 4.4))):
    """Show the reach that a function returns for some ranges of t2, as lines over the curve of the distance.

    Parameters
    ----------
    reach : function (L1, L2, t2_min, t2_max) -> [r_min, r_max]
    lengths : (float, float), in metres
    ranges : sequence of (min, max), in radians

    Returns
    -------
    matplotlib Axes
        The last one.
    """
    found = [numbers(called(reach, *lengths, *row), "reach", (2,), {}) for row in ranges]
    panels = plt.subplots(1, len(ranges), figsize=(3.3 * len(ranges), 3.1), sharey=True, layout="constrained")[1]
    turn = np.linspace(-np.pi, 2 * np.pi, 400)
    for ax, (low, high), limits in zip(panels, ranges, found):
        distance = hand_distance(lengths, turn)
        inside = (turn >= low) & (turn <= high)
        ax.plot(np.degrees(turn), distance, color=SOFT, lw=1.2)
        ax.plot(np.degrees(turn[inside]), distance[inside], color=INK, lw=3)
        ax.axvspan(*np.degrees([low, high]), color="#f1f1f1", zorder=0)
        for value, dashes in zip(limits, ((0, (5, 2)), "-")):
            ax.axhline(value, color=AXIS_COLOURS["x"], lw=1.5, ls=dashes)
        ax.set_title(f"{np.degrees(low):.0f}° to {np.degrees(high):.0f}°".replace("-", "\N{MINUS SIGN}"), fontsize=10)
        ax.set(xlabel=r"$\theta_2$ (degrees)", ylim=(0, 1.2 * sum(lengths)), xticks=range(-180, 361, 180))
    panels[0].set_ylabel("distance (m); your limits in orange")
    return panels[-1]


@own_result
def show_area(area, outline):
    """Show a square of the area of an answer beside the workspace, at the same scale.

    Parameters
    ----------
    area : number, in square metres
    outline : array-like, shape (n, 2), in metres

    Returns
    -------
    matplotlib Axes
    """
    area = float(numbers(area, "area", (), {}))
    if area <= 0:
        raise ValueError(f"an area is positive, found {area:.4g}")
    side, size = np.sqrt(area), float(np.ptp(outline, axis=0).max())
    if side > 20 * size:
        raise ValueError(f"{area:.4g} square metres: a square of {side:.3g} m, far larger than the arm reaches")
    ax = _with_outline(outline)
    left, middle = float(np.max(outline, axis=0)[0]) + 0.15 * size, float(np.mean(outline, axis=0)[1])
    ax.add_patch(Rectangle((left, middle - side / 2), side, side, facecolor="#efe3c4", edgecolor=INK, lw=1.4, zorder=2))
    ax.text(left, middle + side / 2, f"your {area:.3f} m²", va="bottom", zorder=3)
    ax.autoscale_view()
    return ax


@own_result
def show_base(places, mine):
    """Show an RR arm's base at two places on its wall, what it reaches from there, and the stations.

    Parameters
    ----------
    places : 2 numbers [leftmost, rightmost], in metres
    mine : mapping
        L1, L2 in metres; t2_min, t2_max in degrees.

    Returns
    -------
    matplotlib Axes
        Every station belongs between both circles of both places, and at each place one of them on a circle.
    """
    found = numbers(places, "base", (2,), {})
    ax = plt.subplots(figsize=(6.4, 4.6))[1]
    show_plane(ax)
    half_turn = np.linspace(0, np.pi, 120)
    for x, dashes, colour in zip(found, ((0, (5, 2)), "-"), (AXIS_COLOURS["z"], AXIS_COLOURS["x"])):
        for stop in ("t2_min", "t2_max"):
            radius = abs(mine["L1"] + mine["L2"] * np.exp(1j * np.radians(mine[stop])))
            ax.plot(x + radius * np.cos(half_turn), radius * np.sin(half_turn), color=colour, lw=1.4, ls=dashes)
        ax.plot(x, 0, "s", color=colour, ms=7, zorder=4)
    ax.axhline(0, color=INK, lw=1.2)
    for name, (x, y) in stations(mine).items():
        ax.plot(x, y, "o", color=INK, zorder=4)
        ax.annotate(f"${name}$", (x, y), xytext=(6, 5), textcoords="offset points")
    return ax


@own_result
def show_count(count, lengths, limits):
    """Show how many postures a function finds over the plane, with the edges of the arm's sheets on top.

    Parameters
    ----------
    count : function (x, y, lengths, limits) -> number
    lengths : (float, float), in metres
    limits : rows (min, max) of t1 and t2, in radians

    Returns
    -------
    matplotlib Axes
    """
    reach = 1.06 * sum(lengths)
    side = np.linspace(-reach, reach, 42)
    lengths, limits = [float(length) for length in lengths], np.array(limits, float).tolist()
    found = np.array([[_counted(count, x, y, lengths, limits) for x in side] for y in side])
    odd = ~np.isin(found, (0, 1, 2))
    ax = plt.subplots(figsize=(5.2, 4.9))[1]
    step = side[1] - side[0]
    extent = (-reach - step / 2, reach + step / 2) * 2
    ax.imshow(np.where(odd, 0, found), extent=extent, origin="lower", cmap=ListedColormap(COUNT_SHADES), vmin=0, vmax=2)
    if odd.any():
        rows, columns = np.nonzero(odd)
        ax.plot(side[columns], side[rows], "x", ms=4, color=AXIS_COLOURS["x"], label="neither 0, 1 nor 2")
    mark_edges(ax, lengths, limits)
    show_plane(ax)
    for shade, name in zip(COUNT_SHADES[1:], ("one posture", "two postures")):
        ax.add_patch(Rectangle((9, 9), 1, 1, facecolor=shade, edgecolor=INK, label=name))
    ax.set_xlim(extent[:2])
    ax.set_ylim(extent[:2])
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=3, handlelength=1.4, columnspacing=1.2)
    return ax


def _counted(count, x, y, lengths, limits) -> float:
    return float(
        numbers(called(count, float(x), float(y), list(lengths), [list(row) for row in limits]), "count", (), {})
    )


@own_result
def show_section(section, values: dict[str, float]):
    """Show a point [rho, z] over the elbow arm in the posture given by `values`; the cross belongs on the hand.

    Parameters
    ----------
    section : 2 entries in t2, t3, L1, L2
    values : dict
        Numbers for t2, t3 (radians), L1, L2 (metres).

    Returns
    -------
    matplotlib Axes
    """
    at = numbers(section, "section", (2,), values)
    around = [(values[name] - 0.02, values[name] + 0.02) for name in ("t2", "t3")]
    ax = draw_section((values["L1"], values["L2"]), around, (values["t2"], values["t3"]), names=False)
    return mark_target(ax, at, "your result")


@own_result
def show_pallet(distances, mine):
    """Show a pallet at two distances from the base of one's own arm, and what the arm reaches.

    Parameters
    ----------
    distances : 2 numbers [nearest, farthest], in metres
        Of the pallet's near edge from the base.
    mine : mapping
        L1, L2, wide, deep in metres; t2_min, t2_max in degrees.

    Returns
    -------
    matplotlib Axes
        The first pallet touches the inner circle, the second one the outer.
    """
    found = numbers(distances, "pallet", (2,), {})
    ax = plt.subplots(figsize=(5.2, 4.4))[1]
    ax.set_aspect("equal")
    half_turn = np.linspace(0, np.pi, 120)
    for angle, dashes in ((mine["t2_max"], (0, (5, 2))), (mine["t2_min"], "-")):
        radius = abs(mine["L1"] + mine["L2"] * np.exp(1j * np.radians(angle)))
        ax.plot(radius * np.cos(half_turn), radius * np.sin(half_turn), color=INK, lw=1.2, ls=dashes)
    for near, dashes in zip(found, ((0, (5, 2)), "-")):
        corner = (-mine["wide"] / 2, near)
        ax.add_patch(Rectangle(corner, mine["wide"], mine["deep"], fill=False, ec=AXIS_COLOURS["x"], lw=1.6, ls=dashes))
    ax.plot(0, 0, "o", color=INK)
    ax.set(xlabel="x (m)", ylabel="y (m)")
    return ax
