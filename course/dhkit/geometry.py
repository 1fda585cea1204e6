"""Plain geometry of rotations, Denavit-Hartenberg transforms, lines in space and two-link arms.

Numbers only (NumPy), and every function is batched: leading dimensions are written ``...``. Lengths are in metres,
angles in radians. Nothing here draws, judges or knows of an exercise: the drawings, the judge and the solver `dhm` all
build on it. The students' kit holds no solver and the solver needs no kit, so each has this file, alike to the letter.

References
----------
.. [1] J. J. Craig, *Introduction to Robotics: Mechanics and Control*, 3rd ed., Pearson, 2005, section 3.4.
.. [2] W. Khalil and J.-F. Kleinfinger, "A new geometric notation for open and closed-loop robots", IEEE Int. Conf. on
   Robotics and Automation, 1986, doi:10.1109/ROBOT.1986.1087552.
.. [3] J. Denavit and R. S. Hartenberg, "A kinematic notation for lower-pair mechanisms based on matrices", J. Appl.
   Mech. 22(2), 1955, doi:10.1115/1.4011045.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

# A line in space: a point on it and a direction of any length but zero, each of shape (..., 3).
Line = tuple[ArrayLike, ArrayLike]

PARALLEL = 1e-9  # sine of the angle under which two lines count as parallel
TOUCHING = 1e-9  # metres under which two lines count as meeting

# Fractions of a two-link arm's size. On a limit, an angle errs by the root of a length's error; at a point where an
# angle is free, by its quotient. Both choices keep that error below 1e-6 rad.
SAME_LENGTH = 1e-12  # two lengths count as equal
COINCIDENT = 1e-10  # a target counts as lying on the axis that it makes free

_NEXT, _LAST = [1, 2, 0], [2, 0, 1]


# ---------------------------------------------------------------- angles and directions


def wrap(angle: ArrayLike, rounding: float = 6e-13) -> np.ndarray:
    """The same angle in (-pi, pi]; -pi and its rounding neighbours become pi.

    Of a huge number float64 knows no angle: its exact remainder is as good as any, and not zero.

    Parameters
    ----------
    angle : array_like, shape (...), in radians
    rounding : float, in radians
        How far above -pi an angle still counts as -pi.

    Returns
    -------
    ndarray, shape (...), in radians
    """
    angle = np.asarray(angle, dtype=float)
    turns = np.subtract(angle, np.pi + rounding, out=np.empty(angle.shape))
    turns *= 0.5 / np.pi
    np.ceil(turns, out=turns)
    if not (turns.max(initial=0.0) < 1e9 and turns.min(initial=0.0) > -1e9):  # not a number is neither
        near = np.minimum(angle - turns * (2 * np.pi), np.pi)
        return np.where(np.abs(turns) < 1e9, near, np.pi - np.remainder(np.pi - angle, 2 * np.pi))[()]
    turns *= -2 * np.pi
    turns += angle
    return np.minimum(turns, np.pi, out=turns)[()]


def lies_between(angle: ArrayLike, low: ArrayLike, high: ArrayLike, tolerance: float = 0.0) -> np.ndarray:
    """Whether an angle lies in a range, modulo full turns.

    Parameters
    ----------
    angle, low, high : array_like, in radians
        They broadcast against each other; the range runs from `low` up to `high`.
    tolerance : float, in radians
        By how much the angle may miss the range.

    Returns
    -------
    ndarray of bool
    """
    past = np.mod(np.asarray(angle) - low + tolerance, 2 * np.pi)
    return past <= np.subtract(high, low) + 2 * tolerance


def phasor(angle: ArrayLike) -> np.ndarray:
    """The complex number e^(i angle), which turns points x + iy of a plane by `angle`.

    Parameters
    ----------
    angle : array_like, shape (...), in radians

    Returns
    -------
    ndarray of complex, shape (...)
    """
    angle = np.asarray(angle, dtype=float)
    result = np.empty(angle.shape, dtype=complex)
    np.cos(angle, out=result.real)
    np.sin(angle, out=result.imag)
    return result


def unit_vector(angle: ArrayLike) -> np.ndarray:
    """Unit vector of the plane in the direction `angle`, counted from x towards y.

    Parameters
    ----------
    angle : array_like, shape (...), in radians

    Returns
    -------
    ndarray, shape (..., 2)
    """
    angle = np.asarray(angle, dtype=float)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def perpendicular(direction: ArrayLike) -> np.ndarray:
    """A unit vector at right angles to `direction`: its cross product with the coordinate axis farthest from it.

    Parameters
    ----------
    direction : array_like, shape (3,), not zero

    Returns
    -------
    ndarray, shape (3,)
    """
    direction = np.asarray(direction, dtype=float)
    across = np.cross(direction, np.eye(3)[np.argmin(np.abs(direction))])
    return across / np.linalg.norm(across)


def cross(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Vector product over the last axis, of length 3; on small arrays several times faster than NumPy's."""
    return first[..., _NEXT] * second[..., _LAST] - first[..., _LAST] * second[..., _NEXT]


