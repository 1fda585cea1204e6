"""What an erratum is, and how it is proved: one computed test, applied to every reading."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp


@dataclass(frozen=True)
class Proof:
    """Outcome of a check.

    printed_fails : no form that is said to be wrong passed the test.
    corrected_holds : every form that is said to be right passed it.
    detail : the test in words, and the verdict on each form.
    """

    printed_fails: bool
    corrected_holds: bool
    detail: str

    @property
    def proved(self) -> bool:
        return self.printed_fails and self.corrected_holds


@dataclass(frozen=True)
class Reading:
    """One form of a statement: in words, as something to compute with, and whether it is right."""

    words: str
    form: Any
    right: bool


@dataclass(frozen=True)
class Check:
    """A test that tells the right form of a statement from the wrong ones.

    test : the requirement in words.
    holds : computes whether a form meets it; it is not told which form it is given.
    readings : the forms, at least one wrong and one right.
    """

    test: str
    holds: Callable[[Any], bool]
    readings: tuple[Reading, ...]

    def __call__(self) -> Proof:
        found = [bool(self.holds(reading.form)) for reading in self.readings]
        lines = [f"{'holds' if ok else 'fails'}: {reading.words}" for reading, ok in zip(self.readings, found)]
        return Proof(
            not any(ok for reading, ok in zip(self.readings, found) if not reading.right),
            all(ok for reading, ok in zip(self.readings, found) if reading.right),
            "\n".join([f"Test: {self.test}.", *lines]),
        )


@dataclass(frozen=True)
class Erratum:
    """An error or an ambiguity of a course document, with the computation that settles it.

    id : short name, begins with the number of the document.
    document : its name in words. line : line of its text ("L345" or "L5-12").
    printed : what it says, in our words. corrected : what is right, or the reading to use.
    why : the reason. check : the computation; `prove` runs it.
    """

    id: str
    document: str
    line: str
    printed: str
    corrected: str
    why: str
    check: Check

    def prove(self) -> Proof:
        """Run the check: milliseconds, no side effect, the same result every time."""
        return self.check()


def against(test: str, holds: Callable[[Any], bool], printed: Any, corrected: Any, *further: Reading) -> Check:
    """The usual check: the printed form must fail, the corrected one hold."""
    return Check(
        test, holds, (Reading("as printed", printed, False), Reading("as corrected", corrected, True), *further)
    )


def agree(*expressions, draws: int = 3, tolerance: float = 1e-9) -> bool:
    """Whether sympy expressions or matrices are equal, by values at random points.

    All free symbols get the same random values, in (0.2, 1.4), in every expression; the
    draws are seeded. Different shapes are different.
    """
    matrices = [sp.Matrix([e]) if isinstance(e, (int, float, sp.Expr)) else sp.Matrix(e) for e in expressions]
    if len({m.shape for m in matrices}) != 1:
        return False
    symbols = sorted(set().union(*(m.free_symbols for m in matrices)), key=str)
    rng = np.random.default_rng(0)
    for _ in range(draws):
        values = dict(zip(symbols, map(float, rng.uniform(0.2, 1.4, len(symbols)))))
        first, *others = (np.array(m.subs(values).evalf(), float) for m in matrices)
        if any(np.abs(first - other).max() > tolerance for other in others):
            return False
    return True


def assembled(blocks) -> sp.Matrix | None:
    """The matrix of a block layout (rows of matrices or numbers), None if they do not fit."""
    rows = []
    for row in blocks:
        parts = [part if isinstance(part, sp.MatrixBase) else sp.Matrix([[part]]) for part in row]
        if len({part.rows for part in parts}) != 1:
            return None
        rows.append(sp.Matrix.hstack(*parts))
    if len({row.cols for row in rows}) != 1:
        return None
    return sp.Matrix.vstack(*rows)
