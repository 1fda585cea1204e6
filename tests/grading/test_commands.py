"""The command line: what it does, what it says when it cannot, and what it imports."""

import json
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import textwrap
import time
import zipfile
from dataclasses import fields
from functools import partial

import nbformat
import psutil
import pytest
from traitlets.config import Config

from autograder import cli
from autograder.grading import doctor
from autograder.grading.bundle import FOR_LECTURERS
from autograder.grading.plugins.preprocessors import SandboxExecute
from autograder.sandbox import Limits
from dhkit.variants import mark


def run(root, *words):
    return cli.main([*words, "--course", str(root)])


COMMANDS = (
    "release",
    "points",
    "roster",
    "allow",
    "collect",
    "grade",
    "watch",
    "explain",
    "feedback",
    "return",
    "report",
    "export",
    "term",
    "archive",
    "bundle",
    "doctor",
)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help_with_an_example(command, capsys):
    with pytest.raises(SystemExit) as end:
        cli.main([command, "--help"])
    assert end.value.code == 0 and f"example: autograder {command}" in capsys.readouterr().out


def test_help_loads_nothing_heavy():
    code = "import sys; from autograder import cli\ntry: cli.main(['--help'])\nexcept SystemExit: print(*sys.modules)"
    modules = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"nbgrader", "rich", "sympy", "numpy", "nbconvert", "traitlets", "jupyter_client"} & set(modules)


def test_every_limit_of_the_sandbox_has_an_option_that_shows_its_default(capsys):
    with pytest.raises(SystemExit):
        cli.main(["grade", "--help"])
    shown = " ".join(capsys.readouterr().out.split())
    for limit in fields(Limits):
        option = f"--{limit.name.replace('_', '-')}"
        default = re.search(rf"{option} [A-Z]+ .*?\(default (\S+)\)", shown)[1]
        read, _ = cli._UNITS[limit.metadata["unit"]]
        assert read(default) == limit.default


def test_every_limit_of_the_sandbox_can_be_configured():
    config = Config(SandboxExecute={limit.name: 7 for limit in fields(Limits)})
    limits = SandboxExecute(config=config).limits
    assert all(getattr(limits, limit.name) == 7 for limit in fields(Limits))


@pytest.mark.parametrize(
    "words",
    [("--memory", "-1"), ("--memory", "1T"), ("--cell-seconds", "nan"), ("--jobs", "0"), ("--output-bytes", "")],
)
def test_limits_that_make_no_sense_are_refused(empty_course, words, capsys):
    with pytest.raises(SystemExit) as end:
        run(empty_course, "grade", "scara", *words)
    assert end.value.code == 2 and words[0] in capsys.readouterr().err


@pytest.mark.slow
def test_release_is_deterministic_and_gives_nothing_away(course_copy, small, capsys):
    notebook = course_copy / "exercises/scara/scara.ipynb"
    first = notebook.read_bytes()
    assert run(course_copy, "release", "--home", "form") == 0 and notebook.read_bytes() == first
    shutil.rmtree(course_copy / "exercises")
    (course_copy / "gradebook.db").unlink()
    assert run(course_copy, "release", "scara", "--home", "form") == 0 and notebook.read_bytes() == first
    text = first.decode()
    assert "SOLUTION" not in text and "# your code here" in text
    for answer in small.ANSWERS.values():
        for line in answer.splitlines():
            assert line not in text
    nb = nbformat.reads(text, as_version=4)
    assert [cell.id for cell in nb.cells] == [cell.id for cell in small.solution().cells]


