"""Whether two modified DH tables describe the same chain, which freedoms of the convention that takes, or where they part."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from dhkit.geometry import cross, rigid_transform, wrap

from .alignment import Alignment, DeadEnd, align
from .frames import JudgedChain
from .freedoms import Freedom, Pins, Price, Used
from .linear import times, transposed
from .parting import Parting, parting_of_axes, parting_of_joints, parting_of_signs

TOLERANCE = 1e-6

_ROUNDING = 1e-9


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

    Parameters
    ----------
    student, reference : JudgedChain
    pinned : collection of str
        Freedoms that a right answer may not use, each for all joints (``"zero of joint"``, ``"sense of Z"``,
        ``Freedom.BASE``) or for one, written as in `ChainMatch.freedoms` (``"zero of joint 3"``, ``"sense of X2"``).
    tolerance : float
        Largest accepted difference, in radians, and in lengths relative to the larger of 1 m and the robot.

    Raises
    ------
    ValueError
        For a name in `pinned` that is no freedom, or different numbers of sample points.
    """
    pins = Pins(pinned)
    student, reference = _at_same_points(student, reference)
    with np.errstate(all="ignore"):
        difference = parting_of_joints(student, reference)
        if difference:
            return ChainMatch(False, parting=_first_parting(student, reference, difference, pins, tolerance))
        found = _best(student, reference, pins.as_wall, tolerance)
        if not isinstance(found, Alignment) and pins.names:
            found = _best(student, reference, pins.as_cost, tolerance)
        if not isinstance(found, Alignment):
            return ChainMatch(False, parting=_parting(student, reference, found, tolerance))
        return _match(student, reference, found, pins, tolerance)


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


def _first_parting(
    student: JudgedChain, reference: JudgedChain, difference: Parting, pins: Pins, tolerance: float
) -> Parting:
    """The parting of the axes before a joint that differs, if there is one, else that difference."""
    common = difference.joint - 1
    if not common:
        return difference
    student, reference = student.first(common), reference.first(common)
    found = _best(student, reference, pins.as_cost, tolerance)
    return _parting(student, reference, found, tolerance) if isinstance(found, DeadEnd) else difference


def _parting(student: JudgedChain, reference: JudgedChain, found: DeadEnd | None, tolerance: float) -> Parting:
    return parting_of_axes(student, reference, found, tolerance) if found else parting_of_signs(reference)


def _best(student: JudgedChain, reference: JudgedChain, price: Price, tolerance: float) -> Alignment | DeadEnd | None:
    """An alignment, or how far one gets; None if joint variables are combined with signs that cannot be matched."""
    results = [align(student, reference, senses, price, tolerance) for senses in _prescribed(student, reference)]
    found = [result for result in results if isinstance(result, Alignment)]
    if found:
        return min(found, key=lambda alignment: alignment.cost)
    ends = [result for result in results if isinstance(result, DeadEnd)]
    return max(ends, key=lambda end: end.segment.directions[0], default=None)


def _prescribed(student: JudgedChain, reference: JudgedChain) -> Iterator[np.ndarray]:
    """Senses of the axes, (n,), 0 where free: joints that share a variable cannot be reversed one by one."""
    groups = _linked_joints(student, reference)
    if groups is None:
        return
    bound = [group for group in groups if len(group) > 1]
    for signs in product((1, -1), repeat=len(bound)):
        senses = np.zeros(reference.joints, dtype=int)
        for group, sign in zip(bound, signs, strict=True):
            for joint, sense in group.items():
                senses[joint] = sign * sense
        yield senses


