"""Checks of what a drawing is given: arrays of the awaited form, or a `ValueError` that says what was awaited."""

from __future__ import annotations

import numpy as np
import sympy

from ..geometry import unit_line


def as_numbers(value, what: str, shape: tuple[int | None, ...]) -> np.ndarray:
    """`value` as finite floats.

    Parameters
    ----------
    value : array-like or SymPy matrix
    what : str
        What it is, for the error message.
    shape : tuple
        The awaited shape; None stands for any size.

    Returns
    -------
    ndarray of float

    Raises
    ------
    ValueError
        If `value` has another shape, or is not made of finite numbers.
    """
    form = " x ".join("n" if size is None else str(size) for size in shape)
    try:
        array = np.array(value.tolist() if isinstance(value, sympy.MatrixBase) else value, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{what}: expected {form} numbers, found {_short(value)}") from None
    fits = array.ndim == len(shape) and all(want in (None, have) for want, have in zip(shape, array.shape))
    if not fits:
        found = " x ".join(map(str, array.shape)) or "one number"
        raise ValueError(f"{what}: expected {form} numbers, found {found}")
    if not np.isfinite(array).all():
        raise ValueError(f"{what}: found a value that is not a finite number")
    return array


def _short(value) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def as_number(value, what: str) -> float:
    """`as_numbers` for a single number."""
    return float(as_numbers(value, what, ()))


def as_lengths(value, what: str, shape: tuple[int | None, ...]) -> np.ndarray:
    """`as_numbers`, all of them positive."""
    array = as_numbers(value, what, shape)
    if (array <= 0).any():
        raise ValueError(f"{what}: lengths must be positive, found {_short(value)}")
    return array


def as_rows(value, what: str, width: int) -> np.ndarray:
    """`as_numbers` of shape (k, width), where an empty list means that there is no row."""
    return as_numbers(np.empty((0, width)) if np.size(value) == 0 else value, what, (None, width))


def as_names(names, count: int, default) -> list[str]:
    """`names` as `count` texts; where None is given, the texts `default`."""
    names = [str(name) for name in (default if names is None else names)]
    if len(names) != count:
        raise ValueError(f"names: expected {count}, found {len(names)}")
    return names


def as_table(rows, values=None) -> np.ndarray:
    """A table of modified DH parameters as numbers.

    Parameters
    ----------
    rows : n rows [sigma, a, alpha, d, theta], numbers or SymPy; metres and radians
    values : dict, optional
        Numbers for the symbols of the table, by name.

    Returns
    -------
    ndarray, shape (n, 5)

    Raises
    ------
    ValueError
        If a row has another form, a symbol has no value, or a sigma is neither 0 nor 1.
    """
    given = {str(name): value for name, value in (values or {}).items()}
    try:
        rows = list_rows(rows)
    except TypeError:
        raise ValueError(f"table: expected rows [sigma, a, alpha, d, theta], found {rows!r}") from None
    symbols = {s for row in rows for entry in row for s in getattr(entry, "free_symbols", ())}
    if missing := sorted({str(s) for s in symbols} - set(given)):
        raise ValueError(f"values: expected a number for {', '.join(missing)}, found none")
    numbers = {s: given[str(s)] for s in symbols}
    rows = [[e.subs(numbers) if isinstance(e, sympy.Basic) else e for e in row] for row in rows]
    table = as_numbers(rows, "table with rows [sigma, a, alpha, d, theta]", (None, 5))
    if not np.isin(table[:, 0], (0, 1)).all():
        raise ValueError("sigma: expected 0 (revolute) or 1 (prismatic) in every row")
    return table


def list_rows(table) -> list[list]:
    """The rows of a table or a matrix, which may be nested sequences, a NumPy array or a SymPy matrix."""
    return [list(row) for row in (table.tolist() if hasattr(table, "tolist") else table)]


def as_line(line, what: str) -> tuple[np.ndarray, np.ndarray]:
    """A line in space, given as (point, direction): a point and a unit vector, each of shape (3,), in metres."""
    try:
        point, direction = line
    except (TypeError, ValueError):
        raise ValueError(f"{what}: expected a point and a direction, found {line!r}") from None
    point = as_numbers(point, f"{what}, point", (3,))
    direction = as_numbers(direction, f"{what}, direction", (3,))
    if np.linalg.norm(direction) < 1e-12:
        raise ValueError(f"{what}, direction: expected a vector that is not zero")
    return unit_line((point, direction))


def as_joint_limits(limits) -> np.ndarray:
    """Limits of two revolute joints: rows (min, max) in radians, shape (2, 2), each at most a full turn wide."""
    limits = as_numbers(limits, "limits", (2, 2))
    if (limits[:, 0] >= limits[:, 1]).any():
        raise ValueError("limits: each row is (min, max) with min below max")
    if (np.ptp(limits, axis=1) > 2 * np.pi + 1e-9).any():
        raise ValueError("limits: a range wider than a full turn repeats itself")
    return limits


def as_axis_letters(axes, length=None) -> str:
    """`axes` as letters x, y, z, `length` of them if it is given."""
    if not isinstance(axes, str) or not axes or set(axes) - set("xyz") or length not in (None, len(axes)):
        wanted = "letters" if length is None else f"{length} letters"
        raise ValueError(f"axes: expected {wanted} x, y, z, found {axes!r}")
    return axes
