"""A robot described in a file: its table, what its letters measure, and a configuration to come back to."""

from __future__ import annotations

import ast
import operator
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass

import msgspec
import numpy as np
import sympy

from autograder.reference import DHTable, Robot
from dhkit.schema import convert

FILE = "robot.toml"
_OPERATIONS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}


class _File(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    title: str
    joints: list[str]
    rows: list[tuple[int, float | str, float | str, float | str, float | str]]
    lengths: dict[str, float] = {}
    posture: list[float] = []
    source: str = ""


@dataclass(frozen=True, eq=False)
class Described:
    """A robot as its file has it.

    Attributes
    ----------
    title : str
    table : DHTable
        With letters for joints and lengths, and numbers for the lengths.
    posture : tuple of float
        Joint values, (n,), whose pose is asked back; empty where the inverse model is not asked for.
    source : str
        Where the numbers of a robot that can be bought are from; empty for one that is made up.
    """

    title: str
    table: DHTable
    posture: tuple[float, ...] = ()
    source: str = ""

    @property
    def joints(self) -> list[str]:
        """The names of the joint variables."""
        return [str(joint) for joint in self.table.joints]

    @property
    def letters(self) -> list[str]:
        """Joint variables, then lengths."""
        return [*self.joints, *self.table.values]

    @property
    def robot(self) -> Robot:
        return Robot(self.table)

    @property
    def target(self) -> np.ndarray:
        """The pose of the posture, (4, 4)."""
        return self.table.forward(self.posture)


def describe(text: str) -> Described:
    """A robot from the text of its file.

    The file says ``title``; ``joints``, the names of the joint variables in order; ``rows``, lists
    ``[sigma, a, alpha, d, theta]`` of numbers, or texts of numbers, ``pi`` and letters; ``[lengths]``, a number for each
    letter that is no joint; where the inverse model is asked for, ``posture``, one value for each joint; and ``source``,
    where the numbers are from, if somebody has published them.

    Raises
    ------
    ValueError
        Naming the field, the row or the letter that does not fit.
    """
    try:
        return robot_of(FILE, tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"{FILE}: {error}") from None


def robot_of(where: str, fields: Mapping[str, object]) -> Described:
    """A robot from its fields, see `describe`; `where` they stand is named in errors."""
    found = convert(fields, _File)
    names = [*found.joints, *found.lengths]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise ValueError(f"{where}: {', '.join(twice)} is named twice")
    for name in names:
        if not name.isidentifier() or name == "pi":
            raise ValueError(f"{where}: {name!r} cannot be a letter; it needs letters, digits and underscores")
    symbols = {name: sympy.Symbol(name) for name in names}
    rows = []
    for number, row in enumerate(found.rows, 1):
        try:
            rows.append([row[0], *(_expression(entry, symbols) for entry in row[1:])])
        except ValueError as error:
            raise ValueError(f"{where}: row {number}: {error}") from None
    if found.posture and len(found.posture) != len(found.joints):
        raise ValueError(
            f"{where}: posture: expected {len(found.joints)} values, one for each joint, found {len(found.posture)}"
        )
    joints = [symbols[name] for name in found.joints]
    table = DHTable(rows, found.title, joints, values=found.lengths)
    return Described(found.title, table, tuple(map(float, found.posture)), found.source)


def _expression(entry: float | str, symbols: dict[str, sympy.Symbol]) -> sympy.Expr:
    """An entry of a table: sums and products of numbers, pi and letters."""
    if not isinstance(entry, str):
        return sympy.nsimplify(entry, rational=True) if float(entry).is_integer() else sympy.Float(entry)
    try:
        tree = ast.parse(entry.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ValueError(f"{entry!r} is no formula") from None

    def value(node: ast.expr) -> sympy.Expr:
        match node:
            case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
                return sympy.Integer(number) if isinstance(number, int) else sympy.Float(number)
            case ast.Name(id="pi"):
                return sympy.pi
            case ast.Name(id=name) if name in symbols:
                return symbols[name]
            case ast.Name(id=name):
                raise ValueError(f"{name!r} is neither a joint nor a length; known: {', '.join(symbols)}")
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATIONS:
                return _OPERATIONS[type(op)](value(left), value(right))
            case ast.UnaryOp(op=op, operand=operand) if type(op) in _OPERATIONS:
                return _OPERATIONS[type(op)](value(operand))
        raise ValueError(f"{entry!r} is not made of numbers, pi, letters and + - * /")

    return value(tree)
