"""Homogeneous transforms (MECA 953 and DH-m slides): order of moves, inverse, classic and modified convention."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    classic_table,
    degrees,
    inverse_by_transposing,
    inverse_keeps_position,
    misprint,
    of_function,
    option,
    summed_in_the_wrong_frame,
    symbol_negated,
    tool_left_out,
    transposed_rotation,
)
from autograder.reference import DHTable
from autograder.reference.transforms import (
    classic_dh,
    modified_dh,
    modified_dh_inverse,
    rigid_inverse,
    rot_x,
    rot_z,
    trans_x,
    trans_z,
)

GENERAL = a, alpha, d, theta = sympy.symbols("a alpha d theta")

# ---------------------------------------------------------------- a point in two frames


def seen_from_a(mine, shift=1.0, turn=1.0, unit=np.pi / 180, shift_turned=False) -> list[float]:
    """Coordinates in frame A of the point given in frame B; with the defaults right."""
    angle = turn * unit * mine.phi
    rotation = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    way = shift * np.array([mine.tx, mine.ty])
    point = np.array([mine.px, mine.py])
    return (rotation @ (point + way) if shift_turned else rotation @ point + way).tolist()


# ---------------------------------------------------------------- which moves commute

MOVES = (trans_x(a), rot_x(alpha), trans_z(d), rot_z(theta))
COMMUTE = [
    int(sympy.simplify(first * second) == sympy.simplify(second * first)) for first, second in combinations(MOVES, 2)
]


def with_entry(index, value):
    return lambda found: [*found[:index], value, *found[index + 1 :]]


# ---------------------------------------------------------------- classic rows to modified rows

a1, a2, a3, d1, t1, t2, t3 = sympy.symbols("a1 a2 a3 d1 t1 t2 t3")
HALF = sympy.pi / 2
PRINTED = [(0, a1, -HALF, d1, t1), (0, a2, 0, 0, t2), (0, a3, HALF, 0, t3)]
CONVERTED = DHTable.from_classic(PRINTED)
ROWS = [[row.sigma, *row.parameters] for row in CONVERTED.rows] + [[0, *PRINTED[-1][1:3], 0, 0]]


def alpha_left_behind(rows):
    """Only the column a is moved down."""
    return [[row[0], row[1], below[2], *row[3:]] for row, below in zip(rows, [*rows[1:], [0] * 5])]


# ---------------------------------------------------------------- the four numbers out of a matrix


def along_the_tilted_axis(T, angle):
    return T[:3, 3] @ T[:3, 2]


def by_the_angle(T, angle):
    """The same d, by way of the twist that was found: it goes wrong with it."""
    return T[2, 3] * np.cos(angle) - T[1, 3] * np.sin(angle)


def reader(twist=np.arctan2, turn=np.arctan2, offset=along_the_tilted_axis):
    """A function that reads (a, alpha, d, theta) out of a DHm matrix; each part can be done in a wrong way."""

    def parameters(T):
        T = np.array(T, dtype=float)
        angle = twist(-T[1, 2], T[2, 2])
        return [T[0, 3], angle, offset(T, angle), turn(-T[0, 1], T[0, 0])]

    return parameters


def readers(*wrong):
    """Steps that read one angle or both in a wrong way, and d with or without it."""
    return [
        lambda _, way=way: reader(*way)
        for bad in wrong
        for way in (
            (np.arctan2, bad),
            *((bad, turn, offset) for turn in (np.arctan2, bad) for offset in (along_the_tilted_axis, by_the_angle)),
        )
    ]


def from_quotient(sine, cosine):
    """atan for atan2; fails at a quarter turn."""
    if not cosine:
        raise ZeroDivisionError
    return float(np.arctan(sine / cosine))


def from_quotient_or_limit(sine, cosine):
    """atan for atan2, as numpy does it: a quotient without value becomes infinite."""
    return float(np.arctan(sine / cosine)) if cosine else np.sign(sine) * np.pi / 2


def divided(row, column):
    """d by one division, which has no value where the sine or the cosine of alpha vanishes."""

    def offset(T, angle):
        if not T[column]:
            raise ZeroDivisionError
        return T[row, 3] / T[column]

    return offset


def matrices(rng: np.random.Generator) -> list[list]:
    """Argument lists: DHm matrices with angles in all quadrants, then with round twists; rounded, so that zeros are zeros."""
    drawn = [
        (rng.uniform(0.1, 0.6), twist, rng.uniform(-0.5, 0.5), turn)
        for twist, turn in zip((0.5, 2.2, -0.7, -2.4, 1.1), (2.5, -0.6, -2.0, 0.8, -1.3))
    ]
    round_twists = [
        (0.3, 0.0, 0.4, 2.0),
        (0.0, np.pi / 2, 0.35, -2.6),
        (0.25, -np.pi / 2, -0.2, 0.0),
        (0.4, 0.0, -0.15, np.pi / 2),
        (0.2, np.pi / 2, 0.5, 0.9),
    ]
    return [[(np.round(np.array(modified_dh(*row), dtype=float), 12) + 0.0).tolist()] for row in drawn + round_twists]


def round_twist(T) -> str:
    return "a twist of 0 or a quarter turn" if min(abs(T[1][2]), abs(T[2][2])) < 1e-9 else "a twist of any other size"


QUESTIONS = (
    Question(
        "transforms.point",
        reference=seen_from_a,
        mistakes=(
            mistake(
                "turned_the_other_way",
                0.5,
                "**The point is turned the other way.** The columns of R, not its rows, are the axes of B: with phi = {phi} degrees "
                "x_B points up to the right.",
                wrong={"turn": -1.0},
            ),
            mistake(
                "shift_turned_too",
                0.5,
                "**The way from O_A to O_B was turned as well.** It is given along the axes of A already: turn the point, then add.",
                wrong={"shift_turned": True},
            ),
            mistake(
                "shift_missing",
                0.4,
                "**The way from O_A to O_B is missing.** Your point is turned, but counted from O_B.",
                wrong={"shift": 0.0},
            ),
            mistake(
                "degrees",
                0.6,
                "**The angle {phi} is taken in radians.** It is given in degrees: numpy's cos and sin want `np.radians` of it.",
                wrong={"unit": 1.0},
            ),
            summed_in_the_wrong_frame(
                wrong={"turn": 0.0},
                feedback="**Coordinates of two frames are added as they stand.** {px} m along x_B is not {px} m along x_A: frame B is "
                "turned by {phi} degrees.",
            ),
        ),
        tolerance=1e-3,
    ),
    Question(
        "transforms.commute",
        reference=COMMUTE,
        mistakes=(
            mistake(
                "translations_do_not_commute",
                0.6,
                "**Two shifts are missing among the pairs that may be exchanged.** Neither of them turns anything: does it matter "
                "which one you walk first?",
                with_entry(1, 0),
            ),
            mistake(
                "rotations_commute",
                0.4,
                "**Turns about two different axes do not commute.** Turn a book by a quarter about its long edge, then about its "
                "spine; now the other way round.",
                with_entry(4, 1),
            ),
            mistake(
                "translation_and_rotation_commute",
                0.4,
                "**A turn changes the direction in which a later shift goes**, unless it turns about that very direction.",
                with_entry(2, 1),
                with_entry(3, 1),
                lambda found: with_entry(3, 1)(with_entry(2, 1)(found)),
            ),
        ),
    ),
    Question(
        "transforms.operators",
        reference=[alpha, a, theta, d],
        mistakes=(
            misprint(
                lambda found: [found[0], found[0], *found[2:]],
                "the second move is a shift, and a shift wants a length.",
                share=0.3,
            ),
            mistake(
                "a_for_alpha",
                0.4,
                "**An a stands where an alpha belongs.** The first move turns: its argument is an angle. (The slide's list of "
                "parameters names a twice, too.)",
                lambda found: [found[1], *found[1:]],
            ),
            mistake(
                "order_of_the_table",
                0.4,
                "**These are the parameters in the order of a table.** The slide turns before it shifts: R, D, R, D.",
                lambda found: [found[1], found[0], found[3], found[2]],
            ),
        ),
        angles=(0, 2),
    ),
    Question(
        "transforms.inverse",
        reference=modified_dh_inverse(*GENERAL),
        mistakes=(
            inverse_by_transposing(),
            inverse_keeps_position(),
            mistake(
                "signs_turned_order_kept",
                0.4,
                "**The four signs are turned, but the order is kept.** Who puts on socks and then shoes, takes off the shoes first.",
                lambda _: modified_dh(*(-value for value in GENERAL)),
            ),
            mistake(
                "not_inverted",
                0.1,
                "**This is the way from frame i-1 to frame i itself.** The way back is asked for.",
                lambda inverse: rigid_inverse(inverse),
            ),
        ),
    ),
    Question(
        "transforms.classic",
        reference=classic_dh(*GENERAL),
        mistakes=(
            misprint(
                lambda matrix: matrix[:, :3].row_join(matrix[:, 3].subs({a: d, d: a}, simultaneous=True)),
                "it puts the origin a up the z axis and d outwards. What does the page's own definition of a and d say?",
                share=0.2,
            ),
            mistake(
                "modified_matrix",
                0.3,
                "**This is the modified matrix.** In the classic walk the joint comes first: about z, along z, then along x, about x.",
                lambda _: modified_dh(*GENERAL),
            ),
            mistake(
                "origin_not_turned",
                0.5,
                "**The origin is not turned.** a is walked along the x axis *after* the turn by theta.",
                lambda matrix: matrix[:, :3].row_join(sympy.Matrix([a, 0, d, 1])),
            ),
            transposed_rotation(),
            symbol_negated(
                alpha,
                "sign_of_alpha",
                "**alpha turns the wrong way.** Write Rot_x(alpha) alone and see where it sends the y axis.",
                share=0.5,
            ),
        ),
    ),
    Question(
        "transforms.frame_place",
        reference="B",
        mistakes=(
            option(
                "A",
                "slide_misprint",
                "**This is the claim of the slide, and the matrices contradict it.** Which convention ends with the turn of joint i, "
                "so that the joint turns about the z axis of frame i?",
            ),
            option(
                "C",
                "same_place",
                "**The frames are not at the same place.** In one convention joint i turns about z_i, in the other about z_(i-1).",
            ),
            option(
                "D",
                "same_place_downstream",
                "**The frames are not at the same place.** In one convention joint i turns about z_i, in the other about z_(i-1).",
            ),
        ),
    ),
    Question(
        "transforms.convert",
        reference=ROWS,
        mistakes=(
            classic_table(
                feedback="**The classic rows were copied.** In the modified table row i holds a and alpha of the link *before* "
                "joint i: what stands before joint 1?",
            ),
            mistake(
                "alpha_left_behind",
                0.5,
                "**Column a was moved, column alpha was not.** The two are one pair, along and about the same X axis.",
                alpha_left_behind,
            ),
            tool_left_out(
                feedback="**The last pair got lost.** a3 and its twist lead from axis 3 to the hand: where do they go when the "
                "columns move down?",
            ),
        ),
        partial=0.6,
    ),
    Question(
        "transforms.parameters",
        reference=reader(),
        mistakes=(
            mistake(
                "d_by_division",
                0.6,
                "**For some twists your d has no value or a wrong one.** Where the sine or the cosine of alpha vanishes, an entry that "
                "should hold d holds nothing. The other entry then holds all of it.",
                *(lambda _, row=row, at=at: reader(offset=divided(row, at)) for row, at in ((2, (2, 2)), (1, (1, 2)))),
                lambda _: reader(offset=lambda T, angle: T[2, 3] / np.cos(angle)),
            ),
            mistake(
                "d_is_one_component",
                0.4,
                "**d is not an entry of the matrix.** The origin goes d along the *tilted* axis: the last column holds two "
                "components of it.",
                lambda _: reader(offset=lambda T, angle: T[2, 3]),
            ),
            mistake(
                "atan_for_atan2",
                0.5,
                "**atan loses the quadrant.** A quotient is the same for an angle and for the opposite one; a function of two "
                "arguments can tell them apart.",
                *readers(from_quotient_or_limit, from_quotient),
            ),
            mistake(
                "sign_of_angle_lost",
                0.5,
                "**acos does not know the sign of its angle**, and asin does not know more than half a turn. Each angle has a sine "
                "*and* a cosine in the matrix.",
                *readers(lambda sine, cosine: float(np.arccos(cosine)), lambda sine, cosine: float(np.arcsin(sine))),
            ),
            of_function(degrees(1, 3)),
        ),
        angles=(1, 3),
        probe=matrices,
        case=round_twist,
    ),
)
