"""Real graders, each a process of its own with sandboxed kernels: stopped at random moments, and beside each other."""

import itertools
import json
import os
import random
import subprocess
import sys
import time
from contextlib import suppress
from signal import SIGHUP, SIGINT, SIGKILL, SIGTERM

import psutil
import pytest

from autograder import cli

pytestmark = [pytest.mark.slow, pytest.mark.sandbox]

D2_SIGN = {"B": (4, "note: right"), "A": (0, "note: listing_believed")}
"""Points and note of this question by answer; who hands in anew gives the other one."""
OTHERS = {
    "ann": ((10, "note: right"), (6, "note: right")),
    "ben": ((7, "note: sign_of_d2"), (6, "note: right")),
    "cle": ((0, "note: error"), (6, "note: right")),
    "dan": ((10, "note: right"), (0, "note: not_attempted")),
}
"""Points and notes of T04 and forward, by student."""
SLEEPER = f"sleep {86_400 + os.getpid()}"
TURNS = itertools.count()


def answers(small, student, d2_sign):
    """What a student hands in, anew each time; one of them starts a process that outlives its cell."""
    found = {"d2_sign": f"d2_sign = {d2_sign!r}  # {next(TURNS)}"}
    if student == "ben":
        found["T04"] = small.T04.replace("-d2", "d2")
    elif student == "cle":
        found["T04"] = f"import subprocess\nsubprocess.Popen({SLEEPER.split()})\n1 / 0"
    elif student == "dan":
        found["forward"] = None
    return found


def entries_of(student, d2_sign):
    """What the gradebook must hold of a student."""
    first, last = OTHERS[student]
    found = {"scara-T04": first, "scara-d2_sign": D2_SIGN[d2_sign], "scara-forward": last}
    return [(student, check, *entry) for check, entry in found.items()]


def hand_in(small, course, released, d2_sign, students=OTHERS, exercise="scara"):
    for student in students:
        folder = course / "submitted" / student / exercise
        folder.mkdir(parents=True, exist_ok=True)
        nb = small.answered(released, **answers(small, student, d2_sign))
        (folder / f"{exercise}.ipynb").write_text(json.dumps(nb))


def by_student(entries):
    return {student: [row for row in entries if row[0] == student] for student, *_ in entries}


def ends_right(faults, course, d2_sign, students=OTHERS, exercise="scara"):
    """True if points, notes, notebooks and pages are those of the last submissions, and nothing else is there."""
    found = by_student(faults.entries(course, exercise))
    assert found == {student: entries_of(student, d2_sign) for student in students}
    for student, rows in found.items():
        graded, shown = (course / step / student / exercise for step in ("autograded", "feedback"))
        assert [path.name for path in (*graded.iterdir(), *shown.iterdir())] == [
            f"{exercise}.ipynb",
            f"{exercise}.html",
        ]
        page = (shown / f"{exercise}.html").read_text()
        assert f"{exercise}: {sum(row[2] for row in rows):g} of 20 points" in page and page.rstrip().endswith("</html>")
        assert f"d2_sign = {d2_sign!r}" in (graded / f"{exercise}.ipynb").read_text()
    return True


@pytest.fixture
def temporary(tmp_path_factory):
    """A temporary folder for graders; its name leaves room for sockets."""
    return tmp_path_factory.mktemp("t")


@pytest.fixture
def started(faults, course_copy, temporary, tmp_path):
    """started(*words) -> the process of a command, as typed at a terminal of its own in the course's folder."""
    processes = []

    def start(*words):
        said = tmp_path / f"said-{len(processes)}"
        with said.open("wb") as output:
            process = subprocess.Popen(
                [sys.executable, "-m", *words],
                cwd=course_copy,
                env={**os.environ, "TMPDIR": str(temporary)},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                preexec_fn=faults.as_from_a_terminal,
                start_new_session=True,
            )
        processes.append(process)
        process.said = said
        return process

    yield start
    for process in processes:
        process.kill()
        process.wait()


def ended(process):
    """Exit code of a command and what it said, once it has ended."""
    code = process.wait()
    return code, process.said.read_text()


# ---------------------------------------------------------------- stopped at random moments

GRADE = ("autograder.cli", "grade", "scara", "--jobs", "2")
WAYS = ((SIGKILL,), (SIGTERM,), (SIGHUP,), (SIGINT,), (SIGINT, SIGINT))
MOMENTS = 8


class Events:
    """What a run puts in place, seen from outside: folders of kernels, graded notebooks, pages."""

    def __init__(self, course, temporary):
        self.places = (
            (temporary, "ag-run-*"),
            (course, "autograded/*/scara/scara.ipynb"),
            (course, "feedback/*/*/*.html"),
        )
        self.before, self.seen = set(), set()
        self.before = self.look()

    def look(self):
        for folder, pattern in self.places:
            for path in folder.glob(pattern):
                with suppress(FileNotFoundError):
                    self.seen.add((path, path.stat().st_ino))
        return set(self.seen)

    def count(self):
        """How many there were so far."""
        return len(self.look() - self.before)


