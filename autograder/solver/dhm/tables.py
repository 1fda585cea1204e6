"""Modified Denavit-Hartenberg tables: rows, transforms, recursion, rendering, conversions.

A table describes a serial robot by rows (sigma_i, a_{i-1}, alpha_{i-1}, d_i, theta_i), the
template of the MECA 953 slides: sigma_i = 0 for a revolute joint (variable theta_i), 1 for a
prismatic one (variable d_i), ``q_i = (1 - sigma_i) theta_i + sigma_i d_i``.
Lengths in metres, angles in radians, entries numeric or symbolic.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property, partial
from numbers import Real
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from . import forward as _forward
from .markdown import DEGREES, MILLIMETRES, Markdown, in_unit, latex
from .markdown import table as markdown_table
from .transforms import (
    exact_angle,
    modified_dh,
    modified_dh_inverse,
    rigid_inverse,
    rot_x,
    trans_x,
)

_COLUMNS = ("sigma", "a", "alpha", "d", "theta")
_HEADS = (r"\sigma_i", "a_{i-1}", r"\alpha_{i-1}", "d_i", r"\theta_i")


@dataclass(frozen=True)
class DHRow:
    """One row of a modified DH table.

    Attributes
    ----------
    sigma : int
        0 revolute, 1 prismatic.
    a, d : number or SymPy expression
        Metres.
    alpha, theta : number or SymPy expression
        Radians; floats within 1e-12 of a multiple of 15 degrees are taken as exact angles, and those within 1e-4 of a
        multiple of 90 degrees too, with a `RoundedInput` warning.

    Raises
    ------
    ValueError
        Naming the entry that is not a number or an expression.
    """

    sigma: int
    a: sp.Expr
    alpha: sp.Expr
    d: sp.Expr
    theta: sp.Expr

    def __post_init__(self) -> None:
        if isinstance(self.sigma, bool) or self.sigma not in (0, 1):
            raise ValueError(f"sigma must be 0 (revolute) or 1 (prismatic), found {self.sigma!r}")
        object.__setattr__(self, "sigma", int(self.sigma))
        for column in _COLUMNS[1:]:
            value = _expression(getattr(self, column), column)
            if column in ("alpha", "theta"):
                value = exact_angle(value, column)
            object.__setattr__(self, column, value)

    @property
    def parameters(self) -> tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr]:
        """(a, alpha, d, theta)."""
        return self.a, self.alpha, self.d, self.theta

    @property
    def variable(self) -> sp.Expr:
        """The entry the joint acts on: theta if revolute, d if prismatic."""
        return self.d if self.sigma else self.theta

    @property
    def constant(self) -> sp.Expr:
        """The other one of d and theta."""
        return self.theta if self.sigma else self.d

    def transform(self) -> sp.Matrix:
        """Frame i seen from frame i-1, 4x4."""
        return modified_dh(*self.parameters)

    def inverse_transform(self) -> sp.Matrix:
        """Frame i-1 seen from frame i, 4x4."""
        return modified_dh_inverse(*self.parameters)


Row = DHRow | Sequence[Any]
"""A row of a table, or its entries (sigma, a, alpha, d, theta)."""


@dataclass(frozen=True, init=False)
class DHTable:
    """A serial robot in modified DH.

    Parameters
    ----------
    rows : iterable of DHRow or of (sigma, a, alpha, d, theta)
        Metres and radians. ``None`` in the place of the joint variable stands for q1, q2, ... A row without joint
        variable is constant (a tool row).
    name : str
        For headings and messages.
    joints : iterable of Symbol, optional
        The joint variables in order. By default the one symbol found in each joint entry; needed when an entry holds
        a symbolic offset (``r3 + r30``) or couples joints.
    base, tool : 4x4 matrices, optional
        Constant transforms before the first and after the last frame.
    limits : iterable of pairs, optional
        One (lower, upper) per joint, radians or metres.
    values : mapping, optional
        Numbers for the letters of the table (lengths, offsets), by name. Symbolic results keep the letters, numeric
        ones use the values.

    Raises
    ------
    ValueError
        In words, for a wrong number of columns, an entry that is not a number or expression, sigma outside {0, 1}, or
        a joint entry that is not a sum of joints and constants.

    Source: template of the MECA 953 slides; W. Khalil, J. Kleinfinger, "A new geometric notation for open and
    closed-loop robots", ICRA 1986, doi:10.1109/ROBOT.1986.1087552.
    """

    rows: tuple[DHRow, ...]
    name: str
    joints: tuple[sp.Symbol, ...]
    base: sp.ImmutableMatrix
    tool: sp.ImmutableMatrix
    limits: tuple[tuple[float, float], ...] | None
    values: Mapping[str, float] = field(hash=False)
    _coupling: tuple[sp.Matrix, list[sp.Expr]] = field(init=False, repr=False, compare=False)

    def __init__(
        self,
        rows: Iterable[Row],
        name: str = "",
        joints: Iterable[sp.Symbol] | None = None,
        base: sp.Matrix | None = None,
        tool: sp.Matrix | None = None,
        limits: Iterable[tuple[float, float]] | None = None,
        values: Mapping[str, float] | None = None,
    ) -> None:
        checked = tuple(_row(row, i) for i, row in enumerate(rows, start=1))
        if not checked:
            raise ValueError("a DH table needs at least one row")
        variables = _found_joints(checked) if joints is None else tuple(joints)
        if len(set(variables)) != len(variables):
            raise ValueError(f"a joint variable stands in two rows: {variables}; name them in joints=")
        self.__dict__.update(
            rows=checked,
            name=name,
            joints=variables,
            base=_transform(base, "base"),
            tool=_transform(tool, "tool"),
            limits=_checked_limits(limits, variables),
            values=dict(values or {}),
            _coupling=_coupled(checked, variables),
        )

    @property
    def moving(self) -> list[DHRow]:
        """The rows that hold a joint variable; the others are constant."""
        return [row for row in self.rows if row.variable.free_symbols & set(self.joints)]

    def transforms(self) -> list[sp.Matrix]:
        """The elementary transforms [0T1, 1T2, ...], one 4x4 per row."""
        return [row.transform() for row in self.rows]

    def inverse_transforms(self) -> list[sp.Matrix]:
        """The transforms [1T0, 2T1, ...], one 4x4 per row."""
        return [row.inverse_transform() for row in self.rows]

    def product(self) -> sp.Matrix:
        """base 0T1 1T2 ... tool multiplied out as it stands, nothing merged."""
        result = sp.Matrix(self.base)
        for transform in self.transforms():
            result = result * transform
        return result * self.tool

    def inverse_transform(self) -> sp.Matrix:
        """The base seen from the tool, 4x4: the inverse matrix of `symbolic_forward`."""
        return rigid_inverse(self.symbolic_forward())

    def recursion(self) -> list[sp.Matrix]:
        """[U_0, ..., U_n] with U_n = tool, U_{j-1} = j-1Tj U_j (MECA 953 slides)."""
        return _forward.recursion(self.rows, self.tool)

    def symbolic_forward(self) -> sp.Matrix:
        """Forward kinematics as a 4x4 SymPy matrix in textbook form (parallel axes merged)."""
        return self.base * self.recursion()[0]

    def symbolic_jacobian(self) -> sp.Matrix:
        """Geometric Jacobian of the tool point in the base's axes, 6 x n, in letters.

        Rows 0 to 2 are the velocity of the tool point, rows 3 to 5 the angular velocity, per unit of each joint's speed;
        metres and radians. `singularities.jacobian` is the same in numbers.
        """
        place = self.symbolic_forward()[:3, 3]
        axes = [
            sp.zeros(3, 1) if row.sigma else (self.base * _forward.recursion(self.rows[:i], sp.eye(4))[0])[:3, 2]
            for i, row in enumerate(self.rows, start=1)
        ]
        return place.jacobian(self.joints).col_join(sp.Matrix.hstack(*axes) * self._coupling[0])

    def forward(self, q: ArrayLike) -> np.ndarray:
        """Forward kinematics: q of shape (..., n), radians or metres -> poses (..., 4, 4)."""
        return self.chain.forward(q)

    @cached_property
    def chain(self) -> _forward.Chain:
        """The table as numbers. Raises ValueError naming the letters that have no value."""
        if self.values:
            return self.at(self.values).chain
        matrix, offsets = self._coupling
        free = set().union(
            *(row.a.free_symbols | row.alpha.free_symbols for row in self.rows),
            *(row.constant.free_symbols for row in self.rows),
            *(offset.free_symbols for offset in offsets),
            self.base.free_symbols,
            self.tool.free_symbols,
        )
        if free:
            names = ", ".join(sorted(map(str, free)))
            raise ValueError(f"give numbers for {names} first: table.at({{...}})")
        return _forward.Chain(
            a=_numbers(row.a for row in self.rows),
            cos_alpha=_numbers(sp.cos(row.alpha) for row in self.rows),
            sin_alpha=_numbers(sp.sin(row.alpha) for row in self.rows),
            fixed=_numbers(row.constant for row in self.rows),
            prismatic=np.array([bool(row.sigma) for row in self.rows]),
            coupling=_numbers(matrix).reshape(matrix.shape),
            offset=_numbers(offsets),
            base=_numbers(self.base).reshape(4, 4),
            tool=_numbers(self.tool).reshape(4, 4),
        )

    def at(self, values: Mapping[Any, Any]) -> DHTable:
        """The same table with symbols replaced: ``table.at({"a2": 0.3, d3: 0.1})``.

        Keys are symbols or their names. Raises ValueError for a name the table does not use.
        """
        by_name = {str(symbol): value for symbol, value in values.items()}
        known = {s.name: s for row in self.rows for e in row.parameters for s in e.free_symbols}
        known |= {s.name: s for m in (self.base, self.tool) for s in m.free_symbols}
        unknown = sorted(set(by_name) - set(known))
        if unknown:
            raise ValueError(f"no symbol {', '.join(unknown)} in the table: it has {sorted(known)}")
        chosen = {known[name]: value for name, value in by_name.items()}
        return DHTable(
            [DHRow(row.sigma, *(entry.subs(chosen) for entry in row.parameters)) for row in self.rows],
            self.name,
            [joint for joint in self.joints if joint not in chosen],
            self.base.subs(chosen),
            self.tool.subs(chosen),
            self.limits,
            {name: value for name, value in self.values.items() if name not in by_name},
        )

    def with_values(self, values: Mapping[str, float], limits: Iterable[tuple[float, float]] | None = None) -> DHTable:
        """The same table with numbers behind its letters, and joint limits."""
        copy = object.__new__(DHTable)
        kept = {name: value for name, value in self.__dict__.items() if name in {each.name for each in fields(self)}}
        copy.__dict__.update(kept, limits=_checked_limits(limits, self.joints), values=dict(values))
        return copy

    def to_classic(self) -> ClassicTable:
        """The same robot in classic DH: column a_i, alpha_i moved up by one row."""
        first = self.rows[0]
        shifted = [(row.a, row.alpha) for row in self.rows[1:]] + [(sp.S.Zero, sp.S.Zero)]
        rows = tuple(DHRow(row.sigma, a, alpha, row.d, row.theta) for row, (a, alpha) in zip(self.rows, shifted))
        base = self.base * trans_x(first.a) * rot_x(first.alpha)
        return ClassicTable(rows, self.name, self.joints, sp.ImmutableMatrix(base), self.tool, self.values, self.limits)

    @classmethod
    def from_classic(cls, rows: Iterable[Row], *, tool: sp.Matrix | None = None, **options: Any) -> DHTable:
        """A modified table from classic rows (sigma, a_i, alpha_i, d_i, theta_i).

        The last a_n, alpha_n become part of the tool. Options as for DHTable.
        """
        classic = [_row(row, i) for i, row in enumerate(rows, start=1)]
        shifted = [(sp.S.Zero, sp.S.Zero)] + [(row.a, row.alpha) for row in classic]
        modified = [DHRow(row.sigma, a, alpha, row.d, row.theta) for row, (a, alpha) in zip(classic, shifted)]
        a, alpha = shifted[-1]
        return cls(modified, tool=trans_x(a) * rot_x(alpha) * _transform(tool, "tool"), **options)

    def to_markdown(self, degrees: bool = False, millimetres: bool = False) -> Markdown:
        """The table in the slides' layout (i, sigma_i, a_{i-1}, alpha_{i-1}, d_i, theta_i), which notebooks show typeset.

        With ``degrees`` or ``millimetres`` its numbers stand in these units; letters stay as they are.
        """
        angle = partial(in_unit, unit=DEGREES) if degrees else latex
        length = partial(in_unit, unit=MILLIMETRES) if millimetres else latex
        rows = [
            [i, row.sigma, *(f"${shown(e)}$" for shown, e in zip((length, angle, length, angle), row.parameters))]
            for i, row in enumerate(self.rows, start=1)
        ]
        return Markdown(markdown_table(["$i$", *(f"${head}$" for head in _HEADS)], rows))

    def to_latex(self) -> str:
        """The table as a LaTeX array in the slides' layout."""
        lines = [" & ".join(["i", *_HEADS]) + r" \\ \hline"]
        for i, row in enumerate(self.rows, start=1):
            cells = [str(i), str(row.sigma), *map(latex, row.parameters)]
            lines.append(" & ".join(cells) + r" \\")
        return "\\begin{array}{c|c|cccc}\n" + "\n".join(lines) + "\n\\end{array}"

    def _repr_markdown_(self) -> str:
        return self.to_markdown()


