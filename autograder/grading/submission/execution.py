"""Runs a restored notebook in the sandbox and gathers, for every question, what the judge needs to know."""

from __future__ import annotations

import copy
import hashlib
import importlib.util
import json
import re
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Literal

from nbformat.notebooknode import NotebookNode

from autograder import questions
from autograder.judge import MIME, Evidence, Verdict
from autograder.sandbox import CellRun, Limits, Run, read_folders, run_notebook
from dhkit.home.envelopes import SUFFIX

from ..cells import answer_id, check_cells, check_name, grade_id, is_check, notebook_record, question_id
from ..errors import CourseError
from ..inert import inert_outputs
from .judging import cells_looked_at, verdicts
from .kept import KeptRun, conditions, digest_of_work, keep, read_kept

Mode = Literal["bwrap", "none"]
_NAMES_SHOWN = 5


class MachineFault(CourseError):
    """A submission cannot be graded on this machine now; the message says why, and what to do."""


class InDoubt(Exception):
    """A first run for whose end the machine may be to blame: it does not count, the notebook runs once more, alone."""


@dataclass(frozen=True)
class Execution:
    """What one run of one submission left behind.

    Attributes
    ----------
    fingerprint : str
        Which submission it was (see `reading.fingerprint`).
    outputs : dict of int to list
        Inert outputs of each code cell, by its index in the restored notebook.
    evidence : dict of str to Evidence
        By the grade id of the check cell.
    message : str or None
        What went wrong with the run as a whole.
    doubt : str or None
        Why the machine may be to blame for what went wrong.
    starved : bool
        Whether the machine let it run so little that nothing can be said about it.
    lived : float
        For how many seconds the longest-lived of the kernels lived that ended for no reason that is known.
    verdicts : dict of str to Verdict or None
        By the grade id of the check cell, if it was judged while it ran.
    """

    fingerprint: str
    outputs: dict[int, list]
    evidence: dict[str, Evidence]
    message: str | None = None
    doubt: str | None = None
    starved: bool = False
    lived: float = 0.0
    verdicts: dict[str, Verdict] | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Work:
    """What has to be run of one submission, with all that is needed for it.

    Attributes
    ----------
    nb : NotebookNode
        The restored notebook, with the kit imported in its check cells.
    files : dict of str to bytes
        Contents of the files beside it, by name.
    student : str
    limits : Limits
    mode : str
        ``"bwrap"`` or ``"none"``.
    """

    nb: NotebookNode
    files: dict[str, bytes]
    student: str
    limits: Limits
    mode: Mode

    @cached_property
    def digest(self) -> str:
        """Says what is run."""
        return digest_of_work(self.nb, self.files)

    @property
    def key(self) -> str:
        """Says what is run, and with what on this machine."""
        return f"{self.digest} {conditions(self.limits, self.mode)}"

    def run(self, hidden: tuple[Path, ...] = (), warm: bool = True) -> KeptRun:
        """Run it here, in a sandbox that does not show the `hidden` folders; `warm` as in `run_notebook`."""
        sent: dict[int, list] = {}

        def probe(index: int, cell: NotebookNode, outputs: list) -> str | None:
            check = check_name(cell)
            arguments = _arguments(check, self.student, self.digest, outputs) if check else None
            if check is None or arguments is None:
                return None
            sent[index] = arguments
            call = f"answer_probes({question_id(check)!r}, {json.dumps(arguments)!r})"
            return f"from dhkit.check import answer_probes\n{call}"

        judged: dict[str, Verdict] | None = None

        def looked(run: Run) -> set[int]:
            nonlocal judged
            with suppress(Exception):  # whoever judges later fails in the same way, and says so
                judged = verdicts(evidence_of(self.nb, KeptRun(run, sent)), self.student)
            right = {check for check, verdict in (judged or {}).items() if verdict.share == 1}
            return cells_looked_at(self.nb, right) & run.cells.keys()

        run = run_notebook(
            self.nb,
            files=self.files,
            limits=self.limits,
            mode=self.mode,
            followup=probe,
            looked=looked,
            hidden=hidden,
            warm=warm,
        )
        return KeptRun(run, sent, judged)

    def fits(self, found: KeptRun) -> bool:
        """Whether the functions that a run handed in were called with what they would be called with now."""
        return found.sent == _probes(self.nb, self.student, self.digest, found.run)


