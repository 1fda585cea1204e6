"""Runs a student's notebook where it can harm and learn nothing.

Two things are known and left as they are. Sandboxes that run at the same time can exchange bits through locks
(``flock``) on files of the system that both may read, and see by inotify when such a file is opened: no answer and no
points go that way faster than by talking before the exercise. And memory and processor time are counted by looking at
the processes every fifth of a second, not by control groups, which only root or a user with a delegated group can
make; a sandbox can go beyond a limit by what it does in that time.

Kernels are children of one warm parent where that can be had. Of each other they know what all children of it have in
common: where its libraries and objects lie in memory, and the order in which sets of text are gone through (the seed
of Python's hashes). Nothing of a student's and nothing of a solution is ever in the parent's memory, and whatever a
kernel writes is its own.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .limits import Limits

if TYPE_CHECKING:
    from .bubblewrap import SandboxUnavailable, available
    from .client import CellRun, KernelStartError
    from .run import Run, cancel_runs, run_notebook
    from .scratch import sweep
    from .warm import why_cold
from .workdir import NotPlain, TooLarge, plain_bytes, plain_files, read_folders

__all__ = [
    "CellRun",
    "KernelStartError",
    "Limits",
    "NotPlain",
    "Run",
    "SandboxUnavailable",
    "TooLarge",
    "available",
    "cancel_runs",
    "plain_bytes",
    "plain_files",
    "read_folders",
    "run_notebook",
    "sweep",
    "why_cold",
]

_MODULES = {
    "CellRun": "client",
    "KernelStartError": "client",
    "Run": "run",
    "SandboxUnavailable": "bubblewrap",
    "available": "bubblewrap",
    "cancel_runs": "run",
    "run_notebook": "run",
    "sweep": "scratch",
    "why_cold": "warm",
}


def __getattr__(name: str) -> Any:
    # Jupyter is imported when a notebook is run: the command line shows the limits at once.
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_MODULES[name]}", __name__), name)
