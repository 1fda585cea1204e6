"""What the lecture documents leave to do: turns about fixed centres, a pen in the EPFL arm, misprints of the RX-90."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.reference.centres import epfl_centres, scara_centres
from dhm.transforms import rot_z

t1, t2, t3, t4, t5, t6 = ANGLES = sympy.symbols("t1:7")
L1, L2, L4, D3, D4, w, e, h = sympy.symbols("L1 L2 L4 D3 D4 w e h")
C, S = sympy.cos, sympy.sin


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


# ---------------------------------------------------------------- a pen in the six-axis arm, joints 4 and 6 locked


def pen(*heading, aside=e, offset=D3) -> list[sympy.Expr]:
    """The tip of the pen, if upper arm, forearm and hand lean by these angles from the vertical."""
    lean = -sum(length * S(angle) for length, angle in zip((L2, D4, h), heading))
    up = sum(length * C(angle) for length, angle in zip((L2, D4, h), heading))
    return [
        (offset + aside) * C(t1) - lean * S(t1),
        (offset + aside) * S(t1) + lean * C(t1),
        up,
    ]


PEN = pen(t2, t2 + t3, t2 + t3 + t5)
ABSOLUTE_PEN = (pen(t2, t3, t5), pen(t2, t2 + t3, t5), pen(t2, t3, t3 + t5))
PEN_HANGS = pen(t2, t2 + t3, 0)
PEN_STIFF = pen(t2, t2 + t3, t2 + t3)
K = [matrix.subs({t4: 0, t6: 0}) for matrix in epfl_centres(ANGLES, D3, L2, D4)]
PEN_BASE_FIRST = list((K[4] * K[2] * K[1] * K[0] * sympy.Matrix([D3 + e, 0, L2 + D4 + h, 1]))[:3, 0])


# ---------------------------------------------------------------- the RX-90

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
