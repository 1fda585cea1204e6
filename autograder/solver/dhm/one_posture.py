"""Direct model and Jacobian at one posture, with Python's own numbers: arrays cost more than they hold there.

The formulas are those of `forward`, which has them for many postures.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .forward import Chain

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class OnePosture:
    """A chain as plain numbers.

    Attributes
    ----------
    rows : list of tuples
        Of each row a, cos alpha, sin alpha, the constant one of d and theta, whether it slides, the joints that move it
        as pairs (index, factor), and the offset.
    base, tool : lists of 3 rows of 4 floats
    coupling : (rows, n) array, or None where joint i moves row i alone, with factor 1
    """

    rows: list[tuple[float, float, float, float, bool, list[tuple[int, float]], float]]
    base: list[list[float]]
    tool: list[list[float]]
    coupling: np.ndarray | None

    @classmethod
    def of(cls, chain: Chain) -> OnePosture:
        """From a chain."""
        moved = [[(int(j), float(row[j])) for j in np.flatnonzero(row)] for row in chain.coupling]
        columns = (chain.a, chain.cos_alpha, chain.sin_alpha, chain.fixed, chain.prismatic)
        rows = list(zip(*(column.tolist() for column in columns), moved, chain.offset.tolist()))
        plain = np.array_equal(chain.coupling, np.eye(*chain.coupling.shape))
        return cls(rows, chain.base[:3].tolist(), chain.tool[:3].tolist(), None if plain else chain.coupling)

    def forward(self, q: Sequence[float]) -> np.ndarray:
        """Pose of the tool, (4, 4)."""
        (x, y, z, p), _ = self._walk(q)
        return np.array([(*xyzp,) for xyzp in zip(x, y, z, p)] + [(0.0, 0.0, 0.0, 1.0)])

    def jacobian(self, q: Sequence[float]) -> np.ndarray:
        """Geometric Jacobian of the tool point, (6, n)."""
        (_, _, _, (ex, ey, ez)), axes = self._walk(q)
        columns = []
        for (*_, slides, _, _), ((x, y, z), (px, py, pz)) in zip(self.rows, axes):
            if slides:
                columns.append((x, y, z, 0.0, 0.0, 0.0))
            else:
                u, v, w = ex - px, ey - py, ez - pz
                columns.append((y * w - z * v, z * u - x * w, x * v - y * u, x, y, z))
        J = np.array(columns).T
        return J[:, : len(q)].copy() if self.coupling is None else J @ self.coupling

    def _walk(self, q: Sequence[float]) -> tuple[tuple[Vector, Vector, Vector, Vector], list[tuple[Vector, Vector]]]:
        """Axes and origin of the tool, and of each row its axis and a point on that."""
        (x0, y0, z0, p0), (x1, y1, z1, p1), (x2, y2, z2, p2) = self.base
        axes = []
        for a, ca, sa, fixed, slides, moved, variable in self.rows:
            if a:
                p0, p1, p2 = p0 + a * x0, p1 + a * x1, p2 + a * x2
            if sa:
                y0, z0 = ca * y0 + sa * z0, ca * z0 - sa * y0
                y1, z1 = ca * y1 + sa * z1, ca * z1 - sa * y1
                y2, z2 = ca * y2 + sa * z2, ca * z2 - sa * y2
            elif ca < 0:
                y0, y1, y2, z0, z1, z2 = -y0, -y1, -y2, -z0, -z1, -z2
            axes.append(((z0, z1, z2), (p0, p1, p2)))
            for joint, factor in moved:
                variable += factor * q[joint]
            d, theta = (variable, fixed) if slides else (fixed, variable)
            if d:
                p0, p1, p2 = p0 + d * z0, p1 + d * z1, p2 + d * z2
            if theta:
                c, s = cos(theta), sin(theta)
                x0, y0 = c * x0 + s * y0, c * y0 - s * x0
                x1, y1 = c * x1 + s * y1, c * y1 - s * x1
                x2, y2 = c * x2 + s * y2, c * y2 - s * x2
        (a, b, c, d), (e, f, g, h), (i, j, k, m) = self.tool
        return (
            (a * x0 + e * y0 + i * z0, a * x1 + e * y1 + i * z1, a * x2 + e * y2 + i * z2),
            (b * x0 + f * y0 + j * z0, b * x1 + f * y1 + j * z1, b * x2 + f * y2 + j * z2),
            (c * x0 + g * y0 + k * z0, c * x1 + g * y1 + k * z1, c * x2 + g * y2 + k * z2),
            (
                d * x0 + h * y0 + m * z0 + p0,
                d * x1 + h * y1 + m * z1 + p1,
                d * x2 + h * y2 + m * z2 + p2,
            ),
        ), axes
