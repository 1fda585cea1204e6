"""Vectors of numbers or expressions."""

from __future__ import annotations

from dhkit.forms.vector import Vector

from .base import Comparison, Setting
from .entries import Entries, compare_entries
from .entries import read_entries as read

__all__ = ["compare", "read"]


def compare(form: Vector, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Entry by entry."""
    return compare_entries(form.names, student, other, setting)
