"""Marks of a posture: what is special about it, as bits that can be combined."""

from __future__ import annotations

import numpy as np

from dhkit.geometry import TwoLink

FREE_FIRST = 1  # the target lies on axis 1: the first joint is free
FREE_PLANE = 2  # the target lies on the two-link arm's own first joint: that joint is free
FREE_LINE = 4  # two joints act as one (aligned axes): only a sum or difference is defined
FOLDED_LINE = 8  # of such two axes, the second points backwards: the difference is defined
FREE_CHAIN = 16  # more joints than the task needs
STRETCHED = 32  # the arm is straight: on the outer limit
FOLDED = 64  # the arm is folded back: on the inner limit
SIDEWAYS = 128  # the target touches the cylinder that the lateral offset leaves out
FREE = FREE_FIRST | FREE_PLANE | FREE_LINE | FREE_CHAIN
LIMIT = STRETCHED | FOLDED | SIDEWAYS


def two_link_marks(arm: TwoLink) -> np.ndarray:
    """STRETCHED, FOLDED or FREE_PLANE for the postures of a two-link arm, bits of shape (...)."""
    marks = np.where(arm.stretched, STRETCHED, 0) | np.where(arm.folded & ~arm.free, FOLDED, 0)
    return (marks | np.where(arm.free, FREE_PLANE, 0)).astype(np.uint8)
