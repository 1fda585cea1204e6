"""nbgrader's gradebook, opened so that nothing half is ever in it.

nbgrader's own `Gradebook` commits after every row, waits five seconds for another program and ends in a traceback.
Here a change is one transaction that no other program can look into (`writing`), a look is one consistent snapshot
(`reading`), both wait with a message while somebody else has the file, and what is wrong with it is said in words.
"""

from __future__ import annotations

import errno
import fcntl
import os
import sqlite3
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import lru_cache
from pathlib import Path

from nbgrader.api import Gradebook
from sqlalchemy import Engine, create_engine, event, text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import DBAPIError
from sqlalchemy.orm import Session
from sqlalchemy.pool import NullPool

from .errors import CourseError

# How often, and with which pause in seconds, a gradebook that somebody else is using is asked for.
ATTEMPTS, PAUSE = 120, 0.5
_NO_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL)


class GradebookError(CourseError):
    """The gradebook cannot be used now; the message names the file and says what to do."""


def path_of(url: str) -> Path | None:
    """The file of an SQLite gradebook, None for a gradebook on a server."""
    parsed = make_url(url)
    return Path(parsed.database) if parsed.get_backend_name() == "sqlite" and parsed.database else None


def is_made(url: str) -> bool:
    """True if there is a gradebook; `GradebookError` if something else stands in its place."""
    path = path_of(url)
    if path is None:
        return True
    if path.is_symlink() and not path.exists():
        raise GradebookError(f"{path} is a link to {os.readlink(path)}, which does not exist; mend or remove the link")
    if path.exists() and not path.is_file():
        raise GradebookError(f"{path} is not a file; move it away, then run: autograder release")
    return path.exists() and path.stat().st_size > 0


def make(url: str, course_id: str) -> None:
    """Make an empty gradebook if there is none, as a whole."""
    path = path_of(url)
    if path is None or is_made(url):
        with stock_gradebook(url, course_id):
            return
    for left in path.parent.glob(f".{path.name}.*.part"):
        if not _is_running(left.name.split(".")[-2]):
            left.unlink(missing_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        Gradebook(f"sqlite:///{part}", course_id).close()
        if path.exists():
            os.replace(part, path)
        else:
            with suppress(FileExistsError):
                os.link(part, path)
    except DBAPIError as error:
        raise GradebookError(_in_words(error, path)) from error
    finally:
        part.unlink(missing_ok=True)


def _is_running(pid: str) -> bool:
    try:
        os.kill(int(pid), 0)
    except (ProcessLookupError, ValueError):
        return False
    except OSError:
        pass
    return True


@contextmanager
def reading(url: str) -> Iterator[Session]:
    """A session that sees the gradebook as it is at this moment; it changes nothing."""
    with _session(url, "BEGIN") as session:
        yield session


@contextmanager
def writing(url: str) -> Iterator[Session]:
    """A session in which everything is stored together at the end of the block, or nothing at all.

    Meanwhile no other program can change or read the gradebook, so files that belong to it can be put in place
    within the block.
    """
    with _session(url, "BEGIN EXCLUSIVE") as session:
        yield session
        session.commit()


@contextmanager
def stock_gradebook(url: str, course_id: str) -> Iterator[Gradebook]:
    """nbgrader's own `Gradebook`, for what asks for one; only to be read."""
    with reading(url):
        pass
    try:
        with Gradebook(url, course_id) as gradebook:
            yield gradebook
    except DBAPIError as error:
        raise GradebookError(_in_words(error, path_of(url))) from error


@contextmanager
def _session(url: str, begin: str) -> Iterator[Session]:
    path = path_of(url)
    if not is_made(url):
        raise GradebookError(f"there is no {path}; run: autograder release")
    try:
        with Session(_engine(url, begin)) as session:
            _start(session, path)
            yield session
    except DBAPIError as error:
        raise GradebookError(_in_words(error, path)) from error


@lru_cache(maxsize=8)
def _engine(url: str, begin: str) -> Engine:
    """An engine that keeps no connection open, and remembers the statements it once compiled."""
    if path_of(url) is None:
        return create_engine(url, poolclass=NullPool)
    engine = create_engine(url, poolclass=NullPool, connect_args={"timeout": PAUSE})
    event.listen(engine, "connect", _leave_transactions_to_us)
    event.listen(engine, "begin", lambda connection: connection.exec_driver_sql(begin))
    return engine


def _leave_transactions_to_us(connection: sqlite3.Connection, record: object) -> None:
    connection.isolation_level = None


def _start(session: Session, path: Path | None) -> None:
    """Begin the transaction, as soon as no other program stands in the way."""
    for attempt in range(ATTEMPTS):
        try:
            # SQLite takes its lock at the first look.
            session.execute(text("select 1 from alembic_version" if path is None else "select 1 from sqlite_master"))
            return
        except DBAPIError as error:
            session.rollback()
            if not _is_busy(error) or attempt == ATTEMPTS - 1 or (path is not None and not _has_locks(path.parent)):
                raise
        if attempt == 0:
            print(f"waiting: {path} is in use by another program", file=sys.stderr)
        time.sleep(PAUSE)


def _is_busy(error: DBAPIError) -> bool:
    return getattr(error.orig, "sqlite_errorname", "").startswith(("SQLITE_BUSY", "SQLITE_LOCKED"))


def _has_locks(folder: Path) -> bool:
    """Whether files can be locked there; SQLite calls a gradebook busy also where they cannot."""
    try:
        with tempfile.TemporaryFile(dir=folder) as file:
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno not in _NO_LOCKS
    return True


def _in_words(error: DBAPIError, path: Path | None) -> str:
    name = getattr(error.orig, "sqlite_errorname", "")
    safe = "what was graded before is safe"
    if path is None:
        return f"the gradebook says: {error.orig}"
    no_locks = "its file system, perhaps a folder of the network, has no locks; move the course to another disk"
    if _is_busy(error) and not _has_locks(path.parent):
        return f"{path} cannot be used: {no_locks}; {safe}"
    if _is_busy(error):
        return f"{path} is held by another program; close it (formgrader, another grader, a database browser) and run the command again; {safe}"
    if name.startswith(("SQLITE_CORRUPT", "SQLITE_NOTADB", "SQLITE_FORMAT")):
        return f"{path} is damaged ({error.orig}); put back a copy, or move it away, run: autograder release, and grade again"
    if name.startswith("SQLITE_READONLY"):
        return f"{path} can only be read; give yourself the right to write it and its folder"
    if name.startswith("SQLITE_FULL"):
        return f"{path}: no space left; make room on its disk, then run the command again; {safe}"
    if name.startswith(("SQLITE_CANTOPEN", "SQLITE_PERM", "SQLITE_AUTH")):
        return f"{path} cannot be opened ({error.orig}); look at its rights and those of its folder"
    if name.startswith(("SQLITE_IOERR_LOCK", "SQLITE_IOERR_RDLOCK", "SQLITE_PROTOCOL")):
        return f"{path} cannot be used ({error.orig}): {no_locks}; {safe}"
    if name.startswith(("SQLITE_IOERR", "SQLITE_NOLFS")):
        return f"{path} cannot be used ({error.orig}): its file system has no space or a fault; {safe}"
    if "no such column" in str(error.orig) or "no such table" in str(error.orig):
        return f"{path} was made by another version of nbgrader ({error.orig}); copy it, then run: nbgrader db upgrade"
    return f"{path}: {error.orig}"
