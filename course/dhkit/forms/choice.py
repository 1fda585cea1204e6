"""One of several letters."""

from __future__ import annotations

import string
import unicodedata
from typing import Annotated

from msgspec import Meta

from .. import nodes
from ..schema import unique
from .base import Fields

_AROUND = string.punctuation + string.whitespace
Letter = Annotated[str, Meta(pattern="^[A-Z0-9]+$")]


class Choice(Fields, frozen=True, kw_only=True):
    """The letter of one of the options, in capitals or not; the list, the brackets or the full stop around it do not count.

    Attributes
    ----------
    options : tuple of str
        Letters to choose from.
    """

    options: Annotated[tuple[Letter, ...], Meta(min_length=2)]

    def __post_init__(self) -> None:
        unique("options", self.options)

    def arranged(self, node: object) -> object:
        node = nodes.alone(node)
        match node:
            case str(said) | {"sym": str(said)} | {"const": str(said)}:
                return unicodedata.normalize("NFKC", said).strip(_AROUND).upper() or said
        return node

    def misfit(self, node: object) -> str | None:
        if not isinstance(node, str):
            return nodes.describe(node)
        return None if node in self.options else f"{nodes.quoted(node)}, which is none of {', '.join(self.options)}"
