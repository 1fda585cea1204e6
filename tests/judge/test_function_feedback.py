"""What feedback on a function tells: for which arguments it failed, what came back, and nothing of the right result."""

import json

import numpy as np
import pytest
from answers import STUDENT, verdict

from autograder.judge.probing import MOST_ARGUMENTS, MOST_RETURNED
from autograder.questions import exercises, find

pytestmark = pytest.mark.slow

FUNCTIONS = [q for qs in exercises().values() for q in qs if q.form.kind == "function"]


def some(question, change):
    """The right function, its result changed where `change` says so: ``change(number of the call, result)``."""
    reference, calls = question.answer(STUDENT), []

    def answer(*args):
        calls.append(args)
        result = reference(*args)
        return change(len(calls) - 1, getattr(result, "solutions", result))

    return answer


def fail(message):
    raise ZeroDivisionError(message)


@pytest.mark.parametrize("question", FUNCTIONS, ids=lambda question: question.id)
def test_an_exception_is_told_with_its_message_and_the_arguments(question):
    found = verdict(question, some(question, lambda k, result: fail("my <b>own</b> fault") if k == 1 else result))
    assert found.share < 1
    assert "my &lt;b&gt;own" in found.feedback and "For example, with `" in found.feedback
    first = json.dumps(question.probes(STUDENT, 7)[1][0])
    assert first[:3] in found.feedback and len(found.feedback) < 3000


@pytest.mark.parametrize("question", FUNCTIONS, ids=lambda question: question.id)
def test_what_came_back_is_told_and_not_what_is_right(question):
    """The right result of the call that failed is nowhere in the text."""
    odd = 0.123456 if not question.returns.shape else np.full(question.returns.shape, 0.123456).tolist()
    odd = [[0.123456] * len(question.returns.joints)] if question.returns.kind == "joint_solutions" else odd
    found = verdict(question, some(question, lambda k, result: odd))
    assert "0.1234" in found.feedback or "returns the same for all" in found.feedback
    right = np.ravel(_result(question, question.probes(STUDENT, 7)[0]))
    told = found.feedback.partition("it returned")[2]
    assert not any(f"{value:.4g}" in told for value in right if abs(value) > 1e-3 and value % 1)


def _result(question, args):
    result = question.answer(STUDENT)(*args)
    return np.array(getattr(result, "solutions", result), dtype=float)


def test_a_complaint_about_the_form_is_told_where_other_results_are_well_formed():
    question = find("inverse_models.rx90")
    found = verdict(question, some(question, lambda k, result: [row[:3] for row in result]))
    assert "not in the form asked for" in found.feedback and "3" in found.feedback


def test_every_entry_that_differs_is_told():
    question = find("transforms.parameters")
    found = verdict(
        question, some(question, lambda k, result: [result[0], result[1] + 0.3, result[2], result[3] - 0.2])
    )
    assert "alpha and theta" in found.feedback
    both = find("workspace.reach")
    found = verdict(both, some(both, lambda k, result: [result[0] + 0.1, result[1] + 0.3]))
    assert "r_min and r_max" in found.feedback


def test_hostile_messages_and_results_are_short_and_harmless():
    question = find("planar_2r.inverse")
    found = verdict(
        question, some(question, lambda k, result: fail("`</code><script>" + "x" * 5000) if k < 15 else result)
    )
    assert "<script>" not in found.feedback and "`<" not in found.feedback
    assert len(found.feedback) < 3 * (MOST_ARGUMENTS + MOST_RETURNED + 600)
