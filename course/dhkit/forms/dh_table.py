"""Tables of modified Denavit-Hartenberg parameters."""

from __future__ import annotations

import numpy as np

from .. import nodes
from ..geometry import modified_dh
from ..schema import unique
from .base import Names, Parts, Sight, Size, Symbolic, seen, squeezed

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

    def invariants(self, node: object, sight: Sight) -> Parts:
        """The hand at every point, sigma of every row, and what is pinned of the frames between."""
        found = seen(node, sight)
        if found is None:
            return {}
        sigma, a, alpha, d, theta = np.moveaxis(found.reshape(-1, *self.shape), -1, 0)
        frames = [np.broadcast_to(np.eye(4), (len(found), 4, 4))]
        for step in np.moveaxis(modified_dh(a, alpha, d, theta), 1, 0):
            frames.append(frames[-1] @ step)
        columns = [{"x": 0, "z": 2, "origin": 3}[pin] for pin in sight.pins]
        pinned = np.array(frames[1:-1]).reshape(-1, 4, 4)[:, :3, columns]
        looks = (frames[-1][:, :3].ravel(), sigma.ravel(), pinned.ravel())
        return {"": squeezed(np.concatenate(looks)[None])}

    def witness(self, node: object, sight: Sight) -> np.ndarray:
        """Behind what is the same for all tables of a chain, the cells as they are written: by them mistakes are told apart."""
        found = seen(node, sight)
        if found is None:
            return np.zeros(0)
        angles = tuple(i for i in range(found.shape[1]) if DH_COLUMNS[i % len(DH_COLUMNS)] in ("alpha", "theta"))
        return np.concatenate([self.invariants(node, sight)[""], squeezed(found[:1], angles)])

    def essential(self, witness: np.ndarray) -> np.ndarray:
        # Of the five cells of a row two are angles, each a cosine and a sine.
        return witness[: len(witness) - 7 * self.shape[0]]

    def agree(self, first: np.ndarray, second: np.ndarray, sight: Sight) -> bool:
        shared = min(len(first), len(second))
        return shared > 0 and super().agree(first[:shared], second[:shared], sight)
