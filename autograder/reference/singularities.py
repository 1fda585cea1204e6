"""Geometric Jacobian, its determinant in closed form, and the rank that exposes lost freedom.

Sources: singular postures of the RX-90 (MECA 953 slides), two-link arm (EPFL slides), s600
tutorial, PUMA-like table of the DH-m slides (Romanian).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import sympy as sp
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
    return chain_jacobian(table.chain, q)


def chain_jacobian(chain: Chain, q: ArrayLike) -> np.ndarray:
    """`jacobian` of a table that is numbers already."""
    frames = chain.frames(q)
    axes = frames[..., :3, 2]
    arms = chain.forward(q)[..., None, :3, 3] - frames[..., :3, 3]
    slides = chain.prismatic[:, None]
    columns = np.concatenate([np.where(slides, axes, np.cross(axes, arms)), np.where(slides, 0.0, axes)], axis=-1)
    return np.swapaxes(columns, -1, -2) @ chain.coupling


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

    Less than the number of joints means that the table itself is degenerate. The printed
    PUMA-like table has 5: its row 6 puts axis 6 on axis 5.
    """
    return chain_mobility(table.chain, samples, seed)


def chain_mobility(chain: Chain, samples: int = 20, seed: int = 0, rows: int = 6) -> int:
    """`mobility` of a table that is numbers already; of the tool point with the first three rows only."""
    q = np.random.default_rng(seed).uniform(-1.0, 1.0, (samples, chain.joints))
    return int(_rank(chain_jacobian(chain, q)[:, :rows]).max())


def two_link_determinant(l1: Any, l2: Any, t2: Any) -> Any:
    """det of d(x, y)/d(t1, t2) of a planar two-link arm, and of the SCARA's (x, y) part.

    Lengths in metres, t2 in radians; numbers, arrays or SymPy expressions, as the result (square metres).
    Source: two-link arm of the EPFL slides.
    """
    return l1 * l2 * _sin(t2)


def scara_determinant(l1: Any, l2: Any, t2: Any, slide: int = 1, turn: int = 1) -> Any:
    """det of d(x, y, z, omega)/dq of a SCARA.

    l1, l2, t2 and the result as for `two_link_determinant`. slide, turn: +1 or -1, the sense in which joint 3 raises z and joint 4 raises omega. Both
    are -1 on one of the course's two SCARAs: joint 3 of the MECA 953 slides (depth d2), joint
    4 of the s600 (axis pointing down).
    """
    return slide * turn * two_link_determinant(l1, l2, t2)


def rx90_determinant(a3: Any, d3: Any, t2: Any, t3: Any, t5: Any) -> Any:
    """det of the 6x6 geometric Jacobian of the RX-90 at the wrist centre.

    Three factors, three singularities: elbow (cos t3 = 0), wrist (sin t5 = 0), shoulder
    (wrist centre on axis 1). Lengths in metres, angles in radians; numbers, arrays or SymPy expressions, as the
    result (cubic metres). Source: singular postures of the RX-90, MECA 953 slides.
    """
    return -a3 * d3 * _cos(t3) * _sin(t5) * (_sin(t2 + t3) * d3 - _cos(t2) * a3)


def _sin(angle: Any) -> Any:
    return sp.sin(angle) if isinstance(angle, sp.Basic) else np.sin(angle)


def _cos(angle: Any) -> Any:
    return sp.cos(angle) if isinstance(angle, sp.Basic) else np.cos(angle)
