"""The words with which every solver says how many real solutions there are, and why there is none."""

from __future__ import annotations

from enum import IntEnum, IntFlag, StrEnum

import numpy as np

from .geometry import TwoLink


class RoundedInput(UserWarning):
    """An angle or a pose with few digits was read as the exact one that it stands for; the message says how far off."""


class Status(StrEnum):
    """How many real solutions a problem has; in batches an array of these texts."""

    SOLVED = "solved"
    """One or several, apart from each other."""
    BOUNDARY = "boundary"
    """At least two merge: a stretched arm, a double root, two assembly modes at a singular pose."""
    UNREACHABLE = "unreachable"
    """None."""
    INFINITE = "infinite"
    """A whole family; what is reported is a member of it."""


class Flag(IntFlag):
    """What is special about a posture, as bits that can be combined."""

    FREE_FIRST = 1
    """The target lies on axis 1: the first joint is free."""
    FREE_PLANE = 2
    """The target lies on the two-link arm's own first joint: that joint is free."""
    FREE_LINE = 4
    """Two joints act as one, as their axes are aligned: only a sum or difference is defined."""
    FOLDED_LINE = 8
    """Of such two axes the second points backwards: the difference is defined."""
    FREE_CHAIN = 16
    """There are more joints than the task needs."""
    STRETCHED = 32
    """The arm is straight: on the outer limit."""
    FOLDED = 64
    """The arm is folded back: on the inner limit."""
    SIDEWAYS = 128
    """The target touches the cylinder that the lateral offset leaves out."""

    FREE = FREE_FIRST | FREE_PLANE | FREE_LINE | FREE_CHAIN
    LIMIT = STRETCHED | FOLDED | SIDEWAYS


def two_link_flags(arm: TwoLink) -> np.ndarray:
    """STRETCHED, FOLDED or FREE_PLANE for the postures of a two-link arm, uint8 bits of shape (...)."""
    if not (arm.stretched.any() or arm.folded.any()):  # where the first joint is free, the arm is folded
        return np.zeros(arm.stretched.shape, dtype=np.uint8)
    flags = np.where(arm.stretched, Flag.STRETCHED, 0) | np.where(arm.folded & ~arm.free, Flag.FOLDED, 0)
    return (flags | np.where(arm.free, Flag.FREE_PLANE, 0)).astype(np.uint8)


class Failure(IntEnum):
    """Why a pose cannot be reached."""

    NONE = 0
    BEYOND = 1
    """Too far for the two-link arm."""
    SHORT = 2
    """Too near for the two-link arm."""
    INSIDE = 3
    """Within the cylinder about axis 1 that the lateral offset leaves out."""
    TILTED = 4
    """Turned out of the plane of parallel axes."""
    OFF = 5
    """Off the plane, surface or point that the tool can reach."""
    LIMITED = 6
    """Outside the joint limits."""
