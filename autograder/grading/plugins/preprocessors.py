"""Our parts of nbgrader's conversions, named in nbgrader_config.py.

``nbgrader autograde`` converts twice: first it sanitizes what was handed in (`RestoreCells`), then it grades the
result (`SandboxExecute`, `JudgeAnswers`). ``nbgrader generate_feedback`` converts the graded notebook to a page
(`Summarize`). None of them writes to the gradebook: the converters store what comes out, as a whole.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from contextlib import suppress
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, Literal, cast

from nbformat.notebooknode import NotebookNode
from nbgrader.preprocessors import NbGraderPreprocessor
from traitlets import Enum, Float, Integer, TraitType

from autograder.judge.clusters import is_unexplained, keep
from autograder.sandbox import Limits
from dhkit.public import questions as public_questions

from ..cells import (
    CheckRecord,
    answer_id,
    check_cells,
    check_name,
    check_record,
    counts_for_everybody,
    notebook_record,
    question_id,
    tracked_cells,
    write_record,
)
from ..entries import score
from ..errors import in_words
from ..folders import released_notebook
from ..inert import shown, terminal_text
from ..store import StoredNotebook
from ..submission import trial
from ..submission.elsewhere import MustRun, pack, unpack
from ..submission.execution import Execution, InDoubt, MachineFault, Mode, Work, confirm, execute
from ..submission.judging import verdicts
from ..submission.kept import KeptRun, kept_path
from ..submission.restore import restore

Turn = Literal["first", "alone", "both"]
_TRAITS = {"bytes": Integer, "seconds": Float, "count": Integer}


def _limit_traits() -> dict[str, TraitType]:
    """One configurable trait for each of the sandbox's limits."""
    return {
        limit.name: _TRAITS[limit.metadata["unit"]](limit.default, help=limit.metadata["help"]).tag(config=True)
        for limit in fields(Limits)
    }


class RestoreCells(NbGraderPreprocessor):
    """Sanitizes: the tracked cells and all metadata come from the released notebook."""

    def preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        return restore(nb, released_notebook(Path(resources["autograder"]["released"]))), resources


class SandboxExecute(NbGraderPreprocessor):
    """Runs the notebook in the sandbox; leaves the evidence of each question in the resources.

    Every field of `autograder.sandbox.Limits` can be configured, for example ``c.SandboxExecute.cell_seconds = 60``.
    ``turn`` in the resources says which run it is: the first, the second and last one, for which nobody else's may run
    at the same time, or both, one after the other. Where ``brought`` is in the resources, notebooks run on other machines,
    and it holds what came back, by name of the notebook.
    """

    mode = Enum(("bwrap", "none"), "bwrap", help="Sandbox to run students' code in.").tag(config=True)
    locals().update(_limit_traits())

    @property
    def limits(self) -> Limits:
        """The limits as they are configured; `ValueError` for one that makes no sense."""
        return Limits(**{limit.name: getattr(self, limit.name) for limit in fields(Limits)})

    def run(
        self, nb: NotebookNode, folder: Path, released: Path, student: str, course: Path, warm: bool = True
    ) -> Execution:
        """Run a restored notebook with the files of its folder and of the released one beside it.

        The sandbox does not show the `course`. A `warm` kernel may share its parent with others. What was kept of a
        run of the same is taken in place of another.
        """
        kept = kept_path(course, released.parent.name, student, released.stem)
        mode = cast(Mode, self.mode)
        return execute(nb, (folder, released.parent), student, self.limits, mode, (course,), warm, kept)

    def run_alone(self, nb: NotebookNode, folder: Path, released: Path, student: str, course: Path) -> Execution:
        """Run a notebook for the second and last time, because the first time ended in doubt.

        The caller sees to it that nobody else's runs at the same time; its kernel shares nothing with any other.

        Raises
        ------
        MachineFault
            If the machine is to blame.
        """
        return confirm(
            lambda: self.run(nb, folder, released, student, course, warm=False),
            lambda lasting: self.find_fault([released], course, lasting),
        )

    def find_fault(self, released: Sequence[Path], course: Path, lasting: float | None = None) -> str | None:
        """Say why this machine cannot run what the `released` notebooks need, None if it can (see `trial`)."""
        settings = (released, self.limits, cast(Mode, self.mode), (course,))
        return trial.find_fault_once(*settings) if lasting is None else trial.find_fault(*settings, lasting, warm=False)

    def _run_first(self, nb: NotebookNode, *whose: Any) -> Execution:
        """Run a notebook for the first time; `InDoubt` unless this run counts."""
        try:
            execution = self.run(nb, *whose)
        except Exception as error:
            raise InDoubt(in_words(error)) from error
        if execution.doubt:
            raise InDoubt(execution.doubt)
        return execution

    def _run_both(self, nb: NotebookNode, *whose: Any) -> Execution:
        with suppress(InDoubt):
            return self._run_first(nb, *whose)
        return self.run_alone(nb, *whose)

    def _run_elsewhere(
        self,
        nb: NotebookNode,
        folder: Path,
        released: Path,
        student: str,
        course: Path,
        turn: Turn,
        reply: bytes | None,
    ) -> Execution:
        """Take what came back from another machine; `MustRun` if nothing is there yet."""

        def run(work: Work) -> KeptRun:
            if reply is None:
                raise MustRun(released.stem, pack(work, alone=turn == "alone"))
            return unpack(reply, work)

        kept = kept_path(course, released.parent.name, student, released.stem)
        mode = cast(Mode, self.mode)
        try:
            execution = execute(nb, (folder, released.parent), student, self.limits, mode, kept=kept, run=run)
        except MachineFault as fault:
            raise (InDoubt(str(fault)) if turn == "first" else fault) from None
        if turn == "first" and execution.doubt:
            raise InDoubt(execution.doubt)
        return execution

    def preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        ours = resources["autograder"]
        execution: Execution | None = ours.get("execution")
        if execution is None or execution.fingerprint != notebook_record(nb).submission:
            folder, released, course = (Path(ours[name]) for name in ("folder", "released", "root"))
            whose = (folder, released, resources["nbgrader"]["student"], course)
            if (brought := ours.get("brought")) is not None:
                execution = self._run_elsewhere(nb, *whose, ours["turn"], brought.get(released.stem))
            else:
                run = {"first": self._run_first, "alone": self.run_alone, "both": self._run_both}[ours["turn"]]
                execution = run(nb, *whose)
        for count, index in enumerate(sorted(execution.outputs), 1):
            nb.cells[index].outputs = execution.outputs[index]
            nb.cells[index].execution_count = count
        if execution.message:
            write_record(nb, replace(notebook_record(nb), trouble=terminal_text(execution.message)))
        ours["evidence"], ours["verdicts"] = execution.evidence, execution.verdicts
        return nb, resources


