"""Inverse models of elbow arms, with and without a spherical wrist, and of the wrist alone.

One closed form serves the RX-90 (MECA 953 slides), the KR210 joint list, the six-axis arm of
the EPFL slides, the elbow arm and the PUMA-like arm of the DH-m slides (Romanian) and the
repaired pen robot: each of them is only a DHm table. Seen from frame 1, an elbow arm is a
two-link arm in a plane that stands beside axis 1; the wrist is a z-y-z Euler triple between
constant rotations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import nearly_aligned
from .forward import Chain
from .gauge import demand_kinds, demand_length, demand_parallel, demand_square
from .geometry import phasor, two_link
from .inverse import Branches, InverseModel, JointMap, translations
from .shoulder import Shoulder, shoulder
from .solutions import Batch
from .status import Failure, Flag, two_link_flags
from .tables import DHTable

_ALIGNED = 1e-9  # sine of the angle between axes 4 and 6 under which they count as aligned


class Postures(NamedTuple):
    """Arm postures, with the axes shoulder branch (2), elbow branch (2), poses (N).

    Attributes
    ----------
    first : (2, N) array
        theta_1, radians.
    second, third : (2, 2, N) arrays
        theta_2 and theta_3, radians.
    first_phasor, fore_phasor : complex arrays
        e^{i theta_1}, (2, N), and e^{i (theta_2 + theta_3)}, (2, 2, N).
    valid, flags : (2, 2, N) arrays
    excess, failure : (N,) arrays
        As in `inverse.Branches`.
    """

    first: np.ndarray
    second: np.ndarray
    third: np.ndarray
    first_phasor: np.ndarray
    fore_phasor: np.ndarray
    valid: np.ndarray
    flags: np.ndarray
    excess: np.ndarray
    failure: np.ndarray


@dataclass(frozen=True)
class ArmGeometry:
    """The first three rows of an elbow arm and its tip, seen from frame 1.

    Attributes
    ----------
    to_arm : (4, 4) array
        From the world to frame 1 at theta_1 = 0.
    side : float
        +1 or -1, the sense of axis 2 (sine of alpha_1).
    out, upper : float
        a_1, from axis 1 to axis 2, and a_2 >= 0, metres.
    fore : complex
        The tip (tool point or wrist centre) in frame 3 as x + iy, metres.
    offset : float
        Lateral distance of the arm plane along y_1, metres.
    size : float
        Sum of the lengths, metres, for tolerances.
    """

    to_arm: np.ndarray
    side: float
    out: float
    upper: float
    fore: complex
    offset: float
    size: float

    @classmethod
    def of(cls, chain: Chain, tip: np.ndarray) -> ArmGeometry:
        """From a chain in canonical gauge, whose rows 1 to 3 `demand_elbow`, and the tip (3,) in frame 3."""
        side = float(np.sign(chain.sin_alpha[1]))
        offset = -side * (chain.fixed[1] + chain.fixed[2] + tip[2])
        fore = complex(tip[0], tip[1])
        size = abs(chain.a[1]) + chain.a[2] + abs(fore) + abs(offset)
        to_arm = np.linalg.inv(chain.base @ chain.row_matrix(0, 0.0))
        return cls(to_arm, side, chain.a[1], chain.a[2], fore, offset, size)

    def in_plane(self, point: np.ndarray, anchor: ArrayLike, tol: float) -> tuple[Shoulder, np.ndarray]:
        """Shoulder branches and the tip in the arm's plane, complex, (2, N).

        Parameters
        ----------
        point : (3, N) array
            Metres, in frame 1 at theta_1 = 0.
        anchor : array_like
            theta_1 where it is free, radians.
        tol : float
            As for `shoulder`.
        """
        branches = shoulder(point[0] + 1j * point[1], self.offset, self.size, anchor, tol)
        tip = (branches.radius - self.out) + 1j * (self.side * point[2])
        return branches, tip

    def postures(self, point: np.ndarray, anchors: Sequence[ArrayLike], tol: float) -> Postures:
        """All postures that bring the tip to a point; parameters as for `in_plane`.

        anchors : theta_1 and theta_2 where they are free, radians.
        """
        branches, tip = self.in_plane(point, anchors[0], tol)
        fore_phase = np.angle(self.fore)
        arm = two_link(tip, self.upper, abs(self.fore), anchors[1], tol)
        first, bend, first_turn, bend_turn, reached = (by_elbow.swapaxes(0, 1) for by_elbow in arm[:5])
        valid = reached & branches.valid[:, None]
        lost = ~valid.any(axis=(0, 1))
        excess, failure = np.zeros(lost.size), np.full(lost.size, Failure.NONE, dtype=int)
        if lost.any():
            missed = np.maximum(arm.beyond, arm.short)[:, lost]
            nearer = missed.argmin(axis=0), np.arange(missed.shape[1])
            too_far = (arm.beyond > arm.short)[:, lost][nearer]
            inside = branches.inside[lost]
            within = ~branches.valid[0, lost] & (inside >= missed[nearer])  # of two conditions the one missed by more
            excess[lost] = np.where(within, inside, missed[nearer])
            failure[lost] = np.where(within, Failure.INSIDE, np.where(too_far, Failure.BEYOND, Failure.SHORT))
        return Postures(
            first=np.angle(branches.phasor),
            second=first,
            third=bend - fore_phase,
            first_phasor=branches.phasor,
            fore_phasor=first_turn * bend_turn * phasor(-fore_phase),
            valid=valid,
            flags=np.broadcast_to((two_link_flags(arm) | branches.flags)[:, None], valid.shape),
            excess=excess,
            failure=failure,
        )

    def label(self, branch: int, flags: int) -> str:
        """Shoulder and elbow of arm branch 0 to 3 in words.

        Left: the tip lies on the side that x_1 points to. Right: axis 1 has turned round and
        the arm reaches over its back. Up: the elbow lies above the line from axis 2 to the
        tip, as seen when the tip is out in front of the shoulder.
        """
        right, second = divmod(branch, 2)
        side = "right" if right else "left"
        if flags & Flag.FREE_FIRST:
            side = "free"
        elif flags & Flag.SIDEWAYS:
            side = "sideways"
        bent_up = (self.side > 0) == (bool(second) != bool(right))
        elbow = "up" if bent_up else "down"
        if flags & Flag.STRETCHED:
            elbow = "stretched"
        elif flags & (Flag.FOLDED | Flag.FREE_PLANE):
            elbow = "folded"
        return f"shoulder {side}, elbow {elbow}"

    def unreachable(self, target: str, failure: Failure, excess: float) -> str:
        """Why the tip, called target, cannot be reached, in words."""
        if failure == Failure.INSIDE:
            return (
                f"the {target} is {excess:.3g} m inside the cylinder of radius "
                f"{abs(self.offset):.3g} m about axis 1 that the lateral offset leaves out"
            )
        if failure == Failure.BEYOND:
            reach = self.upper + abs(self.fore)
            return f"the {target} is {excess:.3g} m beyond the reach {reach:.3g} m of the elbow"
        inner = abs(self.upper - abs(self.fore))
        return f"the {target} is {excess:.3g} m inside the inner limit {inner:.3g} m of the elbow"


def demand_elbow(chain: Chain) -> None:
    """Raises ValueError unless axes 2 and 3 of a table are revolute and parallel, square to axis 1."""
    demand_kinds(chain, [0, 0, 0])
    demand_square(chain, 1)
    demand_parallel(chain, 2)


class ElbowArm(InverseModel):
    """Three revolute joints that bring a point (x, y, z) in place.

    Branches in order: shoulder left, right; within each, elbow bend in [0, pi] (the angle
    from upper arm to forearm, turning like theta_3), then in [-pi, 0]. At most 4 solutions.
    The orientation of a pose is not looked at: three joints cannot choose it.
    """

    task = "x, y, z"
    expected_joints = 3
    branch_count = 4
    revolute = (0, 1, 2)

    def __init__(self, table: DHTable) -> None:
        super().__init__(table)
        self.anchors = {Flag.FREE_FIRST: (0,), Flag.FREE_PLANE: (1,)}
        self.map = JointMap.of(self.chain)
        demand_elbow(table.chain)
        self.arm = ArmGeometry.of(self.chain, self.chain.tail(2)[:3, 3])
        demand_length(self.arm.upper, "the upper arm", "a_2")
        demand_length(abs(self.arm.fore), "the forearm", "the tool's distance from axis 3")

    def pose(self, task: np.ndarray) -> np.ndarray:
        return translations(task)

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        point = self.arm.to_arm[:3] @ poses[:, :, 3].T
        arm = self.arm.postures(point, [self.map.row(i, near) for i in (0, 1)], tol)
        q = np.empty((3, 2, 2, len(poses)))
        q[0] = self.map.joint(0, arm.first)[:, None]
        q[1] = self.map.joint(1, arm.second)
        q[2] = self.map.joint(2, arm.third)
        return Branches(
            q.reshape(3, 4, -1),
            arm.valid.reshape(4, -1),
            arm.flags.reshape(4, -1),
            arm.excess,
            arm.failure,
        )

    def label(self, branch: int, flags: int) -> str:
        return self.arm.label(branch, flags)

    def unreachable(self, failure: Failure, excess: float) -> str:
        return self.arm.unreachable("point", failure, excess)


@dataclass(frozen=True)
class Wrist:
    """Rows 4 to 6, three axes that meet: Rot_z(u4) Rot_y(u5) Rot_z(u6) between constants.

    Source: spherical wrist of the MECA 953 slides. With alpha_4, alpha_5 = +-90 degrees,
    Rot_x(alpha_4) Rot_z(theta_5) Rot_x(-alpha_4) is a turn about y, so u4 = theta_4,
    u5 = -s4 theta_5, u6 = -s4 s5 theta_6 (s the sines), and a half turn about x remains
    behind when s4 = s5.

    Attributes
    ----------
    cos_alpha, sin_alpha : float
        Of alpha_3, from the forearm to axis 4.
    signs : pair of +1 or -1
        Of u5, u6 in theta_5 and theta_6.
    to_hand : (4, 4) array
        Constant, from the tool to the frame at the wrist centre.
    joints : JointMap
        Of the whole robot.
    first : int
        Index of theta_4.
    """

    cos_alpha: float
    sin_alpha: float
    signs: tuple[float, float]
    to_hand: np.ndarray
    joints: JointMap
    first: int

    @classmethod
    def of(cls, chain: Chain, first: int) -> Wrist:
        """From a chain whose rows first, first+1, first+2 (counted from 0) are the last that move: see `demand_wrist`."""
        i, j, k = first, first + 1, first + 2
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

    def solve(
        self, x: Sequence[np.ndarray], y: Sequence[np.ndarray], z: Sequence[np.ndarray], near: np.ndarray | None
    ) -> tuple[list[tuple[np.ndarray, np.ndarray]], np.ndarray]:
        """Joint values of both wrist branches.

        Parameters
        ----------
        x, y, z : sequences of three (...) arrays
            Rows (s, n, a) of the hand's rotation seen from the forearm frame, before alpha_3.
        near : (n, N) array, or None
            Joint values to keep where they are free, radians.

        Returns
        -------
        list of three pairs of (...) arrays
            Joint values, radians; branch 0 has the middle joint in [0, pi] (if its offset is a multiple of pi).
        (...) uint8 array
            `Flag` bits.
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
        flags = np.where(aligned, np.where(m33 < 0, Flag.FREE_LINE | Flag.FOLDED_LINE, Flag.FREE_LINE), 0)
        both = [
            (self._joint(i, sign * first), self._joint(i, sign * second))
            for i, sign, first, second in (
                (0, 1.0, u4, u4 + np.pi),
                (1, self.signs[0], u5, -u5),
                (2, self.signs[1], u6, u6 + np.pi),
            )
        ]
        return both, flags.astype(np.uint8)

    def _joint(self, index: int, row: float | np.ndarray) -> np.ndarray:
        return self.joints.joint(self.first + index, row)

    @property
    def line(self) -> tuple[int, int, int, int]:
        """Joints of axes 4 and 6 and the sign of the defined sum, plain and folded.

        u4 + u6 is defined at u5 = 0, u4 - u6 at u5 = pi.
        """
        i, j = self.first, self.first + 2
        sign = int(self.joints.sign[i] * self.joints.sign[j] * self.signs[1])
        return i, j, sign, -sign

    def label(self, flipped: int, flags: int) -> str:
        """The wrist branch in words; straight when axis 6 points along axis 4."""
        if flags & Flag.FREE_LINE:
            opposite = bool(flags & Flag.FOLDED_LINE) != (self.signs[1] < 0)
            return "wrist folded" if opposite else "wrist straight"
        return "wrist flipped" if flipped else "wrist unflipped"


