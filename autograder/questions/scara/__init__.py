"""The SCARA of the MECA 953 slides, and an arm of one's own: table, transform, position, measured lengths."""

from __future__ import annotations

import numpy as np

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    angles_subtracted,
    arguments_in_degrees,
    classic_matrix,
    degrees,
    one_factor_missing,
    option,
    posture_missing,
    reversed_product,
    transposed_rotation,
    with_first_theta1,
)
from autograder.judge.steps import in_each_row, negate

from ..shared.own_arm import position_of_own_arm, table_of_own_arm, transform_of_own_arm
from .model import (
    D2_IS_A_DEPTH,
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
    t2,
)
from .own_arm import MEASURED

QUESTIONS = (
    table_of_own_arm("scara.table", joints=4),
    transform_of_own_arm("scara.T0E", table="scara.table"),
    position_of_own_arm("scara.model", transform_id="scara.T0E"),
    MEASURED,
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