@dataclass(frozen=True)
class ClassicTable:
    """A serial robot in classic DH: base, rows (sigma, a_i, alpha_i, d_i, theta_i), tool."""

    rows: tuple[DHRow, ...]
    name: str
    joints: tuple[sp.Symbol, ...]
    base: sp.ImmutableMatrix
    tool: sp.ImmutableMatrix
    values: Mapping[str, float]
    limits: tuple[tuple[float, float], ...] | None = None

    def to_modified(self) -> DHTable:
        """The same robot in modified DH."""
        return DHTable.from_classic(
            self.rows,
            name=self.name,
            joints=self.joints,
            base=self.base,
            tool=self.tool,
            values=self.values,
            limits=self.limits,
        )


def _row(row: Row, index: int) -> DHRow:
    if isinstance(row, DHRow):
        return row
    if isinstance(row, str) or not isinstance(row, (Sequence, np.ndarray, sp.MatrixBase)):
        raise ValueError(f"row {index}: expected {', '.join(_COLUMNS)}, found {row!r}")
    entries = list(row)
    if len(entries) != len(_COLUMNS):
        raise ValueError(f"row {index}: expected {len(_COLUMNS)} columns ({', '.join(_COLUMNS)}), found {len(entries)}")
    place = 3 if entries[0] == 1 else 4
    if entries[place] is None:
        entries[place] = sp.Symbol(f"q{index}", real=True)
    try:
        return DHRow(*entries)
    except ValueError as error:
        raise ValueError(f"row {index}: {error}") from None


