"""Markdown in plain words, for terminals and pages that show none."""

from __future__ import annotations

import re


def plain(markdown: str) -> str:
    r"""Markdown without its marks: ``**$q_{1}$** in `q`, $l_1,\ h$`` becomes ``q1 in q, l1, h``."""
    without_indices = re.sub(r"_\{?(\w+)\}?(?=[^$`]*\$)", r"\1", markdown)
    without_fractions = re.sub(r"\\frac\{(.+?)\}\{(.+?)\}", r"\1/\2", without_indices)
    return re.sub(r"\\ |\\(?=\w)|\*\*|[$`]", lambda mark: " " if mark[0] == "\\ " else "", without_fractions)
