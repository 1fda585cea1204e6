"""The verdict at home is the judge's, and nobody reads it who has not made the answer."""

from itertools import chain, product

import msgspec
import numpy as np
import pytest
import sympy
from answers import evidence, other_forms, perturbed

from autograder.judge import Family, judge
from autograder.judge.tree import IMPOSSIBLE
from autograder.questions import exercises
from autograder.sealing import seal_exercise
from dhkit import variants, wire
from dhkit.home import envelopes
from dhkit.home.envelopes import SUFFIX, encoded, lock_of
from dhkit.home.verdict import kind_of, verdict

pytestmark = pytest.mark.slow

SALT = b"a salt for tests"
CHEAP = 2
"""Of scrypt: tests try more keys than anybody should."""

SETS = 2
QUESTIONS = [question for questions in exercises().values() for question in questions]


@pytest.fixture(scope="module")
def sealed(tmp_path_factory):
    """Every exercise sealed at a low price, for two sets of numbers, in a folder of its own."""
    root = tmp_path_factory.mktemp("sealed")
    for exercise, questions in exercises().items():
        made, _ = seal_exercise(exercise, questions, SALT, {}, {}, cost=CHEAP, sets=SETS)
        folder = root / "exercises" / exercise
        folder.mkdir(parents=True)
        (folder / f"{exercise}{SUFFIX}").write_bytes(encoded(made))
    return root


@pytest.fixture
def home(sealed, monkeypatch):
    """The folder of a student who has all exercises."""
    monkeypatch.chdir(sealed)
    return sealed


def is_sealed(question):
    return not envelopes.find(question.exercise).of(question.id).why_not


def student(question, which=0):
    return variants.member(question.exercise, which)


def judged(question, answer, whose):
    return judge(question, evidence(question, answer, whose), whose)


def plain(answer):
    return answer.solutions if isinstance(answer, Family) else answer


def agree(question, answer, whose):
    """Home says right exactly where the judge gives everything, and names what it names as the judge does."""
    found, ours = verdict(question.id, answer, whose), judged(question, answer, whose)
    if found.state == "undecided":  # right as far as it can be tried at home
        assert "right for all that was tried here" in found.text
        return found
    assert (found.state == "right") == (ours.share == 1), (found, ours)
    if found.state == "mistake":
        assert (found.note, found.share) == (ours.note, ours.share), (found, ours)
        assert found.text.split("**")[1] in ours.feedback
    return found


@pytest.mark.parametrize("question", QUESTIONS, ids=lambda question: question.id)
def test_right_answers_are_right_at_home(home, question):
    for which in range(SETS if question.personal else 1):
        whose = student(question, which)
        answer = plain(question.answer(whose))
        if not is_sealed(question):
            assert verdict(question.id, answer, whose).state == "undecided"
            continue
        found = verdict(question.id, answer, whose)
        assert found.state == "right" or "right for all that was tried here" in found.text
        if question.form.kind != "function":
            for form in other_forms(question, answer).values():
                agree(question, form, whose)


@pytest.mark.parametrize("question", QUESTIONS, ids=lambda question: question.id)
def test_named_mistakes_are_named_as_the_judge_names_them(home, question):
    if not is_sealed(question):
        return
    whose, named = student(question), 0
    for way in chain.from_iterable(node.ways for node in question.mistakes):
        try:
            answer = question.answer(whose, way)
            found = agree(question, answer, whose)
        except IMPOSSIBLE:
            continue
        named += found.state == "mistake"
    assert named or len(question.mistakes) < 3


@pytest.mark.parametrize(
    "question", [q for q in QUESTIONS if q.form.kind not in ("choice", "function")], ids=lambda q: q.id
)
def test_wrong_answers_are_not_right_at_home(home, question):
    if not is_sealed(question) or question.personal:
        return
    rng = np.random.default_rng(5)
    for _ in range(12):
        answer = perturbed(question, rng)
        if answer is not None:
            agree(question, answer, student(question))


ROUNDED = [q for q in QUESTIONS if q.personal and not q.form.symbols and q.form.kind not in ("function", "point_cloud")]


@pytest.mark.parametrize("digits", [1, 2, 3, 4])
@pytest.mark.parametrize("question", ROUNDED, ids=lambda q: q.id)
def test_rounded_answers_are_as_right_as_for_the_judge(home, question, digits):
    if not is_sealed(question):
        return
    whose = student(question)
    numbers = np.array(sympy.Matrix(plain(question.answer(whose))).evalf().tolist(), float)
    agree(question, np.round(numbers, digits).tolist(), whose)


# ---------------------------------------------------------------- secrecy


