"""The question's own answers, right and mistaken, taken through the same wire and reader as a student's answer."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

from dhkit import wire
from dhkit.forms import Form

from .decode import Decoded, Malformed, decode
from .kinds import read
from .question import Answer, Family, Question, Step, Way, take
from .tree import IMPOSSIBLE

# Results of one function that are remembered: more than any question has argument lists.
MOST_RESULTS = 256


@dataclass(frozen=True)
class Expected:
    """What the question itself answers.

    Attributes
    ----------
    forms : tuple
        The answer as its kind holds it; several where a student may give one or another. `Malformed` for a function
        that fails.
    family : bool
        True if infinitely many solutions are right, of which the one form shows some.
    """

    forms: tuple[object, ...]
    family: bool = False


def expect_answer(question: Question, ways: tuple[Way, ...], student: str) -> Expected:
    """The right answer, or the one with mistakes made in some ways."""
    return _answer(question, ways, student if question.personal else None)


def expect_result(question: Question, ways: tuple[Way, ...], student: str, args: list) -> Expected:
    """What the question's function returns for `args`, right or with mistakes made in some ways."""
    wrong, steps = _split(ways)
    try:
        result = _reference(question, wrong, student if question.personal else None)(*args)
        results = _take_any(steps, result) if ways else [_list(result)]
        return Expected(
            tuple(read_result(question.returns, decode(wire.encode(one))) for one in results),
            isinstance(result, Family) and not ways,
        )
    except IMPOSSIBLE as error:
        return Expected((Malformed(f"no value: {error}"),))


def read_result(form: Form, result: Decoded) -> object:
    """A decoded result of a function in its kind's own form, or the complaint about it."""
    try:
        return read(form, result)
    except Malformed as fault:
        return fault


@lru_cache(maxsize=8192)
def _answer(question: Question, ways: tuple[Way, ...], student: str | None) -> Expected:
    wrong, steps = _split(ways)
    answer = _reference(question, wrong, student)
    answers = _take_any(steps, answer) if ways else [_list(answer)]
    return Expected(
        tuple(_read(question, json.dumps(wire.encode(one))) for one in answers), isinstance(answer, Family) and not ways
    )


@lru_cache(maxsize=8192)
def _read(question: Question, sent: str) -> object:
    """An answer as the wire carries it, read: two mistakes mostly come to the same whichever is made first."""
    return read(question.form, decode(json.loads(sent)))


@lru_cache(maxsize=1024)
def _reference(question: Question, ways: tuple[Way, ...], student: str | None) -> Answer:
    """The question's own answer before any step; steps make new ones of it and leave it as it is."""
    wrong = {name: value for way in ways for name, value in (way.wrong or {}).items()}
    answer = question.compute(student or "", wrong)
    return _remember(answer) if question.form.kind == "function" else answer


def _split(ways: tuple[Way, ...]) -> tuple[tuple[Way, ...], list[Step]]:
    """The ways that the reference goes, and the steps behind them."""
    return tuple(way for way in ways if way.step is None), [way.step for way in ways if way.step is not None]


def _list(answer: Answer) -> Answer:
    return answer.solutions if isinstance(answer, Family) else answer


def _take_any(steps: list[Step], answer: Answer) -> list[Answer]:
    """The answer after the steps; of a family, after the steps on each choice of its representatives."""
    if not isinstance(answer, Family):
        return [take(steps, answer)]
    count = len(answer.solutions)
    choices = (choice for size in range(1, count + 1) for choice in combinations(answer.solutions, size))
    return [take(steps, list(choice)) for choice in choices]


def _remember(function: Callable) -> Callable:
    """`function`, asked once for the same arguments: all mistakes of a tree are made from the same right results."""
    known: dict[str, object] = {}

    def answer(*args):
        key = repr(args)
        if key not in known:
            if len(known) >= MOST_RESULTS:
                known.clear()
            known[key] = function(*args)
        return known[key]

    return answer
