"""Which exercise a notebook is, whatever its file is called: by the ids of its cells, else by what stands in them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePath

from nbformat.notebooknode import NotebookNode

from ..cells import check_cells, grade_id, keeps_source, tracked_cells
from ..encodings import utf16
from ..submission.reading import Unreadable, read_content

_CALL = re.compile(r"""\b(?:check|hint|variant)\(\s*["']([a-z0-9_]+)["'.]""")
_TYPED = re.compile(r"""^student\s*=\s*(["'])(.{1,200}?)\1\s*(?:#.*)?$""", re.MULTILINE)


@dataclass(frozen=True)
class Released:
    """An exercise as the class was given it.

    Attributes
    ----------
    stubs : mapping of str to str
        What stood in the answer cells, by their ids.
    sources : frozenset of str
        What stood in any cell.
    """

    exercise: str
    ids: frozenset[str]
    checks: int
    stubs: Mapping[str, str]
    sources: frozenset[str]

    @classmethod
    def of(cls, exercise: str, nb: NotebookNode) -> Released:
        cells = tracked_cells(nb)
        return cls(
            exercise,
            frozenset(cells),
            len(check_cells(nb)),
            {name: cell.source for name, cell in cells.items() if keeps_source(cell)},
            frozenset(cell.source for cell in nb.cells),
        )


@dataclass(frozen=True)
class Found:
    """What a file that may be a notebook turned out to be.

    Attributes
    ----------
    exercise : str or None
        None if it is a notebook of something else, or none at all.
    answered : int
        How many answers differ from what was given out.
    typed : str or None
        The id that its author typed.
    trouble : str or None
        Why it cannot be read as a notebook.
    content : bytes
        UTF-8, as it is to be kept.
    remarks : tuple of str
        What was mended, in words.
    """

    exercise: str | None
    answered: int
    typed: str | None
    trouble: str | None
    content: bytes
    remarks: tuple[str, ...] = ()


def recognise(name: str, content: bytes, released: Sequence[Released]) -> Found:
    """What the file `name` with this content is, among the `released` exercises."""
    text, remarks = _as_utf8(content)
    by_name = {one.exercise: one for one in released}
    try:
        nb = read_content(text)
    except Unreadable as reason:
        exercise = _named(name, by_name)
        return Found(exercise, 0, None, str(reason), content)
    exercise, lost = _exercise(nb, released), False
    if exercise is None and (exercise := _written_about(nb, by_name)) is not None:
        lost = True
    if exercise is None:
        exercise = _named(name, by_name)
    if lost:
        remarks = (*remarks, "its cells had lost their ids; recognised by what stands in them")
    answered = 0 if exercise is None else _answered(nb, by_name[exercise])
    return Found(exercise, answered, typed_id(nb), None, text, remarks)


def _as_utf8(content: bytes) -> tuple[bytes, tuple[str, ...]]:
    """`content` in UTF-8; a text in the other encodings that editors write is converted, and that is said."""
    if encoding := utf16(content):
        try:
            return content.decode(encoding).encode(), ("was saved as UTF-16, and converted",)
        except UnicodeError:
            return content, ()
    try:
        content.decode("utf-8")
    except UnicodeDecodeError:
        try:
            return content.decode("cp1252").encode(), ("was saved as Windows-1252, and converted",)
        except UnicodeError:
            pass
    return content, ()


def _exercise(nb: NotebookNode, released: Sequence[Released]) -> str | None:
    """The exercise most of whose tracked cells are there."""
    claims = {name for cell in nb.cells if (name := grade_id(cell))}
    found = [(len(claims & one.ids), one.exercise) for one in released]
    most, exercise = max(found, default=(0, ""))
    return exercise if most else None


def _written_about(nb: NotebookNode, known: Mapping[str, Released]) -> str | None:
    """The exercise that most calls of the kit name, else the one whose cells stand there unchanged."""
    calls = Counter(name for cell in nb.cells for name in _CALL.findall(cell.source) if name in known)
    if calls:
        return calls.most_common(1)[0][0]
    sources = {cell.source for cell in nb.cells if len(cell.source) > 20}
    most, exercise = max(((len(sources & one.sources), one.exercise) for one in known.values()), default=(0, ""))
    return exercise if most > 1 else None


def _named(name: str, known: Mapping[str, Released]) -> str | None:
    """The exercise a file's name speaks of: the longest that stands in it, as scara stands in scara_s600."""
    text = re.sub(r"[\W_]+", "_", PurePath(name).name.lower())
    return max((one for one in known if one in text), key=len, default=None)


def _answered(nb: NotebookNode, released: Released) -> int:
    claimed = {grade_id(cell): cell.source for cell in nb.cells}
    if any(name in released.ids for name in claimed if name):
        return sum(claimed[name] != stub for name, stub in released.stubs.items() if name in claimed)
    return min(released.checks, sum(cell.source not in released.sources for cell in nb.cells if cell.source.strip()))


def typed_id(nb: NotebookNode) -> str | None:
    """The id that a notebook's author typed, None if there is none."""
    found = [match[1] for cell in nb.cells if cell.cell_type == "code" for match in _TYPED.findall(cell.source)]
    return found[-1].strip() or None if found else None
