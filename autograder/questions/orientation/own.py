"""The student's own controller, camera and wrist, and a function with three faults that reads angles from a matrix."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy

from dhkit.attitudes import CAMERAS, CONTROLLERS, hinges
from dhkit.geometry import rotation_angle_between
from dhm.orientation import EULER_SETS, euler_matrix, rpy, rpy_matrix

from .model import AT_LOCK, e, wrist_angles

# ---------------------------------------------------------------- controllers


@dataclass(frozen=True)
class Convention:
    """How a controller counts its three angles A, B, C: the axes in this order, and whose they are."""

    axes: str
    moving: bool

    def matrix(self, angles) -> np.ndarray:
        """The rotation, (3, 3), of three angles in radians."""
        return euler_matrix(angles, self.axes, intrinsic=self.moving)


CONVENTIONS = dict(
    zip(
        CONTROLLERS,
        (
            Convention("xyz", True),
            Convention("zxy", False),
            Convention("yzy", True),
            Convention("xzy", False),
            Convention("zxz", False),
            Convention("yzx", True),
            Convention("xyx", True),
            Convention("zyz", False),
        ),
        strict=True,
    )
)
READINGS = tuple(Convention(axes, moving) for axes in EULER_SETS for moving in (True, False))
LECTURES_RPY, LECTURES_RPY_FIXED, LECTURES_WRIST = (
    Convention("zyx", True),
    Convention("xyz", False),
    Convention("zyz", True),
)


def shown(controller: str) -> list[list[int]]:
    """The numbers of a controller's two poses, in degrees."""
    place = CONTROLLERS.index(controller)
    return [[35 + 3 * place, 50 - 4 * place, -70 + 5 * place], [-115 + 4 * place, 25 + 3 * place, 48 - 7 * place]]


def tool_axes(A, B, C, *, mine, reading: Convention | str = "own", unit="degrees") -> list[list[float]]:
    """The tool's orientation, rows of (3, 3), by the numbers of the student's controller.

    `reading` may be another convention, or ``"other frames"``: fixed axes for moving ones, or the reverse; `unit` may be
    ``"radians"``.
    """
    own = CONVENTIONS[mine.controller]
    if reading == "other frames":
        reading = Convention(own.axes, not own.moving)
    elif reading == "own":
        reading = own
    angles = np.array([A, B, C], dtype=float)
    return reading.matrix(np.radians(angles) if unit == "degrees" else angles).tolist()


