"""Point clouds: judged by what they cover of the region and by what lies outside it, never point by point."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from dhkit.forms import array_shape
from dhkit.public import PublicQuestion

from ..decode import Number
from .base import Comparison, Setting, describe, refuse
from .entries import flat

MAX_POINTS = 5000
# A cloud may leave out, or have outside, one point in a hundred: rounding at a boundary is not a mistake.
ENOUGH = 0.99


def read_cloud(question: PublicQuestion, value: object) -> np.ndarray:
    """Points as rows, (n, 2) or (n, 3), in metres."""
    shape, (dimension,) = array_shape(value), question.shape
    if shape is None or len(shape) != 2 or shape[1] != dimension:
        raise refuse(question, describe(value))
    if shape[0] > MAX_POINTS:
        raise refuse(question, f"{shape[0]} points; {MAX_POINTS} are enough")
    scalars = flat(value)
    if not all(isinstance(scalar, Number) and not isinstance(scalar.value, complex) for scalar in scalars):
        raise refuse(question, "an entry that is not a real number")
    points = np.array([float(scalar.value) for scalar in scalars]).reshape(shape)
    if not np.isfinite(points).all():
        raise refuse(question, "a value that is not finite")
    return points


def compare_cloud(question: PublicQuestion, student: np.ndarray, other: np.ndarray, setting: Setting) -> Comparison:
    """Coverage: points of `other` that have one of the student's within the tolerance. Excess: the other way round."""
    covered, inside = (_near(a, b, setting.tolerance) for a, b in ((other, student), (student, other)))
    remarks = []
    if covered < ENOUGH:
        remarks.append(f"the cloud covers {covered:.0%} of the region")
    if inside < ENOUGH:
        remarks.append(f"{1 - inside:.0%} of its points lie where the robot cannot be")
    return Comparison(not remarks, min(covered, inside), tuple(remarks))


def _near(points: np.ndarray, others: np.ndarray, tolerance: float) -> float:
    """Share of `points` that have one of `others` within the tolerance."""
    distances, _ = cKDTree(others).query(points, distance_upper_bound=tolerance)
    return float(np.isfinite(distances).mean())
