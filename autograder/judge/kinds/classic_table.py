"""Classic tables: right when their product is, as where the frames between lie is not asked for."""

from __future__ import annotations

import numpy as np

from dhkit.forms.classic_table import CLASSIC_COLUMNS, ClassicTable

from .base import Comparison, Setting
from .entries import Entries, agreement, differing_cells
from .entries import read_entries as read

__all__ = ["compare", "read"]


def compare(form: ClassicTable, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Cell by cell, or else by the transforms of the whole tables at the sample points."""
    turning = np.broadcast_to([name in ("alpha", "theta") for name in CLASSIC_COLUMNS], form.shape)
    agree = agreement(student, other, setting, turning.ravel()).reshape(form.shape)
    if not agree.all() and _same_product(form, student, other, setting):
        return Comparison(True, 1.0, aside="The frames between are other ones than ours.")
    return Comparison(bool(agree.all()), float(agree.mean()), differing_cells(agree))


def _same_product(form: ClassicTable, student: Entries, other: Entries, setting: Setting) -> bool:
    theirs, ours = (entries.values(setting.samples) for entries in (student, other))
    if not np.isfinite(theirs).all() or np.abs(theirs.imag).max() > setting.tolerance:
        return False
    gap = form.products(theirs.real) - form.products(ours.real)
    return bool((np.abs(gap) <= setting.tolerance).all())
