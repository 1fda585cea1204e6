"""Due dates, more time, penalties and exemptions: said once, shown in class table, feedback page and tables of grades."""

import csv
import json
import re
import shutil
from datetime import datetime, timedelta

import pytest
from nbgrader.api import Gradebook

from autograder import cli
from autograder.grading.course import convert, open_course
from autograder.grading.errors import CourseError
from autograder.grading.gradebook import reading
from autograder.grading.plugins.autograde import SubmissionAutograde
from autograder.grading.roster import Person, Roster
from autograder.grading.store import stored_notebooks
from autograder.grading.term import Deadlines, Late, Term, deadlines, read_term

pytestmark = pytest.mark.slow

TERM = """
timezone = "Europe/Zurich"

[due]
scara = 2026-10-14T23:59:00

[late]
grace_minutes = 10
off_per_day = 0.1
at_most = 0.5
"""


@pytest.mark.parametrize(
    "seconds, off", [(1, 1), (86400, 1), (86401, 2), (4 * 86400, 4), (5 * 86400, 5), (50 * 86400, 5)]
)
def test_each_day_that_has_begun_costs_its_share_up_to_the_most(seconds, off):
    assert Late(off_per_day=0.1, at_most=0.5).penalty(10, seconds) == off


def test_dates_are_those_of_the_courses_time_zone(tmp_path):
    (tmp_path / "term.toml").write_text(TERM)
    assert deadlines(tmp_path, "scara").due == datetime(2026, 10, 14, 22, 9)
    assert deadlines(tmp_path, "tables").due is None
    (tmp_path / "term.toml").write_text("timezone = 'UTC'\n[due]\nscara = 2026-10-14\n")
    assert deadlines(tmp_path, "scara").due == datetime(2026, 10, 14, 23, 59, 59)


@pytest.mark.parametrize(
    "text, extension",
    [
        ("scara=+3d", timedelta(days=3)),
        ("scara = +12h", timedelta(hours=12)),
        ("scara=2026-10-16 23:59", timedelta(days=2)),
        ("scara=2026-10-15", timedelta(days=1, seconds=59)),
        ("scara=2026-10-01", timedelta(0)),
        ("tables=+3d", None),
    ],
)
def test_more_time(text, extension):
    term = Term(timezone="UTC", due={"scara": datetime(2026, 10, 14, 23, 59)})
    found = Deadlines("scara", term, Roster((Person("ada", extensions=(text,)),)))
    assert found.extension("ada") == extension and found.extension("ben") is None


def test_more_time_of_a_member_is_more_time_for_the_team():
    term = Term(timezone="UTC", due={"scara": datetime(2026, 10, 14, 23, 59)})
    people = (
        Person("ada", groups=("Team 3",)),
        Person("ben", groups=("Team 3",), extensions=("scara=+3d",)),
        Person("cid"),
    )
    found = Deadlines("scara", term, Roster(people))
    assert [found.extension(name) for name in ("Team 3", "team3", "ada", "cid")] == [timedelta(days=3)] * 2 + [None] * 2


@pytest.mark.parametrize(
    "text, said",
    [
        ("due = 3", "due"),
        ("[due]\nscara = 'soon'", "Invalid"),
        ("[late]\noff_per_dya = 0.1", "off_per_dya"),
        ("[late]\noff_per_day = 10", "shares from 0 to 1"),
        ("timezone = 'Mars/Phobos'", "no time zone 'Mars/Phobos'"),
        ("[due\n", "line 1"),
    ],
)
def test_a_file_that_makes_no_sense_is_refused(tmp_path, text, said):
    (tmp_path / "term.toml").write_text(text)
    with pytest.raises(CourseError, match=f"term.toml: .*{said}"):
        read_term(tmp_path)


@pytest.fixture
def late(without_kernels, small, course_copy, released):
    """A course in which ann handed in in time, ben a day and an hour late, cid nobody knows when; each has 4 points."""
    (course_copy / "term.toml").write_text(TERM)
    (course_copy / "students.csv").write_text("id,last_name\nann,A\nben,B\ncid,C\n")
    stamps = {"ann": "2026-10-14 22:08:00 UTC", "ben": "2026-10-15 23:09:00 UTC"}
    for student in ("ann", "ben", "cid"):
        folder = small.hand_in(course_copy, student, small.answered(released, T04="T04 = ...", forward="forward = ..."))
        if student in stamps:
            (folder / "timestamp.txt").write_text(stamps[student])
    return course_copy


def graded(root, without_kernels, capsys):
    capsys.readouterr()
    with without_kernels():
        assert cli.main(["grade", "scara", "--json", "--course", str(root)]) == 0
    return {line["student"]: line for line in map(json.loads, capsys.readouterr().out.splitlines())}


