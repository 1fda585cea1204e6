"""What a derivation starts from: the table in letters, the pose that is given, and what the letters stand for."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..tables import DHRow, DHTable


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
    tool = sp.eye(4)
    for row in table.rows[len(rows) :]:
        tool = tool * row.transform()
    tool = sp.ImmutableMatrix(tool * table.tool)
    tip = None
    if point:
        entries = [lettered(entry, f"p_{letter}", False) for entry, letter in zip(tool[:3, 3], "xyz")]
        tip = sp.ImmutableMatrix([*entries, 1])
    ends = (sp.ImmutableMatrix(table.base), tool, tip)
    return Setting(table.name, tuple(rows), tuple(unknowns), tuple(joints), *ends, values)
