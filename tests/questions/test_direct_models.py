"""What the trees of the direct models rest on: the marks of the wrong cells, compared with the matrices of the notebook."""

import json
from pathlib import Path

import numpy as np
import sympy

from autograder.questions import direct_models
from autograder.reference import errata, robots

NOTEBOOK = Path(__file__).parents[2] / "solutions/direct_models/direct_models.ipynb"
SOMEWHERE = {"t4": 0.3, "t5": 0.7, "t6": 1.1, "d3": 0.4, "a3": 0.5}


def printed():
    """The three matrices as the notebook shows them."""
    cells = json.loads(NOTEBOOK.read_text())["cells"]
    source = "".join(next(cell["source"] for cell in cells if cell["id"] == "printed"))
    names = {"Matrix": sympy.Matrix, "cos": sympy.cos, "sin": sympy.sin, "d3": sympy.Symbol("d3")}
    names |= {f"t{i}": sympy.Symbol(f"t{i}") for i in range(1, 7)}
    exec(source.partition("show_marks")[0], names)
    return list(names["printed"].values())


def test_marked_cells_are_those_that_differ_from_the_table():
    *_, U3, U4, U5, _ = robots.RX90.table.recursion()
    for matrix, right, marks in zip(
        printed(), (U5, U4, U3), (direct_models.WRONG_T56, direct_models.WRONG_U4, direct_models.WRONG_U3)
    ):
        gap = np.array((matrix - right).subs(SOMEWHERE), dtype=float)
        assert (np.abs(gap) > 1e-9).astype(int).tolist() == marks


def test_the_notebook_prints_what_the_errata_say_is_printed():
    T56, U4, U3 = printed()
    assert errata.find("000-rx90-T56").check.readings[0].form == T56
    assert errata.find("000-rx90-U4").check.readings[0].form == U4[2, 0]
    assert errata.find("000-rx90-U3").check.readings[0].form == (U3[0, 0], U3[0, 1], U3[2, 0], U3[2, 1])
