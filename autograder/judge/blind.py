"""Answers that can be made without reading the question: only what is right beyond them is worth a part of the points.

Most cells of a marked matrix are unmarked, most rows of a table hold nothing but their joint. An answer that was not
recognised earns the share of its right parts, counted from what the luckiest of these answers has right: a part that is
right in it anyway earns nothing, and costs something where it is wrong.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from dhkit.forms import Form

from .decode import Blank, Expression, Number, Symbol
from .expected import expect_answer
from .kinds import Comparison, Entries, compare
from .question import Question


def beyond_guessing(question: Question, student: str, found: Comparison) -> float:
    """The share of the parts that are right beyond a blind answer's; all of it where there is but one slip."""
    if found.equal or found.slip:
        return found.share
    guessed = _guessed(question, student if question.personal else None)
    return max(0.0, (found.share - guessed) / (1 - guessed))


@lru_cache(maxsize=1024)
def _guessed(question: Question, student: str | None) -> float:
    """The largest share that a blind answer has right without being right."""
    (right, *_) = expect_answer(question, (), student or "").forms
    if not isinstance(right, Entries):
        return 0.0
    setting = replace(question.setting(), patient=True)
    compared = (compare(question.form, blind, right, setting) for blind in _blind_answers(question.form, right))
    return max((one.share for one in compared if not one.equal), default=0.0)


def is_blind(form: Form, answer: Entries, right: Entries, samples: Mapping[str, np.ndarray]) -> bool:
    """Whether an answer could have been made without reading the question: no slip explains it, whatever it is equal to."""
    values = answer.values(samples)
    if not np.isfinite(values).all():
        return True
    constant = bool(np.abs(values - values[:1]).max() == 0)
    if constant and (np.abs(values[0] - values[0, 0]).max() == 0) and (form.symbols or form.shape):
        return True
    if form.kind == "expression" and isinstance(answer.expressions[0], Symbol):
        return True
    return any(np.array_equal(values, blind.values(samples)) for blind in _blind_answers(form, right))


def _blind_answers(form: Form, right: Entries) -> Iterator[Entries]:
    """The same number everywhere, one of those that occur; the identity; rows that hold nothing but their joint."""
    zero, count = Number(0), len(right.expressions)
    if form.kind == "transform":
        identity = np.eye(form.shape[0], dtype=int).ravel().tolist()
        yield Entries(tuple(map(Number, identity)))
        return
    for number in dict.fromkeys((zero, *filter(_is_whole, right.expressions))):
        yield Entries((number,) * count)
    joints = getattr(form, "joints", ()) or tuple(name for name in form.symbols if name.startswith(("t", "q")))
    yield Entries(
        tuple(entry if isinstance(entry, Symbol) and entry.name in joints else zero for entry in right.expressions)
    )


def _is_whole(entry: Expression | Blank) -> bool:
    return isinstance(entry, Number) and isinstance(entry.value, int)
