"""Work with SCARAs that no lecture shows: four arms told as walks, six rows of a catalogue, a measured arm."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np


class Step(NamedTuple):
    """One step of an arm, from the base on: a joint, or a constant length."""

    what: str
    """``turn`` or ``slide``, a joint; ``ahead``, ``up`` or ``down``, a length."""
    letter: str
    axis: str = ""
    """Where z of a joint points, ``up`` or ``down``: about it the joint turns, along it it slides."""


def _arm(text: str) -> tuple[Step, ...]:
    return tuple(Step(*step.split()) for step in text.split(", "))


SCARAS = {
    "column": _arm("up H, slide q1 up, turn q2 up, ahead A, turn q3 up, ahead B, turn q4 down"),
    "carousel": _arm("turn q1 up, up H, slide q2 up, ahead A, turn q3 up, ahead B, turn q4 down"),
    "ceiling": _arm("down H, turn q1 down, ahead A, turn q2 down, ahead B, slide q3 down, turn q4 down"),
    "quill last": _arm("up H, turn q1 up, ahead A, turn q2 up, ahead B, turn q3 down, slide q4 down"),
}
JOINTS = ("q1", "q2", "q3", "q4")


def describe(arm: str) -> str:
    """The steps of an arm in words, one line for each."""
    lines = []
    for number, (what, letter, axis) in enumerate(SCARAS[arm], 1):
        if letter in JOINTS:
            joint = JOINTS.index(letter) + 1
            lines.append(f"{number}. joint {joint} {what}s by {letter}; $z_{joint}$ points {axis}")
        else:
            lines.append(f"{number}. {what} by the length {letter}")
    return "\n".join(lines)


class Row(NamedTuple):
    """What a catalogue tells of a SCARA: lengths in metres, the elbow's stop in degrees, kilograms."""

    upper: float
    fore: float
    elbow: float
    stroke: float
    payload: float


_ROWS = (
    Row(0.350, 0.300, 140.0, 0.20, 7.0),
    Row(0.350, 0.250, 150.0, 0.15, 8.0),
    Row(0.325, 0.275, 147.5, 0.21, 6.0),
    Row(0.325, 0.325, 150.0, 0.20, 10.0),
    Row(0.300, 0.300, 120.0, 0.18, 8.0),
    Row(0.400, 0.300, 148.0, 0.10, 10.0),
)
GRIPPER = 1.4
"""Kilograms."""


def catalogue(mine: Mapping[str, Any]) -> dict[str, Row]:
    """Six robots, A to F, in the student's own order."""
    return {letter: _ROWS[int(digit)] for letter, digit in zip("ABCDEF", mine["order"])}


POINTS = 30
_UNKNOWN = ("d2", "d3", "x0", "y0")


def measured(mine: Mapping[str, Any]) -> np.ndarray:
    """What a tracker saw of an s600 that differs a little from its data sheet: (30, 4), rows t1, t2, x, y.

    Radians and metres; x and y in the tracker's frame, which is parallel to frame 0 and does not quite coincide with it.
    Each coordinate has an error of its own of half a millimetre (standard deviation).
    """
    name = f"{mine['d2']} {mine['d3']} {mine['x']} {mine['y']}"
    d2, d3, x0, y0 = (
        value + sign * (0.0115 + 0.0035 * _chance(f"{name} {what}"))
        for what, value, sign in zip(_UNKNOWN, (mine["d2"], mine["d3"], 0.0, 0.0), (1, -1, 1, 1))
    )
    rows = []
    for k in range(POINTS):
        t1 = round(-0.9 + 2.6 * _chance(f"{name} t1 {k}"), 3)
        t2 = round(-2.2 + 4.4 * _chance(f"{name} t2 {k}"), 3)
        x = x0 + d2 * np.cos(t1) + d3 * np.cos(t1 + t2) + _error(f"{name} x {k}")
        y = y0 + d2 * np.sin(t1) + d3 * np.sin(t1 + t2) + _error(f"{name} y {k}")
        rows.append([t1, t2, round(float(x), 5), round(float(y), 5)])
    return np.array(rows)


def _chance(text: str) -> float:
    """A number between 0 and 1 that follows from a text, on any machine."""
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:6], "big") / 2**48


def _error(text: str) -> float:
    """Nearly normal, of mean 0 and standard deviation 0.0005: a sum of twelve uniform ones has the deviation 1."""
    return 0.0005 * (sum(_chance(f"{text} {k}") for k in range(12)) - 6)
