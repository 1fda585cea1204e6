"""Whatever was done to the tracked cells, the result is the released exercise around the student's answers."""

import random
from copy import deepcopy

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell

from autograder.grading.cells import grade_id, is_check, notebook_record
from autograder.grading.submission.restore import restore

CHECKS = ("scara-T04", "scara-d2_sign", "scara-forward")


@pytest.fixture
def right(small, released):
    nb = small.answered(released)
    nb.metadata = {"autograder": {"kernel": "python3"}}
    return nb


def cell(nb, name):
    return nb.cells[place(nb, name)]


def place(nb, name):
    return [grade_id(cell) for cell in nb.cells].index(name)


def sound(nb, released):
    """Every tracked cell once, checks as released and behind their answers, nothing else that nbgrader would see."""
    nbformat.validate(nb)
    tracked = [grade_id(cell) for cell in nb.cells if grade_id(cell)]
    assert sorted(tracked) == sorted(grade_id(cell) for cell in released.cells if grade_id(cell))
    for name in CHECKS:
        assert cell(nb, name) == cell(released, name)
        assert cell(nb, f"{name}-answer").metadata == cell(released, f"{name}-answer").metadata
        assert place(nb, f"{name}-answer") < place(nb, name)
    assert all(cell.metadata == {} for cell in nb.cells if grade_id(cell) is None)
    assert {key: value for key, value in nb.metadata.items() if key != "autograder"} == released.metadata


def repairs(nb):
    return list(notebook_record(nb).repairs)


def test_an_honest_notebook_stays_as_it_is(right, released):
    nb = restore(right, released)
    sound(nb, released)
    assert [cell.source for cell in nb.cells] == [cell.source for cell in right.cells]
    assert repairs(nb) == []


def test_a_deleted_check_comes_back_behind_its_answer(right, released):
    del right.cells[place(right, "scara-T04")]
    nb = restore(right, released)
    sound(nb, released)
    assert place(nb, "scara-T04") == place(nb, "scara-T04-answer") + 1
    assert repairs(nb) == ["the check cell of T04 was missing"]


def test_a_question_that_was_not_in_the_notebook_is_told_once_and_without_blame(right, released):
    for name in ("scara-T04-answer", "scara-T04"):
        del right.cells[place(right, name)]
    nb = restore(right, released)
    sound(nb, released)
    assert repairs(nb) == ["the cells of T04 were missing (deleted, or asked only later)"]


def test_ids_that_an_editor_dropped_are_told_once(right, released):
    for one in right.cells:
        one.metadata.pop("nbgrader", None)
    nb = restore(right, released)
    sound(nb, released)
    assert repairs(nb) == ["no question was found by the ids of its cells; an editor had dropped them"]


def test_a_deleted_check_comes_back_behind_cells_that_finish_the_answer(right, released):
    right.cells[place(right, "scara-T04")] = new_code_cell("T04 = better(T04)")
    nb = restore(right, released)
    sound(nb, released)
    assert nb.cells[place(nb, "scara-T04") - 1].source == "T04 = better(T04)"


def test_an_edited_check_gets_its_source_back(right, released):
    cell(right, "scara-T04").source = "pass"
    nb = restore(right, released)
    sound(nb, released)
    assert repairs(nb) == ["the check cell of T04 had been edited"]


def test_duplicates_count_once(right, released):
    right.cells += [deepcopy(cell(right, "scara-T04")), deepcopy(cell(right, "scara-T04"))]
    nb = restore(right, released)
    sound(nb, released)
    assert repairs(nb) == ["the check cell of T04 was there 3 times"]


def test_a_check_before_its_answer_moves_behind_it(right, released):
    check = right.cells.pop(place(right, "scara-T04"))
    right.cells.insert(0, check)
    nb = restore(right, released)
    sound(nb, released)
    assert repairs(nb) == ["the check cell of T04 stood before its answer"]


def test_a_leftover_copy_of_an_answer_does_not_replace_it(right, released):
    right.cells.append(deepcopy(cell(right, "scara-T04-answer")))
    right.cells[-1].source = "T04 = 'scratch'"
    nb = restore(right, released)
    sound(nb, released)
    assert "Matrix" in cell(nb, "scara-T04-answer").source
    assert nb.cells[-1].source == "T04 = 'scratch'" and grade_id(nb.cells[-1]) is None


