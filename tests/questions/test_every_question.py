"""Judge the judge, for every question there is: a new question is covered by being registered.

Right answers in several forms earn full marks, every mistake of the tree is named, perturbed answers are refused.
"""

import re
from contextlib import suppress
from itertools import islice, permutations

import numpy as np
import pytest
import sympy
from answers import STUDENT, another_form, mistaken, other_forms, perturbed, right, verdict

from autograder.judge import Evidence, Family, Question, judge
from autograder.judge.chain import SAME_SENSES
from autograder.questions import exercises, find
from autograder.questions.shared.tables import list_rows
from autograder.reference import robots
from dhkit import public, wire
from dhkit.variants import SETS, member, numbers_of_set

QUESTIONS = [question for questions in exercises().values() for question in questions]
DATA = [question for question in QUESTIONS if question.form.kind != "function"]
FUNCTIONS = [question for question in QUESTIONS if question.form.kind == "function"]
ids = lambda questions: [question.id for question in questions]  # noqa: E731


def right_forms():
    for question in DATA:
        for name in ("as it is", *other_forms(question, right(question))):
            yield pytest.param(question, name, id=f"{question.id}: {name}")


@pytest.mark.parametrize(("question", "form"), list(right_forms()))
def test_right_forms_earn_everything(question, form):
    answer = {"as it is": right(question), **other_forms(question, right(question))}[form]
    found = verdict(question, answer)
    assert (found.note, found.share) == ("right", 1.0)
    assert not any(word in found.feedback for word in ("wrong", "differ", "missing")), found.feedback


@pytest.mark.parametrize("question", FUNCTIONS, ids=ids(FUNCTIONS))
def test_right_functions_earn_everything(question):
    reference = question.answer(STUDENT)
    plain = lambda *args: getattr(answer := reference(*args), "solutions", answer)  # noqa: E731
    forms = {
        "array": lambda *args: np.array(plain(*args)),
        "lists": lambda *args: np.array(plain(*args)).tolist(),
        "as it is": plain,
        "sympy": lambda *args: sympy.sympify(np.array(plain(*args)).tolist()),
        "tuples": lambda *args: tuple(np.array(plain(*args))) if np.ndim(plain(*args)) else np.float64(plain(*args)),
    }
    for name, form in forms.items():
        assert verdict(question, form).note == "right", name


def mistakes():
    for question in QUESTIONS:
        for node in question.mistakes:
            for i, way in enumerate(node.ways):
                yield pytest.param(question, node, way, id=f"{question.id}: {node.note} {i}")


@pytest.mark.parametrize(("question", "node", "way"), list(mistakes()))
def test_every_mistake_is_named(question, node, way):
    """As the tree makes it, and as a student may write it: a mistake that only the tree can make is nobody's."""
    try:
        answer = mistaken(question, way)
    except ValueError as none:
        assert question.personal and "changes nothing" in str(none)  # nobody can make it with this arm
        return
    for written in (answer, another_form(question, node, answer)) if question in DATA else (answer,):
        found = verdict(question, written)
        assert (found.note, found.share) == (node.note, node.share)
        assert found.feedback.startswith(node.feedback.partition("{")[0])


@pytest.mark.parametrize("question", DATA, ids=ids(DATA))
def test_steps_leave_the_reference_as_it_is(question):
    reference = right(question)
    before = wire.encode(reference)
    for step in (step for node in question.mistakes for step in node.steps):
        with suppress(ValueError):  # a mistake that nobody can make with this arm
            step(reference)
        assert wire.encode(reference) == before, step


SCARA = list_rows(robots.SCARA.table)
TURNED_X2 = [[0, 0, 0, 0, "t1"], [0, "a2", 0, 0, "t2 + pi"], [1, "-a3", 0, "-d2", "pi"], [0, 0, 0, 0, "t4"]]
SHIFTED_O3 = [[0, 0, 0, 0, "t1"], [0, "a2", 0, 0, "t2"], [1, "a3", 0, "-d2 - a2", 0], [0, 0, 0, "a2", "t4"]]
DOWNWARDS = [[0, 0, 0, 0, "t1"], [0, "a2", 0, 0, "t2"], [1, "a3", "pi", "d2", 0], [0, 0, 0, 0, "-t4"]]


