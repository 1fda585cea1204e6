"""All postures of six turns about any axes: five are eliminated, the sixth is an eigenvalue.

Joints a to f stand in a loop with links B_0 to B_5 behind them. A point and a direction on axis f, seen from before c,
depend on (c, d, e) as seen one way round the loop and on (a, b) as seen the other way round. With their products that
Raghavan and Roth found, that makes fourteen equations, affine in each cosine and sine; the eight terms in a and b leave by
linear algebra, six equations remain in d and e, and with them multiplied by tan(d/2) a matrix of 12 rows, quadratic in
tan(c/2), whose singular points are the up to 16 postures. Which joint is a, is free: a loop has no beginning.
Sources: M. Raghavan, B. Roth, "Inverse kinematics of the general 6R manipulator and related linkages", 1993,
doi:10.1115/1.2919218; D. Manocha, J. Canny, "Efficient inverse kinematics for general 6R manipulators", 1994,
doi:10.1109/70.326569.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .geometry import cross
from .loop import motion

MOST = 16
"""Postures that six turns can have for a pose."""

_SAMPLES = 2 * np.pi * np.arange(3) / 3
_ASIDE = np.array([0.4, 1.1, 2.3])  # radians at which c, d and e count from, so that no round angle is half a turn
_TO_HARMONICS = np.linalg.inv(np.stack([np.ones(3), np.cos(_SAMPLES), np.sin(_SAMPLES)], axis=1))
_HALF_ANGLE = np.array(
    [[1.0, 1, 0], [0, 0, 2], [1, -1, 0]]
)  # 1, cos, sin times 1 + t^2 in powers of t = tan(angle / 2)
_TO_POWERS = _HALF_ANGLE @ _TO_HARMONICS
_HARMONICS_OF_TWO = np.kron(_TO_HARMONICS, _TO_HARMONICS).T
_POWERS_OF_THREE = np.kron(np.kron(_TO_POWERS, _TO_POWERS), _TO_POWERS).T
_ONE_IN_POWERS = np.kron(np.kron(_HALF_ANGLE[:, 0], _HALF_ANGLE[:, 0]), _HALF_ANGLE[:, 0])
_RANK = 1e-10  # singular value, per largest, under which a term is none
_NOISE = 1e-13 * np.random.default_rng(0).normal(size=(12, 12))  # so that no matrix is quite singular


@dataclass(frozen=True)
class Elimination:
    """Loops that differ in one of their links; what does not depend on that link is worked out once.

    Attributes
    ----------
    links : six arrays (1, 4, 4)
        B_0 to B_5, each behind its joint; lengths in units of the arm's size.
    place : int
        Which of them differs from loop to loop; its own array does not count.
    """

    links: tuple[np.ndarray, ...]
    place: int

    def candidates(self, link: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Angles of a to f that may close the loops whose one link is (N, 4, 4).

        Returns
        -------
        angles : (6, 16, N) array
            Radians.
        apart : (16, N) array
            How far each is from real, radians; those that are come first.
        """
        links = [*self.links[: self.place], link, *self.links[self.place + 1 :]]
        if self.place in (2, 3, 4):
            of_three, (constant, free) = _of_three(*links[2:5]), self._same_of_two
        else:
            of_three, (constant, free) = self._same_of_three, _of_two(links[5], *links[:2])
        if free.shape[2] > 6:
            free = free @ np.linalg.svd(free.swapaxes(1, 2) @ of_three)[0][:, :, :6]
        six = free.swapaxes(1, 2) @ (of_three - constant * _ONE_IN_POWERS)
        middle_three, apart = _middle_three(six)
        return _all_six(links, middle_three), apart

    @cached_property
    def _same_of_three(self) -> np.ndarray:
        return _of_three(*self.links[2:5])

    @cached_property
    def _same_of_two(self) -> tuple[np.ndarray, np.ndarray]:
        return _of_two(self.links[5], *self.links[:2])


def _of_three(B2: np.ndarray, B3: np.ndarray, B4: np.ndarray) -> np.ndarray:
    """The fourteen products in c, d and e: coefficients of powers of the tangents of their halves, (N, 14, 27)."""
    c, d, e = motion(False, _SAMPLES + _ASIDE[:, None])
    T = c[:, None, None, None] @ (B2 @ d[:, None, None] @ B3 @ e[:, None] @ B4)
    return _products(T[..., :3, 3], T[..., :3, 2]).reshape(27, -1, 14).transpose(1, 2, 0) @ _POWERS_OF_THREE


