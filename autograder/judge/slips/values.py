"""Slips in numbers, vectors, expressions, matrices and transforms, made on the decoded right answer and on its values.

What stands in a sum, a product or a function of the right answer is changed at one place, or one symbol everywhere. Where
several such changes lead to the student's values, all of them are told, as nobody can know which one it was.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from dhkit.geometry import wrap

from ..decode import Blank, Call, Constant, Expression, Number, Symbol
from ..evaluate import evaluate
from ..tree import Slip

Samples = Mapping[str, np.ndarray]

_ANGLES = ("t", "alpha", "beta", "gamma", "phi", "psi", "q", "omega")
# More places than these are tried in no answer.
MOST_PLACES = 60


@dataclass(frozen=True)
class Asked:
    """The right answer and how answers are compared with it.

    `shape` is that of the answer, `names` of its entries; `angles` says which of the m entries count modulo a turn.
    """

    right: Sequence[Expression]
    samples: Samples
    shape: tuple[int, ...]
    names: tuple[str, ...]
    angles: np.ndarray
    tolerance: float

    def values(self, entries: Sequence[Expression], samples: Samples | None = None) -> np.ndarray:
        """Values of entries at the sample points, (N, m)."""
        return np.stack([evaluate(entry, samples or self.samples) for entry in entries], axis=1)

    def agree(self, student: np.ndarray, wrong: np.ndarray) -> np.ndarray:
        """Which entries agree at all sample points, (m,)."""
        with np.errstate(all="ignore"):
            gap = student - wrong
            gap = np.where(self.angles, wrap(gap.real) + 1j * gap.imag, gap)
            return np.asarray((np.abs(gap) <= self.tolerance * np.maximum(1, np.abs(wrong))).all(axis=0))

    def name(self, i: int) -> str:
        return self.names[i] if self.names else str(i + 1)

    def place(self, i: int) -> str:
        if self.names:
            return self.names[i]
        if len(self.shape) < 2:
            return f"entry {i + 1}" if self.shape else "the answer"
        row, column = (int(k) + 1 for k in np.unravel_index(i, self.shape)[-2:])
        which = f"matrix {int(np.unravel_index(i, self.shape)[0]) + 1}, " if len(self.shape) == 3 else ""
        return f"{which}row {row}, column {column}"


@dataclass(frozen=True)
class _Found:
    """A change that may lead to the student's answer: its note and share, and in words what was done."""

    note: str
    share: float
    said: str
    hint: str


def explain(student: np.ndarray, asked: Asked) -> Slip | None:
    """The slip that makes the right answer into the student's values (N, m); None if nothing is certain."""
    # Nothing but zeros is no slip, however small a change has made the right answer.
    if not np.isfinite(student).all() or asked.agree(student, np.zeros_like(student)).all():
        return None
    ours = asked.values(asked.right)
    if not np.abs(ours).max() > 0:
        return None
    found: dict[str, _Found] = {}
    for each, wrong in _candidates(asked, ours):
        if np.isfinite(wrong).all() and asked.agree(student, wrong).all() and not asked.agree(ours, wrong).all():
            found.setdefault(each.said, each)
        if len(found) > 3:
            break
    if found:
        # What a sign inside does, a symbol or the whole answer explains better.
        inside = ("sign_of_a_term", "sign_inside_atan2")
        different = np.flatnonzero(~asked.agree(student, ours)).tolist()
        where = f": {asked.place(different[0])}" if len(different) == 1 < ours.shape[1] else ""
        return _told([each for each in found.values() if each.note not in inside] or list(found.values()), where)
    return _explain_entries(student, ours, asked)


def _told(found: list[_Found], where: str) -> Slip:
    first = found[0]
    if len(found) == 1:
        return Slip(
            first.note, first.share, f"**{first.said[0].upper()}{first.said[1:]}{where}.** {first.hint}".strip()
        )
    said = "; or ".join(each.said for each in found)
    return Slip(
        first.note,
        min(each.share for each in found),
        f"**One of these, which come to the same here: {said}{where}.** {first.hint}".strip(),
    )


# ---------------------------------------------------------------- changes of the whole answer


