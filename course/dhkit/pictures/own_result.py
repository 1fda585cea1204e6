"""What all pictures of a student's result share: numbers out of an answer, and a card where nothing can be drawn."""

from __future__ import annotations

from functools import cache, wraps

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.patches import Rectangle

from ..drawing.inputs import as_numbers
from ..drawing.style import SOFT, styled
from ..forms.classic_table import CLASSIC_COLUMNS
from ..forms.dh_table import DH_COLUMNS
from ..nodes import array_shape
from ..public import questions


class NotAttempted(Exception):
    """The answer, or a part of it, is still ``...`` or ``None``."""


def own_result(show):
    """Turn everything that can go wrong with an answer into a card with one sentence.

    For a function ``show_*(answer, ...)``: it never raises on an answer.
    """

    @wraps(show)
    @styled
    def picture(answer, *args, **kwargs):
        before = set(plt.get_fignums())
        try:
            return show(attempted(laid_out(answer)), *args, **kwargs)
        except NotAttempted as blank:
            message = str(blank)
        except Exception as error:
            message = f"cannot be drawn\n{error or type(error).__name__}"
        for number in set(plt.get_fignums()) - before:
            plt.close(number)
        return card(message)

    return picture


def card(message: str):
    """An empty frame with a message, in place of a picture."""
    ax = plt.subplots(figsize=(5.2, 1.5))[1]
    ax.axis("off")
    ax.add_patch(
        Rectangle((0, 0), 1, 1, transform=ax.transAxes, fill=False, clip_on=False, edgecolor=SOFT, ls=(0, (4, 3)))
    )
    ax.text(0.5, 0.5, message[:300], transform=ax.transAxes, ha="center", va="center", wrap=True, parse_math=False)
    return ax


def attempted(answer):
    """`answer` as it is, unless nothing, or only a part, has been filled in."""
    blanks = [entry is None or entry is Ellipsis for entry in entries(answer)]
    if blanks and all(blanks):
        raise NotAttempted("not attempted yet")
    if any(blanks):
        raise NotAttempted("not complete: some entries are still ...")
    return answer


def laid_out(answer):
    """`answer` with lists in place of dictionaries and sets, and 0 or 1 for truth values.

    A dictionary whose keys are the names of some question's entries, joints or columns is put in their order, any
    other in its own; what `dhkit.forms` accepts can then be drawn.
    """
    if isinstance(answer, dict):
        items = {str(name): laid_out(value) for name, value in answer.items()}
        ordered = [items[name] for name in _orders().get(frozenset(items), items)]
        columns = ordered and all(isinstance(column, list) for column in ordered)
        return [list(row) for row in zip(*ordered, strict=True)] if columns else ordered
    if isinstance(answer, (sympy.MatrixBase, np.ndarray)):
        return laid_out(answer.tolist())
    if isinstance(answer, (list, tuple, set, frozenset)):
        return [laid_out(item) for item in answer]
    if isinstance(answer, (bool, np.bool_, sympy.logic.boolalg.BooleanAtom)):
        return int(bool(answer))
    return answer


@cache
def _orders() -> dict[frozenset[str], tuple[str, ...]]:
    """The order of names that questions give to the entries of an answer, by these names."""
    forms = [question.form for question in questions().values()]
    named = [getattr(form, "names", ()) or getattr(form, "joints", ()) for form in forms]
    return {frozenset(names): names for names in (DH_COLUMNS, CLASSIC_COLUMNS, *named) if names}


def entries(answer) -> list:
    """The entries of an answer as a flat list."""
    if isinstance(answer, (sympy.MatrixBase, np.ndarray)):
        return entries(answer.tolist())
    if isinstance(answer, (list, tuple)):
        return [entry for item in answer for entry in entries(item)]
    return [answer]


def numbers(answer, what: str, shape: tuple, values: dict[str, float]) -> np.ndarray:
    """An answer as floats.

    Parameters
    ----------
    answer : nested lists, SymPy or NumPy arrays of numbers and SymPy expressions
    what : str
        What it is, for the error message.
    shape : tuple
        The awaited shape; None stands for any size. A vector may also be a single row or column.
    values : dict
        Numbers for the symbols, by name.

    Raises
    ------
    ValueError
        If the answer has another form, or symbols without a value.
    """

    def number(entry):
        entry = entry.tolist() if isinstance(entry, (sympy.MatrixBase, np.ndarray)) else entry
        if isinstance(entry, (list, tuple)):
            return [number(item) for item in entry]
        entry = sympy.sympify(entry)
        foreign = sorted(symbol.name for symbol in entry.free_symbols if symbol.name not in values)
        if foreign:
            raise ValueError(
                f"{what}: the symbol {foreign[0]} is not one of {', '.join(values) or 'the given numbers'}"
            )
        return float(entry.subs({symbol: values[symbol.name] for symbol in entry.free_symbols}))

    array = np.array(number(answer))
    if len(shape) == 1 and array.ndim == 2 and 1 in array.shape:
        array = array.reshape(-1)
    return as_numbers(array, what, shape)


def numbers_in_rows(answer, what: str, width: int) -> np.ndarray:
    """An answer of several rows, of a single one, or of none, as floats: shape (k, width)."""
    answer = laid_out(answer)
    found = entries(answer)
    if not found:
        return np.empty((0, width))
    alone = array_shape(answer) in ((width,), (width, 1))
    return numbers([found] if alone else [list(row) for row in answer], what, (None, width), {})


def called(function, *arguments):
    """What a student's function returns; returning nothing counts as not attempted."""
    if not callable(function):
        raise ValueError(f"expected a function, found {type(function).__name__}")
    result = function(*arguments)
    result = laid_out(result)
    return [] if isinstance(result, list) and not result else attempted(result)


def say_if_not_rigid(ax, frame):
    """Write below the picture what keeps `frame`, shape (4, 4), from being a rigid displacement, if anything does."""
    rotation = frame[:3, :3]
    rigid = np.allclose(rotation.T @ rotation, np.eye(3), atol=1e-6) and np.allclose(frame[3], (0, 0, 0, 1), atol=1e-6)
    if not rigid:
        fault = "the axes are not orthogonal unit vectors"
    elif np.linalg.det(rotation) < 0:
        fault = "the axes are left-handed, a mirror image"
    else:
        return
    ax.figure.text(0.5, 0.01, f"not a rigid displacement: {fault}", ha="center")
