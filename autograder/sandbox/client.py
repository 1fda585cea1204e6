"""Runs code in one kernel and keeps what comes back within bounds."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import nbformat
import zmq
import zmq.asyncio
from jupyter_client.asynchronous.client import AsyncKernelClient
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionComplete
from nbformat import NotebookNode

from .clock import Spent, TimeUp, is_over, time_up
from .kernelspec import SandboxKernelSpecs
from .limits import Limits
from .messages import MalformedMessage, Message, as_text, decode, output_content
from .provisioner import SandboxProvisioner

# Seconds in which nothing holds the kernel up, like the bounds on a cell.
START_SECONDS = 60.0
_INTERRUPT_SECONDS = 3.0  # what a cell gets to end after an interrupt before its kernel is killed
_SETTLE_SECONDS = 5.0  # what the other half of a cell's end may lag behind

_POLL_SECONDS = 0.2
_PROBE_SECONDS = 0.5  # until a kernel that was interrupted is asked once more whether it is ready
_MESSAGE_OVERHEAD = 200  # bytes: an output costs memory beyond its text
_SHARE = 8  # a cell may always use this part of the notebook's quota,
_SHARES_END = 4  # until the notebook has used its quota this many times
_FLOOD = 16  # a cell that goes on beyond the quota is let run, unheard, until it has printed the quota this many times
_KEPT_BYTES = 16 << 10  # of the outputs of a cell that was stopped for what it printed
_QUEUED_MESSAGES = 8
_MESSAGE_CHARACTERS = 300
_OUT_OF_MEMORY = ("MemoryError", "_ArrayMemoryError")


class KernelStartError(RuntimeError):
    """A kernel could not be started although a sandbox can be had; a fault of this machine, not of the notebook."""


@dataclass
class CellRun:
    """What happened in one code cell.

    Attributes
    ----------
    status : str
        "ok", "error", "timeout", "output_limit", "memory", "died" or "not_run".
    message : str
        One sentence for a lecturer, empty when all is well.
    outputs : list of NotebookNode
        The cell's outputs in notebook format, within the limits.
    doubtful : bool
        Whether the machine may be to blame: time ran out, or the kernel ended for no reason that is known.
    """

    status: str
    message: str = ""
    outputs: list[NotebookNode] = field(default_factory=list)
    doubtful: bool = False


@dataclass
class _Progress:
    """State of a running cell.

    Attributes
    ----------
    allowed, flood : int
        What its outputs may add up to, and where it is stopped, in bytes.
    refused : bool
        Whether a message was left out on the way.
    ended_at, interrupted_at : Spent or None
        What the kernel had spent when the first half of the cell's end came, and when it was interrupted.
    stopped : (status, message)
        Once it was interrupted.
    interrupt, interrupted : str, bool
        The id of that request, and whether it was answered.
    """

    allowed: int
    flood: int
    refused: bool = False
    reply: dict[str, Any] | None = None
    idle: bool = False
    ended_at: Spent | None = None
    streamed: int = 0
    stopped: tuple[str, str] | None = None
    interrupted_at: Spent | None = None
    interrupt: str | None = None
    interrupted: bool = False

    @property
    def over(self) -> bool:
        return self.refused or self.streamed > self.allowed

    @property
    def flooding(self) -> bool:
        return self.refused or self.streamed > self.flood


class SandboxClient(NotebookClient):
    """nbclient's bookkeeping of outputs and displays, with our own way of running a cell.

    A client lives as long as one kernel; the caller carries over to the next one what the notebook has used up.

    Attributes
    ----------
    used : int
        What the outputs of the notebook hold so far, in bytes.
    spent : Spent
        Time that its cells have taken so far.
    lost : bool
        Whether the kernel is dead or has to be killed.
    time_up : TimeUp or None
        The bound on time that was met last.
    """

    def __init__(
        self, nb: NotebookNode, limits: Limits, options: dict[str, Any], used: int = 0, spent: Spent = Spent()
    ) -> None:
        self._manager = AsyncKernelManager(
            kernel_spec_manager=SandboxKernelSpecs({**options, "limits": limits}), kernel_name="python3"
        )
        super().__init__(nb, km=self._manager)
        self.limits = limits
        self.used = used
        self.spent = spent
        self.lost = False
        self.time_up: TimeUp | None = None

    @property
    def provisioner(self) -> SandboxProvisioner:
        provisioner = self._manager.provisioner
        assert isinstance(provisioner, SandboxProvisioner)
        return provisioner

    @property
    def _kernel(self) -> AsyncKernelClient:
        assert isinstance(self.kc, AsyncKernelClient)
        return self.kc

    async def start(self) -> None:
        """Start the kernel and wait until it answers.

        Raises
        ------
        KernelStartError
            If it ends or does not answer.
        """
        await self._manager.start_kernel()
        self.kc = self._manager.client()
        context = self._kernel.context
        assert context is not None
        context.setsockopt(zmq.MAXMSGSIZE, self.limits.message_bytes)
        context.setsockopt(zmq.RCVHWM, _QUEUED_MESSAGES)
        self._kernel.start_channels(stdin=False, hb=False)
        answered = heard = False
        while not (answered and heard):
            self._kernel.kernel_info()
            for channel, _ in await self._receive(1.0):
                answered |= channel == "shell"
                heard |= channel == "iopub"
            # The first status messages may come before the subscription does: ask again until one is heard.
            if answered and not heard:
                heard = any(channel == "iopub" for channel, _ in await self._receive(_POLL_SECONDS))
            if await self.provisioner.poll() is not None or is_over(self.provisioner.watch.spent(), START_SECONDS):
                raise KernelStartError(f"the kernel did not start: {self._last_words()}")

    def _last_words(self) -> str:
        lines = self.provisioner.relay.tail.decode(errors="replace").strip().splitlines()
        return lines[-1] if lines else "it did not answer"

    def close(self) -> None:
        """Kill the kernel with everything it started and remove its private folder; never fails halfway."""
        if self._manager.provisioner is not None:
            self.provisioner.release()
        if self.kc is not None:
            self._kernel.stop_channels()
            if self._kernel.context is not None:
                self._kernel.context.destroy(linger=0)
        self._manager._close_control_socket()
        self._manager.context.destroy(linger=0)

    async def _receive(self, seconds: float) -> list[tuple[str, Message | None]]:
        """Messages waiting on shell, iopub and control, as (channel, message); None stands for a malformed one."""
        sockets = {getattr(self._kernel, f"{name}_channel").socket: name for name in ("shell", "iopub", "control")}
        poller = zmq.asyncio.Poller()
        for socket in sockets:
            poller.register(socket, zmq.POLLIN)
        received: list[tuple[str, Message | None]] = []
        for socket, _ in await poller.poll(max(0, int(seconds * 1000))):
            frames = await socket.recv_multipart()
            try:
                message = decode(frames, self._kernel.session.key)
            except MalformedMessage:
                message = None
            received.append((sockets[socket], message))
        return received

    async def run_code(self, source: str, cell: NotebookNode, index: int) -> CellRun:
        """Run `source` in the kernel, its outputs going to `cell`, which is number `index` of the notebook."""
        cell.outputs = []
        refused_before = self.provisioner.relay.refused
        self.clear_before_next_output = False
        self.time_up = None
        watch = self.provisioner.watch
        start = watch.spent_now()
        request = self._kernel.execute(source, allow_stdin=False, stop_on_error=False)
        progress = _Progress(allowed=self._allowance(), flood=_FLOOD * self.limits.output_bytes)
        while not self._finished(progress):
            taken = watch.spent() - start
            if progress.stopped is None and (up := time_up(self.limits, taken, self.spent + taken)):
                self.time_up = up
                progress.stopped = ("timeout", up.message)
            if progress.stopped is None and progress.flooding:
                progress.stopped = ("output_limit", self._too_much_output())
            if progress.stopped is not None and progress.interrupt is None:
                progress.interrupted_at = watch.spent()
                progress.interrupt = self._interrupt()
            if self._stays(progress) or (self.time_up is not None and self.time_up.starved):
                self.lost = True
                break
            if await self.provisioner.poll() is not None:
                self.lost = True
                progress.stopped = progress.stopped or self.provisioner.cause_of_death()
                break
            for channel, message in await self._receive(_POLL_SECONDS):
                if message is None:
                    continue
                if channel == "control":
                    progress.interrupted |= message.parent == progress.interrupt
                elif message.parent == request:
                    self._take(channel, message, progress, cell, index)
            progress.refused = self.provisioner.relay.refused > refused_before
        if progress.interrupt is not None and not self.lost:
            self.lost = not await self._outlives_interrupt(progress)
        self.spent += watch.spent_now() - start
        return self._result(progress, cell)

    def _stays(self, progress: _Progress) -> bool:
        """Whether a cell does not end although it was interrupted."""
        since = progress.interrupted_at
        return since is not None and is_over(self.provisioner.watch.spent() - since, _INTERRUPT_SECONDS)

    def _interrupt(self) -> str:
        """Ask the kernel to interrupt what it runs; the id of the request."""
        message = self._kernel.session.msg("interrupt_request", {})
        self._kernel.control_channel.send(message)
        return message["header"]["msg_id"]

    async def _outlives_interrupt(self, progress: _Progress) -> bool:
        """Whether the kernel is ready for the next cell, now that the interrupted one has ended.

        A cell may end before its interrupt comes, which would then hit the next
        one, or the kernel itself in taking that one in, and it would never be answered.
        """
        watch = self.provisioner.watch
        start = watch.spent()
        probes: set[str] = set()
        ask_again = 0.0
        while not is_over(watch.spent() - start, _INTERRUPT_SECONDS) and await self.provisioner.poll() is None:
            if progress.interrupted and time.monotonic() >= ask_again:
                probes.add(self._kernel.kernel_info())
                ask_again = time.monotonic() + _PROBE_SECONDS
            for channel, message in await self._receive(_POLL_SECONDS):
                if message is not None and channel == "control":
                    progress.interrupted |= message.parent == progress.interrupt
                if message is not None and channel == "shell" and message.parent in probes:
                    return True
        return False

    def _allowance(self) -> int:
        """What the next cell's outputs may add up to.

        A cell is left a share whatever the cells before it used, so that one that prints too much does not silence
        the others.
        """
        quota = self.limits.output_bytes
        return max(quota - self.used, quota // _SHARE if self.used < _SHARES_END * quota else 0)

    def _finished(self, progress: _Progress) -> bool:
        """Whether the cell ended: both halves of its end came, or the second does not come any more.

        A message that was too long is left out, and it may have been one of the two. A kernel of which one half is
        missing is not used any further.
        """
        if progress.reply is not None and progress.idle:
            return True
        if progress.reply is None and not (progress.idle and progress.refused):
            progress.ended_at = None
            return False
        now = self.provisioner.watch.spent()
        if progress.ended_at is None:
            progress.ended_at = now
        self.lost = is_over(now - progress.ended_at, _SETTLE_SECONDS)
        return self.lost

    def _take(self, channel: str, message: Message, progress: _Progress, cell: NotebookNode, index: int) -> None:
        if channel == "shell":
            if message.kind == "execute_reply":
                progress.reply = message.content
            return
        progress.streamed += message.size + _MESSAGE_OVERHEAD
        if message.kind == "status":
            progress.idle = progress.idle or message.content.get("execution_state") == "idle"
            return
        content = output_content(message)
        if content is None or progress.over:
            return
        header = {"msg_type": message.kind}
        try:
            self.process_message(
                {**header, "header": header, "parent_header": {"msg_id": message.parent}, "content": content},
                cell,
                index,
            )
        except (CellExecutionComplete, LookupError, ValueError):
            return  # an update of a display that is not there any more

    def output(
        self, outs: list[NotebookNode], msg: dict[str, Any], display_id: str | None, cell_index: int
    ) -> NotebookNode | None:
        """Append an output, or lengthen the last one when both are the same stream."""
        content = msg["content"]
        last = outs[-1] if outs and not self.clear_before_next_output else None
        if msg["msg_type"] == "stream" and last is not None and last.get("name") == content["name"]:
            last["text"] += content["text"]
            return last
        return super().output(outs, msg, display_id, cell_index)

    def _too_much_output(self) -> str:
        return f"stopped: printed far more than {self.limits.output_bytes >> 10} KiB"

    def _result(self, progress: _Progress, cell: NotebookNode) -> CellRun:
        """The cell's run as told by what stopped it, or else by its reply."""
        if progress.flooding:
            cell.outputs = _shortened(cell.outputs, _KEPT_BYTES)
        self.used += min(progress.streamed, _KEPT_BYTES if progress.flooding else progress.allowed)
        reply = progress.reply or {}
        if progress.stopped is not None:
            return CellRun(*progress.stopped, cell.outputs, doubtful=progress.stopped[0] in ("timeout", "died"))
        if progress.flooding:
            return CellRun("output_limit", self._too_much_output(), cell.outputs)
        if _asks_to_exit(reply):
            self.lost = True
            return CellRun("died", "ended the kernel (exit)", cell.outputs)
        if reply.get("status") == "ok":
            return CellRun("ok", "what it printed beyond the limit was left out" if progress.over else "", cell.outputs)
        name, value = as_text(reply.get("ename")), as_text(reply.get("evalue"))
        message = _one_line(f"{name}: {value}" if value else name) or "the cell was not completed"
        if name not in _OUT_OF_MEMORY:
            return CellRun("error", message, cell.outputs)
        # A kernel that still holds what it filled its memory with has none left for the cells to come.
        self.lost = self.provisioner.watch.memory_now() > self.limits.memory // 2
        return CellRun("memory", message, cell.outputs)


def _asks_to_exit(reply: dict[str, Any]) -> bool:
    """Whether an execute reply carries IPython's request to end the kernel."""
    payload = reply.get("payload")
    return isinstance(payload, list) and any(
        isinstance(entry, dict) and entry.get("source") == "ask_exit" for entry in payload
    )


def _one_line(text: str) -> str:
    """The text on one line, cut to a readable length."""
    line = " ".join(text.split())
    return line if len(line) <= _MESSAGE_CHARACTERS else line[: _MESSAGE_CHARACTERS - 3] + "..."


def _shortened(outputs: Sequence[NotebookNode], limit: int) -> list[NotebookNode]:
    """The first outputs that fit into ``limit`` characters; a stream is cut, anything else left out whole."""
    kept: list[NotebookNode] = []
    for output in outputs:
        if output.output_type == "stream":
            text = output.text[:limit]
            kept.append(nbformat.v4.new_output("stream", name=output.name, text=text))
            limit -= len(text)
        if limit <= 0 or output.output_type != "stream":
            break
    return kept
