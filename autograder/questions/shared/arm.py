"""The questions that can be asked of any arm, from its table: references and what usually goes wrong."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial, reduce
from typing import Any

import numpy as np
import sympy

from autograder.judge import Family, Follow, Mistake, Question, following, mistake
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
from autograder.judge.steps import change_entry, in_each_row
from dhkit.geometry import classic_dh
from dhm.transforms import modified_dh

from . import singular, sweep
from .configurations import all_solutions, residual, turning
from .described import Described
from .tables import list_rows

TABLE, MATRIX, RECURSION, TRANSFORM, FORWARD = "table", "T12", "U1", "T0E", "forward"
SOLUTIONS, CLOUD, REACH, RANKS, DETERMINANT = "solutions", "cloud", "reach", "ranks", "determinant"


def ask_about(exercise: str, arm: Described) -> tuple[Question, ...]:
    """The questions of an exercise on one arm.

    Its table, the matrix of one row, the recursion up to joint 1, the transform from base to end effector, the forward
    model as a function, every solution for a pose or some of a family, a part of the workspace with its limits, the
    freedoms left in four configurations, and the determinant. What an arm does not have is left out.
    """
    ways = (_about_table, _about_matrices, _about_forward, _about_solutions, _about_workspace, _about_singularities)
    return tuple(question for way in ways for question in way(exercise, arm))


def _about_table(exercise: str, arm: Described) -> Iterable[Question]:
    rows = list_rows(arm.table)
    yield Question(f"{exercise}.{TABLE}", rows, _telling(rows, _mistakes_in_table(rows), _moved_by), partial=0.6)


def has_second_joint(arm: Described) -> bool:
    """Whether row 2 is a joint's, so that its matrix can be asked for."""
    return len(arm.table.rows) > 1 and arm.table.rows[1] in arm.table.moving


def _about_matrices(exercise: str, arm: Described) -> Iterable[Question]:
    rows, factors, recursion = list_rows(arm.table), arm.table.transforms(), arm.table.recursion()
    if has_second_joint(arm):
        yield Question(f"{exercise}.{MATRIX}", factors[1], _telling(factors[1], _mistakes_in_matrix(rows[1])))
        yield Question(
            f"{exercise}.{RECURSION}",
            recursion[1],
            _telling(recursion[1], _mistakes_in_product(factors[1:], rows[1:], recursion[2:3])),
        )
    yield Question(
        f"{exercise}.{TRANSFORM}",
        recursion[0],
        _telling(recursion[0], _mistakes_in_product(factors, rows, recursion[1:2])),
        follows=Follow(f"{exercise}.{TABLE}", following.product_of_table),
    )


def _about_forward(exercise: str, arm: Described) -> Iterable[Question]:
    yield Question(
        f"{exercise}.{FORWARD}",
        partial(_forward, arm),
        (
            *([arguments_in_degrees({"unit": np.pi / 180})] if turning(arm) else []),
            classic_matrix(note="classic_matrices", wrong={"convention": "classic"}),
        ),
        probe=partial(_draw, arm),
    )


def is_family(arm: Described) -> bool:
    """Whether the pose that is asked back is reached in infinitely many ways."""
    return isinstance(all_solutions(arm), Family)


def _about_solutions(exercise: str, arm: Described) -> Iterable[Question]:
    found = all_solutions(arm)
    if found is None:
        return
    rows = found.solutions if isinstance(found, Family) else found
    several = len(rows) > 1 and not is_family(arm)
    mistakes = [
        *([posture_missing(note="solutions_left_out", feedback=_NOT_ALL)] if several else []),
        *([with_first_theta1(feedback=_ONE_JOINT_FOR_ALL)] if several else []),
        *([degrees(*turning(arm))] if turning(arm) else []),
        mistake("last_joint_at_zero", 0.5, _LAST_JOINT, in_each_row(change_entry(len(arm.joints) - 1, lambda _: 0.0))),
    ]
    yield Question(
        f"{exercise}.{SOLUTIONS}",
        found,
        _telling(rows, mistakes, partial(_as_set, turning(arm))),
        angles=turning(arm),
        residual=partial(residual, arm),
    )


