"""From candidates for postures to postures: brought onto the pose by Newton's method, verified, told apart.

The roots of a polynomial carry its rounding; the forward model does not. What counts as a posture is decided by it
alone, whichever algebra found the candidate.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .forward import Chain
from .geometry import cross
from .inverse import Branches
from .status import Failure, Flag

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
    flat, target = q.reshape(n, -1).T.copy(), np.tile(poses, (branches, 1, 1))
    tried = valid.ravel().copy()
    error = np.full(len(flat), np.inf)
    flat[tried], error[tried] = task.approached(flat[tried], target[tried])
    reached = (error <= tol).reshape(branches, count)
    hopeless = np.tile(~reached.any(axis=0), branches)
    again = hopeless & np.isfinite(flat).all(axis=1)
    if again.any():  # from a singular posture a step leads nowhere: from beside it
        flat[again] += _BESIDE * task.unit * np.cos(np.arange(n))
        flat[again], error[again] = task.approached(flat[again], target[again])
    best = error.reshape(branches, count)
    reached = best <= tol
    q = flat.T.reshape(n, branches, count)
    flags = task.told_by_rank(q, reached, flags)
    lost = ~reached.any(axis=0)
    excess = np.where(lost, best.min(axis=0), 0.0)
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

    def jacobian(self, q: np.ndarray) -> np.ndarray:
        """In sizes of the arm, (R, freedoms, n), for q (R, n)."""
        return self._in_sizes(self.chain.jacobian(q))

    def _in_sizes(self, J: np.ndarray) -> np.ndarray:
        lengths = np.array([1 / self.size] * 3 + [1.0] * 3)[:, None]
        return (lengths * J * self.unit)[:, : self.freedoms]

    def approached(self, q: np.ndarray, T: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Joint values (R, n) brought as near to poses (R, 4, 4) as Newton's method does, and the errors (R,) left.

        An error is the largest entry by which a pose differs, in metres; rotations count times the size of the arm.
        """
        q = q.copy()
        twist, slopes = self.twist(q, T)
        going = np.arange(len(q))
        for _ in range(_STEPS):
            inexact = (twist[going] ** 2).sum(1) > _EXACT**2
            going, J = going[inexact], slopes[inexact]
            if not len(going):
                break
            square = (twist[going] ** 2).sum(1)
            damping = 1e-3 * np.minimum(square, 1e-2) + 1e-14
            normal = J.swapaxes(1, 2) @ J + damping[:, None, None] * np.eye(self.chain.joints)
            step = np.linalg.solve(normal, J.swapaxes(1, 2) @ twist[going, :, None])[..., 0]
            tried = q[going] + self.unit * step
            left, slopes = self.twist(tried, T[going])
            better = (left**2).sum(1) < square
            going, slopes = going[better], slopes[better]
            q[going], twist[going] = tried[better], left[better]
        return q, self.size * np.abs(twist).max(axis=1, initial=0.0)

    def twist(self, q: np.ndarray, T: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """What is missing to poses T: a shift, in sizes of the arm, and a turn, as vectors, (R, freedoms); the Jacobians."""
        found, J = self.chain.poses_and_jacobians(q)
        shift, slopes = (T[:, :3, 3] - found[:, :3, 3]) / self.size, self._in_sizes(J)
        if self.freedoms == 3:
            return shift, slopes
        R, goal = found[:, :3, :3], T[:, :3, :3]
        axis = cross(R.swapaxes(1, 2), goal.swapaxes(1, 2)).sum(axis=1) / 2
        over = ((R * goal).sum(axis=(1, 2)) < 1)[:, None]  # beyond a quarter turn the sine says too little
        return np.concatenate([shift, np.where(over, axis + np.sign(axis + 1e-300), axis)], axis=1), slopes

    def told_by_rank(self, q: np.ndarray, reached: np.ndarray, flags: np.ndarray) -> np.ndarray:
        """Flags (K, N): no family where the Jacobian has its rank; where not and none is free, STRETCHED: branches merge."""
        branch, pose = np.nonzero(reached)
        values = np.linalg.svd(self.jacobian(q[:, branch, pose].T), compute_uv=False)
        singular = values[:, -1] < _SINGULAR * values[:, 0]
        found = flags[branch, pose]
        singular |= self.chain.joints > self.freedoms
        free = (found & Flag.FREE) != 0
        result = np.zeros_like(flags)
        result[branch, pose] = np.where(singular, np.where(free, found & ~Flag.LIMIT, Flag.STRETCHED), 0)
        return result

    def loose(self, q: np.ndarray, T: np.ndarray) -> np.ndarray:
        """Whether singular postures q (R, n) of poses T can move without moving the tool, (R,)."""
        way = np.linalg.svd(self.jacobian(q))[2][:, -1]
        aside, error = self.approached(q + _ASIDE * self.unit * way, T)
        moved = (((aside - q) / self.unit) * way).sum(axis=1)
        return (error <= self.size * _CLOSED) & (np.abs(moved) > _ASIDE / 2)

    def repeated(self, q: np.ndarray, reached: np.ndarray, flags: np.ndarray) -> np.ndarray:
        """Whether an earlier branch is the same posture, (K, N)."""
        repeated = np.zeros_like(reached)
        special = (flags & (Flag.FREE | Flag.LIMIT)) != 0
        apart = q / self.unit[:, None, None]
        turns = ~self.chain.prismatic[: self.chain.joints]
        some = np.flatnonzero(reached.any(axis=1))
        for place, later in enumerate(some[1:], start=1):
            earlier = some[:place]
            gap = np.abs(apart[:, [later]] - apart[:, earlier])
            gap[turns] = np.minimum(gap[turns] % (2 * np.pi), -gap[turns] % (2 * np.pi))
            least = np.where(special[later] | special[earlier], _BLURRED, _SAME)
            repeated[later] = ((gap.max(axis=0) <= least) & reached[later] & reached[earlier]).any(axis=0)
        return repeated
