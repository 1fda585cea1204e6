"""Inverse models of elbow arms, with and without a spherical wrist, and of the wrist alone.

One closed form serves the RX-90 (MECA 953 slides), the KR210 joint list, the six-axis arm of
the EPFL slides, the elbow arm and the PUMA-like arm of the DH-m slides (Romanian) and the
repaired pen robot: each of them is only a DHm table. Seen from frame 1, an elbow arm is a
two-link arm in a plane that stands beside axis 1; the wrist is a z-y-z Euler triple between
constant rotations.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from dhkit.geometry import phasor, two_link

from .inverse import Answer, InverseModel, JointMap, outside_limits, translations
from .marks import (
    FOLDED,
    FOLDED_LINE,
    FREE_FIRST,
    FREE_LINE,
    FREE_PLANE,
    SIDEWAYS,
    STRETCHED,
    two_link_marks,
)
from .shoulder import Shoulder, shoulder
from .solutions import BEYOND, INSIDE, LIMITED, NOTHING, OFF, SHORT
from .tables import DHTable

_ALIGNED = 1e-9  # sine of the angle between axes 4 and 6 under which they count as aligned


class Postures(NamedTuple):
    """Arm postures: axes shoulder branch (2), elbow branch (2), poses (N).

    first (2, N), second and third (2, 2, N): theta_1 to theta_3 of the table, radians.
    first_turn = e^{i theta_1}, fore_turn = e^{i (theta_2 + theta_3)}. The rest as in Answer.
    """

    first: np.ndarray
    second: np.ndarray
    third: np.ndarray
    first_turn: np.ndarray
    fore_turn: np.ndarray
    valid: np.ndarray
    marks: np.ndarray
    miss: np.ndarray
    cause: np.ndarray


@dataclass(frozen=True)
class ArmGeometry:
    """The first three rows of an elbow arm and its tip, seen from frame 1.

    to_arm: 4x4, from the world to frame 1 at theta_1 = 0. side: +-1, the sense of axis 2
    (sine of alpha_1). out: a_1, from axis 1 to axis 2, metres. upper: a_2, metres. fore: the
    tip (tool point or wrist centre) in frame 3 as a complex number x + iy, metres. offset:
    lateral distance of the arm plane along y_1. size: sum of the lengths, for tolerances.
    """

    to_arm: np.ndarray
    side: float
    out: float
    upper: float
    fore: complex
    offset: float
    size: float

    @classmethod
    def of(cls, table: DHTable, tip: np.ndarray) -> ArmGeometry:
        """From the table and the tip (3,) in frame 3.

        Raises ValueError when rows 1 to 3 are not those of an elbow arm.
        """
        chain = table.chain
        upright = abs(chain.cos_alpha[1]) < 1e-12
        parallel = chain.cos_alpha[2] > 1.0 - 1e-12
        if not upright or not parallel or chain.prismatic[:3].any():
            raise ValueError("an elbow arm has revolute axes 2 and 3 parallel, square to axis 1")
        side = float(np.sign(chain.sin_alpha[1]))
        offset = -side * (chain.fixed[1] + chain.fixed[2] + tip[2])
        fore = complex(tip[0], tip[1])
        size = abs(chain.a[1]) + abs(chain.a[2]) + abs(fore) + abs(offset)
        to_arm = np.linalg.inv(chain.base @ chain.row_matrix(0, 0.0))
        return cls(to_arm, side, chain.a[1], chain.a[2], fore, offset, size)

    def in_plane(self, point: np.ndarray, anchor, tol: float) -> tuple[Shoulder, np.ndarray]:
        """Shoulder branches and the tip in the arm's plane, complex, (2, N).

        point: (3, N), metres, in frame 1 at theta_1 = 0. anchor: theta_1 where it is free.
        """
        branches = shoulder(point[0] + 1j * point[1], self.offset, self.size, anchor, tol)
        tip = (branches.radius - self.out) + 1j * (self.side * point[2])
        return branches, tip

    def postures(self, point: np.ndarray, anchors, tol: float) -> Postures:
        """All postures that bring the tip to a point (3, N); arguments as for in_plane.

        anchors: theta_1 and theta_2 where they are free.
        """
        branches, tip = self.in_plane(point, anchors[0], tol)
        upper_phase = np.angle(self.upper)
        fore_phase = np.angle(self.fore)
        arm = two_link(tip, abs(self.upper), abs(self.fore), anchors[1] + upper_phase, tol)
        outside = np.maximum(arm.beyond, arm.short)
        nearer = outside.argmin(axis=0)
        columns = np.arange(tip.shape[-1])
        first, bend, first_turn, bend_turn, reached = (by_elbow.swapaxes(0, 1) for by_elbow in arm[:5])
        valid = reached & branches.valid[:, None]
        miss, cause = outside[nearer, columns], np.where(arm.beyond > arm.short, BEYOND, SHORT)[nearer, columns]
        inside = ~branches.valid[0]
        miss = np.where(inside, branches.inside, miss)
        cause = np.where(inside, INSIDE, cause)
        solved = valid.any(axis=(0, 1))
        return Postures(
            first=np.angle(branches.turn),
            second=first - upper_phase,
            third=bend + (upper_phase - fore_phase),
            first_turn=branches.turn,
            fore_turn=first_turn * bend_turn * phasor(-fore_phase),
            valid=valid,
            marks=np.broadcast_to((two_link_marks(arm) | branches.marks)[:, None], valid.shape),
            miss=np.where(solved, 0.0, miss),
            cause=np.where(solved, NOTHING, cause),
        )

    def label(self, branch: int, marks: int) -> str:
        """Shoulder and elbow of arm branch 0 to 3 in words.

        Left: the tip lies on the side that x_1 points to. Right: axis 1 has turned round and
        the arm reaches over its back. Up: the elbow lies above the line from axis 2 to the
        tip, as seen when the tip is out in front of the shoulder.
        """
        right, second = divmod(branch, 2)
        side = "right" if right else "left"
        if marks & FREE_FIRST:
            side = "free"
        elif marks & SIDEWAYS:
            side = "sideways"
        bent_up = (self.side > 0) == (bool(second) != bool(right))
        elbow = "up" if bent_up else "down"
        if marks & STRETCHED:
            elbow = "stretched"
        elif marks & (FOLDED | FREE_PLANE):
            elbow = "folded"
        return f"shoulder {side}, elbow {elbow}"

    def unreachable(self, target: str, cause: int, miss: float) -> str:
        """Why the tip, called target, cannot be reached, in words."""
        if cause == INSIDE:
            return (
                f"the {target} is {miss:.3g} m inside the cylinder of radius "
                f"{abs(self.offset):.3g} m about axis 1 that the lateral offset leaves out"
            )
        if cause == BEYOND:
            reach = abs(self.upper) + abs(self.fore)
            return f"the {target} is {miss:.3g} m beyond the reach {reach:.3g} m of the elbow"
        inner = abs(abs(self.upper) - abs(self.fore))
        return f"the {target} is {miss:.3g} m inside the inner limit {inner:.3g} m of the elbow"


class ElbowArm(InverseModel):
    """Three revolute joints that bring a point (x, y, z) in place.

    Branches in order: shoulder left, right; within each, elbow bend in [0, pi] (the angle
    from upper arm to forearm, turning like theta_3), then in [-pi, 0]. At most 4 solutions.
    The orientation of a pose is not looked at: three joints cannot choose it.
    """

    task = "x, y, z"
    joints = 3
    branches = 4
    revolute = [0, 1, 2]
    anchors = {FREE_FIRST: (0,), FREE_PLANE: (1,)}

    def __init__(self, table: DHTable):
        super().__init__(table)
        self.arm = ArmGeometry.of(table, table.chain.tail(2)[:3, 3])
        self.map = JointMap.of(table.chain)
        if not (self.arm.upper and self.arm.fore):
            raise ValueError("an elbow arm needs an upper arm and a forearm")

    def pose(self, task):
        return translations(task)

    def kernel(self, poses, near, tol):
        point = self.arm.to_arm[:3] @ poses[:, :, 3].T
        arm = self.arm.postures(point, [self.map.row(i, near) for i in (0, 1)], tol)
        q = np.empty((3, 2, 2, len(poses)))
        q[0] = self.map.joint(0, arm.first)[:, None]
        q[1] = self.map.joint(1, arm.second)
        q[2] = self.map.joint(2, arm.third)
        return Answer(
            q.reshape(3, 4, -1),
            arm.valid.reshape(4, -1),
            arm.marks.reshape(4, -1),
            arm.miss,
            arm.cause,
        )

    def label(self, branch, marks):
        return self.arm.label(branch, marks)

    def unreachable(self, cause, miss):
        if cause == LIMITED:
            return outside_limits(miss)
        return self.arm.unreachable("point", cause, miss)


@dataclass(frozen=True)
class Wrist:
    """Rows 4 to 6, three axes that meet: Rot_z(u4) Rot_y(u5) Rot_z(u6) between constants.

    Source: spherical wrist of the MECA 953 slides. With alpha_4, alpha_5 = +-90 degrees,
    Rot_x(alpha_4) Rot_z(theta_5) Rot_x(-alpha_4) is a turn about y, so u4 = theta_4,
    u5 = -s4 theta_5, u6 = -s4 s5 theta_6 (s the sines), and a half turn about x remains
    behind when s4 = s5.

    cos_alpha, sin_alpha: of alpha_3, from the forearm to axis 4. signs: of u5, u6 in theta_5
    and theta_6. to_hand: 4x4 constant, the tool to the frame at the wrist centre.
    joints: of the whole robot; first: index of theta_4.
    """

    cos_alpha: float
    sin_alpha: float
    signs: tuple[float, float]
    to_hand: np.ndarray
    joints: JointMap
    first: int

    @classmethod
    def of(cls, table: DHTable, first: int) -> Wrist:
        """From the rows first, first+1, first+2 (counted from 0), the last ones that move.

        Raises ValueError when they are not a spherical wrist.
        """
        chain = table.chain
        i, j, k = first, first + 1, first + 2
        square = abs(chain.cos_alpha[j]) < 1e-12 and abs(chain.cos_alpha[k]) < 1e-12
        meeting = chain.a[j] == chain.a[k] == chain.fixed[j] == 0.0
        if not square or not meeting or chain.prismatic[first : first + 3].any():
            raise ValueError("a spherical wrist has three revolute axes, square, in one point")
        s4, s5 = np.sign(chain.sin_alpha[[j, k]])
        centre_to_tool = np.diag([1.0, -s4 * s5, -s4 * s5, 1.0])
        centre_to_tool[2, 3] = -s4 * s5 * chain.fixed[k]  # d6, along axis 6
        return cls(
            chain.cos_alpha[i],
            chain.sin_alpha[i],
            (-s4, -s4 * s5),
            np.linalg.inv(centre_to_tool @ chain.tail(k)),
            JointMap.of(chain),
            first,
        )

    def solve(self, x, y, z, near):
        """Joint values of both wrist branches.

        x, y, z: rows of the hand's rotation seen from the forearm frame, before alpha_3; each
        a triple (s, n, a) of arrays (...). near: (n, N) or None. Returns three arrays
        (2, ...), branch 0 with the middle joint in [0, pi] (if its offset is a multiple of
        pi), and the marks (...).
        """
        ca, sa = self.cos_alpha, self.sin_alpha
        m13, m23, m33 = x[2], ca * y[2] + sa * z[2], ca * z[2] - sa * y[2]
        sine = np.sqrt(m13**2 + m23**2)
        aligned = sine <= _ALIGNED
        # The branch with q5 >= 0 comes first; u5 may run the other way or be half a turn off.
        lead = -1.0 if np.sin(self._joint(1, self.signs[0] * np.pi / 2)) < -_ALIGNED else 1.0
        size = lead * np.where(aligned, 1.0, sine)
        c4, s4 = m13 / size, m23 / size
        if aligned.any():
            anchor = self.joints.row(self.first, near)
            c4 = np.where(aligned, np.cos(anchor), c4)
            s4 = np.where(aligned, np.sin(anchor), s4)
        # Whatever u4 is, the other two follow from it, so that no error is left behind.
        u4 = np.arctan2(s4, c4)
        u5 = np.arctan2(c4 * m13 + s4 * m23, m33)
        m11, m21 = x[0], ca * y[0] + sa * z[0]
        m12, m22 = x[1], ca * y[1] + sa * z[1]
        u6 = np.arctan2(c4 * m21 - s4 * m11, c4 * m22 - s4 * m12)
        marks = np.where(aligned, np.where(m33 < 0, FREE_LINE | FOLDED_LINE, FREE_LINE), 0)
        both = [
            np.stack([self._joint(i, sign * first), self._joint(i, sign * second)])
            for i, sign, first, second in (
                (0, 1.0, u4, u4 + np.pi),
                (1, self.signs[0], u5, -u5),
                (2, self.signs[1], u6, u6 + np.pi),
            )
        ]
        return both, marks.astype(np.uint8)

    def _joint(self, index, row):
        return self.joints.joint(self.first + index, row)

    @property
    def line(self) -> tuple[int, int, int, int]:
        """Joints of axes 4 and 6 and the sign of the defined sum, plain and folded.

        u4 + u6 is defined at u5 = 0, u4 - u6 at u5 = pi.
        """
        i, j = self.first, self.first + 2
        sign = int(self.joints.sign[i] * self.joints.sign[j] * self.signs[1])
        return i, j, sign, -sign

    def label(self, flipped: int, marks: int) -> str:
        """The wrist branch in words; straight when axis 6 points along axis 4."""
        if marks & FREE_LINE:
            opposite = bool(marks & FOLDED_LINE) != (self.signs[1] < 0)
            return "wrist folded" if opposite else "wrist straight"
        return "wrist flipped" if flipped else "wrist unflipped"


class WristedArm(InverseModel):
    """An elbow arm with a spherical wrist: six revolute joints, at most 8 solutions.

    Branches in order: shoulder left, right; within each the elbow bend in [0, pi], then in
    [-pi, 0] (see ElbowArm); within each the wrist with q5 in [0, pi], then flipped.
    Where axes 4 and 6 are aligned the two wrist branches are one family, kept as the first.
    """

    joints = 6
    branches = 8
    revolute = [0, 1, 2, 3, 4, 5]
    anchors = {FREE_FIRST: (0,), FREE_PLANE: (1,)}

    def __init__(self, table: DHTable):
        super().__init__(table)
        chain = table.chain
        self.arm = ArmGeometry.of(table, chain.row_matrix(3, 0.0)[:3, 3])
        self.map = JointMap.of(chain)
        self.wrist = Wrist.of(table, first=3)
        self.line = self.wrist.line
        if not (self.arm.upper and self.arm.fore):
            raise ValueError("an elbow arm needs an upper arm and a forearm")

    def kernel(self, poses, near, tol):
        hand = self.arm.to_arm @ poses @ self.wrist.to_hand
        s, n, a, centre = np.ascontiguousarray(hand[:, :3].transpose(2, 1, 0))
        arm = self.arm.postures(centre, [self.map.row(i, near) for i in (0, 1)], tol)
        # The hand's axes seen from frame 1, then from frame 3.
        back1, back3 = np.conj(arm.first_turn), np.conj(arm.fore_turn)
        side = self.arm.side
        x, y, z = [], [], []
        for axis in (s, n, a):
            flat = (axis[0] + 1j * axis[1]) * back1
            plane = (flat.real + 1j * (side * axis[2]))[:, None] * back3
            x.append(plane.real)
            y.append(plane.imag)
            z.append((-side * flat.imag)[:, None])
        (q4, q5, q6), wrist_marks = self.wrist.solve(x, y, z, near)
        q = np.empty((6, 2, 2, 2, len(poses)))
        q[0] = self.map.joint(0, arm.first)[:, None, None]
        q[1] = self.map.joint(1, arm.second)[:, :, None]
        q[2] = self.map.joint(2, arm.third)[:, :, None]
        for i, both in enumerate((q4, q5, q6)):
            q[3 + i] = np.moveaxis(both, 0, 2)
        valid = np.repeat(arm.valid[:, :, None], 2, axis=2)
        valid[:, :, 1] &= wrist_marks == 0
        marks = np.repeat((arm.marks | wrist_marks)[:, :, None], 2, axis=2)
        return Answer(q.reshape(6, 8, -1), valid.reshape(8, -1), marks.reshape(8, -1), arm.miss, arm.cause)

    def label(self, branch, marks):
        return f"{self.arm.label(branch // 2, marks)}, {self.wrist.label(branch % 2, marks)}"

    def unreachable(self, cause, miss):
        if cause == LIMITED:
            return outside_limits(miss)
        return self.arm.unreachable("wrist centre", cause, miss)


class WristAlone(InverseModel):
    """A spherical wrist on a fixed forearm: any orientation, about one fixed centre.

    Branches in order: middle joint in [0, pi], then flipped. At most 2 solutions. The
    position of a pose must be the one that its orientation implies.
    """

    joints = 3
    branches = 2
    revolute = [0, 1, 2]
    anchors = {}

    def __init__(self, table: DHTable):
        super().__init__(table)
        chain = table.chain
        self.wrist = Wrist.of(table, first=0)
        self.line = self.wrist.line
        first = chain.row_matrix(0, 0.0)
        self._to_centre = chain.base.copy()
        self._to_centre[:3, 3] += chain.base[:3, :3] @ first[:3, 3]
        self._to_centre = np.linalg.inv(self._to_centre)

    def kernel(self, poses, near, tol):
        hand = self._to_centre @ poses @ self.wrist.to_hand
        x, y, z = np.ascontiguousarray(hand[:, :3, :3].transpose(1, 2, 0))
        both, marks = self.wrist.solve(x, y, z, near)
        miss = np.sqrt((hand[:, :3, 3] ** 2).sum(axis=1))
        valid = np.repeat((miss <= tol)[None], 2, axis=0)
        cause = np.where(valid[0], NOTHING, OFF)
        miss = np.where(valid[0], 0.0, miss)
        valid[1] &= marks == 0
        return Answer(np.stack(both), valid, np.stack([marks, marks]), miss, cause)

    def label(self, branch, marks):
        return self.wrist.label(branch, marks)

    def unreachable(self, cause, miss):
        if cause == LIMITED:
            return outside_limits(miss)
        return f"the wrist centre is {miss:.3g} m away from where the three axes meet"
