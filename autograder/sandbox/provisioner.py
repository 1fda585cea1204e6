"""jupyter_client kernel provisioner that starts the kernel in a sandbox.

Chosen by a kernel spec whose metadata says
``{"kernel_provisioner": {"provisioner_name": "autograder-sandbox"}}``.
"""

from __future__ import annotations

import asyncio
import json
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

from jupyter_client.connect import KernelConnectionInfo, port_names
from jupyter_client.manager import KernelManager
from jupyter_client.provisioning import LocalProvisioner
from traitlets import Bool, Bytes, Dict, Instance, Unicode
from traitlets import List as ListOf

from . import bubblewrap
from .cold import ColdKernel
from .fonts import font_list
from .limits import Limits
from .relay import Relay, listening_sockets
from .scratch import PrivateFolder
from .warm import FIRST_DOOR, NoWarmKernel, WarmKernel, start_kernel
from .watch import FamilyWatch

_CONNECTION = ".kernel.json"  # in the home of a sandboxed kernel
_POLL_SECONDS = 0.01
_NO_HISTORY = "--HistoryManager.hist_file=:memory:"
_XCPU_STATUS = 128 + signal.SIGXCPU


def _kernel_source() -> str:
    return Path(__file__).with_name("kernel.py").read_text()


class SandboxProvisioner(LocalProvisioner):
    """Starts a kernel under bubblewrap, relays its messages, watches what it uses, and leaves nothing behind.

    A sandboxed kernel is the child of a warm parent where there can be one. With ``sandboxed`` off the same kernel runs as an ordinary local process: only the bounds on time and messages
    hold.
    """

    limits = Instance(Limits, args=())
    files = Dict(Bytes(), help="contents of the kernel's private work folder, by name")
    hidden = ListOf(Unicode(), help="folders that the kernel must not see, wherever they are")
    sandboxed = Bool(True)
    warm = Bool(True, help="whether the kernel may be the child of a warm parent")

    process: ColdKernel | WarmKernel | None  # type: ignore[assignment]
    relay: Relay  # from the kernel's start on
    watch: FamilyWatch  # likewise
    memory_exceeded = False
    exit_status: int | None = None
    _private: PrivateFolder | None = None

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
            process = await self._start([door.fileno() for door in back], options, kwargs.get("env"))
        finally:
            for door in back:
                door.close()
        self.process, self.pid = process, process.pid
        self.pgid = None if self.sandboxed else process.pid
        self.memory_exceeded = False
        self.relay = Relay(dict(zip(front, back_paths)), process.console.fileno(), self.limits.message_bytes)
        self.relay.start()
        self.watch = FamilyWatch(
            process.pid,
            outer=process.outer,
            places=bubblewrap.PRIVATE if self.sandboxed else (),
            limit=self.limits.memory if self.sandboxed else None,
            exceeded=self._too_much_memory,
        )
        self.watch.start()
        return self.connection_info

    async def _start(
        self, descriptors: list[int], options: list[str], env: dict[str, str] | None
    ) -> ColdKernel | WarmKernel:
        options = list(dict.fromkeys((_NO_HISTORY, *options)))  # nbclient passes the first one as well
        if not self.sandboxed:
            return ColdKernel(self._start_in_place(descriptors, options, env), sandboxed=False)
        files = {f"work/{name}": content for name, content in self.files.items()} | font_list()
        options += ["-f", f"{bubblewrap.HOME}/{_CONNECTION}"]
        if self.warm:
            numbers = list(range(FIRST_DOOR, FIRST_DOOR + len(descriptors)))
            told = files | {_CONNECTION: self._connection(numbers)}
            with suppress(NoWarmKernel):
                return await start_kernel(
                    options, limits=self.limits, files=told, hidden=self.hidden, doors=descriptors
                )
        process = bubblewrap.start(
            [sys.executable, "-c", _kernel_source(), *options],
            limits=self.limits,
            files=files | {_CONNECTION: self._connection(descriptors)},
            hidden=self.hidden,
            pass_fds=descriptors,
        )
        return ColdKernel(process, sandboxed=True)

    def _start_in_place(
        self, descriptors: list[int], options: list[str], env: dict[str, str] | None
    ) -> subprocess.Popen[bytes]:
        work = self.folder / "work"
        work.mkdir(exist_ok=True)
        for name, content in self.files.items():
            path = work / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        own_connection = self.folder / "own-kernel.json"
        own_connection.write_bytes(self._connection(descriptors))
        return subprocess.Popen(
            [sys.executable, "-c", _kernel_source(), *options, "-f", str(own_connection)],
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
        if (process := self.process) is not None:
            process.kill()

    async def poll(self) -> int | None:
        if self.process is None:
            return 0
        status = self.process.poll()
        if status is not None:
            self.exit_status = status
        return status

    async def wait(self) -> int | None:
        """Wait for the kernel and everything it started to be gone."""
        while await self.poll() is None:
            await asyncio.sleep(_POLL_SECONDS)
        self._let_go()
        return self.exit_status

    async def kill(self, restart: bool = False) -> None:
        """Kill the kernel and everything it started."""
        if self.process is not None:
            self.process.kill()
            while self.process.poll() is None:
                await asyncio.sleep(_POLL_SECONDS)

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
        if self.process is not None:
            self.process.kill()
            while self.process.poll() is None:
                time.sleep(_POLL_SECONDS)
        self._let_go()
        if self._private is not None:
            self._private.remove()
            self._private = None

    def _let_go(self) -> None:
        """End what goes with a kernel that is gone."""
        for thread in (getattr(self, "watch", None), getattr(self, "relay", None)):
            if thread is not None:
                thread.stop()
        if self.process is not None:
            self.process.close()
        self.process = None

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
