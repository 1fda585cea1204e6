"""Planar arm with two revolute joints (EPFL slides): direct model, inverse model, postures, reach."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Follow, Question, following, mistake
from autograder.judge.misconceptions import (
    angle_not_summed,
    angles_subtracted,
    atan2_arguments_exchanged,
    atan_for_atan2,
    classic_table,
    columns_exchanged,
    degrees,
    fails_on_limit,
    misprint,
    of_function,
    option,
    posture_missing,
    product,
    reversed_product,
    symbols_exchanged,
    tool_in_joint_row,
    tool_left_out,
    tool_twice,
    transposed_rotation,
    with_first_theta1,
)
from autograder.reference import DHRow, robots

t1, t2, L1, L2, x, y = sympy.symbols("t1 t2 L1 L2 x y")

TABLE = robots.PLANAR_2R.table
TOOL_ROW = [0, TABLE.tool[0, 3], 0, 0, 0]
ROWS = [[row.sigma, *row.parameters] for row in TABLE.rows] + [TOOL_ROW]
TRANSFORMS = [row.transform() for row in map(DHRow, *zip(*ROWS, strict=True))]
HAND = TABLE.symbolic_forward()
MODEL = list(HAND[:2, 3])
DISTANCE_SQUARED = sympy.simplify(MODEL[0] ** 2 + MODEL[1] ** 2)
ELBOW_COSINE = sympy.solve(DISTANCE_SQUARED - x**2 - y**2, sympy.cos(t2))[0]
REACH = [sympy.sqrt(sympy.factor(DISTANCE_SQUARED.subs(sympy.cos(t2), cosine))) for cosine in (-1, 1)]
DIRECTION = sympy.atan2(y, x)
FOREARM = tuple(TABLE.recursion()[1][1::-1, 3])  # the hand seen from link 1: to the left, ahead


def plane(angle, length):
    return [length * sympy.cos(angle), length * sympy.sin(angle)]


def summed(*vectors):
    return [sum(parts) for parts in zip(*vectors, strict=True)]


def consistent_point(rng: np.random.Generator) -> dict[str, float]:
    """A sample point for t1 as a function of x, y and t2: the three belong to one posture."""
    l1, l2 = rng.uniform(0.3, 1.2, 2)
    q1, q2 = rng.uniform(-np.pi, np.pi, 2)
    px, py = robots.planar_2r(l1, l2).forward([q1, q2])[:2, 3]
    return {"L1": l1, "L2": l2, "t2": q2, "x": px, "y": py}


def reachable_point(rng: np.random.Generator) -> dict[str, float]:
    return {name: value for name, value in consistent_point(rng).items() if name != "t2"}


@lru_cache(maxsize=1024)
def solutions(px, py, l1, l2):
    """All (t1, t2) that bring the hand to (px, py)."""
    return robots.planar_2r(l1, l2).inverse((px, py)).q.tolist()


def own_target(mine):
    """The student's (x, y, L1, L2)."""
    return [mine.x, mine.y, mine.L1, mine.L2]


def with_opposite_elbows(found):
    return [[q1, -q2] for q1, q2 in found]


def probes(rng: np.random.Generator) -> list[list[float]]:
    """Targets in all quadrants, on both limits and out of reach."""
    found = []
    for quadrant in range(4):
        for _ in range(3):
            l1, l2 = rng.uniform(0.3, 0.8), rng.uniform(0.3, 0.8)
            r = abs(l1 - l2) + rng.uniform(0.1, 0.9) * (l1 + l2 - abs(l1 - l2))
            angle = quadrant * np.pi / 2 + rng.uniform(0.1, 1.4)
            found.append([r * np.cos(angle), r * np.sin(angle), l1, l2])
    found += [[0.0, 0.6, 0.5, 0.4], [-0.6, 0.0, 0.5, 0.4], [0.0, -0.7, 0.4, 0.5]]
    # Binary fractions: on these limits the elbow cosine is exactly 1 or -1 however it is computed.
    found += [[0.75, 0.0, 0.5, 0.25], [0.0, -0.75, 0.5, 0.25], [0.25, 0.0, 0.5, 0.25], [-0.25, 0.0, 0.25, 0.5]]
    found += [_rounded_outwards(rng) for _ in range(3)]
    found += [[1.0, 0.3, 0.5, 0.4], [-0.2, 0.1, 0.9, 0.3], [0.02, 0.0, 0.5, 0.4], [3.0, 4.0, 1.0, 1.0]]
    return [[float(value) for value in args] for args in found]


