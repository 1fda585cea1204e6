"""Homogeneous transforms."""

from __future__ import annotations

from .matrix import Matrix


class Transform(Matrix, frozen=True, kw_only=True):
    """A homogeneous transform: a square matrix of a rotation block, a position and the last row 0 ... 0 1."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.shape) != 2 or self.shape[0] != self.shape[1] or self.shape[0] < 2:
            raise ValueError(f"shape: a transform is square, found {list(self.shape)}")
