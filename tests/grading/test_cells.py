"""Ids of cells, and the record that grading leaves in a notebook: one contract, with a version."""

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook

from autograder.grading import cells
from autograder.grading.cells import CheckRecord, NotebookRecord, check_record, notebook_record, write_record


def test_ids_of_a_question_lead_to_each_other(released):
    assert list(cells.check_cells(released)) == ["scara-T04", "scara-d2_sign", "scara-forward"]
    for check in cells.check_cells(released):
        assert cells.check_id(cells.question_id(check)) == check
        assert cells.check_of_answer(cells.answer_id(check)) == check
        assert cells.answer_id(check) in cells.tracked_cells(released)
    assert cells.question_id("scara_s600-d2-sign") == "scara_s600.d2-sign"
    assert cells.check_of_answer("scara-open") is None


@pytest.mark.parametrize(
    "record",
    [
        NotebookRecord(),
        NotebookRecord("a" * 64, "julia", "cut off", ("one", "two"), "stopped"),
        CheckRecord("right", 1.0),
        CheckRecord("nothing_matched", 0.0, "ValueError", "{}"),
    ],
)
def test_a_record_survives_the_file(record):
    nb = new_notebook(cells=[new_code_cell()])
    node = nb if isinstance(record, NotebookRecord) else nb.cells[0]
    write_record(node, record)
    again = nbformat.reads(nbformat.writes(nb), as_version=4)
    read = notebook_record(again) if isinstance(record, NotebookRecord) else check_record(again.cells[0])
    assert read == record
    assert node.metadata.autograder["version"] == cells.VERSION


def test_records_without_a_version_are_read():
    """As the course's first term wrote them."""
    nb = new_notebook(metadata={"autograder": {"kernel": None, "submission": "ab", "repairs": ["x was missing"]}})
    assert notebook_record(nb) == NotebookRecord("ab", repairs=("x was missing",))
    cell = new_code_cell(metadata={"autograder": {"note": "error", "share": 0, "trouble": "ValueError"}})
    assert check_record(cell) == CheckRecord("error", 0, "ValueError")


@pytest.mark.parametrize("found", [None, [], "x", {}, {"version": 99, "note": "right", "share": 1}, {"note": "right"}])
def test_what_is_no_record_is_none(found):
    assert check_record(new_code_cell(metadata={"autograder": found})) is None


def test_a_record_says_in_words_what_was_wrong():
    assert NotebookRecord(unreadable="cut off", repairs=("a", "b"), trouble="stopped").remarks() == (
        "cut off",
        "stopped",
        "a",
        "b",
    )
