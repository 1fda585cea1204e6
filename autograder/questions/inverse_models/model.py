"""Inverse models of the documents: determinant of the elbow arm, shoulder offset, RX-90, how many postures; wrong steps."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy

from autograder.judge.misconceptions import product
from autograder.reference import robots

Rows = list[list[float]]

# ---------------------------------------------------------------- the elbow arm (DH-m slides)

t1, t2, t3 = sympy.symbols("t1:4")
HAND = sympy.Matrix(robots.ELBOW_3R.symbolic_forward()[:3, 3])
# Turning about axis 1 changes no volume, so t1 = 0 will do.
DETERMINANT = HAND.jacobian([t1, t2, t3]).subs(t1, 0).det()
ABSOLUTE_DETERMINANT = HAND.subs(t2 + t3, t3).jacobian([t1, t2, t3]).subs(t1, 0).det()
PLANAR_DETERMINANT = sympy.Symbol("L1") * sympy.Symbol("L2") * sympy.sin(t3)


def first_half(found: Rows) -> Rows:
    return found[: len(found) // 2]


def second_half(found: Rows) -> Rows:
    return found[len(found) // 2 :]


def turn_joint_1_only(found: Rows) -> Rows:
    """The postures over the back have the angles of those in front, t1 apart."""
    half = first_half(found)
    return half + [[row[0] + np.pi, *row[1:]] for row in half]


def one_elbow(*pairs: tuple[int, int]):
    """Steps: of each pair of rows one. Rows 0 and 1 are the two elbows in front, 2 and 3 those over the back."""
    return [lambda found, pair=pair: [found[i] for i in pair if i < len(found)] for pair in pairs]


# ---------------------------------------------------------------- how many

GENERAL = robots.RX90.forward([0.4, 0.9, -0.6, 0.5, 0.8, -0.3])[:3, :3]


def general_pose(*centre: float) -> np.ndarray:
    """A pose (4, 4) without any symmetry, its origin at `centre`."""
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = GENERAL, centre
    return pose


def count_solutions(solutions) -> int:
    return -1 if solutions.status == "infinite" else len(solutions)


@lru_cache(maxsize=1)
def count_six_cases() -> list[int]:
    """The six cases of the question, in its order; -1 for infinitely many."""
    return [
        count_solutions(robots.scara(a2=0.4, a3=0.3).inverse((0.3, 0.4, -0.1, 0.5))),
        count_solutions(robots.scara(a2=0.35, a3=0.35).inverse((0.0, 0.0, -0.1, 0.5))),
        count_solutions(robots.elbow_3r(0.5, 0.4).inverse((0.54, 0.0, 0.72))),
        count_solutions(robots.rx90().inverse(general_pose(0.35, 0.2, 0.4))),
        count_solutions(robots.epfl_arm().inverse(general_pose(0.15, 0.0, 0.5))),
        count_solutions(robots.kr210(grip=0.0).inverse(general_pose(2.6, 0.0, 0.75))),
    ]


def change_count(place: int, change):
    """A step that changes one of some counts."""
    return lambda found: [change(value) if i == place else value for i, value in enumerate(found)]


def change_counts(**changed):
    """A step that changes some of the six counts, named a to f."""

    def step(found):
        values = dict(zip("abcdef", found, strict=True))
        return [
            changed[name](value) if callable(changed.get(name)) else changed.get(name, value)
            for name, value in values.items()
        ]

    return step


# ---------------------------------------------------------------- the PUMA-like arm (DH-m slides)

ROW_6 = [6, *(entry for row in robots.PUMA.table.rows[5:] for entry in (row.sigma, *row.parameters))]
Wx, Wy, d2, A = sympy.symbols("Wx Wy d2 A")
DIRECTION, SIDE = sympy.atan2(Wy, Wx), sympy.atan2(d2, A)


def draw_posture(rng: np.random.Generator) -> dict[str, float]:
    """A sample point: Wx, Wy, d2 and A belong to one posture of the arm."""
    offset, q = rng.uniform(0.1, 0.3), rng.uniform(-np.pi, np.pi, 6)
    wx, wy = robots.puma(d2=offset, d6=0.0).forward(q)[:2, 3]
    return {"Wx": wx, "Wy": wy, "d2": offset, "A": wx * np.cos(q[0]) + wy * np.sin(q[0])}


# ---------------------------------------------------------------- the RX-90 (MECA 953 slides)

ALLOWED = 1e-9  # for rounding of the sine of t3, as the statement says
LENGTHS = ((0.45, 0.45), (0.5, 0.25), (0.375, 0.625))
ABOUT_X = np.diag([1.0, -1.0, -1.0, 1.0])
WRIST = product(robots.RX90.table.transforms()[3:])[:3, :3]
AT_REST = np.array(WRIST.subs(dict.fromkeys(WRIST.free_symbols, 0)), dtype=float)  # 3R6 with the wrist's angles zero


@lru_cache(maxsize=16)
def rx90(a3: float, d3: float) -> robots.Robot:
    return robots.rx90(a3, d3)


@lru_cache(maxsize=512)
def _rx90_postures(pose: bytes, a3: float, d3: float) -> Rows:
    return rx90(a3, d3).inverse(np.frombuffer(pose).reshape(4, 4)).q.tolist()


def list_rx90_postures(
    U, a3: float, d3: float, *, hand="own", wrist="own", shoulder="both", slack=ALLOWED, fails=False, beyond=()
):
    """All [t1, ..., t6] that bring the hand to U, (4, 4).

    `hand` may be that of the ``"printed"`` 5T6, and `wrist` be solved for the orientation seen ``"from base"``; `shoulder`
    may be ``"front"`` or ``"back"``. `slack` is allowed for rounding of the sine of t3; where it is pushed beyond 1 the
    function `fails`. `beyond` is returned out of reach, None standing for a failure.
    """
    excess = abs(elbow_sine(U, a3, d3)) - 1
    if fails and 0 < excess <= ALLOWED:
        return None
    if excess > slack:
        return beyond
    pose = np.array(U, dtype=float)
    if excess > ALLOWED:  # the elbow is straight, or folded, as far as it goes
        pose[:3, 3] *= (a3 + d3 if elbow_sine(U, a3, d3) < 0 else abs(a3 - d3)) / np.linalg.norm(pose[:3, 3])
    if hand == "printed":  # The printed hand is turned over about X6, and t6 counts the other way.
        pose = pose @ ABOUT_X
    found = _solve(pose, a3, d3)
    if wrist == "from base":
        found = _solve_wrist_from_base(pose, found, a3, d3)
    if hand == "printed":
        found = [[*q[:5], -q[5]] for q in found]
    return [q for q in found if shoulder == "both" or _is_in_front(q, pose) == (shoulder == "front")]


def _is_in_front(q, pose: np.ndarray) -> bool:
    return pose[0, 3] * np.cos(q[0]) + pose[1, 3] * np.sin(q[0]) > 0


def _solve(pose: np.ndarray, a3: float, d3: float) -> Rows:
    return _rx90_postures(pose.tobytes(), a3, d3)


def _solve_wrist_from_base(pose: np.ndarray, found: Rows, a3: float, d3: float) -> Rows:
    """The wrist is solved for the orientation as it is given, instead of the one seen from the forearm."""
    wrong = []
    for arm in {tuple(q[:3]): None for q in found}:
        seen = pose.copy()
        seen[:3, :3] = rx90(a3, d3).forward([*arm, 0, 0, 0])[:3, :3] @ AT_REST.T @ seen[:3, :3]
        wrong += [q for q in _solve(seen, a3, d3) if np.allclose(q[:3], arm)]
    return wrong


def keep_wrist(sign: int):
    """A step: of the two wrists the one in which sin(t5) has this sign."""
    return lambda found: [q for q in found if sign * np.sin(q[4]) > 0]


def keep_elbow(sign: int):
    """A step: of the two elbows the one in which cos(t3) has this sign; a straight elbow stays."""
    return lambda found: [q for q in found if sign * np.cos(q[2]) > -1e-6]


def rx90_residual(q: np.ndarray, U, a3: float, d3: float) -> np.ndarray:
    """Distance plus angle of the hand from U, (k,), for joint values (k, 6)."""
    gap = rx90(a3, d3).forward(q) - np.array(U, dtype=float)
    return np.linalg.norm(gap[:, :3, 3], axis=-1) + np.linalg.norm(gap[:, :3, :3], axis=(-2, -1)) / np.sqrt(2)


def elbow_sine(U, a3: float, d3: float) -> float:
    """sin(t3) as the slides' equations give it, in floating point: beyond 1 by rounding on some limits."""
    px, py, pz = np.array(U, dtype=float)[:3, 3]
    return (a3 * a3 + d3 * d3 - px * px - py * py - pz * pz) / (2 * a3 * d3)


