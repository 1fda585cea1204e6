"""What came out of the sandbox is judged again without running anything, as long as the same would be run."""

import dataclasses
import json

import pytest

from autograder import questions
from autograder.grading.cells import NotebookRecord, check_cells, write_record
from autograder.grading.submission import execution, kept
from autograder.grading.submission.execution import execute
from autograder.sandbox import Limits
from autograder.sandbox.client import CellRun
from autograder.sandbox.run import Run
from dhkit import wire

FUNCTION = {"function": True}


@pytest.fixture
def ran(monkeypatch):
    """Stands in for the sandbox; lists the sources of what was run."""
    runs = []

    def fake(nb, *, followup, **options):
        runs.append([cell.source for cell in nb.cells])
        found = Run(message="something was said")
        for index, cell in enumerate(nb.cells):
            if cell.cell_type != "code":
                continue
            outputs = [{"output_type": "stream", "name": "stdout", "text": f"cell {index}"}]
            name = cell.metadata.get("nbgrader", {}).get("grade_id", "")
            if name == "scara-forward":
                outputs.append(display(wire.packet("scara.forward", answer=FUNCTION)))
            found.cells[index] = CellRun("error" if name == "scara-T04" else "ok", "NameError: x", outputs)
            if followup(index, cell, outputs):
                found.followups[index] = [display({"results": [index]})]
        return found

    monkeypatch.setattr(execution, "run_notebook", fake)
    return runs


def display(packet):
    return {"output_type": "display_data", "data": {execution.MIME: packet}, "metadata": {}}


@pytest.fixture
def again(small, registry, released, ran, tmp_path):
    """again(...) -> what execution of one submission brings, and whether it was run for that."""
    work = tmp_path / "work"
    work.mkdir()
    (work / "data.csv").write_text("1, 2")

    def run(stamp="stamp", limits=Limits(), student="ann", **answers):
        nb = small.answered(released, **answers)
        write_record(nb, NotebookRecord(stamp))
        before = len(ran)
        found = execute(nb, [work], student, limits, "none", kept=tmp_path / "kept.json")
        return found, len(ran) > before

    return run


def test_the_same_is_not_run_again(again):
    first, was_run = again()
    second, was_run_again = again(stamp="other points")
    assert was_run and not was_run_again
    assert second == dataclasses.replace(first, fingerprint="other points")
    sent, results = first.evidence["scara-forward"].probes
    assert sent and list(results) == ["results"] and first.evidence["scara-T04"].status == "error"


def test_what_another_run_could_change_is_run_again(again, tmp_path, monkeypatch):
    assert again()[1]
    assert again(limits=Limits(cell_seconds=31))[1]
    assert again(limits=Limits(cell_seconds=31), d2_sign="d2_sign = 'A'")[1]
    assert again()[1]
    (tmp_path / "work" / "data.csv").write_text("1, 3")
    assert again()[1] and not again()[1]
    monkeypatch.setattr(kept, "_software", lambda times: "a newer kit")
    assert again()[1] and not again()[1]


def test_other_inputs_of_a_function_need_another_run(again, monkeypatch):
    assert again()[1]
    question = questions.find("scara.forward")
    probes = type(question).probes
    monkeypatch.setattr(type(question), "probes", lambda self, *whose: probes(self, *whose)[1:])
    assert again()[1] and not again()[1]


@pytest.mark.parametrize("content", [b"", b"[]", b"{}", b'{"key": 1}', b"[" * 100_000, b"\xff"])
def test_a_file_that_is_damaged_is_no_run(again, tmp_path, content):
    assert again()[1]
    path = tmp_path / "kept.json"
    whole = path.read_bytes()
    path.write_bytes(content)
    assert again()[1] and path.read_bytes() == whole
    path.write_bytes(whole[:-20])
    assert again()[1] and not again()[1]
    broken = json.loads(whole) | {"cells": {"x": 1}}
    path.write_text(json.dumps(broken))
    assert again()[1]


def test_a_run_in_doubt_is_not_kept(again, monkeypatch, tmp_path):
    fake = execution.run_notebook

    def died(*arguments, **options):
        found = fake(*arguments, **options)
        found.cells[max(found.cells)] = CellRun("died", "the kernel ended", [], doubtful=True)
        return found

    monkeypatch.setattr(execution, "run_notebook", died)
    assert again()[0].doubt and not (tmp_path / "kept.json").exists()
    assert again()[1]


def test_where_nothing_can_be_kept_grading_goes_on(again, monkeypatch):
    monkeypatch.setattr(kept, "write_whole", lambda path, content: path.read_bytes())
    assert again()[1] and again()[1]


def test_only_what_is_run_counts(small, registry, released):
    nb = small.answered(released)
    work = kept.digest_of_work(nb, {})
    for cell in nb.cells:
        if cell.cell_type == "markdown":
            cell.source += " (2 points)"
    for cell in check_cells(nb).values():
        cell.metadata.nbgrader["points"] = 17
    assert kept.digest_of_work(nb, {}) == work != kept.digest_of_work(nb, {"a": b""})
