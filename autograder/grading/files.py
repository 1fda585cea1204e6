"""Files that are there whole or not at all: written under a temporary name in the same folder, then renamed."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from .submission.reading import Unreadable, plain_bytes

MOST_BYTES = 256 << 20
"""Of a file that is looked at."""


def digest(content: bytes) -> str:
    """SHA-256 of `content`, in hexadecimal digits."""
    return hashlib.sha256(content).hexdigest()


def digest_of(path: Path) -> str | None:
    """SHA-256 of a file, None if there is none that can be read."""
    try:
        return digest(plain_bytes(path, MOST_BYTES))
    except (Unreadable, OSError):
        return None


@contextmanager
def staged(folder: Path, files: Mapping[str, bytes], permissions: int) -> Iterator[Callable[[], None]]:
    """Write files into a folder under temporary names; what is given puts them in place.

    A process that is stopped before leaves the old files as they were; what it leaves under a temporary name is
    overwritten the next time.

    Parameters
    ----------
    folder : Path
        Made if need be.
    files : mapping of str to bytes
        Contents by name, relative to `folder`.
    permissions : int
        Of each file, for example ``0o644``.

    Raises
    ------
    OSError
        If a file cannot be written; then none is put in place.
    """
    parts = {folder / name: _part(folder / name) for name in files}

    def put_in_place() -> None:
        for path, part in parts.items():
            os.replace(part, path)

    try:
        for (path, part), content in zip(parts.items(), files.values(), strict=True):
            path.parent.mkdir(parents=True, exist_ok=True)
            part.unlink(missing_ok=True)
            _write(part, content, permissions)
        yield put_in_place
    except BaseException:
        for part in parts.values():
            with suppress(OSError):
                part.unlink(missing_ok=True)
        for place in (folder, folder.parent):
            with suppress(OSError):
                place.rmdir()
        raise


def write_whole(path: Path, content: bytes) -> None:
    """Write one file, made or replaced as a whole; its folder must exist."""
    part = _part(path)
    part.unlink(missing_ok=True)
    try:
        _write(part, content, 0o644)
        os.replace(part, path)
    except BaseException:
        with suppress(OSError):
            part.unlink(missing_ok=True)
        raise


def _part(path: Path) -> Path:
    return path.with_name(f".{path.name}.part")


def _write(path: Path, content: bytes, permissions: int) -> None:
    try:
        with path.open("xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        # A write into a full disk does not say which file it was.
        raise OSError(error.errno, error.strerror, str(path)) from None
    path.chmod(permissions)


def remove_others(folder: Path, kept: Collection[str]) -> None:
    """Remove everything in a folder but the files of these names, relative to it."""
    paths = {folder / name for name in kept}
    for place, folders, names in os.walk(folder, topdown=False):
        for path in (Path(place, name) for name in (*names, *folders)):
            if path not in paths:
                with suppress(OSError):
                    path.rmdir() if path.is_dir() and not path.is_symlink() else path.unlink()
