"""Strokes in space: labels, arrows, arcs, dimensions, marks and prisms.

Points are in metres, angles in radians; sizes of pens, markers and text are in points of print.
"""

from __future__ import annotations

import numpy as np
from matplotlib.colors import LightSource
from matplotlib.patches import FancyArrowPatch
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ..geometry import unit_vector
from .style import HALO, INK, SOFT


class _Arrow3D(FancyArrowPatch):
    """An arrow between two points in space with a head of constant size on paper."""

    def __init__(self, start, end, **options):
        super().__init__((0, 0), (0, 0), shrinkA=0, shrinkB=0, **options)
        self._ends = np.array([start, end], dtype=float).T

    def do_3d_projection(self, renderer=None):
        xs, ys, zs = proj3d.proj_transform(*self._ends, self.axes.get_proj())
        self.set_positions((xs[0], ys[0]), (xs[1], ys[1]))
        return float(np.min(zs))


def draw_arrow_3d(ax, start, end, colour=INK, dashes="-", width=1.6, zorder=6, style="-|>", scale=11):
    """Arrow between two points; its shaft may be dashed."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    neck = start + 0.85 * (end - start)
    if style == "-|>":
        ax.plot(*zip(start, neck), color=colour, lw=width, ls=dashes, zorder=zorder)
        start = start + 0.6 * (end - start)
    arrow = _Arrow3D(start, end, arrowstyle=style, mutation_scale=scale, color=colour, lw=width, zorder=zorder)
    if dashes != "-":
        arrow.set_linestyle("none")
    ax.add_patch(arrow)


def write_3d(ax, at, text, **options):
    """A label centred at a point."""
    options = {"ha": "center", "va": "center", "fontsize": 11, "zorder": 9} | options
    ax.text(*at, text, path_effects=HALO, **options)


def draw_dimension_3d(ax, start, end, shift, label):
    """Dimension line from `start` to `end`, moved by the vector `shift`."""
    a, b = start + np.array(shift), end + np.array(shift)
    for foot, point in ((start, a), (end, b)):
        ax.plot(*zip(foot, point + 0.1 * np.array(shift)), color=SOFT, lw=0.7, zorder=4)
    draw_arrow_3d(ax, a, b, width=0.9, style="<|-|>", scale=8)
    write_3d(ax, (a + b) / 2, f"${label}$")


def arc_points(centre, radius, start, side, turn) -> np.ndarray:
    """Points of an arc.

    Parameters
    ----------
    centre : array-like, shape (3,), in metres
    radius : float, in metres
    start, side : array-like, shape (3,)
        Unit vectors at right angles: where the arc begins, and towards where it runs.
    turn : array-like, shape (n,), in radians
        Angles from `start`.

    Returns
    -------
    ndarray, shape (n, 3), in metres
    """
    return centre + radius * (unit_vector(turn) @ [start, side])


def draw_angle_3d(ax, centre, start, side, radius, sweep, label, away=1.3):
    """Arc with an arrow head over `sweep` radians, from the unit vector `start` towards the unit vector `side`."""
    arc = arc_points(centre, radius, start, side, np.linspace(0, sweep, 30))
    ax.plot(*arc[:-2].T, color=INK, lw=1.1, zorder=4)
    draw_arrow_3d(ax, arc[-4], arc[-1], width=1.1, scale=8, zorder=4)
    if label:
        write_3d(ax, arc_points(centre, away * radius, start, side, sweep / 2), f"${label}$")


def draw_target_3d(ax, at, colour=INK, zorder=7.0, width=1.3, size=13):
    """A cross in a circle of `size` points at a point."""
    for marker, across in (("o", size), ("+", 1.4 * size)):
        ax.plot(*np.asarray(at, float)[:, None], marker, ms=across, mfc="none", mec=colour, mew=width, zorder=zorder)


def draw_prism(ax, outline, low, high, shade=0.85, zorder=1.0):
    """Prism over a closed outline, shape (n, 2), between two heights."""
    outline = np.asarray(outline)
    bottom = np.column_stack([outline, np.full(len(outline), low)])
    top = np.column_stack([outline, np.full(len(outline), high)])
    sides = [[bottom[i], bottom[i + 1], top[i + 1], top[i]] for i in range(-1, len(outline) - 1)]
    light = LightSource(azdeg=225, altdeg=50)
    # One collection per polygon size: mplot3d pads mixed sizes with uninitialised numbers, which may overflow.
    for faces in (sides, [top]):
        paint = {"facecolors": str(shade), "linewidths": 0, "shade": True, "lightsource": light, "zorder": zorder}
        ax.add_collection3d(Poly3DCollection(faces, **paint), autolim=False)
    pen = {"color": INK, "lw": 0.7, "zorder": zorder + 0.01}
    ax.plot(*np.vstack([top, top[:1]]).T, **pen)
    seen = _walls_that_face(outline, ax.azim)
    for i in range(-1, len(outline) - 1):
        if seen[i]:
            ax.plot(*bottom[[i, i + 1]].T, **pen)
        if seen[i] != seen[i - 1]:
            ax.plot(*np.array([bottom[i], top[i]]).T, **pen)


def _walls_that_face(outline, azim) -> np.ndarray:
    """For each edge of a counter-clockwise outline: does the wall on it face a viewer at `azim` degrees?"""
    edges = np.roll(outline, -1, axis=0) - outline
    return np.column_stack([edges[:, 1], -edges[:, 0]]) @ unit_vector(np.radians(azim)) > 0


def stadium_outline(start, end, radius, n=16) -> np.ndarray:
    """Outline of a link with round ends between two points of the plane: shape (2 n, 2), in metres."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    turn = np.arctan2(*(end - start)[::-1]) + np.linspace(np.pi / 2, 3 * np.pi / 2, n)
    return np.vstack([start + radius * unit_vector(turn), end + radius * unit_vector(turn + np.pi)])


def disc_outline(centre, radius, n=32) -> np.ndarray:
    """Outline of a round body about a point of the plane: shape (n, 2), in metres."""
    return np.asarray(centre) + radius * unit_vector(np.linspace(0, 2 * np.pi, n, endpoint=False))
