"""The stock commands as a lecturer types them, in processes of their own and without an activated environment."""

import asyncio
import json
import logging
import os
import subprocess
import sys
from pathlib import Path

import pytest

from autograder.grading.course import open_course
from autograder.grading.results import QuestionResult, Result

pytestmark = pytest.mark.sandbox

PLAIN = {"PATH": "/usr/bin:/bin", "HOME": os.environ.get("HOME", "/")}


def test_generate_assignment_without_an_activated_environment(course_copy):
    notebook = course_copy / "exercises/scara/scara.ipynb"
    ours = notebook.read_bytes()
    (course_copy / "gradebook.db").unlink()
    command = [str(Path(sys.executable).parent / "nbgrader"), "generate_assignment", "scara", "--force"]
    done = subprocess.run(command, cwd=course_copy, env=PLAIN, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "SAWarning" not in done.stderr and "Traceback" not in done.stderr
    assert (course_copy / "gradebook.db").exists() and notebook.read_bytes() == ours


def test_autograde_from_formgraders_server(course_copy, small, released):
    """Formgrader's button runs inside the server's event loop."""
    from nbgrader.apps.api import NbGraderAPI

    small.hand_in(course_copy, "ann", small.answered(released))
    course = open_course(course_copy)
    course.app.log.setLevel(logging.CRITICAL + 1)

    async def button():
        api = NbGraderAPI(course.app.coursedir, parent=course.app)
        return api.autograde("scara", "ann"), api.get_submission("scara", "ann")

    graded, submission = asyncio.run(button())
    assert graded["success"], graded
    assert submission["score"] == 20 and not submission["needs_manual_grade"]


def test_stock_autograde_refuses_without_a_sandbox(course_copy, small, released, monkeypatch):
    from nbgrader.apps import AutogradeApp

    small.hand_in(course_copy, "ann", small.answered(released))
    monkeypatch.setattr("autograder.grading.plugins.autograde.available", lambda: "bubblewrap is missing")
    monkeypatch.chdir(course_copy)
    app = AutogradeApp()
    app.initialize(["scara", "--log-level=CRITICAL"])
    with pytest.raises(SystemExit) as end:
        app.start()
    assert end.value.code == 1 and not (course_copy / "autograded").exists()


def line(*notes, **more):
    answers = tuple(QuestionResult(f"scara.{name}", 0, 1, note, trouble) for name, note, trouble in notes)
    return Result("ann", "scara", more.pop("status", "graded"), answers=answers, **more)


def test_the_line_of_the_class_table():
    assert (
        line(("T04", "sign_of_d2", None), ("U1", "not_attempted", None), ("dhm", "right", None)).found()
        == "T04: sign_of_d2; U1: not_attempted"
    )
    assert line(("T04", "right", None), ("U1", "right", None)).found() == "all right"
    assert (
        line(("T04", "unreadable", "x"), ("U1", "unreadable", "x"), remarks=("cut off",)).found()
        == "all 2: unreadable; cut off"
    )
    many = [(name, "not_attempted", None) for name in ("a", "b", "c")]
    assert (
        line(*many, ("d", "timeout", "stopped after 30 s")).found()
        == "a, b, c: not_attempted; d: timeout (stopped after 30 s)"
    )
    assert (
        line(("T04", "error", "\x1b[31mNo\nname" + "x" * 100), ("U1", "right", None)).found()
        == f"T04: error (No name{'x' * 70}...)"
    )
    assert line(status="failed", remarks=("could not be run",)).found() == "could not be run"
    assert json.loads(json.dumps(line(("T04", "right", None)).as_json()))["answers"][0]["question"] == "scara.T04"
