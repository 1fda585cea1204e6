"""Runs a student's notebook where it can harm and learn nothing."""

from .bubblewrap import SandboxUnavailable, available
from .client import CellRun, KernelStartError
from .limits import Limits
from .run import Run, run_notebook

__all__ = [
    "CellRun",
    "KernelStartError",
    "Limits",
    "Run",
    "SandboxUnavailable",
    "available",
    "run_notebook",
]
