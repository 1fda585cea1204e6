"""From URDF joint origins and axes to a modified DH table.

A URDF joint gives the origin of the joint frame in the parent's frame (xyz, rpy) and an axis
in the joint frame. Only the joint axes matter to DH, so the axes are laid out at q = 0 and
the DHm frames are put on them, as steps 1 to 7 of the MECA 953 slides do by hand.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import sympy as sp

from .geometry import PARALLEL, TOUCHING, common_normal, link_axis, rotation
from .status import RoundedInput
from .tables import DHTable
from .transforms import ROUNDED, nearest_quarter

_NOISE = 1e-12  # radians: the rounding of float64, which is not worth a word
_ALMOST = 1e-2  # radians between two axes whose common normal may be far away


@dataclass(frozen=True)
class UrdfJoint:
    """One joint of a URDF file.

    Attributes
    ----------
    xyz : three floats
        Origin in the parent frame, metres.
    rpy : three floats
        Roll, pitch, yaw about the fixed x, y, z axes, radians.
    axis : three floats
        Direction in the joint frame.
    kind : str
        "revolute" or "continuous", "prismatic", or "fixed".
    """

    xyz: tuple[float, float, float]
    rpy: tuple[float, float, float] = (0.0, 0.0, 0.0)
    axis: tuple[float, float, float] = (1.0, 0.0, 0.0)
    kind: str = "revolute"

    def origin(self) -> np.ndarray:
        """Joint frame in the parent frame at q = 0, 4x4."""
        frame = np.eye(4)
        roll, pitch, yaw = self.rpy
        frame[:3, :3] = rotation("z", yaw) @ rotation("y", pitch) @ rotation("x", roll)
        frame[:3, 3] = self.xyz
        return frame


def table_from_urdf(
    joints: Sequence[UrdfJoint], name: str = "", limits: Sequence[tuple[float, float]] | None = None
) -> DHTable:
    """DHm table of a serial chain of URDF joints; joint variables q1, q2, ...

    The base and tool of the table make its forward kinematics equal to the URDF's: base link to the
    frame of the last joint, fixed joints included. Where DH leaves X_i free it is chosen as
    near to X_{i-1} as possible (joint offset in [-90, 90] degrees), and if that does not
    decide, so that a_i >= 0. Source: joint list of the MECA 953 slides, whose axes
    z, y, y, x, y, x are those of the public KR210 description.

    Turns (rpy) and axes that are within 1e-4 rad of a multiple of 90 degrees, or of parallel or square to the axis
    before, are read as that: URDF files hold 1.5708 and 3.14159. A `RoundedInput` warning says how far off they were.

    Raises ValueError when no joint moves, or an axis is the zero vector.
    """
    points, axes, sigmas, end = _axes_at_zero(_with_right_angles(joints))
    return table_from_axes(points, straightened(axes), sigmas, end, name, limits)


def table_from_axes(
    points: Sequence[np.ndarray],
    axes: Sequence[np.ndarray],
    sigmas: Sequence[int],
    end: np.ndarray,
    name: str = "",
    limits: Sequence[tuple[float, float]] | None = None,
) -> DHTable:
    """DHm table of a serial chain from its joint axes as they lie at q = 0; what is free is chosen as in `table_from_urdf`.

    Parameters
    ----------
    points, axes : sequences of n arrays (3,)
        A point on each axis, metres, and its direction, of length 1; in the base's frame.
    sigmas : sequence of n int
        0 revolute, 1 prismatic.
    end : (4, 4) array
        The tool's pose at q = 0.
    name, limits
        As for `DHTable`.

    Raises ValueError when no joint moves.
    """
    if not len(axes):
        raise ValueError("the chain has no moving joint")
    base = _base_frame(points[0], axes[0])
    z, x, origin = base[:3, 2], base[:3, 0], base[:3, 3]
    rows = []
    a, alpha = 0.0, 0.0
    for i, (axis, sigma) in enumerate(zip(axes, sigmas)):
        if i + 1 < len(axes):
            foot, next_x, next_a = _next_link(origin, axis, points[i + 1], axes[i + 1], x)
        else:
            foot, next_x, next_a = origin, x, 0.0
        d = float(axis @ (foot - origin))
        theta = _angle(x, next_x, axis)
        joint = sp.Symbol(f"q{i + 1}")
        entries: list[Any] = [_length(d), theta]
        entries[1 - sigma] += joint
        rows.append((sigma, _length(a), alpha, *entries))
        x, z, a = next_x, axis, next_a
        origin = foot + next_a * next_x
        if i + 1 < len(axes):
            alpha = _angle(axis, axes[i + 1], next_x)
    last = np.eye(4)
    last[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    last[:3, 3] = origin
    tool = np.linalg.inv(last) @ end
    return DHTable(rows, name=name, base=_tidy(base), tool=_tidy(tool), limits=limits)


def _with_right_angles(joints: Sequence[UrdfJoint]) -> list[UrdfJoint]:
    """The joints with the right angles that their rpy stand for."""
    offs = [0.0]

    def exact(angle: float) -> float:
        quarters, off = nearest_quarter(angle)
        if off > ROUNDED:
            return angle
        offs.append(off)
        return quarters * np.pi / 2 if off > _NOISE else angle

    turns = [(joint, joint.rpy) for joint in joints]
    read = [replace(joint, rpy=(exact(roll), exact(pitch), exact(yaw))) for joint, (roll, pitch, yaw) in turns]
    if max(offs) > _NOISE:
        _warn(f"rpy are read as a multiple of 90 degrees, at most {max(offs):.2g} rad away")
    return read


def straightened(axes: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Unit vectors, each made parallel or square to the one before where it is nearly so, with a `RoundedInput` warning."""
    straight = list(axes[:1])
    for i, axis in enumerate(axes[1:], start=1):
        before = straight[-1]
        along, across = before @ axis, np.linalg.norm(np.cross(before, axis))
        between = f"axes {i} and {i + 1} are"
        if _NOISE < across <= ROUNDED:
            axis = np.sign(along) * before
            _warn(f"{between} read as parallel, {across:.2g} rad away")
        elif ROUNDED < across < _ALMOST:
            _warn(f"{between} almost parallel, {across:.2g} rad apart: their common normal may be far away")
        elif _NOISE < abs(along) <= ROUNDED:
            axis = (axis - along * before) / across
            _warn(f"{between} read as square, {abs(along):.2g} rad away")
        straight.append(axis)
    return straight


