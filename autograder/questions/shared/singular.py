"""Singular configurations of an arm: the freedoms that are left, and the determinant where it is short."""

from __future__ import annotations

from functools import cache
from itertools import combinations, product

import numpy as np
import sympy

from autograder.reference import jacobian, rank

from .configurations import standing, task_rows, turning
from .described import Described

_QUARTERS = (0, 2, 1, -1)
_MOST_TERMS = 60


@cache
def configurations(arm: Described) -> tuple[tuple[sympy.Expr, ...], ...]:
    """Four configurations of which some are singular, where the arm has such: joint values, quarter turns exact.

    None of an arm without turning joints, which has the same freedoms everywhere.
    """
    plain = tuple(sympy.Rational(str(value)) for value in standing(arm))
    singular, regular = _with_quarter_turns(arm, plain)
    mirrored = tuple(-value if i in turning(arm) else value for i, value in enumerate(plain))
    chosen = list(dict.fromkeys([*singular[:2], *regular[:2], plain, mirrored]))[:4]
    order = np.random.default_rng(len(arm.table.rows)).permutation(4)
    return tuple(chosen[i] for i in order) if len(chosen) == 4 else ()


def _with_quarter_turns(arm: Described, plain: tuple) -> tuple[list[tuple], list[tuple]]:
    """Configurations with quarter turns in one or two joints: singular ones, unlike ones first, and others."""
    full = freedoms(arm, plain)
    singular: list[tuple] = []
    near: list[tuple] = []  # another quarter turn of a joint that makes the arm singular
    far: list[tuple] = []
    causes: list[set[int]] = []
    for count in (1, 2):
        for joints in combinations(turning(arm), count):
            if any(cause <= set(joints) for cause in causes):
                continue  # more of the same
            tried = [_turned(plain, joints, quarters) for quarters in product(_QUARTERS, repeat=count)]
            lost = [q for q in tried if freedoms(arm, q) < full]
            if lost:
                singular.append(lost[0])
                causes.append(set(joints))
            (near if lost else far).extend(q for q in tried if q not in lost)
    return singular, [*near[::-1][:1], *far, *near]


def _turned(plain: tuple, joints: tuple[int, ...], quarters: tuple[int, ...]) -> tuple:
    turns = {joint: sympy.pi * sympy.Rational(n, 2) for joint, n in zip(joints, quarters)}
    return tuple(turns.get(i, value) for i, value in enumerate(plain))


def freedoms(arm: Described, q: tuple) -> int:
    """Rank of the Jacobian at a configuration: of the position alone where every joint is needed for it."""
    numbers = np.array([float(value) for value in q])
    if task_rows(arm) == 6:
        return int(rank(arm.table, numbers))
    return _rank(jacobian(arm.table, numbers)[:3])


def _rank(J: np.ndarray) -> int:
    values = np.linalg.svd(J, compute_uv=False)
    return int((values > 1e-9 * max(values[0], 1e-12)).sum())


def ranks(arm: Described, rows: str = "own") -> list[int]:
    """Ranks at the four configurations; `rows` may be ``"position"`` or ``"rotation"``, of these three rows only."""
    if rows == "own":
        return [freedoms(arm, q) for q in configurations(arm)]
    part = slice(0, 3) if rows == "position" else slice(3, 6)
    matrices = (jacobian(arm.table, [float(value) for value in q])[part] for q in configurations(arm))
    return [_rank(J) for J in matrices]


@cache
def senses(arm: Described) -> tuple[int, ...] | None:
    """Of an arm whose turning joints all turn about Z0: 1 or -1 for each, 0 for slides; None of any other arm."""
    found = jacobian(arm.table, standing(arm))[3:]
    if np.abs(found[:2]).max() > 1e-9 or len(arm.joints) != 4:
        return None
    return tuple(int(value) for value in found[2].round())


@cache
def determinant(arm: Described) -> sympy.Expr | None:
    """Determinant of the Jacobian of x, y, z, and of the turn about Z0 where there is a fourth joint; None where it is not short."""
    if not (task_rows(arm) == 3 and len(arm.joints) == 3) and senses(arm) is None:
        return None
    place = sympy.Matrix(arm.table.recursion()[0][:3, 3])
    J = place.jacobian(list(arm.table.joints))
    if (turns := senses(arm)) is not None:
        J = J.col_join(sympy.Matrix([turns]))
    found = sympy.factor(sympy.trigsimp(sympy.expand(J.det(method="berkowitz"))))
    if not found.free_symbols & set(arm.table.joints) or sympy.count_ops(found) > _MOST_TERMS:
        return None
    return found


def without_a_factor(found: sympy.Expr) -> list[sympy.Expr]:
    """The determinant with each of its factors left out."""
    factors = [factor for factor in sympy.Mul.make_args(found) if factor.free_symbols]
    return [found / factor for factor in factors] if len(factors) > 1 else []
