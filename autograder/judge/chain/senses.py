"""Which cells of a table are wrong, in the frames that its author chose: every Z and X may have been drawn the other way.

Turning a frame over about its X axis (another sense of Z) or its Z axis (another sense of X) changes its own row and the
next one in closed form. The senses that leave the fewest cells different are found from row to row, over the four states
of each frame.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from dhkit.forms.dh_table import DH_COLUMNS
from dhkit.geometry import wrap

from .freedoms import Freedom, Pins

_ANGLES = np.array([name in ("alpha", "theta") for name in DH_COLUMNS])
State = tuple[int, int]
"""Whether Z, and whether X, of a frame is turned over."""

_AS_IT_IS = (0, 0)
# A right cell counts for more than all senses of a table.
_PRICE_OF_A_SENSE = 1e-3


def best_senses(student: np.ndarray, reference: np.ndarray, pins: Pins, tolerance: float) -> tuple[State, ...]:
    """How the frames 0 to n of a student's rows (N, n, 5), at N sample points, are turned over; fewest cells differ so."""
    count = student.shape[1]
    best: dict[State, tuple[float, tuple[State, ...]]] = {_AS_IT_IS: (0.0, (_AS_IT_IS,))}
    for row in range(count):
        reached: dict[State, tuple[float, tuple[State, ...]]] = {}
        for after in _states(pins, row + 1) if row + 1 < count else [_AS_IT_IS]:
            for before, (price, path) in best.items():
                agree = agreeing(student[:, row], _in_senses(reference[:, row], before, after), tolerance)
                total = price + float((~agree).sum()) + _PRICE_OF_A_SENSE * sum(after)
                if after not in reached or total < reached[after][0]:
                    reached[after] = total, (*path, after)
        best = reached
    return best[_AS_IT_IS][1]


def in_senses(rows: np.ndarray, senses: tuple[State, ...]) -> np.ndarray:
    """Rows (N, n, 5) with their frames turned over; twice is as before."""
    turned = [_in_senses(rows[:, i], *senses[i : i + 2]) for i in range(rows.shape[1])]
    return np.stack(turned, axis=1)


def _states(pins: Pins, joint: int) -> Iterator[State]:
    z, x = (range(1 if pins.hold(freedom, joint) else 2) for freedom in (Freedom.Z, Freedom.X))
    return product(z, x)


def _in_senses(row: np.ndarray, before: State, after: State) -> np.ndarray:
    """A row (N, 5) between two frames, each of which may be turned over."""
    sigma, a, alpha, d, theta = row.T
    if after[0]:
        alpha, d, theta = alpha + np.pi, -d, -theta
    theta = theta + np.pi * after[1]
    alpha = alpha + np.pi * before[0]
    if before[1]:
        a, alpha, theta = -a, -alpha, theta + np.pi
    return np.stack([sigma, a, alpha, d, theta], axis=-1)


def agreeing(student: np.ndarray, reference: np.ndarray, tolerance: float) -> np.ndarray:
    """Which cells of rows (N, ..., 5) agree at all sample points, (..., 5) booleans; angles modulo a turn."""
    with np.errstate(all="ignore"):
        gap = student - reference
        gap = np.where(_ANGLES, wrap(gap.real) + 1j * gap.imag, gap)
        return np.asarray((np.abs(gap) <= tolerance * np.maximum(1, np.abs(reference))).all(axis=0))
