"""Which pictures of a notebook somebody will look at."""

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder import cli
from autograder.grading.submission.judging import cells_looked_at

PLOT = "import matplotlib.pyplot as plt\nplt.plot([1, 2]);"


def check(name):
    marks = {"grade": True, "grade_id": name, "points": 2, "solution": False, "locked": True, "schema_version": 3}
    return new_code_cell("check()", metadata={"nbgrader": marks})


@pytest.fixture
def nb():
    cells = [
        new_markdown_cell("# Title"),
        new_code_cell("draw()"),
        check("scara-T04"),
        new_markdown_cell("next"),
        new_code_cell("answer"),
        new_code_cell("show(answer)"),
        check("scara-table"),
        new_code_cell("plt.plot()"),
    ]
    return new_notebook(cells=cells)


@pytest.mark.parametrize(
    "right, looked",
    [
        (["scara-T04", "scara-table"], {7}),
        (["scara-T04"], {4, 5, 6, 7}),
        (["scara-table"], {1, 2, 7}),
        ([], {1, 2, 4, 5, 6, 7}),
    ],
)
def test_the_cells_of_what_is_not_right_and_what_a_lecturer_marks(nb, right, looked):
    assert cells_looked_at(nb, right) == looked


@pytest.mark.slow
@pytest.mark.sandbox
def test_a_page_shows_pictures_where_something_is_to_be_mended(small, course_copy, released, needs_sandbox):
    answers = {"T04": f"{small.T04}\n{PLOT}", "d2_sign": f"d2_sign = 'A'\n{PLOT}"}
    small.hand_in(course_copy, "ann", small.answered(released, **answers))
    assert cli.main(["grade", "scara", "--jobs", "1", "--course", str(course_copy)]) == 0
    graded = nbformat.read(course_copy / "autograded" / "ann" / "scara" / "scara.ipynb", 4)
    shown = {
        cell.metadata.nbgrader.grade_id: [output.data for output in cell.outputs if "data" in output]
        for cell in graded.cells
        if cell.cell_type == "code" and "nbgrader" in cell.metadata
    }
    assert "image/png" in shown["scara-d2_sign-answer"][0]
    assert "not drawn here" in shown["scara-T04-answer"][0]["text/plain"]
    page = (course_copy / "feedback" / "ann" / "scara" / "scara.html").read_text()
    assert page.count("<img") == 1 and page.count("not drawn here") == 1
