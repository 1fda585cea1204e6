"""The member of a family of postures that lies within the joint limits: a search along its free joints.

A family has one, two or more free joints, and a closed form for each value of them, its branches. So a member within
the limits is a zero of how far the limits are missed, a function of the free joints alone: a grid finds its valleys, a
compass search their bottoms. All rows (a pose and one of its branches) are searched at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from .geometry import wrap
from .limits import SLACK, bounds, outside, slide_lines
from .status import Flag

if TYPE_CHECKING:
    from .inverse import InverseModel

_AROUND = Flag.FREE_FIRST | Flag.FREE_PLANE | Flag.FREE_CHAIN
_GRID = {1: 181, 2: 31}  # values of each free joint
_SCATTERED = 4096  # values of three and more free joints together
_VALLEYS = 6  # parts of the grid whose lowest points are followed
_MOST_STEPS = 200  # of a compass search
_STEEPEST = 300.0  # of how far limits are missed, in radians per radian of a free joint
_AT_ONCE = 2**15  # postures treated at a time


@dataclass(frozen=True)
class Rows:
    """R pairs of a pose and a branch, with the joint values to start from.

    poses (R, 4, 4); branch (R,); near (R, n).
    """

    poses: np.ndarray
    branch: np.ndarray
    near: np.ndarray

    def __getitem__(self, index: np.ndarray | slice) -> Rows:
        return Rows(self.poses[index], self.branch[index], self.near[index])


def free_joints(model: InverseModel, flags: int) -> tuple[int, ...]:
    """The joints whose values choose a member of the family behind flags; aligned joints are not among them."""
    if flags & Flag.FREE_CHAIN:
        return model.anchors[Flag.FREE_CHAIN]
    return tuple(sorted({j for flag, joints in model.anchors.items() if flags & flag & _AROUND for j in joints}))


def member(model: InverseModel, rows: Rows, tol: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The posture of each row on its branch, its aligned joints within the limits where possible.

    Returns
    -------
    q : (R, n) array
    flags : (R,) array
    misses : (R, n) array
        By how much each joint misses its limits; infinity where the branch has no such member.
    """
    each = np.arange(len(rows.branch))
    batch = model.members(rows.poses, rows.near.T, tol)
    q, flags = batch.q[each, rows.branch], batch.flags[each, rows.branch]
    slide_lines(model, q, flags, rows.near)
    return q, flags, np.where(batch.valid[each, rows.branch, None], outside(model, q), np.inf)


