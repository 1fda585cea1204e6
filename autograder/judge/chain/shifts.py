"""How far links must be shifted, once they are turned: linear equations, with coefficients of the reference alone.

The frame of joint i may land beyond O_i on its own axis: the shift along the axis is t. `SegmentDemands` tells which
rotations of a segment leave room for the t that its first axis brings along, and what t its last axis passes on.
`link_shifts` then settles the shifts of all links together, with as few freedoms as possible.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .freedoms import Freedom
from .linear import Equations, LeastSquares, SolutionSpace, pseudo_inverse, times, together
from .problem import Problem
from .segments import Segment


@dataclass(frozen=True, eq=False)
class SegmentDemands:
    """What a segment asks of the shifts of its two axes along themselves, for each of c rotations.

    Unknown are the shift of the first axis (of the whole base, 3 numbers, if there is none), the strokes of the
    prismatic joints that may have another zero, and the shift of the last axis.
    """

    segment: Segment
    equations: Equations
    tolerance: float

    @classmethod
    def of(cls, problem: Problem, segment: Segment, rotations: np.ndarray) -> SegmentDemands:
        """rotations: (c, K, 3, 3)."""
        equations = together(_segment_equations(problem, segment, rotations))
        return cls(segment, equations, problem.length_tolerance)

    @property
    def _head(self) -> int:
        """Number of unknowns of the first axis."""
        return 3 if self.segment.entry is None else 1

    @cached_property
    def _solved(self) -> LeastSquares:
        """All rotations, the first shift unknown."""
        return LeastSquares.of(self.equations, self.tolerance)

    @cached_property
    def _rest(self) -> tuple[np.ndarray, np.ndarray]:
        """Coefficients of all unknowns but the first shift, and their pseudo-inverse."""
        rows = self.equations.rows[:, :, self._head :]
        return rows, pseudo_inverse(rows)

    def met(self, number: int, shift: np.ndarray | None, base_moves: bool) -> tuple[bool, np.ndarray | None]:
        """Whether a rotation fits a shift (K,) of the first axis (None: any), and the shift of the last axis.

        number: of the rotation. base_moves: whether a segment at the base has a shift at all.
        """
        if self.segment.entry is None and not base_moves:
            return self._met_from(self.equations.wanted[number])
        solved = self._solved
        if not solved.exact[number]:
            return False, None
        if shift is None:
            return True, self._last(solved, number)
        if solved.settled[0]:
            agrees = bool((np.abs(solved.solutions[number, :, 0] - shift) <= self.tolerance).all())
            return agrees, self._last(solved, number)
        return self._met_from(self.equations.wanted[number] - self.equations.rows[:, :, 0] * shift[:, None])

    def _met_from(self, wanted: np.ndarray) -> tuple[bool, np.ndarray | None]:
        """The same where the first shift is known and stands in the right-hand side."""
        rows, inverse = self._rest
        solved = LeastSquares.of(Equations(rows, wanted[None]), self.tolerance, inverse)
        fits = bool(solved.exact[0])
        return fits, self._last(solved, 0) if fits else None

    def _last(self, solved: LeastSquares, number: int) -> np.ndarray | None:
        known = self.segment.exit is not None and solved.settled[-1]
        return solved.solutions[number, :, -1] if known else None


def _segment_equations(problem: Problem, segment: Segment, rotations: np.ndarray) -> Iterator[Equations]:
    """Equations for (shift of the first axis, strokes, shift of the last axis)."""
    reference, student = problem.reference, problem.student
    axes, origins = reference.axes, reference.origins
    count, entry, exit_ = len(axes), segment.entry, segment.exit
    head = np.broadcast_to(np.eye(3), (count, 3, 3)) if entry is None else axes[:, entry, :, None]
    strokes = [joint for joint in segment.sliders if problem.is_free(Freedom.ZERO, joint)]
    tail = np.zeros((count, 3, int(exit_ is not None)))
    columns = np.concatenate([head, *(-axes[:, joint, :, None] for joint in strokes), tail], axis=2)

    def columns_until(joint: int) -> np.ndarray:
        """The columns without the strokes of later joints, which do not move this one."""
        kept = columns.copy()
        kept[:, :, [head.shape[2] + k for k, slider in enumerate(strokes) if slider > joint]] = 0
        return kept

    def missing(ours: np.ndarray, theirs: np.ndarray) -> np.ndarray:
        """How far a point of the student's, turned, lies from the one it must land on."""
        return ours - times(rotations, theirs)

    yield Equations(columns[:, :0], np.zeros((len(rotations), count, 0)))  # where nothing is asked
    start = 0 if entry is None else missing(origins[:, entry], student.origins[:, entry])
    if exit_ is not None:
        columns_with_last = columns.copy()
        columns_with_last[:, :, -1] = -axes[:, exit_]
        yield Equations(columns_with_last, missing(origins[:, exit_], student.origins[:, exit_]) - start)
    elif not np.isfinite(problem.price_of_tool):
        yield Equations(columns, missing(reference.end[:, :3, 3], student.end[:, :3, 3]) - start)
    for joint in segment.carried:
        landing = Equations(columns_until(joint), missing(origins[:, joint], student.origins[:, joint]) - start)
        along = axes[:, joint, :, None] * axes[:, joint, None, :]
        if not problem.is_free(Freedom.ORIGIN, joint) and not problem.is_end(joint):
            yield landing.projected(along)
        if joint in segment.sliders and not problem.is_free(Freedom.AXIS, joint):
            yield landing.projected(np.eye(3) - along)


