"""Warm kernels: children of a process that has done once what every kernel has to do at its start.

The parent runs in a sandbox (see `warm_parent`) and serves all kernels of this process that may see the same files.
Where there can be none, kernels start cold; `why_cold` says why.
"""

from __future__ import annotations

import asyncio
import atexit
import os
import select
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import IO, Any

from . import bubblewrap
from .fonts import font_list
from .limits import Limits

FIRST_DOOR = 4  # the number that the first of a kernel's sockets has in the kernel, see `warm_parent`
_FOLDER = ".warm"  # in the parent's own home
_MODULES = ("numpy", "sympy", "matplotlib.pyplot", "ipywidgets", "dhkit.rehearsal")
_TEXTS = ("warm_parent", "enter", "kernel")
_IDLE_SECONDS = 60.0  # after which a parent that has no kernel ends
_START_SECONDS = 300.0  # on a busy machine
_LOOK_SECONDS = 1.0
_MESSAGE = 200
_TAIL_BYTES = 4096
_POLL_SECONDS = 0.02
_END_SECONDS = 5.0
_KILLED = 128 + signal.SIGKILL


class NoWarmKernel(RuntimeError):
    """No warm kernel can be had; the message says why."""


class WarmKernel:
    """A kernel that a warm parent forked, with all that it starts.

    Attributes
    ----------
    pid : int
        The first process of its namespaces, which takes all others with it when it ends.
    console : file
        What it writes to its standard output.
    returncode : int or None
        Exit status of the kernel, as a shell gives it, once everything has ended.
    """

    outer = 1  # so many of its processes can be stopped from outside only

    def __init__(self, report: socket.socket, console: IO[bytes], handle: int) -> None:
        self._report, self.console, self._handle = report, console, handle
        self._closing = threading.Lock()  # the watch may want to kill what is just being let go
        self.returncode: int | None = None
        lines = Path(f"/proc/self/fdinfo/{handle}").read_text().splitlines()
        self.pid = next(int(line.split()[1]) for line in lines if line.startswith("Pid:"))

    def poll(self) -> int | None:
        """Return the exit status, None while anything of it runs."""
        with self._closing:
            if self.returncode is None:
                try:
                    words = self._report.recv(_MESSAGE).split()
                except BlockingIOError:
                    return None
                except OSError:
                    words = []
                self.returncode = int(words[1]) if words[:1] == [b"ended"] else _KILLED
            return self.returncode

    def kill(self) -> None:
        """Kill it with everything that it started."""
        with self._closing, suppress(OSError):
            signal.pidfd_send_signal(self._handle, signal.SIGKILL)

    def close(self) -> None:
        """Close what this process holds of it."""
        with self._closing:
            if self._handle >= 0:
                self._report.close()
                self.console.close()
                os.close(self._handle)
                self._handle = -1


class WarmParent:
    """A process in a sandbox that forks kernels; it starts at once, and ends when it has had nothing to do for a while.

    Parameters
    ----------
    hidden : iterable of str
        Folders of the host that neither it nor its kernels must see.

    Attributes
    ----------
    fault : str or None
        Why it cannot be had, or why its kernels cannot.
    gone : bool
        Whether it forks no more.
    """

    def __init__(self, hidden: Iterable[str]) -> None:
        self.fault: str | None = None
        self.gone = False
        self._hidden = tuple(hidden)
        self._ready = False
        self._asking = threading.Lock()
        self._asked = time.monotonic()
        self._kernels: set[WarmKernel] = set()
        self._control, self._theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        # bwrap ends with the thread that started it: the parent must not depend on the life of a worker thread.
        self._thread = threading.Thread(target=self._live, name="warm-parent", daemon=True)
        self._thread.start()

    def _live(self) -> None:
        """Start the process, stay for as long as it lives, and see to it that nothing of it is left."""
        if (place := bubblewrap.place_in_private_folder()) is not None:
            self.fault = f"{place} lies in a folder that every kernel has anew"
            self.gone = True
            self._theirs.close()
            return
        texts = {f"{_FOLDER}/{name}.py": Path(__file__).with_name(f"{name}.py").read_bytes() for name in _TEXTS}
        number = self._theirs.fileno()
        command = [sys.executable, f"{bubblewrap.HOME}/{_FOLDER}/warm_parent.py", str(number), *_MODULES]
        try:
            files = {**texts, **font_list()}
            process = bubblewrap.start_parent(command, files=files, hidden=self._hidden, pass_fds=(number,))
        except (OSError, bubblewrap.SandboxUnavailable) as error:
            self.fault = str(error)
            self.gone = True
            return
        finally:
            self._theirs.close()
        with process:
            self._attend(process)
            self.end()
            try:
                process.wait(_END_SECONDS if self._ready else 0)
            except subprocess.TimeoutExpired:
                process.kill()
        self._control.close()

    def _attend(self, process: subprocess.Popen[bytes]) -> None:
        """Read what it writes until it ends or is not needed any more."""
        assert process.stdout is not None
        tail = b""
        while not self.gone:
            watched: list[Any] = [process.stdout] if self._ready else [process.stdout, self._control]
            readable, _, _ = select.select(watched, [], [], _LOOK_SECONDS)
            if self._control in readable:
                self._ready = self._control.recv(_MESSAGE) == b"ready"
            if process.stdout in readable:
                written = os.read(process.stdout.fileno(), _TAIL_BYTES)
                tail = (tail + written)[-_TAIL_BYTES:]
                if not written:
                    break
            with self._asking:
                self._kernels = {kernel for kernel in self._kernels if kernel.returncode is None}
                if self._kernels:
                    self._asked = time.monotonic()
                patience = _IDLE_SECONDS if self._ready else _START_SECONDS
                self.gone |= time.monotonic() - self._asked > patience
        if not self._ready and self.fault is None:
            words = tail.decode(errors="replace").strip().splitlines()
            self.fault = words[-1] if words else "it did not start"

    def end(self) -> None:
        """Let it end, with all kernels that are left, and do not wait for that."""
        with self._asking:
            self.gone = True
            with suppress(OSError):
                self._control.shutdown(socket.SHUT_RDWR)

    def join(self) -> None:
        """Wait until it has ended."""
        self._thread.join()

    async def fork(
        self, options: Sequence[str], *, limits: Limits, files: Mapping[str, bytes], doors: Sequence[int]
    ) -> WarmKernel:
        """Start a kernel; when this returns, it has taken on everything that bounds it.

        Parameters
        ----------
        options : sequence of str
            Of the kernel's command line.
        limits : Limits
        files : mapping of str to bytes
            By their names below its home.
        doors : sequence of int
            Descriptors that it inherits, as numbers from `FIRST_DOOR` on.

        Raises
        ------
        NoWarmKernel
        """
        while not self._ready and not self.gone:
            await asyncio.sleep(_POLL_SECONDS)
        with ExitStack() as undo, ExitStack() as passed:
            report, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            undo.callback(report.close)
            passed.callback(theirs.close)
            report.setblocking(False)
            reading, writing = os.pipe()
            passed.callback(os.close, writing)
            console = undo.enter_context(open(reading, "rb", buffering=0))
            told = passed.enter_context(bubblewrap.child_plan(options, limits=limits, files=files))
            with self._asking:
                if self.gone:
                    raise NoWarmKernel(self.fault or "the parent of warm kernels has ended")
                self._asked = time.monotonic()
                try:
                    socket.send_fds(self._control, [b"fork"], [told, theirs.fileno(), writing, *doors])
                except OSError as error:
                    raise NoWarmKernel(f"the parent of warm kernels does not answer: {error}") from None
            passed.close()
            try:
                kernel = WarmKernel(report, console, await _started(report))
            except NoWarmKernel as reason:
                self.fault = self.fault or str(reason)
                raise
            with self._asking:
                self._kernels.add(kernel)
            undo.pop_all()
            return kernel


