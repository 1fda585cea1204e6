"""Arms that a student's id chooses, as the statements of exercises tell them.

The notebook shows the arm under the student's own name of it, ``CLASSIC_ARMS[mine.arm]``, ``joint_list(mine)``; the grader
takes the same one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from sympy import Expr, Integer, pi, symbols

from .words import plain

q1, q2, q3, q4, q5, a1, a2, a3, a4 = symbols("q1:6 a1:5")
d1, d2, d3, d4, d5 = symbols("d1:6")
HALF, NONE = pi / 2, Integer(0)

CLASSIC_ARMS: dict[str, list[list[Expr | int]]] = {
    "welder": [[0, a1, -HALF, d1, q1], [0, a2, 0, d2, q2], [0, a3, HALF, 0, q3]],
    "loader": [[0, a1, -HALF, d1, q1], [0, 0, HALF, d2, q2], [1, a3, 0, q3, 0]],
    "painter": [[0, 0, HALF, d1, q1], [0, a2, HALF, d2, q2], [0, a3, 0, 0, q3]],
    "stacker": [[1, a1, 0, q1, 0], [0, a2, -HALF, d2, q2], [0, a3, HALF, 0, q3]],
}
"""Arms of three joints in classic rows ``[sigma, a, alpha, d, theta]``, every number with the index of its own joint."""

SIGNED_ARMS: dict[str, list[list[Expr | int]]] = {
    "handler": [
        [0, NONE, NONE, d1, q1],
        [0, a1, -HALF, NONE, q2],
        [0, a2, NONE, NONE, q3],
        [0, a3, -HALF, d4, q4],
        [0, NONE, HALF, NONE, q5],
    ],
    "drill": [
        [0, NONE, NONE, d1, q1],
        [0, a1, HALF, NONE, q2],
        [0, a2, -HALF, d3, q3],
        [0, a3, -HALF, NONE, q4],
        [0, NONE, HALF, d5, q5],
    ],
    "telescope": [
        [0, NONE, NONE, d1, q1],
        [0, a1, -HALF, NONE, q2],
        [1, NONE, HALF, q3, NONE],
        [0, a3, -HALF, NONE, q4],
        [0, a4, NONE, NONE, q5],
    ],
}
"""Arms of five joints in modified rows ``[sigma, a, alpha, d, theta]``, two of whose twists are negative."""


t1, t2, t3, h1, h2, L1, L2, p1 = symbols("t1:4 h1 h2 L1 L2 p1")

PEN_OFFERS: dict[str, list[list[Expr | int]]] = {
    "link": [[0, 0, 0, h1, t1], [0, L1, -HALF, h2, t2 - HALF], [0, L2, 0, 0, t3], [0, p1, 0, 0, 0]],
    "upright": [[0, 0, 0, h1, t1], [0, L1, 0, h2, t2], [0, 0, 0, L2, t3], [0, p1, 0, 0, 0]],
    "ball": [[0, 0, 0, h1, t1], [0, 0, -HALF, 0, t2 - HALF], [0, 0, HALF, 0, t3], [0, p1, 0, 0, 0]],
    "axle": [[0, 0, 0, h1, t1], [0, L1, -HALF, h2, t2], [0, 0, 0, L2, t3], [0, 0, 0, p1, 0]],
    "slide": [[0, 0, 0, h1, t1], [0, L1, -HALF, h2, t2 - HALF], [1, 0, 0, d3, 0], [0, p1, 0, 0, 0]],
    "lifts": [[1, 0, 0, d1, 0], [1, L1, 0, d2, 0], [1, L2, pi, d3, 0], [0, p1, 0, 0, 0]],
}
"""Robots with a pen of length p1: three joints each, modified rows ``[sigma, a, alpha, d, theta]``, the pen in the last."""


def pen_offers(mine: Mapping[str, object]) -> dict[str, list[list[Expr | int]]]:
    """The tables of `PEN_OFFERS` under the letters A to F, beginning with the one that is the student's first."""
    names = [*PEN_OFFERS]
    first = int(mine["offer"])  # type: ignore[call-overload]
    return {letter: PEN_OFFERS[name] for letter, name in zip("ABCDEF", names[first:] + names[:first])}


@dataclass(frozen=True)
class Listed:
    """One line of a list of joint origins.

    Attributes
    ----------
    x, z : str
        The way from the joint before: names of own numbers, "" for none.
    axis : str
        "x", "y" or "z", in whose positive sense the axis points; "" where no joint is.
    X : str
        Where X of the DHm frame points when all joints are at zero, in words.
    slides : bool
    """

    x: str
    z: str
    axis: str
    X: str = ""
    slides: bool = False


GRIPPER = Listed("xg", "", "")
JOINT_LISTS = {
    "welder": (
        Listed("", "z1", "z", "ahead"),
        Listed("x2", "z2", "y", "up"),
        Listed("", "l3", "y", "ahead"),
        Listed("x4", "", "y", "up"),
        Listed("x5", "", "x", "along $+y$"),
        GRIPPER,
    ),
    "roller": (
        Listed("", "z1", "z", "ahead"),
        Listed("x2", "z2", "y", "up"),
        Listed("l3", "", "x", "up"),
        Listed("x4", "", "y", "up"),
        Listed("x5", "z4", "x", "along $-y$"),
        GRIPPER,
    ),
    "lift": (
        Listed("", "z1", "z", "ahead", slides=True),
        Listed("x2", "z2", "y", "ahead"),
        Listed("l3", "", "y", "ahead"),
        Listed("x4", "", "z", "along $+y$"),
        Listed("x5", "z4", "x", "up"),
        GRIPPER,
    ),
}
"""Arms of five joints as a description file gives them, the gripper last."""


@dataclass(frozen=True)
class JointList:
    """A list of joint origins with one's own numbers."""

    title: str
    lines: tuple[Listed, ...]
    numbers: Mapping[str, float]

    @property
    def axes(self) -> list[str]:
        """The axis of each joint, "" for the gripper."""
        return [line.axis for line in self.lines]

    @property
    def origins(self) -> np.ndarray:
        """Origins of the joints and the gripper in the base frame, all joints at zero, shape (n + 1, 3), in metres."""
        known = {"": 0.0, **self.numbers}
        return np.cumsum([[known[line.x], 0, known[line.z]] for line in self.lines], axis=0)

    def __repr__(self) -> str:
        return plain(self._repr_markdown_())

    def _repr_markdown_(self) -> str:
        known = {"": "0", **{name: str(number) for name, number in self.numbers.items()}}
        rows = [
            f"| {number} | {'slides' if line.slides else 'turns'} | {known[line.x]} | 0 | {known[line.z]} | ${line.axis}$ | {line.X} |"
            for number, line in enumerate(self.lines[:-1], 1)
        ]
        rows += [f"| gripper | fixed | {known[line.x]} | 0 | {known[line.z]} | | |" for line in self.lines[-1:]]
        head = ["| joint | | $x$ (m) | $y$ | $z$ | axis | $X_i$ points |", "|---|---|---|---|---|---|---|"]
        return "\n".join([f"Your arm is the **{self.title}**.", "", *head, *rows])


def joint_list(mine: Mapping) -> JointList:
    """The list of your own arm, ``mine.file``, with your own numbers."""
    lines = JOINT_LISTS[mine["file"]]
    return JointList(mine["file"], lines, {name: mine[name] for line in lines for name in (line.x, line.z) if name})
