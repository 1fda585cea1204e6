"""The cheapest way to lay the links of one chain on those of another: a shortest path through the segments."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .frames import JudgedChain
from .freedoms import Freedom, Price
from .problem import Problem
from .rotations import Rotations, determined_rotations, free_rotations, no_rotation
from .segments import Segment, segments
from .shifts import SegmentDemands, link_shifts


@dataclass(frozen=True)
class Alignment:
    """Rigid motions that carry the student's links (0 the base, n the hand) onto the reference's.

    Attributes
    ----------
    rotations : (K, n + 1, 3, 3) array
    shifts : (K, n + 1, 3) array
        Metres; a point p of link k goes to ``rotations[k] @ p + shifts[k]``.
    senses : (n,) array
        +1 where Z_i goes to Z_i, -1 where it is reversed.
    cost : float
        Price of the freedoms used.
    """

    rotations: np.ndarray
    shifts: np.ndarray
    senses: np.ndarray
    cost: float


@dataclass(frozen=True)
class DeadEnd:
    """No alignment: nothing fits from this segment on, though everything before it does.

    ``turned``: whether the segment can be turned as it should be. ``senses``: those of the joints before, from 0.
    """

    segment: Segment
    turned: bool
    senses: dict[int, int]


def align(
    student: JudgedChain, reference: JudgedChain, senses: np.ndarray, price: Price, tolerance: float
) -> Alignment | DeadEnd:
    """The cheapest way to lay `student` on `reference`, joint types being the same.

    Parameters
    ----------
    student, reference : JudgedChain
    senses : (n,) array
        +1 or -1 where the sense of an axis is prescribed, 0 where it is not.
    price : Price
    tolerance : float
        Radians, and lengths relative to the larger of 1 m and the robot.
    """
    problem = Problem(student, reference, senses, price, tolerance)
    stretches = [_Stretch.of(problem, segment) for segment in segments(reference.prismatic)]
    # Whether the base moves is settled first: what it spares shows only at the other end of the chain.
    kept = _cheapest(problem, stretches, base_moves=False)
    if not np.isfinite(problem.price_of_base) or (isinstance(kept, Alignment) and kept.cost <= problem.price_of_base):
        return kept
    moved = _cheapest(problem, stretches, base_moves=True)
    if isinstance(moved, DeadEnd):
        return moved
    moved = replace(moved, cost=moved.cost + problem.price_of_base)
    return moved if isinstance(kept, DeadEnd) or moved.cost < kept.cost else kept


@dataclass(frozen=True)
class _Stretch:
    """A segment; with its candidates and what they ask for, unless it is free to turn."""

    segment: Segment
    rotations: Rotations | None
    demands: SegmentDemands | None

    @classmethod
    def of(cls, problem: Problem, segment: Segment) -> _Stretch:
        rotations = determined_rotations(problem, segment)
        if rotations is None:
            return cls(segment, None, None)
        return cls(segment, rotations, SegmentDemands.of(problem, segment, rotations.matrices))


@dataclass(frozen=True)
class _Step:
    """A rotation chosen for a segment and the cheapest path that leads there.

    ``senses`` of the segment's axes; ``shift`` (K,) of its last axis along itself, None where it may be any.
    """

    rotation: np.ndarray
    senses: dict[int, int]
    shift: np.ndarray | None
    cost: float
    before: _Step | None

    def path(self) -> list[_Step]:
        """The steps up to this one, base first."""
        return [*([] if self.before is None else self.before.path()), self]

    def senses_so_far(self) -> dict[int, int]:
        """Senses of all axes up to here."""
        return {joint: sense for step in self.path() for joint, sense in step.senses.items()}


def _cheapest(problem: Problem, stretches: list[_Stretch], base_moves: bool) -> Alignment | DeadEnd:
    """The cheapest alignment that moves the base frame, or one that does not."""
    steps: list[_Step] = []
    for i, stretch in enumerate(stretches):
        rotations, demands = stretch.rotations, stretch.demands
        if rotations is None or demands is None:
            rotations = _rotations_of_free_segment(problem, stretches[i:], steps, base_moves)
            demands = SegmentDemands.of(problem, stretch.segment, rotations.matrices)
        previous, steps = steps, _next_steps(problem, rotations, demands, steps, base_moves)
        if not steps:
            cheapest = min(previous, key=lambda step: step.cost, default=None)
            senses = cheapest.senses_so_far() if cheapest else {}
            return DeadEnd(stretch.segment, len(rotations.matrices) > 0, senses)
    return _cheapest_with_shifts(problem, steps, base_moves)


def _rotations_of_free_segment(
    problem: Problem, stretches: list[_Stretch], steps: list[_Step], base_moves: bool
) -> Rotations:
    """Candidates for the first of these stretches, from its neighbours: the steps before and the stretches after it."""
    segment = stretches[0].segment
    if segment.entry is None and not base_moves:
        return no_rotation(problem, segment)
    following = next((later.rotations.matrices for later in stretches if later.rotations is not None), ())
    return free_rotations(problem, segment, [*(step.rotation for step in steps), *following])


def _next_steps(
    problem: Problem, rotations: Rotations, demands: SegmentDemands, steps: list[_Step], base_moves: bool
) -> list[_Step]:
    """The steps to a segment's rotations, each taken from where it is cheapest; one for each shift passed on."""
    segment = demands.segment
    found: list[_Step] = []
    for number, rotation in enumerate(rotations.matrices):
        if segment.entry is None and not base_moves and np.abs(rotation - np.eye(3)).max() > problem.tolerance:
            continue
        senses = dict(zip(segment.directions, rotations.senses[number].tolist(), strict=True))
        reached: list[_Step] = []
        for before in steps or (None,):
            cost = float(rotations.prices[number]) + _price_of_path(problem, segment, rotation, senses, before)
            if not np.isfinite(cost):
                continue
            met, shift = demands.met(number, before.shift if before else None, base_moves)
            if met:
                _keep_cheaper(reached, _Step(rotation, senses, shift, cost, before), problem.length_tolerance)
        found += reached
    return found


