"""Homogeneous transforms: a point in two frames, moves that commute, a part seen from a gripper, DHm rows and matrices."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import sympy

from autograder.reference import DHTable
from dhkit import geometry
from dhkit.own_arms import CLASSIC_ARMS
from dhm.transforms import classic_dh, modified_dh, rot_x, rot_y, rot_z, trans_x, trans_z

from ..shared.tables import list_rows

GENERAL = a, alpha, d, theta = sympy.symbols("a alpha d theta")
MODIFIED, CLASSIC = modified_dh(*GENERAL), classic_dh(*GENERAL)

# ---------------------------------------------------------------- a point in two frames


def see_from_a(mine, shift=1.0, turn=1.0, unit=np.pi / 180, shift_turned=False) -> list[float]:
    """Coordinates [x, y] in frame A of the point given in frame B.

    `shift` and `turn` are factors of the way and the angle between the frames, `unit` is that of the angle in radians;
    with `shift_turned` the way is taken along the axes of B.
    """
    angle = turn * unit * mine.phi
    rotation = geometry.rotation_2d(angle)
    way = shift * np.array([mine.tx, mine.ty])
    point = np.array([mine.px, mine.py])
    return (rotation @ (point + way) if shift_turned else rotation @ point + way).tolist()


# ---------------------------------------------------------------- which moves commute

b, beta, e, psi = sympy.symbols("b beta e psi")
HALF = sympy.pi / 2
PAIRS = (
    (rot_z(theta), trans_x(a) * rot_z(psi) * trans_x(-a)),
    (rot_z(HALF) * trans_x(b) * rot_z(-HALF), rot_y(beta)),
    (rot_x(sympy.pi), rot_z(sympy.pi)),
    (trans_x(a), rot_y(beta)),
    (trans_z(d) * rot_z(theta), trans_z(e) * rot_z(psi)),
    (rot_x(sympy.pi), trans_z(d)),
)
COMMUTE = [int(sympy.simplify(first * second - second * first) == sympy.zeros(4)) for first, second in PAIRS]

# ---------------------------------------------------------------- a part seen from a gripper

DOWN, UP, UNTURNED = ((0, 1, 0), (1, 0, 0), (0, 0, -1)), ((0, -1, 0), (1, 0, 0), (0, 0, 1)), np.eye(3)


def way(*factors: np.ndarray) -> list[list[float]]:
    """The product of transforms, as nested lists, whole numbers as such."""
    product = geometry.chain_products(np.array(factors))[-1].tolist()
    return [[int(cell) if cell == int(cell) else cell for cell in row] for row in product]


def turn_back_only(T: np.ndarray) -> np.ndarray:
    """An inverse whose position is the old one with the opposite sign."""
    return geometry.rigid_transform(T[:3, :3].T, -T[:3, 3])


def see_from_gripper(mine, *, looks=DOWN, unit=np.pi / 180, back=np.linalg.inv, order=way) -> list[list[float]]:
    """Transform from the gripper to the part, as nested lists.

    `looks` holds the rows of the camera's rotation, `unit` is that of the angles in radians, `back` inverts the transform of
    the gripper, and `order` multiplies the ways from the gripper to the base, to the camera, to the part.
    """
    camera = geometry.rigid_transform(looks, (mine.cx, mine.cy, mine.cz))
    part = geometry.rigid_transform(geometry.rotation("z", unit * mine.psi), (mine.u, mine.v, mine.w))
    gripper = geometry.modified_dh(mine.a, unit * mine.alpha, mine.d, unit * mine.theta)
    return order(back(gripper), camera, part)


# ---------------------------------------------------------------- a DHm function and its faults

Calls = list[tuple[list[float], float]]
QUARTER = np.pi / 2
CALLS: Calls = [
    ([0, 0.3, 0, 0.4, 0], 0.7),
    ([0, 0.3, QUARTER, 0.4, 0], 0.7),
    ([0, 0.3, -QUARTER, 0, 0], 0.7),
    ([0, 0, 0, 0.4, QUARTER], 0),
    ([1, 0.3, 0, 0.2, 0], 0.25),
    ([1, 0, QUARTER, 0.2, 0], 0.25),
    ([1, 0, QUARTER, 0.2, 0], 0),
    ([0, 0.3, np.pi, 0.4, 0], 1.2),
]


def positive_root(alpha: float) -> float:
    """The sine of an angle by its cosine alone."""
    return float(np.sqrt(1 - np.cos(alpha) ** 2))


def my_dhm(
    row, q, *, constant=True, sine=np.sin, slid=True, reads_sigma=True, matrix: Callable = geometry.modified_dh
) -> list[list[float]]:
    """The DHm matrix of a row [sigma, a, alpha, d, theta] at the joint value q, as nested lists.

    Without `constant` a turning joint forgets the constant theta of its row; `sine` is taken of alpha; without `slid` the
    second entry of the position counts the row's d alone; without `reads_sigma` every joint turns; `matrix` is that of the
    convention, of (a, alpha, d, theta).
    """
    sigma, a, alpha, d, theta = row
    slides = reads_sigma and sigma == 1
    d_q, theta_q = (d + q, theta) if slides else (d, (theta if constant else 0) + q)
    T = np.array(matrix(a, alpha, d_q, theta_q))
    if sine is not np.sin:
        T[1, 2], T[2, :2] = -sine(alpha), sine(alpha) * np.array([np.sin(theta_q), np.cos(theta_q)])
        T[1, 3] = -d_q * sine(alpha)
    if not slid:
        T[1, 3] = -d * sine(alpha)
    return T.tolist()


COLLEAGUE = {"constant": False, "sine": positive_root, "slid": False}
"""Keywords with which `my_dhm` has the faults of the statement."""


def failing_calls(mine, *, taken: int | None = None, left: int | None = None) -> list[int]:
    """Numbers, from 1, of those calls in the student's list whose result is wrong.

    `taken` names a call that is right, from 0 in `CALLS`, in place of `left`.
    """
    fails = [not np.allclose(my_dhm(*call), my_dhm(*call, **COLLEAGUE)) for call in CALLS]
    if taken is not None and left is not None:
        fails[taken], fails[left] = True, False
    start = int(mine.start)
    return [number for number, failed in enumerate(fails[start:] + fails[:start], start=1) if failed]


def draw_rows(rng: np.random.Generator) -> list[list]:
    """Argument lists: rows of turning and of sliding joints with twists of both signs and constants of both kinds."""
    quarter, half = QUARTER, np.pi
    twists = {0: (0.0, quarter, -quarter, half, 0.6, -2.0), 1: (0.0, quarter, -quarter, -half, -0.5, 2.2)}
    drawn = []
    for sigma, alphas in twists.items():
        for alpha in alphas:
            a, d = rng.uniform(0.1, 0.6, 2).round(3).tolist()
            theta, q = rng.uniform(-1.5, 1.5, 2).round(3).tolist()
            drawn.append([[sigma, a, alpha, d, theta], q])
        drawn.append([[sigma, 0.0, quarter, 0.0, 0.0], round(rng.uniform(0.2, 0.6), 3)])
    return drawn


def name_row(row, q) -> str:
    """The case a row belongs to, in words."""
    return (
        f"joints that {'slide' if row[0] == 1 else 'turn'}, {'negative' if np.sin(row[2]) < -1e-9 else 'other'} twists"
    )


# ---------------------------------------------------------------- classic rows to modified rows


def modified_rows(mine) -> list[list]:
    """The rows of the student's arm, the tool's last."""
    rows = CLASSIC_ARMS[mine.arm]
    return [*list_rows(DHTable.from_classic(rows)), [0, *rows[-1][1:3], 0, 0]]


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
