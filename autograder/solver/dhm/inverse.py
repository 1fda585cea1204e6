"""Inverse kinematics in closed form: what all robots share around their own algebra.

A robot's `InverseModel.closed_form` takes poses and returns arrays of branches, vectorised over the poses; one pose is
a batch of one. The closed forms are in `planar_arms` (planar arms, SCARA), `elbow` (elbow arms, spherical wrist) and
`pen`, and share the two-link arm of `geometry`; `decoupled` has every other arm with a group of three joints.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from itertools import product
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from .families import Rows, free_joints, grid_of, member, search
from .forward import Chain
from .gauge import canonical
from .geometry import wrap
from .limits import SLACK, clipped, every_turn, nearest_turn, outside, slack, slide_lines
from .rigid import rigid
from .solutions import Batch, Nearest, Solutions
from .status import Failure, Flag
from .tables import DHTable

TOLERANCE = 1e-9
"""Metres (radians) by which a pose may miss the workspace and count as on it."""

_MOST_STEPS = 1000  # of the search for the nearest member of a family
_BLOCK = 1024  # poses treated at a time, so that the intermediate arrays stay in the cache


@dataclass(frozen=True)
class Branches:
    """What a closed form returns for N poses, K branches before poses.

    ``q`` (n, K, N), angles not wrapped yet; ``valid`` and ``flags`` (K, N); ``excess`` and ``failure`` (N,); see
    `solutions.Batch`.
    """

    q: np.ndarray
    valid: np.ndarray
    flags: np.ndarray
    excess: np.ndarray
    failure: np.ndarray


@dataclass(frozen=True)
class JointMap:
    """Between the variables of the table's rows and the joints: row = sign * q + offset; ``sign``, ``offset`` (n,)."""

    sign: np.ndarray
    offset: np.ndarray

    @classmethod
    def of(cls, chain: Chain) -> JointMap:
        """The map of a chain. Raises ValueError unless joint i alone, with factor +-1, moves row i."""
        n = chain.joints
        sign = np.diag(chain.coupling[:n])
        for row, found in enumerate(chain.coupling):
            alone = row < n and abs(sign[row]) == 1 and np.count_nonzero(found) == 1
            if not alone and (row < n or found.any()):
                drivers = " and ".join(f"{found[j]:g} q{j + 1}" for j in np.flatnonzero(found)) or "no joint"
                raise ValueError(f"row {row + 1} is moved by {drivers}, not by q{row + 1} or -q{row + 1} alone")
        return cls(sign, chain.offset[:n])

    def row(self, index: int, near: np.ndarray | None) -> np.ndarray | float:
        """Row variable at the joint values near (n, N); at joint value 0 without near."""
        value = 0.0 if near is None else self.sign[index] * near[index]
        return value + self.offset[index]

    def joint(self, index: int, row: float | np.ndarray) -> np.ndarray:
        """Joint value from the row variable."""
        return self.sign[index] * (row - self.offset[index])

    def rows(self, near: np.ndarray | None, count: int) -> np.ndarray:
        """`row` of all joints, (n, N) for N = count."""
        return np.repeat(self.offset[:, None], count, axis=1) if near is None else (self.sign * near.T + self.offset).T

    def joints(self, rows: np.ndarray) -> np.ndarray:
        """`joint` of all rows (n, K, N)."""
        return self.sign[:, None, None] * (rows - self.offset[:, None, None])


