"""A machine that plays the newcomer: it types what CONTRIBUTING.md says into a copy of the repository, and runs what it says.

Cells are written as JupyterLab with nbgrader's *Create Assignment* writes them. What a recipe does not say is not done.
"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import uuid
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import nbformat
import pytest
from expected import Submission, submissions
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from write import hand_in

ROOT = Path(__file__).parents[1]
MANUAL = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
FOLDERS = ("autograder", "course", "docs", "exercises", "solutions", "tests")
QUESTION, KIND, ROBOT, EXERCISE = (
    f"Adding {thing}" for thing in ("a question", "a kind of answer", "a robot", "an exercise")
)
TUPLE_END = "\n)\n"
SOME = ("begun", "mistakes-lengths")
NAMES = re.compile(r"^\[\w+\]|^def \w+", re.M)  # of questions and robots
PYTHON_3 = {"kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}}


@dataclass(frozen=True)
class Block:
    """A block of code in the manual, and the words above it, which say where it goes."""

    said: str
    language: str
    text: str


def recipe(title: str) -> list[Block]:
    """The blocks of a section of the manual."""
    parts = re.split(r"^```(\w*)\n(.*?)^```\n", MANUAL, flags=re.M | re.S)
    section, blocks = "", []
    for said, language, text in zip(parts[::3], parts[1::3], parts[2::3]):
        _, heading, after = said.rpartition("\n## ")
        section = after.partition("\n")[0] if heading else section
        if section == title:
            blocks.append(Block(after, language, text))
    assert blocks, f"the manual has no section {title!r}"
    return blocks


def named(words: str, said: str) -> str | None:
    """What stands in backticks behind these words, None if they are not said."""
    found = re.search(rf"{words} `([^`]+)`", " ".join(said.split()), re.I)
    return found and found[1]


def cell(block: Block) -> nbformat.NotebookNode:
    """The cell as JupyterLab saves it."""
    if block.language == "markdown":
        made = new_markdown_cell(block.text.strip())
    else:
        made = new_code_cell(block.text.strip(), metadata=marks(" ".join(block.said.split())))
    made["id"] = str(uuid.uuid4())
    return made


def marks(said: str) -> dict:
    """The metadata of a code cell, as the side bar of *Create Assignment* writes it."""
    answer, tests = "*Autograded answer*" in said, "*Autograded tests*" in said
    if not (answer or tests):
        return {}
    made = {
        "grade": tests,
        "grade_id": named("ID", said),
        "locked": tests,
        "schema_version": 3,
        "solution": answer,
        "task": False,
    }
    points = {"points": float(re.search(r"(\d+) points?\b", said)[1])} if tests else {}
    return {"nbgrader": made | points}


class Newcomer:
    """Somebody with a copy of the repository, who does what the manual says and nothing else."""

    def __init__(self, root: Path) -> None:
        self.root = root
        for folder in FOLDERS:
            shutil.copytree(
                ROOT / folder, root / folder, ignore=shutil.ignore_patterns(".ipynb_checkpoints", "node_modules")
            )
        for file in ROOT.iterdir():
            if file.is_file() and not file.name.startswith(".") and file.suffix in (".md", ".toml", ".py", ".txt", ""):
                shutil.copy(file, root)
        self.typed: dict[str, int] = {}  # file -> lines typed into it
        self.notebook = ""

    def follow(self, blocks: list[Block]) -> None:
        for block in blocks:
            if block.language == "console":
                for line in block.text.splitlines():
                    self.run(*shlex.split(line))
            else:
                place = self.type(block)
                self.typed[place] = self.typed.get(place, 0) + len(block.text.splitlines())

    def type(self, block: Block) -> str:
        """Type a block where the words above it say; returns the file."""
        if place := named("new file", block.said):
            (self.root / place).parent.mkdir(parents=True, exist_ok=True)
            return self.write(place, block, lambda text: block.text)
        if place := named("as the last of `QUESTIONS` in", block.said):
            return self.write(place, block, lambda text: f"{text.removesuffix(TUPLE_END)}\n{block.text})\n")
        if place := named("at the end of", block.said):
            gap = "\n\n" if place.endswith(".py") else "\n"
            return self.write(place, block, lambda text: f"{text}{gap}{block.text}")
        return self.type_cell(block)

    def write(self, place: str, block: Block, change: Callable[[str], str]) -> str:
        file = self.root / place
        text = file.read_text(encoding="utf-8") if file.exists() else ""
        new = "new file" in block.said
        if text and (new or set(NAMES.findall(block.text)) & set(NAMES.findall(text))):
            pytest.skip(f"{place} has it already: somebody followed this recipe here")
        file.write_text(change(text), encoding="utf-8")
        return place

    def type_cell(self, block: Block) -> str:
        if new := named(r"new notebook\W*", block.said):
            self.notebook = new
            (self.root / new).parent.mkdir(parents=True)
            nbformat.write(new_notebook(metadata=PYTHON_3), self.root / new)
        self.notebook = named("end of the notebook", block.said) or self.notebook
        nb = nbformat.read(self.root / self.notebook, as_version=4)
        nb.cells.append(cell(block))
        nbformat.write(nb, self.root / self.notebook)
        return self.notebook

    def run(self, program: str, *words: str) -> str:
        """Run a command of the manual in the copy; what it printed."""
        return self.python("-m", {"autograder": "autograder.cli", "pytest": "pytest"}[program], *words)

    def python(self, *words: str) -> str:
        here = {"PYTHONPATH": os.pathsep.join(str(self.root / each) for each in ("", "course", "autograder/solver"))}
        done = subprocess.run(
            [sys.executable, *words], cwd=self.root, env=os.environ | here, capture_output=True, text=True
        )
        assert done.returncode == 0, f"{' '.join(words)}:\n{done.stdout[-5000:]}\n{done.stderr[-3000:]}"
        return done.stdout

    def grade(self, *students: Submission) -> dict[str, dict[str, str]]:
        """Hand in what these students do, and grade it; student -> question -> note."""
        for one in students:
            source = json.loads(
                (self.root / f"solutions/{one.exercise}/{one.exercise}.ipynb").read_text(encoding="utf-8")
            )
            place = self.root / "submitted" / one.student / one.exercise
            place.mkdir(parents=True)
            for name, content in hand_in(one, source).items():
                (place / name).write_bytes(content)
        printed = self.run("autograder", "grade", "--sandbox", "none", "--json")
        lines = [json.loads(line) for line in printed.splitlines()]
        return {line["student"]: {answer["question"]: answer["note"] for answer in line["answers"]} for line in lines}


@pytest.fixture
def newcomer(tmp_path):
    return Newcomer(tmp_path / "repository")


@pytest.mark.slow
def test_a_question(newcomer):
    newcomer.follow(recipe(QUESTION))
    assert len(newcomer.typed) <= 3 and sum(newcomer.typed.values()) <= 30
    begun, answered = (one for one in submissions() if one.exercise == "planar_2r" and one.student in SOME)
    notes = newcomer.grade(begun, answered)
    for one in (begun, answered):  # nothing in the sample class says a word about the new question
        assert notes[one.student] == {id: one.expected(id.partition(".")[2])[0] for id in notes[one.student]}
    assert [notes[name]["planar_2r.elbow"] for name in SOME] == ["not_attempted", "right"]


@pytest.mark.slow
def test_a_manual_that_forgets_to_say_something_is_noticed(newcomer):
    blocks = [block for block in recipe(QUESTION) if block.language != "console"]
    newcomer.follow([replace(block, text=block.text.replace(" (1 point)", "")) for block in blocks])
    with pytest.raises(AssertionError, match=r"'## Title \(n points\)'"):
        newcomer.run("pytest", "tests/course", "-k", "planar_2r")


@pytest.mark.slow
def test_a_kind_of_answer(newcomer):
    newcomer.follow(recipe(KIND))
    code = "turn = [-cos((t1 + t2) / 2), 0, 0, -sin((t1 + t2) / 2)]"
    notes = newcomer.grade(Submission("planar_2r", "other sign", "", answered=(), answers={"turn": code}))
    assert notes["other sign"]["planar_2r.turn"] == "right"


@pytest.mark.slow
def test_a_robot(newcomer):
    newcomer.follow(recipe(ROBOT))
    asked = (
        "from autograder.reference import robots; print(*robots.UR5.forward([0] * 6)[:3, 3], robots.UR5.has_inverse)"
    )
    *hand, has_inverse = newcomer.python("-c", asked).split()
    assert [float(x) for x in hand] == pytest.approx([-0.81725, -0.19145, -0.00549]), (
        "the data sheet's own zero position"
    )
    assert has_inverse == "True"


@pytest.mark.slow
def test_an_exercise(newcomer):
    newcomer.follow(recipe(EXERCISE))
    assert newcomer.grade(Submission("velocities", "ada", "")) == {"ada": {"velocities.jacobian": "right"}}
