"""What arrives in submitted/ is told once it is there: by exercise and student, nothing else."""

from threading import Event, Timer

import pytest

from autograder import cli
from autograder.grading import watch
from autograder.grading.course import open_course
from autograder.grading.watch import arrivals


@pytest.fixture
def listen(monkeypatch):
    """Starts to listen; ends by itself where nothing is ever told."""
    monkeypatch.setattr(watch, "QUIET", 50)
    monkeypatch.setattr(watch, "LOOK", 50)
    stop = Event()
    timer = Timer(30, stop.set)
    timer.start()
    yield lambda root, exercises=(), poll=False: arrivals(open_course(root), exercises, stop, poll)
    stop.set()
    timer.cancel()


@pytest.mark.parametrize("poll", [False, True])
def test_first_what_is_there_then_what_arrives(poll, course_copy, listen, small):
    small.hand_in(course_copy, "cid", "1")
    told = listen(course_copy, poll=poll)
    assert next(told) == {"scara": ["cid"]}
    small.hand_in(course_copy, "Ann A", "1")
    small.hand_in(course_copy, "ben", "1", ".scara.ipynb.part")
    (course_copy / "submitted/readme.txt").write_text("1")
    assert next(told) == {"scara": ["Ann A"]}


def test_what_belongs_to_other_exercises_is_not_told(course_copy, listen, small):
    told = listen(course_copy, ["scara"])
    assert next(told) == {}
    folder = course_copy / "submitted/ann/tables"
    folder.mkdir(parents=True)
    (folder / "tables.ipynb").write_text("1")
    small.hand_in(course_copy, "ben", "1")
    assert next(told) == {"scara": ["ben"]}


def test_what_arrives_while_others_are_graded_is_told_next(course_copy, listen, small):
    small.hand_in(course_copy, "ann", "1")
    told = listen(course_copy)
    assert next(told) == {"scara": ["ann"]}  # who is graded now, which takes as long as it takes
    small.hand_in(course_copy, "ben", "1")
    assert next(told) == {"scara": ["ben"]}


def test_from_time_to_time_there_is_an_empty_answer(course_copy, listen, monkeypatch):
    monkeypatch.setattr(watch, "PATIENCE", 2)
    told = listen(course_copy)
    assert [next(told), next(told)] == [{}, {}]


@pytest.mark.slow
def test_what_failed_is_tried_again_and_told_once(course_copy, small, released, without_kernels, monkeypatch, capsys):
    small.hand_in(course_copy, "ann", small.answered(released, d2_sign="d2_sign = 'A'"))
    (course_copy / "gradebook.db").rename(course_copy / "away.db")
    seen = iter([{"scara": ["ann"]}, {}, {}, {}])

    def arrivals(*settings, **more):
        for number, one in enumerate(seen):
            if number == 2:
                (course_copy / "away.db").rename(course_copy / "gradebook.db")
            yield one

    monkeypatch.setattr(watch, "arrivals", arrivals)
    with without_kernels():
        assert cli.main(["watch", "scara", "--course", str(course_copy)]) == 0
    out, err = capsys.readouterr()
    assert err.count("run: autograder release") == 2
    assert sum("  ann  scara  0/20" in line for line in out.splitlines()) == 1


@pytest.mark.slow
def test_the_command_shows_one_line_for_each(course_copy, small, released, without_kernels, monkeypatch, capsys):
    for student in ("ann", "ben", "<cid>"):
        small.hand_in(course_copy, student, small.answered(released, d2_sign="d2_sign = 'A'"))
    seen = [{"scara": ["ann", "ben"]}, {"scara": ["ben"]}]
    monkeypatch.setattr(watch, "arrivals", lambda *settings, **more: iter(seen))
    with without_kernels():
        assert cli.main(["watch", "scara", "--course", str(course_copy)]) == 0
    lines = [line.split("  ") for line in capsys.readouterr().out.splitlines() if "/submitted;" not in line]
    assert [line[1:4] for line in lines] == [
        ["<cid>", "scara", "-"],
        ["ann", "scara", "0/20"],
        ["ben", "scara", "0/20"],
    ]
    assert "d2_sign: nothing_matched" in lines[1][4] and "rename it" in lines[0][4]
