"""Where two chains part, and by what: the first quantity between two joint axes that is not the reference's."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from dhkit.geometry import common_normal, cross

from .alignment import DeadEnd
from .frames import JudgedChain

_SAME_COEFFICIENT = 1e-7
_PARALLEL = 1e-7


@dataclass(frozen=True)
class Parting:
    """The first joint (from 1) at which two chains part.

    quantity: what differs there. found, expected: its values where they are the same for all lengths (metres,
    degrees, or words), else None.
    """

    joint: int
    quantity: str
    found: float | str | None = None
    expected: float | str | None = None

    def __str__(self) -> str:
        found, expected = self.found, self.expected
        if found is None or expected is None:
            return f"joint {self.joint}: {self.quantity} differs"
        if isinstance(found, str) or isinstance(expected, str):
            return f"joint {self.joint}: {found} instead of {expected}"
        unit, digits = (" deg", 2) if "twist" in self.quantity else ("", 4)
        return f"joint {self.joint}: {self.quantity} {_short(found, digits)}{unit} instead of {_short(expected, digits)}{unit}"


def _short(value: float, digits: int) -> str:
    return f"{round(value, digits) + 0.0:.6g}"


def parting_of_joints(student: JudgedChain, reference: JudgedChain) -> Parting | None:
    """The first joint that is not of the same type or not moved by the same variables; None if there is none."""
    for i in range(max(student.joints, reference.joints)):
        kinds = [_kind(chain, i) for chain in (student, reference)]
        if kinds[0] != kinds[1]:
            return Parting(i + 1, "type", *kinds)
        if np.abs(np.abs(student.coupling[i]) - np.abs(reference.coupling[i])).max() > _SAME_COEFFICIENT:
            return Parting(i + 1, "joint variable", *(_moved_by(chain, i) for chain in (student, reference)))
    return None


def _kind(chain: JudgedChain, joint: int) -> str:
    if joint >= chain.joints:
        return "no joint"
    return "prismatic" if chain.prismatic[joint] else "revolute"


def _moved_by(chain: JudgedChain, joint: int) -> str:
    terms = [(c, name) for c, name in zip(chain.coupling[joint], chain.variables, strict=True) if c]
    text = " ".join(f"{'-' if c < 0 else '+'} {'' if abs(c) == 1 else f'{abs(c):.4g} '}{name}" for c, name in terms)
    return f"moved by {text.removeprefix('+ ').replace('- ', '-', text.startswith('-'))}"


def parting_of_signs(reference: JudgedChain) -> Parting:
    """What is told where joints share variables with signs that cannot be matched."""
    coupled = (reference.coupling != 0).sum(axis=1) > 1
    return Parting(int(np.argmax(coupled)) + 1, "sign of a joint variable")


def parting_of_axes(student: JudgedChain, reference: JudgedChain, end: DeadEnd, tolerance: float) -> Parting:
    """The first quantity between the joints of a dead end's segment that is not the reference's."""
    segment = end.segment
    for before, joint in pairwise(segment.directions):
        found, expected = (_twist(chain, before, joint) for chain in (student, reference))
        if np.abs(np.abs(np.cos(found)) - np.abs(np.cos(expected))).max() > tolerance:
            return Parting(joint + 1, f"twist from Z{before + 1}", *_degrees(found, expected))
    if segment.entry is None or segment.exit is None or segment.sliders:
        return Parting(segment.directions[-1] + 1, "place of its axis" if end.turned else "direction of its axis")
    return _parting_of_link(student, reference, segment.entry, segment.exit, end, tolerance)


def _parting_of_link(
    student: JudgedChain, reference: JudgedChain, before: int, joint: int, end: DeadEnd, tolerance: float
) -> Parting:
    """The same where the segment is one link between two revolute joints, with the right twist up to its sense."""
    found, expected = (_distance(chain, before, joint) for chain in (student, reference))
    if np.abs(np.abs(found) - np.abs(expected)).max() > tolerance:
        values = _steady(np.abs(found), np.abs(expected))
        return Parting(joint + 1, f"distance between axes {before + 1} and {joint + 1}", *values)
    twist, expected_twist = (_twist(chain, before, joint) for chain in (student, reference))
    if np.abs(found * np.cos(twist) - expected * np.cos(expected_twist)).max() > tolerance:
        signed = twist * np.where(found < 0, -1, 1), expected_twist * np.where(expected < 0, -1, 1)
        return Parting(joint + 1, f"twist from Z{before + 1}", *_degrees(*signed))
    offset, expected_offset = (_offset(chain, before, joint) for chain in (student, reference))
    sense = end.senses.get(before, 1)
    if offset is None or expected_offset is None or np.abs(sense * offset - expected_offset).max() <= tolerance:
        return Parting(joint + 1, "place of its axis")
    return Parting(before + 1, f"offset along Z{before + 1}", *_steady(sense * offset, expected_offset))


def _twist(chain: JudgedChain, before: int, joint: int) -> np.ndarray:
    """Angle between two axes, 0 to pi, (K,)."""
    first, second = chain.axes[:, before], chain.axes[:, joint]
    return np.arctan2(np.linalg.norm(cross(first, second), axis=-1), (first * second).sum(axis=-1))


def _distance(chain: JudgedChain, before: int, joint: int) -> np.ndarray:
    """Distance between two axes, along the vector product of the two unless they are parallel, (K,)."""
    first, second = chain.axes[:, before], chain.axes[:, joint]
    between = chain.origins[:, joint] - chain.origins[:, before]
    normal = cross(first, second)
    sine = np.linalg.norm(normal, axis=-1)
    across = np.linalg.norm(cross(first, between), axis=-1)
    return np.where(sine > _PARALLEL, (between * normal).sum(axis=-1) / sine, across)


def _foot(chain: JudgedChain, joint: int, other: int) -> np.ndarray | None:
    """Foot, on the axis of `joint`, of its common normal with the axis of `other`, (K, 3); None if they are parallel."""
    here, there = ((chain.origins[:, i], chain.axes[:, i]) for i in (joint, other))
    normal = common_normal(here, there, _PARALLEL)
    return None if normal.parallel.any() else normal.feet[:, 0]


def _offset(chain: JudgedChain, before: int, joint: int) -> np.ndarray | None:
    """Along the axis of `before`, from the common normal with the axis before it to the one with `joint`, (K,).

    The normal before is carried over from the last axis that is not parallel; None where there is none, or where a
    prismatic joint stands between.
    """
    revolute = [i for i, slides in enumerate(chain.prismatic) if not slides]
    foot = None
    for first, second in pairwise(revolute[: revolute.index(before) + 1]):
        if second - first > 1:
            return None
        here = _foot(chain, second, first)
        if here is not None:
            foot = here
        elif foot is not None:
            axis, origin = chain.axes[:, second], chain.origins[:, second]
            foot = origin + ((foot - origin) * axis).sum(axis=-1, keepdims=True) * axis
    after = _foot(chain, before, joint)
    if foot is None or after is None:
        return None
    return ((after - foot) * chain.axes[:, before]).sum(axis=-1)


def _steady(found: np.ndarray, expected: np.ndarray) -> tuple[float | None, float | None]:
    """The two values where they do not depend on the sample point, else None."""
    steady = np.ptp(found) < _PARALLEL and np.ptp(expected) < _PARALLEL
    return (float(found[0]), float(expected[0])) if steady else (None, None)


def _degrees(found: np.ndarray, expected: np.ndarray) -> tuple[float | None, float | None]:
    return _steady(np.degrees(found), np.degrees(expected))
