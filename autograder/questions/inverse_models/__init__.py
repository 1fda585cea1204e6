"""Inverse models (MECA 953, EPFL and DH-m slides): elbow arm, PUMA-like shoulder, KR210, RX-90, counts, free directions."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Family, Question, mistake
from autograder.judge.misconceptions import (
    atan2_arguments_exchanged,
    atan_for_atan2,
    degrees,
    misprint,
    of_function,
    product,
)
from autograder.reference import robots

Rows = list[list[float]]

BACK_MISSING = (
    "**The postures over the back are missing.** Joint 1 may turn half round, and the arm then reaches the same point "
    "over its shoulder: a second value of the first joint."
)
ELBOW_MISSING = (
    "**The second elbow is missing.** A cosine, or a sine, alone does not tell the side to which the elbow is bent: look at the "
    "slide with the two postures of the planar arm."
)

# ---------------------------------------------------------------- the elbow arm (DH-m slides)

ELBOW = ("L1", "L2", "x", "y", "z")
t1, t2, t3 = sympy.symbols("t1:4")
HAND = sympy.Matrix(robots.ELBOW_3R.symbolic_forward()[:3, 3])
# Turning about axis 1 changes no volume, so t1 = 0 will do.
DETERMINANT = HAND.jacobian([t1, t2, t3]).subs(t1, 0).det()


@lru_cache(maxsize=256)
def elbow_arm(l1: float, l2: float) -> robots.Robot:
    return robots.elbow_3r(l1, l2)


def elbow_postures(mine) -> Rows:
    l1, l2, *target = (mine[name] for name in ELBOW)
    return elbow_arm(l1, l2).inverse(target).q.tolist()


def elbow_residual(q: np.ndarray, mine) -> np.ndarray:
    l1, l2, *target = (mine[name] for name in ELBOW)
    return np.linalg.norm(elbow_arm(l1, l2).forward(q)[:, :3, 3] - target, axis=-1)


def first_half(found: Rows) -> Rows:
    return found[: len(found) // 2]


def second_half(found: Rows) -> Rows:
    return found[len(found) // 2 :]


def joint_1_turned_only(found: Rows) -> Rows:
    """The postures over the back have the angles of those in front, t1 apart."""
    half = first_half(found)
    return half + [[row[0] + np.pi, *row[1:]] for row in half]


def one_elbow(*pairs: tuple[int, int]):
    """Of each pair of rows one: rows 0 and 1 are the two elbows in front, 2 and 3 those over the back."""
    return [lambda found, pair=pair: [found[i] for i in pair if i < len(found)] for pair in pairs]


# ---------------------------------------------------------------- how many

GENERAL = robots.RX90.forward([0.4, 0.9, -0.6, 0.5, 0.8, -0.3])[:3, :3]


def general_pose(*centre: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = GENERAL, centre
    return pose


def count(solutions) -> int:
    return -1 if solutions.status == "infinite" else len(solutions)


@lru_cache(maxsize=1)
def counts() -> tuple[int, ...]:
    """The six cases of the question, in its order; -1 for infinitely many."""
    return (
        count(robots.scara(a2=0.4, a3=0.3).inverse((0.3, 0.4, -0.1, 0.5))),
        count(robots.scara(a2=0.35, a3=0.35).inverse((0.0, 0.0, -0.1, 0.5))),
        count(robots.elbow_3r(0.5, 0.4).inverse((0.54, 0.0, 0.72))),
        count(robots.rx90().inverse(general_pose(0.35, 0.2, 0.4))),
        count(robots.epfl_arm().inverse(general_pose(0.15, 0.0, 0.5))),
        count(robots.kr210(grip=0.0).inverse(general_pose(2.6, 0.0, 0.75))),
    )


def with_counts(**changed: object):
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


def consistent_point(rng: np.random.Generator) -> dict[str, float]:
    """A sample point: Wx, Wy, d2 and A belong to one posture of the arm."""
    offset, q = rng.uniform(0.1, 0.3), rng.uniform(-np.pi, np.pi, 6)
    wx, wy = robots.puma(d2=offset, d6=0.0).forward(q)[:2, 3]
    return {"Wx": wx, "Wy": wy, "d2": offset, "A": wx * np.cos(q[0]) + wy * np.sin(q[0])}


# ---------------------------------------------------------------- the KR210 (MECA 953 slides)

KR210 = robots.kr210(grip=0.0)


def kr210_target(mine) -> list[float]:
    return [mine.Wx, mine.Wy, mine.Wz]


def arm_postures(robot: robots.Robot, centre) -> Rows:
    """All (q1, q2, q3) that bring the wrist centre to a point."""
    batch = robot.inverse_batch(general_pose(*centre)[None])
    return batch.q[0, ::2, :3][batch.valid[0, ::2]].tolist()


def kr210_centre(q) -> np.ndarray:
    """The wrist centre, (..., 3), for q1 to q3, (..., 3)."""
    q = np.asarray(q, float)
    return KR210.forward(np.concatenate([q, np.zeros_like(q)], axis=-1))[..., :3, 3]


def kr210_without(**lengths: float):
    """A step: the postures of a KR210 with a length forgotten, for the same wrist centre."""
    robot = robots.kr210(grip=0.0, **lengths)
    return lambda found: arm_postures(robot, kr210_centre(found[0]))


def offset_mirrored(found: Rows) -> Rows:
    """Over the back the offset a1 is counted as in front, so that the arm folds at q1 + pi as if it were a mirror image."""
    x, y, z = kr210_centre(found[0])
    r = np.hypot(x, y)
    nearer = (r - 2 * float(KR210.table.chain.a[1])) / r
    back = [row for row in arm_postures(KR210, (nearer * x, nearer * y, z)) if np.cos(row[0] - found[0][0]) < 0]
    return first_half(found) + back


# ---------------------------------------------------------------- the RX-90 (MECA 953 slides)

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


def rx90_postures(U, a3: float, d3: float) -> Rows:
    """All (t1, ..., t6) that bring the hand to U, (4, 4)."""
    return _rx90_postures(np.array(U, dtype=float).tobytes(), a3, d3)


def rx90_residual(q: np.ndarray, U, a3: float, d3: float) -> np.ndarray:
    gap = rx90(a3, d3).forward(q) - np.array(U, dtype=float)
    return np.linalg.norm(gap[:, :3, 3], axis=-1) + np.linalg.norm(gap[:, :3, :3], axis=(-2, -1)) / np.sqrt(2)


def elbow_sine(U, a3: float, d3: float) -> float:
    """sin(t3) as the slides' equations give it, in floating point: beyond 1 by rounding on some limits."""
    px, py, pz = np.array(U, dtype=float)[:3, 3]
    return (a3 * a3 + d3 * d3 - px * px - py * py - pz * pz) / (2 * a3 * d3)


