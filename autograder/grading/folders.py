"""Folders of a course: which students have one in a step, and where a released notebook lies."""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path

import nbformat
from nbformat.notebooknode import NotebookNode
from nbgrader.coursedir import CourseDirectory

# Formgrader puts names into its pages as they are. An apostrophe does no harm there, and O'Neil is a name.
_MARKUP = '<>"&'


def student_names(step: Path) -> list[str]:
    """Students that have a folder in a step of the course (``submitted``, ``autograded`` ...)."""
    return sorted(name for name in _folder_names(step) if why_unusable(name) is None)


def unusable_names(step: Path) -> dict[str, str]:
    """Folders of a step whose names cannot be students' ids, with the reason."""
    return {name: reason for name in sorted(_folder_names(step)) if (reason := why_unusable(name)) is not None}


def why_unusable(name: str) -> str | None:
    """Why the name of a folder cannot be a student's id, None if it can."""
    if not name.isprintable():
        return "the folder's name holds control characters; rename it"
    if name.startswith("."):
        return "the folder's name starts with a dot; rename it"
    if found := [character for character in _MARKUP if character in name]:
        return f"the folder's name holds {' '.join(found)}, which web pages take for markup; rename it"
    return None


def _folder_names(step: Path) -> list[str]:
    return [entry.name for entry in os.scandir(step) if entry.is_dir()] if step.is_dir() else []


def released_path(coursedir: CourseDirectory, exercise: str, notebook: str) -> Path:
    """Where the released notebook lies."""
    return Path(coursedir.format_path(coursedir.release_directory, ".", exercise), f"{notebook}.ipynb").resolve()


def released_notebook(path: Path) -> NotebookNode:
    """The released notebook at `path`, read once for a whole class: not to be changed."""
    state = path.stat()
    return _read_released(path, state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=32)
def _read_released(path: Path, *state: int) -> NotebookNode:
    return nbformat.read(path, as_version=4)
