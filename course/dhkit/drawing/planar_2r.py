"""The planar 2R arm with joint limits: points of its hand, its postures, and the outline of its workspace.

Joint limits are rows (min, max) of t1 and t2, shape (2, 2), in radians, each at most a full turn wide.
"""

from __future__ import annotations

import itertools

import numpy as np

from ..geometry import lies_between, planar_joints, two_link
from .inputs import as_joint_limits, as_lengths, as_numbers


def grid_points(lengths, t1, t2) -> np.ndarray:
    """Points of the hand for every pair of joint values.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    t1, t2 : array-like, shapes (n,) and (m,), in radians

    Returns
    -------
    ndarray, shape (n, m, 2), in metres
    """
    lengths = as_lengths(lengths, "lengths", (2,))
    values = np.meshgrid(as_numbers(t1, "t1", (None,)), as_numbers(t2, "t2", (None,)), indexing="ij")
    return planar_joints(lengths, np.stack(values, axis=-1))[..., -1, :]


def hand_distance(lengths, t2) -> np.ndarray:
    """Distance of the hand from the base for elbow angles t2 of any shape, in radians; in metres."""
    return np.sqrt(lengths[0] ** 2 + lengths[1] ** 2 + 2 * lengths[0] * lengths[1] * np.cos(t2))


def solve_within_limits(lengths, limits, points) -> tuple[np.ndarray, np.ndarray]:
    """Both postures for each point, and which of them reach it within the joint limits.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
    points : array-like, shape (..., 2), in metres

    Returns
    -------
    q : ndarray, shape (2, ..., 2), in radians
        t1 and t2 with t2 >= 0 and with t2 <= 0.
    reached : ndarray of bool, shape (2, ...)
        On the edge of the reach, where both postures are the same, only the first one counts.
    """
    l1, l2 = as_lengths(lengths, "lengths", (2,))
    limits = as_joint_limits(limits)
    arm = two_link(np.asarray(points, float) @ (1, 1j), l1, l2)
    q = np.stack([arm.first, arm.bend], axis=-1)
    return q, arm.valid & lies_between(q, *limits.T).all(axis=-1)


def count_postures(lengths, limits, points) -> np.ndarray:
    """How many postures reach each point within the joint limits: 0, 1 or 2.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
    points : array-like, shape (..., 2), in metres

    Returns
    -------
    ndarray of int, shape (...)
    """
    return solve_within_limits(lengths, limits, points)[1].sum(axis=0)


def split_at_straight_elbow(limits) -> list[np.ndarray]:
    """Cut joint limits where the elbow is straight, so that in each piece every point has one pair of joint values.

    Parameters
    ----------
    limits : array-like, shape (2, 2), in radians

    Returns
    -------
    list of ndarrays, shape (2, 2), in radians
    """
    first, (low, high) = as_joint_limits(limits)
    # Stretched (0) and folded (pi), with their multiples.
    straight = np.pi * np.arange(np.ceil(low / np.pi - 1e-9), np.floor(high / np.pi + 1e-9) + 1)
    cuts = [low, *straight[(low < straight) & (straight < high)], high]
    return [np.array([first, piece]) for piece in itertools.pairwise(cuts)]


def trace_rim(lengths, limits, step=0.02) -> np.ndarray:
    """Image of the rim of a rectangle of joint values: the outline of one sheet of the workspace.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
    limits : array-like, shape (2, 2), in radians
        Without a straight elbow inside.
    step : float, in radians
        Greatest distance of neighbours along the rim, roughly.

    Returns
    -------
    ndarray, shape (k, 2), in metres
    """
    t1, t2 = (np.linspace(*row, max(2, int(np.ptp(row) / step))) for row in limits)
    sides = [
        grid_points(lengths, t1, t2[:1])[:, 0],
        grid_points(lengths, t1[-1:], t2)[0],
        grid_points(lengths, t1[::-1], t2[-1:])[:, 0],
        grid_points(lengths, t1[:1], t2[::-1])[0],
    ]
    return np.vstack(sides)
