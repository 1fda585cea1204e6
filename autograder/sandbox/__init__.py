"""Runs a student's notebook where it can harm and learn nothing."""

from .bubblewrap import SandboxUnavailable, available
from .client import CellRun, KernelStartError
from .limits import Limits
from .run import Run, cancel_runs, run_notebook

__all__ = [
    "CellRun",
    "KernelStartError",
    "Limits",
    "Run",
    "SandboxUnavailable",
    "available",
    "cancel_runs",
    "run_notebook",
]
