"""The question's own answers, right and mistaken, taken through the same wire and reader as a student's answer."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import lru_cache

from dhkit import wire
from dhkit.forms import Form

from .decode import Decoded, Malformed, decode
from .kinds import read
from .question import Family, Question, Way, take
from .tree import IMPOSSIBLE

# Results of one function that are remembered: more than any question has argument lists.
MOST_RESULTS = 256


def expected_answer(question: Question, ways: tuple[Way, ...], student: str) -> tuple[object, bool]:
    """The answer with mistakes made in some ways, in its kind's own form; whether it is one of infinitely many."""
    return _answer(question, ways, student if question.personal else None)


def expected_result(question: Question, ways: tuple[Way, ...], student: str, args: list) -> tuple[object, bool]:
    """What the question's function returns for `args`, a `Malformed` where it fails; whether it is one of infinitely many."""
    try:
        wrong, steps = _split(ways)
        function = take(steps, _reference(question, wrong, student if question.personal else None))
        result, family = _unwrap(function(*args))
    except IMPOSSIBLE as error:
        return Malformed(f"no value: {error}"), False
    return read_result(question.returns, decode(wire.encode(result))), family


def read_result(form: Form, result: Decoded) -> object:
    """A decoded result of a function in its kind's own form, or the complaint about it."""
    try:
        return read(form, result)
    except Malformed as fault:
        return fault


@lru_cache(maxsize=8192)
def _answer(question: Question, ways: tuple[Way, ...], student: str | None) -> tuple[object, bool]:
    wrong, steps = _split(ways)
    answer, family = _unwrap(_reference(question, wrong, student))
    return _read(question, json.dumps(wire.encode(take(steps, answer)))), family


@lru_cache(maxsize=8192)
def _read(question: Question, sent: str) -> object:
    """An answer as the wire carries it, read: two mistakes mostly come to the same whichever is made first."""
    return read(question.form, decode(json.loads(sent)))


@lru_cache(maxsize=1024)
def _reference(question: Question, ways: tuple[Way, ...], student: str | None) -> object:
    """The question's own answer before any step; steps make new ones of it and leave it as it is."""
    wrong = {name: value for way in ways for name, value in (way.wrong or {}).items()}
    answer = question.compute(student or "", wrong)
    return _remember(answer) if question.form.kind == "function" else answer


def _split(ways: tuple[Way, ...]) -> tuple[tuple[Way, ...], list]:
    """The ways that the reference goes, and the steps behind them."""
    return tuple(way for way in ways if way.step is None), [way.step for way in ways if way.step is not None]


def _unwrap(answer: object) -> tuple[object, bool]:
    return (answer.solutions, True) if isinstance(answer, Family) else (answer, False)


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
