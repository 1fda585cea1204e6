"""How the links of one chain can be laid on the links of another, and what that takes.

Two chains are the same when there are signs s, offsets o and constant frames B, E with
``T_ref(s q + o) = B T(q) E`` for all q. In the zero posture of both that is: every link k of the one chain
(0 the base, n the hand) is carried onto link k of the other by a rigid motion A_k, such that joint i, which sits
on links i-1 and i, is carried by both onto joint i of the other, up to its sense, and A_{i-1} differs from A_i by a
motion of that joint: ``A_{i-1} = motion(o_i) A_i``. Then ``B = A_0``, ``E = T(0)^-1 A_n^-1 T_ref(0)``.

Links joined by prismatic joints turn alike, so the rotations are those of *segments*, the stretches between
successive revolute joints. A segment with two directions that are not parallel, or with two parallel axes some
distance apart, leaves at most four rotations, one for each choice of senses; any other one is free to turn about
its direction and takes over the rotation of a neighbour. What a segment asks of the shift t of its axes along
themselves is linear, with coefficients of the reference alone. A shortest path through the segments' rotations
then finds the cheapest alignment; the work is linear in the number of joints.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

import numpy as np

from .frames import JudgedChain, cross

_RANK = 1e-7
_NEAR = 1e-9


class Freedom(StrEnum):
    """What two tables of the same chain may differ in."""

    BASE = "base frame"
    TOOL = "tool frame"
    ZERO = "zero of joint"
    SENSE = "sense of joint"
    Z = "sense of Z"
    X = "sense of X"
    X_DIRECTION = "direction of X"
    ORIGIN = "origin O"
    AXIS = "place of axis Z"


Price = Callable[[Freedom, int], float]
"""What it costs to use a freedom at a joint (0 for base and tool); infinite where it is pinned."""


@dataclass(frozen=True)
class Alignment:
    """Rigid motions of the links (0 the base, n the hand) and senses of the axes.

    ``rotations`` (K, n + 1, 3, 3), ``shifts`` (K, n + 1, 3), ``senses`` (n,) with +1 where Z_i goes to Z_i, and the
    price of the freedoms used.
    """

    rotations: np.ndarray
    shifts: np.ndarray
    senses: np.ndarray
    cost: float


@dataclass(frozen=True)
class Parted:
    """No alignment: nothing fits from this segment on, though everything before it does."""

    segment: Segment
    turned: bool
    senses: dict[int, int]


@dataclass(frozen=True)
class Segment:
    """Links between two successive revolute joints, with the prismatic joints between them (joints count from 0).

    ``entry`` is None at the base, ``exit`` at the hand.
    """

    entry: int | None
    sliders: tuple[int, ...]
    exit: int | None

    @property
    def carried(self) -> list[int]:
        """Joints whose frames are fixed on links of the segment."""
        return [*([] if self.entry is None else [self.entry]), *self.sliders]

    @property
    def directions(self) -> list[int]:
        """Joints whose axes the segment holds in place."""
        return [*self.carried, *([] if self.exit is None else [self.exit])]


def segments(prismatic: tuple[bool, ...]) -> list[Segment]:
    """The segments of a chain, base first."""
    found, entry, sliders = [], None, []
    for joint, slides in enumerate(prismatic):
        if slides:
            sliders.append(joint)
        else:
            found.append(Segment(entry, tuple(sliders), joint))
            entry, sliders = joint, []
    return [*found, Segment(entry, tuple(sliders), None)]


def align(
    student: JudgedChain, reference: JudgedChain, senses: np.ndarray, price: Price, tolerance: float
) -> Alignment | Parted:
    """The cheapest way to lay `student` on `reference`, joint types being the same.

    senses: (n,) with +1 or -1 where the sense of an axis is prescribed, 0 where it is not.
    """

    pair = _Pair(student, reference, senses, price, tolerance)
    # Whether the base moves is settled first: what it spares shows only at the other end of the chain.
    kept, price_of_base = pair.align(base_moves=False), price(Freedom.BASE, 0)
    if not np.isfinite(price_of_base) or (isinstance(kept, Alignment) and kept.cost <= price_of_base):
        return kept
    moved = pair.align(base_moves=True)
    if isinstance(moved, Alignment):
        moved = replace(moved, cost=moved.cost + price_of_base)
        return moved if isinstance(kept, Parted) or moved.cost < kept.cost else kept
    return moved


@dataclass(frozen=True)
class _Turns:
    """Possible rotations of a segment: (c, K, 3, 3), senses (c, directions), prices (c,)."""

    rotations: np.ndarray
    senses: np.ndarray
    prices: np.ndarray


@dataclass(frozen=True)
class _Node:
    """A rotation of a segment, the shift t of its last axis (None: any), and the cheapest way to it."""

    rotation: np.ndarray
    senses: dict[int, int]
    shift: np.ndarray | None
    cost: float
    before: _Node | None


class _Pair:
    def __init__(
        self, student: JudgedChain, reference: JudgedChain, senses: np.ndarray, price: Price, tolerance: float
    ) -> None:
        self.student, self.reference, self.prescribed, self.price = student, reference, senses, price
        self.tolerance = tolerance
        self.length_tolerance = tolerance * max(
            1.0, np.abs(reference.end[:, :3, 3]).max(), np.abs(reference.origins).max(initial=0)
        )
        self.motor = np.sign((student.coupling * reference.coupling).sum(axis=1))
        self.end_is_frame = student.ends_with_joint and reference.ends_with_joint

    @cached_property
    def _still(self) -> np.ndarray:
        """The rotation that changes nothing, (1, K, 3, 3)."""
        return np.broadcast_to(np.eye(3), (1, len(self.reference.end), 3, 3))

    @cached_property
    def end_rotation(self) -> np.ndarray:
        """Rotation of the hand that leaves the tool frame as it is."""
        return self.reference.end[:, :3, :3] @ _transposed(self.student.end[:, :3, :3])

    @cached_property
    def determined(self) -> list[tuple[Segment, _Turns | None, _Demands | None]]:
        """The segments, with rotations and what they ask for where the segment is not free to turn."""
        found = []
        for segment in segments(self.reference.prismatic):
            turns = self._determined_turns(segment)
            found.append((segment, turns, turns and _Demands(self, segment, turns.rotations)))
        return found

    def align(self, base_moves: bool) -> Alignment | Parted:
        nodes: list[_Node] = []
        for i, (segment, turns, demands) in enumerate(self.determined):
            if turns is None:
                following = next((later.rotations for _, later, _ in self.determined[i:] if later is not None), None)
                stays = segment.entry is None and not base_moves
                turns = self._checked(segment, self._still) if stays else self._free_turns(segment, nodes, following)
                demands = _Demands(self, segment, turns.rotations)
            previous, nodes = nodes, self._extend(turns, demands, nodes, base_moves)
            if not nodes:
                cheapest = min(previous, key=lambda node: node.cost, default=None)
                return Parted(segment, len(turns.rotations) > 0, self._senses(cheapest))
        best = None
        for node in sorted(nodes, key=lambda node: node.cost):
            if best is None or node.cost < best.cost:
                found = self._resolved(node, base_moves)
                best = found if best is None or found.cost < best.cost else best
        return best

    def _determined_turns(self, segment: Segment) -> _Turns | None:
        """The rotations of a segment that is not free to turn; None if it is."""
        first, *others = segment.directions or [None]
        if not others:
            return None
        ours, theirs = self.reference.axes, self.student.axes
        crosses = np.linalg.norm(cross(ours[:, [first]], ours[:, others]), axis=-1).min(axis=0)
        if (crosses > _RANK).any():
            second = others[int(np.argmax(crosses > _RANK))]
            signs = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
            our_second, their_second = ours[:, second], theirs[:, second]
        elif segment.entry is not None and segment.exit is not None:
            our_second, their_second = (_across(chain, segment) for chain in (self.reference, self.student))
            if np.linalg.norm(our_second, axis=-1).min() <= _RANK:
                return None
            signs = np.array([[1, 1, 1], [-1, 1, -1]])
        else:
            return None
        triad, other = _triad(ours[:, first], our_second), _triad(theirs[:, first], their_second)
        return self._checked(segment, (triad * signs[:, None, None, :]) @ _transposed(other))

    def _free_turns(self, segment: Segment, nodes: list[_Node], following: np.ndarray | None) -> _Turns:
        """Rotations worth trying for a segment that may turn about its direction."""
        guesses = [*self._still, self.end_rotation, *(node.rotation for node in nodes)]
        guesses += [] if following is None else list(following)
        for joint in segment.directions[:1]:
            ours, theirs = self.reference.frames[:, joint, :3, :3], self.student.frames[:, joint, :3, :3]
            guesses += [ours @ _transposed(theirs), ours * (1, -1, -1) @ _transposed(theirs)]
        turns = np.stack(guesses)
        same = np.abs(turns[:, None] - turns[None]).max(axis=(2, 3, 4)) < _NEAR
        return self._checked(segment, turns[~np.tril(same, -1).any(axis=1)])

    def _checked(self, segment: Segment, turns: np.ndarray) -> _Turns:
        """Those of the rotations that carry every direction onto its own, up to sense, and are not pinned away."""
        joints = segment.directions
        carried = turns @ _transposed(self.student.axes[:, joints])
        wanted = _transposed(self.reference.axes[:, joints])
        senses = np.where((carried[:, 0] * wanted[0]).sum(axis=-2) >= 0, 1, -1)
        fits = (np.abs(carried - wanted * senses[:, None, None]) <= self.tolerance).all(axis=(1, 2, 3))
        prescribed = self.prescribed[joints]
        fits &= ((prescribed == 0) | (senses == prescribed)).all(axis=1)
        turns, senses = turns[fits], senses[fits]
        prices = self._prices(segment, turns, senses)
        return _Turns(turns[np.isfinite(prices)], senses[np.isfinite(prices)], prices[np.isfinite(prices)])

    def _prices(self, segment: Segment, turns: np.ndarray, senses: np.ndarray) -> np.ndarray:
        prices = np.zeros(len(turns))
        carried = segment.carried
        if segment.exit is None:
            prices[self._differ(turns, self.end_rotation)] += self.price(Freedom.TOOL, 0)
        x = turns @ _transposed(self.student.normals[:, carried])
        wanted = _transposed(self.reference.normals[:, carried])
        for k, joint in enumerate(carried):
            prices[senses[:, k] < 0] += self.price(Freedom.Z, joint + 1)
            if self.motor[joint]:
                prices[senses[:, k] * self.motor[joint] < 0] += self.price(Freedom.SENSE, joint + 1)
            if self.end_is_frame and joint == self.student.joints - 1:
                continue
            kept, turned = (self._agree(x[..., k], sign * wanted[..., k]) for sign in (1, -1))
            prices[turned] += self.price(Freedom.X, joint + 1)
            prices[~kept & ~turned] += self.price(Freedom.X_DIRECTION, joint + 1)
        return prices

    def _agree(self, found: np.ndarray, wanted: np.ndarray) -> np.ndarray:
        return (np.abs(found - wanted) <= self.tolerance).all(axis=tuple(range(1, found.ndim)))

    def _differ(self, found: np.ndarray, wanted: np.ndarray) -> np.ndarray:
        return ~self._agree(found, wanted)

    def _extend(self, turns: _Turns, demands: _Demands, nodes: list[_Node], base_moves: bool) -> list[_Node]:
        """The nodes of a segment, each reached in the cheapest way."""
        segment = demands.segment
        best: list[_Node] = []
        for c, rotation in enumerate(turns.rotations):
            if segment.entry is None and not base_moves and np.abs(rotation - np.eye(3)).max() > self.tolerance:
                continue
            senses = dict(zip(segment.directions, turns.senses[c].tolist(), strict=True))
            for node in nodes or [None]:
                cost = float(turns.prices[c])
                if node is not None:
                    if node.senses[segment.entry] != senses[segment.entry]:
                        continue
                    turned = np.abs(node.rotation - rotation).max() > self.tolerance
                    cost += node.cost + (self.price(Freedom.ZERO, segment.entry + 1) if turned else 0)
                    if not np.isfinite(cost):
                        continue
                met, shift = demands.met(c, None if node is None else node.shift, base_moves)
                if met:
                    self._keep(best, _Node(rotation, senses, shift, cost, node))
        return best

    def _keep(self, best: list[_Node], new: _Node) -> None:
        for i, old in enumerate(best):
            if old.rotation is new.rotation and _same_shift(old.shift, new.shift, self.length_tolerance):
                if new.cost < old.cost:
                    best[i] = new
                return
        best.append(new)

    def _senses(self, node: _Node | None) -> dict[int, int]:
        senses: dict[int, int] = {}
        while node is not None:
            senses = node.senses | senses
            node = node.before
        return senses

    def _resolved(self, node: _Node, base_moves: bool) -> Alignment:
        count, cost = self.reference.joints, node.cost
        senses = self._senses(node)
        rotations = np.empty((len(self.reference.end), count + 1, 3, 3))
        for segment, _, _ in reversed(self.determined):
            start = 0 if segment.entry is None else segment.entry + 1
            rotations[:, start : start + len(segment.sliders) + 1] = node.rotation[:, None]
            node = node.before
        shifts, price = _Slides(self, rotations, base_moves).shifts()
        return Alignment(
            rotations, shifts, np.array([senses[joint] for joint in range(count)], dtype=int), cost + price
        )


class _Demands:
    """What a segment asks of the shifts t of its two axes along themselves (t: how far O_i lands beyond O_i).

    Unknown are the shift of the first axis (of the whole base, if there is none), the strokes of the prismatic
    joints that may have another zero, and the shift of the last axis.
    """

    def __init__(self, pair: _Pair, segment: Segment, turns: np.ndarray) -> None:
        self.segment, self.tolerance = segment, pair.length_tolerance
        self.has_entry, self.has_exit = segment.entry is not None, segment.exit is not None
        axes, origins = pair.reference.axes, pair.reference.origins
        count = len(axes)
        head = axes[:, segment.entry, :, None] if self.has_entry else np.broadcast_to(np.eye(3), (count, 3, 3))
        self.head = head.shape[2]
        free = [j for j in segment.sliders if np.isfinite(pair.price(Freedom.ZERO, j + 1))]
        columns = np.concatenate(
            [head, *(-axes[:, j, :, None] for j in free), np.zeros((count, 3, int(self.has_exit)))], axis=2
        )

        def until(joint: int) -> np.ndarray:
            """The columns without the strokes of later joints."""
            kept = columns.copy()
            kept[:, :, [head.shape[2] + k for k, j in enumerate(free) if j > joint]] = 0
            return kept

        def missing(point: np.ndarray, theirs: np.ndarray) -> np.ndarray:
            return point - (turns @ theirs[..., None])[..., 0]

        start = missing(origins[:, segment.entry], pair.student.origins[:, segment.entry]) if self.has_entry else 0
        rows, wanted = [], []

        def demand(row: np.ndarray, gap: np.ndarray, projection: np.ndarray | None = None) -> None:
            if projection is not None:
                row, gap = projection @ row, (projection @ gap[..., None])[..., 0]
            rows.append(row)
            wanted.append(gap)

        if self.has_exit:
            row = columns.copy()
            row[:, :, -1] = -axes[:, segment.exit]
            demand(row, missing(origins[:, segment.exit], pair.student.origins[:, segment.exit]) - start)
        elif not np.isfinite(pair.price(Freedom.TOOL, 0)):
            demand(columns, missing(pair.reference.end[:, :3, 3], pair.student.end[:, :3, 3]) - start)
        for joint in segment.carried:
            along = axes[:, joint, :, None] * axes[:, joint, None, :]
            gap = missing(origins[:, joint], pair.student.origins[:, joint]) - start
            if not np.isfinite(pair.price(Freedom.ORIGIN, joint + 1)) and not (
                pair.end_is_frame and joint == len(origins[0]) - 1
            ):
                demand(until(joint), gap, along)
            if joint in segment.sliders and not np.isfinite(pair.price(Freedom.AXIS, joint + 1)):
                demand(until(joint), gap, np.eye(3) - along)
        self.rows = np.concatenate(rows, axis=1) if rows else None
        self.wanted = np.concatenate(wanted, axis=-1) if rows else None

    @cached_property
    def _open(self) -> _Solved:
        """All rotations, the first shift unknown."""
        return _Solved.of(self.rows, self.wanted, self.tolerance)

    @cached_property
    def _rows_after_head(self) -> tuple[np.ndarray, np.ndarray]:
        rows = self.rows[:, :, self.head :]
        return rows, _pseudo_inverse(rows)

    def met(self, turn: int, shift: np.ndarray | None, base_moves: bool) -> tuple[bool, np.ndarray | None]:
        """Whether rotation number `turn` fits a given shift of the first axis, and the shift of the last one."""
        if self.rows is None:
            return True, None
        base_stays = not self.has_entry and not base_moves
        if not base_stays:
            solved = self._open
            if not solved.fits[turn]:
                return False, None
            if shift is None or solved.settled[0]:
                met = shift is None or bool((np.abs(solved.solutions[turn, :, 0] - shift) <= self.tolerance).all())
                return met, solved.solutions[turn, :, -1] if self.has_exit and solved.settled[-1] else None
        wanted = self.wanted[turn] if base_stays else self.wanted[turn] - self.rows[:, :, 0] * shift[:, None]
        solved = _Solved.of(self._rows_after_head[0], wanted[None], self.tolerance, self._rows_after_head[1])
        last = self.has_exit and bool(solved.fits[0]) and solved.settled[-1]
        return bool(solved.fits[0]), solved.solutions[0, :, -1] if last else None


@dataclass(frozen=True)
class _Solved:
    """Least-squares solutions of ``rows x = wanted`` for several right-hand sides.

    ``solutions`` (c, K, x); ``fits`` (c,) where they are exact; ``settled`` (x,) for unknowns with one value only.
    """

    solutions: np.ndarray
    fits: np.ndarray
    settled: np.ndarray

    @classmethod
    def of(cls, rows: np.ndarray, wanted: np.ndarray, tolerance: float, inverse: np.ndarray | None = None) -> _Solved:
        inverse = _pseudo_inverse(rows) if inverse is None else inverse
        solutions = (inverse @ wanted[..., None])[..., 0]
        left = np.abs((rows @ solutions[..., None])[..., 0] - wanted)
        settled = np.diagonal(inverse @ rows, axis1=1, axis2=2) > 1 - _RANK
        return cls(solutions, (left <= tolerance).all(axis=(1, 2)), settled.all(axis=0))


class _Slides:
    """Shifts of all links for given rotations: what must hold, then as many freedoms left unused as possible.

    Unknown are the shift of the base and the strokes of the prismatic joints.
    """

    def __init__(self, pair: _Pair, rotations: np.ndarray, base_moves: bool) -> None:
        self.pair, self.rotations, self.base_moves = pair, rotations, base_moves
        self.tolerance = pair.length_tolerance
        reference, student = pair.reference, pair.student
        sliders = [j for j, slides in enumerate(reference.prismatic) if slides]
        count, size = len(rotations), 3 + len(sliders)
        moves = np.zeros((count, reference.joints + 1, 3, size))
        moves[..., :3] = np.eye(3)
        for k, joint in enumerate(sliders):
            moves[:, joint + 1 :, :, 3 + k] = -reference.axes[:, None, joint]
        fixed = np.zeros((count, reference.joints + 1, 3))
        steps = ((rotations[:, :-1] - rotations[:, 1:]) @ student.origins[..., None])[..., 0]
        fixed[:, 1:] = np.cumsum(steps, axis=1)
        self.moves, self.fixed, self.sliders = moves, fixed, sliders

    def _landing(self, link: int, ours: np.ndarray, theirs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rows and right-hand side of 'this point of the link lands on that one'."""
        return self.moves[:, link], ours - (self.rotations[:, link] @ theirs[..., None])[..., 0] - self.fixed[:, link]

    def _conditions(self):
        """Pairs of a price, infinite where there is no choice, and an equation (rows, right-hand side)."""
        pair, (count, _, _, size) = self.pair, self.moves.shape
        reference, student = pair.reference, pair.student
        if not self.base_moves:
            yield np.inf, (np.broadcast_to(np.eye(3, size), (count, 3, size)), np.zeros((count, 3)))
        if not pair._differ(self.rotations[None, :, -1], pair.end_rotation)[0]:
            yield pair.price(Freedom.TOOL, 0), self._landing(-1, reference.end[:, :3, 3], student.end[:, :3, 3])
        for k, joint in enumerate(self.sliders):
            stroke = np.broadcast_to(np.eye(1, size, 3 + k), (count, 1, size))
            yield pair.price(Freedom.ZERO, joint + 1), (stroke, np.zeros((count, 1)))
        for joint in range(reference.joints):
            along = reference.axes[:, joint, :, None] * reference.axes[:, joint, None, :]
            rows, wanted = self._landing(joint + 1, reference.origins[:, joint], student.origins[:, joint])
            off_axis = (np.eye(3) - along) @ rows, ((np.eye(3) - along) @ wanted[..., None])[..., 0]
            slides = joint in self.sliders
            yield pair.price(Freedom.AXIS, joint + 1) if slides else np.inf, off_axis
            if not (pair.end_is_frame and joint == reference.joints - 1):
                yield pair.price(Freedom.ORIGIN, joint + 1), (along @ rows, (along @ wanted[..., None])[..., 0])

    def shifts(self) -> tuple[np.ndarray, float]:
        """Shifts of the links, (K, n + 1, 3), and the price of the freedoms they use."""
        conditions = list(self._conditions())
        hard = [equation for price, equation in conditions if not np.isfinite(price)]
        soft = sorted(
            ((price, equation) for price, equation in conditions if np.isfinite(price)), key=lambda item: -item[0]
        )
        solution = _Solutions.all(len(self.moves), self.moves.shape[-1])
        if hard:
            rows, wanted = (np.concatenate(parts, axis=1) for parts in zip(*hard, strict=True))
            solution = solution.with_equation(rows, wanted)
        point, cost = self._cheapest(solution, soft)
        return self.fixed + (self.moves @ point[:, None, :, None])[..., 0], cost

    def _cheapest(self, solution: _Solutions, soft: list) -> tuple[np.ndarray, float]:
        """Meets soft conditions greedily, dearest first; each condition has its turn at being first."""
        best, best_cost = solution.point, np.inf
        for first in soft if solution.dimension and soft else [None]:
            tried = solution
            for _, (rows, wanted) in [first, *soft] if first else ():
                if tried.dimension == 0:
                    break
                if tried.leaves_open(rows):
                    narrowed = tried.with_equation(rows, wanted)
                    tried = narrowed if narrowed.meets(rows, wanted, self.tolerance) else tried
            cost = sum(price for price, (rows, wanted) in soft if not tried.meets(rows, wanted, self.tolerance))
            if cost < best_cost:
                best, best_cost = tried.point, cost
            if best_cost == 0:
                break
        return best, best_cost


