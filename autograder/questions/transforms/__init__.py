"""Homogeneous transforms (MECA 953 and DH-m slides): order of moves, inverse, classic and modified convention."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    classic_table,
    degrees,
    inverse_by_transposing,
    inverse_keeps_position,
    misprint,
    option,
    summed_in_the_wrong_frame,
    symbol_negated,
    tool_left_out,
    transposed_rotation,
)
from autograder.judge.steps import replace_entry
from dhkit.geometry import classic_dh

from .model import (
    CLASSIC,
    COLLEAGUE,
    COMMUTE,
    MODIFIED,
    UNTURNED,
    UP,
    a,
    acos,
    alpha,
    asin,
    atan,
    d,
    divide,
    draw_matrices,
    draw_rows,
    failing_atan,
    failing_calls,
    flat,
    half_turn_forgotten,
    leave_alpha,
    misread_angles,
    modified_rows,
    my_dhm,
    name_row,
    name_twist,
    positive_root,
    project_by_angle,
    project_on_axis,
    read_parameters,
    see_from_a,
    see_from_gripper,
    theta,
    turn_back_only,
    way,
)

QUESTIONS = (
    Question(
        "transforms.point",
        reference=see_from_a,
        mistakes=(
            mistake(
                "turned_the_other_way",
                0.5,
                "**The point is turned the other way.** The columns of R, not its rows, are the axes of B: with phi = {phi} degrees "
                "x_B points up to the right.",
                wrong={"turn": -1.0},
            ),
            mistake(
                "shift_turned_too",
                0.5,
                "**The way from O_A to O_B was turned as well.** It is given along the axes of A already: turn the point, then add.",
                wrong={"shift_turned": True},
            ),
            mistake(
                "shift_missing",
                0.4,
                "**The way from O_A to O_B is missing.** Your point is turned, but counted from O_B.",
                wrong={"shift": 0.0},
            ),
            mistake(
                "degrees",
                0.6,
                "**The angle {phi} is taken in radians.** It is given in degrees: numpy's cos and sin want `np.radians` of it.",
                wrong={"unit": 1.0},
            ),
            summed_in_the_wrong_frame(
                wrong={"turn": 0.0},
                feedback="**Coordinates of two frames are added as they stand.** {px} m along x_B is not {px} m along x_A: frame B is "
                "turned by {phi} degrees.",
            ),
        ),
    ),
    Question(
        "transforms.commute",
        reference=COMMUTE,
        mistakes=(
            mistake(
                "screws_do_not_commute",
                0.6,
                "**Two pairs along and about one and the same line are not all found.** Whoever walks along a line and turns about it, in "
                "whatever order and however often, ends at the same place of it.",
                replace_entry(1, 0),
                replace_entry(4, 0),
            ),
            mistake(
                "half_turns_do_not_commute",
                0.6,
                "**One pair that may be exchanged is missing.** Turns about different axes do not commute *in general*: do these two? Multiply "
                "them both ways round, or turn a book.",
                replace_entry(2, 0),
            ),
            mistake(
                "rotations_commute",
                0.3,
                "**Two turns about parallel lines do not commute.** Their angles add up both ways round, but where does the origin end?",
                replace_entry(0, 1),
            ),
            mistake(
                "translation_and_rotation_commute",
                0.3,
                "**A turn changes the direction in which a later shift goes**, unless it turns about that very direction. A half turn reverses it.",
                replace_entry(3, 1),
                replace_entry(5, 1),
                lambda found: [*found[:3], 1, found[4], 1],
            ),
        ),
        places=False,
    ),
    Question(
        "transforms.operators",
        reference=[alpha, a, theta, d],
        mistakes=(
            misprint(
                replace_entry(1, alpha),
                "the second move is a shift, and a shift wants a length.",
                share=0.3,
            ),
            mistake(
                "a_for_alpha",
                0.4,
                "**An a stands where an alpha belongs.** The first move turns: its argument is an angle. (The slide's list of "
                "parameters names a twice, too.)",
                replace_entry(0, a),
            ),
            mistake(
                "order_of_the_table",
                0.2,
                "**These are the parameters in the order of a table.** The slide turns before it shifts: R, D, R, D.",
                lambda found: [found[1], found[0], found[3], found[2]],
            ),
        ),
        angles=(0, 2),
    ),
    Question(
        "transforms.inverse",
        reference=see_from_gripper,
        mistakes=(
            mistake(
                "hand_not_inverted",
                0.3,
                "**The way from the base to the gripper is taken as it is.** The walk begins at the gripper: this first piece is known the other "
                "way round only.",
                wrong={"back": np.array},
            ),
            inverse_by_transposing(wrong={"back": np.transpose}, share=0.4),
            inverse_keeps_position(
                wrong={"back": turn_back_only},
                feedback="**The position of the inverse is not turned.** It tells where the base lies, seen along the axes of the *gripper*.",
            ),
            mistake(
                "seen_from_the_base",
                0.3,
                "**This is the part seen from the base.** The robot knows it then, but not yet how far the gripper is from it.",
                wrong={"order": lambda back, camera, part: way(camera, part)},
            ),
            mistake(
                "reversed_product",
                0.3,
                "**The transforms are multiplied in the reverse order.** Inner letters must meet: gripper to base, base to camera, camera to part.",
                wrong={"order": lambda back, camera, part: way(part, camera, back)},
            ),
            mistake(
                "other_way_round",
                0.6,
                "**This is the gripper seen from the part.** Asked is the part seen from the gripper: the last column should hold the way that "
                "the gripper still has to go.",
                wrong={"order": lambda back, camera, part: np.linalg.inv(way(back, camera, part)).tolist()},
            ),
            mistake(
                "camera_inverted",
                0.4,
                "**The camera is taken the other way round.** Its place is given in frame 0: that is the way from the base to the camera already.",
                wrong={"order": lambda back, camera, part: way(back, np.linalg.inv(camera), part)},
            ),
            mistake(
                "camera_looks_up",
                0.5,
                "**The axes of the camera are not those told.** Write X_C and Z_C as columns, in frame 0; the third column follows from them.",
                wrong=[{"looks": UP}, {"looks": UNTURNED}],
            ),
            mistake(
                "degrees",
                0.5,
                "**The angles are taken in radians.** They are given in degrees: cos and sin want `np.radians` of them.",
                wrong={"unit": 1.0},
            ),
        ),
    ),
    Question(
        "transforms.classic",
        reference=CLASSIC,
        mistakes=(
            misprint(
                lambda matrix: matrix[:, :3].row_join(matrix[:, 3].subs({a: d, d: a}, simultaneous=True)),
                "it puts the origin a up the z axis and d outwards. What does the page's own definition of a and d say?",
                share=0.2,
            ),
            mistake(
                "modified_matrix",
                0.3,
                "**This is the modified matrix.** In the classic walk the joint comes first: about z, along z, then along x, about x.",
                lambda _: MODIFIED,
            ),
            mistake(
                "origin_not_turned",
                0.5,
                "**The origin is not turned.** a is walked along the x axis *after* the turn by theta.",
                lambda matrix: matrix[:, :3].row_join(sympy.Matrix([a, 0, d, 1])),
            ),
            transposed_rotation(),
            symbol_negated(
                alpha,
                "sign_of_alpha",
                "**alpha turns the wrong way.** Write Rot_x(alpha) alone and see where it sends the y axis.",
                share=0.5,
            ),
        ),
    ),
    Question(
        "transforms.frame_place",
        reference="B",
        mistakes=(
            option(
                "A",
                "slide_misprint",
                "**This is the claim of the slide, and the matrices contradict it.** Which convention ends with the turn of joint i, "
                "so that the joint turns about the z axis of frame i?",
            ),
            option(
                "C",
                "same_place",
                "**The frames are not at the same place.** In one convention joint i turns about z_i, in the other about z_(i-1).",
            ),
            option(
                "D",
                "same_place_downstream",
                "**The frames are not at the same place.** In one convention joint i turns about z_i, in the other about z_(i-1).",
            ),
        ),
    ),
    Question(
        "transforms.bug",
        reference=failing_calls,
        mistakes=(
            mistake(
                "untilted_slide_blamed",
                0.5,
                "**One of your calls is right.** The slide of its joint stands in the wrong place of the function, but this axis is not tilted: "
                "what is the sine of its twist?",
                wrong={"taken": 4, "left": 5},
            ),
            mistake(
                "slide_at_zero_blamed",
                0.5,
                "**One of your calls is right.** A joint that has not moved cannot show that its slide is forgotten.",
                wrong={"taken": 6, "left": 5},
            ),
            mistake(
                "half_turn_blamed",
                0.5,
                "**One of your calls is right.** A half turn has the cosine -1 and the sine 0: the root gives that as well.",
                wrong=[{"taken": 7, "left": left} for left in (2, 3, 5)],
            ),
            mistake(
                "counted_from_zero",
                0.7,
                "**The calls are counted from 0.** The list that is printed counts from 1.",
                lambda found: [number - 1 for number in found],
            ),
        ),
        partial=0.3,
        places=False,
    ),
    Question(
        "transforms.my_dhm",
        reference=my_dhm,
        mistakes=(
            mistake(
                "faults_not_mended",
                0.1,
                "**This is the function of question 7 as it stands.** It fails at three of the eight calls: mend what fails there.",
                wrong=COLLEAGUE,
            ),
            mistake(
                "sine_of_the_twist_by_a_root",
                0.6,
                "**With a negative twist the function is wrong.** A square root is never negative. The sine of a negative angle?",
                wrong={"sine": positive_root},
            ),
            mistake(
                "constant_of_theta_forgotten",
                0.6,
                "**The constant theta of a turning joint is forgotten.** Its angle is that constant *and* the joint value.",
                wrong={"constant": False},
            ),
            mistake(
                "slide_forgotten_in_one_entry",
                0.6,
                "**A joint that slides along a tilted axis comes out wrong.** The last column holds d in two places: both take the slide.",
                wrong={"slid": False},
            ),
            mistake(
                "sigma_not_read",
                0.4,
                "**Every joint turns.** sigma tells which of the two constants of a row the joint value is added to.",
                wrong={"reads_sigma": False},
            ),
            mistake(
                "classic_matrix",
                0.3,
                "**This is the matrix of the classic convention.** Here a row begins with the walk along and about X.",
                wrong={"matrix": classic_dh},
            ),
        ),
        probe=draw_rows,
        case=name_row,
    ),
    Question(
        "transforms.convert",
        reference=modified_rows,
        mistakes=(
            classic_table(
                feedback="**The classic rows were copied.** In the modified table row i holds a and alpha of the link *before* "
                "joint i: what stands before joint 1?",
            ),
            mistake(
                "alpha_left_behind",
                0.5,
                "**Column a was moved, column alpha was not.** The two are one pair, along and about the same X axis.",
                leave_alpha,
            ),
            tool_left_out(
                feedback="**The last pair got lost.** a3 and its twist lead from axis 3 to the hand: where do they go when the "
                "columns move down?",
            ),
        ),
        partial=0.6,
    ),
    Question(
        "transforms.parameters",
        reference=read_parameters,
        mistakes=(
            mistake(
                "d_by_division",
                0.6,
                "**For some twists your d has no value or a wrong one.** Where the sine or the cosine of alpha vanishes, an entry that "
                "should hold d holds nothing. The other entry then holds all of it.",
                wrong=[
                    {"offset": divide(2, (2, 2))},
                    {"offset": divide(1, (1, 2))},
                    {"offset": lambda T, angle: T[2, 3] / np.cos(angle)},
                ],
            ),
            mistake(
                "half_turn_forgotten",
                0.7,
                "**With a twist of half a turn your function is wrong.** Where the sine of alpha vanishes the cosine is +1 or -1: look at what "
                "each of the two does to alpha and to d.",
                wrong=[
                    {"offset": half_turn_forgotten},
                    *(
                        {"twist": flat, "turn": turn, "offset": d}
                        for turn in (np.arctan2, flat)
                        for d in (project_on_axis, project_by_angle)
                    ),
                    {"twist": flat, "offset": half_turn_forgotten},
                ],
            ),
            mistake(
                "d_is_one_component",
                0.4,
                "**d is not an entry of the matrix.** The origin goes d along the *tilted* axis: the last column holds two "
                "components of it.",
                wrong={"offset": lambda T, angle: T[2, 3]},
            ),
            mistake(
                "atan_for_atan2",
                0.5,
                "**atan loses the quadrant.** A quotient is the same for an angle and for the opposite one; a function of two "
                "arguments can tell them apart.",
                wrong=misread_angles(atan, failing_atan),
            ),
            mistake(
                "sign_of_angle_lost",
                0.5,
                "**acos does not know the sign of its angle**, and asin does not know more than half a turn. Each angle has a sine "
                "*and* a cosine in the matrix.",
                wrong=misread_angles(acos, asin),
            ),
            degrees(1, 3),
        ),
        angles=(1, 3),
        probe=draw_matrices,
        case=name_twist,
    ),
)
