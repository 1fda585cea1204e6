"""Planar arms: the one with two joints, an arm that the id chooses, a part on a belt, and a function to be mended."""

from __future__ import annotations

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
    misprint,
    option,
    posture_missing,
    rows_shifted,
    tool_left_out,
    transposed_rotation,
    with_first_theta1,
)

from .model import (
    ABSOLUTE_MODEL,
    DIRECTION,
    FOREARM,
    GIVEN,
    L1,
    MODEL,
    atan,
    belt_times,
    draw_posture,
    draw_targets,
    failing,
    inverse,
    lengths_exchanged,
    name_case,
    own_pose,
    own_postures,
    own_residual,
    own_rows,
    residual,
    t1,
    t2,
    without_quarter_turns,
)

QUESTIONS = (
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
        "planar_2r.centre",
        reference="D",
        mistakes=(
            option(
                "A",
                "formula_without_value",
                "**That atan2(0, 0) has no value does not mean that the end effector cannot be there.** Fold the arm: where does it lie?",
            ),
            option(
                "B",
                "folded_arm_only",
                "**The elbow has one value, but a configuration has two angles.** Fold the arm and turn joint 1: what does the end effector do?",
            ),
            option(
                "C",
                "two_as_everywhere_else",
                "**Two configurations are the rule, and this point is the exception.** What becomes of the two elbow angles when the arm is "
                "folded, and of the determinant that decides about t1?",
            ),
        ),
    ),
    Question(
        "planar_2r.belt",
        reference=belt_times,
        mistakes=(
            mistake(
                "distance_taken_for_the_way",
                0.4,
                "**The belt does not run through the base.** A part at the distance r from the base is less far along the belt: Pythagoras, "
                "with the {belt} m between belt and base.",
                wrong={"distance": "straight"},
            ),
            mistake(
                "start_forgotten",
                0.5,
                "**At time 0 the part is not beside the base.** It is at x = {start} m.",
                wrong={"origin": False},
            ),
            mistake(
                "ways_instead_of_times",
                0.6,
                "**These are ways along the belt.** How long does the part take for them at {speed} m/s?",
                wrong={"per_speed": False},
            ),
            mistake(
                "order_of_the_times",
                0.6,
                "**The four times are right, and in another order.** First it enters, then it is lost near the base, found again, and gone.",
                lambda times: [times[0], times[3], times[1], times[2]],
                lambda times: [times[1], times[2], times[0], times[3]],
            ),
        ),
    ),
    Question(
        "planar_2r.table",
        reference=own_rows,
        depends=("arm",),
        mistakes=(
            classic_table(
                feedback="**This is the classic Denavit-Hartenberg table.** In the modified form row i holds the link *before* joint i.",
            ),
            mistake(
                "quarter_turns_missing",
                0.4,
                "**Every constant angle is 0 in this table.** An axis of a slide lies in the plane, an axis of a turn stands on it; and X has "
                "to be perpendicular to the axis before and the axis behind. Where must a frame turn by 90 degrees for that?",
                without_quarter_turns,
            ),
            columns_exchanged("a", "d"),
            columns_exchanged("a", "alpha"),
            tool_left_out(
                feedback="**The last row is empty.** Behind joint 3 something is left: the way to the end effector, or the turn that brings X "
                "to where the walker looks."
            ),
            rows_shifted(),
        ),
        partial=0.6,
    ),
    Question(
        "planar_2r.T0E",
        reference=own_pose,
        depends=("arm",),
        mistakes=(
            mistake(
                "tool_left_out",
                0.6,
                "**This is 0T3: the step from frame 3 to the end effector is missing.**",
                wrong={"rows": slice(None, -1)},
            ),
            mistake(
                "reversed_product",
                0.3,
                "**The matrices are multiplied in the reverse order.** From left to right: base first, end effector last.",
                wrong={"order": -1},
            ),
            transposed_rotation(),
            mistake(
                "turns_clockwise",
                0.4,
                "**The joints turn clockwise in this transform.** Seen with z0 towards you, a positive angle is counter-clockwise.",
                wrong={"sense": -1},
            ),
        ),
        follows=Follow("planar_2r.table", following.product_of_table),
    ),
    Question(
        "planar_2r.postures",
        reference=own_postures,
        mistakes=(
            posture_missing(),
            with_first_theta1(),
            mistake(
                "heading_taken_for_a_joint",
                0.4,
                "**The last turn is not counted from x0.** The {phi} degrees of the end effector are the sum of all turns before it.",
                wrong={"relative": False},
            ),
            mistake(
                "degrees",
                0.4,
                "**The angles are in degrees.** The question asks for radians, and for metres of a slide.",
                wrong={"unit": 180 / np.pi},
                turn=360,
            ),
        ),
        angles=(0, 1, 2),  # of a slide nobody gives 2 pi metres more
        residual=own_residual,
    ),
    Question(
        "planar_2r.faults",
        reference=failing,
        places=False,
        depends=("order",),
        mistakes=(
            mistake(
                "fourth_quadrant_blamed",
                0.6,
                "**In front of the base, below, the given function is right.** An arctangent gives angles between -90 and 90 degrees: which "
                "directions does it lose?",
                wrong={"instead": {"behind": "below"}},
            ),
            mistake(
                "out_of_reach_blamed",
                0.6,
                "**Where the rod is too short the given function is right.** And nearer to the base than the offset?",
                wrong={"instead": {"inner": "beyond"}},
            ),
            mistake(
                "one_solution_blamed",
                0.6,
                "**One of these targets has one solution only, and the function finds it.** The rod runs through its sleeve: for which target "
                "would it reach on the other side, too?",
                wrong=[{"instead": {"near": "ahead"}}, {"instead": {"near": "below"}}],
            ),
        ),
    ),
    Question(
        "planar_2r.inverse",
        reference=inverse,
        mistakes=(
            mistake(
                "as_it_was_given",
                0.0,
                "**This is the function as it was given.** Try it at your six targets, with the direct model.",
                wrong=GIVEN,
            ),
            atan_for_atan2(wrong={"direction": atan}),
            mistake(
                "rod_on_one_side_only",
                0.5,
                "**Solutions are missing.** The rod runs through its sleeve: its length may be negative, and a square has two roots.",
                wrong=[{"signs": (1,)}, {"signs": (-1,)}],
            ),
            mistake(
                "inner_circle",
                0.6,
                "**Nearer to the base than the offset there is no solution.** The end of the rod is never there, wherever the rod is.",
                wrong={"inner": True},
            ),
            mistake(
                "ends_ignored",
                0.6,
                "**The rod has two ends.** d2 lies between d_min and d_max; a solution that needs more is none.",
                wrong={"ends": False},
            ),
            mistake(
                "offset_on_the_other_side",
                0.4,
                "**The offset is on the other side.** From the base the walker goes e to the *left* before the rod begins.",
                wrong={"side": -1},
            ),
            mistake(
                "out_of_reach_fails",
                0.7,
                "**Where there is no solution your function does not return an empty list.** Ask first whether there is a triangle, and return "
                "`[]` where there is none.",
                wrong={"nothing": None},
            ),
            degrees(0),
            mistake("no_solution_at_all", 0.0, "**Your function finds no solution for any target.**", lambda _: []),
        ),
        angles=(0,),
        probe=draw_targets,
        case=name_case,
        residual=residual,
    ),
)
