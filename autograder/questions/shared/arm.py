"""The questions that can be asked of any arm, from its table: references and what usually goes wrong."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache, partial, reduce
from typing import Any

import numpy as np
import sympy

from autograder.judge import Follow, Mistake, Question, following
from autograder.judge.misconceptions import (
    arguments_in_degrees,
    classic_matrix,
    classic_table,
    columns_exchanged,
    degrees,
    degrees_in_table,
    one_factor_missing,
    posture_missing,
    reversed_product,
    revolute_everywhere,
    rows_shifted,
    sign_of,
    transposed_rotation,
    with_first_theta1,
)
from autograder.reference import Status
from dhkit.geometry import classic_dh, rotation_angle_between

from .described import Described
from .tables import list_rows

TABLE, RECURSION, TRANSFORM, FORWARD, POSTURES = "table", "U1", "T0E", "forward", "postures"
_MOST_POSTURES = 16


def ask_about(exercise: str, arm: Described) -> tuple[Question, ...]:
    """The questions of an exercise on one arm.

    Its table, the recursion up to joint 1, the transform from base to end effector, the forward model as a function and,
    where the file has a posture whose pose is reached in finitely many ways, all of these.
    """
    rows, table = list_rows(arm.table), arm.table
    factors, recursion = table.transforms(), table.recursion()
    forward = partial(_forward, arm)
    asked = [
        Question(f"{exercise}.{TABLE}", rows, _telling(rows, _mistakes_in_table(rows), _moved_by), partial=0.6),
        Question(
            f"{exercise}.{RECURSION}",
            recursion[1],
            _telling(recursion[1], _mistakes_in_product(factors[1:], rows[1:], recursion[2:3])),
        ),
        Question(
            f"{exercise}.{TRANSFORM}",
            recursion[0],
            _telling(recursion[0], _mistakes_in_product(factors, rows, recursion[1:2])),
            follows=Follow(f"{exercise}.{TABLE}", following.product_of_table),
        ),
        Question(
            f"{exercise}.{FORWARD}",
            forward,
            (
                *([arguments_in_degrees({"unit": np.pi / 180})] if turning(arm) else []),
                classic_matrix(note="classic_matrices", wrong={"convention": "classic"}),
            ),
            probe=partial(_draw, arm),
        ),
    ]
    if (postures := all_postures(arm)) is not None:
        asked.append(
            Question(
                f"{exercise}.{POSTURES}",
                postures,
                _telling(
                    postures,
                    [
                        *([posture_missing()] if len(postures) > 1 else []),
                        *([with_first_theta1()] if len(postures) > 1 else []),
                        *([degrees(*turning(arm))] if turning(arm) else []),
                    ],
                ),
                angles=turning(arm),
                residual=partial(_residual, arm),
            )
        )
    return tuple(asked)


@cache
def turning(arm: Described) -> tuple[int, ...]:
    """The places of the joints that turn, from 0."""
    moving = [row for row in arm.table.rows if row.variable.free_symbols & set(arm.table.joints)]
    return tuple(i for i, row in enumerate(moving) if not row.sigma)


@cache
def all_postures(arm: Described) -> list[list[float]] | None:
    """All joint values for the pose that is asked back; None where there is no inverse model, or no end of them."""
    if not arm.posture or not arm.robot.has_inverse:
        return None
    found = arm.robot.inverse(arm.target)
    if found.status is Status.INFINITE or not 0 < len(found) <= _MOST_POSTURES:
        return None
    return found.q.tolist()


@cache
def is_for_point(arm: Described) -> bool:
    """Whether only the position can be asked back: an arm with few joints does not reach it with the same orientation twice."""
    found = arm.robot.inverse(arm.target).q
    return bool((_turned(arm, found) > 1e-6).any())


def _mistakes_in_table(rows: list[list]) -> list[Mistake]:
    filled = lambda column: [i for i, row in enumerate(rows, 1) if row[column] != 0]  # noqa: E731
    return [
        classic_table(),
        columns_exchanged("a", "d"),
        columns_exchanged("a", "alpha"),
        *(sign_of(name, *filled(k)) for k, name in ((1, "a"), (2, "alpha"), (3, "d")) if filled(k)),
        revolute_everywhere(),
        rows_shifted(),
        degrees_in_table(),
    ]


def _mistakes_in_product(factors: list[sympy.Matrix], rows: list[list], shorter: list[sympy.Matrix]) -> list[Mistake]:
    return [
        *([reversed_product(*factors)] if len(factors) > 1 else []),
        classic_matrix(*(row[1:] for row in rows), note="classic_matrices"),
        transposed_rotation(),
        *(one_factor_missing(product, feedback="**The recursion stopped one step too early.**") for product in shorter),
    ]


def _values(answer: object) -> np.ndarray:
    """The entries of an answer at one point that is not special."""
    cells = np.array(answer.tolist() if isinstance(answer, sympy.MatrixBase) else answer, dtype=object)
    symbols = sorted(set().union(*(sympy.S(cell).free_symbols for cell in cells.flat)), key=str)
    at = {symbol: 0.37 + 0.211 * k for k, symbol in enumerate(symbols)}
    return np.array([complex(sympy.S(cell).subs(at)) for cell in cells.flat]).reshape(cells.shape)


def _moved_by(rows: list[list]) -> np.ndarray:
    """The kinds of the joints of a table, and where it leads: two tables with frames of their own agree in both."""
    values = _values(rows)[None]
    return np.append(following.product_of_table(values).ravel(), values[..., 0])


def _telling(
    right: object, mistakes: Iterable[Mistake], look: Callable[[Any], np.ndarray] = _values
) -> tuple[Mistake, ...]:
    """Those mistakes that change the answer, as it is looked at, each in another way than those before it."""
    seen, kept = [look(right)], []
    for mistake in mistakes:
        found = [look(step(right)) for step in mistake.steps]
        if found and all(_differs(one, other) for one in found[:1] for other in seen):
            seen += found
            kept.append(mistake)
    return tuple(kept)


def _differs(one: np.ndarray, other: np.ndarray) -> bool:
    return one.shape != other.shape or bool(np.abs(one - other).max() > 1e-6)


def _forward(arm: Described, *q: float, unit: float = 1.0, convention: str = "modified") -> np.ndarray:
    """The pose (4, 4) for joint values q; `unit` is that of the angles, in radians."""
    turned = [unit * value if i in turning(arm) else value for i, value in enumerate(q)]
    if convention == "modified":
        return arm.table.forward(turned)
    at = dict(zip(map(str, arm.table.joints), turned)) | dict(arm.table.values)
    rows = np.array([row.parameters for row in arm.table.at(at).rows], float)
    return reduce(np.matmul, classic_dh(*rows.T))


def _draw(arm: Described, rng: np.random.Generator) -> list[list[float]]:
    """Argument lists for the forward model: any joint values, then round ones."""
    angles = turning(arm)
    drawn = [
        [rng.uniform(-3, 3) if i in angles else rng.uniform(0.05, 0.6) for i in range(len(arm.joints))]
        for _ in range(8)
    ]
    quarter = [[np.pi / 2 * k if i in angles else 0.1 * k for i in range(len(arm.joints))] for k in (0, 1, 2)]
    return [[float(value) for value in args] for args in drawn + quarter]


def _residual(arm: Described, q: np.ndarray) -> np.ndarray:
    """How far the end effector is from the target, (k,), for joint values (k, n): metres, and radians where they count."""
    far = np.linalg.norm(arm.table.forward(q)[:, :3, 3] - arm.target[:3, 3], axis=1)
    return far if is_for_point(arm) else far + _turned(arm, q)


def _turned(arm: Described, q: np.ndarray) -> np.ndarray:
    """Angle between the end effector and its target, (k,), in radians."""
    return rotation_angle_between(arm.table.forward(q)[:, :3, :3], arm.target[:3, :3])
