"""One of several letters."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from .. import nodes
from ..schema import unique
from .base import Fields

Letter = Annotated[str, Meta(pattern="^[A-Z0-9]+$")]


class Choice(Fields, frozen=True, kw_only=True):
    """The letter of one of the options, in capitals or not.

    Attributes
    ----------
    options : tuple of str
        Letters to choose from.
    """

    options: Annotated[tuple[Letter, ...], Meta(min_length=2)]

    def __post_init__(self) -> None:
        unique("options", self.options)

    def arranged(self, node: object) -> object:
        return node.strip().upper() if isinstance(node, str) else node

    def misfit(self, node: object) -> str | None:
        if not isinstance(node, str):
            return nodes.describe(node)
        return None if node in self.options else f"{nodes.quoted(node)}, which is none of {', '.join(self.options)}"
