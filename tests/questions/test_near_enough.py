"""Right, or near enough: rounded numbers and constant angles earn what they deserve, in every question; wrong ones nothing."""

from dataclasses import replace
from pathlib import Path

import nbformat
import numpy as np
import pytest
import sympy
from answers import STUDENT, entries, right, verdict

from autograder.judge import Family, kinds
from autograder.judge.almost import ROUNDED as NOTE
from autograder.judge.decode import decode
from autograder.questions import exercises
from autograder.questions.shared.sheets import read, reading_of
from dhkit import wire
from dhkit.sheets import sheet_of

pytestmark = pytest.mark.slow

SOLUTIONS = Path(__file__).parents[2] / "solutions"
WORDS = {3: "three", 4: "four"}

QUESTIONS = [question for questions in exercises().values() for question in questions]
DATA = [question for question in QUESTIONS if question.form.kind not in ("function", "choice", "point_cloud")]
FUNCTIONS = [question for question in QUESTIONS if question.form.kind == "function"]
NUMERIC = [question for question in DATA if question.form.decimals]
by_id = lambda question: question.id  # noqa: E731


def each_entry(answer, change):
    if isinstance(answer, sympy.MatrixBase):
        return answer.applyfunc(change)
    return [each_entry(one, change) for one in answer] if isinstance(answer, (list, tuple)) else change(answer)


def typed(answer, places):
    """The answer of somebody who types constant angles as decimals."""
    shortened = lambda angle: sympy.Float(round(float(angle), places))  # noqa: E731
    return each_entry(answer, lambda e: sympy.sympify(e).replace(lambda x: x.is_number and x.has(sympy.pi), shortened))


def rounded(answer, places):
    return np.round(np.array(answer, dtype=float), places)


@pytest.mark.parametrize("question", DATA, ids=by_id)
def test_constant_angles_may_be_typed_to_four_decimals(question):
    if not any(entry.has(sympy.pi) for entry in entries(right(question)).flat):
        return
    for places in (4, 5, 6, 11):
        found = verdict(question, typed(right(question), places))
        assert (found.note, found.share) == ("right", 1.0), (places, found)
        assert ("pi" in found.feedback) or places > 4
    for places in (2, 3):
        found = verdict(question, typed(right(question), places))
        assert (found.note, found.share) == (NOTE, 0.8) and "pi" in found.feedback, (places, found)
    assert verdict(question, typed(right(question), 1)).share < 0.8


@pytest.mark.parametrize(("id", "rows"), [("direct_models.T06", slice(None)), ("direct_models.U2", slice(2, None))])
def test_products_of_rounded_quarter_turns(id, rows):
    question = next(one for one in QUESTIONS if one.id == id)
    mine = question.numbers(STUDENT)
    right = question.answer(STUDENT)

    def product(quarter, rows):
        total = sympy.eye(4)
        for row in sheet_of(mine).rows[rows]:
            rounded = [sympy.sympify(cell).subs(sympy.pi, 2 * quarter) for cell in row]
            total *= read(rounded, reading_of(mine.robot, mine.sheet))
        return total

    assert product(sympy.pi / 2, rows) == right
    for quarter, share in ((1.5708, 1), (1.570796, 1), (1.571, 0.8), (1.57, 0.8), (1.5, 0)):
        assert verdict(question, product(quarter, rows)).share == share, quarter
    assert verdict(question, product(1.5708, slice(2, None)).expand()).share == (id == "direct_models.U2")


@pytest.mark.parametrize(
    "question", [q for q in DATA if q.form.kind in ("dh_table", "transform", "matrix", "vector")], ids=by_id
)
def test_lengths_keep_their_tolerance(question):
    """Added to every entry at once: where an answer has no constant angle, nothing else may be off by it either."""
    error = max(3e-5, 1.5 * question.accuracy)
    answer = each_entry(right(question), lambda e: sympy.sympify(e) + sympy.Float(error))
    assert verdict(question, answer).note not in ("right", NOTE)


