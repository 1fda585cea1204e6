"""Watches from outside what a sandbox's processes hold in memory together."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable

import psutil

INODE_BYTES = 1536  # an inode and its name: an empty file costs memory too
DESCRIPTOR_BYTES = 208 << 10  # what a socket may buffer unread in the kernel (net.core.wmem_default)


def family(pid: int) -> list[psutil.Process]:
    """A process and all its descendants; empty when it is gone."""
    try:
        root = psutil.Process(pid)
        return [root, *root.children(recursive=True)]
    except psutil.Error:
        return []


def summed_lines(path: str, names: tuple[str, ...]) -> int:
    """Sum in bytes of the named lines of a /proc file that counts in kB; 0 when it cannot be read."""
    try:
        with open(path) as file:
            return sum(int(line.split()[1]) << 10 for line in file if line.startswith(names))
    except (OSError, ValueError, IndexError):
        return 0


def resident_bytes(pid: int) -> int:
    """Memory of one process that is not a copy of a file on disk."""
    return summed_lines(f"/proc/{pid}/status", ("RssAnon:", "RssShmem:", "VmSwap:"))


def proportional_bytes(pid: int) -> int:
    """The same, with pages that processes share divided among them."""
    return summed_lines(f"/proc/{pid}/smaps_rollup", ("Pss_Anon:", "Pss_Shmem:", "SwapPss:"))


def buffered_bytes(process: psutil.Process) -> int:
    """Upper bound of what the system holds for a process behind its open descriptors."""
    try:
        return process.num_fds() * DESCRIPTOR_BYTES
    except psutil.Error:
        return 0


def stored_bytes(pid: int, places: Iterable[str]) -> int:
    """What the memory file systems at these paths hold, as the process sees them."""
    total = 0
    for place in places:
        try:
            state = os.statvfs(f"/proc/{pid}/root{place}")
        except OSError:
            continue
        total += (state.f_blocks - state.f_bfree) * state.f_frsize
        total += (state.f_files - state.f_ffree) * INODE_BYTES
    return total


def memory_in_use(pid: int, places: Iterable[str] = (), above: int = 0) -> int:
    """Bytes held by a process, its descendants and the memory file systems they see.

    Resident sizes are summed first; only when they exceed ``above`` are pages
    shared between processes told apart, which costs more.
    """
    members = family(pid)
    buffers = sum(map(buffered_bytes, members))
    stored = stored_bytes(members[-1].pid, places) if members else 0
    resident = sum(resident_bytes(member.pid) for member in members)
    if resident + stored + buffers <= above:
        return resident + stored + buffers
    proportional = sum(proportional_bytes(member.pid) for member in members)
    return (proportional or resident) + stored + buffers


class MemoryWatch(threading.Thread):
    """Calls ``exceeded`` once when a process family holds more than ``limit`` bytes; ``held`` is what it held last."""

    def __init__(
        self, pid: int, places: Iterable[str], limit: int, exceeded: Callable[[], None], period: float = 0.2
    ) -> None:
        super().__init__(name="memory-watch", daemon=True)
        self._pid = pid
        self._places = tuple(places)
        self._limit = limit
        self._exceeded = exceeded
        self._period = period
        self._done = threading.Event()
        self.held = 0

    def run(self) -> None:
        while not self._done.wait(self._period):
            # Nothing is left of a family that is gone: what it held before tells why.
            self.held = memory_in_use(self._pid, self._places, above=self._limit) or self.held
            if self.held > self._limit:
                self._exceeded()
                return

    def stop(self) -> None:
        self._done.set()
        if self.is_alive() and threading.current_thread() is not self:
            self.join()
