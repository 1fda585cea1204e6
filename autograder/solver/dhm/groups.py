"""Three neighbouring joints that form a group: turns about one point, or motions of a plane.

Whatever they do, the point (the plane) stays where it is; so the other three joints of an arm alone bring it there, and
the group does the rest. The links given to a group run from it round the loop of the arm to itself again; what goes
from the tool to the base is as good as a link.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from . import circle
from .elimination import Near, PointProblem, Triples, plane_vectors
from .geometry import perpendicular, phasor, two_link, wrap
from .loop import Loop, motion
from .status import Flag

_PARALLEL = 1e-9  # sine under which axes are parallel
_MEETING = 1e-9  # distance, in sizes of the arm, under which axes meet
_ALIGNED = 1e-9  # sine under which the outer axes of a wrist are one line
_OUT = 1e-4  # by how much a group may be asked for too much: Newton's method and the forward model decide


class Both(NamedTuple):
    """Two solutions of three joints: values, each (2, K, N); valid, flags (2, K, N)."""

    values: tuple[np.ndarray, np.ndarray, np.ndarray]
    valid: np.ndarray
    flags: np.ndarray


class Group(ABC):
    """Three neighbouring joints of a loop that form a group, from index `at` on."""

    words: tuple[str, str]
    line: bool = False

    @property
    def free(self) -> int | None:
        """The joint of the group that is free where the others have no choice left."""
        return None

    @abstractmethod
    def others(self, links: list[np.ndarray], slides: tuple[bool, bool, bool], near: Near) -> Triples:
        """The other three joints, between and around them four links (N or 1, 4, 4)."""

    @abstractmethod
    def solve(self, D: np.ndarray, near: Near, blurred: np.ndarray) -> Both:
        """The joints of the group that do the displacement D (K, N, 4, 4); where blurred (K, N), half its digits are right."""


@dataclass(frozen=True)
class Sphere(Group):
    """Three axes through one point.

    Attributes
    ----------
    inner : two (4, 4) arrays
        The links between them.
    before, after : float
        Where the point lies on the first and on the third axis.
    held : 0 or 2
        Which joint keeps its value where first and third axis are one line.
    line : bool
        Whether both are joints of the arm, so that this is a family.
    """

    inner: tuple[np.ndarray, np.ndarray]
    before: float
    after: float
    held: int
    line: bool
    words = ("wrist unflipped", "wrist flipped")

    @classmethod
    def of(cls, loop: Loop, at: int, joints: int) -> Sphere | None:
        """The group of the joints from index `at` on, None if they form none; joints from `joints` on are not there."""
        if any(loop.slides[at : at + 3]):
            return None
        one, other = loop.links[at + 1], loop.links[at + 2]
        meetings = meeting(one), meeting(other)
        if meetings[0] is None or meetings[1] is None or abs(meetings[0][1] - meetings[1][0]) > _MEETING:
            return None
        first, _, third = (joint < joints for joint in loop.joints[at : at + 3])
        return cls((one, other), meetings[0][0], meetings[1][1], 0 if third or not first else 2, first and third)

    def others(self, links: list[np.ndarray], slides: tuple[bool, bool, bool], near: Near) -> Triples:
        w = links[3][:, :3] @ [0, 0, self.before, 1]
        t = np.linalg.inv(links[0])[:, :3] @ [0, 0, self.after, 1]
        return PointProblem(slides, links[1][0]).solve(links[2], w.T, t.T, near)

    def solve(self, D: np.ndarray, near: Near, blurred: np.ndarray) -> Both:
        Q, P = (link[:3, :3] for link in self.inner)
        R = D[..., :3, :3]
        G, F = complex(*Q[2, :2]), complex(*P[:2, 2])
        cosine = (R[..., 2, 2] - Q[2, 2] * P[2, 2]) / (abs(G) * abs(F))
        bend = np.arccos(np.clip(cosine, -1, 1))
        second = np.angle(G) - np.angle(F) + np.stack([bend, -bend])
        middle = Q @ motion(False, second)[..., :3, :3] @ P
        aligned = np.hypot(R[..., 0, 2], R[..., 1, 2]) <= np.where(blurred, circle.DOUBLE, _ALIGNED)
        first = _heading(R[..., :, 2]) - _heading(middle[..., :, 2])
        if self.held:
            rest = R @ np.swapaxes(middle @ motion(False, near[2])[..., :3, :3], -1, -2)
            first = np.where(aligned, _about_z(rest), first)
        else:
            first = np.where(aligned, near[0], first)
        rest = np.swapaxes(motion(False, first)[..., :3, :3] @ middle, -1, -2) @ R
        third = _about_z(rest)
        if self.held:
            third = np.where(aligned, near[2], third)
        valid = np.broadcast_to(np.abs(cosine) <= 1 + _OUT, second.shape).copy()
        valid[1] &= ~aligned
        flags = np.where(aligned, np.where(R[..., 2, 2] < 0, Flag.FREE_LINE | Flag.FOLDED_LINE, Flag.FREE_LINE), 0)
        flags = flags * self.line
        return Both((first, second, third), valid, np.broadcast_to(flags.astype(np.uint8), valid.shape))


@dataclass(frozen=True)
class Plane(Group):
    """Three turns about parallel axes, or slides square to them, of which at least one is a turn.

    Attributes
    ----------
    slides : three bool
        At least one of them False.
    frame : (4, 4) array
        Its z axis is the normal of the plane, seen from the first joint.
    home : (4, 4) array
        The displacement of the group with all joints zero, seen from the first joint.
    places : three complex numbers
        In the plane, with all joints zero: where the axis of a turn is, which way a slide goes.
    senses : three numbers
        -1 for a turn about an axis that points against the normal.
    """

    slides: tuple[bool, ...]
    frame: np.ndarray
    home: np.ndarray
    places: tuple[complex, ...]
    senses: tuple[float, ...]
    words = ("elbow down", "elbow up")

    @property
    def free(self) -> int:
        return self.slides.index(False)

    @classmethod
    def of(cls, loop: Loop, at: int, joints: int) -> Plane | None:
        """The group of three joints from index `at` on, None if they do not form it."""
        slides = loop.slides[at : at + 3]
        if all(slides):
            return None
        axes = [np.eye(4), loop.links[at + 1], loop.links[at + 1] @ loop.links[at + 2]]
        normal = axes[slides.index(False)][:3, 2]
        for slide, axis in zip(slides, axes):
            across = axis[:3, 2] @ normal if slide else np.linalg.norm(np.cross(axis[:3, 2], normal))
            if abs(across) > _PARALLEL:
                return None
        frame, x = np.eye(4), perpendicular(normal)
        frame[:3, :3] = np.column_stack([x, np.cross(normal, x), normal])
        seen = [np.linalg.inv(frame) @ axis for axis in axes]
        places = tuple(complex(*axis[:2, 2 if slide else 3]) for slide, axis in zip(slides, seen))
        turns = [place for slide, place in zip(slides, places) if not slide]
        if any(abs(one - other) <= _MEETING for one, other in pairwise(turns)):
            return None
        senses = tuple(1.0 if slide else float(np.sign(axis[2, 2])) for slide, axis in zip(slides, seen))
        return cls(slides, frame, axes[2], places, senses)

    def others(self, links: list[np.ndarray], slides: tuple[bool, bool, bool], near: Near) -> Triples:
        normal = self.frame[:3, 2]
        there = self.home[:3, :3].T @ normal  # the normal, seen from behind the group
        lift = normal @ self.home[:3, 3]
        B0, B1, B2, B3 = links
        R0, R1, R2, R3 = (link[:, :3, :3] for link in links)
        # The middle one of the three leaves its axis in place, in direction and, of points on it, in height.
        down = there @ R0[0]
        axis = R1[0, :, 2]
        rows = np.array([_turned(down, axis), _turned(down, B1[0, :3, 3])])
        constant = np.array([down[2] * axis[2], down[2] * B1[0, 2, 3] + there @ B0[0, :3, 3] + lift])
        up = R3 @ normal  # seen from behind the last joint
        back = np.einsum("nji,nj->ni", R3, B3[:, :3, 3]) @ normal

        def at(v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            c, s = np.cos(v), np.sin(v)
            turned = np.stack([c * up[:, 0] - s * up[:, 1], s * up[:, 0] + c * up[:, 1], 0 * c + up[:, 2]])
            shift = np.einsum("nji,nj->ni", R2, B2[:, :3, 3])
            r = np.stack(
                [
                    np.einsum("nj,j...n->...n", R2[:, 2], turned) - constant[0],
                    -np.einsum("nj,j...n->...n", shift, turned) - back - constant[1],
                ]
            )
            return r, np.ones(r.shape[1:])

        count = max(len(B2), len(B3))
        s, third, valid, flags = plane_vectors(rows, at, False, count, near[2])
        f = np.einsum("...ij,...j->...i", R2 @ motion(False, third)[..., :3, :3], up)
        sine = np.hypot(f[..., 0], f[..., 1])
        free = sine <= _ALIGNED
        first = np.arctan2(s[1], s[0])
        for sense in (1.0, -1.0):  # beside the normal the cosine of an angle says too little of it, the sine all
            if abs(down[2] - sense * axis[2]) <= _PARALLEL:
                along = np.arctan2(down[1], down[0]) - np.arctan2(sense * axis[1], sense * axis[0])
                aside = wrap(first - along)
                for _ in range(2):
                    e = np.swapaxes(R0 @ motion(False, along + aside)[..., :3, :3] @ R1, -1, -2) @ there
                    ratio = sine / np.maximum(np.hypot(e[..., 0], e[..., 1]), 1e-300)
                    aside = np.where((sine < 1e-3) & (np.abs(aside) < 2e-3), aside * ratio, aside)
                first = along + aside
        e = np.swapaxes(R0 @ motion(False, first)[..., :3, :3] @ R1, -1, -2) @ there
        second = np.where(free, near[1], _heading(e) - _heading(f))
        flags = flags | np.where(free, Flag.FREE_FIRST, 0).astype(np.uint8)
        return Triples(first, second, third, valid, flags)

    def solve(self, D: np.ndarray, near: Near, blurred: np.ndarray) -> Both:
        E = np.linalg.inv(self.frame) @ D @ np.linalg.inv(self.home) @ self.frame
        turn = np.arctan2(E[..., 1, 0] - E[..., 0, 1], E[..., 0, 0] + E[..., 1, 1])
        shift = E[..., 0, 3] + 1j * E[..., 1, 3]
        anchor = self.senses[self.free] * near[self.free]
        solve = (self._three_turns, self._one_slide, self._two_slides)[sum(self.slides)]
        values, valid, free = solve(turn, shift, anchor)
        shape = (2, *turn.shape)
        first, second, third = (sense * np.broadcast_to(value, shape) for sense, value in zip(self.senses, values))
        flags = np.where(free, Flag.FREE_PLANE, 0).astype(np.uint8)
        return Both((first, second, third), np.repeat(valid[None], 2, axis=0), np.broadcast_to(flags, shape))

    def _three_turns(self, turn: np.ndarray, shift: np.ndarray, anchor: np.ndarray) -> _Values:
        one, two, three = self.places
        upper, fore = two - one, three - two
        target = phasor(turn) * three + shift - one
        arm = two_link(target, abs(upper), abs(fore), anchor + np.angle(upper), _OUT)
        first, second = arm.first - np.angle(upper), arm.bend + np.angle(upper) - np.angle(fore)
        return (first, second, turn - first - second), arm.valid[0], arm.free

    def _one_slide(self, turn: np.ndarray, shift: np.ndarray, anchor: np.ndarray) -> _Values:
        """The slide moves a point along a straight line, the turn beside it moves that on a circle."""
        one, two, three = self.places
        turned = phasor(turn)
        start: complex | np.ndarray
        if self.slides[2]:
            line, way, start = turned * two + shift - one, -turned * three, two - one
        elif self.slides[0]:
            line, way, start = turned * three + shift - two, -one + 0 * turned, three - two
        else:
            line, way, start = three - one + 0 * turned, two + 0 * turned, turned * three + shift - one
        foot = -(np.conj(way) * line).real
        aside, radius = np.abs(line + foot * way), np.abs(start)
        half = np.sqrt(np.maximum(radius**2 - aside**2, 0.0))
        slide = foot + np.stack([half, -half])
        end = line + slide * way
        free = np.abs(end[0]) <= circle.ZERO
        heading = np.angle(end) - np.angle(start)
        angle = np.where(free, anchor, -heading if self.slides[1] else heading)
        pair = iter((angle, turn - angle))
        values = tuple(slide if slides else next(pair) for slides in self.slides)
        return values, aside <= radius + _OUT, free

    def _two_slides(self, turn: np.ndarray, shift: np.ndarray, anchor: np.ndarray) -> _Values:
        one, two, three = self.places
        turned = phasor(turn)
        ways: tuple[complex | np.ndarray, complex | np.ndarray]
        if not self.slides[0]:
            goal, ways = one + np.conj(turned) * (shift - one), (two, three)
        elif not self.slides[1]:
            goal, ways = turned * two + shift - two, (one, turned * three)
        else:
            goal, ways = turned * three + shift - three, (one, two)
        across = (np.conj(ways[0]) * ways[1]).imag + 0 * turn
        valid = np.abs(across) > _PARALLEL
        across = np.where(valid, across, 1.0)
        both = iter([(np.conj(goal) * ways[1]).imag / across, -(np.conj(goal) * ways[0]).imag / across])
        values = tuple(next(both) if slides else turn for slides in self.slides)
        return values, valid, np.zeros(turn.shape, dtype=bool)


_Values = tuple[tuple[np.ndarray, ...], np.ndarray, np.ndarray]  # of three joints, whether they count, are free


def meeting(link: np.ndarray) -> tuple[float, float] | None:
    """Where two axes with a link between them meet, as heights along the first and the second; None if they do not."""
    p, z = link[:3, 3], link[:3, 2]
    square = 1 - z[2] ** 2
    if square <= _PARALLEL**2:
        return None
    second = (p[2] * z[2] - p @ z) / square
    first = p[2] + second * z[2]
    if np.linalg.norm(p + second * z - [0, 0, first]) > _MEETING:
        return None
    return float(first), float(second)


def _turned(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The factors of cos v and sin v in a . Rz(v) b."""
    return np.array([a[0] * b[0] + a[1] * b[1], a[1] * b[0] - a[0] * b[1]])


def _heading(vector: np.ndarray) -> np.ndarray:
    return np.arctan2(vector[..., 1], vector[..., 0])


def _about_z(R: np.ndarray) -> np.ndarray:
    return np.arctan2(R[..., 1, 0] - R[..., 0, 1], R[..., 0, 0] + R[..., 1, 1])
