"""Seven joints: a family for every pose, whose members are chosen by one joint; the other six are solved as such."""

from __future__ import annotations

import numpy as np

from .decoupled import Grouped
from .general import SixTurns, starts
from .inverse import Branches
from .loop_arms import Algebra, Candidates, LoopArm
from .six_turns import MOST
from .status import Flag
from .tables import DHTable

_GENERAL = 0.7  # a value of the free joint at which nothing is special
_ASIDE = np.radians([sign * step for step in range(2, 181, 2) for sign in (1, -1)])
_FIRST_CHOICE = (2, 6, 4, 0, 3, 1, 5)  # of free joints: the upper arm's turn, as the field has it, then the ends


class RedundantArm(LoopArm):
    """Seven joints. Every pose has a family of postures, represented by the member whose free joint is near's.

    The free joint is the first, in the order 3, 7, 5, 1, 4, 2, 6 and slides before turns, that leaves an arm with a
    group of three joints; if none does, one that leaves six turns. Branches are those of that arm. Where the wished
    value of the free joint is out of reach, it is moved in steps of 2 degrees (of a slide: of 3 % of the size).

    Attributes
    ----------
    free_joint : int
        Index of the joint that chooses the member.
    """

    expected_joints = 7

    def __init__(self, table: DHTable) -> None:
        """Raises ValueError unless six of the joints are an arm that is solved."""
        super().__init__(table)
        self.free_joint, self._general = self._chosen()
        kept = [i for i in range(7) if i != self.free_joint]
        grouped = isinstance(self._general, Grouped)
        self.branch_count = 8 if grouped else MOST + 1  # with what near leads to
        self.anchors = {}
        if isinstance(self._general, Grouped):
            self.anchors = {flag: tuple(kept[j] for j in joints) for flag, joints in self._general.anchors.items()}
            if self._general.group.line:
                i, j = sorted(kept[self._general.order[place]] for place in (0, 2))
                sense = int(self.map.sign[i] * self.map.sign[j])
                self.line = i, j, sense, -sense
        self.anchors[Flag.FREE_CHAIN] = (self.free_joint,)

    def _chosen(self) -> tuple[int, Algebra]:
        """The free joint and the algebra of the others."""
        choices = sorted(_FIRST_CHOICE, key=lambda joint: not self.loop.slides[joint])
        for kind in (Grouped, SixTurns):
            for joint in choices:
                rest = self.loop.held(joint, _GENERAL)
                if kind is Grouped or not any(rest.slides):
                    try:
                        return joint, kind.of(rest)
                    except ValueError:
                        continue
        raise ValueError("no six of its joints are an arm that is solved")

    def _algebra(self, value: float) -> Algebra:
        rest = self.loop.held(self.free_joint, value)
        return SixTurns(rest, self._general.beginnings) if isinstance(self._general, SixTurns) else Grouped.of(rest)

    def candidates(self, T: np.ndarray, near: np.ndarray) -> Candidates:
        count, kept = len(T), np.arange(7) != self.free_joint
        shape = (self.branch_count, count)
        rows = np.empty((7, *shape))
        valid, flags = np.zeros(shape, dtype=bool), np.zeros(shape, dtype=np.uint8)
        rows[self.free_joint] = near[self.free_joint]
        values, which = np.unique(near[self.free_joint], return_inverse=True)
        for i, value in enumerate(values):
            poses = np.flatnonzero(which == i)
            wished = near[kept][:, poses]
            found = self._algebra(float(value)).candidates(T[poses], wished)
            if isinstance(self._general, SixTurns):
                found = Candidates.joined([starts(wished[:, None]), found])
            rows[np.ix_(kept, np.arange(shape[0]), poses)] = found.rows
            valid[:, poses] = found.valid
            flags[:, poses] = found.flags & ~np.uint8(Flag.LIMIT) | np.uint8(Flag.FREE_CHAIN)
        return Candidates(rows, valid, flags, np.zeros(shape, dtype=bool))

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        start = self.map.rows(near, len(poses))
        branches, _ = self._branches(poses, start, tol)
        for step in _ASIDE:
            lacking = np.flatnonzero(~branches.valid.any(axis=0))
            if not len(lacking):
                break
            aside = start[:, lacking]
            aside[self.free_joint] += step
            found, _ = self._branches(poses[lacking], aside, tol)
            branches.q[:, :, lacking], branches.valid[:, lacking] = found.q, found.valid
            branches.flags[:, lacking], branches.failure[lacking] = found.flags, found.failure
            branches.excess[lacking] = np.where(
                found.failure == 0, 0.0, np.minimum(found.excess, branches.excess[lacking])
            )
        return branches

    def label(self, branch: int, flags: int) -> str:
        if isinstance(self._general, Grouped):
            return f"arm {branch // 2 + 1}, {self._general.group.words[branch % 2]}"
        return f"posture {branch + 1}"