def draw_poses(rng: np.random.Generator) -> list[list]:
    """Argument lists (U, a3, d3): poses within reach, on the limits of the elbow, and out of reach."""
    found = []
    for a3, d3 in LENGTHS:
        found += [[_draw_within(rng, a3, d3), a3, d3] for _ in range(3)]
    # Binary fractions: on these limits the sine of t3 is exactly 1 or -1 however it is computed.
    exact = [(0.75, 0, 0), (0, -0.75, 0), (-0.45, 0, 0.6), (-0.25, 0, 0)]
    found += [[_draw_turned(rng, point), 0.5, 0.25] for point in exact] + [
        [_draw_turned(rng, (0, 1.0, 0)), 0.375, 0.625]
    ]
    found += [_draw_rounded_limit(rng) for _ in range(3)]
    found += [_draw_near_limit(rng, factor * ALLOWED) for factor in (0.1, 10)]
    beyond = [
        ((0.9, 0.3, 0.2), 0.45, 0.45),
        ((-0.1, 0.1, 0.1), 0.5, 0.25),
        ((0.0, 0.0, 0.2), 0.375, 0.625),
        ((2, -3, 1), 0.5, 0.25),
    ]
    found += [[_draw_turned(rng, point), a3, d3] for point, a3, d3 in beyond]
    return found


