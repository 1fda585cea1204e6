"""`autograder term`: the pages as they come from a course, and what makes two wrong answers the same."""

import json
import re
import shutil
from datetime import datetime

import numpy as np
import pytest
from bs4 import BeautifulSoup

from autograder import cli
from autograder.grading.course import open_course
from autograder.grading.errors import CourseError
from autograder.grading.overview.answers import Sheet, wrong_answers
from autograder.grading.overview.likeness import Pair, Shared, Wrong
from autograder.grading.overview.minutes import Minutes
from autograder.grading.overview.page import as_html
from autograder.grading.overview.reading import Borrowed, Overview, overview
from autograder.grading.overview.standing import Answer, Student, Work, of_class, staying
from autograder.judge.decode import decode
from dhkit import wire

HOSTILE = "</pre><script>alert('student')</script>"
BEFORE, AFTER = datetime(2026, 10, 14, 12), datetime(2026, 10, 20)
ROSTER = """\
id,last_name,first_name,groups,extensions,exempt
ann,Ångström,Ann,,,
ben,Moses,Ben,,,
cid,Campeador,Cid,,,
dan,Dare,Dan,,,scara
eve,Eden,Eve,,scara=+90d,
fay,Fox,Fay,Team 1,,
"""


@pytest.fixture(scope="module")
def course(without_kernels, small, empty_course, released, tmp_path_factory):
    """Ann is late, Ben types Ann's id, Cid sent a report, Dan is exempt, Eve has time, Fay works in a team, Guy is on no list."""
    root = tmp_path_factory.mktemp("term") / "course"
    shutil.copytree(empty_course, root)
    (root / "students.csv").write_text(ROSTER, encoding="utf-8")
    (root / "term.toml").write_text("timezone='UTC'\n[due]\nscara=2026-10-14T20:00:00\n[late]\noff_per_day=0.5\n")
    receipts = {
        "cid": {"platform": "moodle", "name": "Cid", "missing": "no notebook: handed in: report.pdf"},
        "Team 1": {"platform": "moodle", "name": "Team 1"},
    }
    (root / "downloaded/scara").mkdir(parents=True)
    (root / "downloaded/scara/collected.json").write_text(json.dumps(receipts))
    with without_kernels():
        for student in ("ann", "ben", "Team 1", "guy"):
            small.hand_in(root, student, small.answered(released, d2_sign="d2_sign = 'A'"))
        (root / "submitted/ann/scara/timestamp.txt").write_text("2026-10-15 08:00:00 UTC")
        assert cli.main(["grade", "scara", "--course", str(root)]) == 0
        yield root


@pytest.mark.slow
def test_everybody_has_a_line_that_says_how_they_stand(course):
    found = {one.id: one.works[0] for one in overview(open_course(course), AFTER).students}
    assert {id: work.status for id, work in found.items()} == {
        "ann": "graded", "ben": "graded", "cid": "no notebook", "dan": "exempt", "eve": "open", "fay": "graded", "guy": "graded",
    }  # fmt: skip
    assert found["ann"].late.startswith("late by 12 hours") and not found["ben"].late
    assert found["fay"].team == "Team 1" and "report.pdf" in found["cid"].remarks[0]
    # Ann had no more points to lose; the answers of the others were judged as they stand.
    assert [(one.question, one.note) for one in found["guy"].answers if one.question == "scara.d2_sign"] == [
        ("scara.d2_sign", found["ben"].answers[1].note)
    ]


@pytest.mark.slow
def test_whose_time_is_not_over_is_not_missing(course, tmp_path):
    course = shutil.copytree(course, tmp_path / "course")
    before = {one.id: one.works[0].status for one in overview(open_course(course), BEFORE).students}
    assert before["cid"] == "no notebook" and before["eve"] == "open"
    (course / "students.csv").write_text(ROSTER.replace("+90d", "+2d"), encoding="utf-8")
    after = {one.id: one.works[0].status for one in overview(open_course(course), AFTER).students}
    assert after["eve"] == "missing"


