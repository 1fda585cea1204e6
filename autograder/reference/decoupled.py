"""Six joints of which three neighbours form a group: a spherical wrist, or three joints that move in a plane.

Turns about axes through one point leave that point in place; turns about parallel axes, and slides square to them, leave
their plane in place. So the other three joints alone bring the point (the plane) to where it must be: a problem of
three unknowns, in `elimination`. Then the three of the group do the rest. The group may stand anywhere in the arm:
what goes from the tool to the base is as good as a link. UR arms have their group in axes 2 to 4, oblique and offset
shoulders, Stanford arms, gantries and cylindrical arms with a wrist have it in axes 4 to 6. Source: D. Pieper, "The
kinematics of manipulators under computer control", 1968; C. Mavroidis, B. Roth, "Structural parameters which reduce
the number of manipulator configurations", 1994, doi:10.1115/1.2919387.
"""

from __future__ import annotations

import numpy as np

from .elimination import PointProblem
from .groups import Group, Plane, Sphere, meeting
from .inverse import Branches, InverseModel, JointMap, translations
from .loop import Loop, in_unit, motion
from .settling import settled
from .singularities import chain_mobility
from .status import Failure, Flag
from .tables import DHTable

_VIRTUAL = 1e-3  # radians by which a joint that is not there may turn before the posture is brought onto the pose
_OBLIQUE = 1.0  # radians between an axis that is not there and the one before: never aligned with a third one
_ANCHORED = Flag.FREE_FIRST | Flag.FREE_PLANE | Flag.FREE_CHAIN
_ASIDE = np.radians([sign * step for step in range(5, 181, 5) for sign in (1, -1)])


