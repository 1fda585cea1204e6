"""nbgrader's Autograde, taught to read what a stranger wrote and to store it as a whole.

Four things have no plug-in point in nbgrader 0.9.6, so `SubmissionAutograde` takes the place of its Autograde
(`host.prepare` sees to that): a folder without the expected notebook is a submission with zero points, not one that
is passed over or ends the run; files beside the notebook are not copied, because nbgrader follows links and stops at
a pipe; a time stamp that is no time stamp is ignored; and points, notes and files are stored together or not at all,
where nbgrader writes each by itself.
"""

from __future__ import annotations

import os
import traceback
from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from datetime import datetime
from fnmatch import fnmatchcase
from functools import cached_property
from pathlib import Path
from typing import Any

import nbformat
from nbformat.notebooknode import NotebookNode
from nbgrader import utils
from nbgrader.api import Assignment
from nbgrader.converters import Autograde, BaseConverter
from nbgrader.converters.base import NbGraderException
from nbgrader.preprocessors import AssignLatePenalties
from sqlalchemy import select

from autograder.sandbox import available

from ..cells import NotebookRecord, check_cells, notebook_record, tracked_cells, write_record
from ..errors import CourseError, in_words
from ..files import remove_others, staged
from ..folders import released_notebook, released_path, student_names
from ..gradebook import GradebookError, is_made, reading, writing
from ..inert import terminal_text
from ..store import Graded, entries_of, store, stored_notebooks
from ..submission.execution import Execution
from ..submission.reading import Unreadable, fingerprint, plain_bytes, read_submission
from ..term import deadlines
from .preprocessors import SandboxExecute, Turn


def submission(path: Path, released: Path) -> NotebookNode:
    """The notebook handed in at `path`; the released one, with the reason in its record, if that cannot be read."""
    try:
        nb = read_submission(path)
    except Unreadable as reason:
        nb = deepcopy(released_notebook(released))
        write_record(nb, NotebookRecord(unreadable=terminal_text(str(reason))))
    stamp = fingerprint(path.parent, released.read_bytes())
    write_record(nb, replace(notebook_record(nb), submission=stamp))
    return nb


class ChosenStudents(BaseConverter):
    """Converts the folders of given students, whatever characters their names hold; all folders if none is given.

    One student after the other, by `convert_student`; what fails is said, and the others are converted.

    Attributes
    ----------
    failures : dict of str to str
        What went wrong, by student.
    """

    def __init__(self, coursedir=None, students: tuple[str, ...] = (), **kwargs: Any) -> None:
        self.students = students
        self.failures: dict[str, str] = {}
        super().__init__(coursedir=coursedir, **kwargs)

    def folder(self, student: str) -> Path:
        """Where the student's files come from."""
        return Path(self._format_source(self.coursedir.assignment_id, student))

    def chosen(self) -> list[str]:
        """The students to convert that have a folder."""
        wanted = self.coursedir.student_id
        names = self.students or [
            name for name in student_names(self.folder(".").parent) if name == wanted or fnmatchcase(name, wanted)
        ]
        excluded = set(filter(None, self.coursedir.student_id_exclude.split(",")))
        return [name for name in names if name not in excluded and os.path.isdir(self.folder(name))]

    def convert_student(self, student: str) -> None:
        """Convert the files of one student."""
        raise NotImplementedError

    def convert_notebooks(self) -> None:
        for student in self.chosen():
            try:
                self.run_pre_convert_hook()
                self.convert_student(student)
                self.run_post_convert_hook()
            except GradebookError as error:
                self.log.error(str(error))
                raise NbGraderException(str(error)) from error
            except Exception as error:
                self.log.debug(traceback.format_exc())
                self.failures[student] = in_words(error)
                self.log.error("%s: %s", student, self.failures[student])
        if self.failures:
            raise NbGraderException("; ".join(f"{student}: {reason}" for student, reason in self.failures.items()))


def time_stamp(folder: str | os.PathLike) -> datetime | None:
    """The time in a folder's ``timestamp.txt``, None if there is none or it makes no sense."""
    try:
        return utils.parse_utc(plain_bytes(Path(folder, "timestamp.txt"), 100).decode("ascii").strip())
    except (Unreadable, ValueError, OverflowError):
        return None


