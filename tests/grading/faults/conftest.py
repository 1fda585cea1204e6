"""A class whose runs are prepared ahead, and a process that is stopped at any step of storing their results."""

import errno
import gc
import os
import shutil
import signal
import sqlite3
import sys
import traceback
from contextlib import contextmanager
from dataclasses import dataclass
from html import escape
from pathlib import Path
from types import SimpleNamespace

import pytest
import sqlalchemy
from sqlalchemy.exc import OperationalError

from autograder import cli
from autograder.grading import files, rendering
from autograder.grading.cells import check_cells, notebook_record, question_id
from autograder.grading.plugins.preprocessors import SandboxExecute
from autograder.grading.submission import judging
from autograder.grading.submission.execution import Execution
from autograder.judge import Evidence
from dhkit import wire

CHOICES = {"right": "B", "wrong": "C"}
ENTRIES = """
select student.id, base_cell.name, grade.auto_score, comment.auto_comment from submitted_assignment
join assignment on assignment.id = submitted_assignment.assignment_id
join student on student.id = submitted_assignment.student_id
join submitted_notebook on submitted_notebook.assignment_id = submitted_assignment.id
join grade on grade.notebook_id = submitted_notebook.id
join base_cell on base_cell.id = grade.cell_id
join base_cell as answer on answer.name = base_cell.name || '-answer' and answer.notebook_id = base_cell.notebook_id
join comment on comment.notebook_id = submitted_notebook.id and comment.cell_id = answer.id
where assignment.name = ? order by student.id, base_cell.name"""


def prepared(self, nb, folder, released, student, course):
    """What the sandbox would bring back: an answer cell says of itself whether it is right."""
    sources = {cell.metadata.nbgrader.grade_id: cell.source for cell in nb.cells if "nbgrader" in cell.metadata}
    evidence = {}
    for check in check_cells(nb):
        word = sources[f"{check}-answer"].strip("# ")
        answer = wire.encode(CHOICES[word]) if check == "scara-d2_sign" and word in CHOICES else {"blank": True}
        evidence[check] = Evidence(wire.packet(question_id(check), answer=answer))
    return Execution(notebook_record(nb).submission, {}, evidence)


def hand_in(small, root, released, student, word):
    small.hand_in(root, student, small.answered(released, T04="# nothing", d2_sign=f"# {word}", forward="# nothing"))


def entries(root, exercise="scara"):
    """Student, question, points and note of everything that is graded; the gradebook is sound."""
    with sqlite3.connect(root / "gradebook.db") as connection:
        assert connection.execute("pragma integrity_check").fetchone() == ("ok",)
        return connection.execute(ENTRIES, (exercise,)).fetchall()


def files_below(root):
    """Paths of everything in the course's folders."""
    steps = ("autograded", "feedback", "exercises")
    return sorted(str(path.relative_to(root)) for step in steps for path in (root / step).rglob("*"))


def as_from_a_terminal():
    """Let this process be stopped, also where the tests run under nohup or in the background of a shell."""
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.default_int_handler)


def start(action):
    """Start `action` in a process of its own; returns its number."""
    sys.stdout.flush()
    sys.stderr.flush()
    if (child := os.fork()) == 0:
        code = 99
        gc.freeze()  # to collect what the copy shares with this process would copy all of it
        as_from_a_terminal()
        try:
            code = action()
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    return child


def ended(child):
    """Exit code of a process once it has ended; negative for a signal that ended it."""
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def run(action):
    """Exit code of `action` in a process of its own."""
    return ended(start(action))


def grade(root, *words):
    return cli.main(["grade", "scara", "--course", str(root), "--jobs", "1", *words])


