"""A chain cut at its revolute joints: links joined by prismatic joints turn alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Segment:
    """Links between two successive revolute joints, with the prismatic joints between them (joints count from 0).

    ``entry`` is None at the base, ``exit`` at the hand.
    """

    entry: int | None
    sliders: tuple[int, ...]
    exit: int | None

    @property
    def carried(self) -> list[int]:
        """Joints whose frames are fixed on links of the segment."""
        return [*([] if self.entry is None else [self.entry]), *self.sliders]

    @property
    def directions(self) -> list[int]:
        """Joints whose axes have a fixed direction in the segment."""
        return [*self.carried, *([] if self.exit is None else [self.exit])]


def segments(prismatic: Sequence[bool]) -> list[Segment]:
    """The segments of a chain whose joint i is prismatic where ``prismatic[i]``, base first."""
    found, entry, sliders = [], None, []
    for joint, slides in enumerate(prismatic):
        if slides:
            sliders.append(joint)
        else:
            found.append(Segment(entry, tuple(sliders), joint))
            entry, sliders = joint, []
    return [*found, Segment(entry, tuple(sliders), None)]