_NOT_ALL = (
    "**Not all solutions are there.** A cosine alone does not tell the sign of its angle, nor a square root its own."
)
_ONE_JOINT_FOR_ALL = (
    "**All solutions share one value of joint 1.** Each has its own: put your second solution into the direct model and see where "
    "the end effector goes."
)
_LAST_JOINT = (
    "**The last joint stands at zero.** The other joints are right; it must still turn, or slide, the end effector to where the "
    "target has it."
)


def _about_workspace(exercise: str, arm: Described) -> Iterable[Question]:
    swept = sweep.sweep_of(arm)
    if swept is None:
        return
    held = len(arm.joints) > 2
    whole = np.array(sweep.points(arm, swept))
    wrong = [
        mistake("joints_in_step", 0.3, _IN_STEP, wrong={"shape": "diagonal"}),
        mistake("ranges_exchanged", 0.4, _EXCHANGED, wrong={"ranges": "exchanged"}),
        *([mistake("others_at_zero", 0.4, _AT_ZERO, wrong={"held": "zero"})] if held else []),
    ]
    tolerance = round(2.5 * sweep.spacing(arm, swept), 3)
    far = lambda other: bool(np.abs(_box(whole) - _box(np.array(other))).max() > 2 * tolerance)  # noqa: E731
    yield Question(
        f"{exercise}.{CLOUD}",
        partial(sweep.points, arm, swept),
        tuple(
            node
            for node in wrong
            if node.note == "joints_in_step" or far(sweep.points(arm, swept, **dict(node.wrong[0])))
        ),
        tolerance=tolerance,
    )
    reach = partial(sweep.reach, arm, swept)
    limits = [
        mistake("ends_of_the_ranges_only", 0.4, _ENDS_ONLY, wrong={"how": "ends"}),
        mistake("distance_from_the_origin", 0.5, _FROM_ORIGIN, wrong={"centre": "origin"}),
        *([mistake("others_at_zero", 0.4, _AT_ZERO, wrong={"held": "zero"})] if held else []),
        mistake("smallest_and_largest_exchanged", 0.6, _ORDER, lambda found: found[::-1]),
    ]
    yield Question(
        f"{exercise}.{REACH}",
        reach,
        _telling(reach(), limits, lambda found: np.round(found, 2), made=lambda wrong: reach(**wrong)),
    )


_IN_STEP = "**Your points lie on one curve.** The two joints march in step; take every value of one for every value of the other."
_EXCHANGED = "**Each of the two joints has the other's range.** Look once more at which range belongs to which joint."
_AT_ZERO = "**The other joints stand at zero.** The statement says where they stand while the two joints move."
_ENDS_ONLY = (
    "**Only the ends of the ranges are looked at.** Between them the arm may pass through a configuration that reaches further, or "
    "less far."
)
_FROM_ORIGIN = (
    "**These are distances from O0.** The question counts from the axis Z0: how high a point is does not matter."
)
_ORDER = "**The two distances are exchanged.** The smallest one comes first."


def _box(points: np.ndarray) -> np.ndarray:
    return np.array([points.min(axis=0), points.max(axis=0)])


def _about_singularities(exercise: str, arm: Described) -> Iterable[Question]:
    if singular.configurations(arm):
        ranks = partial(singular.ranks, arm)
        full = min(singular.task_rows(arm), len(arm.joints))
        mistakes = [
            mistake("only_the_joints_counted", 0.2, _COUNTED, lambda _: [full] * 4),
            mistake("position_only", 0.4, _POSITION_ONLY, wrong={"rows": "position"}),
            mistake("rotation_only", 0.4, _ROTATION_ONLY, wrong={"rows": "rotation"}),
            mistake("freedoms_lost_counted", 0.6, _LOST, lambda found: [full - value for value in found]),
        ]
        yield Question(
            f"{exercise}.{RANKS}",
            ranks,
            _telling(ranks(), mistakes, np.array, made=lambda wrong: ranks(**wrong)),
        )
    if (found := singular.determinant(arm)) is not None:
        yield Question(
            f"{exercise}.{DETERMINANT}",
            found,
            _telling(
                found,
                [
                    mistake("sign_of_the_determinant", 0.7, _SIGN, lambda det: -det),
                    mistake("a_factor_missing", 0.4, _FACTOR, *_leaving_out(found)),
                    mistake("cosine_for_sine", 0.4, _COSINE, _cosines_for_sines),
                ],
                lambda det: _values([det]),
            ),
        )


