"""Two slips in one answer."""

from __future__ import annotations

from ..tree import Slip


def together(first: Slip, second: Slip) -> Slip:
    """Both of them; the same one at two places counts twice."""
    notes = sorted({first.note, second.note})
    return Slip("+".join(notes), first.share * second.share, f"{first.feedback}\n\n{second.feedback}")
