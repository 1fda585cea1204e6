"""The judge reaches a verdict on whatever the wire can carry: no exception, no points for nonsense."""

import random

import pytest

from autograder.judge import Evidence, judge
from autograder.questions import exercises
from dhkit import wire

pytestmark = pytest.mark.slow

QUESTIONS = [question for questions in exercises().values() for question in questions]
ODD = [
    0, 1, -1, 7, 0.5, 1e308, -1e-300, True, "x", [], [[]],
    {"float": "nan"}, {"float": "inf"}, {"float": "-inf"}, {"int": "9" * 300}, {"rat": [1, {"int": "9" * 300}]},
    {"complex": [1.5, 1.0]}, {"complex": [{"float": "nan"}, 0]}, {"const": "pi"}, {"const": "I"}, {"blank": True},
    {"unknown": "a.b"}, {"function": "f"}, {"dict": [["a", 1]]}, {"error": "E"}, {"call": ["acot", {"int": "0"}]},
]  # fmt: skip
ARITIES = {"pow": 2, "atan2": 2, "Mod": 2, "add": 3, "mul": 3, "Max": 2, "Min": 2}


def scalar(rng, symbols, depth=0):
    draw = rng.random()
    if draw < 0.5 or depth > 4:
        return rng.choice(ODD)
    if draw < 0.7 and symbols:
        return {"sym": rng.choice(symbols)}
    function = rng.choice([*ARITIES, *wire.FUNCTIONS])
    return {"call": [function, *(scalar(rng, symbols, depth + 1) for _ in range(ARITIES.get(function, 1)))]}


def answer(rng, form):
    """A random answer of the form asked for, or now and then of none."""
    if rng.random() < 0.05 or form.kind in ("number", "expression", "choice"):
        return scalar(rng, form.symbols)
    if form.kind == "joint_solutions":
        return [
            [rng.choice([rng.uniform(-4, 4), scalar(rng, ())]) for _ in form.joints]
            for _ in range(rng.choice([0, 1, 2, 99]))
        ]
    everywhere = scalar(rng, form.symbols)
    nested = lambda sizes: [nested(sizes[1:]) for _ in range(sizes[0])] if sizes else entry()  # noqa: E731
    entry = lambda: everywhere if rng.random() < 0.7 else scalar(rng, form.symbols)  # noqa: E731
    return nested(form.shape if len(form.shape) > 1 else (*form.shape, 1))


@pytest.mark.parametrize("question", QUESTIONS, ids=lambda question: question.id)
def test_every_answer_gets_a_verdict(question):
    rng = random.Random(question.id)
    for _ in range(60):
        if question.form.kind == "function":
            probes = question.probes("ada", rng.randrange(9))
            results = wire.packet(question.id, probes=[answer(rng, question.returns) for _ in probes])
            evidence = Evidence(wire.packet(question.id, answer={"function": "f"}), (probes, results))
        else:
            evidence = Evidence(wire.packet(question.id, answer=answer(rng, question.form)))
        found = judge(question, evidence, "ada")
        assert 0 <= found.share <= question.partial, evidence


@pytest.mark.parametrize(
    "question", [q for q in QUESTIONS if q.form.kind == "dh_table"], ids=lambda question: question.id
)
@pytest.mark.parametrize("entry", ODD, ids=str)
def test_a_table_of_one_odd_entry_earns_nothing(question, entry):
    rows, columns = question.form.shape
    found = judge(question, Evidence(wire.packet(question.id, answer=[[entry] * columns] * rows)), "ada")
    assert found.share == 0
