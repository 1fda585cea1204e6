"""Orientation: rotation matrices of Euler sets, roll-pitch-yaw, wrists by their letters, gimbal lock."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Family
from dhkit.geometry import rotation_angle_between
from dhm.orientation import euler_matrix
from dhm.transforms import rot_x, rot_y, rot_z

phi, theta, psi, e = sympy.symbols("phi theta psi e")
R = sympy.Matrix(3, 3, lambda i, j: sympy.Symbol(f"r{i + 1}{j + 1}"))
TRANSPOSED = {R[i, j]: R[j, i] for i in range(3) for j in range(3)}
ELEMENTARY = {"x": rot_x, "y": rot_y, "z": rot_z}


def turns(axes: str, *angles) -> sympy.Matrix:
    """Rotation of three angles about moving axes, (3, 3)."""
    first, second, third = (ELEMENTARY[axis](angle)[:3, :3] for axis, angle in zip(axes, angles))
    return first * second * third


# ---------------------------------------------------------------- roll, pitch, yaw

RPY = turns("zyx", psi, theta, phi)
ENTRIES = [RPY[1, 1], RPY[1, 2]]
REVERSED_RPY = turns("xyz", phi, theta, psi)
GYROSCOPE = turns("zxz", psi, theta, phi)
XYZ, ZYZ = turns("xyz", psi, theta, phi), turns("zyz", psi, theta, phi)

# ---------------------------------------------------------------- any wrist, by its letters


def wrist_angles(axes: str) -> list:
    """[first, middle, third] for a set of moving axes, in the entries of R and the sign e of the root."""
    i, j, k = ("xyz".index(axis) for axis in axes)
    m = 3 - i - j
    s = 1 if (j - i) % 3 == 1 else -1
    if i == k:
        root = sympy.sqrt(R[j, i] ** 2 + R[m, i] ** 2)
        return [
            sympy.atan2(e * R[j, i], -s * e * R[m, i]),
            sympy.atan2(e * root, R[i, i]),
            sympy.atan2(e * R[i, j], s * e * R[i, m]),
        ]
    root = sympy.sqrt(R[j, k] ** 2 + R[k, k] ** 2)
    return [
        sympy.atan2(-s * e * R[j, k], e * R[k, k]),
        sympy.atan2(s * R[i, k], e * root),
        sympy.atan2(-s * e * R[i, j], e * R[i, i]),
    ]


def draw_rotation_and_sign(rng: np.random.Generator) -> dict[str, float]:
    """A sample point: the entries of a rotation, far from the locks of every set, and a sign."""
    while True:
        matrix = euler_matrix(rng.uniform(-np.pi, np.pi, 3), "zyx", intrinsic=True)
        if np.abs(matrix).max() < 0.95:
            break
    found = {f"r{i + 1}{j + 1}": matrix[i, j] for i in range(3) for j in range(3)}
    return found | {"e": rng.choice([-1.0, 1.0])}


def change_atan2(about, *places: int):
    """A step: the mistake about atan2, made in the entries at `places`."""

    def step(answer):
        return [about.steps[0](entry) if place in places else entry for place, entry in enumerate(answer)]

    return step


OUTER, ALL = (0, 2), (0, 1, 2)

# ---------------------------------------------------------------- the spherical wrist as a function


AT_LOCK = 1e-9  # sin(t5), as the statement says


def zyz(rows, *, lock=AT_LOCK):
    """All [t4, t5, t6] for a rotation (3, 3); a `Family` where sin(t5) is below `lock`."""
    matrix = np.array(rows, dtype=float)
    if np.hypot(matrix[0, 2], matrix[1, 2]) > lock:
        return _solve_in_general(matrix)
    # What is left at the lock: the sum of t4 and t6 for the stretched wrist, their difference for the folded one.
    if matrix[2, 2] > 0:
        total = float(np.arctan2(matrix[1, 0] - matrix[0, 1], matrix[0, 0] + matrix[1, 1]))
        return Family([[0.0, 0.0, total], [total, 0.0, 0.0]])
    total = float(np.arctan2(matrix[1, 0] + matrix[0, 1], matrix[1, 1] - matrix[0, 0]))
    return Family([[0.0, np.pi, total], [-total, np.pi, 0.0]])


def _solve_in_general(matrix) -> list[list[float]]:
    """The general formulas, at the lock too."""
    found = []
    for sign in (1, -1):
        root = sign * np.hypot(matrix[0, 2], matrix[1, 2])
        t4, t6 = (
            np.arctan2(sign * matrix[1, 2], sign * matrix[0, 2]),
            np.arctan2(sign * matrix[2, 1], -sign * matrix[2, 0]),
        )
        found.append([t4, np.arctan2(root, matrix[2, 2]), t6])
    return found


def zyz_residual(q, rows) -> np.ndarray:
    """Angle between the rotations of triples (k, 3) and a rotation (3, 3), (k,)."""
    return rotation_angle_between(euler_matrix(q, "zyz", intrinsic=True), np.array(rows))


def draw_rotations(rng: np.random.Generator) -> list[list]:
    """Argument lists: rotations of the wrist: bent both ways, by round angles, stretched and folded back. Zeros are clean zeros."""
    bent = [
        [*rng.uniform(-3, 3, 1), sign * rng.uniform(0.1, 3.0), *rng.uniform(-3, 3, 1)]
        for sign in (1, -1)
        for _ in range(4)
    ]
    quarter = np.pi / 2
    bent += [[0, quarter, 0], [quarter, quarter, -quarter], [np.pi, quarter, quarter], [0.7, -quarter, 0.0]]
    stretched = [[0, 0, 0], [0.4, 0, 0.9], [2.0, 0, 2.5], [quarter, 0, quarter]]
    folded = [[0, np.pi, 0], [0.4, np.pi, 0.9], [-2.0, np.pi, 1.1]]
    matrices = np.round(euler_matrix(bent + stretched + folded, "zyz", intrinsic=True), 12) + 0.0
    # A tenth of a degree beside both locks; then ten times, and a tenth of, what the statement takes for a lock.
    beside = [np.radians(0.1), np.pi - np.radians(0.1), 10 * AT_LOCK, AT_LOCK / 10]
    nearly = euler_matrix([[0.8, angle, -2.0] for angle in beside], "zyz", intrinsic=True)
    return [[matrix.tolist()] for matrix in (*matrices, *nearly)]


def name_bend(rows) -> str:
    """The case a rotation belongs to, in words."""
    bend = np.hypot(rows[0][2], rows[1][2])
    if bend > AT_LOCK:
        return "a bent wrist" if bend > 0.01 else "a wrist that is nearly stretched, or nearly folded back"
    return "the stretched wrist (t5 = 0)" if rows[2][2] > 0 else "the wrist folded back (t5 = pi)"


def keep_one_of_bent(which: int):
    """A step: one of the two triples of a bent wrist; at the lock all that are there."""
    return lambda found: [found[which]] if abs(np.sin(found[0][1])) > 1e-9 else found


def change_t5_only(found):
    """The second triple of a bent wrist has another sign of t5, and t4 and t6 of the first one."""
    if len(found) < 2 or abs(np.sin(found[0][1])) < 1e-9:
        return found
    (t4, t5, t6), _ = found
    return [[t4, t5, t6], [t4, -t5, t6]]
