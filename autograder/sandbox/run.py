"""Runs a whole notebook so that a bad cell costs no more than its own question."""

from __future__ import annotations

import asyncio
import concurrent.futures
import copy
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import nbformat
from nbformat import NotebookNode

from .bubblewrap import SandboxUnavailable, available
from .client import CellRun, SandboxClient
from .clock import Spent
from .limits import Limits

_MAX_RESTARTS = 2
_HARMLESS = ("ok", "error", "memory")

_FIGURE = "application/vnd.autograder.figure+json"  # of a figure that waits in the kernel: its number there

_RUNNING: set[asyncio.Task[Run]] = set()

Followup = Callable[[int, NotebookNode, list[NotebookNode]], str | None]


@dataclass
class Run:
    """What happened in a notebook.

    Attributes
    ----------
    cells : dict of int to CellRun
        Each code cell, by its index.
    followups : dict of int to list of NotebookNode
        Outputs of the code that was run after a cell, by the index of the cell.
    message : str or None
        What went wrong with the notebook as a whole.
    starved : bool
        Whether the machine let it run so little that nothing can be said about it.
    lived : float
        For how many seconds the longest-lived of the kernels lived that ended for no reason that is known.
    """

    cells: dict[int, CellRun] = field(default_factory=dict)
    followups: dict[int, list[NotebookNode]] = field(default_factory=dict)
    message: str | None = None
    starved: bool = False
    lived: float = 0.0

    @property
    def doubt(self) -> str | None:
        """Why it should run once more, with nothing beside it, before it costs anybody a point."""
        return next((cell.message for cell in self.cells.values() if cell.doubtful), None)


Looked = Callable[[Run], Collection[int]]


@dataclass
class _Session:
    """One notebook on its way: the kernel it has now, what it may still use, and the figures that wait, by cell."""

    nb: NotebookNode
    limits: Limits
    options: dict[str, Any]
    run: Run = field(default_factory=Run)
    client: SandboxClient | None = None
    starts: int = 0
    used: int = 0
    spent: Spent = field(default_factory=Spent)
    harmful: set[int] = field(default_factory=set)
    figures: dict[int, list[int]] = field(default_factory=dict)

    async def start(self) -> None:
        self.figures = {}
        self.client = SandboxClient(self.nb, self.limits, self.options, self.used, self.spent)
        self.starts += 1
        await self.client.start()

    def stop(self) -> None:
        if self.client is not None:
            self.used, self.spent = self.client.used, self.client.spent
            self.client.close()
            self.client = None

    @property
    def kernel(self) -> SandboxClient:
        """The client of the kernel that runs."""
        assert self.client is not None
        return self.client

    async def execute(self, source: str) -> CellRun:
        """Run code in the present kernel, with its outputs in a cell of its own at the notebook's end."""
        cell = nbformat.v4.new_code_cell(source)
        self.nb.cells.append(cell)
        result = await self.kernel.run_code(source, cell, len(self.nb.cells) - 1)
        if result.status == "died" and result.doubtful:
            self.run.lived = max(self.run.lived, self.kernel.provisioner.watch.spent().wall)
        if (up := self.kernel.time_up) is not None:
            self.run.message = self.run.message or up.of_notebook
            self.run.starved |= up.starved
        return result

    def did_harm(self, result: CellRun) -> bool:
        return self.kernel.lost or result.status not in _HARMLESS

    async def replay(self) -> None:
        """Bring a fresh kernel to the state after the cells run so far, without those that did harm."""
        for earlier in sorted(self.run.cells.keys() - self.harmful):
            result = await self.execute(self.nb.cells[earlier].source)
            self.figures[earlier] = _numbers(result.outputs)
            if self.did_harm(result):
                self.harmful.add(earlier)
            self.kernel.used = self.used
            if self.kernel.lost or self.run.message is not None:
                return

    async def draw(self, index: int) -> None:
        """Put the pictures of a cell's figures into its outputs, as far as they are to be had."""
        outputs, numbers = self.run.cells[index].outputs, self.figures.get(index, [])
        shown = _numbers(outputs)
        if not numbers or len(numbers) != len(shown):
            return
        cell = nbformat.v4.new_code_cell(f"get_ipython().draw_figures(*{numbers})")
        self.nb.cells.append(cell)
        drawn = (await self.kernel.run_code(cell.source, cell, len(self.nb.cells) - 1)).outputs
        pictures = {_number(output): output for output in drawn if "image/png" in output.get("data", {})}
        in_place: dict[int | None, NotebookNode] = {
            old: pictures[new] for old, new in zip(shown, numbers) if new in pictures
        }
        self.run.cells[index].outputs = [in_place.get(_number(output), output) for output in outputs]