@pytest.mark.parametrize("question", NUMERIC, ids=by_id)
def test_numbers_with_the_decimals_that_are_asked_for_are_right(question):
    decimals = question.form.decimals
    for places in (decimals, decimals + 1, decimals + 2):
        assert verdict(question, rounded(right(question), places)).note == "right"
    assert verdict(question, rounded(right(question), decimals).astype(str).astype(float).tolist()).share == 1


@pytest.mark.parametrize("question", NUMERIC, ids=by_id)
def test_numbers_with_too_few_decimals_are_told_so_and_earn_most(question):
    decimals = question.form.decimals
    exact = np.array(right(question), dtype=float)
    for places in range(decimals - 1, 1, -1):
        cut = np.trunc(exact * 10**places) / 10**places
        assert verdict(question, cut).note in ("right", NOTE)
        found = verdict(question, rounded(exact, places))
        far = np.abs(exact - rounded(exact, places)).max() > question.accuracy
        family = isinstance(question.answer(STUDENT), Family)
        assert found.note == NOTE or (found.note == "right" and (family or not far)), (places, found)
        assert found.share >= 0.8
        if found.note == NOTE:
            assert WORDS[decimals] in found.feedback and "missing" not in found.feedback


@pytest.mark.parametrize("question", NUMERIC, ids=by_id)
def test_a_wrong_number_is_not_taken_for_a_rounded_one(question):
    exact = np.array(right(question), dtype=float)
    off = exact + 0.0127 * np.random.default_rng(1).uniform(0.9, 1.1, exact.shape)
    assert verdict(question, off).note not in ("right", NOTE)
    slipped = rounded(exact, 2) + 0.06 * (np.abs(exact) == np.abs(exact).max())
    assert verdict(question, slipped).note not in ("right", NOTE)


@pytest.mark.parametrize("question", FUNCTIONS, ids=by_id)
def test_functions_may_round_to_the_decimals_that_are_asked_for(question):
    decimals, function = question.returns.decimals, question.answer(STUDENT)
    if decimals is None:
        assert question.returns.kind == "number"
        return
    shortened = lambda places: lambda *args: rounded(getattr(found := function(*args), "solutions", found), places)  # noqa: E731
    assert verdict(question, shortened(decimals)).note == "right"
    found = verdict(question, shortened(2))
    assert (found.note, found.share) in (("right", 1.0), (NOTE, 0.8)), found


@pytest.mark.parametrize(
    "question",
    [q for q in DATA if q.form.kind in ("matrix", "transform", "dh_table", "vector", "expression")],
    ids=by_id,
)
@pytest.mark.parametrize("size", [1e9, 1e160, 1e300])
def test_an_answer_is_equal_to_itself_however_large_its_values_are(question, size):
    answer = kinds.read(question.form, decode(wire.encode(right(question))))
    again = kinds.read(question.form, decode(wire.encode(right(question))))
    large = {name: values * size for name, values in question.samples.items()}
    assert kinds.compare(question.form, answer, again, replace(question.setting(), samples=large)).equal


def is_whole(question):
    return all(entry.is_integer for entry in entries(right(question)).flat)


@pytest.mark.parametrize("question", [*DATA, *FUNCTIONS], ids=by_id)
def test_every_numeric_question_says_how_many_decimals_it_wants(question):
    form = question.returns if question.form.kind == "function" else question.form
    counts = question.form.kind == "function" and form.kind == "number"
    if form.symbols or counts or (question.form.kind != "function" and is_whole(question)):
        assert form.decimals is None
        return
    cells = nbformat.read(SOLUTIONS / question.exercise / f"{question.exercise}.ipynb", as_version=4).cells
    names = [cell.metadata.get("nbgrader", {}).get("grade_id") for cell in cells]
    answer = names.index(f"{question.id.replace('.', '-')}-answer")
    title = max(i for i in range(answer) if cells[i].cell_type == "markdown" and "## " in cells[i].source)
    statement = "\n".join(cell.source for cell in cells[title:answer] if cell.cell_type == "markdown")
    assert f"{WORDS[form.decimals]} decimals" in statement.lower()
