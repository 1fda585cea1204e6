"""Pen robot sheet: a three-row table, the pen tip, and a remark about a parallelogram."""

from __future__ import annotations

import numpy as np
import sympy as sp

from dhm.transforms import modified_dh

from .. import catalogue as robots
from .proof import Check, Erratum, Reading, against, agree

DOCUMENT = "pen robot sheet"

t1, t2, t3 = sp.symbols("t1 t2 t3")
L1, h2 = sp.symbols("L1 h2")
C, S, HALF = sp.cos, sp.sin, sp.pi / 2
_T12 = sp.Matrix(
    [[C(t2 - HALF), -S(t2 - HALF), 0, L1], [0, 0, 1, h2], [-S(t2 - HALF), -C(t2 - HALF), 0, 0], [0, 0, 0, 1]]
)


def _reads_the_second_row(header):
    """Row (L1, -pi/2, h2, t2 - pi/2) under this header is the printed T12; lengths add up."""
    entries = {"a": sp.S.Zero, "alpha": sp.S.Zero, "d": sp.S.Zero, "theta": sp.S.Zero}
    for name, value in zip(header, (L1, -HALF, h2, t2 - HALF)):
        entries[name] += value
    return agree(modified_dh(**entries), _T12)


def _tip(robot, q):
    return robot.forward(q)[..., :3, 3]


def _tip_freedoms(robot):
    """Rank of the derivative of the pen tip at a general posture."""
    q = np.array([0.4, 0.7, -0.3])
    step = 1e-6 * np.eye(3)
    derivative = (_tip(robot, q + step) - _tip(robot, q - step)).T / 2e-6
    return int(np.linalg.matrix_rank(derivative, tol=1e-6))


def _is_linear(robot):
    u, v = np.array([0.4, 0.7, -0.3]), np.array([-0.2, 0.5, 0.9])
    offset = _tip(robot, np.zeros(3))
    return bool(np.allclose(_tip(robot, u + v) - offset, _tip(robot, u) - offset + _tip(robot, v) - offset))


ERRORS = (
    Erratum(
        "003-table-head",
        DOCUMENT,
        "L5",
        "columns a_i, a_i, d_{i+1}, theta_{i+1}",
        "a_i, alpha_i, d_{i+1}, theta_{i+1}",
        "the second column holds -pi/2, a twist; row i leads from frame i to i+1, which is DHm.",
        against(
            "row 1 under this header is the printed T12",
            _reads_the_second_row,
            ("a", "a", "d", "theta"),
            ("a", "alpha", "d", "theta"),
        ),
    ),
    Erratum(
        "003-linear",
        DOCUMENT,
        "L56",
        "a linear system for theta1, theta2, theta3",
        "a trigonometric system in two unknowns, theta1 and theta2 + theta3",
        "three equations of rank 2: solvable only for points of a surface, and then theta2 is free.",
        against(
            "(linear?, number of unknowns that act) of the pen tip",
            lambda claim: claim == (_is_linear(robots.PEN), _tip_freedoms(robots.PEN)),
            (True, 3),
            (False, 2),
        ),
    ),
)

AMBIGUITIES = (
    Erratum(
        "003-remark",
        DOCUMENT,
        "L12",
        "theta2 was replaced by theta2 - theta1 - pi/2 in the matrix that follows",
        "the matrix contains theta2 - pi/2, the offset of the table, and no theta1",
        "the remark and the matrix disagree. All readings reach the same surface, with another "
        "meaning of theta2; a parallelogram drive would need axes 1 and 2 parallel, and they are "
        "perpendicular.",
        Check(
            "the row with this angle is the printed T12",
            lambda angle: agree(modified_dh(L1, -HALF, h2, angle), _T12),
            (
                Reading("theta2 - theta1 - pi/2 is the entry", t2 - t1 - HALF, False),
                Reading("theta2 - theta1 - pi/2 is put inside theta2 - pi/2", t2 - t1 - sp.pi, False),
                Reading("theta2, as for a SCARA", t2, False),
                Reading("theta2 - pi/2, as printed", t2 - HALF, True),
            ),
        ),
    ),
    Erratum(
        "003-coaxial",
        DOCUMENT,
        "L8",
        "row 2 is (0, 0, L2, theta3) in a robot with three joints",
        "if L2 is a link length the row is (L2, 0, 0, theta3); the text gives no way to decide",
        "as printed, joints 2 and 3 turn about the same line and count as one.",
        against(
            "three joints move the pen tip in three directions",
            lambda robot: _tip_freedoms(robot) == 3,
            robots.PEN,
            robots.PEN_REPAIRED,
        ),
    ),
)
