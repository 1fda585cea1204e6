"""Functions, which are judged by what they return."""

from __future__ import annotations

from .. import nodes
from .base import Fields, Form


class Function(Fields, frozen=True, kw_only=True):
    """Something that can be called.

    Attributes
    ----------
    returns : Form
        Form of what it returns, of any other kind.
    """

    returns: Form

    def __post_init__(self) -> None:
        if isinstance(self.returns, Function):
            raise ValueError("returns.kind: a function cannot return a function here")

    def misfit(self, node: object) -> str | None:
        return None if isinstance(node, dict) and "function" in node else nodes.describe(node)
