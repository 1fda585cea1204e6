"""The student's own machine: its drives, their rates, where it is singular, and how often a way passes through such a pose."""

from __future__ import annotations

import numpy as np

from dhkit.geometry import rotation_2d, unit_vector
from dhkit.machines import Leg, Machine, machine_of

BETWEEN = (0.2, 0.8)
"""x of P on the line on which the singular pose is looked for, in metres."""
NEAR = (0.0, 0.9)
"""The same for the lines from the anchors, which meet elsewhere."""
STEPS = 100
"""Into which a way is cut to count singular poses."""


def _cross(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]


def _begin(leg: Leg, joint: np.ndarray, other: str, halves: bool) -> float:
    """The value of a leg's drive for its joint at a place; see `drives` for what may go wrong."""
    way = joint - leg.anchor
    far = np.hypot(*way)
    side = -leg.side if other in (leg.kind, "both") else leg.side
    if leg.kind == "rail":
        along = unit_vector(np.radians(leg.rail))
        half = np.sqrt(leg.rod**2 - _cross(along, way) ** 2)
        return float(way @ along + side * half * halves)
    if leg.kind == "crank":
        half = np.arccos((leg.crank**2 + far**2 - leg.rod**2) / (2 * leg.crank * far))
        return float(np.arctan2(way[1], way[0]) + side * half * halves)
    return float(far)


def _joints(machine: Machine, x: float, y: float, phi: float) -> np.ndarray:
    return (x, y) + np.array(machine.platform) @ rotation_2d(phi).T


def drives(x, y, phi, mine, *, turn=1, other="", halves=True, unit=1.0) -> list[float]:
    """The three values of the drives at a pose.

    `turn` is a factor of phi; `other` names a kind of drive, or ``"both"``, with its other solution; without `halves` a
    slider stands beside its joint and a crank points at it; `unit` is that of the cranks, per radian.
    """
    machine = machine_of(mine)
    found = zip(machine.legs, _joints(machine, x, y, turn * phi))
    return [_begin(leg, joint, other, halves) * (unit if leg.kind == "crank" else 1.0) for leg, joint in found]


def rods(machine: Machine, pose, *, anchors=False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Unit vectors u of the rods, arms r from P, and how fast the rods' beginnings move along u, (3, 2), (3, 2), (3,).

    With `anchors` a rod is taken to begin at the anchor of its leg.
    """
    joints = _joints(machine, *pose)
    begin, speed = np.empty((3, 2)), np.empty((3, 2))
    for i, (leg, joint) in enumerate(zip(machine.legs, joints)):
        q = 0.0 if anchors else _begin(leg, joint, "", True)
        begin[i] = leg.anchor if anchors else leg.driven(q)
        speed[i] = {
            "rail": unit_vector(np.radians(leg.rail)),
            "crank": leg.crank * unit_vector(q + np.pi / 2),
            "ram": unit_vector(np.arctan2(*(joint - leg.anchor)[::-1])),
        }[leg.kind]
    along = (joints - begin) / np.linalg.norm(joints - begin, axis=1)[:, None]
    return along, joints - pose[:2], np.sum(along * speed, axis=1)


def rates(x, y, phi, mine, *, gain="drive", sign=1, centre="P", inverted=False) -> list[list[float]]:
    """The matrix that turns (vx, vy, omega) into the rates of the drives, (3, 3).

    Its rows may not be divided by what the drives give, ``gain=""``, or by that of a crank of 1 m, ``gain="angle"``; the third
    column may have the other `sign`, arms be counted from the ``"origin"``; or the matrix be `inverted`.
    """
    machine = machine_of(mine)
    along, arms, speed = rods(machine, (x, y, phi))
    turning = _cross(arms if centre == "P" else arms + (x, y), along)
    matrix = np.column_stack([along, sign * turning])
    if gain == "angle":
        speed = speed / [leg.crank or 1.0 for leg in machine.legs]
    if gain:
        matrix = matrix / speed[:, None]
    return (np.linalg.inv(matrix) if inverted else matrix).tolist()


def hold(machine: Machine, pose, *, anchors=False) -> float:
    """The determinant that vanishes where the platform gives way: that of the rows (u, r x u); see `rods`."""
    along, arms, _ = rods(machine, pose, anchors=anchors)
    return float(np.linalg.det(np.column_stack([along, _cross(arms, along)])))


def singular(mine, *, anchors=False, point="P") -> float:
    """x of P, where the rods' lines, or those from the `anchors`, meet for phi = 0 on the machine's line.

    Or of another `point`: where they meet, or a joint by its number.
    """
    machine = machine_of(mine)
    places = np.linspace(*(NEAR if anchors else BETWEEN), 91)
    value = lambda x: np.sign(hold(machine, (x, machine.line, 0.0), anchors=anchors))  # noqa: E731
    signs = np.array([value(x) for x in places])
    first = int(np.flatnonzero(signs[1:] != signs[:-1])[0])
    low, high = places[first : first + 2]
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if value(middle) == signs[first] else (low, middle)
    if point == "meeting":
        along, arms, _ = rods(machine, (low, machine.line, 0.0))
        (first, second), (b1, b2) = along[:2], arms[:2]
        way, _ = np.linalg.solve(np.column_stack([first, -second]), b2 - b1)
        return float(low + b1[0] + way * first[0])
    return low + (0.0 if point == "P" else machine.platform[int(point) - 1][0])


def crossings(x1, y1, phi1, x2, y2, phi2, mine, *, looked_at=STEPS + 1, most=9, turning=True) -> int:
    """How often a straight way passes through a singular pose.

    It may be `looked_at` at too few poses, the `most` that is found be too little, or the platform be left unturned.
    """
    machine = machine_of(mine)
    way = np.linspace((x1, y1, phi1), (x2, y2, phi2 if turning else phi1), looked_at)
    signs = np.sign([hold(machine, pose) for pose in way])
    return min(most, int((signs[1:] != signs[:-1]).sum()))


TWO, NONE, ONE = "012", "34", "5"
"""Places of the ways of a machine that pass through two singular poses, through none, and through one."""


def failing(mine, *, instead="") -> list[int]:
    """Numbers of the three ways of which the given function is wrong; one of `instead` may be blamed in place of the first."""
    order = str(mine.order)
    return sorted(order.index(place) + 1 for place in (instead or TWO[0]) + TWO[1:])


# ---------------------------------------------------------------- values to try functions with


def draw_reached(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists (x, y, phi): poses that every machine reaches, and one that is not turned."""
    drawn = [[*rng.uniform(0.36, 0.64, 2), rng.uniform(-0.85, 0.85)] for _ in range(8)]
    return [[float(value) for value in args] for args in [*drawn, [0.45, 0.55, 0.0]]]


def draw_ways(rng: np.random.Generator, mine) -> list[list[float]]:
    """Argument lists of `crossings`: the machine's ways there and back, and two that rest; the same for everybody."""
    ways = [[*start, *end] for start, end in machine_of(mine).ways]
    return [*ways, *([*way[3:], *way[:3]] for way in ways), *([*way[:3], *way[:3]] for way in ways[:2])]
