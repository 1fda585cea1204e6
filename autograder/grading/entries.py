"""What a verdict is in nbgrader's gradebook: a score on its check cell and a comment on its answer cell."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from nbgrader.api import SubmittedAssignment

from .cells import answer_id

_COMMENT = re.compile(r"note: ([a-z0-9_+]+)\Z")


@dataclass(frozen=True)
class Entry:
    """One question of one submission, as the gradebook holds it.

    Attributes
    ----------
    check : str
        Id of the check cell.
    score, max_score : float
        Points, by hand if a lecturer changed them, and the most that can be had.
    note : str or None
        Answer note; None before the question is judged.
    """

    check: str
    score: float
    max_score: float
    note: str | None


def score(share: float, max_score: float) -> float:
    """Points for a share of `max_score`, to a hundredth.

    Raises
    ------
    ValueError
        If `share` lies outside 0 to 1: nbgrader reads a negative or odd score as full marks.
    """
    if not 0 <= share <= 1:
        raise ValueError(f"a share of the points must lie between 0 and 1, found {share}")
    return max_score if share == 1 else min(round(share * max_score, 2), max_score)


def comment(note: str) -> str:
    """The comment that stands for an answer note in the gradebook."""
    return f"note: {note}"


def note_of(text: str | None) -> str | None:
    """The answer note in a comment, None if it is another comment."""
    found = _COMMENT.match(text or "")
    return found and found[1]


def read_entries(submission: SubmittedAssignment) -> Iterator[Entry]:
    """The entries of a submission, by id of the check cell; open problems are left out."""
    for notebook in submission.notebooks:
        notes = {found.name: note_of(found.auto_comment) for found in notebook.comments}
        judged = [grade for grade in notebook.grades if grade.cell.cell_type == "code"]
        for grade in sorted(judged, key=lambda grade: grade.name):
            yield Entry(grade.name, grade.score or 0.0, grade.max_score, notes.get(answer_id(grade.name)))
