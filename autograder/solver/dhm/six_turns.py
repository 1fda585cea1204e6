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

import numpy as np

from .loop import motion

MOST = 16
"""Postures that six turns can have for a pose."""

_SAMPLES = 2 * np.pi * np.arange(3) / 3
_TO_HARMONICS = np.linalg.inv(np.stack([np.ones(3), np.cos(_SAMPLES), np.sin(_SAMPLES)], axis=1))
_HALF_ANGLE = np.array(
    [[1.0, 1, 0], [0, 0, 2], [1, -1, 0]]
)  # 1, cos, sin times 1 + t^2 in powers of t = tan(angle / 2)
_HARMONICS_OF_TWO = np.kron(_TO_HARMONICS, _TO_HARMONICS)
_HARMONICS_OF_THREE = np.kron(_HARMONICS_OF_TWO, _TO_HARMONICS)
_HALF_ANGLES_OF_THREE = np.kron(np.kron(_HALF_ANGLE, _HALF_ANGLE), _HALF_ANGLE)
_ASIDE = np.array([0.4, 1.1, 2.3])  # radians at which c, d and e count from, so that no round angle is half a turn
_RANK = 1e-10  # singular value, per largest, under which a term is none
_NOISE = 1e-13 * np.random.default_rng(0).normal(size=(12, 12))  # so that no matrix is quite singular


