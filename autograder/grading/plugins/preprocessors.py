"""Our parts of nbgrader's conversions, named in nbgrader_config.py.

``nbgrader autograde`` converts twice: first it sanitizes what was handed in (`RestoreCells`), then it grades the
result (`SandboxExecute`, `JudgeAnswers`, nbgrader's own SaveAutoGrades, `SaveNotes`). ``nbgrader
generate_feedback`` converts the graded notebook to a page (`Summarize`).
"""

from __future__ import annotations

from pathlib import Path

import nbformat
from nbformat.notebooknode import NotebookNode
from nbformat.v4 import new_output
from nbgrader.api import Gradebook
from nbgrader.preprocessors import GetGrades, NbGraderPreprocessor
from traitlets import Enum, Float, Integer

from autograder import questions
from autograder.judge import Variant, is_forgivable, judge
from autograder.judge.clusters import is_unexplained, keep
from autograder.sandbox import Limits
from dhkit.public import questions as public_questions

from ..entries import comment, points
from ..inert import terminal_text
from ..submission.execution import Execution, execute
from ..submission.restore import answer_id, grade_id, is_check, question_id, restore

_LIMITS = Limits()


class RestoreCells(NbGraderPreprocessor):
    """Sanitizes: the tracked cells and all metadata come from the released notebook."""

    def preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        released = nbformat.read(resources["autograder"]["released"], as_version=4)
        return restore(nb, released), resources


class SandboxExecute(NbGraderPreprocessor):
    """Runs the notebook in the sandbox; leaves the evidence of each question in the resources."""

    mode = Enum(("bwrap", "none"), "bwrap", help="Sandbox to run students' code in.").tag(config=True)
    memory = Integer(_LIMITS.memory, help="Bytes of memory for the whole sandbox.").tag(config=True)
    processes = Integer(_LIMITS.processes, help="Processes and threads.").tag(config=True)
    file_size = Integer(_LIMITS.file_size, help="Bytes a file may grow to.").tag(config=True)
    cell_seconds = Float(_LIMITS.cell_seconds, help="Seconds for one cell.").tag(config=True)
    notebook_seconds = Float(_LIMITS.notebook_seconds, help="Seconds for one notebook.").tag(config=True)
    output_bytes = Integer(_LIMITS.output_bytes, help="Bytes of output of one notebook.").tag(config=True)

    @property
    def limits(self) -> Limits:
        names = ("memory", "processes", "file_size", "cell_seconds", "notebook_seconds", "output_bytes")
        return Limits(**{name: getattr(self, name) for name in names})

    def preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        ours = resources["autograder"]
        execution: Execution | None = ours.get("execution")
        if execution is None or execution.fingerprint != nb.metadata.autograder.get("submission"):
            folders = [Path(ours["folder"]), Path(ours["released"]).parent]
            student, hidden = resources["nbgrader"]["student"], (Path(ours["root"]),)
            execution = execute(nb, folders, student, self.limits, self.mode, hidden)
        for count, index in enumerate(sorted(execution.outputs), 1):
            nb.cells[index].outputs = execution.outputs[index]
            nb.cells[index].execution_count = count
        if execution.message:
            nb.metadata.autograder["trouble"] = terminal_text(execution.message)
        ours["evidence"] = execution.evidence
        return nb, resources


class JudgeAnswers(NbGraderPreprocessor):
    """Replaces what a check cell displayed by feedback and points, and marks it with note and share.

    An answer in which no misconception was found stays in the cell's metadata: the class report shows what it says.
    """

    def preprocess_cell(self, cell: NotebookNode, resources: dict, index: int) -> tuple[NotebookNode, dict]:
        if not is_check(cell):
            return cell, resources
        evidence = resources["autograder"]["evidence"][grade_id(cell)]
        question = questions.find(question_id(grade_id(cell)))
        earlier = resources["autograder"].setdefault("forgivable", {})
        verdict = judge(question, evidence, Variant(resources["nbgrader"]["student"]), earlier)
        if is_forgivable(verdict):
            earlier[question.id] = evidence
        earned = points(verdict.share, float(cell.metadata.nbgrader["points"]))
        cell.outputs = [
            new_output("display_data", data={"text/markdown": verdict.feedback, "text/plain": verdict.feedback}),
            new_output("execute_result", data={"text/plain": str(earned)}, execution_count=cell.execution_count),
        ]
        cell.metadata["autograder"] = {"note": verdict.note, "share": verdict.share}
        if evidence.trouble:
            cell.metadata["autograder"]["trouble"] = terminal_text(evidence.trouble)
        if is_unexplained(verdict.note) and (answer := keep(question.id, evidence.packet)):
            cell.metadata["autograder"]["answer"] = answer
        return cell, resources


class SaveNotes(NbGraderPreprocessor):
    """Stores each answer note as the automatic comment of its answer cell, where formgrader shows it."""

    def preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        names = resources["nbgrader"]
        answers = {grade_id(cell) for cell in nb.cells}
        with Gradebook(names["db_url"]) as gradebook:
            for check in filter(is_check, nb.cells):
                answer = answer_id(grade_id(check))
                if answer in answers:
                    found = gradebook.find_comment(answer, names["notebook"], names["assignment"], names["student"])
                    found.auto_comment = comment(check.metadata.autograder["note"])
            gradebook.db.commit()
        return nb, resources


class Summarize(GetGrades):
    """nbgrader's GetGrades, which also gathers the table at the top of a feedback page."""

    def preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        nb, resources = super().preprocess(nb, resources)
        ours = nb.metadata.get("autograder", {})
        resources["autograder"] = {
            "questions": [_summary(cell) for cell in filter(is_check, nb.cells)],
            "said": [ours[key] for key in ("unreadable", "trouble") if ours.get(key)] + list(ours.get("repairs", ())),
        }
        return nb, resources


def _summary(check: NotebookNode) -> dict:
    marks = check.metadata.nbgrader
    known = public_questions().get(question_id(marks["grade_id"]))
    feedback = next(
        (output.data["text/markdown"] for output in check.outputs if output.output_type == "display_data"), ""
    )
    return {
        "grade_id": marks["grade_id"],
        "title": known.title if known else marks["grade_id"],
        "score": marks["score"],
        "points": marks["points"],
        "note": check.metadata.get("autograder", {}).get("note", ""),
        "line": " ".join(feedback.split()),
    }
