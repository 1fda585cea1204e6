"""Printed tables (MECA 953 and DH-m slides): conventions, repairs, the rank test, a table from joint origins."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.chain import SAME_FRAMES
from autograder.judge.misconceptions import arguments_in_degrees, misprint, offset_missing, sign_of
from autograder.judge.steps import change_cell, change_entry, negate, replace_entry

from .model import (
    CLASSIC,
    HALF,
    MIXED,
    MODIFIED,
    PRINTED_TABLES,
    PUMA_PRINTED_ROW,
    PUMA_ROW,
    RX90_CLASSIC,
    WRIST,
    WRIST_PRINTED,
    arm,
    draw_arms,
    draw_tables,
    freedoms,
    gripper,
    leave_alpha,
    move_x_pairs,
    move_z_pairs,
    name_arm,
    name_table,
    planar,
)

QUESTIONS = (
    Question(
        "tables.convention",
        reference=PRINTED_TABLES,
        mistakes=(
            mistake(
                "headers_believed",
                0.1,
                "**These are the headers.** All five claim the modified convention; two of them head classic rows, and one a mixture. "
                "Build each robot as its header says, and look at it.",
                lambda _: [MODIFIED] * 5,
            ),
            mistake(
                "classic_2r_not_seen",
                0.6,
                "**The planar 2R is taken at its word.** Then L1 is a part of the base, and theta2 moves nothing.",
                replace_entry(1, MODIFIED),
                replace_entry(1, MIXED),
            ),
            mistake(
                "tool_row_taken_for_classic",
                0.6,
                "**A length in the last row does not make a table classic.** The elbow arm has one row more than joints: its last row, "
                "without a variable, is the tool.",
                replace_entry(2, CLASSIC),
                replace_entry(2, MIXED),
            ),
            mistake(
                "classic_wrist_not_seen",
                0.6,
                "**Look at the last row of the wrist**: as a modified row it puts axes 5 and 6 on one line. Read the rows the other "
                "way.",
                replace_entry(3, MODIFIED),
                replace_entry(3, MIXED),
            ),
            mistake(
                "mixed_table_not_seen",
                0.6,
                "**The PUMA-like table is of one convention only in part.** Test rows 1 and 6 in both readings: each time one of them "
                "puts two axes on one line.",
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
        reference=WRIST,
        mistakes=(
            misprint(
                WRIST_PRINTED,
                "its rows are classic. Read as modified rows, the last one puts axes 5 and 6 on one line.",
                share=0.1,
            ),
            mistake(
                "twist_of_the_arm_kept",
                0.6,
                "**A twist stands before joint 4.** It would lead from axis 3 of an arm to axis 4; here Z3 lies on axis 4 already.",
                change_cell(1, "alpha", lambda _: -HALF),
                change_cell(1, "alpha", lambda _: HALF),
            ),
            sign_of("alpha", 2, 3),
            mistake(
                "hand_length_missing",
                0.6,
                "**d6 is missing.** The printed product has it in the last column.",
                change_cell(3, "d", lambda _: 0),
            ),
        ),
        partial=0.6,
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
                "**A d along a common axis is not complete.** Two rows of the list run along the same axis: with z1 = {z1} and z2 = {z2}, how "
                "high lies the common normal of axes 1 and 2? And how far is it from the elbow to the wrist centre?",
                wrong=[
                    {"d1": lambda origins: origins.z1},
                    {"d1": lambda origins: origins.z2},
                    {"d4": lambda origins: origins.x4},
                    {"d1": lambda origins: origins.z1, "d4": lambda origins: origins.x4},
                ],
            ),
            mistake(
                "hypotenuse_for_length",
                0.5,
                "**The straight distance between two origins stands where one of its components belongs.** a runs along X, d along Z: two "
                "legs of a triangle, not its long side.",
                wrong=[
                    {"a1": lambda origins: float(np.hypot(origins.x2, origins.z2))},
                    {"d4": lambda origins: float(np.hypot(origins.x4 + origins.x5, origins.z4))},
                    {"d4": lambda origins: float(np.hypot(origins.x4, origins.z4)) + origins.x5},
                ],
            ),
            offset_missing(2),
            mistake(
                "origin_of_joint_6",
                0.7,
                "**O6 was put where the list has joint 6.** Axes 4, 5 and 6 meet in one point, the wrist centre: with all three origins there "
                "the table is shortest. The way ahead belongs to the gripper.",
                wrong=[{"d6": lambda origins: origins.x6}, {"d6": lambda origins: origins.x6 + origins.xg}],
            ),
            sign_of("a", 4),
            sign_of("alpha", 2, 4, 5, 6),
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
                "**The axes are not turned.** At zero, compare frame 6 (Z6 ahead, X6 up) with the gripper's (x ahead, z up).",
                wrong={"turn": np.eye(3)},
            ),
            mistake(
                "one_row_of_the_list",
                0.6,
                "**The way ahead is not complete.** From the wrist centre to the gripper there are two rows of the list: {x6} and {xg} m.",
                wrong=[{"rows": ("xg",)}, {"rows": ("x6",)}],
            ),
            mistake(
                "ahead_along_x",
                0.6,
                "**The way ahead is along x.** It is x of the *gripper*; in frame 6, from which this transform is seen, ahead is another axis.",
                wrong={"ahead": (1, 0, 0)},
            ),
            mistake(
                "one_quarter_turn_only",
                0.5,
                "**One of the two turns is missing.** Compare all three axes, not only x: which way does the gripper's y point in frame 6?",
                wrong=[
                    {"turn": ((0.0, 0, -1), (0, 1, 0), (1, 0, 0))},
                    {"turn": ((0.0, 0, 1), (0, 1, 0), (-1, 0, 0))},
                ],
            ),
        ),
    ),
)
