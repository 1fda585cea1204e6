"""Orientations as three angles."""

from __future__ import annotations

import re
from typing import Annotated, Literal

from msgspec import Meta

from ..geometry import rotation
from .base import Parts, Sight, seen
from .vector import Vector


class Orientation(Vector, frozen=True, kw_only=True):
    """Three angles of a set that the question names.

    Attributes
    ----------
    axes : str
        Letters of the three axes in the order of the angles, for example ``"zyx"``.
    frames : str
        Whether they are axes of the ``"moving"`` or of the ``"fixed"`` frame.
    """

    shape: tuple[Annotated[int, Meta(ge=3, le=3)]] = (3,)
    axes: str
    frames: Literal["moving", "fixed"] = "moving"

    def __post_init__(self) -> None:
        super().__post_init__()
        turns = re.fullmatch("[xyz]{3}", self.axes)
        if not turns or self.axes[1] in (self.axes[0], self.axes[2]):
            raise ValueError(f"axes: {self.axes!r} is not three of x, y, z, each another one than the one before")

    def invariants(self, node: object, sight: Sight) -> Parts:
        found = seen(node, sight)
        if found is None:
            return {}
        first, second, third = (rotation(axis, angles) for axis, angles in zip(self.axes, found.T, strict=True))
        turned = third @ second @ first if self.frames == "fixed" else first @ second @ third
        return {"": turned.ravel()}
