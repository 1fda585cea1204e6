"""Whether two modified DH tables describe the same chain, which freedoms of the convention that takes, or where they part."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise, product

import numpy as np

from .alignment import Alignment, Freedom, Parted, Price, Segment, align, segments
from .frames import MAX_JOINTS, JudgedChain, cross

TOLERANCE = 1e-6

SAME_MODEL = frozenset({Freedom.BASE, Freedom.TOOL, Freedom.ZERO, Freedom.SENSE})
"""Pinned together, these leave only the choice of frames between base and tool: T(q) itself must be the same."""

# Fewer freedoms explain a difference better; frames at the ends and joint variables count for more than the choice
# of a frame between them.
_PRICES = {Freedom.BASE: 2.5, Freedom.TOOL: 2.5, Freedom.ZERO: 2.0, Freedom.SENSE: 2.0}
_PRICE_OF_PINNED = 100.0
_SAME_COEFFICIENT = 1e-7
_PARALLEL = 1e-7
_ROUNDING = 1e-9


@dataclass(frozen=True, order=True)
class Used:
    """A freedom that was used, and the joint (from 1; 0 for base and tool) it was used at."""

    freedom: Freedom
    joint: int = 0

    def __str__(self) -> str:
        match self.freedom:
            case Freedom.BASE | Freedom.TOOL:
                return str(self.freedom)
            case Freedom.ZERO | Freedom.SENSE:
                return f"{self.freedom} {self.joint}"
            case Freedom.ORIGIN:
                return f"origin O{self.joint} along Z{self.joint}"
        return f"{self.freedom}{self.joint}"


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
        if isinstance(self.found, str):
            return f"joint {self.joint}: {self.found} instead of {self.expected}"
        if self.found is None or self.expected is None:
            return f"joint {self.joint}: {self.quantity} differs"
        unit, digits = (" deg", 2) if "twist" in self.quantity else ("", 4)
        return f"joint {self.joint}: {self.quantity} {_short(self.found, digits)}{unit} instead of {_short(self.expected, digits)}{unit}"


def _short(value: float, digits: int) -> str:
    return f"{round(value, digits) + 0.0:.6g}"


@dataclass(frozen=True)
class ChainMatch:
    """How a student's chain compares with the reference.

    Attributes
    ----------
    equal : bool
        The same chain, and no pinned freedom used.
    senses : tuple of int, or None
        s of the joint map ``q_ref = s q + o``, +1 or -1; None where there is no map.
    offsets : (K, m) array, or None
        o of the joint map at the K sample points, radians in (-pi, pi] or metres.
    base, tool : (K, 4, 4) arrays, or None
        B and E of ``T_ref(s q + o) = B T(q) E``.
    freedoms : tuple of Used
        What the two tables differ in although they describe the same chain.
    pinned : tuple of Used
        Those of them that the question does not leave free.
    parting : Parting or None
        Where and by what the chains part, if they do.
    """

    equal: bool
    senses: tuple[int, ...] | None = None
    offsets: np.ndarray | None = None
    base: np.ndarray | None = None
    tool: np.ndarray | None = None
    freedoms: tuple[Used, ...] = ()
    pinned: tuple[Used, ...] = ()
    parting: Parting | None = None

    @property
    def remarks(self) -> tuple[str, ...]:
        """Why the tables are not equal, in words; nothing if they are."""
        if self.parting:
            return (str(self.parting),)
        return tuple(f"the same chain, but with another {used}" for used in self.pinned)


def same_chain(
    student: JudgedChain, reference: JudgedChain, *, pinned: Collection[str] = (), tolerance: float = TOLERANCE
) -> ChainMatch:
    """Compare two chains given at the same sample points.

    pinned: freedoms that a right answer may not use, each for all joints (``"zero of joint"``, ``"sense of Z"``,
    ``Freedom.BASE``) or for one, written as in `ChainMatch.freedoms` (``"zero of joint 3"``, ``"sense of X2"``).
    tolerance: largest accepted difference, in radians, and in lengths relative to the larger of 1 m and the robot.

    Raises ValueError for a name in `pinned` that is no freedom, or different numbers of sample points.
    """
    pins = _Pins(pinned)
    student, reference = _at_same_points(student, reference)
    with np.errstate(all="ignore"):
        comparable, mismatch = _common_part(student, reference)
        if mismatch:
            if not comparable:
                return ChainMatch(False, parting=mismatch)
            cut = student.first(comparable), reference.first(comparable)
            found = _best(*cut, pins.as_cost, tolerance)
            return ChainMatch(
                False, parting=_parting(*cut, found, tolerance) if isinstance(found, Parted) else mismatch
            )
        found = _best(student, reference, pins.as_wall, tolerance)
        if isinstance(found, Parted) and pins.given:
            found = _best(student, reference, pins.as_cost, tolerance)
        if isinstance(found, Parted):
            return ChainMatch(False, parting=_parting(student, reference, found, tolerance))
        return _match(student, reference, found, pins, tolerance)


class _Pins:
    def __init__(self, pinned: Collection[str]) -> None:
        self.given = frozenset(map(str, [pinned] if isinstance(pinned, str) else pinned))
        for name in self.given - _NAMES:
            raise ValueError(
                f"no freedom {name!r}: there are {', '.join(Freedom)}, and those of one joint, like {Used(Freedom.Z, 2)}"
            )

    def hold(self, freedom: Freedom, joint: int) -> bool:
        return bool(self.given) and not self.given.isdisjoint((str(freedom), str(Used(freedom, joint))))

    def as_wall(self, freedom: Freedom, joint: int) -> float:
        return np.inf if self.hold(freedom, joint) else _PRICES.get(freedom, 1.0)

    def as_cost(self, freedom: Freedom, joint: int) -> float:
        return _PRICE_OF_PINNED * self.hold(freedom, joint) + _PRICES.get(freedom, 1.0)


_NAMES = frozenset(map(str, Freedom)) | {
    str(Used(freedom, joint)) for freedom in Freedom for joint in range(1, MAX_JOINTS + 1)
}


def _at_same_points(student: JudgedChain, reference: JudgedChain) -> tuple[JudgedChain, JudgedChain]:
    """Both chains at all sample points; a table without symbols is the same at all of them."""
    counts = {len(student.end), len(reference.end)} - {1}
    if len(counts) > 1 or student.variables != reference.variables:
        raise ValueError("the chains are not given at the same sample points, for the same joint variables")
    count = counts.pop() if counts else 1

    def spread(chain: JudgedChain) -> JudgedChain:
        if len(chain.end) == count:
            return chain
        frames, end = (np.repeat(array, count, axis=0) for array in (chain.frames, chain.end))
        return replace(chain, frames=frames, end=end)

    return spread(student), spread(reference)


def _common_part(student: JudgedChain, reference: JudgedChain) -> tuple[int, Parting | None]:
    """How many joints from the base are of the same type, moved by the same variables; and what the next one is."""
    for i in range(max(student.joints, reference.joints)):
        kinds = [_kind(chain, i) for chain in (student, reference)]
        if kinds[0] != kinds[1]:
            return i, Parting(i + 1, "type", *kinds)
        if np.abs(np.abs(student.coupling[i]) - np.abs(reference.coupling[i])).max() > _SAME_COEFFICIENT:
            return i, Parting(i + 1, "joint variable", *(_moved_by(chain, i) for chain in (student, reference)))
    return reference.joints, None


def _kind(chain: JudgedChain, joint: int) -> str:
    if joint >= chain.joints:
        return "no joint"
    return "prismatic" if chain.prismatic[joint] else "revolute"


def _moved_by(chain: JudgedChain, joint: int) -> str:
    terms = [(c, name) for c, name in zip(chain.coupling[joint], chain.variables, strict=True) if c]
    text = " ".join(f"{'-' if c < 0 else '+'} {'' if abs(c) == 1 else f'{abs(c):.4g} '}{name}" for c, name in terms)
    return f"moved by {text.removeprefix('+ ').replace('- ', '-', text.startswith('-'))}"


def _best(student: JudgedChain, reference: JudgedChain, price: Price, tolerance: float) -> Alignment | Parted | None:
    """An alignment, or how far one gets; None if joint variables are combined with signs that cannot be matched."""
    results = [align(student, reference, senses, price, tolerance) for senses in _prescribed(student, reference)]
    found = [result for result in results if isinstance(result, Alignment)]
    if found:
        return min(found, key=lambda alignment: alignment.cost)
    return max(results, key=lambda parted: parted.segment.directions[0], default=None)


def _prescribed(student: JudgedChain, reference: JudgedChain) -> Iterator[np.ndarray]:
    """Senses of the axes, (n,), 0 where free: joints that share a variable cannot be reversed one by one.

    Joint i moves by ``C_ref[i] (s q)`` in the reference and by ``S_i C[i] q`` in the student's chain, S_i its sense.
    """
    relative = np.sign(student.coupling * reference.coupling)
    linked = np.abs(relative) @ np.abs(relative).T > 0
    groups: list[dict[int, int]] = []
    for start in range(len(linked)):
        if any(start in group for group in groups):
            continue
        group, waiting = {start: 1}, [start]
        while waiting:
            i = waiting.pop()
            for k in np.flatnonzero(linked[i]).tolist():
                shared = relative[i] * relative[k]
                if shared.max() > 0 > shared.min():
                    return
                sense = group[i] * int(shared.sum() / np.abs(shared).sum())
                if group.setdefault(k, sense) != sense:
                    return
                waiting += [k] if k not in waiting and k != i and k > i else []
        groups.append(group)
    bound = [group for group in groups if len(group) > 1]
    for signs in product((1, -1), repeat=len(bound)):
        senses = np.zeros(len(linked), dtype=int)
        for group, sign in zip(bound, signs, strict=True):
            for joint, sense in group.items():
                senses[joint] = sign * sense
        yield senses


def _match(student: JudgedChain, reference: JudgedChain, found: Alignment, pins: _Pins, tolerance: float) -> ChainMatch:
    strokes = _strokes(reference, found)
    offsets = strokes @ np.linalg.pinv(reference.coupling).T
    unmet = np.abs(offsets @ reference.coupling.T - strokes)
    if unmet.max() > tolerance:
        joint = int(np.argmax(unmet.max(axis=0)))
        return ChainMatch(False, parting=Parting(joint + 1, "zero of the joint, which shares its variable,"))
    signs = np.sign((found.senses[:, None] * student.coupling * reference.coupling).sum(axis=0)).astype(int)
    signs[signs == 0] = 1
    turning = ~(np.abs(reference.coupling).T @ np.array(reference.prismatic, dtype=float) > 0)
    offsets[:, turning] = _wrapped(offsets[:, turning])
    base, last = (_rigid(found.rotations[:, link], found.shifts[:, link]) for link in (0, -1))
    tool = np.linalg.inv(last @ student.end) @ reference.end
    map_ = (tuple(signs.tolist()), offsets, base, tool)
    used = tuple(sorted(_used(student, reference, found, *map_, tolerance)))
    held = tuple(use for use in used if pins.hold(use.freedom, use.joint))
    return ChainMatch(not held, *map_, used, held)


def _strokes(reference: JudgedChain, found: Alignment) -> np.ndarray:
    """How far each joint of the reference has moved where the student's is at zero, (K, n)."""
    strokes = np.empty((len(reference.end), reference.joints))
    for i, slides in enumerate(reference.prismatic):
        if slides:
            strokes[:, i] = ((found.shifts[:, i] - found.shifts[:, i + 1]) * reference.axes[:, i]).sum(axis=-1)
        else:
            x, z = reference.normals[:, i], reference.axes[:, i]
            turned = (found.rotations[:, i] @ np.swapaxes(found.rotations[:, i + 1], 1, 2) @ x[..., None])[..., 0]
            strokes[:, i] = np.arctan2((turned * cross(z, x)).sum(axis=-1), (turned * x).sum(axis=-1))
    return strokes


