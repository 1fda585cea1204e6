"""The robots of the course's documents, as tables with their inverse models.

Functions build a robot for given lengths (metres, numbers or SymPy expressions) and, with ``limits``, for joint limits:
one (lower, upper) pair per joint. The constants in capitals are the same robots with default lengths, made at first
use: ``robots.SCARA``, ``robots.scara(a2=0.4)``. The parallel robots ``robots.THREE_RPR`` and ``robots.THREE_RRR`` have
models of their own kind. Joint angles in radians, poses 4x4. Sources are named with each robot.

A new robot is a function at the end of this module, decorated with `_robot`.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial, wraps
from typing import Any

import sympy as sp

from dhm import DHTable, Robot, ThreeRPR, ThreeRRR, UrdfJoint
from dhm.elbow import ElbowArm, WristAlone, WristedArm
from dhm.inverse import InverseModel
from dhm.pen import PenArm
from dhm.planar_arms import PlanarArm, Scara
from dhm.transforms import Entry, rot_y, rot_z, trans_x, trans_z

_t1, _t2, _t3, _t4, _t5, _t6 = sp.symbols("t1:7")
_HALF = sp.pi / 2

Limits = Sequence[tuple[float, float]]


def _with_values(
    table: DHTable, model: type[InverseModel] | None, lengths: Mapping[str, Entry], limits: Limits | None
) -> Robot:
    """A robot from a table in letters. Lengths that are expressions stand in the table, numbers behind it."""
    expressions = {name: value for name, value in lengths.items() if isinstance(value, sp.Expr)}
    numbers = {name: value for name, value in lengths.items() if name not in expressions}
    table = table.with_values(numbers, limits)
    return Robot(table.at(expressions) if expressions else table, model)


def _robot(model: type[InverseModel] | None) -> Callable[[Callable[..., DHTable]], Callable[..., Robot]]:
    """Turns a function that returns a table into one that returns a robot, and enters it in the catalogue.

    Its arguments with a number as default are lengths: the table is made with letters of the same names, the numbers
    are put behind them. A further argument ``limits`` takes joint limits.
    """

    def decorate(table: Callable[..., DHTable]) -> Callable[..., Robot]:
        signature = inspect.signature(table)
        lengths = [name for name, each in signature.parameters.items() if isinstance(each.default, int | float)]
        letters = {name: sp.Symbol(name) for name in lengths}
        only_lengths = cache(partial(table, **letters))

        @wraps(table)
        def robot(*args: Any, limits: Limits | None = None, **named: Any) -> Robot:
            given = signature.bind(*args, **named)
            given.apply_defaults()
            others = {name: value for name, value in given.arguments.items() if name not in letters}
            in_letters = table(**others, **letters) if others else only_lengths()
            return _with_values(in_letters, model, {name: given.arguments[name] for name in lengths}, limits)

        limits = inspect.Parameter("limits", inspect.Parameter.KEYWORD_ONLY, default=None, annotation="Limits | None")
        shown = signature.replace(parameters=[*signature.parameters.values(), limits], return_annotation="Robot")
        robot.__signature__ = shown  # type: ignore[attr-defined]  # what help() shows
        _DEFAULTS[table.__name__.upper()] = robot
        return robot

    return decorate


_DEFAULTS: dict[str, Callable[[], Robot]] = {}
_PARALLEL = {"THREE_RPR": ThreeRPR, "THREE_RRR": ThreeRRR}


@cache
def _default(name: str) -> Robot | ThreeRPR | ThreeRRR:
    return (_DEFAULTS | _PARALLEL)[name]()


def __getattr__(name: str) -> Robot | ThreeRPR | ThreeRRR:
    if name in _DEFAULTS or name in _PARALLEL:
        return _default(name)
    raise AttributeError(f"no robot {name}: there are {', '.join(_DEFAULTS | _PARALLEL)}")


def __dir__() -> list[str]:
    return [*globals(), *_DEFAULTS, *_PARALLEL]


def names() -> tuple[str, ...]:
    """Names of the serial robots with default lengths."""
    return tuple(_DEFAULTS)


@_robot(PlanarArm)
def planar_2r(L1: Entry = 1.0, L2: Entry = 0.6) -> DHTable:
    """Planar two-link arm of the EPFL slides, tool point at L2."""
    return DHTable([(0, 0, 0, 0, _t1), (0, L1, 0, 0, _t2)], "planar 2R", tool=trans_x(L2))


def planar_3r(l1: Entry = 0.5, l2: Entry = 0.4, l3: Entry = 0.2, limits: Limits | None = None) -> Robot:
    """Planar three-link arm of the DH-m slides (Romanian), with the tip at l3."""
    return planar((l1, l2, l3), limits)


def planar(lengths: Sequence[Entry], limits: Limits | None = None) -> Robot:
    """Planar arm with one revolute joint per link, of lengths l1, l2, ...; redundant with more than three."""
    n = len(lengths)
    joints, letters = sp.symbols(f"t1:{n + 1}"), sp.symbols(f"l1:{n + 1}")
    rows = [(0, a, 0, 0, joint) for a, joint in zip((0, *letters), joints)]
    table = DHTable(rows, f"planar {n}R", tool=trans_x(letters[-1]))
    return _with_values(table, PlanarArm, {letter.name: length for letter, length in zip(letters, lengths)}, limits)


_DEFAULTS |= {"PLANAR_3R": planar_3r, "PLANAR_4R": lambda: planar((0.4, 0.3, 0.25, 0.15))}


@_robot(Scara)
def scara(a2: Entry = 0.4, a3: Entry = 0.3) -> DHTable:
    """SCARA of the MECA 953 slides; joint 3 is the depth d2 of the quill, downwards."""
    d2 = sp.Symbol("d2")
    return DHTable([(0, 0, 0, 0, _t1), (0, a2, 0, 0, _t2), (1, a3, 0, -d2, 0), (0, 0, 0, 0, _t4)], "SCARA")


@_robot(Scara)
def scara_epfl(L1: Entry = 0.4, L2: Entry = 0.3, L4: Entry = 0.1) -> DHTable:
    """SCARA of the EPFL slides with its tool point L4; joint 3 (t3) is the height."""
    rows = [(0, 0, 0, 0, _t1), (0, L1, 0, 0, _t2), (1, L2, 0, _t3, 0), (0, 0, 0, 0, _t4)]
    return DHTable(rows, "SCARA with tool", tool=trans_x(L4))


@_robot(Scara)
def adept_s600(d2: Entry = 0.325, d3: Entry = 0.275, r30: Entry = 0.0) -> DHTable:
    """Adept Cobra s600 of the s600 tutorial, in its letters (d, r); axis 4 points down."""
    r3 = sp.Symbol("r3")
    rows = [(0, 0, 0, 0, _t1), (0, d2, 0, 0, _t2), (1, d3, 0, r3 + r30, 0), (0, 0, sp.pi, 0, _t4)]
    return DHTable(rows, "Adept s600", (_t1, _t2, r3, _t4))


@_robot(WristedArm)
def rx90(a3: Entry = 0.45, d3: Entry = 0.45) -> DHTable:
    """Stäubli RX-90 of the MECA 953 slides."""
    rows = [
        (0, 0, 0, 0, _t1),
        (0, 0, _HALF, 0, _t2),
        (0, a3, 0, 0, _t3),
        (0, 0, -_HALF, d3, _t4),
        (0, 0, _HALF, 0, _t5),
        (0, 0, -_HALF, 0, _t6),
    ]
    return DHTable(rows, "RX-90")


@_robot(WristAlone)
def spherical_wrist(d6: Entry = 0.1) -> DHTable:
    """Spherical wrist of the MECA 953 slides, its classic rows rewritten in modified DH."""
    return DHTable([(0, 0, 0, 0, _t4), (0, 0, -_HALF, 0, _t5), (0, 0, _HALF, d6, _t6)], "spherical wrist")


KR210_JOINTS = (
    UrdfJoint((0, 0, 0.33), axis=(0, 0, 1)),
    UrdfJoint((0.35, 0, 0.42), axis=(0, 1, 0)),
    UrdfJoint((0, 0, 1.25), axis=(0, 1, 0)),
    UrdfJoint((0.96, 0, -0.054), axis=(1, 0, 0)),
    UrdfJoint((0.54, 0, 0), axis=(0, 1, 0)),
    UrdfJoint((0.193, 0, 0), axis=(1, 0, 0)),
    UrdfJoint((0.11, 0, 0), kind="fixed"),
)
"""Joint list of the KR210 in the MECA 953 slides, with the axes of its public description."""


@_robot(WristedArm)
def kr210(
    d1: Entry = 0.75,
    a1: Entry = 0.35,
    a2: Entry = 1.25,
    a3: Entry = -0.054,
    d4: Entry = 1.5,
    grip: Entry = 0.303,
) -> DHTable:
    """KR210 from the joint list of the MECA 953 slides (axes of its public description).

    Its poses are those of the URDF's gripper link: the tool turns the last DHm frame by
    Rot_z(180) Rot_y(-90 degrees).
    """
    q1, q2, q3, q4, q5, q6 = sp.symbols("q1:7")
    rows = [
        (0, 0, 0, d1, q1),
        (0, a1, -_HALF, 0, q2 - _HALF),
        (0, a2, 0, 0, q3),
        (0, a3, -_HALF, d4, q4),
        (0, 0, _HALF, 0, q5),
        (0, 0, -_HALF, 0, q6),
    ]
    return DHTable(rows, "KR210", tool=trans_z(grip) * rot_z(sp.pi) * rot_y(-_HALF))


@_robot(WristedArm)
def epfl_arm(D3: Entry = 0.2, L2: Entry = 0.5, D4: Entry = 0.6, h: Entry = 0.0) -> DHTable:
    """Six-axis arm of the EPFL slides; tool point at h from the wrist centre.

    `centres.epfl_centres` gives the same model as rotations about centres.
    """
    rows = [
        (0, 0, 0, 0, _t1 + _HALF),
        (0, 0, _HALF, 0, _t2 + _HALF),
        (0, L2, 0, D3, _t3 + _HALF),
        (0, 0, _HALF, D4, _t4 + sp.pi),
        (0, 0, _HALF, 0, _t5 + sp.pi),
        (0, 0, _HALF, 0, _t6 + _HALF),
    ]
    return DHTable(rows, "EPFL six-axis arm", tool=trans_z(h))


@_robot(ElbowArm)
def elbow_3r(L1: Entry = 0.5, L2: Entry = 0.4) -> DHTable:
    """Elbow arm of the DH-m slides (Romanian); the last row carries the tool point."""
    return DHTable([(0, 0, 0, 0, _t1), (0, 0, _HALF, 0, _t2), (0, L1, 0, 0, _t3), (0, L2, 0, 0, 0)], "elbow 3R")


@_robot(WristedArm)
def puma(a2: Entry = 0.43, a3: Entry = 0.02, d2: Entry = 0.15, d4: Entry = 0.43, d6: Entry = 0.06) -> DHTable:
    """PUMA-like arm of the DH-m slides (Romanian), row 6 corrected to alpha = -90 degrees."""
    return DHTable(_puma_rows(a2, a3, d2, d4, d6, -_HALF), "PUMA-like arm")


@_robot(None)
def puma_printed(a2: Entry = 0.43, a3: Entry = 0.02, d2: Entry = 0.15, d4: Entry = 0.43, d6: Entry = 0.06) -> DHTable:
    """PUMA-like arm as printed: row 6 with alpha = 0 puts axis 6 on axis 5.

    It has five freedoms instead of six (`singularities.mobility`) and no inverse model.
    """
    return DHTable(_puma_rows(a2, a3, d2, d4, d6, 0), "PUMA-like arm as printed")


def _puma_rows(a2: Entry, a3: Entry, d2: Entry, d4: Entry, d6: Entry, last_twist: Entry) -> list[tuple]:
    return [
        (0, 0, 0, 0, _t1),
        (0, 0, -_HALF, 0, _t2),
        (0, a2, 0, d2, _t3),
        (0, a3, -_HALF, d4, _t4),
        (0, 0, _HALF, 0, _t5),
        (0, 0, last_twist, d6, _t6),
    ]


@_robot(PenArm)
def pen(
    h1: Entry = 0.1,
    L1: Entry = 0.3,
    h2: Entry = 0.12,
    L2: Entry = 0.08,
    p1: Entry = 0.5,
    reading: str = "printed",
) -> DHTable:
    """Pen robot as printed, or with its remark on the parallelogram read in one of three ways.

    reading: "printed" (joint 2 enters as t2 - pi/2), "A" (t2 - t1 - pi/2), "B" (t2 - t1 - pi:
    substituted inside t2 - pi/2), "C" (t2, the text's "SCARA"). The tool is the pen tip at
    p1. Raises ValueError for another reading.
    """
    entries = {
        "printed": _t2 - _HALF,
        "A": _t2 - _t1 - _HALF,
        "B": _t2 - _t1 - sp.pi,
        "C": _t2,
    }
    if reading not in entries:
        raise ValueError(f"reading must be one of {', '.join(entries)}, found {reading!r}")
    rows = [(0, 0, 0, h1, _t1), (0, L1, -_HALF, h2, entries[reading]), (0, 0, 0, L2, _t3)]
    name = "pen robot" if reading == "printed" else f"pen robot, reading {reading}"
    return DHTable(rows, name, (_t1, _t2, _t3), tool=trans_x(p1))


_DEFAULTS |= {f"PEN_{reading}": partial(pen, reading=reading) for reading in "ABC"}


@_robot(ElbowArm)
def pen_repaired(h1: Entry = 0.1, L1: Entry = 0.3, h2: Entry = 0.2, L2: Entry = 0.25, p1: Entry = 0.5) -> DHTable:
    """Pen robot with L2 taken as a link length: a hypothetical repair, three real freedoms."""
    rows = [(0, 0, 0, h1, _t1), (0, L1, -_HALF, h2, _t2 - _HALF), (0, L2, 0, 0, _t3)]
    return DHTable(rows, "pen robot, repaired", tool=trans_x(p1))