def probes(rng: np.random.Generator) -> list[list]:
    """Poses within reach, on the limits of the elbow, and out of reach."""
    found = []
    for a3, d3 in LENGTHS:
        found += [[_pose_within(rng, a3, d3), a3, d3] for _ in range(3)]
    # Binary fractions: on these limits the sine of t3 is exactly 1 or -1 however it is computed.
    exact = [(0.75, 0, 0), (0, -0.75, 0), (-0.45, 0, 0.6), (-0.25, 0, 0)]
    found += [[_turned(rng, point), 0.5, 0.25] for point in exact] + [[_turned(rng, (0, 1.0, 0)), 0.375, 0.625]]
    found += [_rounded_outwards(rng) for _ in range(3)]
    beyond = [
        ((0.9, 0.3, 0.2), 0.45, 0.45),
        ((-0.1, 0.1, 0.1), 0.5, 0.25),
        ((0.0, 0.0, 0.2), 0.375, 0.625),
        ((2, -3, 1), 0.5, 0.25),
    ]
    found += [[_turned(rng, point), a3, d3] for point, a3, d3 in beyond]
    return found


def _turned(rng: np.random.Generator, point) -> list[list[float]]:
    """A pose at a point in any orientation."""
    pose = rx90(0.45, 0.45).forward(rng.uniform(-np.pi, np.pi, 6))
    pose[:3, 3] = point
    return pose.tolist()