@dataclass(frozen=True, eq=False)
class _Links:
    """Links already turned by ``rotations`` (K, n + 1, 3, 3): link k is then shifted by ``fixed[k] + moves[k] @ x``.

    The unknowns x are the shift of the base and the strokes of the prismatic joints ``sliders``; ``moves``
    (K, n + 1, 3, x), ``fixed`` (K, n + 1, 3).
    """

    rotations: np.ndarray
    sliders: list[int]
    moves: np.ndarray
    fixed: np.ndarray

    @classmethod
    def of(cls, problem: Problem, rotations: np.ndarray) -> _Links:
        reference = problem.reference
        sliders = [joint for joint, slides in enumerate(reference.prismatic) if slides]
        moves = np.zeros((*rotations.shape[:3], 3 + len(sliders)))
        moves[..., :3] = np.eye(3)
        for k, joint in enumerate(sliders):
            moves[:, joint + 1 :, :, 3 + k] = -reference.axes[:, None, joint]
        fixed = np.zeros(rotations.shape[:3])
        fixed[:, 1:] = np.cumsum(times(rotations[:, :-1] - rotations[:, 1:], problem.student.origins), axis=1)
        return cls(rotations, sliders, moves, fixed)

    def landing(self, link: int, ours: np.ndarray, theirs: np.ndarray) -> Equations:
        """'This point (K, 3) of the student's link lands on that one.'"""
        return Equations(self.moves[:, link], ours - times(self.rotations[:, link], theirs) - self.fixed[:, link])

    def shifts(self, x: np.ndarray) -> np.ndarray:
        """Shifts of the links, (K, n + 1, 3), for unknowns (K, x)."""
        return self.fixed + times(self.moves, x[:, None])


def link_shifts(problem: Problem, rotations: np.ndarray, base_moves: bool) -> tuple[np.ndarray, float]:
    """Shifts of the links, (K, n + 1, 3), for their rotations, and the price of the freedoms that they use.

    What must hold does hold; then as many freedoms as possible are left unused.
    """
    links = _Links.of(problem, rotations)
    conditions = list(_conditions(problem, links, base_moves))
    solution = SolutionSpace.whole(len(links.moves), links.moves.shape[-1])
    required = [equations for price, equations in conditions if not np.isfinite(price)]
    if required:
        solution = solution.narrowed(together(required))
    wished = sorted((each for each in conditions if np.isfinite(each[0])), key=lambda each: -each[0])
    x, cost = _cheapest(solution, wished, problem.length_tolerance)
    return links.shifts(x), cost


def _conditions(problem: Problem, links: _Links, base_moves: bool) -> Iterator[tuple[float, Equations]]:
    """Equations, each with the price of not meeting it, which is infinite where it must be met."""
    reference, student = problem.reference, problem.student
    count, _, _, size = links.moves.shape
    if not base_moves:
        yield np.inf, Equations(np.broadcast_to(np.eye(3, size), (count, 3, size)), np.zeros((count, 3)))
    if problem.agree(links.rotations[None, :, -1], problem.end_rotation)[0]:
        yield problem.price_of_tool, links.landing(-1, reference.end[:, :3, 3], student.end[:, :3, 3])
    for k, joint in enumerate(links.sliders):
        stroke = np.broadcast_to(np.eye(1, size, 3 + k), (count, 1, size))
        yield problem.price_at(Freedom.ZERO, joint), Equations(stroke, np.zeros((count, 1)))
    for joint in range(reference.joints):
        along = reference.axes[:, joint, :, None] * reference.axes[:, joint, None, :]
        landing = links.landing(joint + 1, reference.origins[:, joint], student.origins[:, joint])
        price_of_axis = problem.price_at(Freedom.AXIS, joint) if joint in links.sliders else np.inf
        yield price_of_axis, landing.projected(np.eye(3) - along)
        if not problem.is_end(joint):
            yield problem.price_at(Freedom.ORIGIN, joint), landing.projected(along)


def _cheapest(
    solution: SolutionSpace, wished: list[tuple[float, Equations]], tolerance: float
) -> tuple[np.ndarray, float]:
    """Meets wishes greedily, dearest first; each wish has its turn at being the very first."""
    best, best_cost = solution.point, np.inf
    for first in wished if solution.dimension and wished else [None]:
        tried = _granted(solution, [first, *wished], tolerance) if first else solution
        cost = sum(price for price, equations in wished if not tried.meets(equations, tolerance))
        if cost < best_cost:
            best, best_cost = tried.point, cost
        if best_cost == 0:
            break
    return best, best_cost


def _granted(solution: SolutionSpace, wished: list[tuple[float, Equations]], tolerance: float) -> SolutionSpace:
    """The solutions that meet the wishes one after the other, without those that no longer can be met."""
    for _, equations in wished:
        if solution.dimension == 0:
            break
        if solution.leaves_open(equations):
            narrowed = solution.narrowed(equations)
            solution = narrowed if narrowed.meets(equations, tolerance) else solution
    return solution