def _candidates(asked: Asked, ours: np.ndarray) -> Iterator[tuple[_Found, np.ndarray]]:
    yield from _scaled(asked, ours)
    if len(asked.shape) >= 2 and asked.shape[-1] == asked.shape[-2]:
        yield from _of_matrices(asked, ours)
    if len(asked.shape) == 1:
        yield from _of_vectors(asked, ours)
    yield from _of_symbols(asked)
    yield from _of_trees(asked, ours)


def _scaled(asked: Asked, ours: np.ndarray) -> Iterator[tuple[_Found, np.ndarray]]:
    if len(asked.shape) < 2:
        yield _Found("sign_turned", 0.6, "the sign is turned everywhere", "Which sense is counted as positive?"), -ours
    for factor in (2.0, 0.5):
        yield (
            _Found(
                "factor_two",
                0.5,
                "a factor of two is too much, or is missing",
                "Look for a half, or for a double angle.",
            ),
            factor * ours,
        )
    degrees = _Found("degrees", 0.5, "the result is in degrees", "The question counts in radians.")
    yield degrees, np.degrees(ours.real) + 0j
    yield (
        _Found("degrees", 0.5, "a result in radians was turned into radians once more", ""),
        np.radians(ours.real) + 0j,
    )
    if asked.angles.any():
        yield degrees, np.where(asked.angles, np.degrees(ours.real), ours)
    if not asked.samples:
        for digits in (1, 2, 3, -1, -2, -3):
            yield (
                _Found(
                    "decimal_slip",
                    0.7,
                    "the decimal point has slipped",
                    "Or a unit: the question wants metres and radians.",
                ),
                10.0**digits * ours,
            )


def _of_matrices(asked: Asked, ours: np.ndarray) -> Iterator[tuple[_Found, np.ndarray]]:
    matrices = ours.reshape(len(ours), *asked.shape)
    flat = lambda changed: np.asarray(changed).reshape(ours.shape)  # noqa: E731
    transposed = np.swapaxes(matrices, -1, -2)
    yield (
        _Found(
            "transposed", 0.4, "the matrix is transposed", "Its columns, not its rows, are the axes of the new frame."
        ),
        flat(transposed),
    )
    if asked.shape[-1] == 4:
        turned = matrices.copy()
        turned[..., :3, :3] = np.swapaxes(matrices[..., :3, :3], -1, -2)
        yield (
            _Found(
                "transposed_rotation",
                0.4,
                "the rotation block is transposed",
                "Its columns, not its rows, are the axes of the new frame.",
            ),
            flat(turned),
        )
    with np.errstate(all="ignore"):
        regular = np.abs(np.linalg.det(matrices)).min() > 1e-9
    if regular:
        yield (
            _Found(
                "inverse_for_transform",
                0.3,
                "this is the inverse",
                "From which frame does the transform lead, and to which?",
            ),
            flat(np.linalg.inv(matrices)),
        )
    if len(asked.shape) == 3:
        yield _Found("reverse_order", 0.3, "the matrices stand in the reverse order", ""), flat(matrices[:, ::-1])


def _of_vectors(asked: Asked, ours: np.ndarray) -> Iterator[tuple[_Found, np.ndarray]]:
    count = ours.shape[1]
    for i, j in combinations(range(count), 2):
        swapped = ours.copy()
        swapped[:, [i, j]] = ours[:, [j, i]]
        said = f"the entries {asked.name(i)} and {asked.name(j)} are exchanged"
        yield _Found("entries_exchanged", 0.5, said, "Look at the order that the question asks for."), swapped
    for shift in range(1, count) if count > 2 else ():
        yield (
            _Found("another_order", 0.4, "the entries stand in another order than asked for", ""),
            np.roll(ours, shift, axis=1),
        )
    if count > 2:
        yield _Found("another_order", 0.4, "the entries stand in the reverse order", ""), ours[:, ::-1]


