"""Opens archives that strangers packed: every file in them, and in the archives within, with its whole path.

Nothing is ever written under a name that stands in an archive, so no path can lead anywhere. What is read is bounded
in number, size, ratio and nesting; what cannot be read comes out with the reason, in words for the lecturer.
"""

from __future__ import annotations

import errno
import os
import re
import stat
import struct
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from tempfile import SpooledTemporaryFile
from typing import IO
from unicodedata import normalize
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile, ZipInfo

from ..submission.reading import MAX_FILE

MAX_NESTING = 3
MAX_DOWNLOAD = 100_000
"""Most files in what a platform gives."""
MAX_FILES = 2000
"""Most files that are looked at in what one person packed."""
MAX_ARCHIVE = 512 << 20
"""Of an archive within an archive."""
MAX_DIRECTORY = 8 << 20
"""Of the list of names in what one person packed."""
MAX_RATIO = 100
"""Of what comes out of an archive to its own size; `MAX_FILE` may always come out."""

EMPTY = "an empty folder"
"""Stands for the files of a folder without any."""

_EARLIEST = datetime(1980, 1, 1)
_IN_MEMORY = 16 << 20
_HEAD = 512
_LEFT_OUT = {"__MACOSX", "__pycache__", "node_modules", "Thumbs.db", "desktop.ini"}
_OFFICE = (".docx", ".xlsx", ".pptx", ".odt", ".ods", ".odp", ".jar", ".epub", ".mlx", ".ggb", ".npz", ".whl")
_OTHER_ARCHIVES = {
    b"Rar!\x1a\x07": "a RAR archive",
    b"7z\xbc\xaf\x27\x1c": "a 7z archive",
    b"\x1f\x8b": "a gzip archive",
    b"\xfd7zXZ\x00": "an xz archive",
    b"BZh": "a bzip2 archive",
}
_ENCRYPTED = 0x1
_UTF8 = 0x800


@dataclass(frozen=True)
class Packed:
    """One file of a download.

    Attributes
    ----------
    path : tuple of str
        From the name of the download, through the archives within, to the file's own name.
    starts : tuple of int
        Where in `path` the inside of each archive begins, outermost first.
    times : tuple of datetime
        When the entry of each archive was written that leads to the file.
    content : bytes or None
        Of what may be a notebook; None of any other file.
    trouble : str or None
        Why it cannot be read.
    """

    path: tuple[str, ...]
    starts: tuple[int, ...]
    times: tuple[datetime, ...]
    content: bytes | None = None
    trouble: str | None = None

    @property
    def name(self) -> str:
        return self.path[-1]

    def level(self, number: int) -> tuple[str, ...]:
        """The parts of the path inside the archive of this level, 0 for the download itself; empty if it lies higher."""
        ends = (*self.starts[1:], len(self.path))
        return self.path[self.starts[number] : ends[number]] if number < len(self.starts) else ()

    def written(self, part: int) -> datetime:
        """When the archive's entry was written to which this part of the path belongs."""
        return [time for start, time in zip(self.starts, self.times, strict=True) if start <= part][-1]


@dataclass(frozen=True)
class _Place:
    """Where a file lies, as in `Packed`."""

    path: tuple[str, ...]
    starts: tuple[int, ...] = ()
    times: tuple[datetime, ...] = ()

    def inside(self, parts: tuple[str, ...], time: datetime) -> _Place:
        """A file in the archive that lies here."""
        return _Place((*self.path, *parts), (*self.starts, len(self.path)), (*self.times, time))

    def packed(self, content: bytes | None = None, trouble: str | None = None) -> Packed:
        return Packed(self.path, self.starts or (0,), self.times or (_EARLIEST,), content, trouble)


class _Refused(ValueError):
    """An archive or a file in it is not read; the message says why."""


_PASSWORD = "it is encrypted with a password"


@dataclass
class _Budget:
    """What may still come out of what one person packed."""

    files: int
    bytes: int


