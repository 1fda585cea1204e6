"""What grading found, one `Result` per submission, read back from the graded notebook and the gradebook."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

import nbformat

from .cells import answer_id, check_cells, check_record, notebook_record, question_id
from .collecting.receipts import read_receipts, receipts_folder
from .course import Course
from .entries import note_of
from .inert import terminal_text
from .store import StoredNotebook
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
        ``"graded"``, ``"unchanged"`` (graded before and not handed in again), ``"failed"`` (could not be judged) or
        ``"no notebook"`` (something else was handed in).
    remarks : tuple of str
        What was wrong with the notebook as a whole, in words that can be forwarded.
    feedback : str or None
        Path of the HTML page.
    moved, by_hand : tuple of str
        What changed against the time before, and what a lecturer typed (see `changes`).
    """

    student: str
    exercise: str
    status: str
    score: float | None = None
    max_score: float | None = None
    answers: tuple[QuestionResult, ...] = ()
    remarks: tuple[str, ...] = ()
    feedback: str | None = None
    moved: tuple[str, ...] = ()
    by_hand: tuple[str, ...] = ()

    def found(self) -> str:
        """What was found, on one line, by order of questions: ``"T04: sign_of_d2; U1: not_attempted"`` or ``"all right"``."""
        return "; ".join((*self._notes(), *self.remarks))

    def _notes(self) -> list[str]:
        if self.status in ("failed", "no notebook"):
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


def graded_notebooks(course: Course, student: str, exercise: str, outputs: bool = True) -> list[nbformat.NotebookNode]:
    """The graded notebooks of a submission; empty if it was not graded or they cannot be read.

    Without `outputs`, which are most of a notebook, reading takes a fraction of the time.
    """
    found = []
    for path in sorted(course.step("autograded", student, exercise).glob("*.ipynb")):
        try:
            content = json.loads(plain_bytes(path, 64 << 20))
            if not outputs:
                for cell in content["cells"]:
                    cell["outputs"] = []
            # Written by us and told apart by its digest: looking at its form would take longer than all the rest.
            found.append(nbformat.v4.to_notebook(content))
        except (Unreadable, OSError, ValueError, AttributeError, LookupError, TypeError):
            return []
    return found


def read_result(
    course: Course, stored: Mapping[str, StoredNotebook], student: str, exercise: str, status: str
) -> Result:
    """The result of a submission that was graded now or before; `stored` by name of the notebook."""
    if not stored:
        return Result(student, exercise, "failed", remarks=("the gradebook does not know this submission",))
    notebooks = graded_notebooks(course, student, exercise, outputs=False)
    judged = {check: check_record(cell) for nb in notebooks for check, cell in check_cells(nb).items()}
    grades = {name: grade for one in stored.values() for name, grade in one.grades.items() if grade.cell_type == "code"}
    comments = {name: found.auto for one in stored.values() for name, found in one.comments.items()}
    answers = []
    for check in sorted(grades, key=lambda check: list(judged).index(check) if check in judged else len(judged)):
        record, note = judged.get(check), note_of(comments.get(answer_id(check)))
        trouble = record.trouble if record else None
        grade = grades[check]
        answers.append(QuestionResult(question_id(check), grade.score, grade.max_score, note or "", trouble))
    pages = sorted(course.step("feedback", student, exercise).glob("*.html"))
    return Result(
        student,
        exercise,
        status,
        score=max(0.0, sum(one.score - one.penalty for one in stored.values())),
        max_score=sum(one.max_score for one in stored.values()),
        answers=tuple(answers),
        remarks=(
            *filter(None, (one.lateness for one in stored.values())),
            *(remark for nb in notebooks for remark in notebook_record(nb).remarks()),
        ),
        feedback=str(pages[0]) if pages else None,
    )


def without_notebook(course: Course, exercise: str) -> list[Result]:
    """Those who handed in something for an exercise, but no notebook of it."""
    handed_in = set(course.students(exercise))
    return [
        Result(student, exercise, "no notebook", remarks=(receipt.missing,))
        for student, receipt in read_receipts(receipts_folder(course.root, exercise)).items()
        if receipt.missing and student not in handed_in
    ]


def relative(path: str | Path, root: Path) -> str:
    """`path` as seen from the course root."""
    return str(Path(path).relative_to(root)) if Path(path).is_relative_to(root) else str(path)
