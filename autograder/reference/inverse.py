"""Inverse geometric models: what all robots share around their closed forms.

A robot's own algebra is a *kernel*: poses in, arrays of branches out, vectorised over the
poses; one pose is a batch of one. The kernels are in `horizontal` (planar arms, SCARA),
`elbow` (elbow arms, spherical wrist) and `pen`, and share the closed forms of `planar`.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from dhkit.geometry import wrap

from .forward import Chain
from .marks import FOLDED_LINE, FREE_LINE
from .solutions import LIMITED, UNREACHABLE, Batch, Nearest, Solutions
from .tables import DHTable

TOLERANCE = 1e-9  # metres (radians) by which a pose may miss the workspace and count as on it
_RIGID = 1e-5  # how far a transform may be from rigid: poses rounded to six decimals pass
_LIMIT_SLACK = 1e-9  # radians (metres) by which a posture may pass a joint limit
_MOST_TURNS = 3  # full turns listed to either side of a joint with wide limits
_BLOCK = 1024  # poses treated at a time, so that the intermediate arrays stay in the cache


@dataclass(frozen=True)
class Answer:
    """What a kernel returns, branches before poses: q (n, K, N), valid and marks (K, N),
    miss and cause (N,), see `solutions.Batch`. Angles need not be wrapped yet."""

    q: np.ndarray
    valid: np.ndarray
    marks: np.ndarray
    miss: np.ndarray
    cause: np.ndarray


@dataclass(frozen=True)
class JointMap:
    """Between the variables of the table's rows and the joints: row = sign * q + offset."""

    sign: np.ndarray
    offset: np.ndarray

    @classmethod
    def of(cls, chain: Chain) -> JointMap:
        """Raises ValueError unless joint i alone, with factor +-1, moves row i."""
        n = chain.joints
        square = chain.coupling[:n]
        sign = np.diag(square)
        if chain.coupling[n:].any() or (square != np.diag(sign)).any() or (sign**2 != 1).any():
            raise ValueError("this inverse model needs joint i alone, with factor +-1, in row i")
        return cls(sign, chain.offset[:n])

    def row(self, index: int, near: np.ndarray | None):
        """Row variable at the joint values near (n, N); at joint value 0 without near."""
        value = 0.0 if near is None else self.sign[index] * near[index]
        return value + self.offset[index]

    def joint(self, index: int, row):
        """Joint value from the row variable."""
        return self.sign[index] * (row - self.offset[index])