# ---------------------------------------------------------------- rotations and elementary moves


def rotation_2d(angle: ArrayLike) -> np.ndarray:
    """Rotation matrix of the plane.

    Parameters
    ----------
    angle : array_like, shape (...), in radians

    Returns
    -------
    ndarray, shape (..., 2, 2)
    """
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=-2)


def rotation(axis: str, angle: ArrayLike) -> np.ndarray:
    """Rotation matrix about a coordinate axis.

    Parameters
    ----------
    axis : "x", "y" or "z"
    angle : array_like, shape (...), in radians

    Returns
    -------
    ndarray, shape (..., 3, 3)

    Raises
    ------
    ValueError
        If `axis` is none of the three letters.
    """
    i = _axis_number(axis)
    j, k = _NEXT[i], _LAST[i]
    angle = np.asarray(angle, dtype=float)
    matrix = np.zeros((*angle.shape, 3, 3))
    matrix[..., i, i] = 1
    matrix[..., j, j] = matrix[..., k, k] = np.cos(angle)
    matrix[..., k, j] = np.sin(angle)
    matrix[..., j, k] = -matrix[..., k, j]
    return matrix


def rot(axis: str, angle: ArrayLike) -> np.ndarray:
    """Elementary move Rot(axis, angle): the homogeneous transform of a rotation about a coordinate axis.

    Parameters
    ----------
    axis : "x", "y" or "z"
    angle : array_like, shape (...), in radians

    Returns
    -------
    ndarray, shape (..., 4, 4)
    """
    turned = rotation(axis, angle)
    matrix = np.zeros((*turned.shape[:-2], 4, 4))
    matrix[..., :3, :3] = turned
    matrix[..., 3, 3] = 1
    return matrix


def trans(axis: str, distance: ArrayLike) -> np.ndarray:
    """Elementary move Trans(axis, distance): the homogeneous transform of a translation along a coordinate axis.

    Parameters
    ----------
    axis : "x", "y" or "z"
    distance : array_like, shape (...), in metres

    Returns
    -------
    ndarray, shape (..., 4, 4)
    """
    distance = np.asarray(distance, dtype=float)
    matrix = np.zeros((*distance.shape, 4, 4))
    matrix[...] = np.eye(4)
    matrix[..., _axis_number(axis), 3] = distance
    return matrix


def rigid_transform(turn: ArrayLike, shift: ArrayLike) -> np.ndarray:
    """Homogeneous transform of a frame with the given axes and origin.

    Parameters
    ----------
    turn : array_like, shape (..., 3, 3)
        Rotation matrix: the axes of the frame as columns.
    shift : array_like, shape (..., 3), in metres
        Its origin.

    Returns
    -------
    ndarray, shape (..., 4, 4)
    """
    turn, shift = np.asarray(turn, dtype=float), np.asarray(shift, dtype=float)
    matrix = np.zeros((*np.broadcast_shapes(turn.shape[:-2], shift.shape[:-1]), 4, 4))
    matrix[..., :3, :3], matrix[..., :3, 3], matrix[..., 3, 3] = turn, shift, 1
    return matrix


def rotation_angle_between(first: ArrayLike, second: ArrayLike) -> np.ndarray:
    """Angle of the rotation that takes one orientation to another.

    Parameters
    ----------
    first, second : array_like, shape (..., 3, 3)
        Rotation matrices.

    Returns
    -------
    ndarray, shape (...), in radians, in [0, pi]

    Notes
    -----
    Accurate for tiny angles too, where the usual ``arccos((trace - 1) / 2)`` keeps only half of the digits.
    """
    chord = np.linalg.norm(np.asarray(first, dtype=float) - np.asarray(second, dtype=float), axis=(-2, -1))
    return 2 * np.arcsin(np.minimum(chord / np.sqrt(8), 1))


