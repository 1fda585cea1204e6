"""The account of a verdict says the same as the verdict, for every question, whatever was handed in."""

import pytest
from answers import STUDENT, evidence, right

from autograder.judge import Evidence, judge
from autograder.judge.account import account
from autograder.questions import exercises
from dhkit import wire

QUESTIONS = [question for questions in exercises().values() for question in questions]


@pytest.mark.parametrize("question", QUESTIONS, ids=lambda question: question.id)
def test_a_right_answer_is_read_and_nothing_of_it_is_wrong(question):
    told = account(question, evidence(question, right(question)), STUDENT, {})
    assert told.verdict.note == "right" and told.read and told.asked == question.form.expected
    assert [note for note, _, decided in told.tree if decided] == ["right"]
    assert [note for note, *_ in told.tree[1:]] == [node.note for node in question.mistakes]
    if question.form.kind == "function":
        assert told.calls and all(call.right and call.returned and not call.remarks for call in told.calls)
    else:
        assert told.expected and not told.calls
    assert bool(told.numbers) == question.personal


ODD = [
    Evidence(None),
    Evidence(None, None, "NameError: name 'x'", "error"),
    Evidence("not a packet"),
    Evidence({"format": "dhkit.answer/1", "answer": {"blank": True}}),
]


@pytest.mark.parametrize(
    "question", [QUESTIONS[0], next(one for one in QUESTIONS if one.form.kind == "function")], ids=lambda one: one.id
)
def test_nothing_that_can_be_handed_in_has_no_account(question):
    packet = lambda answer: wire.packet(question.id, answer=answer)  # noqa: E731
    functions = [
        Evidence(packet({"function": "f"}), ([[1]] * 3, back))
        for back in (
            None,
            "x",
            wire.packet(question.id, probes=[1]),
            wire.packet(question.id, probes=[{"error": "no"}] * 3),
        )
    ]
    for found in [*ODD, Evidence(packet([[{"unknown": "a.b"}]])), Evidence(packet("x")), *functions]:
        told = account(question, found, STUDENT, {})
        assert told.verdict == judge(question, found, STUDENT, {}) and told.verdict.share == 0
