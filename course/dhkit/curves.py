"""Curves for robots to draw. Numbers only, so that the grader can use them too."""

from __future__ import annotations

import numpy as np

from .arms import Arm, Axis

ARM_CURVES = ("eight", "wave", "spiral")
STOPS = {True: 0.15, False: float(np.radians(75))}
"""Of a joint that slides, to either side in metres; and of one that turns, in radians."""


def arm_path(arm: Arm, shape: str, count: int = 121) -> np.ndarray:
    """A curve on the surface of a pen, as joint values of an arm of which two joints do the same.

    Parameters
    ----------
    arm : Arm
        Of three joints, two of which turn about lines of one direction, or slide along them.
    shape : str
        One of `ARM_CURVES`.
    count : int
        Number of points.

    Returns
    -------
    ndarray, shape (count, 3), in radians and metres
        The first of the two joints alone does the work of both: it goes beyond its stop.
    """
    if shape not in ARM_CURVES:
        raise ValueError(f"shape: one of {', '.join(ARM_CURVES)}, found {shape!r}")
    first, second = same_joints(arm)
    (free,) = {0, 1, 2} - {first, second}
    across, along = _drawn(shape, np.linspace(0, 2 * np.pi, count))
    q = np.zeros((count, 3))
    q[:, first] = STOPS[arm.joints[first].slides] * (1.1 + 0.6 * along)
    q[:, free] = 0.12 * across if arm.joints[free].slides else np.radians(40 + 24 * across)
    return q


def same_joints(arm: Arm) -> tuple[int, int]:
    """The places of the two joints that do the same to the pen, counted from 0."""
    pairs = [(i, k) for i in range(3) for k in range(i + 1, 3) if _alike(arm.joints[i], arm.joints[k])]
    if len(pairs) != 1:
        raise ValueError(f"{arm.title}: expected two joints that do the same, found {len(pairs)} pairs")
    return pairs[0]


def _alike(one: Axis, other: Axis) -> bool:
    return one.slides == other.slides and not np.cross(one.direction, other.direction).any()


def _drawn(shape: str, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two coordinates of a curve between -1 and 1, for a parameter from 0 to 2 pi."""
    if shape == "eight":
        return np.sin(s), np.sin(2 * s)
    if shape == "wave":
        return s / np.pi - 1, np.sin(3 * s)
    fade = 1 - 0.4 * s / np.pi
    return fade * np.cos(2 * s), fade * np.sin(2 * s)