class InverseModel:
    """Base of the closed-form inverse models; a subclass supplies what is declared here.

    branches: K, the number of branches. revolute: indices of the revolute joints.
    anchors: for FREE_FIRST, FREE_PLANE and FREE_CHAIN the joints whose value can be chosen.
    line: joints i, j and signs (s, s') such that, at a FREE_LINE mark, only q_i + s q_j is
    defined, or q_i + s' q_j when FOLDED_LINE is marked too.
    """

    joints: int | None = None  # None in a class: any number
    branches: int
    revolute: list[int]
    anchors: dict[int, tuple[int, ...]]
    line: tuple[int, int, int, int] | None = None

    def __init__(self, table: DHTable):
        """Raises ValueError, in words, when the table is not of the model's kind of robot."""
        found = table.chain.joints
        if self.joints not in (None, found):
            raise ValueError(f"expected a robot with {self.joints} joints, found {found}")
        self.joints = found
        self.limits = table.limits

    def kernel(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Answer:
        """All branches for rigid poses (N, 4, 4); near (n, N) fixes what is free."""
        raise NotImplementedError

    def pose(self, task: np.ndarray) -> np.ndarray:
        """Poses (N, 4, 4) from task coordinates (N, m), for robots that have them."""
        raise ValueError(f"expected poses of shape (N, 4, 4), found {task.shape}")

    def label(self, branch: int, marks: int) -> str:
        """The branch in words."""
        raise NotImplementedError

    def unreachable(self, cause: int, miss: float) -> str:
        """Why a pose is out of reach, in words."""
        raise NotImplementedError

    def free(self, marks: int) -> str:
        """The free directions behind marks in words, "" when there is none."""
        texts = [
            " and ".join(f"q{joint + 1}" for joint in joints) + " free"
            for mark, joints in self.anchors.items()
            if marks & mark
        ]
        if marks & FREE_LINE:
            i, j, sign = self._line_of(marks)
            texts.append(f"q{i + 1} {'+' if sign > 0 else '-'} q{j + 1} = const")
        return ", ".join(texts)

    def solve(self, T, near=None, tol: float = TOLERANCE, limits: bool = False) -> Solutions:
        """All postures for one pose (4, 4), or one set of task coordinates (m,).

        Arguments and errors as for `solve_batch`.
        """
        return self.solve_batch(np.asarray(T, dtype=float)[None], near, tol, limits)[0]

    def solve_batch(self, T, near=None, tol: float = TOLERANCE, limits: bool = False) -> Batch:
        """All postures for N poses at once.

        T: (N, 4, 4) rigid transforms, or (N, m) task coordinates where the robot has them.
        near: (n,) or (N, n) joint values. A family of postures is represented by its member
            whose free angles are those of near (by default 0); of two aligned joints, by the
            member nearest to near. So the representative is near itself if near reaches T.
        tol: metres by which a target may miss the workspace and still count as on its limit.
        limits: keep only postures within the joint limits, in every full turn they allow.

        Raises ValueError for wrong shapes, numbers that are not finite, transforms that are
        not rigid, and for ``limits=True`` on a robot without joint limits.
        """
        poses = self._poses(T)
        near = self._near(near, len(poses))
        if limits:
            near = self._clip_to_limits(np.zeros((1, self.joints)) if near is None else near.T)
            near = np.broadcast_to(near, (len(poses), self.joints)).T
        n, k, total = self.joints, self.branches, len(poses)
        batch = Batch(
            q=np.empty((total, k, n)),
            valid=np.empty((total, k), dtype=bool),
            marks=np.empty((total, k), dtype=np.uint8),
            miss=np.empty(total),
            cause=np.empty(total, dtype=np.uint8),
            words=self,
        )
        for start in range(0, total, _BLOCK):
            block = slice(start, start + _BLOCK)
            answer = self.kernel(poses[block], None if near is None else near[:, block], tol)
            batch.valid[block], batch.marks[block] = answer.valid.T, answer.marks.T
            batch.miss[block], batch.cause[block] = answer.miss, answer.cause
            for joint in self.revolute:
                answer.q[joint] = wrap(answer.q[joint])
            if not answer.valid.all():
                answer.q[:, ~answer.valid] = 0.0
            batch.q[block] = answer.q.transpose(2, 1, 0)
        if near is not None:
            self._slide_towards(batch, near)
        return self._within_limits(batch) if limits else batch

    def nearest(self, T, q0, tol: float = TOLERANCE, limits: bool = False) -> Nearest:
        """The posture for one pose that is nearest to q0 (n,).

        Distances are Euclidean over angle differences modulo 2 pi (radians) and slides
        (metres). In a family the free angles are chosen to come as near to q0 as possible.
        Arguments and errors as for `solve_batch`.
        """
        target = np.asarray(T, dtype=float)[None]
        q0 = np.asarray(q0, dtype=float)
        batch = self.solve_batch(target, q0, tol, limits)
        if batch.status[0] == UNREACHABLE:
            answer = batch[0]
            return Nearest(None, np.inf, "", answer.status, answer.reason, "")
        _, distance, branch = self._pick(batch, q0)
        free = self._free_anchors(batch)
        if free:
            batch, distance, branch = self._search(target, q0, free, tol, limits)
        answer = batch[0]
        row = int(batch.valid[0, :branch].sum())
        return Nearest(
            answer.q[row],
            distance,
            answer.labels[row],
            answer.status,
            answer.reason,
            answer.free_by_row[row],
        )

    def nearest_batch(self, T, q0, tol: float = TOLERANCE, limits: bool = False):
        """`nearest` for N poses: q (N, n), found (N,) bool, distance (N,).

        q0: (n,) or (N, n). Rows that are not found hold 0 and an infinite distance.
        """
        batch = self.solve_batch(T, q0, tol, limits)
        q0 = np.broadcast_to(np.asarray(q0, dtype=float), (len(batch), self.joints))
        distances = np.where(batch.valid, self._distance(batch.q, q0[:, None]), np.inf)
        branch = distances.argmin(axis=1)
        rows = np.arange(len(batch))
        q, distance = batch.q[rows, branch], distances[rows, branch]
        anchored = sum(self.anchors)
        marks = np.bitwise_or.reduce(np.where(batch.valid, batch.marks, 0), axis=1)
        for i in np.flatnonzero(marks & anchored):
            one = self.nearest(np.asarray(T)[i], q0[i], tol, limits)
            q[i], distance[i] = one.q, one.distance
        return q, batch.valid.any(axis=1), distance

    def _distance(self, q, q0) -> np.ndarray:
        difference = q - q0
        difference[..., self.revolute] = wrap(difference[..., self.revolute])
        return np.sqrt((difference**2).sum(axis=-1))

    def _pick(self, batch: Batch, q0: np.ndarray) -> tuple[int, float, int]:
        """Pose, distance and branch of the posture in the whole batch nearest to q0."""
        distances = np.where(batch.valid, self._distance(batch.q, q0), np.inf)
        pose, branch = np.unravel_index(distances.argmin(), distances.shape)
        return int(pose), float(distances[pose, branch]), int(branch)

    def _free_anchors(self, batch: Batch) -> list[int]:
        marks = np.bitwise_or.reduce(batch.marks[batch.valid])
        return sorted({j for mark, joints in self.anchors.items() if marks & mark for j in joints})

    def _search(self, target, q0, free, tol, limits):
        """Compass search over the free anchor angles for the member nearest to q0."""

        def evaluate(anchors):
            anchors = self._clip_to_limits(anchors) if limits else anchors
            # The aligned joints of each member are still drawn towards q0 itself.
            batch = self.solve_batch(np.repeat(target, len(anchors), axis=0), anchors, tol, limits)
            pose, distance, branch = self._pick(batch, q0)
            return distance, anchors[pose], branch

        scan = np.linspace(-np.pi, np.pi, 24 if len(free) > 1 else 120, endpoint=False)
        start = np.repeat(q0[None], len(scan) ** min(len(free), 2) + 1, axis=0)
        start[1:, free[:2]] += list(product(scan, repeat=min(len(free), 2)))
        distance, best, branch = evaluate(start)
        step = scan[1] - scan[0]
        while step > 1e-11:
            around = np.repeat(best[None], 2 * len(free), axis=0)
            for k, joint in enumerate(free):
                around[2 * k, joint] += step
                around[2 * k + 1, joint] -= step
            closer, candidate, its_branch = evaluate(around)
            if closer < distance:
                distance, best, branch = closer, candidate, its_branch
            else:
                step /= 2
        batch = self.solve_batch(target, best, tol, limits)
        return batch, distance, branch

    def _poses(self, T) -> np.ndarray:
        T = np.asarray(T, dtype=float)
        if not np.isfinite(T).all():
            raise ValueError("a pose must hold finite numbers")
        if T.ndim == 2:
            return self.pose(T)
        if T.ndim != 3 or T.shape[1:] != (4, 4):
            raise ValueError(f"expected poses of shape (N, 4, 4), found {T.shape}")
        if not _rigid(T):
            raise ValueError("a pose must be a rigid transform with last row 0 0 0 1")
        return T

    def _near(self, near, poses: int) -> np.ndarray | None:
        if near is None:
            return None
        near = np.asarray(near, dtype=float)
        if near.shape not in ((self.joints,), (poses, self.joints)):
            raise ValueError(f"expected joint values of shape ({self.joints},), found {near.shape}")
        if not np.isfinite(near).all():
            raise ValueError("joint values must be finite numbers")
        return np.broadcast_to(near, (poses, self.joints)).T

    def _line_of(self, marks: int) -> tuple[int, int, int]:
        i, j, plain, folded = self.line
        return i, j, folded if marks & FOLDED_LINE else plain

    def _slide_towards(self, batch: Batch, near: np.ndarray) -> None:
        """Move members with two aligned joints along their line, as near as possible."""
        rows = (batch.marks & FREE_LINE).astype(bool) & batch.valid
        if self.line is None or not rows.any():
            return
        i, j, plain, folded = self.line
        pose, _ = np.nonzero(rows)
        sign = np.where(batch.marks[rows] & FOLDED_LINE, folded, plain)
        at_i, at_j = near[i, pose], near[j, pose]
        # Half of what q_i + sign q_j must still change goes to each of the two joints.
        missing = wrap(batch.q[rows, i] - at_i + sign * (batch.q[rows, j] - at_j))
        batch.q[rows, i] = wrap(at_i + missing / 2)
        batch.q[rows, j] = wrap(at_j + sign * missing / 2)

    def _bounds(self) -> tuple[np.ndarray, np.ndarray]:
        if self.limits is None:
            raise ValueError("this robot has no joint limits")
        lower, upper = np.array(self.limits).T
        return lower, upper

    def _clip_to_limits(self, q: np.ndarray) -> np.ndarray:
        return np.clip(q, *self._bounds())

    def _within_limits(self, batch: Batch) -> Batch:
        """The postures within the limits; a joint that may turn further gives more of them."""
        lower, upper = self._bounds()
        self._slide_into_limits(batch, lower, upper)
        turns = [range(1)] * self.joints
        for j in self.revolute:
            first = int(np.ceil((lower[j] - np.pi) / (2 * np.pi)))
            last = int(np.floor((upper[j] + np.pi) / (2 * np.pi)))
            turns[j] = range(max(first, -_MOST_TURNS), min(last, _MOST_TURNS) + 1)
        shifts = 2 * np.pi * np.array(list(product(*turns)), dtype=float)
        q = batch.q[:, :, None] + shifts
        excess = np.maximum(lower - q, q - upper).max(axis=-1)
        valid = batch.valid[:, :, None] & (excess <= _LIMIT_SLACK)
        lost = batch.valid.any(axis=1) & ~valid.any(axis=(1, 2))
        least = np.where(batch.valid[:, :, None], excess, np.inf).min(axis=(1, 2))
        poses, many = len(q), self.branches * len(shifts)
        return Batch(
            q=np.where(valid[..., None], q, 0.0).reshape(poses, many, self.joints),
            valid=valid.reshape(poses, many),
            marks=np.repeat(batch.marks, len(shifts), axis=1),
            miss=np.where(lost, least, batch.miss),
            cause=np.where(lost, LIMITED, batch.cause),
            words=self,
        )

    def _slide_into_limits(self, batch: Batch, lower, upper) -> None:
        """Move members with two aligned joints along their line, into the limits if possible."""
        rows = (batch.marks & FREE_LINE).astype(bool) & batch.valid
        if self.line is None or not rows.any():
            return
        i, j, plain, folded = self.line
        sign = np.where(batch.marks[rows] & FOLDED_LINE, folded, plain)
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


def _rigid(T) -> bool:
    """Whether all transforms (N, 4, 4) are rotations with translations, within _RIGID."""
    s, n, a = np.moveaxis(T[:, :3, :3], 2, 0)
    wrong = [(s * s).sum(1) - 1, (n * n).sum(1) - 1, (s * n).sum(1), *(np.cross(s, n) - a).T]
    bottom = (T[:, 3] == (0.0, 0.0, 0.0, 1.0)).all()
    return bool(bottom and np.abs(wrong).max(initial=0.0) < _RIGID)


def translations(points) -> np.ndarray:
    """Poses (N, 4, 4) without rotation from points (N, m), m = 2 or 3, metres."""
    poses = np.tile(np.eye(4), (len(points), 1, 1))
    poses[:, : points.shape[1], 3] = points
    return poses


def outside_limits(miss: float) -> str:
    """Reason in words when only joint limits stand in the way."""
    return f"every posture is outside the joint limits, the best one by {miss:.3g} (rad or m)"
