"""Inverse models: an arm of the student's own; of the documents a PUMA-like shoulder, a determinant, the RX-90, counts."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    atan2_arguments_exchanged,
    atan_for_atan2,
    degrees,
    fails_on_limit,
    misprint,
    tolerance_too_wide,
)
from autograder.judge.steps import change_entry, negate, replace_entry

from . import own
from .model import (
    ABSOLUTE_DETERMINANT,
    DETERMINANT,
    DIRECTION,
    PLANAR_DETERMINANT,
    ROW_6,
    SIDE,
    A,
    Wx,
    Wy,
    change_count,
    change_counts,
    count_six_cases,
    d2,
    draw_poses,
    draw_posture,
    first_half,
    keep_elbow,
    keep_wrist,
    list_rx90_postures,
    name_case,
    one_elbow,
    rx90_residual,
    second_half,
    turn_joint_1_only,
)

BACK_MISSING = (
    "**The postures over the back are missing.** Joint 1 may turn half round, and the arm then reaches the same point "
    "over its shoulder: a second value of the first joint."
)
ELBOW_MISSING = (
    "**The second elbow is missing.** A cosine, or a sine, alone does not tell the side to which the elbow is bent: look at the "
    "slide with the two postures of the planar arm."
)

QUESTIONS = (
    Question(
        "inverse_models.own_point",
        reference=own.list_configurations,
        mistakes=(
            mistake("over_the_back_missing", 0.5, BACK_MISSING, first_half, second_half),
            mistake("one_elbow_missing", 0.5, ELBOW_MISSING, *one_elbow((0, 2), (1, 3), (0, 3), (1, 2))),
            mistake(
                "joint_1_turned_only",
                0.5,
                "**Over the back only q1 was changed.** In the turned plane the target lies behind the arm: how far ahead it is changes its "
                "sign, and q2 and q3 follow. Put your third solution into the direct model.",
                turn_joint_1_only,
            ),
            degrees(0, 1, 2),
        ),
        angles=(0, 1, 2),
        residual=own.residual,
    ),
    Question(
        "inverse_models.own_counts",
        reference=own.counts,
        depends=("arm",),
        mistakes=(
            mistake(
                "wrist_not_counted",
                0.4,
                "**Case d: these are the configurations of the first three joints alone.** The wrist has two for each of them.",
                change_count(3, lambda n: n // 2),
            ),
            mistake(
                "reach_not_tested",
                0.25,
                "**Case b: is the point within reach at all, in front and over the back?** Compare its distance from axis 2, on either "
                "side, with upper arm and forearm.",
                change_count(1, lambda n: 4),
                change_count(1, lambda n: 2 - n),
            ),
            mistake(
                "near_axis_1",
                0.6,
                "**Case c: the point is close to axis 1.** How near can the wrist centre come: does the arm swing in a plane through axis 1, "
                "or in one beside it?",
                change_count(2, lambda n: 4 - n),
                change_count(2, lambda n: 2),
            ),
        ),
        partial=0.6,
    ),
    Question(
        "inverse_models.counts",
        reference=count_six_cases,
        mistakes=(
            mistake(
                "wrist_not_counted",
                0.6,
                "**These are the postures of the arm alone.** The slide stops at shoulder and elbow and asks for the wrist: it doubles "
                "the number.",
                change_counts(d=lambda n: n // 2, f=lambda n: n // 2),
                change_counts(d=lambda n: n // 2),
            ),
            mistake(
                "inner_cylinder_forgotten",
                0.7,
                "**Case e: this point is too near to axis 1.** The arm swings in a plane beside the axis. How near can its wrist centre come?",
                change_counts(e=8),
                change_counts(e=4),
            ),
            mistake(
                "back_always_in_reach",
                0.7,
                "**Case f: over its back this robot does not reach as far.** Its shoulder stands in front of axis 1.",
                change_counts(f=lambda n: 2 * n),
            ),
            mistake(
                "limit_counted_twice",
                0.7,
                "**Case c: on the limit of reach two postures are one.** Compute the distance of the target from axis 2.",
                change_counts(c=lambda n: 2 * n),
            ),
            mistake(
                "back_forgotten_on_the_limit",
                0.7,
                "**Case c: joint 1 may turn half round here, too.** The elbow is straight, so there is one posture in front. And over the back?",
                change_counts(c=1),
            ),
            mistake(
                "infinitely_many_missed",
                0.7,
                "**Case b: fold the arm and turn joint 1.** What does the hand do, and what can joint 4 do about it?",
                *(change_counts(b=n) for n in (1, 2, 0)),
            ),
        ),
        partial=0.6,
    ),
    Question(
        "inverse_models.repaired",
        reference=ROW_6,
        mistakes=(
            misprint(
                [6, 0, 0, 0, sympy.Symbol("d6"), sympy.Symbol("t6")],
                "this row belongs to a classic table. In the modified convention it puts axis 6 on axis 5.",
            ),
            mistake(
                "sign_of_alpha",
                0.6,
                "**The sign of alpha is turned.** With it the hand points back into the forearm at t5 = 0.",
                negate(3),
            ),
            mistake(
                "degrees",
                0.7,
                "**alpha is in degrees.** The question counts in radians: a quarter turn is pi/2.",
                change_entry(3, lambda alpha: alpha * 180 / sympy.pi),
            ),
            mistake(
                "row_number",
                0.8,
                "**The row is repaired, but it is not the row of this number.** Rows are counted from 1, as on the slide.",
                replace_entry(0, 5),
            ),
        ),
        angles=(3, 5),
    ),
    Question(
        "inverse_models.shoulder",
        reference=DIRECTION - SIDE,
        mistakes=(
            mistake(
                "sine_loses_the_back",
                0.5,
                "**Right in front, wrong over the back.** An arcsine, or the square root of a distance, forgets the sign of A. Let atan2 see A itself.",
                lambda angle: angle + SIDE - sympy.asin(d2 / sympy.sqrt(Wx**2 + Wy**2)),
                lambda angle: angle + SIDE - sympy.acos(sympy.Abs(A) / sympy.sqrt(Wx**2 + Wy**2)),
            ),
            atan_for_atan2(2),
            atan2_arguments_exchanged(2),
            mistake(
                "sign_of_second_angle",
                0.5,
                "**The angle of the offset has the wrong sign.** Seen along t1 the wrist centre lies to the left, by d2: on which side of the "
                "line to it does the direction t1 lie?",
                lambda angle: angle + 2 * SIDE,
            ),
            mistake(
                "offset_not_considered",
                0.3,
                "**This is the direction of the wrist centre.** The plane of the arm passes beside axis 1, by d2, as the view from above shows.",
                lambda angle: angle + SIDE,
            ),
        ),
        angles=(0,),
        draw=draw_posture,
    ),
    Question(
        "inverse_models.determinant",
        reference=DETERMINANT,
        mistakes=(
            mistake(
                "shoulder_factor_missing",
                0.4,
                "**This is the determinant of the planar arm.** Joint 1 is missing: how fast does it move the hand, and where does it not "
                "move it at all?",
                lambda _: PLANAR_DETERMINANT,
                lambda _: -PLANAR_DETERMINANT,
            ),
            mistake(
                "sign_of_the_determinant",
                0.7,
                "**The sign is turned.** Two rows or two columns are exchanged: x, y, z from top to bottom, t1, t2, t3 from left to right.",
                lambda determinant: -determinant,
            ),
            mistake(
                "angle_not_summed",
                0.4,
                "**The elevation of the forearm is t2 + t3.** t3 counts from the upper arm, as in the planar arm.",
                lambda _: ABSOLUTE_DETERMINANT,
            ),
        ),
    ),
    Question(
        "inverse_models.rx90",
        reference=list_rx90_postures,
        mistakes=(
            mistake(
                "wrist_flip_missing",
                0.5,
                "**The flipped wrist is missing.** t5 comes from a square root: with its other sign t4 and t6 turn half round, and the hand is "
                "the same.",
                keep_wrist(1),
                keep_wrist(-1),
            ),
            mistake(
                "over_the_back_missing",
                0.5,
                BACK_MISSING,
                wrong=[{"shoulder": "front"}, {"shoulder": "back"}],
            ),
            mistake(
                "one_elbow_missing",
                0.5,
                ELBOW_MISSING,
                keep_elbow(1),
                keep_elbow(-1),
            ),
            misprint(
                {"hand": "printed"},
                "the matrix 5T6 has the signs of alpha5 = +pi/2, and the table says -pi/2. Compare it with row 6, and put one of your solutions "
                "into the direct model.",
                share=0.6,
            ),
            mistake(
                "orientation_seen_from_base",
                0.4,
                "**The arm is right, the wrist is not: it was solved for the orientation seen from the base.** The wrist stands on a forearm that is "
                "turned itself. See the slide with R(base)^-1.",
                wrong={"wrist": "from base"},
            ),
            fails_on_limit(
                {"slack": 0.0, "beyond": None},
                {"fails": True},
                share=0.7,
                feedback="**On a limit your function fails.** Rounding pushes the sine of t3 a hair beyond 1, where arcsin and sqrt have no "
                "value: clip first.",
            ),
            mistake(
                "limit_taken_for_out_of_reach",
                0.8,
                "**Some poses on the limit come back without a solution.** Rounding pushes the sine of t3 a hair beyond 1: leave a small tolerance "
                "before you say that a pose is out of reach.",
                wrong=[{"slack": 0.0}, {"slack": 1e-12}],
            ),
            tolerance_too_wide({"slack": 1e-6}),
            mistake(
                "out_of_reach_fails",
                0.7,
                "**Out of reach your function does not return an empty list.** Test the sine of t3 first, and return `[]` where there is no "
                "angle.",
                wrong={"beyond": None},
            ),
            degrees(0, 1, 2, 3, 4, 5),
        ),
        partial=0.4,
        angles=(0, 1, 2, 3, 4, 5),
        probe=draw_poses,
        case=name_case,
        residual=rx90_residual,
    ),
    Question(
        "inverse_models.aligned",
        reference=own.align,
        mistakes=(
            mistake(
                "sign_of_the_sum",
                0.5,
                "**The sum q4 + q6 has the wrong sign.** Positive is right-handed about Z6: thumb along it, which way does X6 have to go?",
                wrong={"sign": -1},
            ),
            mistake(
                "sum_half_a_turn_off",
                0.5,
                "**The sum q4 + q6 is half a turn off.** Check both arguments of your atan2, and put the solution into the direct model.",
                wrong={"offset": np.pi},
            ),
            degrees(wrong={"unit": 180 / np.pi}),
        ),
        angles=(0, 1, 2),
        residual=own.aligned_residual,
    ),
    Question(
        "inverse_models.free",
        reference=[0, 0, 0, 1, 0, -1],
        mistakes=(
            mistake(
                "turned_the_same_way",
                0.3,
                "**Both joints turn the same way: so does the hand.** The sum of the two angles must stay as it is.",
                lambda _: [0, 0, 0, 1, 0, 1],
            ),
            mistake(
                "one_joint_alone",
                0.3,
                "**One joint alone turns the hand.** Which other joint turns about the same line and can undo it?",
                *(lambda _, joint=joint: [float(joint == i) for i in range(6)] for joint in (3, 5)),
            ),
            mistake(
                "joint_5_is_not_free",
                0.1,
                "**Joint 5 tilts the hand.** It is the value q5 = 0 that is special, not the motion of joint 5.",
                lambda _: [0, 0, 0, 0, 1, 0],
            ),
        ),
    ),
)
