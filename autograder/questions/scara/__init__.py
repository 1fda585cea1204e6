"""SCARA (MECA 953 slides): table, recursion, direct model, the sign of d2, postures."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Follow, Question, following, mistake
from autograder.judge.misconceptions import (
    angle_not_summed,
    angles_subtracted,
    arguments_in_degrees,
    classic_matrix,
    classic_table,
    columns_exchanged,
    degrees,
    one_factor_missing,
    option,
    posture_missing,
    product,
    reversed_product,
    revolute_everywhere,
    sign_of,
    symbol_negated,
    transposed_rotation,
    with_first_theta1,
)
from autograder.reference import DHTable, robots

t1, t2, t4, a2, a3, d2 = sympy.symbols("t1 t2 t4 a2 a3 d2")
GENERAL = sympy.symbols("a alpha d theta")

TABLE = robots.SCARA.table
ROWS = [[row.sigma, *row.parameters] for row in TABLE.rows]
TRANSFORMS = TABLE.transforms()
U0, U1, *_ = TABLE.recursion()
MODEL = [*U0[:3, 3], t1 + t2 + t4]

D2_IS_A_DEPTH = (
    "**The sign of d2 is turned.** d2 counts downwards, like the depth of the quill, while Z3 points upwards. The "
    "slides print the table twice, once with each sign: only one of them goes with their matrices."
)


@lru_cache
def forward():
    """The direct model as a function of numbers: forward(t1, t2, d2, t4, a2, a3) -> (4, 4) array."""
    return sympy.lambdify([t1, t2, d2, t4, a2, a3], U0)


def probes(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists for forward: random ones, then round angles."""
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


def own_pose(mine):
    """The student's (a2, a3) and the pose (x, y, z, theta) to reach, metres and radians."""
    return [mine.a2, mine.a3], [mine.x, mine.y, mine.z, np.radians(mine.heading)]


def postures(mine):
    """All (t1, t2, d2, t4) that reach the student's pose."""
    lengths, pose = own_pose(mine)
    return robots.scara(*lengths).inverse(pose).q.tolist()


def with_first_t1_and_heading(solutions):
    """Both t1 alike, and each t4 made up from them so that the heading is right."""
    q1 = solutions[0][0]
    return [[q1, q2, depth, q4 + first - q1] for first, q2, depth, q4 in solutions]


def residual(q, mine):
    """How far the hand is from the student's pose, (k,), for joint values (k, 4)."""
    lengths, pose = own_pose(mine)
    hands = np.array([forward()(q1, q2, depth, q4, *lengths) for q1, q2, depth, q4 in q])
    heading = np.arctan2(hands[:, 1, 0], hands[:, 0, 0]) - pose[3]
    return np.linalg.norm(hands[:, :3, 3] - pose[:3], axis=1) + np.abs((heading + np.pi) % (2 * np.pi) - np.pi)


def with_turned_d2(solutions):
    return [[*solution[:2], -solution[2], solution[3]] for solution in solutions]


def turned_quill(share=0.7):
    """The answer with d2 counted upwards, as in the second print of the table."""
    return symbol_negated(d2, "sign_of_d2", D2_IS_A_DEPTH, share)


