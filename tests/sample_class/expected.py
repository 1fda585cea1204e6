"""The sample class as data: who hands in what, and what each submission must earn.

``students/*.toml`` holds one table ``[<exercise>.<student>]`` per submission:

says      what this student did, one sentence
answered  questions that are answered as the instructor does; the others keep the stub (default: all are answered)
answers   question -> source of its answer cell
edits     named edits of `edits.py`, in this order: ``do`` is the name, the rest are arguments
score     the points of the whole submission
notes     question -> answer note, where it is not "right"; ``"*"`` stands for all questions not named
remarks   words that the line of the class table must contain
harmful   true if it could do harm, or learn the answers, on a machine without a sandbox
stock     true if the comparison with stock nbgrader, and the short class, include it

``@COURSE@`` and ``@REPOSITORY@`` in a source stand for the two folders. Scores and notes are written by hand, from
reading the questions: they judge the grader, so the grader must never write them.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Submission:
    """One table of ``students/*.toml`` (see above)."""

    exercise: str
    student: str
    says: str
    score: float
    notes: dict[str, str] = field(default_factory=dict)
    answered: tuple[str, ...] | None = None
    answers: dict[str, str] = field(default_factory=dict)
    edits: tuple[dict, ...] = ()
    remarks: tuple[str, ...] = ()
    harmful: bool = False
    stock: bool = False

    def note(self, question: str) -> str:
        """The expected answer note of a question, named without its exercise."""
        return self.notes.get(question, self.notes.get("*", "right"))


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
    try:
        return Submission(exercise, student, **{**table, **lists})
    except TypeError as error:
        raise ValueError(f"{exercise}.{student}: {error}") from None