def unpack(download: Path) -> Iterator[Packed]:
    """Every file in a zip or a folder, and in the zips within."""
    if download.is_dir():
        yield from _folder(download)
        return
    size = download.stat().st_size
    with download.open("rb") as file:
        is_zip = _is_zip(file.read(_HEAD))
        file.seek(0)
        if is_zip:
            yield from _zip(file, size, _Place((download.name,)), None, 0)
            return
        (packed,) = _file(file, _Place((download.name,), (0,), (_written(download.stat()),)), _budget(size), 0)
        if packed.content is None and packed.trouble is None:
            packed = replace(
                packed, trouble="it is neither a zip nor a notebook; was the page of a login saved instead?"
            )
        yield packed


def _folder(folder: Path) -> Iterator[Packed]:
    """A download that was unpacked already."""
    for place, folders, names in os.walk(folder, followlinks=False):
        folders[:] = sorted(name for name in folders if not is_left_out((name,)))
        for name in sorted(names):
            path = Path(place, name)
            found = path.lstat()
            inside = tuple(normalize("NFC", _shown(part)) for part in path.relative_to(folder).parts)
            lies = _Place((folder.name,)).inside(inside, _written(found))
            if is_left_out((name,)) or not stat.S_ISREG(found.st_mode):
                yield lies.packed()
                continue
            try:
                file = path.open("rb")
            except OSError as error:
                yield lies.packed(trouble=f"it cannot be read here ({error.strerror})")
                continue
            with file:
                yield from _file(file, lies, _budget(found.st_size), 0)


def _shown(name: str) -> str:
    """A name of the file system, without what is no UTF-8."""
    return os.fsencode(name).decode("utf-8", "replace")


def _written(found: os.stat_result) -> datetime:
    return datetime.fromtimestamp(found.st_mtime).replace(microsecond=0)


def _budget(size: int) -> _Budget:
    return _Budget(MAX_FILES, min(MAX_ARCHIVE, MAX_FILE + MAX_RATIO * size))


def _zip(file: IO[bytes], size: int, place: _Place, budget: _Budget | None, depth: int) -> Iterator[Packed]:
    """The files in a zip; the platform's own has no budget, but gives one to each of its files."""
    try:
        if depth > MAX_NESTING:
            raise _Refused(f"zips are packed into each other more than {MAX_NESTING} deep")
        if budget is not None and _directory_size(file, size) > MAX_DIRECTORY:
            raise _Refused("it holds too many files")
        archive = ZipFile(file)
        entries = archive.infolist()
        if len(entries) > MAX_DOWNLOAD:
            raise _Refused("it holds too many files")
    except Exception as error:  # zipfile raises anything at what is damaged
        yield place.packed(trouble=_in_words(error))
        return
    looked_at = False
    if budget is None:
        for folder, time in _empty_folders(entries):
            yield place.inside((*folder, EMPTY), time).packed()
    for entry in entries:
        inside = _parts(entry)
        if not inside or _is_folder(entry):
            continue
        within = place.inside(inside, _time(entry))
        if is_left_out(inside) or stat.S_ISLNK(entry.external_attr >> 16):
            if budget is None:  # it may be all that a person handed in
                yield within.packed()
            continue
        looked_at = True
        own = _budget(entry.compress_size) if budget is None else budget
        if own.files <= 0:
            yield place.packed(trouble=f"it holds more than {MAX_FILES} files; the others were not looked at")
            return
        own.files -= 1
        try:
            if entry.flag_bits & _ENCRYPTED:
                raise _Refused(_PASSWORD)
            if entry.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
                raise NotImplementedError  # others may ask for gigabytes of memory
            opened = archive.open(entry)
        except Exception as error:  # zipfile raises anything at what is damaged
            yield within.packed(trouble=_in_words(error))
            continue
        with opened:
            yield from _file(opened, within, own, depth)
    if not looked_at and budget is not None:
        yield place.packed()


def _file(file: IO[bytes], place: _Place, budget: _Budget, depth: int) -> Iterator[Packed]:
    """One file: a zip is opened, what may be a notebook is read, of anything else the name is enough."""
    name = place.path[-1].lower()
    try:
        head = file.read(_HEAD)
        if _is_zip(head) and not name.endswith(_OFFICE):
            with SpooledTemporaryFile(_IN_MEMORY) as copy:
                size = _copy(head, file, copy, budget)
                yield from _zip(copy, size, place, budget, depth + 1)
        elif kind := _other_archive(head):
            raise _Refused(f"it is {kind}, which is not opened here; ask for a zip or the notebook itself")
        elif _may_be_notebook(head, name):
            yield place.packed(_content(head, file, budget))
        else:
            yield place.packed()
    except Exception as error:  # zipfile raises anything at what is damaged
        yield place.packed(trouble=_in_words(error))


