"""What every picture of a student's result shares: numbers out of an answer, and a card where there is nothing to draw."""

from __future__ import annotations

from functools import wraps

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.patches import Rectangle

from ..strokes import SOFT, as_numbers, styled


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
            return show(attempted(answer), *args, **kwargs)
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


def entries(answer) -> list:
    if isinstance(answer, (sympy.MatrixBase, np.ndarray)):
        return entries(answer.tolist())
    if isinstance(answer, (list, tuple)):
        return [entry for item in answer for entry in entries(item)]
    return [answer]


def numbers(answer, what: str, shape: tuple, values: dict[str, float]) -> np.ndarray:
    """The answer as floats, with `values` put in for its symbols by name."""

    def number(entry):
        entry = entry.tolist() if isinstance(entry, np.ndarray) else entry
        if isinstance(entry, (list, tuple)):
            return [number(item) for item in entry]
        entry = sympy.sympify(entry)
        foreign = sorted(symbol.name for symbol in entry.free_symbols if symbol.name not in values)
        if foreign:
            raise ValueError(
                f"{what}: the symbol {foreign[0]} is not one of {', '.join(values) or 'the given numbers'}"
            )
        return float(entry.subs({symbol: values[symbol.name] for symbol in entry.free_symbols}))

    nested = answer.tolist() if isinstance(answer, (sympy.MatrixBase, np.ndarray)) else answer
    array = np.array(number(nested))
    if len(shape) == 1 and array.ndim == 2 and 1 in array.shape:
        array = array.reshape(-1)
    return as_numbers(array, what, shape)


def called(function, *arguments):
    """What a student's function returns; returning nothing counts as not attempted."""
    result = _function(function)(*arguments)
    return [] if isinstance(result, (list, tuple, np.ndarray)) and len(result) == 0 else attempted(result)


def _function(answer):
    if not callable(answer):
        raise ValueError(f"expected a function, found {type(answer).__name__}")
    return answer
