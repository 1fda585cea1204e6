"""One of several letters."""

from __future__ import annotations

from dhkit.forms.choice import Choice

from ..decode import Text
from .base import Comparison, Setting

__all__ = ["compare", "read"]


def read(form: Choice, value: Text) -> str:
    return value.value


def compare(form: Choice, student: str, other: str, setting: Setting) -> Comparison:
    """The same letter or not."""
    return Comparison(student == other, float(student == other))
