"""How many answers somebody would have to try who knows the question but not the answer, in bits.

An estimate from below, for guessing with a list of plausible answers rather than blindly. An expression counts by the
length of its description: which symbol, which number, which operation. A number counts by the cells of the grid in the
range where it can be; one that is round counts as one of a few. Entries that say the same count once, but for those of a
table, where each cell has to be chosen.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf, log2

import numpy as np

from dhkit.forms import Form
from dhkit.forms.base import Parts, Sight
from dhkit.forms.dh_table import DHTable
from dhkit.forms.direction import Direction
from dhkit.forms.joint_solutions import JointSolutions
from dhkit.home.cells import WIDTH
from dhkit.nodes import entries
from dhkit.values import reals

ENOUGH = 30.0
"""Bits that an answer must have to be sealed: a thousand million trials at some hundredths of a second each."""

ROUND = 4.0  # bits of a number that is a multiple of a tenth, or of fifteen degrees
_RANGE = 2.0  # metres, or units, in which a number is expected
SECONDS_A_KEY = 0.02  # on a laptop of 2026
_SECONDS_A_YEAR = 365 * 86400
_MOST_BITS = 1000.0  # a matrix of a seven-axis arm has more


def years(bits: float, seconds_a_key: float) -> float:
    """Time until half of the plausible answers have been tried on one core; infinite where it cannot be counted."""
    trials = 2.0 ** (bits - 1) if bits < _MOST_BITS else inf
    return trials * seconds_a_key / _SECONDS_A_YEAR


def bits_of_parts(form: Form, node: object, sight: Sight, parts: Parts) -> dict[str, float]:
    """Bits of the whole answer and of each of its parts.

    Parameters
    ----------
    form : Form
    node : object
        The arranged answer.
    sight : Sight
    parts : dict
        What ``form.invariants`` says of the answer.
    """
    if isinstance(form, JointSolutions):
        rows = reals(node, {}).reshape(-1, len(form.joints))
        alone = [sum(_number(value, joint in sight.angles, sight) for joint, value in enumerate(row)) for row in rows]
        return {part: min(alone, default=0.0) if part else sum(alone) for part in parts}
    cells = list(entries(node))
    if len(form.shape) == 2 and "rotation" in parts:
        place = np.arange(len(cells)).reshape(form.shape)
        blocks = {"": place, "rotation": place[:-1, :-1], "position": place[:-1, -1]}
        return {part: _entries(form, [cells[i] for i in blocks[part].ravel()], sight) for part in parts}
    bits = _entries(form, cells, sight)
    if isinstance(form, Direction) and not form.symbols:
        bits *= (len(cells) - 1) / len(cells)
    return {"": bits}


def bits_of_results(results: Sequence[np.ndarray], tolerance: float) -> float:
    """Bits of what a function returns for several arguments: of the values that are not the same everywhere."""
    distinct = {tuple(np.round(result / (WIDTH * tolerance)).tolist()): result for result in results}
    if len(distinct) < 2:
        return 0.0
    values = {value for result in distinct.values() for value in result.tolist()}
    fresh = sum(1 for value in values if not _is_round(value))
    return fresh * log2(1 / (WIDTH * tolerance)) + len(results) * log2(len(distinct))


def _entries(form: Form, cells: Sequence[object], sight: Sight) -> float:
    if isinstance(form, DHTable):
        return sum(_expression(cell, form.symbols, False, sight) for cell in cells)
    different = {repr(_unsigned(cell)): cell for cell in cells}
    angles = {repr(_unsigned(cell)) for place, cell in enumerate(cells) if place in sight.angles}
    return sum(_expression(cell, form.symbols, said in angles, sight) for said, cell in different.items())


def _unsigned(node: object) -> object:
    """A node without its sign, which takes one bit only."""
    match node:
        case int() | float():
            return abs(node)
        case {"call": ["mul", -1, *rest]}:
            return {"call": ["mul", *rest]} if len(rest) > 1 else rest[0]
    return node


def _expression(node: object, symbols: Sequence[str], angle: bool, sight: Sight) -> float:
    match node:
        case bool():
            return 1.0
        case {"sym": _}:
            return log2(len(symbols) + 2)
        case {"const": _} | {"rat": _}:
            return 2.0
        case {"call": ["pow", {"call": ["pow", inner, 2]}, {"rat": [1, 2]}]}:  # what is left of Abs
            return 2.5 + _expression(inner, symbols, angle, sight)
        case {"call": ["mul", -1, *args]}:
            return 1.0 + sum(_expression(arg, symbols, angle, sight) for arg in args)
        case {"call": [_, *args]}:
            return 2.5 + sum(_expression(arg, symbols, angle, sight) for arg in args)
        case int() | float() if symbols:
            return 1.0 if node in (0, 1, -1, 2) else ROUND
        case int() | float():
            return _number(float(node), angle, sight)
    return 2.0


def _number(value: float, angle: bool, sight: Sight) -> float:
    if _is_round(value) or (angle and _is_round(value / (np.pi / 12), 1.0)):
        return ROUND
    return log2((2 * np.pi if angle else _RANGE * max(1.0, abs(value))) / (WIDTH * sight.tolerance))


def _is_round(value: float, step: float = 0.1) -> bool:
    return abs(value / step - round(value / step)) < 1e-6
