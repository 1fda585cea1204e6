"""Orientation (EPFL and MECA 953 slides): Euler sets, roll-pitch-yaw, wrists, both triples, gimbal lock."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    atan2_arguments_exchanged,
    atan_for_atan2,
    degrees,
    extrinsic_for_intrinsic,
    lock_not_switched,
    misprint,
    one_triple_only,
    option,
    symbol_negated,
    symbols_exchanged,
    transposed_rotation,
)
from autograder.judge.steps import replace_entry, substitute

from .model import (
    ALL,
    BACK,
    ENTRIES,
    FORTH,
    GYROSCOPE,
    LEFT_AT_LOCK,
    OUTER,
    REVERSED_RPY,
    RPY,
    TRANSPOSED,
    XYZ,
    ZYZ,
    add_to_roll,
    change_atan2,
    change_pitch_only,
    change_t5_only,
    draw_locked,
    draw_rotation_and_sign,
    draw_rotations,
    e,
    keep_one_of_bent,
    list_rpy,
    name_bend,
    phi,
    psi,
    read_from,
    rpy_residual,
    spin,
    wrist_angles,
    zyz,
    zyz_residual,
)

QUADRANT_LOST = (
    "**atan loses the quadrant.** A quotient cannot tell an angle from the one half a turn further; a function of two "
    "arguments can."
)

QUESTIONS = (
    Question(
        "orientation.own_fixed",
        reference="B",
        mistakes=(
            option(
                "A",
                "moving_for_fixed",
                "**Here the second axis moves with the brick.** The statement says the *fixed* x: the axis is painted on the floor.",
            ),
            option(
                "C",
                "same_result_believed",
                "**The order of two factors matters.** Try it with a book: a turn about its own z, then about the fixed x; then with "
                "both axes on the book.",
            ),
            option(
                "D",
                "angles_exchanged",
                "**The angles have changed their axes.** Which axis does the first turn use, and by which angle?",
            ),
        ),
    ),
    Question(
        "orientation.rpy_entries",
        reference=ENTRIES,
        mistakes=(
            mistake(
                "order_of_turns_reversed",
                0.4,
                "**These entries belong to the product in the reverse order.** Fixed axes x, y, z: the roll is applied first, so it "
                "stands rightmost.",
                lambda _: [REVERSED_RPY[1, 1], REVERSED_RPY[1, 2]],
            ),
            mistake(
                "row_and_column_exchanged",
                0.5,
                "**The second entry is r32.** The first index counts rows, the second one columns.",
                replace_entry(1, RPY[2, 1]),
            ),
            symbols_exchanged(
                phi,
                psi,
                "letters_exchanged",
                "**phi and psi have changed places.** The two pages of the slides use the letters for different axes; here phi turns "
                "about x and psi about z.",
                0.5,
            ),
            symbol_negated(
                psi,
                "sign_of_pitch_or_yaw",
                "**The pitch or the yaw turns the wrong way; these two entries do not tell which.** Where do Rot_y and Rot_z carry their minus? "
                "Send the first axis of each through a quarter turn: which way must it go?",
            ),
        ),
    ),
    Question(
        "orientation.zxz",
        reference=GYROSCOPE,
        mistakes=(
            misprint(
                XYZ,
                "with body axes x, y, z the middle angle is not the tilt of the axle. Compare with the page on the three-axis wrist.",
                share=0.4,
            ),
            symbols_exchanged(
                psi,
                phi,
                "extrinsic_for_intrinsic",
                "**The turns are multiplied in the reverse order.** The axes move with the body: the precession, which comes first, "
                "stands on the left.",
                0.5,
            ),
            mistake(
                "nutation_about_y",
                0.5,
                "**The nutation turns about the wrong axis.** The line of nodes is where the body's x axis has come to lie.",
                lambda _: ZYZ,
            ),
            transposed_rotation(),
        ),
    ),
    Question(
        "orientation.nutation",
        reference="C",
        mistakes=(
            option(
                "A",
                "slide_misprint",
                "**This is the form printed on the slide; it is an erratum.** With x, y, z the entry r33 is a product of two cosines, and "
                "the middle angle is not the angle between axle and vertical.",
            ),
            option(
                "B",
                "reversed_axes_believed",
                "**The order of the letters does not save it.** With three different axes the first and the third turn go about different "
                "lines of the body; the precession and the spin of an upright top do not.",
            ),
            option(
                "D",
                "wrist_of_the_arm",
                "**These are the axes of the spherical wrist.** The middle angle would be a tilt there too; but which axis of the body "
                "lies on the line of nodes of the classical top?",
                0.3,
            ),
        ),
    ),
    Question(
        "orientation.rpy_both",
        reference=list_rpy,
        mistakes=(
            one_triple_only(),
            misprint(
                change_pitch_only,
                "roll and yaw come from pairs that carry the cosine of the pitch, and that has changed its sign. Put your second "
                "triple back into the matrix: is it the same one?",
            ),
            extrinsic_for_intrinsic(
                feedback="**The angles come in the reverse order.** Asked for are (roll, pitch, yaw): about x, about y, about z."
            ),
            degrees(0, 1, 2),
        ),
        angles=(0, 1, 2),
        residual=rpy_residual,
    ),
    Question(
        "orientation.spun",
        reference=spin,
        mistakes=(
            mistake(
                "fixed_for_moving",
                0.5,
                "**Your top has turned about the vertical of the room.** More yaw does just that, and so does a factor on the left. Look "
                "at the axle: may a turn about the axle move it?",
                read_from(lambda matrix: FORTH @ matrix @ BACK),
            ),
            mistake(
                "added_to_the_roll",
                0.4,
                "**Your top has turned about its own x axis.** More roll does just that. The letter of the proper rotation is the "
                "letter of the roll here, but the axis is another one.",
                add_to_roll,
            ),
            mistake(
                "transposed_rotation",
                0.4,
                "**These are the angles of the transposed matrix.** r32 stands in row 3, column 2.",
                read_from(np.transpose),
            ),
            extrinsic_for_intrinsic(
                feedback="**The angles come in the reverse order.** Asked for are (roll, pitch, yaw): about x, about y, about z."
            ),
            degrees(0, 1, 2),
        ),
    ),
    Question(
        "orientation.printed",
        reference="D",
        mistakes=(
            option(
                "A",
                "nothing_found",
                "**Neither line stands as printed.** Put the angles for the minus sign back into the matrix, and compare Arctg(n/m) with the "
                "direction of a vector that points to the left.",
            ),
            option(
                "B",
                "extraction_taken_for_right",
                "**The minus sign has not been tried.** Roll and yaw are computed from pairs that carry the cosine of the pitch: what happens to "
                "them when that is negative?",
                0.3,
            ),
            option(
                "C",
                "quotient_taken_for_right",
                "**A quotient forgets both signs.** Where does Arctg(n/m) send a vector with a negative m?",
                0.3,
            ),
        ),
    ),
    Question(
        "orientation.lock",
        reference=LEFT_AT_LOCK,
        mistakes=(
            mistake(
                "roll_minus_yaw",
                0.6,
                "**This is roll - yaw.** Look at the sign of the sine in the matrix.",
                lambda angle: -angle,
            ),
            atan_for_atan2(feedback=QUADRANT_LOST),
            mistake(
                "sine_or_cosine_alone",
                0.5,
                "**An arcsine or an arccosine alone knows half of the circle.** Both the sine and the cosine of the angle stand in the matrix: "
                "use them together.",
                lambda angle: sympy.asin(angle.args[0]),
                lambda angle: sympy.acos(angle.args[1]),
            ),
            atan2_arguments_exchanged(),
        ),
        angles=(0,),
        draw=draw_locked,
    ),
    Question(
        "orientation.wrist",
        reference=lambda mine, axes="own": wrist_angles(mine.wrist if axes == "own" else axes),
        mistakes=(
            mistake(
                "sign_of_the_root_missing",
                0.6,
                "**e is missing: these are the angles for e = +1 only.** The middle angle comes from a square root, and both its signs give "
                "a solution. Where does e enter, and in which of the three angles?",
                substitute({e: 1}),
            ),
            misprint(
                lambda answer: [answer[0].subs(e, 1), answer[1], answer[2].subs(e, 1)],
                "the outer angles come from pairs that carry the root as a factor. Put the angles for e = -1 back into the matrix.",
                share=0.6,
            ),
            mistake(
                "atan_for_atan2",
                0.5,
                QUADRANT_LOST,
                change_atan2(atan_for_atan2(), *OUTER),
                change_atan2(atan_for_atan2(), *ALL),
            ),
            mistake(
                "atan2_arguments_exchanged",
                0.4,
                atan2_arguments_exchanged().feedback,
                change_atan2(atan2_arguments_exchanged(), *ALL),
                change_atan2(atan2_arguments_exchanged(), *OUTER),
            ),
            extrinsic_for_intrinsic(
                feedback="**First and third angle have changed places.** Your wrist is {wrist}, axes that move: the first letter is the "
                "joint nearest to the arm."
            ),
            mistake(
                "transposed_rotation",
                0.4,
                "**Rows and columns are exchanged.** These are the angles of the transposed matrix: r12 stands in row 1, column 2.",
                substitute(TRANSPOSED),
            ),
            mistake(
                "another_wrist",
                0.2,
                "**These are the angles of another wrist.** The lecture's formulas hold for its own letters; yours are {wrist}. Write out the "
                "product of your three turns, and look for the entries that hold one angle, or two.",
                wrong=[{"axes": "zyz"}, {"axes": "zyx"}],
            ),
        ),
        partial=0.6,
        angles=ALL,
        draw=draw_rotation_and_sign,
    ),
    Question(
        "orientation.zyz",
        reference=zyz,
        mistakes=(
            one_triple_only(steps=(keep_one_of_bent(0), keep_one_of_bent(-1))),
            lock_not_switched({"lock": -1.0}),
            mistake(
                "lock_seen_too_early",
                0.7,
                "**Near the lock your function is wrong.** A wrist that is bent by a tenth of a degree still has its two triples: how does "
                "your code decide that it is stretched?",
                wrong=[{"lock": 1e-7}, {"lock": 1e-2}],
            ),
            mistake(
                "slide_misprint",
                0.5,
                "**As on the slide, the sign of the root acts on the middle angle only.** Put your second triple back into the matrix: "
                "is it the same one?",
                change_t5_only,
            ),
            degrees(0, 1, 2),
        ),
        angles=(0, 1, 2),
        probe=draw_rotations,
        case=name_bend,
        residual=zyz_residual,
    ),
)
