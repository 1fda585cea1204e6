"""jupyter_client kernel provisioner that starts the kernel in a sandbox.

Chosen by a kernel spec whose metadata says
``{"kernel_provisioner": {"provisioner_name": "autograder-sandbox"}}``.
"""

from __future__ import annotations

import asyncio
import functools
import glob
import importlib.util
import json
import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

import psutil
from jupyter_client.connect import KernelConnectionInfo, port_names
from jupyter_client.manager import KernelManager
from jupyter_client.provisioning import LocalProvisioner
from traitlets import Bool, Bytes, Dict, Instance, Unicode
from traitlets import List as ListOf

from . import bubblewrap
from .limits import Limits
from .relay import Relay, listening_sockets
from .scratch import PrivateFolder
from .watch import FamilyWatch

_NO_HISTORY = "--HistoryManager.hist_file=:memory:"
_XCPU_STATUS = 128 + signal.SIGXCPU


@functools.cache
def _font_list() -> dict[str, bytes]:
    """matplotlib's list of fonts, by its place in the sandbox's home.

    Building it takes half a second, so it is done once for this user and not in every new home.
    """
    home = os.path.expanduser("~")
    cache = os.environ.get("XDG_CACHE_HOME") or f"{home}/.cache"
    folder = os.environ.get("MPLCONFIGDIR") or f"{cache}/matplotlib"
    pattern = f"{glob.escape(folder)}/fontlist-v*.json"
    found = glob.glob(pattern)
    if not found and importlib.util.find_spec("matplotlib"):
        subprocess.run([sys.executable, "-c", "import matplotlib.font_manager"], check=False, capture_output=True)
        found = glob.glob(pattern)
    return {f".cache/matplotlib/{os.path.basename(path)}": Path(path).read_bytes() for path in found}


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


