"""What a tracker has measured of a student's own arm, and what follows from it."""

from __future__ import annotations

from functools import cache

import numpy as np
import sympy

from autograder.judge import Question, mistake
from dhkit.variants import OwnNumbers

from ..shared.own_arm import ARM, transform
from ..shared.pool import arms, in_si, measured

DEGREE = np.pi / 180


def predicted(
    mine: OwnNumbers, *, lengths: str = "fitted", degree: float = DEGREE, rows: int | None = None, unit: float = 1.0
) -> list[float]:
    """Where the end effector of the arm that was built will be, (3,), in metres.

    `lengths` are those that fit the log best, or the ``"printed"`` ones; `degree` is what an angle of 1 in the log
    counts, `rows` how many measurements are used, `unit` what a metre counts.
    """
    return [unit * value for value in _predicted(mine.arm, lengths, degree, rows)]


@cache
def _predicted(name: str, lengths: str, degree: float, rows: int | None) -> list[float]:
    arm, log = arms()[name], measured(name)
    matrix, shift = _linear(name)
    tried = [in_si(arm, q, degree) for q in log["q"][:rows]]
    if lengths == "fitted":
        left = np.vstack([matrix(*q) for q in tried])
        right = np.ravel(log["points"][:rows]) / 1000 - np.concatenate([shift(*q).ravel() for q in tried])
        found = np.linalg.lstsq(left, right)[0]
    else:
        found = np.array([float(value) for value in arm.table.values.values()])
    asked = in_si(arm, log["asked"], degree)
    return (matrix(*asked) @ found + shift(*asked).ravel()).tolist()


@cache
def _linear(name: str):
    """The position of the end effector is linear in the lengths: matrix (3, k) and shift (3,), functions of the joint values."""
    table = arms()[name].table
    lengths = [sympy.Symbol(str(letter)) for letter in table.values]
    position = transform(name)[:3, 3]
    matrix = position.jacobian(lengths)
    shift = (position - matrix * sympy.Matrix(lengths)).applyfunc(sympy.expand)
    as_floats = lambda entries: (  # noqa: E731
        lambda call: lambda *q: np.array(call(*q), float)
    )(sympy.lambdify(table.joints, entries))
    return as_floats(matrix), as_floats(shift)


MEASURED = Question(
    "scara.measured",
    reference=predicted,
    mistakes=(
        mistake(
            "printed_lengths",
            0.3,
            "**These are the lengths on paper.** The arm that was built has others: the log tells them.",
            wrong={"lengths": "printed"},
        ),
        mistake(
            "degrees",
            0.4,
            "**The log counts angles in degrees, cosines want radians.** A fit whose residuals are not below a millimetre says that "
            "something is wrong.",
            wrong={"degree": 1.0},
        ),
        mistake(
            "millimetres", 0.8, "**Right, in millimetres.** The question counts in metres.", wrong={"unit": 1000.0}
        ),
        mistake(
            "few_measurements",
            0.6,
            "**Not all measurements are in it.** Some of them fix the lengths, all of them fix them better: the errors of the tracker "
            "average out.",
            wrong=[{"rows": count} for count in (2, 3, 4, 5)],
        ),
    ),
    depends=ARM,
)
