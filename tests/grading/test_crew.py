"""A class is graded by processes as it is by threads; one that is killed costs nobody anything."""

import json
import os
import signal
import sqlite3
import time
from concurrent.futures.process import BrokenProcessPool

import pytest

from autograder import cli, questions
from autograder.grading import crew, pipeline
from autograder.grading.course import open_course
from autograder.grading.crew import Crew

pytestmark = [pytest.mark.slow, pytest.mark.sandbox]


@pytest.fixture
def in_processes(needs_sandbox, monkeypatch):
    monkeypatch.setattr(crew, "FEW", 0)
    monkeypatch.setattr(crew, "ONE_SUFFICES", 0)


def test_processes_give_what_threads_give(small, course_copy, released, in_processes, monkeypatch, capsys):
    for student, answers in {"ann": {}, "ben": {"d2_sign": "d2_sign = 'A'"}, "eve": {"T04": "1/0"}}.items():
        small.hand_in(course_copy, student, small.answered(released, **answers))

    def graded():
        assert cli.main(["grade", "scara", "--force", "--json", "--jobs", "2", "--course", str(course_copy)]) == 0
        with sqlite3.connect(course_copy / "gradebook.db") as gradebook:
            marks = gradebook.execute("select submission, graded, page from autograder_mark order by 1").fetchall()
        return [json.loads(line) for line in capsys.readouterr().out.splitlines()], marks

    # Processes know the questions of the course, not those of these tests.
    monkeypatch.setattr(questions, "find", {one.id: one for one in questions.of_exercise("scara")}.get)
    first = graded()
    monkeypatch.setattr(crew, "FEW", 1000)
    again = graded()
    assert [one["student"] for one in first[0]] == ["ann", "ben", "eve"]
    assert first[0][0]["score"] == 20 and first == again
    assert all(all(mark) for mark in first[1])


def test_who_was_worked_on_when_a_process_is_killed_is_done_again_alone(
    small, course_copy, released, in_processes, monkeypatch
):
    for student in ("ann", "ben"):
        small.hand_in(course_copy, student, small.answered(released))
    killed = []

    class Deadly(Crew):
        def judged(self, exercise, student, names, turn):
            future = super().judged(exercise, student, names, turn)
            if student == "ann" and not killed:
                future.add_done_callback(lambda done: killed.append(done.exception()))
                while not future.running():
                    time.sleep(0.05)
                for process in self._processes._processes.values():
                    os.kill(process.pid, signal.SIGKILL)
            return future

    course = open_course(course_copy)
    with Deadly(course, 2) as crew_of_two:
        results = pipeline.grade(course, "scara", ["ann", "ben"], crew_of_two, False, lambda student: None)
    assert isinstance(killed[0], BrokenProcessPool)
    assert {one.student: (one.status, one.score) for one in results} == {"ann": ("graded", 20), "ben": ("graded", 20)}