def guesses(question):
    """Plausible entries for somebody who has not worked: symbols, signs, products of two, round numbers."""
    names = question.form.symbols
    symbols = list(sympy.symbols(names)) if names else []
    simple = [0, 1, -1, sympy.pi, -sympy.pi / 2, sympy.pi / 2, *symbols, *(-s for s in symbols)]
    waves = [f(s) for s in symbols for f in (sympy.sin, sympy.cos)]
    products = [a * b for a, b in product([*symbols, *waves], repeat=2)] if symbols else []
    decimals = [round(0.1 * k, 1) for k in range(-31, 32)]
    return [*simple, *waves, *products, *decimals]


def filled(question, entry):
    """An answer whose entries are all one guess, or one guess beside zeros."""
    form = question.form
    if form.kind == "joint_solutions":
        yield [[entry] * len(form.joints)]
        return
    shape = form.shape
    if not shape:
        yield entry
        return
    yield np.full(shape, entry, dtype=object).tolist()
    identity = np.zeros(shape, dtype=object)
    identity.reshape(-1)[0] = entry
    yield identity.tolist()


@pytest.mark.parametrize(
    "question", [q for q in QUESTIONS if q.form.kind not in ("choice", "function", "point_cloud")], ids=lambda q: q.id
)
def test_guesses_open_nothing(home, question):
    """Each cell that a guess touches is tried against all envelopes, whole answers and parts."""
    if not is_sealed(question):
        return
    sealed = envelopes.find(question.exercise)
    here = sealed.of(question.id)
    tags = {here.envelopes[0][start : start + 8] for start in range(0, len(here.envelopes[0]), here.length)}
    tried = 0
    for entry in guesses(question)[:150]:
        for answer in filled(question, entry):
            node = question.form.arranged(wire.encode(answer))
            if question.form.complaint(node):
                continue
            for part, numbers in question.form.invariants(node, here.sight).items():
                lock = lock_of(sealed, question.id, kind_of(part), here.personal, 0, here.sight.tolerance)
                for cell in lock.cells(numbers):
                    tried += 1
                    assert lock.key(cell)[0] not in tags, (answer, part)
    assert tried > 50


def test_nothing_of_an_answer_stands_in_the_file(sealed):
    for exercise, questions in exercises().items():
        raw = (sealed / "exercises" / exercise / f"{exercise}{SUFFIX}").read_bytes()
        for question in questions:
            for node in question.mistakes:
                assert node.feedback[:30].encode() not in raw
                assert node.feedback[-30:].encode() not in raw
            here = msgspec.msgpack.decode(raw, type=envelopes.SealedExercise).of(question.id)
            assert len({len(text) for text in here.texts}) <= 1
            assert len({len(some) for some in here.envelopes}) <= 1


def test_two_releases_share_nothing_and_one_is_repeated_to_the_byte():
    questions = exercises()["scara"]
    seal = lambda salt: encoded(seal_exercise("scara", questions, salt, {}, {}, cost=CHEAP, sets=1)[0])  # noqa: E731
    first, again, other = seal(b"one"), seal(b"one"), seal(b"two")
    assert first == again
    read = lambda raw: msgspec.msgpack.decode(raw, type=envelopes.SealedExercise)  # noqa: E731
    for name, here in read(first).questions.items():
        there = read(other).questions[name]
        pieces = set(there.texts) | {some[i : i + 16] for some in there.envelopes for i in range(len(some) - 16)}
        mine = set(here.texts) | {some[i : i + 16] for some in here.envelopes for i in range(len(some) - 16)}
        assert not pieces & mine


def test_another_set_of_numbers_opens_nothing(home):
    (question,) = (q for q in exercises()["scara"] if q.id == "scara.postures")
    answer = question.answer(student(question, 1))
    assert verdict(question.id, answer, student(question, 0)).state in ("not_right", "partly")


def test_the_solution_comes_with_the_right_answer_only(tmp_path, monkeypatch):
    questions = exercises()["scara"]
    made, _ = seal_exercise("scara", questions, SALT, {"scara.T04": "as follows"}, {}, cost=CHEAP, sets=1)
    (tmp_path / f"scara{SUFFIX}").write_bytes(encoded(made))
    monkeypatch.chdir(tmp_path)
    (question,) = (q for q in questions if q.id == "scara.T04")
    assert verdict(question.id, question.answer("ada"), "ada").solution == "as follows"
    wrong = question.answer("ada", question.mistakes[0].ways[0])
    assert verdict(question.id, wrong, "ada").solution == ""
    assert b"as follows" not in encoded(made)


def test_what_cannot_be_read_is_decided_by_the_grader(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (question,) = (q for q in exercises()["scara"] if q.id == "scara.T04")
    answer = question.answer("ada")
    assert verdict(question.id, answer, "ada").state == "undecided"
    (tmp_path / f"scara{SUFFIX}").write_bytes(b"nonsense")
    assert verdict(question.id, answer, "ada").state == "undecided"
