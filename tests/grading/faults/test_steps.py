"""Stopped at any step of storing, in any way: the gradebook opens, and the next run ends with what is right."""

import os
import re
import time
from signal import SIG_IGN, SIGHUP, SIGINT, SIGKILL, SIGTERM, signal

import pytest

from autograder import cli
from autograder.grading.plugins import autograde

pytestmark = pytest.mark.slow

SCORES = {"new": 4, "old": 4, "same": 4}
STEPS = range(100)
"""More than there are; what lies behind the last is passed over."""


def ends_right(faults, course, right):
    """True after a plain rerun: points, notes, pages, and nothing left over."""
    assert faults.grade(course) == 0
    assert faults.entries(course) == right.entries
    assert faults.files_below(course) == right.files
    for student, score in SCORES.items():
        page = (course / f"feedback/{student}/scara/scara.html").read_text()
        assert re.search(rf"scara: {score} of 20 points", page) and page.rstrip().endswith("</html>")
    return True


def fault(faults, course, right, step, what):
    """Exit code of a run to which `what` happens at one step of storing."""
    if step >= len(right.steps):
        pytest.skip("there are fewer steps")

    def action():
        faults.Steps(step, what).watch()
        return faults.grade(course)

    code = faults.run(action)
    graded = {(student, check): score for student, check, score, _ in faults.entries(course)}
    # A submission is stored as a whole or not at all; what was graded before stands.
    assert graded["same", "scara-d2_sign"] == 4
    assert graded["old", "scara-d2_sign"] in (0, 4) and None not in graded.values()
    return code


def test_the_class_is_graded(right):
    scores = {}
    for student, _, score, _ in right.entries:
        scores[student] = scores.get(student, 0) + score
    assert scores == SCORES
    assert {name.split()[0] for name in right.steps} == {"sql", "commit", "before", "after", "half"}
    assert right.steps.count("before judge") == 6 and right.steps.count("half a file") == 4
    assert len(right.steps) < len(STEPS)


@pytest.mark.parametrize("step", STEPS)
def test_killed(faults, course, right, step, capsys):
    assert fault(faults, course, right, step, [SIGKILL]) == -SIGKILL
    found = {student for student, check, score, _ in faults.entries(course) if score == 4}
    assert ends_right(faults, course, right)
    assert f"{3 - len(found)} graded; {len(found)} unchanged" in capsys.readouterr().out


@pytest.mark.parametrize("step", STEPS)
def test_told_to_stop(faults, course, right, step, capfd):
    number = (SIGTERM, SIGHUP, SIGINT)[step % 3]
    assert fault(faults, course, right, step, [number]) == 128 + number
    said = capfd.readouterr().err
    assert "interrupted: what was graded before is in the gradebook" in said and "Traceback" not in said
    assert ends_right(faults, course, right)


@pytest.mark.parametrize("step", STEPS[::2])
def test_told_to_stop_twice(faults, course, right, step, capfd):
    assert fault(faults, course, right, step, [SIGINT, SIGINT]) == 128 + SIGINT
    assert "Traceback" not in capfd.readouterr().err
    assert ends_right(faults, course, right)


@pytest.mark.parametrize("number", [SIGHUP, SIGINT])
def test_a_signal_that_is_ignored_stays_ignored(faults, course, right, number, capfd):
    """As a lecturer wants it who typed ``nohup autograder grade``, or ``autograder grade &`` in a script."""

    def action():
        signal(number, SIG_IGN)
        faults.Steps(right.steps.index("commit"), [number, number]).watch()
        return faults.grade(course)

    assert faults.run(action) == 0
    assert "interrupted" not in capfd.readouterr().err
    assert faults.entries(course) == right.entries and faults.files_below(course) == right.files


def test_a_second_signal_may_come_while_the_first_is_told(faults, course, right, monkeypatch, capfd):
    def said(*words, **options):
        print(*words, **options)
        os.kill(os.getpid(), SIGINT)

    def action():
        monkeypatch.setattr(cli, "print", said, raising=False)
        faults.Steps(right.steps.index("commit"), [SIGINT]).watch()
        return faults.grade(course)

    assert faults.run(action) == 128 + SIGINT
    assert "Traceback" not in capfd.readouterr().err
    assert ends_right(faults, course, right)


class Cleaned:
    """An object in whose cleaning up a signal comes, where Python lets no exception through."""

    def __del__(self):
        os.kill(os.getpid(), SIGTERM)
        for _ in range(1000):  # its handler runs meanwhile
            pass


def test_a_signal_that_comes_while_something_is_cleaned_up_is_no_lost_one(faults, course, right, monkeypatch, capfd):
    def store(*what):  # by the thread that signals are for
        Cleaned()
        for _ in range(1000):
            time.sleep(0.01)
        return os._exit(98)

    def action():
        monkeypatch.setattr(autograde, "store", store)
        return faults.grade(course)

    assert faults.run(action) == 128 + SIGTERM
    said = capfd.readouterr().err
    assert "interrupted: " in said and "Traceback" not in said
    assert ends_right(faults, course, right)


@pytest.mark.parametrize("step", STEPS)
def test_the_disk_is_full(faults, course, right, step, capfd):
    if right.steps[step : step + 1] and right.steps[step].startswith(("after", "commit")):
        pytest.skip("it is noticed at the next step")
    code = fault(faults, course, right, step, "full disk")
    said = "".join(capfd.readouterr())
    assert "Traceback" not in said
    assert (code == 1) == ("make room" in said)
    assert ends_right(faults, course, right)
