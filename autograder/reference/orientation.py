"""Orientation: Euler sets, roll-pitch-yaw, quaternions, axis and angle.

Every function is batched: leading dimensions are written ``...``. Angles are
in radians; the ones that are returned lie in (-pi, pi].

An Euler set is three letters, ``"zxz"`` or ``"xyz"``, and three angles in the
same order. ``intrinsic`` is never guessed:

* intrinsic (about the axes of the moving body): ``R = R1(a) R2(b) R3(c)``;
* extrinsic (about the fixed axes):              ``R = R3(c) R2(b) R1(a)``.

Sources: the EPFL slides (twelve sets; a wrist with body axes z, x, z; a cardan
wrist with body axes x, z, y; ``Rz Ry Rx`` for roll, pitch, yaw).
"""

from dataclasses import dataclass
from itertools import product

import numpy as np

from dhkit.geometry import rotation, wrap

EULER_SETS = tuple("".join(s) for s in product("xyz", repeat=3) if s[0] != s[1] != s[2])
"""The twelve sequences without two equal neighbours."""

EULER_WRIST = "zxz"
"""Precession, nutation, proper rotation; intrinsic (EPFL slides)."""

CARDAN_WRIST = "xzy"
"""Pitch about x, yaw about z, roll about y; intrinsic (EPFL slides)."""

REGULAR = "two solutions"
ONLY_SUM = "only first + third"
ONLY_DIFFERENCE = "only first - third"

AXIS_DEFINED = "two solutions: (axis, angle) and (-axis, -angle)"
AXIS_FREE = "angle 0: every axis"
HALF_TURN = "half turn: both senses of the axis with the same angle"


def check_rotation(R, tolerance=1e-6):
    """Return R as a float array, or raise.

    Raises
    ------
    ValueError
        If the shape is not (..., 3, 3), an entry is not finite, the columns
        are not orthonormal within `tolerance`, or R is a reflection
        (determinant -1), such as the 4T5 printed in the MECA 953 slides.
    """
    R = np.asarray(R, float)
    if R.shape[-2:] != (3, 3):
        raise ValueError(f"a rotation has shape (..., 3, 3), found {R.shape}")
    if not np.isfinite(R).all():
        raise ValueError("a rotation has finite entries, found NaN or infinity")
    defect = np.abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(initial=0)
    if defect > tolerance:
        raise ValueError(f"the columns are not orthonormal: R^T R differs from I by {defect:.2g}")
    if (np.linalg.det(R) < 0).any():
        raise ValueError("determinant -1: a reflection, not a rotation")
    return R


# -- Euler sets ---------------------------------------------------------------


@dataclass(frozen=True)
class EulerAngles:
    """All Euler angles of a batch of rotations.

    Attributes
    ----------
    axes, intrinsic :
        the set and the way it is read.
    angles : array, shape (..., 2, 3), radians
        the two solutions. The first has its middle angle in [0, pi] (sets like
        zxz) or in [-pi/2, pi/2] (sets like xyz). At a singular rotation both
        belong to the one-parameter family, see `family` for the others.
    status : array of str, shape (...)
        `REGULAR`, or at a singular rotation what remains defined: `ONLY_SUM`
        (first + third angle; their difference is free) or `ONLY_DIFFERENCE`
        (first - third; their sum is free).
    combination : array, shape (...), radians
        the value of first + third or first - third, whichever is the well
        conditioned one; at a singular rotation all that is known.
    """

    axes: str
    intrinsic: bool
    angles: np.ndarray
    status: np.ndarray
    combination: np.ndarray

    @property
    def singular(self):
        """Bool array, shape (...)."""
        return self.status != REGULAR

    def family(self, first):
        """The member of a singular family whose first angle is `first`.

        `first`: radians, broadcast against the batch. Returns (..., 3).

        Raises
        ------
        ValueError
            If a rotation of the batch is regular: nothing is free there.
        """
        if not np.all(self.singular):
            raise ValueError("a regular rotation has two solutions and no free angle")
        first, combination, middle, is_sum = np.broadcast_arrays(
            np.asarray(first, float), self.combination, self.angles[..., 0, 1], self.status == ONLY_SUM
        )
        third = np.where(is_sum, combination - first, first - combination)
        return np.stack([wrap(first), middle, wrap(third)], axis=-1)

    def describe(self, names=("first", "second", "third")):
        """The status of a single rotation as a sentence with your angle names."""
        if np.ndim(self.status):
            raise ValueError(f"describe one rotation at a time: this is a batch of shape {np.shape(self.status)}")
        if self.status == REGULAR:
            return REGULAR
        first, _, third = names
        defined, free = ("+", "-") if self.status == ONLY_SUM else ("-", "+")
        return f"{first} {defined} {third} = {float(self.combination):.6g} rad, {first} {free} {third} free"