def _price_of_path(
    problem: Problem, segment: Segment, rotation: np.ndarray, senses: dict[int, int], before: _Step | None
) -> float:
    """The price of the path up to a segment, and of the zero of the joint that it passes; infinite if they disagree."""
    if before is None or segment.entry is None:
        return 0.0
    if before.senses[segment.entry] != senses[segment.entry]:
        return np.inf
    turned = np.abs(before.rotation - rotation).max() > problem.tolerance
    return before.cost + (problem.price_at(Freedom.ZERO, segment.entry) if turned else 0.0)


def _keep_cheaper(reached: list[_Step], new: _Step, tolerance: float) -> None:
    """Adds a step to those of the same rotation, of which two that pass on the same shift are one."""
    for i, old in enumerate(reached):
        if _same_shift(old.shift, new.shift, tolerance):
            if new.cost < old.cost:
                reached[i] = new
            return
    reached.append(new)


def _same_shift(one: np.ndarray | None, other: np.ndarray | None, tolerance: float) -> bool:
    if one is None or other is None:
        return one is other
    return bool((np.abs(one - other) <= tolerance).all())


def _cheapest_with_shifts(problem: Problem, last_steps: list[_Step], base_moves: bool) -> Alignment:
    """Of the paths that reach the hand, the one that is cheapest with what the shifts of its links cost."""
    first, *others = sorted(last_steps, key=lambda step: step.cost)
    best = _with_shifts(problem, first, base_moves)
    for step in others:
        if step.cost < best.cost:
            found = _with_shifts(problem, step, base_moves)
            best = found if found.cost < best.cost else best
    return best


def _with_shifts(problem: Problem, last_step: _Step, base_moves: bool) -> Alignment:
    reference = problem.reference
    rotations = np.empty((len(reference.end), reference.joints + 1, 3, 3))
    for segment, step in zip(segments(reference.prismatic), last_step.path(), strict=True):
        start = 0 if segment.entry is None else segment.entry + 1
        rotations[:, start : start + len(segment.sliders) + 1] = step.rotation[:, None]
    shifts, price = link_shifts(problem, rotations, base_moves)
    senses = last_step.senses_so_far()
    in_order = np.array([senses[joint] for joint in range(reference.joints)], dtype=int)
    return Alignment(rotations, shifts, in_order, last_step.cost + price)