def chain_products(transforms: ArrayLike) -> np.ndarray:
    """Frames of a chain seen from its base: the products I, M1, M1 M2, ... of the steps from frame to frame.

    Parameters
    ----------
    transforms : array_like, shape (n, ..., m, m)

    Returns
    -------
    ndarray, shape (n + 1, ..., m, m)
    """
    transforms = np.asarray(transforms, dtype=float)
    frames = np.empty((len(transforms) + 1, *transforms.shape[1:]))
    frames[0] = np.eye(transforms.shape[-1])
    for i, step in enumerate(transforms):
        frames[i + 1] = frames[i] @ step
    return frames


def _axis_number(axis: str) -> int:
    if axis not in ("x", "y", "z"):
        raise ValueError(f"axis: expected 'x', 'y' or 'z', found {axis!r}")
    return "xyz".index(axis)


# ---------------------------------------------------------------- Denavit-Hartenberg matrices


def modified_dh(a: ArrayLike, alpha: ArrayLike, d: ArrayLike, theta: ArrayLike) -> np.ndarray:
    """Modified DH matrix: frame i seen from frame i - 1, ``Trans_x(a) Rot_x(alpha) Trans_z(d) Rot_z(theta)``.

    Parameters
    ----------
    a, d : array_like, in metres
        a_{i-1} and d_i; the four parameters broadcast against each other to the shape (...).
    alpha, theta : array_like, in radians
        alpha_{i-1} and theta_i.

    Returns
    -------
    ndarray, shape (..., 4, 4)
        Complex if a parameter is.

    Notes
    -----
    The convention of Khalil and Kleinfinger [2]_ and of Craig [1]_, and of the MECA 953 slides.
    """
    return modified_dh_of_cosines(a, np.cos(alpha), np.sin(alpha), d, np.cos(theta), np.sin(theta))


def modified_dh_of_cosines(
    a: ArrayLike, cos_alpha: ArrayLike, sin_alpha: ArrayLike, d: ArrayLike, cos_theta: ArrayLike, sin_theta: ArrayLike
) -> np.ndarray:
    """`modified_dh` for cosines and sines that are already known, for instance exactly 0 and 1.

    Parameters
    ----------
    a, d : array_like, in metres
    cos_alpha, sin_alpha, cos_theta, sin_theta : array_like
        All six broadcast against each other to the shape (...).

    Returns
    -------
    ndarray, shape (..., 4, 4)
    """
    ca, sa, c, s = np.asarray(cos_alpha), np.asarray(sin_alpha), np.asarray(cos_theta), np.asarray(sin_theta)
    return _affine([[c, -s, 0.0, a], [s * ca, c * ca, -sa, -sa * d], [s * sa, c * sa, ca, ca * d]])


def classic_dh(a: ArrayLike, alpha: ArrayLike, d: ArrayLike, theta: ArrayLike) -> np.ndarray:
    """Classic DH matrix: frame i seen from frame i - 1, ``Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha)``.

    Parameters
    ----------
    a, d : array_like, in metres
        a_i and d_i; the four parameters broadcast against each other to the shape (...).
    alpha, theta : array_like, in radians
        alpha_i and theta_i.

    Returns
    -------
    ndarray, shape (..., 4, 4)

    Notes
    -----
    The convention of Denavit and Hartenberg [3]_.
    """
    ca, sa, c, s = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
    return _affine([[c, -ca * s, sa * s, a * c], [s, ca * c, -sa * c, a * s], [0.0, sa, ca, d]])


def _affine(rows: list[list[ArrayLike]]) -> np.ndarray:
    """Homogeneous transforms, (..., 4, 4), from their first three rows, whose entries broadcast."""
    entries = [entry for row in rows for entry in row]
    matrix = np.zeros((*np.broadcast(*entries).shape, 4, 4), dtype=np.result_type(float, *entries))
    for i, row in enumerate(rows):
        for j, entry in enumerate(row):
            matrix[..., i, j] = entry
    matrix[..., 3, 3] = 1
    return matrix


