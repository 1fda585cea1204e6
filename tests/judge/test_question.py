"""A reference and its mistakes: what they are called with, and how two mistakes meet in one answer."""

import numpy as np
import pytest
import sympy

from autograder.judge import Evidence, Family, Question, judge, mistake
from autograder.judge.misconceptions import posture_missing
from dhkit import public, variants, wire
from dhkit.public import from_table

TABLES = {
    "arm.point": {"kind": "vector", "expected": "two numbers", "shape": [2]},
    "arm.postures": {"kind": "joint_solutions", "expected": "a list of all (t1, t2)", "joints": ["t1", "t2"]},
    "arm.inverse": {
        "kind": "function",
        "expected": "a function",
        "returns": {"kind": "joint_solutions", "expected": "a list of all (t1, t2)", "joints": ["t1", "t2"]},
    },
}


@pytest.fixture(autouse=True)
def arm(monkeypatch):
    known = {id: from_table(id, {"title": id, **table}) for id, table in TABLES.items()}
    monkeypatch.setattr(public, "find", lambda id: known[id])
    monkeypatch.setattr(variants, "variant_ranges", lambda exercise: {"L1": (0.1, 9.9, 0.1)})


def note(question, answer, student="ada"):
    return judge(question, Evidence(wire.packet(question.id, answer=wire.encode(answer))), student).note


def note_of_function(question, function, student="ada"):
    probes = question.probes(student, 3)
    results = wire.packet(question.id, probes=[wire.encode(function(*args)) for args in probes])
    handed_in = wire.packet(question.id, answer={"function": "inverse"})
    return judge(question, Evidence(handed_in, (probes, results)), student).note


# ---------------------------------------------------------------- a value, or a function of the student's numbers


def point(mine, bend=1.0, shift=0.0):
    return [mine.L1 * bend, mine.L1 + shift]


POINT = Question(
    "arm.point",
    reference=point,
    mistakes=(
        mistake("bent", 0.5, "**Bent.**", wrong={"bend": 3.0}),
        mistake("shifted", 0.5, "**Shifted.**", wrong=[{"shift": 0.5}, {"shift": 0.7}]),
        mistake("exchanged", 0.5, "**Exchanged.**", lambda found: found[::-1]),
    ),
)


@pytest.mark.parametrize("student", ["ada", "bob"])
def test_a_reference_is_made_of_the_students_own_numbers(student):
    own = variants.numbers("arm", student)["L1"]
    assert POINT.personal and note(POINT, [own, own], student) == "right"


def test_keywords_of_the_reference_make_a_mistake_in_each_of_its_forms():
    own = variants.numbers("arm", "ada")["L1"]
    assert note(POINT, [3 * own, own]) == "bent"
    assert note(POINT, [own, own + 0.5]) == note(POINT, [own, own + 0.7]) == "shifted"


def test_keywords_of_two_mistakes_go_together_and_act_before_every_step():
    own = variants.numbers("arm", "ada")["L1"]
    assert note(POINT, [3 * own, own + 0.7]) == "bent+shifted"
    assert note(POINT, [own + 0.5, own]) == "exchanged+shifted"
    bent, _, exchanged = POINT.mistakes
    assert POINT.answer("ada", exchanged.ways[0], bent.ways[0]) == POINT.answer("ada", bent.ways[0], exchanged.ways[0])


def test_a_value_is_the_same_for_everybody():
    question = Question("arm.point", reference=[sympy.Symbol("x"), 1])
    assert not question.personal and question.answer("ada") is question.answer("bob")
    assert Question("arm.point", reference=sympy.Symbol("x")).answer("ada") == sympy.Symbol("x"), (
        "symbols can be called"
    )


def test_a_keyword_that_the_reference_does_not_take_is_refused():
    bent = mistake("bent", 0.5, "**Bent.**", wrong={"angle": 3.0})
    with pytest.raises(ValueError, match=r"arm\.point: bent sets angle, but the reference takes bend, shift"):
        Question("arm.point", reference=point, mistakes=(bent,))
    with pytest.raises(ValueError, match="bent sets angle, but the reference takes no keyword"):
        Question("arm.point", reference=[1, 2], mistakes=(bent,))


def test_a_reference_that_wants_something_else_than_the_numbers_is_refused():
    with pytest.raises(ValueError, match=r"arm\.point: the reference takes variant, but is given .* as mine"):
        Question("arm.point", reference=lambda variant: [1, 2])


# ---------------------------------------------------------------- functions


def inverse(x, *, mine, sign=1):
    """Two postures up to the student's length, one at it, none beyond."""
    if x > mine.L1:
        return []
    return [[x, sign * 1.0], [x, -sign * 2.0]] if x < mine.L1 else [[x, 0.0]]


def ask(rng, mine):
    return [[0.5 * mine.L1], [0.7 * mine.L1], [mine.L1], [2 * mine.L1]]


INVERSE = Question(
    "arm.inverse",
    reference=inverse,
    mistakes=(posture_missing(), mistake("sign", 0.5, "**Sign.**", wrong={"sign": -1})),
    tolerance=1e-3,
    probe=ask,
    residual=lambda q, x: np.abs(q[:, 0] - x),
)


def test_a_function_and_what_it_is_asked_depend_on_the_students_numbers():
    for student in ("ada", "bob"):
        assert note_of_function(INVERSE, INVERSE.answer(student), student) == "right"


def test_steps_work_on_what_a_function_returns_also_where_that_is_empty():
    right = INVERSE.answer("ada")
    assert note_of_function(INVERSE, lambda x: right(x)[:1]) == "one_posture_missing"
    assert note_of_function(INVERSE, lambda x: right(x)[-1:]) == "one_posture_missing"


def test_two_mistakes_of_a_function():
    wrong = INVERSE.answer("ada", *(node.ways[0] for node in INVERSE.mistakes))
    assert note_of_function(INVERSE, wrong) == "one_posture_missing+sign"


# ---------------------------------------------------------------- infinitely many solutions


def free(sign=1):
    return Family([[0.0, sign * 0.4], [0.4, 0.0], [0.2, sign * 0.2]])


FREE = Question(
    "arm.postures",
    reference=free,
    mistakes=(
        mistake("sign", 0.5, "**Sign.**", wrong={"sign": -1}),
        mistake("half", 0.5, "**Half.**", lambda found: [[q1 / 2, q2 / 2] for q1, q2 in found]),
    ),
    tolerance=1e-3,
    residual=lambda q: np.abs(q.sum(axis=1) - 0.4),
)


def test_a_mistake_is_named_in_any_choice_of_the_representatives():
    assert note(FREE, [[0.1, 0.3]]) == "right"
    for rows in ([[0.0, 0.2]], [[0.1, 0.1]], [[0.2, 0.0], [0.1, 0.1]]):
        assert note(FREE, rows) == "half"
    assert note(FREE, [[0.0, -0.4]]) == note(FREE, [[0.0, -0.4], [0.2, -0.2]]) == "sign"
    assert note(FREE, [[0.0, -0.2]]) == "half+sign"
    assert note(FREE, [[0.05, 0.2]]) == "nothing_matched", "no representative"
