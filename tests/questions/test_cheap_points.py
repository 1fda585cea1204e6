"""No points for nothing: errors carried over that are bought on purpose, functions that know nothing, blind guesses."""

from itertools import chain, combinations

import numpy as np
import pytest
import sympy
from answers import STUDENT, evidence, right, verdict

from autograder.judge import is_forgivable, judge
from autograder.questions import exercises, find
from dhm.transforms import modified_dh

pytestmark = pytest.mark.slow

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
    for row in before:
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


# ---------------------------------------------------------------- blind guesses

# Where a guess earns more than a tenth, and why.
PARTLY_RIGHT = {
    "transforms.operators: the symbols as listed": 0.2,  # the order of a table, which is a misconception with a name
}


def guesses(question):
    """Answers made without reading more than the form that is asked for."""
    form = question.form if question.form.kind != "function" else question.returns
    if form.kind == "choice":
        yield "first choice", "A"
    elif form.kind == "joint_solutions":
        yield from (("none", []), ("zeros", [[0.0] * len(form.joints)]))
    elif form.kind == "point_cloud":
        yield "a square", [[x, y] for x in np.linspace(-1, 1, 60) for y in np.linspace(-1, 1, 60)]
    else:
        yield from ((f"all {number}", np.full(form.shape, number)) for number in (0, 1, 2, 3, 4, 8, -1))
        symbols = sympy.symbols(form.symbols)
        if len(form.shape) > 1:
            *_, rows, columns = form.shape
            if rows == columns:
                yield "identity", np.broadcast_to(np.eye(rows), form.shape)
            joints = [
                *(sympy.symbols(getattr(form, "joints", ())) or [s for s in symbols if str(s)[0] in "tqr"]),
                *[0] * 9,
            ]
            yield (
                "theta = q",
                np.broadcast_to(
                    np.array([[0] * (columns - 1) + [joint] for joint in joints[:rows]], dtype=object), form.shape
                ),
            )
        elif len(form.shape) == 1 and symbols:
            yield "the symbols as listed", (symbols * 9)[: form.shape[0]]
        elif symbols:
            yield from ((f"{symbol} alone", symbol) for symbol in symbols)


@pytest.mark.parametrize("question", QUESTIONS, ids=ids(QUESTIONS))
def test_a_blind_guess_earns_nothing(question):
    for name, guess in guesses(question):
        guess = guess.tolist() if isinstance(guess, np.ndarray) else guess
        answer = (lambda *args, guess=guess: guess) if question.form.kind == "function" else guess
        assert verdict(question, answer).share <= PARTLY_RIGHT.get(f"{question.id}: {name}", 0.1), name


# ---------------------------------------------------------------- right parts of wrong answers


def filled(answer, value, *places):
    """An answer of numbers or symbols with another value at some places."""
    changed = np.array(answer, dtype=object)
    for place in places:
        changed[place] = value
    return changed.tolist()


IDENTITY = np.eye(4, dtype=int).tolist()
PARTS = [
    ("direct_models.K", "four of five", lambda K: [*K[:3], IDENTITY, K[4]], 0.7),
    ("direct_models.K", "turns without their centres", lambda K: [[[*row[:3], int(i == 3)] for i, row in enumerate(M)] for M in K], 0.4),
    ("direct_models.K", "in reverse order", lambda K: K[::-1], 0.3),
    ("direct_models.wrong_cells", "one false alarm", lambda marks: filled(marks, 1, (2, 1, 1)), 0.7),
    ("direct_models.wrong_cells", "three of eight found", lambda marks: [marks[0], *filled(marks, 0, 1, 2)[1:]], 3 / 8),
    ("direct_models.wrong_cells", "three of eight found, two false alarms", lambda marks: filled([marks[0], *filled(marks, 0, 1, 2)[1:]], 1, (2, 1, 1), (1, 0, 0)), 1 / 8),
    ("direct_models.wrong_cells", "everything marked", lambda marks: np.ones((3, 4, 4)), 0),
    ("parameters.gripper", "the position of the statement alone", lambda T: filled(T, np.eye(3)[[1, 2, 0]], np.s_[:3, :3]), 0),
    ("parameters.gripper", "the rotation alone", lambda T: filled(T, 0.123, np.s_[:3, 3]), 0.5),
    ("scara.table", "row 2 wrong", lambda rows: filled(rows, 0.7, (1, 1), (1, 3)), 0.6),
    ("scara.table", "rows 2 and 3 wrong", lambda rows: filled(rows, 0.7, (1, 1), (2, 2)), 0.5),
]  # fmt: skip


@pytest.mark.parametrize(("id", "what", "change", "share"), PARTS, ids=[f"{id}: {what}" for id, what, *_ in PARTS])
def test_right_parts_earn_what_a_guess_does_not(id, what, change, share):
    found = verdict(find(id), change(right(find(id))))
    assert found.share == pytest.approx(share), found
