"""CONTRIBUTING.md shows how to add a question in under 30 lines: here a machine follows it to the letter."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "CONTRIBUTING.md").read_text()
TOML = re.findall(r"```toml\n(.*?)```", TEXT, re.S)
PRIVATE, ANSWER, CHECK = re.findall(r"```python\n(.*?)```", TEXT, re.S)

TRIAL = """
import sympy
from autograder.judge import Evidence, judge
from autograder.questions import find
from dhkit import wire

t1, L1 = sympy.symbols("t1 L1")
x, y = L1 * sympy.cos(t1), L1 * sympy.sin(t1)
for answer in ([x, y], [y, x], [x, x], ...):
    packet = wire.packet("planar_2r.elbow", answer=wire.encode(answer))
    print(judge(find("planar_2r.elbow"), Evidence(packet), "ada").note)
"""


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    root = tmp_path_factory.mktemp("repository")
    for folder in ("autograder", "course", "solutions"):
        shutil.copytree(ROOT / folder, root / folder, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "nbgrader_config.py", root)
    with (root / "course/dhkit/questions/planar_2r.toml").open("a") as file:
        file.write("\n" + TOML[0])
    with (root / "autograder/questions/planar_2r/__init__.py").open("a") as file:
        file.write("\n" + PRIVATE)
    return root


def run(copy, *args):
    environment = {"PYTHONPATH": f"{copy}:{copy / 'course'}", "PATH": f"{Path(sys.executable).parent}:/usr/bin:/bin"}
    return subprocess.run(
        [sys.executable, *args], cwd=copy, env=environment, capture_output=True, text=True, check=True
    ).stdout


def test_it_takes_fewer_than_thirty_lines():
    assert sum(len(block.splitlines()) for block in (TOML[0], PRIVATE, ANSWER, CHECK)) < 30


def test_the_question_is_judged(copy):
    assert run(copy, "-c", TRIAL).split() == ["right", "x_and_y_exchanged", "partly_right", "not_attempted"]


def test_the_question_is_released(copy):
    source = copy / "solutions/planar_2r/planar_2r.ipynb"
    notebook = nbformat.read(source, as_version=4)
    kinds = {"planar_2r-elbow-answer": (ANSWER, False), "planar_2r-elbow": (CHECK, True)}
    for id, (code, graded) in kinds.items():
        data = {
            "grade_id": id,
            "grade": graded,
            "solution": not graded,
            "locked": graded,
            "task": False,
            "schema_version": 3,
        }
        cell = nbformat.v4.new_code_cell(code.strip(), metadata={"nbgrader": data | ({"points": 1} if graded else {})})
        notebook.cells.append(cell)
    nbformat.write(notebook, source)
    run(copy, "-m", "autograder.cli", "release", "planar_2r")
    released = (copy / "exercises/planar_2r/planar_2r.ipynb").read_text()
    assert "planar_2r.elbow" in released and "L1 * cos(t1), L1 * sin(t1)" not in released
