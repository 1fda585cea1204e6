"""Constant angles that were rounded, read as they are meant.

An angle that stands in an answer as a constant is a multiple of pi. Who writes 1.5708 means a quarter turn, and gets
``cos(1.5708)``, which is -3.67e-06, where a zero belongs. A number is changed by less than its last decimal, and only to
a multiple of pi / 12, 0, 1 or -1: no length comes nearer to the right one by it.
"""

from __future__ import annotations

import math
from fractions import Fraction

from .decode import Call, Constant, Expression, Number

ENOUGH = 4
"""Decimals of an angle that are taken for the exact one."""
FEWEST = 2
"""Decimals of an angle that are still recognized."""

_TWELFTH = math.pi / 12
_LARGEST = 8 * math.pi
_QUARTERS = range(1, 9)
_ALIKE = 1e-6  # of the last decimal: a cosine may have been multiplied by sines, which are nearly 1


def meant(expression: Expression, decimals: int = ENOUGH) -> Expression:
    """`expression` with exact multiples of pi in place of those given to at least so many decimals."""
    match expression:
        case Number(float() as value):
            return _exact(value, decimals)
        case Call(function, args):
            exact = tuple(meant(arg, decimals) for arg in args)
            return expression if exact == args else Call(function, exact)
    return expression


def _exact(value: float, decimals: int) -> Expression:
    size, last = abs(value), 10.0**-decimals
    twelfths = round(value / _TWELFTH) if size < _LARGEST else 0
    if twelfths and abs(value - twelfths * _TWELFTH) < last:
        return Call("mul", (Number(Fraction(twelfths, 12)), Constant("pi")))
    if 0 < size < last and _completes_quarters(math.asin(size), decimals):
        return Number(0)
    if 0 < 1 - size < last and _completes_quarters(math.acos(size), decimals):
        return Number(round(value))
    return Number(value)


def _completes_quarters(angle: float, decimals: int) -> bool:
    """Whether some quarter turns and `angle` more, or less, are a number of about so many decimals."""
    angles = [quarters * math.pi / 2 + sign * angle for quarters in _QUARTERS for sign in (1, -1)]
    near = _ALIKE * 10.0**-decimals
    return any(abs(one - round(one, places)) < near for one in angles for places in (decimals, decimals + 1))
