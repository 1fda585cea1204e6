"""Six joints of which three neighbours form a group: a spherical wrist, or three joints that move in a plane.

Turns about axes through one point leave that point in place; turns about parallel axes, and slides square to them,
leave their plane in place. So the other three joints alone bring the point (the plane) to where it must be: a problem of
three unknowns, in `elimination`. Then the three of the group do the rest. The group may stand anywhere in the arm:
what goes from the tool to the base is as good as a link. UR arms have their group in axes 2 to 4, oblique and offset
shoulders, Stanford arms, gantries and cylindrical arms with a wrist have it in axes 4 to 6. Source: D. Pieper, "The
kinematics of manipulators under computer control", 1968; C. Mavroidis, B. Roth, "Structural parameters which reduce
the number of manipulator configurations", 1994, doi:10.1115/1.2919387.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .elimination import PointProblem
from .groups import Group, Plane, Sphere, meeting
from .inverse import Branches, InverseModel, JointMap, translations
from .loop import Loop, in_unit, motion
from .loop_arms import Candidates, LoopArm, anchored
from .settling import settled
from .singularities import chain_mobility
from .status import Failure, Flag
from .tables import DHTable

_VIRTUAL = 1e-3  # radians by which a joint that is not there may turn before the posture is brought onto the pose
_OBLIQUE = 1.0  # radians between an axis that is not there and the one before: never aligned with a third one


@dataclass(frozen=True)
class Grouped:
    """The algebra of a loop with a group.

    Attributes
    ----------
    loop : Loop
        Six joints, its group at index 0 or 1.
    at : int
        That index.
    group : Group
    backwards : bool
        Whether the loop runs from the tool to the base of the arm.
    joints : int
        How many joints the arm has; those with higher numbers are not there.
    """

    loop: Loop
    at: int
    group: Group
    backwards: bool
    joints: int

    @classmethod
    def of(cls, loop: Loop) -> Grouped:
        """Of the loop of an arm with three to six joints. Raises ValueError where three joints form no group."""
        joints = len(loop.slides)
        for kind in (Sphere, Plane) if joints == 6 else (Plane, Sphere):
            for walked, backwards in ((loop, False), (loop.reversed(), True)):
                whole = _completed(walked)
                for turned, candidate in enumerate((whole, whole.reversed())):
                    for at in (0, 1):
                        group = kind.of(candidate, at, joints)
                        slides = candidate.slides[at + 3 :] + candidate.slides[:at]
                        if group is not None and (kind is Sphere or not any(slides)):
                            return cls(candidate, at, group, backwards != bool(turned), joints)
        raise ValueError("no three neighbouring axes meet in one point or are parallel, which would decouple it")

    @property
    def order(self) -> list[int]:
        """The joints from the group on round the loop, as the arm numbers them."""
        return [self.loop.joints[(self.at + i) % 6] for i in range(6)]

    @property
    def anchors(self) -> dict[Flag, tuple[int, ...]]:
        """As `InverseModel.anchors`."""
        places = {Flag.FREE_FIRST: 3, Flag.FREE_PLANE: 4, Flag.FREE_CHAIN: 5}
        if isinstance(self.group, Plane):
            places = {Flag.FREE_FIRST: 4, Flag.FREE_PLANE: self.group.free, Flag.FREE_CHAIN: 5}
        named = {flag: self.order[place] for flag, place in places.items()}
        return {flag: (joint,) for flag, joint in named.items() if joint < self.joints}

    def candidates(self, T: np.ndarray, near: np.ndarray) -> Candidates:
        """As `loop_arms.Algebra` has it; K = 8."""
        count = len(T)
        start = np.zeros((6, count))
        start[: self.joints] = near
        if self.backwards:
            start, T = -start, np.linalg.inv(T)
        wished = [start[place] for place in self.order]
        links = [link[None] for link in self.loop.links]
        closing = links[6] @ np.linalg.inv(T) @ links[0]
        around = [*links[self.at + 3 : 6], closing, *links[1 : self.at + 1]]
        slides = [self.loop.slides[(self.at + i) % 6] for i in range(3, 6)]
        other = self.group.others(around, tuple(slides), tuple(wished[3:]))  # type: ignore[arg-type]
        values = (other.first, other.second, other.third)
        D = around[0]
        for slide, value, link in zip(slides, values, around[1:]):
            D = D @ motion(slide, value) @ link
        blurred = (other.flags & Flag.STRETCHED) != 0
        both = self.group.solve(np.linalg.inv(D), tuple(wished[:3]), blurred)  # type: ignore[arg-type]
        q = np.empty((6, 4, 2, count))
        for place, value in zip(
            self.order, [*(np.moveaxis(v, 0, 1) for v in both.values), *(v[:, None] for v in values)]
        ):
            q[place] = value
        rows = (-q if self.backwards else q).reshape(6, 8, count)
        flags = (other.flags[:, None] | np.moveaxis(both.flags, 0, 1)).reshape(8, count)
        family = np.repeat(other.valid, 2, axis=0) & anchored(flags)
        valid = (other.valid[:, None] & np.moveaxis(both.valid, 0, 1)).reshape(8, count)
        for absent in rows[self.joints :]:
            valid &= (np.abs(np.angle(np.exp(1j * absent))) <= _VIRTUAL) | family
        return Candidates(rows[: self.joints], valid, flags, family)


class Decoupled(LoopArm):
    """Up to six joints, three of which form a group: see the module. At most 8 solutions.

    Branches in order: the up to four solutions of the other three joints; within each, both solutions of the group. The
    roots of a polynomial have no names, so that "arm 2" is a place in a list and no shape of the arm. Arms of three to
    five joints are solved as if the missing ones stood behind the tool; postures that turn those do not count.
    """

    branch_count = 8

    def __init__(self, table: DHTable) -> None:
        """Raises ValueError unless three neighbouring joints form a group and the joints give all freedoms they can."""
        super().__init__(table)
        if not 3 <= self.joints <= 6:
            raise ValueError(f"it has {self.joints} joints, not 3 to 6")
        self._algebra = Grouped.of(self.loop)
        self.anchors = self._algebra.anchors
        self.group = self._algebra.group
        if self.group.line:
            i, j = sorted((self._algebra.order[0], self._algebra.order[2]))
            sense = int(self.map.sign[i] * self.map.sign[j])
            self.line = i, j, sense, -sense

    def candidates(self, T: np.ndarray, near: np.ndarray) -> Candidates:
        return self._algebra.candidates(T, near)

    def label(self, branch: int, flags: int) -> str:
        if flags & Flag.LIMIT:
            return f"arm {branch // 2 + 1}, at a limit"
        return f"arm {branch // 2 + 1}, {self.group.words[branch % 2]}"


class PointArm(InverseModel):
    """Three joints, turns or slides, that bring a point (x, y, z) in place. At most 4 solutions.

    Cartesian, cylindrical and spherical arms, and three turns about any axes. Branches are in the order of the last
    joint's values. The orientation of a pose is not looked at: three joints cannot choose it.
    """

    task = "x, y, z"
    expected_joints = 3
    branch_count = 4

    def __init__(self, table: DHTable) -> None:
        """Raises ValueError unless the point has three freedoms."""
        super().__init__(table)
        self.anchors = {Flag.FREE_FIRST: (0,), Flag.FREE_PLANE: (1,), Flag.FREE_CHAIN: (2,)}
        chain = self.chain
        self.map = JointMap.of(chain)
        freedoms = chain_mobility(chain, rows=3)
        if freedoms < 3:
            raise ValueError(f"its 3 joints give its point {freedoms} freedoms only")
        self.revolute = tuple(int(i) for i in np.flatnonzero(~chain.prismatic[:3]))
        loop = Loop.of(chain)
        self.size = loop.size + float(np.linalg.norm(loop.links[3][:3, 3]))
        self._loop = loop.scaled(1 / self.size)
        self._problem = PointProblem(loop.slides, self._loop.links[1])  # type: ignore[arg-type]

    def pose(self, task: np.ndarray) -> np.ndarray:
        return translations(task)

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        unit = np.where(self.chain.prismatic[:3], self.size, 1.0)
        start = [self.map.row(i, near) / unit[i] for i in range(3)]
        base, _, link, tip = self._loop.links
        goal = np.linalg.inv(base) @ in_unit(poses, 1 / self.size)
        found = self._problem.solve(link[None], tip[:3, 3:], goal[:, :3, 3].T, tuple(start))  # type: ignore[arg-type]
        rows = (found.first, found.second, found.third)
        q = np.stack([self.map.joint(i, unit[i] * row) for i, row in enumerate(rows)])
        return settled(self.chain, self.size, q, found.valid, found.flags, poses, tol, only_point=True)[0]

    def label(self, branch: int, flags: int) -> str:
        return "at a limit" if flags & Flag.LIMIT else f"posture {branch + 1}"

    def unreachable(self, failure: Failure, excess: float) -> str:
        return f"no posture reaches the point, the nearest one found misses it by {excess:.3g} m"


def _completed(loop: Loop) -> Loop:
    """The loop with six joints: turns that are not there stand behind the last joint, on its axis."""
    links, slides = list(loop.links), loop.slides
    missing = 6 - len(slides)
    if not missing:
        return loop
    place = None if any(slides[-2:]) else meeting(links[-2])
    first = np.eye(4)
    first[2, 3] = place[1] if place else 0.0
    c, s = np.cos(_OBLIQUE), np.sin(_OBLIQUE)
    bent = np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1.0]])
    added = [first @ bent] + [bent] * (missing - 1)
    links[-1:] = [*added, np.linalg.inv(np.linalg.multi_dot([*added, np.eye(4)])) @ links[-1]]
    return Loop(tuple(links), (*slides, *[False] * missing), (*loop.joints, *range(6 - missing, 6)))
