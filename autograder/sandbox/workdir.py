"""Reads a notebook's own folder, within bounds and without following links."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path

MAX_FILES = 1000
MAX_DEPTH = 8


def regular_files(folder: Path, depth: int = MAX_DEPTH) -> Iterator[Path]:
    """Regular files below a folder in a stable order; links, sockets and devices are passed over."""
    with os.scandir(folder) as entries:
        ordered = sorted(entries, key=lambda entry: (entry.is_dir(follow_symlinks=False), entry.name))
    for entry in ordered:
        if entry.is_file(follow_symlinks=False):
            yield Path(entry.path)
        elif entry.is_dir(follow_symlinks=False) and depth > 0:
            yield from regular_files(Path(entry.path), depth - 1)


def read_bounded(path: Path, limit: int) -> bytes | None:
    """Content of a regular file of at most ``limit`` bytes, else None."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError:
        return None
    with open(descriptor, "rb") as file:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode) or status.st_size > limit:
            return None
        content = file.read(limit + 1)
    return content if len(content) <= limit else None


def read_folder(folder: Path, limit: int) -> tuple[dict[str, bytes], list[str]]:
    """(contents by relative name, names left out) of a folder; the contents add up to at most ``limit`` bytes."""
    contents: dict[str, bytes] = {}
    left_out: list[str] = []
    used = 0
    for path in regular_files(folder):
        name = str(path.relative_to(folder))
        content = read_bounded(path, limit - used) if len(contents) < MAX_FILES else None
        if content is None:
            left_out.append(name)
        else:
            contents[name] = content
            used += len(content)
    return contents, left_out
