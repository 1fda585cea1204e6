"""Says what this machine lacks for grading, and how to get it."""

from __future__ import annotations

import re
import sqlite3
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

from packaging.requirements import Requirement

PYTHON = (3, 11)
SETUP = "run: make setup"


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at; `cure` says how to get it where it is not ok."""

    what: str
    ok: bool
    found: str
    cure: str = ""


def examine(root: Path) -> Iterator[Finding]:
    """Everything that grading the course in `root` needs, one finding each."""
    version = ".".join(map(str, sys.version_info[:3]))
    yield Finding("Python", sys.version_info >= PYTHON, version, "install Python 3.11 or newer")
    yield from _packages(root)
    yield _alembic()
    yield _kernel()
    yield (sandbox := _sandbox())
    if sandbox.ok:
        yield _trial(root)
        yield _warm_kernels()
    yield _gradebook(root)


def _packages(root: Path) -> Iterator[Finding]:
    wrong = []
    pins = dict(_pins(root / "requirements.txt"))
    for name, pin in pins.items():
        try:
            installed = metadata.version(name)
        except metadata.PackageNotFoundError:
            installed = "missing"
        if installed != pin:
            wrong.append(f"{name} {installed}, pinned {pin}")
    found = "; ".join(wrong) or (f"{len(pins)} as pinned" if pins else f"{root} pins none")
    yield Finding("packages", not wrong, found, SETUP)
    try:
        yield Finding("autograder", True, metadata.version("autograder"))
    except metadata.PackageNotFoundError:
        yield Finding("autograder", False, "not installed", SETUP)
    # The kit may have come with autograder's own files, and then has no version of its own.
    kit = find_spec("dhkit")
    yield Finding("dhkit", kit is not None, str(kit.origin) if kit else "not installed", SETUP)


def _pins(path: Path) -> Iterator[tuple[str, str]]:
    """Names and versions of a requirements file and of the files it names, as far as they are for this Python."""
    for line in path.read_text(encoding="utf-8").splitlines() if path.is_file() else ():
        text = line.partition("#")[0].strip()
        if found := re.match(r"-r\s+(\S+)", text):
            yield from _pins(path.parent / found[1])
        elif "==" in text:
            pin = Requirement(text)
            if pin.marker is None or pin.marker.evaluate():
                yield pin.name, str(pin.specifier).removeprefix("==")


def _alembic() -> Finding:
    path = Path(sys.executable).parent / "alembic"
    found = str(path) if path.is_file() else "not installed"
    return Finding("alembic", path.is_file(), found, f"nbgrader makes gradebooks with it; {SETUP}")


def _kernel() -> Finding:
    try:
        return Finding("kernel", True, f"ipykernel {metadata.version('ipykernel')}")
    except metadata.PackageNotFoundError:
        return Finding("kernel", False, "ipykernel is missing", SETUP)


def _sandbox() -> Finding:
    from autograder.sandbox import available

    reason = available()
    cure = "or grade with --sandbox none, if you trust every submission"
    return Finding("sandbox", reason is None, reason or "bubblewrap works", cure)


def _trial(root: Path) -> Finding:
    from autograder.sandbox import Limits

    from .submission.trial import find_fault

    released = sorted(root.glob("exercises/*/*.ipynb"))
    fault = find_fault(released, Limits(), "bwrap", (root,))
    return Finding("trial notebook", fault is None, fault or "runs in the sandbox and hands in an answer", SETUP)


def _warm_kernels() -> Finding:
    """After the trial notebook: how its kernel started."""
    from autograder.sandbox import why_cold

    reason = why_cold()
    slow = f"not here, each notebook takes some seconds longer: {reason}"
    return Finding("warm kernels", True, slow if reason else "kernels start warm")


def _gradebook(root: Path) -> Finding:
    path, cure = root / "gradebook.db", "restore it from a copy, or move it away and release again"
    if not path.exists():
        return Finding("gradebook", True, "none yet; autograder release makes it")
    try:
        connection = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        try:
            (count,) = connection.execute("select count(*) from submitted_assignment").fetchone()
            (state,) = connection.execute("pragma quick_check").fetchone()
        finally:
            connection.close()
    except sqlite3.Error as error:
        return Finding("gradebook", False, f"{path}: {error}", cure)
    return Finding("gradebook", state == "ok", f"{count} submissions", cure)