def test_who_is_late_loses_points_and_is_told_everywhere(late, without_kernels, capsys, tmp_path):
    found = graded(late, without_kernels, capsys)
    assert {student: line["score"] for student, line in found.items()} == {"ann": 4, "ben": 3.2, "cid": 4}
    said = "late by 1 day 1 hour: 0.8 points off"
    assert said in found["ben"]["found"] and "late" not in found["ann"]["found"] + found["cid"]["found"]
    page = (late / "feedback/ben/scara/scara.html").read_text()
    assert said in page and "3.2 of 20 points" in page
    assert "late by" not in (late / "feedback/ann/scara/scara.html").read_text()
    assert cli.main(["export", "--to", str(tmp_path / "grades.csv"), "--course", str(late)]) == 0
    rows = {row["student_id"]: row for row in csv.DictReader((tmp_path / "grades.csv").open())}
    assert (rows["ben"]["raw_score"], rows["ben"]["late_submission_penalty"], rows["ben"]["score"]) == (
        "4.0",
        "0.8",
        "3.2",
    )
    assert [rows[student]["last_name"] for student in ("ann", "ben", "cid")] == ["A", "B", "C"]
    assert rows["ben"]["duedate"] == "2026-10-14 22:09:00"


def test_more_time_counts_without_running_anything_again(late, without_kernels, capsys):
    graded(late, without_kernels, capsys)
    assert cli.main(["allow", "b", "scara", "--until", "+2d", "--course", str(late)]) == 0
    assert "ben: scara=+2d" in capsys.readouterr().out
    found = graded(late, without_kernels, capsys)
    assert {line["status"] for line in found.values()} == {"unchanged"} and found["ben"]["score"] == 4
    assert "had until 2026-10-17 00:09" in found["ben"]["found"] and "had until" not in found["ann"]["found"]
    assert cli.main(["export", "--to", str(late / "grades.csv"), "--course", str(late)]) == 0
    rows = {row["student_id"]: row["duedate"] for row in csv.DictReader((late / "grades.csv").open())}
    assert (rows["ann"], rows["ben"]) == ("2026-10-14 22:09:00", "2026-10-16 22:09:00")
    assert found["ben"]["moved"] == ["points off for being late: 0.8 -> 0"] and found["ann"]["moved"] == []
    assert "late by" not in (late / "feedback/ben/scara/scara.html").read_text()
    assert cli.main(["allow", "ben", "scara", "--nothing", "--course", str(late)]) == 0
    assert graded(late, without_kernels, capsys)["ben"]["score"] == 3.2


def test_another_due_date_counts_for_everybody(late, without_kernels, capsys):
    graded(late, without_kernels, capsys)
    (late / "term.toml").write_text(TERM.replace("10-14", "10-13"))
    assert {student: line["score"] for student, line in graded(late, without_kernels, capsys).items()} == {"ann": 3.6, "ben": 2.8, "cid": 4}  # fmt: skip


def test_nbgraders_own_dates_count_where_the_course_says_nothing(late, without_kernels, capsys):
    (late / "term.toml").unlink()
    with Gradebook(f"sqlite:///{late}/gradebook.db") as gradebook:
        gradebook.update_or_create_assignment("scara", duedate="2026-10-14 22:09:00 UTC")
    found = graded(late, without_kernels, capsys)
    assert found["ben"]["score"] == 4 and "late by 1 day 1 hour: no points off" in found["ben"]["found"]


def test_who_is_exempt_has_no_points_to_lose(late, without_kernels, capsys, tmp_path):
    shutil.rmtree(late / "submitted/cid")
    graded(late, without_kernels, capsys)
    for student in ("ben", "cid"):
        assert cli.main(["allow", student, "scara", "--exempt", "--course", str(late)]) == 0
    assert "exempt" in graded(late, without_kernels, capsys)["ben"]["found"]
    assert cli.main(["roster", "--course", str(late)]) == 0
    assert cli.main(["export", "--to", str(tmp_path / "grades.csv"), "--course", str(late)]) == 0
    rows = {row["student_id"]: row for row in csv.DictReader((tmp_path / "grades.csv").open())}
    assert all((rows[name]["score"], rows[name]["notes"]) == ("", "exempt") for name in ("ben", "cid"))
    assert rows["ann"]["score"] == "4.0"


@pytest.mark.parametrize(
    "words, said",
    [
        (("zoe", "scara", "--until", "+1d"), "nobody is called 'zoe'; there are: ann, ben, cid"),
        (("ann", "sacra", "--exempt"), "there is no exercise 'sacra'"),
        (("ann", "scara", "--until", "tomorrow"), "'tomorrow' of ann is no time; write +3d, +12h or 2026-10-20 23:59"),
    ],
)
def test_what_cannot_be_allowed_is_said(late, capsys, words, said):
    before = (late / "students.csv").read_text()
    assert cli.main(["allow", *words, "--course", str(late)]) == 2
    assert said in capsys.readouterr().err and (late / "students.csv").read_text() == before


def test_a_due_date_of_no_exercise_is_refused(late, without_kernels, capsys):
    (late / "term.toml").write_text("[due]\nsacra = 2026-10-14\n")
    with without_kernels():
        assert cli.main(["grade", "scara", "--course", str(late)]) == 2
    assert re.search("no exercise 'sacra'", capsys.readouterr().err)


def test_the_stock_command_reckons_with_the_same_dates(late, without_kernels):
    (late / "students.csv").write_text("id,extensions\nann,\nben,scara=+1h\n")
    course = open_course(late)
    course.choose("scara")
    with without_kernels():
        convert(SubmissionAutograde(coursedir=course.app.coursedir, parent=course.app))
    with reading(course.db_url) as session:
        stored = stored_notebooks(session, "scara")
    assert {student: one.penalty for (student, _), one in stored.items()} == {"ann": 0, "ben": 0.4, "cid": 0}
