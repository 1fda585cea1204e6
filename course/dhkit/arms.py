"""Arms that the lectures do not show, by their axes in space: which one is yours follows from your id.

``arm = arm_of(mine)`` at the end of a cell says where its axes are, ``draw_arm(arm)`` draws it. A table it does not
have: that is what the exercises ask for. ``log_of(mine)`` is what a tracker saw of one that was really built.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

import numpy as np

from .words import plain

FILE = "arms.json"
EXTENDED = 0.25
"""How far a sliding joint is drawn out, in metres."""

Point = tuple[Mapping[str, float], Mapping[str, float], Mapping[str, float]]
"""Three entries, each a sum: letters, or "" for a plain number, with their factors."""


@dataclass(frozen=True)
class Axis:
    """The axis of a joint, seen from the base, with all turning joints at zero.

    Attributes
    ----------
    name : str
        Of the joint variable.
    slides : bool
    point : tuple of mapping
        A point on it.
    direction : tuple of float
        Unit vector along which the joint slides, or about which it turns.
    """

    name: str
    slides: bool
    point: Point
    direction: tuple[float, ...]


@dataclass(frozen=True)
class Arm:
    """An arm as its statement shows it.

    Attributes
    ----------
    title : str
    joints : tuple of Axis
        From base to end effector.
    origin : tuple of mapping
        Of the end effector's frame.
    x, z : tuple of float
        Unit vectors of the end effector's frame.
    lengths : dict
        Numbers for the letters, in metres.
    frame : str
        The name of the end effector's frame: that of the last joint, or E where constant rows lead on from there.
    """

    title: str
    joints: tuple[Axis, ...]
    origin: Point
    x: tuple[float, ...]
    z: tuple[float, ...]
    lengths: Mapping[str, float]
    frame: str

    @property
    def letters(self) -> list[str]:
        """The lengths in which the arm is described, those of which it is made first."""
        said = [*(joint.point for joint in self.joints), self.origin]
        used = {letter for point in said for entry in point for letter in entry}
        return [letter for letter in self.lengths if letter in used]

    def at(self, point: Point, values: Mapping[str, float]) -> np.ndarray:
        """A point in numbers, (3,), in metres."""
        known = {"": 1.0, **self.lengths, **values}
        return np.array([sum(factor * known[letter] for letter, factor in entry.items()) for entry in point])

    def in_words(self) -> str:
        """Its axes and its end effector in Markdown."""
        rows = (
            f"| {number} | {'slides' if joint.slides else 'turns'}, ${said_letter(joint.name)}$ "
            f"| ${said_direction(joint.direction)}$ | ${said_point(joint.point)}$ |"
            for number, joint in enumerate(self.joints, 1)
        )
        last = self.frame
        return "\n".join(
            [
                "| joint | | $Z_i$ points along | and passes through |",
                "|---|---|---|---|",
                *rows,
                "",
                f"The end effector is frame {last}: $O_{last}$ at ${said_point(self.origin)}$, $X_{last}$ along "
                f"${said_direction(self.x)}$, $Z_{last}$ along ${said_direction(self.z)}$.",
            ]
        )

    def __repr__(self) -> str:
        return plain(self._repr_markdown_())

    def _repr_markdown_(self) -> str:
        return (
            f"Your arm is **{self.title}**. Seen from frame 0, with every turning joint at zero:\n\n{self.in_words()}"
        )


def arm_of(mine: Mapping[str, object]) -> Arm:
    """Your own arm, with your own lengths where you have any.

    Parameters
    ----------
    mine : OwnNumbers
        What `variant` returns: ``mine.arm`` is its name.
    """
    fields = _arms()[str(mine["arm"])]
    return arm_from(fields, {name: float(mine.get(name, number)) for name, number in fields["lengths"].items()})  # type: ignore[arg-type]


def arm_of_exercise(exercise: str) -> Arm:
    """The arm of an exercise on one robot, which everybody has."""
    text = resources.files(__package__).joinpath("questions", f"{exercise}.json").read_text(encoding="utf-8")
    return arm_from(json.loads(text))


def arm_from(fields: Mapping[str, Any], lengths: Mapping[str, float] | None = None) -> Arm:
    """An arm as a file of the kit has it; `lengths` may replace those of the file."""
    joints = tuple(
        Axis(one["name"], one["slides"], tuple(one["point"]), tuple(one["direction"])) for one in fields["joints"]
    )
    end = fields["end"]
    return Arm(
        fields["title"],
        joints,
        tuple(end["point"]),
        tuple(end["x"]),
        tuple(end["direction"]),
        fields["lengths"] if lengths is None else lengths,
        end.get("frame", str(len(joints))),
    )


@dataclass(frozen=True)
class Log:
    """What a tracker saw: an arm that was built is never quite the one that was drawn.

    Attributes
    ----------
    joints : tuple of str
        Names of the joint variables.
    slides : tuple of bool
        Which of them slide.
    q : tuple of tuple
        Joint values, one row for each measurement, as the controller shows them: **degrees** and **millimetres**.
    points : tuple of tuple
        Where the origin of the end effector's frame was, in frame 0, in millimetres.
    asked : tuple of float
        Joint values that have not been tried.
    """

    joints: tuple[str, ...]
    slides: tuple[bool, ...]
    q: tuple[tuple[float, ...], ...]
    points: tuple[tuple[float, ...], ...]
    asked: tuple[float, ...]

    def __repr__(self) -> str:
        return plain(self._repr_markdown_())

    def _repr_markdown_(self) -> str:
        units = ["mm" if slides else "degrees" for slides in self.slides]
        heads = [
            *(f"${said_letter(name)}$, {unit}" for name, unit in zip(self.joints, units)),
            "x, mm",
            "y, mm",
            "z, mm",
        ]
        rows = [[*map(str, q), *map(str, point)] for q, point in zip(self.q, self.points)]
        rows.append([*map(str, self.asked), "?", "?", "?"])
        lines = ["| " + " | ".join(row) + " |" for row in (heads, ["---"] * len(heads), *rows)]
        return "\n".join(lines)


def log_of(mine: Mapping[str, object]) -> Log:
    """The log of your own arm."""
    fields = _arms()[str(mine["arm"])]
    if "log" not in fields:
        raise ValueError(f"{mine['arm']} has not been measured")
    joints, log = fields["joints"], fields["log"]
    rows = {key: tuple(map(tuple, log[key])) for key in ("q", "points")}
    return Log(
        tuple(one["name"] for one in joints), tuple(one["slides"] for one in joints), **rows, asked=tuple(log["asked"])
    )


@cache
def _arms() -> dict[str, dict]:
    return json.loads(resources.files(__package__).joinpath(FILE).read_text(encoding="utf-8"))


def said_point(point: Point) -> str:
    """A point in LaTeX."""
    return "(" + r",\ ".join(said_sum(entry) for entry in point) + ")"


def said_direction(direction: tuple[float, ...]) -> str:
    """A unit vector in LaTeX: by the axis of frame 0 that it lies on, if it lies on one."""
    for value, letter in zip(direction, "XYZ"):
        if abs(value) == 1:
            return f"{'+' if value > 0 else '-'}{letter}_0"
    return "(" + r",\ ".join(f"{value:.4g}" for value in direction) + ")"


def said_sum(entry: Mapping[str, float]) -> str:
    """A sum in LaTeX."""
    return "".join(_terms(entry)).removeprefix("+") or "0"


def _terms(entry: Mapping[str, float]) -> Iterator[str]:
    for letter, factor in sorted(entry.items(), key=lambda term: term[1] < 0):
        size = "" if abs(factor) == 1 and letter else f"{abs(factor):.4g}"
        yield f"{'-' if factor < 0 else '+'}{size}{said_letter(letter)}"


def said_letter(name: str) -> str:
    """A letter with its number as an index, in LaTeX."""
    stem = name.rstrip("0123456789")
    return f"{stem}_{{{name[len(stem) :]}}}" if stem and stem != name else name
