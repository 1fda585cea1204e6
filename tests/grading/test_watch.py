"""What arrives in submitted/ is told once it is there: by exercise and student, nothing else."""

from threading import Event, Thread

import pytest

from autograder.grading import watch
from autograder.grading.course import open_course
from autograder.grading.watch import arrivals


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setattr(watch, "QUIET", 50)
    monkeypatch.setattr(watch, "LOOK", 50)


def first(course, act, exercises=(), poll=False):
    """What is told first after `act` is done."""
    stop, found, started = Event(), [], Event()

    def listen():
        started.set()
        for one in arrivals(course, exercises, stop, poll):
            found.append(one)
            break

    listener = Thread(target=listen)
    listener.start()
    started.wait()
    # A file written before the watch has begun would be missed: write until it is told.
    count = 0
    while listener.is_alive() and count < 200:
        act(count)
        listener.join(0.3)
        count += 1
    stop.set()
    listener.join()
    return found[0] if found else None


@pytest.mark.parametrize("poll", [False, True])
def test_a_notebook_that_arrives_is_told(poll, course_copy, quick, small):
    course = open_course(course_copy)

    def act(count):
        small.hand_in(course_copy, "Ann A", f"{count}")
        small.hand_in(course_copy, "ben", f"{count}", ".scara.ipynb.part")
        (course_copy / "submitted/readme.txt").write_text(f"{count}")

    assert first(course, act, poll=poll) == {"scara": ["Ann A"]}


def test_what_belongs_to_other_exercises_is_not_told(course_copy, quick, small):
    course = open_course(course_copy)

    def act(count):
        folder = course_copy / "submitted/ann/tables"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "tables.ipynb").write_text(f"{count}")
        if count > 3:
            small.hand_in(course_copy, "ben", f"{count}")

    assert first(course, act, ["scara"]) == {"scara": ["ben"]}