# ---------------------------------------------------------------- two lines in space


class CommonNormal(NamedTuple):
    """The common normal of two lines.

    Attributes
    ----------
    feet : ndarray, shape (..., 2, 3), in metres
        Its ends, on the first and on the second line.
    parallel : ndarray of bool, shape (...)
        True if the lines are parallel or opposite; the normal is then the one through the point of the first line.
    meeting : ndarray of bool, shape (...)
        True if the two feet coincide: the lines intersect, or are one line where they are parallel too.
    """

    feet: np.ndarray
    parallel: np.ndarray
    meeting: np.ndarray


def common_normal(first: Line, second: Line, parallel_below: float = PARALLEL) -> CommonNormal:
    """Common normal of two lines in space.

    Parameters
    ----------
    first, second : (point, direction), each of shape (..., 3)
        Points in metres; directions of any length but zero.
    parallel_below : float
        Sine of the angle under which the lines count as parallel.

    Raises
    ------
    ValueError
        If a direction is the zero vector.
    """
    (p, u), (q, v) = unit_line(first), unit_line(second)
    between = q - p
    normal = cross(u, v)
    sine = np.linalg.norm(normal, axis=-1)
    parallel = sine < parallel_below
    square = np.where(parallel, 1.0, sine**2)
    along_u, along_v = _dot(between, u), _dot(between, v)
    at_first = np.where(parallel, 0.0, (along_u - _dot(u, v) * along_v) / square)
    foot = p + at_first[..., None] * u
    # Along the normal, not from foot to foot: the feet of lines that are almost parallel are far away and ill defined.
    way = (_dot(between, normal) / square)[..., None] * normal
    feet = np.stack([foot, np.where(parallel[..., None], q - along_v[..., None] * v, foot + way)], axis=-2)
    meeting = np.linalg.norm(feet[..., 1, :] - feet[..., 0, :], axis=-1) < TOUCHING
    return CommonNormal(feet, parallel, meeting)


def link_axis(first: Line, second: Line) -> np.ndarray:
    """X of the link that carries two joint axes: along the common normal from the first axis to the second.

    Where the axes meet, X has the sense that makes alpha positive.

    Parameters
    ----------
    first, second : (point, direction), each of shape (3,)

    Returns
    -------
    ndarray, shape (3,), of length 1

    Raises
    ------
    ValueError
        If the axes lie on one line, where X may have any direction normal to it, or a direction is zero.

    Notes
    -----
    Parameter rules of the MECA 953 slides, X_i along the common normal from Z_i to Z_{i+1} whatever the cross product
    says.
    """
    normal = common_normal(first, second)
    if normal.parallel and normal.meeting:
        raise ValueError("the axes lie on one line: X may have any direction normal to it")
    way = normal.feet[1] - normal.feet[0]
    if normal.meeting:
        way = np.cross(unit_line(first)[1], unit_line(second)[1])
    return way / np.linalg.norm(way)


def unit_line(line: Line) -> tuple[np.ndarray, np.ndarray]:
    """The line with a direction of length 1: point and direction, each of shape (..., 3).

    Raises ValueError where a direction is the zero vector.
    """
    point, direction = (np.asarray(each, dtype=float) for each in line)
    length = np.linalg.norm(direction, axis=-1, keepdims=True)
    if (length == 0).any():
        raise ValueError("the direction of an axis is the zero vector")
    return point, direction / length


