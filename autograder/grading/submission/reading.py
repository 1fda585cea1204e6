"""Reads what a student handed in: strictly, bounded, and never through a link.

A submission is a file that a stranger wrote. What comes out of here is either a valid notebook that holds only
cell types, sources, attached pictures and the nbgrader ids that the student's cells *claim* to have, or
`Unreadable` with the reason in words that can be forwarded to the student.
"""

from __future__ import annotations

import errno
import hashlib
import json
import os
import threading
from dataclasses import replace
from pathlib import Path

from nbformat.notebooknode import NotebookNode
from nbformat.v4 import new_notebook

from autograder import sandbox
from autograder.sandbox import plain_files

from ..cells import NotebookRecord, notebook_record, write_record
from ..inert import BASE64, PICTURES
from .slim import TooManyTokens, cut

MAX_FILE = 100 << 20
MAX_BYTES = 10 << 20
"""Of a file, and of what is left of it without outputs."""
MAX_TOKENS = 5_000_000
MAX_CELLS = 1000
MAX_SOURCE = 500_000

_CELL_TYPES = ("code", "markdown", "raw")
# Trouble with a file that its author can have caused: there is none, or it is a link, a pipe or a socket.
_AUTHORS_FAULT = {errno.ENOENT, errno.ENOTDIR, errno.ELOOP, errno.ENXIO, errno.ENAMETOOLONG}
# Ten megabytes of "[],[],..." become a quarter of a gigabyte of objects: one file is parsed at a time.
_parsing = threading.Lock()


class Unreadable(ValueError):
    """The submission cannot be read; the message is a sentence for the lecturer and the student."""


def read_submission(path: Path) -> NotebookNode:
    """The notebook at `path`, reduced to what grading needs (see above).

    Raises
    ------
    Unreadable
        If its author handed in something else.
    OSError
        If this machine cannot read it.
    """
    if not path.exists() and not path.is_symlink():
        raise Unreadable(_missing(path))
    for place in (path, path.parent, path.parent.parent):
        if place.is_symlink():
            raise Unreadable(f"{place.name} is a link, not a file of its own")
    return read_content(plain_bytes(path, MAX_FILE))


def plain_bytes(path: Path, limit: int) -> bytes:
    """Content of a regular file of at most `limit` bytes; anything else is `Unreadable`, trouble of the machine `OSError`."""
    try:
        return sandbox.plain_bytes(path, limit)
    except sandbox.TooLarge as reason:
        raise Unreadable(f"{reason}; clear its outputs and hand it in again") from None
    except sandbox.NotPlain as reason:
        cause = reason.__context__
        if isinstance(cause, OSError) and cause.errno not in _AUTHORS_FAULT:
            raise OSError(cause.errno, cause.strerror, str(path)) from None
        raise Unreadable(str(reason)) from None


def read_content(content: bytes) -> NotebookNode:
    """The notebook in a file's content, its outputs left aside, and its pictures too if they are too large.

    Raises
    ------
    Unreadable
        If it is something else.
    """
    with _parsing:
        return _trimmed(content)


def _trimmed(content: bytes) -> NotebookNode:
    try:
        content = cut(content, b"outputs", MAX_TOKENS)
        if (size := len(content)) <= MAX_BYTES:
            return _notebook(_parse(content))
        content = cut(content, b"attachments", MAX_TOKENS)
    except TooManyTokens as reason:
        raise Unreadable(f"the file holds {reason}; clear its outputs and hand it in again") from None
    if len(content) > MAX_BYTES:
        raise Unreadable(f"the file is larger than {MAX_BYTES >> 20} MiB, without its outputs")
    nb = _notebook(_parse(content))
    remark = f"its pasted pictures hold {size >> 20} MiB, more than {MAX_BYTES >> 20}, and were left out"
    record = notebook_record(nb)
    write_record(nb, replace(record, repairs=(remark, *record.repairs)))
    return nb


def cell_metadata(content: bytes) -> list[dict]:
    """The metadata of a notebook's cells, as its author's program wrote them; none where they cannot be read."""
    with _parsing:
        try:
            content = cut(cut(content, b"outputs", MAX_TOKENS), b"attachments", MAX_TOKENS)
            found = _parse(content) if len(content) <= MAX_BYTES else None
        except (TooManyTokens, Unreadable):
            return []
    cells = found.get("cells") if isinstance(found, dict) else None
    metadata = (
        [cell.get("metadata") for cell in cells[:MAX_CELLS] if isinstance(cell, dict)]
        if isinstance(cells, list)
        else []
    )
    return [one for one in metadata if isinstance(one, dict)]


def fingerprint(folder: Path, released: bytes) -> str:
    """SHA-256 of a submission's files and of the released notebook: equal means there is nothing new to grade."""
    digest = hashlib.sha256(released)
    for path in plain_files(folder):
        digest.update(os.fsencode(path.relative_to(folder)) + b"\0")
        with path.open("rb") as file:
            left = MAX_FILE
            while left > 0 and (block := file.read(min(left, 1 << 20))):
                digest.update(block)
                left -= len(block)
        digest.update(b"%d\0" % path.stat().st_size)
    return digest.hexdigest()


