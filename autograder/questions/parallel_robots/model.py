"""Planar parallel robots: the 3-RPR both ways, and a 3-RRR whose motors have stops."""

from __future__ import annotations

import numpy as np
import sympy

from dhkit.geometry import rotation_2d, unit_vector, wrap
from dhm.parallel import ThreeRPR, ThreeRRR

q1, q2, phi, c, L = sympy.symbols("q1 q2 phi c L")

BASE = ((0.0, 0.0), (1.0, 0.0), (0.3, 0.7))
PLATFORM = ((-0.3, -0.3), (0.4, -0.3), (0.2, 0.4))
ROBOT = ThreeRPR(BASE, PLATFORM)

STAND = ((0.0, 0.0), (1.0, 0.05), (0.45, 0.95))
PLATE = ((-0.2, -0.25), (0.25, -0.1), (0.05, 0.2))
BARS = ((0.40, 0.45), (0.45, 0.45), (0.45, 0.55))
"""Of each leg the driven bar and the outer one."""
TWO_BARS = ThreeRRR(STAND, PLATE, *zip(*BARS))

TURN = sympy.Matrix([[sympy.cos(phi), -sympy.sin(phi)], [sympy.sin(phi), sympy.cos(phi)]])
GAP = TURN * sympy.Matrix([c, 0]) - sympy.Matrix([L, 0])  # d of the platform side c and the base side L
GAP_SQUARED = sympy.simplify(GAP.dot(GAP))


def list_modes(mine) -> list[list[float]]:
    """All poses [x, y, phi] of the 3-RPR with the student's leg lengths."""
    return ROBOT.forward(own_lengths(mine)).listed().tolist()


def list_postures(mine, *, stops=True) -> list[list[float]]:
    """The joint values (6,) of the 3-RRR at the student's pose, drive and elbow of each leg in turn, between the stops or all."""
    found = TWO_BARS.inverse(own_pose(mine)).listed()
    allowed = (np.abs(wrap(found[:, ::2])) <= np.radians(mine.stop)).all(axis=1)
    return found[allowed | (not stops)].tolist()


def own_lengths(mine) -> list[float]:
    return [mine.q1, mine.q2, mine.q3]


def own_pose(mine) -> list[float]:
    return [mine.x, mine.y, mine.phi]


def leg_vectors(x, y, phi) -> np.ndarray:
    """From each anchor to its joint on the platform, (3, 2)."""
    return (x, y) + PLATFORM @ rotation_2d(phi).T - BASE


def leg_lengths(x, y, phi, *, turn=1, anchored=True) -> list[float]:
    """The three leg lengths at a pose.

    `turn` is a factor of phi; not `anchored`, lengths count from the origin of the base.
    """
    legs = leg_vectors(x, y, turn * phi)
    return np.linalg.norm(legs if anchored else legs + BASE, axis=1).tolist()


# ---------------------------------------------------------------- how far solutions are off


def mode_residual(q, mine) -> np.ndarray:
    """Largest error of a leg length, (k,), for poses (k, 3)."""
    with np.errstate(over="ignore"):
        return np.abs(ROBOT.inverse(q) - own_lengths(mine)).max(axis=1)


def posture_residual(q, mine) -> np.ndarray:
    """How far joint values (k, 6) are off, (k,): from end of leg to joint of the platform, and beyond the stops."""
    drive, elbow = q[:, ::2], q[:, 1::2]
    driven, outer = np.transpose(BARS)[:, :, None]
    ends = np.add(STAND, driven * unit_vector(drive) + outer * unit_vector(drive + elbow))
    px, py, turn = own_pose(mine)
    off = np.linalg.norm(ends - (px, py) - PLATE @ rotation_2d(turn).T, axis=-1).max(axis=1)
    beyond = np.abs(wrap(drive)).max(axis=1) - np.radians(mine.stop)
    return np.maximum(off, np.maximum(beyond, 0.0))


# ---------------------------------------------------------------- wrong steps


def move_to_joint_1(modes):
    """x, y of B1 in the place of P."""
    return [[*((px, py) + rotation_2d(turn) @ PLATFORM[0]).tolist(), turn] for px, py, turn in modes]


def count_elbows_from_x0(postures):
    """Each elbow angle measured from the x axis instead of the driven bar."""
    return [[value + (row[k - 1] if k % 2 else 0) for k, value in enumerate(row)] for row in postures]


def draw_poses(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists (x, y, phi): random poses, then round angles."""
    draws = [[*rng.uniform(0.2, 0.9, 2), rng.uniform(-3, 3)] for _ in range(8)]
    round_angles = [[0.5, 0.6, 0.0], [0.4, 0.7, np.pi / 2], [0.6, 0.5, np.pi], [0.55, 0.45, -np.pi / 2]]
    return [[float(value) for value in args] for args in draws + round_angles]
