"""The patterns of docs/lecturers.md read the file names of Moodle and Canvas, as nbgrader's own collector applies them."""

import re
from pathlib import Path

import pytest
from nbgrader.plugins import FileNameCollectorPlugin

PAGE = (Path(__file__).parents[2] / "docs" / "lecturers.md").read_text(encoding="utf-8")
MOODLE, CANVAS = re.findall(r'^c\.FileNameCollectorPlugin\.named_regexp = r"(.+)"$', PAGE, re.M)


@pytest.mark.parametrize(
    ("pattern", "name", "student", "exercise"),
    [
        (MOODLE, "Ada Lovelace_4711_assignsubmission_file/scara.ipynb", "Ada Lovelace", "scara"),
        (MOODLE, "Zoë O'Neil_4712_assignsubmission_file_/planar_2r (1).ipynb", "Zoë O'Neil", "planar_2r"),
        (MOODLE, "Jean-Luc P. 2_47_assignsubmission_file_parallel_robots.ipynb", "Jean-Luc P. 2", "parallel_robots"),
        (CANVAS, "lovelaceada_3143_207797_scara.ipynb", "lovelaceada", "scara"),
        (CANVAS, "hopper-smithgrace_LATE_3144_207798_scara_s600-2.ipynb", "hopper-smithgrace", "scara_s600"),
    ],
)
def test_a_downloaded_file_finds_its_student(pattern, name, student, exercise):
    found = FileNameCollectorPlugin(named_regexp=pattern).collect(
        f"/course_1/downloaded/{exercise}/extracted/all_2/{name}"
    )
    assert (found["student_id"], found["file_id"]) == (student, exercise)


def test_other_files_are_skipped():
    collector = FileNameCollectorPlugin(named_regexp=MOODLE)
    assert collector.collect("/course/downloaded/scara/extracted/all/notes.ipynb") is None
    assert collector.collect("/x/Ada Lovelace_4711_assignsubmission_file/notes.txt") is None