def test_a_failing_release_says_why(course_copy, capsys):
    path = course_copy / "solutions/scara/scara.ipynb"
    path.write_text(path.read_text().replace("### END SOLUTION", ""))
    assert run(course_copy, "release", "scara", "--home", "form") == 2
    assert "no end solution statement found" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words, said",
    [
        (("release", "sacra"), "there is no exercise 'sacra'; there are: scara"),
        (("grade", "sacra"), "there is no exercise 'sacra'; there are: scara"),
        (("report", "sacra"), "there is no exercise 'sacra'; there are: scara"),
        (("feedback", "sacra"), "there is no exercise 'sacra'; there are: scara"),
        (("export", "--exercise", "sacra"), "there is no exercise 'sacra'; there are: scara"),
        (("grade", "scara", "--student", "zoe"), "'zoe' handed in nothing for scara; handed in: ann, ben"),
        (("report", "scara"), "nothing was graded for scara yet; run: autograder grade scara"),
        (("feedback", "scara"), "nothing was graded for scara yet; run: autograder grade scara"),
    ],
)
def test_unknown_names_list_what_exists(course_copy, small, released, capsys, words, said):
    small.hand_in(course_copy, "ann", released)
    small.hand_in(course_copy, "ben", released)
    assert run(course_copy, *words) == 2
    assert said in capsys.readouterr().err


def test_nobody_handed_in(empty_course, capsys):
    assert run(empty_course, "grade", "scara") == 2
    assert "nobody handed in anything" in capsys.readouterr().err


def test_not_released(course_copy, small, released, capsys):
    small.hand_in(course_copy, "ann", released)
    (course_copy / "gradebook.db").unlink()
    assert run(course_copy, "grade", "scara") == 2
    assert "scara is not in the gradebook; run: autograder release scara" in capsys.readouterr().err


def test_released_notebook_and_gradebook_must_agree(course_copy, small, released, capsys):
    small.hand_in(course_copy, "ann", released)
    path = course_copy / "exercises/scara/scara.ipynb"
    path.write_text(path.read_text().replace('"points": 10', '"points": 11'))
    assert run(course_copy, "grade", "scara") == 2
    assert "is not what the gradebook knows" in capsys.readouterr().err


@pytest.mark.slow
def test_without_a_sandbox_grading_is_refused(course_copy, small, released, capsys, monkeypatch):
    small.hand_in(course_copy, "ann", small.answered(released))
    monkeypatch.setattr("autograder.grading.plugins.autograde.available", lambda: "bubblewrap is missing")
    assert run(course_copy, "grade", "scara") == 2
    assert "no sandbox: bubblewrap is missing" in capsys.readouterr().err
    assert not (course_copy / "autograded").exists()
    assert run(course_copy, "grade", "scara", "--sandbox", "none") == 0
    output = capsys.readouterr()
    assert "20/20" in output.out and "no sandbox; students' code runs with your rights" in output.err


@pytest.mark.sandbox
def test_a_submission_that_cannot_be_judged_is_said_and_the_others_are_graded(
    course_copy, small, released, capsys, monkeypatch
):
    from autograder.grading.submission import judging

    for student in ("ann", "ben", "ev\x1bil"):
        small.hand_in(course_copy, student, small.answered(released))
    judge = judging.judge

    def broken(question, evidence, student, earlier):
        if student == "ann":
            raise ArithmeticError("the judge is ill")
        return judge(question, evidence, student, earlier)

    monkeypatch.setattr(judging, "judge", broken)
    assert run(course_copy, "grade", "scara") == 1
    out = capsys.readouterr().out
    assert "could not be judged: ArithmeticError: the judge is ill" in out and "20/20" in out
    assert "1 graded; 2 could not be judged" in out and "control characters; rename it" in out and "\x1b" not in out
    monkeypatch.undo()
    shutil.rmtree(course_copy / "submitted/ev\x1bil")
    assert run(course_copy, "grade") == 0
    assert "1 graded; 1 unchanged" in capsys.readouterr().out


def test_outside_a_course(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["grade", "scara"]) == 2
    assert "nbgrader_config.py" in capsys.readouterr().err
    assert run(tmp_path, "release") == 2
    assert "is not a course folder" in capsys.readouterr().err


@pytest.mark.sandbox
def test_a_course_is_found_from_a_folder_inside(course_copy, small, released, capsys, monkeypatch):
    small.hand_in(course_copy, "ann", released)
    monkeypatch.chdir(course_copy / "submitted/ann")
    assert cli.main(["grade", "scara", "--student", "zoe"]) == 2
    assert "handed in: ann" in capsys.readouterr().err