def _rounded_outwards(rng: np.random.Generator) -> list[float]:
    """A point of the outer limit whose elbow cosine comes out some rounding errors above 1."""
    while True:
        l1, l2, angle = rng.uniform(0.3, 0.8), rng.uniform(0.3, 0.8), rng.uniform(0.1, 1.4)
        px, py = (l1 + l2) * np.cos(angle), (l1 + l2) * np.sin(angle)
        if elbow_cosine(px, py, l1, l2) > 1 + 4e-16:
            return [px, py, l1, l2]


def elbow_cosine(px, py, l1, l2) -> float:
    return (px * px + py * py - l1 * l1 - l2 * l2) / (2 * l1 * l2)


def where(px, py, l1, l2) -> str:
    """The case a target belongs to."""
    r = np.hypot(px, py)
    if min(abs(r - l1 - l2), abs(r - abs(l1 - l2))) < 1e-9:
        return "targets on a limit"
    return "targets within reach" if abs(l1 - l2) < r < l1 + l2 else "targets out of reach"


def inverse(*, direction=np.arctan2, clipped=True, beyond=()):
    """A student's inverse(x, y, L1, L2) with one thing done wrong; the default is right.

    `beyond` is returned out of reach, None standing for a function that fails there. Without clipping,
    targets on a limit fall out of reach by rounding.
    """

    def answer(px, py, l1, l2):
        lost = not clipped and abs(elbow_cosine(px, py, l1, l2)) > 1
        if lost or where(px, py, l1, l2) == "targets out of reach":
            return beyond
        heading = direction(py, px)
        if heading is None:
            return None
        turn = heading - np.arctan2(py, px)
        return [[q1 + turn, q2] for q1, q2 in solutions(px, py, l1, l2)]

    return answer


def atan_direction(py, px):
    return np.arctan(py / px) if px else np.sign(py) * np.pi / 2


def plain_atan_direction(py, px):
    """None, a failure, straight above and below the base: there y / x divides by zero."""
    return np.arctan(py / px) if px else None


def lengths_exchanged(feedback):
    return symbols_exchanged(L1, L2, "lengths_exchanged", f"**The two lengths are exchanged.** {feedback}")


def residual(q, *target, mine):
    """How far the hand is from the target, (k,), for joint values (k, 2)."""
    px, py, l1, l2 = target or own_target(mine)
    t1, t12 = q[:, 0], q.sum(axis=1)
    return np.hypot(l1 * np.cos(t1) + l2 * np.cos(t12) - px, l1 * np.sin(t1) + l2 * np.sin(t12) - py)


