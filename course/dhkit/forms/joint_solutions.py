"""All ways to reach a target."""

from __future__ import annotations

import numpy as np

from .. import nodes
from ..schema import unique
from ..values import values
from .base import Fields, Names

MAX_SOLUTIONS = 100
"""Sets of solutions are compared pair by pair; a general six-axis arm has at most 16."""


class JointSolutions(Fields, frozen=True, kw_only=True):
    """A list of joint positions; an empty one says that there is no solution.

    Each is a list in the order of the joints or a dictionary keyed by their names; one alone may stand without the list
    around it, and several may be a dictionary of columns.

    Attributes
    ----------
    joints : tuple of str
        Names and order of the joint variables.
    """

    joints: Names

    def __post_init__(self) -> None:
        unique("joints", self.joints)
        if not self.joints:
            raise ValueError("joints: none is named")

    def arranged(self, node: object) -> object:
        node = nodes.rows_in_order(node, self.joints)
        alone = nodes.array_shape(node) == (len(self.joints),)
        return [node] if alone else node

    def misfit(self, node: object) -> str | None:
        shape = nodes.array_shape(node)
        if not isinstance(node, list) or (shape != (0,) and (shape is None or shape[1:] != (len(self.joints),))):
            return nodes.describe(node)
        if len(node) > MAX_SOLUTIONS:
            return f"{len(node)} solutions, more than any robot has"
        return nodes.alien(node, ()) or unreal(node)


def unreal(node: list) -> str | None:
    """What keeps an array of constant expressions from being one of real numbers, in words; None if nothing does."""
    if nodes.blanks(node):
        return "an entry that is not filled in"
    found = values(node, {})
    if not np.isfinite(found).all():
        return "a value that is not finite"
    return "a complex number" if np.abs(found.imag).max(initial=0) > 1e-9 else None
