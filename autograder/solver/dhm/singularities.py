"""Geometric Jacobian, and the rank that exposes lost freedom."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .forward import Chain
from .tables import DHTable


def jacobian(table: DHTable, q: ArrayLike) -> np.ndarray:
    """Geometric Jacobian of the tool point in the base's axes.

    Parameters
    ----------
    table : DHTable
    q : array_like, shape (..., n)
        Radians or metres.

    Returns
    -------
    array, shape (..., 6, n)
        Rows 0 to 2 the velocity of the tool point (m/s), rows 3 to 5 the angular velocity (rad/s), per unit of each
        joint's speed.

    Source: D. Whitney, "Resolved motion rate control of manipulators and human prostheses", 1969,
    doi:10.1109/TMMS.1969.299896.
    """
    return table.chain.jacobian(q)


def rank(table: DHTable, q: ArrayLike, tol: float = 1e-9) -> np.ndarray:
    """Rank of the Jacobian: the freedoms that are left at joint values.

    Parameters
    ----------
    table : DHTable
    q : array_like, shape (..., n)
        Radians or metres.
    tol : float
        Smallest singular value that counts, relative to the largest.

    Returns
    -------
    int array, shape (...)
    """
    return _rank(jacobian(table, q), tol)


def _rank(J: np.ndarray, tol: float = 1e-9) -> np.ndarray:
    values = np.linalg.svd(J, compute_uv=False)
    return (values > tol * values[..., :1]).sum(axis=-1)


def mobility(table: DHTable, samples: int = 20, seed: int = 0) -> int:
    """Freedoms of the robot in general position: the largest rank at random postures.

    Less than the number of joints means that the table itself is degenerate.
    """
    return chain_mobility(table.chain, samples, seed)


def chain_mobility(chain: Chain, samples: int = 20, seed: int = 0, rows: int = 6) -> int:
    """`mobility` of a table that is numbers already; of the tool point with the first three rows only."""
    q = np.random.default_rng(seed).uniform(-1.0, 1.0, (samples, chain.joints))
    return int(_rank(chain.jacobian(q)[:, :rows]).max())
