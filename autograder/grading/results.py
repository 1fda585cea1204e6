"""What grading found, one `Result` per submission, read back from the graded notebook and the gradebook."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path

import nbformat
from nbgrader.api import Gradebook, MissingEntry

from .cells import check_cells, check_record, notebook_record, question_id
from .course import Course
from .entries import read_entries
from .inert import terminal_text
from .submission.reading import Unreadable, plain_bytes

# From this many on, questions with the same note share it: "U1, T04, model: not_attempted".
_MANY = 3
_SAID_WHY = ("error", "timeout", "memory", "output_limit", "died", "not_run")


@dataclass(frozen=True)
class QuestionResult:
    """One question of one submission: points, answer note, and why it did not run, if it did not."""

    question: str
    score: float
    max_score: float
    note: str
    trouble: str | None = None


@dataclass(frozen=True)
class Result:
    """One line of the class table.

    Attributes
    ----------
    status : str
        ``"graded"``, ``"unchanged"`` (graded before and not handed in again) or ``"failed"`` (could not be judged).
    remarks : tuple of str
        What was wrong with the notebook as a whole, in words that can be forwarded.
    feedback : str or None
        Path of the HTML page.
    """

    student: str
    exercise: str
    status: str
    score: float | None = None
    max_score: float | None = None
    answers: tuple[QuestionResult, ...] = ()
    remarks: tuple[str, ...] = ()
    feedback: str | None = None

    def found(self) -> str:
        """What was found, on one line, by order of questions: ``"T04: sign_of_d2; U1: not_attempted"`` or ``"all right"``."""
        return "; ".join((*self._notes(), *self.remarks))

    def _notes(self) -> list[str]:
        if self.status == "failed":
            return []
        if len(self.answers) > 1 and len({answer.note for answer in self.answers}) == 1:
            note = self.answers[0].note
            return ["all right" if note == "right" else f"all {len(self.answers)}: {note}"]
        alike: dict[str, list[str]] = {}
        for answer in self.answers:
            if answer.note != "right":
                alike.setdefault(_in_short(answer), []).append(answer.question.partition(".")[2])
        return [
            f"{question}: {short}"
            for short, questions in alike.items()
            for question in ([", ".join(questions)] if len(questions) >= _MANY else questions)
        ]

    def as_json(self) -> dict:
        """The same as plain data, for ``grade --json``."""
        return {**asdict(self), "found": self.found()}


def _in_short(answer: QuestionResult) -> str:
    why = f" ({terminal_text(answer.trouble, 80)})" if answer.trouble and answer.note in _SAID_WHY else ""
    return f"{answer.note}{why}"


def graded_notebooks(course: Course, student: str, exercise: str) -> list[nbformat.NotebookNode]:
    """The graded notebooks of a submission; empty if it was not graded or they cannot be read."""
    found = []
    for path in sorted(course.step("autograded", student, exercise).glob("*.ipynb")):
        try:
            found.append(nbformat.reads(plain_bytes(path, 64 << 20).decode(), as_version=4))
        except (Unreadable, ValueError):
            return []
    return found


def read_result(course: Course, gradebook: Gradebook, student: str, exercise: str, status: str) -> Result:
    """The result of a submission that was graded now or before."""
    try:
        submission = gradebook.find_submission(exercise, student)
    except MissingEntry:
        return Result(student, exercise, "failed", remarks=("the gradebook does not know this submission",))
    notebooks = graded_notebooks(course, student, exercise)
    judged = {check: check_record(cell) for nb in notebooks for check, cell in check_cells(nb).items()}
    entries = {entry.check: entry for entry in read_entries(submission)}
    order = [check for check in judged if check in entries] + [check for check in entries if check not in judged]
    answers = [
        QuestionResult(
            question_id(entry.check), entry.score, entry.max_score, entry.note or "", record.trouble if record else None
        )
        for entry, record in ((entries[check], judged.get(check)) for check in order)
    ]
    feedback = sorted(course.step("feedback", student, exercise).glob("*.html"))
    score = max(0.0, submission.score - submission.late_submission_penalty)
    page = str(feedback[0]) if feedback else None
    remarks = tuple(remark for nb in notebooks for remark in notebook_record(nb).remarks())
    return Result(student, exercise, status, score, submission.max_score, tuple(answers), remarks, page)


def relative(path: str | Path, root: Path) -> str:
    """`path` as seen from the course root."""
    return str(Path(path).relative_to(root)) if Path(path).is_relative_to(root) else str(path)
