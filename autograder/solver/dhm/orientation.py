"""Orientation: Euler sets and roll-pitch-yaw.

Every function is batched: leading dimensions are written ``...``. Angles are
in radians; the ones that are returned lie in (-pi, pi].

An Euler set is three letters, ``"zxz"`` or ``"xyz"``, and three angles in the
same order. ``intrinsic`` is never guessed:

* intrinsic (about the axes of the moving body): ``R = R1(a) R2(b) R3(c)``;
* extrinsic (about the fixed axes):              ``R = R3(c) R2(b) R1(a)``.

Sources: the EPFL slides (twelve sets; a wrist with body axes z, x, z; a cardan
wrist with body axes x, z, y; ``Rz Ry Rx`` for roll, pitch, yaw). For unit
quaternions, rotation vectors and the like, use `scipy.spatial.transform.Rotation`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from .geometry import rotation, wrap
from .status import Status

EULER_SETS = tuple("".join(s) for s in product("xyz", repeat=3) if s[0] != s[1] != s[2])
"""The twelve sequences without two equal neighbours."""

EULER_WRIST = "zxz"
"""Precession, nutation, proper rotation; intrinsic (EPFL slides)."""

CARDAN_WRIST = "xzy"
"""Pitch about x, yaw about z, roll about y; intrinsic (EPFL slides)."""


def check_rotation(R: ArrayLike, tolerance: float = 1e-6) -> np.ndarray:
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
    status : array of `Status`, shape (...)
        SOLVED: the two solutions; INFINITE at a singular rotation (gimbal lock).
    sign : array, shape (...), +1 or -1
        the combination ``first + sign * third`` is the well conditioned one; at
        a singular rotation it is all that is defined.
    combination : array, shape (...), radians
        its value.
    """

    axes: str
    intrinsic: bool
    angles: np.ndarray
    status: np.ndarray
    sign: np.ndarray
    combination: np.ndarray

    @property
    def singular(self) -> np.ndarray:
        """Bool array, shape (...)."""
        return self.status == Status.INFINITE

    def family(self, first: ArrayLike) -> np.ndarray:
        """The member of a singular family whose first angle is `first`.

        `first`: radians, broadcast against the batch. Returns (..., 3).

        Raises
        ------
        ValueError
            If a rotation of the batch is regular: nothing is free there.
        """
        if not np.all(self.singular):
            raise ValueError("a regular rotation has two solutions and no free angle")
        first, combination, middle, sign = np.broadcast_arrays(
            np.asarray(first, float), self.combination, self.angles[..., 0, 1], self.sign
        )
        third = sign * (combination - first)
        return np.stack([wrap(first), middle, wrap(third)], axis=-1)

    def describe(self, names: Sequence[str] = ("first", "second", "third")) -> str:
        """The status of a single rotation as a sentence with your angle names."""
        if np.ndim(self.status):
            raise ValueError(f"describe one rotation at a time: this is a batch of shape {np.shape(self.status)}")
        if not self.singular:
            return "two solutions"
        first, _, third = names
        defined, free = ("+", "-") if self.sign > 0 else ("-", "+")
        return f"{first} {defined} {third} = {float(self.combination):.6g} rad, {first} {free} {third} free"


def euler_matrix(angles: ArrayLike, axes: str, *, intrinsic: bool) -> np.ndarray:
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


def euler_angles(R: ArrayLike, axes: str, *, intrinsic: bool, tolerance: float = 1e-9) -> EulerAngles:
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
    turned = check_rotation(R)
    body = axes if intrinsic else axes[::-1]
    i, j, k = map(_axis_number, body)
    m = 3 - i - j
    cyclic = 1 if (j - i) % 3 == 1 else -1
    quarter = 0.0
    order = +1
    if k != i:
        quarter, order = -cyclic * np.pi / 2, -cyclic
        turned = turned @ np.rint(rotation(body[1], quarter))

    across = np.hypot(turned[..., j, i], turned[..., m, i])
    singular = across < tolerance
    a = np.where(singular, 0.0, np.arctan2(order * turned[..., j, i], -cyclic * order * turned[..., m, i]))
    b = order * np.arctan2(np.where(singular, 0.0, across), turned[..., i, i])
    row = np.cos(a)[..., None] * turned[..., j, :] + cyclic * np.sin(a)[..., None] * turned[..., m, :]
    c = np.arctan2(-cyclic * row[..., m], row[..., j])

    upright = turned[..., i, i] > 0
    ends = (a, c) if intrinsic else (c, a)
    sign = np.where(upright, 1, -1)
    combination = wrap(ends[0] + sign * ends[1])
    status = np.where(singular, Status.INFINITE, Status.SOLVED)

    triples = [(a, b - quarter, c), (a + np.pi, -b - quarter, c + np.pi)]
    angles = np.stack([np.stack(t if intrinsic else t[::-1], axis=-1) for t in triples], axis=-2)
    return EulerAngles(axes, intrinsic, wrap(angles), status, sign, combination)


def rpy_matrix(roll: ArrayLike, pitch: ArrayLike, yaw: ArrayLike) -> np.ndarray:
    """``Rz(yaw) Ry(pitch) Rx(roll)``: fixed axes x, y, z in this order.

    Each of shape (...), radians. Returns (..., 3, 3). This is the assignment of
    the matrix page of the EPFL slides (their phi, vartheta, psi).
    """
    return euler_matrix(np.stack(np.broadcast_arrays(roll, pitch, yaw), axis=-1), "xyz", intrinsic=False)


def rpy(R: ArrayLike, tolerance: float = 1e-9) -> EulerAngles:
    """Both (roll, pitch, yaw) of a rotation: `EulerAngles` of shape (..., 2, 3).

    The second is (roll + pi, pi - pitch, yaw + pi). At pitch = pi/2 only
    roll - yaw is defined, at -pi/2 only roll + yaw.
    """
    return euler_angles(R, "xyz", intrinsic=False, tolerance=tolerance)


def _axis_number(axis: str) -> int:
    if axis not in ("x", "y", "z"):
        raise ValueError(f"an axis is 'x', 'y' or 'z', found {axis!r}")
    return "xyz".index(axis)


def _check_set(axes: str) -> None:
    if axes not in EULER_SETS:
        raise ValueError(f"unknown Euler set {axes!r}; the twelve are {', '.join(EULER_SETS)}")
