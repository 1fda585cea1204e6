"""Every student's own numbers: lengths, targets, postures, derived in the open from the student's id.

An id leads to one of a pool of sets of numbers, so that verdicts can be sealed for each of them.

The ranges stand in the table ``[variant]`` of ``dhkit/questions/<exercise>.toml``. The grader takes the id from its
gradebook and derives the same numbers, on any machine: a text is hashed (SHA-256), nothing is drawn.
"""

from __future__ import annotations

import hashlib
import unicodedata
from functools import cache
from importlib.resources import files
from itertools import count

from .public import variant_ranges

NOBODY = "nobody"
LIST = "ids.txt"
"""Beside this module in what students get: the marks of the ids of the course, one a line."""
SETS = 64
"""Sets of numbers of an exercise."""

_typed: dict[str, str] = {}


def number_set(exercise: str, student: str) -> int:
    """Which of the `SETS` sets of numbers is the student's: the SHA-256 of "<exercise> <id>" modulo `SETS`.

    The id counts in its normal form.
    """
    return _hash(f"{exercise} {normal_form(student)}") % SETS


def numbers_of_set(exercise: str, which: int) -> dict[str, float | str]:
    """The numbers of one set of `exercise`, by name; empty if the exercise is the same for everybody.

    A range ``[lowest, highest, step]`` gives ``lowest + k * step``, a list of texts gives one of them; k, counted from
    0, is the SHA-256 of "<exercise> <name> <which>" modulo the number of values.
    """
    return {name: _pick(range_, f"{exercise} {name} {which}") for name, range_ in variant_ranges(exercise).items()}


def numbers(exercise: str, student: str) -> dict[str, float | str]:
    """The numbers of `student` for `exercise`, by name."""
    return numbers_of_set(exercise, number_set(exercise, student))


@cache
def member(exercise: str, which: int) -> str:
    """An id, nobody's, that leads to the set `which`."""
    return next(id for number in count() if number_set(exercise, id := f"set {which}, {number}") == which)


def normal_form(student: str) -> str:
    """An id as it is compared: small letters without accents, and digits; nothing else counts.

    Learning platforms leave out apostrophes, systems write accents in several ways, and people type what they like. An
    id without letters and digits is all that is left of it without blanks.
    """
    folded = unicodedata.normalize("NFKD", unicodedata.normalize("NFKD", student).casefold())
    return "".join(filter(str.isalnum, folded)) or "".join(folded.split())


def mark(student: str) -> str:
    """What stands for an id in the list of the course, which so names nobody."""
    return hashlib.sha256(f"id {normal_form(student)}".encode()).hexdigest()[:12]


def is_listed(student: str) -> bool:
    """Whether an id is in the list of the course; True where there is no list."""
    marks = _marks()
    return marks is None or mark(student) in marks


@cache
def _marks() -> frozenset[str] | None:
    file = files(__package__) / LIST
    return frozenset(file.read_text(encoding="ascii").split()) if file.is_file() else None


def _pick(range_: tuple, text: str) -> float | str:
    chance = _hash(text)
    if isinstance(range_[0], str):
        return range_[chance % len(range_)]
    lowest, highest, step = range_
    return round(lowest + chance % (round((highest - lowest) / step) + 1) * step, 9)


def _hash(text: str) -> int:
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big")


class OwnNumbers(dict):
    """Numbers by name: ``mine["L1"]`` or ``mine.L1``."""

    student: str

    def __getattr__(self, name: str) -> float | str:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no number {name!r}; there are {', '.join(self)}") from None

    def _repr_markdown_(self) -> str:
        whose = f"Numbers of **{self.student}**"
        if self.student == NOBODY:
            whose = "**Nobody's numbers: type your id above**"
        elif not is_listed(self.student):
            whose = f"**{self.student} is not in the list of the course; type your id as it stands there.** Numbers"
        return f"{whose}: " + ", ".join(f"{name} = {value}" for name, value in self.items())


def variant(exercise: str, student=...) -> OwnNumbers:
    """Your own numbers for `exercise`.

    Parameters
    ----------
    exercise : str
    student : str
        Your id, as in the list of the course. ``...`` gives numbers to look around with, which are nobody's.

    Raises
    ------
    ValueError
        If `student` is no text.
    """
    if student is ...:
        student = NOBODY
    if not isinstance(student, str):
        raise ValueError(f'your id is a text, for example "ada"; found {student!r}')
    student = student.strip() or NOBODY
    mine = OwnNumbers(numbers(exercise, student))
    mine.__dict__["student"] = student
    _typed[exercise] = mine.student
    return mine


def typed(exercise: str) -> str | None:
    """The id that was typed in this session for `exercise`, None if no numbers were asked for."""
    return _typed.get(exercise)
