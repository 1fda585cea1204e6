"""Directions: vectors that count as equal when they are parallel."""

from __future__ import annotations

import numpy as np

from dhkit.forms.direction import Direction

from .base import Comparison, Setting
from .entries import Entries
from .entries import read_entries as read

__all__ = ["compare", "read"]


def compare(form: Direction, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Lengths and senses are free."""
    theirs, ours = (_unit(entries.values(setting.samples)) for entries in (student, other))
    aligned = np.abs((theirs * ours.conj()).sum(axis=1))
    if np.isfinite(aligned).all() and (aligned > 1 - setting.tolerance).all():
        return Comparison(True, 1.0)
    if not np.isfinite(aligned).all():
        return Comparison(False, 0.0, ("a direction cannot be all zeros or undefined",))
    worst = np.degrees(np.arccos(np.clip(aligned.min(), 0, 1)))
    return Comparison(False, 0.0, (f"the direction is off by {worst:.3g} deg",))


def _unit(vectors: np.ndarray) -> np.ndarray:
    with np.errstate(all="ignore"):
        vectors = vectors / np.abs(vectors).max(axis=1, keepdims=True)  # the squares of huge ones are beyond float64
        return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
