"""A table of modified DH parameters taken apart into constants and joints, as the browser computes with it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np
import sympy

from ..drawing.inputs import as_names, as_numbers, list_rows
from ..geometry import modified_dh
from ..interactive import step_of

COLUMNS = ("sigma", "a", "alpha", "d", "theta")
_GREEK = {name: sympy.pretty(sympy.Symbol(name)) for name in ("alpha", "beta", "gamma", "phi", "psi", "theta")}
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_LONGEST = 16  # letters of a name in the picture
_MOST = 40  # rows of a table


@dataclass(frozen=True)
class Joint:
    """A joint variable.

    Attributes
    ----------
    name : str
        As it is shown, for instance θ₁.
    prismatic : bool
    low, high : float
        Ends of its slider, in radians or metres.
    step : float
        Of its slider, in metres; a revolute joint moves by whole degrees.
    limited : bool
        Whether its ends are the robot's own, and not the slider's only.
    """

    name: str
    prismatic: bool
    low: float
    high: float
    step: float
    limited: bool


@dataclass(frozen=True)
class Arm:
    """A serial robot in numbers: entry d or theta of row i is ``rows[i]`` plus ``coupling[i] @ q``.

    Attributes
    ----------
    rows : ndarray, shape (m, 5)
        Rows [sigma, a, alpha, d, theta] with all joints at zero, in metres and radians.
    coupling : ndarray, shape (m, n)
        What each of n joints adds to d (sigma = 1) or theta (sigma = 0) of each row.
    joints : tuple of n Joint
    letters : tuple of m pairs of str
        What the lengths a and d of each row are called.
    start : tuple of n floats
        Joint values before anything has been moved.
    tool : ndarray, shape (4, 4), or None
        The hand seen from the last frame.
    """

    rows: np.ndarray
    coupling: np.ndarray
    joints: tuple[Joint, ...]
    letters: tuple[tuple[str, str], ...]
    start: tuple[float, ...]
    tool: np.ndarray | None

    def table(self, q: Sequence[float]) -> np.ndarray:
        """The table in numbers for joint values q, shape (m, 5)."""
        table = self.rows.copy()
        moved = self.coupling @ np.asarray(q, dtype=float)
        prismatic = table[:, 0] == 1
        table[prismatic, 3] += moved[prismatic]
        table[~prismatic, 4] += moved[~prismatic]
        return table

    def hands(self, q: np.ndarray) -> np.ndarray:
        """The hand seen from the base for postures q, shape (..., n): frames of shape (..., 4, 4)."""
        q = np.asarray(q, dtype=float)
        prismatic = self.rows[:, 0] == 1
        moved = q @ self.coupling.T
        d, theta = self.rows[:, 3] + prismatic * moved, self.rows[:, 4] + ~prismatic * moved
        hand = np.broadcast_to(np.eye(4), (*q.shape[:-1], 4, 4))
        for i, (_, a, alpha, *_) in enumerate(self.rows):
            hand = hand @ modified_dh(a, alpha, d[..., i], theta[..., i])
        return hand if self.tool is None else hand @ self.tool

    def reached(self, count: int) -> np.ndarray:
        """Where the hand gets with random joint values within the limits: the same points each time, shape (count, 3)."""
        low, high = np.transpose([(joint.low, joint.high) for joint in self.joints])
        return self.hands(np.random.default_rng(0).uniform(low, high, (count, len(low))))[:, :3, 3]

    @property
    def ends_in_tool(self) -> bool:
        """Whether a row or a transform without joint carries the hand."""
        return self.tool is not None or not self.coupling[-1].any()


def read_arm(
    table: Any,
    values: Mapping[Any, Any] | None = None,
    tool: Any = False,
    limits: Sequence[tuple[float, float]] | None = None,
) -> Arm:
    """Take a table apart.

    Parameters
    ----------
    table, values, tool, limits
        As for `Scene`.

    Raises
    ------
    ValueError
        In words, for a row of another form, a symbol without a number, or a joint entry that is no sum of joint
        variables and constants.
    """
    rows = _entries(table)
    given = {str(name): _number(value, f"values: {name}") for name, value in (values or {}).items()}
    starts = _joint_variables(rows, given)
    if not starts:
        rows, starts = _as_posture(rows, given, len(rows) - (tool is True))
    variables = tuple(starts)
    lengths = {name: value for name, value in given.items() if name not in {each.name for each in variables}}
    at_zero = dict.fromkeys(variables, 0)
    numbers = np.empty((len(rows), len(COLUMNS)))
    for i, row in enumerate(rows):
        for j, entry in enumerate(row):
            constant = entry.subs(at_zero) if j == _moving(row) else entry
            numbers[i, j] = _value(constant, lengths, f"row {i + 1}, {COLUMNS[j]}")
    coupling = np.array([_shares(row[_moving(row)], variables, i) for i, row in enumerate(rows, 1)])
    names = [_pretty(variable.name) for variable in variables]
    joints = _joints(names, numbers, coupling, list(starts.values()), limits)
    start = tuple(min(max(value, joint.low), joint.high) for value, joint in zip(starts.values(), joints))
    letters = tuple((_letter(row[1], "a", i), _letter(row[3], "d", i + 1)) for i, row in enumerate(rows))
    matrix = None if isinstance(tool, bool | np.bool_) else _rigid(tool)
    return Arm(numbers, coupling, joints, letters, start, matrix)


def frame_names(arm: Arm, names: Sequence[Any] | None) -> list[str]:
    """Names of all frames, by default 0, 1, ..., and E for a tool."""
    count = len(arm.rows) + (1 if arm.tool is not None else 0)
    return as_names(names, count + 1, [*range(count), "E" if arm.ends_in_tool else count])


def _moving(row: Sequence[sympy.Expr]) -> int:
    """The column of the entry that a joint moves: d or theta."""
    return 3 if row[0] == 1 else 4


def _entries(table: Any) -> list[list[sympy.Expr]]:
    """The rows of a table as expressions; numbers and SymPy only: a text would have to be evaluated."""
    try:
        rows = list_rows(table)
    except TypeError:
        raise ValueError(f"table: expected rows [sigma, a, alpha, d, theta], found {str(table)[:60]!r}") from None
    if not 0 < len(rows) <= _MOST:
        raise ValueError(f"table: expected 1 to {_MOST} rows, found {len(rows)}")
    result = []
    for i, row in enumerate(rows, 1):
        if len(row) != len(COLUMNS):
            raise ValueError(f"table, row {i}: expected [sigma, a, alpha, d, theta], found {len(row)} entries")
        for name, entry in zip(COLUMNS, row):
            if not isinstance(entry, Real | sympy.Expr):
                raise ValueError(f"table, row {i}: {name} must be a number or an expression, found {str(entry)[:40]!r}")
        result.append([sympy.sympify(entry) for entry in row])
        if result[-1][0] not in (0, 1):
            raise ValueError(f"table, row {i}: sigma must be 0 (revolute) or 1 (prismatic), found {row[0]}")
    return result


def _joint_variables(rows: list[list[sympy.Expr]], given: Mapping[str, float]) -> dict[sympy.Symbol, float]:
    """The joint variables in their order and where they start.

    They are, in each moving entry, the symbols without a number; its only symbol, if it has one.
    """
    starts: dict[sympy.Symbol, float] = {}
    for row in rows:
        symbols = sorted(row[_moving(row)].free_symbols, key=str)
        free = [symbol for symbol in symbols if symbol.name not in given]
        for symbol in free or symbols[: len(symbols) == 1]:
            starts.setdefault(symbol, given.get(symbol.name, 0.0))
    return starts


def _as_posture(
    rows: list[list[sympy.Expr]], given: Mapping[str, float], count: int
) -> tuple[list[list[sympy.Expr]], dict[sympy.Symbol, float]]:
    """A table of numbers with a joint variable in each of its first rows, which starts at the row's number."""
    if count == 0:
        raise ValueError("table: expected at least one joint, found none")
    rows, starts = [list(row) for row in rows], {}
    for i, row in enumerate(rows[:count], 1):
        column = _moving(row)
        variable = sympy.Dummy(f"{'d' if column == 3 else 't'}{i}")
        starts[variable] = _value(row[column], given, f"row {i}, {COLUMNS[column]}")
        row[column] = variable
    return rows, starts


