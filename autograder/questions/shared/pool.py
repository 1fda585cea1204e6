"""The pool of arms from which a student's id picks one: references for a question, and what its statement shows.

A question about "your arm" has an entry ``arm`` in its exercise's ``[variant]``, a list of names of the pool, and takes
its reference from ``arm_of(mine)``. Students see the axes of the arm in space, never its table: these stand in the kit's
``arms.json``, which ``python -m autograder.questions.shared.pool`` writes.
"""

from __future__ import annotations

import json
import random
import tomllib
from collections.abc import Sequence
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import sympy

import dhkit
from autograder.reference import DHTable
from dhkit.variants import OwnNumbers

from .described import Described, robot_of

FILE = "arms.toml"
MEASURED = 4
"""Arms of so many joints have a log."""
KIT_FILE = Path(dhkit.__file__).with_name("arms.json")


@cache
def arms() -> dict[str, Described]:
    """Every arm of the pool by its name."""
    groups = tomllib.loads(resources.files(__package__).joinpath(FILE).read_text(encoding="utf-8"))
    return {
        name: robot_of(f"{FILE}: {name}", {**shared, **entry})
        for group in groups.values()
        for shared in [{key: value for key, value in group.items() if key in ("joints", "lengths")}]
        for name, entry in group.items()
        if name not in shared
    }


def arm_of(mine: OwnNumbers) -> Described:
    """The student's own arm."""
    return arms()[mine.arm]


def axes_in_space(table: DHTable) -> dict[str, Any]:
    """Where the axes of a robot and its end effector are, seen from the base, with every turning joint at zero.

    Points and directions are lists of three entries; an entry of a point maps letters (and "" for a plain number) to
    their factors. Sliding joints keep their letter.
    """
    letters = [row.variable.free_symbols & set(table.joints) for row in table.rows]
    frames = frames_in_space(table)
    joints = [
        {"name": str(letter), "slides": bool(row.sigma), **_line(frame)}
        for row, own, frame in zip(table.rows, letters, frames)
        for letter in own
    ]
    end = {**_line(frames[-1]), "x": direction_of(frames[-1], 0)}
    return {"joints": joints, "end": {**end, "frame": "E"} if end_frame(table) == "E" else end}


def end_frame(table: DHTable) -> str:
    """The name of the end effector's frame: the number of the last row, or E where that is no joint's."""
    return str(len(table.rows)) if table.rows[-1] in table.moving else "E"


def frames_in_space(table: DHTable) -> list[sympy.Matrix]:
    """The frames of a table, one (4, 4) for each row, seen from the base, with every turning joint at zero."""
    turning = set().union(*(row.variable.free_symbols for row in table.moving if not row.sigma)) & set(table.joints)
    at_zero, frame, frames = dict.fromkeys(turning, 0), sympy.eye(4), []
    for transform in table.transforms():
        frame = (frame * transform.subs(at_zero)).applyfunc(sympy.expand)
        frames.append(frame)
    return frames


def _line(frame: sympy.Matrix) -> dict[str, Any]:
    return {"point": origin_of(frame), "direction": direction_of(frame, 2)}


def origin_of(frame: sympy.Matrix) -> list[dict[str, float]]:
    """The origin of a frame, as the kit's files have points."""
    return [_factors(entry) for entry in frame[:3, 3]]


def direction_of(frame: sympy.Matrix, axis: int) -> list[float]:
    """The direction of an axis of a frame, 0 for X to 2 for Z."""
    return [int(entry) if entry.is_integer else float(entry) for entry in frame[:3, axis]]


def _factors(entry: sympy.Expr) -> dict[str, float]:
    """A sum of letters with their factors."""
    found = {}
    for letter, factor in sympy.expand(entry).as_coefficients_dict().items():
        if factor:
            found["" if letter == 1 else str(letter)] = int(factor) if factor.is_integer else float(factor)
    return found


@cache
def measured(name: str) -> dict[str, Any]:
    """What a tracker saw of an arm as it was built: its lengths are not quite those of the pool.

    ``q`` and ``asked`` in degrees and millimetres, ``points`` of the end effector in millimetres. The same for a name on
    every machine.
    """
    arm, chance = arms()[name], random.Random(name)
    table = arm.table.with_values(
        {
            letter: value + chance.choice((-1, 1)) * chance.uniform(0.012, 0.03)
            for letter, value in _lengths(arm).items()
        }
    )
    drawn = [
        [chance.randrange(40, 400, 5) if row.sigma else chance.randrange(-85, 90, 5) for row in table.moving]
        for _ in range(9)
    ]
    points = [
        [round(1000 * float(value) + chance.gauss(0, 1.5), 1) for value in table.forward(in_si(arm, q))[:3, 3]]
        for q in drawn
    ]
    return {"q": drawn[:-1], "points": points[:-1], "asked": drawn[-1]}


def in_si(arm: Described, q: Sequence[float], degree: float = np.pi / 180) -> list[float]:
    """Joint values in degrees and millimetres, in radians and metres; `degree` is what an angle of 1 counts."""
    return [value / 1000 if row.sigma else value * degree for row, value in zip(arm.table.moving, q, strict=True)]


def for_the_kit() -> str:
    """What the kit's file says: of each arm what is shown of it, and of those of four joints a log."""
    lines = (
        f"{json.dumps(name)}: "
        + json.dumps(shown(arm) | ({"log": measured(name)} if len(arm.joints) == MEASURED else {}))
        for name, arm in arms().items()
    )
    return "{\n" + ",\n".join(lines) + "\n}\n"


def shown(arm: Described) -> dict[str, Any]:
    """Of an arm its title, axes, and lengths to draw it with, as the kit's files have it."""
    return {"title": arm.title, **axes_in_space(arm.table), "lengths": _lengths(arm)}


def _lengths(arm: Described) -> dict[str, float]:
    return {str(name): float(value) for name, value in arm.table.values.items()}


if __name__ == "__main__":
    KIT_FILE.write_text(for_the_kit(), encoding="utf-8")
