"""Comparison of answers kind by kind: equivalent forms agree, near misses do not."""

import numpy as np
import pytest
import sympy

from autograder.judge import kinds
from autograder.judge.chain import SAME_MODEL
from autograder.judge.decode import Malformed, decode
from autograder.judge.kinds import Setting
from dhkit import forms
from dhkit.wire import encode

t1, t2, x = sympy.symbols("t1 t2 x")
rng = np.random.default_rng(5)
POINTS = {"t1": rng.uniform(-3, 3, 8), "t2": rng.uniform(-3, 3, 8)}


def question(kind, **fields):
    if kind not in ("number", "joint_solutions", "choice"):
        fields = {"symbols": ["t1", "t2"], **fields}
    return forms.from_table({"kind": kind, "expected": "the form", **fields})


def read(form, answer):
    return kinds.read(form, decode(encode(answer)))


def compare(form, student, other, **setting):
    return kinds.compare(form, read(form, student), read(form, other), Setting(POINTS, **setting))


EXPRESSION = question("expression")


@pytest.mark.parametrize(
    ("student", "other", "equal"),
    [
        (sympy.sin(t1) ** 2, 1 - sympy.cos(t1) ** 2, True),
        (sympy.sin(t1 + t2), sympy.sin(t1 - t2), False),
        (t1 + 1e-9, t1, True),
        (t1 + 1e-4, t1, False),
        (sympy.sqrt(t1**2), t1, False),
        (sympy.sqrt(t1**2), sympy.Abs(t1), True),
        (1 / sympy.Add(t1, -t1, evaluate=False), t1, False),
        (sympy.log(t1), sympy.log(t1), True),
    ],
)
def test_expressions(student, other, equal):
    assert compare(EXPRESSION, student, other).equal is equal


def test_cancellation_does_not_fail_a_right_answer():
    big = sympy.Integer(10) ** 11
    spoiled = sympy.Add(
        sympy.Mul(big, sympy.sin(t1) + 1, evaluate=False),
        sympy.Mul(-big, sympy.sin(t1), evaluate=False),
        -big + t1,
        evaluate=False,
    )
    assert compare(EXPRESSION, spoiled, t1).equal
    assert not compare(EXPRESSION, spoiled + sympy.Rational(1, 1000), t1).equal


def test_a_near_miss_without_symbols_is_not_equal():
    number = question("number")
    assert not compare(number, 1.005, 1).equal
    assert compare(number, 1.00000001, 1).equal


def test_angles_are_equal_modulo_two_pi_only_where_asked():
    assert compare(EXPRESSION, t1 + 2 * sympy.pi, t1, angles=(0,)).equal
    assert not compare(EXPRESSION, t1 + sympy.pi, t1, angles=(0,)).equal
    assert not compare(EXPRESSION, t1 + 2 * sympy.pi, t1).equal


def test_natural_types_of_a_matrix():
    form = question("matrix", shape=[2, 2])
    rows = [[sympy.cos(t1), 0], [1, t2]]
    for student in (
        rows,
        tuple(map(tuple, rows)),
        np.array(rows, dtype=object),
        sympy.Matrix(rows),
        sympy.ImmutableMatrix(rows),
    ):
        assert compare(form, student, rows).equal
    wrong = compare(form, [[sympy.cos(t1), 0], [1, t1]], rows)
    assert not wrong.equal and wrong.share == 0.75 and "row 2, column 2" in wrong.remarks[0]


def test_transform_credit_is_per_block():
    form = question("transform", shape=[4, 4])
    right, wrong = sympy.eye(4), sympy.eye(4)
    wrong[0, 3] = 1
    assert compare(form, wrong, right).share == 0.5


def test_table_credit_is_per_row_and_angles_wrap():
    form = question("dh_table", shape=[2, 5], joints=["t1", "t2"])
    rows = [[0, 0, 0, 0, t1], [0, 1, sympy.pi / 2, 0, t2]]
    wrapped = [[0, 0, 2 * sympy.pi, 0, t1], [0, 1, -3 * sympy.pi / 2, 0, t2]]
    assert compare(form, wrapped, rows).equal
    assert compare(form, [rows[0], [0, 2, sympy.pi / 2, 0, t2]], rows, patient=True).share == 0.5


def test_a_table_of_the_same_chain_is_right_within_the_freedoms_left():
    form = question("dh_table", shape=[2, 5], joints=["t1", "t2"])
    rows = [[0, 0, 0, 0, t1], [0, 1, sympy.pi / 2, 0, t2]]
    turned_x1 = [[0, 0, 0, 0, t1 + sympy.pi], [0, -1, -sympy.pi / 2, 0, t2 + sympy.pi]]
    found = compare(form, turned_x1, rows, patient=True)
    assert found.equal and found.remarks == ("another sense of X1",)
    pinned = compare(form, turned_x1, rows, patient=True, pinned=frozenset({"sense of X"}))
    assert not pinned.equal and pinned.note == "same_chain_other_frames" and "sense of X1" in pinned.remarks[0]
    one = compare(form, [rows[0], [0, 2, sympy.pi / 2, 0, t2]], rows, patient=True)
    assert not one.equal and one.note == "one_cell" and "row 2, column a" in one.remarks[0]
    two = compare(form, [rows[0], [0, 2, sympy.pi / 3, 0, t2]], rows, patient=True)
    assert not two.equal and two.remarks == ("what differs: row 2, columns a and alpha",)