def _wrapped(angles: np.ndarray) -> np.ndarray:
    """In (-pi, pi], angles within rounding of -pi taken as pi."""
    return np.pi - np.mod(np.pi - angles + _ROUNDING, 2 * np.pi) + _ROUNDING


def _rigid(rotation: np.ndarray, shift: np.ndarray) -> np.ndarray:
    motion = np.zeros((len(rotation), 4, 4))
    motion[:, :3, :3], motion[:, :3, 3], motion[:, 3, 3] = rotation, shift, 1
    return motion


def _used(
    student: JudgedChain, reference: JudgedChain, found: Alignment, signs, offsets, base, tool, tolerance: float
) -> Iterator[Used]:
    """What the tables differ in, measured on the motions found."""
    lengths = tolerance * max(1.0, np.abs(reference.end[:, :3, 3]).max(), np.abs(reference.origins).max(initial=0))
    limits = np.full((4, 4), tolerance)
    limits[:3, 3] = lengths

    def differ(motion: np.ndarray) -> bool:
        return bool((np.abs(motion - np.eye(4)) > limits).any())

    if differ(base):
        yield Used(Freedom.BASE)
    if differ(tool):
        yield Used(Freedom.TOOL)
    for j, sign in enumerate(signs):
        joint = int(np.argmax(reference.coupling[:, j] != 0)) + 1
        if sign < 0:
            yield Used(Freedom.SENSE, joint)
        if np.abs(offsets[:, j]).max() > tolerance:
            yield Used(Freedom.ZERO, joint)
    for i, sense in enumerate(found.senses):
        if sense < 0:
            yield Used(Freedom.Z, i + 1)
        if student.ends_with_joint and reference.ends_with_joint and i == reference.joints - 1:
            continue
        x = (found.rotations[:, i + 1] @ student.normals[:, i, :, None])[..., 0]
        if np.abs(x + reference.normals[:, i]).max() <= tolerance:
            yield Used(Freedom.X, i + 1)
        elif np.abs(x - reference.normals[:, i]).max() > tolerance:
            yield Used(Freedom.X_DIRECTION, i + 1)
        landed = (found.rotations[:, i + 1] @ student.origins[:, i, :, None])[..., 0] + found.shifts[:, i + 1]
        gap = landed - reference.origins[:, i]
        along = (gap * reference.axes[:, i]).sum(axis=-1, keepdims=True)
        if np.abs(along).max() > lengths:
            yield Used(Freedom.ORIGIN, i + 1)
        if np.abs(gap - along * reference.axes[:, i]).max() > lengths:
            yield Used(Freedom.AXIS, i + 1)