def demand_wrist(chain: Chain, first: int) -> None:
    """Raises ValueError unless rows first, first+1, first+2 (counted from 0) of a table are a spherical wrist."""
    i, j, k = first, first + 1, first + 2
    demand_kinds(chain, [0, 0, 0], first)
    for row in (j, k):
        demand_square(chain, row)
    for letter, length in ((f"a_{j}", chain.a[j]), (f"a_{k}", chain.a[k]), (f"d_{k}", chain.fixed[j])):
        if length:
            raise ValueError(f"axes {i + 1}, {j + 1} and {k + 1} do not meet in one point: {letter} = {length:.6g} m")


class WristedArm(InverseModel):
    """An elbow arm with a spherical wrist: six revolute joints, at most 8 solutions.

    Branches in order: shoulder left, right; within each the elbow bend in [0, pi], then in
    [-pi, 0] (see ElbowArm); within each the wrist with q5 in [0, pi], then flipped.
    Where axes 4 and 6 are aligned the two wrist branches are one family, kept as the first.
    """

    expected_joints = 6
    branch_count = 8
    revolute = (0, 1, 2, 3, 4, 5)

    def __init__(self, table: DHTable) -> None:
        super().__init__(table)
        self.anchors = {Flag.FREE_FIRST: (0,), Flag.FREE_PLANE: (1,)}
        chain = self.chain
        self.map = JointMap.of(chain)
        demand_elbow(table.chain)
        demand_wrist(table.chain, first=3)
        self.arm = ArmGeometry.of(chain, chain.row_matrix(3, 0.0)[:3, 3])
        self.wrist = Wrist.of(chain, first=3)
        self.line = self.wrist.line
        demand_length(self.arm.upper, "the upper arm", "a_2")
        demand_length(abs(self.arm.fore), "the forearm", "the wrist centre's distance from axis 3")

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        # Two products of all poses at once; so many small ones would take as long as the rest.
        moved = (poses.reshape(-1, 4) @ self.wrist.to_hand).reshape(-1, 4, 4)
        hand = self.arm.to_arm[:3] @ moved.transpose(1, 2, 0).reshape(4, -1)
        s, n, a, centre = hand.reshape(3, 4, -1).swapaxes(0, 1)
        arm = self.arm.postures(centre, [self.map.row(i, near) for i in (0, 1)], tol)
        # The hand's axes seen from frame 1, then from frame 3.
        back1, back3 = np.conj(arm.first_phasor), np.conj(arm.fore_phasor)
        side = self.arm.side
        x, y, z = [], [], []
        for axis in (s, n, a):
            flat = (axis[0] + 1j * axis[1]) * back1
            plane = (flat.real + 1j * (side * axis[2]))[:, None] * back3
            x.append(plane.real)
            y.append(plane.imag)
            z.append((-side * flat.imag)[:, None])
        (q4, q5, q6), wrist_flags = self.wrist.solve(x, y, z, near)
        q = np.empty((6, 2, 2, 2, len(poses)))
        q[0] = self.map.joint(0, arm.first)[:, None, None]
        q[1] = self.map.joint(1, arm.second)[:, :, None]
        q[2] = self.map.joint(2, arm.third)[:, :, None]
        for i, both in enumerate((q4, q5, q6)):
            q[3 + i, :, :, 0], q[3 + i, :, :, 1] = both
        valid = np.repeat(arm.valid[:, :, None], 2, axis=2)
        valid[:, :, 1] &= wrist_flags == 0
        flags = np.repeat((arm.flags | wrist_flags)[:, :, None], 2, axis=2)
        return Branches(q.reshape(6, 8, -1), valid.reshape(8, -1), flags.reshape(8, -1), arm.excess, arm.failure)

    def _slide_towards(self, batch: Batch, near: np.ndarray) -> None:
        super()._slide_towards(batch, near)
        nearly_aligned.slide(self, batch, near)

    def label(self, branch: int, flags: int) -> str:
        return f"{self.arm.label(branch // 2, flags)}, {self.wrist.label(branch % 2, flags)}"

    def unreachable(self, failure: Failure, excess: float) -> str:
        return self.arm.unreachable("wrist centre", failure, excess)