def send(process, number):
    # What is typed at a terminal, and its end, reaches the whole group.
    group = number in (SIGINT, SIGHUP)
    with suppress(ProcessLookupError):
        os.killpg(process.pid, number) if group else os.kill(process.pid, number)


def stop(process, events, at, further, numbers):
    """Stop a run that has shown `at` events and has then computed for `further` seconds more.

    Returns the processes that it and its kernels had at that moment.
    """
    grader = psutil.Process(process.pid)
    family, reached = [], None
    while process.poll() is None:
        used = sum(grader.cpu_times()[:2])
        if reached is None and events.count() >= at:
            reached = used
        if reached is not None and used >= reached + further:
            family = grader.children(recursive=True)
            for number in numbers:
                send(process, number)
                time.sleep(0.02)  # two of a kind that come together are one
            break
        time.sleep(0.01)
    return family


def is_alive(process):
    # Whoever nobody waits for, in a container without an init, stays in the table.
    with suppress(psutil.NoSuchProcess):
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    return False


def test_stopped_at_random_moments(needs_sandbox, faults, small, course_copy, released, temporary, started):
    hand_in(small, course_copy, released, "A")
    events = Events(course_copy, temporary)
    undisturbed = started(*GRADE)
    while undisturbed.poll() is None:
        events.count()
        time.sleep(0.01)
    assert ended(undisturbed)[0] == 0 and ends_right(faults, course_copy, "A")
    chance, whole, codes = random.Random(10), events.count(), []
    for moment in range(MOMENTS):
        before, d2_sign, numbers = by_student(faults.entries(course_copy)), "BA"[moment % 2], WAYS[moment % len(WAYS)]
        hand_in(small, course_copy, released, d2_sign)
        process = started(*GRADE)
        at, further = chance.randrange(1, whole - 2), chance.uniform(0, 0.1)
        family = stop(process, Events(course_copy, temporary), at, further, numbers)
        code, said = ended(process)
        codes.append(code)
        # The last of several may meet a process that is ending, and no longer listens.
        assert code in {0, -SIGKILL if SIGKILL in numbers else 128 + numbers[0], *(-one for one in numbers[1:])}, said
        assert "Traceback" not in said, said
        # Whoever was graded before has the old result or the new one, as a whole.
        after = by_student(faults.entries(course_copy))
        assert before.keys() <= after.keys()
        assert all(rows in (before.get(student), entries_of(student, d2_sign)) for student, rows in after.items())
        while any(map(is_alive, family)):
            time.sleep(0.05)
        assert numbers == (SIGKILL,) or len(numbers) == 2 or not list(temporary.iterdir())
    assert sum(code != 0 for code in codes) > MOMENTS // 2, codes
    code, said = ended(started(*GRADE))
    assert code == 0, said
    assert ends_right(faults, course_copy, d2_sign)
    assert not list(temporary.iterdir())
    assert not [one for one in psutil.process_iter(["cmdline"]) if SLEEPER in " ".join(one.info["cmdline"] or ())]
    assert [path.name for path in course_copy.glob("*gradebook*")] == ["gradebook.db"]


# ---------------------------------------------------------------- beside each other


def test_graders_beside_each_other(needs_sandbox, faults, small, course_copy, released, started, capsys):
    """Ours and nbgrader's, of one exercise and of two, of a student with an older grade and of a new one."""
    (course_copy / "solutions/second").mkdir()
    text = (course_copy / "solutions/scara/scara.ipynb").read_text()
    (course_copy / "solutions/second/second.ipynb").write_text(text)
    assert cli.main(["release", "second", "--course", str(course_copy)]) == 0
    exercises, both, ours, stock = ("scara", "second"), ("ann", "ben"), "autograder.cli grade", "nbgrader autograde"

    def graded(students, d2_sign, *commands):
        for exercise in exercises:
            hand_in(small, course_copy, released, d2_sign, students, exercise)
        for process in [started(*command.split()) for command in commands]:
            code, said = ended(process)
            assert code == 0 and "Traceback" not in said, said

    graded(("ann",), "A", f"{ours} scara second --jobs 1")
    graded(both, "B", f"{ours} scara", f"{ours} scara", f"{ours} second", f"{stock} second")
    for exercise in exercises:
        assert ends_right(faults, course_copy, "B", both, exercise)
    graded(both, "A", f"{ours} scara", f"{stock} scara", f"{ours} second")
    for exercise in exercises:
        assert ends_right(faults, course_copy, "A", both, exercise)
