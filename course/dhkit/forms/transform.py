"""Homogeneous transforms."""

from __future__ import annotations

import numpy as np

from .base import Parts, Sight, seen, squeezed
from .matrix import Matrix


class Transform(Matrix, frozen=True, kw_only=True):
    """A homogeneous transform: a square matrix of a rotation block, a position and the last row 0 ... 0 1."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.shape) != 2 or self.shape[0] != self.shape[1] or self.shape[0] < 2:
            raise ValueError(f"shape: a transform is square, found {list(self.shape)}")

    def invariants(self, node: object, sight: Sight) -> Parts:
        found = seen(node, sight)
        if found is None:
            return {}
        cells = np.arange(found.shape[1]).reshape(self.shape)
        blocks = {"": cells, "rotation": cells[:-1, :-1], "position": cells[:-1, -1]}
        return {part: squeezed(found[:, block.ravel()]) for part, block in blocks.items()}