def _pose_within(rng: np.random.Generator, a3: float, d3: float) -> list[list[float]]:
    """A pose clear of all singularities, in every arm posture."""
    while True:
        pose = rx90(a3, d3).forward(rng.uniform(-np.pi, np.pi, 6))
        found = np.array(rx90_postures(pose, a3, d3))
        clear = np.hypot(*pose[:2, 3]) > 0.1 and abs(np.cos(found[:, 2])).min() > 0.2
        if clear and len(found) == 8 and abs(np.sin(found[:, 4])).min() > 0.15:
            return pose.tolist()


def _rounded_outwards(rng: np.random.Generator) -> list:
    """A pose at full reach whose sine of t3 comes out some rounding errors beyond -1."""
    while True:
        a3, d3 = LENGTHS[rng.integers(len(LENGTHS))]
        up, around = rng.uniform(-1, 1), rng.uniform(-np.pi, np.pi)
        point = (a3 + d3) * np.array([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)])
        pose = _turned(rng, point)
        if elbow_sine(pose, a3, d3) < -1 - 4e-16:
            return [pose, a3, d3]


def where(U, a3: float, d3: float) -> str:
    """The case a pose belongs to."""
    sine = elbow_sine(U, a3, d3)
    if abs(abs(sine) - 1) < 1e-9:
        return "poses on a limit of the elbow"
    return "poses within reach" if abs(sine) < 1 else "poses out of reach"


def kept(condition):
    """A step: a function that finds only the postures for which `condition(q, U)` holds."""
    return lambda inverse: lambda U, a3, d3: [q for q in inverse(U, a3, d3) if condition(q, np.array(U, dtype=float))]


def in_front(q, U) -> bool:
    return U[0, 3] * np.cos(q[0]) + U[1, 3] * np.sin(q[0]) > 0


def printed_5t6(inverse):
    """The inverse model made with the 5T6 that the slides print: their hand is turned over about X6, and t6 counts the other way."""

    def answer(U, a3, d3):
        turned = np.array(U, dtype=float) @ ABOUT_X
        return [[*q[:5], -q[5]] for q in inverse(turned.tolist(), a3, d3)]

    return answer


def wrist_from_base(inverse):
    """The wrist is solved for the orientation as it is given, instead of the one seen from the forearm."""

    def answer(U, a3, d3):
        found = []
        for arm in {tuple(q[:3]): None for q in inverse(U, a3, d3)}:
            seen = np.array(U, dtype=float)
            seen[:3, :3] = rx90(a3, d3).forward([*arm, 0, 0, 0])[:3, :3] @ AT_REST.T @ seen[:3, :3]
            found += [q for q in rx90_postures(seen, a3, d3) if np.allclose(q[:3], arm)]
        return found

    return answer


def on_limits(elsewhere):
    """A step: on a limit where rounding pushes the sine of t3 beyond 1, `elsewhere` decides; None is a failure."""

    def lost(inverse):
        return lambda U, a3, d3: (
            elsewhere if abs(elbow_sine(U, a3, d3)) > 1 and where(U, a3, d3).endswith("elbow") else inverse(U, a3, d3)
        )

    return lost


def fails_out_of_reach(inverse):
    return lambda U, a3, d3: None if where(U, a3, d3) == "poses out of reach" else inverse(U, a3, d3)


def fails_on_limit_and_beyond(inverse):
    return on_limits(None)(fails_out_of_reach(inverse))


# ---------------------------------------------------------------- the aligned wrist


def total(mine) -> float:
    """t4 + t6, from the pose that the notebook builds of the student's own numbers."""
    U, arm = aligned_pose(mine)
    forearm = robots.RX90.forward([*arm, 0, 0, 0])[:3, :3]
    seen = forearm.T @ U[:3, :3]
    return float(np.arctan2(seen[1, 0], seen[0, 0]))


def aligned_pose(mine) -> tuple[np.ndarray, list[float]]:
    """Hand along the forearm, its X axis `roll` above the horizontal; the arm's t1, t2, t3."""
    arm, roll = [mine.t1, mine.t2, mine.t3], mine.roll
    U = robots.RX90.forward([*arm, 0, 0, 0])
    approach = U[:3, 2]
    level = np.cross([0, 0, 1], approach) / np.linalg.norm(np.cross([0, 0, 1], approach))
    x_axis = np.cos(roll) * level + np.sin(roll) * np.cross(approach, level)
    U[:3, :3] = np.column_stack([x_axis, np.cross(approach, x_axis), approach])
    return U, arm


