"""Strokes that the drawings are made of: one style, checked input, arrows, arcs, dimensions, joints, solids.

For authors of drawings; a notebook uses ``dhkit.drawing`` and ``dhkit.pictures``. Points are in metres,
angles in radians; sizes of pens and text are in points.
"""

from __future__ import annotations

from functools import wraps

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.colors import LightSource
from matplotlib.patches import Arc, FancyArrowPatch
from matplotlib.patheffects import withStroke
from mpl_toolkits.mplot3d import Axes3D, proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

INK = "#222222"
SOFT = "#8c8c8c"
FAINT = "#d4d4d4"
# Okabe-Ito colours: told apart with any common colour-blindness, and of different lightness in grey print.
AXIS_COLOURS = {"x": "#D55E00", "y": "#009E73", "z": "#0072B2"}
AXIS_DASHES = {"x": "-", "y": (0, (5, 1.5)), "z": (0, (6, 1.5, 1.2, 1.5))}
POSTURE_SHADES = ("#e9e9e9", "#a9a9a9", "#cfcfcf", "#8e8e8e")
CENTRE_LINE = (0, (9, 3, 2, 3))

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 10,
    "mathtext.fontset": "cm",
    "axes.edgecolor": SOFT,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 11,
    "axes.axisbelow": True,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
    "grid.color": "#ececec",
    "figure.dpi": 110,
    "savefig.dpi": 160,
    "savefig.bbox": "tight",
    "legend.frameon": False,
}


def styled(draw):
    """Run a drawing function in the style of the course, leaving the reader's own settings alone."""

    @wraps(draw)
    def in_style(*args, **kwargs):
        # Not rc_context: it would also undo the interactive mode that Jupyter's backend sets when the first figure
        # loads it, and no later figure would be shown.
        kept = {name: plt.rcParams[name] for name in STYLE}
        plt.rcParams.update(STYLE)
        try:
            return draw(*args, **kwargs)
        finally:
            plt.rcParams.update(kept)

    return in_style


