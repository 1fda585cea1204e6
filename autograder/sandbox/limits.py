"""What one run of one notebook may use."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Limits:
    """Bounds of one sandbox; bytes and seconds.

    ``memory`` holds for the whole sandbox (all processes, private file systems
    included); an allocation beyond it fails with MemoryError in the process
    that asks.  ``disk`` is the size of each private file system (home with the
    work folder, /tmp, /dev/shm).  ``cpu_seconds`` counts per process.
    ``output_bytes`` is what the outputs of one notebook may add up to while
    they stream; each cell is left an eighth of it whatever was used before.
    """

    memory: int = 1 << 30
    processes: int = 128
    file_size: int = 64 << 20
    open_files: int = 256
    disk: int = 64 << 20
    cpu_seconds: int = 120
    cell_seconds: float = 30.0
    notebook_seconds: float = 120.0
    output_bytes: int = 1 << 20

    @property
    def message_bytes(self) -> int:
        """Largest single message let through from a kernel: one full quota of output and its envelope."""
        return self.output_bytes + (256 << 10)
