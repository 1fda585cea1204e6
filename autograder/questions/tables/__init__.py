"""Printed tables (MECA 953 and DH-m slides): conventions, repairs, the rank test, a table from joint origins."""

from __future__ import annotations

from functools import partial

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    arguments_in_degrees,
    misprint,
    offset_missing,
    sign_of,
)
from autograder.reference import robots
from dhkit.geometry import modified_dh

HALF = sympy.pi / 2
MODIFIED, CLASSIC, MIXED = 1, 2, 3
PRINTED_TABLES = [MODIFIED, CLASSIC, MODIFIED, CLASSIC, MIXED]  # planar 3R, planar 2R, elbow arm, wrist, PUMA-like arm


def with_entry(index, value):
    return lambda found: [*found[:index], value, *found[index + 1 :]]


def rows_of(table):
    return [[row.sigma, *row.parameters] for row in table.rows]


# ---------------------------------------------------------------- planar arms


def planar(lengths, angles):
    """Tip and heading of a planar arm with any number of joints."""
    tip = robots.planar(lengths).forward(angles)
    return [*tip[:2, 3].tolist(), float(np.sum(angles))]


def arms(rng: np.random.Generator) -> list[list]:
    """Argument lists: arms with one to six links."""
    counts = (1, 2, 2, 3, 3, 4, 6)
    return [[rng.uniform(0.1, 0.6, n).round(3).tolist(), rng.uniform(-2.5, 2.5, n).round(3).tolist()] for n in counts]


def absolute_angles(lengths, angles):
    x, y = np.array(lengths) @ np.cos(angles), np.array(lengths) @ np.sin(angles)
    return [x, y, float(np.sum(angles))]


def last_angle_as_heading(function):
    return lambda lengths, angles: [*function(lengths, angles)[:2], angles[-1]]


def without_last_link(function):
    return lambda lengths, angles: function([*lengths[:-1], 0.0], angles)


# ---------------------------------------------------------------- RX-90 in classic rows


RX90_CLASSIC = [list(row.parameters) for row in robots.RX90.table.to_classic().rows]


def x_pairs_moved(rows, places):
    """The columns a and alpha moved down, or up where `places` is negative; zeros follow."""
    pairs = [row[:2] for row in rows]
    pairs = [[0, 0]] * places + pairs[: len(pairs) - places] if places > 0 else pairs[-places:] + [[0, 0]] * -places
    return [[*pair, *row[2:]] for pair, row in zip(pairs, rows)]


def alpha_left(rows):
    """Only a is moved: alpha still stands where the modified table has it."""
    modified = x_pairs_moved(rows, 1)
    return [[row[0], below[1], *row[2:]] for row, below in zip(rows, modified)]


def z_pairs_moved(rows):
    """d and theta are moved up as well."""
    pairs = [row[2:] for row in rows[1:]] + [[0, 0]]
    return [[*row[:2], *pair] for row, pair in zip(rows, pairs)]


# ---------------------------------------------------------------- the wrist and the PUMA-like arm


WRIST = rows_of(robots.SPHERICAL_WRIST.table)
WRIST_PRINTED = [[0, 0, -HALF, 0, WRIST[0][4]], [0, 0, HALF, 0, WRIST[1][4]], [0, 0, 0, *WRIST[2][3:]]]
PUMA_ROW = rows_of(robots.PUMA.table)[5]
PUMA_PRINTED_ROW = rows_of(robots.PUMA_PRINTED.table)[5]


def with_cell(rows, row, column, value):
    return [
        [value if (i, j) == (row, column) else cell for j, cell in enumerate(cells)] for i, cells in enumerate(rows)
    ]


# ---------------------------------------------------------------- freedoms of a table of numbers


def screws(rows, *, slides=True, early=False, about_tip=False):
    """Columns (Z_i, O_i x Z_i) of turning joints and (0, Z_i) of sliding ones, shape (6, n)."""
    rows = np.array(rows, dtype=float)
    frames = [np.eye(4)]
    for step in modified_dh(*rows.T[1:]):
        frames.append(frames[-1] @ step)
    centre = frames[-1][:3, 3] if about_tip else np.zeros(3)
    columns = []
    for row, frame in zip(rows, frames if early else frames[1:]):
        axis, origin = frame[:3, 2], frame[:3, 3]
        sliding = slides and row[0] == 1
        columns.append(np.concatenate([0 * axis, axis] if sliding else [axis, np.cross(origin - centre, axis)]))
    return np.transpose(columns)