class SandboxProvisioner(LocalProvisioner):
    """Starts a kernel under bubblewrap, relays its messages, watches what it uses, and leaves nothing behind.

    With ``sandboxed`` off the same kernel runs as an ordinary local process: only the bounds on time and messages
    hold.
    """

    limits = Instance(Limits, args=())
    files = Dict(Bytes(), help="contents of the kernel's private work folder, by name")
    hidden = ListOf(Unicode(), help="folders that the kernel must not see, wherever they are")
    sandboxed = Bool(True)

    relay: Relay  # from the kernel's start on
    watch: FamilyWatch  # likewise
    memory_exceeded = False
    exit_status: int | None = None
    _private: PrivateFolder | None = None
    _console: IO[bytes] | None = None

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._reaping = threading.Lock()  # the watch may want to kill what is just being waited for

    @property
    def folder(self) -> Path:
        """The private folder of this kernel's sockets; made when it is first asked for."""
        if self._private is None:
            self._private = PrivateFolder()
        return self._private.path

    @property
    def _manager(self) -> KernelManager:
        assert isinstance(self.parent, KernelManager)
        return self.parent

    async def pre_launch(self, **kwargs: Any) -> dict[str, Any]:
        self._manager.transport = "ipc"
        self._manager.connection_file = str(self.folder / "kernel.json")
        self._manager.ip = str(self.folder / "k")
        for number, name in enumerate(port_names, start=1):
            setattr(self._manager, name, number)
        return await super().pre_launch(**kwargs)

    async def launch_kernel(self, cmd: list[str], **kwargs: Any) -> KernelConnectionInfo:
        """Start the kernel; the command's options after the kernel spec's own are passed on to it."""
        options = cmd[len(self.kernel_spec.argv) :]
        front = listening_sockets([self.folder / f"k-{number}" for number, _ in enumerate(port_names, 1)])
        back_paths = [self.folder / f"s-{number}" for number, _ in enumerate(port_names, 1)]
        back = listening_sockets(back_paths)
        try:
            process = self._start([door.fileno() for door in back], options, kwargs.get("env"))
        finally:
            for door in back:
                door.close()
        assert process.stdout is not None
        self.process, self.pid, self._console = process, process.pid, process.stdout
        self.pgid = None if self.sandboxed else process.pid
        self.memory_exceeded = False
        self.relay = Relay(dict(zip(front, back_paths)), process.stdout.fileno(), self.limits.message_bytes)
        self.relay.start()
        self.watch = FamilyWatch(
            process.pid,
            outer=2 if self.sandboxed else 0,  # bwrap, and the first process of the sandbox
            places=bubblewrap.PRIVATE if self.sandboxed else (),
            limit=self.limits.memory if self.sandboxed else None,
            exceeded=self._too_much_memory,
        )
        self.watch.start()
        return self.connection_info

    def _start(self, descriptors: list[int], options: list[str], env: dict[str, str] | None) -> subprocess.Popen[bytes]:
        connection = self._connection(descriptors)
        source = Path(__file__).with_name("kernel.py").read_text()
        # nbclient passes the first option as well.
        command = [sys.executable, "-c", source, *dict.fromkeys((_NO_HISTORY, *options))]
        if self.sandboxed:
            files = {f"work/{name}": content for name, content in self.files.items()}
            files |= {**_font_list(), ".kernel.json": connection}
            return bubblewrap.start(
                [*command, "-f", f"{bubblewrap.HOME}/.kernel.json"],
                limits=self.limits,
                files=files,
                hidden=self.hidden,
                pass_fds=descriptors,
            )
        work = self.folder / "work"
        work.mkdir(exist_ok=True)
        for name, content in self.files.items():
            path = work / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        own_connection = self.folder / "own-kernel.json"
        own_connection.write_bytes(connection)
        return subprocess.Popen(
            [*command, "-f", str(own_connection)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            pass_fds=descriptors,
            env=env,
            cwd=work,
            start_new_session=True,
        )

    def _connection(self, descriptors: list[int]) -> bytes:
        """The kernel's own connection file: its ports are the descriptors of the sockets it inherits."""
        info = {
            "transport": "ipc",
            "ip": "kernel",
            "key": self._manager.session.key.decode(),
            "signature_scheme": self._manager.session.signature_scheme,
            **dict(zip(port_names, descriptors)),
        }
        return json.dumps(info).encode()

    def _too_much_memory(self) -> None:
        self.memory_exceeded = True
        self._kill_family()

    def _kill_family(self) -> None:
        """Kill everything that runs in the sandbox.

        The first process of the PID namespace takes all others with it, and bubblewrap, its parent, ends only after
        they are gone.
        """
        process = self.process
        if process is None:
            return
        with self._reaping:
            if process.returncode is not None:
                return  # its number may be anybody's by now
            try:
                first = psutil.Process(process.pid).children() if self.sandboxed else []
            except psutil.Error:
                first = []
            for child in first:
                _kill_child(child.pid, process.pid)
            if not first:
                _kill_group(process.pid)

    def _ended(self, process: subprocess.Popen[bytes]) -> int | None:
        """Exit status once the process has ended; what is left of its group ends before its number is given back."""
        with self._reaping:
            if process.returncode is None:
                try:
                    if psutil.Process(process.pid).status() != psutil.STATUS_ZOMBIE:
                        return None
                    _kill_group(process.pid)
                except psutil.NoSuchProcess:
                    pass  # where nobody waits for processes (SIGCHLD is ignored) it is given back at once
            return process.poll()

    async def poll(self) -> int | None:
        if self.process is None:
            return 0
        status = self._ended(self.process)
        if status is not None:
            self.exit_status = status
        return status

    async def wait(self) -> int | None:
        """Wait for the kernel and everything it started to be gone."""
        while await self.poll() is None:
            await asyncio.sleep(0.05)
        self._let_go()
        return self.exit_status

    async def kill(self, restart: bool = False) -> None:
        """Kill the kernel and everything it started."""
        self._kill_family()
        for _ in range(50):
            if self.process is None or self._ended(self.process) is not None:
                return
            await asyncio.sleep(0.05)
        if self.process is not None:
            with self._reaping:
                self.process.kill()

    async def terminate(self, restart: bool = False) -> None:
        """Same as kill: a student's kernel is not asked."""
        await self.kill(restart)

    async def send_signal(self, signum: int) -> None:
        """Signals do not reach into the sandbox, except the one that ends it; interrupts go by message."""
        if signum in (signal.SIGKILL, signal.SIGTERM):
            await self.kill()

    async def cleanup(self, restart: bool = False) -> None:
        self.release()

    def release(self) -> None:
        """End the relay and the watch, kill what is left, remove the private folder."""
        self._kill_family()
        while self.process is not None and self._ended(self.process) is None:
            time.sleep(0.01)
        self._let_go()
        if self._private is not None:
            self._private.remove()
            self._private = None

    def _let_go(self) -> None:
        """End what goes with a kernel that is gone."""
        for thread in (getattr(self, "watch", None), getattr(self, "relay", None)):
            if thread is not None:
                thread.stop()
        if self._console is not None:
            self._console.close()
        self.process = self._console = None

    def cause_of_death(self) -> tuple[str, str]:
        """Return (status, sentence) for a kernel that ended although nobody asked it to."""
        if self.memory_exceeded:
            return "memory", f"used more than {self.limits.memory >> 20} MiB of memory and was stopped"
        if self.exit_status == _XCPU_STATUS:
            return "timeout", f"used up its {self.limits.notebook_seconds:g} s of processor time"
        if self.watch.held > self.limits.memory * 3 // 4:
            # Where memory is full, libraries below Python end the process instead of raising MemoryError.
            return "memory", f"the kernel ended with {self.watch.held >> 20} MiB of memory in use"
        return "died", "the kernel ended while the cell was running"