def _number(output: NotebookNode) -> int | None:
    """The number of the figure that an output stands for, None if it is none."""
    number = output.get("data", {}).get(_FIGURE)
    return number if type(number) is int and 0 <= number < 1000 else None


def _numbers(outputs: list[NotebookNode]) -> list[int]:
    return [number for output in outputs if (number := _number(output)) is not None]


async def _run_cells(session: _Session, followup: Followup | None, looked: Looked | None) -> None:
    """Run every code cell of the session's notebook, in a new kernel where the old one was lost."""
    code_cells = [index for index, cell in enumerate(session.nb.cells) if cell.cell_type == "code"]
    run = session.run
    for index in code_cells:
        source = session.nb.cells[index].source
        if not source.strip():
            run.cells[index] = CellRun("ok")
            continue
        while run.message is None and (session.client is None or session.client.lost):
            session.stop()
            if session.starts > _MAX_RESTARTS:
                run.message = f"the kernel was lost {session.starts} times, the rest of the notebook was not run"
                break
            await session.start()
            await session.replay()
        if run.message is not None:
            run.cells[index] = CellRun("not_run", run.message)
            continue
        result = run.cells[index] = await session.execute(source)
        session.figures[index] = _numbers(result.outputs)
        if session.did_harm(result):
            session.harmful.add(index)
        code = followup(index, session.nb.cells[index], result.outputs) if followup is not None else None
        if code is not None and not session.kernel.lost:
            probed = await session.execute(code)
            run.followups[index] = probed.outputs
            if probed.status != "ok" and result.status == "ok":
                result.status, result.doubtful = probed.status, probed.doubtful
                result.message = f"{probed.message} (with the grader's inputs)"
    for index in sorted(code_cells if looked is None else looked(run)):
        if session.client is None or session.client.lost:
            return
        await session.draw(index)


async def _run_session(session: _Session, followup: Followup | None, looked: Looked | None) -> Run:
    task = asyncio.current_task()
    assert task is not None
    _RUNNING.add(task)
    try:
        await _run_cells(session, followup, looked)
    finally:
        session.stop()
        _RUNNING.discard(task)
    return session.run


def run_notebook(
    nb: NotebookNode,
    *,
    files: Mapping[str, bytes] = MappingProxyType({}),
    limits: Limits = Limits(),
    mode: Literal["bwrap", "none"] = "bwrap",
    followup: Followup | None = None,
    looked: Looked | None = None,
    hidden: tuple[Path, ...] = (),
    warm: bool = True,
) -> Run:
    """Run a notebook in a sandbox and return what came of each code cell; the notebook itself is not changed.

    Works from any thread, also from several at a time.

    Parameters
    ----------
    nb : NotebookNode
    files : mapping of str to bytes
        Contents of the kernel's private work folder, by names below it.
    limits : Limits
    mode : str
        "none" runs an ordinary local kernel: the bounds on time and output hold, nothing else does.
    followup : callable, optional
        ``followup(index, cell, outputs)`` is called here, in the trusted process, after each cell. Code that it
        returns is run in the same kernel under the same limits; its outputs are kept apart, and trouble in it becomes
        the status of its cell.
    looked : callable, optional
        ``looked(run)`` is called here at the end and says which cells' figures somebody will look at: these are drawn,
        of the others only words are left. Without it, all are. Figures of a kernel that was lost are not drawn.
    hidden : tuple of Path
        Further folders that a kernel must not see.
    warm : bool
        Whether a kernel may be the child of a warm parent, see `warm`; where there can be none it starts cold anyhow.

    Raises
    ------
    SandboxUnavailable
        If there is no sandbox to be had.
    KernelStartError
        If a kernel does not start in it.
    """
    if mode not in ("bwrap", "none"):
        raise ValueError(f"unknown mode {mode!r}: 'bwrap' or 'none'")
    reason = available() if mode == "bwrap" else None
    if reason is not None:
        raise SandboxUnavailable(reason)
    options = {
        "files": dict(files),
        "sandboxed": mode == "bwrap",
        "hidden": [str(folder) for folder in hidden],
        "warm": warm,
    }
    session = _Session(copy.deepcopy(nb), limits, options)
    if not _loop_is_running():
        return asyncio.run(_run_session(session, followup, looked))
    with concurrent.futures.ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, _run_session(session, followup, looked)).result()


def _loop_is_running() -> bool:
    """Whether this thread is inside an event loop already, as in formgrader's server."""
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return False
    return True


def cancel_runs() -> None:
    """End every ``run_notebook`` under way in other threads: each kills its kernel and raises CancelledError.

    For the main thread's ``except KeyboardInterrupt``, because an interrupt
    reaches no other thread.
    """
    for task in tuple(_RUNNING):
        task.get_loop().call_soon_threadsafe(task.cancel)
