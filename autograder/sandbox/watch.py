"""Watches from outside what a sandbox's processes use together: memory, and time as `clock` counts it.

Control groups would count both, but only root or a user with a delegated group can make them.
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Iterable
from contextlib import suppress

import psutil

from .clock import FairClock, Observation, Spent

INODE_BYTES = 1536  # an inode and its name: an empty file costs memory too
_DESCRIPTOR_BYTES = 208 << 10  # what a socket may buffer unread in the kernel (net.core.wmem_default)
_TICKS = os.sysconf("SC_CLK_TCK")
_PERIOD = 0.2
_LISTS_CHILDREN = os.path.exists(f"/proc/self/task/{os.getpid()}/children")  # a choice made when Linux was built
_LOOKS = 3  # at a family that seems to have lost processor time: a child was just being waited for


def family(root: psutil.Process) -> list[psutil.Process]:
    """Return a process and all its descendants, parents first; nothing when it is gone, whoever has its number then."""
    try:
        return [root, *root.children(recursive=True)]
    except psutil.Error:
        return []


def family_at_a_glance(root: psutil.Process) -> list[psutil.Process]:
    """The same without a look at every process of the machine; one may be missing while others around it end."""
    if not _LISTS_CHILDREN:
        return family(root)
    members = [root] if root.is_running() else []
    for member in members:
        for pid in _children(member.pid):
            with suppress(psutil.Error):
                members.append(psutil.Process(pid))
    return members


def _children(pid: int) -> list[int]:
    """Numbers of the processes that the threads of a process started and that are there."""
    found: list[int] = []
    with suppress(OSError):
        for thread in os.listdir(f"/proc/{pid}/task"):
            with suppress(OSError), open(f"/proc/{pid}/task/{thread}/children") as file:
                found += map(int, file.read().split())
    return found


def _summed_lines(path: str, names: tuple[str, ...]) -> int:
    """Sum in bytes of the named lines of a /proc file that counts in kB; 0 when it cannot be read."""
    try:
        with open(path) as file:
            return sum(int(line.split()[1]) << 10 for line in file if line.startswith(names))
    except (OSError, ValueError, IndexError):
        return 0


def resident_bytes(pid: int) -> int:
    """Return the memory of one process that is not a copy of a file on disk."""
    return _summed_lines(f"/proc/{pid}/status", ("RssAnon:", "RssShmem:", "VmSwap:"))


def _proportional_bytes(pid: int) -> int:
    """The same, with pages that processes share divided among them."""
    return _summed_lines(f"/proc/{pid}/smaps_rollup", ("Pss_Anon:", "Pss_Shmem:", "SwapPss:"))


def buffered_bytes(process: psutil.Process) -> int:
    """Return an upper bound of what the system holds for a process behind its open descriptors."""
    try:
        return process.num_fds() * _DESCRIPTOR_BYTES
    except psutil.Error:
        return 0


def stored_bytes(pid: int, places: Iterable[str]) -> int:
    """Return what the memory file systems at these paths hold, as the process sees them."""
    total = 0
    for place in places:
        try:
            state = os.statvfs(f"/proc/{pid}/root{place}")
        except OSError:
            continue
        total += (state.f_blocks - state.f_bfree) * state.f_frsize
        total += (state.f_files - state.f_ffree) * INODE_BYTES
    return total


def memory_in_use(members: list[psutil.Process], places: Iterable[str] = (), above: int = 0) -> int:
    """Return the bytes held by processes and the memory file systems that the last of them sees.

    Resident sizes are summed first; only when they exceed `above` are pages shared between processes told apart,
    which costs more.
    """
    buffers = sum(map(buffered_bytes, members))
    stored = stored_bytes(members[-1].pid, places) if members else 0
    resident = sum(resident_bytes(member.pid) for member in members)
    if resident + stored + buffers <= above:
        return resident + stored + buffers
    proportional = sum(_proportional_bytes(member.pid) for member in members)
    return (proportional or resident) + stored + buffers


def _stat(path: str) -> list[str]:
    """Fields of a ``stat`` file below /proc from the state on; a process that is gone has none."""
    try:
        with open(path, errors="replace") as file:
            return file.read().rpartition(")")[2].split()
    except OSError:
        return []


def _thread_states(pid: int) -> set[str]:
    try:
        threads = os.listdir(f"/proc/{pid}/task")
    except OSError:
        return set()
    return {state for thread in threads for state in _stat(f"/proc/{pid}/task/{thread}/stat")[:1]}


def observe(members: list[psutil.Process], outer: int) -> Observation:
    """Return what `clock` wants to know about a family.

    Parameters
    ----------
    members : list of psutil.Process
        The family, parents first: of a child that is being waited for, time is missed rather than counted twice.
    outer : int
        So many of its first members can be stopped from outside only.
    """
    stats = [_stat(f"/proc/{member.pid}/stat") for member in members]
    ticks = sum(int(field) for stat in stats for field in stat[11:15])
    stopped = any(stat[:1] == ["T"] for stat in stats[:outer])
    return Observation(ticks / _TICKS, stopped or any("R" in _thread_states(member.pid) for member in members))


class FamilyWatch(threading.Thread):
    """Looks at a family of processes every fifth of a second until it is stopped.

    Parameters
    ----------
    pid : int
        Its first process, which nobody has waited for.
    outer : int
        How many of its processes stand outside the sandbox or keep it, so that it cannot stop them; what they hold
        is not the notebook's.
    places : iterable of str
        Memory file systems whose content counts.
    limit : int or None
        Bytes of memory above which `exceeded` is called, once.
    exceeded : callable

    Attributes
    ----------
    held : int
        Bytes of memory that it held last.
    """

    def __init__(
        self, pid: int, *, outer: int, places: Iterable[str], limit: int | None, exceeded: Callable[[], None]
    ) -> None:
        super().__init__(name="family-watch", daemon=True)
        self._root = psutil.Process(pid)
        self._outer = outer
        self._places = tuple(places)
        self._limit = limit
        self._exceeded = exceeded
        self._done = threading.Event()
        self._looking = threading.Lock()
        self._looked = time.monotonic()
        self._clock = FairClock(self._looked)
        self._processor = 0.0
        self.held = 0

    def run(self) -> None:
        while not self._done.wait(_PERIOD):
            members = self._look()
            if self._limit is not None:
                # Nothing is left of a family that is gone: what it held before tells why.
                self.held = memory_in_use(members[self._outer :], self._places, above=self._limit) or self.held
                if self.held > self._limit:
                    self._exceeded()
                    return

    def spent(self) -> Spent:
        """Return what the family had spent a moment ago."""
        if time.monotonic() - self._looked > 2 * _PERIOD:  # the watch itself is held up, or ended
            self._look()
        return self._clock.spent

    def spent_now(self) -> Spent:
        """Look again, and return what the family has spent."""
        self._look(family_at_a_glance)
        return self._clock.spent

    def memory_now(self) -> int:
        """Return the bytes of memory that the family holds."""
        return memory_in_use(family(self._root)[self._outer :], self._places)

    def _look(self, members_of: Callable[[psutil.Process], list[psutil.Process]] = family) -> list[psutil.Process]:
        with self._looking:
            for _ in range(_LOOKS):
                members = members_of(self._root)
                seen = observe(members, self._outer)
                if seen.processor >= self._processor:
                    break
            self._looked = time.monotonic()
            if members:
                self._processor = seen.processor
                self._clock.tick(self._looked, seen)
            return members

    def stop(self) -> None:
        """End the watch."""
        self._done.set()
        if self.is_alive() and threading.current_thread() is not self:
            self.join()
