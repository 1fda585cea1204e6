"""Targets of a planar arm with two revolute joints: which case each one is, and how they are drawn.

Lengths in metres, angles in radians; (x, y) is the hand seen from the base, `l1` and `l2` are the links.
"""

from __future__ import annotations

import numpy as np

from autograder.reference import robots

ON_LIMIT, WITHIN, BEYOND = "on a limit", "within reach", "out of reach"


def elbow_cosine(x: float, y: float, l1: float, l2: float) -> float:
    """Cosine of joint angle 2 by the law of cosines, in floating point: above 1 by rounding on some limits."""
    return (x * x + y * y - l1 * l1 - l2 * l2) / (2 * l1 * l2)


def classify(x: float, y: float, l1: float, l2: float) -> str:
    """The case a target belongs to: `ON_LIMIT`, `WITHIN` or `BEYOND`."""
    r = np.hypot(x, y)
    if min(abs(r - l1 - l2), abs(r - abs(l1 - l2))) < 1e-9:
        return ON_LIMIT
    return WITHIN if abs(l1 - l2) < r < l1 + l2 else BEYOND


def draw_posture(rng: np.random.Generator) -> tuple[float, float, float, float, float, float]:
    """Lengths, joint angles and hand of one posture: (l1, l2, q1, q2, x, y)."""
    l1, l2 = rng.uniform(0.3, 1.2, 2)
    q1, q2 = rng.uniform(-np.pi, np.pi, 2)
    x, y = robots.planar_2r(l1, l2).forward([q1, q2])[:2, 3]
    return l1, l2, q1, q2, x, y


def draw_target(
    rng: np.random.Generator, quadrant: int, lengths: tuple[float, float], margins: tuple[float, float]
) -> tuple[float, float, float, float]:
    """A target in one quadrant, 0 to 3, and an arm for it: (x, y, l1, l2).

    `lengths` is the range of both links; `margins` says between which parts of the ring from the smallest to the
    largest reach the target lies, 0 to 1.
    """
    l1, l2 = rng.uniform(*lengths, 2)
    r = abs(l1 - l2) + rng.uniform(*margins) * (l1 + l2 - abs(l1 - l2))
    angle = quadrant * np.pi / 2 + rng.uniform(0.1, 1.4)
    return r * np.cos(angle), r * np.sin(angle), l1, l2


def draw_rounded_limit(rng: np.random.Generator) -> tuple[float, float, float, float]:
    """A target on the outer limit whose `elbow_cosine` comes out some rounding errors above 1: (x, y, l1, l2)."""
    while True:
        l1, l2, angle = rng.uniform(0.3, 0.8), rng.uniform(0.3, 0.8), rng.uniform(0.1, 1.4)
        x, y = (l1 + l2) * np.cos(angle), (l1 + l2) * np.sin(angle)
        if elbow_cosine(x, y, l1, l2) > 1 + 4e-16:
            return x, y, l1, l2