QUESTIONS = (
    Question(
        "planar_2r.table",
        reference=ROWS,
        mistakes=(
            classic_table(
                feedback="**This is the classic Denavit-Hartenberg table**, as on the Romanian slide whose header says modified. "
                "In the modified form row i holds the link *before* joint i.",
            ),
            columns_exchanged("a", "d"),
            lengths_exchanged("Which link lies between the two joint axes?"),
            tool_left_out(),
            tool_twice(),
            tool_in_joint_row(),
        ),
        partial=0.6,
    ),
    Question(
        "planar_2r.model",
        reference=MODEL,
        mistakes=(
            misprint(
                lambda model: [model[0], model[1] - L1 * sympy.sin(t1) + L1 * sympy.cos(t1)],
                "in the expansion of y the first term carries a cosine: compare it with the line above it.",
                note="slide_misprint_y",
                share=0.6,
            ),
            angle_not_summed(summed(plane(t1, L1), plane(t2, L2))),
            angles_subtracted(t2),
            mistake(
                "x_and_y_exchanged",
                0.5,
                "**x and y are exchanged.** With both angles zero the arm lies on the x axis.",
                lambda model: model[::-1],
            ),
            lengths_exchanged("L1 is the link at the base."),
        ),
    ),
    Question(
        "planar_2r.T0E",
        reference=HAND,
        mistakes=(
            mistake(
                "tool_left_out",
                0.6,
                "**The tool is missing: this is 0T2, whose origin is at the elbow.** The hand is one length further on.",
                lambda _: product(TRANSFORMS[:2]),
            ),
            reversed_product(*TRANSFORMS),
            transposed_rotation(),
            angles_subtracted(t2),
        ),
        follows=Follow("planar_2r.table", following.product_of_table),
    ),
    Question(
        "planar_2r.cos_theta2",
        reference=ELBOW_COSINE,
        mistakes=(
            mistake(
                "sign_of_law_of_cosines",
                0.5,
                "**The sign is turned.** The law of cosines holds for the inner angle of the triangle; t2 is measured "
                "from the prolonged link 1. Check with the stretched arm.",
                lambda cosine: -cosine,
            ),
            mistake(
                "factor_two_missing",
                0.5,
                "**A factor 2 is missing in the denominator.** Check with the stretched arm: its cosine must be 1.",
                lambda cosine: 2 * cosine,
            ),
            mistake(
                "angle_instead_of_cosine",
                0.7,
                "**This is the angle; its cosine is asked for.** With acos the second posture is already lost.",
                sympy.acos,
            ),
        ),
        draw=reachable_point,
    ),
    Question(
        "planar_2r.theta1",
        reference=DIRECTION - sympy.atan2(*FOREARM),
        mistakes=(
            atan_for_atan2(2),
            atan2_arguments_exchanged(2),
            mistake(
                "sign_of_second_angle",
                0.5,
                "**The angle between link 1 and the line to the target has the wrong sign.** Draw the arm with a "
                "small positive t2: on which side of the line does link 1 lie?",
                lambda angle: angle + 2 * sympy.atan2(*FOREARM),
            ),
            mistake(
                "elbow_not_considered",
                0.3,
                "**This is the direction of the target.** Link 1 points there only when the arm is stretched.",
                lambda _: DIRECTION,
            ),
        ),
        angles=(0,),
        draw=consistent_point,
    ),
    Question(
        "planar_2r.reach",
        reference=REACH,
        mistakes=(
            mistake(
                "r_min_without_absolute_value",
                0.7,
                "**r_min becomes negative when link 2 is the longer one.** A distance never does.",
                lambda limits: [L1 - L2, limits[1]],
                lambda limits: [L2 - L1, limits[1]],
            ),
            mistake(
                "r_min_zero",
                0.5,
                "**The hand cannot come back to the base unless the links are equally long.** Fold the arm and measure.",
                lambda limits: [0, limits[1]],
            ),
            mistake(
                "limits_exchanged",
                0.6,
                "**The two limits are exchanged.** r_min comes first.",
                lambda limits: limits[::-1],
            ),
        ),
    ),
    Question(
        "planar_2r.postures",
        reference=lambda mine: solutions(*own_target(mine)),
        mistakes=(
            posture_missing(),
            with_first_theta1(),
            mistake(
                "elbows_crossed",
                0.4,
                "**Each t1 is paired with the other posture's t2.** The pairs belong together: put them into the direct model.",
                with_opposite_elbows,
            ),
            degrees(0, 1),
        ),
        angles=(0, 1),
        tolerance=1e-3,
        residual=residual,
    ),
    Question(
        "planar_2r.inverse",
        reference=solutions,
        mistakes=(
            mistake(
                "one_posture_missing",
                0.5,
                posture_missing().feedback,
                lambda inverse: lambda *target: inverse(*target)[:1],
                lambda inverse: lambda *target: inverse(*target)[-1:],
            ),
            mistake(
                "atan_for_atan2",
                0.5,
                atan_for_atan2().feedback,
                lambda _: inverse(direction=atan_direction),
                lambda _: inverse(direction=atan_direction, clipped=False, beyond=None),
                lambda _: inverse(direction=plain_atan_direction),
                lambda _: inverse(direction=plain_atan_direction, clipped=False, beyond=None),
            ),
            fails_on_limit(inverse(clipped=False, beyond=None)),
            mistake(
                "limit_taken_for_out_of_reach",
                0.7,
                "**Some targets on a limit come back without a solution.** Rounding pushes the cosine of t2 a hair above "
                "1: leave a small tolerance before you say that a target is out of reach.",
                lambda _: inverse(clipped=False),
            ),
            mistake(
                "out_of_reach_fails",
                0.7,
                "**Out of reach your function fails instead of returning an empty list.** Test the cosine of t2 before "
                "you take acos.",
                lambda _: inverse(beyond=None),
            ),
            of_function(degrees(0, 1)),
            mistake(
                "no_solution_at_all",
                0.0,
                "**Your function finds no solution for any target**, not even for those within reach.",
                lambda _: lambda *target: [],
            ),
        ),
        angles=(0, 1),
        tolerance=1e-4,
        probe=probes,
        case=where,
        residual=residual,
    ),
    Question(
        "planar_2r.centre",
        reference="D",
        mistakes=(
            option(
                "A",
                "formula_without_value",
                "**That atan2(0, 0) has no value does not mean that the hand cannot be there.** Fold the arm: where does the hand lie?",
            ),
            option(
                "B",
                "folded_arm_only",
                "**The elbow has one value, but the posture has two angles.** Fold the arm and turn joint 1: what does the hand do?",
            ),
            option(
                "C",
                "two_as_everywhere_else",
                "**Two postures are the rule, and this point is the exception.** What becomes of the two elbow angles when the arm is "
                "folded, and of the determinant that decides about t1?",
            ),
        ),
    ),
)
