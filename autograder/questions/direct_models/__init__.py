"""Direct models: turns about fixed centres, misprints of the RX-90, an arm of the student's own and a robot from its data sheet."""

from __future__ import annotations

import operator

import numpy as np

from autograder.judge import Mistake, Question, mistake
from autograder.judge.chain import SAME_SENSES
from autograder.judge.misconceptions import (
    angle_not_summed,
    arguments_in_degrees,
    classic_table,
    columns_exchanged,
    offset_missing,
    sign_of,
    summed_in_the_wrong_frame,
    symbol_negated,
    transposed_rotation,
)
from autograder.judge.steps import negate, substitute

from . import own
from .model import (
    ABSOLUTE_PEN,
    BLANKS,
    D3,
    L1,
    L2,
    L4,
    NO_CELL,
    PEN,
    PEN_BASE_FIRST,
    PEN_HANGS,
    PEN_STIFF,
    TOOL_BASE_FIRST,
    TOOL_POINT,
    TURNED_CENTRE,
    WRONG_T56,
    WRONG_U3,
    WRONG_U4,
    e,
    leave_unturned,
    mark_columns,
    planar_tool,
    t1,
    t2,
    t3,
    t4,
    t5,
    unmark,
    w,
)


def _in_a_product(after: int, stopped: str, look: str) -> tuple[Mistake, ...]:
    """What goes wrong in a product of the rows of a sheet: `stopped` says where, `look` how the reading is checked."""
    return (
        mistake(
            "one_step_short",
            0.4,
            f"**The recursion stopped one step too early.** {stopped}",
            wrong={"after": after},
        ),
        mistake(
            "reversed_product",
            0.3,
            "**The matrices are multiplied in the reverse order.** From left to right: base first, end effector last.",
            wrong={"order": "end first"},
        ),
        mistake(
            "other_convention",
            0.4,
            f"**The sheet is read in the other convention.** {look}",
            wrong={"convention": False},
        ),
        mistake(
            "lengths_exchanged",
            0.4,
            f"**The two lengths of every row are exchanged.** {look}",
            wrong={"columns": False},
        ),
        transposed_rotation(),
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
        "direct_models.locked",
        reference=PEN,
        mistakes=(
            angle_not_summed(
                *ABSOLUTE_PEN,
                feedback="**An angle is counted from the wrong line.** t3 goes from the upper arm to the forearm, t5 from the forearm to "
                "the hand: with both zero the arm is stretched, whatever t2 is.",
            ),
            mistake(
                "pen_not_turned",
                0.5,
                "**The pen has not turned with joint 5.** h is added straight up, or along the forearm: about which line, and by which "
                "angle in all, has the hand turned?",
                lambda _: PEN_HANGS,
                lambda _: PEN_STIFF,
            ),
            mistake(
                "base_first_with_fixed_centres",
                0.3,
                "**The turns are multiplied in the reverse order.** K1 stands on the left, and the hand's K nearest to the "
                "point: only then is every centre still in the reference position.",
                lambda _: PEN_BASE_FIRST,
            ),
            mistake(
                "leans_the_other_way",
                0.5,
                "**The arm leans to the other side.** A positive turn about x carries z towards -y: thumb along x, and see where "
                "the fingers go.",
                substitute({t2: -t2, t3: -t3, t5: -t5}),
            ),
            mistake(
                "offset_left_out",
                0.6,
                "**A length across the plane of the arm is missing.** D3 and e both point along x, out of the plane in which joints "
                "2, 3 and 5 turn: none of the three changes them.",
                substitute({D3: 0}),
                substitute({e: 0}),
            ),
        ),
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
        "direct_models.K",
        reference=own.turns,
        depends=("arm",),
        mistakes=(
            mistake(
                "sign_of_translation",
                0.5,
                "**The last columns have the wrong sign: R p - p.** Each K must leave every point of its own axis where it is. "
                "Try it with the centre.",
                wrong={"column": "R p - p"},
            ),
            mistake(
                "centre_as_translation",
                0.4,
                "**The last columns are the centres themselves.** They must be p - R p: what the turn about the origin takes "
                "away from p.",
                wrong={"column": "p"},
            ),
            mistake(
                "centres_missing",
                0.4,
                "**The turns have lost their centres: all go about the origin.** Which axes do not pass through it, and what does a turn "
                "about the origin do to a point of theirs?",
                wrong={"column": "0"},
            ),
            mistake(
                "centres_from_the_joint_before",
                0.4,
                "**Your centres are counted from the joint before.** Every centre is a point of frame 0, in the reference position.",
                wrong={"column": "step"},
            ),
            mistake(
                "senses_overlooked",
                0.6,
                "**An axis that points against one of frame 0 is turned the wrong way.** Thumb along the arrow: a positive turn "
                "about -Z_0 is a negative one about Z_0.",
                wrong={"senses": False},
            ),
            mistake(
                "opposite_sense",
                0.5,
                "**All turns go the wrong way round.** Positive is right-handed, thumb along the arrow of the axis.",
                wrong={"sense": -1},
            ),
        ),
        partial=0.7,
    ),
    Question(
        "direct_models.end_point",
        reference=own.end_point,
        depends=("arm",),
        mistakes=(
            mistake(
                "base_first_with_fixed_centres",
                0.3,
                "**The turns are multiplied in the reverse order.** K1 stands on the left, and the last K nearest to the "
                "point: only then is every centre still in the reference position.",
                wrong={"order": "base first"},
            ),
            mistake(
                "senses_overlooked",
                0.6,
                "**An axis that points against one of frame 0 is turned the wrong way.** Thumb along the arrow: a positive turn "
                "about -Z_0 is a negative one about Z_0.",
                wrong={"senses": False},
            ),
            mistake(
                "opposite_sense",
                0.5,
                "**All turns go the wrong way round.** Positive is right-handed, thumb along the arrow of the axis.",
                wrong={"sense": -1},
            ),
            mistake(
                "length_left_out",
                0.6,
                "**The length h is missing.** Put zero for all angles: do you get the point that the statement gives?",
                substitute({"h": 0}),
            ),
        ),
    ),
    Question(
        "direct_models.table",
        reference=own.rows,
        depends=("arm",),
        mistakes=(
            classic_table(),
            columns_exchanged("a", "d"),
            columns_exchanged("a", "alpha"),
            own.in_rows(offset_missing(1), 4, own.without_constant),
            own.in_rows(sign_of("alpha", 1), 2, operator.neg),
            own.in_rows(sign_of("d", 1), 3, operator.neg),
        ),
        partial=0.4,
        pinned=SAME_SENSES,
    ),
    Question(
        "direct_models.reading",
        reference=own.reading,
        depends=("robot", "sheet"),
        mistakes=(
            mistake(
                "lengths_exchanged",
                0.0,
                "**The convention is right, the two lengths are exchanged.** Which of the two belongs to the X axis? Put the example "
                "into your product.",
                own.other_letter(False, True),
            ),
            mistake(
                "other_convention",
                0.0,
                "**The lengths are right, the convention is the other one.** In the classic form a row begins with the joint, in the "
                "modified one it ends with it. Put the example into your product.",
                own.other_letter(True, False),
            ),
            mistake(
                "misread",
                0.0,
                "**Neither the convention nor the order of the lengths is right.** Multiply the six matrices of your reading, put the "
                "example in, and compare the last column.",
                own.other_letter(True, True),
            ),
        ),
    ),
    Question(
        "direct_models.U2",
        reference=own.from_frame_2,
        depends=("robot", "sheet"),
        mistakes=_in_a_product(
            3,
            "This is U3 = 3T6: joint 3 is not in it.",
            "See the question before: which point does the example give?",
        ),
    ),
    Question(
        "direct_models.T06",
        reference=own.product,
        depends=("robot", "sheet"),
        mistakes=_in_a_product(
            1,
            "This is U1 = 1T6: joint 1 is not in it.",
            "Put the example of the sheet into your matrix: is the last column the point?",
        ),
    ),
    Question(
        "direct_models.forward",
        reference=own.forward,
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
            mistake(
                "other_convention",
                0.4,
                "**The sheet is read in the other convention.** Without the tool, does your function give the point of the sheet's "
                "example?",
                wrong={"convention": False},
            ),
            arguments_in_degrees({"angles": "degrees"}),
        ),
        probe=own.draw_joint_values,
        case=own.name_case,
    ),
)