@pytest.mark.parametrize(
    ("rows", "note", "words"),
    [
        (TURNED_X2, "right", "another sense of X2"),
        (SHIFTED_O3, "right", "another origin O3 along Z3"),
        (DOWNWARDS, "same_chain_other_frames", "another tool frame"),
    ],
)
def test_the_scara_in_other_frames(rows, note, words):
    question = Question("scara.table", SCARA, pinned=SAME_SENSES, partial=0.6)
    heading = {"title": "SCARA", "expected": "four rows", "hints": ["one", "two"], "minutes": 1}
    letters = {"symbols": ["t1", "t2", "d2", "t4", "a2", "a3"], "joints": ["t1", "t2", "d2", "t4"]}
    question.__dict__["public"] = public.from_table(
        "scara.table", {"kind": "dh_table", "shape": [4, 5], **heading, **letters}
    )
    found = verdict(question, [[sympy.sympify(cell) for cell in row] for row in rows])
    assert found.note == note and words in found.feedback


@pytest.mark.slow
@pytest.mark.parametrize("question", [q for q in DATA if q.form.kind != "number"], ids=lambda q: q.id)
def test_two_mistakes_at_once_are_named(question):
    """But for single numbers: there two mistakes would match by chance."""
    for first, second in permutations(question.mistakes, 2):
        try:
            answer = mistaken(question, first.ways[0], second.ways[0])
        except (AttributeError, IndexError, KeyError, TypeError, ValueError, ZeroDivisionError):
            continue  # the steps exclude each other
        note = verdict(question, answer).note
        assert note not in ("partly_right", "nothing_matched", "malformed"), f"{first.note}, then {second.note}"


def test_two_mistakes_earn_the_product_of_their_shares_and_both_feedbacks():
    question = find("scara.table")
    signs, classic = (next(n for n in question.mistakes if n.note == note) for note in ("sign_of_d", "classic_table"))
    found = verdict(question, mistaken(question, signs.ways[0], classic.ways[0]))
    assert found.note == "classic_table+sign_of_d"
    assert found.share == pytest.approx(signs.share * classic.share)
    assert signs.feedback in found.feedback and classic.feedback in found.feedback


@pytest.mark.parametrize("question", QUESTIONS, ids=ids(QUESTIONS))
def test_a_tree_is_well_formed(question):
    notes = [node.note for node in question.mistakes]
    assert len(set(notes)) == len(notes)
    assert all(re.fullmatch("[a-z0-9_]+", note) for note in notes), "the gradebook would lose such a note"
    assert all(0 <= node.share < 1 and node.feedback.strip() for node in question.mistakes)
    assert all(node.ways for node in question.mistakes)
    assert len(question.mistakes) >= 2, "a response tree knows at least two misconceptions"
    assert question.residual or "joint_solutions" not in (
        question.form.kind,
        getattr(getattr(question.form, "returns", None), "kind", ""),
    )


@pytest.mark.parametrize("question", QUESTIONS, ids=ids(QUESTIONS))
def test_nothing_is_not_an_answer(question):
    blank = ... if question.form.kind != "function" else lambda *args: None
    assert (verdict(question, blank).note, verdict(question, blank).share) == ("not_attempted", 0.0)


@pytest.mark.slow
@pytest.mark.parametrize("question", [q for q in DATA if q.form.kind != "choice"], ids=lambda q: q.id)
def test_perturbed_answers_are_refused(question):
    """As many as it takes to reach most entries of a table or a matrix in most ways, and all of anything smaller."""
    rng = np.random.default_rng(11)
    wanted = 100 if len(getattr(question.form, "shape", ())) == 2 else 60
    tried = (perturbed(question, rng) for _ in range(4 * wanted))
    wrong = list(islice((answer for answer in tried if answer is not None), wanted))
    assert len(wrong) == wanted
    for answer in wrong:
        assert verdict(question, answer).share < 1, answer