QUESTIONS = (
    Question(
        "scara.table",
        reference=ROWS,
        mistakes=(
            sign_of("d", 3, note="sign_of_d2", share=0.7, feedback=D2_IS_A_DEPTH),
            classic_table(),
            columns_exchanged("a", "d"),
            columns_exchanged("a", "alpha", share=0.4),
            revolute_everywhere(),
        ),
        partial=0.6,
    ),
    Question(
        "scara.dhm",
        reference=DHTable([(0, *GENERAL)], joints=GENERAL[3:]).transforms()[0],
        mistakes=(
            classic_matrix(GENERAL),
            symbol_negated(
                GENERAL[1],
                "sign_of_alpha",
                "**alpha turns the wrong way.** Write Rot_x(alpha) alone and see where it sends the y axis.",
                0.5,
            ),
            transposed_rotation(),
        ),
    ),
    Question(
        "scara.U1",
        reference=U1,
        mistakes=(
            turned_quill(),
            reversed_product(*TRANSFORMS[1:]),
            mistake(
                "one_matrix_only",
                0.2,
                "**This is one elementary matrix.** U1 gathers everything from frame 1 to the hand.",
                *(lambda _, matrix=matrix: matrix for matrix in TRANSFORMS[1:3]),
            ),
            one_factor_missing(
                product(TRANSFORMS[2:]), feedback="**The recursion stopped one step too early.** This is U2 = 2T4."
            ),
        ),
    ),
    Question(
        "scara.T04",
        reference=U0,
        mistakes=(
            turned_quill(),
            reversed_product(*TRANSFORMS),
            angles_subtracted(t2),
            classic_matrix(*(row[1:] for row in ROWS), note="classic_matrices"),
            transposed_rotation(),
            one_factor_missing(
                U1,
                feedback="**The recursion stopped one step too early.** This is U1 = 1T4: the first joint is not in it.",
            ),
        ),
        follows=Follow("scara.table", following.product_of_table),
    ),
    Question(
        "scara.model",
        reference=MODEL,
        mistakes=(
            turned_quill(),
            angles_subtracted(t2),
            angle_not_summed(
                [a2 * sympy.cos(t1) + a3 * sympy.cos(t2), a2 * sympy.sin(t1) + a3 * sympy.sin(t2), *MODEL[2:]],
            ),
            mistake(
                "theta4_left_out",
                0.7,
                "**The hand's own joint is missing in theta.** Joint 4 turns the hand too.",
                lambda model: [*model[:3], t1 + t2],
            ),
        ),
        partial=0.7,
        angles=(3,),
        follows=Follow("scara.T04", lambda T04: np.column_stack([following.position(T04), following.heading(T04)])),
    ),
    Question(
        "scara.d2_sign",
        reference="B",
        mistakes=(
            option(
                "A",
                "listing_believed",
                "**Two witnesses that agree may share one slip.** Put the row of this table into the general matrix: does the printed "
                "2T3 come out, and the printed z?",
            ),
            option(
                "C",
                "z3_turned_over",
                "**An axis that points down leaves traces.** Put alpha = pi into the general matrix and look at its diagonal, not only "
                "at the last column.",
            ),
            option(
                "D",
                "direction_is_free",
                "**The direction of an axis is free to choose, but the choice shows in the matrix.** The printed 2T3 goes with one of "
                "the two tables only.",
            ),
        ),
    ),
    Question(
        "scara.forward",
        reference=forward(),
        mistakes=(
            mistake(
                "sign_of_d2", 0.7, D2_IS_A_DEPTH, lambda model: lambda t1, t2, d2, *rest: model(t1, t2, -d2, *rest)
            ),
            arguments_in_degrees(0, 1, 3),
            replace(angles_subtracted(), steps=(lambda model: lambda t1, t2, *rest: model(t1, -t2, *rest),)),
        ),
        probe=probes,
    ),
    Question(
        "scara.postures",
        reference=postures,
        mistakes=(
            posture_missing(),
            mistake(
                "posture_with_other_theta1",
                0.4,
                "**Both postures share one t1.** Each t2 has a t1 of its own: put your second solution into the "
                "direct model and see where the hand goes.",
                *with_first_theta1().steps,
                with_first_t1_and_heading,
                lambda solutions: with_first_t1_and_heading(solutions[::-1]),
            ),
            with_first_theta1(
                3,
                note="posture_with_other_theta4",
                share=0.6,
                feedback="**Both postures share one t4.** The heading is the sum of three angles, and two of them have changed.",
            ),
            mistake("sign_of_d2", 0.7, D2_IS_A_DEPTH, with_turned_d2),
            degrees(0, 1, 3),
        ),
        angles=(0, 1, 3),
        tolerance=1e-3,
        residual=residual,
    ),
)
