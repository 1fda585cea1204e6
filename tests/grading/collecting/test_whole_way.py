"""From Moodle's zip to Moodle's worksheet, with kernels: what was packed oddly is graded like any other."""

import csv
import json
import re

import pytest

from autograder import cli

pytestmark = [pytest.mark.sandbox, pytest.mark.slow]


def test_odd_files_earn_their_points_and_the_points_go_back(
    needs_sandbox, course_copy, small, released, downloads, tmp_path, capsys
):
    right = downloads.as_bytes(small.answered(released))
    bare = json.loads(right)
    for cell in bare["cells"]:
        cell["metadata"] = {}
        cell.pop("id")
    upload = downloads.Upload
    people = [
        upload("José O'Brien", {"Rendu TP.zip": downloads.zipped({"__MACOSX/._scara.ipynb": b"x", "TP/Scara.ipynb": right})}, ""),
        upload("Lost Ids", {"Untitled3.ipynb": json.dumps({**bare, "nbformat_minor": 0}).encode()}, ""),
        upload("Wide Letters", {"scara.ipynb.txt": right.decode().encode("utf-16")}, ""),
        upload("Only Report", {"report.pdf": b"%PDF"}, ""),
    ]  # fmt: skip
    download, worksheet = tmp_path / "all.zip", tmp_path / "worksheet.csv"
    download.write_bytes(downloads.moodle(people))
    lines = "".join(f"Participant {number},{one.name},,20.00,-\n" for number, one in enumerate(people, 4711))
    worksheet.write_text(f"Identifier,Full name,Grade,Maximum grade,Last modified (grade)\n{lines}")
    for words in (
        ["collect", "scara", str(download)],
        ["grade", "scara"],
        ["return", "scara", "--moodle", str(worksheet)],
    ):
        assert cli.main([*words, "--course", str(course_copy)]) == 0
    assert re.search(r"Only Report .*no notebook", capsys.readouterr().out)
    rows = list(csv.DictReader((course_copy / "build/return/scara/scara-grades.csv").open(encoding="utf-8")))
    assert [row["Grade"] for row in rows] == ["20.00", "20.00", "20.00", ""]
