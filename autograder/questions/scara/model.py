"""The SCARA: symbols, direct model, and a function of numbers that can go wrong."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge.misconceptions import product, symbol_negated
from autograder.reference import robots
from dhm.transforms import classic_dh

from ..shared.residuals import distance_and_turn
from ..shared.tables import list_rows

t1, t2, t4, a2, a3, d2 = sympy.symbols("t1 t2 t4 a2 a3 d2")

TABLE = robots.SCARA.table
ROWS = list_rows(TABLE)
TRANSFORMS = TABLE.transforms()
U0, U1, *_ = TABLE.recursion()

D2_IS_A_DEPTH = (
    "**The sign of d2 is turned.** d2 counts downwards, like the depth of the quill, while Z3 points upwards. MECA 953 "
    "prints the table twice, once with each sign: only one of them goes with their matrices."
)

_CLASSIC = product([classic_dh(*row[1:]) for row in ROWS])
_pose, _classic_pose = (sympy.lambdify([t1, t2, d2, t4, a2, a3], matrix) for matrix in (U0, _CLASSIC))


def forward(t1, t2, d2, t4, a2, a3, *, elbow=1, depth=1, unit=1.0, convention="modified") -> np.ndarray:
    """The direct model as a function of numbers, (4, 4).

    `elbow` and `depth` are the signs with which t2 and d2 enter; `unit` is that of the angles, in radians; the matrices of
    the rows may be those of the ``"classic"`` convention.
    """
    pose = _pose if convention == "modified" else _classic_pose
    return pose(unit * t1, unit * elbow * t2, depth * d2, unit * t4, a2, a3)


def draw_arguments(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists for `forward`: random ones, then round angles."""
    draws = [
        [*rng.uniform(-3, 3, 2), rng.uniform(0.05, 0.3), rng.uniform(-3, 3), *rng.uniform(0.2, 0.6, 2)]
        for _ in range(8)
    ]
    round_angles = [
        [np.pi / 2, 0.0, 0.1, np.pi, 0.4, 0.3],
        [0.0, -np.pi / 2, 0.2, np.pi / 4, 0.25, 0.35],
        [np.pi, np.pi, 0.0, 0.0, 0.4, 0.4],
    ]
    return [[float(value) for value in args] for args in draws + round_angles]


def list_postures(mine) -> list[list[float]]:
    """All [t1, t2, d2, t4] that reach the student's pose."""
    return robots.scara(mine.a2, mine.a3).inverse((mine.x, mine.y, mine.z, np.radians(mine.heading))).q.tolist()


def share_t1_and_heading(postures):
    """Both t1 alike, and each t4 made up from them so that the heading is right."""
    q1 = postures[0][0]
    return [[q1, q2, depth, q4 + first - q1] for first, q2, depth, q4 in postures]


def residual(q, mine) -> np.ndarray:
    """How far the hand is from the student's pose, (k,), for joint values (k, 4)."""
    hands = np.array([forward(*row, mine.a2, mine.a3) for row in q])
    return distance_and_turn(hands, (mine.x, mine.y, mine.z), np.radians(mine.heading))


def quill_turned(share=0.7):
    """The mistake of counting d2 upwards, as in the second print of the table."""
    return symbol_negated(d2, "sign_of_d2", D2_IS_A_DEPTH, share)