def _dot(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    return (first * second).sum(axis=-1)


# ---------------------------------------------------------------- planar arms


def planar_joints(lengths: ArrayLike, q: ArrayLike) -> np.ndarray:
    """Base, joints and tip of a planar arm with revolute joints.

    Parameters
    ----------
    lengths : array_like, shape (n,), in metres
    q : array_like, shape (..., n), in radians
        Joint angles, each counted from the link before; the first from x.

    Returns
    -------
    ndarray, shape (..., n + 1, 2), in metres
    """
    steps = np.asarray(lengths, dtype=float)[:, None] * unit_vector(np.cumsum(q, axis=-1))
    points = np.zeros((*steps.shape[:-2], steps.shape[-2] + 1, 2))
    np.cumsum(steps, axis=-2, out=points[..., 1:, :])
    return points


class TwoLink(NamedTuple):
    """Postures of a two-link arm for targets of shape (...).

    Attributes
    ----------
    first, bend : ndarray, shape (2, ...), in radians
        Joint angles t1 and t2. The leading axis is the elbow: t2 >= 0 first, then t2 <= 0.
    first_turn, bend_turn : ndarray of complex, shape (2, ...)
        The rotations e^(i t1) and e^(i t2).
    valid : ndarray of bool, shape (2, ...)
        Does this posture reach the target? On a limit, where both postures are the same, only the first one is.
    stretched, folded : ndarray of bool, shape (...)
        The target is on the outer limit or beyond it; on the inner limit or within it.
    free : ndarray of bool, shape (...)
        The target is the arm's own first joint and both links have one length, so that t1 may be anything.
    beyond, short : ndarray, shape (...), in metres
        Distance of the target outside the outer limit and inside the inner one, negative where it is reached.
    """

    first: np.ndarray
    bend: np.ndarray
    first_turn: np.ndarray
    bend_turn: np.ndarray
    valid: np.ndarray
    stretched: np.ndarray
    folded: np.ndarray
    free: np.ndarray
    beyond: np.ndarray
    short: np.ndarray


def two_link(target: ArrayLike, l1: ArrayLike, l2: ArrayLike, anchor: ArrayLike = 0.0, tol: ArrayLike = 0.0) -> TwoLink:
    """All (t1, t2) with ``l1 e^(i t1) + l2 e^(i (t1 + t2)) = target``, both elbows, exact up to the limits of reach.

    Parameters
    ----------
    target : array_like of complex, shape (...), in metres
        Points x + iy of the arm's plane, seen from its first joint.
    l1, l2 : array_like, in metres, positive
        Numbers, or arrays that broadcast with `target`.
    anchor : array_like, in radians
        The t1 to report where it is free; broadcasts with `target`.
    tol : array_like, in metres
        By how much a target may miss the ring of reach and still count as on its limit; at least 1e-12 of the reach.

    Returns
    -------
    TwoLink
        Free of NaN: a target out of reach gets the posture that comes nearest to it, and is not valid.

    Notes
    -----
    With ``outer = (l1 + l2)^2 - r^2`` and ``inner = r^2 - (l1 - l2)^2``, ``tan(t2 / 2) = sqrt(outer / inner)`` is exact
    at both limits, where the arc cosine of the usual formula loses half of its digits. Two-link arm of the EPFL
    slides; type-8 equation of the s600 tutorial.
    """
    p = np.asarray(target, dtype=complex)
    l1, l2 = np.asarray(l1, dtype=float), np.asarray(l2, dtype=float)
    r = np.abs(p)
    total, gap = l1 + l2, np.abs(l1 - l2)
    beyond, short = r - total, gap - r
    free = (r <= COINCIDENT * total) & (gap <= SAME_LENGTH * total)
    stretched = beyond >= -SAME_LENGTH * total
    folded = free | (short >= -SAME_LENGTH * total)
    outer = np.where(stretched, 0.0, -beyond * (total + r))
    inner = np.where(folded, 0.0, -short * (gap + r))
    root_outer, root_inner = np.sqrt(outer), np.sqrt(inner)

    bend = np.empty((2, *outer.shape))
    np.multiply(np.arctan2(root_outer, root_inner), 2.0, out=bend[0, ...])
    np.negative(bend[0], out=bend[1, ...])
    bend_turn = np.empty(bend.shape, dtype=complex)
    scale = 1.0 / (inner + outer)
    bend_turn.real = (inner - outer) * scale
    bend_turn.imag[0] = 2.0 * root_inner * root_outer * scale
    bend_turn.imag[1] = -bend_turn.imag[0]

    first_turn = p * np.conj(l1 + l2 * bend_turn)
    size = np.abs(first_turn)
    if free.any():
        first_turn = np.where(free, phasor(anchor), first_turn)
        size = np.where(free, 1.0, size)
    first_turn /= np.where(size > 0.0, size, 1.0)
    first = np.arctan2(first_turn.imag, first_turn.real)

    reach = np.maximum(tol, SAME_LENGTH * total)
    reached = (beyond <= reach) & (short <= reach)
    valid = np.stack([reached, reached & ~(stretched | folded)])
    return TwoLink(first, bend, first_turn, bend_turn, valid, stretched, folded, free, beyond, short)
