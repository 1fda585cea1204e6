"""Joint solutions: all ways to reach a target, without order, angles modulo a turn, repetitions merged."""

from __future__ import annotations

import numpy as np

from dhkit.forms import array_shape
from dhkit.geometry import wrap
from dhkit.public import PublicQuestion

from ..decode import Blank, Expression, Number, Record
from ..evaluate import evaluate
from .base import Comparison, Setting, describe, in_order, refuse
from .entries import checked, flat

# Sets of solutions are compared pair by pair; a general six-axis arm has at most 16.
MAX_SOLUTIONS = 100


def read_solutions(question: PublicQuestion, value: object) -> np.ndarray:
    """Rows of joint values, (k, n); a single solution may stand alone, rows may be keyed by joint names."""
    count = len(question.joints)
    value = in_order(value, question.joints)
    if isinstance(value, tuple) and any(isinstance(row, Record) for row in value):
        value = tuple(in_order(row, question.joints) for row in value)
    shape = array_shape(value)
    single = shape == (count,)
    if shape != (0,) and not single and (shape is None or len(shape) != 2 or shape[1] != count):
        raise refuse(question, describe(value))
    if not single and len(value) > MAX_SOLUTIONS:
        raise refuse(question, f"{len(value)} solutions, more than any robot has")
    numbers = checked(question, flat(value)).expressions
    if any(isinstance(number, Blank) for number in numbers):
        raise refuse(question, "an entry that is not filled in")
    values = np.array([_value(number) for number in numbers])
    if not np.isfinite(values).all():
        raise refuse(question, "a value that is not finite")
    if np.abs(values.imag).max(initial=0) > 1e-9:
        raise refuse(question, "a complex number")
    return values.real.reshape(-1, count)


def _value(number: Expression) -> complex:
    plain = isinstance(number, Number) and isinstance(number.value, float)
    return number.value if plain else evaluate(number, {})[0]


def compare_solutions(question: PublicQuestion, student: np.ndarray, other: np.ndarray, setting: Setting) -> Comparison:
    """Two sets of joint solutions; missing, wrong and superfluous ones are told apart.

    Of a family of infinitely many, any valid representatives are accepted.
    """
    mine, theirs = (_distinct(solutions, setting) for solutions in (student, other))
    if setting.family and setting.residual is not None:
        return _of_a_family(mine, setting)
    same = _close(theirs, mine, setting)
    missing, extra = int((~same.any(axis=1)).sum()), ~same.any(axis=0)
    remarks = []
    if missing:
        remarks.append(
            f"{missing} of {len(theirs)} solutions missing" if len(theirs) > 1 else "the solution is missing"
        )
    if not len(theirs) and len(mine):
        remarks.append("there is no solution here, the answer gives some")
    elif extra.any():
        remarks.append(_wrong(mine, extra, setting))
    most = max(len(theirs), len(mine))
    return Comparison(not remarks, (len(theirs) - missing) / most if most else 1.0, tuple(remarks))


def _wrong(mine: np.ndarray, extra: np.ndarray, setting: Setting) -> str:
    count = f"{int(extra.sum())} of the {len(mine)} given"
    if setting.residual is None:
        return f"{count} {'does' if extra.sum() == 1 else 'do'} not reach the target"
    residuals = setting.residual(mine[extra])
    return (
        f"{count} miss{'es' if extra.sum() == 1 else ''} the target, by up to {residuals.max():.3g} (metres or radians)"
    )


def _of_a_family(mine: np.ndarray, setting: Setting) -> Comparison:
    if not len(mine):
        return Comparison(False, 0.0, ("there are solutions here, the answer gives none",))
    residuals = setting.residual(mine)
    wrong = residuals > 10 * setting.tolerance
    if not wrong.any():
        return Comparison(True, 1.0)
    return Comparison(False, float((~wrong).mean()), (_wrong(mine, wrong, setting),))


def _close(a: np.ndarray, b: np.ndarray, setting: Setting) -> np.ndarray:
    """Which of the (m, n) solutions `a` are the same as which of the (k, n) solutions `b`: an (m, k) array."""
    gap = np.abs(a[:, None] - b[None])
    angles = list(setting.angles)
    radians = gap[..., angles] * (2 * np.pi / setting.turn)
    gap[..., angles] = np.abs(wrap(radians))
    return (gap <= setting.tolerance).all(axis=-1)


def _distinct(solutions: np.ndarray, setting: Setting) -> np.ndarray:
    kept: list[int] = []
    for i, same in enumerate(_close(solutions, solutions, setting)):
        if not same[kept].any():
            kept.append(i)
    return solutions[kept]
