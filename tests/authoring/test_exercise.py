"""An exercise on any robot: what is written loads, right answers are right, every mistake is named, by the same judge as ever."""

import json
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import nbformat
import numpy as np
import pytest
from answers import STUDENT, mistaken, right, verdict

from autograder.authoring import write_exercise
from autograder.authoring.from_urdf import robot_text
from autograder.authoring.public_half import public_half
from autograder.judge import Family
from autograder.questions.shared import singular, sweep
from autograder.questions.shared.arm import ask_about
from autograder.questions.shared.configurations import all_solutions, configuration, residual, standing
from autograder.questions.shared.described import describe
from autograder.reference import table_from_urdf_file
from dhkit import public

ROOT = Path(__file__).parents[2]
ROBOTS = sorted((ROOT / "docs/robots").glob("*.toml"))
SOLUTIONS = {"arm_3r": 4, "franka": Family, "gantry": 1, "irb120": 8, "scara_t6": 2, "ur5e": 8}
FREEDOMS = {
    "arm_3r": {3, 2},
    "franka": {6, 5},
    "gantry": {4},
    "irb120": {6, 5},
    "scara_t6": {4, 3},
    "ur5e": {6, 5},
}


@pytest.mark.slow
@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.stem)
def test_right_answers_are_right_and_mistakes_are_named(robot, monkeypatch):
    arm = describe(robot.read_text())
    questions = ask_about("mine", arm)
    kinds = [question.id.partition(".")[2] for question in questions]
    tables = tomllib.loads(public_half(arm, kinds))
    halves = {f"mine.{name}": public.from_table(f"mine.{name}", table) for name, table in tables.items()}
    monkeypatch.setattr(public, "questions", lambda: halves)
    found, expected = all_solutions(arm), SOLUTIONS[robot.stem]
    assert isinstance(found, Family) if expected is Family else len(found) == expected
    assert set(singular.ranks(arm)) == FREEDOMS[robot.stem]
    assert residual(arm, np.array([standing(arm)])) > 0.01, "a statement tells no solution"
    assert ("determinant" in kinds) == (robot.stem in ("arm_3r", "scara_t6"))
    for question in questions:
        assert verdict(question, given(question)).note == "right", question.id
        assert len(question.mistakes) >= 2, question.id
        for node in question.mistakes:
            told = verdict(question, given(question, node.ways[0]))
            assert (told.note, told.share) == (node.note, node.share), question.id


def given(question, *ways):
    if question.form.kind == "function":
        return question.answer(STUDENT, *ways)
    return mistaken(question, *ways) if ways else right(question)


def test_without_a_configuration_in_the_file_one_is_chosen_away_from_singular_ones():
    arm = describe((ROOT / "docs/robots/scara_t6.toml").read_text().replace("posture", "# posture"))
    q = np.array(configuration(arm))
    assert singular.freedoms(arm, q) == 4 and abs(np.sin(q[1])) > 0.1
    assert residual(arm, np.array(all_solutions(arm))).max() < 1e-9


def test_the_reach_of_a_sweep_is_that_of_a_fine_grid():
    arm = describe((ROOT / "docs/robots/scara_t6.toml").read_text())
    swept = sweep.sweep_of(arm)
    grid = np.meshgrid(*(np.linspace(*limits, 1500) for limits in swept.ranges))
    far = np.hypot(*np.moveaxis(arm.table.forward(swept.values(*grid))[..., :2, 3], -1, 0))
    assert sweep.reach(arm, swept) == pytest.approx([far.min(), far.max()], abs=1e-5)


EMPTY = ("course/dhkit/questions", "autograder/questions", "solutions", "tests/sample_class/students")


def empty_course(folder):
    for name in EMPTY:
        (folder / name).mkdir(parents=True)
    return folder


@pytest.mark.slow
def test_the_files_stand_where_they_belong_and_nothing_is_overwritten(tmp_path):
    written = write_exercise(empty_course(tmp_path), ROOT / "docs/robots/gantry.toml", title="Our gantry")
    assert [path.relative_to(tmp_path).as_posix() for path in written.files] == [
        "course/dhkit/questions/gantry.toml",
        "course/dhkit/questions/gantry.json",
        "autograder/questions/gantry/robot.toml",
        "autograder/questions/gantry/__init__.py",
        "solutions/gantry/gantry.ipynb",
        "tests/sample_class/students/gantry.toml",
    ]
    notebook = nbformat.read(written.files[4], as_version=4)
    nbformat.validate(notebook)
    assert notebook.cells[0].source.startswith("# Exercise: Our gantry\n")
    checks = [cell for cell in notebook.cells if cell.source.startswith("check(")]
    assert len(checks) == 9 and written.left_out == ""
    compile(written.files[3].read_text(), "module", "exec")
    students = tomllib.loads(written.files[5].read_text())["gantry"]
    assert "right" in students and students["mistakes-1"]["notes"]["table"] == ["classic_table", 0.3]
    with pytest.raises(FileExistsError, match="another --name"):
        write_exercise(tmp_path, ROOT / "docs/robots/gantry.toml")


URDF = """<robot name="bench arm">
  <link name="base"/><link name="a"/><link name="b"/><link name="c"/><link name="tool"/>
  <joint name="1" type="revolute"><parent link="base"/><child link="a"/>
    <origin xyz="0 0 0.3"/><axis xyz="0 0 1"/><limit lower="-3" upper="3"/></joint>
  <joint name="2" type="revolute"><parent link="a"/><child link="b"/>
    <origin xyz="0.05 0 0"/><axis xyz="0 -1 0"/><limit lower="-2" upper="2"/></joint>
  <joint name="3" type="revolute"><parent link="b"/><child link="c"/>
    <origin xyz="0.4 0 0"/><axis xyz="0 -1 0"/><limit lower="-2" upper="2"/></joint>
  <joint name="end" type="fixed"><parent link="c"/><child link="tool"/><origin xyz="{xyz}" rpy="{rpy}"/></joint>
</robot>
"""


