"""``autograder archive``: a term in one zip, to be kept; and a course folder that is ready for the next one."""

from __future__ import annotations

import shutil
import zipfile
from collections.abc import Iterator
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from .course import Course
from .errors import CourseError
from .gradebook import path_of, writing
from .roster import FILE as ROSTER
from .submission.kept import FOLDER
from .term import FILE as TERM

_STEPS = ("submitted", "autograded", "feedback", "release", "source")
_PAGES = ("downloaded", "build/return", "build/reports", "build/term")
"""Folders of the course, beside nbgrader's own, that hold what people did."""
_ABOUT = """\
A term of a course, written by {versions}.

feedback/ and build/ hold pages that any browser opens. Points, notes and comments are in gradebook.db, an SQLite file.
To work with it, unpack it and type the commands of the repository in that folder: autograder report, autograder term,
autograder export, autograder explain. Verdicts are those of the questions that the repository holds then: check out the
version of that term before anything is graded again.
"""
_CLEARED = ("submitted", "autograded", "feedback")


def archive(course: Course, target: Path) -> list[str]:
    """Write everything of the term into the zip `target`: gradebook, what was handed in and given back, roster, dates.

    Nobody can change the gradebook meanwhile.

    Returns
    -------
    list of str
        Names inside, relative to the course folder.

    Raises
    ------
    CourseError
        If there is such a file already, or there is nothing to keep.
    """
    if target.exists():
        raise CourseError(f"{target} is there already; name another file")
    part = target.with_name(f".{target.name}.part")
    try:
        with writing(course.db_url):
            files = {path.relative_to(course.root).as_posix(): path for path in _files(course, target, part)}
            with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as written:
                written.writestr("ABOUT.txt", _ABOUT.format(versions=_versions()))
                for name, path in files.items():
                    written.write(path, name)
        with zipfile.ZipFile(part) as written:
            if damaged := written.testzip():
                raise CourseError(f"{damaged} could not be read back from {target}; is its disk all right?")
        part.rename(target)
    finally:
        part.unlink(missing_ok=True)
    return list(files)


def clear(course: Course) -> None:
    """Remove what belongs to the term that was archived: gradebook, submissions, pages, receipts and roster."""
    for name in _CLEARED:
        shutil.rmtree(course.step(name), ignore_errors=True)
    for name in (*_PAGES, str(FOLDER)):
        shutil.rmtree(course.root / name, ignore_errors=True)
    for path in (path_of(course.db_url), course.root / ROSTER):
        if path is not None:
            path.unlink(missing_ok=True)


def _versions() -> str:
    found = []
    for name in ("autograder", "nbgrader"):
        with suppress(PackageNotFoundError):
            found.append(f"{name} {version(name)}")
    return " and ".join(found)


def _files(course: Course, *besides: Path) -> Iterator[Path]:
    single = (path_of(course.db_url), course.root / ROSTER, course.root / TERM, course.root / "nbgrader_config.py")
    yield from (path for path in single if path is not None and path.is_file())
    for folder in (*map(course.step, _STEPS), *(course.root / name for name in _PAGES)):
        for path in sorted(folder.rglob("*")):
            if path.is_file() and not path.is_symlink() and path not in besides and path.is_relative_to(course.root):
                yield path