def _of_symbols(asked: Asked) -> Iterator[tuple[_Found, np.ndarray]]:
    samples = asked.samples
    names = [name for name in samples if any(_contains(entry, name) for entry in asked.right)]
    angles = [name for name in names if name.startswith(_ANGLES)]
    lengths = [name for name in names if name not in angles]

    def at(**changed: np.ndarray) -> np.ndarray:
        return asked.values(asked.right, {**samples, **changed})

    for name in names:
        here = samples[name]
        yield (
            _Found(
                "sign_of_symbol", 0.6, f"the sign of {name} is turned", "Set all other symbols to zero and draw it."
            ),
            at(**{name: -here}),
        )
        zero = np.zeros_like(here)
        yield (
            _Found(
                "symbol_left_out", 0.4, f"the answer takes no notice of {name}", "What does it change in the figure?"
            ),
            at(**{name: zero}),
        )
        yield (
            _Found("factor_two", 0.5, f"a factor of two: {name} enters doubled, or halved", ""),
            at(**{name: 2 * here}),
        )
        yield (
            _Found("factor_two", 0.5, f"a factor of two: {name} enters doubled, or halved", ""),
            at(**{name: here / 2}),
        )
    if len(angles) > 1:
        yield (
            _Found(
                "all_turns_backwards",
                0.4,
                "all turns go the wrong way",
                "SymPy's `rot_axis1`, `rot_axis2` and `rot_axis3` do that: they turn the axes and not the vector.",
            ),
            at(**{name: -samples[name] for name in angles}),
        )
    for name in angles:
        here = samples[name]
        said = f"sine and cosine of {name} are exchanged"
        for turned in (np.pi / 2 - here, here + np.pi / 2, here - np.pi / 2):
            yield _Found("sine_and_cosine_exchanged", 0.5, said, "Try it with the angle zero."), at(**{name: turned})
        yield _Found("half_turn_off", 0.6, f"the angle {name} is half a turn off", ""), at(**{name: here + np.pi})
    if angles:
        radians = {name: np.radians(samples[name]) for name in angles}
        yield (
            _Found("degrees", 0.5, "the angles are taken in degrees", "The question counts in radians."),
            at(**radians),
        )
        complement = {name: np.pi / 2 - samples[name] for name in angles}
        yield (
            _Found("sine_and_cosine_exchanged", 0.5, "sine and cosine are exchanged", "Try it with all angles zero."),
            at(**complement),
        )
    for group in (angles, lengths):
        for first, second in combinations(group, 2):
            changed = {first: samples[second], second: samples[first]}
            yield (
                _Found(
                    "symbols_exchanged",
                    0.5,
                    f"the symbols {first} and {second} are exchanged",
                    "Which of them comes first in the chain?",
                ),
                at(**changed),
            )


# ---------------------------------------------------------------- changes at one place of an expression


def _of_trees(asked: Asked, ours: np.ndarray) -> Iterator[tuple[_Found, np.ndarray]]:
    """One call inside the answer is changed, at every place alike in all entries, or all of its kind."""
    calls = list(dict.fromkeys(call for entry in asked.right for call in _calls(entry)))[:MOST_PLACES]
    for change, found in _CHANGES:
        swaps = {call: changed for call in calls if (changed := change(call)) is not None}
        for chosen in [{call: changed} for call, changed in swaps.items()] + ([swaps] if len(swaps) > 1 else []):
            wrong = [_replaced(entry, chosen) for entry in asked.right]
            yield found, asked.values(wrong)
    yield from _of_sums(asked, calls)
    if not asked.samples:
        return
    degrees = [_in_degrees(entry) for entry in asked.right]
    yield (
        _Found("degrees", 0.5, "a constant angle is in degrees", "The question counts in radians: write pi/2."),
        asked.values(degrees),
    )
    exchanged = [_sines_for_cosines(entry) for entry in asked.right]
    yield (
        _Found("sine_and_cosine_exchanged", 0.5, "sine and cosine are exchanged", "Try it with all angles zero."),
        asked.values(exchanged),
    )


def _of_sums(asked: Asked, calls: Sequence[Call]) -> Iterator[tuple[_Found, np.ndarray]]:
    """One term of a sum inside the answer has the other sign, or is not there."""
    places = [(call, k) for call in calls if call.function == "add" for k in range(len(call.args))]
    turned = _Found("sign_of_a_term", 0.6, "one of the terms has the wrong sign", "Write them one by one.")
    missing = _Found("term_missing", 0.5, "one of the terms is missing", "Count them.")
    for call, k in places[:MOST_PLACES]:
        before, term, after = call.args[:k], call.args[k], call.args[k + 1 :]
        for found, args in ((turned, (*before, Call("mul", (_MINUS, term)), *after)), (missing, (*before, *after))):
            wrong = [_replaced(entry, {call: Call("add", args)}) for entry in asked.right]
            yield found, asked.values(wrong)


