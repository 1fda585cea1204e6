"""Direct models: turns about fixed centres and the six-axis arm (EPFL slides), the RX-90 by its recursion (MECA 953 slides)."""

from __future__ import annotations

import numpy as np

from autograder.judge import Question, mistake
from autograder.judge.chain import SAME_SENSES
from autograder.judge.misconceptions import (
    angle_not_summed,
    angles_subtracted,
    arguments_in_degrees,
    classic_matrix,
    classic_table,
    hypotenuse,
    offset_misplaced,
    offset_missing,
    one_factor_missing,
    origins_as_d,
    reversed_product,
    sign_of,
    summed_in_the_wrong_frame,
    symbol_negated,
    transposed_rotation,
)
from autograder.judge.steps import change_cell, negate, replace_entry, substitute

from .model import (
    ABSOLUTE_WRIST,
    BLANKS,
    CENTRES,
    D3,
    D4,
    ELBOW_AT_WRIST,
    K_LISTS,
    L1,
    L2,
    L4,
    NO_CELL,
    PRINTED_U0,
    PRINTED_U2,
    ROWS,
    RX90,
    TOOL_BASE_FIRST,
    TOOL_POINT,
    TRANSFORMS,
    TURNED_CENTRE,
    U0,
    U1,
    U2,
    U3,
    WRIST,
    WRIST_AT_ELBOW,
    WRIST_BASE_FIRST,
    WRONG_T56,
    WRONG_U3,
    WRONG_U4,
    change_last_columns,
    draw_angles,
    forward,
    leave_unturned,
    mark_columns,
    name_posture,
    offset_as_link_length,
    or_with,
    planar_tool,
    t1,
    t2,
    t3,
    t4,
    turn_backwards,
    unmark,
    w,
)

