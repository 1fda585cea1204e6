"""The result of a submission, stored as a whole: grades, notes and the mark that says what they belong to.

The gradebook decides what has been graded. Beside nbgrader's tables it holds one of ours, ``autograder_mark``, with a
row for each submitted notebook: the fingerprint of what was handed in, and checksums of the entries and of the files
that were stored for it. The row is written in the same transaction as the entries. Whatever does not agree with its
mark was stored half, by another program, or belongs to another copy of the gradebook; it is done again. Entries of
other programs (a lecturer's points, comments and extra credit) are not part of it.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

from nbformat.notebooknode import NotebookNode
from nbgrader import utils
from nbgrader.api import (
    Assignment,
    BaseCell,
    Comment,
    Grade,
    GradeCell,
    Notebook,
    Student,
    SubmittedAssignment,
    SubmittedNotebook,
    TaskCell,
)
from nbgrader.preprocessors import AssignLatePenalties
from sqlalchemy import String, func, inspect, select
from sqlalchemy.orm import DeclarativeBase, Mapped, Session, mapped_column

from .cells import answer_id, check_cells, check_record, notebook_record, tracked_cells
from .entries import comment
from .errors import CourseError
from .files import digest, digest_of
from .roster import Person, gradebook_names
from .term import Deadlines


class _Base(DeclarativeBase):
    pass


class Mark(_Base):
    """Says to what the stored result of a submitted notebook belongs.

    Attributes
    ----------
    notebook_id : str
        Id of nbgrader's row for the submitted notebook.
    submission : str
        Fingerprint of what was handed in and of the release it was graded against.
    entries : str
        Checksum of the points and notes that were stored.
    graded : str
        Checksum of the graded notebook's file.
    shown, page : str or None
        Checksums of what the feedback page shows and of its file; None before the page is written.
    """

    __tablename__ = "autograder_mark"

    notebook_id: Mapped[str] = mapped_column(String(32), primary_key=True)
    submission: Mapped[str] = mapped_column(String(64))
    entries: Mapped[str] = mapped_column(String(64))
    graded: Mapped[str] = mapped_column(String(64))
    shown: Mapped[str | None] = mapped_column(String(64))
    page: Mapped[str | None] = mapped_column(String(64))


@dataclass(frozen=True)
class Entries:
    """What one graded notebook enters in the gradebook.

    Attributes
    ----------
    submission : str
        Fingerprint of what was handed in and of the release it was graded against.
    scores : dict of str to float or None
        Points by the id of their cell; None where somebody has to give them.
    tasks : frozenset of str
        Cells that only a person marks.
    comments : dict of str to str or None
        The judge's comments, by the id of the answer's cell.
    """

    submission: str
    scores: dict[str, float | None]
    tasks: frozenset[str]
    comments: dict[str, str | None]


@dataclass(frozen=True)
class Graded:
    """A graded notebook: the content of its file, and what it enters in the gradebook."""

    content: bytes
    entries: Entries


def entries_of(nb: NotebookNode) -> Entries:
    """Points and comments of a graded notebook, and the judge's notes as comments on the answers."""
    cells = tracked_cells(nb)
    comments: dict[str, str | None] = {}
    for name, cell in cells.items():
        if utils.is_solution(cell) or utils.is_task(cell):
            untouched = cell.metadata.nbgrader.get("checksum") == utils.compute_checksum(cell)
            comments[name] = "No response." if untouched and not utils.is_task(cell) else None
    for check, cell in check_cells(nb).items():
        record = check_record(cell)
        if record is not None and answer_id(check) in comments:
            comments[answer_id(check)] = comment(record.note)
    return Entries(
        notebook_record(nb).submission,
        {name: utils.determine_grade(cell)[0] for name, cell in cells.items() if utils.is_grade(cell)},
        frozenset(name for name, cell in cells.items() if utils.is_task(cell)),
        comments,
    )


