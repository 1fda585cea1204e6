"""Tables of modified Denavit-Hartenberg parameters."""

from __future__ import annotations

from .. import nodes
from ..schema import unique
from .base import Names, Size, Symbolic

DH_COLUMNS = ("sigma", "a", "alpha", "d", "theta")


class DHTable(Symbolic, frozen=True, kw_only=True):
    """Rows [sigma, a, alpha, d, theta], as lists or as dictionaries; the table may be a dictionary of columns, too.

    Attributes
    ----------
    shape : tuple of int
        Rows and columns; there are always five columns.
    joints : tuple of str
        Joint variables in the order of the joints; a row more than joints is a constant one, such as a tool.
    """

    shape: tuple[Size, Size]
    joints: Names

    def __post_init__(self) -> None:
        super().__post_init__()
        unique("joints", self.joints)
        rows, columns = self.shape
        if columns != len(DH_COLUMNS):
            raise ValueError(f"shape: a row is {', '.join(DH_COLUMNS)}, five cells; found {columns}")
        if not 1 <= len(self.joints) <= rows:
            raise ValueError(f"joints: {len(self.joints)} for a table of {rows} rows")
        if strange := set(self.joints) - set(self.symbols):
            raise ValueError(f"joints: {min(strange)} is not among the symbols")

    def arranged(self, node: object) -> object:
        return nodes.rows_in_order(node, DH_COLUMNS)
