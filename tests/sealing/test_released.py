"""The sealed files in ``exercises/`` are those of the present questions: everything that is sealed now opens in them."""

from pathlib import Path

import nbformat
import pytest

from autograder.grading.release import points, solutions
from autograder.questions import exercises
from autograder.sealing import decisions
from autograder.sealing.seal import sealables
from dhkit import variants
from dhkit.home import envelopes
from dhkit.home.envelopes import SUFFIX, lock_of, open_envelopes, read

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
MOST_BYTES = 5 << 20


@pytest.mark.parametrize("exercise", exercises())
def test_the_sealed_file_is_current(exercise):
    """If it is not: autograder release."""
    questions = exercises()[exercise]
    notebook = nbformat.read(ROOT / "solutions" / exercise / f"{exercise}.ipynb", as_version=4)
    worked, worth = solutions(notebook), points(notebook)
    file = read(ROOT / "exercises" / exercise / f"{exercise}{SUFFIX}")
    assert list(file.questions) == [question.id.partition(".")[2] for question in questions]
    for question, decision in zip(questions, decisions(questions), strict=True):
        here = file.of(question.id)
        assert (here.why_not, here.points) == (decision.why_not, worth[question.id]), question.id
        if here.why_not:
            continue
        assert len(here.envelopes) == 1 + max(map(here.place, range(variants.SETS)))
        for which in {0, variants.SETS - 1} if question.personal else {0}:
            place = here.place(which)
            for one in sealables(question, which, worked.get(question.id, "")):
                lock = lock_of(file, question.id, one.part, here.personal, place, here.sight.tolerance)
                # Answers that are close together lie in one cell: their numbers tell them apart.
                opened = open_envelopes(here, here.envelopes[place], lock, one.numbers)
                assert one.said in [each.said for each in opened], (question.id, one.said.note)


def test_all_sealed_files_together_are_small():
    sizes = [path.stat().st_size for path in (ROOT / "exercises").glob(f"*/*{envelopes.SUFFIX}")]
    assert len(sizes) == len(exercises()) and sum(sizes) < MOST_BYTES
