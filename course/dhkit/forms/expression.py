"""One expression."""

from __future__ import annotations

from .. import nodes
from .base import Symbolic


class Expression(Symbolic, frozen=True, kw_only=True):
    """One expression in the symbols of the question; it may be the only entry of a list, as of what ``solve`` returns."""

    def arranged(self, node: object) -> object:
        return nodes.alone(node)
