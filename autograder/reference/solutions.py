"""What an inverse model answers: all postures of one pose, or of a batch of poses."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from .marks import FREE, LIMIT

STATUS = ("solved", "boundary", "unreachable", "infinite")
SOLVED, BOUNDARY, UNREACHABLE, INFINITE = range(4)

# Why a pose cannot be reached.
NOTHING, BEYOND, SHORT, INSIDE, TILTED, OFF, LIMITED = range(7)


class Words(Protocol):
    """How an inverse model speaks about its branches; the numbers are in Batch."""

    branches: int

    def label(self, branch: int, marks: int) -> str: ...

    def free(self, marks: int) -> str: ...

    def unreachable(self, cause: int, miss: float) -> str: ...


@dataclass(frozen=True)
class Solutions:
    """All postures that bring the robot to one pose, in the robot's fixed branch order.

    q: (k, n), radians (in (-pi, pi] unless joint limits ask for more turns) or metres.
    labels: the branch of each row, in words.
    status: "solved"; "boundary" (branches merge on a limit of the workspace); "unreachable"
        (k = 0); "infinite" (at least one row stands for a family).
    reason: in words; for "unreachable" it says by how much.
    free: the free direction in words ("q4 + q6 = const", "q1 free"), "" when there is none.
    free_by_row: the same for each row: at a wrist singularity only some rows are families.
    miss: metres (radians when the reason speaks of an angle) by which the pose is out of
        reach, else 0.
    """

    q: np.ndarray
    labels: tuple[str, ...]
    status: str
    reason: str
    free: str
    free_by_row: tuple[str, ...]
    miss: float

    def __len__(self) -> int:
        return len(self.q)


@dataclass(frozen=True)
class Nearest:
    """The posture nearest to a given one, or why there is none.

    q: (n,) or None. distance: Euclidean norm of the angle differences modulo 2 pi (radians)
    and of the slides (metres); infinity when there is no posture. The other fields are those
    of Solutions, for the chosen row.
    """

    q: np.ndarray | None
    distance: float
    label: str
    status: str
    reason: str
    free: str


@dataclass(frozen=True)
class Batch:
    """All postures of N poses as arrays; column j of the branches is always the same branch.

    q: (N, K, n); rows that are not valid hold 0. valid: (N, K) bool. marks: (N, K) bits of
    `planar`, what is special about a posture. miss: (N,) metres or radians out of reach.
    cause: (N,) which constraint fails. ``batch[i]`` is the Solutions of pose i.
    """

    q: np.ndarray
    valid: np.ndarray
    marks: np.ndarray
    miss: np.ndarray
    cause: np.ndarray
    words: Words = field(repr=False)

    def __len__(self) -> int:
        return len(self.q)

    @property
    def count(self) -> np.ndarray:
        """Number of postures of each pose, (N,); a family counts once."""
        return self.valid.sum(axis=1)

    @property
    def status(self) -> np.ndarray:
        """Index into STATUS for each pose, (N,)."""
        return _status(self.valid, self.marks)

    def __getitem__(self, index: int) -> Solutions:
        rows = np.flatnonzero(self.valid[index])
        marks = [int(m) for m in self.marks[index, rows]]
        turns = self.q.shape[1] // self.words.branches
        labels = tuple(self.words.label(int(b) // turns, m) for b, m in zip(rows, marks))
        free_by_row = tuple(self.words.free(m) for m in marks)
        free = "; ".join(dict.fromkeys(text for text in free_by_row if text))
        status = STATUS[_status(self.valid[index], self.marks[index])]
        miss = float(self.miss[index]) if status == "unreachable" else 0.0
        if status == "unreachable":
            reason = self.words.unreachable(int(self.cause[index]), miss)
        elif status == "infinite":
            reason = f"a whole family of postures reaches the pose: {free}"
        elif status == "boundary":
            reason = "on the limit of the workspace, where branches merge: " + labels[0]
        else:
            reason = "1 posture" if len(rows) == 1 else f"{len(rows)} postures"
        return Solutions(self.q[index, rows] + 0.0, labels, status, reason, free, free_by_row, miss)


def _status(valid, marks) -> np.ndarray:
    marks = np.bitwise_or.reduce(np.where(valid, marks, 0), axis=-1)
    status = np.where(marks & LIMIT, BOUNDARY, SOLVED)
    status = np.where(marks & FREE, INFINITE, status)
    return np.where(valid.any(axis=-1), status, UNREACHABLE)