def freedoms(rows, part=slice(None), **how) -> int:
    """The rank of the screws, or of a part of their six numbers."""
    return int(np.linalg.matrix_rank(screws(rows, **how)[part], tol=1e-6))


def robots_at_random(rng: np.random.Generator) -> list[list]:
    """Argument lists: tables of robots at random postures, with sliding joints, with two joints on one line, and sound ones."""
    tables = [
        robots.RX90,
        robots.PUMA,
        robots.PUMA_PRINTED,
        robots.SCARA,
        robots.SPHERICAL_WRIST,
        robots.PLANAR_3R,
        robots.KR210,
    ]
    found = []
    for robot in tables:
        table = robot.table.at(robot.table.values)
        joints = {joint: rng.uniform(0.2, 1.2) for joint in table.joints}
        found.append(
            [[float(cell) for cell in (row.sigma, *(p.subs(joints) for p in row.parameters))] for row in table.rows]
        )
    a, d, t = rng.uniform(0.2, 0.6, 3)
    half = np.pi / 2
    found.append([[1, 0, 0, d, 0], [1, 0, half, a, half], [1, 0, half, t, 0]])  # a gantry
    found.append([[0, 0, 0, 0, t], [1, 0, 0, d, 0], [0, a, 0, 0, t], [1, 0, 0, a, 0]])  # two parallel slides
    found.append([[0, 0, -half, 0, t], [0, 0, half, 0, a], [0, 0, 0, d, t]])  # the wrist as printed, read as modified
    return [[[[round(cell, 6) for cell in row] for row in rows]] for rows in found]


def kind_of_table(rows) -> str:
    if any(row[0] == 1 for row in rows):
        return "tables with a sliding joint"
    return (
        "sound tables of turning joints"
        if freedoms(rows) == min(len(rows), 6)
        else "tables with two joints on one line"
    )


# ---------------------------------------------------------------- a table from a list of joint origins


KR210 = rows_of(robots.KR210.table)


def arm(
    mine,
    d1=lambda origins: origins.z1 + origins.z2,
    a1=lambda origins: origins.x2,
    d4=lambda origins: origins.x4 + origins.x5,
    d6=lambda origins: 0,
) -> list[list]:
    """The rows of an arm like the KR210; each keyword takes a length from the student's list of joint origins."""
    lengths = {"d1": d1(mine), "a1": a1(mine), "a2": mine.z3, "a3": mine.z4, "d4": d4(mine)}
    rows = [[lengths.get(str(cell), cell) for cell in row] for row in KR210]
    rows[5][3] = d6(mine)
    return rows


def gripper(mine, turn=((0.0, 0, 1), (0, -1, 0), (1, 0, 0)), ahead=(0, 0, 1), rows=("x6", "xg")) -> list[list]:
    """Transform from frame 6 to the gripper as nested lists; with the defaults right."""
    matrix = np.eye(4)
    matrix[:3, :3] = turn
    matrix[:3, 3] = np.array(ahead) * sum(mine[row] for row in rows)
    return [[int(cell) if cell == int(cell) else float(cell) for cell in row] for row in matrix]


