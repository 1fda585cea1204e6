"""Slips that may happen in any question of a kind: looked for where none of the question's own mistakes is the answer.

A name is given only where the wrong answer, recomputed, is the student's. All is done on values at the sample points, so that
hundreds of slips cost some milliseconds; no question need list any of them. Modules: `tables` for tables of
Denavit-Hartenberg parameters, `values` for numbers, vectors, expressions, matrices and transforms, `results` for joint
solutions and functions.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from dhkit.forms.dh_table import DH_COLUMNS

from ..blind import is_blind
from ..chain import SAME_MODEL
from ..chain.freedoms import Pins
from ..chain.senses import agreeing, best_senses, in_senses
from ..evaluate import size
from ..expected import expect_answer, expect_result
from ..kinds import Comparison, Entries, Setting
from ..kinds.dh_table import IN_OUR_FRAMES, rows_of
from ..question import Question
from ..tree import IMPOSSIBLE, Slip
from . import results, tables, values

__all__ = ["Slip", "explain_answer", "explain_results", "locate"]

# Larger answers than the question's own ones are not searched for slips in their single parts.
MOST_NODES = 4000


def explain_answer(
    question: Question, answer: Any, student: str, setting: Setting, compare: Callable[[object], Comparison]
) -> Slip | None:
    """The slip behind an answer that is wrong; `compare` sets a changed answer against the right one."""
    (right, *_) = expect_answer(question, (), student).forms
    if question.form.kind == "joint_solutions":
        return _explain_solutions(question, answer, compare) if np.size(answer) else None
    if not isinstance(answer, Entries) or not isinstance(right, Entries) or not question.places:
        return None
    if is_blind(question.form, answer, right, setting.samples):
        return None
    if question.form.kind == "dh_table":
        return _explain_table(question, answer, right, setting)
    if question.form.kind in ("orientation", "direction") or _is_discrete(question, right):
        return None
    asked = _asked(question, right, setting)
    return values.explain(answer.values(setting.samples), asked) if asked else None


def locate(question: Question, answer: object, student: str, setting: Setting) -> str:
    """Where a wrong expression is right, in words; empty for any other kind."""
    (right, *_) = expect_answer(question, (), student).forms
    if question.form.kind != "expression" or not isinstance(answer, Entries) or not isinstance(right, Entries):
        return ""
    asked, theirs = _asked(question, right, setting), values.without_blanks(answer.expressions)
    if asked is None or theirs is None:
        return ""
    return values.locate(answer.values(setting.samples), lambda samples: asked.values(theirs, samples), asked)


def _asked(question: Question, right: Entries, setting: Setting) -> values.Asked | None:
    entries = values.without_blanks(right.expressions)
    if entries is None or sum(map(size, entries)) > MOST_NODES:
        return None
    angles = np.array([i in setting.angles for i in range(len(entries))])
    names = tuple(getattr(question.form, "names", ()))
    return values.Asked(entries, setting.samples, question.form.shape, names, angles, setting.tolerance)


def _is_discrete(question: Question, right: Entries) -> bool:
    """Whole numbers without a unit, such as counts and marks: there every other value is a likely one."""
    numbers = right.values(question.samples)
    return not question.form.symbols and bool((numbers == np.round(numbers.real)).all())


def _explain_table(question: Question, answer: Entries, right: Entries, setting: Setting) -> Slip | None:
    theirs, ours = rows_of(answer, setting), rows_of(right, setting)
    senses = best_senses(theirs, ours, Pins(SAME_MODEL), setting.tolerance)
    if agreeing(in_senses(theirs, senses), ours, setting.tolerance).all():
        return None  # nothing but other senses of axes than those that are asked for
    joints = {name: np.zeros_like(setting.samples[name]) for name in question.form.joints}  # type: ignore[attr-defined]
    shape = (-1, *question.form.shape)
    constants = Entries(right.expressions).values({**setting.samples, **joints}).reshape(shape)
    table = tables.Table(ours, constants, DH_COLUMNS, question.columns, setting.tolerance)
    found = tables.explain(theirs, table)
    turned = answer.kept(IN_OUR_FRAMES, setting.samples)
    return found or (tables.explain(turned, table) if turned is not None else None)


def _explain_solutions(question: Question, answer: Any, compare: Callable[[object], Comparison]) -> Slip | None:
    for undoing in results.undoings(question.form, question.angles):
        if compare(results.changed(answer, undoing.change)).equal:
            return undoing.slip
    return None


def explain_results(
    question: Question,
    calls: Sequence[tuple[list, object]],
    student: str,
    compare: Callable[[list, object, object | None], Comparison],
) -> Slip | None:
    """The slip behind the results of a function; ``compare(args, result, right)`` sets one against the right result, or another.

    There is none behind results that are the same nearly everywhere.
    """
    if max(Counter(repr(result) for _, result in calls).values()) > max(1, len(calls) // 2):
        return None
    for undoing in results.undoings(question.returns, question.angles):
        if all(_is_right(compare, args, result, undoing.change) for args, result in calls):
            return undoing.slip
    for misread in results.misreadings(calls[0][0]):
        if all(_is_read_so(question, compare, args, result, misread, student) for args, result in calls):
            return misread.slip
    return None


def _is_right(compare: Callable, args: list, result: object, change: results.Change) -> bool:
    try:
        return bool(compare(args, results.changed(result, change), None).equal)
    except IMPOSSIBLE:
        return False


def _is_read_so(
    question: Question, compare: Callable, args: list, result: object, misread: results.Misread, student: str
) -> bool:
    try:
        (other, *_) = expect_result(question, (), student, misread.change(args)).forms
        return bool(compare(args, result, other).equal)
    except IMPOSSIBLE:
        return False
