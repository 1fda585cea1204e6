"""Folders and environments that are not as they should be: one sentence each, and the others are graded."""

import errno
import json
import os
import subprocess
import sys

import pytest

from autograder import cli
from autograder.grading import files

pytestmark = pytest.mark.slow

NAMES = {
    ".dots": "starts with a dot",
    "..dots": "starts with a dot",
    "<b>": "holds < >, which web pages take for markup",
    'say "hi"': 'holds ", which web pages',
    "a&b": "holds &, which web pages",
    "bell\x07": "holds control characters",
}


def lines(capsys):
    return {line["student"]: line for line in map(json.loads, capsys.readouterr().out.splitlines())}


def test_a_folder_whose_name_cannot_be_an_id_has_a_line(course, faults, small, released, capsys):
    for name in NAMES:
        small.hand_in(course, name, released)
    small.hand_in(course, "Zoë O'Neil", released)
    assert faults.grade(course, "--json") == 1
    found = lines(capsys)
    assert found.keys() == {"same", "old", "new", "Zoë O'Neil", *(name.replace("\x07", "") for name in NAMES)}
    for name, reason in NAMES.items():
        line = found[name.replace("\x07", "")]
        assert line["status"] == "failed" and reason in line["found"] and "rename it" in line["found"]
    assert {found[name]["status"] for name in ("new", "old", "Zoë O'Neil")} == {"graded"}


def test_only_such_folders_are_no_silence(course, faults, small, released, capsys):
    for folder in (course / "submitted").iterdir():
        folder.rename(folder.with_name(f".{folder.name}"))
    assert faults.grade(course) == 1
    assert "starts with a dot; rename it" in capsys.readouterr().out


@pytest.mark.parametrize("what", ["folder", "deep"])
def test_a_notebook_that_is_none_gets_no_points_and_a_reason(course, faults, what, capsys):
    path = course / "submitted/new/scara/scara.ipynb"
    path.unlink()
    if what == "folder":
        path.mkdir()
    else:
        deep = '{"a":' * 50_000 + "1" + "}" * 50_000
        path.write_text(f'{{"nbformat": 4, "nbformat_minor": 5, "metadata": {deep}, "cells": []}}')
    assert faults.grade(course, "--json") == 0
    line = lines(capsys)["new"]
    assert (line["status"], line["score"]) == ("graded", 0)
    assert ("not a regular file" if what == "folder" else "nested far too deeply") in line["found"]


def test_a_submission_that_this_machine_cannot_read_is_no_zero(course, faults, right, monkeypatch, capsys):
    opened = os.open

    def refuse(path, *more, **options):
        if str(path).endswith("submitted/new/scara/scara.ipynb"):
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return opened(path, *more, **options)

    with monkeypatch.context() as broken:
        broken.setattr(os, "open", refuse)
        assert faults.grade(course, "--json") == 1
    line = lines(capsys)["new"]
    assert line["status"] == "failed" and "Permission denied; give yourself the right to it" in line["found"]
    assert {student for student, *_ in faults.entries(course)} == {"old", "same"}
    assert faults.grade(course) == 0 and faults.entries(course) == right.entries


@pytest.mark.parametrize("step", ["autograded", "feedback"])
def test_a_folder_that_cannot_be_written_is_said(course, faults, right, step, monkeypatch, capsys):
    written = files._write

    def refuse(path, content, permissions):
        if path.is_relative_to(course / step):
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        written(path, content, permissions)

    with monkeypatch.context() as foreign:
        foreign.setattr(files, "_write", refuse)
        assert faults.grade(course, "--json") == 1
    found = lines(capsys)
    assert {name for name, line in found.items() if line["status"] == "failed"} == {"old", "new"}
    assert f"{step}/new/scara/.scara" in found["new"]["found"]
    assert "Permission denied; give yourself the right to it" in found["new"]["found"]
    assert faults.grade(course) == 0
    assert faults.entries(course) == right.entries and faults.files_below(course) == right.files


def test_a_file_where_a_folder_should_be_is_said(course, faults, capsys):
    (course / "feedback/old/scara/scara.html").unlink()
    (course / "feedback/old/scara").rmdir()
    (course / "feedback/old/scara").write_text("mine")
    assert faults.grade(course, "--json") == 1
    assert "the points are in the gradebook, but there is no feedback page: " in lines(capsys)["old"]["found"]


def test_what_a_killed_grader_left_in_the_temporary_folder_goes_with_the_next_run(
    course, faults, tmp_path, monkeypatch
):
    assert faults.grade(course) == 0
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    (tmp_path / "ag-run-left/work").mkdir(parents=True)
    (tmp_path / "ag-run-left" / "work" / "answer.txt").write_text("mine")
    assert faults.grade(course) == 0  # there is nothing to do
    assert not list(tmp_path.glob("ag-run-*"))


# ---------------------------------------------------------------- environments


def test_names_that_the_terminal_cannot_show_do_not_end_the_command(course, small, released):
    small.hand_in(course, "Zoë 漢", "{}")
    command = [sys.executable, "-m", "autograder.cli", "grade", "scara", "--student", "Zoë 漢", "--course", str(course)]
    done = subprocess.run(
        [*command, "--sandbox", "none"], env={**os.environ, "PYTHONIOENCODING": "ascii"}, capture_output=True
    )
    assert done.returncode == 0 and b"Traceback" not in done.stderr, done.stderr
    assert b"Zo? ?" in done.stdout


@pytest.mark.parametrize("package", ["dhkit", "sqlalchemy"])
def test_what_cannot_be_imported_is_said(course, package, tmp_path):
    (tmp_path / f"{package}.py").write_text("raise RuntimeError('half installed')")
    command = [sys.executable, "-m", "autograder.cli", "grade", "scara", "--course", str(course)]
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 2 and "Traceback" not in done.stderr
    assert f"{package} cannot be imported (RuntimeError: half installed); make setup" in done.stderr
    done = subprocess.run([*command, "--verbose"], env=environment, capture_output=True, text=True)
    assert "Traceback" in done.stderr


def test_a_current_folder_that_is_gone_is_said(course, faults, right, tmp_path, capsys):
    gone = tmp_path / "gone"

    def action(*where):
        gone.mkdir()
        os.chdir(gone)
        gone.rmdir()
        return cli.main(["grade", "scara", "--jobs", "1", *where])

    assert faults.run(lambda: action()) == 2
    assert faults.run(lambda: action("--course", str(course))) == 0
    assert faults.entries(course) == right.entries


@pytest.mark.parametrize(
    "name, text", [("jupyter_config.py", "1/0"), ("nbgrader_config.py", "c = ("), ("jupyter_config.json", "{")]
)
def test_a_bad_configuration_is_named(course, faults, name, text, tmp_path, monkeypatch, capsys):
    (tmp_path / name).write_text(text)
    monkeypatch.setattr("jupyter_core.paths.jupyter_config_dir", lambda: str(tmp_path))
    monkeypatch.setattr("jupyter_core.application.jupyter_config_dir", lambda: str(tmp_path))
    assert faults.grade(course) == 2
    said = capsys.readouterr().err
    assert str(tmp_path / name) in said and "mend it or move it away" in said and "Traceback" not in said


def test_a_bad_configuration_of_the_course_is_named(course, faults, capsys):
    with (course / "nbgrader_config.py").open("a") as file:
        file.write("c.SandboxExecute.cell_second = 3\nc.(")
    assert faults.grade(course) == 2
    assert f"{course / 'nbgrader_config.py'} cannot be used (SyntaxError" in capsys.readouterr().err
