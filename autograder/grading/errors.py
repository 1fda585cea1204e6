"""What went wrong, in words for the person who typed the command."""

from __future__ import annotations

import errno
import os


class CourseError(Exception):
    """The command cannot do what was asked; the message is for the person who typed it."""


_REMEDIES = {
    errno.ENOSPC: "make room on its disk, then run the command again",
    errno.EDQUOT: "make room in your quota, then run the command again",
    errno.EROFS: "its disk can only be read; make it writable",
    errno.EACCES: "give yourself the right to it",
    errno.EPERM: "give yourself the right to it",
    errno.EISDIR: "it is a folder; move it away",
    errno.ENOTDIR: "a file stands where a folder should; move it away",
    errno.EMFILE: "close other programs, or grade with fewer --jobs",
    errno.ENOMEM: "close other programs, or grade with fewer --jobs",
}


def in_words(error: BaseException) -> str:
    """One sentence for an error: which file, what is wrong, what to do."""
    if isinstance(error, CourseError):
        return str(error)
    if isinstance(error, OSError) and error.errno is not None:
        where = " ".join(
            os.fsdecode(name) for name in (error.filename, error.filename2) if isinstance(name, str | bytes)
        )
        what = f"{where}: {error.strerror}" if where else str(error.strerror)
        remedy = _REMEDIES.get(error.errno)
        return f"{what}; {remedy}" if remedy else what
    said = str(error)
    return f"{type(error).__name__}: {said}" if said else type(error).__name__
