"""The robots of the course's documents, as tables with their inverse models.

Functions build a robot for given lengths (metres); the constants in capitals are the same
robots with default lengths, made at first use: ``robots.SCARA``, ``robots.scara(a2=0.4)``.
The parallel robots ``robots.THREE_RPR`` and ``robots.THREE_RRR`` have models of their own kind.
Joint angles in radians, poses 4x4. Sources are named with each robot.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import sympy as sp

from . import singularities
from .elbow import ElbowArm, WristAlone, WristedArm
from .elementary import rot_y, rot_z, trans_x, trans_z
from .inverse import TOLERANCE, InverseModel
from .parallel import ThreeRPR, ThreeRRR
from .pen import PenArm
from .planar_arms import PlanarArm, Scara
from .solutions import Batch, Nearest, Solutions
from .tables import DHTable
from .urdf import UrdfJoint

_t1, _t2, _t3, _t4, _t5, _t6 = sp.symbols("t1:7")
_HALF = sp.pi / 2


@dataclass(frozen=True)
class Robot:
    """A serial robot: a DHm table with values for its letters, and an inverse model.

    table: letters for the lengths as in the documents, and numbers behind them.
    model: class of the closed-form inverse model, or None where there is none.
    """

    table: DHTable
    model: type[InverseModel] | None

    @property
    def name(self) -> str:
        """What the robot is called."""
        return self.table.name

    @cached_property
    def inverse(self) -> InverseModel:
        """The inverse model. Raises ValueError when the robot has none."""
        if self.model is None:
            raise ValueError(f"{self.name} has no inverse model: its table is degenerate")
        return self.model(self.table)

    def forward(self, q) -> np.ndarray:
        """Poses (..., 4, 4) for joint values q (..., n), radians or metres."""
        return self.table.forward(q)

    def symbolic_forward(self) -> sp.Matrix:
        """Direct model, 4x4, with letters for joints and lengths, in textbook form."""
        return self.table.symbolic_forward()

    def jacobian(self, q) -> np.ndarray:
        """Geometric Jacobian (..., 6, n) of the tool point at q (..., n)."""
        return singularities.jacobian(self.table, q)

    def solve(self, T, near=None, tol: float = TOLERANCE, limits: bool = False) -> Solutions:
        """All postures for a pose (4, 4) or task coordinates: see InverseModel.solve."""
        return self.inverse.solve(T, near, tol, limits)

    def solve_batch(self, T, near=None, tol: float = TOLERANCE, limits: bool = False) -> Batch:
        """All postures for N poses: see InverseModel.solve_batch."""
        return self.inverse.solve_batch(T, near, tol, limits)

    def nearest(self, T, q0, tol: float = TOLERANCE, limits: bool = False) -> Nearest:
        """The posture nearest to q0 (n,): see InverseModel.nearest."""
        return self.inverse.nearest(T, q0, tol, limits)

    def nearest_batch(self, T, q0, tol: float = TOLERANCE, limits: bool = False):
        """Nearest postures for N poses: see InverseModel.nearest_batch."""
        return self.inverse.nearest_batch(T, q0, tol, limits)


def _robot(name: str, model, rows, values, joints=None, limits=None, tool=None) -> Robot:
    """A robot from symbolic rows; lengths given as sympy expressions go into the table."""
    letters = {name: v for name, v in values.items() if isinstance(v, sp.Expr)}
    numbers = {name: v for name, v in values.items() if name not in letters}
    table = DHTable(rows, name, joints, None, tool, limits, numbers)
    return Robot(table.at(letters) if letters else table, model)


def planar_2r(L1: float = 1.0, L2: float = 0.6, limits=None) -> Robot:
    """Planar two-link arm of the EPFL slides, tool point at L2."""
    l1, l2 = sp.symbols("L1 L2")
    rows = [(0, 0, 0, 0, _t1), (0, l1, 0, 0, _t2)]
    values = {"L1": L1, "L2": L2}
    return _robot("planar 2R", PlanarArm, rows, values, limits=limits, tool=trans_x(l2))


def planar_3r(l1: float = 0.5, l2: float = 0.4, l3: float = 0.2, limits=None) -> Robot:
    """Planar three-link arm of the DH-m slides (Romanian), with the tip at l3."""
    return planar((l1, l2, l3), limits)


def planar(lengths: Sequence[float], limits=None) -> Robot:
    """Planar arm with one revolute joint per link; redundant with more than three."""
    n = len(lengths)
    joints, letters = sp.symbols(f"t1:{n + 1}"), sp.symbols(f"l1:{n + 1}")
    rows = [(0, a, 0, 0, joint) for a, joint in zip((0, *letters), joints)]
    values = {letter.name: length for letter, length in zip(letters, lengths)}
    tool = trans_x(letters[-1])
    return _robot(f"planar {n}R", PlanarArm, rows, values, limits=limits, tool=tool)


def scara(a2: float = 0.4, a3: float = 0.3, limits=None) -> Robot:
    """SCARA of the MECA 953 slides; joint 3 is the depth d2 of the quill, downwards."""
    a2_, a3_, d2 = sp.symbols("a2 a3 d2")
    rows = [(0, 0, 0, 0, _t1), (0, a2_, 0, 0, _t2), (1, a3_, 0, -d2, 0), (0, 0, 0, 0, _t4)]
    return _robot("SCARA", Scara, rows, {"a2": a2, "a3": a3}, limits=limits)


def scara_epfl(L1: float = 0.4, L2: float = 0.3, L4: float = 0.1, limits=None) -> Robot:
    """SCARA of the EPFL slides with its tool point L4; joint 3 (t3) is the height."""
    l1, l2, l4 = sp.symbols("L1 L2 L4")
    rows = [(0, 0, 0, 0, _t1), (0, l1, 0, 0, _t2), (1, l2, 0, _t3, 0), (0, 0, 0, 0, _t4)]
    values = {"L1": L1, "L2": L2, "L4": L4}
    return _robot("SCARA with tool", Scara, rows, values, limits=limits, tool=trans_x(l4))


def adept_s600(d2: float = 0.325, d3: float = 0.275, r30: float = 0.0, limits=None) -> Robot:
    """Adept Cobra s600 of the s600 tutorial, in its letters (d, r); axis 4 points down."""
    d2_, d3_, r3, r30_ = sp.symbols("d2 d3 r3 r30")
    rows = [(0, 0, 0, 0, _t1), (0, d2_, 0, 0, _t2), (1, d3_, 0, r3 + r30_, 0), (0, 0, sp.pi, 0, _t4)]
    values = {"d2": d2, "d3": d3, "r30": r30}
    return _robot("Adept s600", Scara, rows, values, (_t1, _t2, r3, _t4), limits)


def rx90(a3: float = 0.45, d3: float = 0.45, limits=None) -> Robot:
    """Stäubli RX-90 of the MECA 953 slides."""
    a3_, d3_ = sp.symbols("a3 d3")
    rows = [
        (0, 0, 0, 0, _t1),
        (0, 0, _HALF, 0, _t2),
        (0, a3_, 0, 0, _t3),
        (0, 0, -_HALF, d3_, _t4),
        (0, 0, _HALF, 0, _t5),
        (0, 0, -_HALF, 0, _t6),
    ]
    return _robot("RX-90", WristedArm, rows, {"a3": a3, "d3": d3}, limits=limits)


def spherical_wrist(d6: float = 0.1, limits=None) -> Robot:
    """Spherical wrist of the MECA 953 slides, its classic rows rewritten in modified DH."""
    rows = [(0, 0, 0, 0, _t4), (0, 0, -_HALF, 0, _t5), (0, 0, _HALF, sp.Symbol("d6"), _t6)]
    return _robot("spherical wrist", WristAlone, rows, {"d6": d6}, limits=limits)


KR210_JOINTS = (
    UrdfJoint((0, 0, 0.33), axis=(0, 0, 1)),
    UrdfJoint((0.35, 0, 0.42), axis=(0, 1, 0)),
    UrdfJoint((0, 0, 1.25), axis=(0, 1, 0)),
    UrdfJoint((0.96, 0, -0.054), axis=(1, 0, 0)),
    UrdfJoint((0.54, 0, 0), axis=(0, 1, 0)),
    UrdfJoint((0.193, 0, 0), axis=(1, 0, 0)),
    UrdfJoint((0.11, 0, 0), kind="fixed"),
)


def kr210(
    d1: float = 0.75,
    a1: float = 0.35,
    a2: float = 1.25,
    a3: float = -0.054,
    d4: float = 1.5,
    grip: float = 0.303,
    limits=None,
) -> Robot:
    """KR210 from the joint list of the MECA 953 slides (axes of its public description).

    Its poses are those of the URDF's gripper link: the tool turns the last DHm frame by
    Rot_z(180) Rot_y(-90 degrees).
    """
    letters = sp.symbols("d1 a1 a2 a3 d4 grip")
    d1_, a1_, a2_, a3_, d4_, grip_ = letters
    q1, q2, q3, q4, q5, q6 = sp.symbols("q1:7")
    rows = [
        (0, 0, 0, d1_, q1),
        (0, a1_, -_HALF, 0, q2 - _HALF),
        (0, a2_, 0, 0, q3),
        (0, a3_, -_HALF, d4_, q4),
        (0, 0, _HALF, 0, q5),
        (0, 0, -_HALF, 0, q6),
    ]
    values = {s.name: v for s, v in zip(letters, (d1, a1, a2, a3, d4, grip))}
    tool = trans_z(grip_) * rot_z(sp.pi) * rot_y(-_HALF)
    return _robot("KR210", WristedArm, rows, values, limits=limits, tool=tool)


def epfl_arm(D3: float = 0.2, L2: float = 0.5, D4: float = 0.6, h: float = 0.0, limits=None) -> Robot:
    """Six-axis arm of the EPFL slides; tool point at h from the wrist centre.

    `centres.epfl_centres` gives the same model as rotations about centres.
    """
    d3, l2, d4 = sp.symbols("D3 L2 D4")
    rows = [
        (0, 0, 0, 0, _t1 + _HALF),
        (0, 0, _HALF, 0, _t2 + _HALF),
        (0, l2, 0, d3, _t3 + _HALF),
        (0, 0, _HALF, d4, _t4 + sp.pi),
        (0, 0, _HALF, 0, _t5 + sp.pi),
        (0, 0, _HALF, 0, _t6 + _HALF),
    ]
    values = {"D3": D3, "L2": L2, "D4": D4, "h": h}
    tool = trans_z(sp.Symbol("h"))
    return _robot("EPFL six-axis arm", WristedArm, rows, values, limits=limits, tool=tool)


def elbow_3r(L1: float = 0.5, L2: float = 0.4, limits=None) -> Robot:
    """Elbow arm of the DH-m slides (Romanian); the last row carries the tool point."""
    l1, l2 = sp.symbols("L1 L2")
    rows = [(0, 0, 0, 0, _t1), (0, 0, _HALF, 0, _t2), (0, l1, 0, 0, _t3), (0, l2, 0, 0, 0)]
    return _robot("elbow 3R", ElbowArm, rows, {"L1": L1, "L2": L2}, limits=limits)


def puma(
    a2: float = 0.43,
    a3: float = 0.02,
    d2: float = 0.15,
    d4: float = 0.43,
    d6: float = 0.06,
    limits=None,
) -> Robot:
    """PUMA-like arm of the DH-m slides (Romanian), row 6 corrected to alpha = -90 degrees."""
    return _puma("PUMA-like arm", WristedArm, -_HALF, (a2, a3, d2, d4, d6), limits)


def puma_printed(a2: float = 0.43, a3: float = 0.02, d2: float = 0.15, d4: float = 0.43, d6: float = 0.06) -> Robot:
    """PUMA-like arm as printed: row 6 with alpha = 0 puts axis 6 on axis 5.

    It has five freedoms instead of six (`singularities.mobility`) and no inverse model.
    """
    return _puma("PUMA-like arm as printed", None, 0, (a2, a3, d2, d4, d6), None)


def _puma(name, model, alpha, lengths, limits) -> Robot:
    letters = sp.symbols("a2 a3 d2 d4 d6")
    a2, a3, d2, d4, d6 = letters
    rows = [
        (0, 0, 0, 0, _t1),
        (0, 0, -_HALF, 0, _t2),
        (0, a2, 0, d2, _t3),
        (0, a3, -_HALF, d4, _t4),
        (0, 0, _HALF, 0, _t5),
        (0, 0, alpha, d6, _t6),
    ]
    values = {letter.name: length for letter, length in zip(letters, lengths)}
    return _robot(name, model, rows, values, limits=limits)


def pen(
    h1: float = 0.1,
    L1: float = 0.3,
    h2: float = 0.12,
    L2: float = 0.08,
    p1: float = 0.5,
    reading: str = "printed",
) -> Robot:
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
    h1_, l1, h2_, l2, p1_ = sp.symbols("h1 L1 h2 L2 p1")
    rows = [(0, 0, 0, h1_, _t1), (0, l1, -_HALF, h2_, entries[reading]), (0, 0, 0, l2, _t3)]
    values = {"h1": h1, "L1": L1, "h2": h2, "L2": L2, "p1": p1}
    name = "pen robot" if reading == "printed" else f"pen robot, reading {reading}"
    return _robot(name, PenArm, rows, values, (_t1, _t2, _t3), tool=trans_x(p1_))


def pen_repaired(
    h1: float = 0.1,
    L1: float = 0.3,
    h2: float = 0.2,
    L2: float = 0.25,
    p1: float = 0.5,
    limits=None,
) -> Robot:
    """Pen robot with L2 taken as a link length: a hypothetical repair, three real freedoms."""
    h1_, l1, h2_, l2, p1_ = sp.symbols("h1 L1 h2 L2 p1")
    rows = [(0, 0, 0, h1_, _t1), (0, l1, -_HALF, h2_, _t2 - _HALF), (0, l2, 0, 0, _t3)]
    values = {"h1": h1, "L1": L1, "h2": h2, "L2": L2, "p1": p1}
    tool = trans_x(p1_)
    return _robot("pen robot, repaired", ElbowArm, rows, values, limits=limits, tool=tool)


_DEFAULTS: dict[str, Callable[[], Robot]] = {
    "PLANAR_2R": planar_2r,
    "PLANAR_3R": planar_3r,
    "PLANAR_4R": lambda: planar((0.4, 0.3, 0.25, 0.15)),
    "SCARA": scara,
    "SCARA_EPFL": scara_epfl,
    "ADEPT_S600": adept_s600,
    "RX90": rx90,
    "SPHERICAL_WRIST": spherical_wrist,
    "KR210": kr210,
    "EPFL_ARM": epfl_arm,
    "ELBOW_3R": elbow_3r,
    "PUMA": puma,
    "PUMA_PRINTED": puma_printed,
    "PEN": pen,
    "PEN_A": lambda: pen(reading="A"),
    "PEN_B": lambda: pen(reading="B"),
    "PEN_C": lambda: pen(reading="C"),
    "PEN_REPAIRED": pen_repaired,
}

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