@dataclass(frozen=True)
class _Solutions:
    """Solutions of linear equations at K points: ``point`` (K, x) plus any combination of ``basis`` (K, x, dimension)."""

    point: np.ndarray
    basis: np.ndarray

    @classmethod
    def all(cls, count: int, size: int) -> _Solutions:
        return cls(np.zeros((count, size)), np.broadcast_to(np.eye(size), (count, size, size)))

    @property
    def dimension(self) -> int:
        return self.basis.shape[-1]

    def leaves_open(self, rows: np.ndarray) -> bool:
        return bool(np.abs(rows @ self.basis).max() > _RANK)

    def meets(self, rows: np.ndarray, wanted: np.ndarray, tolerance: float) -> bool:
        return bool((np.abs((rows @ self.point[..., None])[..., 0] - wanted) <= tolerance).all())

    def with_equation(self, rows: np.ndarray, wanted: np.ndarray) -> _Solutions:
        """The solutions that meet one more equation, as nearly as they can."""
        gap = wanted - (rows @ self.point[..., None])[..., 0]
        u, s, vt = np.linalg.svd(rows @ self.basis)
        rank = int((s[0] > _RANK).sum())
        step = np.swapaxes(vt[:, :rank], 1, 2) @ ((_transposed(u[:, :, :rank]) @ gap[..., None]) / s[:, :rank, None])
        return _Solutions(self.point + (self.basis @ step)[..., 0], self.basis @ _transposed(vt[:, rank:]))


def _transposed(matrices: np.ndarray) -> np.ndarray:
    return np.swapaxes(matrices, -1, -2)


def _across(chain: JudgedChain, segment: Segment) -> np.ndarray:
    """From the first axis of a segment to its last one, at right angles to the first, (K, 3)."""
    axis = chain.axes[:, segment.entry]
    between = chain.origins[:, segment.exit] - chain.origins[:, segment.entry]
    return between - (between * axis).sum(axis=-1, keepdims=True) * axis


def _triad(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Right-handed frames with x along `first` and y towards `second`, (K, 3, 3); nan where these are parallel."""
    normal = cross(first, second)
    with np.errstate(all="ignore"):
        normal = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    return np.stack([first, cross(normal, first), normal], axis=-1)


def _pseudo_inverse(matrices: np.ndarray) -> np.ndarray:
    if 0 in matrices.shape:
        return np.zeros(_transposed(matrices).shape)
    return np.linalg.pinv(matrices, rcond=_RANK)


def _same_shift(one: np.ndarray | None, other: np.ndarray | None, tolerance: float) -> bool:
    if one is None or other is None:
        return one is other
    return bool((np.abs(one - other) <= tolerance).all())
