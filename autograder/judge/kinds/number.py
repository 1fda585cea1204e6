"""One number."""

from __future__ import annotations

from dhkit.forms.number import Number

from .base import Comparison, Setting
from .entries import Entries, compare_entries
from .entries import read_entries as read

__all__ = ["compare", "read"]


def compare(form: Number, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Equal within the tolerance."""
    return compare_entries((), student, other, setting)