@pytest.mark.slow
@pytest.mark.parametrize("question", FUNCTIONS, ids=ids(FUNCTIONS))
def test_perturbed_functions_are_refused(question):
    """A result of one single argument list is changed: the function is not right, whatever else it gets right."""
    reference, probes = question.answer(STUDENT), question.probes(STUDENT, 7)
    rng = np.random.default_rng(13)
    plain = [getattr(answer := reference(*args), "solutions", answer) for args in probes]
    for place in range(len(probes)):
        results = [np.array(each, dtype=float) for each in plain]
        if results[place].size == 0:
            results[place] = np.full((1, len(question.returns.joints)), 0.3)
        elif question.returns.kind == "point_cloud":
            results[place] = results[place] * 1.5 + 10 * question.accuracy
        else:
            results[place].flat[rng.integers(results[place].size)] += rng.uniform(0.1, 1)
        family = isinstance(reference(*probes[place]), Family)
        if family and question.setting(STUDENT, *probes[place]).residual(np.atleast_2d(results[place])).max() < 1e-9:
            continue
        answers = iter(results)
        assert verdict(question, lambda *args: next(answers)).share < 1, probes[place]


@pytest.mark.parametrize("question", [q for q in DATA if q.form.kind == "choice"], ids=lambda q: q.id)
def test_other_choices_are_refused(question):
    answer = question.answer(STUDENT)
    assert answer in question.form.options
    assert all(verdict(question, letter).share < 0.5 for letter in question.form.options if letter != answer)


@pytest.mark.parametrize("question", FUNCTIONS, ids=ids(FUNCTIONS))
def test_constant_functions_are_refused(question):
    first = question.answer(STUDENT)(*question.probes(STUDENT, 7)[0])
    first = getattr(first, "solutions", first)
    for wrong in (lambda *args: first, lambda *args: [], lambda *args: 1 / 0, lambda *args: "right"):
        assert verdict(question, wrong).share == 0


@pytest.mark.parametrize("question", FUNCTIONS, ids=ids(FUNCTIONS))
def test_something_else_than_a_function_is_said_to_be_so(question):
    found = judge(question, Evidence(wire.packet(question.id, answer=[1, 2])), STUDENT)
    assert found.note == "malformed" and "expected a function" in found.feedback and "shape 2" in found.feedback


@pytest.mark.parametrize("question", [q for q in QUESTIONS if q.depends is not None], ids=lambda q: q.id)
def test_only_the_numbers_that_a_question_names_change_its_answer(question):
    """Else the envelopes of one student would open, or stay closed, for another one's answer."""
    numbers = [numbers_of_set(question.exercise, which) for which in range(SETS)]
    like = {}
    for which, mine in enumerate(numbers):
        like.setdefault(tuple(mine[name] for name in question.depends), []).append(which)
    shared = [sets[:2] for sets in like.values() if len(sets) > 1]
    assert question.personal and shared
    for pair in shared[:6]:
        students = [member(question.exercise, which) for which in pair]
        for ways in ((), *((node.ways[0],) for node in question.mistakes)):
            try:
                one, other = (question.answer(student, *ways) for student in students)
            except ValueError as none:
                assert "changes nothing" in str(none)
                continue
            if question.form.kind == "function":
                probes = question.probes(students[0], 7)
                assert probes == question.probes(students[1], 7)
                one, other = ([function(*args) for args in probes] for function in (one, other))
            plain = [getattr(each, "solutions", each) for each in (one, other)]
            assert wire.encode(plain[0]) == wire.encode(plain[1])


def test_both_halves_ask_the_same_questions():
    assert {question.id for question in QUESTIONS} == set(public.questions())


def test_what_several_exercises_share_is_no_exercise():
    assert "shared" not in exercises()
    with pytest.raises(KeyError, match="there is no question 'shared.tables'"):
        find("shared.tables")


def test_an_unknown_question_names_what_exists():
    with pytest.raises(KeyError, match="scara.T04"):
        find("scara.T40")
