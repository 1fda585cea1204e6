"""nbgrader's converters, taught to read what a stranger wrote.

Three things have no plug-in point in nbgrader 0.9.6, so `SubmissionAutograde` takes the place of its Autograde
(`host.prepare` sees to that): a folder without the expected notebook is a submission with zero points, not one
that is passed over or ends the run; files beside the notebook are not copied, because nbgrader follows links and
stops at a pipe; a time stamp that is no time stamp is ignored.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import replace
from datetime import datetime
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import nbformat
from nbconvert.exporters import HTMLExporter, NotebookExporter
from nbgrader.api import Gradebook, MissingEntry
from nbgrader.converters import Autograde, BaseConverter, GenerateFeedback
from nbgrader.converters.base import NbGraderException
from nbgrader.utils import parse_utc
from traitlets.config import Config

from autograder.sandbox import available

from ..cells import NotebookRecord, check_cells, notebook_record, tracked_cells, write_record
from ..inert import terminal_text
from ..submission.execution import Execution
from ..submission.reading import Unreadable, fingerprint, plain_bytes, read_submission
from .preprocessors import SandboxExecute

TEMPLATES = str(Path(__file__).parent / "templates")


class SubmissionExporter(NotebookExporter):
    """Reads a submission strictly; one that cannot be read goes on as the released notebook with the reason."""

    def from_filename(self, filename: str, resources: dict | None = None, **kw: Any) -> tuple[Any, dict]:
        resources = resources or {}
        if not resources["autograder"]["sanitizing"]:
            return super().from_filename(filename, resources, **kw)
        released = Path(resources["autograder"]["released"])
        return self.from_notebook_node(submission(Path(filename), released), resources, **kw)


def submission(path: Path, released: Path) -> nbformat.NotebookNode:
    """The notebook handed in at `path`; the released one, with the reason in its record, if that cannot be read."""
    try:
        nb = read_submission(path)
    except Unreadable as reason:
        nb = deepcopy(nbformat.read(released, as_version=4))
        write_record(nb, NotebookRecord(unreadable=terminal_text(str(reason))))
    stamp = fingerprint(path.parent, released.read_bytes())
    write_record(nb, replace(notebook_record(nb), submission=stamp))
    return nb


class ChosenStudents(BaseConverter):
    """Converts the folders of given students, whatever characters their names hold; all folders if none is given."""

    def __init__(self, coursedir=None, students: tuple[str, ...] = (), **kwargs) -> None:
        self.students = students
        super().__init__(coursedir=coursedir, **kwargs)

    def _folders(self) -> list[str]:
        steps = Path(self._format_source(self.coursedir.assignment_id, "."))
        wanted = self.coursedir.student_id
        names = self.students or [
            name for name in student_names(steps.parent) if name == wanted or fnmatchcase(name, wanted)
        ]
        folders = [self._format_source(self.coursedir.assignment_id, name) for name in names]
        return [folder for folder in folders if os.path.isdir(folder)]


def student_names(step: Path) -> list[str]:
    """Students that have a folder in a step of the course (``submitted``, ``autograded`` ...)."""
    if not step.is_dir():
        return []
    names = [entry.name for entry in os.scandir(step) if entry.is_dir()]
    return sorted(name for name in names if name.isprintable() and not name.startswith("."))


class _NothingElse(BaseConverter):
    """Stands between Autograde and BaseConverter: of the files beside a notebook only the time stamp is copied."""

    def init_assignment(self, assignment_id: str, student_id: str) -> None:
        source, target = (Path(place(assignment_id, student_id)) for place in (self._format_source, self._format_dest))
        target.mkdir(parents=True, exist_ok=True)
        if time_stamp(source) is not None:
            (target / "timestamp.txt").write_bytes(plain_bytes(source / "timestamp.txt", 100))


def time_stamp(folder: str | os.PathLike) -> datetime | None:
    """The time in a folder's ``timestamp.txt``, None if there is none or it makes no sense."""
    try:
        return parse_utc(plain_bytes(Path(folder, "timestamp.txt"), 100).decode("ascii").strip())
    except (Unreadable, ValueError, OverflowError):
        return None