class Steps:
    """Counts the steps of storing in this process, and does something at one of them.

    A step is a change of the gradebook or of a file, the half of a file that is written, and each verdict.
    """

    def __init__(self, stop_at=None, what=None):
        self.names, self.stop_at, self.what = [], stop_at, what

    def reached(self, name, failure=None):
        self.names.append(name)
        if self.stop_at is None or self.what is None:
            return
        if self.what == "full disk":
            # It stays full from this step on.
            if len(self.names) > self.stop_at and failure is not None:
                raise failure
        elif len(self.names) - 1 == self.stop_at:
            for number in self.what:
                os.kill(os.getpid(), number)

    def watch(self):
        full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        @sqlalchemy.event.listens_for(sqlalchemy.Engine, "before_cursor_execute")
        def statement(connection, cursor, statement, *more):
            if not statement.lstrip().upper().startswith(("SELECT", "PRAGMA")):
                error = sqlite3.OperationalError("database or disk is full")
                error.sqlite_errorname = "SQLITE_FULL"
                self.reached(f"sql {statement.split()[0]}", OperationalError(statement, {}, error))

        @sqlalchemy.event.listens_for(sqlalchemy.Engine, "commit")
        def commit(connection):
            self.reached("commit")

        def around(name, call):
            def stepped(*arguments, **options):
                self.reached(f"before {name}", full)
                result = call(*arguments, **options)
                self.reached(f"after {name}")
                return result

            return stepped

        os.replace, os.fsync = around("replace", os.replace), around("fsync", os.fsync)
        Path.mkdir, Path.unlink = around("mkdir", Path.mkdir), around("unlink", Path.unlink)
        judging.judge = around("judge", judging.judge)
        whole = Path.open

        def opened(path, mode="r", *more, **options):
            file = whole(path, mode, *more, **options)
            return HalfWritten(file, lambda: self.reached("half a file", full)) if mode == "xb" else file

        files.Path.open = opened
        return self


class HalfWritten:
    """A file that reports when the first half of its content is written."""

    def __init__(self, file, half):
        self.file, self.half = file, half

    def write(self, content):
        middle = len(content) // 2
        self.file.write(content[:middle])
        self.file.flush()
        self.half()
        self.file.write(content[middle:])

    def __enter__(self):
        self.file.__enter__()
        return self

    def __exit__(self, *error):
        return self.file.__exit__(*error)

    def __getattr__(self, name):
        return getattr(self.file, name)


@contextmanager
def stubbed():
    """Runs are prepared and no process lays out texts, for as long as this lasts: tests with real kernels may follow."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(SandboxExecute, "run", prepared)
        patch.setattr(SandboxExecute, "find_fault", lambda *settings: None)
        patch.setattr("autograder.grading.plugins.autograde.available", lambda: None)
        patch.setattr(rendering.RENDERER, "render", lambda kind, text, *more: f"<pre>{escape(text)}</pre>")
        yield


@pytest.fixture(autouse=True)
def stub_runs(registry):
    with stubbed():
        yield


@pytest.fixture(scope="session")
def faults(small):
    """The helpers of this file, by name."""
    return SimpleNamespace(
        Steps=Steps,
        as_from_a_terminal=as_from_a_terminal,
        start=start,
        ended=ended,
        run=run,
        grade=grade,
        entries=entries,
        files_below=files_below,
        hand_in=hand_in,
    )


@dataclass(frozen=True)
class HalfGraded:
    """A class that is graded in part, kept in a folder of its own, and the place where it is worked with.

    The place is the same for every test: what was compiled for its gradebook once serves all of them.
    """

    kept: Path
    place: Path

    def put_back(self):
        """The class in its place, as it was."""
        shutil.rmtree(self.place, ignore_errors=True)
        shutil.copytree(self.kept, self.place)
        return self.place


@pytest.fixture(scope="session")
def half_graded(registry, small, empty_course, released, tmp_path_factory):
    """A class of three: `same` is graded, `old` was graded and handed in anew, `new` was never graded."""
    folder = tmp_path_factory.mktemp("faults")
    found = HalfGraded(folder / "kept", folder / "course")
    shutil.copytree(empty_course, found.place)
    hand_in(small, found.place, released, "same", "right")
    hand_in(small, found.place, released, "old", "wrong")
    with stubbed():
        assert grade(found.place) == 0
    hand_in(small, found.place, released, "old", "right")
    hand_in(small, found.place, released, "new", "right")
    shutil.copytree(found.place, found.kept)
    # In this process: each later one starts as a copy of it, with all templates and statements compiled.
    with stubbed():
        assert grade(found.place) == 0
    return found


@pytest.fixture
def course(half_graded):
    """The half graded class."""
    return half_graded.put_back()


@pytest.fixture(scope="session")
def right(half_graded, tmp_path_factory):
    """Gradebook entries, files and pages as they must be in the end, and the steps of storing that lead there."""
    root = half_graded.put_back()
    names = tmp_path_factory.mktemp("steps") / "names"

    def action():
        steps = Steps().watch()
        code = grade(root)
        names.write_text("\n".join(steps.names))
        return code

    with stubbed():
        assert run(action) == 0
    return SimpleNamespace(entries=entries(root), files=files_below(root), steps=names.read_text().splitlines())
