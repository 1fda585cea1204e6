"""The notebooks as files: clean, stable, and asking every question exactly once in the exact form."""

import re
from pathlib import Path

import nbformat
import pytest
from nbgrader.preprocessors import ClearSolutions
from traitlets.config import Config

from autograder.grading.bundle import FOR_LECTURERS
from dhkit.public import questions

ROOT = Path(__file__).parents[2]
LECTURES = sorted((ROOT / "course").glob("*.ipynb"))
SOLUTIONS = sorted((ROOT / "solutions").glob("*/*.ipynb"))
STUB = "# your code here"


def name(path):
    return str(path.relative_to(ROOT))


def read(path):
    return nbformat.read(path, as_version=4)


def nbgrader(cell) -> dict:
    return cell.metadata.get("nbgrader", {})


def checks(notebook) -> list:
    """The cells that are graded by machine."""
    return [cell for cell in notebook.cells if nbgrader(cell).get("grade") and not nbgrader(cell)["solution"]]


def open_problems(notebook) -> list:
    """The cells that are graded by hand."""
    return [cell for cell in notebook.cells if nbgrader(cell).get("grade") and nbgrader(cell)["solution"]]


def test_there_are_notebooks_to_test():
    assert {path.stem for path in LECTURES} >= {"03_scara", "08_planar_2r"}
    assert {path.stem for path in SOLUTIONS} >= {"scara", "planar_2r"}
    assert all(path.stem == path.parent.name for path in SOLUTIONS)


@pytest.mark.parametrize("path", LECTURES + SOLUTIONS, ids=name)
def test_notebook_is_valid_and_without_outputs(path):
    notebook = read(path)
    nbformat.validate(notebook)
    assert (notebook.nbformat, notebook.nbformat_minor) == (4, 5)
    assert notebook.metadata.kernelspec.name == "python3"
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert cell.outputs == [] and cell.execution_count is None, cell.id


@pytest.mark.parametrize("path", LECTURES + SOLUTIONS, ids=name)
def test_cell_ids_are_unique(path):
    ids = [cell.id for cell in read(path).cells]
    assert len(ids) == len(set(ids))


@pytest.mark.parametrize("path", LECTURES, ids=name)
def test_lectures_need_no_grader(path):
    if name(path) in FOR_LECTURERS:
        pytest.skip("holds answers and their proofs: it stays with the lecturer, and out of the students' zip")
    source = "\n".join(cell.source for cell in read(path).cells)
    assert "autograder" not in source and "nbgrader" not in source


ANSWER = re.compile(r"\n\n<details><summary>Answer</summary>\n\n(.+?)\n\n</details>(?=\n\n|$)", re.S)
"""Blank lines on both sides: only then the Markdown inside is laid out."""


@pytest.mark.parametrize("path", LECTURES, ids=name)
def test_every_try_has_an_answer_that_unfolds_below_it(path):
    for cell in read(path).cells:
        if cell.cell_type == "markdown":
            for tried in re.split(r"\*\*Try[.:]", cell.source)[1:]:
                assert len(ANSWER.findall(tried)) == tried.count("<details>") == 1, f"{cell.id}: {tried}"


@pytest.mark.parametrize("path", LECTURES, ids=name)
def test_names_of_formulas_are_typeset(path):
    """SymPy makes an index of what follows a low line; a name in braces it leaves to LaTeX."""
    for cell in read(path).cells:
        if cell.cell_type == "code":
            for shown in re.findall(r'\bshow\(r?"([^"]*)",', cell.source):
                assert " " not in shown or "{" in shown, f"{cell.id}: {shown}"


@pytest.mark.parametrize("path", LECTURES + SOLUTIONS, ids=name)
def test_items_of_a_numbered_list_begin_their_lines(path):
    for cell in read(path).cells:
        if cell.cell_type == "markdown":
            assert not re.search(r"^ *1\. .* 2\. ", cell.source, re.M), cell.id
            for number in map(int, re.findall(r"\S\n *([2-9])\. ", cell.source)):
                assert re.search(rf"^ *{number - 1}\. ", cell.source, re.M), (
                    f"{cell.id}: {number}. without {number - 1}."
                )


@pytest.mark.parametrize("path", SOLUTIONS, ids=name)
def test_every_question_is_asked_once_in_the_exact_form(path):
    notebook = read(path)
    asked = [cell.source for cell in checks(notebook)]
    ids = [id for id in questions() if id.startswith(f"{path.stem}.")]
    assert sorted(asked) == sorted(f'check("{id}", {id.split(".")[1]})' for id in ids)


@pytest.mark.parametrize("path", SOLUTIONS, ids=name)
def test_each_check_follows_its_own_answer_cell(path):
    cells = read(path).cells
    marked = [cell for cell in cells if nbgrader(cell) and cell.cell_type == "code"]
    for answer, check in zip(marked[::2], marked[1::2], strict=True):
        id = re.match(r'check\("([\w.]+)"', check.source)[1].replace(".", "-")
        assert (nbgrader(answer)["grade_id"], nbgrader(check)["grade_id"]) == (f"{id}-answer", id)
        assert nbgrader(answer)["solution"] and not nbgrader(answer)["locked"] and not nbgrader(answer)["grade"]
        assert nbgrader(check)["locked"] and not nbgrader(check)["solution"]
        assert {nbgrader(answer)["schema_version"], nbgrader(check)["schema_version"]} == {3}


@pytest.mark.parametrize("path", SOLUTIONS, ids=name)
def test_released_answer_cells_are_python_with_a_stub_and_no_solution(path):
    config = Config()
    config.ClearSolutions.code_stub = {"python": STUB}
    released, _ = ClearSolutions(config=config).preprocess(read(path), {})
    for cell in released.cells:
        if nbgrader(cell).get("solution") and cell.cell_type == "code":
            assert STUB in cell.source and "SOLUTION" not in cell.source
            assert "..." in cell.source or cell.source.startswith("def ")
            compile(cell.source, cell.id, "exec")


@pytest.mark.parametrize("path", SOLUTIONS, ids=name)
def test_titles_announce_the_points_of_their_question(path):
    announced = None
    for cell in read(path).cells:
        if cell.cell_type == "markdown" and (found := re.search(r"^## .*\(([\d.]+) points?\)$", cell.source, re.M)):
            announced = float(found[1])
        if nbgrader(cell).get("grade") and not nbgrader(cell)["solution"]:
            assert announced == nbgrader(cell)["points"] > 0, (
                f"above {cell.source}: '## Title (n points)' with its points"
            )
            announced = None


@pytest.mark.parametrize("path", SOLUTIONS, ids=name)
def test_an_open_problem_is_graded_by_hand_as_a_bonus(path):
    for problem in open_problems(read(path)):
        assert problem.cell_type == "markdown" and nbgrader(problem)["points"] == 0
        assert nbgrader(problem)["grade_id"] == f"{path.stem}-open", "one in each notebook"
        assert "**Marking key** (4 bonus marks)" in problem.source, (
            "a model answer and a marking key, which weighs the same everywhere"
        )


@pytest.mark.parametrize("path", SOLUTIONS, ids=name)
def test_every_question_has_two_hints_and_an_expected_time(path):
    asked = [question for question in questions().values() if question.exercise == path.stem]
    assert [question.id for question in asked if len(question.hints) != 2 or not 1 <= question.minutes <= 45] == []
