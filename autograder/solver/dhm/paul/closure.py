"""Paul's method: unknown joints, one after the other, from single elements of the closure equation.

With the pose U_0 of the last frame, ``iT0 U_0 nTk = (i+1 ... k)``: the matrices of known joints go to the left, and where
an element holds one unknown, or two elements hold two, they are of one of the types 1 to 8 of Khalil and Dombre. Angles
of parallel axes stay sums, which count as unknowns of their own (theta_23). As soon as the first joints are known, the pose
is seen from the frame behind them, and what it is there has a name: the F, G, H of Khalil and Dombre are s, n, a seen from
frame 3.

Source: R. Paul, "Robot Manipulators", 1981; W. Khalil, E. Dombre, "Modeling, Identification and Control of Robots", 2002,
chapter 4.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations, product

import numpy as np
import sympy as sp

from ..forward import merged_runs
from ..tables import DHRow
from ..transforms import rot_x, trans_x

U0 = sp.Matrix(
    [
        sp.symbols("s_x n_x a_x P_x"),
        sp.symbols("s_y n_y a_y P_y"),
        sp.symbols("s_z n_z a_z P_z"),
        [0, 0, 0, 1],
    ]
)
"""The pose of the last frame seen from the first: what is given."""

_GENERIC = 1e-9  # of a value in a posture in general position, under which an expression vanishes
_POINTS = 4  # such postures
_MOST_ON_THE_LEFT = 4  # matrices beside U0: with more of them nothing is easier
_ANGLE_AND_SLIDE, _TWO_ANGLES = 2, 5  # ranks of steps with two unknowns, among those with one
_WORTH_A_NAME = 3  # joints that are left, so that to see the pose from a later frame is worth the names
_SHORTEST = 8  # equations that are looked at for each unknown


@dataclass(frozen=True)
class Equation:
    """An element of the closure equation: left = right, known joints mostly on the left.

    Attributes
    ----------
    first, last : int
        The right side is the product of the matrices first + 1 ... last.
    element : (int, int)
        Row and column, counted from 0.
    left, right : sympy expressions
        With sums of angles as symbols.
    """

    first: int
    last: int
    element: tuple[int, int]
    left: sp.Expr
    right: sp.Expr

    @cached_property
    def difference(self) -> sp.Expr:
        """left - right, which is 0."""
        return self.left - self.right

    @cached_property
    def size(self) -> int:
        """How long it is to read."""
        return int(self.left.count_ops() + self.right.count_ops())


@dataclass(frozen=True)
class Solved:
    """One unknown and what it comes from.

    Attributes
    ----------
    unknown : Symbol
    helper : str
        "type1", "type2", "type3", or "quadratic": what solves for it; "sum" for what follows from the others.
    coefficients : tuple of sympy expressions
        X, Y of type 1; X, Y, Z of type 2; both rows of type 3; A, B, C of A r^2 + B r + C = 0; the expression of a sum.
    """

    unknown: sp.Symbol
    helper: str
    coefficients: tuple[sp.Expr, ...]


@dataclass(frozen=True)
class Step:
    """A step of the method: one or two equations, their type, and the unknowns they give.

    Attributes
    ----------
    kind : int
        The type, 1 to 8.
    equations : tuple of Equation
    solved : tuple of Solved
        In the order in which they are computed.
    seen : tuple of (Symbol, expression)
        Entries of the pose seen from a later frame that this step is the first to use, in the order in which they are
        computed.
    """

    kind: int
    equations: tuple[Equation, ...]
    solved: tuple[Solved, ...]
    seen: tuple[tuple[sp.Symbol, sp.Expr], ...] = ()

    @property
    def unknowns(self) -> tuple[sp.Symbol, ...]:
        """The unknowns that the equations give, without what follows from them as a sum."""
        return tuple(each.unknown for each in self.solved if each.helper != "sum")


@dataclass
class Angles:
    """The angles of the rows, and the sums of them that equations hold, as symbols of their own."""

    joints: tuple[sp.Symbol, ...]
    sums: dict[sp.Symbol, sp.Expr] = field(default_factory=dict)

    def symbol(self, angle: sp.Expr) -> sp.Symbol:
        """The symbol of an angle: itself, or theta_23 for theta_2 + theta_3."""
        if angle.is_Symbol:
            return angle
        for known, value in self.sums.items():
            if sp.expand(value - angle) == 0:
                return known
        signs = [(joint, angle.coeff(joint)) for joint in self.joints if angle.has(joint)]
        name = "".join(("m" if sign < 0 else "") + joint.name.removeprefix("theta_") for joint, sign in signs)
        rest = angle - sum(sign * joint for joint, sign in signs)
        found = sp.Symbol(f"theta_{name}" + ("" if rest == 0 else f"_{len(self.sums)}"))
        self.sums[found] = angle
        return found

    def in_symbols(self, expression: sp.Expr) -> sp.Expr:
        """The expression with sums of angles as symbols."""

        def named(function: sp.Expr) -> sp.Expr:
            angle = function.args[0]
            return function.func(self.symbol(angle)) if angle.has(*self.joints) else function

        return expression.replace(lambda e: isinstance(e, (sp.sin, sp.cos)), named)

    def following(self, known: set[sp.Symbol]) -> Iterator[Solved]:
        """What follows from known angles as sums and differences; adds it to them."""
        found = True
        while found:
            found = False
            for total, value in self.sums.items():
                parts = [joint for joint in self.joints if value.has(joint)]
                missing = [symbol for symbol in (*parts, total) if symbol not in known]
                if len(missing) != 1:
                    continue
                found = True
                known.add(missing[0])
                (result,) = sp.solve(value - total, missing[0])
                yield Solved(missing[0], "sum", (result,))


class Closure:
    """The equations of a chain, and the search for steps through them."""

    def __init__(self, rows: Sequence[DHRow], unknowns: Sequence[sp.Symbol], tip: sp.Matrix | None = None) -> None:
        """From rows whose variables are the unknowns; with a tip, only its place counts, which is P of U0.

        Parameters
        ----------
        rows : sequence of DHRow
        unknowns : sequence of Symbol
        tip : Matrix (4, 1), optional
            In the last frame, metres.
        """
        self.rows, self.unknowns, self.tip = tuple(rows), tuple(unknowns), tip
        self.angles = Angles(tuple(u for u, row in zip(unknowns, rows) if not row.sigma))
        self.frame, self.given, self.seen = 0, U0 if tip is None else U0[:, 3], dict[sp.Symbol, sp.Expr]()
        self._linear: dict[tuple, tuple[list, sp.Expr] | None] = {}
        self._points = [self._point(seed) for seed in range(_POINTS)]
        self.equations = self._equations()

    def _equations(self) -> list[Equation]:
        """All of the pose seen from the present frame whose left sides are not too long, shortest first."""
        found: dict[sp.Expr, Equation] = {}
        count = len(self.rows)
        behind = {count: sp.eye(4)}
        for last in reversed(range(1, count)):
            behind[last] = behind[last + 1] * _inverse(self.rows[last : last + 1])
        for last in [count] if self.tip is not None else range(count, 0, -1):
            given = self.given * behind[last] if self.tip is None else self.given
            for first in range(self.frame, min(last, self.frame + _MOST_ON_THE_LEFT + 1 - (count - last))):
                left = _inverse(self.rows[self.frame : first]) * given
                right = merged_runs(self.rows[first:last])
                right = right if self.tip is None else right * self.tip
                for row, column in product(range(3), range(left.shape[1])):
                    pair = [self.angles.in_symbols(side[row, column]) for side in (left, right)]
                    equation = Equation(first, last, (row, column if self.tip is None else 3), *pair)
                    if self._unknowns_in(equation.difference):
                        found.setdefault(equation.difference, equation)
        return sorted(found.values(), key=lambda each: (each.size, -each.element[1]))

    def _look_from(self, frame: int) -> None:
        """See the pose from another frame, with a name for every entry that is more than one of before."""
        entries = (_inverse(self.rows[self.frame : frame]) * self.given).applyfunc(self.angles.in_symbols)
        columns = U0 if self.tip is None else U0[:, 3]
        for row, column in product(range(3), range(columns.shape[1])):
            if entries[row, column].count_ops() > 1:
                name = sp.Symbol(f"{columns[row, column]}_{frame}")
                self.seen[name], entries[row, column] = entries[row, column], name
        self.frame, self.given = frame, entries
        self.equations = self._equations()

    def _last_frame(self, known: set[sp.Symbol]) -> int:
        """The last frame that known joints lead to and that no parallel axis follows."""
        count = next((i for i, unknown in enumerate(self.unknowns) if unknown not in known), len(self.rows))
        while 0 < count < len(self.rows) and sp.cos(self.rows[count].alpha) in (1, -1):
            count -= 1
        return count

    def _unknowns_in(self, expression: sp.Expr) -> set[sp.Symbol]:
        return expression.free_symbols & {*self.unknowns, *self.angles.sums}

    def steps(self) -> list[Step]:
        """The steps that give all unknowns. Raises ValueError, naming those that are left where the method ends before."""
        steps: list[Step] = []
        known: set[sp.Symbol] = set()
        while set(self.unknowns) - known:
            choices = [*self._one_unknown(known)]
            ranks = [rank for (rank, *_), _ in choices]
            slides = any(not self._turns(unknown) for unknown in set(self.unknowns) - known)
            if not ranks or (slides and min(ranks) > _ANGLE_AND_SLIDE) or min(ranks) > _TWO_ANGLES:
                choices += self._two_unknowns(known)
            if not choices:
                left = ", ".join(str(unknown) for unknown in self.unknowns if unknown not in known)
                raise ValueError(f"no element of the equations holds one unknown, and no two hold two: {left} are left")
            step = min(choices, key=lambda choice: choice[0])[1]
            known |= set(step.unknowns)
            following = tuple(self.angles.following(known))
            steps.append(Step(step.kind, step.equations, step.solved + following))
            if self.frame < self._last_frame(known) <= len(self.rows) - _WORTH_A_NAME:
                self._look_from(self._last_frame(known))
        steps = list(self._with_seen(steps))
        return [replace(step, solved=tuple(self._wanted(steps, i))) for i, step in enumerate(steps)]

    def _with_seen(self, steps: Sequence[Step]) -> Iterator[Step]:
        """The steps with the names that each of them is the first to use."""
        told: set[sp.Symbol] = set()
        for step in steps:
            parts = [each.difference for each in step.equations] + [
                p for each in step.solved for p in each.coefficients
            ]
            wanted = set().union(*(part.free_symbols for part in parts))
            for name in reversed(self.seen):  # names of a later frame are made of those of an earlier one
                if name in wanted:
                    wanted |= self.seen[name].free_symbols
            seen = tuple((name, self.seen[name]) for name in self.seen if name in wanted - told)
            told |= wanted
            yield replace(step, seen=seen)

    def _wanted(self, steps: Sequence[Step], index: int) -> Iterator[Solved]:
        """What is solved in a step, without sums that nothing asks for later."""
        later = [part for step in steps[index + 1 :] for each in step.solved for part in each.coefficients]
        later += [entry for step in steps[index + 1 :] for _, entry in step.seen]
        for each in steps[index].solved:
            wanted = each.helper != "sum" or each.unknown in self.unknowns
            if wanted or any(part.has(each.unknown) for part in later):
                yield each

    def _rank(self, unknown: sp.Symbol) -> tuple[int, int]:
        """Single angles before sums, the first joint first."""
        value = self.angles.sums.get(unknown, unknown)
        parts = [i for i, joint in enumerate(self.unknowns) if value.has(joint)]
        return len(parts), min(parts)

    def _with_unknowns(self, known: set[sp.Symbol], count: int) -> dict[tuple[sp.Symbol, ...], list[Equation]]:
        """The shortest equations that hold so many unknowns, by these."""
        groups: dict[tuple[sp.Symbol, ...], list[Equation]] = {}
        for equation in self.equations:
            unknown = self._unknowns_in(equation.difference) - known
            if len(unknown) == count:
                groups.setdefault(tuple(sorted(unknown, key=self._rank)), []).append(equation)
        return groups

    def _one_unknown(self, known: set[sp.Symbol]) -> Iterator[tuple[tuple, Step]]:
        """Steps of the types 1, 2 and 3, each with its rank: what always gives one solution comes first."""
        for (symbol,), equations in self._with_unknowns(known, 1).items():
            if not self._turns(symbol):
                for equation in equations[:_SHORTEST]:
                    X = equation.difference.diff(symbol)
                    if not X.has(symbol) and not self._vanishes(X):
                        solved = Solved(symbol, "type1", (X, -equation.difference.subs(symbol, 0)))
                        yield (0 if self._constant(X) else 6, *self._rank(symbol)), Step(1, (equation,), (solved,))
                        break
                continue
            rows = []
            for equation in sorted(equations, key=lambda each: (not self._plain(each, symbol), each.size)):
                found = self._of_angle(equation, (symbol,))
                if found:
                    ((C, S),), rest = found
                    rows.append((equation, (S, C, -rest)))
                if len(rows) == _SHORTEST:
                    break
            if rows:
                equation, row = min(rows, key=lambda each: each[0].size)
                yield (4, *self._rank(symbol)), Step(2, (equation,), (Solved(symbol, "type2", row),))
            for constant, ((one, first), (two, second)) in self._independent(rows, symbol):
                solved = Solved(symbol, "type3", (*first, *second))
                yield (1 if constant else 3, *self._rank(symbol)), Step(3, (one, two), (solved,))

    def _plain(self, equation: Equation, symbol: sp.Symbol) -> bool:
        """Whether the right side holds this unknown and no other, and the left side not."""
        return self._unknowns_in(equation.right) == {symbol} and not equation.left.has(symbol)

    def _independent(self, rows: list, symbol: sp.Symbol) -> Iterator[tuple[bool, tuple]]:
        """Of rows X S + Y C = Z the best pair that gives S and C: if possible one whose determinant never vanishes."""
        ranked = []
        for order, (one, two) in enumerate(combinations(rows, 2)):
            (X1, Y1, _), (X2, Y2, _) = one[1], two[1]
            determinant = X1 * Y2 - X2 * Y1
            if not self._vanishes(determinant):
                constant = self._constant(determinant)
                apart = (one[0].first, one[0].last) != (two[0].first, two[0].last)
                mixed = sum(not self._plain(each[0], symbol) for each in (one, two))
                ranked.append(((not constant, mixed, apart, order), constant, (one, two)))
        if ranked:
            _, constant, pair = min(ranked, key=lambda each: each[0])
            yield constant, pair

    def _two_unknowns(self, known: set[sp.Symbol]) -> Iterator[tuple[tuple, Step]]:
        """Steps of the types 4 to 8, each with its rank."""
        for symbols, equations in self._with_unknowns(known, 2).items():
            turns = [self._turns(symbol) for symbol in symbols]
            pairs = sorted(combinations(equations[:_SHORTEST], 2), key=lambda pair: self._length(pair, symbols))
            for pair in pairs if any(turns) else ():
                if all(turns):
                    step, rank = self._two_angles(pair, symbols, known), _TWO_ANGLES
                else:
                    angle, slide = sorted(symbols, key=self._turns, reverse=True)
                    step, rank = self._angle_and_slide(pair, angle, slide), _ANGLE_AND_SLIDE
                if step is not None:
                    yield (rank, *self._length(pair, symbols)), step
                    break

    def _length(self, pair: tuple[Equation, Equation], symbols: tuple[sp.Symbol, ...]) -> tuple[int, int]:
        """How many left sides hold what is unknown, and how long both equations are to read."""
        mixed = sum(each.left.has(*symbols) for each in pair)
        return mixed, pair[0].size + pair[1].size

    def _two_angles(
        self, pair: tuple[Equation, Equation], symbols: tuple[sp.Symbol, sp.Symbol], known: set[sp.Symbol]
    ) -> Step | None:
        """Types 6, 7 and 8: A [C_i, S_i] + B [C_j, S_j] = y, where A and B turn and stretch only."""
        found = [read for read in (self._of_angle(each, symbols) for each in pair) if read]
        if len(found) < 2:
            return None
        A, B = (sp.Matrix([each[0][k] for each in found]) for k in (0, 1))
        y = sp.Matrix([-each[1] for each in found])
        if not (self._turns_only(A) and self._turns_only(B)):
            return None
        if all(self._vanishes(entry) for entry in y):
            return None  # both say the same: how the two angles differ
        one, two = symbols
        a, b = (self.angles.sums.get(symbol, symbol) for symbol in symbols)
        N = A.T * B
        mirror = 1 if self._at(N.det(), 0) > 0 else -1
        relative = sp.expand(b - mirror * a)
        parts = [joint for joint in self.angles.joints if relative.has(joint) and joint not in known]
        single = not any(self._both_there(M[0, 0], M[0, 1]) for M in (A, B))
        kind = 7 if not single else 8 if self._vanishes(A[0, 0]) == self._vanishes(B[0, 0]) else 6
        sense = relative.coeff(parts[0]) if len(parts) == 1 else sp.S.Zero
        if len(parts) == 1 and sp.expand(relative - sense * parts[0]) == 0:
            # The squares hold the angle between the two links only.
            bend = parts[0]
            C, S = sp.cos(bend), sense * sp.sin(bend)
            K = A + B * sp.Matrix([[C, -mirror * S], [S, mirror * C]])
            Z = _norm(y) - _norm(A) - _norm(B)
            solved = (
                Solved(bend, "type2", (-2 * mirror * sense * N[1, 0], 2 * N[0, 0], Z)),
                Solved(one, "type3", (K[0, 1], K[0, 0], y[0], K[1, 1], K[1, 0], y[1])),
            )
            return Step(kind, pair, solved)
        forced = 2 * (y.T * A)
        rest = y - A * sp.Matrix([sp.cos(one), sp.sin(one)])
        solved = (
            Solved(one, "type2", (forced[1], forced[0], _norm(y) + _norm(A) - _norm(B))),
            Solved(two, "type3", (B[0, 1], B[0, 0], rest[0], B[1, 1], B[1, 0], rest[1])),
        )
        return Step(kind if kind != 8 else 7, pair, solved)

    def _angle_and_slide(self, pair: tuple[Equation, Equation], angle: sp.Symbol, slide: sp.Symbol) -> Step | None:
        """Types 4 and 5: (U r + V) [C, S] = y + z r, where U r + V turns and stretches only."""
        found = [read for read in (self._of_angle(each, (angle,)) for each in pair) if read]
        if len(found) < 2:
            return None
        K = sp.Matrix([each[0][0] for each in found])
        y = sp.Matrix([-each[1] for each in found])
        if any(entry.diff(slide).has(slide) for entry in (*K, *y)) or not self._turns_only(K):
            return None
        square = sp.Poly(sp.expand(_norm(K) - _norm(y)), slide)
        if square.degree() != 2:
            return None
        solved = (
            Solved(slide, "quadratic", tuple(square.all_coeffs())),
            Solved(angle, "type3", (K[0, 1], K[0, 0], y[0], K[1, 1], K[1, 0], y[1])),
        )
        return Step(4 if K.has(slide) else 5, pair, solved)

    def _turns(self, symbol: sp.Symbol) -> bool:
        return symbol in self.angles.joints or symbol in self.angles.sums

    def _of_angle(self, equation: Equation, symbols: tuple[sp.Symbol, ...]) -> tuple[list, sp.Expr] | None:
        """([(factor of C, factor of S) for each angle], rest) of left - right where that is linear in them and holds each."""
        key = (equation, symbols)
        if key not in self._linear:
            self._linear[key] = self._read(equation, symbols)
        return self._linear[key]

    def _read(self, equation: Equation, symbols: tuple[sp.Symbol, ...]) -> tuple[list, sp.Expr] | None:
        parts = [(sp.Dummy("C"), sp.Dummy("S")) for _ in symbols]
        names = {f(s): d for s, pair in zip(symbols, parts) for f, d in zip((sp.cos, sp.sin), pair)}
        left, right = equation.left.xreplace(names), equation.right.xreplace(names)
        if left.has(*symbols) or right.has(*symbols):
            return None
        flat = [part for pair in parts for part in pair]
        factors = [tuple(left.diff(part) - right.diff(part) for part in pair) for pair in parts]
        if any(factor.has(*flat) for pair in factors for factor in pair):
            return None
        tidy = [tuple(sp.S.Zero if self._vanishes(factor) else factor for factor in pair) for pair in factors]
        none = dict.fromkeys(flat, sp.S.Zero)
        rest = left.xreplace(none) - right.xreplace(none)
        return (tidy, sp.S.Zero if self._vanishes(rest) else rest) if all(any(pair) for pair in tidy) else None

    def _turns_only(self, M: sp.Matrix) -> bool:
        """Whether the columns of a matrix (2, 2) are of one length and at a right angle, and do not vanish."""
        (p, q), (r, s) = M.tolist()
        across, uneven = p * q + r * s, p**2 + r**2 - q**2 - s**2
        return not self._vanishes(p * s - q * r) and self._vanishes(across) and self._vanishes(uneven)

    def _both_there(self, one: sp.Expr, other: sp.Expr) -> bool:
        return not self._vanishes(one) and not self._vanishes(other)

    def _vanishes(self, expression: sp.Expr) -> bool:
        return expression == 0 or all(abs(self._at(expression, which)) <= _GENERIC for which in range(_POINTS))

    def _constant(self, expression: sp.Expr) -> bool:
        """Whether it has one value in all postures, whatever the lengths are."""
        if not expression.free_symbols & {*self.unknowns, *self.angles.sums, *U0.free_symbols, *self.seen}:
            return True
        values = [self._at(expression, which) for which in range(1, _POINTS)]
        return max(values) - min(values) <= _GENERIC

    def _at(self, expression: sp.Expr, which: int) -> float:
        """The value in one of some postures in general position."""
        point = self._points[which]
        for symbol in expression.free_symbols - point.keys():
            point[symbol] = sp.Float(self._at(self.angles.sums.get(symbol, self.seen.get(symbol)), which))
        return float(expression.xreplace(point))

    def _point(self, seed: int) -> dict[sp.Symbol, float]:
        """Values of joints, lengths and U0 that belong together; the lengths are those of the last but the first one."""
        point: dict[sp.Symbol, sp.Float] = {}
        letters = {s for row in self.rows for entry in row.parameters for s in entry.free_symbols} - {*self.unknowns}
        letters |= self.tip.free_symbols if self.tip is not None else set()
        for symbols, stream in (
            (sorted(letters, key=str), min(seed, 1)),
            (self.unknowns, 100 + seed),
        ):
            numbers = np.random.default_rng(stream).uniform(0.3, 1.3, len(symbols))
            point |= {symbol: sp.Float(number) for symbol, number in zip(symbols, numbers)}
        pose = sp.eye(4)
        for row in self.rows:
            pose = pose * row.transform().xreplace(point)
        if self.tip is not None:
            return point | dict(zip(U0[:3, 3], (pose * self.tip.xreplace(point))[:3]))
        return point | dict(zip(U0[:3, :], pose[:3, :]))


def _norm(M: sp.Matrix) -> sp.Expr:
    """The square of a vector (2, 1), or of the stretch of a matrix (2, 2)."""
    first, second = (-entry if entry.could_extract_minus_sign() else entry for entry in (M[0, 0], M[1, 0]))
    return first**2 + second**2


def _inverse(rows: Sequence[DHRow]) -> sp.Matrix:
    """The base of a chain seen from its end, in textbook form: parallel axes merged as in the direct model."""
    result, start = sp.eye(4), 0
    while start < len(rows):
        end = start + 1
        while end < len(rows) and sp.cos(rows[end].alpha) in (1, -1):
            end += 1
        result = _inverse_of_run(rows[start:end]) * result
        start = end
    return result


def _inverse_of_run(rows: Sequence[DHRow]) -> sp.Matrix:
    """The inverse of rows whose axes are parallel or opposite to the first one."""
    first, *others = rows
    angle, up, lift, legs = first.theta, sp.S.One, first.d, []
    for row in others:
        legs.append((row.a, angle))
        up *= sp.cos(row.alpha)
        lift += up * row.d
        angle += up * row.theta
    x = -sum((a * sp.cos(there - angle) for a, there in legs), sp.S.Zero)
    y = -up * sum((a * sp.sin(there - angle) for a, there in legs), sp.S.Zero)
    c, s = sp.cos(angle), sp.sin(angle)
    plane = sp.Matrix([[c, s, 0, x], [-up * s, up * c, 0, y], [0, 0, up, -up * lift], [0, 0, 0, 1]])
    return plane * rot_x(-first.alpha) * trans_x(-first.a)
