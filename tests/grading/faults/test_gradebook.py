"""The gradebook decides: held, damaged, older, lost or put back, and nothing is silently wrong."""

import errno
import os
import shutil
import sqlite3
import subprocess
import sys

import pytest
import sqlalchemy
from nbgrader.api import Gradebook
from nbgrader.apps import AutogradeApp, GenerateFeedbackApp
from sqlalchemy.exc import OperationalError

from autograder import cli
from autograder.grading import gradebook
from autograder.grading.course import open_course

pytestmark = pytest.mark.slow


def rows(root, query):
    with sqlite3.connect(root / "gradebook.db") as connection:
        return connection.execute(query).fetchall()


@pytest.fixture
def graded(course, faults):
    assert faults.grade(course) == 0
    return course


def unchanged(faults, course, right):
    return faults.entries(course) == right.entries and faults.files_below(course) == right.files


# ---------------------------------------------------------------- in use


@pytest.fixture
def impatient(monkeypatch):
    monkeypatch.setattr(gradebook, "ATTEMPTS", 2)
    monkeypatch.setattr(gradebook, "PAUSE", 0.01)
    gradebook._engine.cache_clear()
    yield
    gradebook._engine.cache_clear()


@pytest.mark.parametrize("lock", ["exclusive", "immediate", "reader"])
def test_a_gradebook_that_another_program_holds_is_said(course, faults, right, impatient, capsys, lock):
    holder = sqlite3.connect(course / "gradebook.db", isolation_level=None)
    holder.execute("begin" if lock == "reader" else f"begin {lock}")
    holder.execute("select * from grade").fetchone()
    assert faults.grade(course) == 1
    said = capsys.readouterr().err
    assert (
        "waiting: " in said and "gradebook.db is held by another program; close it" in said and "Traceback" not in said
    )
    holder.execute("rollback")
    assert faults.grade(course) == 0 and unchanged(faults, course, right)


def test_grading_waits_until_the_other_program_is_done(course, faults, right, capsys, monkeypatch):
    holder = sqlite3.connect(course / "gradebook.db", isolation_level=None, check_same_thread=False)
    holder.execute("begin immediate")
    sleep = gradebook.time.sleep

    def done_meanwhile(seconds):
        sleep(0)
        if holder.in_transaction:
            holder.execute("rollback")

    monkeypatch.setattr(gradebook.time, "sleep", done_meanwhile)
    assert faults.grade(course) == 0 and unchanged(faults, course, right)
    assert capsys.readouterr().err.count("waiting: ") == 1


def refused(name, words):
    """Let SQLite say this of the gradebook from now on, in this process."""

    @sqlalchemy.event.listens_for(sqlalchemy.Engine, "before_cursor_execute")
    def refuse(connection, cursor, statement, *more):
        error = sqlite3.OperationalError(words)
        error.sqlite_errorname = name
        raise OperationalError(statement, {}, error)


WITHOUT_LOCKS = {
    # As sqliteErrorFromPosixError of SQLite's os_unix.c translates them.
    errno.ENOLCK: ("SQLITE_BUSY", "database is locked"),
    errno.EOPNOTSUPP: ("SQLITE_IOERR_LOCK", "disk I/O error"),
}


@pytest.mark.parametrize("number", WITHOUT_LOCKS, ids=errno.errorcode.get)
def test_a_file_system_without_locks_is_said_at_once(course, faults, right, number, monkeypatch, capfd):
    def no_locks(*lock):
        raise OSError(number, os.strerror(number))

    def action():
        monkeypatch.setattr(gradebook.fcntl, "lockf", no_locks)
        monkeypatch.setattr(gradebook.time, "sleep", lambda seconds: pytest.fail("there is nothing to wait for"))
        refused(*WITHOUT_LOCKS[number])
        return faults.grade(course)

    assert faults.run(action) == 1
    said = capfd.readouterr().err
    assert (
        f"{course / 'gradebook.db'} cannot be used" in said and "has no locks; move the course to another disk" in said
    )
    assert "waiting: " not in said and "Traceback" not in said
    assert faults.grade(course) == 0 and unchanged(faults, course, right)


