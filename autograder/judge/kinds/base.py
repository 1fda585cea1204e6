"""What the kinds of answer share: how two answers compare, what a comparison must know, and words for what was found."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from dhkit.forms import array_shape
from dhkit.public import PublicQuestion

from ..decode import Blank, Failure, Foreign, Function, Malformed, Number, Record, Text


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
    samples : mapping of str to (N,) array
        Values of the symbols at the sample points.
    angles : tuple of int
        Indices of the vector entries (or () and (0,) for a single expression) that are angles, compared modulo 2 pi.
    tolerance : float
        Largest difference that still counts as equal, relative to the larger of 1 and the reference's size; metres
        for a point cloud.
    pinned : set of str
        Freedoms of the DHm convention that a right table may not use (see `chains.same_chain`).
    turn : float
        A full turn in the unit of the joint angles: 2 pi, or 360 where both answers are in degrees.
    patient : bool
        Whether an entry that differs in float64 gets the benefit of forty digits: asked for against the reference,
        where rounding must not fail a right answer.
    residual : callable, optional
        How far joint solutions (k, n) are from the target, (k,), in metres and radians.
    family : bool
        Infinitely many solutions: every one that does not miss the target is right.
    """

    samples: Mapping[str, np.ndarray] = field(default_factory=dict)
    angles: tuple[int, ...] = ()
    tolerance: float = 1e-6
    pinned: frozenset[str] = frozenset()
    turn: float = 2 * np.pi
    patient: bool = False
    residual: Callable[[np.ndarray], np.ndarray] | None = None
    family: bool = False


@dataclass(frozen=True)
class Kind:
    """A kind of answer.

    ``read`` turns a decoded value into the kind's own form or raises `Malformed` with what was expected and what was
    found. ``compare`` sets a student's answer against another one, the reference or a mistaken form of it.
    """

    read: Callable[[PublicQuestion, object], object]
    compare: Callable[[PublicQuestion, object, object, Setting], Comparison]


def describe(value: object) -> str:
    """A decoded value in words, for messages."""
    match value:
        case Text():
            return "a text"
        case Function():
            return "a function"
        case Record(items):
            return (
                f"a dictionary with the keys {', '.join(key[:20] for key, _ in items[:6])}"
                if items
                else "an empty dictionary"
            )
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


def refuse(question: PublicQuestion, found: str) -> Malformed:
    return Malformed(f"expected {question.expected}, found {found}")


def in_order(value: object, names: Sequence[str]) -> object:
    """A dictionary with exactly the keys `names` as a tuple in their order; anything else as it is."""
    if isinstance(value, Record) and names and sorted(key for key, _ in value.items) == sorted(names):
        found = dict(value.items)
        return tuple(found[name] for name in names)
    return value
