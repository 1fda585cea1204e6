"""What the lecture documents give to practise is asked: thirty topics, every robot, every kind of answer, the whole catalogue."""

import ast
import inspect
import re
import tomllib
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

from autograder.judge import misconceptions
from autograder.questions import exercises
from autograder.reference import errata, parallel, robots
from dhkit.forms import KINDS
from dhkit.public import questions

ROOT = Path(__file__).parents[2]
SYLLABUS = tomllib.loads((ROOT / "docs/syllabus.toml").read_text())
TOPICS = SYLLABUS["topic"]
README = (ROOT / "README.md").read_text()
MODULES = [ast.parse(file.read_text()) for file in (ROOT / "autograder/questions").rglob("*.py")]
# Robots that questions make with lengths or readings of their own.
MADE_BY = {"planar": {"PLANAR_4R"}, "pen": {"PEN_A", "PEN_B", "PEN_C"}, "scara_centres": {"SCARA_EPFL"}}


def asked():
    cells = [
        cell for path in (ROOT / "solutions").glob("*/*.ipynb") for cell in nbformat.read(path, as_version=4).cells
    ]
    return {cell.source.partition('"')[2].partition('"')[0] for cell in cells if cell.source.startswith("check(")}


def names_used():
    for node in (node for module in MODULES for node in ast.walk(module)):
        if isinstance(node, ast.Attribute):
            yield node.attr
        elif isinstance(node, ast.Name):
            yield node.id


def test_there_are_thirty_topics_from_five_documents():
    assert len(TOPICS) == 30
    assert len({(topic["source"], topic["task"]) for topic in TOPICS}) == 30
    for document in ("MECA 953", "EPFL", "DH-m", "pen robot", "s600"):
        assert any(document in topic["source"] for topic in TOPICS)


@pytest.mark.parametrize("topic", TOPICS, ids=lambda topic: f"{topic['source']}: {topic['task']}")
def test_every_topic_is_asked(topic):
    assert topic["questions"] and set(topic["questions"]) <= asked()


def test_there_are_at_least_eighty_questions_of_every_kind():
    assert len(questions()) >= 80
    forms = [question.form for question in questions().values()]
    kinds = {form.kind for form in forms} | {form.returns.kind for form in forms if form.kind == "function"}
    assert kinds == set(KINDS)


def test_every_robot_of_the_documents_is_asked_about():
    used = set(names_used())
    found = {name.upper() for name in used} | set().union(*(made for name, made in MADE_BY.items() if name in used))
    assert set(SYLLABUS["robots"]) - found == set()
    assert set(SYLLABUS["robots"]) <= set(robots.names())
    assert {parallel.ThreeRPR.__name__, parallel.ThreeRRR.__name__, "THREE_RPR"} & used


def test_every_misconception_of_the_catalogue_stands_in_a_tree():
    functions = inspect.getmembers(misconceptions, inspect.isfunction)
    makes = {
        name for name, made in functions if made.__module__ == misconceptions.__name__ and not name.startswith("_")
    }
    assert makes - {"classic_transform", "product"} - set(names_used()) == set()


def test_every_lecture_has_its_exercise_and_stands_in_the_readme():
    lectures = {path.stem for path in (ROOT / "course").glob("[0-9]*.ipynb")}
    assert {name.partition("_")[2] for name in lectures} - set(exercises()) == {"errata"}
    table = re.findall(r"^\| `course/(\w+).ipynb` \| (?:`exercises/(\w+)/`|for lecturers) \|", README, re.M)
    assert {lecture for lecture, _ in table} == lectures
    assert all(exercise in ("", lecture.partition("_")[2]) for lecture, exercise in table)


@pytest.mark.slow
@pytest.mark.notebook
def test_the_errata_lecture_shows_every_erratum_with_its_proof():
    lecture = nbformat.read(ROOT / "course/13_errata.ipynb", as_version=4)
    done = NotebookClient(lecture, timeout=120).execute()
    shown = "\n".join(
        output.get("data", {}).get("text/html", "") for cell in done.cells for output in cell.get("outputs", ())
    )
    known = {erratum.id for erratum in errata.ERRORS + errata.AMBIGUITIES}
    assert len(known) == 61
    assert sorted(known) == sorted(re.findall(r"<code>([\w-]+)</code>", shown)), "each once"
    assert shown.count("<b>proved</b>") == len(known) and "NOT PROVED" not in shown
