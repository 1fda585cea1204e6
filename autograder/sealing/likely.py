"""Wrong answers that come from more than one of a question's own mistakes, or from none of them, and yet often."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from itertools import combinations, islice, permutations

import numpy as np
import sympy

from autograder.judge import Evidence, Question, Verdict, judge
from autograder.judge.question import Answer
from autograder.judge.tree import IMPOSSIBLE, UNEXPLAINED
from dhkit import wire

MOST, MOST_OPERATIONS = 48, 12_000
"""Answers that are tried for each question, and operations in all of them together: the judge needs time for long ones."""


@cache
def named(question: Question, student: str) -> tuple[tuple[Verdict, Answer], ...]:
    """Those of the likely answers to a question that the judge has a name for, with the judge's verdict."""
    most = min(MOST, MOST_OPERATIONS // max(1, _size(question.answer(student))))
    judged = (
        (judge(question, Evidence(wire.packet(question.id, answer=wire.encode(answer))), student), answer)
        for answer in islice(_likely_answers(question, student), most)
    )
    return tuple(one for one in judged if one[0].share < 1 and one[0].note not in UNEXPLAINED)


def _size(answer: Answer) -> int:
    """Operations in a symbolic answer."""
    cells = np.array(answer.tolist() if isinstance(answer, sympy.MatrixBase) else answer, dtype=object)
    return sum(int(sympy.count_ops(cell)) for cell in cells.flat if isinstance(cell, sympy.Basic))


def _likely_answers(question: Question, student: str) -> Iterator[Answer]:
    """Two of the question's mistakes at once, and the right answer with one slip in it."""
    for first, second in permutations(question.mistakes, 2):
        try:
            yield question.answer(student, first.ways[0], second.ways[0])
        except IMPOSSIBLE:
            continue
    right = question.answer(student)
    cells = np.array(right.tolist() if isinstance(right, sympy.MatrixBase) else right, dtype=object)
    yield from (cells.tolist() for cells in _slips(cells, question.form.kind == "dh_table"))


def _slips(cells: np.ndarray, is_table: bool) -> Iterator[np.ndarray]:
    symbols = sorted(set().union(*(_symbols(cell) for cell in cells.flat)), key=str)
    yield from (_replaced(cells, {one: other, other: one}) for one, other in combinations(symbols, 2))
    yield from (_replaced(cells, {symbol: -symbol}) for symbol in symbols)
    if is_table:
        for one, other in combinations(range(cells.shape[1]), 2):
            order = list(range(cells.shape[1]))
            order[one], order[other] = other, one
            yield cells[:, order]
    elif cells.ndim == 2:
        yield cells.T
    else:
        yield np.array(-cells, dtype=object)
    for place in np.ndindex(cells.shape):
        if cells[place] != 0:
            changed = cells.copy()
            changed[place] = -cells[place]
            yield changed


def _symbols(cell: object) -> set[sympy.Symbol]:
    return cell.free_symbols if isinstance(cell, sympy.Basic) else set()


def _replaced(cells: np.ndarray, swap: Mapping[sympy.Symbol, sympy.Expr]) -> np.ndarray:
    changed = np.empty(cells.shape, dtype=object)
    for place in np.ndindex(cells.shape):
        cell = cells[place]
        changed[place] = cell.xreplace(swap) if isinstance(cell, sympy.Basic) else cell
    return changed