QUESTIONS = (
    Question(
        "tables.convention",
        reference=PRINTED_TABLES,
        mistakes=(
            mistake(
                "headers_believed",
                0.2,
                "**These are the headers.** All five claim the modified convention; two of them head classic rows, and one a mixture. "
                "Build each robot as its header says, and look at it.",
                lambda _: [MODIFIED] * 5,
            ),
            mistake(
                "classic_2r_not_seen",
                0.6,
                "**The planar 2R is taken at its word.** Then L1 is a part of the base, and theta2 moves nothing.",
                with_entry(1, MODIFIED),
                with_entry(1, MIXED),
            ),
            mistake(
                "tool_row_taken_for_classic",
                0.6,
                "**A length in the last row does not make a table classic.** The elbow arm has one row more than joints: its last row, "
                "without a variable, is the tool.",
                with_entry(2, CLASSIC),
                with_entry(2, MIXED),
            ),
            mistake(
                "classic_wrist_not_seen",
                0.6,
                "**Look at the last row of the wrist**: as a modified row it puts axes 5 and 6 on one line. Read the rows the other "
                "way.",
                with_entry(3, MODIFIED),
                with_entry(3, MIXED),
            ),
            mistake(
                "mixed_table_not_seen",
                0.6,
                "**The PUMA-like table is of one convention only in part.** Test rows 1 and 6 in both readings: each time one of them "
                "puts two axes on one line.",
                with_entry(4, MODIFIED),
                with_entry(4, CLASSIC),
            ),
        ),
    ),
    Question(
        "tables.planar",
        reference=planar,
        mistakes=(
            mistake(
                "angle_not_summed",
                0.4,
                "**The angles are measured from the x axis.** Each of them is measured from the link before it.",
                lambda _: absolute_angles,
                lambda _: last_angle_as_heading(absolute_angles),
            ),
            mistake(
                "last_link_missing",
                0.5,
                "**The last link is missing.** Your point is the last joint; the tip is one length further on. (The slide's table of the 3R "
                "stops there, too: it has no tool row.)",
                without_last_link,
            ),
            mistake(
                "heading_not_summed",
                0.6,
                "**The heading is the last joint angle only.** It is measured from the link before it, which has turned as well.",
                last_angle_as_heading,
            ),
            mistake(
                "degrees",
                0.4,
                arguments_in_degrees().feedback,
                lambda function: lambda lengths, angles: function(lengths, np.radians(angles).tolist()),
                lambda function: (
                    lambda lengths, angles: [
                        *function(lengths, np.radians(angles).tolist())[:2],
                        function(lengths, angles)[2],
                    ]
                ),
            ),
        ),
        angles=(2,),
        probe=arms,
        case=lambda lengths, angles: "arms with one or two links" if len(lengths) < 3 else "arms with more links",
    ),
    Question(
        "tables.classic_rows",
        reference=RX90_CLASSIC,
        mistakes=(
            mistake(
                "modified_rows_copied",
                0.2,
                "**These are the modified rows again.** In a classic row a and alpha lead from the row's own joint to the next one.",
                partial(x_pairs_moved, places=1),
            ),
            mistake(
                "moved_the_wrong_way",
                0.4,
                "**The columns a and alpha were moved the wrong way.** Down is the way from classic to modified.",
                partial(x_pairs_moved, places=2),
            ),
            mistake(
                "alpha_left_behind",
                0.5,
                "**Column a was moved, column alpha was not.** The two are one pair, along and about the same X axis.",
                alpha_left,
            ),
            mistake(
                "whole_rows_moved",
                0.3,
                "**d and theta were moved as well.** They belong to the joint of their row in both conventions, and stay.",
                z_pairs_moved,
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
                lambda rows: with_cell(rows, 0, 2, -HALF),
                lambda rows: with_cell(rows, 0, 2, HALF),
            ),
            sign_of("alpha", 2, 3),
            mistake(
                "hand_length_missing",
                0.6,
                "**d6 is missing.** The printed product has it in the last column.",
                lambda rows: with_cell(rows, 2, 3, 0),
            ),
        ),
        partial=0.6,
    ),
    Question(
        "tables.puma_row",
        reference=PUMA_ROW,
        mistakes=(
            misprint(
                lambda row: [*row[:2], PUMA_PRINTED_ROW[2], *row[3:]],
                "it is the last row of a classic table. In a modified one it puts axes 5 and 6 on one line.",
                share=0.1,
            ),
            mistake(
                "hand_points_back",
                0.6,
                "**With this twist the hand points back into the forearm.** The rank is right, the sense is not: at theta5 = 0, which way "
                "does Z6 point compared with Z4?",
                lambda row: [*row[:2], -row[2], *row[3:]],
            ),
            mistake(
                "degrees",
                0.6,
                "**The twist is in degrees.** Here it is asked for in radians.",
                lambda row: [*row[:2], row[2] * 180 / sympy.pi, *row[3:]],
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
                lambda _: len,
                lambda _: lambda rows: min(len(rows), 6),
            ),
            mistake(
                "prismatic_as_revolute",
                0.6,
                "**A sliding joint is treated like a turning one.** It turns nothing, and moves every point the same way: what are its six "
                "numbers?",
                lambda _: partial(freedoms, slides=False),
            ),
            mistake(
                "half_of_the_numbers",
                0.4,
                "**Only three of the six numbers of a column are used.** A motion turns *and* moves: robots with more than three joints show it.",
                lambda _: partial(freedoms, part=slice(0, 3)),
                lambda _: partial(freedoms, part=slice(3, 6)),
                lambda _: partial(freedoms, part=slice(3, 6), about_tip=True),
            ),
            mistake(
                "axes_one_frame_early",
                0.5,
                "**The axes are taken one frame too early.** In the modified convention joint i turns about Z_i, which is known *after* the "
                "matrix of row i.",
                lambda _: partial(freedoms, early=True),
            ),
        ),
        probe=robots_at_random,
        case=kind_of_table,
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
        tolerance=1e-4,
    ),
)
