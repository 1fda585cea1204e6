"""Cold kernels: programs that were started for one notebook, under bubblewrap or without."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
from contextlib import suppress

import psutil


def _kill_child(pid: int, parent: int) -> None:
    """Kill a child of `parent`; nothing happens if it is gone and somebody else has its number."""
    try:
        descriptor = os.pidfd_open(pid)
    except ProcessLookupError:
        return
    try:
        # Is the one seen here not the one behind the descriptor, then that one is gone and gets no signal.
        if psutil.Process(pid).ppid() == parent:
            signal.pidfd_send_signal(descriptor, signal.SIGKILL)
    except (psutil.Error, ProcessLookupError):
        pass
    finally:
        os.close(descriptor)


def _kill_group(leader: int) -> None:
    """Kill the process group of a process that has not been waited for, so that the number is still its own."""
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(leader, signal.SIGKILL)


class ColdKernel:
    """A program that was started to be a kernel, with all that it starts.

    Parameters
    ----------
    process : Popen
        With a pipe for its standard output; bubblewrap if it is sandboxed.
    sandboxed : bool

    Attributes
    ----------
    pid : int
        Its first process.
    console : file
        What it writes to its standard output.
    outer : int
        How many of its processes stand outside the sandbox or keep it, so that it cannot stop them.
    """

    def __init__(self, process: subprocess.Popen[bytes], sandboxed: bool) -> None:
        assert process.stdout is not None
        self.console = process.stdout
        self.pid = process.pid
        self.outer = 2 if sandboxed else 0  # bwrap, and the first process of the sandbox
        self._process = process
        self._sandboxed = sandboxed
        self._reaping = threading.Lock()  # the watch may want to kill what is just being waited for

    def poll(self) -> int | None:
        """Return the exit status, None while it runs; what is left of its group ends before its number is given back."""
        process = self._process
        with self._reaping:
            if process.returncode is None:
                try:
                    if psutil.Process(process.pid).status() != psutil.STATUS_ZOMBIE:
                        return None
                    _kill_group(process.pid)
                except psutil.NoSuchProcess:
                    pass  # where nobody waits for processes (SIGCHLD is ignored) it is given back at once
            return process.poll()

    def kill(self) -> None:
        """Kill everything that runs in the sandbox.

        The first process of the PID namespace takes all others with it, and bubblewrap, its parent, ends only after
        they are gone.
        """
        process = self._process
        with self._reaping:
            if process.returncode is not None:
                return  # its number may be anybody's by now
            try:
                first = psutil.Process(process.pid).children() if self._sandboxed else []
            except psutil.Error:
                first = []
            for child in first:
                _kill_child(child.pid, process.pid)
            if not first:
                _kill_group(process.pid)

    def close(self) -> None:
        """Close what this process holds of it."""
        self.console.close()
