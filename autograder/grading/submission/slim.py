"""Cuts out of a notebook's file, before it is parsed, what grading does not read.

Outputs are most of a notebook, and the only part that its author did not write: pictures by the megabyte, numbers
such as NaN that are no JSON, structures of any depth. None of it is looked at, so none of it may cost points.
"""

from __future__ import annotations

import re

_TOKEN = re.compile(rb'"[^"\\]*(?:\\.[^"\\]*)*"|[\[\]{}]', re.DOTALL)
_COLON = re.compile(rb"\s*:")
# Depth of a key of a cell: inside the notebook, inside its list of cells, inside the cell.
_IN_CELL = 3


class TooManyTokens(ValueError):
    """The file holds more brackets and texts than any notebook."""


def cut(content: bytes, key: bytes, limit: int) -> bytes:
    """`content` with the value of a key replaced by an empty one in every cell.

    Parameters
    ----------
    content : bytes
        JSON; what is malformed outside the value stays as it is, for the parser to refuse.
    key : bytes
        For example ``b"outputs"``. A value that is neither a list nor an object stays.
    limit : int
        Most brackets and texts that are looked at.

    Raises
    ------
    TooManyTokens
        If there are more.
    """
    kept: list[bytes] = []
    start = depth = 0
    value_follows, cutting_from = False, -1
    for count, token in enumerate(_TOKEN.finditer(content)):
        if count >= limit:
            raise TooManyTokens(f"more than {limit:,} brackets and texts")
        first = content[token.start() : token.start() + 1]
        if first == b'"':
            is_key = depth == _IN_CELL and token[0][1:-1] == key and _COLON.match(content, token.end()) is not None
            value_follows = is_key and cutting_from < 0
        elif first in b"[{":
            if value_follows:
                cutting_from, value_follows = token.start(), False
            depth += 1
        else:
            depth -= 1
            if cutting_from >= 0 and depth == _IN_CELL:
                opening = content[cutting_from : cutting_from + 1]
                kept += (content[start:cutting_from], b"[]" if opening == b"[" else b"{}")
                start, cutting_from = token.end(), -1
    return b"".join((*kept, content[start:]))
