"""Matrices, and stacks of matrices."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from .base import Size, Symbolic


class Matrix(Symbolic, frozen=True, kw_only=True):
    """A matrix, as nested lists, NumPy array or SymPy Matrix; a list of matrices where the shape has three sizes.

    Attributes
    ----------
    shape : tuple of int
        Rows and columns, ``[3, 3]`` in the table.
    """

    shape: Annotated[tuple[Size, ...], Meta(min_length=2, max_length=3)]