def as_numbers(value, what: str, shape: tuple[int | None, ...]) -> np.ndarray:
    """`value` as a float array of `shape` (None: any size), or a `ValueError` that says what `what` must be."""
    form = " x ".join("n" if size is None else str(size) for size in shape)
    try:
        array = np.array(value.tolist() if isinstance(value, sympy.MatrixBase) else value, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{what}: expected {form} numbers, found {_short(value)}") from None
    fits = array.ndim == len(shape) and all(want in (None, have) for want, have in zip(shape, array.shape))
    if not fits:
        found = " x ".join(map(str, array.shape)) or "one number"
        raise ValueError(f"{what}: expected {form} numbers, found {found}")
    if not np.isfinite(array).all():
        raise ValueError(f"{what}: found a value that is not a finite number")
    return array


def _short(value) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def as_lengths(value, what: str, shape: tuple[int | None, ...]) -> np.ndarray:
    """`as_numbers`, all positive."""
    array = as_numbers(value, what, shape)
    if (array <= 0).any():
        raise ValueError(f"{what}: lengths must be positive, found {_short(value)}")
    return array


def in_degrees(angle: float) -> str:
    """An angle in radians as text in whole degrees, with a proper minus sign."""
    return f"{np.degrees(angle):.0f}°".replace("-", "\N{MINUS SIGN}")


# ---------------------------------------------------------------- in the plane


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


def halo():
    """White rim that keeps a label readable on top of lines."""
    return [withStroke(linewidth=3.2, foreground="white")]


def write(ax, at, text, **options):
    """A label centred at the point `at`."""
    options = {"ha": "center", "va": "center", "fontsize": 11, "zorder": 9} | options
    return ax.text(*at, text, path_effects=halo(), **options)


def unit_vector(angle: float) -> np.ndarray:
    """Direction of `angle` in the plane."""
    return np.array([np.cos(angle), np.sin(angle)])


def arrow(ax, start, end, colour=INK, width=1.6, style="-|>", dashes="-", zorder=6, neck=0.9):
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


def axis_arrow(ax, origin, angle, size, letter, label, away=0.2, neck=0.9):
    """Axis `letter` (x, y or z) of a frame, in its colour and dashes; the label stands `away` lengths past its tip."""
    end = np.asarray(origin) + size * unit_vector(angle)
    arrow(ax, origin, end, AXIS_COLOURS[letter], dashes=AXIS_DASHES[letter], neck=neck)
    if label:
        write(ax, end + away * size * unit_vector(angle), f"${label}$", color=AXIS_COLOURS[letter])


def dimension(ax, start, end, label, shift, beside=False):
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


def angle_arc(ax, centre, radius, start, sweep, label, away=1.28, colour=INK):
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


def link(ax, start, end, fill, width=13.0, zorder=3.0):
    """A link with round ends: an ink line under a lighter and thinner one."""
    xs, ys = zip(start, end)
    outline = ax.plot(xs, ys, color=INK, lw=width, solid_capstyle="round", zorder=zorder)[0]
    ax.plot(xs, ys, color=fill, lw=width - 2.4, solid_capstyle="round", zorder=zorder + 0.01)
    return outline


def joint(ax, at, zorder=4.5, size=8.0):
    """Revolute joint seen along its axis: a circle with a dot, the axis pointing to the reader."""
    ax.plot(*at, "o", ms=size, mfc="white", mec=INK, mew=1.3, zorder=zorder)
    ax.plot(*at, "o", ms=size * 0.26, color=INK, zorder=zorder)


def ground(ax, at, width, depth):
    """Hatched ground under the point `at`."""
    x, y = at
    ax.plot([x - width / 2, x + width / 2], [y, y], color=INK, lw=1.4, zorder=2)
    for foot in np.linspace(x - width / 2 + depth, x + width / 2, 7):
        ax.plot([foot, foot - depth], [y, y - depth], color=INK, lw=0.8, zorder=2)


def target_mark(ax, at):
    """A cross in a circle."""
    ax.plot(*at, marker="o", ms=15, mfc="none", mec=INK, mew=1.3, zorder=7)
    ax.plot(*at, marker="+", ms=21, color=INK, mew=1.3, zorder=7)


def arm(ax, points, fill, zorder=3.0, width=13.0):
    """Links and joints through `points`, base first; returns the outline of the first link, for a legend."""
    outline = None
    for start, end in zip(points[-2::-1], points[:0:-1]):
        outline = link(ax, start, end, fill, width, zorder)
    for point in points[:-1]:
        joint(ax, point, zorder + 0.5)
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


# ---------------------------------------------------------------- in space


class _Arrow3D(FancyArrowPatch):
    """An arrow between two points in space with a head of constant size on paper."""

    def __init__(self, start, end, **options):
        super().__init__((0, 0), (0, 0), shrinkA=0, shrinkB=0, **options)
        self._ends = np.array([start, end], dtype=float).T

    def do_3d_projection(self, renderer=None):
        xs, ys, zs = proj3d.proj_transform(*self._ends, self.axes.get_proj())
        self.set_positions((xs[0], ys[0]), (xs[1], ys[1]))
        return float(np.min(zs))


class _TrimmedAxes3D(Axes3D):
    """3D axes that may be larger than their figure: the figure's edges, not theirs, frame the picture."""

    def get_tightbbox(self, *args, **kwargs):
        return self.get_figure(root=True).bbox


def new_axes_3d(elev=22.0, azim=-60.0):
    """Space without axes in a figure of its own, seen without perspective from `elev` and `azim` degrees."""
    figure = plt.figure()
    ax = figure.add_axes(_TrimmedAxes3D(figure, (0, 0, 1, 1), computed_zorder=False))
    ax.view_init(elev=elev, azim=azim)
    ax.set_proj_type("ortho")
    ax.set_axis_off()
    return ax


def fit_3d(ax, points, own, width=6.2, height=5.0, pad=0.3):
    """Equal scale on the three axes; if the figure is our `own`, trim it to `points` (sizes in inches)."""
    points = np.asarray(points, float)
    low, high = points.min(axis=0), points.max(axis=0)
    half = np.maximum(high - low, 0.2 * (high - low).max()) / 2
    for setter, centre, h in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), (low + high) / 2, half):
        setter(centre - h, centre + h)
    ax.set_box_aspect(half, zoom=0.75)
    if not own:
        return
    projected = np.column_stack(proj3d.proj_transform(*points.T, ax.get_proj())[:2])
    on_axes = ax.transAxes.inverted().transform(ax.transData.transform(projected))
    start, extent = on_axes.min(axis=0), np.ptp(on_axes, axis=0)
    side = min((width - 2 * pad) / extent[0], (height - 2 * pad) / extent[1])
    size = side * extent + 2 * pad
    ax.figure.set_size_inches(size)
    ax.set_position((*(pad - side * start) / size, *side / size))