def _shares(entry: sympy.Expr, variables: Sequence[sympy.Symbol], row: int) -> list[float]:
    """What each joint adds to an entry, per unit of its own value."""
    shares = [sympy.diff(entry, variable) for variable in variables]
    if any(not share.is_number for share in shares):
        raise ValueError(f"table, row {row}: expected a sum of joint variables and constants, found {entry}")
    return [float(share) for share in shares]


def _value(entry: sympy.Expr, given: Mapping[str, float], what: str) -> float:
    missing = sorted({symbol.name for symbol in entry.free_symbols} - set(given))
    if missing:
        raise ValueError(f"values: expected a number for {', '.join(missing)} ({what}), found none")
    return _number(entry.subs({symbol: given[symbol.name] for symbol in entry.free_symbols}), what)


def _number(value: Any, what: str) -> float:
    return float(as_numbers(value, what, ()))


def _rigid(tool: Any) -> np.ndarray:
    matrix = as_numbers(tool, "tool", (4, 4))
    turn = matrix[:3, :3]
    if not (np.allclose(turn.T @ turn, np.eye(3), atol=1e-6) and np.allclose(matrix[3], (0, 0, 0, 1), atol=1e-9)):
        raise ValueError("tool: expected True, False or a 4x4 matrix of a rotation and a displacement")
    return matrix