def aligned_residual(q: np.ndarray, mine) -> np.ndarray:
    U, arm = aligned_pose(mine)
    joints = np.concatenate([np.broadcast_to(arm, (len(q), 3)), q], axis=1)
    return rx90_residual(joints, U, 0.45, 0.45)


def representatives(change):
    """Steps to a single wrong representative: with t4 = 0, with t6 = 0, with both equal. `change` makes the sum wrong."""

    def step(share):
        return lambda found: [[share * change(found[0]), 0.0, (1 - share) * change(found[0])]]

    return [step(share) for share in (0.0, 1.0, 0.5)]


def the_sum(row) -> float:
    return row[0] + row[2]


QUESTIONS = (
    Question(
        "inverse_models.elbow",
        reference=elbow_postures,
        mistakes=(
            mistake("over_the_back_missing", 0.5, BACK_MISSING, first_half, second_half),
            mistake("one_elbow_missing", 0.5, ELBOW_MISSING, *one_elbow((0, 2), (1, 3), (0, 3), (1, 2))),
            mistake(
                "joint_1_turned_only",
                0.5,
                "**Over the back only t1 was changed.** In the turned plane the target lies behind the arm: A changes its sign, and t2 "
                "and t3 follow. Put your third solution into the direct model.",
                joint_1_turned_only,
            ),
            degrees(0, 1, 2),
        ),
        angles=(0, 1, 2),
        tolerance=1e-3,
        residual=elbow_residual,
    ),
    Question(
        "inverse_models.counts",
        reference=lambda: list(counts()),
        mistakes=(
            mistake(
                "wrist_not_counted",
                0.6,
                "**These are the postures of the arm alone.** The slide stops at shoulder and elbow and asks for the wrist: it doubles "
                "the number.",
                with_counts(d=lambda n: n // 2, f=lambda n: n // 2),
                with_counts(d=lambda n: n // 2),
            ),
            mistake(
                "inner_cylinder_forgotten",
                0.7,
                "**Case e: this point is too near to axis 1.** The arm swings in a plane beside the axis. How near can its wrist centre come?",
                with_counts(e=8),
                with_counts(e=4),
            ),
            mistake(
                "back_always_in_reach",
                0.7,
                "**Case f: over its back this robot does not reach as far.** Its shoulder stands in front of axis 1.",
                with_counts(f=lambda n: 2 * n),
            ),
            mistake(
                "limit_counted_twice",
                0.7,
                "**Case c: on the limit of reach two postures are one.** Compute the distance of the target from axis 2.",
                with_counts(c=lambda n: 2 * n),
                with_counts(c=1),
            ),
            mistake(
                "infinitely_many_missed",
                0.7,
                "**Case b: fold the arm and turn joint 1.** What does the hand do, and what can joint 4 do about it?",
                *(with_counts(b=n) for n in (1, 2, 0)),
            ),
        ),
        partial=0.6,
    ),
    Question(
        "inverse_models.repaired",
        reference=ROW_6,
        mistakes=(
            misprint(
                [6, 0, 0, 0, sympy.Symbol("d6"), sympy.Symbol("t6")],
                "this row belongs to a classic table. In the modified convention it puts axis 6 on axis 5.",
            ),
            mistake(
                "sign_of_alpha",
                0.6,
                "**The sign of alpha is turned.** With it the hand points back into the forearm at t5 = 0.",
                lambda row: [*row[:3], -row[3], *row[4:]],
            ),
            mistake(
                "degrees",
                0.7,
                "**alpha is in degrees.** The question counts in radians: a quarter turn is pi/2.",
                lambda row: [*row[:3], row[3] * 180 / sympy.pi, *row[4:]],
            ),
            mistake(
                "row_number",
                0.8,
                "**The row is repaired, but it is not the row of this number.** Rows are counted from 1, as on the slide.",
                lambda row: [5, *row[1:]],
            ),
        ),
    ),
    Question(
        "inverse_models.shoulder",
        reference=DIRECTION - SIDE,
        mistakes=(
            mistake(
                "sine_loses_the_back",
                0.5,
                "**Right in front, wrong over the back.** An arcsine, or the square root of a distance, forgets the sign of A. Let atan2 see A itself.",
                lambda angle: angle + SIDE - sympy.asin(d2 / sympy.sqrt(Wx**2 + Wy**2)),
                lambda angle: angle + SIDE - sympy.acos(sympy.Abs(A) / sympy.sqrt(Wx**2 + Wy**2)),
            ),
            atan_for_atan2(2),
            atan2_arguments_exchanged(2),
            mistake(
                "sign_of_second_angle",
                0.5,
                "**The angle of the offset has the wrong sign.** Seen along t1 the wrist centre lies to the left, by d2: on which side of the "
                "line to it does the direction t1 lie?",
                lambda angle: angle + 2 * SIDE,
            ),
            mistake(
                "offset_not_considered",
                0.3,
                "**This is the direction of the wrist centre.** The plane of the arm passes beside axis 1, by d2, as the view from above shows.",
                lambda angle: angle + SIDE,
            ),
        ),
        angles=(0,),
        draw=consistent_point,
    ),
    Question(
        "inverse_models.kr210",
        reference=lambda mine: arm_postures(KR210, kr210_target(mine)),
        mistakes=(
            mistake("over_the_back_missing", 0.5, BACK_MISSING, first_half, second_half),
            mistake("one_elbow_missing", 0.5, ELBOW_MISSING, *one_elbow((0, 2), (1, 3), (0, 3), (1, 2))),
            mistake(
                "offset_at_the_back",
                0.6,
                "**In front your postures are right, over the back they miss.** Joint 1 carries axis 2 round with it: there it stands on the far "
                "side of axis 1. Is the wrist centre nearer to it then, or further away?",
                offset_mirrored,
            ),
            mistake(
                "shoulder_offset_forgotten",
                0.4,
                "**The 0.35 m between axes 1 and 2 are missing.** See row 2 of the table: the arm does not begin on axis 1.",
                kr210_without(a1=0.0),
            ),
            mistake(
                "forearm_offset_forgotten",
                0.5,
                "**The forearm is taken for straight.** Row 4 carries a3 = -0.054 beside d4 = 1.5: axis 4 passes beside the elbow.",
                kr210_without(a3=0.0),
            ),
            mistake(
                "joint_offset_forgotten",
                0.6,
                "**q2 is a quarter turn off.** Row 2 of the table turns by q2 - 90 degrees: at q2 = 0 the upper arm stands upright.",
                lambda found: [[q1, q2 - np.pi / 2, q3] for q1, q2, q3 in found],
            ),
            degrees(0, 1, 2),
        ),
        angles=(0, 1, 2),
        tolerance=1e-3,
        residual=lambda q, mine: np.linalg.norm(kr210_centre(q) - kr210_target(mine), axis=-1),
    ),
    Question(
        "inverse_models.determinant",
        reference=DETERMINANT,
        mistakes=(
            mistake(
                "shoulder_factor_missing",
                0.4,
                "**This is the determinant of the planar arm.** Joint 1 is missing: how fast does it move the hand, and where does it not "
                "move it at all?",
                *(
                    lambda _, sign=sign: sign * sympy.Symbol("L1") * sympy.Symbol("L2") * sympy.sin(t3)
                    for sign in (1, -1)
                ),
            ),
            mistake(
                "sign_of_the_determinant",
                0.7,
                "**The sign is turned.** Two rows or two columns are exchanged: x, y, z from top to bottom, t1, t2, t3 from left to right.",
                lambda determinant: -determinant,
            ),
            mistake(
                "angle_not_summed",
                0.4,
                "**The elevation of the forearm is t2 + t3.** t3 counts from the upper arm, as in the planar arm.",
                lambda _: HAND.subs(t2 + t3, t3).jacobian([t1, t2, t3]).subs(t1, 0).det(),
            ),
        ),
    ),
    Question(
        "inverse_models.rx90",
        reference=rx90_postures,
        mistakes=(
            mistake(
                "wrist_flip_missing",
                0.5,
                "**The flipped wrist is missing.** t5 comes from a square root: with its other sign t4 and t6 turn half round, and the hand is "
                "the same.",
                kept(lambda q, U: np.sin(q[4]) > 0),
                kept(lambda q, U: np.sin(q[4]) < 0),
            ),
            mistake(
                "over_the_back_missing",
                0.5,
                BACK_MISSING,
                kept(in_front),
                kept(lambda q, U: not in_front(q, U)),
            ),
            mistake(
                "one_elbow_missing",
                0.5,
                ELBOW_MISSING,
                kept(lambda q, U: np.cos(q[2]) > -1e-6),
                kept(lambda q, U: np.cos(q[2]) < 1e-6),
            ),
            misprint(
                printed_5t6,
                "the matrix 5T6 has the signs of alpha5 = +pi/2, and the table says -pi/2. Compare it with row 6, and put one of your solutions "
                "into the direct model.",
                share=0.6,
            ),
            mistake(
                "orientation_seen_from_base",
                0.4,
                "**The arm is right, the wrist is not: it was solved for the orientation seen from the base.** The wrist stands on a forearm that is "
                "turned itself. See the slide with R(base)^-1.",
                wrist_from_base,
            ),
            mistake(
                "unclipped_limit",
                0.7,
                "**On a limit your function fails.** Rounding pushes the sine of t3 a hair beyond 1, where arcsin and sqrt have no value: clip first.",
                fails_on_limit_and_beyond,
                on_limits(None),
            ),
            mistake(
                "limit_taken_for_out_of_reach",
                0.8,
                "**Some poses on the limit come back without a solution.** Rounding pushes the sine of t3 a hair beyond 1: leave a small tolerance "
                "before you say that a pose is out of reach.",
                on_limits(()),
            ),
            mistake(
                "out_of_reach_fails",
                0.7,
                "**Out of reach your function fails instead of returning an empty list.** Test the sine of t3 first.",
                fails_out_of_reach,
            ),
            of_function(degrees(0, 1, 2, 3, 4, 5)),
        ),
        partial=0.4,
        angles=(0, 1, 2, 3, 4, 5),
        tolerance=1e-4,
        probe=probes,
        case=where,
        residual=rx90_residual,
    ),
    Question(
        "inverse_models.aligned",
        reference=lambda mine: Family([[0.0, 0.0, total(mine)]]),
        mistakes=(
            mistake(
                "sign_of_the_sum",
                0.5,
                "**The sum t4 + t6 has the wrong sign.** Which of the two entries of 3R6 carries the minus?",
                *representatives(lambda row: -the_sum(row)),
            ),
            mistake(
                "sum_half_a_turn_off",
                0.5,
                "**The sum t4 + t6 is half a turn off.** Check both arguments of your atan2, and put the solution into the direct model.",
                *representatives(lambda row: the_sum(row) + np.pi),
            ),
            mistake(
                "degrees",
                0.4,
                degrees().feedback,
                *representatives(lambda row: np.degrees(the_sum(row))),
                turn=360,
            ),
        ),
        angles=(0, 1, 2),
        tolerance=1e-3,
        residual=aligned_residual,
    ),
    Question(
        "inverse_models.free",
        reference=[0, 0, 0, 1, 0, -1],
        mistakes=(
            mistake(
                "turned_the_same_way",
                0.3,
                "**Both joints turn the same way: so does the hand.** The sum of the two angles must stay as it is.",
                lambda _: [0, 0, 0, 1, 0, 1],
            ),
            mistake(
                "one_joint_alone",
                0.3,
                "**One joint alone turns the hand.** Which other joint turns about the same line and can undo it?",
                *(lambda _, joint=joint: [float(joint == i) for i in range(6)] for joint in (3, 5)),
            ),
            mistake(
                "joint_5_is_not_free",
                0.1,
                "**Joint 5 tilts the hand.** It is the value t5 = 0 that is special, not the motion of joint 5.",
                lambda _: [0, 0, 0, 0, 1, 0],
            ),
        ),
    ),
)
