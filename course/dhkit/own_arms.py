"""Arms that a student's id chooses, as the statements of exercises tell them.

The notebook shows the arm under the student's own name of it, ``CLASSIC_ARMS[mine.arm]``; the grader takes the same one.
"""

from __future__ import annotations

from sympy import Expr, pi, symbols

q1, q2, q3, a1, a2, a3, d1, d2 = symbols("q1:4 a1:4 d1:3")
HALF = pi / 2

CLASSIC_ARMS: dict[str, list[list[Expr | int]]] = {
    "welder": [[0, a1, -HALF, d1, q1], [0, a2, 0, d2, q2], [0, a3, HALF, 0, q3]],
    "loader": [[0, a1, -HALF, d1, q1], [0, 0, HALF, d2, q2], [1, a3, 0, q3, 0]],
    "painter": [[0, 0, HALF, d1, q1], [0, a2, HALF, d2, q2], [0, a3, 0, 0, q3]],
    "stacker": [[1, a1, 0, q1, 0], [0, a2, -HALF, d2, q2], [0, a3, HALF, 0, q3]],
}
"""Arms of three joints in classic rows ``[sigma, a, alpha, d, theta]``, every number with the index of its own joint."""