REFUSALS = {
    "SQLITE_READONLY": ("attempt to write a readonly database", "can only be read; give yourself the right"),
    "SQLITE_CANTOPEN": ("unable to open database file", "cannot be opened"),
    "SQLITE_IOERR_READ": ("disk I/O error", "its file system has no space or a fault"),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_a_gradebook_that_the_system_refuses_is_said(course, faults, right, name, capfd):
    words, sentence = REFUSALS[name]

    def action():
        refused(name, words)
        return faults.grade(course)

    assert faults.run(action) == 1
    said = capfd.readouterr().err
    assert f"{course / 'gradebook.db'} can" in said and sentence in said
    assert "Traceback" not in said
    assert faults.grade(course) == 0 and unchanged(faults, course, right)


# ---------------------------------------------------------------- damaged


def truncated(path):
    with path.open("r+b") as file:
        file.truncate(path.stat().st_size // 2)


def random_header(path):
    with path.open("r+b") as file:
        file.write(b"\x17" * 64)


def as_folder(path):
    path.unlink()
    path.mkdir()


def as_dangling_link(path):
    path.unlink()
    path.symlink_to("nowhere/gradebook.db")


def older_schema(path):
    with sqlite3.connect(path) as connection:
        connection.execute("alter table grade drop column extra_credit")


DAMAGES = {
    "truncated": (truncated, "is damaged"),
    "overwritten": (random_header, "is damaged"),
    "a text": (lambda path: path.write_text("grades\n" * 100), "is damaged"),
    "a folder": (as_folder, "is not a file; move it away, then run: autograder release"),
    "a dangling link": (as_dangling_link, "is a link to nowhere/gradebook.db, which does not exist"),
    "an older schema": (older_schema, "was made by another version of nbgrader"),
    "empty": (lambda path: path.write_bytes(b""), "run: autograder release"),
    "gone": (lambda path: path.unlink(), "run: autograder release"),
}


@pytest.mark.parametrize("command", ["grade", "feedback", "report", "export"])
@pytest.mark.parametrize("damage", DAMAGES)
def test_a_gradebook_that_cannot_be_used_is_said(course, capsys, damage, command, tmp_path):
    act, words = DAMAGES[damage]
    act(course / "gradebook.db")
    where = ["--to", str(tmp_path / "grades.csv")] if command == "export" else ["scara"]
    assert cli.main([command, *where, "--course", str(course)]) in (1, 2)
    said = capsys.readouterr().err
    assert words in said and "Traceback" not in said
    assert len([line for line in said.splitlines() if not line.startswith("grading scara")]) == 1
    assert command == "feedback" or str(course / "gradebook.db") in said or "scara is not in the gradebook" in said


@pytest.mark.parametrize("damage", ["truncated", "a folder", "a dangling link", "an older schema"])
def test_release_leaves_the_exercise_when_the_gradebook_cannot_be_used(course, capsys, damage):
    before = (course / "exercises/scara/scara.ipynb").read_bytes()
    act, words = DAMAGES[damage]
    act(course / "gradebook.db")
    assert cli.main(["release", "--home", "form", "scara", "--course", str(course)]) in (1, 2)
    assert words in capsys.readouterr().err
    assert (course / "exercises/scara/scara.ipynb").read_bytes() == before


# ---------------------------------------------------------------- lost and put back


def test_an_older_gradebook_put_back_is_brought_up_to_date(graded, half_graded, faults, right):
    shutil.copy(half_graded.kept / "gradebook.db", graded / "gradebook.db")
    assert faults.grade(graded) == 0 and unchanged(faults, graded, right)


def test_a_gradebook_lost_and_released_again_is_filled_again(graded, faults, right):
    (graded / "gradebook.db").rename(graded / "gradebook.old")
    assert cli.main(["release", "--home", "form", "--course", str(graded)]) == 0
    assert faults.grade(graded) == 0 and unchanged(faults, graded, right)


@pytest.mark.parametrize(
    "lost", ["feedback", "autograded", "feedback/new", "autograded/same", "feedback/old/scara/scara.html"]
)
def test_what_is_lost_is_written_again(graded, faults, right, lost):
    shutil.rmtree(graded / lost) if (graded / lost).is_dir() else (graded / lost).unlink()
    assert faults.grade(graded) == 0 and unchanged(faults, graded, right)


def test_a_page_that_was_cut_off_is_written_again(graded, faults, right):
    page = graded / "feedback/same/scara/scara.html"
    whole = page.read_bytes()
    page.write_bytes(whole[:1000])
    assert faults.grade(graded) == 0
    assert page.read_bytes() == whole


def test_only_what_is_missing_is_graded(graded, faults, monkeypatch, capsys):
    from autograder.grading.submission import judging

    monkeypatch.setattr(judging, "judge", lambda *evidence: pytest.fail("judged again"))
    shutil.rmtree(graded / "feedback")
    assert faults.grade(graded) == 0
    assert "0 graded; 3 unchanged" in capsys.readouterr().out
    assert len(list(graded.glob("feedback/*/scara/scara.html"))) == 3


def test_points_that_somebody_else_changed_are_stored_again(graded, faults, right):
    """As nbgrader's own SaveAutoGrades leaves them when it is killed, or an older program that knows no marks."""
    with sqlite3.connect(graded / "gradebook.db") as connection:
        connection.execute("update grade set auto_score = 0 where auto_score = 4")
    assert faults.grade(graded) == 0 and unchanged(faults, graded, right)


def test_points_by_hand_stay_and_come_onto_the_page(graded, faults, capsys):
    with Gradebook(f"sqlite:///{graded}/gradebook.db") as book:
        book.find_grade("scara-T04", "scara", "scara", "same").manual_score = 9
        book.find_comment("scara-T04-answer", "scara", "scara", "same").manual_comment = "nice figure"
        book.db.commit()
    assert faults.grade(graded) == 0
    assert "3 unchanged" in capsys.readouterr().out
    page = (graded / "feedback/same/scara/scara.html").read_text()
    assert "13 of 20 points" in page and "nice figure" in page


def test_a_gradebook_of_before_the_marks_is_graded_once(graded, faults, right, capsys):
    with sqlite3.connect(graded / "gradebook.db") as connection:
        connection.execute("drop table autograder_mark")
    assert faults.grade(graded) == 0 and unchanged(faults, graded, right)
    assert faults.grade(graded) == 0
    assert "0 graded; 3 unchanged" in capsys.readouterr().out


# ---------------------------------------------------------------- beside stock nbgrader


def stock(course, app, *words):
    """A stock command, in the course's folder."""
    here = os.getcwd()
    os.chdir(course)
    try:
        made = app()
        made.initialize(["scara", "--log-level=CRITICAL", *words])
        made.start()
    finally:
        os.chdir(here)


@pytest.mark.parametrize("words", [(), ("--force",)])
def test_stock_autograde_in_between_changes_nothing(course, faults, right, words, capsys):
    stock(course, AutogradeApp, *words)
    assert faults.entries(course) == right.entries
    assert faults.grade(course) == 0 and unchanged(faults, course, right)
    stock(course, AutogradeApp, *words)
    stock(course, GenerateFeedbackApp, *words)
    assert unchanged(faults, course, right)


def test_stock_upgrade_leaves_the_marks(graded, faults, capsys):
    marks = rows(graded, "select * from autograder_mark order by notebook_id")
    command = [sys.executable, "-m", "nbgrader", "db", "upgrade"]
    subprocess.run(command, cwd=graded, check=True, capture_output=True)
    assert rows(graded, "select * from autograder_mark order by notebook_id") == marks
    assert faults.grade(graded) == 0
    assert "0 graded; 3 unchanged" in capsys.readouterr().out


def test_a_submission_removed_by_hand_is_graded_again(graded, faults, right):
    with Gradebook(f"sqlite:///{graded}/gradebook.db") as book:
        book.remove_submission("scara", "same")
    assert faults.grade(graded) == 0 and unchanged(faults, graded, right)


def test_the_rows_are_those_of_nbgraders_own_preprocessors(graded, faults):
    """Points, comments and flags as SaveAutoGrades and AssignLatePenalties write them for the same graded notebook."""
    import nbformat
    from nbgrader.preprocessors import AssignLatePenalties, SaveAutoGrades

    query = """select base_cell.name, auto_score, manual_score, extra_credit, needs_manual_grade, late_submission_penalty
        from grade join base_cell on base_cell.id = cell_id join submitted_notebook on submitted_notebook.id = grade.notebook_id"""
    ours = sorted(rows(graded, query), key=str)
    with sqlite3.connect(graded / "gradebook.db") as connection:
        connection.execute("update grade set auto_score = null, needs_manual_grade = 1")
    names = {"assignment": "scara", "notebook": "scara", "db_url": f"sqlite:///{graded}/gradebook.db"}
    app = open_course(graded).app
    for student in ("new", "old", "same"):
        nb = nbformat.read(graded / f"autograded/{student}/scara/scara.ipynb", as_version=4)
        for preprocessor in (SaveAutoGrades(parent=app), AssignLatePenalties(parent=app)):
            preprocessor.preprocess(nb, {"nbgrader": {**names, "student": student}})
    assert sorted(rows(graded, query), key=str) == ours


# ---------------------------------------------------------------- several at once


@pytest.mark.parametrize("graders", [2, 4])
def test_several_graders_of_the_same_class(course, faults, right, graders):
    children = [faults.start(lambda: faults.grade(course)) for _ in range(graders)]
    codes = [faults.ended(child) for child in children]
    assert codes == [0] * graders and unchanged(faults, course, right)


def test_two_exercises_of_the_same_new_students_at_once(course, faults, small, released, capsys):
    """Both graders make the rows of the students."""
    text = (course / "solutions/scara/scara.ipynb").read_text()
    (course / "solutions/second").mkdir()
    (course / "solutions/second/second.ipynb").write_text(text)
    assert cli.main(["release", "--home", "form", "second", "--course", str(course)]) == 0
    for student in ("x", "y", "z"):
        faults.hand_in(small, course, released, student, "right")
        (course / "submitted" / student / "second").mkdir()
        notebook = (course / "submitted" / student / "scara/scara.ipynb").read_bytes()
        (course / "submitted" / student / "second/second.ipynb").write_bytes(notebook)

    def grade(exercise):
        return lambda: cli.main(["grade", exercise, "--course", str(course), "--jobs", "1"])

    children = [faults.start(grade(exercise)) for exercise in ("scara", "second")]
    assert [faults.ended(child) for child in children] == [0, 0]
    scores = """select assignment.name, student_id, sum(auto_score) from grade
        join submitted_notebook on submitted_notebook.id = grade.notebook_id
        join submitted_assignment on submitted_assignment.id = submitted_notebook.assignment_id
        join assignment on assignment.id = submitted_assignment.assignment_id group by 1, 2"""
    found = {(exercise, student): score for exercise, student, score in rows(course, scores)}
    assert {found[exercise, student] for exercise in ("scara", "second") for student in ("x", "y", "z")} == {4}
