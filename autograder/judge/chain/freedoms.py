"""What the modified DH convention leaves free, what a question takes away of it, and what using a freedom costs."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from .frames import MAX_JOINTS


class Freedom(StrEnum):
    """What two tables of the same chain may differ in."""

    BASE = "base frame"
    TOOL = "tool frame"
    ZERO = "zero of joint"
    SENSE = "sense of joint"
    Z = "sense of Z"
    X = "sense of X"
    X_DIRECTION = "direction of X"
    ORIGIN = "origin O"
    AXIS = "place of axis Z"


SAME_MODEL = frozenset({Freedom.BASE, Freedom.TOOL, Freedom.ZERO, Freedom.SENSE})
"""Pinned together, these leave only the choice of frames between base and tool: T(q) itself must be the same."""

SAME_SENSES = SAME_MODEL | {Freedom.Z}
"""Pinned where a statement tells which way every Z points, and leaves X free."""

SAME_FRAMES = SAME_SENSES | {Freedom.X, Freedom.X_DIRECTION}
"""Pinned where a statement tells which way every Z and every X points."""

Price = Callable[[Freedom, int], float]
"""What it costs to use a freedom at a joint (from 1; 0 for base and tool); infinite where it may not be used."""

# Fewer freedoms explain a difference better; frames at the ends and joint variables count for more than the choice
# of a frame between them.
_PRICES = {Freedom.BASE: 2.5, Freedom.TOOL: 2.5, Freedom.ZERO: 2.0, Freedom.SENSE: 2.0}
_PRICE_OF_PINNED = 100.0


@dataclass(frozen=True, order=True)
class Used:
    """A freedom that was used, and the joint (from 1; 0 for base and tool) it was used at."""

    freedom: Freedom
    joint: int = 0

    def __str__(self) -> str:
        match self.freedom:
            case Freedom.BASE | Freedom.TOOL:
                return str(self.freedom)
            case Freedom.ZERO | Freedom.SENSE:
                return f"{self.freedom} {self.joint}"
            case Freedom.ORIGIN:
                return f"origin O{self.joint} along Z{self.joint}"
        return f"{self.freedom}{self.joint}"


_NAMES = frozenset(map(str, Freedom)) | {
    str(Used(freedom, joint)) for freedom in Freedom for joint in range(1, MAX_JOINTS + 1)
}


class Pins:
    """The freedoms that a question does not leave.

    names: each for all joints (``"sense of Z"``) or for one (``"sense of Z2"``). Raises ValueError for any other name.
    """

    def __init__(self, names: Collection[str]) -> None:
        self.names = frozenset(map(str, [names] if isinstance(names, str) else names))
        for name in self.names - _NAMES:
            raise ValueError(
                f"no freedom {name!r}: there are {', '.join(Freedom)}, and those of one joint, like {Used(Freedom.Z, 2)}"
            )

    def hold(self, freedom: Freedom, joint: int) -> bool:
        """Whether a freedom is pinned at a joint."""
        return bool(self.names) and not self.names.isdisjoint((str(freedom), str(Used(freedom, joint))))

    def as_wall(self, freedom: Freedom, joint: int) -> float:
        """A `Price` with which a pinned freedom is never used."""
        return np.inf if self.hold(freedom, joint) else _PRICES.get(freedom, 1.0)

    def as_cost(self, freedom: Freedom, joint: int) -> float:
        """A `Price` with which a pinned freedom is used where nothing else helps, in order to name it."""
        return _PRICE_OF_PINNED * self.hold(freedom, joint) + _PRICES.get(freedom, 1.0)
