"""SCARA (MECA 953 slides): table, recursion, direct model, the sign of d2, postures."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    classic_rows,
    classic_transform,
    exchanged,
    negated,
    product,
    reversed_product,
    revolute_everywhere,
    transposed_rotation,
)
from autograder.reference import DHTable, robots

t1, t2, t4, a2, a3, d2 = sympy.symbols("t1 t2 t4 a2 a3 d2")
GENERAL = sympy.symbols("a alpha d theta")

TABLE = robots.SCARA.table
ROWS = [[row.sigma, *row.parameters] for row in TABLE.rows]
TRANSFORMS = TABLE.transforms()
U0, U1, *_ = TABLE.recursion()
MODEL = [*U0[:3, 3], t1 + t2 + t4]

LENGTHS = {"a2": 0.4, "a3": 0.3}
POSE = (0.35, 0.45, -0.12, np.pi / 3)  # x, y, z, theta of the last question

D2_IS_A_DEPTH = (
    "**The sign of d2 is turned.** d2 counts downwards, like the depth of the quill, while Z3 points upwards. The "
    "slides print the table twice, once with each sign: only one of them goes with their matrices."
)
RELATIVE_ANGLE = (
    "**The second link is placed as if t2 were measured from the x axis.** t2 goes from link 1 to link 2: look at "
    "the arm from above with t2 = 0, where it is stretched."
)
DIFFERENCE = (
    "**The two joint angles are subtracted.** Both joints turn in the same sense about parallel axes: look at what "
    "the product of two rotations about z does to their angles."
)
CLASSIC_TABLE = (
    "**This is the classic Denavit-Hartenberg table.** In the modified form (Khalil-Kleinfinger) row i holds a and "
    "alpha of the link *before* joint i. See the slide that compares the two conventions."
)
CLASSIC_MATRIX = (
    "**This is the matrix of classic Denavit-Hartenberg.** The modified form begins with the step along and about "
    "X, and ends with the step along and about Z. See the slide that compares the two conventions."
)
REVERSED = "**The matrices are multiplied in the reverse order.** Read 0T4 as 0T1, then 1T2, then 2T3, then 3T4."
TRANSPOSED = "**The rotation block is transposed.** Its columns, not its rows, are the axes of the new frame."
DEGREES = "**The angles are taken in degrees.** The question and numpy's cos and sin count in radians."


def turned_quill(answer):
    """The answer with d2 counted upwards, as in the second print of the table."""
    return sympy.Matrix(answer).subs(d2, -d2)


def subtracted_angles(answer):
    """The answer with theta1 - theta2 in the place of theta1 + theta2."""
    return sympy.Matrix(answer).subs(t2, -t2)


@lru_cache
def forward():
    """The direct model as a function of numbers: forward(t1, t2, d2, t4, a2, a3) -> (4, 4) array."""
    return sympy.lambdify([t1, t2, d2, t4, a2, a3], U0)


def with_angles_in_degrees(model):
    """A direct model whose angles are taken in degrees."""
    return lambda t1, t2, d2, t4, a2, a3: model(np.radians(t1), np.radians(t2), d2, np.radians(t4), a2, a3)


def probes(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists for forward: random ones, then round angles."""
    draws = [[*rng.uniform(-3, 3, 2), rng.uniform(0.05, 0.3), rng.uniform(-3, 3), *rng.uniform(0.2, 0.6, 2)] for _ in range(8)]
    round_angles = [[np.pi / 2, 0.0, 0.1, np.pi, 0.4, 0.3], [0.0, -np.pi / 2, 0.2, np.pi / 4, 0.25, 0.35], [np.pi, np.pi, 0.0, 0.0, 0.4, 0.4]]
    return [[float(value) for value in args] for args in draws + round_angles]


@lru_cache
def postures():
    """All (t1, t2, d2, t4) that reach `POSE`."""
    return robots.scara(**LENGTHS).solve(POSE).q


def with_first_t4(solutions):
    return [[*solution[:3], solutions[0][3]] for solution in solutions]


def with_first_t1(solutions):
    return [[solutions[0][0], *solution[1:]] for solution in solutions]


def with_first_t1_and_heading(solutions):
    """Both t1 alike, and each t4 made up from them so that the heading is right."""
    q1 = solutions[0][0]
    return [[q1, q2, depth, q4 + first - q1] for first, q2, depth, q4 in solutions]


def with_turned_d2(solutions):
    return [[*solution[:2], -solution[2], solution[3]] for solution in solutions]


def in_degrees(solutions):
    return [[np.degrees(q1), np.degrees(q2), depth, np.degrees(q4)] for q1, q2, depth, q4 in solutions]


