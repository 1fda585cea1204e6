"""A small course with three questions, and a class that hands in what classes hand in."""

import ast
import json
import os
import shutil
from contextlib import contextmanager
from copy import deepcopy
from html import escape
from pathlib import Path
from types import SimpleNamespace

import nbformat
import pytest
import sympy
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder import questions
from autograder.grading import crew, rendering
from autograder.grading.cells import check_cells, notebook_record, question_id
from autograder.grading.course import open_course
from autograder.grading.plugins.preprocessors import SandboxExecute
from autograder.grading.release import release
from autograder.grading.submission.execution import Execution
from autograder.judge import Evidence, Question, mistake
from autograder.sandbox import available
from dhkit import wire

REPOSITORY = Path(__file__).resolve().parents[2]
CHECKS = {"scara-T04": 10, "scara-d2_sign": 4, "scara-forward": 6}

T1, T2, T4, A2, A3, D2 = sympy.symbols("t1 t2 t4 a2 a3 d2")


def _transform(sign):
    total = T1 + T2 + T4
    x = A2 * sympy.cos(T1) + A3 * sympy.cos(T1 + T2)
    y = A2 * sympy.sin(T1) + A3 * sympy.sin(T1 + T2)
    c, s = sympy.cos(total), sympy.sin(total)
    return sympy.Matrix([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, sign * D2], [0, 0, 0, 1]])


def _forward(t1, t2, d2, t4, a2, a3):
    values = dict(zip((T1, T2, D2, T4, A2, A3), (t1, t2, d2, t4, a2, a3), strict=True))
    return _transform(-1).subs(values).evalf()


QUESTIONS = {
    question.id: question
    for question in (
        Question(
            "scara.T04",
            _transform(-1),
            (mistake("sign_of_d2", 0.5, "**The sign of d2.**", lambda answer: _transform(1)),),
        ),
        Question("scara.d2_sign", "B"),
        Question("scara.forward", _forward, probe=lambda rng: rng.uniform(0.1, 1, (4, 6)).tolist()),
    )
}

SETUP = "from sympy import Matrix, cos, sin, symbols\nfrom dhkit import check\n\nt1, t2, t4, a2, a3, d2 = symbols('t1 t2 t4 a2 a3 d2')"
T04 = """\
c, s = cos(t1 + t2 + t4), sin(t1 + t2 + t4)
x, y = a2*cos(t1) + a3*cos(t1 + t2), a2*sin(t1) + a3*sin(t1 + t2)
T04 = Matrix([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, -d2], [0, 0, 0, 1]])"""
FORWARD = """\
def forward(t1, t2, d2, t4, a2, a3):
    from math import cos, sin
    c, s = cos(t1 + t2 + t4), sin(t1 + t2 + t4)
    x, y = a2*cos(t1) + a3*cos(t1 + t2), a2*sin(t1) + a3*sin(t1 + t2)
    return [[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, -d2], [0, 0, 0, 1]]"""
ANSWERS = {"scara-T04": T04, "scara-d2_sign": "d2_sign = 'B'", "scara-forward": FORWARD}


def solution():
    """The instructor's notebook."""
    cells = [new_markdown_cell("# SCARA\n\nWith $x<y$.", id="title"), new_code_cell(SETUP, id="setup")]
    for check, points in CHECKS.items():
        name = check.partition("-")[2]
        marks = {"schema_version": 3, "grade": False, "solution": True, "locked": False, "grade_id": f"{check}-answer"}
        source = f"{name} = ...\n### BEGIN SOLUTION\n{ANSWERS[check]}\n### END SOLUTION"
        cells.append(new_code_cell(source, id=f"{check}-answer", metadata={"nbgrader": marks}))
        marks = {
            "schema_version": 3,
            "grade": True,
            "solution": False,
            "locked": True,
            "points": points,
            "grade_id": check,
        }
        source = f'check("{check.replace("-", ".", 1)}", {name})'
        cells.append(new_code_cell(source, id=check, metadata={"nbgrader": marks}))
        cells.append(new_markdown_cell(f"After {name}.", id=f"{check}-after"))
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return new_notebook(cells=cells, metadata={"kernelspec": kernel, "language_info": {"name": "python"}})


