"""Poses and Jacobians of some dozens of postures in one go, by products of matrices.

For so few the number of operations on arrays counts, not their size: `forward` multiplies less, and is faster for many.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .geometry import cross, modified_dh_of_cosines

if TYPE_CHECKING:
    from .forward import Chain

FEW = 512
"""Postures up to which this is the faster way."""


@dataclass(frozen=True)
class FewPostures:
    """A chain whose matrices are affine in functions of their row's variable v: (1, cos v, sin v), of a slide (1, v, 0).

    Attributes
    ----------
    affine : (rows, 3, 16) array
        Coefficients of the entries of each row's matrix, the base in the first one's.
    slides : (rows,) int array
        Indices of the rows that slide.
    coupling : (rows, n) array
    offset : (rows, 1) array
        Radians or metres.
    tool : (4, 4) array
    """

    affine: np.ndarray
    slides: np.ndarray
    coupling: np.ndarray
    offset: np.ndarray
    tool: np.ndarray

    @classmethod
    def of(cls, chain: Chain) -> FewPostures:
        """From a chain."""
        zero, first, second = np.array([[0, 0, 0], [0, 1, 0], [0, 0, 1.0]])[:, :, None]
        slide = np.where(chain.prismatic, first, chain.fixed)
        cosine = np.where(chain.prismatic, np.cos(chain.fixed), first)
        sine = np.where(chain.prismatic, np.sin(chain.fixed), second)
        affine = modified_dh_of_cosines(chain.a + zero, chain.cos_alpha, chain.sin_alpha, slide, cosine, sine)
        affine[1:] -= affine[0]
        affine[:, 0] = chain.base @ affine[:, 0]
        slides = np.flatnonzero(chain.prismatic)
        by_row = affine.swapaxes(0, 1).reshape(len(chain.a), 3, 16)
        return cls(by_row, slides, chain.coupling, chain.offset[:, None], chain.tool)

    def poses_and_jacobians(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Poses (N, 4, 4) and geometric Jacobians (N, 6, n) for joint values (N, n)."""
        variables = self.coupling @ q.T + self.offset
        terms = np.ones((*variables.shape, 3))
        np.cos(variables, out=terms[..., 1])
        np.sin(variables, out=terms[..., 2])
        if len(self.slides):
            terms[self.slides, :, 1], terms[self.slides, :, 2] = variables[self.slides], 0.0
        frames = (terms @ self.affine).reshape(*variables.shape, 4, 4)
        for row in range(1, len(frames)):
            frames[row] = frames[row - 1] @ frames[row]
        poses = frames[-1] @ self.tool
        axes = frames[..., :3, 2]
        columns = np.concatenate([cross(axes, poses[:, :3, 3] - frames[..., :3, 3]), axes], axis=-1)
        if len(self.slides):
            columns[self.slides, :, :3], columns[self.slides, :, 3:] = axes[self.slides], 0.0
        return poses, columns.transpose(1, 2, 0) @ self.coupling