class JudgeAnswers(NbGraderPreprocessor):
    """Replaces what a check cell displayed by feedback and points, and marks it with note and share.

    An answer in which no misconception was found stays in the cell's metadata: the class report shows what it says.
    """

    def preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        ours, student = resources["autograder"], resources["nbgrader"]["student"]
        if ours["verdicts"] is None:
            ours["verdicts"] = verdicts(ours["evidence"], student)
        return super().preprocess(nb, resources)

    def preprocess_cell(self, cell: NotebookNode, resources: dict, index: int) -> tuple[NotebookNode, dict]:
        if (check := check_name(cell)) is None:
            return cell, resources
        evidence, verdict = (resources["autograder"][name][check] for name in ("evidence", "verdicts"))
        share, feedback = verdict.share, verdict.feedback
        if counts_for_everybody(cell):
            share, feedback = 1.0, f"**This question counts fully for everybody.** Of your answer:\n\n{feedback}"
        earned = score(share, float(cell.metadata.nbgrader["points"]))
        cell.outputs = [
            shown({"text/markdown": feedback, "text/plain": feedback}),
            shown({"text/plain": str(earned)}, execution_count=cell.execution_count),
        ]
        trouble = terminal_text(evidence.trouble) if evidence.trouble else None
        answer = keep(question_id(check), evidence.packet) if is_unexplained(verdict.note) else None
        write_record(cell, CheckRecord(verdict.note, share, trouble, answer))
        return cell, resources


class Summarize(NbGraderPreprocessor):
    """Puts what the gradebook holds into a graded notebook, and gathers the table at the top of its feedback page."""

    def preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        stored: StoredNotebook = resources["stored"]
        for name, cell in tracked_cells(nb).items():
            if (found := stored.comments.get(name)) is not None:
                cell.metadata.nbgrader["comment"] = found.text
            if (grade := stored.grades.get(name)) is not None:
                cell.metadata.nbgrader.update(score=grade.score, points=grade.max_score)
        resources["nbgrader"] |= {
            "score": stored.score - stored.penalty, "max_score": stored.max_score, "late_penalty": stored.penalty
        }  # fmt: skip
        resources["autograder"] = {
            "questions": [
                *(_summary(cell, stored) for cell in check_cells(nb).values()),
                *_open_problems(check_cells(nb), stored),
            ],
            "said": (*filter(None, [stored.lateness]), *notebook_record(nb).remarks()),
        }
        return nb, resources


def _summary(check: NotebookNode, stored: StoredNotebook) -> dict:
    marks = check.metadata.nbgrader
    known, record = public_questions().get(question_id(marks["grade_id"])), check_record(check)
    feedback = next(
        (output.data["text/markdown"] for output in check.outputs if output.output_type == "display_data"), ""
    )
    return {
        "grade_id": marks["grade_id"],
        "title": known.title if known else marks["grade_id"],
        "score": marks["score"],
        "points": marks["points"],
        "percent": _percent(marks["score"], marks["points"]),
        "note": record.note if record else "",
        "line": " ".join([*feedback.split(), *_by_hand(stored, marks["grade_id"], answer_id(marks["grade_id"]))]),
    }


def _open_problems(checks: Container[str], stored: StoredNotebook) -> Iterator[dict]:
    """What no program marks, where somebody did."""
    for name, grade in stored.grades.items():
        said = _by_hand(stored, name, name)
        if name not in checks and (grade.score or said):
            yield {
                "grade_id": name, "title": "Open problem" if grade.max_score else "Open problem (bonus)",
                "score": grade.score, "points": grade.max_score, "percent": _percent(grade.score, grade.max_score),
                "note": "", "line": " ".join(said),
            }  # fmt: skip


def _percent(earned: float, most: float) -> int:
    return round(100 * min(1.0, max(0.0, earned / most))) if most else 0


def _by_hand(stored: StoredNotebook, check: str, commented: str) -> list[str]:
    """That points were typed by hand, and what was said with them, as words."""
    grade, found = stored.grades.get(check), stored.comments.get(commented)
    typed = grade is not None and grade.manual is not None and grade.max_score > 0
    return [
        *(["*These points were given by hand.*"] if typed else []),
        *(["**Comment:**", *found.manual.split()] if found and found.manual else []),
    ]
