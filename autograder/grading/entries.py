"""From a share to points, and from a note to the comment that nbgrader stores."""

from __future__ import annotations

import re

_COMMENT = re.compile(r"note: ([a-z0-9_+]+)\Z")


def points(share: float, maximum: float) -> float:
    """Points for a share of `maximum`, to a hundredth; `ValueError` for a share outside 0 to 1.

    nbgrader reads a negative or odd score as full marks, so nothing of the kind may reach it.
    """
    if not 0 <= share <= 1:
        raise ValueError(f"a share of the points must lie between 0 and 1, found {share}")
    return maximum if share == 1 else min(round(share * maximum, 2), maximum)


def comment(note: str) -> str:
    """The comment that stands for an answer note in the gradebook."""
    return f"note: {note}"


def note_of(text: str | None) -> str | None:
    """The answer note in a comment, None if it is another comment."""
    found = _COMMENT.match(text or "")
    return found and found[1]
