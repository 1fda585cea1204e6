"""What an inverse model answers: all postures of one pose, or of a batch of poses."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from .markdown import Markdown, table
from .status import Failure, Flag, Status

if TYPE_CHECKING:
    from .inverse import InverseModel


@dataclass(frozen=True, repr=False)
class Solutions:
    """All postures that bring the robot to one pose, in the robot's fixed branch order.

    Notebooks show them as a table; `to_markdown` has it in degrees and millimetres.

    Attributes
    ----------
    q : (k, n) array
        Radians (in (-pi, pi] unless joint limits ask for more turns) or metres.
    labels : tuple of k str
        The branch of each row, in words.
    status : Status
        SOLVED; BOUNDARY (branches merge on a limit of the workspace); UNREACHABLE (k = 0); INFINITE (at least one
        row stands for a family).
    reason : str
        In words; for UNREACHABLE it says by how much.
    free : str
        The free direction in words ("q4 + q6 = const", "q1 free"), "" when there is none.
    free_by_row : tuple of k str
        The same for each row: at a wrist singularity only some rows are families.
    excess : float
        Metres (radians when the reason speaks of an angle) by which the pose misses the condition that the reason
        names, else 0. It is no distance to the nearest pose that can be reached.
    slides : tuple of int
        Indices of the joints that slide, whose values are lengths.
    """

    q: np.ndarray
    labels: tuple[str, ...]
    status: Status
    reason: str
    free: str
    free_by_row: tuple[str, ...]
    excess: float
    slides: tuple[int, ...] = ()

    def __len__(self) -> int:
        return len(self.q)

    def __repr__(self) -> str:
        numbers = [[f"{value:8.4f}" for value in row] for row in self.q + 0.0]
        lines = [f"  {' '.join(row)}  {label}" for row, label in zip(numbers, self._labels_with_free())]
        return "\n".join([f"{self.status}: {self.reason}", *lines])

    def to_markdown(self, degrees: bool = False, millimetres: bool = False) -> Markdown:
        """The postures as a table that notebooks show typeset, in radians and metres unless told otherwise."""
        angle = (np.degrees(1.0), "°", 2) if degrees else (1.0, "rad", 4)
        length = (1000.0, "mm", 2) if millimetres else (1.0, "m", 4)
        units = [length if i in self.slides else angle for i in range(self.q.shape[1])]
        heads = [f"$q_{{{i}}}$ ({unit})" for i, (_, unit, _) in enumerate(units, start=1)]
        rows = [
            [*(f"{value * factor:.{digits}f}" for value, (factor, _, digits) in zip(row, units)), label]
            for row, label in zip(self.q, self._labels_with_free())
        ]
        text = f"**{self.status}**: {self.reason}"
        return Markdown(f"{text}\n\n{table([*heads, 'posture'], rows)}" if rows else text)

    def _labels_with_free(self) -> list[str]:
        return [f"{label}; {free}" if free else label for label, free in zip(self.labels, self.free_by_row)]

    def _repr_markdown_(self) -> str:
        return self.to_markdown()


@dataclass(frozen=True)
class Nearest:
    """The posture nearest to a given one, or why there is none.

    Attributes
    ----------
    q : (n,) array, or None
        Radians or metres.
    distance : float
        Euclidean norm of the angle differences (radians; modulo 2 pi unless limits were asked for) and of the slides
        (metres); infinity when there is no posture.
    label, status, reason, free
        As in `Solutions`, for this posture.
    """

    q: np.ndarray | None
    distance: float
    label: str
    status: Status
    reason: str
    free: str


@dataclass(frozen=True)
class Batch:
    """All postures of N poses as arrays; column j of the K branches is always the same branch.

    ``batch[i]`` is the `Solutions` of pose i.

    Attributes
    ----------
    q : (N, K, n) array
        Radians or metres; rows that are not valid hold 0.
    valid : (N, K) bool array
    flags : (N, K) uint8 array
        `Flag` bits: what is special about a posture.
    excess : (N,) array
        Metres or radians by which a pose misses the condition that `failure` names.
    failure : (N,) uint8 array
        `Failure`: which constraint the pose does not meet.
    model : InverseModel
        Names the branches.
    """

    q: np.ndarray
    valid: np.ndarray
    flags: np.ndarray
    excess: np.ndarray
    failure: np.ndarray
    model: InverseModel = field(repr=False)

    def __len__(self) -> int:
        return len(self.q)

    @property
    def count(self) -> np.ndarray:
        """Number of postures of each pose, (N,); a family counts once."""
        return self.valid.sum(axis=1)

    @property
    def status(self) -> np.ndarray:
        """`Status` of each pose, (N,)."""
        return _status(self.valid, self.flags)

    def __getitem__(self, index: int) -> Solutions:
        rows = np.flatnonzero(self.valid[index])
        flags = [int(each) for each in self.flags[index, rows]]
        turns = self.q.shape[1] // self.model.branch_count
        labels = tuple(self.model.label(int(row) // turns, each) for row, each in zip(rows, flags))
        free_by_row = tuple(self.model.free(each) if each else "" for each in flags)
        free = "; ".join(dict.fromkeys(text for text in free_by_row if text))
        status = Status(str(_status(self.valid[index], self.flags[index])))
        excess = float(self.excess[index]) if status == Status.UNREACHABLE else 0.0
        match status:
            case Status.UNREACHABLE:
                reason = self.model.reason(Failure(int(self.failure[index])), excess)
            case Status.INFINITE:
                reason = f"a whole family of postures reaches the pose: {free}"
            case Status.BOUNDARY:
                reason = "on the limit of the workspace, where branches merge: " + labels[0]
            case Status.SOLVED:
                reason = "1 posture" if len(rows) == 1 else f"{len(rows)} postures"
        slides = tuple(sorted(set(range(self.q.shape[2])) - set(self.model.revolute)))
        return Solutions(self.q[index, rows] + 0.0, labels, status, reason, free, free_by_row, excess, slides)


def _status(valid: np.ndarray, flags: np.ndarray) -> np.ndarray:
    flags = np.bitwise_or.reduce(np.where(valid, flags, 0), axis=-1)
    return np.select(
        [~valid.any(axis=-1), (flags & Flag.FREE) != 0, (flags & Flag.LIMIT) != 0],
        [Status.UNREACHABLE, Status.INFINITE, Status.BOUNDARY],
        Status.SOLVED,
    )