def _warn(message: str) -> None:
    warnings.warn(message, RoundedInput, stacklevel=4)


def _axes_at_zero(
    joints: Sequence[UrdfJoint],
) -> tuple[list[np.ndarray], list[np.ndarray], list[int], np.ndarray]:
    """Points on the axes, axis directions and sigmas in the base frame, and the last frame."""
    frame = np.eye(4)
    points, axes, sigmas = [], [], []
    for i, joint in enumerate(joints, start=1):
        frame = frame @ joint.origin()
        if joint.kind == "fixed":
            continue
        if joint.kind not in ("revolute", "continuous", "prismatic"):
            raise ValueError(f"joint {i}: unknown kind {joint.kind!r}")
        length = np.linalg.norm(joint.axis)
        if length == 0:
            raise ValueError(f"joint {i}: the axis is the zero vector")
        points.append(frame[:3, 3])
        axes.append(frame[:3, :3] @ (np.asarray(joint.axis) / length))
        sigmas.append(1 if joint.kind == "prismatic" else 0)
    return points, axes, sigmas, frame


def _base_frame(point: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """Frame 0: the URDF base if its z axis is axis 1, else a frame placed on axis 1."""
    on_z = np.hypot(axis[0], axis[1]) < PARALLEL and np.hypot(point[0], point[1]) < TOUCHING
    if on_z and axis[2] > 0:
        return np.eye(4)
    frame = np.eye(4)
    helper = np.eye(3)[np.argmin(np.abs(axis))]
    x = helper - (helper @ axis) * axis
    x /= np.linalg.norm(x)
    frame[:3, :3] = np.column_stack([x, np.cross(axis, x), axis])
    frame[:3, 3] = point
    return frame


def _next_link(
    origin: np.ndarray, axis: np.ndarray, next_point: np.ndarray, next_axis: np.ndarray, previous_x: np.ndarray
) -> tuple[np.ndarray, np.ndarray, float]:
    """Foot of the common normal on the axis, X direction and signed length a to the next axis."""
    normal = common_normal((origin, axis), (next_point, next_axis))
    across = normal.feet[1] - normal.feet[0]
    if not normal.meeting:
        x = across / np.linalg.norm(across)
    elif normal.parallel:
        x = previous_x - (previous_x @ axis) * axis
        x = x / np.linalg.norm(x)
    else:
        x = link_axis((origin, axis), (next_point, next_axis))
    if x @ previous_x < -PARALLEL:
        x = -x
    return normal.feet[0], x, float(across @ x)


def _angle(start: np.ndarray, end: np.ndarray, about: np.ndarray) -> float:
    """Angle from one vector to another about an axis perpendicular to both, radians."""
    return float(np.arctan2(np.cross(start, end) @ about, start @ end))


def _length(value: float) -> float:
    """A length without rounding noise; axes that count as touching have none between them."""
    return 0.0 if abs(value) < TOUCHING else _tidy(value)


def _tidy(values: Any) -> Any:
    """Numbers without rounding noise: 0.75 for 0.7500000000000001, 0 for 1e-17."""
    short = np.round(values, 9) + 0.0
    tidied = np.where(np.abs(values - short) < 1e-14, short, values)
    return tidied if tidied.ndim else float(tidied)