_COUNTED = (
    "**These are the freedoms in general.** In some of the four configurations the columns of the Jacobian depend on each other: "
    "compute its singular values there."
)
_POSITION_ONLY = (
    "**Only the rows of the position are looked at.** The end effector turns, too: the Jacobian has six rows."
)
_ROTATION_ONLY = "**Only the rows of the rotation are looked at.** The Jacobian has three more, those of the position."
_LOST = "**You count the freedoms that are lost.** Asked for are those that are left, the rank."
_SIGN = "**The sign is turned.** Two rows or two columns are exchanged: rows and columns stand as the question says."
_FACTOR = "**A factor is missing.** Check the unit, and where the determinant should vanish but yours does not."
_COSINE = "**A sine and a cosine are exchanged.** At which angle of this joint should the determinant vanish?"


def _leaving_out(found: sympy.Expr) -> list[Callable]:
    return [lambda _, shorter=shorter: shorter for shorter in singular.without_a_factor(found)]


def _cosines_for_sines(found: sympy.Expr) -> sympy.Expr:
    held = {sine: sympy.Dummy() for sine in found.atoms(sympy.sin)}
    return found.xreplace(held).xreplace({dummy: sympy.cos(*sine.args) for sine, dummy in held.items()})


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


def _mistakes_in_matrix(row: list) -> list[Mistake]:
    turned = lambda k: modified_dh(*(-value if i == k else value for i, value in enumerate(row[1:])))  # noqa: E731
    return [
        classic_matrix(row[1:]),
        transposed_rotation(),
        mistake("sign_of_alpha", 0.6, "**The sign of alpha is turned.** It turns Z1 onto Z2 about X1.", lambda _: turned(1)),
        mistake("sign_of_a_length", 0.6, "**A length has the wrong sign.** Where is O2, seen from frame 1?",
                lambda _: turned(0), lambda _: turned(2)),
    ]  # fmt: skip


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


def _as_set(angles: tuple[int, ...], rows: list[list[float]]) -> np.ndarray:
    """Joint solutions without order, angles modulo a turn."""
    found = np.array(rows, float)
    parts = [
        np.column_stack([np.cos(column), np.sin(column)]) if i in angles else column[:, None]
        for i, column in enumerate(found.T)
    ]
    return np.array(sorted(np.round(np.hstack(parts), 6).tolist()))


def _telling(
    right: Any,
    mistakes: Iterable[Mistake],
    look: Callable[[Any], np.ndarray] = _values,
    made: Callable[[dict], Any] = lambda wrong: None,
) -> tuple[Mistake, ...]:
    """Those mistakes that change the answer, as it is looked at, each in another way than those before it.

    `made` gives the answer of somebody who goes wrong on the way to it, by the keywords of the reference. Of a mistake of several
    forms those are kept that change the answer.
    """
    seen, kept = [look(right)], []
    for node in mistakes:
        steps = [(step, look(step(right))) for step in node.steps]
        wrongs = [(wrong, look(made(dict(wrong)))) for wrong in node.wrong]
        telling = replace(
            node,
            steps=tuple(step for step, found in steps if _is_new(found, seen)),
            wrong=tuple(wrong for wrong, found in wrongs if _is_new(found, seen)),
        )
        if telling.steps or telling.wrong:
            seen += [found for _, found in (*steps, *wrongs)]
            kept.append(telling)
    return tuple(kept)


def _is_new(found: np.ndarray, seen: list[np.ndarray]) -> bool:
    return all(_differs(found, other) for other in seen)


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
