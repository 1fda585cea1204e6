"""Wrong answers that no misconception explains, put together where they say the same: the next ones to name.

What students handed in outlives grading as text, `keep`; it is decoded again as strictly as the first time, `kept`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from dhkit import wire

from .decode import Blank, Malformed, Number, Value, decode_answer
from .kinds import KINDS, Setting
from .question import Question, Variant

UNEXPLAINED = frozenset({"nothing_matched", "partly_right", "malformed"})
MAX_KEPT = 20_000


def is_unexplained(note: str) -> bool:
    """True for the note of a wrong answer in which no misconception was found."""
    return note in UNEXPLAINED


def keep(question: str, bundle: object) -> str | None:
    """The bundle of an answer as JSON text; None if it is longer than `MAX_KEPT` characters or cannot be decoded."""
    try:
        decode_answer(bundle, question)
        text = json.dumps(bundle, separators=(",", ":"))
    except (Malformed, ValueError):
        return None
    return text if len(text) <= MAX_KEPT else None


def kept(question: str, text: object) -> Value | None:
    """The answer inside a text made by `keep`; None if it is anything else."""
    if not isinstance(text, str) or len(text) > MAX_KEPT:
        return None
    try:
        return decode_answer(json.loads(text), question)
    except (ValueError, RecursionError):
        return None


@dataclass(frozen=True)
class Attempt:
    """One student's unexplained answer: what the judge said about it, and the answer, if it was kept."""

    student: str
    said: str
    answer: Value | None = None


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
    def said(self) -> str:
        return self.attempts[0].said

    @property
    def students(self) -> tuple[str, ...]:
        return tuple(attempt.student for attempt in self.attempts)


def cluster(question: Question, attempts: Iterable[Attempt]) -> tuple[Cluster, ...]:
    """Clusters of equal answers, the largest first.

    Equal answers make the judge say the same, so only those are compared. What cannot be compared goes by the
    judge's words alone: functions, answers in another form, and answers to a question with other numbers for
    each student.
    """
    by_words: dict[str, list[Attempt]] = {}
    for attempt in sorted(attempts, key=lambda attempt: attempt.student):
        by_words.setdefault(attempt.said, []).append(attempt)
    found = [cluster for same_words in by_words.values() for cluster in _by_value(question, same_words)]
    return tuple(sorted(found, key=lambda cluster: -len(cluster.attempts)))


def right_answer(question: Question, student: str) -> Value | None:
    """The question's own answer for `student`, as if it had been handed in; None for a function."""
    if question.public.kind == "function":
        return None
    answer = wire.bundle(question.id, answer=wire.encode(question.reference(Variant(student))))
    return decode_answer(answer, question.id)


def _by_value(question: Question, attempts: list[Attempt]) -> list[Cluster]:
    forms = {attempt.student: _form(question, attempt) for attempt in attempts}
    comparable = [attempt for attempt in attempts if forms[attempt.student] is not None]
    if comparable and len({repr(right_answer(question, attempt.student)) for attempt in comparable}) > 1:
        comparable = []
    heaps: list[list[Attempt]] = []
    for attempt in comparable:
        mine = forms[attempt.student]
        same = (heap for heap in heaps if heap[0].answer == attempt.answer or mine.equals(forms[heap[0].student]))
        heap = next(same, None)
        if heap is None:
            heaps.append([attempt])
        else:
            heap.append(attempt)
    others = [attempt for attempt in attempts if attempt not in comparable]
    clusters = [Cluster(tuple(heap), True) for heap in heaps]
    return clusters + ([Cluster(tuple(others), False)] if others else [])


@dataclass(frozen=True, eq=False)
class _Form:
    """An answer in its kind's own form; what was left blank is held apart, because blanks have no value."""

    question: Question
    value: object
    blanks: Value

    def equals(self, other: _Form) -> bool:
        if self.blanks != other.blanks:
            return False
        question = self.question
        setting = Setting(question.points(), question.angles, question.tolerance, question.pinned)
        with np.errstate(all="ignore"):
            return KINDS[question.public.kind].compare(question.public, self.value, other.value, setting).equal


def _form(question: Question, attempt: Attempt) -> _Form | None:
    if attempt.answer is None or question.public.kind not in KINDS:
        return None
    try:
        value = KINDS[question.public.kind].read(question.public, _filled(attempt.answer))
    except Malformed:
        return None
    return _Form(question, value, _blanks(attempt.answer))


def _filled(answer: Value) -> Value:
    if isinstance(answer, tuple):
        return tuple(map(_filled, answer))
    return Number(0) if isinstance(answer, Blank) else answer


def _blanks(answer: Value) -> Value | bool:
    return tuple(map(_blanks, answer)) if isinstance(answer, tuple) else isinstance(answer, Blank)
