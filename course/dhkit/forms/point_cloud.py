"""Clouds of points."""

from __future__ import annotations

from .. import nodes
from .base import Fields, Size
from .joint_solutions import unreal

MAX_POINTS = 5000


class PointCloud(Fields, frozen=True, kw_only=True):
    """Points as rows of coordinates.

    Attributes
    ----------
    shape : tuple of int
        Number of coordinates of a point, ``[2]`` or ``[3]`` in the table.
    """

    shape: tuple[Size]

    def arranged(self, node: object) -> object:
        return nodes.listed(node)

    def misfit(self, node: object) -> str | None:
        if isinstance(node, dict) and "large" in node:
            return f"{nodes.describe(node)}; {MAX_POINTS} points are enough"
        shape = nodes.array_shape(node)
        if not isinstance(node, list) or shape is None or shape[1:] != self.shape:
            turned = shape is not None and len(shape) == 2 and shape[:1] == self.shape
            return nodes.describe(node) + (": each point is a row, not a column" if turned else "")
        if len(node) > MAX_POINTS:
            return f"{len(node)} points; {MAX_POINTS} are enough"
        return nodes.alien(node, ()) or unreal(node)
