"""No points for nothing: errors carried over that are bought on purpose, functions that know nothing, blind guesses."""

from itertools import chain, combinations

import numpy as np
import pytest
import sympy
from answers import STUDENT, evidence, right, verdict

from autograder.judge import is_forgivable, judge
from autograder.questions import exercises, find
from autograder.reference.transforms import modified_dh

QUESTIONS = [question for questions in exercises().values() for question in questions]
FUNCTIONS = [question for question in QUESTIONS if question.form.kind == "function"]
FOLLOWING = [question for question in QUESTIONS if question.follows is not None]
ids = lambda questions: [question.id for question in questions]  # noqa: E731


# ---------------------------------------------------------------- errors carried over


def bought(earlier):
    """Earlier answers that know little, but from which something follows, and in how many rows or blocks they do not."""
    answer = np.array(sympy.Matrix(right(earlier)).tolist(), dtype=object)
    if earlier.form.kind == "dh_table":
        count, joints = len(answer), sympy.symbols(earlier.form.joints)
        yield "theta = q", [[0, 0, 0, 0, theta] for theta in (*joints, *[0] * (count - len(joints)))]
        for rows in chain.from_iterable(combinations(range(count), size) for size in range(1, count + 1)):
            empty = answer.copy()
            empty[list(rows)] = 0
            yield f"{len(rows)} empty", empty.tolist()
        return
    for name, block in (("no position", np.s_[:3, 3]), ("no rotation", np.s_[:3, :3]), ("identity", np.s_[:, :])):
        empty = answer.copy()
        empty[block] = np.eye(4, dtype=int)[block]
        yield name, empty.tolist()


def what_follows(question, before):
    """The answer that follows from an earlier one, in symbols."""
    if find(question.follows.earlier).form.kind == "transform":
        return [*(row[3] for row in before[:3]), sympy.atan2(before[1][0], before[0][0])]
    T = sympy.eye(4)
    for row in before[1 if question.id == "scara_s600.T14" else 0 :]:
        T = T * modified_dh(*row[1:])
    return T if question.form.kind == "transform" else list(T[:3, 3])


@pytest.mark.parametrize("question", FOLLOWING, ids=ids(FOLLOWING))
def test_points_of_a_follow_up_cannot_be_bought(question):
    earlier, symbols = find(question.follows.earlier), sympy.Matrix(sympy.flatten(right(question))).free_symbols
    for name, before in bought(earlier):
        handed_in, answer = evidence(earlier, before), what_follows(question, before)
        forgiven = {earlier.id: handed_in} if is_forgivable(judge(earlier, handed_in, STUDENT)) else {}
        found = judge(question, evidence(question, answer), STUDENT, forgiven)
        nothing_lost = sympy.Matrix(sympy.flatten(answer)).free_symbols == symbols
        assert found.note != "right_from_earlier" or (nothing_lost and name == "1 empty"), (name, found)


# ---------------------------------------------------------------- functions that know nothing


def constants(question):
    """What a function may return for everything: nothing, zeros, or what is right for some arguments."""
    reference, form = question.answer(STUDENT), question.returns
    yield [] if form.kind == "joint_solutions" else 0 if not form.shape else np.zeros(form.shape)
    kept = set()
    for args in question.probes(STUDENT, 7):
        result = reference(*args)
        result = getattr(result, "solutions", result)
        case = question.case(*args)
        if case not in kept:
            kept.add(case)
            yield result


def all_but_one(constant, other):
    """A function that tells one call from the others, without reading its arguments."""
    calls = []

    def answer(*args):
        calls.append(args)
        if len(calls) > 1:
            return constant
        if isinstance(other, Exception):
            raise other
        return other

    return answer


@pytest.mark.parametrize("question", FUNCTIONS, ids=ids(FUNCTIONS))
def test_a_constant_that_differs_at_one_call_earns_nothing(question):
    for constant in constants(question):
        for other in (constant, ValueError("not now"), right_at_first(question)):
            assert verdict(question, all_but_one(constant, other)).share == 0, (constant, other)


def right_at_first(question):
    result = question.answer(STUDENT)(*question.probes(STUDENT, 7)[0])
    return getattr(result, "solutions", result)