def euler_matrix(angles, axes, *, intrinsic):
    """Rotation of three Euler angles.

    Parameters
    ----------
    angles : array_like, shape (..., 3), radians
    axes : one of `EULER_SETS`
    intrinsic : bool

    Returns
    -------
    array, shape (..., 3, 3)
    """
    _check_set(axes)
    angles = np.asarray(angles, float)
    first, second, third = (rotation(axis, angles[..., n]) for n, axis in enumerate(axes))
    return first @ second @ third if intrinsic else third @ second @ first


def euler_angles(R, axes, *, intrinsic, tolerance=1e-9):
    """Both triples of Euler angles of a rotation.

    One algorithm serves the twelve sets. With body axes (i, j, i),
    ``R = Ri(a) Rj(b) Ri(c)`` gives a and b from column i, then c from row j of
    ``Ri(-a) R``: that row does not vanish with sin b, so R is reproduced to
    rounding error even beside the singularity. A set with three different axes
    (i, j, k) is the set (i, j, i) of ``R Rj(s pi/2)``, the quarter turn that
    brings axis i onto axis k, with b shifted by as much. Fixed axes are the
    body axes read backwards.

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
    axes : one of `EULER_SETS`
    intrinsic : bool
    tolerance : float
        a rotation is called singular when the sine that divides the first and
        third angles (of the middle angle for zxz, its cosine for xyz) is below.

    Returns
    -------
    EulerAngles

    Raises
    ------
    ValueError
        For an unknown set, or when R is not a rotation.
    """
    _check_set(axes)
    R = check_rotation(R)
    body = axes if intrinsic else axes[::-1]
    i, j, k = map(_axis_number, body)
    m = 3 - i - j
    cyclic = 1 if (j - i) % 3 == 1 else -1
    quarter = 0.0
    order = +1
    if k != i:
        quarter, order = -cyclic * np.pi / 2, -cyclic
        R = R @ np.rint(rotation(body[1], quarter))

    across = np.hypot(R[..., j, i], R[..., m, i])
    singular = across < tolerance
    a = np.where(singular, 0.0, np.arctan2(order * R[..., j, i], -cyclic * order * R[..., m, i]))
    b = order * np.arctan2(np.where(singular, 0.0, across), R[..., i, i])
    row = np.cos(a)[..., None] * R[..., j, :] + cyclic * np.sin(a)[..., None] * R[..., m, :]
    c = np.arctan2(-cyclic * row[..., m], row[..., j])

    upright = R[..., i, i] > 0
    ends = (a, c) if intrinsic else (c, a)
    combination = wrap(np.where(upright, ends[0] + ends[1], ends[0] - ends[1]))
    status = np.where(singular, np.where(upright, ONLY_SUM, ONLY_DIFFERENCE), REGULAR)

    triples = [(a, b - quarter, c), (a + np.pi, -b - quarter, c + np.pi)]
    angles = np.stack([np.stack(t if intrinsic else t[::-1], axis=-1) for t in triples], axis=-2)
    return EulerAngles(axes, intrinsic, wrap(angles), status, combination)


def rpy_matrix(roll, pitch, yaw):
    """``Rz(yaw) Ry(pitch) Rx(roll)``: fixed axes x, y, z in this order.

    Each of shape (...), radians. Returns (..., 3, 3). This is the assignment of
    the matrix page of the EPFL slides (their phi, vartheta, psi).
    """
    return euler_matrix(np.stack(np.broadcast_arrays(roll, pitch, yaw), axis=-1), "xyz", intrinsic=False)


def rpy(R, tolerance=1e-9):
    """Both (roll, pitch, yaw) of a rotation: `EulerAngles` of shape (..., 2, 3).

    The second is (roll + pi, pi - pitch, yaw + pi). At pitch = pi/2 only
    roll - yaw is defined, at -pi/2 only roll + yaw.
    """
    return euler_angles(R, "xyz", intrinsic=False, tolerance=tolerance)


# -- Quaternions, axis and angle -----------------------------------------------


@dataclass(frozen=True)
class AxisAngle:
    """Axis and angle of a batch of rotations.

    Attributes
    ----------
    axis : array, shape (..., 3), unit vectors
    angle : array, shape (...), radians in [0, pi]
    status : array of str, shape (...)
        `AXIS_DEFINED`; `AXIS_FREE` at the identity (the z axis stands for all);
        `HALF_TURN` when (axis, pi) and (-axis, pi) both serve.
    """

    axis: np.ndarray
    angle: np.ndarray
    status: np.ndarray

    def both(self):
        """Both solutions: axes (..., 2, 3) and angles (..., 2) in (-pi, pi]."""
        return (np.stack([self.axis, -self.axis], axis=-2), wrap(np.stack([self.angle, -self.angle], axis=-1)))