QUESTIONS = (
    Question(
        "scara.table",
        reference=lambda variant: ROWS,
        mistakes=(
            mistake("sign_of_d2", 0.7, D2_IS_A_DEPTH, lambda rows: negated(rows, 3, "d")),
            mistake("classic_table", 0.3, CLASSIC_TABLE, classic_rows),
            mistake(
                "a_and_d_exchanged",
                0.3,
                "**The columns a and d are exchanged.** a is counted along X, from one joint axis to the next; d along Z.",
                lambda rows: exchanged(rows, "a", "d"),
            ),
            mistake(
                "a_and_alpha_exchanged",
                0.4,
                "**The columns a and alpha are exchanged.** Some slides print alpha first; the question asks for "
                "sigma, a, alpha, d, theta.",
                lambda rows: exchanged(rows, "a", "alpha"),
            ),
            mistake(
                "sigma_all_revolute",
                0.7,
                "**One joint slides, and sigma must say so.** Look at what its motor changes: an angle or a distance?",
                revolute_everywhere,
            ),
        ),
        partial=0.6,
    ),
    Question(
        "scara.dhm",
        reference=lambda variant: DHTable([(0, *GENERAL)], joints=GENERAL[3:]).transforms()[0],
        mistakes=(
            mistake("classic_matrix", 0.3, CLASSIC_MATRIX, lambda _: classic_transform(*GENERAL)),
            mistake(
                "sign_of_alpha",
                0.5,
                "**alpha turns the wrong way.** Write Rot_x(alpha) alone and see where it sends the y axis.",
                lambda matrix: matrix.subs(GENERAL[1], -GENERAL[1]),
            ),
            mistake(
                "transposed_rotation",
                0.4,
                TRANSPOSED,
                transposed_rotation,
            ),
        ),
    ),
    Question(
        "scara.U1",
        reference=lambda variant: U1,
        mistakes=(
            mistake("sign_of_d2", 0.7, D2_IS_A_DEPTH, turned_quill),
            mistake("reversed_product", 0.3, REVERSED, lambda _: reversed_product(TRANSFORMS[1:])),
            mistake(
                "one_matrix_only",
                0.2,
                "**This is one elementary matrix.** U1 gathers everything from frame 1 to the hand.",
                *(lambda _, matrix=matrix: matrix for matrix in TRANSFORMS[1:3]),
            ),
            mistake(
                "one_step_short",
                0.4,
                "**The recursion stopped one step too early.** This is U2 = 2T4.",
                lambda _: product(TRANSFORMS[2:]),
            ),
        ),
    ),
    Question(
        "scara.T04",
        reference=lambda variant: U0,
        mistakes=(
            mistake("sign_of_d2", 0.7, D2_IS_A_DEPTH, turned_quill),
            mistake("reversed_product", 0.3, REVERSED, lambda _: reversed_product(TRANSFORMS)),
            mistake("angles_subtracted", 0.4, DIFFERENCE, subtracted_angles),
            mistake(
                "classic_matrices",
                0.3,
                CLASSIC_MATRIX,
                lambda _: product([classic_transform(*row[1:]) for row in ROWS]),
            ),
            mistake("transposed_rotation", 0.4, TRANSPOSED, transposed_rotation),
            mistake(
                "one_step_short",
                0.4,
                "**The recursion stopped one step too early.** This is U1 = 1T4: the first joint is not in it.",
                lambda _: U1,
            ),
        ),
    ),
    Question(
        "scara.model",
        reference=lambda variant: MODEL,
        mistakes=(
            mistake("sign_of_d2", 0.7, D2_IS_A_DEPTH, turned_quill),
            mistake("angles_subtracted", 0.4, DIFFERENCE, subtracted_angles),
            mistake(
                "angle_not_summed",
                0.4,
                RELATIVE_ANGLE,
                lambda model: [a2 * sympy.cos(t1) + a3 * sympy.cos(t2), a2 * sympy.sin(t1) + a3 * sympy.sin(t2), *model[2:]],
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
    ),
    Question("scara.d2_sign", reference=lambda variant: "B"),
    Question(
        "scara.forward",
        reference=lambda variant: forward(),
        mistakes=(
            mistake("sign_of_d2", 0.7, D2_IS_A_DEPTH, lambda model: lambda t1, t2, d2, *rest: model(t1, t2, -d2, *rest)),
            mistake("degrees", 0.4, DEGREES, with_angles_in_degrees),
            mistake(
                "angles_subtracted", 0.4, DIFFERENCE, lambda model: lambda t1, t2, *rest: model(t1, -t2, *rest)
            ),
        ),
        probe=probes,
    ),
    Question(
        "scara.postures",
        reference=lambda variant: postures(),
        mistakes=(
            mistake(
                "one_posture_missing",
                0.5,
                "**One posture is missing.** A cosine alone does not tell the sign of its angle.",
                lambda solutions: solutions[:1],
                lambda solutions: solutions[1:],
            ),
            mistake(
                "posture_with_other_theta1",
                0.4,
                "**Both postures share one t1.** Each t2 has a t1 of its own: put your second solution into the "
                "direct model and see where the hand goes.",
                with_first_t1,
                lambda solutions: with_first_t1(solutions[::-1]),
                with_first_t1_and_heading,
                lambda solutions: with_first_t1_and_heading(solutions[::-1]),
            ),
            mistake(
                "posture_with_other_theta4",
                0.6,
                "**Both postures share one t4.** The heading is the sum of three angles, and two of them have changed.",
                with_first_t4,
                lambda solutions: with_first_t4(solutions[::-1]),
            ),
            mistake("sign_of_d2", 0.7, D2_IS_A_DEPTH, with_turned_d2),
            mistake("degrees", 0.4, DEGREES, in_degrees, turn=360),
        ),
        angles=(0, 1, 3),
        tolerance=1e-3,
    ),
)
