"""Planar arms: the one with two revolute joints, those that the id chooses, a telescopic one, and a belt."""

from __future__ import annotations

from functools import cache

import numpy as np
import sympy

from autograder.judge.misconceptions import product, symbols_exchanged
from autograder.reference import DHTable, Robot, robots
from dhkit.geometry import phasor, unit_vector, wrap
from dhkit.planar_arms import JOINTS, order_of_targets
from dhm.transforms import modified_dh

from ..shared import two_link
from ..shared.residuals import distance_and_turn

t1, t2, L1, L2, x, y = sympy.symbols("t1 t2 L1 L2 x y")

TABLE = robots.PLANAR_2R.table
MODEL = list(TABLE.symbolic_forward()[:2, 3])
DIRECTION = sympy.atan2(y, x)
FOREARM = tuple(TABLE.recursion()[1][1::-1, 3])  # the end effector seen from link 1: to the left, ahead

# Both angles counted from the x axis.
ABSOLUTE_MODEL = [L1 * f(t1) + L2 * f(t2) for f in (sympy.cos, sympy.sin)]


def lengths_exchanged(feedback: str):
    """The mistake of taking each length for the other; `feedback` says how to tell them apart here."""
    return symbols_exchanged(L1, L2, "lengths_exchanged", f"**The two lengths are exchanged.** {feedback}")


def draw_posture(rng: np.random.Generator) -> dict[str, float]:
    """A sample point for t1 as a function of x, y and t2: the three belong to one posture."""
    l1, l2, _, q2, px, py = two_link.draw_posture(rng)
    return {"L1": l1, "L2": l2, "t2": q2, "x": px, "y": py}


# ---------------------------------------------------------------- the belt


def belt_times(mine, *, distance="along", origin=True, per_speed=True) -> list[float]:
    """When the part on the belt enters the reach, is lost near the base, comes back, and leaves.

    `distance` from the base may be taken for the way along the belt; the place at time 0, or the speed, may be forgotten.
    """
    half = [
        np.sqrt(r**2 - mine.belt**2) if distance == "along" else r for r in (mine.L1 + mine.L2, abs(mine.L1 - mine.L2))
    ]
    ways = np.array([-half[0], -half[1], half[1], half[0]]) - (mine.start if origin else 0.0)
    return (ways / (mine.speed if per_speed else 1.0)).tolist()


# ---------------------------------------------------------------- the arms that the id chooses

q1, q2, q3, a, b, c = sympy.symbols("q1 q2 q3 a b c")
_QUARTER = sympy.pi / 2
TABLES = {
    "telescope": [[0, 0, 0, 0, q1 + _QUARTER], [1, c, _QUARTER, q2, 0], [0, 0, -_QUARTER, 0, q3 - _QUARTER], [0, b, 0, 0, 0]],
    "cross slide": [[0, 0, 0, 0, q1], [1, c, -_QUARTER, q2, 0], [0, 0, _QUARTER, 0, q3], [0, b, 0, 0, 0]],
    "boom": [[0, 0, 0, 0, q1], [0, a, 0, 0, q2 + _QUARTER], [1, c, _QUARTER, q3, 0], [0, 0, -_QUARTER, 0, -_QUARTER]],
    "side boom": [[0, 0, 0, 0, q1], [0, a, 0, 0, q2], [1, b, -_QUARTER, q3, 0], [0, 0, _QUARTER, 0, 0]],
    "rail": [[1, c, -_QUARTER, q1, 0], [0, 0, _QUARTER, 0, q2], [0, a, 0, 0, q3], [0, b, 0, 0, 0]],
    "rail with bent tool": [[1, 0, -_QUARTER, q1, 0], [0, 0, _QUARTER, 0, q2], [0, a, 0, 0, q3 - _QUARTER], [0, c, 0, 0, _QUARTER]],
    "bent tool": [[0, 0, 0, 0, q1], [0, a, 0, 0, q2], [0, b, 0, 0, q3 + _QUARTER], [0, c, 0, 0, -_QUARTER]],
    "bracket": [[0, 0, 0, 0, q1 + _QUARTER], [0, a, 0, 0, q2 - _QUARTER], [0, b, 0, 0, q3], [0, c, 0, 0, 0]],
}  # fmt: skip
"""DHm rows of each arm of `dhkit.planar_arms.ARMS`: its joints, then the step to the end effector."""


def own_rows(mine) -> list[list]:
    """The table of the student's arm, with letters."""
    return TABLES[mine.arm]


def without_quarter_turns(rows: list[list]) -> list[list]:
    """A table whose constant angles are all left out."""
    return [
        [row[0], row[1], 0, row[3], sympy.sympify(row[4]).subs({q1: 0, q2: 0, q3: 0}) * -1 + row[4]] for row in rows
    ]


@cache
def matrices(arm: str) -> tuple[sympy.Matrix, ...]:
    """The matrix of each row of an arm's table."""
    return tuple(modified_dh(*row[1:]) for row in TABLES[arm])


def own_pose(mine, *, order=1, rows=slice(None), sense=1) -> sympy.Matrix:
    """The transform from base to end effector of the student's arm.

    The matrices may be multiplied in the other `order`, some `rows` left out, or the turns of one `sense` taken for the other.
    """
    pose = product(matrices(mine.arm)[rows][::order])
    turning = [joint for joint, sigma in _kinds(mine.arm) if not sigma]
    return pose.subs({joint: sense * joint for joint in turning}, simultaneous=True)


