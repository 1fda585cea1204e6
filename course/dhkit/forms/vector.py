"""Several numbers or expressions in a fixed order."""

from __future__ import annotations

from .. import nodes
from ..schema import unique
from .base import Names, Size, Symbolic


class Vector(Symbolic, frozen=True, kw_only=True):
    """A list of expressions, or a matrix of one row or one column; a dictionary, too, where the entries have names.

    Attributes
    ----------
    shape : tuple of int
        How many there are, ``[3]`` in the table.
    names : tuple of str
        Names of the entries.
    unordered : bool
        Whether the numbers may stand in any order.
    """

    shape: tuple[Size]
    names: Names = ()
    unordered: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        unique("names", self.names)
        if self.names and len(self.names) != self.shape[0]:
            raise ValueError(f"names: {len(self.names)} for {self.shape[0]} entries")

    def arranged(self, node: object) -> object:
        node = nodes.in_order(nodes.listed(node) if self.unordered else node, self.names)
        (count,) = self.shape
        flat = nodes.array_shape(node) in ((count, 1), (1, count))
        node = list(nodes.entries(node)) if flat else node
        if self.unordered and isinstance(node, list) and all(isinstance(entry, (int, float)) for entry in node):
            return sorted(node)
        return node
