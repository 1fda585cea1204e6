"""Direct models: turns about fixed centres and the six-axis arm (EPFL slides), the RX-90 by its recursion (MECA 953 slides)."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    angle_not_summed,
    angles_subtracted,
    arguments_in_degrees,
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
from autograder.reference import DHTable, robots
from autograder.reference.centres import epfl_centres, scara_centres
from autograder.reference.transforms import modified_dh, rot_z

t1, t2, t3, t4, t5, t6 = ANGLES = sympy.symbols("t1:7")
L1, L2, L4, D3, D4, w, a3, d3 = sympy.symbols("L1 L2 L4 D3 D4 w a3 d3")
C, S, HALF = sympy.cos, sympy.sin, sympy.pi / 2


# ---------------------------------------------------------------- turns in the plane

SCARA_K = scara_centres((t1, t2, t4), (L1, L2))
BLANKS = list(SCARA_K[2][:2, 2])
TOOL_0 = sympy.Matrix([L1 + L2 + L4, w, 1])


def planar_tool(*angles) -> list[sympy.Expr]:
    """The tool point if the two links and the hand make these angles with x."""
    parts = [rot_z(angle)[:2, :2] * sympy.Matrix(step) for angle, step in zip(angles, ([L1, 0], [L2, 0], [L4, w]))]
    return list(sum(parts, sympy.zeros(2, 1)))


TOOL_POINT = planar_tool(t1, t1 + t2, t1 + t2 + t4)


def with_unturned(*lengths) -> list[sympy.Expr]:
    """The tool point with these lengths of its step from the wrist added along the axes of the base."""
    turned = [entry.subs(dict.fromkeys(lengths, 0)) for entry in TOOL_POINT]
    return [entry + (length if length in lengths else 0) for entry, length in zip(turned, (L4, w))]


# ---------------------------------------------------------------- six turns in space


def lists(matrices) -> list:
    return [matrix.tolist() for matrix in matrices]


K = epfl_centres(ANGLES, D3, L2, D4)
WRIST_0 = sympy.Matrix([D3, 0, L2 + D4, 1])
# Turns 4, 5 and 6 leave the wrist centre alone.
WRIST = list((K[0] * K[1] * K[2] * WRIST_0)[:3, 0])
BASE_FIRST = list((K[2] * K[1] * K[0] * WRIST_0)[:3, 0])
CENTRES = [[0, 0, 0], [0, 0, 0], [0, 0, L2], [D3, 0, 0], [0, 0, L2 + D4], [D3, 0, 0]]


def with_last_columns(matrices, change) -> list:
    """The six matrices, the translation of each replaced by `change(matrix, index)`."""
    changed = []
    for i, matrix in enumerate(map(sympy.Matrix, matrices)):
        new = matrix.copy()
        new[:3, 3] = sympy.Matrix(change(matrix[:3, 3], i))
        changed.append(new.tolist())
    return changed


def without(symbol):
    """Everything as if this length were zero."""

    def step(answer):
        nested = isinstance(answer, (list, tuple))
        return [step(item) for item in answer] if nested else sympy.sympify(answer).subs(symbol, 0)

    return step


TABLE = robots.EPFL_ARM.table
ROWS = [[row.sigma, *row.parameters] for row in TABLE.rows]


def offset_as_link_length(rows):
    """D3 in column a of the row of joint 4."""
    rows = [list(row) for row in rows]
    rows[3][1], rows[2][3] = rows[3][1] + rows[2][3], sympy.S.Zero
    return rows


def in_row_3(column, value):
    """Another length in row 3."""

    def step(rows):
        rows = [list(row) for row in rows]
        rows[2][column] = value
        return rows

    return step


def or_with(step, about):
    """A mistake of one step, alone or with a second step behind it."""
    (first,) = about.steps
    return replace(about, steps=(first, lambda rows: step(first(rows))))


# ---------------------------------------------------------------- the RX-90

RX90 = robots.RX90.table
TRANSFORMS = RX90.transforms()
U0, U1, U2, U3, *_ = RX90.recursion()
# Row 6 with alpha = +90 degrees: the slide's page of matrices.
PRINTED_U0, _, PRINTED_U2, *_ = DHTable([*RX90.rows[:5], (0, 0, HALF, 0, t6)]).recursion()

# 1 marks a printed cell that differs from the product of the table (a test compares them).
WRONG_T56 = [[0, 0, 0, 0], [0, 0, 1, 0], [1, 1, 0, 0], [0, 0, 0, 0]]
WRONG_U4 = [[0, 0, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0]]
WRONG_U3 = [[1, 1, 0, 0], [0, 0, 0, 0], [1, 1, 0, 0], [0, 0, 0, 0]]
NO_CELL = [[0] * 4 for _ in range(4)]


def whole_columns(marks):
    """Every cell of a column that has a wrong one, as the test of orthogonality points at columns."""
    marks = np.array(marks)
    columns = marks.any(axis=0, keepdims=True) & (np.arange(4)[:, None] < 3)
    return np.where(columns, 1, 0).tolist()


def one_unmarked(cell):
    """A wrong cell of U3 is overlooked."""

    def step(marks):
        marks = np.array(marks)
        marks[2][cell] = 0
        return marks.tolist()

    return step


# ---------------------------------------------------------------- a tool


@lru_cache
def rx90(a3, d3) -> DHTable:
    return RX90.at({"a3": a3, "d3": d3})


def forward(*q, mine, tool="right", bend="radians", angles="radians") -> np.ndarray:
    """The pose of the student's tool on the RX-90, (4, 4), for six joint angles."""
    arm = rx90(mine.a3, mine.d3).forward(np.radians(q) if angles == "degrees" else q)
    if tool == "none":
        return arm
    step = tool_matrix(mine.reach, mine.bend if bend == "degrees" else np.radians(mine.bend), mine.length)
    return step @ arm if tool == "left" else arm @ step


