"""The sample class as data: who hands in what, and what each answer must earn.

``students/*.toml`` holds one table ``[<exercise>.<student>]`` per submission:

says      what this student did, one sentence
answered  questions that are answered as the instructor does; the others keep the stub (default: all are answered)
answers   question -> source of its answer cell
edits     named edits of `edits.py`, in this order: ``do`` is the name, the rest are arguments
notes     question -> answer note; with its share of the points, ``["classic_table", 0.3]``, where the note does not
          settle that all or nothing is earned. A question without a note is right where it was answered, and not
          attempted where it was not; ``"*"`` stands for all questions without a note.
remarks   words that the line of the class table must contain
harmful   true if it could do harm, or learn the answers, on a machine without a sandbox
stock     true if the comparison with stock nbgrader, and the short class, include it

There are no totals: a new question, or other points, change no table. ``@COURSE@`` and ``@REPOSITORY@`` in a source stand
for the two folders. Notes and shares are written by hand, from reading the questions: they judge the grader, so the
grader must never write them.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
EARN_ALL = frozenset({"right", "right_from_earlier"})
EARN_NOTHING = frozenset({"numbers_of_another_student", "nothing_matched", "not_attempted", "malformed", "no_answer", "unreadable",
                          "error", "timeout", "memory", "output_limit", "died", "not_run"})  # fmt: skip


@dataclass(frozen=True)
class Submission:
    """One table of ``students/*.toml`` (see above)."""

    exercise: str
    student: str
    says: str
    notes: dict[str, str | list] = field(default_factory=dict)
    answered: tuple[str, ...] | None = None
    answers: dict[str, str] = field(default_factory=dict)
    edits: tuple[dict, ...] = ()
    remarks: tuple[str, ...] = ()
    harmful: bool = False
    stock: bool = False

    def expected(self, question: str) -> tuple[str, float]:
        """The expected answer note of a question, named without its exercise, and its share of the points."""
        tried = self.answered is None or question in (*self.answered, *self.answers)
        return _with_share(self.notes.get(question, self.notes.get("*", "right" if tried else "not_attempted")))


def _with_share(note: str | list) -> tuple[str, float]:
    if isinstance(note, list):
        return note[0], note[1]
    return note, 1.0 if note in EARN_ALL else 0.0


def submissions() -> list[Submission]:
    """The whole sample class, in the order of the files; `ValueError` names a table that makes no sense."""
    found = {}
    for file in sorted(HERE.glob("students/*.toml")):
        for exercise, students in tomllib.loads(file.read_text(encoding="utf-8")).items():
            for student, table in students.items():
                if (exercise, student) in found:
                    raise ValueError(f"{file.name}: {exercise}.{student} is there twice")
                found[exercise, student] = _submission(exercise, student, table)
    return list(found.values())


def _submission(exercise: str, student: str, table: dict) -> Submission:
    lists = {key: tuple(value) for key, value in table.items() if isinstance(value, list)}
    for question, note in table.get("notes", {}).items():
        if isinstance(note, str) and note not in EARN_ALL | EARN_NOTHING:
            raise ValueError(f"{exercise}.{student}: {question} has no share; write [{note!r}, SHARE]")
    try:
        return Submission(exercise, student, **{**table, **lists})
    except TypeError as error:
        raise ValueError(f"{exercise}.{student}: {error}") from None