def _linked_joints(student: JudgedChain, reference: JudgedChain) -> list[dict[int, int]] | None:
    """Joints that share variables, group by group, with their senses relative to each other; None if these clash.

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
                    return None
                sense = group[i] * int(shared.sum() / np.abs(shared).sum())
                if group.setdefault(k, sense) != sense:
                    return None
                if k > i and k not in waiting:
                    waiting.append(k)
        groups.append(group)
    return groups


def _match(student: JudgedChain, reference: JudgedChain, found: Alignment, pins: Pins, tolerance: float) -> ChainMatch:
    strokes = _strokes(reference, found)
    offsets = strokes @ np.linalg.pinv(reference.coupling).T
    unmet = np.abs(offsets @ reference.coupling.T - strokes)
    if unmet.max() > tolerance:
        joint = int(np.argmax(unmet.max(axis=0)))
        return ChainMatch(False, parting=Parting(joint + 1, "zero of the joint, which shares its variable,"))
    signs = np.sign((found.senses[:, None] * student.coupling * reference.coupling).sum(axis=0)).astype(int)
    signs[signs == 0] = 1
    turning = ~(np.abs(reference.coupling).T @ np.array(reference.prismatic, dtype=float) > 0)
    offsets[:, turning] = wrap(offsets[:, turning], _ROUNDING)
    base, last = (rigid_transform(found.rotations[:, link], found.shifts[:, link]) for link in (0, -1))
    tool = np.linalg.inv(last @ student.end) @ reference.end
    used = [
        *_used_at_ends(reference, base, tool, tolerance),
        *_used_by_variables(reference, signs, offsets, tolerance),
        *_used_by_frames(student, reference, found, tolerance),
    ]
    held = tuple(sorted(use for use in used if pins.hold(use.freedom, use.joint)))
    return ChainMatch(not held, tuple(signs.tolist()), offsets, base, tool, tuple(sorted(used)), held)


def _strokes(reference: JudgedChain, found: Alignment) -> np.ndarray:
    """How far each joint of the reference has moved where the student's is at zero, (K, n)."""
    strokes = np.empty((len(reference.end), reference.joints))
    for i, slides in enumerate(reference.prismatic):
        if slides:
            strokes[:, i] = ((found.shifts[:, i] - found.shifts[:, i + 1]) * reference.axes[:, i]).sum(axis=-1)
        else:
            x, z = reference.normals[:, i], reference.axes[:, i]
            turned = times(found.rotations[:, i] @ transposed(found.rotations[:, i + 1]), x)
            strokes[:, i] = np.arctan2((turned * cross(z, x)).sum(axis=-1), (turned * x).sum(axis=-1))
    return strokes


def _used_at_ends(reference: JudgedChain, base: np.ndarray, tool: np.ndarray, tolerance: float) -> Iterator[Used]:
    limits = np.full((4, 4), tolerance)
    limits[:3, 3] = tolerance * reference.size
    for freedom, motion in ((Freedom.BASE, base), (Freedom.TOOL, tool)):
        if (np.abs(motion - np.eye(4)) > limits).any():
            yield Used(freedom)


def _used_by_variables(
    reference: JudgedChain, signs: np.ndarray, offsets: np.ndarray, tolerance: float
) -> Iterator[Used]:
    for j, sign in enumerate(signs):
        joint = int(np.argmax(reference.coupling[:, j] != 0)) + 1
        if sign < 0:
            yield Used(Freedom.SENSE, joint)
        if np.abs(offsets[:, j]).max() > tolerance:
            yield Used(Freedom.ZERO, joint)


def _used_by_frames(student: JudgedChain, reference: JudgedChain, found: Alignment, tolerance: float) -> Iterator[Used]:
    """What the frames on the joint axes differ in, measured on the motions found."""
    for i, sense in enumerate(found.senses):
        if sense < 0:
            yield Used(Freedom.Z, i + 1)
        if student.ends_with_joint and reference.ends_with_joint and i == reference.joints - 1:
            continue
        rotation, axis = found.rotations[:, i + 1], reference.axes[:, i]
        x = times(rotation, student.normals[:, i])
        if np.abs(x + reference.normals[:, i]).max() <= tolerance:
            yield Used(Freedom.X, i + 1)
        elif np.abs(x - reference.normals[:, i]).max() > tolerance:
            yield Used(Freedom.X_DIRECTION, i + 1)
        gap = times(rotation, student.origins[:, i]) + found.shifts[:, i + 1] - reference.origins[:, i]
        along = (gap * axis).sum(axis=-1, keepdims=True)
        if np.abs(along).max() > tolerance * reference.size:
            yield Used(Freedom.ORIGIN, i + 1)
        if np.abs(gap - along * axis).max() > tolerance * reference.size:
            yield Used(Freedom.AXIS, i + 1)
