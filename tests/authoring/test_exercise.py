"""An exercise on any robot: what is written loads, right answers are right, every mistake is named, by the same judge as ever."""

import tomllib
from pathlib import Path

import nbformat
import pytest
from answers import evidence

from autograder.authoring import write_exercise
from autograder.authoring.exercise import public_half
from autograder.judge import judge
from autograder.questions.shared.arm import all_postures, ask_about
from autograder.questions.shared.described import describe
from dhkit import public

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
ROBOTS = sorted((ROOT / "docs/robots").glob("*.toml"))
SOLUTIONS = {"arm_3r": 4, "franka": None, "gantry": 1, "irb120": 8, "scara_t6": 2, "ur5e": 8}


def asked_of(robot, monkeypatch):
    """The questions on a robot, with their public half where the kit looks for it."""
    arm = describe(robot.read_text())
    questions = ask_about("mine", arm)
    tables = tomllib.loads(public_half(arm, [question.id.partition(".")[2] for question in questions]))
    halves = {f"mine.{name}": public.from_table(f"mine.{name}", table) for name, table in tables.items()}
    monkeypatch.setattr(public, "questions", lambda: halves)
    return arm, questions


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.stem)
def test_right_answers_are_right_and_mistakes_are_named(robot, monkeypatch):
    arm, questions = asked_of(robot, monkeypatch)
    found = all_postures(arm)
    assert (found and len(found)) == SOLUTIONS[robot.stem]
    for question in questions:
        assert judge(question, evidence(question, question.answer("ada"), "ada"), "ada").note == "right", question.id
        assert len(question.mistakes) >= 1
        for node in question.mistakes:
            verdict = judge(question, evidence(question, question.answer("ada", node.ways[0]), "ada"), "ada")
            assert (verdict.note, verdict.share) == (node.note, node.share), question.id


def test_the_files_stand_where_they_belong_and_nothing_is_overwritten(tmp_path):
    for folder in ("course/dhkit/questions", "autograder/questions", "solutions"):
        (tmp_path / folder).mkdir(parents=True)
    written = write_exercise(tmp_path, ROOT / "docs/robots/gantry.toml")
    assert [path.relative_to(tmp_path).as_posix() for path in written.files] == [
        "course/dhkit/questions/gantry.toml",
        "autograder/questions/gantry/robot.toml",
        "autograder/questions/gantry/__init__.py",
        "solutions/gantry/gantry.ipynb",
    ]
    notebook = nbformat.read(written.files[-1], as_version=4)
    nbformat.validate(notebook)
    checks = [cell for cell in notebook.cells if cell.source.startswith("check(")]
    assert len(checks) == 5 and sum(cell.metadata.nbgrader.points for cell in checks) == 20
    compile(written.files[2].read_text(), "module", "exec")
    with pytest.raises(FileExistsError, match="another --name"):
        write_exercise(tmp_path, ROOT / "docs/robots/gantry.toml")
    assert "no posture" in write_exercise(tmp_path, ROOT / "docs/robots/franka.toml", "panda").left_out


def test_what_is_not_written_leaves_nothing(tmp_path):
    with pytest.raises(FileNotFoundError, match="clone of the course"):
        write_exercise(tmp_path, ROOT / "docs/robots/gantry.toml")
    for folder in ("course/dhkit/questions", "autograder/questions", "solutions"):
        (tmp_path / folder).mkdir(parents=True)
    with pytest.raises(ValueError, match="--name"):
        write_exercise(tmp_path, ROOT / "docs/robots/gantry.toml", "My arm")
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


GOOD = 'title = "x"\njoints = ["q1"]\nrows = [[0, 0, 0, "h", "q1"]]\n[lengths]\nh = 0.3\n'


@pytest.mark.parametrize("text, said", [
    (GOOD.replace('"h"', '"k"'), "row 1: 'k' is neither a joint nor a length"),
    (GOOD.replace('"h"', '"h ** 9"'), "row 1: 'h \\*\\* 9' is not made of numbers"),
    (GOOD.replace('"h"', '"__import__(1)"'), "is not made of numbers"),
    (GOOD.replace('"h"', '"h +"'), "row 1: 'h \\+' is no formula"),
    (GOOD.replace('"h"', '"' + "(" * 500 + '"'), "is no formula"),
    (GOOD.replace('["q1"]', '["q1", "h"]'), "h is named twice"),
    (GOOD.replace('["q1"]', '["q 1"]'), "'q 1' cannot be a letter"),
    (GOOD.replace("title", "titel"), "titel"),
    (GOOD.replace("joints", "posture = [1, 2]\njoints"), "posture: expected 1 values"),
    (GOOD.replace("[[0", "[[2"), "sigma"),
    ("title = ", "robot.toml: "),
])  # fmt: skip
def test_what_does_not_fit_is_named(text, said):
    with pytest.raises(ValueError, match=said):
        describe(text)
