"""Running a restored notebook: what a student's cells do by accident to the names of the kit costs nothing."""

import pytest
from nbformat.v4 import new_code_cell, new_notebook

from autograder.grading.cells import NotebookRecord, write_record
from autograder.grading.submission.execution import _first_trouble, execute
from autograder.judge import Evidence, judge
from autograder.questions import find
from autograder.sandbox import Limits
from autograder.sandbox.client import CellRun
from autograder.sandbox.run import Run
from dhkit import wire

TAKEN = "check = hint = variant = display = json = print = len = True\ndhkit = wire = 0"


@pytest.mark.slow
@pytest.mark.parametrize("source", [TAKEN, "del check", "import numpy as np\ncheck = np.allclose(1, 1)"])
def test_names_of_the_kit_taken_by_a_student_cost_nothing(small, registry, released, source):
    nb = small.answered(released, d2_sign=f"{source}\nd2_sign = 'B'")
    nb.cells.insert(2, new_code_cell(source))
    write_record(nb, NotebookRecord("stamp"))
    found = execute(nb, [], "ann", Limits(), "none").evidence
    assert all(one.packet is not None for one in found.values()), found
    assert found["scara-forward"].probes[1] is not None


@pytest.mark.parametrize("order", [["T04-answer", "U1", "T04"], ["U1", "T04-answer", "T04"], ["T04", "T04-answer"]])
def test_an_answer_that_raised_is_an_error_wherever_its_cell_stands(order):
    """Not "not attempted", though the check cell that comes last hands in the stub."""
    nb = new_notebook(cells=[new_code_cell("...") for _ in order])
    for cell, name in zip(nb.cells, order, strict=True):
        cell.metadata["nbgrader"] = {"grade_id": f"scara-{name}", "grade": "answer" not in name, "points": 1}
    ran = {i: CellRun("error" if "answer" in name else "ok", "NameError: c1", []) for i, name in enumerate(order)}
    trouble = _first_trouble(nb, order.index("T04"), "scara-T04", Run(ran, {}, None))
    assert trouble is not None
    evidence = Evidence(wire.packet("scara.T04", answer={"blank": True}), None, trouble.message, trouble.status)
    assert judge(find("scara.T04"), evidence, "ada").note == "error"
