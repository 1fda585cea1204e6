"""What a derivation starts from: the table in letters, the pose that is given, and what the letters stand for.

As Khalil and Kleinfinger place the outer frames: frame 0 where frame 1 is at q_1 = 0, frame n so that d_n = 0. What a table
has there all the same belongs to the base and to the tool.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import sympy as sp

from ..tables import DHRow, DHTable
from ..transforms import rot_x, rot_z, trans_x, trans_z


@dataclass(frozen=True)
class Setting:
    """A robot as a derivation sees it.

    Attributes
    ----------
    name : str
    rows : tuple of DHRow
        Of the moving joints, with letters for lengths and oblique angles.
    unknowns : tuple of Symbol
        theta_i or r_i, the variables of the rows.
    joints : tuple of (Symbol, int, expression)
        Joint variable q, and sign and offset with ``unknown = sign q + offset``.
    base, tool : Matrix (4, 4)
        Before the first and behind the last row, in letters.
    tip : Matrix (4, 1) or None
        Where only the place of the tool counts: the tool in the last frame.
    values : dict of Symbol to float
        What the letters stand for, metres and radians.
    """

    name: str
    rows: tuple[DHRow, ...]
    unknowns: tuple[sp.Symbol, ...]
    joints: tuple[tuple[sp.Symbol, int, sp.Expr], ...]
    base: sp.ImmutableMatrix
    tool: sp.ImmutableMatrix
    tip: sp.ImmutableMatrix | None
    values: dict[sp.Symbol, float]


def setting_of(table: DHTable, point: bool) -> Setting:
    """The setting of a table; with `point`, only the place of the tool is given.

    Raises ValueError where a joint does not move its own row alone.
    """
    letters = {symbol for row in table.rows for entry in row.parameters for symbol in entry.free_symbols}
    letters |= table.base.free_symbols | table.tool.free_symbols
    letters -= set(table.joints)
    values = {symbol: float(table.values[symbol.name]) for symbol in letters if symbol.name in table.values}

    def lettered(entry: sp.Expr, name: str, angle: bool) -> sp.Expr:
        """A number as a letter, where it does not vanish and is no right angle."""
        if entry.free_symbols or entry == 0 or (angle and (entry * 2 / sp.pi).is_integer):
            return entry
        symbol = sp.Symbol(name)
        while symbol in letters:
            symbol = sp.Symbol(symbol.name + "p")
        values[symbol] = float(entry)
        return symbol

    rows, unknowns, joints = [], [], []
    for i, (joint, row) in enumerate(zip(table.joints, table.rows), start=1):
        sign = row.variable.diff(joint)
        offset = sp.expand(row.variable - sign * joint)
        if sign not in (1, -1) or offset.has(*table.joints):
            raise ValueError(f"row {i} is moved by {row.variable}, not by {joint} or -{joint} alone")
        unknown = sp.Symbol(f"{'r' if row.sigma else 'theta'}_{i}")
        a, alpha = lettered(row.a, f"a_{i - 1}", False), lettered(row.alpha, f"alpha_{i - 1}", True)
        constant = lettered(row.constant, f"beta_{i}" if row.sigma else f"d_{i}", bool(row.sigma))
        rows.append(DHRow(row.sigma, a, alpha, *((unknown, constant) if row.sigma else (constant, unknown))))
        unknowns.append(unknown)
        joints.append((joint, int(sign), offset))
    before, rows[0] = _base_and_rest(rows[0])
    behind = sp.eye(4)
    if not point:
        rows[-1], behind = _rest_and_tool(rows[-1])
    for row in table.rows[len(rows) :]:
        behind = behind * row.transform()
    base, tool = sp.ImmutableMatrix(table.base * before), sp.ImmutableMatrix(behind * table.tool)
    tip = None
    if point:
        entries = [lettered(entry, f"p_{letter}", False) for entry, letter in zip(tool[:3, 3], "xyz")]
        tip = sp.ImmutableMatrix([*entries, 1])
    return Setting(table.name, tuple(rows), tuple(unknowns), tuple(joints), base, tool, tip, values)


def _base_and_rest(row: DHRow) -> tuple[sp.Matrix, DHRow]:
    """The first row as a constant transform and a row with nothing but its joint."""
    before = trans_x(row.a) * rot_x(row.alpha)
    zero = sp.S.Zero
    if row.sigma:
        return before * rot_z(row.theta), DHRow(1, zero, zero, row.d, zero)
    return before * trans_z(row.d), DHRow(0, zero, zero, zero, row.theta)


def _rest_and_tool(row: DHRow) -> tuple[DHRow, sp.Matrix]:
    """The last row without its constant, which does not care whether it comes before or behind the joint."""
    if row.sigma:
        return replace(row, theta=sp.S.Zero), rot_z(row.theta)
    return replace(row, d=sp.S.Zero), trans_z(row.d)
