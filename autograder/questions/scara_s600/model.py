"""The Adept s600: symbols, the type-8 equation, and an inverse model that can go wrong."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Family, mistake
from autograder.judge.misconceptions import product
from autograder.judge.steps import substitute
from autograder.reference import robots
from dhkit.scara_tasks import GRIPPER, catalogue, measured
from dhm.transforms import modified_dh

from ..shared import two_link
from ..shared.residuals import distance_and_turn

t1, t2, r3, t4, d2, d3, r30 = sympy.symbols("t1 t2 r3 t4 d2 d3 r30")

TABLE = robots.ADEPT_S600.table
HAND = TABLE.recursion()[0]
R30 = -0.05

CONSTANT = (
    "**The constant r30 is missing.** The motor's zero is not where O3 meets the arm: two lengths lie along z3. The tutorial "
    "leaves it out in one matrix, too."
)


def constant_missing(share=0.7):
    """The mistake of leaving out r30."""
    return mistake("constant_missing", share, CONSTANT, substitute({r30: 0}))


def blame(wrong: int, instead_of: int):
    """A step on line numbers: one is taken for another."""
    return lambda lines: sorted(wrong if line == instead_of else line for line in lines)


# ---------------------------------------------------------------- the inverse model


@lru_cache(maxsize=1024)
def robot(length2, length3, constant) -> robots.Robot:
    return robots.adept_s600(length2, length3, constant)


def mgi(
    x, y, z, omega, length2, length3, constant, *, constant_sign=-1, slack=two_link.ALLOWED, fails=False, divided=False
):
    """All [t1, t2, r3, t4] for a pose, a `Family` at the centre of an arm with equal links.

    `constant_sign` is that of r30 in r3, 0 where it is left out. `slack` is allowed for rounding of the elbow cosine; where
    it is pushed beyond 1 the function `fails`. With a division it fails at the centre.
    """
    case = name_case(x, y, z, omega, length2, length3, constant)
    if fails and 0 < abs(two_link.elbow_cosine(x, y, length2, length3)) - 1 < two_link.ALLOWED:
        raise ValueError("math domain error")
    if two_link.classify(x, y, length2, length3, slack) == two_link.BEYOND:
        return []
    if two_link.classify(x, y, length2, length3) == two_link.BEYOND:
        x, y = two_link.pull_onto_limit(x, y, length2, length3)
    if divided and case == AT_CENTRE:
        raise ZeroDivisionError("float division by zero")
    found = robot(length2, length3, constant).inverse((x, y, z, omega))
    more = (constant_sign + 1) * constant
    rows = [[q1, q2, height + more, q4] for q1, q2, height, q4 in found.q.tolist()]
    return Family(turn_about_centre(rows[0])) if found.status == "infinite" else rows


def turn_about_centre(row, firsts=(0.0, -np.pi / 2, np.pi / 2)) -> list[list[float]]:
    """Members of the family of a folded arm, by their t1; the direction of the hand stays."""
    return [[first, row[1], row[2], row[3] + first - row[0]] for first in firsts]


def keep_elbow(which: int):
    """A step: one of two postures. Those of a folded arm have the same elbow, and any of them shows all."""
    return lambda found: found if len(found) < 2 or found[0][1] == found[1][1] else [found[which]]


def residual(q, *pose, mine) -> np.ndarray:
    """How far the hand is from the pose, (k,), for joint values (k, 4); without a pose, from the student's."""
    x, y, z, omega, *lengths = pose or own_pose(mine)
    return distance_and_turn(robot(*lengths).forward(q), (x, y, z), omega)


def own_pose(mine) -> tuple[float, ...]:
    """The student's (x, y, z, omega) and arm (d2, d3, r30)."""
    return mine.x, mine.y, mine.z, np.radians(mine.omega), mine.d2, mine.d3, R30