QUESTIONS = (
    Question(
        "direct_models.blanks",
        reference=BLANKS,
        mistakes=(
            mistake(
                "sign_of_translation",
                0.5,
                "**The sign is turned: this is R p - p.** Put the centre [L1 + L2, 0, 1] into your matrix: it should stay.",
                negate(0, 1),
            ),
            mistake(
                "centre_as_translation",
                0.3,
                "**The last column is the centre itself.** That is what it would be if the turn carried the origin to the "
                "centre; but the centre must be carried to itself.",
                lambda _: [L1 + L2, 0],
                lambda _: [-(L1 + L2), 0],
            ),
            mistake(
                "turned_centre",
                0.4,
                "**This is R p, or its opposite, alone.** The last column is what is missing between R p and p: see the "
                "slide that derives [R, p - R p].",
                lambda _: TURNED_CENTRE,
                lambda _: [-entry for entry in TURNED_CENTRE],
            ),
            mistake(
                "another_centre",
                0.5,
                "**This is the turn about another joint.** Joint 4 is at the wrist; where is that in the reference position?",
                *(substitute({gone: 0}) for gone in (L1, L2)),
            ),
        ),
    ),
    Question(
        "direct_models.tool_point",
        reference=TOOL_POINT,
        mistakes=(
            mistake(
                "tool_not_turned_by_joint_4",
                0.6,
                "**The hand's own joint does not move your tool.** The tool sits behind joint 4: which of the three turns "
                "does its point take part in?",
                lambda _: planar_tool(t1, t1 + t2, t1 + t2),
            ),
            angle_not_summed(planar_tool(t1, t2, t4), planar_tool(t1, t1 + t2, t4)),
            mistake(
                "base_first_with_fixed_centres",
                0.3,
                "**The turns are multiplied in the reverse order.** Once joint 1 has turned, the other centres are no longer "
                "where they were in the reference position. Which turn leaves all the other centres alone?",
                lambda _: TOOL_BASE_FIRST,
            ),
            summed_in_the_wrong_frame(
                leave_unturned(L4, w),
                leave_unturned(w),
                feedback="**A length of the tool is added as it stands.** Ahead and left are told as the hand sees them, and the hand has "
                "turned: what is ahead of it is not ahead of the base.",
            ),
            symbol_negated(
                w,
                "tool_on_the_other_side",
                "**The tool reaches to the wrong side.** Check a posture with all angles zero and a quarter turn of joint 1: "
                "left of the arm is +y there, and -x here.",
            ),
        ),
    ),
    Question(
        "direct_models.K",
        reference=K_LISTS,
        mistakes=(
            mistake(
                "sign_of_translation",
                0.5,
                "**The last columns have the wrong sign: R p - p.** Each K must leave every point of its own axis where it is. "
                "Try it with the centre.",
                change_last_columns(lambda column, i: -column),
            ),
            mistake(
                "centre_as_translation",
                0.4,
                "**The last columns are the centres themselves.** They must be p - R p: what the turn about the origin takes "
                "away from p. See the slide of K5 and K6.",
                change_last_columns(lambda column, i: CENTRES[i]),
            ),
            mistake(
                "centres_missing",
                0.4,
                "**The turns have lost their centres: all six go about the origin.** Which axes do not pass through it, and what does a turn "
                "about the origin do to a point of theirs?",
                change_last_columns(lambda column, i: [0, 0, 0]),
            ),
            mistake(
                "elbow_at_the_wrist",
                0.6,
                "**K3 and K5 turn about the same height.** Axis 3 is at the elbow, axis 5 at the wrist; read both heights from "
                "the figure.",
                replace_entry(2, ELBOW_AT_WRIST),
                replace_entry(4, WRIST_AT_ELBOW),
            ),
            mistake(
                "opposite_sense",
                0.5,
                "**The turns go the wrong way round.** Positive is about +x and +z, thumb along the axis, as in the K5 and K6 of "
                "the slide.",
                turn_backwards,
            ),
        ),
        partial=0.7,
    ),
    Question(
        "direct_models.wrist",
        reference=WRIST,
        mistakes=(
            angle_not_summed(
                ABSOLUTE_WRIST,
                feedback="**The forearm is placed as if t3 were counted from the vertical.** t3 goes from the upper arm to the "
                "forearm: with t3 = 0 the arm is stretched, whatever t2 is.",
            ),
            mistake(
                "base_first_with_fixed_centres",
                0.3,
                "**The turns are multiplied in the reverse order.** K1 stands on the left, and the hand's K nearest to the "
                "point: only then is every centre still in the reference position.",
                lambda _: WRIST_BASE_FIRST,
            ),
            mistake(
                "leans_the_other_way",
                0.5,
                "**The arm leans to the other side.** A positive turn about x carries z towards -y: thumb along x, and see where "
                "the fingers go.",
                substitute({t2: -t2, t3: -t3}),
            ),
            mistake(
                "d3_left_out",
                0.6,
                "**The offset D3 is missing.** The plane of the arm does not contain axis 1.",
                substitute({D3: 0}),
            ),
        ),
    ),
    Question(
        "direct_models.table",
        reference=ROWS,
        mistakes=(
            offset_missing(1, 2, 3, 4, 5, 6),
            classic_table(),
            mistake(
                "offset_as_link_length",
                0.5,
                "**D3 stands in column a.** It is measured along axis 3, from one common normal to the next, and not across "
                "from axis to axis: axes 3 and 4 meet.",
                offset_as_link_length,
            ),
            sign_of("alpha", 2, 4, 5, 6),
            offset_misplaced(3, 2),
            or_with(
                change_cell(3, "d", lambda _: 0),
                hypotenuse(
                    4,
                    "d",
                    D3,
                    D4,
                    feedback="**In column d stands the straight distance from elbow to wrist.** d runs along one Z axis: which two axes "
                    "do its two components follow?",
                ),
            ),
            or_with(
                change_cell(3, "a", lambda _: D3),
                origins_as_d(
                    (0, 0, L2, D4, 0, 0),
                    feedback="**Heights of the figure were copied into column d.** d is measured along Z_i, from X_(i-1) to X_i: is "
                    "every Z of this arm upright?",
                ),
            ),
        ),
        partial=0.4,
        pinned=SAME_SENSES,
    ),
    Question(
        "direct_models.wrong_cells",
        reference=[WRONG_T56, WRONG_U4, WRONG_U3],
        mistakes=(
            mistake(
                "perfect_rotation_believed",
                0.6,
                "**You have let 5T6 pass.** It is a perfect rotation, but not the one of row 6: put the alpha of that row into "
                "the general DHm matrix.",
                lambda marks: [NO_CELL, *marks[1:]],
            ),
            mistake(
                "whole_columns_marked",
                0.3,
                "**You have marked whole columns.** That a column is no unit vector tells where to look, not which of its cells is "
                "wrong: compare cell by cell with your own product.",
                lambda marks: [marks[0], *map(mark_columns, marks[1:])],
            ),
            mistake(
                "cell_overlooked",
                0.7,
                "**One wrong cell of U3 is not marked.** Put numbers for the angles into your own U3 and into the printed one, and "
                "compare all twelve.",
                *map(unmark, ((0, 0), (0, 1), (2, 0), (2, 1))),
            ),
            mistake(
                "right_and_wrong_exchanged",
                0.5,
                "**0 and 1 are exchanged.** A 1 marks a wrong cell.",
                lambda marks: (1 - np.array(marks)).tolist(),
            ),
        ),
        partial=0.7,
        places=False,
    ),
    Question(
        "direct_models.U2",
        reference=U2,
        mistakes=(
            mistake(
                "printed_5t6_used",
                0.6,
                "**You have used the 5T6 that is printed on the slide; it is an erratum.** Its alpha has another sign than row 6 "
                "of the table: see your marks in the question before.",
                lambda _: PRINTED_U2,
            ),
            reversed_product(*TRANSFORMS[2:]),
            classic_matrix(*(row.parameters for row in RX90.rows[2:]), note="classic_matrices"),
            one_factor_missing(
                U3, feedback="**The recursion stopped one step too early.** This is U3 = 3T6: joint 3 is not in it."
            ),
            transposed_rotation(),
        ),
    ),
    Question(
        "direct_models.T06",
        reference=U0,
        mistakes=(
            mistake(
                "printed_5t6_used",
                0.6,
                "**You have used the 5T6 that is printed on the slide; it is an erratum.** Its alpha has another sign than row 6 "
                "of the table. The twelve elements printed at the end of the slides are right: compare with them.",
                lambda _: PRINTED_U0,
            ),
            reversed_product(*TRANSFORMS),
            angles_subtracted(
                t3,
                feedback="**theta2 and theta3 are subtracted.** Axes 2 and 3 are parallel and of the same sense: their angles add "
                "up, and the slides write C23 and S23.",
            ),
            classic_matrix(*(row.parameters for row in RX90.rows), note="classic_matrices"),
            one_factor_missing(
                U1, feedback="**The recursion stopped one step too early.** This is U1 = 1T6: joint 1 is not in it."
            ),
        ),
    ),
    Question(
        "direct_models.forward",
        reference=forward,
        mistakes=(
            mistake(
                "tool_left_out",
                0.5,
                "**Your tool is missing.** This is the pose of frame 6; the row of your tool comes behind it.",
                wrong={"tool": "none"},
            ),
            mistake(
                "tool_on_the_left",
                0.4,
                "**The tool is multiplied from the left.** There it would stand in front of the base. What the hand holds comes "
                "last in the chain, on the right.",
                wrong={"tool": "left"},
            ),
            mistake(
                "bend_in_degrees",
                0.6,
                "**The bend of {bend} degrees is taken as {bend} radians.** cos and sin count in radians.",
                wrong={"bend": "degrees"},
            ),
            arguments_in_degrees({"angles": "degrees"}),
        ),
        probe=draw_angles,
        case=name_posture,
    ),
)
