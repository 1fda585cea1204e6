"""Wrong steps on answers: each makes a new answer."""

import pytest
import sympy

from autograder.judge.steps import (
    change_cell,
    change_entry,
    change_rows,
    exchange,
    in_each_row,
    negate,
    replace_entry,
    substitute,
)

x, y = sympy.symbols("x y")
TABLE = [[0, 0, 0, 0, x], [0, 1, 0, 2, y]]


@pytest.mark.parametrize(
    ("step", "answer", "expected"),
    [
        (replace_entry(1, 9), [1, 2, 3], [1, 9, 3]),
        (change_entry(2, lambda entry: 2 * entry), [1, 2, 3], [1, 2, 6]),
        (negate(0, 2), [1, 2, 3], [-1, 2, -3]),
        (exchange(0, 2), [1, 2, 3], [3, 2, 1]),
        (in_each_row(negate(1)), [[1, 2], [3, 4]], [[1, -2], [3, -4]]),
        (change_cell(2, "d", lambda d: -d), TABLE, [TABLE[0], [0, 1, 0, -2, y]]),
        (change_rows("theta", lambda theta: theta + 1, 1, 2), TABLE, [[0, 0, 0, 0, x + 1], [0, 1, 0, 2, y + 1]]),
        (substitute({x: y, y: x}), [x, [x - y]], [y, [y - x]]),
        (substitute({x: 2}), sympy.Matrix([x, y]), sympy.Matrix([2, y])),
        (substitute({x: 2}), 5, 5),
    ],
)
def test_a_step_makes_a_new_answer(step, answer, expected):
    before = str(answer)
    assert step(answer) == expected
    assert str(answer) == before
