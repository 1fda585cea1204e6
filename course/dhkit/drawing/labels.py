"""Labels in space that keep out of one another's way."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .strokes_3d import write_3d
from .style import INK
from .view import to_pixels, view_axes

TURNS = np.radians([0, 30, -30, 60, -60, 90, -90, 125, -125, 180])  # away from the wished direction, as tried
EXTRA = (0, 9, 20)  # further away than the wished gap, in points of print
CLEARLY = 1.6  # how many times nearer a label is to its own point than to another's


class _Label(NamedTuple):
    at: np.ndarray
    text: str
    towards: np.ndarray | None
    colour: str
    fontsize: float
    gap: float


class Labels:
    """Labels which are placed together, beside what they name and clear of each other."""

    def __init__(self):
        self._wanted: list[_Label] = []
        self._obstacles: list[np.ndarray] = []

    def ask(self, at, text, towards=None, colour=INK, fontsize=11, gap=4.0):
        """Ask for a label.

        Parameters
        ----------
        at : array-like, shape (3,), in metres
            The point that it names.
        text : str
        towards : array-like, shape (3,), optional
            Direction from there in which it stands best; by default up on paper.
        colour : str
        fontsize, gap : float
            Size, and distance from the point, in points of print.
        """
        self._wanted.append(_Label(np.asarray(at, float), text, towards, colour, fontsize, gap))

    def avoid(self, points):
        """Points of space, shape (3,) or (n, 3) in metres, that no label should cover."""
        self._obstacles.append(np.atleast_2d(np.asarray(points, float)))

    def place(self, ax):
        """Choose a place for every label and write them; the view of `ax` must be final."""
        if not self._wanted:
            return
        ax.apply_aspect()
        right, up, _ = view_axes(ax)
        anchors = to_pixels(ax, [label.at for label in self._wanted])
        origin = self._wanted[0].at
        scale = np.linalg.norm(np.diff(to_pixels(ax, [origin, origin + right]), axis=0))
        places = self._settle(ax, anchors, scale)
        for label, anchor, place in zip(self._wanted, anchors, places):
            shift = (place - anchor) / scale
            at = label.at + shift[0] * right + shift[1] * up
            write_3d(ax, at, label.text, color=label.colour, fontsize=label.fontsize)

    def _settle(self, ax, anchors, scale) -> np.ndarray:
        """Centres of the labels in pixels, shape (n, 2): each in turn takes its cheapest place, three times over."""
        point = ax.figure.dpi / 72
        halves = np.array([
            point * label.fontsize * np.array([0.5 * _width(label.text) + 0.1, 0.62]) for label in self._wanted
        ])  # fmt: skip
        obstacles = to_pixels(ax, np.vstack(self._obstacles)) if self._obstacles else np.zeros((0, 2))
        choices = []
        for k, (label, half) in enumerate(zip(self._wanted, halves)):
            centres, costs = _options(ax, label, anchors[k], half, scale, point)
            costs += _covering(centres, half, obstacles) + _leaving(centres, half, ax.figure.bbox)
            choices.append((centres, costs + _confusion(centres, anchors, k)))
        places = np.array([centres[0] for centres, _ in choices])
        for sweep in range(3):
            for k, (centres, costs) in enumerate(choices):
                others = [j for j in range(len(places) if sweep else k) if j != k]
                crowded = costs + _crowding(centres, halves[k], places[others], halves[others])
                places[k] = centres[np.argmin(crowded)]
        return places


def _options(ax, label, anchor, half, scale, point):
    """Places to try for a label, as centres in pixels, (k, 2), and what each costs by itself, (k,)."""
    heading, steep = np.pi / 2, 0.0
    if label.towards is not None:
        way = np.diff(to_pixels(ax, [label.at, label.at + np.asarray(label.towards, float)]), axis=0)[0]
        heading = np.arctan2(*way[::-1])
        steep = np.linalg.norm(way) / scale / np.linalg.norm(label.towards)
    turns, extras = (grid.ravel() for grid in np.meshgrid(TURNS, EXTRA, indexing="ij"))
    out = np.stack([np.cos(heading + turns), np.sin(heading + turns)], axis=-1)
    reach = (half / np.maximum(np.abs(out), 1e-9)).min(axis=1) + (label.gap + extras) * point
    return anchor + reach[:, None] * out, (2.2 if steep > 0.25 else 0.8) * np.abs(turns) + 0.09 * extras


def _width(text: str) -> float:
    """Width of a label in units of its font size, roughly."""
    width, small = 0.0, False
    plain = text
    for word in ("alpha", "theta", "sigma", "mathrm", "frac"):
        plain = plain.replace("\\" + word, "m" if word != "mathrm" else "")
    for letter in plain:
        if letter in "${}\\^":
            small = small and letter != "}"
        elif letter == "_":
            small = True
        else:
            width += 0.42 if small else 0.34 if letter in ",. il" else 0.66
            small = small and letter != ","
    return width


def _confusion(centres, anchors, own) -> np.ndarray:
    """What places cost, (k,), that are not clearly nearer to what their label names than to what another one does."""
    away = np.linalg.norm(centres[:, None] - anchors, axis=-1)
    if len(anchors) == 1:
        return np.zeros(len(centres))
    nearest = np.delete(away, own, axis=1).min(axis=1)
    return 12.0 * np.maximum(0.0, 1.0 - nearest / (CLEARLY * away[:, own]))


def _crowding(centres, half, others, sizes) -> np.ndarray:
    """What places cost, (k,), for covering other labels."""
    overlap = np.minimum(half + sizes + 2 - np.abs(centres[:, None] - others), 2 * np.minimum(half, sizes))
    covered = (overlap > 0).all(axis=-1)
    return np.where(covered, 6 + 12 * overlap.prod(axis=-1) / (4 * half.prod()), 0.0).sum(axis=1)


def _covering(centres, half, obstacles) -> np.ndarray:
    """What places cost, (k,), for covering obstacles."""
    return 0.8 * np.minimum((np.abs(obstacles - centres[:, None]) < half + 1).all(axis=-1).sum(axis=1), 8)


def _leaving(centres, half, frame) -> np.ndarray:
    """What places cost, (k,), for leaving the figure."""
    below = np.maximum([frame.x0 + 3, frame.y0 + 3] - (centres - half), 0)
    above = np.maximum((centres + half) - [frame.x1 - 3, frame.y1 - 3], 0)
    return 1.5 * (below + above).sum(axis=1)