def _joints(
    names: list[str], rows: np.ndarray, coupling: np.ndarray, start: list[float], limits: Any
) -> tuple[Joint, ...]:
    count = len(names)
    ends = None if limits is None else as_numbers(limits, "limits", (count, 2))
    if ends is not None and (ends[:, 0] >= ends[:, 1]).any():
        raise ValueError("limits: each is (lowest, highest), the lowest first")
    lengths = np.abs(rows[:, [1, 3]]).sum()
    joints = []
    for j, name in enumerate(names):
        prismatic = rows[np.flatnonzero(coupling[:, j])[0], 0] == 1
        if ends is not None:
            low, high = ends[j]
        elif prismatic:
            reach = _rounded_up(max(0.4 * lengths, abs(start[j]), 0.1))
            low, high = (-reach, reach) if start[j] < 0 else (0.0, reach)
        else:
            low, high = min(-np.pi, start[j]), max(np.pi, start[j])
        step = step_of(float(low), float(high), 0.0 if low <= 0 <= high else float(low)) if prismatic else 0.0
        joints.append(Joint(name, bool(prismatic), float(low), float(high), step, ends is not None))
    return tuple(joints)


def _rounded_up(length: float) -> float:
    """The next length of one digit, in metres."""
    decade = 10.0 ** np.floor(np.log10(length))
    return float(np.round(np.ceil(length / decade - 1e-9) * decade, 12))


def _letter(entry: sympy.Expr, column: str, number: int) -> str:
    """What a length is called: its own letters if they are short, else a or d with its index."""
    text = _pretty(sympy.sstr(entry).replace("_", "")) if entry.free_symbols else ""
    return text if 0 < len(text) <= _LONGEST else column + str(number).translate(_SUBSCRIPTS)


def _pretty(text: str) -> str:
    """Names as they are written by hand: t1 is θ₁, a2 is a₂."""

    def written(found: re.Match) -> str:
        name = "θ" if found[1] == "t" and found[2] else _GREEK.get(found[1], found[1])
        return name + found[2].translate(_SUBSCRIPTS)

    return re.sub(r"([A-Za-z]+)_?(\d*)", written, text).replace("-", "\N{MINUS SIGN}")[:60]