@pytest.mark.parametrize(
    ("xyz", "rpy", "rows"),
    [
        ("0.35 0 0", "0 0 0", 4),
        ("0.3 0.02 -0.1", "0.4 -0.7 1.1", 4),
        ("0 -0.1 0", "1.5707963267948966 0 0", 3),
        ("0 0 0", "0 0 0", 4),
    ],
)
def test_a_urdf_becomes_a_table_of_letters_with_the_same_poses(tmp_path, xyz, rpy, rows):
    file = tmp_path / "bench.urdf"
    file.write_text(URDF.format(xyz=xyz, rpy=rpy))
    arm, table = describe(robot_text(file)), table_from_urdf_file(file)
    assert arm.title == "bench arm" and {"d1", "a2", "a3"} <= set(arm.table.values)
    assert len(arm.table.rows) == rows, "no row for a tool that slides and turns along the last axis"
    base = np.array(table.base, float)
    for q in np.random.default_rng(0).uniform(-2, 2, (5, 3)):
        np.testing.assert_allclose(base @ arm.table.forward(q), table.forward(q), atol=1e-6)


SLIDES = """title = "three slides"
joints = ["q1", "q2", "q3"]
rows = [[1, 0, 0, "q1", 0], [1, 0, "-pi/2", "q2", "-pi/2"], [1, 0, "-pi/2", "q3", 0]]
"""


def test_of_small_robots_is_asked_what_they_have():
    kinds = lambda text: [question.id.partition(".")[2] for question in ask_about("mine", describe(text))]  # noqa: E731
    assert kinds(GOOD) == ["table", "T0E", "forward", "ranks"]
    assert kinds(GOOD.replace('"q1"]]', '"q1"], [0, "h", 0, 0, 0]]')) == ["table", "T0E", "forward", "ranks"]
    assert kinds(SLIDES) == ["table", "T12", "U1", "T0E", "forward", "solutions", "cloud", "reach"]


def test_what_is_not_written_leaves_nothing(tmp_path):
    with pytest.raises(FileNotFoundError, match="clone of the course"):
        write_exercise(tmp_path, ROOT / "docs/robots/gantry.toml")
    empty_course(tmp_path)
    with pytest.raises(ValueError, match="--name"):
        write_exercise(tmp_path, ROOT / "docs/robots/gantry.toml", "My arm")
    turned = tmp_path / "turned.toml"
    turned.write_text(GOOD.replace('"q1"]]', '"-q1"]]'))
    with pytest.raises(ValueError, match="joint 1 stands in its row as -q1, expected q1"):
        write_exercise(tmp_path, turned)
    turned.unlink()
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


COPIED = ("autograder", "course", "docs", "exercises", "solutions", "tests", "nbgrader_config.py", "pyproject.toml")


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    """A copy of the course with an exercise in it, made as a lecturer makes it; a function runs Python there."""
    root = tmp_path_factory.mktemp("clone")
    for name in COPIED:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copyfile
        copy(ROOT / name, root / name)
    places = os.pathsep.join(str(root / place) for place in (".", "course", "autograder/solver"))

    def run(*words, cwd=root):
        done = subprocess.run(
            [sys.executable, *map(str, words)],
            cwd=cwd,
            capture_output=True,
            text=True,
            env=os.environ | {"PYTHONPATH": places},
        )
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
        return done.stdout

    run("-m", "autograder.cli", "new-exercise", ROOT / "docs/robots/arm_3r.toml")
    return root, run


@pytest.mark.slow
def test_a_new_exercise_passes_the_tests_of_our_own(clone):
    _, run = clone
    own = (
        "tests/questions/test_every_question.py",
        "tests/questions/test_pool.py",
        "tests/course/test_course_notebooks.py",
    )
    run("-m", "pytest", "-m", "not slow", "-k", "arm_3r", "-p", "no:cacheprovider", *own)  # no such test: an error


@pytest.mark.slow
@pytest.mark.sandbox
def test_its_students_earn_what_they_should(clone, tmp_path):
    root, run = clone
    write = "from pathlib import Path; from write import write_class; write_class(Path('{}'), sparse=True, exercise='arm_3r')"
    run("-c", write.format(tmp_path / "class"), cwd=root / "tests/sample_class")
    chosen = {
        "right",
        "mistakes-1",
        "mistakes-2",
    }  # the mistakes of the others are named in the first test, without a kernel
    for folder in (tmp_path / "class/submitted").iterdir():
        if folder.name not in chosen:
            shutil.rmtree(folder)
    run("-m", "autograder.cli", "release", "arm_3r", "--home", "form", "--yes", cwd=tmp_path / "class")
    # Without a sandbox, which knows the installed kit only; these students are ours.
    lines = run(
        "-m", "autograder.cli", "grade", "arm_3r", "--json", "--sandbox", "none", cwd=tmp_path / "class"
    ).splitlines()
    students = tomllib.loads((root / "tests/sample_class/students/arm_3r.toml").read_text())["arm_3r"]
    told = {line["student"]: line["answers"] for line in map(json.loads, lines)}
    assert told.keys() == chosen
    for student, made in ((name, students[name]) for name in chosen):
        for answer in told[student]:
            note = made.get("notes", {}).get(answer["question"].partition(".")[2])
            blank = "not_attempted" if "answered" in made else "right"
            assert answer["note"] == (note[0] if note else blank), (student, answer["question"])
    assert len({answer["note"] for answers in told.values() for answer in answers}) > 15


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