class InverseModel(ABC):
    """Base of the closed-form inverse models.

    Attributes
    ----------
    expected_joints : int or None
        Number of joints of every robot of the class, where it is fixed.
    joints : int
        n, the number of joints.
    branch_count : int
        K, the number of branches.
    task : str
        Names of the task coordinates, where poses can be given by them.
    revolute : sequence of int
        Indices of the revolute joints.
    anchors : dict
        For FREE_FIRST, FREE_PLANE and FREE_CHAIN the joints whose value can be chosen.
    line : (i, j, s, s') or None
        With the flag FREE_LINE only q_i + s q_j is defined, or q_i + s' q_j where FOLDED_LINE is set too.
    limits : tuple of n pairs, or None
        Joint limits (lower, upper), radians or metres.
    """

    expected_joints: ClassVar[int | None] = None
    branch_count: int
    task: str = ""
    revolute: tuple[int, ...]
    anchors: dict[Flag, tuple[int, ...]]
    line: tuple[int, int, int, int] | None = None

    def __init__(self, table: DHTable) -> None:
        """Raises ValueError, in words, when the table is not of the model's kind of robot."""
        self.joints = table.chain.joints
        if self.expected_joints not in (None, self.joints):
            raise ValueError(f"it has {self.joints} joints, not {self.expected_joints}")
        self.limits = table.limits
        self.chain = canonical(table.chain)

    @abstractmethod
    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        """All branches for rigid poses (N, 4, 4); near (n, N) fixes what is free."""

    @abstractmethod
    def label(self, branch: int, flags: int) -> str:
        """The branch in words."""

    @abstractmethod
    def unreachable(self, failure: Failure, excess: float) -> str:
        """Why no posture reaches a pose, in words; joint limits are not asked about."""

    def reason(self, failure: Failure, excess: float) -> str:
        """Why a pose has no posture, in words: out of reach by `excess` metres or radians, or outside the limits."""
        if failure == Failure.LIMITED:
            return f"every posture is outside the joint limits, the best one found by {excess:.3g} (rad or m)"
        return self.unreachable(failure, excess)

    def pose(self, task: np.ndarray) -> np.ndarray:
        """Poses (N, 4, 4) from task coordinates (N, m), for robots that have them. Raises ValueError for others."""
        raise ValueError(f"expected poses of shape (N, 4, 4), found {task.shape}")

    def free(self, flags: int) -> str:
        """The free directions behind flags in words, "" when there is none."""
        texts = [
            " and ".join(f"q{joint + 1}" for joint in joints) + " free"
            for flag, joints in self.anchors.items()
            if flags & flag
        ]
        if flags & Flag.FREE_LINE and self.line:
            i, j, plain, folded = self.line
            sign = folded if flags & Flag.FOLDED_LINE else plain
            texts.append(f"q{i + 1} {'+' if sign > 0 else '-'} q{j + 1} = const")
        return ", ".join(texts)

    def solve(
        self, T: ArrayLike, near: ArrayLike | None = None, tol: float = TOLERANCE, limits: bool = False
    ) -> Solutions:
        """All postures for one pose.

        Parameters
        ----------
        T : (4, 4) or (m,) array_like
            A rigid transform, or m task coordinates where the robot has them (metres, radians).
        near, tol, limits
            As for `solve_batch`, which also names the errors.
        """
        return self.solve_batch(np.asarray(T, dtype=float)[None], near, tol, limits)[0]

    def solve_batch(
        self, T: ArrayLike, near: ArrayLike | None = None, tol: float = TOLERANCE, limits: bool = False
    ) -> Batch:
        """All postures for N poses at once.

        Parameters
        ----------
        T : (N, 4, 4) or (N, m) array_like
            Rigid transforms, or m task coordinates each where the robot has them (metres, radians).
        near : (n,) or (N, n) array_like, optional
            Joint values. A family of postures is represented by its member whose free angles are those of near (by
            default 0); of two aligned joints, by the member nearest to near. So the representative is near itself if
            near reaches T.
        tol : float
            Metres by which a target may miss the workspace and still count as on its limit.
        limits : bool
            Keep only postures within the joint limits, in every full turn that they allow (up to three to either side).
            A family stays if one of its members is within them, and is then represented by one.

        Raises
        ------
        ValueError
            For wrong shapes, numbers that are not finite, transforms that are not rigid (rounded to four decimals, they
            are read as the nearest rigid ones, with a `RoundedInput` warning), and for ``limits=True`` on a
            robot without joint limits, or whose limits allow more postures in all than memory should hold.
        """
        poses = self._poses(T)
        start = self._near(near, len(poses))
        if limits:
            return every_turn(self._within_limits(poses, start, tol))
        batch = self.members(poses, start, tol)
        if start is not None:
            self._slide_towards(batch, start)
        return batch

    def members(self, poses: np.ndarray, start: np.ndarray | None, tol: float) -> Batch:
        """The closed form of rigid poses (N, 4, 4) as a batch; start (n, N) fixes what is free, except aligned joints."""
        batch = self._empty_batch(len(poses))
        for first in range(0, len(poses), _BLOCK):
            block = slice(first, first + _BLOCK)
            found = self.closed_form(poses[block], None if start is None else start[:, block], tol)
            batch.valid[block], batch.flags[block] = found.valid.T, found.flags.T
            batch.excess[block], batch.failure[block] = found.excess, found.failure
            for joint in self.revolute:
                found.q[joint] = wrap(found.q[joint])
            if not found.valid.all():
                found.q[:, ~found.valid] = 0.0
            batch.q[block] = found.q.transpose(2, 1, 0)
        return batch

    def _within_limits(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Batch:
        """The postures within the joint limits, each in one of its turns; near is (n, N)."""
        wish = np.zeros((len(poses), self.joints)) if near is None else near.T
        start = clipped(self, wish)
        batch = self.members(poses, start.T, tol)
        reached = batch.valid.any(axis=1)
        miss = self._settle(batch, (start if near is None else wish)[:, None])
        flags = np.bitwise_or.reduce(np.where(batch.valid, batch.flags, 0), axis=1)
        searched = np.flatnonzero((miss > SLACK).any(axis=1))
        for its_flags in np.unique(flags[searched]):
            free = free_joints(self, int(its_flags))
            if not free:
                continue
            pose, branch = np.nonzero((flags == its_flags)[:, None] & (miss > SLACK))
            rows = Rows(poses[pose], branch, start[pose])
            found = replace(rows, near=search(self, rows, free, tol))
            batch.q[pose, branch], batch.flags[pose, branch], misses = member(self, found, tol)
            miss[pose, branch] = misses.max(axis=1)
        valid = miss <= slack(batch.flags)
        lost = reached & ~valid.any(axis=1)
        return replace(
            batch,
            q=np.where(valid[..., None], batch.q, 0.0),
            valid=valid,
            excess=np.where(lost, miss.min(axis=1), batch.excess),
            failure=np.where(lost, Failure.LIMITED, batch.failure),
        )

    def _settle(self, batch: Batch, near: np.ndarray) -> np.ndarray:
        """Slide aligned joints into the limits, as near to near (..., n) as possible; by how much postures miss them."""
        slide_lines(self, batch.q, np.where(batch.valid, batch.flags, 0), near)
        return np.where(batch.valid, outside(self, batch.q).max(axis=-1), np.inf)

    def nearest(self, T: ArrayLike, q0: ArrayLike, tol: float = TOLERANCE, limits: bool = False) -> Nearest:
        """The posture for one pose that is nearest to given joint values.

        Distances are Euclidean over angle differences (radians) and slides (metres). In a family the free angles are
        chosen to come as near to q0 as possible. Without limits, angles count modulo 2 pi; with them, a turn is a
        distance like any other, and the posture is in the turn nearest to q0 that the limits allow.

        Parameters
        ----------
        T : (4, 4) or (m,) array_like
            As for `solve`.
        q0 : (n,) array_like
            Radians or metres.
        tol, limits
            As for `solve_batch`, which also names the errors.
        """
        target = np.asarray(T, dtype=float)[None]
        q0 = np.asarray(q0, dtype=float)
        near = self._near(q0, 1)
        batch = self._within_limits(self._poses(target), near, tol) if limits else self.solve_batch(target, q0, tol)
        if not batch.valid.any():
            none = batch[0]
            return Nearest(None, np.inf, "", none.status, none.reason, "")
        if limits:
            batch = replace(batch, q=nearest_turn(self, batch.q, q0))
        _, distance, branch = self._closest(batch, q0, limits)
        free = self._free_anchors(batch)
        if free:
            known = batch.q[batch.valid]
            batch, distance, branch = self._search_family(target, q0, known, free, tol, limits)
        found = batch[0]
        row = int(batch.valid[0, :branch].sum())
        return Nearest(found.q[row], distance, found.labels[row], found.status, found.reason, found.free_by_row[row])

    def _empty_batch(self, count: int) -> Batch:
        branches = (count, self.branch_count)
        return Batch(
            q=np.empty((*branches, self.joints)),
            valid=np.empty(branches, dtype=bool),
            flags=np.empty(branches, dtype=np.uint8),
            excess=np.empty(count),
            failure=np.empty(count, dtype=np.uint8),
            model=self,
        )

    def _closest(self, batch: Batch, q0: np.ndarray, limits: bool) -> tuple[int, float, int]:
        """Pose, distance and branch of the posture in the whole batch that is nearest to q0."""
        difference = batch.q - q0
        if not limits:
            difference[..., self.revolute] = wrap(difference[..., self.revolute])
        distances = np.where(batch.valid, np.sqrt((difference**2).sum(axis=-1)), np.inf)
        pose, branch = np.unravel_index(distances.argmin(), distances.shape)
        return int(pose), float(distances[pose, branch]), int(branch)

    def _free_anchors(self, batch: Batch) -> list[int]:
        flags = np.bitwise_or.reduce(batch.flags[batch.valid])
        return sorted({j for flag, joints in self.anchors.items() if flags & flag for j in joints})

    def _search_family(
        self, target: np.ndarray, q0: np.ndarray, known: np.ndarray, free: list[int], tol: float, limits: bool
    ) -> tuple[Batch, float, int]:
        """Compass search over the free joints for the member of a family that is nearest to q0; with limits, from known ones."""

        allowed = max(SLACK, outside(self, known).max(axis=-1).min()) if limits else SLACK

        def solved(anchors: np.ndarray) -> Batch:
            # The aligned joints of each member are still drawn towards q0 itself.
            targets = np.repeat(target, len(anchors), axis=0)
            if not limits:
                return self.solve_batch(targets, anchors, tol)
            batch = self.members(self._poses(targets), anchors.T, tol)
            inside = self._settle(batch, q0) <= allowed
            return replace(batch, q=nearest_turn(self, batch.q, q0), valid=inside)

        def closest(anchors: np.ndarray) -> tuple[float, np.ndarray, int]:
            anchors = clipped(self, anchors) if limits else anchors
            pose, distance, branch = self._closest(solved(anchors), q0, limits)
            return distance, anchors[pose], branch

        scan = np.linspace(-np.pi, np.pi, 24 if len(free) > 1 else 120, endpoint=False)
        if limits:
            places = np.concatenate([known[:, free], grid_of(self, tuple(free))])
            start = np.repeat(q0[None], len(places) + 1, axis=0)
            start[1:, free] = places
        else:
            start = np.repeat(q0[None], len(scan) ** min(len(free), 2) + 1, axis=0)
            start[1:, free[:2]] += list(product(scan, repeat=min(len(free), 2)))
        distance, best, branch = closest(start)
        step = scan[1] - scan[0]
        turned, ways = np.random.default_rng(0), np.eye(len(free))
        for _ in range(_MOST_STEPS):
            around = np.repeat(best[None], 2 * len(free), axis=0)
            around[::2, free] += step * ways
            around[1::2, free] -= step * ways
            closer, candidate, its_branch = closest(around)
            if closer < distance:
                distance, best, branch = closer, candidate, its_branch
            else:
                step /= 2
            if step <= 1e-11:
                break
            if limits and len(free) > 1:  # along a limit that is aslant to the joints, other ways lead on
                ways = np.linalg.qr(turned.normal(size=ways.shape))[0]
        return solved(best[None]), distance, branch

    def _poses(self, T: ArrayLike) -> np.ndarray:
        T = np.asarray(T, dtype=float)
        if not np.isfinite(T).all():
            raise ValueError("a pose must hold finite numbers")
        if T.ndim == 2:
            return self.pose(T)
        if T.ndim != 3 or T.shape[1:] != (4, 4):
            raise ValueError(f"expected poses of shape (N, 4, 4), found {T.shape}")
        return rigid(T)

    def _near(self, near: ArrayLike | None, poses: int) -> np.ndarray | None:
        if near is None:
            return None
        near = np.asarray(near, dtype=float)
        if near.shape not in ((self.joints,), (poses, self.joints)):
            raise ValueError(f"expected joint values of shape ({self.joints},), found {near.shape}")
        if not np.isfinite(near).all():
            raise ValueError("joint values must be finite numbers")
        return np.broadcast_to(near, (poses, self.joints)).T

    def _slide_towards(self, batch: Batch, near: np.ndarray) -> None:
        """Move members with two aligned joints along their line, as near as possible."""
        rows = (batch.flags & Flag.FREE_LINE).astype(bool) & batch.valid
        if self.line is None or not rows.any():
            return
        pose, _ = np.nonzero(rows)
        batch.q[rows] = self.slid(batch.q[rows], near[:, pose].T, (batch.flags[rows] & Flag.FOLDED_LINE) != 0)

    def slid(self, q: np.ndarray, near: np.ndarray, folded: np.ndarray) -> np.ndarray:
        """Postures (R, n) with their two aligned joints moved along their line, as near as possible to near (R, n)."""
        assert self.line is not None
        i, j, plain, other = self.line
        sign = np.where(folded, other, plain)
        # Half of what q_i + sign q_j must still change goes to each of the two joints.
        missing = wrap(q[:, i] - near[:, i] + sign * (q[:, j] - near[:, j]))
        q = q.copy()
        q[:, i], q[:, j] = wrap(near[:, i] + missing / 2), wrap(near[:, j] + sign * missing / 2)
        return q


def translations(points: np.ndarray) -> np.ndarray:
    """Poses (N, 4, 4) without rotation from points (N, m), m = 2 or 3, metres."""
    poses = np.tile(np.eye(4), (len(points), 1, 1))
    poses[:, : points.shape[1], 3] = points
    return poses
