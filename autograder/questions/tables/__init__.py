"""Tables: conventions of printed ones, repairs, the rank test, a wrist from its axes, an arm from joint origins."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.chain import SAME_FRAMES
from autograder.judge.misconceptions import (
    arguments_in_degrees,
    classic_table,
    degrees_in_table,
    misprint,
    offset_missing,
    sign_of,
)
from autograder.judge.steps import change_cell, change_entry, negate, replace_entry

from .model import (
    CLASSIC,
    MIXED,
    MODIFIED,
    PRINTED_TABLES,
    PUMA_PRINTED_ROW,
    PUMA_ROW,
    RX90_CLASSIC,
    arm,
    draw_arms,
    draw_tables,
    first,
    freedoms,
    gripper,
    last,
    leave_alpha,
    move_x_pairs,
    move_z_pairs,
    name_arm,
    name_table,
    planar,
    wrist,
)

QUESTIONS = (
    Question(
        "tables.convention",
        reference=PRINTED_TABLES,
        mistakes=(
            mistake(
                "headers_believed",
                0.1,
                "**These are the headers.** All five claim the modified convention; not all of the rows follow it. "
                "Build each robot as its header says, and look at it.",
                lambda _: [MODIFIED] * 5,
            ),
            mistake(
                "classic_cobot_not_seen",
                0.6,
                "**The cobot is taken at its word.** Which of its axes would be parallel then, and which two would be one line?",
                replace_entry(0, MODIFIED),
                replace_entry(0, MIXED),
            ),
            mistake(
                "tool_row_taken_for_classic",
                0.6,
                "**A length in the last row does not make a table classic.** The elbow arm has one row more than joints: its last row, "
                "without a variable, is the tool.",
                replace_entry(1, CLASSIC),
                replace_entry(1, MIXED),
            ),
            mistake(
                "classic_wrist_not_seen",
                0.6,
                "**Look at the last row of the wrist**: as a modified row it puts axes 5 and 6 on one line. Read the rows the other "
                "way.",
                replace_entry(2, MODIFIED),
                replace_entry(2, MIXED),
            ),
            mistake(
                "honest_header_doubted",
                0.6,
                "**The arm of seven axes is not what you say.** Read its first row the other way: which two axes would be one line?",
                replace_entry(3, CLASSIC),
                replace_entry(3, MIXED),
            ),
            mistake(
                "mixed_table_not_seen",
                0.6,
                "**The handling arm is of one convention only in part.** Test its first row and its last in both readings: each time one "
                "of them puts two axes on one line.",
                replace_entry(4, MODIFIED),
                replace_entry(4, CLASSIC),
            ),
        ),
        places=False,
    ),
    Question(
        "tables.planar",
        reference=planar,
        mistakes=(
            mistake(
                "angle_not_summed",
                0.4,
                "**The angles are measured from the x axis.** Each of them is measured from the link before it.",
                wrong=[{"base": True}, {"base": True, "heading": "last"}],
            ),
            mistake(
                "last_link_missing",
                0.5,
                "**The last link is missing.** Your point is the last joint; the tip is one length further on. (The slide's table of the 3R "
                "stops there, too: it has no tool row.)",
                wrong={"last_link": False},
            ),
            mistake(
                "heading_not_summed",
                0.6,
                "**The heading is the last joint angle only.** It is measured from the link before it, which has turned as well.",
                wrong={"heading": "last"},
            ),
            arguments_in_degrees({"unit": np.pi / 180}, {"unit": np.pi / 180, "heading_unit": 1.0}),
        ),
        angles=(2,),
        probe=draw_arms,
        case=name_arm,
    ),
    Question(
        "tables.classic_rows",
        reference=RX90_CLASSIC,
        mistakes=(
            mistake(
                "modified_rows_copied",
                0.2,
                "**These are the modified rows again.** In a classic row a and alpha lead from the row's own joint to the next one.",
                move_x_pairs(1),
            ),
            mistake(
                "moved_the_wrong_way",
                0.4,
                "**The columns a and alpha were moved the wrong way.** Down is the way from classic to modified.",
                move_x_pairs(2),
            ),
            mistake(
                "alpha_left_behind",
                0.5,
                "**Column a was moved, column alpha was not.** The two are one pair, along and about the same X axis.",
                leave_alpha,
            ),
            mistake(
                "whole_rows_moved",
                0.3,
                "**d and theta were moved as well.** They belong to the joint of their row in both conventions, and stay.",
                move_z_pairs,
            ),
        ),
        partial=0.6,
    ),
    Question(
        "tables.wrist",
        reference=wrist,
        depends=("arm",),
        mistakes=(
            classic_table(),
            sign_of("alpha", 2, 3),
            offset_missing(2),
            mistake(
                "hand_length_missing",
                0.6,
                "**e is missing.** The end effector stands e behind the point where the axes meet: along which axis, in whose row?",
                change_cell(3, "d", lambda _: 0),
            ),
            mistake(
                "hand_length_as_a",
                0.5,
                "**e stands in the wrong column.** a leads along X, from one axis to the next; where axes meet it is 0. e runs along an axis.",
                lambda rows: [*rows[:2], [0, rows[2][3], rows[2][2], 0, rows[2][4]]],
            ),
            degrees_in_table(),
        ),
        partial=0.4,
    ),
    Question(
        "tables.puma_row",
        reference=PUMA_ROW,
        mistakes=(
            misprint(
                replace_entry(2, PUMA_PRINTED_ROW[2]),
                "it is the last row of a classic table. In a modified one it puts axes 5 and 6 on one line.",
                share=0.1,
            ),
            mistake(
                "hand_points_back",
                0.6,
                "**With this twist the hand points back into the forearm.** The rank is right, the sense is not: at theta5 = 0, which way "
                "does Z6 point compared with Z4?",
                negate(2),
            ),
            mistake(
                "degrees",
                0.6,
                "**The twist is in degrees.** Here it is asked for in radians.",
                change_entry(2, lambda alpha: alpha * 180 / sympy.pi),
            ),
        ),
        partial=0.4,
        angles=(2, 4),
    ),
    Question(
        "tables.freedoms",
        reference=freedoms,
        mistakes=(
            mistake(
                "joints_counted",
                0.1,
                "**Your function counts the joints.** Two joints on one line make one motion: the rank of the columns tells.",
                wrong=[{"count": "joints"}, {"count": "joints up to six"}],
            ),
            mistake(
                "prismatic_as_revolute",
                0.6,
                "**A sliding joint is treated like a turning one.** It turns nothing, and moves every point the same way: what are its six "
                "numbers?",
                wrong={"slides": False},
            ),
            mistake(
                "half_of_the_numbers",
                0.4,
                "**Only three of the six numbers of a column are used.** A motion turns *and* moves: robots with more than three joints show it.",
                wrong=[{"part": slice(0, 3)}, {"part": slice(3, 6)}, {"part": slice(3, 6), "about_tip": True}],
            ),
            mistake(
                "axes_one_frame_early",
                0.5,
                "**The axes are taken one frame too early.** In the modified convention joint i turns about Z_i, which is known *after* the "
                "matrix of row i.",
                wrong={"early": True},
            ),
            mistake(
                "tolerance_of_the_rank",
                0.8,
                "**Two axes that are almost one line are counted wrongly.** The statement says below which size a singular value counts as "
                "zero; numpy's own bound is another.",
                wrong=[{"below": 1e-12}, {"below": 1e-4}],
            ),
        ),
        probe=draw_tables,
        case=name_table,
    ),
    Question(
        "tables.arm",
        reference=arm,
        mistakes=(
            mistake(
                "rows_of_the_list_not_added",
                0.5,
                "**A d along a common axis is not complete.** Lines of the list can run along the same axis: with z1 = {z1} and z2 = {z2}, how "
                "high lies the common normal of axes 1 and 2?",
                wrong=[{"added": first}, {"added": last}],
            ),
            mistake(
                "hypotenuse_for_length",
                0.5,
                "**The straight distance between two origins stands where one of its components belongs.** a runs along X, d along Z: two "
                "legs of a triangle, not its long side.",
                wrong={"a1": lambda mine: float(np.hypot(mine.x2, mine.z2))},
            ),
            offset_missing(wrong=[{"offsets": slice(0)}, {"offsets": slice(1, None)}, {"offsets": slice(-1)}]),
            mistake(
                "origin_of_the_last_joint",
                0.7,
                "**O5 was put where the list has joint 5, or the gripper.** It is where X4 and axis 5 meet, as told; the way ahead belongs to the "
                "gripper.",
                wrong=[{"d5": lambda mine: mine.x5}, {"d5": lambda mine: mine.x5 + mine.xg}],
            ),
            sign_of("a", 2),
            sign_of("alpha", 2, 5),
        ),
        partial=0.6,
        pinned=SAME_FRAMES,
    ),
    Question(
        "tables.gripper",
        reference=gripper,
        mistakes=(
            mistake(
                "not_turned",
                0.4,
                "**The axes are not turned.** At zero, compare frame 5 of your arm with the gripper's (z ahead, x down).",
                wrong={"turned": False},
            ),
            mistake(
                "x_up",
                0.5,
                "**The gripper's x points up.** It is said to point down.",
                wrong={"down": -1},
            ),
            mistake(
                "one_row_of_the_list",
                0.6,
                "**The way ahead is not complete.** From O5 to the gripper there are two lines of the list: {x5} and {xg} m.",
                wrong=[{"rows": ("xg",)}, {"rows": ("x5",)}],
            ),
            mistake(
                "ahead_along_x",
                0.6,
                "**The way ahead is along x.** Ahead is x of the *file*; in frame 5, from which this transform is seen, ahead is another axis.",
                wrong={"ahead": (1, 0, 0)},
            ),
        ),
    ),
)