def test_cells_are_wrong_in_the_frames_that_the_author_chose():
    """A right row is not blamed because X of its frame points the other way."""
    form = question("dh_table", shape=[3, 5], joints=["t1", "t2"])
    rows = [[0, 0, 0, 0, t1], [0, 1, sympy.pi / 2, 0, t2], [0, 0.5, 0, 0.2, 0]]
    turned_x1 = [[0, 0, 0, 0, t1 + sympy.pi], [0, -2, -sympy.pi / 2, 0, t2 + sympy.pi], rows[2]]
    found = compare(form, turned_x1, rows, patient=True, pinned=SAME_MODEL)
    assert found.remarks == ("only one cell differs: row 2, column a",) and found.share == 2 / 3
    empty = compare(form, [rows[0], [...] * 5, rows[2]], rows, patient=True)
    assert empty.remarks == ("row 2 is not filled in",)


def test_what_is_no_chain_is_compared_cell_by_cell():
    form = question("dh_table", shape=[2, 5], joints=["t1", "t2"])
    rows = [[0, 0, 0, 0, t1], [0, 1, 0, 0, t2]]
    for broken in (
        [rows[0], [0, 1, 0, 0, sympy.sin(t2)]],
        [rows[0], [0.5, 1, 0, 0, t2]],
        [rows[0], [0, 1, 0, ..., t2]],
    ):
        found = compare(form, broken, rows, patient=True)
        assert not found.equal and found.share == 0.5 and "row 2" in found.remarks[0]


def test_blank_cells_are_wrong_cells():
    form = question("vector", shape=[2])
    assert compare(form, [t1, ...], [t1, t2]).share == 0.5


SOLUTIONS = question("joint_solutions", joints=["t1", "t2"])


@pytest.mark.parametrize(
    ("student", "equal", "remark"),
    [
        ([[1, 2], [-1, 3]], True, None),
        ([[-1, 3], [1, 2]], True, None),
        ([[-1, 3 - 2 * np.pi], [1 + 4 * np.pi, 2], [1, 2]], True, None),
        ([[1, 2]], False, "1 of 2 solutions missing"),
        ([1, 2], False, "1 of 2 solutions missing"),
        ([], False, "2 of 2 solutions missing"),
        ([[1, 2], [-1, 3], [0, 0]], False, "1 of the 3 given does not reach"),
        ([[1, 3], [-1, 2]], False, "missing"),
    ],
)
def test_joint_solutions(student, equal, remark):
    result = compare(SOLUTIONS, student, [[1, 2], [-1, 3]], angles=(0, 1), tolerance=1e-3)
    assert result.equal is equal
    if remark:
        assert remark in "; ".join(result.remarks)


def test_a_full_turn_has_360_degrees():
    assert compare(SOLUTIONS, [[10, 370.01]], [[10, 10]], angles=(0, 1), tolerance=1e-3, turn=360).equal
    assert not compare(SOLUTIONS, [[10, 370.1]], [[10, 10]], angles=(0, 1), tolerance=1e-3, turn=360).equal
    assert not compare(SOLUTIONS, [[10, 10 + 2 * np.pi]], [[10, 10]], angles=(0, 1), tolerance=1e-3, turn=360).equal


def test_a_heap_of_guesses_is_no_list_of_solutions():
    with pytest.raises(Malformed, match="4000 solutions"):
        read(SOLUTIONS, [[k, k] for k in range(4000)])


def test_no_solution_is_an_answer():
    assert compare(SOLUTIONS, [], []).equal
    assert not compare(SOLUTIONS, [[0, 0]], []).equal


@pytest.mark.parametrize(
    ("form", "answer", "found"),
    [
        (EXPRESSION, x, "symbol x"),
        (EXPRESSION, [1, 2], "shape 2"),
        (EXPRESSION, "t1", "text"),
        (EXPRESSION, object(), "type object"),
        (EXPRESSION, {"t1": 1, "t2": 2}, "dictionary"),
        (question("matrix", shape=[2, 2]), [[1, 2], [3]], "different lengths"),
        (question("vector", shape=[3]), [[1, 2, 3], [1, 2, 3]], "2 x 3"),
        (EXPRESSION, 1 / (t1 - t1 + 0 * t2), "the value nan"),
        (SOLUTIONS, [[float("nan"), 0]], "the value nan"),
        (SOLUTIONS, [[sympy.Pow(0, -1, evaluate=False), 0]], "not finite"),
        (SOLUTIONS, [[1j, 0]], "complex"),
        (SOLUTIONS, [[t1, 0]], "symbol t1"),
        (question("choice", options=["A", "B"]), "E", "E"),
        (question("choice", options=["A", "B"]), 1, "number"),
    ],
)
def test_what_is_not_understood_is_named(form, answer, found):
    with pytest.raises(Malformed, match="expected the form, found") as caught:
        read(form, answer)
    assert found in str(caught.value)


def test_choice_ignores_case_and_space():
    form = question("choice", options=["A", "B"])
    assert compare(form, " a ", "A").equal and not compare(form, "b", "A").equal


def test_every_form_can_be_judged():
    """A kind is a module in dhkit/forms and one of the same name in judge/kinds; a function is judged by its results."""
    assert set(kinds.KINDS) == set(forms.KINDS) - {"function"}
