"""The verdict at home is the judge's, and nobody reads it who has not made the answer."""

from itertools import chain, product

import msgspec
import numpy as np
import pytest
import sympy
from answers import entries, evidence, other_forms, perturbed

from autograder.judge import Family, judge
from autograder.judge.tree import IMPOSSIBLE
from autograder.questions import exercises
from autograder.sealing import seal_exercise
from autograder.sealing.likely import named
from autograder.sealing.plausible import years
from autograder.sealing.seal import sealables
from dhkit import variants, wire
from dhkit.forms.base import Symbolic, squeezed
from dhkit.forms.number import Number
from dhkit.home import envelopes
from dhkit.home.cells import WIDTH
from dhkit.home.envelopes import SUFFIX, encoded, lock_of
from dhkit.home.verdict import kind_of, verdict
from dhkit.values import reals

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
    "question",
    [q for q in QUESTIONS if not q.personal and q.form.symbols and q.form.kind != "function"],
    ids=lambda q: q.id,
)
def test_two_mistakes_and_slips_are_named_as_the_judge_names_them(home, question):
    if not is_sealed(question):
        return
    whose = student(question)
    known = named(question, whose)
    said = [(ours, verdict(question.id, answer, whose)) for ours, answer in known]
    assert all(found.note in ("", ours.note) and found.state != "right" for ours, found in said)
    assert sum(found.note == ours.note for ours, found in said) >= len(known) / 4 > 0


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


def test_a_table_has_the_name_of_a_mistake_only_as_this_is_written(home):
    """-t5 gives the hand of two wrong twists: the judge does not blame the twists, and home does not either."""
    question = next(question for question in QUESTIONS if question.id == "tables.wrist")
    whose = student(question)
    rows = [list(row) for row in question.answer(whose)]
    rows[1][4] = -rows[1][4]
    assert agree(question, rows, whose).state == "not_right"


ROUNDED = [q for q in QUESTIONS if q.personal and not q.form.symbols and q.form.kind not in ("function", "point_cloud")]


@pytest.mark.parametrize("digits", [1, 2, 3, 4])
@pytest.mark.parametrize("question", ROUNDED, ids=lambda q: q.id)
def test_rounded_answers_are_as_right_as_for_the_judge(home, question, digits):
    if not is_sealed(question):
        return
    whose = student(question)
    numbers = np.array(sympy.Matrix(plain(question.answer(whose))).evalf().tolist(), float)
    agree(question, np.round(numbers, digits).tolist(), whose)


@pytest.mark.parametrize("question", [q for q in QUESTIONS if q.form.symbols], ids=lambda q: q.id)
def test_constant_angles_typed_as_decimals_are_right_at_home(home, question):
    whose = student(question)
    answer = entries(plain(question.answer(whose)))
    if not is_sealed(question) or not any(entry.has(sympy.pi) for entry in answer.flat):
        return
    typed = lambda e: e.replace(lambda x: x.is_number and x.has(sympy.pi), lambda x: sympy.Float(round(float(x), 4)))  # noqa: E731
    found = agree(question, np.vectorize(typed, otypes=[object])(answer).tolist(), whose)
    assert found.state == "right"


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


def sealed_features(question):
    """Features of all that is sealed for the first set of numbers, by part."""
    made = envelopes.find(question.exercise)
    here = made.of(question.id)
    found = {}
    for one in sealables(question, 0):
        lock = lock_of(made, question.id, one.part, here.personal, 0, here.sight.tolerance)
        found.setdefault(one.part, (lock, []))[1].append(lock.features(one.numbers))
    return here.sight, found


def opened(lock, features, numbers):
    """How many of the answers (G, m) come so near to a sealed one that a neighbouring cell could be its own."""
    guessed = lock.features(numbers.T).T
    width = WIDTH * lock.tolerance
    near = [guessed.shape[1] == len(one) and (np.abs(guessed - one) <= width).all(axis=1) for one in features]
    return int(np.sum(near))


ENTRIES = [q for q in QUESTIONS if type(q.form).invariants in (Symbolic.invariants, Number.invariants)]


@pytest.mark.parametrize("question", ENTRIES, ids=lambda q: q.id)
def test_a_hundred_thousand_guesses_open_nothing(home, question):
    if not is_sealed(question):
        return
    sight, sealed = sealed_features(question)
    rng = np.random.default_rng(8)
    pool = np.array([reals([wire.encode(one) for one in guesses(question)], at) for at in sight.points])
    pool = pool[:, np.isfinite(pool).all(axis=0)]
    size = int(np.prod(question.form.shape))
    lock, features = sealed[""]
    tried = 0
    for _ in range(20):
        chosen = rng.integers(pool.shape[1], size=(5000, size))
        chosen[rng.random(chosen.shape) < 0.4] = 0  # the pool begins with zero
        answers = np.moveaxis(pool[:, chosen], 0, 1)
        tried += len(answers)
        assert not opened(lock, features, squeezed(answers.reshape(-1, size), sight.angles).reshape(5000, -1))
    assert tried == 100_000


@pytest.mark.parametrize(
    "question",
    [q for q in QUESTIONS if q not in ENTRIES and q.form.kind not in ("choice", "function", "point_cloud")],
    ids=lambda q: q.id,
)
def test_guesses_at_tables_transforms_and_postures_open_nothing(home, question):
    if not is_sealed(question):
        return
    sight, sealed = sealed_features(question)
    form, rng = question.form, np.random.default_rng(8)
    nodes = [wire.encode(one) for one in guesses(question)]
    rows = {"joint_solutions": 2}.get(form.kind)
    shape = (rows, len(form.joints)) if rows else form.shape
    tried = 0
    for _ in range(500):
        chosen = rng.integers(len(nodes), size=shape)
        chosen[rng.random(shape) < 0.4] = 0
        node = form.arranged(np.vectorize(nodes.__getitem__, otypes=[object])(chosen).tolist())
        for part, numbers in form.invariants(node, sight).items():
            if kind_of(part) in sealed:
                tried += 1
                assert not opened(*sealed[kind_of(part)], numbers[None])
    assert tried > 300


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


def test_years_of_an_answer_beyond_all_counting():
    assert years(31.0, 365 * 86400) == 2.0**30
    assert years(5000.0, 0.02) == float("inf")