@pytest.mark.sandbox
def test_manual_points_stay_and_the_feedback_can_be_written_again(course_copy, small, released, capsys):
    from nbgrader.api import Gradebook

    small.hand_in(course_copy, "ann", released)
    assert run(course_copy, "grade", "scara") == 0
    with Gradebook(f"sqlite:///{course_copy}/gradebook.db") as gradebook:
        gradebook.find_grade("scara-T04", "scara", "scara", "ann").manual_score = 7
        gradebook.find_comment("scara-T04-answer", "scara", "scara", "ann").manual_comment = "see *me*"
        gradebook.db.commit()
    capsys.readouterr()
    assert run(course_copy, "feedback", "scara") == 0
    page = course_copy / "feedback/ann/scara/scara.html"
    assert capsys.readouterr().out.strip() == str(page)
    assert "7 of 20 points" in page.read_text() and "see <em>me</em>" in page.read_text()
    assert run(course_copy, "grade", "scara", "--force", "--json") == 0
    assert json.loads(capsys.readouterr().out)["score"] == 7


@pytest.fixture
def with_kit(course_copy, small):
    """A course with lectures beside its exercises, and with things that must not be handed out."""
    kit = course_copy / "course/dhkit"
    kit.mkdir(parents=True)
    (kit / "check.py").write_text("def check(): ...\n")
    for name in FOR_LECTURERS:
        (course_copy / name).write_text('{"cells": []}')
    (kit / "__pycache__").mkdir()
    (kit / "__pycache__/check.pyc").write_text("")
    (course_copy / "course/build/lib/dhkit").mkdir(parents=True)
    (course_copy / "course/build/lib/dhkit/check.py").write_text("def check(): ...\n")
    (kit / "scene/js/node_modules").mkdir(parents=True)
    (kit / "scene/js/node_modules/tool.js").write_text("")
    (course_copy / "course/dhkit.egg-info").mkdir()
    (course_copy / "course/dhkit.egg-info/PKG-INFO").write_text("")
    (course_copy / "course/secret").symlink_to(course_copy / "solutions")
    (course_copy / "course/gradebook").symlink_to(course_copy / "gradebook.db")
    return course_copy


@pytest.mark.slow
def test_the_bundle_holds_the_students_half_only(with_kit, small, tmp_path):
    target = tmp_path / "robots.zip"
    assert run(with_kit, "bundle", "--to", str(target)) == 0
    with zipfile.ZipFile(target) as archive:
        names = archive.namelist()
        text = b"".join(map(archive.read, names)).decode()
    assert sorted(names) == ["robots/README.md", "robots/course/dhkit/check.py", "robots/exercises/scara/scara.ipynb"]
    assert "SOLUTION" not in text and small.T04.splitlines()[-1] not in text
    first = target.read_bytes()
    os.utime(with_kit / "exercises/scara/scara.ipynb")
    assert run(with_kit, "bundle", "--to", str(target)) == 0 and target.read_bytes() == first


def test_the_bundle_knows_the_ids_and_names_nobody(with_kit, tmp_path):
    (with_kit / "students.csv").write_text("id,last_name\nada,Lovelace\nZoë O'Brien,\n", encoding="utf-8")
    assert run(with_kit, "bundle", "--to", str(tmp_path / "robots.zip")) == 0
    with zipfile.ZipFile(tmp_path / "robots.zip") as bundle:
        marks = bundle.read("robots/course/dhkit/ids.txt").decode().split()
        assert sorted(marks) == sorted(map(mark, ["ada", "zoe obrien"]))
        assert not [name for name in bundle.namelist() if b"Lovelace" in bundle.read(name)]


@pytest.mark.parametrize("leak", ["### BEGIN SOLUTION\\nT04 = 1\\n### END SOLUTION", "T04 = the_answer"])
def test_a_bundle_with_a_solution_is_refused(with_kit, tmp_path, capsys, leak):
    path = with_kit / "exercises/scara/scara.ipynb"
    text = path.read_text()
    path.write_text(text.replace('"T04 = ...\\n",\n    "# your code here"', f'"{leak}"'))
    assert path.read_text() != text
    assert run(with_kit, "bundle", "--to", str(tmp_path / "robots.zip")) == 2
    assert "run: autograder release" in capsys.readouterr().err
    assert not (tmp_path / "robots.zip").exists()


