"""Wrong steps on answers, for `question.mistake`: each function here returns a step, from an answer to the mistaken answer.

Vectors are lists, DH tables lists of rows ``[sigma, a, alpha, d, theta]``, symbolic answers SymPy expressions or matrices,
alone or in nested lists. A step makes a new answer and leaves the one it was given as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import sympy

from dhkit.forms.dh_table import DH_COLUMNS

from .question import Step


def replace_entry(index: int, value: object) -> Step:
    """Another value for one entry of a vector."""
    return change_entry(index, lambda _: value)


def change_entry(index: int, change: Callable) -> Step:
    """One entry of a vector changed."""
    return lambda vector: [change(entry) if i == index else entry for i, entry in enumerate(vector)]


def negate(*places: int) -> Step:
    """The entries of a vector at some places with the opposite sign."""
    return lambda vector: [-entry if i in places else entry for i, entry in enumerate(vector)]


def exchange(first: int, second: int) -> Step:
    """Two entries of a vector in each other's place."""
    places = {first: second, second: first}
    return lambda vector: [vector[places.get(i, i)] for i in range(len(vector))]


def in_each_row(step: Step) -> Step:
    """A step on a vector, taken on every row of a list of them."""
    return lambda rows: [step(row) for row in rows]


def change_cell(row: int, column: str, change: Callable) -> Step:
    """One cell of a DH table changed; rows count from 1, as on the slides."""
    return change_rows(column, change, row)


def change_rows(column: str, change: Callable, *rows: int) -> Step:
    """The cells of one column of a DH table changed in some rows, counted from 1."""
    place = DH_COLUMNS.index(column)
    return lambda table: [
        [change(cell) if k == place and i in rows else cell for k, cell in enumerate(row)]
        for i, row in enumerate(table, start=1)
    ]


def substitute(replacements: Mapping) -> Step:
    """Other expressions for some symbols, all at once."""

    def step(answer):
        if isinstance(answer, (list, tuple)):
            return [step(item) for item in answer]
        return sympy.sympify(answer).subs(replacements, simultaneous=True)

    return step
