"""Values of decoded expressions at sample points: NumPy first, mpmath where float64 cannot decide."""

from __future__ import annotations

import operator
from collections.abc import Mapping
from fractions import Fraction
from functools import reduce

import mpmath
import numpy as np

from dhkit.values import CONSTANTS, OPERATIONS, as_complex

from .decode import Call, Constant, Expression, Foreign, Number, Symbol

_MPMATH = {
    "sin": mpmath.sin, "cos": mpmath.cos, "tan": mpmath.tan,
    "cot": mpmath.cot, "sec": mpmath.sec, "csc": mpmath.csc,
    "asin": mpmath.asin, "acos": mpmath.acos, "atan": mpmath.atan, "acot": mpmath.acot,
    "atan2": lambda y, x: mpmath.atan2(mpmath.re(y), mpmath.re(x)),
    "exp": mpmath.exp, "log": mpmath.log, "Abs": abs, "sign": mpmath.sign,
    "Max": lambda *xs: max(map(mpmath.re, xs)), "Min": lambda *xs: min(map(mpmath.re, xs)),
    "re": mpmath.re, "im": mpmath.im, "arg": mpmath.arg, "conjugate": mpmath.conj,
    "floor": lambda x: mpmath.floor(mpmath.re(x)), "ceiling": lambda x: mpmath.ceil(mpmath.re(x)),
    "lt": lambda x, y: mpmath.mpf(mpmath.re(x) < mpmath.re(y)), "le": lambda x, y: mpmath.mpf(mpmath.re(x) <= mpmath.re(y)),
    "gt": lambda x, y: mpmath.mpf(mpmath.re(x) > mpmath.re(y)), "ge": lambda x, y: mpmath.mpf(mpmath.re(x) >= mpmath.re(y)),
    "eq": lambda x, y: mpmath.mpf(x == y), "ne": lambda x, y: mpmath.mpf(x != y),
    "and": min, "or": max, "not": lambda x: 1 - x,
    "Mod": lambda x, y: mpmath.re(x) - mpmath.re(y) * mpmath.floor(mpmath.re(x) / mpmath.re(y)),
    "add": lambda *xs: reduce(operator.add, xs), "mul": lambda *xs: reduce(operator.mul, xs), "pow": operator.pow,
}  # fmt: skip

_DIGITS = 40
# Beyond these sizes a value says nothing about a robot, and computing it with many digits would cost without bound.
_MAX_EXPONENT = 1000
_MAX_ARGUMENT = 1e6


def evaluate(expression: Expression, samples: Mapping[str, np.ndarray]) -> np.ndarray:
    """Complex values of `expression` at N sample points given as one (N,) array per symbol; nan or inf where undefined."""
    values = np.empty(len(next(iter(samples.values()), (0,))), complex)
    with np.errstate(all="ignore"):
        values[:] = _evaluate(expression, samples)
    return values


def _evaluate(expression: Expression, samples: Mapping[str, np.ndarray]):
    match expression:
        case Number(value):
            return as_complex(value)
        case Constant(name):
            return CONSTANTS[name]
        case Symbol(name):
            return samples[name] + 0j
        case Call(function, args):
            return OPERATIONS[function](*(_evaluate(arg, samples) for arg in args))
        case Foreign():
            return np.nan


def evaluate_exactly(expression: Expression, point: Mapping[str, float]) -> mpmath.mpc | None:
    """Value at one point with 40 digits; None where it is undefined."""
    with mpmath.workdps(_DIGITS):
        try:
            return mpmath.mpmathify(_evaluate_exactly(expression, point))
        except (ZeroDivisionError, ValueError, OverflowError, TypeError):
            return None


def _evaluate_exactly(expression: Expression, point: Mapping[str, float]):
    match expression:
        case Number(Fraction() as value):
            return mpmath.mpf(value.numerator) / value.denominator
        case Number(value):
            return mpmath.mpmathify(value)
        case Constant(name):
            return {"pi": mpmath.pi(), "E": mpmath.e(), "I": mpmath.j}[name]
        case Symbol(name):
            return mpmath.mpf(float(point[name]))
        case Call("pow", (base, exponent)):
            power = _evaluate_exactly(exponent, point)
            if abs(power) > _MAX_EXPONENT:
                raise OverflowError
            return _evaluate_exactly(base, point) ** power
        case Call("Piecewise", args):
            return _first_that_holds(args, point)
        case Call(function, args):
            values = [_evaluate_exactly(arg, point) for arg in args]
            if function not in ("add", "mul") and any(abs(value) > _MAX_ARGUMENT for value in values):
                raise OverflowError
            return _MPMATH[function](*values)
        case Foreign():
            raise ValueError


def _first_that_holds(parts: tuple[Expression, ...], point: Mapping[str, float]):
    """The value before the first condition that holds; `ValueError` if none does."""
    for value, condition in zip(parts[::2], parts[1::2], strict=True):
        if _evaluate_exactly(condition, point) == 1:
            return _evaluate_exactly(value, point)
    raise ValueError


def symbols(expression: Expression) -> frozenset[str]:
    """Names of the symbols in `expression`."""
    match expression:
        case Symbol(name):
            return frozenset({name})
        case Call(_, args):
            return frozenset().union(*map(symbols, args))
    return frozenset()


def size(expression: Expression) -> int:
    """Number of nodes of `expression`."""
    return 1 + sum(map(size, expression.args)) if isinstance(expression, Call) else 1
