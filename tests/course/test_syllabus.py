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
from autograder.reference import errata, robots
from dhkit.forms import KINDS
from dhkit.public import questions
from dhm import parallel

ROOT = Path(__file__).parents[2]
SYLLABUS = tomllib.loads((ROOT / "docs/syllabus.toml").read_text())
TOPICS = SYLLABUS["topic"]
LECTURES = SYLLABUS["lecture"]
COURSE = ROOT / "course"
README = (ROOT / "README.md").read_text()
LECTURERS = (ROOT / "docs/lecturers.md").read_text()
MODULES = [ast.parse(file.read_text()) for file in (ROOT / "autograder/questions").rglob("*.py")]
# Robots that questions make with lengths or readings of their own.
MADE_BY = {
    "planar": {"PLANAR_4R"},
    "pen": {"PEN_A", "PEN_B", "PEN_C"},
    "scara_centres": {"SCARA_EPFL"},
    "epfl_centres": {"EPFL_ARM"},
}


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
def test_every_topic_is_taught_and_asked(topic):
    assert topic["questions"] and set(topic["questions"]) <= asked()
    assert topic["lecture"] in {lecture["notebook"] for lecture in LECTURES}


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


def test_lectures_stand_in_an_order_that_their_needs_allow_and_each_exercise_follows_one():
    names = [lecture["notebook"] for lecture in LECTURES]
    assert names == sorted(path.stem for path in COURSE.glob("[0-9]*.ipynb") if not path.stem.endswith("_errata"))
    for k, lecture in enumerate(LECTURES):
        assert set(lecture["needs"]) <= set(names[:k])
        assert 30 <= lecture["minutes"] <= 90
    # A robot of the lecturer's own (autograder new-exercise) belongs to no lecture.
    own = {file.parent.name for file in (ROOT / "autograder/questions").glob("*/robot.toml")}
    assert sorted(filter(None, map(exercise_of, LECTURES))) == sorted(set(exercises()) - own)


def exercise_of(lecture) -> str:
    return lecture.get("exercise", "")


def title(name) -> str:
    """The cell that a lecture begins with."""
    return nbformat.read(COURSE / f"{name}.ipynb", as_version=4).cells[0].source


def link(name) -> str:
    heading = title(name).partition("\n")[0].removeprefix("# ")
    return f"[{name[:2]} {heading.partition(':')[0]}]({name}.ipynb)"


@pytest.mark.parametrize("place, lecture", list(enumerate(LECTURES)), ids=lambda value: str(value)[:30])
def test_a_lecture_says_its_time_what_it_needs_and_what_follows(place, lecture):
    needs = ", ".join(map(link, lecture["needs"])) or "matrices and vectors, a little Python"
    exercise = exercise_of(lecture)
    then = [f"the exercise [{exercise}](../exercises/{exercise}/{exercise}.ipynb)"] if exercise else []
    then += [f"lecture {link(LECTURES[place + 1]['notebook'])}"] if place + 1 < len(LECTURES) else []
    said = [f"**Time** about {lecture['minutes']} minutes", f"**needs** {needs}", f"**then** {', '.join(then)}"]
    said += ["**terms** [glossary](glossary.ipynb)"]
    assert title(lecture["notebook"]).split("\n")[2] == " · ".join(said)


@pytest.mark.parametrize("path", sorted(COURSE.glob("*.ipynb")), ids=lambda path: path.stem)
def test_links_between_notebooks_lead_somewhere(path):
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "markdown":
            for target in re.findall(r"\]\(([^)#:]+\.ipynb)\)", cell.source):
                assert (COURSE / target).exists(), f"{cell.id}: {target}"


def test_readme_and_term_plan_list_every_lecture_with_its_exercise():
    pairs = [(lecture["notebook"], exercise_of(lecture)) for lecture in LECTURES]
    table = re.findall(r"^\| `course/(\w+).ipynb` \| (?:`exercises/(\w+)/`)? ?\|", README, re.M)
    assert table[: len(pairs)] == pairs and [name for name, _ in table[len(pairs) :]] == ["glossary"]
    plan = re.findall(r"^\| \d+ \| `(\w+)` \| (\d+) \| (?:`(\w+)`)? ?\| ([\d.]*) ?\|", LECTURERS, re.M)
    assert [(name, exercise) for name, _, exercise, _ in plan] == pairs
    assert [int(minutes) for _, minutes, _, _ in plan] == [lecture["minutes"] for lecture in LECTURES]
    for _, _, exercise, hours in plan:
        counted = sum(q.minutes for q in questions().values() if q.exercise == exercise)
        assert exercise == hours == "" or counted <= 60 * float(hours) <= 2 * counted + 30, (exercise, counted)


@pytest.mark.slow
@pytest.mark.notebook
def test_the_errata_lecture_shows_every_erratum_with_its_proof():
    lecture = nbformat.read(ROOT / "course/15_errata.ipynb", as_version=4)
    done = NotebookClient(lecture, timeout=120).execute()
    shown = "\n".join(
        output.get("data", {}).get("text/html", "") for cell in done.cells for output in cell.get("outputs", ())
    )
    known = {erratum.id for erratum in errata.ERRORS + errata.AMBIGUITIES}
    assert len(known) == 61
    assert sorted(known) == sorted(re.findall(r"<code>([\w-]+)</code>", shown)), "each once"
    assert shown.count("<b>proved</b>") == len(known) and "NOT PROVED" not in shown
