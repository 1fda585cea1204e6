"""Postures within joint limits: which ones stay, in which full turns, and where a family has a member inside."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from dhkit.geometry import wrap

from .solutions import Batch
from .status import Failure, Flag

if TYPE_CHECKING:
    from .inverse import InverseModel

_SLACK = 1e-9  # radians (metres) by which a posture may pass a joint limit
_MOST_TURNS = 3  # full turns listed to either side of a joint with wide limits


def bounds(model: InverseModel) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper joint limits, (n,) each. Raises ValueError for a robot without limits."""
    if model.limits is None:
        raise ValueError("this robot has no joint limits")
    lower, upper = np.array(model.limits).T
    return lower, upper


def clipped(model: InverseModel, q: np.ndarray) -> np.ndarray:
    """Joint values (N, n) moved into the limits, each to the limit that it passes."""
    return np.clip(q, *bounds(model))


def within_limits(batch: Batch) -> Batch:
    """The postures within the limits; a joint that may turn further gives more of them."""
    model = batch.model
    lower, upper = bounds(model)
    _slide_into_limits(batch, lower, upper)
    periods = _periods(model, lower, upper)
    q = batch.q[:, :, None] + periods
    excess = np.maximum(lower - q, q - upper).max(axis=-1)
    valid = batch.valid[:, :, None] & (excess <= _SLACK)
    lost = batch.valid.any(axis=1) & ~valid.any(axis=(1, 2))
    least = np.where(batch.valid[:, :, None], excess, np.inf).min(axis=(1, 2))
    poses, many = len(q), model.branch_count * len(periods)
    return Batch(
        q=np.where(valid[..., None], q, 0.0).reshape(poses, many, model.joints),
        valid=valid.reshape(poses, many),
        flags=np.repeat(batch.flags, len(periods), axis=1),
        excess=np.where(lost, least, batch.excess),
        failure=np.where(lost, Failure.LIMITED, batch.failure),
        model=model,
    )


def _periods(model: InverseModel, lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """Multiples of 2 pi to add to the joints, (number, n), so that every posture within the limits is met."""
    turns = [range(1)] * model.joints
    for j in model.revolute:
        first = int(np.ceil((lower[j] - np.pi) / (2 * np.pi)))
        last = int(np.floor((upper[j] + np.pi) / (2 * np.pi)))
        turns[j] = range(max(first, -_MOST_TURNS), min(last, _MOST_TURNS) + 1)
    return 2 * np.pi * np.array(list(product(*turns)), dtype=float)


def _slide_into_limits(batch: Batch, lower: np.ndarray, upper: np.ndarray) -> None:
    """Move members with two aligned joints along their line, into the limits if possible."""
    rows = (batch.flags & Flag.FREE_LINE).astype(bool) & batch.valid
    if batch.model.line is None or not rows.any():
        return
    i, j, plain, folded = batch.model.line
    sign = np.where(batch.flags[rows] & Flag.FOLDED_LINE, folded, plain)
    at_i, at_j = batch.q[rows, i], batch.q[rows, j]
    best = np.full(at_i.shape, np.inf)
    for turn in (0.0, 2 * np.pi, -2 * np.pi):
        # q_i + t and q_j + turn - sign t must lie in their intervals.
        ends = np.sort([sign * (at_j + turn - lower[j]), sign * (at_j + turn - upper[j])], 0)
        low = np.maximum(lower[i] - at_i, ends[0])
        high = np.minimum(upper[i] - at_i, ends[1])
        step = np.clip(0.0, low, high)
        best = np.where((low <= high) & (np.abs(step) < np.abs(best)), step, best)
    best[np.isinf(best)] = 0.0
    batch.q[rows, i] = wrap(at_i + best)
    batch.q[rows, j] = wrap(at_j - sign * best)