def test_the_repositorys_own_bundle_holds_no_solution(small, tmp_path):
    if not list(small.REPOSITORY.glob("exercises/*/*.ipynb")):
        pytest.skip("the exercises are not released yet")
    target = tmp_path / "robots.zip"
    assert run(small.REPOSITORY, "bundle", "--to", str(target)) == 0
    hidden, given = set(), set()
    for path in small.REPOSITORY.glob("solutions/*/*.ipynb"):
        for cell in nbformat.read(path, as_version=4).cells:
            for place, text in enumerate(re.split("### (?:BEGIN|END) SOLUTION", cell.source)):
                (hidden if place % 2 else given).update(line.strip() for line in text.splitlines())
    lines = hidden - given
    with zipfile.ZipFile(target) as archive:
        assert not {f"robots/{name}" for name in FOR_LECTURERS} & set(archive.namelist())
        for name in archive.namelist():
            assert name.split("/")[1] in ("README.md", "course", "exercises")
            if name.startswith("robots/exercises/"):
                text = archive.read(name).decode(errors="replace")
                assert not [line for line in lines if len(line) > 25 and json.dumps(line)[1:-1] in text]


@pytest.mark.sandbox
def test_doctor_finds_everything_here(small, capsys):
    assert run(small.REPOSITORY, "doctor") == 0
    out = capsys.readouterr().out
    for what in (
        "Python",
        "packages",
        "autograder",
        "dhkit",
        "alembic",
        "kernel",
        "sandbox",
        "warm kernels",
        "gradebook",
    ):
        assert f"ok       {what}: " in out


def test_doctor_says_what_is_missing(tmp_path, capsys, monkeypatch):
    (tmp_path / "requirements.txt").write_text(
        "nbgrader==0.1\nno-such-package==1.0  # why\nfor-older==2.0 ; python_version < '3.0'\n"
    )
    (tmp_path / "gradebook.db").write_text("not a database")
    monkeypatch.setattr("autograder.sandbox.available", lambda: "bubblewrap is missing")
    monkeypatch.setattr(doctor.sys, "executable", str(tmp_path / "python"))
    assert run(tmp_path, "doctor") == 1
    out = capsys.readouterr().out
    assert "nbgrader 0.9.6, pinned 0.1; no-such-package missing, pinned 1.0\n" in out
    assert "missing  sandbox: bubblewrap is missing" in out
    assert "missing  alembic" in out and "missing  gradebook" in out and "run: make setup" in out


@pytest.mark.sandbox
def test_an_interrupt_leaves_a_gradebook_and_no_kernel(course_copy, small, released, tmp_path):
    for number in range(4):
        small.hand_in(course_copy, f"loop{number}", small.answered(released, T04="while True: pass"))
    small.hand_in(course_copy, "a right one", small.answered(released))
    driver = tmp_path / "driver.py"
    driver.write_text(
        textwrap.dedent(
            """\
            import sys
            from autograder import cli, questions
            from autograder.judge import Question
            questions.find = lambda id: Question(id, "B")
            sys.exit(cli.main(sys.argv[1:]))
            """
        )
    )
    words = ["grade", "scara", "--course", str(course_copy), "--jobs", "2"]
    # A job in the background is started with Ctrl-C ignored, and hands that on: here it must be heard.
    listen = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    process = subprocess.Popen(
        [sys.executable, str(driver), *words], stderr=subprocess.PIPE, text=True, preexec_fn=listen
    )
    kernels = []
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and not (course_copy / "autograded/a right one/scara/scara.ipynb").exists():
        time.sleep(0.1)
    kernels = psutil.Process(process.pid).children(recursive=True)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=30)
    assert process.returncode == 130 and "interrupted" in said and "Traceback" not in said
    assert kernels and not psutil.wait_procs(kernels, timeout=10)[1]
    with sqlite3.connect(course_copy / "gradebook.db") as connection:
        assert connection.execute("pragma integrity_check").fetchone() == ("ok",)
        assert connection.execute("select count(*) from submitted_assignment").fetchone() == (1,)
    assert run(course_copy, "grade", "scara", "--student", "a right one") == 0