def arrow_3d(ax, start, end, colour=INK, dashes="-", width=1.6, zorder=6, style="-|>", scale=11):
    """Arrow in space; its shaft may be dashed."""
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
    """A label centred at a point in space."""
    options = {"ha": "center", "va": "center", "fontsize": 11, "zorder": 9} | options
    ax.text(*at, text, path_effects=halo(), **options)


def dimension_3d(ax, start, end, shift, label):
    """Dimension line from `start` to `end`, moved by the vector `shift`."""
    a, b = start + np.array(shift), end + np.array(shift)
    for foot, point in ((start, a), (end, b)):
        ax.plot(*zip(foot, point + 0.1 * np.array(shift)), color=SOFT, lw=0.7, zorder=4)
    arrow_3d(ax, a, b, width=0.9, style="<|-|>", scale=8)
    write_3d(ax, (a + b) / 2, f"${label}$")


def angle_arc_3d(ax, centre, start, side, radius, sweep, label, away=1.3):
    """Arc over `sweep` radians from the unit vector `start` towards the unit vector `side`."""
    turn = np.linspace(0, sweep, 30)
    arc = centre + radius * (np.outer(np.cos(turn), start) + np.outer(np.sin(turn), side))
    ax.plot(*arc[:-2].T, color=INK, lw=1.1, zorder=4)
    arrow_3d(ax, arc[-4], arc[-1], width=1.1, scale=8, zorder=4)
    if label:
        middle = np.cos(sweep / 2) * start + np.sin(sweep / 2) * side
        write_3d(ax, centre + away * radius * middle, f"${label}$")


def solid(ax, outline, low, high, shade=0.85, zorder=1.0):
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
    seen = _towards_viewer(outline, ax.azim)
    for i in range(-1, len(outline) - 1):
        if seen[i]:
            ax.plot(*bottom[[i, i + 1]].T, **pen)
        if seen[i] != seen[i - 1]:
            ax.plot(*np.array([bottom[i], top[i]]).T, **pen)


def _towards_viewer(outline, azim) -> np.ndarray:
    """For each edge of a counter-clockwise outline: does the wall on it face a viewer at `azim` degrees?"""
    edges = np.roll(outline, -1, axis=0) - outline
    return np.column_stack([edges[:, 1], -edges[:, 0]]) @ unit_vector(np.radians(azim)) > 0


def stadium(start, end, radius, n=16) -> np.ndarray:
    """Outline of a link with round ends."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    heading = np.arctan2(*(end - start)[::-1])
    turn = np.linspace(np.pi / 2, 3 * np.pi / 2, n)
    rear = start + radius * np.column_stack([np.cos(heading + turn), np.sin(heading + turn)])
    front = end + radius * np.column_stack([np.cos(heading + turn + np.pi), np.sin(heading + turn + np.pi)])
    return np.vstack([rear, front])


def disc(centre, radius, n=32) -> np.ndarray:
    """Outline of a round body."""
    turn = np.linspace(0, 2 * np.pi, n, endpoint=False)
    return np.asarray(centre) + radius * np.column_stack([np.cos(turn), np.sin(turn)])
