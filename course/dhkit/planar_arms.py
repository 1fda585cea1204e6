"""Planar arms that no lecture shows: each a walk in the plane from the base to the end effector.

The walker starts at the base and looks along x0. ``turn`` is a revolute joint: he turns on the spot, counter-clockwise.
``ahead``, ``left`` and ``right`` carry him in that direction while he goes on looking where he looked: by a length, or, where the
letter is a joint's, by as much as that slide is out. Where he stands in the end, and looks, is the end effector.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from .geometry import phasor, unit_vector

JOINTS = ("q1", "q2", "q3")
LENGTHS = ("a", "b", "c")


class Step(NamedTuple):
    """One step of a walk: what is done, and the letter that says by how much."""

    do: str
    letter: str


def _walk(text: str) -> tuple[Step, ...]:
    return tuple(Step(*step.split()) for step in text.split(", "))


ARMS = {
    "telescope": _walk("turn q1, left c, ahead q2, turn q3, ahead b"),
    "cross slide": _walk("turn q1, ahead c, left q2, turn q3, ahead b"),
    "boom": _walk("turn q1, ahead a, turn q2, left c, ahead q3"),
    "side boom": _walk("turn q1, ahead a, turn q2, ahead b, left q3"),
    "rail": _walk("ahead c, left q1, turn q2, ahead a, turn q3, ahead b"),
    "rail with bent tool": _walk("left q1, turn q2, ahead a, turn q3, right c"),
    "bent tool": _walk("turn q1, ahead a, turn q2, ahead b, turn q3, left c"),
    "bracket": _walk("turn q1, left a, turn q2, ahead b, turn q3, ahead c"),
}


def places(arm: str, values: Mapping[str, float]) -> tuple[np.ndarray, np.ndarray]:
    """Where the walker stands and looks, at the base and after each of the n steps of a walk.

    Parameters
    ----------
    arm : str
        A name of `ARMS`.
    values : mapping
        Numbers for the letters of the walk, in metres and radians.

    Returns
    -------
    positions : ndarray, shape (n + 1, 2)
        In metres.
    headings : ndarray, shape (n + 1,)
        In radians, from x0.
    """
    directions = {"ahead": 1, "left": 1j, "right": -1j}
    at: list[Any] = [0j]
    heading = [0.0]
    for do, letter in ARMS[arm]:
        value = float(values[letter])
        heading.append(heading[-1] + (value if do == "turn" else 0.0))
        at.append(at[-1] if do == "turn" else at[-1] + value * directions[do] * phasor(heading[-1]))
    return np.column_stack([np.real(at), np.imag(at)]), np.array(heading)


def describe(arm: str) -> str:
    """The walk in words, one line for each step."""
    lines = []
    for number, (do, letter) in enumerate(ARMS[arm], 1):
        whose = (
            f" (joint {JOINTS.index(letter) + 1} {'turns' if do == 'turn' else 'slides'})" if letter in JOINTS else ""
        )
        lines.append(f"{number}. {do} by {letter}{whose}" if do == "turn" else f"{number}. go {do} by {letter}{whose}")
    return "\n".join(lines)


TARGETS = ("ahead", "behind", "near", "beyond", "inner", "below")


def telescope_targets(mine: Mapping[str, Any]) -> list[tuple[float, float]]:
    """Six targets (x, y) for the telescopic arm with offset, in metres, in the student's own order.

    One of each kind of `TARGETS`: on the rod's way out in three directions, within what it passes on both sides, out of
    reach, and nearer to the base than the offset.
    """
    rods = {"ahead": 0.8 * mine["out"], "behind": 0.85 * mine["out"], "near": 0.6 * mine["back"],
            "beyond": 1.2 * mine["out"], "below": 0.9 * mine["out"]}  # fmt: skip
    distances = {kind: np.hypot(rod, mine["e"]) for kind, rod in rods.items()} | {"inner": 0.7 * mine["e"]}
    directions = {"ahead": 40, "behind": 150, "near": 20, "beyond": -30, "inner": 70, "below": -60}
    points = [distances[kind] * unit_vector(np.radians(directions[kind])) for kind in order_of_targets(mine)]
    return [tuple(np.round(point, 3).tolist()) for point in points]


def order_of_targets(mine: Mapping[str, Any]) -> list[str]:
    """The kinds of the six targets in the student's own order."""
    return [TARGETS[int(digit)] for digit in mine["order"]]
