"""The kinds of answer: how each is read from decoded values, and how two answers of a kind compare.

A kind is two functions. ``read`` turns a decoded value into the kind's own form or raises `Malformed` with
what was expected and what was found. ``compare`` sets a student's answer against another one, the reference
or a mistaken form of it, and returns a `Comparison`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from dhkit.forms import array_shape
from dhkit.public import DH_COLUMNS, PublicQuestion

from .chains import Chain, NotAChain, same_chain
from .decode import Blank, Call, Constant, Expression, Failure, Foreign, Function, Malformed, Number, Record, Symbol, Text
from .evaluate import evaluate, evaluate_exactly, symbols

# Sets of solutions are compared pair by pair; a general six-axis arm has at most 16.
MAX_SOLUTIONS = 100


@dataclass(frozen=True)
class Comparison:
    """How two answers compare: equal or not, the share of parts that agree, and what differs, in words.

    `note` is the answer note of a difference that has a name of its own.
    """

    equal: bool
    share: float
    remarks: tuple[str, ...] = ()
    note: str = ""


@dataclass(frozen=True)
class Setting:
    """What a comparison needs to know besides the two answers.

    Attributes
    ----------
    points : mapping of str to (N,) array
        Values of the symbols at the sample points.
    angles : tuple of int
        Indices of the vector entries (or () and (0,) for a single expression) that are angles, compared modulo 2 pi.
    tolerance : float
        Largest difference that still counts as equal, relative to the larger of 1 and the reference's size.
    pinned : set of str
        Freedoms of the DHm convention that a right table may not use (see `chains.same_chain`).
    turn : float
        A full turn in the unit of the joint angles: 2 pi, or 360 where both answers are in degrees.
    """

    points: Mapping[str, np.ndarray]
    angles: tuple[int, ...] = ()
    tolerance: float = 1e-6
    pinned: frozenset[str] = frozenset()
    turn: float = 2 * np.pi


@dataclass(frozen=True)
class Kind:
    read: Callable[[PublicQuestion, object], object]
    compare: Callable[[PublicQuestion, object, object, Setting], Comparison]


def describe(value: object) -> str:
    """A decoded value in words, for messages."""
    match value:
        case Text():
            return "a text"
        case Function():
            return "a function"
        case Record():
            return "a dictionary"
        case Foreign(type):
            return f"an object of type {type}"
        case Failure(message):
            return f"an error ({message})"
        case Blank():
            return "no answer"
        case Number():
            return "a number"
        case tuple():
            shape = array_shape(value)
            if shape is None:
                return "a list whose rows have different lengths"
            return "an empty list" if shape == (0,) else f"an array of shape {' x '.join(map(str, shape))}"
    return "an expression"


def _refuse(question: PublicQuestion, found: str) -> Malformed:
    return Malformed(f"expected {question.expected}, found {found}")


def _entries(question: PublicQuestion, values: tuple) -> tuple:
    """Check every scalar of an array: expressions in the allowed symbols, or blanks."""
    for value in values:
        if isinstance(value, Blank):
            continue
        if not isinstance(value, Expression):
            raise _refuse(question, f"{describe(value)} among the entries")
        foreign = sorted(symbols(value) - set(question.symbols))
        if foreign:
            allowed = ", ".join(question.symbols) or "no symbol (numbers)"
            raise _refuse(question, f"the symbol {foreign[0]} where only {allowed} may appear")
    return values


def _flatten(value: object) -> tuple:
    return sum(map(_flatten, value), ()) if isinstance(value, tuple) else (value,)


def _read_scalar(question: PublicQuestion, value: object) -> tuple:
    if isinstance(value, tuple):
        raise _refuse(question, describe(value))
    return _entries(question, (value,))


def _read_vector(question: PublicQuestion, value: object) -> tuple:
    (count,) = question.shape
    if array_shape(value) not in ((count,), (count, 1), (1, count)):
        raise _refuse(question, describe(value))
    return _entries(question, _flatten(value))


def _read_array(question: PublicQuestion, value: object) -> tuple:
    if array_shape(value) != question.shape:
        raise _refuse(question, describe(value))
    return _entries(question, _flatten(value))


def _read_choice(question: PublicQuestion, value: object) -> str:
    letter = value.value.strip().upper() if isinstance(value, Text) else None
    if letter not in question.options:
        raise _refuse(question, repr(value.value[:20]) if isinstance(value, Text) else describe(value))
    return letter


def _read_solutions(question: PublicQuestion, value: object) -> np.ndarray:
    count, shape = len(question.joints), array_shape(value)
    single = shape == (count,)
    if shape != (0,) and not single and (shape is None or len(shape) != 2 or shape[1] != count):
        raise _refuse(question, describe(value))
    if not single and len(value) > MAX_SOLUTIONS:
        raise _refuse(question, f"{len(value)} solutions, more than any robot has")
    numbers = _entries(question, _flatten(value))
    if any(isinstance(number, Blank) for number in numbers):
        raise _refuse(question, "an entry that is not filled in")
    values = np.array([evaluate(number, {})[0] for number in numbers])
    if not np.isfinite(values).all():
        raise _refuse(question, "a value that is not finite")
    if np.abs(values.imag).max(initial=0) > 1e-9:
        raise _refuse(question, "a complex number")
    return values.real.reshape(-1, count)


def _same(student: Expression | Blank, other: Expression, setting: Setting, angle: bool) -> bool:
    """True if two expressions agree at every sample point, modulo 2 pi if they are angles."""
    if isinstance(student, Blank):
        return False
    ours, theirs = evaluate(other, setting.points), evaluate(student, setting.points)
    if not np.isfinite(theirs).all():
        return False
    scale = np.maximum(1, np.abs(ours))
    error = np.abs(_difference(theirs, ours, angle)) / scale
    if (error <= setting.tolerance).all():
        return True
    # Cancellation in float64 may spoil a right answer; forty digits decide where the values are at least close.
    return bool((error < 1e-3).all()) and _same_exactly(student, other, setting, angle)


def _difference(a, b, angle: bool):
    difference = a - b
    if not angle:
        return difference
    return (difference.real + np.pi) % (2 * np.pi) - np.pi + 1j * difference.imag


def _same_exactly(student: Expression, other: Expression, setting: Setting, angle: bool) -> bool:
    names = list(setting.points)
    draws = list(zip(*setting.points.values(), strict=True)) or [()]
    for values in draws:
        point = dict(zip(names, values, strict=True))
        theirs, ours = evaluate_exactly(student, point), evaluate_exactly(other, point)
        if theirs is None or ours is None:
            return False
        difference = complex(_difference(np.complex128(complex(theirs - ours)), 0, angle))
        if abs(difference) > setting.tolerance * max(1, abs(complex(ours))):
            return False
    return True


def _matches(student: tuple, other: tuple, setting: Setting, is_angle: Callable[[int], bool]) -> list[bool]:
    return [_same(mine, theirs, setting, is_angle(i)) for i, (mine, theirs) in enumerate(zip(student, other, strict=True))]


def _compare_entries(question: PublicQuestion, student: tuple, other: tuple, setting: Setting) -> Comparison:
    agree = _matches(student, other, setting, lambda i: i in setting.angles)
    remarks = tuple(f"entry {i + 1} differs" for i, same in enumerate(agree) if not same)
    return Comparison(all(agree), sum(agree) / len(agree), remarks if len(agree) > 1 else ())


def _compare_matrix(question: PublicQuestion, student: tuple, other: tuple, setting: Setting) -> Comparison:
    rows, columns = question.shape
    agree = np.array(_matches(student, other, setting, lambda i: False)).reshape(rows, columns)
    wrong = [f"({i + 1}, {j + 1})" for i, j in np.argwhere(~agree)]
    share = agree.mean() if question.kind == "matrix" else (agree[:-1, :-1].all() + agree[:-1, -1].all()) / 2
    remark = f"cell {wrong[0]} differs" if len(wrong) == 1 else f"{len(wrong)} cells differ: {', '.join(wrong[:6])}"
    return Comparison(bool(agree.all()), float(share), (remark,) if wrong else ())


def _compare_table(question: PublicQuestion, student: tuple, other: tuple, setting: Setting) -> Comparison:
    """Two tables are equal when they describe the same chain without using a freedom that the question pins."""
    cells = _compare_cells(student, other, setting)
    if cells.equal:
        return cells
    try:
        mine, theirs = (Chain.of_entries(entries, question.joints, setting.points) for entries in (student, other))
        match = same_chain(mine, theirs, pinned=setting.pinned)
    except NotAChain:
        return cells
    if match.equal:
        return Comparison(True, 1.0, tuple(f"another {used}" for used in match.freedoms))
    if match.parting:
        return Comparison(False, cells.share, (f"joint {match.parting.joint}: {match.parting.quantity} differs",))
    return Comparison(False, 1.0, match.remarks, "same_chain_other_frames")


def _compare_cells(student: tuple, other: tuple, setting: Setting) -> Comparison:
    width = len(DH_COLUMNS)
    is_angle = [name in ("alpha", "theta") for name in DH_COLUMNS]
    agree = np.array(_matches(student, other, setting, lambda i: is_angle[i % width])).reshape(-1, width)
    remarks = tuple(
        f"row {i + 1}: {', '.join(name for name, same in zip(DH_COLUMNS, row, strict=True) if not same)}"
        for i, row in enumerate(agree)
        if not row.all()
    )
    return Comparison(bool(agree.all()), float(agree.all(axis=1).mean()), remarks)


def _compare_choice(question: PublicQuestion, student: str, other: str, setting: Setting) -> Comparison:
    return Comparison(student == other, float(student == other))


def _compare_solutions(question: PublicQuestion, student: np.ndarray, other: np.ndarray, setting: Setting) -> Comparison:
    """Two sets of joint solutions without order; angles modulo 2 pi, repeated solutions merged."""
    mine, theirs = (_distinct(solutions, setting) for solutions in (student, other))
    same = _close(theirs, mine, setting)
    missing, extra = int((~same.any(axis=1)).sum()), int((~same.any(axis=0)).sum())
    remarks = []
    if missing:
        remarks.append(f"{missing} of {len(theirs)} solutions missing")
    if extra:
        remarks.append(f"{extra} of the {len(mine)} given do not reach the target")
    most = max(len(theirs), len(mine))
    return Comparison(not remarks, (len(theirs) - missing) / most if most else 1.0, tuple(remarks))


def _close(a: np.ndarray, b: np.ndarray, setting: Setting) -> np.ndarray:
    """Which of the (m, n) solutions `a` are the same as which of the (k, n) solutions `b`: an (m, k) array."""
    difference = np.abs(a[:, None] - b[None])
    angles = list(setting.angles)
    radians = difference[..., angles] * (2 * np.pi / setting.turn)
    difference[..., angles] = np.abs((radians + np.pi) % (2 * np.pi) - np.pi)
    return (difference <= setting.tolerance).all(axis=-1)


def _distinct(solutions: np.ndarray, setting: Setting) -> np.ndarray:
    kept: list[int] = []
    for i, same in enumerate(_close(solutions, solutions, setting)):
        if not same[kept].any():
            kept.append(i)
    return solutions[kept]


KINDS = {
    "number": Kind(_read_scalar, _compare_entries),
    "expression": Kind(_read_scalar, _compare_entries),
    "vector": Kind(_read_vector, _compare_entries),
    "matrix": Kind(_read_array, _compare_matrix),
    "transform": Kind(_read_array, _compare_matrix),
    "dh_table": Kind(_read_array, _compare_table),
    "joint_solutions": Kind(_read_solutions, _compare_solutions),
    "choice": Kind(_read_choice, _compare_choice),
}
