"""The files of an exercise on one robot, in the folders where they belong."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path

import nbformat

from autograder.questions.shared import arm as asked
from autograder.questions.shared.configurations import why_not
from autograder.questions.shared.described import FILE, Described, describe
from autograder.questions.shared.pool import shown

from .from_urdf import robot_text
from .notebook import solution_notebook
from .public_half import public_half
from .students import made_students

_PUBLIC, _PRIVATE, _SOLUTIONS = "course/dhkit/questions", "autograder/questions", "solutions"
_STUDENTS = "tests/sample_class/students"

_MODULE = '''"""{title}: made by ``autograder new-exercise`` from {file}; add questions of your own to the tuple."""

from importlib import resources

from ..shared.arm import ask_about
from ..shared.described import describe

ARM = describe(resources.files(__package__).joinpath("{file}").read_text(encoding="utf-8"))
QUESTIONS = ask_about("{name}", ARM)
'''


@dataclass(frozen=True)
class Written:
    """What `write_exercise` did.

    Attributes
    ----------
    name : str
    files : tuple of Path
    left_out : str
        Why the inverse model is not asked for; empty if it is.
    """

    name: str
    files: tuple[Path, ...]
    left_out: str = ""


def write_exercise(root: Path, robot: Path, name: str | None = None, title: str | None = None) -> Written:
    """Write an exercise on the robot described in a file: a table, see `describe`, or a URDF.

    Parameters
    ----------
    root : Path
        The repository of the course.
    robot : Path
        Read as a URDF where it ends in ``.urdf`` or ``.xml``.
    name : str, optional
        What the exercise is called; by default the file's name.
    title : str, optional
        What the robot is called in the texts; by default what its file says.

    Raises
    ------
    ValueError
        If the robot or the name does not fit; nothing is written then.
    FileExistsError
        If there is such an exercise.
    OSError
        If the file cannot be read, or the folders are not there.
    """
    name = name or re.sub(r"\W+", "_", robot.stem).lower()
    if not name.isidentifier() or not name.islower():
        raise ValueError(
            f"{name!r} cannot be the name of an exercise: small letters, digits and underscores; say --name"
        )
    for folder in (_PUBLIC, _PRIVATE, _SOLUTIONS, _STUDENTS):
        if not (root / folder).is_dir():
            raise FileNotFoundError(
                f"{root / folder} is not there; new exercises are written into a clone of the course"
            )
    text = _text_of(robot, title)
    arm = describe(text)
    _complain(arm)
    questions = asked.ask_about(name, arm)
    kinds = [question.id.partition(".")[2] for question in questions]
    files = {
        root / _PUBLIC / f"{name}.toml": public_half(arm, kinds),
        root / _PUBLIC / f"{name}.json": json.dumps(shown(arm)) + "\n",
        root / _PRIVATE / name / FILE: text,
        root / _PRIVATE / name / "__init__.py": _MODULE.format(title=arm.title, file=FILE, name=name),
        root / _SOLUTIONS / name / f"{name}.ipynb": nbformat.writes(solution_notebook(name, arm, kinds)) + "\n",
        root / _STUDENTS / f"{name}.toml": made_students(name, arm, questions),
    }
    for path in files:
        if path.exists():
            raise FileExistsError(f"{path} is there already; say another --name")
    for path, content in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")
    return Written(name, tuple(files), "" if asked.SOLUTIONS in kinds else why_not(arm))


def _text_of(robot: Path, title: str | None) -> str:
    """The file of the exercise's robot, with another title where one is wished."""
    if robot.suffix.lower() in (".urdf", ".xml"):
        return robot_text(robot, title or "")
    text = robot.read_text(encoding="utf-8")
    if title is None:
        return text
    said = f"title = {json.dumps(title, ensure_ascii=False)}"
    return re.sub(r"^title\s*=.*$", lambda _: said, text, count=1, flags=re.MULTILINE)


def _complain(arm: Described) -> None:
    """Raise ValueError unless each joint stands in one row of its own, in order, as it is: statements speak of its axis."""
    stand = [row.variable for row in arm.table.moving]
    for number, (joint, variable) in enumerate(zip(arm.table.joints, stand), 1):
        if variable.diff(joint) != 1 or variable.free_symbols & set(arm.table.joints) != {joint}:
            raise ValueError(
                f"{FILE}: joint {number} stands in its row as {variable}, expected {joint} plus a constant; turn its Z axis round, or "
                "put joints in the order of the rows"
            )
    if len(stand) != len(arm.table.joints):
        raise ValueError(f"{FILE}: {len(arm.table.joints)} joints for {len(stand)} rows that have one")
