"""Entries of numbers, expressions, vectors, matrices, transforms and tables: compared by their values at sample points.

Two entries count as equal when they agree at every one of N = 12 points that are drawn once per question, angles in
(-pi, pi] and lengths in (0.2, 1.5) metres unless the question draws otherwise. An answer that is wrong by more than the
tolerance on a share p of that region passes with probability (1 - p)^12: an analytic expression, which can only be
right on a set of measure zero without being right everywhere, does not pass; one that is wrong on half of the region
(a lost quadrant, a branch of a root) passes one draw in 4096, and the draw of a question is fixed and tested.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from dhkit.forms import Form
from dhkit.geometry import wrap

from .. import angles
from ..decode import Blank, Expression, Number, Value
from ..evaluate import evaluate, evaluate_exactly, size
from .base import Comparison, Setting

T = TypeVar("T")

# No more than so many nodes of an answer are recomputed with forty digits: bounded time counts for more.
MAX_EXACT_NODES = 3000


@dataclass(frozen=True, eq=False)
class Entries:
    """The scalars of an answer, row after row.

    Attributes
    ----------
    expressions : tuple
        Decoded expressions, `Blank` where nothing was filled in; empty where only values are known.
    known : (N, m) array, optional
        Their values, where they were not given as expressions.
    """

    expressions: tuple[Expression | Blank, ...] = ()
    known: np.ndarray | None = None
    _kept: dict = field(default_factory=dict, repr=False)
    _meant: dict = field(default_factory=dict, repr=False)

    def values(self, samples: Mapping[str, np.ndarray]) -> np.ndarray:
        """Complex values at N points, (N, m), computed once; nan where nothing was filled in or nothing is defined."""
        if self.known is not None:
            return self.known

        def evaluated() -> np.ndarray:
            count = len(next(iter(samples.values()), np.zeros(1)))
            columns = [
                np.full(count, np.nan) if isinstance(e, Blank) else evaluate(e, samples) for e in self.expressions
            ]
            return np.stack(columns, axis=1).astype(complex)

        return self.once("values", samples, evaluated)

    def meant(self, decimals: int = angles.ENOUGH) -> Entries | None:
        """The same with rounded constant angles read as exact (see `judge.angles`); None where nothing changes."""
        if decimals not in self._meant:
            exact = tuple(e if isinstance(e, Blank) else angles.meant(e, decimals) for e in self.expressions)
            self._meant[decimals] = None if exact == self.expressions else Entries(exact)
        return self._meant[decimals]

    def once(self, what: str, samples: Mapping[str, np.ndarray], make: Callable[[], T]) -> T:
        """What `make` returns; made once for the same sample points, as one answer is compared with many."""
        if (kept := self._kept.get(what)) is None or kept[0] is not samples:
            kept = self._kept[what] = samples, make()
        return kept[1]

    def kept(self, what: str, samples: Mapping[str, np.ndarray]) -> Any:
        """What was made `once` for the same sample points, None if it was not."""
        known = self._kept.get(what)
        return known[1] if known is not None and known[0] is samples else None


def flat(value: Value) -> tuple:
    """The scalars of nested tuples, row after row."""
    return tuple(scalar for item in value for scalar in flat(item)) if isinstance(value, tuple) else (value,)


def read_entries(form: Form, value: Value) -> Entries:
    return Entries(flat(value))


def real_values(value: Value) -> np.ndarray:
    """The values (m,) of m constant expressions that are known to be real."""
    return np.array([_constant(expression) for expression in flat(value)], dtype=float)


def _constant(expression: Expression) -> float:
    if isinstance(expression, Number) and isinstance(expression.value, float):
        return expression.value
    return float(evaluate(expression, {})[0].real)


def depends_on(entries: Entries, samples: Mapping[str, np.ndarray]) -> set[str]:
    """The symbols that change some value when they change."""
    here = Entries(entries.expressions).values(samples)

    def acts(name: str) -> bool:
        there = Entries(entries.expressions).values({**samples, name: samples[name] + 0.37})
        return not np.allclose(here, there, rtol=1e-6, atol=1e-6, equal_nan=True)

    return {name for name in samples if acts(name)}


def agreement(student: Entries, other: Entries, setting: Setting, turning: Sequence[bool] | np.ndarray) -> np.ndarray:
    """Which of m entries agree at every sample point, (m,) booleans; where `turning` says so, modulo 2 pi."""
    theirs, ours = student.values(setting.samples), other.values(setting.samples)
    turning = np.asarray(turning, bool)
    with np.errstate(all="ignore"):
        error = np.abs(difference(theirs, ours, turning)) / np.maximum(1, np.abs(ours))
    error[theirs == ours] = 0  # also where a size is beyond float64
    agree = (error <= setting.tolerance + setting.slack).all(axis=0)
    if student.expressions and other.expressions:
        for i in np.flatnonzero(~agree & ~np.isfinite(error).all(axis=0)):  # beyond float64, the same is the same
            same = student.expressions[i] == other.expressions[i]
            agree[i] = same and not isinstance(student.expressions[i], Blank)
    # Cancellation in float64 may spoil a right answer; forty digits decide where the values are close, or the reader patient.
    doubtful = ~agree & ((error < 1e-3).all(axis=0) | setting.patient)
    if student.expressions and other.expressions:
        left = MAX_EXACT_NODES
        for i in np.flatnonzero(doubtful):
            theirs_exactly, ours_exactly = student.expressions[i], other.expressions[i]
            if isinstance(theirs_exactly, Blank) or isinstance(ours_exactly, Blank):
                continue
            left -= size(theirs_exactly)
            if left < 0:
                break
            agree[i] = _agree_exactly(theirs_exactly, ours_exactly, setting, turning[i])
    return agree


def difference(a: ArrayLike, b: ArrayLike, angles: ArrayLike) -> np.ndarray:
    """a - b, the real part of angles in (-pi, pi]."""
    found = np.subtract(a, b)
    if not np.any(angles):
        return found
    return np.where(angles, wrap(found.real) + 1j * found.imag, found)


def _agree_exactly(student: Expression, other: Expression, setting: Setting, angle: bool) -> bool:
    draws = list(zip(*setting.samples.values(), strict=True)) or [()]
    for values in draws:
        point = dict(zip(setting.samples, values, strict=True))
        theirs, ours = evaluate_exactly(student, point), evaluate_exactly(other, point)
        if theirs is None or ours is None:
            return False
        with np.errstate(all="ignore"):
            # np.abs, as the abs of a huge complex number overflows.
            gap = np.abs(difference(np.complex128(complex(theirs - ours)), np.complex128(0), angle))
        if not gap <= setting.tolerance * max(1, abs(complex(ours))):
            return False
    return True


def compare_entries(names: Sequence[str], student: Entries, other: Entries, setting: Setting) -> Comparison:
    """A number, an expression or a vector, entry by entry; `names` of its entries where they have some."""
    count = len(student.expressions)
    agree = agreement(student, other, setting, [i in setting.angles for i in range(count)])
    differ = [names[i] if names else str(i + 1) for i in np.flatnonzero(~agree).tolist()]
    remarks: tuple[str, ...] = ()
    if count > 1 and differ:
        entry = differ[0] if names else f"entry {differ[0]}"
        remarks = (f"only {entry} differs" if len(differ) == 1 else f"these entries differ: {listed(differ)}",)
    return Comparison(bool(agree.all()), float(agree.mean()), remarks)


def listed(names: Sequence[str]) -> str:
    """``a, b and c``."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


_PLURAL = {"matrix": "matrices", "row": "rows"}


def differing_cells(agree: np.ndarray) -> tuple[str, ...]:
    """Which cells of a matrix, or of a list of matrices, do not agree, in words; of many, in which rows or matrices."""
    names = ("matrix", "row", "column")[-agree.ndim :]
    places = (np.argwhere(~agree) + 1).tolist()
    wrong = [", ".join(f"{name} {k}" for name, k in zip(names, place, strict=True)) for place in places]
    if not wrong:
        return ()
    if len(wrong) == 1:
        return (f"only one cell differs: {wrong[0]}",)
    if len(wrong) <= 4:
        return (f"{len(wrong)} cells differ: {'; '.join(wrong)}",)
    which = sorted({str(place[0]) for place in places})
    where = f"{_PLURAL[names[0]]} {listed(which)}" if len(which) > 1 else f"{names[0]} {which[0]}"
    return (f"{len(wrong)} cells differ, in {where}",)
