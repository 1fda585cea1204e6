"""Wrong answers that no misconception explains, put together where they say the same: the next ones to name.

What students handed in outlives grading as text, `keep`; it is decoded again as strictly as the first time, `recall`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from dhkit import wire

from .decode import Blank, Decoded, Function, Malformed, Number, decode, decode_answer
from .kinds import Entries, compare, read
from .probing import EXAMPLES
from .question import Family, Question
from .tree import UNEXPLAINED

MAX_KEPT = 20_000

# Measured errors, which differ between students who made the same mistake with other numbers.
_MEASURE = re.compile(r"\d+(\.\d+)?%|(?<=by )(up to )?[-+.e\d]+")


def is_unexplained(note: str) -> bool:
    """True for the note of a wrong answer in which no misconception was found."""
    return note in UNEXPLAINED


def keep(question: str, packet: object) -> str | None:
    """The packet of an answer as JSON text.

    None for a function, whose name says nothing, for what cannot be decoded, and for more than `MAX_KEPT` characters.
    """
    try:
        answer = decode_answer(packet, question)
        text = json.dumps(packet, separators=(",", ":"))
    except (ValueError, RecursionError):
        return None
    return text if len(text) <= MAX_KEPT and not isinstance(answer.value, Function) else None


def recall(question: str, text: object) -> Decoded | None:
    """The answer inside a text made by `keep`; None if it is anything else."""
    if not isinstance(text, str) or len(text) > MAX_KEPT:
        return None
    try:
        return decode_answer(json.loads(text), question)
    except (ValueError, RecursionError):
        return None


@dataclass(frozen=True)
class Attempt:
    """One student's unexplained answer.

    Attributes
    ----------
    feedback : str
        What the judge said about it.
    answer, right : decoded answer or None
        What was handed in, if it was kept, and what would have been right for this student.
    """

    student: str
    feedback: str
    answer: Decoded | None = None
    right: Decoded | None = None


@dataclass(frozen=True)
class Cluster:
    """Attempts that say the same.

    Attributes
    ----------
    attempts : tuple of Attempt
        By student; never empty.
    alike : bool
        True if the answers are equal for the question's kind of answer, False if only the judge's words are.
    """

    attempts: tuple[Attempt, ...]
    alike: bool

    @property
    def size(self) -> int:
        return len(self.attempts)

    @property
    def feedback(self) -> str:
        return self.attempts[0].feedback

    @property
    def students(self) -> tuple[str, ...]:
        return tuple(attempt.student for attempt in self.attempts)


def cluster(question: Question, attempts: Iterable[Attempt]) -> tuple[Cluster, ...]:
    """Clusters of equal answers, the largest first.

    What cannot be compared goes by the judge's words alone: functions, answers in another form, and answers to a
    question that has other numbers for each student.
    """
    attempts = sorted(attempts, key=lambda attempt: attempt.student)
    comparable = len({repr(attempt.right) for attempt in attempts}) <= 1
    alike = equal_answers(question, [attempt.answer if comparable else None for attempt in attempts])
    words: dict[str, list[int]] = {}
    for i in sorted(set(range(len(attempts))) - {i for group in alike for i in group}):
        words.setdefault(_MEASURE.sub("...", attempts[i].feedback.partition(EXAMPLES)[0]), []).append(i)
    groups = [(group, True) for group in alike] + [(group, False) for group in words.values()]
    found = [Cluster(tuple(attempts[i] for i in group), by_value) for group, by_value in groups]
    return tuple(sorted(found, key=lambda cluster: -cluster.size))


def equal_answers(question: Question, answers: Sequence[Decoded | None]) -> list[list[int]]:
    """Places of answers that are equal for the question's kind of answer; those that cannot be compared are left out."""
    forms = [_form(question, answer) for answer in answers]
    groups: list[list[int]] = []
    for i, form in enumerate(forms):
        if form is None:
            continue
        for group in groups:
            first = forms[group[0]]
            if answers[group[0]] == answers[i] or (first is not None and form.equals(first)):
                group.append(i)
                break
        else:
            groups.append([i])
    return groups


def right_answer(question: Question, student: str) -> Decoded | None:
    """The question's own answer for `student`, as if it had been handed in; None for a function."""
    if question.form.kind == "function":
        return None
    answer = question.answer(student)
    answer = answer.solutions if isinstance(answer, Family) else answer
    return decode(wire.encode(answer))


@dataclass(frozen=True, eq=False)
class _Form:
    """An answer in its kind's own form; which entries were left blank stands apart, because a blank equals nothing."""

    question: Question
    value: object
    blanks: tuple[bool, ...] = ()

    def equals(self, other: _Form) -> bool:
        if self.blanks != other.blanks:
            return False
        question = self.question
        try:
            with np.errstate(all="ignore"):
                return compare(question.form, self.value, other.value, question.setting()).equal
        except (ArithmeticError, IndexError, ValueError):
            # A kind counts on a sound answer on one side, the question's own. Here both are students'.
            return False


def _form(question: Question, answer: Decoded | None) -> _Form | None:
    if answer is None or question.form.kind == "function":
        return None
    try:
        value = read(question.form, answer)
    except Malformed:
        return None
    if not isinstance(value, Entries):
        return _Form(question, value)
    filled = tuple(Number(0) if isinstance(entry, Blank) else entry for entry in value.expressions)
    return _Form(question, Entries(filled), tuple(isinstance(entry, Blank) for entry in value.expressions))
