"""Postures within joint limits: which ones stay, in which full turns, and where a family has a member inside.

Joint values are arrays (..., n). A revolute joint is within its limits if one of its full turns is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .solutions import Batch
from .status import Flag

if TYPE_CHECKING:
    from .inverse import InverseModel

SLACK = 1e-9
"""Radians (metres) by which a posture may pass a joint limit."""

_BLURRED = 1e-7  # the same where links may lie straight: there an angle errs by the root of what a length errs
_TURN = 2 * np.pi
_MOST_TURNS = 3  # full turns listed to either side of a joint with wide limits
_MOST_NUMBERS = 2**27  # joint values of one answer: 1 GiB
_ENDLESS = 1e9  # no joint turns or slides further, so that limits are finite numbers


def bounds(model: InverseModel) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper joint limits, (n,) each. Raises ValueError for a robot without limits."""
    if model.limits is None:
        raise ValueError("this robot has no joint limits")
    lower, upper = np.clip(np.array(model.limits).T, -_ENDLESS, _ENDLESS)
    return lower, upper


def clipped(model: InverseModel, q: np.ndarray) -> np.ndarray:
    """Joint values moved into the limits, each to the limit that it passes."""
    return np.clip(q, *bounds(model))


def outside(model: InverseModel, q: np.ndarray) -> np.ndarray:
    """By how much each joint misses its limits in the best of its full turns, negative within, (..., n)."""
    lower, upper = bounds(model)
    q = q + _TURN * _turning(model) * np.round(((lower + upper) / 2 - q) / _TURN)
    return np.maximum(lower - q, q - upper)


def slack(flags: np.ndarray) -> np.ndarray:
    """Radians (metres) by which postures with such flags may pass a joint limit."""
    return np.where(flags & (Flag.LIMIT | Flag.FREE_CHAIN), _BLURRED, SLACK)


def nearest_turn(model: InverseModel, q: np.ndarray, near: np.ndarray) -> np.ndarray:
    """The joint values, each in the full turn within its limits that is nearest to near."""
    first, last = _turns(model, q)
    return q + _TURN * np.clip(np.round(_turning(model) * (near - q) / _TURN), first, np.maximum(first, last))


def every_turn(batch: Batch) -> Batch:
    """All full turns within the limits of postures that are within them in at least one.

    Raises ValueError when that is more than memory should hold.
    """
    model = batch.model
    first, last = _turns(model, batch.q)
    # Of a joint that goes round the whole circle and no further, both ends are one posture.
    lower, upper = bounds(model)
    circle = (upper - lower <= _TURN + 2 * SLACK) & (last > first)
    first = np.where(circle, np.clip(0.0, first, last), first)
    last = np.where(circle, first, last)
    first = np.maximum(first, np.minimum(-_MOST_TURNS, last - 2 * _MOST_TURNS))
    last = np.minimum(last, first + 2 * _MOST_TURNS)
    count = np.where(batch.valid[..., None], last - first + 1, 1).astype(int)
    total = count.prod(axis=-1)
    poses, branches, joints = batch.q.shape
    most = int(total.max(initial=1))
    if poses * branches * most * joints > _MOST_NUMBERS:
        raise ValueError(
            f"limits wider than a turn give up to {branches * most} postures for each of {poses} poses, too many to list: "
            "ask for fewer poses at a time, or for the nearest posture"
        )
    valid = batch.valid[..., None] & (np.arange(most) < total[..., None])
    q = np.zeros((*valid.shape, joints))
    rest = np.broadcast_to(np.arange(most), valid.shape)
    for j in reversed(range(joints)):
        rest, turn = np.divmod(rest, count[..., j, None])
        q[..., j] = np.where(valid, batch.q[..., j, None] + _TURN * (first[..., j, None] + turn), 0.0)
    return Batch(
        q=q.reshape(poses, branches * most, joints),
        valid=valid.reshape(poses, branches * most),
        flags=np.repeat(batch.flags, most, axis=1),
        excess=batch.excess,
        failure=batch.failure,
        model=model,
    )


def slide_lines(model: InverseModel, q: np.ndarray, flags: np.ndarray, near: np.ndarray) -> None:
    """Move members with two aligned joints along their line, within the limits as near to near as possible."""
    rows = (flags & Flag.FREE_LINE) != 0
    if model.line is None or not rows.any():
        return
    i, j, plain, folded = model.line
    lower, upper = bounds(model)
    sign = np.where(flags[rows] & Flag.FOLDED_LINE, folded, plain)
    near = np.broadcast_to(near, q.shape)[rows]
    wish_i, wish_j = near[:, i], sign * near[:, j]
    low_j, high_j = np.sort([sign * lower[j], sign * upper[j]], axis=0)
    # q_i + sign q_j is defined up to full turns: each of them is a line, met by the limits in a piece or not at all.
    total = q[rows, i] + sign * q[rows, j]
    first = np.ceil((lower[i] + low_j - SLACK - total) / _TURN)
    last = np.floor((upper[i] + high_j + SLACK - total) / _TURN)
    middle = np.round((wish_i + wish_j - total) / _TURN)
    best, at_i, at_j = np.full(len(total), np.inf), q[rows, i], q[rows, j]
    for turn in range(-2, 3):
        line = total + _TURN * np.clip(np.clip(middle, first, last) + turn, first, last)
        foot = wish_i + (line - wish_i - wish_j) / 2
        on_i = np.clip(foot, np.maximum(lower[i], line - high_j), np.minimum(upper[i], line - low_j))
        on_j = line - on_i
        distance = np.hypot(on_i - wish_i, on_j - wish_j)
        closer = distance < best
        best = np.where(closer, distance, best)
        at_i, at_j = np.where(closer, on_i, at_i), np.where(closer, sign * on_j, at_j)
    q[rows, i], q[rows, j] = at_i, at_j


def _turning(model: InverseModel) -> np.ndarray:
    """1 for a revolute joint, 0 for a slide, (n,)."""
    return np.isin(np.arange(model.joints), model.revolute).astype(float)


def _turns(model: InverseModel, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First and last number of full turns that bring each joint within its limits; first > last where none does."""
    lower, upper = bounds(model)
    turning = _turning(model)
    first, last = np.ceil((lower - SLACK - q) / _TURN), np.floor((upper + SLACK - q) / _TURN)
    blurred = last < first
    first = np.where(blurred, np.ceil((lower - _BLURRED - q) / _TURN), first)
    last = np.where(blurred, np.floor((upper + _BLURRED - q) / _TURN), last)
    return turning * first, turning * last
