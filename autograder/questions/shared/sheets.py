"""Data sheets: the tables of the six-axis arms as makers print them, in either convention and with either length first.

Which convention a sheet is in, it does not say; it says where the end effector is for some joint values. What students
see stands in the kit's ``sheets.json``, which ``python -m autograder.questions.shared.sheets`` writes.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np
import sympy

import dhkit
from autograder.reference import DHTable
from dhkit.sheets import ARMS, SHEETS
from dhkit.variants import OwnNumbers
from dhm.transforms import classic_dh, modified_dh

from .described import Described
from .pool import arms

KIT_FILE = Path(dhkit.__file__).with_name("sheets.json")
TRIED = (20, 35, -50, 40, 65, -30)
"""Angles in degrees at which a sheet tells the position; a joint that slides is drawn out by a hundredth of that, in metres."""


@cache
def reading_of(arm: str, sheet: str) -> str:
    """The letter of `dhkit.sheets.READINGS` with which a sheet of an arm is read rightly."""
    return "ABCD"[(ARMS.index(arm) + SHEETS.index(sheet)) % 4]


def rows_of(table: DHTable, reading: str) -> list[tuple]:
    """The rows ``(length, length, twist, angle)`` of a table that is to be read so."""
    rows = [row.parameters for row in table.rows]
    if reading in "CD":  # classic: behind the joint, the step to the next one
        if rows[0][:2] != (0, 0):
            raise ValueError("the first axis must be Z0: a classic table has no step before joint 1")
        links = [*(row[:2] for row in rows[1:]), (sympy.S.Zero, sympy.S.Zero)]
        rows = [(*link, *row[2:]) for link, row in zip(links, rows)]
    return [(d, a, alpha, theta) if reading in "BD" else (a, d, alpha, theta) for a, alpha, d, theta in rows]


def read(row: tuple, reading: str) -> sympy.Matrix:
    """The matrix, 4x4, of a row of a sheet."""
    first, second, alpha, theta = row
    a, d = (first, second) if reading in "AC" else (second, first)
    return modified_dh(a, alpha, d, theta) if reading in "AB" else classic_dh(a, alpha, d, theta)


def robot_of(mine: OwnNumbers) -> Described:
    """The arm of the student's sheet."""
    return arms()[mine.robot]


@cache
def factors(arm: str, sheet: str, columns: bool = True, convention: bool = True) -> tuple[sympy.Matrix, ...]:
    """The matrices of a sheet's rows, read rightly, or with the lengths exchanged, or in the other convention."""
    right = reading_of(arm, sheet)
    letter = "ABCD"[("ABCD".index(right) ^ (not columns)) ^ 2 * (not convention)]
    return tuple(read(row, letter) for row in rows_of(arms()[arm].table, right))


def tried(arm: Described) -> tuple[list[float], np.ndarray]:
    """The joint values of a sheet's example, in radians and metres, and where the end effector is then."""
    slides = [row.sigma for row in arm.table.rows]
    q = [abs(angle) / 100 if slide else np.radians(angle) for angle, slide in zip(TRIED, slides)]
    return q, arm.table.forward(q)[:3, 3]


def for_the_kit() -> str:
    """What the kit's file says."""
    lines = []
    for name in ARMS:
        arm = arms()[name]
        sheets = {
            sheet: [[str(cell) for cell in row] for row in rows_of(arm.table, reading_of(name, sheet))]
            for sheet in SHEETS
        }
        q, point = tried(arm)
        shown = {
            "title": arm.title,
            "slides": [bool(row.sigma) for row in arm.table.rows],
            "lengths": {str(letter): float(value) for letter, value in arm.table.values.items()},
            "q": [round(value, 12) for value in q],
            "point": [round(float(value), 4) + 0.0 for value in point],
        }
        lines.append(f"{json.dumps(name)}: " + json.dumps(shown | sheets, ensure_ascii=False))
    return "{\n" + ",\n".join(lines) + "\n}\n"


if __name__ == "__main__":
    KIT_FILE.write_text(for_the_kit(), encoding="utf-8")
