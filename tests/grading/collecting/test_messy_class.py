"""A whole messy class: every right notebook under the right student, everybody else in the table with a reason."""

import json
import os

import pytest

pytestmark = pytest.mark.slow


def handed_in(root, student, exercise="scara"):
    path = root / "submitted" / student / exercise / f"{exercise}.ipynb"
    return path.read_bytes() if path.exists() else None


def test_the_class_is_large_and_messy(downloads):
    people = downloads.uploads()
    assert len(people) >= 40 and len({one.name for one in people}) == len(people)
    assert {one.status for one in people} == {"collected", "wrong exercise", "no notebook", "unreadable"}


@pytest.mark.parametrize("platform", ["moodle folders", "moodle flat", "moodle now", "canvas"])
def test_everybody_is_collected_or_named_with_a_reason(platform, downloads, collect, root):
    people = downloads.uploads()
    content, name = {
        "moodle folders": (lambda: downloads.moodle(people), downloads.moodle_name),
        "moodle flat": (lambda: downloads.moodle(people, folders=False), downloads.moodle_name),
        "moodle now": (lambda: downloads.moodle(people, real_times=False), downloads.moodle_name),
        "canvas": (lambda: downloads.canvas(people), downloads.canvas_name),
    }[platform]
    rows = {row.student: row for row in collect(content())}
    assert rows.keys() == {name(one.name) for one in people}
    wrong = {}
    for one in people:
        row = rows[name(one.name)]
        there = handed_in(root, name(one.name))
        if row.status != one.status or one.says not in "; ".join((row.file, *row.remarks)) or there != one.wanted:
            wrong[one.name] = (row, there == one.wanted)
    assert not wrong
    assert not (root.parent / "escaped").exists() and not os.path.exists("/tmp/escaped")
    assert {path.name for path in root.rglob("*") if path.is_file() and "submitted" in path.parts} <= {
        "scara.ipynb",
        "timestamp.txt",
    }


def test_with_a_roster_names_of_both_platforms_lead_to_one_id_and_the_missing_are_named(downloads, collect, root):
    people = downloads.uploads()[:12]
    lines = ["id,last_name,first_name"]
    lines += [
        f"s{number},{one.name.rpartition(' ')[2]},{one.name.rpartition(' ')[0]}" for number, one in enumerate(people)
    ]
    (root / "students.csv").write_text("\n".join([*lines, "gone,Home,Stayed"]))
    rows = {row.student: row for row in collect(downloads.moodle(people), downloads.canvas(people))}
    assert {student: row.status for student, row in rows.items()} == {
        **{f"s{number}": "collected" for number in range(len(people))}, "gone": "missing"
    }  # fmt: skip
    assert all(handed_in(root, f"s{number}") == one.wanted for number, one in enumerate(people))


def test_the_receipts_keep_what_the_platform_said(downloads, collect, root):
    people = downloads.uploads()[:3]
    collect(downloads.canvas(people, late=("Ada Lovelace",)))
    receipts = json.loads((root / "downloaded/scara/collected.json").read_text())
    assert receipts["lovelaceada"] | {"digest": "", "downloaded": ""} == {
        "platform": "canvas", "number": "3000", "prefix": "lovelaceada_LATE_3000", "name": "lovelaceada", "late": True,
        "downloaded": "", "file": "lovelaceada_LATE_3000_200007_scara.ipynb", "digest": "", "upload": 200007, "answered": 9,
    }  # fmt: skip
