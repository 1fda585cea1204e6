"""The generator of the sample class: what it writes, what it refuses, and that it hands out what nbgrader would."""

import json
import shutil

import expected
import nbformat
import pytest
from edits import FILE_EDITS, NOTEBOOK_EDITS, STUB, grade_id, released, solved, undrawn
from expected import Submission, submissions
from nbgrader.preprocessors import ClearSolutions
from write import NotOurs, hand_in, solution, write_class

pytestmark = pytest.mark.slow

EXERCISES = sorted({one.exercise for one in submissions()})


@pytest.mark.parametrize("exercise", EXERCISES)
def test_stubs_are_those_of_nbgrader(exercise):
    nb = nbformat.reads(json.dumps(solution(exercise)), as_version=4)
    theirs, _ = ClearSolutions(code_stub={"python": STUB}).preprocess(nb, {})
    ours = released(solution(exercise))
    answers = [cell for cell in ours["cells"] if (grade_id(cell) or "").endswith("-answer")]
    assert [cell["source"] for cell in ours["cells"]] == [cell.source for cell in theirs.cells]
    assert len(answers) >= 6 and all(STUB in cell["source"] for cell in answers)


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_solved_notebook_keeps_its_cells(exercise):
    nb, source = solved(solution(exercise)), solution(exercise)
    assert [cell["id"] for cell in nb["cells"]] == [cell["id"] for cell in source["cells"]]
    assert not any("SOLUTION" in cell["source"] for cell in nb["cells"])


@pytest.mark.parametrize("exercise", EXERCISES)
def test_what_only_draws_can_be_left_out(exercise):
    source = solution(exercise)
    kept = undrawn(source)["cells"]
    assert kept == [cell for cell in source["cells"] if cell in kept], "in the same order"
    missing = ["".join(cell["source"]) for cell in source["cells"] if cell not in kept]
    assert len(missing) >= 4 and all(text.startswith(("draw_", "show_")) for text in missing)
    assert all(grade_id(cell) is None for cell in source["cells"] if cell not in kept)


def test_edits_leave_their_input_alone():
    nb = solution("scara")
    before = json.dumps(nb)
    examples = {
        "write": {"cell": "scara-T04", "source": "pass"},
        "insert": {"source": "pass", "before": "scara-T04"},
        "insert_first": {"source": "pass"},
        "delete": {"cell": "scara-T04"},
        "duplicate": {"cell": "scara-T04"},
        "move": {"cell": "scara-T04", "before": "scara-table"},
        "set_metadata": {"cell": "scara-T04", "nbgrader": {"points": 9}, "autograder": {"share": 1}},
        "forge_output": {"cell": "scara-T04", "data": {"text/plain": "3"}},
        "break_nbgrader_metadata": {},
        "drop_nbgrader_metadata": {},
        "ask_for_kernel": {"name": "julia", "language": "julia"},
    }
    assert examples.keys() == NOTEBOOK_EDITS.keys()
    for name, arguments in examples.items():
        assert NOTEBOOK_EDITS[name](nb, **arguments) != nb, name
        assert json.dumps(nb) == before, name


@pytest.mark.parametrize("one", submissions(), ids=lambda one: f"{one.exercise}.{one.student}")
def test_every_submission_can_be_made(one):
    files = hand_in(one, solution(one.exercise))
    assert all(isinstance(content, bytes) for content in files.values())
    assert one.says.endswith(".")
    assert f"{one.exercise}.ipynb" in files or any(edit["do"] in FILE_EDITS for edit in one.edits)


def test_an_unknown_edit_and_an_unknown_cell_are_named():
    nb = solution("scara")
    with pytest.raises(ValueError, match="no edit 'explode'"):
        hand_in(Submission("scara", "x", "", edits=({"do": "explode"},)), nb)
    with pytest.raises(LookupError, match="no cell 'scara-T40'; there are scara-table-answer"):
        hand_in(Submission("scara", "x", "", edits=({"do": "delete", "cell": "scara-T40"},)), nb)


def test_a_note_that_does_not_settle_the_share_needs_one(tmp_path, monkeypatch):
    (tmp_path / "students").mkdir()
    (tmp_path / "students/x.toml").write_text('[scara.x]\nsays = "."\nnotes = { T04 = "sign_of_d2" }\n')
    monkeypatch.setattr(expected, "HERE", tmp_path)
    with pytest.raises(ValueError, match=r"scara\.x: T04 has no share"):
        submissions()


def test_a_question_without_a_note_is_right_where_it_was_answered():
    one = Submission(
        "scara", "x", "", {"U1": ["sign_of_d2", 0.7], "dhm": "malformed"}, ("table", "dhm"), {"model": "..."}
    )
    assert one.expected("table") == one.expected("model") == ("right", 1.0)
    assert one.expected("new") == ("not_attempted", 0.0)
    assert (one.expected("U1"), one.expected("dhm")) == (("sign_of_d2", 0.7), ("malformed", 0.0))
    assert Submission("scara", "x", "").expected("new") == ("right", 1.0)
    assert Submission("scara", "x", "", {"*": "unreadable"}).expected("new") == ("unreadable", 0.0)


def test_the_class_is_written_twice_the_same_and_keeps_grades(tmp_path):
    root = tmp_path / "class"
    write_class(root)
    first = {path: path.read_bytes() for path in root.rglob("*") if path.is_file()}
    (root / "gradebook.db").write_text("grades")
    shutil.rmtree(root / "submitted" / "right")
    (root / "submitted" / "stranger").mkdir()
    write_class(root)
    assert {path: path.read_bytes() for path in root.rglob("*") if path.is_file()} == first | {
        root / "gradebook.db": b"grades"
    }
    assert not (root / "submitted" / "stranger").exists()


def test_a_folder_with_something_else_is_refused(tmp_path):
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(NotOurs, match="not a sample class"):
        write_class(tmp_path)
    with pytest.raises(NotOurs):
        write_class(tmp_path / "thesis.tex")
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_harmless_leaves_out_what_could_do_harm(tmp_path):
    written = write_class(tmp_path / "class", harmless=True)
    assert 20 <= len(written) < len(submissions())
    text = "".join(path.read_text(errors="replace") for path in (tmp_path / "class" / "submitted").rglob("*.*"))
    for danger in ("fork()", "Popen", "create_connection", "rmtree", "10 << 30", "range(500)", "gradebook.db"):
        assert danger not in text, danger
