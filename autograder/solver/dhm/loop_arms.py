"""What arms that are solved as loops of six joints share around their algebra, whichever it is."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from .inverse import Branches, InverseModel, JointMap
from .limits import outside
from .loop import Loop, in_unit
from .settling import Task, settled
from .singularities import chain_mobility
from .solutions import Batch
from .status import Failure, Flag
from .tables import DHTable

_ANCHORED = Flag.FREE_FIRST | Flag.FREE_PLANE | Flag.FREE_CHAIN
_ASIDE = np.radians([sign * step for step in range(5, 181, 5) for sign in (1, -1)])


@dataclass(frozen=True)
class Candidates:
    """What may be postures, for N poses.

    Attributes
    ----------
    rows : (n, K, N) array
        Variables of the arm's rows, slides in sizes of the arm.
    valid, flags : (K, N) arrays
        Which ones are worth a try, and what is free in them.
    family : (K, N) bool array
        Which ones would be members of a family if the rest of the arm could follow.
    """

    rows: np.ndarray
    valid: np.ndarray
    flags: np.ndarray
    family: np.ndarray

    @classmethod
    def joined(cls, several: Sequence[Candidates]) -> Candidates:
        """All of several for the same poses."""
        return cls(
            np.concatenate([each.rows for each in several], axis=1),
            *(np.concatenate([getattr(each, name) for each in several]) for name in ("valid", "flags", "family")),
        )


class Algebra(Protocol):
    """Finds candidates for poses of a loop of six joints."""

    def candidates(self, T: np.ndarray, near: np.ndarray) -> Candidates:
        """For poses (N, 4, 4), lengths in sizes of the arm; near (n, N) are the rows where they are free."""


class LoopArm(InverseModel):
    """Arms solved as loops: candidates from an `Algebra`, and the forward model decides which ones are postures.

    Attributes
    ----------
    size : float
        Of the arm, metres.
    loop : Loop
        In sizes of the arm.
    """

    def __init__(self, table: DHTable) -> None:
        """Raises ValueError when the joints give less freedoms than they could."""
        super().__init__(table)
        chain = self.chain
        self.map = JointMap.of(chain)
        freedoms, possible = chain_mobility(chain), min(self.joints, 6)
        if freedoms < possible:
            raise ValueError(f"its {self.joints} joints give {freedoms} freedoms only")
        self.revolute = tuple(int(i) for i in np.flatnonzero(~chain.prismatic[: self.joints]))
        loop = Loop.of(chain)
        self.size = loop.size
        self.loop = loop.scaled(1 / self.size)
        self._unit = np.where(chain.prismatic[: self.joints], self.size, 1.0)[:, None]

    @abstractmethod
    def candidates(self, T: np.ndarray, near: np.ndarray) -> Candidates:
        """As `Algebra.candidates`, for the joints of the arm."""

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        start = self.map.rows(near, len(poses))
        branches, missing = self._branches(poses, start, tol)
        # Of a family, the member at the wished values may be out of reach: then the nearest one on a grid that is not.
        free = sorted({j for joints in self.anchors.values() for j in joints})
        for step in _ASIDE:
            lacking = np.flatnonzero(missing.any(axis=0))
            if not len(lacking):
                break
            aside = start[:, lacking]
            aside[free] += step
            found = self._branches(poses[lacking], aside, tol)[0]
            new = found.valid & missing[:, lacking]
            branch, pose = np.nonzero(new)
            branches.q[:, branch, lacking[pose]] = found.q[:, branch, pose]
            branches.flags[branch, lacking[pose]] = found.flags[branch, pose]
            branches.valid[branch, lacking[pose]], missing[branch, lacking[pose]] = True, False
            reached = lacking[new.any(axis=0)]
            branches.excess[reached], branches.failure[reached] = 0.0, Failure.NONE
        return branches

    def _branches(self, poses: np.ndarray, start: np.ndarray, tol: float) -> tuple[Branches, np.ndarray]:
        """All branches with free rows at start (n, N), and (K, N) which would be families if the rest could follow."""
        return self._settled(self.candidates(in_unit(poses, 1 / self.size), start / self._unit), poses, tol)

    def _settled(self, found: Candidates, poses: np.ndarray, tol: float) -> tuple[Branches, np.ndarray]:
        q = self.map.joints(found.rows * self._unit[:, None])
        branches, reached = settled(self.chain, self.size, q, found.valid, found.flags, poses, tol)
        return branches, found.family & ~reached

    def _slide_towards(self, batch: Batch, near: np.ndarray) -> None:
        poses = self.chain.forward(batch.q)
        super()._slide_towards(batch, near)
        self._kept_on(batch, poses)

    def _settle(self, batch: Batch, near: np.ndarray) -> np.ndarray:
        poses = self.chain.forward(batch.q)
        super()._settle(batch, near)
        self._kept_on(batch, poses)
        return np.where(batch.valid, outside(self, batch.q).max(axis=-1), np.inf)

    def _kept_on(self, batch: Batch, poses: np.ndarray) -> None:
        """Aligned joints that have slid are aligned to half of the digits only, where branches merge too."""
        slid = batch.valid & ((batch.flags & Flag.FREE_LINE) != 0)
        batch.q[slid] = Task(self.chain, self.size, 6).approached(batch.q[slid], poses[slid])[0]

    def unreachable(self, failure: Failure, excess: float) -> str:
        return f"no posture reaches the pose, the nearest one found misses it by {excess:.3g} m"


def anchored(flags: np.ndarray) -> np.ndarray:
    """Whether flags say that a joint is free by itself."""
    return (flags & _ANCHORED) != 0
