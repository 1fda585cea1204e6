"""Inverse models of arms that move in a plane: planar arms with n joints and the SCARA.

Sources: two-link arm and SCARA of the EPFL slides, SCARA of the MECA 953 slides, planar
tables of the DH-m slides (Romanian), s600 tutorial.
"""

from __future__ import annotations

import numpy as np

from .gauge import demand_kinds, demand_length, demand_parallel
from .geometry import SAME_LENGTH, phasor, rotation, two_link, wrap
from .inverse import Branches, InverseModel, JointMap, translations
from .status import Failure, Flag, two_link_flags
from .tables import DHTable


class PlanarArm(InverseModel):
    """n >= 2 revolute joints with parallel axes, at most 2 solutions or a family.

    n = 2: the task is the point (x, y); the orientation of a pose is not looked at, two
    joints cannot choose it. n >= 3: the task is (x, y, phi), phi the direction of the last
    link, and a pose must not be tilted.
    Branches in order: bend of the last two links in [0, pi] ("elbow down" when the target is
    to the right), then in [-pi, 0].
    n > 3: a family of n - 3 dimensions. Its representative keeps q1 .. q_{n-3} at their
    wished values where the rest of the arm can then reach the target, and otherwise moves
    them, one after the other, by as little as needed.
    """

    branch_count = 2

    def __init__(self, table: DHTable) -> None:
        super().__init__(table)
        chain = self.chain
        n = chain.joints
        if n < 2:
            raise ValueError("it has fewer than two joints")
        self.map = JointMap.of(chain)
        demand_kinds(table.chain, [0] * n)
        for row in range(1, n):
            demand_parallel(table.chain, row)
        tail = chain.tail(n - 1)
        if abs(abs(tail[2, 2]) - 1.0) > 1e-12:
            tilt = np.degrees(np.arccos(tail[2, 2]))
            raise ValueError(f"the z axis of its tool is tilted by {tilt:.6g} degrees from the joint axes")
        self.revolute = tuple(range(n))
        height = chain.fixed[1:n].sum() + tail[2, 3]
        plane = chain.base @ chain.row_matrix(0, 0.0)
        plane[:3, 3] += height * plane[:3, 2]
        self._height = plane[2, 3]
        self._to_plane = np.linalg.inv(plane)
        self._up = np.sign(tail[2, 2])  # -1 for a tool that is held upside down
        self._tip = complex(tail[0, 3], tail[1, 3])
        self._tip_turn = np.arctan2(tail[1, 0], tail[0, 0])
        if n == 2:
            self.task = "x, y"
            self.links = np.array([chain.a[1], abs(self._tip)])
        else:
            self.task = "x, y, phi"
            self.links = chain.a[1:n]
        for i, link in enumerate(self.links, start=1):
            demand_length(link, f"link {i}", f"a_{i}" if i < n else "the tool's x, y")
        self._spare = max(n - 3, 0)
        self.anchors = {Flag.FREE_PLANE: (self._spare,)}
        if self._spare:
            self.anchors[Flag.FREE_CHAIN] = tuple(range(self._spare))

    @property
    def reach(self) -> tuple[float, float]:
        """Inner and outer radius, metres: of the tip (n = 2) or of the last joint (n >= 3)."""
        return _reach(self.links)

    def pose(self, task: np.ndarray) -> np.ndarray:
        if task.shape[1] != (2 if self.joints == 2 else 3):
            raise ValueError(f"expected the coordinates {self.task}, found {task.shape[1]} numbers")
        poses = translations(task[:, :2])
        poses[:, 2, 3] = self._height
        if self.joints > 2:
            poses[:, :3, :3] = rotation("z", task[:, 2]) @ np.diag([1.0, self._up, self._up])
        return poses

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        flat = self._to_plane @ poses
        target, height, tilt, heading = _flattened(flat, self._up)
        off = np.abs(height)
        bend_offset = np.angle(self._tip) if self.joints == 2 else 0.0
        if self.joints == 2:
            tilt = np.zeros_like(tilt)
        else:
            heading = heading - self._tip_turn
            target = target - self._tip * phasor(heading)
        least, most = self.reach
        beyond, short = np.abs(target) - most, least - np.abs(target)

        q = np.empty((self.joints, 2, len(poses)))
        rest, direction = self._place_spare_links(q, target, near)
        i = self._spare
        arm = two_link(rest, self.links[i], self.links[i + 1], direction + self.map.row(i, near), tol)
        q[i] = self.map.joint(i, arm.first - direction)
        q[i + 1] = self.map.joint(i + 1, arm.bend - bend_offset)
        if self.joints > 2:
            q[-1] = self.map.joint(self.joints - 1, heading - arm.first - arm.bend)

        flags = self._flags_of_chain(two_link_flags(arm), beyond, short) if self._spare else two_link_flags(arm)
        failing = [tilt > tol, off > tol, beyond > tol, short > tol]
        return Branches(
            q,
            arm.valid & ~np.any(failing, axis=0),
            np.stack([flags, flags]),
            np.select(failing, [tilt, off, beyond, short], 0.0),
            np.select(failing, [Failure.TILTED, Failure.OFF, Failure.BEYOND, Failure.SHORT], Failure.NONE),
        )

    def _place_spare_links(
        self, q: np.ndarray, target: np.ndarray, near: np.ndarray | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Write the first n - 3 joints to q; what of the target is left for the others, and their direction."""
        direction = np.zeros(len(target))
        for i in range(self._spare):
            wished = direction + self.map.row(i, near)
            placed = _placed(target, self.links[i], _reach(self.links[i + 1 :]), wished)
            q[i] = self.map.joint(i, placed - direction)
            target, direction = target - self.links[i] * phasor(placed), placed
        return target, direction

    def _flags_of_chain(self, flags: np.ndarray, beyond: np.ndarray, short: np.ndarray) -> np.ndarray:
        """Flags of the whole arm: its last two links may lie straight by choice, which is no limit of it."""
        least, most = self.reach
        folded = (short >= -SAME_LENGTH * most) & (least > 0)
        limit = np.where(folded, Flag.FOLDED, Flag.FREE_CHAIN)
        limit = np.where(beyond >= -SAME_LENGTH * most, Flag.STRETCHED, limit)
        return (flags & Flag.FREE_PLANE) | limit.astype(np.uint8)

    def label(self, branch: int, flags: int) -> str:
        return _elbow(branch, flags, ("down", "up"))

    def unreachable(self, failure: Failure, excess: float) -> str:
        point = "point" if self.joints == 2 else "last joint"
        return _out_of_plane_reach(point, self.reach, failure, excess)


class Scara(InverseModel):
    """Four joints with parallel axes: revolute, revolute, prismatic, revolute.

    The task is (x, y, z, omega), omega the direction of the tool's x axis in the plane; a
    pose must keep the tool upright. Branches in order: second angle in [0, pi] ("elbow
    right", seen from above towards the target), then in [-pi, 0] ("elbow left").
    """

    task = "x, y, z, omega"
    expected_joints = 4
    branch_count = 2
    revolute = (0, 1, 3)

    def __init__(self, table: DHTable) -> None:
        super().__init__(table)
        chain = self.chain
        self.map = JointMap.of(chain)
        demand_kinds(table.chain, [0, 0, 1, 0])
        for row in range(1, 4):
            demand_parallel(table.chain, row)
        for row in (1, 2):
            demand_length(chain.a[row], f"link {row}", f"a_{row}")
        if chain.a[3]:
            raise ValueError(f"axis 4 stands beside the quill: a_3 = {table.chain.a[3]:.6g} m")
        self.anchors = {Flag.FREE_PLANE: (0,)}
        self.links = chain.a[1:3]
        self._to_base = np.linalg.inv(chain.base @ chain.row_matrix(0, 0.0))
        self._to_flange = np.linalg.inv(chain.tail(3))
        self._quill_turn = chain.fixed[2]
        self._height = chain.fixed[1] + chain.fixed[3]
        # The tool at all joints zero gives its posture at omega = 0.
        self._home = chain.forward(np.zeros(4))
        turn = np.arctan2(self._home[1, 0], self._home[0, 0])
        self._home[:3, :3] = rotation("z", -turn) @ self._home[:3, :3]

    @property
    def reach(self) -> tuple[float, float]:
        """Inner and outer radius of axis 4 about axis 1, metres."""
        return _reach(self.links)

    def pose(self, task: np.ndarray) -> np.ndarray:
        if task.shape[1] != 4:
            raise ValueError(f"expected the coordinates {self.task}, found {task.shape[1]} numbers")
        poses = translations(task[:, :3])
        poses[:, :3, :3] = rotation("z", task[:, 3])
        poses[:, :3, :3] = poses[:, :3, :3] @ self._home[:3, :3]
        return poses

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        flange = self._to_base @ poses @ self._to_flange
        target, height, tilt, heading = _flattened(flange)
        arm = two_link(target, self.links[0], self.links[1], self.map.row(0, near), tol)
        q = np.empty((4, 2, len(poses)))
        q[0] = self.map.joint(0, arm.first)
        q[1] = self.map.joint(1, arm.bend)
        q[2] = self.map.joint(2, height - self._height)
        last = heading - arm.first - arm.bend - self._quill_turn
        q[3] = self.map.joint(3, last)
        failing = [tilt > tol, arm.beyond > tol, arm.short > tol]
        return Branches(
            q,
            arm.valid & ~failing[0],
            np.stack([two_link_flags(arm), two_link_flags(arm)]),
            np.select(failing, [tilt, arm.beyond, arm.short], 0.0),
            np.select(failing, [Failure.TILTED, Failure.BEYOND, Failure.SHORT], Failure.NONE),
        )

    def label(self, branch: int, flags: int) -> str:
        return _elbow(branch, flags, ("right", "left"))

    def unreachable(self, failure: Failure, excess: float) -> str:
        return _out_of_plane_reach("tool axis", self.reach, failure, excess)


def _flattened(frames: np.ndarray, up: float = 1.0) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Target (complex), height, tilt of the z axis from up and heading of frames (N, 4, 4)."""
    target = frames[:, 0, 3] + 1j * frames[:, 1, 3]
    tilt = np.arctan2(np.hypot(frames[:, 0, 2], frames[:, 1, 2]), up * frames[:, 2, 2])
    heading = np.arctan2(frames[:, 1, 0], frames[:, 0, 0])
    return target, frames[:, 2, 3], tilt, heading


def _reach(links: np.ndarray) -> tuple[float, float]:
    """Inner and outer radius a chain of links can reach, metres."""
    return max(0.0, 2.0 * max(links) - sum(links)), sum(links)


def _placed(target: np.ndarray, link: float, reach: tuple[float, float], wished: np.ndarray) -> np.ndarray:
    """Direction of a link, as near to the wished one as the rest of the arm allows.

    The end of the link must lie between the radii ``reach`` from the target; by the law of
    cosines that bounds the angle between link and target from below and from above.
    """
    r, towards = np.abs(target), np.angle(target)
    least, most = (
        2.0
        * np.arctan2(
            np.sqrt(np.maximum(d**2 - (link - r) ** 2, 0.0)),
            np.sqrt(np.maximum((link + r) ** 2 - d**2, 0.0)),
        )
        for d in reach
    )
    aside = wrap(wished - towards)
    return towards + np.copysign(np.clip(np.abs(aside), least, most), aside)


def _elbow(branch: int, flags: int, sides: tuple[str, str]) -> str:
    if flags & Flag.STRETCHED:
        return "arm stretched"
    if flags & (Flag.FOLDED | Flag.FREE_PLANE):
        return "arm folded"
    return f"elbow {sides[branch]}"


def _out_of_plane_reach(point: str, reach: tuple[float, float], failure: Failure, excess: float) -> str:
    least, most = reach
    texts = {
        Failure.BEYOND: f"the {point} is {excess:.3g} m beyond the reach {most:.3g} m",
        Failure.SHORT: f"the {point} is {excess:.3g} m inside the inner limit {least:.3g} m",
        Failure.TILTED: f"the pose is tilted by {excess:.3g} rad, which parallel axes cannot do",
        Failure.OFF: f"the pose is {excess:.3g} m out of the arm's plane",
    }
    return texts[failure]