def _calls(entry: Expression) -> Iterator[Call]:
    if isinstance(entry, Call):
        yield entry
        for argument in entry.args:
            yield from _calls(argument)


def _contains(entry: Expression, name: str) -> bool:
    return entry == Symbol(name) or (isinstance(entry, Call) and any(_contains(part, name) for part in entry.args))


def _replaced(entry: Expression, swaps: Mapping[Call, Expression]) -> Expression:
    if isinstance(entry, Call):
        return (
            swaps[entry]
            if entry in swaps
            else Call(entry.function, tuple(_replaced(part, swaps) for part in entry.args))
        )
    return entry


def _change(function: str, make: Callable[..., Expression | None]) -> Callable[[Call], Expression | None]:
    return lambda call: make(*call.args) if call.function == function else None


def _root(base: Expression, exponent: Expression, make: Callable[[Expression], Expression]) -> Expression | None:
    half = isinstance(exponent, Number) and complex(exponent.value) == 0.5
    return make(base) if half else None


_MINUS = Number(-1)
_CHANGES: tuple[tuple[Callable[[Call], Expression | None], _Found], ...] = (
    (
        _change("atan2", lambda y, x: Call("atan2", (x, y))),
        _Found("atan2_arguments_exchanged", 0.4, "the arguments of an atan2 are exchanged", "The ordinate comes first: atan2(y, x)."),
    ),
    (
        _change("atan2", lambda y, x: Call("atan", (Call("mul", (y, Call("pow", (x, _MINUS)))),))),
        _Found("atan_for_atan2", 0.5, "atan loses the quadrant", "A function of two arguments can tell an angle from the one half a turn further."),
    ),
    (
        _change("atan2", lambda y, x: Call("atan2", (Call("mul", (_MINUS, y)), x))),
        _Found("sign_inside_atan2", 0.5, "an argument of an atan2 has the wrong sign", ""),
    ),
    (
        _change("atan2", lambda y, x: Call("atan2", (y, Call("mul", (_MINUS, x))))),
        _Found("sign_inside_atan2", 0.5, "an argument of an atan2 has the wrong sign", ""),
    ),
    (
        _change("sin", lambda angle: Call("cos", (angle,))),
        _Found("sine_and_cosine_exchanged", 0.5, "a cosine stands for a sine", "Try it with the angle zero."),
    ),
    (
        _change("cos", lambda angle: Call("sin", (angle,))),
        _Found("sine_and_cosine_exchanged", 0.5, "a sine stands for a cosine", "Try it with the angle zero."),
    ),
    (
        _change("sin", lambda angle: Call("mul", (_MINUS, Call("sin", (angle,))))),
        _Found("sign_of_a_term", 0.6, "a sine has the wrong sign", ""),
    ),
    (
        _change("cos", lambda angle: Call("mul", (_MINUS, Call("cos", (angle,))))),
        _Found("sign_of_a_term", 0.6, "a cosine has the wrong sign", ""),
    ),
    (
        _change("pow", lambda base, exponent: _root(base, exponent, lambda inner: inner)),
        _Found("root_missing", 0.5, "a square root is missing", ""),
    ),
    (_change("Abs", lambda inner: inner), _Found("absolute_value_missing", 0.6, "an absolute value is missing", "")),
)  # fmt: skip


def _in_degrees(entry: Expression) -> Expression:
    if entry == Constant("pi"):
        return Number(180)
    return Call(entry.function, tuple(map(_in_degrees, entry.args))) if isinstance(entry, Call) else entry


def _sines_for_cosines(entry: Expression) -> Expression:
    if not isinstance(entry, Call):
        return entry
    other = {"sin": "cos", "cos": "sin"}.get(entry.function, entry.function)
    return Call(other, tuple(map(_sines_for_cosines, entry.args)))


# ---------------------------------------------------------------- changes of single entries


