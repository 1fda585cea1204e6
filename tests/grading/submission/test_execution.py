"""Running a restored notebook: what a student's cells do by accident to the names of the kit costs nothing."""

import pytest
from nbformat.v4 import new_code_cell

from autograder.grading.cells import NotebookRecord, write_record
from autograder.grading.submission.execution import execute
from autograder.sandbox import Limits

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
