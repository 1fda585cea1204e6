"""Tables of classic Denavit-Hartenberg parameters."""

from __future__ import annotations

import numpy as np

from .. import nodes
from ..geometry import chain_products, classic_dh
from .base import Parts, Sight, Size, seen, squeezed
from .matrix import Matrix

CLASSIC_COLUMNS = ("a", "alpha", "d", "theta")


class ClassicTable(Matrix, frozen=True, kw_only=True):
    """Rows [a, alpha, d, theta], as lists or as dictionaries; those with the same product are equal, whatever their frames.

    Attributes
    ----------
    shape : tuple of int
        Rows and columns; there are always four columns.
    """

    shape: tuple[Size, Size]

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.shape[1] != len(CLASSIC_COLUMNS):
            raise ValueError(f"shape: a row is {', '.join(CLASSIC_COLUMNS)}, four cells; found {self.shape[1]}")

    def arranged(self, node: object) -> object:
        return nodes.rows_in_order(node, CLASSIC_COLUMNS)

    def invariants(self, node: object, sight: Sight) -> Parts:
        found = seen(node, sight)
        return {} if found is None else {"": squeezed(self.products(found).reshape(len(found), -1))}

    def products(self, values: np.ndarray) -> np.ndarray:
        """The transforms of the whole tables, (N, 4, 4), of the values (N, m) of their cells."""
        columns = values.reshape(len(values), *self.shape).transpose(2, 1, 0)
        return chain_products(classic_dh(*columns))[-1]