def _explain_entries(student: np.ndarray, ours: np.ndarray, asked: Asked) -> Slip | None:
    """One slip of a kind in each differing entry: a sign, a term, a factor, sine for cosine."""
    differing = np.flatnonzero(~asked.agree(student, ours)).tolist()
    if not differing or len(differing) > max(1, min(4, ours.shape[1] - 1)):
        return None
    said = [_explain_entry(student[:, [i]], ours[:, [i]], asked, i) for i in differing]
    known = [each for each in said if each is not None]
    if len(known) < len(said):
        return None
    notes = sorted({each.note for each in known})
    if len(notes) > 2:
        return None
    share = min(each.share for each in known) ** len(notes)
    return Slip("+".join(notes), share, "\n\n".join(dict.fromkeys(each.said for each in known)))


def _explain_entry(student: np.ndarray, ours: np.ndarray, asked: Asked, i: int) -> _Found | None:
    alone = Asked([asked.right[i]], asked.samples, (), (), asked.angles[[i]], asked.tolerance)
    place = asked.place(i)
    is_it = lambda wrong: bool(alone.agree(student, wrong).all())  # noqa: E731
    if not np.abs(ours).max() > 0:
        return None
    if is_it(-ours):
        return _Found("sign_of_an_entry", 0.6, f"**A sign is turned: {place}.**", "")
    if is_it(2 * ours) or is_it(ours / 2):
        return _Found("factor_two", 0.6, f"**A factor of two is too much, or missing: {place}.**", "")
    if is_it(0 * ours):
        return _Found("entry_left_out", 0.5, f"**Something is missing: {place} is zero in your answer.**", "")
    if any(is_it(np.array(ours + turn)) for turn in (np.pi, np.pi / 2, -np.pi / 2)) and asked.angles[i]:
        return _Found("quarter_turn_off", 0.5, f"**An angle is a quarter or half a turn off: {place}.**", "")
    if is_it(np.degrees(ours.real) + 0j):
        return _Found("degrees", 0.5, f"**Degrees for radians: {place}.**", "")
    terms = _terms(asked.right[i])
    if 1 < len(terms) <= MOST_PLACES:
        parts = np.stack([evaluate(term, asked.samples) for term in terms], axis=1)
        for part in parts.T[..., None]:
            if is_it(ours - 2 * part):
                return _Found(
                    "sign_of_a_term",
                    0.6,
                    f"**One of the terms has the wrong sign: {place}.** Write them one by one.",
                    "",
                )
            if is_it(ours - part):
                return _Found("term_missing", 0.5, f"**One of the terms is missing: {place}.** Count them.", "")
    for found, wrong in (*_of_symbols(alone), *_of_trees(alone, ours)):
        if is_it(wrong):
            return _Found(
                found.note,
                found.share,
                f"**{found.said[0].upper()}{found.said[1:]}: {place}.** {found.hint}".strip(),
                "",
            )
    return None


def _terms(entry: Expression) -> tuple[Expression, ...]:
    return entry.args if isinstance(entry, Call) and entry.function == "add" else (entry,)


def locate(student: np.ndarray, entry: Callable[[Samples], np.ndarray], asked: Asked) -> str:
    """Where a single wrong expression is right, in words; empty where nothing can be said.

    `entry` gives the student's values at other sample points.
    """
    samples = asked.samples
    ours = asked.values(asked.right)
    with np.errstate(all="ignore"):
        right = np.abs(student - ours).max(axis=1) <= asked.tolerance * np.maximum(1, np.abs(ours).max(axis=1))
    if right.any():
        return "it is right at some of the values tried and wrong at others: a case, a sign or a quadrant is missing"
    for name in samples:
        if not any(_contains(expression, name) for expression in asked.right):
            continue
        there = {**samples, name: np.zeros_like(samples[name])}
        theirs, there_right = entry(there), asked.values(asked.right, there)
        defined = np.isfinite(theirs).all() and np.isfinite(there_right).all()
        if defined and np.abs(there_right).max() > 0 and asked.agree(theirs, there_right).all():
            return f"with {name} = 0 it is right: look at what {name} brings in"
    return ""


def without_blanks(entries: Sequence[Expression | Blank]) -> list[Expression] | None:
    """The entries if all of them are filled in."""
    filled = [entry for entry in entries if not isinstance(entry, Blank)]
    return filled if len(filled) == len(entries) else None
