"""The Adept s600 tutorial, a SCARA that the id chooses, a robot for a task, and the lengths of a measured arm."""

from __future__ import annotations

import sympy

from autograder.judge import Follow, Question, following, mistake
from autograder.judge.misconceptions import (
    classic_table,
    columns_exchanged,
    degrees,
    fails_on_limit,
    misprint,
    posture_missing,
    rows_shifted,
    symbol_negated,
    tolerance_too_wide,
)
from autograder.judge.steps import exchange, in_each_row, negate

from .model import (
    HAND,
    blame,
    constant_missing,
    draw_poses,
    fitted,
    fitting,
    keep_elbow,
    list_configurations,
    mgi,
    name_case,
    own_classic,
    own_rows,
    own_transform,
    r3,
    r30,
    residual,
    t1,
    t2,
    t4,
    without_half_turn,
)

ANGLES_ADDED = (
    "**t4 is counted like t1 and t2.** It turns about an axis that points the other way: look at the hand from above and "
    "turn it about z4."
)
NO_Z_TURNS_OVER = (
    "**No z turns over in this answer.** Read where each z points: between which two is half a turn about x?"
)

QUESTIONS = (
    Question(
        "scara_s600.table",
        reference=own_rows,
        depends=("arm",),
        mistakes=(
            mistake("z_never_turns_over", 0.6, NO_Z_TURNS_OVER, without_half_turn),
            classic_table(
                feedback="**This is the classic Denavit-Hartenberg table.** In the modified form row i holds d and alpha of the link "
                "*before* joint i."
            ),
            columns_exchanged(
                "a",
                "d",
                note="d_and_r_exchanged",
                feedback="**The columns d and r are exchanged.** In the letters of Khalil and Kleinfinger d is counted along x, from one "
                "joint axis to the next; r along z.",
            ),
            rows_shifted(
                feedback="**The rows are shifted by one.** Row i leads from frame i-1 to frame i. What lies between the base and joint 1?"
            ),
        ),
        partial=0.6,
        columns=("sigma", "d", "alpha", "r", "theta"),
    ),
    Question(
        "scara_s600.T04",
        reference=own_transform,
        depends=("arm",),
        mistakes=(
            mistake("z_never_turns_over", 0.5, NO_Z_TURNS_OVER, wrong={"axis": 0}),
            mistake(
                "reversed_product",
                0.3,
                "**The matrices are multiplied in the reverse order.** From left to right: base first, end effector last.",
                wrong={"order": -1},
            ),
        ),
        follows=Follow("scara_s600.table", following.product_of_table),
    ),
    Question(
        "scara_s600.wrong_cell",
        reference=HAND[1, 0],
        mistakes=(
            misprint(
                sympy.sin(t1) * sympy.cos(t2 - t4) - sympy.cos(t1) * sympy.sin(t2 - t4),
                "with it the first column does not have length 1.",
                share=0.3,
            ),
            mistake(
                "another_cell",
                0.2,
                "**This cell is printed rightly.** Square and add the columns of the printed block: which one has not length 1?",
                lambda cell: HAND[0, 0],
                lambda cell: HAND[1, 1],
            ),
            symbol_negated(t4, "angles_added", ANGLES_ADDED, 0.5),
        ),
    ),
    Question(
        "scara_s600.misprints",
        reference=[2, 4, 7],
        mistakes=(
            mistake(
                "system_blamed",
                0.6,
                "**The system (S1) is not to blame.** The lines behind it use the names in the same way; only one line gives them to the "
                "other expressions.",
                blame(8, instead_of=7),
            ),
            mistake(
                "arctangent_blamed",
                0.6,
                "**The line with atan2 holds.** It has the sign and the square; look for the line where they are missing.",
                blame(5, instead_of=4),
            ),
            mistake(
                "squares_blamed",
                0.6,
                "**The sum of the squares holds.** Write out both squares once; then look at what the bracket is said to be.",
                blame(1, instead_of=2),
            ),
        ),
    ),
    Question(
        "scara_s600.mgi",
        reference=mgi,
        mistakes=(
            posture_missing(steps=(keep_elbow(0), keep_elbow(1))),
            mistake("sign_of_theta4", 0.6, ANGLES_ADDED, in_each_row(negate(3))),
            mistake(
                "constant_missing",
                0.7,
                "**r30 has the wrong sign, or is missing.** z = r3 + r30: solve it for r3.",
                wrong=[{"constant_sign": 0}, {"constant_sign": 1}],
            ),
            fails_on_limit(
                {"fails": True},
                feedback="**On a limit your function fails.** Rounding pushes a cosine a hair above 1, where no sine is left. What must "
                "the cosine be on the limit?",
            ),
            mistake(
                "limit_taken_for_out_of_reach",
                0.8,
                "**Some poses on a limit come back without a solution.** Rounding pushes the cosine of t2 a hair above 1: leave the small "
                "tolerance of the statement before you say that a pose is out of reach.",
                wrong=[{"slack": 0.0}, {"slack": 1e-12}],
            ),
            tolerance_too_wide({"slack": 1e-6}),
            mistake(
                "centre_divides_by_zero",
                0.8,
                "**At the centre of an arm with equal links your function fails.** There B1^2 + B2^2 = 0: atan2 needs no division.",
                wrong={"divided": True},
            ),
            degrees(0, 1, 3),
        ),
        angles=(0, 1, 3),
        probe=draw_poses,
        case=name_case,
        residual=residual,
    ),
    Question(
        "scara_s600.configurations",
        reference=list_configurations,
        mistakes=(
            mistake(
                "one_turn_only",
                0.5,
                "**These are the configurations of a hand that can make one turn.** Here t4 may go from -2 pi to 2 pi: a whole turn more or "
                "less is another position of the motor.",
                lambda found: found[::2],
                lambda found: [row for row in found if row[3] > 0],
            ),
            posture_missing((0, 1), (2, 3)),
            mistake("sign_of_theta4", 0.5, ANGLES_ADDED, in_each_row(negate(3))),
            degrees(0, 1, 3),
        ),
        angles=(0, 1),
        residual=residual,
    ),
    Question(
        "scara_s600.classic",
        reference=own_classic,
        depends=("arm",),
        mistakes=(
            mistake(
                "modified_table",
                0.3,
                "**This is the modified table.** In the classic form a row holds the joint first and the link *behind* it.",
                wrong={"modified": True},
            ),
            mistake("z_never_turns_over", 0.4, NO_Z_TURNS_OVER, without_half_turn),
        ),
    ),
    Question(
        "scara_s600.cousin",
        reference=[-(r3 + r30), -t4],
        mistakes=(
            mistake(
                "sign_of_the_height",
                0.5,
                "**The height has kept its sign.** One of the two documents counts upwards, the other one downwards.",
                negate(0),
            ),
            mistake(
                "sign_of_theta4",
                0.5,
                "**The last angle has kept its sign.** The two hands turn about axes that point in opposite directions.",
                negate(1),
            ),
            constant_missing(),
        ),
        angles=(1,),
    ),
    Question(
        "scara_s600.choice",
        reference=fitting,
        places=False,
        mistakes=(
            mistake(
                "hole_forgotten",
                0.5,
                "**Near parts are overlooked.** No elbow folds completely: at its stop the end effector is still some way from axis 1. How far?",
                wrong={"inner": False},
            ),
            mistake(
                "stroke_forgotten",
                0.5,
                "**The stroke is overlooked.** How far must the quill go, and how far does it go?",
                wrong={"stroke": False},
            ),
            mistake(
                "gripper_forgotten",
                0.6,
                "**The gripper weighs something, too.** The payload of a data sheet is all that hangs on the flange.",
                wrong={"gripper": False},
            ),
        ),
    ),
    Question(
        "scara_s600.lengths",
        reference=fitted,
        tolerance=6e-4,  # some three standard deviations of what 30 such points leave open
        mistakes=(
            mistake(
                "as_on_the_data_sheet",
                0.0,
                "**These are the lengths of the data sheet.** Put them into the model: how far are the measured points from it?",
                wrong={"sheet": True},
            ),
            mistake(
                "tracker_not_at_the_base",
                0.5,
                "**The tracker's origin is not quite on axis 1.** Two more unknowns, the place of axis 1 in the tracker's frame, stand in the "
                "same linear equations.",
                wrong={"offset": False},
            ),
            mistake(
                "lengths_exchanged", 0.5, "**The two lengths are exchanged.** d2 turns with t1 alone.", exchange(0, 1)
            ),
        ),
    ),
)