@dataclass(frozen=True)
class Judged:
    """All that is to be stored of one submission.

    Attributes
    ----------
    notebooks : dict of str to Graded
        By name.
    beside : dict of str to bytes
        Contents of the files beside them, by name.
    timestamp : datetime or None
        When it was handed in, if that is known.
    """

    notebooks: dict[str, Graded]
    beside: dict[str, bytes]
    timestamp: datetime | None


class SubmissionAutograde(ChosenStudents, Autograde):
    """Autograde for submissions that nobody has looked at.

    A submission whose result is stored as a whole is passed over, unless it is forced.

    Parameters
    ----------
    students : tuple of str
        Whom to grade; everybody that the course directory's ``student_id`` matches if empty.
    executions : mapping, optional
        Runs that were done ahead, by student and notebook name; what is missing is run in place.
    """

    def __init__(self, coursedir=None, executions: Mapping[tuple[str, str], Execution] | None = None, **kwargs) -> None:
        self.executions = executions
        super().__init__(coursedir=coursedir, **kwargs)
        self.coursedir.get_existing_timestamp = time_stamp

    def start(self) -> None:
        if self.executions is None:
            try:
                refuse_unless_ready(self)
                refuse_unless_fit(self)
            except CourseError as reason:
                self.log.error(str(reason))
                raise NbGraderException(str(reason)) from None
        super().start()

    def folder(self, student: str) -> Path:
        # Autograde's input is the submission while it sanitizes, and its own output afterwards.
        return Path(
            self.coursedir.format_path(self.coursedir.submitted_directory, student, self.coursedir.assignment_id)
        )

    def init_notebooks(self) -> None:
        self.notebooks = [name for name in notebook_names(self) if fnmatchcase(name, self.coursedir.notebook_id)]
        if not self.notebooks or not self.chosen():
            message = f"Nothing to grade in '{self.folder(self.coursedir.student_id)}'"
            self.log.error(message)
            raise NbGraderException(message)

    def convert_student(self, student: str) -> None:
        target = Path(self._format_dest(self.coursedir.assignment_id, student))
        if not self.force and self._is_done(student, self.folder(student), target):
            self.log.info("Skipping existing assignment: %s", target)
            return
        with utils.setenv(NBGRADER_EXECUTION="autograde"):
            judged = self.judged(student, self.notebooks)
        self.enter(student, judged)

    def judged(
        self, student: str, names: Sequence[str], turn: Turn = "both", brought: Mapping[str, bytes] | None = None
    ) -> Judged:
        """Restore, run and judge a submission; nothing is stored.

        Parameters
        ----------
        student : str
        names : sequence of str
            Of the exercise's notebooks.
        turn, brought
            See `SandboxExecute`.

        Raises
        ------
        InDoubt
            In the first turn, if the machine may be to blame for what went wrong.
        MustRun
            If a notebook has to run on another machine first.
        """
        folder = self.folder(student)
        notebooks = {name: self._graded(student, folder / f"{name}.ipynb", turn, brought) for name in names}
        return Judged(notebooks, self._beside(folder), time_stamp(folder))

    def enter(self, student: str, judged: Judged) -> None:
        """Store a submission as a whole: entries of the gradebook, and files."""
        exercise = self.coursedir.assignment_id
        target = Path(self._format_dest(exercise, student))
        files = {f"{name}.ipynb": graded.content for name, graded in judged.notebooks.items()} | judged.beside
        dates = deadlines(self.coursedir.root, exercise)
        penalties = AssignLatePenalties(parent=self)
        with writing(self.coursedir.db_url) as session:
            store(session, exercise, student, judged.notebooks, judged.timestamp, dates, penalties)
            with staged(target, files, int(str(self.permissions), 8)) as put_in_place:
                put_in_place()
            if self.coursedir.notebook_id == "*":
                remove_others(target, files)
        if self.coursedir.groupshared:
            self.set_permissions(exercise, student)

    def _is_done(self, student: str, folder: Path, target: Path) -> bool:
        exercise, names = self.coursedir.assignment_id, self.notebooks
        with reading(self.coursedir.db_url) as session:
            stored = stored_notebooks(session, exercise, student)
        stamps = {
            name: fingerprint(folder, released_path(self.coursedir, exercise, name).read_bytes()) for name in names
        }
        return all(
            (student, name) in stored and stored[student, name].is_graded(stamp, target / f"{name}.ipynb")
            for name, stamp in stamps.items()
        )

    @cached_property
    def _steps(self) -> list[Callable]:
        """The configured plug-ins, those that sanitize first."""
        exporter = self.exporter_class(parent=self, config=self.config)
        for plugin in (*self.sanitize_preprocessors, *self.autograde_preprocessors):
            exporter.register_preprocessor(plugin)
        return exporter._preprocessors

    def _graded(self, student: str, path: Path, turn: Turn, brought: Mapping[str, bytes] | None) -> Graded:
        """The graded notebook: sanitized, then judged.

        nbconvert would copy and validate it around each plug-in; what `submission` gives is valid, and ours alone.
        """
        name, exercise = path.stem, self.coursedir.assignment_id
        released = released_path(self.coursedir, exercise, name)
        resources: dict[str, Any] = {"unique_key": name, "output_files_dir": f"{name}_files"}
        resources["nbgrader"] = {
            "student": student, "assignment": exercise, "notebook": name, "db_url": self.coursedir.db_url
        }  # fmt: skip
        resources["autograder"] = {
            "root": self.coursedir.root,
            "folder": str(path.parent),
            "released": str(released),
            "execution": (self.executions or {}).get((student, name)),
            "turn": turn,
            "brought": brought,
        }
        nb = submission(path, released)
        for step in self._steps:
            nb, resources = step(nb, resources)
        nbformat.validate(nb)
        return Graded(f"{nbformat.v4.writes(nb)}\n".encode(), entries_of(nb))

    def _beside(self, folder: Path) -> dict[str, bytes]:
        """The files that stand beside the graded notebook: the solution's own, and the time stamp."""
        source = self.coursedir.format_path(self.coursedir.source_directory, ".", self.coursedir.assignment_id)
        found = utils.find_all_files(source, [*self.coursedir.ignore, "*.ipynb"])
        files = {os.path.relpath(path, source): Path(path).read_bytes() for path in found}
        if time_stamp(folder) is not None:
            files["timestamp.txt"] = plain_bytes(folder / "timestamp.txt", 100)
        return files


