"""Joint solutions: all ways to reach a target, without order, angles modulo a turn, repetitions merged."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dhkit.forms.joint_solutions import JointSolutions, close, distinct

from ..decode import Value
from .base import Comparison, Setting
from .entries import real_values

__all__ = ["compare", "read"]


SOLUTIONS_MISSING = "solutions_missing"


def read(form: JointSolutions, value: Value) -> np.ndarray:
    """Rows of joint values, (k, n)."""
    return real_values(value).reshape(-1, len(form.joints))


def compare(form: JointSolutions, student: np.ndarray, other: np.ndarray, setting: Setting) -> Comparison:
    """Two sets of joint solutions; missing, wrong and superfluous ones are told apart.

    Of a family of infinitely many, any valid representatives are accepted.
    """
    merged = setting.angles, setting.tolerance, setting.turn
    kept = distinct(student, *merged)
    mine, theirs = student[kept], other[distinct(other, *merged)]
    slack = np.broadcast_to(setting.slack, student.shape)[kept]
    if setting.family and setting.residual is not None:
        return _of_a_family(mine, setting.residual, setting, slack)
    same = close(theirs, mine, setting.angles, setting.tolerance + slack, setting.turn)
    missing, extra = int((~same.any(axis=1)).sum()), np.asarray(~same.any(axis=0))
    remarks = []
    if missing:
        remarks.append(
            f"{missing} of {len(theirs)} solutions missing" if len(theirs) > 1 else "the solution is missing"
        )
    if not len(theirs) and len(mine):
        remarks.append("there is no solution here, the answer gives some")
    elif extra.any():
        remarks.append(_wrong(mine, extra, setting))
    note = ""
    if missing and len(mine) and not extra.any():
        note = SOLUTIONS_MISSING
        remarks.append(
            f"what is given is right{'; each cosine and each root has two signs' if len(theirs) > 1 else ''}"
        )
    most = max(len(theirs), len(mine))
    return Comparison(not remarks, (len(theirs) - missing) / most if most else 1.0, tuple(remarks), note)


def _wrong(mine: np.ndarray, extra: np.ndarray, setting: Setting) -> str:
    count = f"{int(extra.sum())} of the {len(mine)} given" if len(mine) > 1 else "the one given"
    if setting.residual is None:
        return f"{count} {'does' if extra.sum() == 1 else 'do'} not reach the target"
    residuals = setting.residual(mine[extra])
    return (
        f"{count} miss{'es' if extra.sum() == 1 else ''} the target, by up to {residuals.max():.3g} (metres or radians)"
    )


def _of_a_family(
    mine: np.ndarray, residual: Callable[[np.ndarray], np.ndarray], setting: Setting, slack: np.ndarray
) -> Comparison:
    if not len(mine):
        return Comparison(False, 0.0, ("there are solutions here, the answer gives none",))
    wrong = residual(mine) > 10 * setting.tolerance + slack.sum(axis=1)
    if not wrong.any():
        return Comparison(True, 1.0)
    return Comparison(False, float((~wrong).mean()), (_wrong(mine, wrong, setting),))