def draw_poses(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists: poses in all quadrants, on both limits, out of reach, and at the centre of an arm with equal links."""
    found = []
    for quadrant in range(4):
        for _ in range(2):
            x, y, l2, l3 = two_link.draw_target(rng, quadrant, (0.25, 0.5), (0.15, 0.9))
            found.append([x, y, *_draw_height_and_direction(rng), l2, l3, rng.uniform(-0.1, 0.1)])
    found += [[0.0, 0.5, -0.1, np.pi / 2, 0.325, 0.275, -0.05], [-0.4, 0.0, -0.2, 0.0, 0.325, 0.275, 0.0]]
    # Binary fractions: on these limits the elbow cosine is exactly 1 or -1 however it is computed.
    found += [[0.75, 0.0, -0.1, 0.5, 0.5, 0.25, 0.0], [0.0, -0.25, -0.1, 0.5, 0.25, 0.5, -0.05]]
    for _ in range(2):
        x, y, l2, l3 = two_link.draw_rounded_limit(rng)
        found.append([x, y, *_draw_height_and_direction(rng), l2, l3, -0.05])
    for factor, inner in ((0.1, False), (0.1, True), (10, False), (10, True)):
        x, y, l2, l3 = two_link.draw_near_limit(rng, factor * two_link.ALLOWED, inner)
        found.append([x, y, *_draw_height_and_direction(rng), l2, l3, 0.05])
    found += [[0.5, 0.4, -0.1, 0.5, 0.325, 0.275, 0.0], [0.02, 0.01, -0.1, 0.5, 0.325, 0.275, 0.0]]
    found += [[0.0, 0.0, -0.15, 0.5, 0.5, 0.5, -0.05]]
    return [[float(value) for value in args] for args in found]


def _draw_height_and_direction(rng: np.random.Generator) -> tuple[float, float]:
    return rng.uniform(-0.3, 0.0), rng.uniform(-3, 3)


AT_CENTRE = "the centre, with equal links"


def name_case(x, y, z, omega, l2, l3, constant) -> str:
    """The case a pose belongs to, in words."""
    if np.hypot(x, y) < 1e-9 and abs(l2 - l3) < 1e-9:
        return AT_CENTRE
    return f"poses {two_link.classify(x, y, l2, l3)}"


# ---------------------------------------------------------------- all configurations


def list_configurations(mine) -> list[list[float]]:
    """All [t1, t2, r3, t4] with t4 between -2 pi and 2 pi, posture after posture, the smaller |t4| first."""
    found = []
    for row in mgi(*own_pose(mine)):
        other = row[3] - np.copysign(2 * np.pi, row[3])
        found += [[*row[:3], row[3]], [*row[:3], other]]
    return found


# ---------------------------------------------------------------- the SCARA that the id chooses

q1, q2, q3, q4, A, B, H = sympy.symbols("q1 q2 q3 q4 A B H")
TABLES = {
    "column": [[1, 0, 0, q1 + H, 0], [0, 0, 0, 0, q2], [0, A, 0, 0, q3], [0, B, sympy.pi, 0, q4]],
    "carousel": [[0, 0, 0, 0, q1], [1, 0, 0, q2 + H, 0], [0, A, 0, 0, q3], [0, B, sympy.pi, 0, q4]],
    "ceiling": [[0, 0, sympy.pi, H, q1], [0, A, 0, 0, q2], [1, B, 0, q3, 0], [0, 0, 0, 0, q4]],
    "quill last": [[0, 0, 0, H, q1], [0, A, 0, 0, q2], [0, B, sympy.pi, 0, q3], [1, 0, 0, q4, 0]],
}
"""DHm rows of each arm of `dhkit.scara_tasks.SCARAS`."""
CLASSIC = {
    "column": [[0, 0, q1 + H, 0], [A, 0, 0, q2], [B, sympy.pi, 0, q3], [0, 0, 0, q4]],
    "carousel": [[0, 0, 0, q1], [A, 0, q2 + H, 0], [B, sympy.pi, 0, q3], [0, 0, 0, q4]],
    "ceiling": [[A, sympy.pi, -H, -q1], [B, 0, 0, q2], [0, 0, q3, 0], [0, 0, 0, q4]],
    "quill last": [[A, 0, H, q1], [B, sympy.pi, 0, q2], [0, 0, 0, q3], [0, 0, q4, 0]],
}
"""Classic rows [a, alpha, d, theta] of the same arms."""


def own_rows(mine) -> list[list]:
    """The table of the student's SCARA."""
    return TABLES[mine.arm]


@lru_cache
def _product(arm: str, order: int, axis: int) -> sympy.Matrix:
    rows = TABLES[arm] if axis else without_half_turn(TABLES[arm])
    return sympy.simplify(product([modified_dh(*row[1:]) for row in rows][::order]))


def own_transform(mine, *, order=1, axis=1) -> sympy.Matrix:
    """The transform from base to frame 4 of the student's SCARA.

    The matrices may be multiplied in the other `order`; with `axis` 0 no z turns over.
    """
    return _product(mine.arm, order, axis)


def without_half_turn(rows: list[list]) -> list[list]:
    """A table, modified or classic, in which no z turns over."""
    return [[0 if cell == sympy.pi else cell for cell in row] for row in rows]


def own_classic(mine, *, modified=False) -> list[list]:
    """The classic table of the student's SCARA; or its `modified` one, without sigma."""
    return [row[1:] for row in TABLES[mine.arm]] if modified else CLASSIC[mine.arm]


# ---------------------------------------------------------------- choose, and measure


def fitting(mine, *, inner=True, stroke=True, gripper=True) -> list[int]:
    """Which robots of the catalogue do the student's task, 0 or 1 each; a demand may be overlooked."""
    found = []
    for upper, fore, elbow, quill, payload in catalogue(mine).values():
        nearest = np.sqrt(upper**2 + fore**2 + 2 * upper * fore * np.cos(np.radians(elbow))) if inner else 0.0
        load = mine.mass + (GRIPPER if gripper else 0.0)
        fits = nearest <= mine.near and mine.far <= upper + fore and (mine.lift <= quill or not stroke)
        found.append(int(fits and load <= payload))
    return found


def fitted(mine, *, offset=True, sheet=False) -> list[float]:
    """[d2, d3] of the measured arm, by least squares; without the `offset` of the tracker, or as the data `sheet` has them."""
    if sheet:
        return [mine.d2, mine.d3]
    first, second, px, py = measured(mine).T
    one, none = np.ones_like(first), np.zeros_like(first)
    columns = [
        [np.cos(first), np.sin(first)],
        [np.cos(first + second), np.sin(first + second)],
        [one, none],
        [none, one],
    ]
    design = np.array([np.concatenate(column) for column in columns[: 4 if offset else 2]]).T
    return np.linalg.lstsq(design, np.concatenate([px, py]), rcond=None)[0][:2].tolist()
