"""What came out of the sandbox, kept beside the course, so that it can be judged again without running anything.

A kept run counts only for what was run: the same cells, the same files beside the notebook, the same kit and libraries,
the same limits. Points, references and mistakes are not among that; the inputs that a student's function was called
with are, and are compared by whoever reads it.
"""

from __future__ import annotations

import functools
import hashlib
import json
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from importlib import metadata
from pathlib import Path

import msgspec
from nbformat.notebooknode import NotebookNode

import dhkit
from autograder.judge import Verdict
from autograder.sandbox import CellRun, Limits, Run

from ..cells import grade_id
from ..files import write_whole

FOLDER = Path("build", "runs")
"""Below the course folder; may be removed at any time, then notebooks run again."""
MOST_BYTES = 64 << 20
_LIBRARIES = ("numpy", "sympy", "mpmath", "matplotlib", "ipython", "ipykernel", "ipywidgets")


def kept_path(course: Path, exercise: str, student: str, notebook: str) -> Path:
    """The file in which the run of a student's notebook is kept."""
    return course / FOLDER / exercise / student / f"{notebook}.json"


@dataclass
class KeptRun:
    """A run that nobody doubts.

    Attributes
    ----------
    run : Run
    sent : dict of int to list
        What students' functions were called with, by the index of the check cell.
    verdicts : dict of str to Verdict or None
        By the grade id of the check cell, if it was just run and judged; they are not kept.
    """

    run: Run
    sent: dict[int, list] = field(default_factory=dict)
    verdicts: dict[str, Verdict] | None = field(default=None, compare=False)


def digest_of_work(nb: NotebookNode, files: Mapping[str, bytes]) -> str:
    """SHA-256 of what is run of a restored notebook, and of the files beside it."""
    cells = [[cell.cell_type, grade_id(cell), cell.source if cell.cell_type == "code" else ""] for cell in nb.cells]
    digest = hashlib.sha256(json.dumps(cells).encode())
    for name, content in sorted(files.items()):
        digest.update(f"{name}\0{len(content)}\0".encode("utf-8", "surrogateescape"))
        digest.update(content)
    return digest.hexdigest()


def conditions(limits: Limits, mode: str) -> str:
    """SHA-256 of what a run depends on beside the notebook: limits, kind of sandbox, the kit and the libraries."""
    folder = Path(dhkit.__path__[0])
    paths = sorted(path for path in folder.rglob("*") if path.is_file() and path.suffix != ".pyc")
    times = tuple((str(path), path.stat().st_mtime_ns) for path in paths)
    return hashlib.sha256(json.dumps([asdict(limits), mode, _software(times)]).encode()).hexdigest()


@functools.lru_cache(maxsize=1)
def _software(times: Sequence[tuple[str, int]]) -> str:
    digest = hashlib.sha256(sys.version.encode())
    for library in _LIBRARIES:
        with suppress(metadata.PackageNotFoundError):
            digest.update(f"{library}=={metadata.version(library)}\0".encode())
    for path, _ in times:
        content = Path(path).read_bytes()
        digest.update(b"%d\0" % len(content) + content)
    return digest.hexdigest()


class _Content(msgspec.Struct, forbid_unknown_fields=True):
    """What a run is written as; cells as (status, message, outputs, doubtful)."""

    key: str
    cells: dict[int, tuple[str, str, list[dict], bool]]
    followups: dict[int, list[dict]]
    message: str | None
    starved: bool
    lived: float
    sent: dict[int, list]


def written(key: str, kept: KeptRun) -> bytes:
    """A run as JSON."""
    run = kept.run
    cells = {index: [cell.status, cell.message, cell.outputs, cell.doubtful] for index, cell in run.cells.items()}
    content = {
        "key": key, "cells": cells, "followups": run.followups, "message": run.message, "starved": run.starved,
        "lived": run.lived, "sent": kept.sent,
    }  # fmt: skip
    return json.dumps(content).encode()


def read(content: bytes, key: str) -> KeptRun | None:
    """Return a run from JSON, None if it is none or was not made under this key."""
    try:
        found = msgspec.convert(json.loads(content), _Content, str_keys=True)
    except (ValueError, msgspec.ValidationError, RecursionError):
        return None
    if found.key != key:
        return None
    cells = {index: CellRun(*what) for index, what in found.cells.items()}  # type: ignore[arg-type]
    run = Run(cells, found.followups, found.message, found.starved, found.lived)  # type: ignore[arg-type]
    return KeptRun(run, found.sent)


def keep(path: Path, key: str, kept: KeptRun) -> None:
    """Write a run, whole or not at all. Where it cannot be written nothing is lost but time."""
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, written(key, kept))


def read_kept(path: Path, key: str) -> KeptRun | None:
    """Return the run that was kept under this key, None if there is none."""
    try:
        return None if path.stat().st_size > MOST_BYTES else read(path.read_bytes(), key)
    except OSError:
        return None