@dataclass(frozen=True)
class StoredGrade:
    """Points of one cell: the judge's, those typed by hand in their place, and extra ones."""

    auto: float | None
    manual: float | None
    extra: float | None
    max_score: float
    cell_type: str

    @property
    def score(self) -> float:
        """The points that count, as nbgrader adds them up."""
        found = self.auto if self.manual is None else self.manual
        return 0.0 if found is None else found + (self.extra or 0.0)


@dataclass(frozen=True)
class StoredComment:
    """Comment on one cell: the judge's note, and what was typed by hand."""

    auto: str | None
    manual: str | None

    @property
    def text(self) -> str | None:
        return self.auto if self.manual is None else self.manual


@dataclass
class StoredNotebook:
    """What the gradebook holds of one notebook of one submission; grades and comments by the id of their cell."""

    id: str
    penalty: float
    late: float = 0.0
    """Seconds after the due date."""
    grades: dict[str, StoredGrade] = field(default_factory=dict)
    comments: dict[str, StoredComment] = field(default_factory=dict)
    mark: Mark | None = None

    @property
    def score(self) -> float:
        """Points of the notebook, nothing taken off for being late."""
        return sum(grade.score for grade in self.grades.values())

    @property
    def lateness(self) -> str:
        """How late it was and what that cost, in words; empty if it was in time."""
        if not self.late:
            return ""
        days, hours = int(self.late // 86400), int(self.late % 86400 // 3600)
        parts = [
            f"{count} {unit}{'s' if count > 1 else ''}" for count, unit in ((days, "day"), (hours, "hour")) if count
        ]
        cost = f"{round(self.penalty, 2):g} points off" if self.penalty else "no points off"
        return f"late by {' '.join(parts) or 'less than an hour'}: {cost}"

    @property
    def bonus(self) -> float:
        """What of the score are extra points."""
        return sum(grade.score - replace(grade, extra=None).score for grade in self.grades.values())

    @property
    def max_score(self) -> float:
        """The most points that can be had."""
        return sum(grade.max_score for grade in self.grades.values())

    def entries(self) -> str:
        """Checksum of what the judge stored."""
        grades = {name: grade.auto for name, grade in self.grades.items()}
        return _checksum([grades, {name: found.auto for name, found in self.comments.items()}])

    def shown(self) -> str:
        """Checksum of all that a feedback page shows of the gradebook, and of the graded notebook."""
        grades = {name: [grade.score, grade.max_score] for name, grade in self.grades.items()}
        comments = {name: found.text for name, found in self.comments.items()}
        late = [round(self.late)] if self.late else []
        return _checksum([grades, comments, self.penalty, self.mark.graded if self.mark else None, *late])

    def is_graded(self, submission: str, graded: Path) -> bool:
        """True if the submission with this fingerprint is stored as a whole, its graded notebook included."""
        return (
            self.mark is not None
            and (self.mark.submission, self.mark.entries) == (submission, self.entries())
            and self.mark.graded == digest_of(graded)
        )

    def has_page(self, page: Path) -> bool:
        """True if `page` is the whole feedback page and shows what the gradebook holds now."""
        return self.mark is not None and self.mark.shown == self.shown() and self.mark.page == digest_of(page)


def _checksum(data: Any) -> str:
    return digest(json.dumps(data, sort_keys=True).encode())


def stored_notebooks(
    session: Session, exercise: str, student: str | None = None
) -> dict[tuple[str, str], StoredNotebook]:
    """What the gradebook holds of an exercise, by student and name of the notebook; of one student if one is given."""
    submitted = (
        select(
            SubmittedNotebook.id,
            SubmittedAssignment.student_id,
            Notebook.name,
            SubmittedNotebook.late_submission_penalty,
            SubmittedAssignment.timestamp,
            SubmittedAssignment.extension,
            Assignment.duedate,
        )
        .join(SubmittedAssignment, SubmittedNotebook.assignment_id == SubmittedAssignment.id)
        .join(Assignment, SubmittedAssignment.assignment_id == Assignment.id)
        .join(Notebook, SubmittedNotebook.notebook_id == Notebook.id)
        .where(Assignment.name == exercise)
    )
    if student is not None:
        submitted = submitted.where(SubmittedAssignment.student_id == student)
    found = {
        row.id: (row.student_id, row.name, StoredNotebook(row.id, row[3] or 0.0, _seconds_late(*row[4:])))
        for row in session.execute(submitted)
    }
    ids = submitted.with_only_columns(SubmittedNotebook.id)
    graded, task = GradeCell.__table__, TaskCell.__table__
    grades = (
        select(
            Grade.notebook_id, BaseCell.name, Grade.auto_score, Grade.manual_score, Grade.extra_credit,
            func.coalesce(graded.c.max_score, task.c.max_score), func.coalesce(graded.c.cell_type, task.c.cell_type),
        )
        .join(BaseCell, Grade.cell_id == BaseCell.id)
        .outerjoin(graded, graded.c.id == BaseCell.id)
        .outerjoin(task, task.c.id == BaseCell.id)
        .where(Grade.notebook_id.in_(ids))
        .order_by(BaseCell.name)
    )  # fmt: skip
    for notebook, name, *values in session.execute(grades):
        found[notebook][2].grades[name] = StoredGrade(*values)
    comments = (
        select(Comment.notebook_id, BaseCell.name, Comment.auto_comment, Comment.manual_comment)
        .join(BaseCell, Comment.cell_id == BaseCell.id)
        .where(Comment.notebook_id.in_(ids))
    )
    for notebook, name, *texts in session.execute(comments):
        found[notebook][2].comments[name] = StoredComment(*texts)
    if inspect(session.connection()).has_table(Mark.__tablename__):
        for mark in session.scalars(select(Mark).where(Mark.notebook_id.in_(ids))):
            found[mark.notebook_id][2].mark = mark
            session.expunge(mark)
    return {(name, notebook): stored for name, notebook, stored in found.values()}


def _seconds_late(handed_in: datetime | None, extension: timedelta | None, due: datetime | None) -> float:
    if handed_in is None or due is None:
        return 0.0
    return max(0.0, (handed_in - due - (extension or timedelta(0))).total_seconds())


def store(
    session: Session,
    exercise: str,
    student: str,
    graded: Mapping[str, Graded],
    timestamp: datetime | None,
    dates: Deadlines,
    penalties: AssignLatePenalties,
) -> None:
    """Enter the graded notebooks of a submission in the gradebook, as nbgrader's own SaveAutoGrades would, and mark them.

    Parameters
    ----------
    session : Session
        Of `gradebook.writing`.
    graded : mapping of str to Graded
        Each graded notebook, by name.
    timestamp : datetime or None
        When it was handed in, if that is known.
    dates : Deadlines
        When it was due.
    penalties : AssignLatePenalties
        Asks the course's plug-in what being late costs.

    Raises
    ------
    CourseError
        If the exercise was released anew while the submission was graded.
    """
    submission = _submission(session, exercise, dates.roster.get(student) or Person(student))
    if timestamp is not None:
        submission.timestamp = timestamp
    dates.apply(submission)
    for notebook in submission.notebooks:
        if notebook.name not in graded:
            continue
        _enter(notebook, graded[notebook.name].entries)
        session.flush()
        session.refresh(notebook)
        notebook.late_submission_penalty = _penalty(submission, notebook, penalties)
    session.flush()
    Mark.__table__.create(session.connection(), checkfirst=True)  # type: ignore[attr-defined]
    for (_, name), stored in stored_notebooks(session, exercise, student).items():
        if name not in graded:
            continue
        submission_mark, checksum = graded[name].entries.submission, digest(graded[name].content)
        session.merge(
            Mark(notebook_id=stored.id, submission=submission_mark, entries=stored.entries(), graded=checksum)
        )


def refresh_dates(session: Session, dates: Deadlines, penalties: AssignLatePenalties) -> None:
    """Bring due dates, extensions and penalties of everybody who was graded up to what the course says now."""
    submissions = session.scalars(
        select(SubmittedAssignment)
        .join(Assignment, SubmittedAssignment.assignment_id == Assignment.id)
        .where(Assignment.name == dates.exercise)
    )
    for submission in submissions:
        dates.apply(submission)
        for notebook in submission.notebooks:
            notebook.late_submission_penalty = _penalty(submission, notebook, penalties)


def mark_page(session: Session, stored: StoredNotebook, content: bytes) -> None:
    """Mark that the feedback page of a stored notebook is written and shows what the gradebook holds."""
    if stored.mark is not None:
        mark = session.merge(stored.mark)
        mark.shown, mark.page = stored.shown(), digest(content)


def _submission(session: Session, exercise: str, person: Person) -> SubmittedAssignment:
    """The gradebook's rows for a submission, made where they are missing."""
    assignment = session.scalars(select(Assignment).where(Assignment.name == exercise)).one()
    student = person.id
    if session.get(Student, student) is None:
        session.add(Student(id=student, **gradebook_names(person)))
    submission = session.scalars(
        select(SubmittedAssignment).where(
            SubmittedAssignment.assignment_id == assignment.id, SubmittedAssignment.student_id == student
        )
    ).one_or_none()
    if submission is None:
        submission = SubmittedAssignment(assignment_id=assignment.id, student_id=student)
        session.add(submission)
        session.flush()
    complete(session, submission, assignment.notebooks)
    return submission


def complete(session: Session, submission: SubmittedAssignment, notebooks: Iterable[Notebook]) -> None:
    """Add what a submission lacks of an exercise's notebooks and cells: to be graded, without a comment."""
    present = {found.notebook_id: found for found in submission.notebooks}
    for notebook in notebooks:
        submitted = present.get(notebook.id)
        if submitted is None:
            submitted = SubmittedNotebook(notebook_id=notebook.id, assignment_id=submission.id)
            session.add(submitted)
            session.flush()
        graded = {grade.cell_id for grade in submitted.grades}
        commented = {found.cell_id for found in submitted.comments}
        for cell in (*notebook.grade_cells, *notebook.task_cells):
            if cell.id not in graded:
                session.add(Grade(cell_id=cell.id, notebook_id=submitted.id))
        for cell in (*notebook.solution_cells, *notebook.task_cells):
            if cell.id not in commented:
                session.add(Comment(cell_id=cell.id, notebook_id=submitted.id))
    session.flush()
    session.refresh(submission)


def _enter(notebook: SubmittedNotebook, entries: Entries) -> None:
    """Put points and comments into the rows of a notebook."""
    grades, comments = ({row.name: row for row in rows} for rows in (notebook.grades, notebook.comments))
    if grades.keys() != entries.scores.keys() | entries.tasks or comments.keys() != entries.comments.keys():
        raise CourseError("the exercise was released anew while this was graded; grade again")
    for name, points in entries.scores.items():
        grade = grades[name]
        grade.auto_score = points
        # Points typed by hand stay; somebody should look whether they still fit.
        grade.needs_manual_grade = grade.manual_score is not None or points is None
    for name, text in entries.comments.items():
        comments[name].auto_comment = text


def _penalty(
    submission: SubmittedAssignment, notebook: SubmittedNotebook, penalties: AssignLatePenalties
) -> float | None:
    late = submission.total_seconds_late
    if not late > 0:
        return None
    penalties.init_plugin()
    penalty = penalties.plugin_inst.late_submission_penalty(submission.student_id, notebook.score, late)
    return None if penalty is None else penalties._check_late_penalty(notebook, penalty)
