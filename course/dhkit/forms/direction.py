"""A direction in space, in the plane or in joint space."""

from __future__ import annotations

import numpy as np

from .base import Parts, Sight, seen
from .vector import Vector


class Direction(Vector, frozen=True, kw_only=True):
    """A vector of which only the line counts that it lies on, neither its length nor its sense."""

    def invariants(self, node: object, sight: Sight) -> Parts:
        found = seen(node, sight)
        if found is None or not (length := np.linalg.norm(found, axis=1, keepdims=True)).all():
            return {}
        unit = found / length
        return {"": (unit[:, :, None] * unit[:, None]).ravel()}