def _content(head: bytes, file: IO[bytes], budget: _Budget) -> bytes:
    most = max(0, min(MAX_FILE, budget.bytes))
    content = head + file.read(max(0, most - len(head)) + 1)
    budget.bytes -= len(content)
    if len(content) > most:
        raise _Refused(f"it is larger than {most >> 20} MiB; its outputs should be cleared")
    return content


def _copy(head: bytes, file: IO[bytes], copy: IO[bytes], budget: _Budget) -> int:
    block, copied = head, 0
    while block:
        copied += len(block)
        budget.bytes -= len(block)
        if budget.bytes < 0:
            raise _Refused("it is too large, or holds far more than its size says")
        copy.write(block)
        block = file.read(1 << 20)
    copy.seek(0)
    return copied


def _other_archive(head: bytes) -> str | None:
    if head[257:262] == b"ustar":
        return "a tar archive"
    return next((kind for magic, kind in _OTHER_ARCHIVES.items() if head.startswith(magic)), None)


def _is_zip(head: bytes) -> bool:
    return head.startswith((b"PK\x03\x04", b"PK\x05\x06"))


def _may_be_notebook(head: bytes, name: str) -> bool:
    return ".ipynb" in name or head.replace(b"\0", b"").lstrip(b"\xef\xbb\xbf\xff\xfe \t\r\n").startswith(b"{")


def _directory_size(file: IO[bytes], size: int) -> int:
    """Of the list of names at the end of a zip; `zipfile` reads all of it at once."""
    file.seek(max(0, size - (1 << 16) - 100))
    tail = file.read()
    file.seek(0)
    if (place := tail.rfind(b"PK\x05\x06")) < 0:
        raise BadZipFile
    (length,) = struct.unpack_from("<L", tail, place + 12)
    if length == 0xFFFFFFFF and (wide := tail.rfind(b"PK\x06\x06")) >= 0:
        (length,) = struct.unpack_from("<Q", tail, wide + 40)
    return length


def _parts(entry: ZipInfo) -> tuple[str, ...]:
    """The parts of an entry's name, composed (NFC), as they are shown and compared."""
    name = entry.filename
    if not entry.flag_bits & _UTF8:
        # Without the mark for UTF-8 zipfile takes a name for cp437; many tools write UTF-8 and no mark.
        with suppress(UnicodeError):
            name = name.encode("cp437").decode("utf-8")
    return tuple(part for part in re.split(r"[/\\]", normalize("NFC", name)) if part not in ("", ".", ".."))


def _empty_folders(entries: Sequence[ZipInfo]) -> Iterator[tuple[tuple[str, ...], datetime]]:
    full = {
        parts[:end]
        for entry in entries
        if not _is_folder(entry)
        for parts in [_parts(entry)]
        for end in range(len(parts))
    }
    for entry in entries:
        if _is_folder(entry) and (parts := _parts(entry)) and parts not in full:
            yield parts, _time(entry)


def _is_folder(entry: ZipInfo) -> bool:
    return entry.filename.endswith(("/", "\\"))


def is_left_out(parts: tuple[str, ...]) -> bool:
    """True for what systems and tools put beside people's files."""
    return any(part.startswith(".") or part in _LEFT_OUT for part in parts)


def _time(entry: ZipInfo) -> datetime:
    try:
        return datetime(*entry.date_time)
    except ValueError:
        return _EARLIEST


def _in_words(error: Exception) -> str:
    if isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT):
        raise error  # not the archive's fault
    if isinstance(error, _Refused):
        return str(error)
    if "password" in str(error):
        return _PASSWORD
    if isinstance(error, NotImplementedError):
        return "it is packed in a way that is not read here; ask for an ordinary zip"
    return "the zip is damaged or was cut off"
