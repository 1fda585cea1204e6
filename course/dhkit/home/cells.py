"""From the numbers of an answer to keys: a grid over a few of their features, and a slow derivation for each cell.

Two answers that are equal have features that differ by the tolerance at most. Each feature is cut by a grid; whoever
opens an envelope tries every cell that his feature touches, so that nothing need be said of where in its cell the right
one lies.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

FEATURES, FEW = 6, 9
"""Features of an answer of many numbers; an answer of a few numbers is its own features."""

WIDTH = 8
"""Width of a cell in tolerances."""

COST = 2**13
"""Of scrypt, with blocks of 1 KiB: 8 MiB of memory and some hundredths of a second for each cell that is tried."""

TAG, KEY = 8, 32


@dataclass(frozen=True)
class Lock:
    """What makes the keys of one part of one answer different from all others.

    Attributes
    ----------
    salt : bytes
        Drawn for each release.
    about : str
        Question, set of numbers and part of the answer.
    tolerance : float
        Largest difference between equal numbers.
    cost : int
        Of scrypt, a power of two.
    """

    salt: bytes
    about: str
    tolerance: float
    cost: int = COST

    def features(self, numbers: np.ndarray) -> np.ndarray:
        """A few features (k, ...) of m numbers, (m, ...): they move by no more than the numbers do."""
        if len(numbers) <= FEW:
            return numbers
        stream = hashlib.shake_256(self.salt + self.about.encode()).digest(4 * FEATURES * len(numbers))
        weights = np.frombuffer(stream, "<u4").reshape(FEATURES, -1) / 2.0**31 - 1
        return weights / np.abs(weights).sum(axis=1, keepdims=True) @ numbers

    def cell(self, numbers: np.ndarray) -> tuple[int, ...]:
        """The cell in which an answer lies."""
        return tuple(np.floor(self.features(numbers) / self._width).astype(int).tolist())

    def cells(self, numbers: np.ndarray) -> Iterator[tuple[int, ...]]:
        """All cells that an equal answer may lie in, the nearest first."""
        features = self.features(numbers)
        low, middle, high = (
            np.floor((features + shift) / self._width).astype(int).tolist()
            for shift in (-self.tolerance, 0.0, self.tolerance)
        )
        choices = [
            dict.fromkeys((at, *range(first, last + 1))) for first, at, last in zip(low, middle, high, strict=True)
        ]
        yield from sorted(product(*choices), key=lambda cell: sum(a != b for a, b in zip(cell, middle, strict=True)))

    def key(self, cell: tuple[int, ...]) -> tuple[bytes, bytes]:
        """What an envelope is found by, and the key that opens it."""
        said = f"{self.about} {len(cell)} {' '.join(map(str, cell))}".encode()
        made = hashlib.scrypt(said, salt=self.salt, n=self.cost, r=8, p=1, maxmem=1 << 28, dklen=TAG + KEY)
        return made[:TAG], made[TAG:]

    @property
    def _width(self) -> float:
        return WIDTH * self.tolerance