def _expression(value: Any, column: str) -> sp.Expr:
    if isinstance(value, (Real, sp.Expr)) and not isinstance(value, bool):
        expression = _exact_integer(sp.sympify(value))
        possible = expression.is_finite is not False and expression.is_extended_real is not False
        if possible and not expression.has(sp.nan):
            return expression
    raise ValueError(f"{column} must be a real number or a sympy expression, found {value!r}")


def _exact_integer(expression: sp.Expr) -> sp.Expr:
    """Float 0.0, 1.0, ... as Integer: sympy tells them apart, and only Integer 0 vanishes."""
    if expression.is_Float and float(expression).is_integer():
        return sp.Integer(int(expression))
    return expression


def _found_joints(rows: Iterable[DHRow]) -> tuple[sp.Symbol, ...]:
    joints: list[sp.Symbol] = []
    for i, row in enumerate(rows, start=1):
        symbols = row.variable.free_symbols
        if len(symbols) > 1:
            raise ValueError(
                f"row {i}: which of the symbols in {row.variable} is the joint variable? "
                "Name the joints in joints=(...)"
            )
        joints += symbols
    return tuple(joints)


def _coupled(rows: Sequence[DHRow], joints: Sequence[sp.Symbol]) -> tuple[sp.Matrix, list[sp.Expr]]:
    """Matrix and offsets with row variables = matrix * joints + offsets."""
    matrix = sp.zeros(len(rows), len(joints))
    offsets = []
    for i, row in enumerate(rows):
        rest = row.variable
        for j, joint in enumerate(joints):
            matrix[i, j] = row.variable.diff(joint)
            rest = rest - matrix[i, j] * joint
        rest = sp.expand(rest)
        if not all(entry.is_number for entry in matrix[i, :]) or rest.has(*joints):
            raise ValueError(
                f"row {i + 1}: the joint entry {row.variable} must be a sum of joint variables and constants"
            )
        offsets.append(rest)
    return matrix, offsets


def _transform(value: Any, what: str) -> sp.ImmutableMatrix:
    matrix = sp.eye(4) if value is None else sp.Matrix(value).applyfunc(_exact_integer)
    if matrix.shape != (4, 4) or list(matrix[3, :]) != [0, 0, 0, 1]:
        raise ValueError(f"{what} must be a 4x4 transform with last row 0 0 0 1")
    return sp.ImmutableMatrix(matrix)


def _checked_limits(
    limits: Iterable[tuple[float, float]] | None, joints: Sequence[sp.Symbol]
) -> tuple[tuple[float, float], ...] | None:
    if limits is None:
        return None
    checked = tuple((float(low), float(high)) for low, high in limits)
    if len(checked) != len(joints):
        raise ValueError(f"expected {len(joints)} pairs of joint limits, found {len(checked)}")
    for joint, (low, high) in zip(joints, checked):
        if not low <= high:
            raise ValueError(f"limits of {joint}: lower {low} is above upper {high}")
    return checked


def _numbers(entries: Iterable[sp.Expr]) -> np.ndarray:
    return np.array([float(entry) for entry in entries])
