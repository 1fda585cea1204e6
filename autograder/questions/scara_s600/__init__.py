"""The Adept s600 tutorial: table, product, misprints, type-8 equation, inverse model, classic table, its cousin."""

from __future__ import annotations

import sympy

from autograder.judge import Follow, Question, following, mistake
from autograder.judge.chain import SAME_FRAMES
from autograder.judge.misconceptions import (
    classic_table,
    columns_exchanged,
    degrees,
    fails_on_limit,
    misprint,
    posture_missing,
    reversed_product,
    rows_shifted,
    symbol_negated,
    tolerance_too_wide,
)
from autograder.judge.steps import change_cell, in_each_row, negate

from .model import (
    B1,
    B2,
    CLASSIC,
    HAND,
    ROWS,
    T14,
    T14_WITH_Z4_UP,
    TRANSFORMS,
    blame,
    constant_missing,
    draw_poses,
    draw_posture,
    keep_elbow,
    list_configurations,
    mgi,
    move_links_down,
    name_case,
    r3,
    r30,
    residual,
    solve_linear,
    t1,
    t2,
    t4,
    turn_axis_3_over,
)

Z4_IS_DOWN = (
    "**z4 points upwards in this answer.** In the drawing it points against z3: how far must z turn about x3 to get there, "
    "and what does that do to y and z of the hand?"
)
ANGLES_ADDED = (
    "**t4 is counted like t1 and t2.** It turns about an axis that points the other way: look at the hand from above and "
    "turn it about z4."
)

QUESTIONS = (
    Question(
        "scara_s600.table",
        reference=ROWS,
        mistakes=(
            mistake("z4_upwards", 0.6, Z4_IS_DOWN, change_cell(4, "alpha", lambda _: 0)),
            constant_missing(),
            classic_table(
                feedback="**This is the classic Denavit-Hartenberg table**, as the simulator lists it. In the modified form row i holds d "
                "and alpha of the link *before* joint i."
            ),
            columns_exchanged(
                "a",
                "d",
                note="d_and_r_exchanged",
                feedback="**The columns d and r are exchanged.** In the letters of Khalil and Kleinfinger d is counted along x, from one "
                "joint axis to the next; r along z.",
            ),
            rows_shifted(
                feedback="**The rows are shifted by one.** Row i leads from frame i-1 to frame i. Frames 0 and 1 share their origin and "
                "their z: what does row 1 hold then, and which joint?"
            ),
        ),
        partial=0.6,
        pinned=SAME_FRAMES,
        columns=("sigma", "d", "alpha", "r", "theta"),
    ),
    Question(
        "scara_s600.T14",
        reference=T14,
        mistakes=(
            mistake("z4_upwards", 0.5, Z4_IS_DOWN, lambda _: T14_WITH_Z4_UP),
            symbol_negated(t4, "angles_added", ANGLES_ADDED),
            constant_missing(),
            reversed_product(*TRANSFORMS[1:]),
        ),
        follows=Follow("scara_s600.table", lambda rows: following.product_of_table(rows[:, 1:])),
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
        "scara_s600.linear",
        reference=solve_linear(B1, B2),
        mistakes=(
            misprint(
                solve_linear(B2, B1),
                "at tj = 0 the hand is X + Y ahead and nothing to the left; with the printed names it is the other way round.",
                share=0.4,
            ),
            mistake(
                "determinant_missing",
                0.5,
                "**Cosine and sine are not divided by the determinant.** Square and add them: is it 1?",
                lambda pair: [entry * (B1**2 + B2**2) for entry in pair],
            ),
            mistake(
                "sign_of_the_sine",
                0.5,
                "**The sine has the wrong sign.** Try tj = 0 with the hand straight above the base.",
                negate(1),
            ),
        ),
        draw=draw_posture,
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
        reference=CLASSIC,
        mistakes=(
            mistake(
                "modified_table",
                0.3,
                "**This is the modified table.** In the classic form a row holds the joint first and the link *behind* it.",
                move_links_down,
            ),
            mistake(
                "links_moved_the_wrong_way",
                0.3,
                "**The links have moved down instead of up.** Row 1 of the classic table holds joint 1 and what lies between axes 1 and 2.",
                lambda rows: move_links_down(move_links_down(rows)),
            ),
            mistake(
                "axis_3_turned_over",
                0.8,
                "**The right robot, with axis 3 turned over.** The question asks for the axes of the modified table, where axis 3 points up.",
                turn_axis_3_over(-1),
            ),
            mistake(
                "half_turn_too_early",
                0.4,
                "**The half turn comes one row too early.** Behind it z points down: with this d the hand is above the arm.",
                turn_axis_3_over(1),
            ),
        ),
        angles=tuple(range(1, 16, 2)),
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
)