def execute(
    nb: NotebookNode,
    folders: Iterable[Path],
    student: str,
    limits: Limits,
    mode: Mode,
    hidden: tuple[Path, ...] = (),
    warm: bool = True,
    kept: Path | None = None,
    run: Callable[[Work], KeptRun] | None = None,
) -> Execution:
    """Run the restored notebook `nb` of `student`, or take what was kept of a run of the same.

    Parameters
    ----------
    folders : iterable of Path
        Where the notebook's own files come from; a later folder overrides an earlier one.
    mode : str
        ``"bwrap"`` or ``"none"``.
    hidden : tuple of Path
        Folders of the host that the sandbox must not show, the course's own above all.
    warm : bool
        Whether its kernel may share a parent with others.
    kept : Path, optional
        The file in which a run is kept that nobody doubts (see `kept`).
    run : callable, optional
        Runs it, in place of `Work.run` here.

    Raises
    ------
    autograder.sandbox.SandboxUnavailable
        If the sandbox cannot be had.
    """
    record = notebook_record(nb)
    if reason := record.unreadable:
        unread = {name: Evidence(None, None, reason, "unreadable") for name in check_cells(nb)}
        return Execution(record.submission, {}, unread)
    folders = list(folders)
    files, left_out = read_folders(folders, limits.disk // 2)
    # Opening a verdict sealed for home is slow on purpose, and here the judge has the word.
    files = {name: content for name, content in files.items() if not name.endswith(SUFFIX)}
    work = Work(_with_kit(nb), files, student, limits, mode)
    if kept is not None and (found := read_kept(kept, work.key)) is not None and work.fits(found):
        return execution_of(nb, found, left_out)
    found = run(work) if run is not None else work.run((*hidden, *folders), warm)
    execution = execution_of(nb, found, left_out)
    if kept is not None and execution.doubt is None:
        keep(kept, work.key, found)
    return execution


def execution_of(nb: NotebookNode, found: KeptRun, left_out: Sequence[str] = ()) -> Execution:
    """What a run of the restored notebook says of each question."""
    run = found.run
    counts = {index: count for count, index in enumerate(sorted(run.cells), 1)}
    outputs = {index: inert_outputs(cell.outputs, counts[index]) for index, cell in run.cells.items()}
    message = run.message or _left_out(left_out)
    doubt = run.doubt or next((cell.message for cell in run.cells.values() if _missed_import(cell)), None)
    submission = notebook_record(nb).submission
    evidence = evidence_of(nb, found)
    return Execution(submission, outputs, evidence, message, doubt, run.starved, run.lived, found.verdicts)


def evidence_of(nb: NotebookNode, found: KeptRun) -> dict[str, Evidence]:
    """What the judge needs to know, by the grade id of the check cell."""
    checks = {index: name for index in found.run.cells if (name := check_name(nb.cells[index]))}
    return {name: _evidence(nb, index, name, found.run, found.sent) for index, name in checks.items()}


def _probes(nb: NotebookNode, student: str, work: str, run: Run) -> dict[int, list]:
    """What would be asked now of the functions that a run handed in."""
    asked = {
        index: _arguments(check, student, work, cell.outputs)
        for index, cell in run.cells.items()
        if (check := check_name(nb.cells[index]))
    }
    # What was kept went through JSON.
    return {index: json.loads(json.dumps(arguments)) for index, arguments in asked.items() if arguments is not None}


def confirm(again: Callable[[], Execution], find_fault: Callable[[float], str | None]) -> Execution:
    """Run a notebook once more whose first run ended in doubt; only this run counts.

    Parameters
    ----------
    again : callable
        Runs it, with no other student's notebook beside it.
    find_fault : callable
        Says what is wrong with the machine, if anything is, with a trial that lasts so many seconds (see `trial`).

    Raises
    ------
    MachineFault
        If it was the machine. A student cannot bring that about: what ends his kernel ends no trial.
    """
    try:
        execution = again()
    except Exception as error:
        raise MachineFault(f"it could not be run, not even alone ({error}); grade again") from error
    if execution.starved:
        raise MachineFault(f"{execution.message}; grade again when the machine is less busy")
    if execution.doubt and (fault := find_fault(execution.lived)):
        raise MachineFault(f"{fault}; then grade again")
    return execution


def _with_kit(nb: NotebookNode) -> NotebookNode:
    """The notebook with `check` imported afresh in each check cell: a cell of the student's may have taken its name."""
    ready = copy.deepcopy(nb)
    for cell in check_cells(ready).values():
        cell.source = f"from dhkit import check\n{cell.source}"
    return ready


def _left_out(names: Sequence[str]) -> str | None:
    if not names:
        return None
    return f"{len(names)} files too large for the work folder were left out: {', '.join(names[:_NAMES_SHOWN])}"


def _missed_import(cell: CellRun) -> bool:
    """Whether a cell could not import what this environment seems to hold."""
    missing = re.match(r"ModuleNotFoundError: No module named '(\w+)", cell.message)
    known = missing is None or importlib.util.find_spec(missing[1]) is not None
    return cell.status == "error" and cell.message.startswith(("ModuleNotFoundError", "ImportError")) and known


def _arguments(check: str, student: str, work: str, outputs: list) -> list | None:
    """Arguments to try a student's function with, None if the check cell handed in no function."""
    packet = last_packet(outputs)
    answer = packet.get("answer") if isinstance(packet, dict) else None
    if not isinstance(answer, dict) or "function" not in answer:
        return None
    question = questions.find(question_id(check))
    # The seed follows from what was handed in: grading it again, here or with nbgrader, asks the same things.
    seed = int.from_bytes(hashlib.sha256(f"{work} {question.id}".encode()).digest()[:8])
    return question.probes(student, seed)


def _evidence(nb: NotebookNode, index: int, check: str, run: Run, sent: dict[int, list]) -> Evidence:
    trouble = _first_trouble(nb, index, check, run)
    probes = (sent[index], last_packet(run.followups.get(index, []))) if index in sent else None
    packet = last_packet(run.cells[index].outputs)
    return Evidence(packet, probes, trouble.message, trouble.status) if trouble else Evidence(packet, probes)


def _first_trouble(nb: NotebookNode, index: int, check: str, run: Run) -> CellRun | None:
    """The first cell of a question that did not end well: an answer that looped explains a check without a name.

    The answer's own cell belongs to it wherever the student has moved it.
    """
    start = index
    while start > 0 and grade_id(nb.cells[start]) != answer_id(check):
        start -= 1
        if is_check(nb.cells[start]):
            start = index
            break
    answers = [i for i, cell in enumerate(nb.cells) if grade_id(cell) == answer_id(check)]
    question = [run.cells[i] for i in sorted({*answers, *range(start, index + 1)}) if i in run.cells]
    return next((cell for cell in question if cell.status != "ok"), None)


def last_packet(outputs: list) -> object | None:
    """The JSON value displayed last under `MIME`."""
    for output in reversed(outputs):
        data = output.get("data")
        if isinstance(data, dict) and MIME in data:
            return data[MIME]
    return None