async def _started(report: socket.socket) -> int:
    """Return the handle (pidfd) of a kernel's first process once the kernel reports that it is ready."""
    handle, ready = -1, False
    try:
        while handle < 0 or not ready:
            await _readable(report)
            message, handles, _, _ = socket.recv_fds(report, _MESSAGE, 1)
            handle = handles[0] if handles else handle
            ready |= message == b"ready"
            if not message or message.startswith((b"failed", b"ended")):
                raise NoWarmKernel(message.decode(errors="replace").removeprefix("failed ") or "its parent ended")
        return handle
    except BaseException:
        with suppress(OSError):
            report.shutdown(socket.SHUT_RD)  # from here on the other end fails to hand over, and kills what it made
            while handle < 0 and (found := socket.recv_fds(report, _MESSAGE, 1))[0]:
                handle = found[1][0] if found[1] else handle
        if handle >= 0:
            with suppress(ProcessLookupError):
                signal.pidfd_send_signal(handle, signal.SIGKILL)
            os.close(handle)
        raise


async def _readable(sock: socket.socket) -> None:
    """Wait until something can be read from a socket."""
    loop = asyncio.get_running_loop()
    arrived = loop.create_future()
    loop.add_reader(sock, _settle, arrived)
    try:
        await arrived
    finally:
        loop.remove_reader(sock)


def _settle(arrived: asyncio.Future[None]) -> None:
    if not arrived.done():
        arrived.set_result(None)


_parents: dict[tuple, WarmParent] = {}
_choosing = threading.Lock()


def _parent(hidden: Iterable[str]) -> WarmParent:
    """The parent whose kernels see what kernels may see now; a new one where there is none."""
    hidden = tuple(hidden)
    kit = bubblewrap.package_folder("dhkit")
    changed = max((path.stat().st_mtime_ns for path in Path(kit).rglob("*.py")), default=0) if kit else 0
    key = (*bubblewrap.mounts(Limits(), hidden), changed, shutil.which("bwrap"))
    with _choosing:
        found = _parents.get(key)
        if found is None or (found.gone and found.fault is None):
            found = _parents[key] = WarmParent(hidden)
        return found


async def start_kernel(
    options: Sequence[str],
    *,
    limits: Limits,
    files: Mapping[str, bytes],
    hidden: Iterable[str],
    doors: Sequence[int],
) -> WarmKernel:
    """Start a warm kernel (see `WarmParent.fork`) that sees no `hidden` folder of the host; `NoWarmKernel` if none can be had."""
    parent = _parent(hidden)
    if parent.fault is not None:
        raise NoWarmKernel(parent.fault)
    return await parent.fork(options, limits=limits, files=files, doors=doors)


def why_cold() -> str | None:
    """Say why kernels of this process started cold, None if none had to."""
    return next((parent.fault for parent in _parents.values() if parent.fault is not None), None)


@atexit.register
def end_parents() -> None:
    """End all parents with their kernels."""
    for parent in _parents.values():
        parent.end()
    for parent in _parents.values():
        with suppress(KeyboardInterrupt):  # everything is done and said; who is still there ends by itself
            parent.join()
    _parents.clear()


os.register_at_fork(after_in_child=_parents.clear)  # they are the children of another process
