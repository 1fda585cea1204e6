"""What the lectures ask to try: every answer is confirmed, every mistake named, by the file in the kit."""

import json
import re
from pathlib import Path

import pytest

from autograder.questions.tries import TRIES
from autograder.sealing.lectures import seal_lectures
from dhkit import public
from dhkit.home.envelopes import OF_LECTURES, encoded
from dhkit.home.verdict import verdict

COURSE = Path(__file__).parents[2] / "course"


def test_the_file_is_current():
    """If it is not: python -m autograder.sealing.lectures"""
    assert OF_LECTURES.read_bytes() == encoded(seal_lectures())


def test_both_halves_and_the_lectures_have_the_same():
    sources = [
        "".join(cell["source"]) for path in COURSE.glob("*.ipynb") for cell in json.loads(path.read_text())["cells"]
    ]
    checked = [id for source in sources for id in re.findall(r'^check\("(try\.[\w.]+)"', source, re.M)]
    assert sorted(checked) == sorted(public.tries()) == sorted(question.id for question in TRIES)


@pytest.mark.parametrize("question", TRIES, ids=lambda question: question.id)
def test_answers_are_confirmed_and_mistakes_named(question):
    assert verdict(question.id, question.answer("ada")).state == "right"
    for node in question.mistakes:
        for way in node.ways:
            found = verdict(question.id, question.answer("ada", way))
            assert (found.state, found.note, found.text) == ("mistake", node.note, node.feedback)


def test_an_unknown_one_is_told_with_its_neighbours():
    with pytest.raises(KeyError, match=r"try\.scara\.down"):
        public.find("try.scara.donw")
