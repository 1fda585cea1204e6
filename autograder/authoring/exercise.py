"""The files of an exercise on one robot, in the folders where they belong."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import nbformat

from autograder.questions.shared import arm as asked
from autograder.questions.shared.described import FILE, Described, describe

from .notebook import solution_notebook

_PUBLIC, _PRIVATE, _SOLUTIONS = "course/dhkit/questions", "autograder/questions", "solutions"

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


def write_exercise(root: Path, robot: Path, name: str | None = None) -> Written:
    """Write an exercise on the robot described in a file, see `describe`.

    Parameters
    ----------
    root : Path
        The repository of the course.
    robot : Path
    name : str, optional
        What the exercise is called; by default the file's name.

    Raises
    ------
    ValueError
        If the robot or the name does not fit; nothing is written then.
    FileExistsError
        If there is such an exercise.
    OSError
        If the file cannot be read, or the folders are not there.
    """
    name = name or robot.stem.replace("-", "_")
    if not name.isidentifier() or not name.islower():
        raise ValueError(
            f"{name!r} cannot be the name of an exercise: small letters, digits and underscores; say --name"
        )
    for folder in (_PUBLIC, _PRIVATE, _SOLUTIONS):
        if not (root / folder).is_dir():
            raise FileNotFoundError(
                f"{root / folder} is not there; new exercises are written into a clone of the course"
            )
    text = robot.read_text(encoding="utf-8")
    arm = describe(text)
    questions = asked.ask_about(name, arm)
    kinds = [question.id.partition(".")[2] for question in questions]
    files = {
        root / _PUBLIC / f"{name}.toml": public_half(arm, kinds),
        root / _PRIVATE / name / FILE: text,
        root / _PRIVATE / name / "__init__.py": _MODULE.format(title=arm.title, file=FILE, name=name),
        root / _SOLUTIONS / name / f"{name}.ipynb": nbformat.writes(solution_notebook(name, arm, kinds)) + "\n",
    }
    for path in files:
        if path.exists():
            raise FileExistsError(f"{path} is there already; say another --name")
    for path, content in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")
    return Written(name, tuple(files), "" if asked.POSTURES in kinds else why_not(arm))


def why_not(arm: Described) -> str:
    """Why the inverse model of an arm is not asked for, in words."""
    if not arm.posture:
        return f"{FILE} has no posture whose pose could be asked back"
    if not arm.robot.has_inverse:
        try:
            arm.robot.inverse_model  # noqa: B018
        except ValueError as error:
            return str(error)
    found = arm.robot.inverse(arm.target)
    return f"its pose is {found.status.value}: {found.reason or 'there is no end of solutions'}"


def public_half(arm: Described, kinds: list[str]) -> str:
    """The file of what is asked: one table for each question."""
    tables = {kind: _about(arm, kind) for kind in kinds}
    lines = [f"# {arm.title}: what is asked; made by autograder new-exercise."]
    for kind, fields in tables.items():
        nested = {key: value for key, value in fields.items() if isinstance(value, Mapping)}
        lines += ["", f"[{kind}]", *_entries({key: value for key, value in fields.items() if key not in nested})]
        for key, value in nested.items():
            lines += ["", f"[{kind}.{key}]", *_entries(value)]
        if kind in (asked.RECURSION, asked.TRANSFORM):
            says = "the rotation block is a rotation and the last row is 0 0 0 1"
            lines += ["", f"[[{kind}.public]]", *_entries({"name": "rigid_transform", "says": says})]
    return "\n".join(lines) + "\n"


def _entries(fields: Mapping[str, object]) -> Iterator[str]:
    """Lines of TOML, which writes texts, numbers and lists as JSON does."""
    return (f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in fields.items())


def _about(arm: Described, kind: str) -> dict[str, object]:
    """The table of one question."""
    letters, joints, count = arm.letters, arm.joints, len(arm.table.rows)
    units = "lengths in metres, angles in radians"
    matrix = {"kind": "transform", "shape": [4, 4], "symbols": letters, "units": units}
    if kind == asked.TABLE:
        return {
            "title": "DHm table",
            "kind": "dh_table",
            "shape": [count, 5],
            "symbols": letters,
            "joints": joints,
            "units": units,
            "expected": f"{count} rows [sigma, a, alpha, d, theta]",
            "hints": [
                "Fill one column at a time. sigma: which joint slides? alpha: how is each Z axis turned against the one before it?",
                "In row i, a and alpha belong to the link before joint i, along and about X_(i-1); d and theta are counted along and about Z_i.",
            ],
            "minutes": 5 + 2 * count,
        }
    if kind == asked.RECURSION:
        return {
            "title": f"The end effector seen from frame 1, 1T{count}",
            **matrix,
            "expected": f"a 4x4 sympy Matrix in {', '.join(letters[1:])}",
            "hints": ["One matrix for each row, the product from left to right, without the first one."],
            "minutes": 4 + count,
        }
    if kind == asked.TRANSFORM:
        return {
            "title": f"From the base to the end effector, 0T{count}",
            **matrix,
            "expected": f"a 4x4 sympy Matrix in {', '.join(letters)}",
            "hints": ["One step is left: 0T1 times what you have."],
            "minutes": 5,
        }
    if kind == asked.FORWARD:
        return {
            "title": "Forward model as a function",
            "kind": "function",
            "units": units,
            "expected": f"a function forward({', '.join(joints)}) that returns a 4x4 array of numbers",
            "hints": [
                "Multiply numeric matrices, or put numbers into your symbolic matrix; lengths are those of the statement."
            ],
            "minutes": 10,
            "returns": {"kind": "transform", "decimals": 4, "shape": [4, 4], "expected": "a 4x4 array of numbers"},
        }
    return {
        "title": f"Every way to reach a {'point' if asked.is_for_point(arm) else 'pose'}",
        "kind": "joint_solutions",
        "decimals": 3,
        "joints": joints,
        "units": units,
        "expected": f"a list of all ({', '.join(joints)})",
        "hints": [
            "Which joints move the point where the last axes meet, or the position, and which only turn the end effector?",
            "A cosine alone leaves two angles, and so does a square root: count the branches before you compute.",
        ],
        "minutes": 15 + 5 * count,
    }
