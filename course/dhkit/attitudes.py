"""Orientations of one's own: what an unknown controller has logged, a camera that hangs somehow, a wrist by its hinges.

``display_of(mine)`` and ``camera_of(mine)`` at the end of a cell show what your id has picked. What they mean is what the
exercise asks for.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

import numpy as np

from .words import plain

FILE = "attitudes.json"
CONTROLLERS = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII")
CAMERAS = ("A", "B", "C", "D", "E", "F", "G", "H")


@dataclass(frozen=True)
class Display:
    """Two poses of a tool: the three numbers that a controller showed, and the tool's axes as a tracker saw them.

    Attributes
    ----------
    controller : str
    shown : tuple of tuple
        Three angles for each pose, in degrees.
    measured : ndarray, shape (k, 3, 3)
        Columns: the axes x, y, z of the tool in the base frame.
    """

    controller: str
    shown: tuple[tuple[int, ...], ...]
    measured: np.ndarray

    def __repr__(self) -> str:
        return plain(self._repr_markdown_())

    def _repr_markdown_(self) -> str:
        rows = [
            "| "
            + " | ".join(
                [*map(str, numbers), *(f"({', '.join(f'{value:.4f}' for value in axis)})" for axis in turned.T)]
            )
            + " |"
            for numbers, turned in zip(self.shown, self.measured)
        ]
        head = ["| A | B | C | x of the tool | y of the tool | z of the tool |", "|---|---|---|---|---|---|"]
        return "\n".join([f"Controller **{self.controller}**, A, B, C in degrees:", "", *head, *rows])


@dataclass(frozen=True)
class Camera:
    """A camera on a drone.

    Attributes
    ----------
    hangs : str
        In words, for a drone that stands level.
    rotation : ndarray, shape (3, 3)
        Columns: the axes x, y, z of the camera, in flight, seen from the world.
    """

    hangs: str
    rotation: np.ndarray

    def __repr__(self) -> str:
        return plain(self._repr_markdown_())

    def _repr_markdown_(self) -> str:
        rows = [" & ".join(f"{value:.6f}" for value in row) for row in self.rotation]
        matrix = r"\begin{pmatrix} " + r"\\ ".join(rows) + r" \end{pmatrix}"
        return f"With the drone level, your camera {self.hangs}. In flight: $R_c = {matrix}$"


def display_of(mine: Mapping[str, Any]) -> Display:
    """The log of your own controller, ``mine.controller``."""
    fields = _file()["controllers"][mine["controller"]]
    return Display(mine["controller"], tuple(map(tuple, fields["shown"])), np.array(fields["measured"]))


def camera_of(mine: Mapping[str, Any]) -> Camera:
    """Your own camera, ``mine.camera``."""
    fields = _file()["cameras"][mine["camera"]]
    return Camera(fields["hangs"], np.array(fields["rotation"]))


@cache
def _file() -> dict[str, Any]:
    return json.loads(resources.files(__package__).joinpath(FILE).read_text(encoding="utf-8"))


def hinges(wrist: str) -> tuple[str, tuple[int, ...]]:
    """Letters and senses of a wrist's axes: ``"z, -x, y"`` gives ``("zxy", (1, -1, 1))``."""
    found = re.findall("-?[xyz]", wrist)
    return "".join(axis[-1] for axis in found), tuple(-1 if axis[0] == "-" else 1 for axis in found)
