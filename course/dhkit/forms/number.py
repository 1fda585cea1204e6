"""One number."""

from __future__ import annotations

from .. import nodes
from .base import Fields, Parts, Sight, seen, squeezed


class Number(Fields, frozen=True, kw_only=True):
    """One number, or an expression without symbols such as ``sqrt(2)/2``; it may be the only entry of a list or an array."""

    def arranged(self, node: object) -> object:
        return nodes.alone(node)

    def misfit(self, node: object) -> str | None:
        return nodes.describe(node) if isinstance(node, list) else nodes.alien(node, ())

    def invariants(self, node: object, sight: Sight) -> Parts:
        found = seen(node, sight)
        return {} if found is None else {"": squeezed(found)}
