"""SCARA (MECA 953 slides): table, recursion, direct model, the sign of d2, postures."""

from __future__ import annotations

import numpy as np

from autograder.judge import Follow, Question, following, mistake
from autograder.judge.chain import SAME_SENSES
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
from autograder.judge.steps import in_each_row, negate

from .model import (
    ABSOLUTE_MODEL,
    D2_IS_A_DEPTH,
    GENERAL,
    GENERAL_MATRIX,
    MODEL,
    ROWS,
    TRANSFORMS,
    U0,
    U1,
    draw_arguments,
    forward,
    list_postures,
    quill_turned,
    residual,
    share_t1_and_heading,
    t1,
    t2,
)

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
        pinned=SAME_SENSES,
    ),
    Question(
        "scara.dhm",
        reference=GENERAL_MATRIX,
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
            quill_turned(),
            reversed_product(*TRANSFORMS[1:]),
            classic_matrix(*(row[1:] for row in ROWS[1:]), note="classic_matrices"),
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
            quill_turned(),
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
            quill_turned(),
            angles_subtracted(t2),
            angle_not_summed(ABSOLUTE_MODEL),
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
        reference=forward,
        mistakes=(
            mistake("sign_of_d2", 0.7, D2_IS_A_DEPTH, wrong={"depth": -1}),
            arguments_in_degrees({"unit": np.pi / 180}),
            angles_subtracted(wrong={"elbow": -1}),
            classic_matrix(note="classic_matrices", wrong={"convention": "classic"}),
        ),
        probe=draw_arguments,
    ),
    Question(
        "scara.postures",
        reference=list_postures,
        mistakes=(
            posture_missing(),
            mistake(
                "posture_with_other_theta1",
                0.4,
                "**Both postures share one t1.** Each t2 has a t1 of its own: put your second solution into the "
                "direct model and see where the hand goes.",
                *with_first_theta1().steps,
                share_t1_and_heading,
                lambda postures: share_t1_and_heading(postures[::-1]),
            ),
            with_first_theta1(
                3,
                note="posture_with_other_theta4",
                share=0.6,
                feedback="**Both postures share one t4.** The heading is the sum of three angles, and two of them have changed.",
            ),
            mistake("sign_of_d2", 0.7, D2_IS_A_DEPTH, in_each_row(negate(2))),
            degrees(0, 1, 3),
        ),
        angles=(0, 1, 3),
        residual=residual,
    ),
)