def _missing(path: Path) -> str:
    others = sorted(file.name for file in path.parent.glob("*.ipynb"))
    if not others:
        return f"there is no {path.name} in the folder"
    return f"there is no {path.name} in the folder, but {others[0]}; rename it and hand it in again"


def _parse(content: bytes) -> object:
    if not content.strip():
        raise Unreadable("the file is empty")
    try:
        return json.loads(content.decode("utf-8-sig"), parse_constant=lambda name: None, parse_int=_whole_number)
    except UnicodeDecodeError:
        raise Unreadable("the file is not UTF-8 text") from None
    except json.JSONDecodeError as error:
        raise Unreadable(f"the file is not valid JSON (line {error.lineno}); it may have been cut off") from None
    except RecursionError:
        raise Unreadable("the file is nested far too deeply for a notebook") from None


def _whole_number(text: str) -> int | None:
    """A number, unless it has more digits than any that is read here."""
    return int(text) if len(text) < 20 else None


def _notebook(content: object) -> NotebookNode:
    if not isinstance(content, dict) or not isinstance(content.get("cells"), list | None) or "nbformat" not in content:
        raise Unreadable("the file is not a Jupyter notebook")
    if content["nbformat"] != 4 or "cells" not in content:
        raise Unreadable(
            "the notebook has an old or unknown format; open it in JupyterLab, save it and hand it in again"
        )
    if len(content["cells"]) > MAX_CELLS:
        raise Unreadable(f"the notebook has more than {MAX_CELLS} cells")
    cells = [_cell(number, cell) for number, cell in enumerate(content["cells"], 1)]
    if (length := sum(len(cell.source) for cell in cells)) > MAX_SOURCE:
        raise Unreadable(f"the notebook holds {length:,} characters of text, without its outputs")
    nb = new_notebook(cells=cells)
    lost = sum(map(_pictures_lost, content["cells"], cells))
    remark = (f"{lost} of its pasted pictures cannot be shown (PNG, JPEG, GIF and WebP can)",) if lost else ()
    write_record(nb, NotebookRecord(kernel=_kernel(content.get("metadata")), repairs=remark))
    return nb


def _pictures_lost(submitted: dict, cell: NotebookNode) -> int:
    found = submitted.get("attachments")
    return len(found) - len(cell.get("attachments", ())) if isinstance(found, dict) and found else 0


def _kernel(metadata: object) -> str | None:
    spec = metadata.get("kernelspec") if isinstance(metadata, dict) else None
    name = spec.get("name") if isinstance(spec, dict) else None
    return _text(name)[:60] if isinstance(name, str) else None


def _cell(number: int, cell: object) -> NotebookNode:
    if not isinstance(cell, dict) or cell.get("cell_type") not in _CELL_TYPES:
        raise Unreadable(f"cell {number} is not a notebook cell")
    source = _joined(cell.get("source", ""))
    if source is None:
        raise Unreadable(f"the source of cell {number} is not text")
    # nbformat's own constructors validate each cell by itself: there is nothing in this one that could be wrong.
    clean = NotebookNode(
        id=f"cell-{number}", cell_type=cell["cell_type"], metadata=NotebookNode(), source=_text(source)
    )
    if clean.cell_type == "code":
        clean.update(execution_count=None, outputs=[])
    if (claim := _claim(cell.get("metadata"))) is not None:
        clean.metadata["nbgrader"] = NotebookNode(grade_id=claim)
    if cell["cell_type"] == "markdown" and (pictures := _attachments(cell.get("attachments"))):
        clean["attachments"] = pictures
    return clean


def _claim(metadata: object) -> str | None:
    """The nbgrader id a cell says it has."""
    marks = metadata.get("nbgrader") if isinstance(metadata, dict) else None
    claim = marks.get("grade_id") if isinstance(marks, dict) else None
    return claim if isinstance(claim, str) else None


def _attachments(found: object) -> dict[str, dict[str, str]]:
    """Pictures by name, each in one form."""
    kept = {}
    for name, forms in found.items() if isinstance(found, dict) else ():
        for mime in PICTURES:
            data = _joined(forms.get(mime)) if isinstance(forms, dict) else None
            if data is not None and BASE64.match(data):
                kept[_text(name)] = {mime: data}
                break
    return kept


def _joined(text: object) -> str | None:
    """A text that may be given line by line; None for anything else."""
    if isinstance(text, list) and all(isinstance(line, str) for line in text):
        return "".join(text)
    return text if isinstance(text, str) else None


def _text(text: str) -> str:
    """`text` without lone surrogates, which JSON can hold but no UTF-8 file can."""
    return text.encode("utf-8", "replace").decode("utf-8")
