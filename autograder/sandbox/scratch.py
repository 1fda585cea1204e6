"""Private folders in the temporary folder: short-lived, and swept up after graders that were killed."""

from __future__ import annotations

import contextlib
import fcntl
import os
import shutil
import tempfile
from pathlib import Path

PREFIX = "ag-run-"
_BASE_BYTES = 78  # a socket's whole path may have 108, or 104 on macOS


class PrivateFolder:
    """A new folder that only this user can enter, with a path short enough for sockets.

    It is locked for as long as its process lives, by which others see that it is in use; a process number would say
    less, since it is given again, and means nothing in another container with the same temporary folder.
    """

    def __init__(self) -> None:
        base = _base()
        sweep()
        while True:
            self.path = Path(tempfile.mkdtemp(prefix=PREFIX, dir=base))
            try:
                self._lock = os.open(self.path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
            except FileNotFoundError:  # swept away already
                continue
            with contextlib.suppress(OSError):  # without locks nothing is swept either
                fcntl.flock(self._lock, fcntl.LOCK_SH)
            if self.path.exists():  # else it was swept away before it could be locked
                return
            os.close(self._lock)

    def remove(self) -> None:
        """Remove the folder with all that it holds."""
        shutil.rmtree(self.path, ignore_errors=True)
        os.close(self._lock)

    def __enter__(self) -> Path:
        return self.path

    def __exit__(self, *exception: object) -> None:
        self.remove()


def _base() -> Path:
    base = tempfile.gettempdir()
    return Path(base if len(base) <= _BASE_BYTES else "/tmp")


def sweep() -> None:
    """Remove the private folders of this user whose process is gone."""
    for folder in _base().glob(PREFIX + "*"):
        with contextlib.suppress(OSError):
            if folder.lstat().st_uid != os.geteuid():
                continue
            descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder, ignore_errors=True)
            finally:
                os.close(descriptor)