def candidates(links: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Angles of a to f that may close a loop.

    Parameters
    ----------
    links : six arrays (N or 1, 4, 4)
        B_0 to B_5, each behind its joint; lengths in units of the arm's size.

    Returns
    -------
    angles : (6, 16, N) array
        Radians.
    apart : (16, N) array
        How far each is from real, radians; those that are come first.
    """
    B0, B1, B2, B3, B4, B5 = links
    count = max(len(link) for link in links)
    c, d, e = (_SAMPLES + aside for aside in _ASIDE)
    left = _products(
        motion(False, c)[:, None, None, None]
        @ (B2 @ motion(False, d)[:, None, None] @ B3 @ motion(False, e)[:, None] @ B4)
    )
    back = np.linalg.inv(motion(False, _SAMPLES))
    right = _products(
        np.linalg.inv(B1) @ back[None, :, None] @ np.linalg.inv(B0) @ back[:, None, None] @ np.linalg.inv(B5)
    )
    left = left.reshape(27, -1, 14).transpose(1, 2, 0) @ _HARMONICS_OF_THREE.T
    right = right.reshape(9, -1, 14).transpose(1, 2, 0) @ _HARMONICS_OF_TWO.T
    left = np.broadcast_to(left, (count, 14, 27)).copy()
    left[:, :, 0] -= right[:, :, 0]
    free = _six_free_of(right[:, :, 1:], left)
    six = (free.swapaxes(1, 2) @ left @ _HALF_ANGLES_OF_THREE.T).reshape(count, 6, 3, 3, 3)
    rows = np.zeros((3, count, 12, 4, 3))
    for power in range(3):
        rows[power, :, :6, :3] = rows[power, :, 6:, 1:] = six[:, :, power]
    M = rows.reshape(3, count, 12, 12)
    companion = np.zeros((count, 24, 24))
    companion[:, :12, 12:] = np.eye(12)
    companion[:, 12:] = -_solved(M[2] + _NOISE, np.concatenate([M[0], M[1]], axis=2))
    roots, vectors = np.linalg.eig(companion)
    apart = 2 * np.abs(roots.imag) / (1 + np.abs(roots) ** 2)
    kept = np.argsort(apart, axis=1)[:, :MOST]
    roots = np.take_along_axis(roots, kept, axis=1)
    powers = np.take_along_axis(vectors[:, :12], kept[:, None], axis=2).reshape(count, 4, 3, MOST)
    t = roots.real.T, _ratio(powers[:, :-1], powers[:, 1:]), _ratio(powers[:, :, :-1], powers[:, :, 1:])
    c, d, e = (2 * np.arctan(each) + aside for each, aside in zip(t, _ASIDE))
    return np.stack(_others(links, c, d, e)), np.take_along_axis(apart, kept, axis=1).T


def _solved(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """A^-1 B; of matrices that are singular nevertheless, some answer that is finite."""
    try:
        return np.linalg.solve(A, B)
    except np.linalg.LinAlgError:
        return np.linalg.pinv(A, rcond=1e-14) @ B


def _six_free_of(terms: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """Six combinations (N, 14, 6) of fourteen equations without terms (N, 14, 8), and with most of rest (N, 14, 27)."""
    left, sizes, _ = np.linalg.svd(terms)
    rank = int((sizes > _RANK * sizes[:, :1]).sum(axis=1).max(initial=0))
    free = left[:, :, rank:]
    if rank == 8:
        return free
    return free @ np.linalg.svd(free.swapaxes(1, 2) @ rest)[0][:, :, :6]


def _products(T: np.ndarray) -> np.ndarray:
    """The fourteen products of the origin p and the axis z of transforms (..., 4, 4), (..., 14)."""
    p, z = T[..., :3, 3], T[..., :3, 2]
    pp, pz = (p * p).sum(-1, keepdims=True), (p * z).sum(-1, keepdims=True)
    return np.concatenate([p, z, np.cross(p, z), pp * z - 2 * pz * p, pp, pz], axis=-1)


def _ratio(lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """What lower (N, i, j, K) must be multiplied by to give upper, (K, N)."""
    across = (np.conj(lower) * upper).sum(axis=(1, 2)).real
    return (across / np.maximum((np.abs(lower) ** 2).sum(axis=(1, 2)), 1e-300)).T


def _others(links: Sequence[np.ndarray], c: np.ndarray, d: np.ndarray, e: np.ndarray) -> tuple[np.ndarray, ...]:
    """All six angles from three of them, (K, N) each."""
    B0, B1, B2, B3, B4, B5 = links
    middle = B1 @ motion(False, c) @ B2 @ motion(False, d) @ B3 @ motion(False, e) @ B4
    p, z = middle[..., :3, 3], middle[..., :3, 2]
    behind = np.linalg.inv(B5)
    goal_p, goal_z = behind[:, :3, 3], behind[:, :3, 2]
    R, shift = B0[:, :3, :3], B0[:, :3, 3]
    back = np.einsum("nji,nj->ni", R, shift)
    # Seen from behind a: heights, distance and their product do not change with a, and are affine in b.
    rows, rest = [], []
    for ahead, vector, goal in (
        (R[:, 2], z, goal_z[:, 2]),
        (R[:, 2], p, goal_p[:, 2] - shift[:, 2]),
        (back, p, ((goal_p**2).sum(1) - (p * p).sum(-1) - (shift**2).sum(1)) / 2),
        (back, z, (goal_p * goal_z).sum(1) - (p * z).sum(-1)),
    ):
        rows.append(
            [
                ahead[:, 0] * vector[..., 0] + ahead[:, 1] * vector[..., 1],
                ahead[:, 1] * vector[..., 0] - ahead[:, 0] * vector[..., 1],
            ]
        )
        rest.append(goal - ahead[:, 2] * vector[..., 2])
    x = [sum(row[0] * r for row, r in zip(rows, rest)), sum(row[1] * r for row, r in zip(rows, rest))]
    m00, m01, m11 = (sum(row[i] * row[j] for row in rows) for i, j in ((0, 0), (0, 1), (1, 1)))
    b = np.arctan2(m00 * x[1] - m01 * x[0], m11 * x[0] - m01 * x[1])
    seen = B0 @ motion(False, b) @ middle
    along = sum(
        (goal[:, 0] + 1j * goal[:, 1]) * np.conj(vector[..., 0] + 1j * vector[..., 1])
        for goal, vector in ((goal_p, seen[..., :3, 3]), (goal_z, seen[..., :3, 2]))
    )
    a = np.angle(along)
    last = np.linalg.inv(B5 @ motion(False, a) @ seen)
    f = np.arctan2(last[..., 1, 0] - last[..., 0, 1], last[..., 0, 0] + last[..., 1, 1])
    return a, b, c, d, e, f
