"""Linear equations ``rows @ x = wanted`` at K sample points at once, all of the same rank there."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

RANK = 1e-7
"""Under this, a coefficient of equations whose rows are of length 1 counts as zero."""


class Equations(NamedTuple):
    """``rows`` (K, e, x) and ``wanted`` (..., K, e): e equations for x unknowns, for one or several right-hand sides."""

    rows: np.ndarray
    wanted: np.ndarray

    def projected(self, projection: np.ndarray) -> Equations:
        """The equations multiplied from the left by (K, e, e) matrices."""
        return Equations(projection @ self.rows, times(projection, self.wanted))


def together(parts: Iterable[Equations]) -> Equations:
    """All equations as one set."""
    rows, wanted = zip(*parts, strict=True)
    return Equations(np.concatenate(rows, axis=1), np.concatenate(wanted, axis=-1))


@dataclass(frozen=True)
class LeastSquares:
    """Least-squares solutions of equations with several right-hand sides.

    ``solutions`` (c, K, x); ``exact`` (c,) where they meet the equations; ``settled`` (x,) for unknowns with one
    value only.
    """

    solutions: np.ndarray
    exact: np.ndarray
    settled: np.ndarray

    @classmethod
    def of(cls, equations: Equations, tolerance: float, inverse: np.ndarray | None = None) -> LeastSquares:
        """inverse: the pseudo-inverse of the rows, if it is known."""
        rows, wanted = equations
        inverse = pseudo_inverse(rows) if inverse is None else inverse
        solutions = times(inverse, wanted)
        residual = np.abs(times(rows, solutions) - wanted)
        settled = np.all(np.diagonal(inverse @ rows, axis1=1, axis2=2) > 1 - RANK, axis=0)
        return cls(solutions, np.all(residual <= tolerance, axis=(1, 2)), settled)


@dataclass(frozen=True)
class SolutionSpace:
    """All solutions of equations: ``point`` (K, x) plus any combination of the columns of ``basis`` (K, x, dimension)."""

    point: np.ndarray
    basis: np.ndarray

    @classmethod
    def whole(cls, count: int, size: int) -> SolutionSpace:
        """Every x of `size` numbers, at `count` sample points."""
        return cls(np.zeros((count, size)), np.broadcast_to(np.eye(size), (count, size, size)))

    @property
    def dimension(self) -> int:
        """How many unknowns are still free."""
        return self.basis.shape[-1]

    def leaves_open(self, equations: Equations) -> bool:
        """Whether the left-hand sides are not the same for all solutions."""
        return bool(np.abs(equations.rows @ self.basis).max() > RANK)

    def meets(self, equations: Equations, tolerance: float) -> bool:
        """Whether the point meets the equations."""
        return bool((np.abs(times(equations.rows, self.point) - equations.wanted) <= tolerance).all())

    def narrowed(self, equations: Equations) -> SolutionSpace:
        """The solutions that meet further equations, as nearly as they can."""
        gap = equations.wanted - times(equations.rows, self.point)
        u, s, vt = np.linalg.svd(equations.rows @ self.basis)
        rank = int((s[0] > RANK).sum())
        step = transposed(vt[:, :rank]) @ ((transposed(u[:, :, :rank]) @ gap[..., None]) / s[:, :rank, None])
        return SolutionSpace(self.point + times(self.basis, step[..., 0]), self.basis @ transposed(vt[:, rank:]))


def times(matrices: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Matrices (..., e, x) applied to vectors (..., x)."""
    return (matrices @ vectors[..., None])[..., 0]


def transposed(matrices: np.ndarray) -> np.ndarray:
    """Matrices (..., e, x) with rows and columns exchanged."""
    return np.swapaxes(matrices, -1, -2)


def pseudo_inverse(matrices: np.ndarray) -> np.ndarray:
    """Moore-Penrose inverses of matrices (K, e, x), of which e or x may be 0."""
    if 0 in matrices.shape:
        return np.zeros(transposed(matrices).shape)
    return np.linalg.pinv(matrices, rcond=RANK)