class Decoupled(InverseModel):
    """Up to six joints, three of which form a group: see the module. At most 8 solutions.

    Branches in order: the up to four solutions of the other three joints; within each, both solutions of the group. The
    roots of a polynomial have no names, so that "arm 2" is a place in a list and no shape of the arm. Arms of four or
    five joints are solved as if the missing ones stood behind the tool; postures that turn those do not count.
    """

    branch_count = 8

    def __init__(self, table: DHTable) -> None:
        """Raises ValueError unless three neighbouring joints form a group, and the joints give all freedoms they can."""
        super().__init__(table)
        chain = self.chain
        if not 3 <= self.joints <= 6:
            raise ValueError(f"it has {self.joints} joints, not 3 to 6")
        self.map = JointMap.of(chain)
        freedoms = chain_mobility(chain)
        if freedoms < self.joints:
            raise ValueError(f"its {self.joints} joints give {freedoms} freedoms only")
        self.revolute = tuple(int(i) for i in np.flatnonzero(~chain.prismatic[: self.joints]))
        loop = Loop.of(chain)
        self.size = loop.size
        self.loop, self.at, self.group, self.backwards = _grouped(loop.scaled(1 / self.size))
        self._order = [self.loop.joints[(self.at + i) % 6] for i in range(6)]  # from the group on round the loop
        anchors = {Flag.FREE_FIRST: 3, Flag.FREE_PLANE: 4, Flag.FREE_CHAIN: 5}
        if isinstance(self.group, Plane):
            anchors = {Flag.FREE_FIRST: 4, Flag.FREE_PLANE: self.group.free, Flag.FREE_CHAIN: 5}
        named = {flag: self._order[place] for flag, place in anchors.items()}
        self.anchors = {flag: (joint,) for flag, joint in named.items() if joint < self.joints}
        if self.group.line:
            i, j = sorted((self._order[0], self._order[2]))
            sense = int(self.map.sign[i] * self.map.sign[j])
            self.line = i, j, sense, -sense

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        start = np.zeros((6, len(poses)))
        for i in range(self.joints):
            start[i] = self.map.row(i, near)
        branches, missing = self._branches(poses, start, tol)
        # Of a family, the member at the wished values may be out of reach: then the nearest one on a grid that is not.
        free = sorted({j for joints in self.anchors.values() for j in joints})
        for step in _ASIDE:
            lacking = np.flatnonzero(missing.any(axis=0))
            if not len(lacking):
                break
            aside = start[:, lacking]
            aside[free] += step
            found = self._branches(poses[lacking], aside, tol)[0]
            new = found.valid & missing[:, lacking]
            branch, pose = np.nonzero(new)
            branches.q[:, branch, lacking[pose]] = found.q[:, branch, pose]
            branches.flags[branch, lacking[pose]] = found.flags[branch, pose]
            branches.valid[branch, lacking[pose]], missing[branch, lacking[pose]] = True, False
            reached = lacking[new.any(axis=0)]
            branches.excess[reached], branches.failure[reached] = 0.0, Failure.NONE
        return branches

    def _branches(self, poses: np.ndarray, start: np.ndarray, tol: float) -> tuple[Branches, np.ndarray]:
        """All branches with free rows at start (6, N), and those (K, N) that would be families if the rest could follow."""
        count = len(poses)
        unit = np.where(np.append(self.chain.prismatic[: self.joints], [False] * (6 - self.joints)), self.size, 1.0)[
            :, None
        ]
        start = start / unit
        T = in_unit(poses, 1 / self.size)
        if self.backwards:
            start, T = -start, np.linalg.inv(T)
        near = [start[place] for place in self._order]
        links = [link[None] for link in self.loop.links]
        closing = links[6] @ np.linalg.inv(T) @ links[0]
        around = [*links[self.at + 3 : 6], closing, *links[1 : self.at + 1]]
        slides = [self.loop.slides[(self.at + i) % 6] for i in range(3, 6)]
        other = self.group.others(around, tuple(slides), tuple(near[3:]))  # type: ignore[arg-type]
        values = (other.first, other.second, other.third)
        D = around[0]
        for slide, value, link in zip(slides, values, around[1:]):
            D = D @ motion(slide, value) @ link
        blurred = (other.flags & Flag.STRETCHED) != 0
        both = self.group.solve(np.linalg.inv(D), tuple(near[:3]), blurred)  # type: ignore[arg-type]
        q = np.empty((6, 4, 2, count))
        for place, value in zip(
            self._order, [np.moveaxis(each, 0, 1) for each in both.values] + [v[:, None] for v in values]
        ):
            q[place] = value
        if self.backwards:
            q = -q
        q *= unit[:, None, None]
        flags = (other.flags[:, None] | np.moveaxis(both.flags, 0, 1)).reshape(8, count)
        wanted = (np.repeat(other.valid, 2, axis=0)) & ((flags & _ANCHORED) != 0)
        valid = (other.valid[:, None] & np.moveaxis(both.valid, 0, 1)).reshape(8, count)
        for absent in q[self.joints :].reshape(-1, 8, count):
            valid &= (np.abs(np.angle(np.exp(1j * absent))) <= _VIRTUAL) | wanted
        joint = np.stack([self.map.joint(i, q[i]) for i in range(self.joints)]).reshape(self.joints, 8, count)
        branches, reached = settled(self.chain, self.size, joint, valid, flags, poses, tol)
        return branches, wanted & ~reached

    def label(self, branch: int, flags: int) -> str:
        if flags & Flag.LIMIT:
            return f"arm {branch // 2 + 1}, at a limit"
        return f"arm {branch // 2 + 1}, {self.group.words[branch % 2]}"

    def unreachable(self, failure: Failure, excess: float) -> str:
        return f"no posture reaches the pose, the nearest one found misses it by {excess:.3g} m"


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


def _grouped(loop: Loop) -> tuple[Loop, int, Group, bool]:
    """The loop with six joints, or that backwards, with its group at index 0 or 1; which index, the group, whether backwards."""
    joints = len(loop.slides)
    for kind in (Sphere, Plane) if joints == 6 else (Plane, Sphere):
        for walked, backwards in ((loop, False), (loop.reversed(), True)):
            whole = _completed(walked)
            for candidate, turned in ((whole, False), (whole.reversed(), True)):
                for at in (0, 1):
                    group = kind.of(candidate, at, joints)
                    if group is not None and (
                        kind is Sphere or not any(candidate.slides[at + 3 :] + candidate.slides[:at])
                    ):
                        return candidate, at, group, backwards != turned
    raise ValueError("no three neighbouring axes meet in one point or are parallel, which would decouple it")


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
