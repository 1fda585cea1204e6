"""Homogeneous transforms: a point in two frames, moves that commute, classic rows, parameters read out of a matrix."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import sympy

from autograder.reference import DHTable
from dhkit.geometry import rotation_2d
from dhm.transforms import classic_dh, modified_dh, modified_dh_inverse, rot_x, rot_z, trans_x, trans_z

from ..shared.tables import list_rows

GENERAL = a, alpha, d, theta = sympy.symbols("a alpha d theta")
MODIFIED, CLASSIC = modified_dh(*GENERAL), classic_dh(*GENERAL)
INVERSE = modified_dh_inverse(*GENERAL)
SIGNS_TURNED = modified_dh(*(-value for value in GENERAL))

# ---------------------------------------------------------------- a point in two frames


def see_from_a(mine, shift=1.0, turn=1.0, unit=np.pi / 180, shift_turned=False) -> list[float]:
    """Coordinates [x, y] in frame A of the point given in frame B.

    `shift` and `turn` are factors of the way and the angle between the frames, `unit` is that of the angle in radians;
    with `shift_turned` the way is taken along the axes of B.
    """
    angle = turn * unit * mine.phi
    rotation = rotation_2d(angle)
    way = shift * np.array([mine.tx, mine.ty])
    point = np.array([mine.px, mine.py])
    return (rotation @ (point + way) if shift_turned else rotation @ point + way).tolist()


# ---------------------------------------------------------------- which moves commute

MOVES = (trans_x(a), rot_x(alpha), trans_z(d), rot_z(theta))
COMMUTE = [
    int(sympy.simplify(first * second) == sympy.simplify(second * first)) for first, second in combinations(MOVES, 2)
]

# ---------------------------------------------------------------- classic rows to modified rows

a1, a2, a3, d1, t1, t2, t3 = sympy.symbols("a1 a2 a3 d1 t1 t2 t3")
HALF = sympy.pi / 2
PRINTED = [(0, a1, -HALF, d1, t1), (0, a2, 0, 0, t2), (0, a3, HALF, 0, t3)]
ROWS = [*list_rows(DHTable.from_classic(PRINTED)), [0, *PRINTED[-1][1:3], 0, 0]]


def leave_alpha(rows):
    """Only the column a is moved down."""
    return [[row[0], row[1], below[2], *row[3:]] for row, below in zip(rows, [*rows[1:], [0] * 5])]


# ---------------------------------------------------------------- the four numbers out of a matrix


def project_on_axis(T, angle) -> float:
    """The offset d, along the tilted axis."""
    return T[:3, 3] @ T[:3, 2]


def project_by_angle(T, angle) -> float:
    """The same d, by way of the twist that was found: it goes wrong with it."""
    return T[2, 3] * np.cos(angle) - T[1, 3] * np.sin(angle)


def divide(row, column):
    """d by one division, which has no value where the sine or the cosine of alpha vanishes."""

    def offset(T, angle):
        if not T[column]:
            raise ZeroDivisionError
        return T[row, 3] / T[column]

    return offset


def half_turn_forgotten(T, angle) -> float:
    """d by one division, and the entry itself where there is no sine to divide by: half a turn turns its sign."""
    return T[2, 3] if abs(T[1, 2]) < 1e-9 else T[1, 3] / T[1, 2]


def flat(sine, cosine) -> float:
    """No angle wherever there is no sine: half a turn is not seen."""
    return 0.0 if abs(sine) < 1e-9 else float(np.arctan2(sine, cosine))


def read_parameters(T, *, twist=np.arctan2, turn=np.arctan2, offset=project_on_axis) -> list[float]:
    """[a, alpha, d, theta] of a DHm matrix, (4, 4).

    `twist` and `turn` find alpha and theta from a sine and a cosine, `offset` finds d from the matrix and alpha.
    """
    T = np.array(T, dtype=float)
    angle = twist(-T[1, 2], T[2, 2])
    return [T[0, 3], angle, offset(T, angle), turn(-T[0, 1], T[0, 0])]


def misread_angles(*finders) -> list[dict]:
    """Keywords with which `read_parameters` finds one angle or both in a wrong way, and d with or without it."""
    return [
        {"twist": twist, "turn": turn, "offset": offset}
        for wrong in finders
        for twist, turn, offset in (
            (np.arctan2, wrong, project_on_axis),
            *((wrong, turn, offset) for turn in (np.arctan2, wrong) for offset in (project_on_axis, project_by_angle)),
        )
    ]


def failing_atan(sine, cosine) -> float:
    """atan for atan2; fails at a quarter turn."""
    if not cosine:
        raise ZeroDivisionError
    return float(np.arctan(sine / cosine))


def atan(sine, cosine) -> float:
    """atan for atan2, as numpy does it: a quotient without value becomes infinite."""
    return float(np.arctan(sine / cosine)) if cosine else np.sign(sine) * np.pi / 2


def acos(sine, cosine) -> float:
    return float(np.arccos(cosine))


def asin(sine, cosine) -> float:
    return float(np.arcsin(sine))


def draw_matrices(rng: np.random.Generator) -> list[list]:
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
        (0.35, np.pi, 0.3, 1.1),
        (0.15, np.pi, -0.45, -2.2),
        (0.3, 0.0, 0.25, np.pi),
        (0.1, -np.pi / 2, 0.4, np.pi),
        (0.2, np.pi, 0.15, -np.pi / 2),
        (0.25, 1.0, 0.2, 0.0),
        (0.0, -2.0, -0.1, -np.pi / 2),
    ]
    return [[(np.round(np.array(modified_dh(*row), dtype=float), 12) + 0.0).tolist()] for row in drawn + round_twists]


def name_twist(T) -> str:
    """The case a matrix belongs to, in words."""
    return (
        "a twist of 0, a quarter or half a turn"
        if min(abs(T[1][2]), abs(T[2][2])) < 1e-9
        else "a twist of any other size"
    )
