"""Data sheets of six-axis arms: tables as makers print them, which seldom say how to read them.

``sheet = sheet_of(mine)`` at the end of a cell shows the table, the lengths and an example to test a reading with.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

import sympy

from .words import plain

FILE = "sheets.json"
ARMS = ("ur5e", "irb120", "puma560", "stanford", "lr_mate", "kr6", "tx2_60", "gantry", "cylindrical")
SHEETS = ("I", "II", "III", "IV")
READINGS = {
    "A": "modified, first length a, second d",
    "B": "modified, first length d, second a",
    "C": "classic, first length a, second d",
    "D": "classic, first length d, second a",
}


@dataclass(frozen=True)
class Sheet:
    """A data sheet.

    Attributes
    ----------
    title : str
    joints : tuple of str
        Names of the joint variables, from base to end effector.
    slides : tuple of bool
        Which joints slide.
    rows : tuple of tuple
        One for each joint: two lengths, the twist and the joint angle, SymPy expressions; radians.
    lengths : dict
        Numbers for the letters, in metres.
    q : tuple of float
        Joint values of the sheet's example, radians and metres.
    point : tuple of float
        Where the origin of frame 6 is then, seen from frame 0, in metres.
    """

    title: str
    joints: tuple[str, ...]
    slides: tuple[bool, ...]
    rows: tuple[tuple[sympy.Expr, ...], ...]
    lengths: Mapping[str, float]
    q: tuple[float, ...]
    point: tuple[float, ...]

    def __repr__(self) -> str:
        return plain(self._repr_markdown_())

    def _repr_markdown_(self) -> str:
        rows = (
            f"| {number} | {'slides' if slide else 'turns'} | "
            + " | ".join(f"${sympy.latex(cell)}$" for cell in row)
            + " |"
            for number, (slide, row) in enumerate(zip(self.slides, self.rows), 1)
        )
        said = [
            f"{value:g} m" if slide else f"{float(sympy.deg(value)):.0f}°" for value, slide in zip(self.q, self.slides)
        ]
        return "\n".join(
            [
                f"Your robot is the **{self.title}**.",
                "",
                "| joint | | length | length | twist | joint angle |",
                "|---|---|---|---|---|---|",
                *rows,
                "",
                "Lengths in metres: "
                + ", ".join(f"${letter} = {value:g}$" for letter, value in self.lengths.items())
                + ".",
                f"Example: for q = ({', '.join(said)}) the origin of frame 6 is at "
                f"$({', '.join(f'{value:.4f}' for value in self.point)})$ m, seen from frame 0.",
            ]
        )


def sheet_of(mine: Mapping[str, object]) -> Sheet:
    """The sheet of your own robot.

    Parameters
    ----------
    mine : OwnNumbers
        What `variant` returns: ``mine.robot`` and ``mine.sheet`` say which sheet it is.
    """
    fields = _sheets()[str(mine["robot"])]
    rows = tuple(tuple(map(sympy.sympify, row)) for row in fields[str(mine["sheet"])])
    joints = tuple(f"q{number}" for number in range(1, len(rows) + 1))
    return Sheet(
        fields["title"],
        joints,
        tuple(fields["slides"]),
        rows,
        fields["lengths"],
        tuple(fields["q"]),
        tuple(fields["point"]),
    )


@cache
def _sheets() -> dict[str, dict]:
    return json.loads(resources.files(__package__).joinpath(FILE).read_text(encoding="utf-8"))