def _kinds(arm: str) -> list[tuple[sympy.Symbol, int]]:
    """Each joint of an arm with its sigma."""
    return [(sympy.Symbol(name), row[0]) for name, row in zip(JOINTS, TABLES[arm])]


@cache
def robot(arm: str, lengths: tuple[float, ...]) -> Robot:
    """An arm with numbers for a, b and c."""
    letters = dict(zip((a, b, c), lengths))
    *rows, tool = [[sympy.sympify(cell).subs(letters) for cell in row] for row in TABLES[arm]]
    end = np.array(modified_dh(*tool[1:]).evalf(), float)
    return Robot(DHTable(rows, arm, [q1, q2, q3], tool=end))


def own_robot(mine) -> Robot:
    """The student's arm with the student's lengths."""
    return robot(mine.arm, (mine.a, mine.b, mine.c))


def own_postures(mine, *, unit=1.0, relative=True) -> list[list[float]]:
    """All [q1, q2, q3] that bring the end effector of the student's arm to the student's pose.

    `unit` is that of the angles, per radian. The last turning joint may be given the heading itself, not `relative` to the
    turns before it.
    """
    target, phi = np.eye(4), np.radians(mine.phi)
    target[:2, :2] = np.column_stack([unit_vector(phi), unit_vector(phi + np.pi / 2)])
    target[:2, 3] = mine.x, mine.y
    found = own_robot(mine).inverse(target).q
    turning = [i for i, (_, sigma) in enumerate(_kinds(mine.arm)) if not sigma]
    if not relative:
        found[:, turning[-1]] = phi
    found[:, turning] *= unit
    return found.tolist()


def own_residual(q, mine) -> np.ndarray:
    """How far the end effector of the student's arm is from the student's pose, (k,), for joint values (k, 3)."""
    return distance_and_turn(own_robot(mine).forward(q), (mine.x, mine.y, 0.0), np.radians(mine.phi))


# ---------------------------------------------------------------- the telescopic arm with offset

NEAREST = "targets nearer to the base than the offset"
TWO = "targets that the rod reaches on both sides"
FAR = "targets on no side within the rod's ends"
FRONT, BACK = "targets in front of the base", "targets behind the base"


def failing(mine, *, instead=None) -> list[int]:
    """Numbers of the student's targets at which the given function fails; `instead` blames others, kind for kind."""
    kinds = [(instead or {}).get(kind, kind) for kind in ("behind", "near", "inner")]
    return sorted(order_of_targets(mine).index(kind) + 1 for kind in kinds)


def inverse(px, py, e, least, most, *, direction=np.arctan2, signs=(1, -1), inner=False, ends=True, side=1, nothing=()):
    """All [t1, d2] of the telescopic arm for a target.

    The direction of the target may lose a quadrant; one sign of d2 be forgotten; a target nearer than the offset be given a
    rod all the same; the ends of the rod be ignored; the offset be on the other `side`. `nothing` is returned where there is no
    solution, None standing for a failure.
    """
    square = px * px + py * py - e * e
    if square < 0:
        if not inner:
            return nothing
        square = -square
    rods = [sign * np.sqrt(square) for sign in signs]
    kept = [d for d in rods if least <= d <= most or not ends]
    return [[wrap(direction(py, px) - side * np.arctan2(e, d)), d] for d in kept] or nothing


def atan(py: float, px: float) -> float:
    """The direction by the quotient."""
    return np.arctan(py / px)


GIVEN = {"direction": atan, "signs": (1,), "inner": True}
"""What goes wrong in the function that is given to be mended."""


def draw_targets(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists (x, y, e, d_min, d_max): all quadrants, both signs of d2, none, and nearer than the offset."""
    found = []
    for quadrant in range(4):
        for low, high, least, most in (
            (0.4, 0.6, -0.3, 0.7),
            (0.1, 0.25, -0.3, 0.7),
            (0.4, 0.6, -0.7, 0.3),
            (0.8, 0.9, -0.3, 0.7),
        ):
            e, d = rng.uniform(0.08, 0.2), rng.uniform(low, high)
            point = np.hypot(e, d) * unit_vector(quadrant * np.pi / 2 + rng.uniform(0.2, 1.3))
            found.append([*point, e, least, most])
        e = rng.uniform(0.1, 0.2)
        found.append(
            [*(rng.uniform(0.3, 0.8) * e * unit_vector(quadrant * np.pi / 2 + rng.uniform(0.2, 1.3))), e, -0.3, 0.7]
        )
    found.append([*(0.5 * unit_vector(rng.uniform(-1, 1))), 0.15, 0.1, 0.2])
    return [[float(value) for value in args] for args in found]


def name_case(px, py, e, least, most) -> str:
    """The case a target belongs to, in words."""
    if np.hypot(px, py) < e:
        return NEAREST
    number = len(inverse(px, py, e, least, most))
    return FAR if number == 0 else TWO if number == 2 else FRONT if px > 0 else BACK


def residual(q, px, py, e, least, most) -> np.ndarray:
    """Distance of the end of the rod from the target, (k,), for joint values (k, 2), and how far the rod is beyond its ends."""
    end = (q[:, 1] + 1j * e) * phasor(q[:, 0])
    return np.abs(end - (px + 1j * py)) + np.maximum(0, np.maximum(least - q[:, 1], q[:, 1] - most))