def _parting(student: JudgedChain, reference: JudgedChain, parted: Parted | None, tolerance: float) -> Parting:
    """Puts a dead end into words: the first quantity between the joints of the segment that is not the reference's."""
    if parted is None:
        coupled = (reference.coupling != 0).sum(axis=1) > 1
        return Parting(int(np.argmax(coupled)) + 1, "sign of a joint variable")
    segment = parted.segment
    for before, joint in pairwise(segment.directions):
        found, expected = (_twist(chain, before, joint) for chain in (student, reference))
        if np.abs(np.abs(np.cos(found)) - np.abs(np.cos(expected))).max() > tolerance:
            return Parting(joint + 1, f"twist from Z{before + 1}", *_degrees(found, expected))
    if segment.entry is None or segment.exit is None or segment.sliders:
        return Parting(segment.directions[-1] + 1, "place of its axis" if parted.turned else "direction of its axis")
    before, joint = segment.entry, segment.exit
    found, expected = (_distance(chain, before, joint) for chain in (student, reference))
    if np.abs(np.abs(found) - np.abs(expected)).max() > tolerance:
        return Parting(
            joint + 1, f"distance between axes {before + 1} and {joint + 1}", *_plain(np.abs(found), np.abs(expected))
        )
    twists = [_twist(chain, before, joint) for chain in (student, reference)]
    if np.abs(found * np.cos(twists[0]) - expected * np.cos(twists[1])).max() > tolerance:
        signed = (
            twist * np.where(distance < 0, -1, 1) for twist, distance in zip(twists, (found, expected), strict=True)
        )
        return Parting(joint + 1, f"twist from Z{before + 1}", *_degrees(*signed))
    sense = parted.senses.get(before, 1)
    found, expected = (_offset(chain, segment) for chain in (student, reference))
    if found is None or np.abs(sense * found - expected).max() <= tolerance:
        return Parting(joint + 1, "place of its axis")
    return Parting(before + 1, f"offset along Z{before + 1}", *_plain(sense * found, expected))


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
    axis, away = chain.axes[:, joint], chain.axes[:, other]
    cosine = (axis * away).sum(axis=-1)
    if np.sqrt(np.clip(1 - cosine**2, 0, None)).min() <= _PARALLEL:
        return None
    between = chain.origins[:, other] - chain.origins[:, joint]
    along = ((between * axis).sum(axis=-1) - (between * away).sum(axis=-1) * cosine) / (1 - cosine**2)
    return chain.origins[:, joint] + along[:, None] * axis