@pytest.mark.slow
def test_the_command_writes_a_page_for_everybody(course, capsys):
    assert cli.main(["term", "--course", str(course)]) == 0
    folder = course / "build/term"
    assert capsys.readouterr().out.strip().endswith(str(folder / "index.html"))
    page = BeautifulSoup((folder / "index.html").read_text(encoding="utf-8"), "html.parser")
    links = [link["href"] for link in page.find_all("a")]
    assert links and all((folder / link.replace("%20", " ")).is_file() for link in links)
    assert "Ann Ångström" in (folder / "students/ann.html").read_text(encoding="utf-8")
    assert not (folder / "students/Team 1.html").exists()
    (course / "file").write_text("")
    assert cli.main(["term", "--course", str(course), "--to", str(course / "file")]) == 2
    assert "is not a folder" in capsys.readouterr().err


def test_before_anything_is_graded_it_says_what_to_do(course_copy):
    with pytest.raises(CourseError, match="run: autograder grade"):
        overview(open_course(course_copy), AFTER)


def work(name, **notes):
    answers = tuple(Answer(f"{name}.{key}", 0, 1, note, HOSTILE) for key, note in notes.items())
    return Work(name, "graded", 3, 10, answers)


def sheet(source, value=None):
    return Sheet(source, HOSTILE, None if value is None else decode(wire.encode(value)))


def test_wrong_answers_are_the_same_by_their_mistake_their_value_or_their_text():
    classes = {
        "scara": {
            "ann": work("scara", T04="nothing_matched", forward="nothing_matched", d2_sign="listing_believed"),
            "ben": work("scara", T04="partly_right", forward="nothing_matched", d2_sign="listing_believed"),
            "cid": work("scara", T04="nothing_matched", forward="nothing_matched", d2_sign="right"),
            "dan": work("scara", T04="not_attempted", forward="malformed", d2_sign="numbers_of_another_student"),
        }
    }
    sheets = {
        ("ann", "scara.T04"): sheet("", np.eye(4)),
        ("ben", "scara.T04"): sheet("", np.eye(4).tolist()),
        ("cid", "scara.T04"): sheet("", 2 * np.eye(4)),
        ("ann", "scara.forward"): sheet("def forward(x):\n    # mine\n    return x+1"),
        ("ben", "scara.forward"): sheet("def forward(x):\n        return x + 1\n"),
        ("cid", "scara.forward"): sheet("def forward(x):\n    return 'x + 1"),
    }
    found = wrong_answers(classes, sheets)
    T04, forward = found["scara.T04"], found["scara.forward"]
    assert T04.keys() == {"ann", "ben", "cid"} and T04["ann"] == T04["ben"] != T04["cid"]
    assert forward.keys() == {"ann", "ben", "cid"} and forward["ann"] == forward["ben"] != forward["cid"]
    assert found["scara.d2_sign"] == {
        "ann": Wrong("mistake", "listing_believed"),
        "ben": Wrong("mistake", "listing_believed"),
    }


def test_nothing_in_the_pages_acts_whatever_was_handed_in():
    students = (
        Student("ann", HOSTILE, (work("scara", model="degrees", T04="right"), work("tables", arm="degrees"))),
        Student("ben", "Ben", (work("scara", model="nothing_matched"), Work("tables", "missing", max_score=10, remarks=(HOSTILE,)))),
    )  # fmt: skip
    exercises = tuple(
        of_class(name, (one for student in students for one in student.works)) for name in ("scara", "tables")
    )
    shared = Shared("scara.model", Wrong("mistake", "degrees"), 2, 40)
    found = Overview(
        exercises,
        students,
        {"ben": (HOSTILE,)},
        tuple(staying(students, ["scara", "tables"])),
        (Minutes("scara.model", 10, 25, 9),),
        (Pair(("ann", "ben"), (shared, shared), 3, 1e-4),),
        (Borrowed("ben", HOSTILE, ("scara.postures",)),),
        {("ann", "scara.model"): HOSTILE},
    )
    pages = as_html(found)
    assert pages.keys() == {"index.html", "alike.html", "students/ann.html", "students/ben.html"}
    for text in pages.values():
        page = BeautifulSoup(text, "html.parser")
        assert not page.find_all(["script", "img", "link", "iframe", "object"]) and not re.search(r'\bon\w+="', text)
        assert page.find("meta", {"name": "viewport"}) and "default-src 'none'" in text
        assert "alert('student')" in page.get_text() or "alert" not in text
    assert "takes longer" in pages["index.html"] and "once in 10,000 classes" in pages["alike.html"]
    assert "Mistakes that came back" in pages["students/ann.html"]
    assert not any(name in pages["students/ben.html"] for name in ("falling", "alike", "Ann"))  # it can be forwarded
