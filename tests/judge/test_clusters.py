"""Wrong answers outlive grading as text, are read again without trust, written readably, and put together by what they say."""

import json
from fractions import Fraction

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.judge import Question
from autograder.judge.clusters import MAX_KEPT, Attempt, cluster, is_unexplained, keep, recall, right_answer
from autograder.judge.decode import Call, Constant, Number, Symbol, Text, decode_answer
from autograder.judge.evaluate import evaluate
from autograder.judge.written import LIMIT, written
from dhkit import public, wire

t1, t2, a2, a3, d2, x, y, z = sympy.symbols("t1 t2 a2 a3 d2 x y z")
SYMBOLS = ["t1", "t2", "t4", "a2", "a3", "d2"]


def asked(id, table, *args, **kwargs):
    """A question of these tests alone, whose public half is `table`."""
    question = Question(id, *args, **kwargs)
    question.__dict__["public"] = public.from_table(
        id, {"title": id, "minutes": 1, "hints": ["one", "two"], "expected": "it", **table}
    )
    return question


MODEL = asked(
    "scara.model",
    {"kind": "vector", "shape": [4], "symbols": SYMBOLS},
    [a2 * sympy.cos(t1), a2 * sympy.sin(t1), -d2, t1],
    angles=(3,),
)
TABLE = asked(
    "scara.table",
    {"kind": "dh_table", "shape": [4, 5], "symbols": SYMBOLS, "joints": SYMBOLS[:3] + ["d2"]},
    [[0, 0, 0, 0, t1], [0, a2, 0, 0, t2], [1, a3, 0, -d2, 0], [0, 0, 0, 0, 0]],
)
POSTURES = Question("scara.postures", [[0, 0, 0, 0]], angles=(0, 1, 3), tolerance=1e-3)
FORWARD = Question("scara.forward", max)
CHOICE = Question("scara.d2_sign", "B")


def decoded(value, id="any"):
    return decode_answer(wire.packet(id, answer=wire.encode(value)), id)


def attempts(question, *answers, said="Not right."):
    """Students a, b, c ... with these answers, each taken through what grading keeps."""
    return [
        Attempt(
            chr(ord("a") + i),
            said,
            recall(question.id, keep(question.id, wire.packet(question.id, answer=wire.encode(answer)))),
        )
        for i, answer in enumerate(answers)
    ]


def students(question, found):
    return ["".join(one.students) for one in cluster(question, found)]


def test_equivalent_forms_fall_together_and_different_answers_apart():
    c, s = sympy.cos, sympy.sin
    answers = (
        [0, a2, 0, 0],
        [a2 * c(t1 + t2), a3, d2, t1],
        [a2 * (c(t1) * c(t2) - s(t1) * s(t2)), a3, d2, t1 + 2 * sympy.pi],
        [a2 * c(t1 - t2), a3, d2, t1],
        [a2 * c(-t1 - t2), a3 + 0 * t1, d2, t1],
    )
    assert students(MODEL, attempts(MODEL, *answers)) == ["bce", "a", "d"]
    assert all(one.alike for one in cluster(MODEL, attempts(MODEL, *answers)))


def test_other_kinds_compare_in_their_own_way():
    elbow = [[0.1, 0.2, 0.3, 0.4], [1, 2, 3, 4]]
    turned = [[1, 2 + 2 * np.pi, 3, 4], [0.1, 0.2001, 0.3, 0.4]]
    assert students(POSTURES, attempts(POSTURES, elbow, [[1, 2, 3, 4]], turned)) == ["ac", "b"]
    assert students(CHOICE, attempts(CHOICE, "C", "a", " c ", "A", "c")) == ["ace", "bd"]
    rows = [[0, 0, 0, 0, t1], [0, a3, 0, 0, t2], [1, a2, 0, -d2, 0], [0, 0, 0, 0, 0]]
    assert students(TABLE, attempts(TABLE, rows, sympy.Matrix(rows), rows[::-1])) == ["ab", "c"]


def test_blanks_are_equal_to_blanks_only():
    found = attempts(MODEL, [..., a2, 0, 0], [0, a2, 0, 0], [..., a2 + a3 - a3, 0, 0], [a2, ..., 0, 0])
    assert students(MODEL, found) == ["ac", "b", "d"]


def test_what_has_no_value_is_equal_to_itself():
    undefined = [sympy.log(sympy.Abs(t1) - sympy.Abs(t1), evaluate=False), 0, 0, 0]
    assert students(MODEL, attempts(MODEL, undefined, undefined, [0, 0, 0, 0])) == ["ab", "c"]


def test_two_tables_without_a_joint_do_not_end_the_report():
    lengths = [[0, t1, 0, 0, 0]] * 4, [[0, t2, 0, 0, 0]] * 4, [[0, t1 + t2 - t2, 0, 0, 0]] * 4
    assert students(TABLE, attempts(TABLE, *lengths)) == ["ac", "b"]


def test_functions_go_by_the_judges_words_without_their_measures():
    said = [
        "Wrong for reach (misses by up to 0.352).",
        "Wrong for reach (misses by up to 1.2e-05).",
        "Wrong for the rest.",
    ]
    found = [Attempt(name, words) for name, words in zip("abc", said)]
    assert students(FORWARD, found) == ["ab", "c"]
    assert not any(one.alike for one in cluster(FORWARD, found))


def test_answers_in_another_form_or_lost_go_by_words():
    found = attempts(MODEL, [1, 2], [1, 2, 3], said="Expected four expressions.") + [
        Attempt("lost", "Entry 1 differs.")
    ]
    assert students(MODEL, found) == ["ab", "lost"]