def _draw_turned(rng: np.random.Generator, point) -> list[list[float]]:
    """A pose at a point in any orientation."""
    pose = rx90(0.45, 0.45).forward(rng.uniform(-np.pi, np.pi, 6))
    pose[:3, 3] = point
    return pose.tolist()


def _draw_within(rng: np.random.Generator, a3: float, d3: float) -> list[list[float]]:
    """A pose clear of all singularities, in every arm posture."""
    while True:
        pose = rx90(a3, d3).forward(rng.uniform(-np.pi, np.pi, 6))
        found = np.array(_solve(pose, a3, d3))
        clear = np.hypot(*pose[:2, 3]) > 0.1 and abs(np.cos(found[:, 2])).min() > 0.2
        if clear and len(found) == 8 and abs(np.sin(found[:, 4])).min() > 0.15:
            return pose.tolist()


def _draw_rounded_limit(rng: np.random.Generator) -> list:
    """A pose at full reach whose sine of t3 comes out some rounding errors beyond -1."""
    while True:
        a3, d3 = LENGTHS[rng.integers(len(LENGTHS))]
        up, around = rng.uniform(-1, 1), rng.uniform(-np.pi, np.pi)
        point = (a3 + d3) * np.array([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)])
        pose = _draw_turned(rng, point)
        if elbow_sine(pose, a3, d3) < -1 - 4e-16:
            return [pose, a3, d3]


def _draw_near_limit(rng: np.random.Generator, excess: float) -> list:
    """A pose beside full reach, whose sine of t3 is `excess` beyond -1."""
    a3, d3 = LENGTHS[1]
    up, around = rng.uniform(-1, 1), rng.uniform(-np.pi, np.pi)
    r = np.sqrt(a3**2 + d3**2 + 2 * a3 * d3 * (1 + excess))
    point = r * np.array([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)])
    return [_draw_turned(rng, point), a3, d3]


ON_LIMIT, WITHIN, BEYOND = "poses on a limit of the elbow", "poses within reach", "poses out of reach"


def name_case(U, a3: float, d3: float) -> str:
    """The case a pose belongs to, in words."""
    sine = elbow_sine(U, a3, d3)
    if abs(abs(sine) - 1) < ALLOWED:
        return ON_LIMIT
    return WITHIN if abs(sine) < 1 else BEYOND
