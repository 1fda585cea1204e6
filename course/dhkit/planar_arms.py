"""Planar arms that no lecture shows: each a walk in the plane from the base to the end effector.

The walker starts at the base and looks along x0. ``turn`` is a revolute joint: he turns on the spot, counter-clockwise.
``ahead``, ``left`` and ``right`` carry him in that direction while he goes on looking where he looked: by a length, or, where the
letter is a joint's, by as much as that slide is out. Where he stands in the end, and looks, is the end effector.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

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


SLIDING = {
    "boom with its rod on the left": _walk("turn q1, left a, ahead q2"),
    "boom with its rod on the right": _walk("turn q1, right a, ahead q2"),
    "crane on a rail across": _walk("left q1, turn q2, ahead a"),
    "crane on a rail ahead": _walk("ahead q1, turn q2, ahead a"),
}
"""Arms of two joints of which one slides."""


def walk_of(arm: str) -> tuple[Step, ...]:
    """The steps of an arm of `ARMS` or `SLIDING`."""
    return (ARMS | SLIDING)[arm]


def places(arm: str, values: Mapping[str, ArrayLike]) -> tuple[np.ndarray, np.ndarray]:
    """Where the walker stands and looks, at the base and after each of the n steps of a walk.

    Parameters
    ----------
    arm : str
        A name of `ARMS` or `SLIDING`.
    values : mapping
        Numbers for the letters of the walk, or arrays of one shape (...), in metres and radians.

    Returns
    -------
    positions : ndarray, shape (n + 1, ..., 2)
        In metres.
    headings : ndarray, shape (n + 1, ...)
        In radians, from x0.
    """
    directions = {"ahead": 1, "left": 1j, "right": -1j}
    steps = walk_of(arm)
    at: list[Any] = [np.zeros(np.broadcast_shapes(*(np.shape(values[letter]) for _, letter in steps)), complex)]
    heading: list[Any] = [at[0].real]
    for do, letter in steps:
        value = np.asarray(values[letter], float)
        heading.append(heading[-1] + (value if do == "turn" else 0.0))
        at.append(at[-1] if do == "turn" else at[-1] + value * directions[do] * phasor(heading[-1]))
    return np.stack([np.real(at), np.imag(at)], axis=-1), np.array(heading)


def describe(arm: str) -> str:
    """The walk in words, one line for each step."""
    lines = []
    for number, (do, letter) in enumerate(walk_of(arm), 1):
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


def sliding_limits(mine: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    """Ranges (min, max) of q1 and q2 of the student's arm of `SLIDING`, ``mine.slider``, in metres and radians."""
    turn = np.radians((mine["turn_min"], mine["turn_max"]))
    if mine["slider"] == "crane on a rail ahead":
        turn = turn - np.radians(80)
    ranges = {"turn": tuple(turn.tolist()), "slide": (mine["out_min"], mine["out_max"])}
    steps = {letter: do for do, letter in walk_of(mine["slider"])}
    return {joint: ranges["turn" if steps[joint] == "turn" else "slide"] for joint in ("q1", "q2")}


def sliding_outline(mine: Mapping[str, Any], count: int = 60) -> np.ndarray:
    """The outline of what the student's arm of `SLIDING` reaches, shape (4 count, 2): the image of its ranges' border."""
    (low1, high1), (low2, high2) = sliding_limits(mine).values()
    first, second = np.linspace(low1, high1, count), np.linspace(low2, high2, count)
    border = np.array([
        *((q1, low2) for q1 in first),
        *((high1, q2) for q2 in second),
        *((q1, high2) for q1 in first[::-1]),
        *((low1, q2) for q2 in second[::-1]),
    ])  # fmt: skip
    return places(mine["slider"], {"a": mine["a"], "q1": border[:, 0], "q2": border[:, 1]})[0][-1]


def stations(mine: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    """Three stations (x, y) before the wall y = 0 that carries the student's RR arm, in metres."""
    far, near = (abs(mine["L1"] + mine["L2"] * phasor(np.radians(mine[stop]))) for stop in ("t2_min", "t2_max"))
    wanted = {"A": (0.35 * far, 0.9 * far), "B": (-0.5 * far, 0.5 * far), "C": (0.22 * far - 0.87 * near, 0.5 * near)}
    return {name: (round(float(x), 2), round(float(y), 2)) for name, (x, y) in wanted.items()}
