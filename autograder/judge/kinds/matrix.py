"""Matrices."""

from __future__ import annotations

import numpy as np

from dhkit.forms.matrix import Matrix

from .base import Comparison, Setting
from .entries import Entries, agreement, differing_cells
from .entries import read_entries as read

__all__ = ["compare", "read"]


def compare(form: Matrix, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Cell by cell; of a list of symbolic matrices only those count as right that are so in all cells."""
    agree = agreement(student, other, setting, np.isin(np.arange(len(student.expressions)), setting.angles)).reshape(
        form.shape
    )
    parts = agree.all(axis=(1, 2)) if agree.ndim == 3 and form.symbols else agree
    return Comparison(bool(agree.all()), float(parts.mean()), differing_cells(agree))