class NotReady(CourseError):
    """Grading cannot start; the message says what to do first."""


def notebook_names(converter: Autograde) -> list[str]:
    """Names of the notebooks of the converter's assignment; `NotReady` if it was never released."""
    course, exercise = converter.coursedir, converter.coursedir.assignment_id
    if is_made(course.db_url):
        with reading(course.db_url) as session:
            assignment = session.scalars(select(Assignment).where(Assignment.name == exercise)).one_or_none()
            if assignment is not None:
                return sorted(notebook.name for notebook in assignment.notebooks)
    raise NotReady(f"{exercise} is not in the gradebook; run: autograder release {exercise}")


def refuse_unless_ready(converter: SubmissionAutograde) -> None:
    """`NotReady` without a sandbox, or if the released notebook is not the one that the gradebook knows."""
    mode = SandboxExecute(parent=converter).mode
    if mode == "bwrap" and (reason := available()):
        raise NotReady(f"no sandbox: {reason}. Students' code is not run without one unless you say --sandbox none")
    course, exercise = converter.coursedir, converter.coursedir.assignment_id
    for name in notebook_names(converter):
        path = released_path(course, exercise, name)
        if not path.is_file():
            raise NotReady(f"{path} is missing; run: autograder release {exercise}")
        nb = released_notebook(path)
        checks = {check: (cell.metadata.nbgrader["points"], cell.source) for check, cell in check_cells(nb).items()}
        with reading(course.db_url) as session:
            assignment = session.scalars(select(Assignment).where(Assignment.name == exercise)).one()
            notebook = next(notebook for notebook in assignment.notebooks if notebook.name == name)
            sources = {cell.name: cell.source for cell in notebook.source_cells}
            known = {cell.name: (cell.max_score, sources.get(cell.name)) for cell in notebook.grade_cells}
        if sources.keys() != tracked_cells(nb).keys() or not checks.items() <= known.items():
            raise NotReady(f"{path} is not what the gradebook knows; run: autograder release {exercise}")


def refuse_unless_fit(converter: SubmissionAutograde) -> None:
    """`NotReady` if a trial notebook with the imports of the released ones does not run here."""
    course = converter.coursedir
    released = [released_path(course, course.assignment_id, name) for name in notebook_names(converter)]
    if fault := SandboxExecute(parent=converter).find_fault(released, Path(course.root)):
        raise NotReady(fault)
