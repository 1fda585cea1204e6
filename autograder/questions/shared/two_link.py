"""Targets of a planar arm with two revolute joints: which case each one is, and how they are drawn.

Lengths in metres, angles in radians; (x, y) is the hand seen from the base, `l1` and `l2` are the links.
"""

from __future__ import annotations

import numpy as np

from autograder.reference import robots

ALLOWED = 1e-9  # for rounding, as the statements say
ON_LIMIT, WITHIN, BEYOND = "on a limit", "within reach", "out of reach"


def elbow_cosine(x: float, y: float, l1: float, l2: float) -> float:
    """Cosine of joint angle 2 by the law of cosines, in floating point: above 1 by rounding on some limits."""
    return (x * x + y * y - l1 * l1 - l2 * l2) / (2 * l1 * l2)


def classify(x: float, y: float, l1: float, l2: float, slack: float = ALLOWED) -> str:
    """The case a target belongs to: `ON_LIMIT`, `WITHIN` or `BEYOND`; `slack` is allowed for rounding of the cosine."""
    excess = abs(elbow_cosine(x, y, l1, l2)) - 1
    return BEYOND if excess > slack else ON_LIMIT if excess > -ALLOWED else WITHIN


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


def draw_near_limit(rng: np.random.Generator, excess: float, inner: bool) -> tuple[float, float, float, float]:
    """A target beside the outer or inner limit, where the elbow cosine is `excess` above 1, or below -1: (x, y, l1, l2)."""
    l1, l2 = rng.permutation([rng.uniform(0.6, 0.8), rng.uniform(0.3, 0.4)])
    r = np.sqrt(l1**2 + l2**2 + 2 * l1 * l2 * (-1 if inner else 1) * (1 + excess))
    angle = rng.uniform(-np.pi, np.pi)
    return r * np.cos(angle), r * np.sin(angle), l1, l2


def pull_onto_limit(x: float, y: float, l1: float, l2: float) -> tuple[float, float]:
    """The place on the limit next to a target out of reach."""
    r = np.hypot(x, y)
    nearest = l1 + l2 if elbow_cosine(x, y, l1, l2) > 0 else abs(l1 - l2)
    return x * nearest / r, y * nearest / r
