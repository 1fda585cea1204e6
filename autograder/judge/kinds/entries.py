"""Numbers, expressions, vectors, matrices and transforms: entries that are compared by their values at sample points.

Two entries count as equal when they agree at every one of N = 12 points that are drawn once per question, angles in
(-pi, pi] and lengths in (0.2, 1.5) metres unless the question draws otherwise. An answer that is wrong by more than the
tolerance on a share p of that region passes with probability (1 - p)^12: an analytic expression, which can only be
right on a set of measure zero without being right everywhere, does not pass; one that is wrong on half of the region
(a lost quadrant, a branch of a root) passes one draw in 4096, and the draw of a question is fixed and tested.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from dhkit.forms import array_shape
from dhkit.geometry import rotation_angle_between, wrap
from dhkit.public import PublicQuestion

from ..decode import Blank, Expression
from ..evaluate import evaluate, evaluate_exactly, size, symbols
from .base import Comparison, Setting, describe, in_order, refuse

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

    def finite(self) -> bool:
        """Whether no filled-in number is nan or infinite; for entries without symbols."""
        filled = [not isinstance(expression, Blank) for expression in self.expressions]
        return bool(np.isfinite(self.values({})[:, filled]).all())

    def once(self, what: str, samples: Mapping[str, np.ndarray], make: Callable[[], T]) -> T:
        """What `make` returns; made once for the same sample points, as one answer is compared with many."""
        if (kept := self._kept.get(what)) is None or kept[0] is not samples:
            kept = self._kept[what] = samples, make()
        return kept[1]


def checked(question: PublicQuestion, values: tuple) -> Entries:
    """Every scalar must be a blank or an expression in the symbols that the question allows."""
    for value in values:
        if isinstance(value, Blank):
            continue
        if not isinstance(value, Expression):
            raise refuse(question, f"{describe(value)} among the entries")
        foreign = sorted(symbols(value) - set(question.symbols))
        if foreign:
            allowed = ", ".join(question.symbols) or "no symbol (numbers)"
            raise refuse(question, f"the symbol {foreign[0]} where only {allowed} may appear")
    return Entries(values)


def flat(value: object) -> tuple:
    return tuple(scalar for item in value for scalar in flat(item)) if isinstance(value, tuple) else (value,)


def read_scalar(question: PublicQuestion, value: object) -> Entries:
    if isinstance(value, tuple):
        raise refuse(question, describe(value))
    return checked(question, (value,))


def read_vector(question: PublicQuestion, value: object) -> Entries:
    (count,) = question.shape
    value = in_order(value, question.names)
    if array_shape(value) not in ((count,), (count, 1), (1, count)):
        raise refuse(question, describe(value))
    return checked(question, flat(value))


def read_array(question: PublicQuestion, value: object) -> Entries:
    if array_shape(value) != question.shape:
        raise refuse(question, describe(value))
    return checked(question, flat(value))


def agreement(student: Entries, other: Entries, setting: Setting, angles: Sequence[bool] | np.ndarray) -> np.ndarray:
    """Which of m entries agree at every sample point, (m,) booleans; where `angles` says so, modulo 2 pi."""
    theirs, ours = student.values(setting.samples), other.values(setting.samples)
    angles = np.asarray(angles, bool)
    with np.errstate(all="ignore"):
        error = np.abs(difference(theirs, ours, angles)) / np.maximum(1, np.abs(ours))
    agree = (error <= setting.tolerance).all(axis=0)
    # Cancellation in float64 may spoil a right answer; forty digits decide where the values are close, or the reader patient.
    doubtful = ~agree & ((error < 1e-3).all(axis=0) | setting.patient)
    if student.expressions and other.expressions:
        left = MAX_EXACT_NODES
        for i in np.flatnonzero(doubtful):
            left -= size(student.expressions[i])
            if left < 0:
                break
            agree[i] = _agree_exactly(student.expressions[i], other.expressions[i], setting, angles[i])
    return agree


def difference(a: np.ndarray, b: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """a - b, the real part of angles in (-pi, pi]."""
    found = a - b
    if not np.any(angles):
        return found
    return np.where(angles, wrap(found.real) + 1j * found.imag, found)


def _agree_exactly(student: Expression | Blank, other: Expression, setting: Setting, angle: bool) -> bool:
    if isinstance(student, Blank):
        return False
    draws = list(zip(*setting.samples.values(), strict=True)) or [()]
    for values in draws:
        point = dict(zip(setting.samples, values, strict=True))
        theirs, ours = evaluate_exactly(student, point), evaluate_exactly(other, point)
        if theirs is None or ours is None:
            return False
        with np.errstate(all="ignore"):
            # np.abs, as the abs of a huge complex number overflows.
            gap = np.abs(difference(np.complex128(complex(theirs - ours)), np.complex128(0), np.bool_(angle)))
        if not gap <= setting.tolerance * max(1, abs(complex(ours))):
            return False
    return True


def compare_entries(question: PublicQuestion, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """A number, an expression or a vector, entry by entry."""
    count = len(student.expressions)
    agree = agreement(student, other, setting, [i in setting.angles for i in range(count)])
    remarks = tuple(f"{_name(question, i)} differs" for i in np.flatnonzero(~agree)) if count > 1 else ()
    return Comparison(bool(agree.all()), float(agree.mean()), remarks)


def _name(question: PublicQuestion, index: int) -> str:
    return f"{question.names[index]}" if question.names else f"entry {index + 1}"


def compare_direction(question: PublicQuestion, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Vectors that count as equal when they are parallel: lengths and senses are free."""
    theirs, ours = (_unit(entries.values(setting.samples)) for entries in (student, other))
    aligned = np.abs((theirs * ours.conj()).sum(axis=1))
    if np.isfinite(aligned).all() and (aligned > 1 - setting.tolerance).all():
        return Comparison(True, 1.0)
    if not np.isfinite(aligned).all():
        return Comparison(False, 0.0, ("a direction cannot be all zeros or undefined",))
    worst = np.degrees(np.arccos(np.clip(aligned.min(), 0, 1)))
    return Comparison(False, 0.0, (f"the direction is off by {worst:.3g} deg",))


