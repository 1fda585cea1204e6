"""Direct models: turns about fixed centres, the six-axis arm of the EPFL slides, the RX-90 with a student's tool."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import sympy

from autograder.reference import DHTable, robots
from autograder.reference.centres import epfl_centres, scara_centres
from dhm.transforms import modified_dh, rot_z

from ..shared.tables import list_rows

t1, t2, t3, t4, t5, t6 = ANGLES = sympy.symbols("t1:7")
L1, L2, L4, D3, D4, w = sympy.symbols("L1 L2 L4 D3 D4 w")
C, S, HALF = sympy.cos, sympy.sin, sympy.pi / 2


# ---------------------------------------------------------------- turns in the plane

SCARA_K = scara_centres((t1, t2, t4), (L1, L2))
BLANKS = list(SCARA_K[2][:2, 2])
TURNED_CENTRE = list(rot_z(t4)[:2, 0] * (L1 + L2))
TOOL_0 = sympy.Matrix([L1 + L2 + L4, w, 1])
TOOL_BASE_FIRST = list((SCARA_K[2] * SCARA_K[1] * SCARA_K[0] * TOOL_0)[:2, 0])


def planar_tool(*angles) -> list[sympy.Expr]:
    """The tool point if the two links and the hand make these angles with x."""
    parts = [rot_z(angle)[:2, :2] * sympy.Matrix(step) for angle, step in zip(angles, ([L1, 0], [L2, 0], [L4, w]))]
    return list(sum(parts, sympy.zeros(2, 1)))


TOOL_POINT = planar_tool(t1, t1 + t2, t1 + t2 + t4)


def leave_unturned(*lengths) -> list[sympy.Expr]:
    """The tool point with these lengths of its step from the wrist added along the axes of the base."""
    turned = [entry.subs(dict.fromkeys(lengths, 0)) for entry in TOOL_POINT]
    return [entry + (length if length in lengths else 0) for entry, length in zip(turned, (L4, w))]


# ---------------------------------------------------------------- six turns in space


def as_lists(matrices) -> list:
    return [matrix.tolist() for matrix in matrices]


K = epfl_centres(ANGLES, D3, L2, D4)
K_LISTS = as_lists(K)
WRIST_0 = sympy.Matrix([D3, 0, L2 + D4, 1])
# Turns 4, 5 and 6 leave the wrist centre alone.
WRIST = list((K[0] * K[1] * K[2] * WRIST_0)[:3, 0])
WRIST_BASE_FIRST = list((K[2] * K[1] * K[0] * WRIST_0)[:3, 0])
ABSOLUTE_WRIST = list((K[0] * sympy.Matrix([D3, -L2 * S(t2) - D4 * S(t3), L2 * C(t2) + D4 * C(t3), 1]))[:3, 0])
CENTRES = [[0, 0, 0], [0, 0, 0], [0, 0, L2], [D3, 0, 0], [0, 0, L2 + D4], [D3, 0, 0]]
ELBOW_AT_WRIST = epfl_centres(ANGLES, D3, L2 + D4, 0)[2].tolist()
WRIST_AT_ELBOW = epfl_centres(ANGLES, D3, L2, 0)[4].tolist()


def change_last_columns(change):
    """A step on six matrices: the translation of each replaced by `change(translation, index)`."""

    def step(matrices):
        changed = []
        for i, matrix in enumerate(map(sympy.Matrix, matrices)):
            new = matrix.copy()
            new[:3, 3] = sympy.Matrix(change(matrix[:3, 3], i))
            changed.append(new.tolist())
        return changed

    return step


def turn_backwards(matrices) -> list:
    """The six matrices with every angle in the opposite sense."""
    return as_lists(
        matrix.subs({t: -t for t in matrix.free_symbols.intersection(ANGLES)}) for matrix in map(sympy.Matrix, matrices)
    )


TABLE = robots.EPFL_ARM.table
ROWS = list_rows(TABLE)


def offset_as_link_length(rows):
    """D3 in column a of the row of joint 4."""
    rows = [list(row) for row in rows]
    rows[3][1], rows[2][3] = rows[3][1] + rows[2][3], sympy.S.Zero
    return rows


def or_with(step, about):
    """A mistake of one step, alone or with a second step behind it."""
    (first,) = about.steps
    return replace(about, steps=(first, lambda rows: step(first(rows))))


# ---------------------------------------------------------------- the RX-90

RX90 = robots.RX90.table
TRANSFORMS = RX90.transforms()
U0, U1, U2, U3, *_ = RX90.recursion()
# Row 6 with alpha = +90 degrees: the slide's page of matrices.
PRINTED_U0, _, PRINTED_U2, *_ = DHTable([*RX90.rows[:5], (0, 0, HALF, 0, t6)]).recursion()

# 1 marks a printed cell that differs from the product of the table (a test compares them).
WRONG_T56 = [[0, 0, 0, 0], [0, 0, 1, 0], [1, 1, 0, 0], [0, 0, 0, 0]]
WRONG_U4 = [[0, 0, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0]]
WRONG_U3 = [[1, 1, 0, 0], [0, 0, 0, 0], [1, 1, 0, 0], [0, 0, 0, 0]]
NO_CELL = [[0] * 4 for _ in range(4)]


def mark_columns(marks):
    """Every cell of a column that has a wrong one, as the test of orthogonality points at columns."""
    marks = np.array(marks)
    columns = marks.any(axis=0, keepdims=True) & (np.arange(4)[:, None] < 3)
    return np.where(columns, 1, 0).tolist()


def unmark(cell):
    """A step: a wrong cell of U3 is overlooked."""

    def step(marks):
        marks = np.array(marks)
        marks[2][cell] = 0
        return marks.tolist()

    return step


# ---------------------------------------------------------------- a tool


@lru_cache
def rx90(a3, d3) -> DHTable:
    return RX90.at({"a3": a3, "d3": d3})


def forward(*q, mine, tool="right", bend="radians", angles="radians") -> np.ndarray:
    """The pose of the student's tool on the RX-90, (4, 4), for six joint angles.

    `tool` may be ``"left"``, multiplied from the left, or ``"none"``; the tool's `bend` and the joint `angles` may be
    taken in ``"degrees"``.
    """
    arm = rx90(mine.a3, mine.d3).forward(np.radians(q) if angles == "degrees" else q)
    if tool == "none":
        return arm
    step = tool_matrix(mine.reach, mine.bend if bend == "degrees" else np.radians(mine.bend), mine.length)
    return step @ arm if tool == "left" else arm @ step


@lru_cache
def tool_matrix(reach, bend, length) -> np.ndarray:
    """The step from frame 6 to the tool frame."""
    return np.array(modified_dh(reach, bend, length, 0).evalf(), dtype=float)


def draw_angles(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists for `forward`: random postures, then quarter turns."""
    random = [[float(angle) for angle in rng.uniform(-3, 3, 6)] for _ in range(6)]
    quarters = [[float(k) * np.pi / 2 for k in rng.integers(-2, 3, 6)] for _ in range(3)]
    return [*random, *quarters]


def name_posture(*q) -> str:
    """The case a list of joint angles belongs to, in words."""
    quarters = np.divide(q, np.pi / 2)
    return "quarter turns" if np.allclose(quarters, quarters.round()) else "random postures"
