"""The file of a robot, made of its URDF: the table's lengths get letters, its angles stay exact."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import sympy

from autograder.reference import DHTable, table_from_urdf_file

_NONE = 1e-6  # metres, radians: what is less is rounding


def robot_text(path: Path, title: str = "") -> str:
    """What `describe` reads, of the arm in a URDF file.

    Raises
    ------
    ValueError
        As `table_from_urdf_file`.
    """
    table = table_from_urdf_file(path)
    lengths: dict[str, float] = {}
    rows = [
        [sigma, _length(a, f"a{i}", lengths), _angle(alpha), _length(d, f"d{i}", lengths), _angle(theta)]
        for i, (sigma, a, alpha, d, theta) in enumerate(_numbered(table), 1)
    ]
    lines = [
        f"# From {path.name}. Frame 0 stands on axis 1.",
        f"title = {json.dumps(title or table.name or path.stem, ensure_ascii=False)}",
        f"joints = {json.dumps([str(joint) for joint in table.joints])}",
        "rows = [",
        *(f"    {json.dumps(row)}," for row in rows),
        "]",
    ]
    if lengths:
        lines += ["", "[lengths]", *(f"{name} = {value:.9g}" for name, value in lengths.items())]
    return "\n".join(lines) + "\n"


def _numbered(table: DHTable) -> list[list]:
    """The rows of a table, its tool among them: a row of its own where it does not just slide and turn along the last Z."""
    rows = [[row.sigma, *row.parameters] for row in table.rows]
    tool = np.array(table.tool, float)
    if np.allclose(tool, np.eye(4), atol=_NONE):
        return rows
    d_before, theta_before, a, alpha, d, theta = _as_steps(tool)
    apart = max(abs(a), abs(alpha)) > _NONE
    rows[-1][3] += d_before if apart else d_before + d
    rows[-1][4] += theta_before if apart else theta_before + theta
    return [*rows, [0, a, alpha, d, theta]] if apart else rows


def _as_steps(tool: np.ndarray) -> tuple[float, float, float, float, float, float]:
    """A displacement as (d, theta) along and about Z, then a row (a, alpha, d, theta): along the common normal of the two Z axes."""
    point, axis = tool[:3, 3], tool[:3, 2]
    across = np.hypot(*axis[:2])
    if across > _NONE:
        normal = np.array([-axis[1], axis[0], 0.0]) / across
        along = float(point[:2] @ axis[:2]) / across**2
    else:
        aside = np.hypot(*point[:2])
        normal = np.array([*point[:2], 0.0]) / aside if aside > _NONE else np.array([1.0, 0.0, 0.0])
        along = float(point[2] * np.sign(axis[2]))
    before = float(point[2] - along * axis[2]) if across > _NONE else 0.0
    theta_before = float(np.arctan2(normal[1], normal[0]))
    alpha = float(np.arctan2(across, axis[2]))
    turned = np.column_stack([normal, np.cross(axis, normal), axis]).T @ tool[:3, 0]
    return before, theta_before, float(point @ normal), alpha, along, float(np.arctan2(turned[1], turned[0]))


def _length(entry: sympy.Expr, letter: str, lengths: dict[str, float]) -> float | str:
    """A letter in the place of a length, which is noted; a sliding joint's own letter stays in front of it."""
    entry = sympy.sympify(entry)
    variable = [str(symbol) for symbol in entry.free_symbols]
    value = float(entry.subs(dict.fromkeys(entry.free_symbols, 0)))
    if abs(value) < _NONE:
        return variable[0] if variable else 0
    lengths[letter] = abs(round(value, 9))
    if variable:
        return f"{variable[0]} {'-' if value < 0 else '+'} {letter}"
    return letter if value > 0 else f"-{letter}"


def _angle(entry: sympy.Expr) -> float | str:
    """An angle as a text, multiples of 15 degrees as those of pi."""
    entry = sympy.sympify(entry)
    variable = [str(symbol) for symbol in entry.free_symbols]
    value = float(entry.subs(dict.fromkeys(entry.free_symbols, 0)))
    value = float(np.arctan2(np.sin(value), np.cos(value)))
    steps = round(value / (np.pi / 12))
    exact = abs(value - steps * np.pi / 12) < 1e-6
    size = sympy.pi * sympy.Rational(abs(steps), 12) if exact else sympy.Float(round(abs(value), 9))
    if size == 0:
        return variable[0] if variable else 0
    if variable:
        return f"{variable[0]} {'-' if value < 0 else '+'} {size}"
    return f"{'-' if value < 0 else ''}{size}"
