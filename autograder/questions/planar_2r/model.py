"""The planar arm with two revolute joints: symbols, direct model, and an inverse model that can go wrong."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy

from autograder.judge.misconceptions import symbols_exchanged
from autograder.reference import DHRow, robots
from dhkit.geometry import planar_joints

from ..shared import two_link
from ..shared.tables import list_rows

t1, t2, L1, L2, x, y = sympy.symbols("t1 t2 L1 L2 x y")

TABLE = robots.PLANAR_2R.table
ROWS = [*list_rows(TABLE), [0, TABLE.tool[0, 3], 0, 0, 0]]
TRANSFORMS = [row.transform() for row in map(DHRow, *zip(*ROWS, strict=True))]
HAND = TABLE.symbolic_forward()
MODEL = list(HAND[:2, 3])
DISTANCE_SQUARED = sympy.simplify(MODEL[0] ** 2 + MODEL[1] ** 2)
ELBOW_COSINE = sympy.solve(DISTANCE_SQUARED - x**2 - y**2, sympy.cos(t2))[0]
REACH = [sympy.sqrt(sympy.factor(DISTANCE_SQUARED.subs(sympy.cos(t2), cosine))) for cosine in (-1, 1)]
DIRECTION = sympy.atan2(y, x)
FOREARM = tuple(TABLE.recursion()[1][1::-1, 3])  # the hand seen from link 1: to the left, ahead

# Both angles counted from the x axis.
ABSOLUTE_MODEL = [L1 * f(t1) + L2 * f(t2) for f in (sympy.cos, sympy.sin)]


def lengths_exchanged(feedback: str):
    """The mistake of taking each length for the other; `feedback` says how to tell them apart here."""
    return symbols_exchanged(L1, L2, "lengths_exchanged", f"**The two lengths are exchanged.** {feedback}")


def draw_posture(rng: np.random.Generator) -> dict[str, float]:
    """A sample point for t1 as a function of x, y and t2: the three belong to one posture."""
    l1, l2, _, q2, px, py = two_link.draw_posture(rng)
    return {"L1": l1, "L2": l2, "t2": q2, "x": px, "y": py}


def draw_reachable(rng: np.random.Generator) -> dict[str, float]:
    """A sample point for what depends on the target alone."""
    return {name: value for name, value in draw_posture(rng).items() if name != "t2"}


@lru_cache(maxsize=1024)
def solve(px: float, py: float, l1: float, l2: float) -> list[list[float]]:
    """All [t1, t2] that bring the hand to (px, py)."""
    return robots.planar_2r(l1, l2).inverse((px, py)).q.tolist()


def solve_own(mine) -> list[list[float]]:
    """All [t1, t2] for the student's target."""
    return solve(mine.x, mine.y, mine.L1, mine.L2)


def inverse(px, py, l1, l2, *, direction=np.arctan2, slack=two_link.ALLOWED, beyond=()):
    """All [t1, t2] for a target.

    `direction` of the target may lose a quadrant, or its value. `beyond` is returned out of reach, None standing for a
    failure. Without `slack` for the cosine, targets on a limit fall out of reach by rounding.
    """
    if two_link.classify(px, py, l1, l2, slack) == two_link.BEYOND:
        return beyond
    if two_link.classify(px, py, l1, l2) == two_link.BEYOND:
        px, py = two_link.pull_onto_limit(px, py, l1, l2)
    heading = direction(py, px)
    if heading is None:
        return None
    turn = heading - np.arctan2(py, px)
    return [[q1 + turn, q2] for q1, q2 in solve(px, py, l1, l2)]


def atan(py: float, px: float) -> float:
    """The direction by the quotient, as NumPy divides: infinite straight above and below the base."""
    return np.arctan(py / px) if px else np.sign(py) * np.pi / 2


def failing_atan(py: float, px: float) -> float | None:
    """The direction by the quotient, as Python divides: None, a failure, straight above and below the base."""
    return np.arctan(py / px) if px else None


def draw_targets(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists (x, y, L1, L2): targets in all quadrants, on both limits and out of reach."""
    found = [two_link.draw_target(rng, quadrant, (0.3, 0.8), (0.1, 0.9)) for quadrant in range(4) for _ in range(3)]
    found += [(0.0, 0.6, 0.5, 0.4), (-0.6, 0.0, 0.5, 0.4), (0.0, -0.7, 0.4, 0.5)]
    # Binary fractions: on these limits the elbow cosine is exactly 1 or -1 however it is computed.
    found += [(0.75, 0.0, 0.5, 0.25), (0.0, -0.75, 0.5, 0.25), (0.25, 0.0, 0.5, 0.25), (-0.25, 0.0, 0.25, 0.5)]
    found += [two_link.draw_rounded_limit(rng) for _ in range(3)]
    found += [
        two_link.draw_near_limit(rng, factor * two_link.ALLOWED, inner)
        for factor in (0.1, 10)
        for inner in (False, True)
    ]
    found += [(1.0, 0.3, 0.5, 0.4), (-0.2, 0.1, 0.9, 0.3), (0.02, 0.0, 0.5, 0.4), (3.0, 4.0, 1.0, 1.0)]
    return [[float(value) for value in args] for args in found]


def name_case(px, py, l1, l2) -> str:
    """The case a target belongs to, in words."""
    return f"targets {two_link.classify(px, py, l1, l2)}"


def residual(q, *target, mine) -> np.ndarray:
    """Distance of the hand from the target, (k,), for joint values (k, 2); without a target, from the student's."""
    px, py, l1, l2 = target or (mine.x, mine.y, mine.L1, mine.L2)
    return np.linalg.norm(planar_joints([l1, l2], q)[:, -1] - (px, py), axis=1)
