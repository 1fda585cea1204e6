"""Cells: the ids that tie a question's cells together, and what grading writes into their metadata.

A question is an *answer* cell (``scara-T04-answer``), which is the student's, and a locked *check* cell
(``scara-T04``), which earns the points; the question itself is called ``scara.T04``. Ids are nbgrader's:
``metadata.nbgrader.grade_id``.

Grading leaves its own findings in ``metadata.autograder`` of a notebook (`NotebookRecord`) and of each check cell
(`CheckRecord`). Graded notebooks are kept for a term and longer, so the records have a version. They are read and
written here and nowhere else.
"""

from __future__ import annotations

from dataclasses import MISSING, dataclass, fields
from typing import Any, TypeVar

from nbformat.notebooknode import NotebookNode

KEY = "autograder"
FOR_EVERYBODY = "full_points_for_everybody"
"""Metadata of a check cell: all who hand in get its points, whatever they answered."""
VERSION = 2
_ANSWER = "-answer"


def grade_id(cell: NotebookNode) -> str | None:
    """The nbgrader id of a cell, None for an ordinary cell."""
    return cell.metadata.get("nbgrader", {}).get("grade_id")


def check_name(cell: NotebookNode) -> str | None:
    """The nbgrader id of a check cell (a locked code cell that earns points), None for any other cell."""
    marks = cell.metadata.get("nbgrader", {})
    is_check = cell.cell_type == "code" and bool(marks.get("grade")) and not marks.get("solution")
    return marks.get("grade_id") or None if is_check else None


def is_check(cell: NotebookNode) -> bool:
    """True for the check cell of a question."""
    return check_name(cell) is not None


def counts_for_everybody(cell: NotebookNode) -> bool:
    """True for a check cell whose points all who hand in get."""
    return bool(cell.metadata.get(FOR_EVERYBODY))


def keeps_source(cell: NotebookNode) -> bool:
    """True for a tracked cell whose source is the student's: an answer or an open problem."""
    marks = cell.metadata.get("nbgrader", {})
    return bool(marks.get("solution") or marks.get("task"))


def tracked_cells(nb: NotebookNode) -> dict[str, NotebookNode]:
    """The cells that nbgrader follows, by id, in the notebook's order."""
    return {name: cell for cell in nb.cells if (name := grade_id(cell))}


def check_cells(nb: NotebookNode) -> dict[str, NotebookNode]:
    """The check cells by id, in the notebook's order."""
    return {name: cell for cell in nb.cells if (name := check_name(cell))}


def question_id(check: str) -> str:
    """``"scara-T04"`` -> ``"scara.T04"``."""
    return check.replace("-", ".", 1)


def check_id(question: str) -> str:
    """``"scara.T04"`` -> ``"scara-T04"``."""
    return question.replace(".", "-", 1)


def answer_id(check: str) -> str:
    """``"scara-T04"`` -> ``"scara-T04-answer"``."""
    return f"{check}{_ANSWER}"


def check_of_answer(name: str) -> str | None:
    """``"scara-T04-answer"`` -> ``"scara-T04"``, None if `name` is not the id of an answer."""
    return name.removesuffix(_ANSWER) if name.endswith(_ANSWER) else None


@dataclass(frozen=True)
class NotebookRecord:
    """What grading found out about a notebook as a whole.

    Attributes
    ----------
    submission : str
        Fingerprint of what was handed in and of the release it was graded against (see `submission.reading`).
    kernel : str or None
        Name of the kernel that the student's notebook asked for.
    unreadable : str or None
        Why the file could not be read, in words for the student.
    repairs : tuple of str
        What had to be mended in the tracked cells, in words.
    trouble : str or None
        What went wrong with the run as a whole.
    """

    submission: str = ""
    kernel: str | None = None
    unreadable: str | None = None
    repairs: tuple[str, ...] = ()
    trouble: str | None = None

    def remarks(self) -> tuple[str, ...]:
        """Everything that can be said about the notebook as a whole, in words that can be forwarded."""
        return (*filter(None, (self.unreadable, self.trouble)), *self.repairs)


@dataclass(frozen=True)
class CheckRecord:
    """What the judge found in one answer.

    Attributes
    ----------
    note : str
        Answer note, ``"right"`` or the name of a mistake.
    share : float
        Share of the points, from 0 to 1.
    trouble : str or None
        Why the answer did not run, if it did not.
    answer : str or None
        The packet of an answer that no mistake explains, as JSON text, kept for the class report.
    """

    note: str
    share: float
    trouble: str | None = None
    answer: str | None = None


Record = TypeVar("Record", NotebookRecord, CheckRecord)


def notebook_record(nb: NotebookNode) -> NotebookRecord:
    """The record of a notebook; an empty one if grading has not written any."""
    return _read(NotebookRecord, nb.metadata) or NotebookRecord()


def check_record(cell: NotebookNode) -> CheckRecord | None:
    """The record of a check cell, None if it was not judged."""
    return _read(CheckRecord, cell.metadata)


def write_record(node: NotebookNode, record: NotebookRecord | CheckRecord) -> None:
    """Write the record of a notebook or of a check cell; what says nothing is left out."""
    found: dict[str, Any] = {"version": VERSION}
    for field in fields(record):
        value = getattr(record, field.name)
        if field.default is MISSING or value != field.default:
            found[field.name] = list(value) if isinstance(value, tuple) else value
    node.metadata[KEY] = found


def _read(kind: type[Record], metadata: NotebookNode) -> Record | None:
    found = metadata.get(KEY)
    if not isinstance(found, dict) or not (values := _upgraded(found)):
        return None
    known = {field.name: field.default is MISSING for field in fields(kind)}
    if any(required and name not in values for name, required in known.items()):
        return None
    values = {name: tuple(value) if isinstance(value, list) else value for name, value in values.items()}
    return kind(**{name: value for name, value in values.items() if name in known})


def _upgraded(found: dict[str, Any]) -> dict[str, Any]:
    """A record as the present version writes it; empty if it was written by a later version."""
    # Version 1 wrote no number and had the same keys.
    version = found.get("version", 1)
    return {**found, "version": VERSION} if version in (1, VERSION) else {}
