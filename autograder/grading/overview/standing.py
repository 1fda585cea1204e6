"""Who did what over the term: points, mistakes that stay, and who is falling behind."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from statistics import mean, median, quantiles

from autograder.judge.clusters import is_unexplained

from ..report.statistics import NOTHING_CAME, RIGHT

OTHERS_NUMBERS = "numbers_of_another_student"
# With fewer the lowest quarter says nothing.
_ENOUGH = 8
# Against the median of the class: a fall of this share of the points, from the exercises before to each of the last two.
_FALL = 0.25
_LAST = 2


@dataclass(frozen=True)
class Answer:
    """One question of one submission; `told` is what the student was told first."""

    question: str
    score: float
    max_score: float
    note: str
    told: str = ""

    @property
    def is_wrong(self) -> bool:
        """Whether there was an answer, and it was not right."""
        return self.note not in (*RIGHT, *NOTHING_CAME)

    @property
    def mistakes(self) -> tuple[str, ...]:
        """The names of the mistakes in it; those of two mistakes at once stand apart."""
        if not self.is_wrong or is_unexplained(self.note) or self.note == OTHERS_NUMBERS:
            return ()
        return tuple(self.note.split("+"))


@dataclass(frozen=True)
class Work:
    """One exercise of one student.

    Attributes
    ----------
    status : str
        ``"graded"``, ``"missing"``, ``"no notebook"``; ``"not graded"`` yet, ``"open"`` (there is time left),
        ``"exempt"``: these three do not count.
    score : float
        What being late cost is taken off; a bonus is in it.
    late : str
        How late it was and what that cost, in words.
    team : str
        The group that handed in for this student; empty if it is the student's own.
    """

    exercise: str
    status: str
    score: float = 0.0
    max_score: float = 0.0
    answers: tuple[Answer, ...] = ()
    late: str = ""
    team: str = ""
    remarks: tuple[str, ...] = ()

    @property
    def counts(self) -> bool:
        return self.status in ("graded", "missing", "no notebook")

    @property
    def share(self) -> float:
        """Of the points; more than 1 with a bonus."""
        return self.score / self.max_score if self.max_score else 0.0


@dataclass(frozen=True)
class Student:
    """One student over the term; `works` has one entry for each exercise, in their order."""

    id: str
    name: str
    works: tuple[Work, ...]

    @cached_property
    def counting(self) -> tuple[Work, ...]:
        return tuple(work for work in self.works if work.counts)

    @property
    def mean(self) -> float | None:
        """Mean share of the points; None where nothing counts yet."""
        return mean(work.share for work in self.counting) if self.counting else None

    @cached_property
    def stays(self) -> dict[str, tuple[str, ...]]:
        """Mistakes that were made in several exercises, with those exercises."""
        return {note: where for note, where in _where(self.works).items() if len(where) > 1}


@dataclass(frozen=True)
class Exercise:
    """One exercise over the class: shares of the points of those who handed in, and how many are missing or late."""

    name: str
    shares: tuple[float, ...]
    missing: int
    late: int

    @property
    def median(self) -> float:
        return median(self.shares)

    @property
    def lowest_quarter(self) -> float:
        """Below this share is the lowest quarter of the class; nobody is where it is too small to tell."""
        return quantiles(self.shares, n=4, method="inclusive")[0] if len(self.shares) >= _ENOUGH else 0.0


@dataclass(frozen=True)
class Staying:
    """A mistake over the class: how many made it in each exercise, and how many again in a later one."""

    note: str
    counts: tuple[int, ...]
    again: int


def of_class(name: str, works: Iterable[Work]) -> Exercise:
    """The class on one exercise."""
    found = [work for work in works if work.exercise == name]
    graded = tuple(work.share for work in found if work.status == "graded")
    late = sum(bool(work.late) for work in found)
    return Exercise(name, graded, sum(work.counts for work in found) - len(graded), late)


def falling_behind(student: Student, exercises: Sequence[Exercise]) -> tuple[str, ...]:
    """Why one should talk to a student, in words; empty if there is no sign.

    One exercise is no sign of anything.
    """
    works, by_name = student.counting, {one.name: one for one in exercises}
    if len(works) < _LAST:
        return ()
    missed = [work.status != "graded" for work in works]
    handed_in = [work for work in works if work.status == "graded"]
    if not handed_in:
        return (f"handed in none of {len(works)} exercises",)
    signs = []
    since = missed[::-1].index(False)
    if since >= _LAST:
        signs.append(f"nothing in the last {since} exercises")
    elif sum(missed) >= _LAST:
        signs.append(f"{sum(missed)} of {len(works)} exercises missing")
    last = handed_in[-_LAST:]
    if len(last) == _LAST and all(
        work.share < 0.5 and work.share < by_name[work.exercise].lowest_quarter for work in last
    ):
        signs.append("less than half of the points, and in the lowest quarter, twice in a row")
    gaps = [work.share - by_name[work.exercise].median for work in handed_in]
    if len(gaps) >= 2 * _LAST:
        before, now = mean(gaps[:-_LAST]), gaps[-_LAST:]
        if before - max(now) >= _FALL:
            signs.append(f"falling: {_against(before)}, in the last two exercises {_against(mean(now))}")
    return tuple(signs)


def _against(gap: float) -> str:
    return f"{abs(gap):.0%} of the points {'above' if gap >= 0 else 'below'} the class's median"


def staying(students: Iterable[Student], exercises: Sequence[str]) -> list[Staying]:
    """Mistakes that were made again in a later exercise, those that stay with most students first."""
    made: Counter[tuple[str, str]] = Counter()
    again: Counter[str] = Counter()
    for student in students:
        for note, where in _where(student.works).items():
            made.update((note, name) for name in where)
            again[note] += len(where) > 1
    found = [Staying(note, tuple(made[note, name] for name in exercises), count) for note, count in again.items()]
    return sorted((one for one in found if one.again), key=lambda one: (-one.again, -sum(one.counts), one.note))


def _where(works: Iterable[Work]) -> dict[str, tuple[str, ...]]:
    found: dict[str, dict[str, None]] = {}
    for work in works:
        for answer in work.answers:
            for note in answer.mistakes:
                found.setdefault(note, {})[work.exercise] = None
    return {note: tuple(names) for note, names in found.items()}