def quaternion(R):
    """Unit quaternion (w, x, y, z) of a rotation; its opposite is the other one.

    R: shape (..., 3, 3). Returns (..., 4) with w >= 0, and where w = 0 the first
    nonzero of x, y, z positive. Each component is taken from the largest of the
    four squared ones, so that nothing is divided by a small number.

    Raises
    ------
    ValueError
        When R is not a rotation.
    """
    R = check_rotation(R)
    xx, yy, zz = R[..., 0, 0], R[..., 1, 1], R[..., 2, 2]
    x, y, z = (R[..., 2, 1] - R[..., 1, 2], R[..., 0, 2] - R[..., 2, 0], R[..., 1, 0] - R[..., 0, 1])
    xy, xz, yz = (R[..., 0, 1] + R[..., 1, 0], R[..., 0, 2] + R[..., 2, 0], R[..., 1, 2] + R[..., 2, 1])
    # Four times the outer product of (w, x, y, z) with itself: every row is a multiple of it.
    rows = np.stack(
        [
            np.stack([1 + xx + yy + zz, x, y, z], axis=-1),
            np.stack([x, 1 + xx - yy - zz, xy, xz], axis=-1),
            np.stack([y, xy, 1 - xx + yy - zz, yz], axis=-1),
            np.stack([z, xz, yz, 1 - xx - yy + zz], axis=-1),
        ],
        axis=-2,
    )
    largest = np.argmax(np.diagonal(rows, axis1=-2, axis2=-1), axis=-1)
    q = np.take_along_axis(rows, largest[..., None, None], axis=-2)[..., 0, :]
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    leading = np.argmax(np.abs(q) > 1e-12, axis=-1)
    return q * np.where(np.take_along_axis(q, leading[..., None], axis=-1) < 0, -1.0, 1.0)


def quaternion_matrix(q):
    """Rotation of a quaternion (w, x, y, z), shape (..., 4), of any nonzero length.

    Returns (..., 3, 3). Raises ValueError for a zero or non-finite quaternion.
    """
    q = np.asarray(q, float)
    length = np.linalg.norm(q, axis=-1, keepdims=True)
    if q.shape[-1:] != (4,) or not np.isfinite(length).all() or (length == 0).any():
        raise ValueError("a quaternion is four finite numbers (w, x, y, z), not all zero")
    q = q / length
    w, vector = q[..., 0, None, None], q[..., 1:]
    outer = vector[..., :, None] * vector[..., None, :]
    square = np.sum(vector**2, axis=-1)[..., None, None]
    return (w**2 - square) * np.eye(3) + 2 * outer + 2 * w * _cross_matrix(vector)


def axis_angle(R, tolerance=1e-9):
    """Axis and angle of a rotation, R of shape (..., 3, 3).

    `tolerance` (radians): nearer than this to angle 0 the axis is called free,
    nearer to pi the rotation is called a half turn. Raises ValueError when R is
    not a rotation.
    """
    q = quaternion(R)
    length = np.linalg.norm(q[..., 1:], axis=-1)
    angle = 2 * np.arctan2(length, q[..., 0])
    free = angle < tolerance
    axis = np.where(free[..., None], (0.0, 0.0, 1.0), q[..., 1:] / np.where(free, 1.0, length)[..., None])
    status = np.where(free, AXIS_FREE, np.where(np.pi - angle < tolerance, HALF_TURN, AXIS_DEFINED))
    return AxisAngle(axis, np.where(free, 0.0, angle), status)


def axis_angle_matrix(axis, angle):
    """Rotation by `angle` (shape (...), radians) about `axis` (shape (..., 3)).

    The axis need not have unit length. Returns (..., 3, 3). Raises ValueError
    for a zero or non-finite axis.
    """
    axis = np.asarray(axis, float)
    length = np.linalg.norm(axis, axis=-1, keepdims=True)
    if axis.shape[-1:] != (3,) or not np.isfinite(length).all() or (length == 0).any():
        raise ValueError("an axis is three finite numbers, not all zero")
    half = np.asarray(angle, float)[..., None] / 2
    vector = np.sin(half) * (axis / length)
    return quaternion_matrix(np.concatenate([np.broadcast_to(np.cos(half), vector.shape[:-1] + (1,)), vector], axis=-1))


def _cross_matrix(v):
    K = np.zeros(v.shape + (3,))
    K[..., 2, 1], K[..., 0, 2], K[..., 1, 0] = v[..., 0], v[..., 1], v[..., 2]
    return K - np.swapaxes(K, -1, -2)


def _axis_number(axis):
    if axis not in ("x", "y", "z"):
        raise ValueError(f"an axis is 'x', 'y' or 'z', found {axis!r}")
    return "xyz".index(axis)


def _check_set(axes):
    if axes not in EULER_SETS:
        raise ValueError(f"unknown Euler set {axes!r}; the twelve are {', '.join(EULER_SETS)}")