class SubmissionAutograde(Autograde, ChosenStudents, _NothingElse):
    """Autograde for submissions that nobody has looked at.

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
            except NotReady as reason:
                self.log.error(str(reason))
                raise NbGraderException(str(reason)) from None
        super().start()

    def init_notebooks(self) -> None:
        self.notebooks = list[str]()
        names = [name for name in notebook_names(self) if fnmatchcase(name, self.coursedir.notebook_id)]
        self.assignments = {
            folder: [os.path.join(folder, f"{name}.ipynb") for name in names] for folder in self._folders()
        }
        if not names or not self.assignments:
            message = (
                f"Nothing to grade in '{self._format_source(self.coursedir.assignment_id, self.coursedir.student_id)}'"
            )
            self.log.error(message)
            raise NbGraderException(message)

    def init_single_notebook_resources(self, notebook_filename: str) -> dict:
        resources = super().init_single_notebook_resources(notebook_filename)
        names = resources["nbgrader"]
        student, assignment, notebook = names["student"], names["assignment"], names["notebook"]
        resources["autograder"] = {
            "sanitizing": self._sanitizing,
            "root": self.coursedir.root,
            "folder": self.coursedir.format_path(self.coursedir.submitted_directory, student, assignment),
            "released": str(released_path(self.coursedir, assignment, notebook)),
            "execution": (self.executions or {}).get((student, notebook)),
        }
        return resources


def released_path(coursedir, assignment: str, notebook: str) -> Path:
    """Where the released notebook lies."""
    return Path(coursedir.format_path(coursedir.release_directory, ".", assignment), f"{notebook}.ipynb").resolve()


class NotReady(RuntimeError):
    """Grading cannot start; the message says what to do first."""


def notebook_names(converter: Autograde) -> list[str]:
    """Names of the notebooks of the converter's assignment; `NotReady` if it was never released."""
    course, assignment = converter.coursedir, converter.coursedir.assignment_id
    with Gradebook(course.db_url, course.course_id) as gradebook:
        try:
            return [notebook.name for notebook in gradebook.find_assignment(assignment).notebooks]
        except MissingEntry:
            raise NotReady(f"{assignment} is not in the gradebook; run: autograder release {assignment}") from None


def refuse_unless_ready(converter: SubmissionAutograde) -> None:
    """`NotReady` without a sandbox, or if the released notebook is not the one that the gradebook knows."""
    mode = SandboxExecute(parent=converter).mode
    if mode == "bwrap" and (reason := available()):
        raise NotReady(f"no sandbox: {reason}. Students' code is not run without one unless you say --sandbox none")
    course, assignment = converter.coursedir, converter.coursedir.assignment_id
    for name in notebook_names(converter):
        path = released_path(course, assignment, name)
        if not path.is_file():
            raise NotReady(f"{path} is missing; run: autograder release {assignment}")
        nb = nbformat.read(path, as_version=4)
        checks = {check: (cell.metadata.nbgrader["points"], cell.source) for check, cell in check_cells(nb).items()}
        with Gradebook(course.db_url, course.course_id) as gradebook:
            notebook = gradebook.find_notebook(name, assignment)
            sources = {cell.name: cell.source for cell in notebook.source_cells}
            known = {cell.name: (cell.max_score, sources.get(cell.name)) for cell in notebook.grade_cells}
        if sources.keys() != tracked_cells(nb).keys() or not checks.items() <= known.items():
            raise NotReady(f"{path} is not what the gradebook knows; run: autograder release {assignment}")


def refuse_unless_fit(converter: SubmissionAutograde) -> None:
    """`NotReady` if a trial notebook with the imports of the released ones does not run here."""
    course = converter.coursedir
    released = [released_path(course, course.assignment_id, name) for name in notebook_names(converter)]
    if fault := SandboxExecute(parent=converter).find_fault(released, Path(course.root)):
        raise NotReady(fault)


class FeedbackExporter(HTMLExporter):
    """The feedback page: nbgrader's, with a summary on top and no script but that for formulas."""

    def __init__(self, config: Config | None = None, **kw) -> None:
        own = deepcopy(config or Config())
        # nbgrader configures HTMLExporter for pages of its own; a section of the subclass goes before that.
        own.FeedbackExporter.template_name = "feedback_page"
        nbgrader_templates = own.HTMLExporter.get("extra_template_basedirs", [])
        own.FeedbackExporter.extra_template_basedirs = [TEMPLATES, *nbgrader_templates]
        own.FeedbackExporter.extra_template_paths = [
            *own.HTMLExporter.get("extra_template_paths", []),
            *nbgrader_templates,
        ]
        super().__init__(config=own, **kw)


class FeedbackPages(GenerateFeedback, ChosenStudents):
    """GenerateFeedback for given students."""

    def init_notebooks(self) -> None:
        self.notebooks = list[str]()
        found = {folder: sorted(map(str, Path(folder).glob("*.ipynb"))) for folder in self._folders()}
        self.assignments = {folder: notebooks for folder, notebooks in found.items() if notebooks}
