"""The view of a drawing in space: its directions on paper, and how large its contents appear."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass, field

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d import Axes3D, proj3d


@dataclass
class Frame:
    """What a row of pictures has shown so far: the next one keeps its scale and place, and grows where it must.

    Attributes
    ----------
    points : dict from (elevation, azimuth) to ndarray, shape (n, 3), in metres
        Outermost points in space.
    size : tuple of float
        Greatest width and height that a drawing in space has asked for, in inches.
    limits : dict from places of plane axes to ndarray, shape (2, 2)
        Outermost limits (min, max) of x and of y.
    """

    points: dict[tuple, np.ndarray] = field(default_factory=dict)
    size: tuple[float, float] = (0.0, 0.0)
    limits: dict[tuple, np.ndarray] = field(default_factory=dict)

    def hold_space(self, ax, points, width, height):
        """`points` with those shown before from the same side, and the greater size."""
        side = (ax.elev, ax.azim)
        points = np.vstack([points, self.points.get(side, points[:0])])
        heights = points @ np.vstack([np.eye(3), view_axes(ax)]).T
        self.points[side] = points[np.unique([heights.argmin(axis=0), heights.argmax(axis=0)])]
        self.size = max(width, self.size[0]), max(height, self.size[1])
        return points, *self.size

    def hold_planes(self, figure):
        """Widen the limits of the plane axes of a finished figure to those that were shown before."""
        planes = [ax for ax in figure.axes if not isinstance(ax, Axes3D)]
        for place, ax in enumerate(planes):
            here = np.array([ax.get_xlim(), ax.get_ylim()])
            if (np.diff(here) < 0).any():
                continue  # a picture, or an axis that runs backwards
            key = (len(planes), place)
            before = self.limits.get(key, here)
            held = np.column_stack([np.minimum(here, before)[:, 0], np.maximum(here, before)[:, 1]])
            self.limits[key] = held
            ax.set(xlim=held[0], ylim=held[1])


_frame: Frame | None = None


@contextmanager
def held(frame: Frame):
    """Draw within a frame: see `Frame`."""
    global _frame
    before, _frame = _frame, frame
    try:
        yield
    finally:
        _frame = before


def view_axes(ax) -> np.ndarray:
    """Directions of a 3D drawing as the reader sees them.

    Returns
    -------
    ndarray, shape (3, 3)
        Unit vectors as rows: to the right on paper, up on paper, and out of the paper towards the reader.
    """
    elev, azim = np.radians([ax.elev, ax.azim])
    right = [-np.sin(azim), np.cos(azim), 0.0]
    up = [-np.sin(elev) * np.cos(azim), -np.sin(elev) * np.sin(azim), np.cos(elev)]
    towards = [np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)]
    return np.array([right, up, towards])


def to_pixels(ax, points) -> np.ndarray:
    """Where points of space, shape (n, 3) in metres, lie on the figure: shape (n, 2), in pixels."""
    points = np.asarray(points, float)
    return ax.transData.transform(np.column_stack(proj3d.proj_transform(*points.T, ax.get_proj())[:2]))


class _TrimmedAxes3D(Axes3D):
    """3D axes that may be larger than their figure: the figure's edges, not theirs, frame the picture."""

    def get_tightbbox(self, *args, **kwargs):
        return self.get_figure(root=True).bbox


def new_axes_3d(elev=22.0, azim=-60.0):
    """Space without a box in a figure of its own, seen without perspective from `elev` and `azim` degrees."""
    figure = plt.figure()
    ax = figure.add_axes(_TrimmedAxes3D(figure, (0, 0, 1, 1), computed_zorder=False))
    look_from(ax, elev, azim)
    return ax


def add_axes_3d(figure, box, elev=22.0, azim=-60.0):
    """Space in a part of a figure, `box` = (left, bottom, width, height) in shares of it."""
    ax = figure.add_axes(box, projection="3d", computed_zorder=False)
    look_from(ax, elev, azim)
    return ax


def look_from(ax, elev, azim):
    """Show a space without its box and without perspective, from `elev` and `azim` degrees."""
    ax.view_init(elev=elev, azim=azim)
    ax.set_proj_type("ortho")
    ax.set_axis_off()


def new_panels_3d(titles, width=3.5, height=3.6, columns=None, view=(20, -58)):
    """Spaces side by side in one figure with a title over each.

    Parameters
    ----------
    titles : sequence of n texts
    width, height : float
        Size of each space, in inches.
    columns : int, optional
        Spaces per row; by default all in one.
    view : (elevation, azimuth), in degrees

    Returns
    -------
    list of n matplotlib Axes (3D)
    """
    count = len(titles)
    columns = columns or count
    rows = -(-count // columns)
    figure = plt.figure(figsize=(width * columns, height * rows))
    panels = []
    for k, title in enumerate(titles):
        left, bottom = (k % columns) / columns, 1 - (k // columns + 1) / rows
        ax = add_axes_3d(figure, (left, bottom, 1 / columns, (1 - 0.32 / height) / rows), *view)
        ax.set_clip_on(False)
        figure.text(
            left + 0.5 / columns, bottom + (1 - 0.12 / height) / rows, title, ha="center", va="top", fontsize=11
        )
        panels.append(ax)
    return panels


def fit_3d(ax, points, own, width=6.2, height=5.0, pad=0.3):
    """Equal scale on the three axes; if the figure is our own, trim it to its contents.

    Parameters
    ----------
    points : array-like, shape (n, 3), in metres
        What the view must hold.
    own : bool
        The figure was made for this drawing alone.
    width, height, pad : float
        Greatest size of the figure and the room at its edges, in inches.
    """
    points = np.asarray(points, float)
    if own and _frame is not None:
        points, width, height = _frame.hold_space(ax, points, width, height)
    low, high = points.min(axis=0), points.max(axis=0)
    half = np.maximum(high - low, 0.2 * (high - low).max()) / 2
    _set_limits(ax, (low + high) / 2, half)
    ax.set_box_aspect(half, zoom=0.75)
    if not own:
        return
    on_axes = ax.transAxes.inverted().transform(to_pixels(ax, points))
    start, extent = on_axes.min(axis=0), np.ptp(on_axes, axis=0)
    side = min((width - 2 * pad) / extent[0], (height - 2 * pad) / extent[1])
    size = side * extent + 2 * pad
    ax.figure.set_size_inches(size)
    ax.set_position((*(pad - side * start) / size, *side / size))


def fill_panel(ax, points, share=0.78):
    """Show `points`, shape (n, 3) in metres, centred and as large as a `share` of the panel allows."""
    points = np.asarray(points, float)
    low, high = points.min(axis=0), points.max(axis=0)
    centre, half = (low + high) / 2, np.full(3, (high - low).max() / 2)
    for _ in range(2):
        _set_limits(ax, centre, half)
        ax.set_box_aspect((1, 1, 1), zoom=1)
        ax.apply_aspect()
        on_paper = to_pixels(ax, points)
        box = ax.get_window_extent()
        room = ax.figure.bbox.size * ax.get_position(original=True).size
        half = half * max(np.ptp(on_paper, axis=0) / (share * room))
        middle = (on_paper.min(axis=0) + on_paper.max(axis=0)) / 2 - (box.p0 + box.p1) / 2
        right, up, _ = view_axes(ax)
        scale = np.hypot(*np.diff(to_pixels(ax, [centre, centre + right]), axis=0)[0])
        centre = centre + (middle[0] * right + middle[1] * up) / scale
    _set_limits(ax, centre, half)


def _set_limits(ax, centre, half):
    for setter, c, h in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), centre, half):
        setter(c - h, c + h)
