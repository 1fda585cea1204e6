"""Wrong steps that students really take, each as a transformation of a right answer.

A DH table is a list of rows ``[sigma, a, alpha, d, theta]``; a transform is a SymPy 4x4 matrix.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from dhkit.public import DH_COLUMNS

Rows = list[list]


def _copy(rows: Sequence[Sequence]) -> Rows:
    return [list(row) for row in rows]


def negated(rows: Sequence[Sequence], row: int, column: str) -> Rows:
    """The table with the sign of one cell turned; `row` counts from 1 as on the slides."""
    table = _copy(rows)
    cell = DH_COLUMNS.index(column)
    table[row - 1][cell] = -table[row - 1][cell]
    return table


def exchanged(rows: Sequence[Sequence], first: str, second: str) -> Rows:
    """The table with two columns exchanged under unchanged headers."""
    i, j = DH_COLUMNS.index(first), DH_COLUMNS.index(second)
    table = _copy(rows)
    for row in table:
        row[i], row[j] = row[j], row[i]
    return table


def classic_rows(rows: Sequence[Sequence], last: tuple = (0, 0)) -> Rows:
    """The classic table: a and alpha of the next row, `last` (a, alpha) in the last one."""
    links = [tuple(row[1:3]) for row in rows[1:]] + [last]
    return [[row[0], *link, *row[3:]] for row, link in zip(rows, links, strict=True)]


def revolute_everywhere(rows: Sequence[Sequence]) -> Rows:
    """The table with sigma = 0 in every row: the prismatic joint taken for a revolute one."""
    return [[0, *row[1:]] for row in rows]


def classic_transform(a, alpha, d, theta) -> sympy.Matrix:
    """The elementary matrix of classic DH: ``Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha)``."""
    c, s, ca, sa = sympy.cos(theta), sympy.sin(theta), sympy.cos(alpha), sympy.sin(alpha)
    return sympy.Matrix([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])


def transposed_rotation(transform: sympy.Matrix) -> sympy.Matrix:
    """The transform with its rotation block transposed, the position kept."""
    wrong = sympy.Matrix(transform)
    wrong[:3, :3] = transform[:3, :3].T
    return wrong


def product(transforms: Sequence[sympy.Matrix]) -> sympy.Matrix:
    """The plain product of transforms, left to right."""
    result = sympy.eye(4)
    for transform in transforms:
        result = result * transform
    return result


def reversed_product(transforms: Sequence[sympy.Matrix]) -> sympy.Matrix:
    """The product taken in the wrong order, last transform first."""
    return product(transforms[::-1])
