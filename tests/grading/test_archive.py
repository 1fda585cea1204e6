"""A term is kept as a whole before anything of it goes."""

import io
import sqlite3
import zipfile

import pytest

from autograder import cli

pytestmark = pytest.mark.slow


@pytest.fixture
def term(without_kernels, small, course_copy, released):
    """A course in which ann was graded."""
    small.hand_in(course_copy, "ann", small.answered(released, T04="T04 = ...", forward="forward = ..."))
    (course_copy / "students.csv").write_text("id\nann\n")
    (course_copy / "term.toml").write_text("[due]\nscara = 2026-10-14\n")
    (course_copy / "submitted/ann/scara/secret").symlink_to("/etc/passwd")
    with without_kernels():
        assert cli.main(["grade", "scara", "--course", str(course_copy)]) == 0
    for page in ("term/students/ann.html", "reports/scara/report.html", "return/scara/scara-grades.csv"):
        (course_copy / "build" / page).parent.mkdir(parents=True)
        (course_copy / "build" / page).write_text("ann")
    (course_copy / "build/runs").mkdir(exist_ok=True)
    (course_copy / "build/runs/one").write_text("what ann's notebook brought back")
    (course_copy / "build/robots.zip").write_text("for the students")
    return course_copy


def archive(root, target, *more):
    return cli.main(["archive", str(target), *more, "--course", str(root)])


def test_everything_of_the_term_is_kept(term, tmp_path, capsys):
    assert archive(term, tmp_path / "2026.zip") == 0
    with zipfile.ZipFile(tmp_path / "2026.zip") as kept:
        names = set(kept.namelist())
        assert names >= {
            "gradebook.db", "students.csv", "term.toml", "nbgrader_config.py", "submitted/ann/scara/scara.ipynb",
            "autograded/ann/scara/scara.ipynb", "feedback/ann/scara/scara.html", "exercises/scara/scara.ipynb",
            "solutions/scara/scara.ipynb", "build/term/students/ann.html", "build/reports/scara/report.html",
            "build/return/scara/scara-grades.csv",
        }  # fmt: skip
        assert not [name for name in names if "secret" in name or "build/runs" in name]
        about = kept.read("ABOUT.txt").decode()
        assert "nbgrader 0." in about and "autograder explain" in about and "feedback/" in about
        kept.extract("gradebook.db", tmp_path)
    with sqlite3.connect(tmp_path / "gradebook.db") as gradebook:
        assert gradebook.execute("select count(*) from submitted_assignment").fetchone() == (1,)
    assert (term / "gradebook.db").exists() and (term / "submitted/ann").exists()


def test_the_next_term_begins_without_the_last_one(term, tmp_path, capsys):
    assert archive(term, tmp_path / "2026.zip", "--clear", "--yes") == 0
    left = {path.name for path in term.iterdir()}
    assert not left & {"gradebook.db", "submitted", "autograded", "feedback", "students.csv", "downloaded"}
    assert left >= {"solutions", "exercises", "term.toml", "nbgrader_config.py"}
    assert [path.name for path in (term / "build").iterdir()] == ["robots.zip"]
    assert "term.toml holds the dates of the last term" in capsys.readouterr().out
    assert cli.main(["release", "scara", "--home", "form", "--course", str(term)]) == 0


def test_nothing_goes_without_being_asked_for(term, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", io.StringIO("y\n"))
    assert archive(term, tmp_path / "2026.zip", "--clear") == 2
    assert "nothing was removed; say --yes" in capsys.readouterr().err and (term / "gradebook.db").exists()


def test_an_archive_is_never_overwritten(term, tmp_path, capsys):
    (tmp_path / "2026.zip").write_text("last year")
    assert archive(term, tmp_path / "2026.zip", "--clear", "--yes") == 2
    assert (tmp_path / "2026.zip").read_text() == "last year" and (term / "gradebook.db").exists()