def search(model: InverseModel, rows: Rows, free: tuple[int, ...], tol: float) -> np.ndarray:
    """Joint values (R, n) whose free ones choose, for each row, a member within the limits or the one closest to it.

    Of the members within the limits that the grid meets it is the one whose free joints are nearest to those of near.
    """
    grid = grid_of(model, free)
    found = rows.near.copy()
    at_a_time = max(1, _AT_ONCE // len(grid))
    for first in range(0, len(found), at_a_time):
        block = slice(first, first + at_a_time)
        found[block] = _search_block(model, rows[block], free, grid, tol)
    return found


def grid_of(model: InverseModel, free: tuple[int, ...]) -> np.ndarray:
    """Values of the free joints within their limits, (G, m), ordered by the first one."""
    lower, upper = _ranges(model, free)
    if len(free) in _GRID:
        values = np.linspace(lower, upper, _GRID[len(free)]).T
        return np.array(list(product(*values)))
    scattered = np.random.default_rng(0).uniform(lower, upper, (_SCATTERED, len(free)))
    return scattered[scattered[:, 0].argsort()]


def _ranges(model: InverseModel, free: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Where the free joints are searched: between their limits, or one turn."""
    lower, upper = (each[list(free)] for each in bounds(model))
    wide = upper - lower > 2 * np.pi
    return np.where(wide, -np.pi, lower), np.where(wide, np.pi, upper)


def _search_block(model: InverseModel, rows: Rows, free: tuple[int, ...], grid: np.ndarray, tol: float) -> np.ndarray:
    near = rows.near
    count, points = len(near), len(grid)
    tried = np.repeat(near, points, axis=0)
    tried[:, free] = np.tile(grid, (count, 1))
    misses = _miss(model, rows, np.repeat(np.arange(count), points), tried, len(free) == 1, tol).reshape(count, points)
    apart = np.linalg.norm(wrap(grid - near[:, None, free]), axis=-1)
    rank = np.where(misses > 0, misses, apart - 1e6)
    found = near.copy()
    found[:, free] = grid[rank.argmin(axis=1)]
    lost = np.flatnonzero(misses.min(axis=1) > 0)
    if len(lost):
        parts = np.array_split(np.arange(points), _VALLEYS)
        lowest = np.stack([part[misses[lost][:, part].argmin(axis=1)] for part in parts], axis=1)
        found[lost] = _descend(model, rows[lost], free, grid[lowest], np.take_along_axis(misses[lost], lowest, 1), tol)
    return found


def _descend(
    model: InverseModel, rows: Rows, free: tuple[int, ...], starts: np.ndarray, misses: np.ndarray, tol: float
) -> np.ndarray:
    """Compass search from starts (R, S, m) with their misses (R, S); returns the best joint values (R, n)."""
    lower, upper = _ranges(model, free)
    dimensions, valleys = len(free), starts.shape[1]
    ways, turned = np.eye(dimensions), np.random.default_rng(0)
    row = np.repeat(np.arange(len(starts)), valleys)
    at, miss = starts.reshape(-1, dimensions).copy(), misses.ravel().copy()
    step = np.full(len(at), (upper - lower).max() / _GRID.get(dimensions, 8))
    for _ in range(_MOST_STEPS):
        solved = np.zeros(len(starts), dtype=bool)
        solved[row[miss == 0]] = True
        hopeless = miss > (_STEEPEST * step) ** 2  # no zero is left within a step
        going = np.flatnonzero((step > 1e-12) & ~hopeless & ~solved[row])
        if not len(going):
            break
        if dimensions > 1:  # valleys run aslant: other ways each time, and longer steps while they lead down
            ways = np.linalg.qr(turned.normal(size=ways.shape))[0]
        both = np.concatenate([ways, -ways])
        around = np.clip(at[going, None] + step[going, None, None] * both, lower, upper)
        tried = np.repeat(rows.near[row[going]], len(both), axis=0)
        tried[:, free] = around.reshape(-1, dimensions)
        theirs = _miss(model, rows, np.repeat(row[going], len(both)), tried, dimensions == 1, tol).reshape(
            len(going), -1
        )
        way = theirs.argmin(axis=1)
        lowest = theirs[np.arange(len(going)), way]
        lower_now = lowest < miss[going]
        moved = going[lower_now]
        at[moved], miss[moved] = around[lower_now, way[lower_now]], lowest[lower_now]
        step[moved] *= 1 if dimensions == 1 else 1.5
        step[going[~lower_now]] /= 2
    best = miss.reshape(-1, valleys).argmin(axis=1)
    found = rows.near.copy()
    found[:, free] = at.reshape(-1, valleys, dimensions)[np.arange(len(best)), best]
    return found


def _miss(model: InverseModel, rows: Rows, row: np.ndarray, near: np.ndarray, one: bool, tol: float) -> np.ndarray:
    """How far members miss their limits, squared, 0 within: in the worst joint; of several free joints, in all of them.

    The worst joint is what is reported, but with several free joints a search would be caught in its creases.
    """
    result = np.empty(len(row))
    for first in range(0, len(row), _AT_ONCE):
        block = slice(first, first + _AT_ONCE)
        each = Rows(rows.poses[row[block]], rows.branch[row[block]], near[block])
        misses = member(model, each, tol)[2]
        squares = np.where(misses > SLACK / 2, misses, 0.0) ** 2
        result[block] = squares.max(axis=1) if one else squares.sum(axis=1)
    return result
