"""Point clouds: judged by what they cover of the region and by what lies outside it, never point by point."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from dhkit.forms.point_cloud import PointCloud

from ..decode import Value
from .base import Comparison, Setting
from .entries import real_values

__all__ = ["compare", "read"]

# A cloud may leave out, or have outside, one point in a hundred: rounding at a boundary is not a mistake.
ENOUGH = 0.99


def read(form: PointCloud, value: Value) -> np.ndarray:
    """Points as rows, (n, 2) or (n, 3), in metres."""
    return real_values(value).reshape(-1, *form.shape)


def compare(form: PointCloud, student: np.ndarray, other: np.ndarray, setting: Setting) -> Comparison:
    """Coverage: points of `other` that have one of the student's within the tolerance. Excess: the other way round.

    Places count, not points: what lies outside is not outweighed by many points where the robot can surely be.
    """
    places = _apart(student, setting.tolerance / 2)
    covered, inside = (_near(a, b, setting.tolerance) for a, b in ((other, student), (places, other)))
    remarks = []
    if covered < ENOUGH:
        remarks.append(f"the cloud covers {covered:.0%} of the region")
    if inside < ENOUGH:
        remarks.append(f"{1 - inside:.0%} of its points lie where the robot cannot be")
    # What lies outside is measured by the region, like what is covered of it.
    outside = (1 - inside) / inside if inside else 1.0
    return Comparison(not remarks, max(0.0, covered - outside), tuple(remarks))


def _apart(points: np.ndarray, distance: float) -> np.ndarray:
    """Some of the points, none of them nearer to another one than `distance`, and each of the others near to one of them."""
    # One point of every small cell will do; what is left is sparse enough to be gone through one by one.
    _, first = np.unique(np.floor(points / (distance / 2)), axis=0, return_index=True)
    points = points[np.sort(first)]
    taken, neighbours = np.zeros(len(points), bool), cKDTree(points).query_ball_point(points, distance)
    for i, near in enumerate(neighbours):
        taken[i] = not taken[near].any()
    return points[taken]


def _near(points: np.ndarray, others: np.ndarray, tolerance: float) -> float:
    """Share of `points` that have one of `others` within the tolerance."""
    distances, _ = cKDTree(others).query(points, distance_upper_bound=tolerance)
    return float(np.isfinite(distances).mean())
