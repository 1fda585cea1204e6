"""Any six turns, by the eigenvalues of `six_turns`: arms of which no three joints form a group."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .geometry import wrap
from .inverse import Branches
from .loop import Loop, in_unit, motion
from .loop_arms import Candidates, LoopArm
from .settling import Task
from .six_turns import MOST, Elimination
from .status import Flag
from .tables import DHTable

_TRIED = 24  # poses by which the beginnings of a loop are judged
_REAL = 1e-2  # imaginary part, in radians, up to which a root is worth a try: a double one loses half of its digits
_COUNTED = 1e-3  # the same, up to which it should lead to a posture
_FOUND = 1e-4  # radians within which a posture counts as found there
_NEAR = 0.1  # the same, for a pose beside it
_ASIDE = (1e-2, -1e-2, 1e-3, -1e-3)  # turns and shifts (in sizes of the arm) that lead away from a special pose
_LOOKS = 2  # joints that a loop may begin with, for a pose where something may be missing


def _moves() -> list[np.ndarray]:
    """Small displacements (4, 4) in no special direction."""
    moves = []
    for size in _ASIDE:
        moves.append(motion(False, np.array(size)))
        for axis in np.eye(3)[[1, 2, 0]], np.eye(3)[[2, 0, 1]]:
            turn = np.eye(4)
            turn[:3, :3] = axis
            moves[-1] = turn @ moves[-1] @ turn.T @ motion(False, np.array(0.7 * size)) @ motion(True, np.array(size))
    return moves


_BESIDE = _moves()


@dataclass(frozen=True)
class SixTurns:
    """The algebra of a loop of six turns.

    Attributes
    ----------
    loop : Loop
    beginnings : tuple of (int, bool)
        The joint that `six_turns` calls a, and whether it goes round the loop backwards from there; the best
        conditioned choice first.
    """

    loop: Loop
    beginnings: tuple[tuple[int, bool], ...]

    @classmethod
    def of(cls, loop: Loop) -> SixTurns:
        """Raises ValueError where every beginning loses postures: elimination has a degenerate case there."""
        rows = np.random.default_rng(0).uniform(-np.pi, np.pi, (6, _TRIED))
        T = loop.links[0]
        for value, link in zip(rows, loop.links[1:]):
            T = T @ motion(False, value) @ link

        def gaps(beginning: tuple[int, bool], moved: np.ndarray) -> np.ndarray:
            """How far from the known postures the nearest candidates are that poses beside theirs give."""
            found = cls(loop, (beginning,)).candidates(T @ moved, rows)
            off = np.abs(np.angle(np.exp(1j * (found.rows - rows[:, None])))).max(axis=0)
            return np.where(found.valid, off, np.inf).min(axis=0)

        beginnings = [(first, backwards) for first in range(6) for backwards in (False, True)]
        found = np.array([gaps(each, np.eye(4)) for each in beginnings])
        order = np.lexsort((np.median(found, axis=1), (found > _FOUND).sum(axis=1)))
        best = [beginnings[each] for each in order]
        beside = np.array([gaps(each, moved) for each in best[:_LOOKS] for moved in _BESIDE])
        missed = int(((found.min(axis=0) > _FOUND) & (beside.min(axis=0) > _NEAR)).sum())
        if missed:
            raise ValueError(f"elimination is degenerate for it: it loses {missed} of {_TRIED} known postures")
        return cls(loop, tuple(best))

    @cached_property
    def _eliminations(self) -> list[Elimination]:
        return [self._elimination(*each) for each in self.beginnings[:_LOOKS]]

    def _elimination(self, first: int, backwards: bool) -> Elimination:
        links = [link[None] for link in (*self.loop.links[1:6], np.eye(4))]  # the last one differs from pose to pose
        around, place = links[first:] + links[:first], 5 - first
        if backwards:
            around = [*(np.linalg.inv(link) for link in around[4::-1]), np.linalg.inv(around[5])]
            place = 5 if place == 5 else 4 - place
        return Elimination(tuple(around), place)

    def candidates(self, T: np.ndarray, near: np.ndarray, looks: int = 1) -> Candidates:
        """As `loop_arms.Algebra` has it; K = 16 for each of so many beginnings."""
        link = self.loop.links[6] @ np.linalg.inv(T) @ self.loop.links[0]
        several = []
        for (first, backwards), elimination in zip(self.beginnings[:looks], self._eliminations):
            angles, apart = elimination.candidates(np.linalg.inv(link) if backwards else link)
            angles = np.roll(-angles[::-1] if backwards else angles, first, axis=0)
            flags = np.where(apart > _COUNTED, Flag.STRETCHED, 0).astype(np.uint8)
            several.append(Candidates(angles, apart <= _REAL, flags, flags > 255))
        return Candidates.joined(several)


class GeneralArm(LoopArm):
    """Six turns about any axes: at most 16 solutions, in the order of their first joint's values."""

    expected_joints = 6
    branch_count = MOST

    def __init__(self, table: DHTable) -> None:
        """Raises ValueError for slides, for joints that lose a freedom, and where elimination is degenerate."""
        super().__init__(table)
        for joint, slide in enumerate(self.loop.slides, start=1):
            if slide:
                raise ValueError(f"joint {joint} is prismatic, not revolute")
        self._algebra = SixTurns.of(self.loop)
        self.anchors = {Flag.FREE_CHAIN: ()}

    def candidates(self, T: np.ndarray, near: np.ndarray) -> Candidates:
        return self._algebra.candidates(T, near)

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        start, T = self.map.rows(near, len(poses)), in_unit(poses, 1 / self.size)
        candidates = self.candidates(T, start)
        tried = candidates if near is None else Candidates.joined([starts(start[:, None]), candidates])
        found = self._listed(tried, poses, tol)
        # At special poses roots coincide, and their vectors with them. Beside them they do not, and postures are near.
        count = found.valid.sum(axis=0)
        merged = (found.valid & (found.flags != 0)).any(axis=0)
        doubtful = np.flatnonzero(
            (count % 2 == 1) | (count < (candidates.flags == 0).sum(axis=0)) | (count == 0) | merged
        )
        if len(doubtful):
            wished, T = start[:, doubtful], T[doubtful]
            beside = [self._algebra.candidates(T @ moved, wished, _LOOKS) for moved in _BESIDE]
            others = [starts(wished[:, None]), self._algebra.candidates(T, wished, _LOOKS), *beside]
            again = self._listed(Candidates.joined(others), poses[doubtful], tol)
            found.q[:, :, doubtful], found.valid[:, doubtful] = again.q, again.valid
            found.flags[:, doubtful], found.excess[doubtful], found.failure[doubtful] = (
                again.flags,
                again.excess,
                again.failure,
            )
        return found

    def _listed(self, candidates: Candidates, poses: np.ndarray, tol: float) -> Branches:
        """The postures among candidates, in the order of their first joint."""
        found, _ = self._settled(candidates, poses, tol)
        branch, pose = np.nonzero(found.valid & ((found.flags & Flag.LIMIT) != 0))
        if len(pose):
            loose = Task(self.chain, self.size, 6).loose(found.q[:, branch, pose].T, poses[pose])
            found.flags[branch[loose], pose[loose]] = Flag.FREE_CHAIN
        first = np.argsort(~found.valid, axis=0, kind="stable")[: self.branch_count]
        pose = np.arange(len(poses))
        angle = np.where(found.valid[first, pose], wrap(found.q[0, first, pose]), np.inf)
        order = first[angle.argsort(axis=0, kind="stable"), pose]
        return Branches(
            found.q[:, order, pose], found.valid[order, pose], found.flags[order, pose], found.excess, found.failure
        )

    def free(self, flags: int) -> str:
        return "several joints can move together" if flags & Flag.FREE_CHAIN else ""

    def label(self, branch: int, flags: int) -> str:
        return f"posture {branch + 1}, at a limit" if flags & Flag.LIMIT else f"posture {branch + 1}"


def starts(rows: np.ndarray) -> Candidates:
    """Row variables (6, K, N) from which Newton's method may lead to postures."""
    none = np.zeros(rows.shape[1:], dtype=np.uint8)
    return Candidates(rows, none == 0, none, none != 0)
