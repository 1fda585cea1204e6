"""From candidates for postures to postures: brought onto the pose by Newton's method, verified, told apart.

The roots of a polynomial carry its rounding; the forward model does not. What counts as a posture is decided by it
alone, whichever algebra found the candidate.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .forward import Chain
from .inverse import Branches
from .status import Failure, Flag

_BELOW, _ABOVE = [7, 2, 3], [5, 6, 1]  # entries of a rotation whose differences are twice its axis times the sine
_EXACT = 1e-13  # of a pose with the arm's size as unit: no step is worth its while below
_STEPS = 12
_SINGULAR = 1e-5  # smallest singular value of the Jacobian, per largest, where branches merge
_SAME = 1e-7  # radians (sizes of the arm) between two postures that are one; more where branches merge
_BLURRED = 1e-4
_BESIDE = 1e-3  # radians (sizes of the arm) between a candidate that came to nothing and its second try
_ASIDE = 1e-2  # radians that a singular posture is moved to see whether that is a family
_CLOSED = 1e-11  # of the pose then: a fold misses it by the square


def settled(
    chain: Chain,
    size: float,
    q: np.ndarray,
    valid: np.ndarray,
    flags: np.ndarray,
    poses: np.ndarray,
    tol: float,
    only_point: bool = False,
) -> tuple[Branches, np.ndarray]:
    """Postures from candidates q (n, K, N) for poses (N, 4, 4); which ones are worth a try says valid (K, N).

    Also which candidates are postures, (K, N), of which `Branches.valid` counts every one once. Where there is none,
    `Branches.excess` is how far the best of all candidates stays from the pose, in
    metres (radians, times the size of the arm).
    """
    task = Task(chain, size, 3 if only_point else 6)
    n, branches, count = q.shape
    flat = q.reshape(n, -1).T.copy()
    error, slopes = np.full(len(flat), np.inf), np.zeros((len(flat), task.freedoms, n))

    def approach(some: np.ndarray) -> np.ndarray:
        """Brings some of all candidates onto their poses; says which candidates are there, (K, N)."""
        flat[some], error[some], slopes[some] = task.approached(flat[some], poses[some % count])
        return (error <= tol).reshape(branches, count)

    reached = approach(np.flatnonzero(valid))
    hopeless = ~reached.any(axis=0)
    if hopeless.any():  # from a singular posture a step leads nowhere: from beside it
        again = np.flatnonzero(np.tile(hopeless, branches) & np.isfinite(flat).all(axis=1))
        flat[again] += _BESIDE * task.unit * np.cos(np.arange(n))
        reached = approach(again)
    q = flat.T.reshape(n, branches, count)
    flags = task.told_by_rank(slopes[reached.ravel()], reached, flags)
    lost = ~reached.any(axis=0)
    excess = np.where(lost, error.reshape(branches, count).min(axis=0), 0.0)
    once = reached & ~task.repeated(q, reached, flags)
    return Branches(q, once, flags, excess, np.where(lost, Failure.BEYOND, Failure.NONE)), reached


@dataclass(frozen=True)
class Task:
    """What a chain has to do: to bring its tool onto poses, or only its point.

    Attributes
    ----------
    chain : Chain
    size : float
        Of the arm, metres: the unit of length, in which turns and shifts count alike.
    freedoms : int
        6, or 3 for the point.
    """

    chain: Chain
    size: float
    freedoms: int

    @cached_property
    def unit(self) -> np.ndarray:
        """What a joint's unit is in radians or metres, (n,)."""
        return np.where(self.chain.prismatic[: self.chain.joints], self.size, 1.0)

    @cached_property
    def _in_sizes(self) -> np.ndarray:
        """What turns a Jacobian in metres and radians into one in sizes of the arm, (freedoms, n)."""
        return (np.array([1 / self.size] * 3 + [1.0] * 3)[:, None] * self.unit)[: self.freedoms]

    def approached(self, q: np.ndarray, T: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Joint values (R, n) brought as near to poses (R, 4, 4) as Newton's method does.

        Also the errors (R,) left, each the largest entry by which a pose differs, in metres (rotations count times the
        size of the arm), and the Jacobians there, as `twist` has them.
        """
        q, identity = q.copy(), np.eye(self.chain.joints)
        twist, slopes = self.twist(q, T)
        squares = (twist * twist).sum(axis=1)
        going = np.flatnonzero(squares > _EXACT**2)
        for _ in range(_STEPS):
            if not len(going):
                break
            J, square = slopes[going], squares[going]
            transposed = J.swapaxes(1, 2)
            damping = 1e-3 * np.minimum(square, 1e-2) + 1e-14
            normal = transposed @ J + damping[:, None, None] * identity
            step = np.linalg.solve(normal, transposed @ twist[going, :, None])[..., 0]
            tried = q[going] + self.unit * step
            left, there = self.twist(tried, T[going])
            smaller = (left * left).sum(axis=1)
            better = smaller < square
            going = going[better]
            q[going], twist[going], slopes[going], squares[going] = (
                each[better] for each in (tried, left, there, smaller)
            )
            going = going[squares[going] > _EXACT**2]
        return q, self.size * np.abs(twist).max(axis=1, initial=0.0), slopes

    def twist(self, q: np.ndarray, T: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """What is missing to poses T: a shift, in sizes of the arm, and a turn, as vectors, (R, freedoms).

        Also the Jacobians in sizes of the arm, (R, freedoms, n).
        """
        found, J = self.chain.poses_and_jacobians(q)
        shift, slopes = (T[:, :3, 3] - found[:, :3, 3]) / self.size, J[:, : self.freedoms] * self._in_sizes
        if self.freedoms == 3:
            return shift, slopes
        turn = (T[:, :3, :3] @ found[:, :3, :3].swapaxes(1, 2)).reshape(-1, 9)
        axis = (turn[:, _BELOW] - turn[:, _ABOVE]) / 2
        far = turn[:, ::4].sum(axis=1) < 1  # beyond a quarter turn the sine says too little
        if far.any():
            axis[far] += np.sign(axis[far] + 1e-300)
        return np.concatenate([shift, axis], axis=1), slopes

    def told_by_rank(self, slopes: np.ndarray, reached: np.ndarray, flags: np.ndarray) -> np.ndarray:
        """Flags (K, N): no family where the Jacobian has its rank; where not and none is free, STRETCHED: branches merge.

        slopes : (R, freedoms, n) array
            The Jacobians of the candidates that reached (K, N) names, in its order.
        """
        values = np.linalg.svd(slopes, compute_uv=False)
        singular = values[:, -1] < _SINGULAR * values[:, 0]
        singular |= self.chain.joints > self.freedoms
        result = np.zeros_like(flags)
        if singular.any():
            found = flags[reached]
            free = (found & Flag.FREE) != 0
            result[reached] = np.where(singular, np.where(free, found & ~Flag.LIMIT, Flag.STRETCHED), 0)
        return result

    def loose(self, q: np.ndarray, T: np.ndarray) -> np.ndarray:
        """Whether singular postures q (R, n) of poses T can move without moving the tool, (R,)."""
        way = np.linalg.svd(self.twist(q, T)[1])[2][:, -1]
        aside, error, _ = self.approached(q + _ASIDE * self.unit * way, T)
        moved = (((aside - q) / self.unit) * way).sum(axis=1)
        return (error <= self.size * _CLOSED) & (np.abs(moved) > _ASIDE / 2)

    def repeated(self, q: np.ndarray, reached: np.ndarray, flags: np.ndarray) -> np.ndarray:
        """Whether an earlier branch is the same posture, (K, N)."""
        some = np.flatnonzero(reached.any(axis=1))
        both = reached[some, None] & reached[some] & np.tri(len(some), k=-1, dtype=bool)[..., None]
        later, earlier, pose = np.nonzero(both)
        later, earlier = some[later], some[earlier]
        gap = np.abs(q[:, later, pose] - q[:, earlier, pose]) / self.unit[:, None]
        turns = ~self.chain.prismatic[: self.chain.joints]
        gap[turns] = np.minimum(gap[turns] % (2 * np.pi), -gap[turns] % (2 * np.pi))
        special = (flags & (Flag.FREE | Flag.LIMIT)) != 0
        same = gap.max(axis=0, initial=0.0) <= np.where(special[later, pose] | special[earlier, pose], _BLURRED, _SAME)
        repeated = np.zeros_like(reached)
        repeated[later[same], pose[same]] = True
        return repeated