@lru_cache
def tool_matrix(reach, bend, length) -> np.ndarray:
    """The step from frame 6 to the tool frame."""
    return np.array(modified_dh(reach, bend, length, 0).evalf(), dtype=float)


def probes(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists for forward: random postures, then quarter turns."""
    random = [[float(angle) for angle in rng.uniform(-3, 3, 6)] for _ in range(6)]
    quarters = [[float(k) * np.pi / 2 for k in rng.integers(-2, 3, 6)] for _ in range(3)]
    return [*random, *quarters]


def group(*q) -> str:
    quarters = np.divide(q, np.pi / 2)
    return "quarter turns" if np.allclose(quarters, quarters.round()) else "random postures"


QUESTIONS = (
    Question(
        "direct_models.blanks",
        reference=BLANKS,
        mistakes=(
            mistake(
                "sign_of_translation",
                0.5,
                "**The sign is turned: this is R p - p.** Put the centre [L1 + L2, 0, 1] into your matrix: it should stay.",
                lambda blanks: [-blank for blank in blanks],
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
                lambda _: list(rot_z(t4)[:2, 0] * (L1 + L2)),
                lambda _: list(-rot_z(t4)[:2, 0] * (L1 + L2)),
            ),
            mistake(
                "another_centre",
                0.5,
                "**This is the turn about another joint.** Joint 4 is at the wrist; where is that in the reference position?",
                *(lambda blanks, gone=gone: [blank.subs(gone, 0) for blank in blanks] for gone in (L1, L2)),
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
                lambda _: list((SCARA_K[2] * SCARA_K[1] * SCARA_K[0] * TOOL_0)[:2, 0]),
            ),
            summed_in_the_wrong_frame(
                with_unturned(L4, w),
                with_unturned(w),
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
        reference=lists(K),
        mistakes=(
            mistake(
                "sign_of_translation",
                0.5,
                "**The last columns have the wrong sign: R p - p.** Each K must leave every point of its own axis where it is. "
                "Try it with the centre.",
                lambda matrices: with_last_columns(matrices, lambda column, i: -column),
            ),
            mistake(
                "centre_as_translation",
                0.4,
                "**The last columns are the centres themselves.** They must be p - R p: what the turn about the origin takes "
                "away from p. See the slide of K5 and K6.",
                lambda matrices: with_last_columns(matrices, lambda column, i: CENTRES[i]),
            ),
            mistake(
                "elbow_at_the_wrist",
                0.6,
                "**K3 and K5 turn about the same height.** Axis 3 is at the elbow, axis 5 at the wrist; read both heights from "
                "the figure.",
                lambda matrices: [*matrices[:2], epfl_centres(ANGLES, D3, L2 + D4, 0)[2].tolist(), *matrices[3:]],
                lambda matrices: [*matrices[:4], epfl_centres(ANGLES, D3, L2, 0)[4].tolist(), matrices[5]],
            ),
            mistake(
                "opposite_sense",
                0.5,
                "**The turns go the wrong way round.** Positive is about +x and +z, thumb along the axis, as in the K5 and K6 of "
                "the slide.",
                lambda matrices: lists(
                    m.subs({t: -t for t in m.free_symbols.intersection(ANGLES)}) for m in map(sympy.Matrix, matrices)
                ),
            ),
        ),
        # Most cells are 0 or 1 whatever the centres are: right cells alone say little.
        partial=0.2,
    ),
    Question(
        "direct_models.wrist",
        reference=WRIST,
        mistakes=(
            angle_not_summed(
                list((K[0] * sympy.Matrix([D3, -L2 * S(t2) - D4 * S(t3), L2 * C(t2) + D4 * C(t3), 1]))[:3, 0]),
                feedback="**The forearm is placed as if t3 were counted from the vertical.** t3 goes from the upper arm to the "
                "forearm: with t3 = 0 the arm is stretched, whatever t2 is.",
            ),
            mistake(
                "base_first_with_fixed_centres",
                0.3,
                "**The turns are multiplied in the reverse order.** K1 stands on the left, and the hand's K nearest to the "
                "point: only then is every centre still in the reference position.",
                lambda _: BASE_FIRST,
            ),
            mistake(
                "leans_the_other_way",
                0.5,
                "**The arm leans to the other side.** A positive turn about x carries z towards -y: thumb along x, and see where "
                "the fingers go.",
                lambda wrist: [sympy.sympify(entry).subs({t2: -t2, t3: -t3}, simultaneous=True) for entry in wrist],
            ),
            mistake(
                "d3_left_out",
                0.6,
                "**The offset D3 is missing.** The plane of the arm does not contain axis 1.",
                without(D3),
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
                in_row_3(3, 0),
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
                in_row_3(1, D3),
                origins_as_d(
                    (0, 0, L2, D4, 0, 0),
                    feedback="**Heights of the figure were copied into column d.** d is measured along Z_i, from X_(i-1) to X_i: is "
                    "every Z of this arm upright?",
                ),
            ),
        ),
        partial=0.4,
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
                lambda marks: [marks[0], *map(whole_columns, marks[1:])],
            ),
            mistake(
                "cell_overlooked",
                0.7,
                "**One wrong cell of U3 is not marked.** Put numbers for the angles into your own U3 and into the printed one, and "
                "compare all twelve.",
                *map(one_unmarked, ((0, 0), (0, 1), (2, 0), (2, 1))),
            ),
            mistake(
                "right_and_wrong_exchanged",
                0.5,
                "**0 and 1 are exchanged.** A 1 marks a wrong cell.",
                lambda marks: (1 - np.array(marks)).tolist(),
            ),
        ),
        # Most cells are right on the slide: a sheet without a mark has most of its cells right, too.
        partial=0.0,
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
            arguments_in_degrees(wrong={"angles": "degrees"}),
        ),
        probe=probes,
        case=group,
    ),
)
