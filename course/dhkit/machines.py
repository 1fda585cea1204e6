"""Planar parallel machines that no lecture shows: a platform on three legs, each driven in its own way.

``machine = machine_of(mine)`` at the end of a cell shows the legs of the student's machine.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .geometry import unit_vector
from .words import plain

Pose = tuple[float, float, float]
"""x, y of P in metres, and the angle of the platform in radians."""


class Leg(NamedTuple):
    """One leg of a machine, from its anchor on the base to its joint B on the platform; metres and degrees."""

    kind: str
    """``rail``: the drive moves a slider along a straight rail; ``crank``: it turns a crank; ``ram``: it draws a leg out."""
    anchor: tuple[float, float]
    rod: float = 0.0
    """Length of the rod from slider or crank pin to B; a ram has none."""
    rail: float = 0.0
    """Direction of the rail, counted from x0."""
    crank: float = 0.0
    """Length of the crank."""
    side: int = 0
    """Which of both solutions is built, 1 or -1: a slider ahead of B or behind it, a crank pin left or right of the way to B."""

    def driven(self, q: float) -> np.ndarray:
        """Where the rod begins, (2,), for the value of the drive: metres of a rail, radians of a crank."""
        along = {"rail": q * unit_vector(np.radians(self.rail)), "crank": self.crank * unit_vector(q)}
        return np.array(self.anchor) + along.get(self.kind, 0.0)


@dataclass(frozen=True)
class Machine:
    """A platform on three legs.

    Attributes
    ----------
    legs : three of `Leg`
    platform : three points (x, y)
        The joints B, seen from the platform's frame, in metres.
    home : (x, y, phi)
        A pose for pictures, metres and radians.
    drives : (float, float, float)
        The values of the drives there, metres and radians.
    line : float
        y of P, in metres, on the line on which a singular pose is looked for.
    ways : tuple
        Six pairs of poses.
    """

    legs: tuple[Leg, Leg, Leg]
    platform: tuple[tuple[float, float], ...]
    home: Pose
    drives: tuple[float, float, float]
    line: float
    ways: tuple[tuple[Pose, Pose], ...]

    def __repr__(self) -> str:
        return plain(self._repr_markdown_())

    def _repr_markdown_(self) -> str:
        rows = "\n".join(
            f"| {i} | {_said(leg)} | {tuple(leg.anchor)} | {tuple(point)} |"
            for i, (leg, point) in enumerate(zip(self.legs, self.platform), 1)
        )
        return f"| leg | how it is driven | anchor $A_i$ | $b_i$ |\n|---|---|---|---|\n{rows}"


def _said(leg: Leg) -> str:
    """A leg in words."""
    if leg.kind == "rail":
        where = "ahead of" if leg.side > 0 else "behind"
        return (
            f"**rail**: $q$ is the way of a slider from $A_i$ along a rail at {leg.rail:g}°, a rod of {leg.rod:g} m to $B_i$; the "
            f"slider is {where} $B_i$"
        )
    if leg.kind == "crank":
        hand = "left" if leg.side > 0 else "right"
        return (
            f"**crank**: $q$ is the angle of a crank of {leg.crank:g} m from $x_0$, a rod of {leg.rod:g} m to $B_i$; the pin is to the {hand}, "
            "seen from $A_i$ towards $B_i$"
        )
    return "**ram**: $q$ is the distance from $A_i$ to $B_i$"


MACHINES = {
    "saw": Machine(
        legs=(
            Leg("rail", (-0.1, 0.05), 0.9, rail=150, side=1),
            Leg("rail", (1.05, 0.05), 0.75, rail=-60, side=1),
            Leg("crank", (0.6, 0.95), 0.6, crank=0.55, side=-1),
        ),
        platform=((-0.2, -0.25), (0.15, -0.15), (0.0, 0.15)),
        home=(0.5, 0.5, 0.2),
        drives=(0.5102, 0.2586, -3.4048),
        line=0.45,
        ways=(
            ((0.7, 0.65, -1.2), (0.51, 0.61, 0.6)),
            ((0.33, 0.65, -0.5), (0.67, 0.51, 0.9)),
            ((0.68, 0.7, -1.1), (0.38, 0.45, 0.9)),
            ((0.32, 0.37, -1.0), (0.62, 0.61, -0.1)),
            ((0.53, 0.58, -0.7), (0.31, 0.37, -1.2)),
            ((0.39, 0.51, 0.9), (0.62, 0.5, -1.2)),
        ),
    ),
    "press": Machine(
        legs=(
            Leg("crank", (-0.05, -0.05), 0.6, crank=0.5, side=-1),
            Leg("ram", (0.9, 0.05)),
            Leg("rail", (0.64, 0.85), 0.7, rail=165, side=1),
        ),
        platform=((-0.15, -0.15), (0.1, -0.15), (0.1, 0.2)),
        home=(0.5, 0.5, 0.2),
        drives=(-0.4705, 0.4223, 0.7278),
        line=0.5,
        ways=(
            ((0.68, 0.41, -0.4), (0.67, 0.65, 1.3)),
            ((0.41, 0.41, 0.9), (0.46, 0.61, 0.3)),
            ((0.7, 0.69, 1.3), (0.49, 0.66, -1.0)),
            ((0.45, 0.37, 0.2), (0.36, 0.6, -0.4)),
            ((0.53, 0.5, -0.4), (0.56, 0.33, -0.1)),
            ((0.36, 0.69, 1.1), (0.36, 0.36, -1.2)),
        ),
    ),
    "loom": Machine(
        legs=(
            Leg("crank", (0.05, 0.0), 0.65, crank=0.6, side=1),
            Leg("crank", (1.05, -0.05), 0.65, crank=0.45, side=-1),
            Leg("rail", (0.5, 1.1), 0.7, rail=-30, side=-1),
        ),
        platform=((-0.15, -0.25), (0.2, -0.05), (0.0, 0.3)),
        home=(0.5, 0.5, 0.2),
        drives=(1.9129, 0.9037, -0.5335),
        line=0.6,
        ways=(
            ((0.63, 0.64, -0.2), (0.38, 0.4, -0.8)),
            ((0.65, 0.68, 0.3), (0.61, 0.4, -1.1)),
            ((0.4, 0.56, -0.4), (0.62, 0.68, 0.2)),
            ((0.55, 0.34, 0.3), (0.6, 0.31, 1.0)),
            ((0.7, 0.32, -0.5), (0.61, 0.54, 1.2)),
            ((0.33, 0.32, -0.8), (0.59, 0.55, 0.1)),
        ),
    ),
    "punch": Machine(
        legs=(
            Leg("rail", (0.1, 0.0), 0.85, rail=-45, side=1),
            Leg("crank", (1.0, -0.1), 0.65, crank=0.55, side=-1),
            Leg("ram", (0.6, 1.05)),
        ),
        platform=((-0.2, -0.15), (0.2, -0.2), (-0.1, 0.1)),
        home=(0.5, 0.5, 0.2),
        drives=(0.7007, 0.7984, 0.5197),
        line=0.45,
        ways=(
            ((0.32, 0.55, 1.0), (0.61, 0.57, -0.6)),
            ((0.52, 0.49, -0.1), (0.59, 0.6, 1.2)),
            ((0.59, 0.61, -1.2), (0.38, 0.63, 0.7)),
            ((0.35, 0.61, -1.0), (0.36, 0.37, -0.2)),
            ((0.35, 0.65, 1.3), (0.7, 0.39, 0.4)),
            ((0.42, 0.64, -0.9), (0.36, 0.5, 1.3)),
        ),
    ),
    "lathe": Machine(
        legs=(
            Leg("rail", (-0.1, -0.05), 0.75, rail=30, side=-1),
            Leg("crank", (0.95, -0.1), 0.7, crank=0.45, side=1),
            Leg("rail", (0.6, 1.4), 0.85, rail=-120, side=-1),
        ),
        platform=((-0.25, -0.1), (0.1, -0.1), (0.05, 0.2)),
        home=(0.5, 0.5, 0.2),
        drives=(-0.2067, 3.5366, -0.1601),
        line=0.45,
        ways=(
            ((0.42, 0.36, 0.3), (0.68, 0.62, -1.2)),
            ((0.38, 0.44, 0.5), (0.66, 0.61, -1.1)),
            ((0.66, 0.63, -1.0), (0.41, 0.37, 0.4)),
            ((0.34, 0.61, -1.2), (0.52, 0.32, -0.7)),
            ((0.31, 0.35, 0.5), (0.67, 0.48, -0.2)),
            ((0.35, 0.69, -0.7), (0.63, 0.4, 1.3)),
        ),
    ),
    "plane": Machine(
        legs=(
            Leg("ram", (-0.05, 0.05)),
            Leg("rail", (0.95, -0.1), 0.9, rail=150, side=-1),
            Leg("crank", (0.55, 1.05), 0.75, crank=0.6, side=-1),
        ),
        platform=((-0.3, -0.05), (0.15, -0.25), (0.05, 0.1)),
        home=(0.5, 0.5, 0.2),
        drives=(0.4327, -0.4642, -3.2013),
        line=0.6,
        ways=(
            ((0.34, 0.44, 0.4), (0.67, 0.37, 0.8)),
            ((0.35, 0.69, 0.4), (0.64, 0.35, 0.7)),
            ((0.47, 0.48, 0.3), (0.69, 0.54, 0.8)),
            ((0.52, 0.56, 0.9), (0.44, 0.55, 0.6)),
            ((0.43, 0.38, 0.2), (0.56, 0.56, -0.6)),
            ((0.37, 0.48, 1.1), (0.31, 0.53, -0.6)),
        ),
    ),
}
"""By name."""


def machine_of(mine: Mapping[str, object]) -> Machine:
    """The student's own machine."""
    return MACHINES[str(mine["machine"])]


def ways_of(mine: Mapping[str, object]) -> list[tuple[Pose, Pose]]:
    """The six ways (start, end) of the student's machine, in the student's own order."""
    return [machine_of(mine).ways[int(digit)] for digit in str(mine["order"])]
