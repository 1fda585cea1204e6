"""Constant angles that were rounded, read as they are meant.

An angle that stands in an answer as a constant is a multiple of pi. Who writes 1.5708 means a quarter turn, and gets
``cos(1.5708)``, which is -3.67e-06, where a zero belongs. A number is changed by less than its last decimal, and only to
a multiple of pi / 12, 0, 1 or -1: no length comes nearer to the right one by it.
"""

from __future__ import annotations

import math
from fractions import Fraction

ENOUGH = 4
"""Decimals of an angle that are taken for the exact one."""
FEWEST = 2
"""Decimals of an angle that are still recognized."""

_TWELFTH = math.pi / 12
_LARGEST = 8 * math.pi
_QUARTERS = range(1, 9)
_MORE = 4  # decimals that may be given besides: 1.570796 is meant as 1.5708 is
_ALIKE = 1e-6  # of the last decimal: a cosine may have been multiplied by sines, which are nearly 1


def half_turns(value: float, decimals: int = ENOUGH) -> Fraction | None:
    """The multiple of pi that `value` is to at least so many decimals, None if it is none."""
    twelfths = round(value / _TWELFTH) if abs(value) < _LARGEST else 0
    near = twelfths and abs(value - twelfths * _TWELFTH) < 10.0**-decimals
    return Fraction(twelfths, 12) if near else None


def cosine(value: float, decimals: int = ENOUGH) -> int | None:
    """0, 1 or -1 where `value` is the sine or cosine of quarter turns given to so many decimals; None elsewhere."""
    size, last = abs(value), 10.0**-decimals
    if 0 < size < last and _completes_quarters(math.asin(size), decimals):
        return 0
    if 0 < 1 - size < last and _completes_quarters(math.acos(size), decimals):
        return round(value)
    return None


def _completes_quarters(angle: float, decimals: int) -> bool:
    """Whether some quarter turns and `angle` more, or less, are a number of about so many decimals."""
    angles = [quarters * math.pi / 2 + sign * angle for quarters in _QUARTERS for sign in (1, -1)]
    return any(
        abs(one - round(one, places)) < _ALIKE * 10.0**-places
        for one in angles
        for places in range(decimals, decimals + _MORE)
    )


def meant(node: object) -> object:
    """A node of an answer with exact numbers in place of those given to at least `ENOUGH` decimals."""
    match node:
        case list():
            return [meant(item) for item in node]
        case float():
            if (turns := half_turns(node)) is not None:
                return {"call": ["mul", {"rat": [turns.numerator, turns.denominator]}, {"const": "pi"}]}
            return node if (exact := cosine(node)) is None else exact
        case {"call": [name, *args]}:
            return {"call": [name, *map(meant, args)]}
    return node
