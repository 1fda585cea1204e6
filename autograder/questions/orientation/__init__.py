"""Orientation (EPFL and MECA 953 slides): Euler sets and roll-pitch-yaw; a controller, a camera and a wrist of one's own."""

from __future__ import annotations

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
    ENTRIES,
    GYROSCOPE,
    OUTER,
    REVERSED_RPY,
    RPY,
    TRANSPOSED,
    XYZ,
    ZYZ,
    change_atan2,
    change_t5_only,
    draw_rotation_and_sign,
    draw_rotations,
    e,
    keep_one_of_bent,
    name_bend,
    phi,
    psi,
    zyz,
    zyz_residual,
)
from .own import (
    AS_FOUND,
    LECTURES_RPY,
    LECTURES_RPY_FIXED,
    LECTURES_WRIST,
    STEEP,
    change_pitch_only,
    draw_locked,
    draw_numbers,
    draw_poses,
    list_rpy,
    locked,
    misses,
    name_pose,
    own_hinges,
    pan_tilt_roll,
    rpy_residual,
    tool_axes,
)

QUADRANT_LOST = (
    "**atan loses the quadrant.** A quotient cannot tell an angle from the one half a turn further; a function of two "
    "arguments can."
)

QUESTIONS = (
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
        "orientation.tool_axes",
        reference=tool_axes,
        mistakes=(
            mistake(
                "moving_for_fixed",
                0.4,
                "**The letters are right, whose axes they are is not.** Try the second pose of the log too, and the other way of reading "
                "the three turns.",
                wrong={"reading": "other frames"},
            ),
            mistake(
                "degrees_taken_for_radians",
                0.6,
                "**The numbers of the display are degrees.** numpy and SymPy count in radians.",
                wrong={"unit": "radians"},
            ),
            mistake(
                "lectures_set_believed",
                0.1,
                "**This is a set of the lecture; your controller has another one.** Does your function give the axes of the log? Which set "
                "does?",
                wrong=[{"reading": LECTURES_RPY}, {"reading": LECTURES_WRIST}, {"reading": LECTURES_RPY_FIXED}],
            ),
            transposed_rotation(),
        ),
        probe=draw_numbers,
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
            mistake(
                "camera_for_drone",
                0.2,
                "**These are the angles of the camera.** Asked is how the *drone* flies: how does the camera hang on it?",
                wrong={"mount": "ignored"},
            ),
            mistake(
                "mount_not_inverted",
                0.5,
                "**The camera is mounted twice.** From the drone to the camera there is one constant rotation; which way do you go?",
                wrong={"mount": "put on again"},
            ),
            mistake(
                "mount_on_the_left",
                0.5,
                "**The rotation of the mount stands on the wrong side.** Its axes move with the drone: they are not those of the world.",
                wrong={"side": "left"},
            ),
            mistake(
                "wrong_way_up",
                0.6,
                "**Your camera is turned by half a turn about its view.** Read again where the top of its picture is.",
                wrong={"way_up": "other"},
            ),
            extrinsic_for_intrinsic(
                feedback="**The angles come in the reverse order.** Asked for are (roll, pitch, yaw): about x, about y, about z."
            ),
            degrees(0, 1, 2),
        ),
        angles=(0, 1, 2),
        residual=rpy_residual,
        depends=("camera",),
    ),
    Question(
        "orientation.wrist",
        reference=own_hinges,
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
                feedback="**First and third angle have changed places.** Your wrist is ({wrist}), axes that move: the first one belongs to the "
                "joint nearest to the arm."
            ),
            mistake(
                "transposed_rotation",
                0.4,
                "**Rows and columns are exchanged.** These are the angles of the transposed matrix: r12 stands in row 1, column 2.",
                substitute(TRANSPOSED),
            ),
            mistake(
                "senses_overlooked",
                0.5,
                "**A hinge turns about the negative axis.** Your wrist is ({wrist}): what is a turn by an angle about -x, about +x?",
                wrong={"hinges": "straight"},
            ),
            mistake(
                "another_wrist",
                0.2,
                "**These are the angles of another wrist.** The lecture's formulas hold for its own axes; yours are ({wrist}). Write out the "
                "product of your three turns, and look for the entries that hold one angle, or two.",
                wrong=[{"hinges": "z, y, z"}, {"hinges": "z, y, x"}],
            ),
        ),
        partial=0.6,
        angles=ALL,
        draw=draw_rotation_and_sign,
        depends=("wrist",),
    ),
    Question(
        "orientation.lock",
        reference=locked,
        mistakes=(
            mistake(
                "other_combination",
                0.4,
                "**The outer angles are combined the other way.** Turn the third hinge a little at the lock: which turn of the first one "
                "brings the end effector back? Yours are ({wrist}): with a minus a hinge turns the other way.",
                wrong={"combination": "other"},
            ),
            mistake(
                "angle_negated",
                0.6,
                "**The angle has the wrong sign.** Look at the sign of the sine in your matrix, and at the sense of your first hinge.",
                lambda found: [found[0], -found[1]],
            ),
            mistake("quadrant_lost", 0.5, QUADRANT_LOST, wrong={"quotient": "atan"}),
            degrees(1),
        ),
        angles=(1,),
        probe=draw_locked,
    ),
    Question(
        "orientation.misses",
        reference=misses,
        mistakes=(
            degrees(*range(6)),
            mistake(
                "angles_compared",
                0.3,
                "**You compare the three angles.** Different triples may be the same orientation, at the lock above all. Compare the "
                "matrices: which single turn leads from one to the other, and what is its trace?",
                wrong={"measure": "difference"},
            ),
            mistake(
                "norm_for_angle",
                0.4,
                "**This is the size of the difference of two matrices, no angle.** Which single turn leads from one to the other, and "
                "what is its trace?",
                wrong={"measure": "norm"},
            ),
        ),
        places=False,
    ),
    Question(
        "orientation.mended",
        reference=pan_tilt_roll,
        mistakes=(
            mistake(
                "as_it_was_found",
                0.0,
                "**The function is as it was.** Begin with the poses of question 9 that it misses: what is special about each?",
                wrong=AS_FOUND,
            ),
            mistake(
                "camera_that_looks_back",
                0.6,
                "**A camera that looks back is read as one that looks ahead.** One sine belongs to two angles: which entry tells them apart?",
                wrong={"pan": "arcsin"},
            ),
            mistake(
                "lock_seen_too_early",
                0.6,
                "**A steep camera is taken for a locked one.** Its pan and roll can still be told apart: what vanishes at the lock, and how "
                "nearly?",
                wrong={"lock": STEEP},
            ),
            mistake(
                "down_as_up",
                0.6,
                "**Straight up and straight down are treated alike.** At one of them the sum of pan and roll is left, at the other the "
                "difference. Write out the matrix for both.",
                wrong={"down": "as up"},
            ),
            lock_not_switched({"lock": -1.0}),
            degrees(0, 1, 2),
        ),
        probe=draw_poses,
        case=name_pose,
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
