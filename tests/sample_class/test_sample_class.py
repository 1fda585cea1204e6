"""The sample class, graded once by our command and partly by stock nbgrader: exact scores, exact notes, no harm done."""

import json
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path

import pytest
from edits import grade_id
from expected import EARN_ALL, EARN_NOTHING, HERE, submissions
from write import REPOSITORY, solution, write_class

from autograder.questions import exercises
from autograder.sandbox import available

pytestmark = [pytest.mark.slow, pytest.mark.sandbox]

SANDBOX = available() is None
CLASS = [submission for submission in submissions() if SANDBOX or not submission.harmful]
# What loops for ever is stopped sooner; a slow machine still reaches the bound on output before the one on time.
LIMITS = {"cell_seconds": 10, "notebook_seconds": 120}
CANARY = "canary-of-the-sample-class"
FRAME_NOTES = EARN_ALL | EARN_NOTHING | {"partly_right", "same_chain_other_frames"}
# Of the catalogue behind every question, what somebody of the class does.
SLIPS = {"entries_exchanged", "factor_two", "rounded_too_far", "sign_of_an_entry", "sign_turned", "symbols_exchanged"}
MADE_BY_GRADING = {"autograded", "build", "feedback", "gradebook.db"}

each_submission = pytest.mark.parametrize("submission", CLASS, ids=lambda one: f"{one.exercise}.{one.student}")


def contents(folder, leave_out=()):
    """Path -> bytes of every file below `folder`."""
    files = (path for path in sorted(folder.rglob("*")) if path.relative_to(folder).parts[0] not in leave_out)
    return {str(path.relative_to(folder)): path.read_bytes() for path in files if path.is_file()}


def listing(*folders):
    return {path for folder in folders for path in folder.rglob("*") if "__pycache__" not in path.parts}


