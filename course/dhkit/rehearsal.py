"""What is slow the first time, done once: in a process that is copied for many notebooks, before it has seen any."""

from __future__ import annotations

import sympy

from .arms import arm_of
from .drawing import draw_arm, draw_planar_arm
from .pictures import show_table
from .public import questions
from .variants import numbers

t1, t2, t4, d3, a2, a3 = sympy.symbols("t1 t2 t4 d3 a2 a3")
TABLE = [[0, 0, 0, 0, t1], [0, a2, 0, 0, t2], [1, a3, 0, d3, 0], [0, 0, sympy.pi / 2, 0, t4]]
VALUES = {"t1": 0.6, "t2": 0.9, "t4": 0.3, "d3": 0.1, "a2": 0.5, "a3": 0.4}


def rehearse() -> None:
    """Read the kit's files and make a few figures, which are left open: fonts, formulas and data stay in memory."""
    questions()
    draw_arm(arm_of(numbers("scara", "nobody")))
    draw_planar_arm([0.5, 0.4], [0.6, 0.9], projections=True)
    show_table(TABLE, VALUES, tool=True)
