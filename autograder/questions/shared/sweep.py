"""A part of an arm's workspace: where the end effector goes while two joints run over ranges and the others stand still."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import combinations

import numpy as np

from autograder.reference import jacobian

from .configurations import standing, turning
from .described import Described

COUNT = 60
"""Values of each joint in the reference cloud."""

# Widths below and above where the arm stands, in radians; the first that stay clear of the axis Z0 are taken.
_WIDTHS = ((1.0, 1.4), (1.4, 0.6), (0.6, 1.0), (0.3, 0.7), (0.8, 0.2), (0.2, 0.8), (0.2, 0.4))
_SLIDES = (0.1, 0.3)
_NO_AREA = 1e-4  # square metres
_CLEAR = 0.1  # of the largest distance: nearer to the axis a grid of values finds the smallest distance badly


@dataclass(frozen=True)
class Sweep:
    """Two joints, by their places from 0, their ranges, and where the other joints stand.

    Attributes
    ----------
    joints : (int, int)
    ranges : two pairs of float
        Radians or metres.
    held : tuple of float
        Joint values (n,); those of the two joints do not count.
    """

    joints: tuple[int, int]
    ranges: tuple[tuple[float, float], tuple[float, float]]
    held: tuple[float, ...]

    def values(self, first: np.ndarray, second: np.ndarray) -> np.ndarray:
        """Joint values (..., n) with those of the two joints in their places."""
        first, second = np.broadcast_arrays(first, second)
        q = np.tile(np.array(self.held), (*first.shape, 1))
        q[..., self.joints[0]], q[..., self.joints[1]] = first, second
        return q


@cache
def sweep_of(arm: Described) -> Sweep | None:
    """The two joints that sweep the largest surface, joint 1 left out where it only turns the picture; None of fewer joints."""
    places = range(1 if len(arm.joints) > 2 and 0 in turning(arm) else 0, len(arm.joints))
    held = standing(arm)
    largest = []
    for widths in _WIDTHS:
        ranges = {i: _range(arm, held, i, widths) for i in places}
        sweeps = [Sweep((i, j), (ranges[i], ranges[j]), held) for i, j in combinations(places, 2)]
        areas = [_area(arm, sweep) for sweep in sweeps]
        if not sweeps or max(areas) < _NO_AREA:
            return None
        largest.append(sweeps[areas.index(max(areas))])
        near, far = reach(arm, largest[-1])
        if near > _CLEAR * far:
            return largest[-1]
    return largest[0]


def _range(arm: Described, held: tuple[float, ...], place: int, widths: tuple[float, float]) -> tuple[float, float]:
    if place not in turning(arm):
        # Slides of unlike ranges, so that taking one for the other shows.
        return _SLIDES[0], round(_SLIDES[1] + 0.1 * place, 2)
    return round(held[place] - widths[place % 2], 2), round(held[place] + widths[1 - place % 2], 2)


def _area(arm: Described, sweep: Sweep) -> float:
    """Area in square metres that the end effector's origin sweeps, every sheet counted."""
    grid = np.meshgrid(*(np.linspace(*limits, 9) for limits in sweep.ranges), indexing="ij")
    columns = jacobian(arm.table, sweep.values(*grid))[..., :3, list(sweep.joints)]
    patch = np.linalg.norm(np.cross(columns[..., 0], columns[..., 1]), axis=-1).mean()
    return float(patch * np.prod([high - low for low, high in sweep.ranges]))


def points(
    arm: Described, sweep: Sweep, shape: str = "grid", ranges: str = "own", held: str = "own"
) -> list[list[float]]:
    """Points [x, y, z] of the end effector's origin.

    `shape` may be ``"diagonal"``, both joints in step; `ranges` ``"exchanged"``; `held` ``"zero"``.
    """
    limits = sweep.ranges if ranges == "own" else sweep.ranges[::-1]
    still = sweep if held == "own" else Sweep(sweep.joints, sweep.ranges, (0.0,) * len(sweep.held))
    values = [np.linspace(*pair, COUNT) for pair in limits]
    first, second = values if shape == "diagonal" else np.meshgrid(*values, indexing="ij")
    return arm.table.forward(still.values(first, second))[..., :3, 3].reshape(-1, 3).round(4).tolist()


def spacing(arm: Described, sweep: Sweep) -> float:
    """Largest distance between neighbours in the reference cloud, in metres."""
    grid = np.array(points(arm, sweep)).reshape(COUNT, COUNT, 3)
    return float(max(np.linalg.norm(np.diff(grid, axis=axis), axis=-1).max() for axis in (0, 1)))


def reach(arm: Described, sweep: Sweep, how: str = "all", centre: str = "axis", held: str = "own") -> list[float]:
    """[smallest, largest] distance in metres of the end effector's origin from the axis Z0.

    `how` may be ``"ends"``, the ends of the ranges only; `centre` ``"origin"``, the distance from O0; `held` ``"zero"``.
    """
    still = sweep if held == "own" else Sweep(sweep.joints, sweep.ranges, (0.0,) * len(sweep.held))
    over = 3 if centre == "origin" else 2

    def distances(limits: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
        grid = np.meshgrid(*(np.linspace(*pair, count) for pair in limits), indexing="ij")
        places = arm.table.forward(still.values(*grid))[..., :over, 3]
        return np.stack(grid, axis=-1).reshape(-1, 2), np.linalg.norm(places, axis=-1).ravel()

    whole = np.array(sweep.ranges)
    if how == "ends":
        found = distances(whole, 2)[1]
        return [float(found.min()), float(found.max())]
    extremes = []
    for sign in (1, -1):
        limits, best = whole, 0.0
        for _ in range(4):  # each time the grid closes in on the best of its points
            values, far = distances(limits, 41)
            best_at = int((sign * far).argmin())
            best, step = far[best_at], (limits[:, 1] - limits[:, 0]) / 20
            limits = np.clip(values[best_at][:, None] + step[:, None] * [-1, 1], whole[:, :1], whole[:, 1:])
        extremes.append(float(best))
    return extremes
