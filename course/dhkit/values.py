"""Numbers behind the nodes of an answer (see `dhkit.wire`), with values put in for its symbols."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import reduce
from typing import Any

import numpy as np


def _real(x: Any) -> Any:
    """The real part where it is the whole value, but for rounding; nan elsewhere."""
    return np.where(np.abs(np.imag(x)) <= 1e-12 * np.abs(x), np.real(x), np.nan)


def _first_that_holds(parts: Any) -> Any:
    """The value before the first condition that holds, nan where none does; values and conditions take turns."""
    result: Any = np.complex128(np.nan)
    for value, holds in zip(parts[-2::-2], parts[::-2], strict=True):
        result = np.where(np.real(holds) == 1, value, result)
    return result


OPERATIONS: dict[str, Callable] = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan,
    "cot": lambda x: 1 / np.tan(x), "sec": lambda x: 1 / np.cos(x), "csc": lambda x: 1 / np.sin(x),
    "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "acot": lambda x: np.arctan(1 / x),
    "atan2": lambda y, x: np.arctan2(_real(y), _real(x)) + 0j,
    "exp": np.exp, "log": np.log, "Abs": lambda x: np.abs(x) + 0j, "sign": lambda x: np.sign(_real(x)) + 0j,
    "Max": lambda *xs: reduce(np.maximum, map(_real, xs)) + 0j, "Min": lambda *xs: reduce(np.minimum, map(_real, xs)) + 0j,
    "re": lambda x: np.real(x) + 0j, "im": lambda x: np.imag(x) + 0j, "arg": lambda x: np.angle(x) + 0j, "conjugate": np.conjugate,
    "floor": lambda x: np.floor(_real(x)) + 0j, "ceiling": lambda x: np.ceil(_real(x)) + 0j,
    "lt": lambda x, y: np.less(_real(x), _real(y)) + 0j, "le": lambda x, y: np.less_equal(_real(x), _real(y)) + 0j,
    "gt": lambda x, y: np.greater(_real(x), _real(y)) + 0j, "ge": lambda x, y: np.greater_equal(_real(x), _real(y)) + 0j,
    "eq": lambda x, y: np.equal(x, y) + 0j, "ne": lambda x, y: np.not_equal(x, y) + 0j,
    "and": lambda *xs: reduce(operator.mul, xs), "or": lambda *xs: reduce(np.maximum, map(_real, xs)) + 0j,
    "not": lambda x: 1 - x, "Piecewise": lambda *parts: _first_that_holds(parts),
    "Mod": lambda x, y: np.mod(_real(x), _real(y)) + 0j,
    "add": lambda *xs: reduce(operator.add, xs), "mul": lambda *xs: reduce(operator.mul, xs), "pow": np.power,
}  # fmt: skip
"""What the wire's operations and functions compute, on complex numbers or arrays of them."""

CONSTANTS = {"pi": np.complex128(np.pi), "E": np.complex128(np.e), "I": np.complex128(1j)}


def as_complex(number: Any) -> np.complex128:
    """As NumPy's number, which divides by zero without an exception."""
    try:
        return np.complex128(number)
    except OverflowError:
        return np.complex128(np.inf)


def values(node: object, at: Mapping[str, float]) -> np.ndarray:
    """Complex values of an array of expressions, in its shape; nan or inf where undefined.

    Parameters
    ----------
    node : object
        Nested lists of numbers, expressions and blanks (which count as nan), or a single one.
    at : mapping of str to float
        A value for each symbol.
    """
    with np.errstate(all="ignore"):
        return np.array(_nested(node, at), dtype=complex)


def reals(node: object, at: Mapping[str, float]) -> np.ndarray:
    """As `values`, real; nan where a value is not."""
    found = values(node, at)
    with np.errstate(all="ignore"):
        return np.where(np.abs(found.imag) <= 1e-9 * np.maximum(1, np.abs(found.real)), found.real, np.nan)


def _nested(node: object, at: Mapping[str, float]) -> Any:
    return [_nested(item, at) for item in node] if isinstance(node, list) else _value(node, at)


def _value(node: object, at: Mapping[str, float]) -> np.complex128:
    match node:
        case bool() | int() | float():
            return as_complex(node)
        case {"int": digits}:
            return as_complex(int(digits))
        case {"float": name}:
            return as_complex(float(name))
        case {"complex": [real, imaginary]}:
            return np.complex128(complex(_value(real, at).real, _value(imaginary, at).real))
        case {"rat": [numerator, denominator]}:
            return as_complex(Fraction(_whole(numerator), _whole(denominator)))
        case {"const": name}:
            return CONSTANTS[name]
        case {"sym": name}:
            return np.complex128(at[name])
        case {"call": [name, *args]}:
            return OPERATIONS[name](*(_value(arg, at) for arg in args))
        case {"blank": _}:
            return np.complex128(np.nan)
    raise TypeError("no number stands behind this node")


def _whole(node: Any) -> int:
    return int(node["int"]) if isinstance(node, dict) else int(node)
