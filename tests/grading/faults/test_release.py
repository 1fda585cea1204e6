"""A release changes exercise and gradebook together, also when somebody has handed in already."""

import json
import sqlite3
from signal import SIGKILL

import nbformat
import pytest
from nbgrader.api import Gradebook
from nbgrader.apps import GenerateAssignmentApp

from autograder import cli, questions
from autograder.grading import files
from autograder.judge import Question

pytestmark = pytest.mark.slow


def solution(root):
    return root / "solutions/scara/scara.ipynb"


def released(root):
    return root / "exercises/scara/scara.ipynb"


def release(root):
    return cli.main(["release", "--yes", "--home", "form", "scara", "--course", str(root)])


def edited(root, edit):
    nb = nbformat.read(solution(root), as_version=4)
    edit(nb)
    nbformat.write(nb, solution(root))


def without_forward(nb):
    nb.cells = [cell for cell in nb.cells if not cell.id.startswith("scara-forward")]


def with_table(nb):
    """A question more, put together from the cells of another."""
    source = json.dumps([cell for cell in nb.cells if cell.id.startswith("scara-d2_sign")])
    nb.cells += nbformat.from_dict(json.loads(source.replace("d2_sign", "table")))


def grades(root, student):
    with Gradebook(f"sqlite:///{root}/gradebook.db") as book:
        found = book.find_submission_notebook("scara", "scara", student)
        return {grade.name: (grade.auto_score, grade.needs_manual_grade) for grade in found.grades}


@pytest.fixture
def graded(course, faults, monkeypatch):
    find = questions.find
    monkeypatch.setattr(questions, "find", lambda id: Question(id, "B") if id == "scara.table" else find(id))
    assert faults.grade(course) == 0
    return course


def test_a_question_is_added_while_submissions_are_there(graded, faults, capsys):
    edited(graded, with_table)
    assert release(graded) == 0
    assert "new: scara-table; for 3 submissions, run: autograder grade scara" in capsys.readouterr().out
    found = grades(graded, "same")
    assert found["scara-d2_sign"] == (4, False) and found["scara-table"] == (None, True) and len(found) == 4
    assert faults.grade(graded) == 0
    assert "3 graded" in capsys.readouterr().out
    assert grades(graded, "same")["scara-table"] == (0, False)
    assert "4 of 24 points" in (graded / "feedback/same/scara/scara.html").read_text()


def test_a_question_is_removed_while_submissions_are_there(graded, faults, capsys):
    with Gradebook(f"sqlite:///{graded}/gradebook.db") as book:
        book.find_grade("scara-T04", "scara", "scara", "same").manual_score = 9
        book.db.commit()
    edited(graded, without_forward)
    assert release(graded) == 0
    assert "no longer asked: scara-forward; for 3 submissions" in capsys.readouterr().out
    assert grades(graded, "same").keys() == {"scara-T04", "scara-d2_sign"}
    assert faults.grade(graded) == 0
    assert "13 of 14 points" in (graded / "feedback/same/scara/scara.html").read_text()
    with sqlite3.connect(graded / "gradebook.db") as connection:
        for table, key in (
            ("grade", "cell_id"),
            ("comment", "cell_id"),
            ("grade_cells", "id"),
            ("solution_cells", "id"),
        ):
            left = f"select count(*) from {table} where {key} not in (select id from base_cell)"
            assert connection.execute(left).fetchone() == (0,)


def test_there_and_back_again_ends_as_before(graded, faults, right, capsys):
    before = solution(graded).read_text()
    edited(graded, without_forward)
    edited(graded, with_table)
    assert release(graded) == 0
    solution(graded).write_text(before)
    assert release(graded) == 0 and faults.grade(graded) == 0
    assert faults.entries(graded) == right.entries and faults.files_below(graded) == right.files


