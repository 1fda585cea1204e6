"""Planar arm with two revolute joints (EPFL slides): direct model, inverse model, postures, reach."""

from __future__ import annotations

import sympy

from autograder.judge import Follow, Question, following, mistake
from autograder.judge.chain import SAME_FRAMES
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
    option,
    posture_missing,
    product,
    reversed_product,
    tolerance_too_wide,
    tool_in_joint_row,
    tool_left_out,
    tool_twice,
    transposed_rotation,
    with_first_theta1,
)
from autograder.judge.steps import in_each_row, negate, replace_entry

from .model import (
    ABSOLUTE_MODEL,
    DIRECTION,
    ELBOW_COSINE,
    FOREARM,
    HAND,
    L1,
    L2,
    MODEL,
    REACH,
    ROWS,
    TRANSFORMS,
    atan,
    draw_posture,
    draw_reachable,
    draw_targets,
    failing_atan,
    inverse,
    lengths_exchanged,
    name_case,
    residual,
    solve_own,
    t1,
    t2,
)

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
        pinned=SAME_FRAMES,
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
            angle_not_summed(ABSOLUTE_MODEL),
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
        draw=draw_reachable,
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
        draw=draw_posture,
    ),
    Question(
        "planar_2r.reach",
        reference=REACH,
        mistakes=(
            mistake(
                "r_min_without_absolute_value",
                0.7,
                "**r_min becomes negative when link 2 is the longer one.** A distance never does.",
                replace_entry(0, L1 - L2),
                replace_entry(0, L2 - L1),
            ),
            mistake(
                "r_min_zero",
                0.5,
                "**The hand cannot come back to the base unless the links are equally long.** Fold the arm and measure.",
                replace_entry(0, 0),
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
        reference=solve_own,
        mistakes=(
            posture_missing(),
            with_first_theta1(),
            mistake(
                "elbows_crossed",
                0.4,
                "**Each t1 is paired with the other posture's t2.** The pairs belong together: put them into the direct model.",
                in_each_row(negate(1)),
            ),
            degrees(0, 1),
        ),
        angles=(0, 1),
        residual=residual,
    ),
    Question(
        "planar_2r.inverse",
        reference=inverse,
        mistakes=(
            posture_missing(),
            atan_for_atan2(
                wrong=[
                    {"direction": atan},
                    {"direction": atan, "slack": 0.0, "beyond": None},
                    {"direction": failing_atan},
                    {"direction": failing_atan, "slack": 0.0, "beyond": None},
                ],
            ),
            fails_on_limit({"slack": 0.0, "beyond": None}),
            mistake(
                "limit_taken_for_out_of_reach",
                0.7,
                "**Some targets on a limit come back without a solution.** Rounding pushes the cosine of t2 a hair above "
                "1: leave a small tolerance before you say that a target is out of reach.",
                wrong=[{"slack": 0.0}, {"slack": 1e-12}],
            ),
            tolerance_too_wide({"slack": 1e-6}),
            mistake(
                "out_of_reach_fails",
                0.7,
                "**Out of reach your function does not return an empty list.** Test the cosine of t2 before you take acos, and return `[]` "
                "where there is no angle.",
                wrong={"beyond": None},
            ),
            degrees(0, 1),
            mistake(
                "no_solution_at_all",
                0.0,
                "**Your function finds no solution for any target**, not even for those within reach.",
                lambda _: [],
            ),
        ),
        angles=(0, 1),
        probe=draw_targets,
        case=name_case,
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
