"""Slips in joint solutions, and in what a function returns: undone on the student's result, or made on the arguments.

A result that becomes right when a sign, a unit or an order is undone shows this slip; of infinitely many solutions, too,
where nobody knows which of them the student meant.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np

from dhkit.forms import Form

from ..decode import Malformed, Number
from ..kinds import Entries
from ..tree import Slip

Change = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Undoing:
    """A slip, and the change of a result that takes it back."""

    slip: Slip
    change: Change


@dataclass(frozen=True)
class Misread:
    """A slip made on the arguments of a function, and the change that makes it."""

    slip: Slip
    change: Callable[[list], list]


def _slip(note: str, share: float, said: str, hint: str = "") -> Slip:
    return Slip(note, share, f"**{said}** {hint}".strip())


def undoings(form: Form, angles: tuple[int, ...]) -> Iterator[Undoing]:
    """What may be undone on a result of this form."""
    if form.kind == "joint_solutions":
        yield from _of_columns(list(getattr(form, "joints", ())), angles)
    elif form.kind in ("number", "vector", "expression"):
        names = list(getattr(form, "names", ())) or [f"entry {i + 1}" for i in range(int(np.prod(form.shape or (1,))))]
        yield from _of_columns(names, angles)
        yield Undoing(_slip("factor_two", 0.5, "A factor of two is too much."), lambda found: found / 2)
        yield Undoing(_slip("factor_two", 0.5, "A factor of two is missing."), lambda found: 2 * found)
        yield Undoing(_slip("squared", 0.5, "This is the square of the result."), np.emath.sqrt)
        yield Undoing(_slip("root_taken", 0.5, "This is the square root of the result."), np.square)
    elif form.kind in ("matrix", "transform"):
        yield from _of_matrices(form)


def _of_columns(names: list[str], angles: tuple[int, ...]) -> Iterator[Undoing]:
    """Rows (k, n) of a result, column by column."""
    count = len(names)

    def on(columns: tuple[int, ...], change: Change) -> Change:
        def changed(found: np.ndarray) -> np.ndarray:
            found = np.array(found, dtype=complex if np.iscomplexobj(found) else float)
            found[..., list(columns)] = change(found[..., list(columns)])
            return found

        return changed

    every = tuple(range(count))
    if angles:
        degrees = _slip("degrees", 0.4, "The angles are in degrees.", "The question asks for radians.")
        yield Undoing(degrees, on(angles, np.radians))
    for k, name in enumerate(names):
        yield Undoing(_slip("sign_of_an_entry", 0.6, f"The sign of {name} is turned."), on((k,), np.negative))
        if k in angles:
            for turn, said in ((np.pi, "half a turn"), (np.pi / 2, "a quarter turn"), (-np.pi / 2, "a quarter turn")):
                slip = _slip("angle_off", 0.6, f"{name} is {said} off.", "From which line is it counted?")
                yield Undoing(slip, on((k,), partial(np.add, -turn)))
            degrees = _slip("degrees", 0.5, f"{name} is in degrees.", "The question asks for radians.")
            yield Undoing(degrees, on((k,), np.radians))
    yield Undoing(_slip("sign_turned", 0.5, "The sign is turned everywhere."), np.negative)
    if len(angles) > 1:
        yield Undoing(_slip("sign_turned", 0.5, "All angles have the opposite sign."), on(angles, np.negative))
        for i, k in combinations(angles, 2):
            slip = _slip("sign_of_an_entry", 0.5, f"The signs of {names[i]} and {names[k]} are turned.")
            yield Undoing(slip, on((i, k), np.negative))
    for i, k in combinations(every, 2):
        order = [k if j == i else i if j == k else j for j in every]
        slip = _slip("entries_exchanged", 0.5, f"{names[i]} and {names[k]} are exchanged.")
        yield Undoing(slip, partial(_columns, order))
    if count > 2:
        slip = _slip("another_order", 0.4, "The entries stand in another order than asked for.")
        yield Undoing(slip, partial(_columns, list(every[::-1])))
        yield from (Undoing(slip, partial(np.roll, shift=shift, axis=-1)) for shift in range(1, count))


def _columns(order: list[int], found: np.ndarray) -> np.ndarray:
    return found[..., order]


def _of_matrices(form: Form) -> Iterator[Undoing]:
    shape = form.shape

    def on(change: Change) -> Change:
        return lambda found: change(found.reshape(-1, *shape)).reshape(found.shape)

    if len(shape) == 2 and shape[0] == shape[1]:
        yield Undoing(
            _slip("transposed", 0.4, "The matrix is transposed."), on(lambda matrix: np.swapaxes(matrix, -1, -2))
        )
        slip = _slip(
            "inverse_for_transform", 0.3, "This is the inverse.", "From which frame does it lead, and to which?"
        )
        yield Undoing(slip, on(np.linalg.inv))
    if shape == (4, 4):

        def turned(matrix: np.ndarray) -> np.ndarray:
            matrix = matrix.copy()
            matrix[..., :3, :3] = np.swapaxes(matrix[..., :3, :3], -1, -2)
            return matrix

        hint = "Its columns, not its rows, are the axes of the new frame."
        yield Undoing(_slip("transposed_rotation", 0.4, "The rotation block is transposed.", hint), on(turned))
    for k in range(shape[-1]):

        def negated(matrix: np.ndarray, k: int = k) -> np.ndarray:
            matrix = matrix.copy()
            matrix[..., :3, k] *= -1
            return matrix

        yield Undoing(_slip("sign_of_a_column", 0.5, f"The sign of column {k + 1} is turned."), on(negated))


def misreadings(args: list) -> Iterator[Misread]:
    """What may be mistaken about the arguments of a function, judged by one list of them."""
    numbers = [k for k, arg in enumerate(args) if isinstance(arg, (int, float))]

    def on(places: list[int], change: Callable[[float], float]) -> Callable[[list], list]:
        return lambda args: [change(arg) if k in places else arg for k, arg in enumerate(args)]

    for places in [numbers, *([k] for k in numbers)]:
        which = "Angles are" if len(places) != 1 else f"Argument {places[0] + 1} is"
        slip = _slip(
            "degrees", 0.4, f"{which} taken in degrees.", "The question, and numpy's cos and sin, count in radians."
        )
        yield Misread(slip, on(places, lambda arg: float(np.radians(arg))))
    for k in numbers:
        slip = _slip("sign_of_an_argument", 0.5, f"Argument {k + 1} enters with the wrong sign.")
        yield Misread(slip, on([k], lambda arg: -arg))
        slip = _slip("argument_left_out", 0.4, f"Argument {k + 1} is not taken into account.")
        yield Misread(slip, on([k], lambda arg: 0.0))
    for i, k in combinations(numbers, 2):
        slip = _slip(
            "arguments_exchanged", 0.4, f"Arguments {i + 1} and {k + 1} are exchanged.", "Look at their order."
        )
        yield Misread(slip, partial(_columns_of_list, i, k))
    for k, arg in enumerate(args):
        if not isinstance(arg, list) or not arg:
            continue
        if all(isinstance(row, list) and len(row) == len(arg) for row in arg):
            slip = _slip("argument_transposed", 0.4, f"Argument {k + 1} is read with rows and columns exchanged.")
            yield Misread(slip, _at(k, lambda matrix: np.transpose(matrix).tolist()))
        elif not isinstance(arg[0], list):
            slip = _slip(
                "degrees",
                0.4,
                f"Argument {k + 1} is taken in degrees.",
                "The question, and numpy's cos and sin, count in radians.",
            )
            yield Misread(slip, _at(k, lambda values: np.radians(values).tolist()))
            yield Misread(
                _slip("sign_of_an_argument", 0.5, f"Argument {k + 1} enters with the wrong sign."),
                _at(k, lambda values: (-np.array(values)).tolist()),
            )
            yield Misread(
                _slip("argument_reversed", 0.4, f"Argument {k + 1} is read from its end."),
                _at(k, lambda values: values[::-1]),
            )


def _columns_of_list(i: int, k: int, args: list) -> list:
    return [args[k] if j == i else args[i] if j == k else arg for j, arg in enumerate(args)]


def _at(place: int, change: Callable[[list], list]) -> Callable[[list], list]:
    return lambda args: [change(arg) if k == place else arg for k, arg in enumerate(args)]


def changed(result: Any, change: Change) -> Any:
    """A result as its kind holds it, after a change of its values; one that is in no form stays as it is."""
    if isinstance(result, Malformed):
        return result
    if isinstance(result, Entries):
        values = change(result.values({})[0])
        return Entries(tuple(Number(value if value.imag else value.real) for value in values.tolist()))
    return change(np.asarray(result)) if np.size(result) else result
