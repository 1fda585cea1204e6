"""What one run of one notebook may use: the one place where a limit is named, explained and given its default."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any, Literal

Unit = Literal["bytes", "seconds", "count"]


def _limit(default: float, unit: Unit, help: str) -> Any:
    return field(default=default, metadata={"unit": unit, "help": help})


@dataclass(frozen=True)
class Limits:
    """Bounds of one sandbox, all its processes together.

    The metadata of each field holds its ``unit`` ("bytes", "seconds" or "count") and ``help``, a short text for
    ``--help``. An allocation beyond `memory` fails with MemoryError in the process that asks. However much of
    `output_bytes` was used before, each cell is left an eighth of it.

    Raises
    ------
    ValueError
        If a limit is not a positive number.
    """

    memory: int = _limit(1 << 30, "bytes", "memory for one notebook, files in its private folders included")
    processes: int = _limit(48, "count", "processes and threads of one notebook")
    file_size: int = _limit(64 << 20, "bytes", "size a file may grow to")
    open_files: int = _limit(256, "count", "files that one process may hold open")
    disk: int = _limit(64 << 20, "bytes", "size of each private folder: home, /tmp and /dev/shm")
    cell_seconds: float = _limit(30.0, "seconds", "processor time for one cell")
    notebook_seconds: float = _limit(120.0, "seconds", "processor time for one notebook")
    output_bytes: int = _limit(1 << 20, "bytes", "output of one notebook")

    def __post_init__(self) -> None:
        for limit in fields(self):
            value = getattr(self, limit.name)
            if not 0 < value < float("inf"):
                raise ValueError(f"{limit.name} must be a positive number of {limit.metadata['unit']}, not {value!r}")

    @property
    def message_bytes(self) -> int:
        """Largest single message let through from a kernel: one full quota of output and its envelope."""
        return self.output_bytes + (256 << 10)