def _unit(vectors: np.ndarray) -> np.ndarray:
    with np.errstate(all="ignore"):
        return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def compare_matrix(question: PublicQuestion, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """A matrix cell by cell."""
    agree = agreement(student, other, setting, np.zeros(len(student.expressions))).reshape(question.shape)
    return Comparison(bool(agree.all()), float(agree.mean()), _cells(agree))


def compare_transform(question: PublicQuestion, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """A transform block by block: half the share for the rotation, half for the position; errors in degrees and metres."""
    agree = agreement(student, other, setting, np.zeros(len(student.expressions))).reshape(question.shape)
    blocks = agree[:-1, :-1].all(), agree[:-1, -1].all()
    share = (sum(map(float, blocks)) / 2) if agree[-1].all() else 0.25 * sum(map(float, blocks))
    if agree.all():
        return Comparison(True, 1.0)
    where = " at the values tried" if question.symbols else ""
    theirs, ours = (entries.values(setting.samples).reshape(-1, *question.shape) for entries in (student, other))
    remarks = list(_cells(agree))
    if not blocks[0]:
        remarks.append(_rotation_error(theirs[:, :-1, :-1], ours[:, :-1, :-1], where))
    if not blocks[1]:
        with np.errstate(all="ignore"):
            miss = np.linalg.norm(theirs[:, :-1, -1] - ours[:, :-1, -1], axis=1).max()
        remarks.append(
            f"the position is off by up to {miss:.3g} m{where}" if np.isfinite(miss) else "the position is not defined"
        )
    remarks += [f"the {name} is right" for name, right in zip(("rotation", "position"), blocks, strict=True) if right]
    if not agree[-1].all():
        remarks.append("the last row of a transform is 0 ... 0 1")
    return Comparison(False, share, tuple(remarks))


def _cells(agree: np.ndarray) -> tuple[str, ...]:
    wrong = [f"({', '.join(map(str, place + 1))})" for place in np.argwhere(~agree)]
    if not wrong:
        return ()
    more = ", ..." if len(wrong) > 6 else ""
    return (
        f"cell {wrong[0]} differs" if len(wrong) == 1 else f"{len(wrong)} cells differ: {', '.join(wrong[:6])}{more}",
    )


def _rotation_error(theirs: np.ndarray, ours: np.ndarray, where: str) -> str:
    with np.errstate(all="ignore"):
        skew = np.abs(np.swapaxes(theirs, 1, 2) @ theirs - np.eye(theirs.shape[-1])).max()
        angle = rotation_angle_between(theirs.real, ours.real).max()
        rigid = skew < 1e-4 and (np.linalg.det(theirs).real > 0).all()
    if not rigid:
        return "its rotation block is no rotation: columns of length 1, orthogonal, right-handed"
    return f"the rotation is off by up to {np.degrees(angle):.3g} deg{where}"