def _of_two(B5: np.ndarray, B0: np.ndarray, B1: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The fourteen products in a and b: what they all have, (N, 14, 1), and the combinations that are free of the rest.

    These are columns, (N, 14, 6 or more): eight terms in a and b, some of which may depend on others.
    """
    turns = motion(False, _SAMPLES)
    back = B5 @ turns[:, None, None] @ B0 @ turns[:, None] @ B1
    R = back[..., :3, :3]
    p, z = -(R * back[..., :3, 3:]).sum(axis=-2), R[..., 2, :]
    terms = _products(p, z).reshape(9, -1, 14).transpose(1, 2, 0) @ _HARMONICS_OF_TWO
    left, sizes, _ = np.linalg.svd(terms[:, :, 1:])
    rank = int((sizes > _RANK * sizes[:, :1]).sum(axis=1).max(initial=0))
    return terms[:, :, :1], left[:, :, rank:]


def _products(p: np.ndarray, z: np.ndarray) -> np.ndarray:
    """The fourteen products of points and axes (..., 3), (..., 14)."""
    pp, pz = (p * p).sum(-1, keepdims=True), (p * z).sum(-1, keepdims=True)
    return np.concatenate([p, z, cross(p, z), pp * z - 2 * pz * p, pp, pz], axis=-1)


def _middle_three(six: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """c, d and e (3, 16, N) of six equations (N, 6, 27) in powers of tangents, and how far each is from real (16, N)."""
    count = len(six)
    rows = np.zeros((count, 12, 3, 4, 3))
    rows[:, :6, :, :3] = rows[:, 6:, :, 1:] = six.reshape(count, 6, 3, 3, 3)
    companion = np.zeros((count, 24, 24))
    companion[:, :12, 12:] = np.eye(12)
    companion[:, 12:] = -_solved(rows[:, :, 2].reshape(count, 12, 12) + _NOISE, rows[:, :, :2].reshape(count, 12, 24))
    roots, vectors = np.linalg.eig(companion)
    apart = 2 * np.abs(roots.imag) / (1 + np.abs(roots) ** 2)
    pose, kept = np.arange(count)[:, None], np.argsort(apart, axis=1)[:, :MOST]
    powers = vectors[pose, :12, kept].reshape(count, MOST, 4, 3)
    t = roots.real[pose, kept], _ratio(powers[:, :, :-1], powers[:, :, 1:]), _ratio(powers[..., :-1], powers[..., 1:])
    return (2 * np.arctan(t) + _ASIDE[:, None, None]).swapaxes(1, 2), apart[pose, kept].T


def _solved(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """A^-1 B; of matrices that are singular nevertheless, some answer that is finite."""
    try:
        return np.linalg.solve(A, B)
    except np.linalg.LinAlgError:
        return np.linalg.pinv(A, rcond=1e-14) @ B


def _ratio(lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """What lower (N, K, i, j) must be multiplied by to give upper, (N, K)."""
    lower_conjugate = lower.conj()
    across = np.einsum("nkij,nkij->nk", lower_conjugate, upper).real
    return across / np.maximum(np.einsum("nkij,nkij->nk", lower_conjugate, lower).real, 1e-300)


def _all_six(links: Sequence[np.ndarray], middle_three: np.ndarray) -> np.ndarray:
    """a to f (6, K, N) from c, d and e (3, K, N)."""
    B0, B1, B2, B3, B4, B5 = links
    c, d, e = motion(False, middle_three)
    middle = B1 @ c @ B2 @ d @ B3 @ e @ B4
    # What z and p are behind a and b does not change in height, distance and product with a. With z and p as the last
    # index, that makes four equations Re(w e^(ib)) = rest.
    R, shift = B0[:, :3, :3], B0[:, :3, 3]
    ahead = np.stack([R[:, 2], (R * shift[:, :, None]).sum(axis=1)], axis=1)
    goal, z, p = np.linalg.inv(B5)[:, :3, 2:], middle[..., :3, 2], middle[..., :3, 3]
    rest = -ahead[:, :, 2:] * middle[..., None, 2, 2:]
    rest[..., 0, :] += goal[:, 2]
    rest[..., 0, 1] -= shift[:, 2]
    rest[..., 1, 0] += (goal[:, :, 0] * goal[:, :, 1]).sum(axis=-1) - (z * p).sum(axis=-1)
    rest[..., 1, 1] += ((goal[:, :, 1] ** 2 - shift**2).sum(axis=-1) - (p * p).sum(axis=-1)) / 2
    w = (ahead[:, :, 0] - 1j * ahead[:, :, 1])[:, :, None] * _in_plane(middle)[..., None, :]
    sums = ((rest * w.conj()).sum(axis=(2, 3)), (w * w.conj()).sum(axis=(2, 3)), (w * w).sum(axis=(2, 3)))
    b = np.angle(sums[1] * sums[0] - (sums[2] * sums[0]).conj())
    seen = B0 @ motion(False, b) @ middle
    a = np.angle((_in_plane(goal) * _in_plane(seen).conj()).sum(axis=-1))
    back = B5 @ motion(False, a) @ seen
    f = np.arctan2(back[..., 0, 1] - back[..., 1, 0], back[..., 0, 0] + back[..., 1, 1])
    return np.stack([a, b, *middle_three, f])


def _in_plane(T: np.ndarray) -> np.ndarray:
    """x + iy of the last two columns (the axis and the point) of (..., 3 or 4, 2 or 4) arrays, (..., 2)."""
    return T[..., 0, -2:] + 1j * T[..., 1, -2:]
