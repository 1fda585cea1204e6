"""A direction in space, in the plane or in joint space."""

from __future__ import annotations

from .vector import Vector


class Direction(Vector, frozen=True, kw_only=True):
    """A vector of which only the line counts that it lies on, neither its length nor its sense."""
