"""One class of broken and hostile submissions, graded by our command and by stock nbgrader: the same gradebook."""

import json
import os
import shutil
import sqlite3
import tempfile
from copy import deepcopy
from pathlib import Path

import nbformat
import pytest
from bs4 import BeautifulSoup
from nbformat.v4 import new_code_cell, new_markdown_cell
from nbgrader.apps import AutogradeApp, ExportApp, GenerateFeedbackApp

from autograder import cli

pytestmark = [pytest.mark.slow, pytest.mark.sandbox]

NOTHING = ["not_attempted"] * 3
UNREADABLE = ["unreadable"] * 3
RIGHT = ["right"] * 3
SCRIPT = "<script>alert('student')</script>"


def submissions(small, released):
    """Student -> what is handed in, expected score, expected notes (T04, d2_sign, forward), words of the class table."""
    right, cell = small.answered(released), small.cell

    def edited(edit):
        nb = deepcopy(right)
        edit(nb)
        return nb

    def delete(*names):
        return edited(lambda nb: [nb.cells.remove(cell(nb, name)) for name in names])

    def forge(nb):
        for one in nb.cells:
            one.metadata["autograder"] = {"note": "right", "share": 1}
            if "nbgrader" in one.metadata:
                one.metadata.nbgrader.update(points=1000, grade="yes", solution=1, schema_version="3", checksum=7)
        cell(nb, "scara-T04-answer").source = "T04 = ..."
        cell(nb, "scara-T04-answer").metadata["nbgrader"] = {"grade_id": "scara-T04-answer", "locked": "maybe"}
        nb.metadata["autograder"] = {"unreadable": "", "submission": "0" * 64, "repairs": "<b>"}
        nb.cells.append(
            new_code_cell(
                "6", metadata={"nbgrader": {"grade_id": "scara-gift", "grade": True, "points": 50, "schema_version": 9}}
            )
        )

    def noise(nb):
        nb.cells.insert(
            1, new_code_cell("import sys, warnings\nwarnings.warn('odd')\nprint('noise', file=sys.stderr)\n1/0")
        )

    def scripts(nb):
        nb.cells.insert(0, new_markdown_cell(f"{SCRIPT} ![gone](attachment:gone.png) <img src=x onerror=alert(1)>"))
        show = f"from IPython.display import *\ndisplay(HTML({SCRIPT!r}), Javascript('alert(1)'), SVG('<svg onload=\"alert(1)\"/>'))"
        nb.cells.insert(1, new_code_cell(f"{show}\nprint({SCRIPT!r})\nraise ValueError({SCRIPT!r})"))
        cell(nb, "scara-d2_sign-answer").source = f"raise ValueError({SCRIPT!r} + '\\x1b[2J**bold**')"

    def move(nb):
        check = cell(nb, "scara-T04")
        nb.cells.remove(check)
        nb.cells.insert(0, check)

    text = json.dumps(right)
    deep = json.dumps({"a": 1}).replace("1", "[" * 30_000 + "]" * 30_000)
    return {
        "right": (right, 20, RIGHT, "all right"),
        "sign": (small.answered(released, T04=small.T04.replace("-d2", "d2")), 15, ["sign_of_d2", "right", "right"], "T04: sign_of_d2"),
        "untouched": (released, 0, NOTHING, "all 3: not_attempted"),
        "truncated": (text[: len(text) // 2], 0, UNREADABLE, "may have been cut off"),
        "utf16": (text.encode("utf-16"), 0, UNREADABLE, "not UTF-8"),
        "deep": (deep, 0, UNREADABLE, "nested"),
        "not_a_notebook": ("[]", 0, UNREADABLE, "not a Jupyter notebook"),
        "deleted_check": (delete("scara-T04"), 20, RIGHT, "the check cell of T04 was missing"),
        "deleted_answer": (delete("scara-T04-answer"), 10, ["error", "right", "right"], "the answer cell of T04 was missing"),
        "deleted_both": (delete("scara-d2_sign", "scara-d2_sign-answer"), 16, ["right", "error", "right"], "the cells of d2_sign were missing (deleted, or asked only later)"),
        "duplicated": (edited(lambda nb: nb.cells.append(deepcopy(cell(nb, "scara-T04")))), 20, RIGHT, "was there 2 times"),
        "edited_check": (edited(lambda nb: cell(nb, "scara-T04").update(source="pass")), 20, RIGHT, "had been edited"),
        "moved_check": (edited(move), 20, RIGHT, "stood before its answer"),
        "forged": (edited(forge), 10, ["not_attempted", "right", "right"], "T04: not_attempted"),
        "other_kernel": (edited(lambda nb: nb.metadata.update(kernelspec={"name": "julia", "display_name": "J"})), 20, RIGHT, "'julia'"),
        "noise": (edited(noise), 20, RIGHT, "all right"),
        "scripts": (edited(scripts), 16, ["right", "error", "right"], "d2_sign: error (ValueError: <script>"),
        "syntax": (small.answered(released, d2_sign="d2_sign = 'B"), 16, ["right", "error", "right"], "d2_sign: error (SyntaxError"),
        "loop": (small.answered(released, d2_sign="while True: pass"), 16, ["right", "timeout", "right"], "d2_sign: timeout (stopped after"),
        "slow_function": (
            small.answered(released, forward="def forward(*args):\n    while True: pass"), 14, ["right", "right", "timeout"], "forward: timeout"
        ),
        "empty_folder": (None, 0, UNREADABLE, "there is no scara.ipynb in the folder"),
        "wrong name": ((right, "SCARA (1).ipynb"), 0, UNREADABLE, "but SCARA (1).ipynb; rename it"),
        "odd files": (right, 20, RIGHT, "all right"),
        "linked": (None, 0, UNREADABLE, "is a link"),
    }  # fmt: skip


LIMITS = {"cell_seconds": 3, "notebook_seconds": 40}


@pytest.fixture(scope="module")
def expected(small, released):
    return submissions(small, released)


@pytest.fixture(scope="module")
def handed_in(small, empty_course, expected, tmp_path_factory):
    root = tmp_path_factory.mktemp("class") / "course"
    shutil.copytree(empty_course, root)
    for student, (content, *_) in expected.items():
        small.hand_in(root, student, *(content if isinstance(content, tuple) else (content,)))
    odd = root / "submitted/odd files/scara"
    (odd / "passwd.txt").symlink_to("/etc/passwd")
    (odd / "all").symlink_to("/etc")
    (odd / "timestamp.txt").write_text("the day before\x00 yesterday")
    (odd / "scara.html").write_text(SCRIPT)
    (odd / "notes.txt").write_text("mine")
    os.mkfifo(odd / "pipe")
    (root / "submitted/linked/scara/scara.ipynb").symlink_to(root / "submitted/right/scara/scara.ipynb")
    return root


def command(root, *words):
    return cli.main([*words, "--course", str(root)])


@pytest.fixture(scope="module")
def ours(handed_in, tmp_path_factory):
    """The class graded by our own command; the JSON lines it printed are in graded.jsonl."""
    root = tmp_path_factory.mktemp("ours") / "course"
    shutil.copytree(handed_in, root, symlinks=True, copy_function=copy_unless_pipe)
    options = [word for name, value in LIMITS.items() for word in (f"--{name.replace('_', '-')}", str(value))]
    printed = root / "graded.jsonl"
    with printed.open("w") as file, pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.stdout", file)
        patch.setattr(tempfile, "tempdir", str(root.parent / "temporary"))
        os.mkdir(tempfile.tempdir)
        assert command(root, "grade", "scara", "--json", "--jobs", "2", *options) == 0
    return root


@pytest.fixture(scope="module")
def stock(handed_in, tmp_path_factory):
    """The class graded by ``nbgrader autograde`` and ``nbgrader generate_feedback``."""
    root = tmp_path_factory.mktemp("stock") / "course"
    shutil.copytree(handed_in, root, symlinks=True, copy_function=copy_unless_pipe)
    here = os.getcwd()
    os.chdir(root)
    try:
        for make, options in ((AutogradeApp, LIMITS), (GenerateFeedbackApp, {}), (ExportApp, {})):
            app = make()
            words = [] if make is ExportApp else ["scara"]
            app.initialize(
                [
                    *words,
                    "--log-level=CRITICAL",
                    *(f"--SandboxExecute.{name}={value}" for name, value in options.items()),
                ]
            )
            app.start()
    finally:
        os.chdir(here)
    return root


def copy_unless_pipe(source, target, **options):
    return os.mkfifo(target) if Path(source).is_fifo() else shutil.copy2(source, target, **options)


def contents(folder):
    return {
        str(path): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file() and not path.is_symlink()
    }


def rows(root, query):
    with sqlite3.connect(root / "gradebook.db") as connection:
        return sorted(connection.execute(query).fetchall(), key=str)


GRADES = """
select student.id, base_cell.name, grade.auto_score, grade.manual_score, grade.extra_credit, grade.needs_manual_grade
from grade join base_cell on grade.cell_id = base_cell.id
join submitted_notebook on grade.notebook_id = submitted_notebook.id
join submitted_assignment on submitted_notebook.assignment_id = submitted_assignment.id
join student on submitted_assignment.student_id = student.id"""
COMMENTS = """
select student.id, base_cell.name, comment.auto_comment, comment.manual_comment
from comment join base_cell on comment.cell_id = base_cell.id
join submitted_notebook on comment.notebook_id = submitted_notebook.id
join submitted_assignment on submitted_notebook.assignment_id = submitted_assignment.id
join student on submitted_assignment.student_id = student.id"""


@pytest.fixture(scope="module")
def results(ours):
    lines = (ours / "graded.jsonl").read_text().splitlines()
    return {line["student"]: line for line in map(json.loads, lines)}


def test_one_json_object_for_every_submission(results, expected):
    assert sorted(results) == sorted(expected)
    assert {line["status"] for line in results.values()} == {"graded"}


def test_scores_and_notes_are_those_expected(results, expected):
    found = {
        student: (line["score"], [answer["note"] for answer in line["answers"]]) for student, line in results.items()
    }
    assert found == {student: (score, notes) for student, (_, score, notes, _) in expected.items()}


def test_the_class_table_says_what_was_wrong(results, expected):
    for student, (_, _, _, words) in expected.items():
        assert words in results[student]["found"]
        assert results[student]["found"].isprintable()


@pytest.mark.parametrize("query", [GRADES, COMMENTS], ids=["grades", "comments"])
def test_stock_nbgrader_keeps_the_same_gradebook(ours, stock, expected, query):
    assert rows(ours, query) == rows(stock, query)
    assert len(rows(ours, query)) == 3 * len(expected)


def test_stock_nbgrader_keeps_the_same_feedback(ours, stock, expected):
    for student in expected:
        pair = [nbformat.read(root / f"autograded/{student}/scara/scara.ipynb", as_version=4) for root in (ours, stock)]
        assert pair[0].metadata == pair[1].metadata
        judged = [[(cell.outputs, cell.metadata) for cell in nb.cells if "autograder" in cell.metadata] for nb in pair]
        assert judged[0] == judged[1] and len(judged[0]) == 3
        pages = [(root / f"feedback/{student}/scara/scara.html").read_text() for root in (ours, stock)]
        assert pages[0].partition('id="notebook"')[0] == pages[1].partition('id="notebook"')[0]


def test_submissions_are_not_touched(handed_in, ours, stock):
    for root in (ours, stock):
        now = {
            path.replace(str(root), str(handed_in)): content for path, content in contents(root / "submitted").items()
        }
        assert now == contents(handed_in / "submitted")


def test_nothing_else_is_written_and_nothing_stays(ours, expected):
    made = {path.name for path in ours.iterdir()}
    assert made == {
        "build",
        "solutions",
        "exercises",
        "submitted",
        "autograded",
        "feedback",
        "gradebook.db",
        "nbgrader_config.py",
        "graded.jsonl",
    }
    for step, name in (("autograded", "scara.ipynb"), ("feedback", "scara.html")):
        files = sorted(str(path.relative_to(ours / step)) for path in (ours / step).rglob("*") if not path.is_dir())
        assert files == sorted(f"{student}/scara/{name}" for student in expected)
    assert os.listdir(ours.parent / "temporary") == []


def test_feedback_runs_no_script_of_a_student(ours):
    for page in (ours / "feedback").rglob("*.html"):
        tree = BeautifulSoup(page.read_text(), "html.parser")
        harmless(tree.body)
        assert not tree.find_all(["script", "link", "iframe", "object", "embed", "form"])
        assert "url(" not in str(tree.head) and "@import" not in str(tree.head)
    page = (ours / "feedback/scripts/scara/scara.html").read_text()
    assert "Content-Security-Policy" in page.partition("<title>")[0]
    assert "&lt;script&gt;alert('student')&lt;/script&gt;" in page
    assert "16 of 20 points" in page


def harmless(tree):
    """No script, no handler, no frame and nothing fetched: `tree` only shows."""
    assert not tree.find_all(["script", "svg", "iframe", "object", "embed", "form", "style", "link", "base", "meta"])
    for tag in tree.find_all(True):
        assert not [name for name in tag.attrs if name.startswith("on")]
        assert tag.get("src", "data:image/").startswith("data:image/")
        assert not tag.get("href", "#").lower().startswith(("javascript", "data"))


def test_formgrader_shows_the_notes_and_runs_no_script(ours, monkeypatch):
    from nbconvert.exporters import HTMLExporter
    from nbgrader.api import Gradebook
    from nbgrader.server_extensions.formgrader.formgrader import FormgradeExtension

    monkeypatch.chdir(ours)
    extension = FormgradeExtension()
    extension.initialize([])
    exporter = HTMLExporter(config=extension.config)
    page, _ = exporter.from_filename(
        str(ours / "autograded/scripts/scara/scara.ipynb"), resources={"index": 0, "total": 1, "base_url": ""}
    )
    student = BeautifulSoup(page, "html.parser").find(id="notebook-container")
    for control in student.find_all(["button", "input", "textarea"]):
        control.decompose()
    harmless(student)
    assert SCRIPT in student.get_text() and "scara-d2_sign" in student.get_text()
    with Gradebook(extension.coursedir.db_url) as gradebook:
        assert gradebook.find_comment("scara-T04-answer", "scara", "scara", "sign").comment == "note: sign_of_d2"


def test_stock_export_holds_grades_and_notes(stock, ours, tmp_path):
    assert command(ours, "export", "--to", str(tmp_path / "grades.csv")) == 0
    text = (tmp_path / "grades.csv").read_text()
    assert text == (stock / "grades.csv").read_text()
    sign = next(line for line in text.splitlines() if ",sign," in line)
    assert sign == "scara,,,sign,,,,15.0,0.0,0.0,15.0,20.0,scara.T04: sign_of_d2,5.0,4.0,6.0"


def test_grading_again_leaves_unchanged_submissions_alone(ours, small, released, capsys, tmp_path):
    root = tmp_path / "course"
    shutil.copytree(ours, root, symlinks=True, copy_function=copy_unless_pipe)
    small.hand_in(root, "untouched", small.answered(released))
    small.hand_in(root, "new", released)
    assert command(root, "grade", "scara", "--json") == 0
    again = {line["student"]: line for line in map(json.loads, capsys.readouterr().out.splitlines())}
    assert {student for student, line in again.items() if line["status"] == "graded"} == {"untouched", "new"}
    assert again["untouched"]["score"] == 20 and again["new"]["score"] == 0
    assert again["sign"] == json.loads(json.dumps(again["sign"])) and again["sign"]["found"] == "T04: sign_of_d2"
    assert command(root, "grade", "scara", "--student", "new") == 0
    assert "0 graded; 1 unchanged" in capsys.readouterr().out
    assert command(root, "grade", "scara", "--student", "new", "--force") == 0
    assert "1 graded\n" in capsys.readouterr().out


def test_the_report_counts_notes_and_runs_no_script(ours, capsys, tmp_path):
    assert command(ours, "report", "scara", "--to", str(tmp_path)) == 0
    assert "right 12" in capsys.readouterr().out
    assert 'scara.T04,"The SCARA of the lecture, 0T4",10.0,24,' in (tmp_path / "questions.csv").read_text()
    harmless(BeautifulSoup((tmp_path / "report.html").read_text(), "html.parser").body)