def run(course, *words):
    """Run a program in the course folder; its output is shown when it fails."""
    done = subprocess.run([sys.executable, *map(str, words)], cwd=course, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stdout


@pytest.fixture(scope="session")
def course(tmp_path_factory):
    """The sample class, released and not yet graded."""
    root = tmp_path_factory.mktemp("sample_class") / "course"
    write_class(root, harmless=not SANDBOX, sparse=True)
    run(root, "-m", "autograder.cli", "release", "--home", "form")
    return root


@pytest.fixture(scope="session")
def ungraded(course, tmp_path_factory):
    """A copy of the part of the class that stock nbgrader grades, made before anything is graded."""
    root = tmp_path_factory.mktemp("stock") / "course"
    shutil.copytree(course, root)
    chosen = {(one.student, one.exercise) for one in CLASS if one.stock}
    for folder in root.glob("submitted/*/*"):
        if (folder.parent.name, folder.name) not in chosen:
            shutil.rmtree(folder)
    return root


@pytest.fixture(scope="session")
def graded(course, ungraded, tmp_path_factory):
    """What grading the whole class printed, cost and left behind."""
    report = tmp_path_factory.mktemp("report") / "report.json"
    ours = [REPOSITORY / name for name in ("solutions", "exercises", "course", "autograder")]
    before = contents(course, MADE_BY_GRADING), listing(*ours)
    limits = [word for name, value in LIMITS.items() for word in (f"--{name.replace('_', '-')}", str(value))]
    mode = "bwrap" if SANDBOX else "none"
    printed = run(course, HERE / "watched.py", report, "grade", "--json", "--jobs", "2", "--sandbox", mode, *limits)
    lines = [json.loads(line) for line in printed.splitlines()]
    return {
        "lines": {(line["exercise"], line["student"]): line for line in lines},
        "course": (before[0], contents(course, MADE_BY_GRADING)),
        "made": {path.name for path in course.iterdir()},
        "repository": (before[1], listing(*ours)),
        **json.loads(report.read_text()),
    }


def test_every_submission_was_judged(graded):
    assert graded["exit"] == 0
    assert graded["lines"].keys() == {(one.exercise, one.student) for one in CLASS}
    assert {line["status"] for line in graded["lines"].values()} == {"graded"}


@cache
def points(exercise):
    """Question, without its exercise -> points, as the instructor's notebook gives them."""
    marks = {grade_id(cell): cell["metadata"]["nbgrader"] for cell in solution(exercise)["cells"] if grade_id(cell)}
    named = [question.id.partition(".")[2] for question in exercises()[exercise]]
    return {name: marks[f"{exercise}-{name}"]["points"] for name in named}


@each_submission
def test_scores_and_notes_are_those_expected(submission, graded):
    line = graded["lines"][submission.exercise, submission.student]
    found = {answer["question"].partition(".")[2]: (answer["note"], answer["score"]) for answer in line["answers"]}
    expected = {name: submission.expected(name) for name in points(submission.exercise)}
    earned = {name: round(expected[name][1] * most, 2) for name, most in points(submission.exercise).items()}
    assert found == {name: (note, pytest.approx(earned[name])) for name, (note, _) in expected.items()}
    assert line["score"] == pytest.approx(sum(earned.values()), abs=1e-9)
    assert line["max_score"] == sum(points(submission.exercise).values())


@each_submission
def test_the_class_table_says_what_was_wrong(submission, graded):
    found = graded["lines"][submission.exercise, submission.student]["found"]
    assert [words for words in submission.remarks if words not in found] == [], found
    assert found.isprintable()


def test_no_process_of_a_student_lives(graded):
    assert graded["left"] == []


def test_the_grader_stays_small(graded):
    assert graded["peak"] < 500 << 20


def test_nothing_is_written_outside_the_work_folders(graded, course):
    before, after = graded["course"]
    assert after == before
    assert graded["made"] == {Path(name).parts[0] for name in before} | MADE_BY_GRADING
    assert graded["repository"][0] == graded["repository"][1]
    reachable = [Path(place) for place in ("/", "/etc", "/usr/local", "/var/tmp", "/dev/shm", sys.prefix, Path.home())]
    reachable += [course, REPOSITORY, REPOSITORY / "course" / "dhkit", Path(tempfile.gettempdir())]
    assert [path for folder in reachable if folder.is_dir() for path in folder.iterdir() if CANARY in path.name] == []


def test_work_folders_are_gone(graded):
    # os.walk passes over what other tests remove meanwhile; what they keep lies in folders of pytest's.
    left = [
        folder
        for folder, _, files in os.walk(tempfile.gettempdir())
        if Path(folder).name == "work" and "notes.txt" in files and "pytest-of-" not in folder
    ]
    assert left == []


# ---------------------------------------------------------------- the class covers what it should


def notes_of(some):
    """Question and note of every answer of these submissions; a note of two mistakes is both of them."""
    for one in some:
        for name in points(one.exercise):
            yield from ((f"{one.exercise}.{name}", note) for note in one.expected(name)[0].split("+"))


def test_nearly_every_named_mistake_is_made_by_somebody():
    """As students type it; tests/questions makes every one of them from the tree, in the forms that students use."""
    trees = {
        (question.id, node.note) for each in exercises().values() for question in each for node in question.mistakes
    }
    assert len(trees & set(notes_of(submissions()))) > 0.9 * len(trees)


def test_every_outcome_appears():
    assert {note for _, note in notes_of(submissions())} >= FRAME_NOTES


def test_expected_notes_exist():
    """A note that no question can give would make a student pass for the wrong reason, or a typing error pass unseen."""
    known = {
        q.id: {node.note for node in q.mistakes} | FRAME_NOTES | SLIPS for each in exercises().values() for q in each
    }
    assert [(question, note) for question, note in notes_of(submissions()) if note not in known[question]] == []
    for one in submissions():
        assert set(one.notes) <= {"*", *points(one.exercise)}, one.student
        assert all(0 <= one.expected(name)[1] <= 1 for name in points(one.exercise)), one.student


# ---------------------------------------------------------------- stock nbgrader

ROWS = """
select assignment.name, student.id, base_cell.name, {columns}
from {table} join base_cell on {table}.cell_id = base_cell.id
join submitted_notebook on {table}.notebook_id = submitted_notebook.id
join submitted_assignment on submitted_notebook.assignment_id = submitted_assignment.id
join assignment on submitted_assignment.assignment_id = assignment.id
join student on submitted_assignment.student_id = student.id"""
GRADES = ROWS.format(
    table="grade",
    columns="grade_cells.max_score, grade.auto_score, grade.manual_score, grade.extra_credit, grade.needs_manual_grade",
).replace("join student", "join grade_cells on grade_cells.id = base_cell.id join student")
COMMENTS = ROWS.format(table="comment", columns="comment.auto_comment, comment.manual_comment")


def rows(course, query):
    with sqlite3.connect(course / "gradebook.db") as connection:
        found = sorted(connection.execute(query).fetchall(), key=str)
    chosen = {(one.exercise, one.student) for one in CLASS if one.stock}
    return [row for row in found if row[:2] in chosen]


@pytest.fixture(scope="session")
def stock(graded, ungraded):
    """The chosen part of the class, graded by ``nbgrader autograde``."""
    mode = "bwrap" if SANDBOX else "none"
    options = [f"--SandboxExecute.{name}={value}" for name, value in {**LIMITS, "mode": mode}.items()]
    for exercise in sorted({one.exercise for one in CLASS if one.stock}):
        run(ungraded, "-m", "nbgrader", "autograde", exercise, "--log-level=ERROR", *options)
    return ungraded


def test_the_part_for_stock_nbgrader_has_every_outcome():
    notes = {note for _, note in notes_of(one for one in submissions() if one.stock)}
    assert notes >= FRAME_NOTES | {"sign_of_d2"}
    assert any(one.exercise not in ("scara", "planar_2r") for one in submissions() if one.stock), (
        "one with numbers of one's own"
    )


@pytest.mark.parametrize("query", [GRADES, COMMENTS], ids=["grades", "comments"])
def test_stock_nbgrader_keeps_the_same_gradebook(query, stock, course):
    found = rows(course, query)
    per_exercise = {name: len(questions) + 1 for name, questions in exercises().items()}  # and the open problem
    assert len(found) == sum(per_exercise[one.exercise] for one in CLASS if one.stock)
    assert rows(stock, query) == found


def test_stock_nbgrader_shows_the_same_feedback(stock, course):
    for one in CLASS:
        if one.stock:
            pair = [
                json.loads((root / f"autograded/{one.student}/{one.exercise}/{one.exercise}.ipynb").read_text())
                for root in (course, stock)
            ]
            judged = [[cell["outputs"] for cell in nb["cells"] if "autograder" in cell["metadata"]] for nb in pair]
            assert judged[0] == judged[1]