def test_answers_to_different_numbers_go_by_words():
    found = [
        Attempt(name, said, decoded(value), decoded(right))
        for name, said, value, right in (("a", "x", 1.0, 2.0), ("b", "x", 3.0, 4.0), ("c", "y", 1.0, 2.0))
    ]
    number = Question("planar_2r.theta1", 1)
    assert students(number, found) == ["ab", "c"]


def test_the_right_answer_is_there_to_compare():
    assert written(right_answer(MODEL, "ann").value) == "[a2*cos(t1), a2*sin(t1), -d2, t1]"
    assert right_answer(FORWARD, "ann") is None


def test_notes_that_name_a_mistake_are_explained():
    assert all(map(is_unexplained, ("nothing_matched", "partly_right", "one_cell", "malformed")))
    assert not any(
        map(
            is_unexplained,
            ("right", "right_from_earlier", "sign_of_d2", "not_attempted", "error", "same_chain_other_frames"),
        )
    )


@pytest.mark.parametrize(
    "packet",
    [
        None, "text", {"format": 1}, wire.packet("other.question", answer=1), wire.packet("scara.model", answer={"eval": "1"}),
        wire.packet("scara.model", answer={"function": "model"}), wire.packet("scara.model", answer=["x" * 900] * 30),
        wire.packet("scara.model", answer=float("nan")),
    ],
)  # fmt: skip
def test_only_what_can_be_decoded_is_kept(packet):
    assert keep("scara.model", packet) is None


def deep(levels):
    return '{"format":1,"question":"scara.model","answer":' + "[" * levels + "]" * levels + "}"


@pytest.mark.parametrize(
    "text", [None, 7, ["[]"], "", "1/0", "NaN", deep(100), deep(9_000), deep(MAX_KEPT), "9" * 6000, '{"a":1}']
)
def test_a_kept_text_is_not_trusted(text):
    assert recall("scara.model", text) is None


def test_what_is_kept_comes_back():
    value = [sympy.sqrt(t1) / 3, 2**80, 0.1, ...]
    text = keep("scara.model", wire.packet("scara.model", answer=wire.encode(value)))
    assert json.loads(text)["question"] == "scara.model" and recall("scara.model", text) == decoded(value)


@pytest.mark.parametrize(
    "value, text",
    [
        (a2 * sympy.cos(t1) - a3, "a2*cos(t1) - a3"),
        (-a2, "-a2"),
        (-x / 2, "-x/2"),
        (x / (y * z), "x/(y*z)"),
        ((x + y) * (x - y) ** 2, "(x - y)**2*(x + y)"),
        (1 / sympy.sqrt(x), "1/sqrt(x)"),
        ((x**y) ** z, "(x**y)**z"),
        (sympy.Rational(-2, 3) * x, "-2*x/3"),
        (sympy.atan2(y, -x), "atan2(y, -x)"),
        (sympy.pi / 2, "pi/2"),
        (0.1 + 0.2, "0.3"),
        (1 + 2j, "(1+2j)"),
        ([1, sympy.Rational(1, 2), ...], "[1, 1/2, ...]"),
        ([[1, -a2], [a3, 0]], "[ 1, -a2]\n[a3,   0]"),
        ([[1], [2, 3]], "[1]\n[2, 3]"),
        ("B", '"B"'),
        ({"x": t1}, '{"x": t1}'),
        (max, "a function max"),
        (object(), "an object of type builtins.object"),
        ([], "[]"),
    ],
)
def test_answers_are_written_as_one_types_them(value, text):
    assert written(decoded(value).value) == text


LEAVES = st.sampled_from(
    [Symbol("x"), Symbol("y"), *map(Number, (1, -2, Fraction(1, 3), Fraction(-3, 2), 0.5, -0.25)), Constant("pi")]
)
EXPONENTS = st.sampled_from([Number(value) for value in (1, 2, -1, -2, Fraction(2, 1), 0.0)])
ROOTS = st.sampled_from([Call("pow", (Symbol("x"), Number(Fraction(k, 2)))) for k in (1, -1, 3)])


def trees(inner):
    pairs = st.lists(inner, min_size=2, max_size=3).map(tuple)
    powers = st.tuples(inner, EXPONENTS)
    return st.one_of(
        *(
            st.builds(Call, st.just(name), args)
            for name, args in (("add", pairs), ("mul", pairs), ("pow", powers), ("sin", st.tuples(inner)))
        )
    )


@pytest.mark.slow
@settings(max_examples=200, deadline=None)
@given(st.recursive(LEAVES | ROOTS, trees, max_leaves=8))
def test_what_is_written_means_what_was_handed_in(tree):
    """Python itself reads the text and finds the same value."""
    names = {"sin": np.sin, "sqrt": np.sqrt, "pi": np.float64(np.pi), "x": np.float64(1.3), "y": np.float64(0.7)}
    (expected,) = evaluate(tree, {"x": np.array([1.3]), "y": np.array([0.7])})
    with np.errstate(all="ignore"):
        try:
            found = eval(written(tree, 10_000), names)
        except ZeroDivisionError:
            found = np.inf
    if np.isfinite(expected) and abs(expected) < 1e12:
        assert found == pytest.approx(expected, rel=1e-6, abs=1e-6)


def test_hostile_texts_are_written_on_one_line_and_short():
    text = "\x1b[2J\u202e</pre>\r\n\ud800" + "=" * 900
    for value in (Text(text), (Text(text),) * 40, decoded({"k\n": 1}).value):
        line = written(value)
        assert line.isprintable() and len(line) <= LIMIT
    assert len(written(decoded([[10**299] * 30] * 30).value)) <= LIMIT
