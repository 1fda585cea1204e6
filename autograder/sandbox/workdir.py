"""Reads files that a stranger wrote, within bounds and without following links."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable, Iterator
from pathlib import Path

MAX_FILES = 500


class NotPlain(ValueError):
    """A file is not read; the message says why in words that can be forwarded to its author."""


class TooLarge(NotPlain):
    """A file holds more than it may."""


def plain_bytes(path: Path, limit: int) -> bytes:
    """Return the content of a regular file.

    Raises
    ------
    NotPlain
        If it is a link, a folder, a pipe or a device, or cannot be opened.
    TooLarge
        If it holds more than `limit` bytes.
    """
    try:
        handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as error:
        raise NotPlain(f"{path.name} cannot be opened ({error.strerror})") from None
    try:
        if not stat.S_ISREG(os.fstat(handle).st_mode):
            raise NotPlain(f"{path.name} is not a regular file")
        with open(handle, "rb", closefd=False) as file:
            content = file.read(limit + 1)
    except OSError as error:
        raise NotPlain(f"{path.name} cannot be read ({error.strerror})") from None
    finally:
        os.close(handle)
    if len(content) > limit:
        raise TooLarge(f"{path.name} is larger than {limit >> 20} MiB")
    return content


def plain_files(folder: Path) -> Iterator[Path]:
    """Yield the regular files under `folder` that can be read, in a stable order, links neither followed nor listed.

    At most `MAX_FILES`; folders that start with a dot are passed over.
    """
    left = 0 if folder.is_symlink() else MAX_FILES
    for place, folders, names in os.walk(folder, followlinks=False):
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name != "__pycache__")
        for name in sorted(names):
            path = Path(place, name)
            if not left:
                return
            if stat.S_ISREG(path.lstat().st_mode) and os.access(path, os.R_OK):
                left -= 1
                yield path


def read_folders(folders: Iterable[Path], limit: int) -> tuple[dict[str, bytes], list[str]]:
    """Return the files of some folders by their names below them, notebooks excepted, and the names of those left out.

    Of files of one name that of the last folder counts, and it is the first to be given room: the contents add up to
    at most `limit` bytes.
    """
    contents: dict[str, bytes] = {}
    left_out: list[str] = []
    for folder in reversed(list(folders)):
        for path in plain_files(folder):
            name = str(path.relative_to(folder))
            if name in contents or path.suffix == ".ipynb":
                continue
            try:
                contents[name] = plain_bytes(path, limit)
            except NotPlain:
                left_out.append(name)
            else:
                limit -= len(contents[name])
    return contents, left_out
