"""How a segment of one chain can be turned onto the same segment of the other.

A segment with two directions that are not parallel, or with two parallel axes some distance apart, leaves at most
four rotations, one for each choice of senses. Any other segment is free to turn about its direction; it takes over
the rotation of a neighbour, or one that keeps its own frames.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from dhkit.geometry import cross

from .frames import JudgedChain
from .freedoms import Freedom
from .linear import RANK, transposed
from .problem import Problem
from .segments import Segment

_EQUAL = 1e-9

# Columns of a triad (first axis, what is across it, normal of both) that change sign together.
_SENSES_OF_TWO_AXES = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
_SENSES_OF_PARALLEL_AXES = np.array([[1, 1, 1], [-1, 1, -1]])


@dataclass(frozen=True)
class Rotations:
    """Candidates for the rotation of a segment: ``matrices`` (c, K, 3, 3) with their ``prices`` (c,).

    ``senses`` (c, directions) has +1 where an axis of the segment keeps its sense, -1 where it is reversed.
    """

    matrices: np.ndarray
    senses: np.ndarray
    prices: np.ndarray


def determined_rotations(problem: Problem, segment: Segment) -> Rotations | None:
    """The candidates of a segment that is not free to turn; None if it is."""
    second = _second_direction(problem, segment)
    if second is None:
        return None
    ours, theirs, senses = second
    first = segment.directions[0]
    triad = _triad(problem.reference.axes[:, first], ours)
    other = _triad(problem.student.axes[:, first], theirs)
    return _admissible(problem, segment, (triad * senses[:, None, None, :]) @ transposed(other))


def free_rotations(problem: Problem, segment: Segment, neighbours: Iterable[np.ndarray]) -> Rotations:
    """Candidates worth trying for a segment that may turn about its direction.

    neighbours: (K, 3, 3) rotations of the segments before and after it.
    """
    candidates = [*_identity(problem), problem.end_rotation, *neighbours]
    for joint in segment.directions[:1]:
        ours, theirs = problem.reference.frames[:, joint, :3, :3], problem.student.frames[:, joint, :3, :3]
        candidates += [ours @ transposed(theirs), ours * (1, -1, -1) @ transposed(theirs)]
    matrices = np.stack(candidates)
    same = np.abs(matrices[:, None] - matrices[None]).max(axis=(2, 3, 4)) < _EQUAL
    return _admissible(problem, segment, matrices[~np.tril(same, -1).any(axis=1)])


def no_rotation(problem: Problem, segment: Segment) -> Rotations:
    """The one candidate of a segment that stays as it is."""
    return _admissible(problem, segment, _identity(problem))


def _identity(problem: Problem) -> np.ndarray:
    return np.broadcast_to(np.eye(3), (1, len(problem.reference.end), 3, 3))


def _second_direction(problem: Problem, segment: Segment) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """What fixes a segment besides its first axis: in the reference, in the student's chain, and senses to try.

    Another axis that is not parallel to the first, or the way from its first axis to its last one.
    """
    if len(segment.directions) < 2:
        return None
    first, *others = segment.directions
    ours, theirs = problem.reference.axes, problem.student.axes
    sines = np.linalg.norm(cross(ours[:, [first]], ours[:, others]), axis=-1).min(axis=0)
    if (sines > RANK).any():
        second = others[int(np.argmax(sines > RANK))]
        return ours[:, second], theirs[:, second], _SENSES_OF_TWO_AXES
    if segment.entry is None or segment.exit is None:
        return None
    way, other_way = (_across(chain, segment.entry, segment.exit) for chain in (problem.reference, problem.student))
    if np.linalg.norm(way, axis=-1).min() <= RANK:
        return None
    return way, other_way, _SENSES_OF_PARALLEL_AXES


def _admissible(problem: Problem, segment: Segment, matrices: np.ndarray) -> Rotations:
    """Those of the rotations that carry every direction onto its own, up to sense, and are not pinned away."""
    joints = segment.directions
    carried = matrices @ transposed(problem.student.axes[:, joints])
    wanted = transposed(problem.reference.axes[:, joints])
    senses = np.where((carried[:, 0] * wanted[0]).sum(axis=-2) >= 0, 1, -1)
    prescribed = problem.prescribed[joints]
    fits = problem.agree(carried, wanted * senses[:, None, None])
    fits &= ((prescribed == 0) | (senses == prescribed)).all(axis=1)
    matrices, senses = matrices[fits], senses[fits]
    prices = _prices(problem, segment, matrices, senses)
    allowed = np.isfinite(prices)
    return Rotations(matrices[allowed], senses[allowed], prices[allowed])


def _prices(problem: Problem, segment: Segment, matrices: np.ndarray, senses: np.ndarray) -> np.ndarray:
    """What the rotations cost: reversed axes, other X axes, and another tool frame, (c,)."""
    prices = np.zeros(len(matrices))
    if segment.exit is None:
        prices[~problem.agree(matrices, problem.end_rotation)] += problem.price_of_tool
    x = matrices @ transposed(problem.student.normals[:, segment.carried])
    wanted = transposed(problem.reference.normals[:, segment.carried])
    for k, joint in enumerate(segment.carried):
        motor = problem.motor_senses[joint]
        prices[senses[:, k] < 0] += problem.price_at(Freedom.Z, joint)
        if motor:
            prices[senses[:, k] * motor < 0] += problem.price_at(Freedom.SENSE, joint)
        if problem.is_end(joint):
            continue
        kept, reversed_ = (problem.agree(x[..., k], sign * wanted[..., k]) for sign in (1, -1))
        prices[reversed_] += problem.price_at(Freedom.X, joint)
        prices[~kept & ~reversed_] += problem.price_at(Freedom.X_DIRECTION, joint)
    return prices


def _across(chain: JudgedChain, entry: int, exit: int) -> np.ndarray:
    """From one axis to another, at right angles to the first, (K, 3)."""
    axis = chain.axes[:, entry]
    between = chain.origins[:, exit] - chain.origins[:, entry]
    return between - (between * axis).sum(axis=-1, keepdims=True) * axis


def _triad(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Right-handed frames with x along `first` and y towards `second`, (K, 3, 3); nan where these are parallel."""
    normal = cross(first, second)
    with np.errstate(all="ignore"):
        normal = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    return np.stack([first, cross(normal, first), normal], axis=-1)
