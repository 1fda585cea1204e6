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
_State = tuple[int, int]
"""Whether Z, and whether X, of a frame is turned over."""

# A right cell counts for more than all senses of a table.
_PRICE_OF_A_SENSE = 1e-3


def agreeing_cells(student: np.ndarray, reference: np.ndarray, pins: Pins, tolerance: float) -> np.ndarray:
    """Which cells agree, (n, 5) booleans, for rows (N, n, 5) at N sample points and the best choice of senses."""
    count = student.shape[1]
    best: dict[_State, tuple[float, list[np.ndarray]]] = {(0, 0): (0.0, [])}
    for row in range(count):
        reached: dict[_State, tuple[float, list[np.ndarray]]] = {}
        for after in _states(pins, row + 1) if row + 1 < count else [(0, 0)]:
            for before, (price, cells) in best.items():
                turned = _in_senses(reference[:, row], before, after)
                agree = _agree(student[:, row], turned, tolerance)
                total = price + float((~agree).sum()) + _PRICE_OF_A_SENSE * sum(after)
                if after not in reached or total < reached[after][0]:
                    reached[after] = total, [*cells, agree]
        best = reached
    return np.array(best[0, 0][1])


def _states(pins: Pins, joint: int) -> Iterator[_State]:
    z, x = (range(1 if pins.hold(freedom, joint) else 2) for freedom in (Freedom.Z, Freedom.X))
    return product(z, x)


def _in_senses(row: np.ndarray, before: _State, after: _State) -> np.ndarray:
    """A row (N, 5) between two frames, each of which may be turned over."""
    sigma, a, alpha, d, theta = row.T
    if after[0]:
        alpha, d, theta = alpha + np.pi, -d, -theta
    theta = theta + np.pi * after[1]
    alpha = alpha + np.pi * before[0]
    if before[1]:
        a, alpha, theta = -a, -alpha, theta + np.pi
    return np.stack([sigma, a, alpha, d, theta], axis=-1)


def _agree(student: np.ndarray, reference: np.ndarray, tolerance: float) -> np.ndarray:
    with np.errstate(all="ignore"):
        gap = student - reference
        gap = np.where(_ANGLES, wrap(gap.real) + 1j * gap.imag, gap)
        return np.asarray((np.abs(gap) <= tolerance * np.maximum(1, np.abs(reference))).all(axis=0))
