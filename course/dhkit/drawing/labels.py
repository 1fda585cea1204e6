"""Labels in space that keep out of one another's way."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..geometry import unit_vector
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

    def _settle(self, ax, anchors, scale) -> list[np.ndarray]:
        """Centres of the labels in pixels: each in turn takes its cheapest place, three times over."""
        point = ax.figure.dpi / 72
        halves = [point * label.fontsize * np.array([0.5 * _width(label.text) + 0.1, 0.62]) for label in self._wanted]
        choices = [
            list(_options(ax, label, anchor, half, scale, point))
            for label, anchor, half in zip(self._wanted, anchors, halves)
        ]
        obstacles = to_pixels(ax, np.vstack(self._obstacles)) if self._obstacles else np.zeros((0, 2))
        places = [options[0][0] for options in choices]
        placed = set()
        for sweep in range(3):
            for k, options in enumerate(choices):
                others = [(places[j], halves[j]) for j in range(len(places)) if j != k and (sweep or j in placed)]
                costs = [
                    cost
                    + _crowding(place, halves[k], others, obstacles, ax.figure.bbox)
                    + _confusion(place, anchors, k)
                    for place, cost in options
                ]
                places[k] = options[int(np.argmin(costs))][0]
                placed.add(k)
        return places


def _options(ax, label, anchor, half, scale, point):
    """Places to try for a label, as centres in pixels, and what each costs by itself."""
    heading, steep = np.pi / 2, 0.0
    if label.towards is not None:
        way = np.diff(to_pixels(ax, [label.at, label.at + np.asarray(label.towards, float)]), axis=0)[0]
        heading = np.arctan2(*way[::-1])
        steep = np.linalg.norm(way) / scale / np.linalg.norm(label.towards)
    for turn in TURNS:
        for extra in EXTRA:
            out = unit_vector(heading + turn)
            reach = min(half / np.maximum(np.abs(out), 1e-9)) + (label.gap + extra) * point
            yield anchor + reach * out, (2.2 if steep > 0.25 else 0.8) * abs(turn) + 0.09 * extra


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


def _confusion(place, anchors, own) -> float:
    """What a place costs that is not clearly nearer to what its label names than to what another one does."""
    away = np.linalg.norm(anchors - place, axis=1)
    others = np.delete(away, own)
    return 12.0 * max(0.0, 1.0 - others.min() / (CLEARLY * away[own])) if len(others) else 0.0


def _crowding(centre, half, others, obstacles, frame) -> float:
    """What a place costs for covering other labels and obstacles, and for leaving the figure."""
    cost = 0.0
    for other, size in others:
        overlap = np.minimum(half + size + 2 - np.abs(centre - other), 2 * np.minimum(half, size))
        if (overlap > 0).all():
            cost += 6 + 12 * overlap.prod() / (4 * half.prod())
    if len(obstacles):
        cost += 0.8 * min((np.abs(obstacles - centre) < half + 1).all(axis=1).sum(), 8)
    below = np.maximum([frame.x0 + 3, frame.y0 + 3] - (centre - half), 0)
    above = np.maximum((centre + half) - [frame.x1 - 3, frame.y1 - 3], 0)
    return cost + 1.5 * (below + above).sum()