def _offset(chain: JudgedChain, segment: Segment) -> np.ndarray | None:
    """Along the first axis of a segment, from the common normal before it to the one after it, (K,).

    The normal before is carried over from the last axis that is not parallel; None where there is none, or where a
    prismatic joint stands between.
    """
    stretches = segments(chain.prismatic)
    foot = None
    for link in stretches[1 : stretches.index(segment)]:
        if link.sliders:
            return None
        here = _foot(chain, link.exit, link.entry)
        if here is not None:
            foot = here
        elif foot is not None:
            axis, origin = chain.axes[:, link.exit], chain.origins[:, link.exit]
            foot = origin + ((foot - origin) * axis).sum(axis=-1, keepdims=True) * axis
    after = _foot(chain, segment.entry, segment.exit)
    if foot is None or after is None:
        return None
    return ((after - foot) * chain.axes[:, segment.entry]).sum(axis=-1)


def _plain(found: np.ndarray, expected: np.ndarray) -> tuple[float | None, float | None]:
    """The two values where they do not depend on the sample point, else None."""
    steady = np.ptp(found) < _PARALLEL and np.ptp(expected) < _PARALLEL
    return (float(found[0]), float(expected[0])) if steady else (None, None)


def _degrees(found: np.ndarray, expected: np.ndarray) -> tuple[float | None, float | None]:
    return _plain(np.degrees(found), np.degrees(expected))