def test_a_notebook_is_added_and_removed_while_submissions_are_there(graded, faults, right, capsys):
    second = solution(graded).with_name("second.ipynb")
    second.write_text(solution(graded).read_text().replace("scara-", "second-"))
    assert release(graded) == 0
    assert released(graded).with_name("second.ipynb").exists()
    second.unlink()
    assert release(graded) == 0
    assert not released(graded).with_name("second.ipynb").exists()
    assert faults.grade(graded) == 0 and faults.entries(graded) == right.entries


def test_the_cells_are_those_of_nbgraders_own_preprocessor(graded, tmp_path, monkeypatch):
    """The rows that SaveCells would write for the same notebook."""
    from nbgrader.preprocessors import (
        CheckCellMetadata,
        ClearOutput,
        ClearSolutions,
        ComputeChecksums,
        LockCells,
        SaveCells,
    )

    from autograder.grading.course import open_course

    nb = nbformat.read(solution(graded), as_version=4)
    other = f"sqlite:///{tmp_path}/other.db"
    with Gradebook(other) as book:
        book.add_assignment("scara")
    app, resources = (
        open_course(graded).app,
        {"nbgrader": {"assignment": "scara", "notebook": "scara", "db_url": other}},
    )
    for each in (LockCells, ClearSolutions, ClearOutput, CheckCellMetadata, ComputeChecksums, SaveCells):
        nb, resources = each(parent=app).preprocess(nb, resources)
    rows = []
    for url in (other, f"sqlite:///{graded}/gradebook.db"):
        with Gradebook(url) as book:
            found = book.find_notebook("scara", "scara")
            cells = [*found.grade_cells, *found.solution_cells, *found.task_cells, *found.source_cells]
            rows.append(sorted([{**cell.to_dict(), "id": ""} for cell in cells], key=str))
            rows[-1].append(found.kernelspec)
    assert rows[0] == rows[1]


def test_what_cannot_be_released_changes_nothing(graded, faults, capsys):
    before = released(graded).read_bytes(), (graded / "gradebook.db").read_bytes()
    edited(graded, with_table)
    solution(graded).write_text(solution(graded).read_text().replace("### END SOLUTION", "", 1))
    assert release(graded) == 2
    assert "no end solution statement found" in capsys.readouterr().err
    assert (released(graded).read_bytes(), (graded / "gradebook.db").read_bytes()) == before


@pytest.mark.slow
@pytest.mark.parametrize("what", [[SIGKILL], "full disk"], ids=["killed", "full"])
@pytest.mark.parametrize("step", range(0, 40, 2))
def test_stopped_at_any_step_it_can_be_done_again(graded, faults, step, what, capfd):
    edited(graded, with_table)

    def action():
        faults.Steps(step, what).watch()
        return release(graded)

    assert faults.run(action) in (0, 1, 2, -SIGKILL)  # 2: refused, in words
    assert "Traceback" not in capfd.readouterr().err
    assert released(graded).is_file()
    assert grades(graded, "same")["scara-d2_sign"] == (4, False)
    assert release(graded) == 0 and faults.grade(graded) == 0
    assert grades(graded, "same")["scara-table"] == (0, False)
    assert sorted(path.name for path in released(graded).parent.iterdir()) == ["scara.ipynb"]


def test_stock_generate_assignment_leaves_nothing_half_either(graded, monkeypatch, capsys):
    edited(graded, with_table)
    before = released(graded).read_bytes()
    monkeypatch.chdir(graded)

    def refuse(path, content, permissions):
        raise OSError(28, "No space left on device", str(path))

    with monkeypatch.context() as full, pytest.raises(SystemExit):
        full.setattr(files, "_write", refuse)
        app = GenerateAssignmentApp()
        app.initialize(["scara", "--force", "--log-level=CRITICAL"])
        app.start()
    assert released(graded).read_bytes() == before and len(grades(graded, "same")) == 3
    app = GenerateAssignmentApp()
    app.initialize(["scara", "--force", "--log-level=CRITICAL"])
    app.start()
    assert len(grades(graded, "same")) == 4 and b"scara-table" in released(graded).read_bytes()