def cell(nb, grade_id):
    """The cell of `nb` with this nbgrader id."""
    return next(cell for cell in nb.cells if cell.metadata.get("nbgrader", {}).get("grade_id") == grade_id)


def answered(released, **answers):
    """`released` with every answer right, except those given here (None leaves the stub)."""
    nb = deepcopy(released)
    for check, source in {**ANSWERS, **{f"scara-{name}": source for name, source in answers.items()}}.items():
        if source is not None:
            cell(nb, f"{check}-answer").source = source
    return nb


@pytest.fixture(scope="session")
def small():
    """The helpers of this file, by name."""
    return SimpleNamespace(
        CHECKS=CHECKS,
        ANSWERS=ANSWERS,
        T04=T04,
        REPOSITORY=REPOSITORY,
        solution=solution,
        cell=cell,
        answered=answered,
        hand_in=hand_in,
    )


@pytest.fixture(scope="session")
def registry():
    """Grade with the questions above instead of the course's own."""
    patch = pytest.MonkeyPatch()
    patch.setattr(questions, "find", QUESTIONS.__getitem__)
    patch.setattr(crew, "FEW", 1000)  # other processes would know the course's own
    yield
    patch.undo()


@pytest.fixture(scope="session")
def empty_course(tmp_path_factory, registry):
    """Root of a released course that nobody handed in to."""
    root = tmp_path_factory.mktemp("course")
    shutil.copy(REPOSITORY / "nbgrader_config.py", root)
    (root / "solutions/scara").mkdir(parents=True)
    nbformat.write(solution(), root / "solutions/scara/scara.ipynb")
    release(open_course(root), "scara", "form")
    return root


@pytest.fixture(scope="session")
def released(empty_course):
    return nbformat.read(empty_course / "exercises/scara/scara.ipynb", as_version=4)


def hand_in(root, student, content, name="scara.ipynb"):
    """Put a notebook, a text or bytes into a student's folder."""
    folder = root / "submitted" / student / "scara"
    folder.mkdir(parents=True, exist_ok=True)
    if content is None:
        return folder
    if isinstance(content, nbformat.NotebookNode):
        content = json.dumps(content)
    (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    return folder


@pytest.fixture
def course_copy(empty_course, tmp_path):
    """A released course of one's own."""
    root = tmp_path / "course"
    shutil.copytree(empty_course, root)
    return root


def typed(source):
    """What an answer cell hands in without being run: the text behind its last ``=``; blank for anything else."""
    text = source.rpartition("=")[2].strip()
    try:
        return wire.encode(ast.literal_eval(text))
    except (SyntaxError, ValueError):
        return {"blank": True} if "undefined" not in text else None


def prepared(self, nb, folder, released, student, course):
    """What the sandbox would bring back of answers that are literals; ``undefined`` in one is an error."""
    sources = {cell.metadata.nbgrader.grade_id: cell.source for cell in nb.cells if "nbgrader" in cell.metadata}
    evidence = {}
    for check in check_cells(nb):
        answer = typed(sources[f"{check}-answer"])
        packet = wire.packet(question_id(check), answer=answer)
        evidence[check] = Evidence(packet) if answer else Evidence(None, None, "NameError: undefined", "error")
    return Execution(notebook_record(nb).submission, {}, evidence)


@pytest.fixture(scope="session")
def without_kernels(registry):
    """A context in which grading starts no process: answers are taken from their cells as they stand."""

    @contextmanager
    def context():
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(SandboxExecute, "run", prepared)
            patch.setattr(SandboxExecute, "find_fault", lambda *settings: None)
            for module in ("plugins.autograde", "explain"):
                patch.setattr(f"autograder.grading.{module}.available", lambda: None)
            patch.setattr(rendering.RENDERER, "render", lambda kind, text, *more: f"<pre>{escape(text)}</pre>")
            yield

    return context


@pytest.fixture(scope="session")
def needs_sandbox():
    """Skips where there is no sandbox to be had."""
    if reason := available():
        pytest.skip(reason)


@pytest.fixture(autouse=True)
def same_folder():
    """nbgrader changes folders; no test may leave the process somewhere else."""
    here = os.getcwd()
    yield
    assert os.getcwd() == here