def draw_numbers(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists (A, B, C) in degrees, round ones and others."""
    general = [[float(round(value, 2)) for value in rng.uniform(-170, 170, 3)] for _ in range(6)]
    return [*general, [90.0, 0.0, 0.0], [0.0, 90.0, 0.0], [0.0, 0.0, -90.0], [180.0, 30.0, 90.0]]


# ---------------------------------------------------------------- cameras


@dataclass(frozen=True)
class Mount:
    """How a camera hangs under a drone, and how the drone flies.

    Attributes
    ----------
    hangs : str
        In words.
    ahead : tuple of int
        Where the camera would look if it were not tilted, in the drone's frame: x ahead, y to the left, z up.
    tilt : int
        By how much it looks below that, in degrees.
    top : tuple of int
        Where the top of the picture would be without the tilt.
    flies : tuple of int
        Roll, pitch and yaw of the drone, in degrees.
    """

    hangs: str
    ahead: tuple[int, int, int]
    tilt: int
    top: tuple[int, int, int]
    flies: tuple[int, int, int]

    @property
    def camera(self) -> np.ndarray:
        """The camera's axes in the drone's frame, (3, 3): x to the right in the picture, y down in it, z the view."""
        angle, ahead, top = np.radians(self.tilt), np.array(self.ahead), np.array(self.top)
        down = np.array((0, 0, -1))
        view = np.cos(angle) * ahead + np.sin(angle) * down
        upwards = np.cos(angle) * top + np.sin(angle) * (top @ -down) * ahead
        return np.column_stack([np.cross(-upwards, view), -upwards, view])

    @property
    def drone(self) -> np.ndarray:
        """The drone's axes in the world, (3, 3)."""
        return rpy_matrix(*np.radians(self.flies))


_AHEAD, _BACK, _LEFT, _RIGHT, _UP, _DOWN = (
    (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1),
)  # fmt: skip
MOUNTS = dict(
    zip(
        CAMERAS,
        (
            Mount("looks ahead, 25° below the horizon, and hangs the right way up", _AHEAD, 25, _UP, (8, -13, 37)),
            Mount("looks ahead, 35° below the horizon, and hangs upside down", _AHEAD, 35, _DOWN, (-11, 17, 64)),
            Mount("looks to the left, 20° below the horizon, and hangs the right way up", _LEFT, 20, _UP, (14, 9, -9)),
            Mount("looks to the right, level, and hangs upside down", _RIGHT, 0, _DOWN, (-7, -19, 167)),
            Mount("looks back, 40° below the horizon, and hangs the right way up", _BACK, 40, _UP, (16, 12, -158)),
            Mount("looks to the right, 50° below the horizon, and hangs upside down", _RIGHT, 50, _DOWN, (9, 21, -117)),
            Mount("looks to the left, 45° below the horizon, and hangs the right way up", _LEFT, 45, _UP, (-18, 7, 18)),
            Mount("looks back, 15° below the horizon, and hangs upside down", _BACK, 15, _DOWN, (13, -22, 49)),
        ),
        strict=True,
    )
)
UPSIDE_DOWN = np.diag([-1, -1, 1])
"""The camera turned by half a turn about its view."""


def drone(mine, *, mount="taken off", side="right", way_up="own") -> np.ndarray:
    """The orientation of the student's drone, (3, 3), as it follows from that of its camera.

    `mount` may be ``"ignored"`` or ``"put on again"``, `side` ``"left"``, `way_up` the ``"other"`` one.
    """
    own = MOUNTS[mine.camera]
    in_flight = own.drone @ own.camera
    camera = own.camera if way_up == "own" else own.camera @ UPSIDE_DOWN
    step = {"taken off": camera.T, "put on again": camera, "ignored": np.eye(3)}[mount]
    return in_flight @ step if side == "right" else step @ in_flight


def list_rpy(mine, *, mount="taken off", side="right", way_up="own") -> list[list[float]]:
    """Both [roll, pitch, yaw] of the student's drone; keywords as for `drone`."""
    return rpy(drone(mine, mount=mount, side=side, way_up=way_up)).angles.tolist()


def rpy_residual(q, mine) -> np.ndarray:
    """Angle between the rotations of triples (k, 3) and the student's drone, (k,)."""
    return rotation_angle_between(rpy_matrix(*q.T), drone(mine))


def change_pitch_only(found):
    """As printed: the second triple has another pitch, and roll and yaw of the first one."""
    first = found[0]
    return [first, [first[0], np.pi - first[1], first[2]]]


# ---------------------------------------------------------------- wrists


def own_hinges(mine, hinges="own") -> list:
    """[first, middle, third] of the student's wrist, of one with its axes all ``"straight"``, or of another one."""
    return hinge_angles({"own": mine.wrist, "straight": straight(mine.wrist)}.get(hinges, hinges))


def hinge_angles(wrist: str) -> list:
    """[first, middle, third] of a wrist by its hinges, in the entries of R and the sign e of the root."""
    axes, senses = hinges(wrist)
    angles = wrist_angles(axes)
    if senses[1] < 0 and axes[0] == axes[2]:  # the root stands with the sign e in the joint's own angle
        angles = [angle.subs(e, -e) for angle in angles]
    return [angle if sense > 0 else _negated(angle) for angle, sense in zip(angles, senses)]


def _negated(angle) -> sympy.Expr:
    ordinate, abscissa = angle.args
    return sympy.atan2(-ordinate, abscissa)


def straight(wrist: str) -> str:
    """The same wrist with every hinge in the positive sense of its axis."""
    return ", ".join(hinges(wrist)[0])


def lock_of(axes: str) -> float:
    """The middle angle at the lock that the question takes, in radians."""
    return 0.0 if axes[0] == axes[2] else np.pi / 2


def locked(rows, *, mine, combination="own", quotient="atan2") -> list[float]:
    """[k, angle] with first + k third = angle, where the student's wrist is locked at the orientation (3, 3).

    `combination` may be the ``"other"`` one; `quotient` may be ``"atan"``.
    """
    matrix = np.array(rows, dtype=float)
    axes, (first, middle, third) = hinges(mine.wrist)
    i, j, k = ("xyz".index(axis) for axis in axes)
    m = 3 - i - j
    handed = 1 if (j - i) % 3 == 1 else -1
    # Behind the lock the third axis lies along the first one, or against it.
    along = 1 if i == k else handed * middle
    sine, cosine = handed * matrix[m, j], matrix[j, j]
    angle = np.arctan2(sine, cosine) if quotient == "atan2" else np.arctan(sine / cosine)
    sense = first * third * along
    return [sense if combination == "own" else -sense, float(first * angle)]


def draw_locked(rng: np.random.Generator, mine) -> list[list]:
    """Argument lists: orientations at which the student's wrist is locked, in all four quadrants, round ones too."""
    axes, senses = hinges(mine.wrist)
    outer = [*rng.uniform(-3, 3, (8, 2)), (0.0, 0.0), (np.pi, 0.0), (0.0, np.pi)]
    angles = [np.multiply(senses, (first, lock_of(axes), third)) for first, third in outer]
    return [[(np.round(euler_matrix(one, axes, intrinsic=True), 12) + 0.0).tolist()] for one in angles]


# ---------------------------------------------------------------- pan, tilt, roll: three faults

PAN_TILT_ROLL = "zxy"


def pan_tilt_roll(rows, *, pan="right", lock=AT_LOCK, down="right") -> list[float]:
    """[pan, tilt, roll] about moving z, x, y for an orientation (3, 3).

    The camera is taken for locked where the cosine of the tilt is below `lock`. As the function was found, this is much too soon,
    `pan` is an ``"arcsin"``, and straight `down` is treated ``"as up"``.
    """
    matrix = np.array(rows, dtype=float)
    cosine = np.hypot(matrix[0, 1], matrix[1, 1])
    tilt = float(np.arctan2(matrix[2, 1], cosine))
    if cosine < lock:
        sense = -1 if tilt < 0 and down == "right" else 1
        return [0.0, tilt, float(sense * np.arctan2(matrix[1, 0], matrix[0, 0]))]
    sine = -matrix[0, 1]
    turned = np.arcsin(np.clip(sine / cosine, -1, 1)) if pan == "arcsin" else np.arctan2(sine, matrix[1, 1])
    return [float(turned), tilt, float(np.arctan2(-matrix[2, 0], matrix[2, 2]))]


STEEP = float(np.sqrt(1 - 0.99**2))
AS_FOUND: dict[str, Any] = {"pan": "arcsin", "lock": STEEP, "down": "as up"}


def poses(mine) -> list[list[float]]:
    """The six poses of the student's test, [pan, tilt, roll] in degrees, as the notebook has them."""
    return [
        [35, mine.tilt, mine.roll],
        [mine.pan, mine.tilt, mine.roll],
        [35, 90, mine.roll],
        [35, 84, mine.roll],
        [35, mine.tilt, 180 - mine.roll],
        [-35, -90, mine.roll],
    ]


def misses(mine, *, measure="turn") -> list[float]:
    """By what angle, in radians, the function as it was found misses each of the six poses.

    `measure` may be the largest ``"difference"`` of the three angles, or the ``"norm"`` of that of the matrices.
    """
    asked = np.radians(poses(mine))
    matrices = np.round(euler_matrix(asked, PAN_TILT_ROLL, intrinsic=True), 12) + 0.0
    found = np.array([pan_tilt_roll(matrix, **AS_FOUND) for matrix in matrices])
    if measure == "difference":
        missed = np.abs(found - asked).max(axis=1)
    else:
        turned = euler_matrix(found, PAN_TILT_ROLL, intrinsic=True)
        apart = np.linalg.norm(turned - matrices, axis=(1, 2))
        missed = apart if measure == "norm" else rotation_angle_between(turned, matrices)
    return [angle or 0 for angle in np.round(missed, 9).tolist()]


def draw_poses(rng: np.random.Generator) -> list[list]:
    """Argument lists: poses ahead and back, steep ones, straight up and straight down. Zeros are clean zeros."""
    turn = lambda: rng.uniform(-np.pi, np.pi)  # noqa: E731
    found = [[rng.uniform(-1.4, 1.4), rng.uniform(-1.2, 1.2), turn()] for _ in range(4)]
    found += [[sign * rng.uniform(1.8, 3.0), rng.uniform(-1.2, 1.2), turn()] for sign in (1, -1, 1, -1)]
    found += [
        [rng.uniform(-1.4, 1.4), sign * np.radians(steep), turn()] for steep in (83, 86, 88.7, 89.6) for sign in (1, -1)
    ]
    found += [[turn(), sign * np.pi / 2, turn()] for _ in range(3) for sign in (1, -1)]
    clean = np.round(euler_matrix(found, PAN_TILT_ROLL, intrinsic=True), 12) + 0.0
    # Ten times, and a tenth of, what the statement takes for a lock.
    beside = [[0.8, sign * (np.pi / 2 - gap * AT_LOCK), -2.0] for gap in (10, 0.1) for sign in (1, -1)]
    return [[matrix.tolist()] for matrix in (*clean, *euler_matrix(beside, PAN_TILT_ROLL, intrinsic=True))]


def name_pose(rows) -> str:
    """The case a pose belongs to, in words."""
    cosine = np.hypot(rows[0][1], rows[1][1])
    if cosine < AT_LOCK:
        return "a camera that looks straight up" if rows[2][1] > 0 else "a camera that looks straight down"
    if cosine < 0.2:
        return "a camera that looks steeply up or down"
    return "a camera that looks back" if rows[1][1] < 0 else "a camera that looks ahead"
