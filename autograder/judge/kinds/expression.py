"""One expression."""

from __future__ import annotations

from dhkit.forms.expression import Expression

from .base import Comparison, Setting
from .entries import Entries, compare_entries
from .entries import read_entries as read

__all__ = ["compare", "read"]


def compare(form: Expression, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Equal where the values at the sample points are."""
    return compare_entries((), student, other, setting)