class WristAlone(InverseModel):
    """A spherical wrist on a fixed forearm: any orientation, about one fixed centre.

    Branches in order: middle joint in [0, pi], then flipped. At most 2 solutions. The
    position of a pose must be the one that its orientation implies.
    """

    expected_joints = 3
    branch_count = 2
    revolute = (0, 1, 2)

    def __init__(self, table: DHTable) -> None:
        super().__init__(table)
        self.anchors = {}
        chain = self.chain
        demand_wrist(table.chain, first=0)
        self.wrist = Wrist.of(chain, first=0)
        self.line = self.wrist.line
        first = chain.row_matrix(0, 0.0)
        self._to_centre = chain.base.copy()
        self._to_centre[:3, 3] += chain.base[:3, :3] @ first[:3, 3]
        self._to_centre = np.linalg.inv(self._to_centre)

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        hand = self._to_centre @ poses @ self.wrist.to_hand
        x, y, z = np.ascontiguousarray(hand[:, :3, :3].transpose(1, 2, 0))
        both, flags = self.wrist.solve(x, y, z, near)
        excess = np.sqrt((hand[:, :3, 3] ** 2).sum(axis=1))
        valid = np.repeat((excess <= tol)[None], 2, axis=0)
        failure = np.where(valid[0], Failure.NONE, Failure.OFF)
        excess = np.where(valid[0], 0.0, excess)
        valid[1] &= flags == 0
        return Branches(np.array(both), valid, np.stack([flags, flags]), excess, failure)

    def label(self, branch: int, flags: int) -> str:
        return self.wrist.label(branch, flags)

    def unreachable(self, failure: Failure, excess: float) -> str:
        return f"the wrist centre is {excess:.3g} m away from where the three axes meet"