def test_of_two_answers_before_the_check_the_last_is_the_answer(right, released):
    first = place(right, "scara-T04-answer")
    right.cells.insert(first, deepcopy(right.cells[first]))
    right.cells[first].source = "T04 = 'draft'"
    nb = restore(right, released)
    sound(nb, released)
    assert "Matrix" in cell(nb, "scara-T04-answer").source


def test_an_answer_typed_into_a_new_cell_is_not_overwritten_by_a_stub(right, released):
    where = place(right, "scara-T04-answer")
    right.cells[where] = new_code_cell(right.cells[where].source)
    nb = restore(right, released)
    sound(nb, released)
    assert "Matrix" in nb.cells[where].source
    assert cell(nb, "scara-T04-answer").source.startswith("#") and "T04" not in cell(nb, "scara-T04-answer").source
    assert place(nb, "scara-T04-answer") > where


def test_a_whole_question_deleted_comes_back_in_its_place(right, released):
    right.cells = [cell for cell in right.cells if not (grade_id(cell) or "").startswith("scara-d2_sign")]
    nb = restore(right, released)
    sound(nb, released)
    assert (
        place(nb, "scara-T04")
        < place(nb, "scara-d2_sign-answer")
        < place(nb, "scara-d2_sign")
        < place(nb, "scara-forward-answer")
    )


def test_an_answer_turned_into_text_is_code_again(right, released):
    where = place(right, "scara-T04-answer")
    right.cells[where] = new_markdown_cell(right.cells[where].source, metadata=right.cells[where].metadata)
    nb = restore(right, released)
    sound(nb, released)
    assert cell(nb, "scara-T04-answer").cell_type == "code"


def test_an_empty_notebook_becomes_the_exercise_without_answers(right, released):
    right.cells = []
    nb = restore(right, released)
    sound(nb, released)
    assert all(cell.source.startswith("#") for cell in nb.cells if not is_check(cell))


def test_foreign_ids_are_ordinary_cells(right, released):
    right.cells.append(new_code_cell("x = 1", metadata={"nbgrader": {"grade_id": "scara-bonus"}}))
    sound(restore(right, released), released)


def test_another_kernel_is_said(right, released):
    right.metadata = {"autograder": {"kernel": "julia-1.9"}}
    nb = restore(right, released)
    sound(nb, released)
    assert repairs(nb) == ["the notebook asked for the kernel 'julia-1.9', it was run with python3"]


@pytest.mark.parametrize("seed", range(60))
def test_any_shuffle_deletion_and_copy_is_mended(right, released, seed):
    rng = random.Random(seed)
    cells = [deepcopy(cell) for cell in rng.choices(right.cells, k=rng.randrange(0, 25))]
    names = [grade_id(cell) for cell in released.cells if grade_id(cell)] + ["", "nonsense"]
    for one in cells:
        one["id"] = f"c{rng.getrandbits(60):x}"
        if rng.random() < 0.2:
            one.metadata["nbgrader"] = {"grade_id": rng.choice(names)}
        if rng.random() < 0.2:
            one.source = "edited"
    right.cells = cells
    nb = restore(right, released)
    sound(nb, released)
    assert restore(nb, released).cells == nb.cells
    kept = [cell.source for cell in cells if cell.source == "edited" and grade_id(cell) not in CHECKS]
    assert sum(cell.source == "edited" for cell in nb.cells) >= len(kept)


def test_pictures_pasted_into_the_open_problem_stay(right, released):
    marks = {
        "grade": True,
        "solution": True,
        "locked": False,
        "grade_id": "scara-open",
        "points": 0,
        "schema_version": 3,
    }
    open_problem = new_markdown_cell("YOUR ANSWER HERE", id="open", metadata={"nbgrader": marks})
    released = deepcopy(released)
    released.cells.append(open_problem)
    answer = new_markdown_cell("See ![](attachment:a.png)", metadata={"nbgrader": {"grade_id": "scara-open"}})
    answer["attachments"] = {"a.png": {"image/png": "QUJD"}}
    right.cells.append(answer)
    cell(right, "scara-T04")["attachments"] = {"a.png": {"image/png": "QUJD"}}
    nb = restore(right, released)
    nbformat.validate(nb)
    assert cell(nb, "scara-open").attachments == {"a.png": {"image/png": "QUJD"}}
    assert cell(nb, "scara-open").source == answer.source and "attachments" not in cell(nb, "scara-T04")
