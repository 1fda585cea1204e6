"""Planar parallel robots: the 3-RPR both ways, its Jacobian and a singular pose, the 3-RRR."""

from __future__ import annotations

import numpy as np
import sympy

from dhkit.geometry import rotation_2d, unit_vector
from dhm.parallel import ThreeRPR, ThreeRRR

x, y, phi, u, v, q1, q2, c, L = sympy.symbols("x y phi u v q1 q2 c L")

BASE = ((0.0, 0.0), (1.0, 0.0), (0.3, 0.7))
PLATFORM = ((-0.3, -0.3), (0.4, -0.3), (0.2, 0.4))
BARS = (0.4, 0.35)
ROBOT = ThreeRPR(BASE, PLATFORM)
TWO_BARS = ThreeRRR(BASE, PLATFORM, BARS[:1] * 3, BARS[1:] * 3)

TURN = sympy.Matrix([[sympy.cos(phi), -sympy.sin(phi)], [sympy.sin(phi), sympy.cos(phi)]])
JOINT = list(sympy.Matrix([x, y]) + TURN * sympy.Matrix([u, v]))
GAP = TURN * sympy.Matrix([c, 0]) - sympy.Matrix([L, 0])  # d of the platform side c and the base side L
GAP_SQUARED = sympy.simplify(GAP.dot(GAP))
MOVED_BEFORE_TURNED = list(TURN * sympy.Matrix([x + u, y + v]))

HEIGHT = 0.7  # of P in the question about the singular pose, phi = 0


def list_modes(mine) -> list[list[float]]:
    """All poses [x, y, phi] of the 3-RPR with the student's leg lengths."""
    return ROBOT.forward(own_lengths(mine)).listed().tolist()


def list_postures(mine) -> list[list[float]]:
    """All joint values (6,) of the 3-RRR at the student's pose, drive and elbow of each leg in turn."""
    return TWO_BARS.inverse(own_pose(mine)).listed().tolist()


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


def jacobian(x, y, phi, *, unit=True, turned=True, centre="P") -> list[list[float]]:
    """The Jacobian of the leg lengths, (3, 3).

    Not `unit`, its rows are not divided by the lengths. The arms may be left un-`turned`, or be counted from the
    ``"origin"`` of the base.
    """
    rows = ROBOT.jacobian([x, y, phi])
    ux, uy = rows[:, 0], rows[:, 1]
    if not turned:
        bx, by = np.transpose(PLATFORM)
        rows[:, 2] = bx * uy - by * ux
    if centre == "origin":
        rows[:, 2] += x * uy - y * ux
    return (rows if unit else rows * np.array(leg_lengths(x, y, phi))[:, None]).tolist()


def find_singular_x() -> float:
    """x of P for phi = 0, y = `HEIGHT`, between 0 and 1, by halving the interval."""
    low, high = 0.0, 1.0
    sign = np.sign(np.linalg.det(jacobian(low, HEIGHT, 0.0)))
    for _ in range(60):
        middle = (low + high) / 2
        inside = np.sign(np.linalg.det(jacobian(middle, HEIGHT, 0.0))) == sign
        low, high = (middle, high) if inside else (low, middle)
    return low


SINGULAR_X = find_singular_x()


def find_meeting_x() -> float:
    """x of the point where the leg lines of that pose meet."""
    first, second = (np.subtract((SINGULAR_X, HEIGHT), a) + b for a, b in list(zip(BASE, PLATFORM))[:2])
    along, _ = np.linalg.solve(np.column_stack([first, -second]), np.subtract(BASE[1], BASE[0]))
    return float(along * first[0])


MEETING_X = find_meeting_x()

# ---------------------------------------------------------------- how far solutions are off


def mode_residual(q, mine) -> np.ndarray:
    """Largest error of a leg length, (k,), for poses (k, 3)."""
    with np.errstate(over="ignore"):
        return np.abs(ROBOT.inverse(q) - own_lengths(mine)).max(axis=1)


def posture_residual(q, mine) -> np.ndarray:
    """Largest distance from the end of a leg to its joint on the platform, (k,), for joint values (k, 6)."""
    drive, elbow = q[:, ::2], q[:, 1::2]
    ends = np.add(BASE, BARS[0] * unit_vector(drive) + BARS[1] * unit_vector(drive + elbow))
    px, py, turn = own_pose(mine)
    return np.linalg.norm(ends - (px, py) - PLATFORM @ rotation_2d(turn).T, axis=-1).max(axis=1)


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
