"""One expression."""

from __future__ import annotations

from .base import Symbolic


class Expression(Symbolic, frozen=True, kw_only=True):
    """One expression in the symbols of the question."""
