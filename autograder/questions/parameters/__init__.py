"""Parameter rules (MECA 953 slides): axes, common normals, frames, the four parameters and their signs."""

from __future__ import annotations

from autograder.judge import Question, mistake
from autograder.judge.chain import Freedom
from autograder.judge.misconceptions import degrees, degrees_in_table, option, transposed_rotation
from autograder.judge.steps import change_entry, exchange, negate

from .model import (
    LEFT_HANDED,
    choose_axes,
    draw_axes,
    find_frame,
    find_gripper,
    find_link,
    find_origin,
    find_parallel_link,
    find_x_axis,
    move_to_joint,
    name_axes,
    read_parameters,
    rewrite,
)

QUESTIONS = (
    Question(
        "parameters.variable",
        reference="C",
        mistakes=(
            option(
                "A",
                "slide_believed",
                "**The printed line cannot stand.** Take the quill of the SCARA: which of its four numbers changes when it goes down? "
                "The page on joint variables, a little earlier in the same slides, has it right.",
            ),
            option(
                "B",
                "revolute_line_doubted",
                "**The line for revolute joints is right.** A revolute joint turns about Z_i, and the angle about Z_i is counted from X_(i-1) "
                "to X_i. Look at the other line.",
            ),
            option(
                "D",
                "twist_taken_for_variable",
                "**alpha belongs to a link**: it is the angle between two axes that are cast into the same piece of metal. No motor "
                "changes it.",
            ),
        ),
    ),
    Question(
        "parameters.reading",
        reference=read_parameters,
        mistakes=(
            mistake(
                "signs_dropped",
                0.4,
                "**Signs are missing.** All four parameters are counted along or about an arrow, and may be negative: which walk goes against "
                "its arrow, which turn looks clockwise when the arrow points at your eye?",
                lambda values: [abs(value) for value in values],
            ),
            mistake(
                "sign_turned",
                0.7,
                "**One sign is turned.** Go through the four sentences once more: with the arrow of the guide or against it? Right hand, thumb along the "
                "guide: do the fingers curl from the first axis to the second, or the other way?",
                negate(1),
                negate(2),
                negate(3),
                negate(0),
            ),
            mistake(
                "alpha_and_theta_exchanged",
                0.3,
                "**alpha and theta are exchanged.** alpha1 compares two Z axes, about X1; theta2 compares two X axes, about Z2.",
                exchange(1, 3),
            ),
            degrees(1, 3, share=0.5),
        ),
        angles=(1, 3),
    ),
    Question(
        "parameters.origin",
        reference=find_origin,
        mistakes=(
            mistake(
                "other_foot",
                0.5,
                "**This is the foot on the other axis.** The common normal meets both axes; O1 belongs to link 1 and lies on Z1.",
                wrong={"place": "other foot"},
            ),
            mistake(
                "origin_at_joint",
                0.2,
                "**This is the point by which Z1 was given.** The origin is not where the joint sits, it is where the common normal "
                "of Z1 and Z2 leaves Z1. See the section on common mistakes of the lecture.",
                wrong={"place": "joint"},
            ),
            mistake(
                "perpendicular_from_joint",
                0.3,
                "**You dropped a perpendicular from joint 2 onto Z1.** It meets Z1 at a right angle, but not Z2: the common normal is "
                "perpendicular to both.",
                wrong={"place": "perpendicular"},
            ),
            mistake(
                "middle_of_normal",
                0.3,
                "**This is the middle of the common normal.** It is the right line; the origin is where this line meets Z1.",
                wrong={"place": "middle"},
            ),
        ),
        partial=0.3,
    ),
    Question(
        "parameters.x_axis",
        reference=find_x_axis,
        mistakes=(
            mistake(
                "wedge_for_normal",
                0.4,
                "**This is Z1 x Z2, or its direction, and here it leads away from Z2.** The printed rule gives sin(alpha1) X1: what is its sense when "
                "alpha1 is negative? X1 leads from Z1 to Z2.",
                negate(0, 1, 2),
                wrong={"vector": "wedge"},
            ),
            mistake(
                "not_a_unit_vector",
                0.7,
                "**Right line, right sense, but not of length 1.** An axis of a frame is a unit vector.",
                wrong={"vector": "normal"},
            ),
            mistake(
                "along_the_metal",
                0.2,
                "**This leads from joint to joint, along the metal.** X1 is perpendicular to both axes: test it with two dot products.",
                wrong={"vector": "between joints"},
            ),
        ),
        partial=0.0,
    ),
    Question(
        "parameters.parallel",
        reference=find_parallel_link,
        mistakes=(
            mistake(
                "hypotenuse_for_length",
                0.5,
                "**a1 is not the distance of the two joints.** It is the distance of two vertical lines: seen from above, {gap} m one way and "
                "{side} m the other count, and the heights of the joints do not.",
                wrong={"length": "between joints"},
            ),
            mistake(
                "one_coordinate_only",
                0.4,
                "**a1 is not a coordinate, nor their sum.** Seen from above, Z1 and Z2 are two points: how far apart are they in a straight line?",
                wrong=[{"length": "gap"}, {"length": "side"}, {"length": "gap and side"}],
            ),
            mistake(
                "origin_at_joint",
                0.5,
                "**With this height d2 does not vanish.** You put O1 where a joint sits. O1 is free along Z1; the question asks for the one place "
                "that makes d2 = 0.",
                wrong=[{"height": "joint 1"}, {"height": "joint 2"}],
            ),
            mistake(
                "height_above_joint",
                0.6,
                "**z1 is counted from joint 1.** The question asks for the coordinate of O1, from the floor.",
                wrong={"height": "above joint 1"},
            ),
        ),
    ),
    Question(
        "parameters.frame",
        reference=find_frame,
        mistakes=(
            mistake(
                "alpha_negative",
                0.6,
                "**X1 points the other way.** Both senses obey the rule for axes that meet, but the question asks for the one with a positive alpha1: "
                "right hand, thumb along X1, and the fingers must curl from Z1 to Z2.",
                choose_axes((0, -1), (1, -1), (2, 1)),
            ),
            mistake(
                "origin_at_joint",
                0.5,
                "**O1 is not where the two axes meet.** You took the point by which Z1 was given. Where is the point that lies on both lines?",
                move_to_joint,
            ),
            LEFT_HANDED,
            transposed_rotation(),
        ),
    ),
    Question(
        "parameters.flip",
        reference=rewrite,
        mistakes=(
            mistake(
                "not_rewritten",
                0.0,
                "**This is the table as it was.** Two of its twists are negative; the question asks for a table of the same robot without a "
                "negative twist.",
                wrong={"turned": False},
            ),
            mistake(
                "half_turn_forgotten",
                0.3,
                "**You changed the signs and nothing else: that is another robot.** With X_i turned around, the angles before and after it are "
                "counted from or to another arrow. Compare the two drawings.",
                wrong=[{"before": False, "after": False}, {"before": False, "after": False, "lengths": False}],
            ),
            mistake(
                "half_turn_on_one_side",
                0.5,
                "**The half turn is put in, but not taken out again.** An X that is turned around ends the angle of its own row and "
                "begins the angle of the next row.",
                wrong=[{"after": False}, {"before": False}],
            ),
            mistake(
                "length_not_turned",
                0.6,
                "**A length has kept its sign.** a is counted along the X that you turned around: the same way is now walked against the arrow.",
                wrong={"lengths": False},
            ),
            degrees_in_table(),
        ),
        pinned=frozenset(Freedom),
    ),
    Question(
        "parameters.gripper",
        reference=find_gripper,
        mistakes=(
            mistake(
                "approach_reversed",
                0.5,
                "**Z_E points back at the arm.** It points the way the hand moves towards the book.",
                choose_axes((0, -1), (1, 1), (2, -1)),
            ),
            mistake(
                "jaws_and_approach_exchanged",
                0.4,
                "**Y_E and Z_E are exchanged.** Z_E is the way of the hand, Y_E the way of the jaws.",
                choose_axes((0, -1), (2, 1), (1, 1)),
                choose_axes((0, 1), (2, 1), (1, 1)),
            ),
            mistake(
                "approach_along_x",
                0.4,
                "**X_E points along the way of the hand.** That is Z_E, the approach; X_E is what is left when Z_E and Y_E stand.",
                choose_axes((2, 1), (1, 1), (0, -1)),
                choose_axes((2, 1), (1, -1), (0, 1)),
            ),
            LEFT_HANDED,
            mistake(
                "degrees",
                0.5,
                "**The angle went into cos and sin in degrees.** numpy and sympy count in radians.",
                wrong={"unit": 1.0},
            ),
        ),
        position_share=0.0,
    ),
    Question(
        "parameters.link",
        reference=find_link,
        mistakes=(
            mistake(
                "alpha_without_sign",
                0.5,
                "**alpha has lost its sign.** arccos, and the turn about u x v, only know the size of an angle. X leads from the first axis to the "
                "second: about *this* X the turn may be negative.",
                change_entry(1, abs),
            ),
            mistake(
                "parallel_axes_forgotten",
                0.6,
                "**Parallel axes make your function fail.** u x v is zero there and has no direction. What is the distance of two parallel "
                "lines?",
                wrong={"parallel": False},
            ),
            mistake(
                "distance_of_the_points",
                0.3,
                "**a is the distance of the two points.** It is the distance of the two lines, and must not change when a point slides along its line.",
                wrong={"distance": "points"},
            ),
            mistake(
                "normal_not_scaled",
                0.5,
                "**a changes with the lengths of u and v.** Divide the cross product by its length before you measure along it.",
                wrong={"scaled": False},
            ),
            mistake(
                "tolerance_too_wide",
                0.8,
                "**Axes that are almost parallel, or almost meet, are taken for parallel or meeting.** The statement says below which size "
                "rounding may be blamed: yours is wider.",
                wrong={"slack": 1e-6},
            ),
        ),
        probe=draw_axes,
        case=name_axes,
        angles=(1,),
    ),
)
