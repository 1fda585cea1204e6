"""The pen robot as printed: three joints of which only two act, on a surface of points.

Axes 2 and 3 of its table are one line (a_2 = alpha_2 = 0), so the pen tip
``P0 = Rot_z(theta1) [L1 + p1 sin(phi), H, h1 + p1 cos(phi)]`` depends on theta1 and on
phi = theta2 + theta3 only (H = h2 + L2). The equations are not linear, as the text says, and
they have a solution only on a surface, a family of postures each time.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .elbow import ArmGeometry, demand_elbow
from .geometry import wrap
from .inverse import Branches, InverseModel, JointMap, translations
from .status import Failure, Flag
from .tables import DHTable


class PenArm(InverseModel):
    """Inverse model of the printed pen robot: points (x, y, z) of its surface.

    Branches in order: pen circle out in front (rho >= 0), then behind (rho <= 0), where rho
    is the distance of the tip from axis 1 along the arm. Each solution is a family: only
    q2 + q3 is defined. It also serves the readings of the text's remark, where joint 2 is
    driven by theta2 - theta1.
    """

    task = "x, y, z"
    expected_joints = 3
    branch_count = 2
    revolute = (0, 1, 2)

    def __init__(self, table: DHTable) -> None:
        super().__init__(table)
        self.anchors = {Flag.FREE_FIRST: (0,), Flag.FREE_PLANE: (1, 2)}
        chain = self.chain
        demand_elbow(table.chain)
        self.arm = ArmGeometry.of(chain, chain.tail(2)[:3, 3])
        if self.arm.upper:
            raise ValueError(f"axes 2 and 3 are not one line: a_2 = {table.chain.a[2]:.6g} m")
        # Row 2 may follow joint 1 too, which leaves the other rows one joint each.
        self._from_first = chain.coupling[1, 0]
        follows = np.zeros_like(chain.coupling)
        follows[1, 0] = self._from_first
        self.map = JointMap.of(replace(chain, coupling=chain.coupling - follows))
        same = int(self.map.sign[1] * self.map.sign[2])
        self.line = (1, 2, same, same)

    def pose(self, task: np.ndarray) -> np.ndarray:
        return translations(task)

    def closed_form(self, poses: np.ndarray, near: np.ndarray | None, tol: float) -> Branches:
        point = self.arm.to_arm[:3] @ poses[:, :, 3].T
        branches, tip = self.arm.in_plane(point, self.map.row(0, near), tol)
        pen = abs(self.arm.fore)
        off = np.abs(np.abs(tip) - pen)
        valid = branches.valid & (off <= tol)
        q = np.zeros((3, 2, len(poses)))
        q[0] = self.map.joint(0, np.angle(branches.phasor))
        both = np.angle(tip) - np.angle(self.arm.fore)
        if near is not None:
            q[1] = near[1]
        if pen:
            q[2] = self.map.joint(2, both - self._from_first * q[0] - self.map.row(1, q))
            flags = branches.flags | Flag.FREE_LINE
        else:
            q[2] = 0.0 if near is None else near[2]
            flags = branches.flags | Flag.FREE_PLANE
        inside = ~branches.valid[0] & (branches.inside >= off.min(axis=0))
        reached = valid.any(axis=0)
        return Branches(
            q,
            valid,
            np.stack([flags, flags]).astype(np.uint8),
            np.where(reached, 0.0, np.where(inside, branches.inside, off.min(axis=0))),
            np.where(reached, Failure.NONE, np.where(inside, Failure.INSIDE, Failure.OFF)),
        )

    def label(self, branch: int, flags: int) -> str:
        if flags & Flag.FREE_FIRST:
            return "tip on axis 1"
        if flags & Flag.SIDEWAYS:
            return "tip beside axis 1"
        return "tip behind" if branch else "tip in front"

    def unreachable(self, failure: Failure, excess: float) -> str:
        if failure == Failure.INSIDE:
            return self.arm.unreachable("tip", failure, excess)
        return f"the point is {excess:.3g} m off the surface that the pen tip can reach"

    def effective(self, point, tol: float = 1e-9) -> list[tuple[float, float]]:
        """All (theta1, theta2 + theta3) that reach a point (3,), radians, in branch order."""
        q = self.solve(point, tol=tol).q
        return [(float(row[0]), float(wrap(row[1] + row[2]))) for row in q]

    def circles(self, z: float) -> tuple[float, ...]:
        """Radii of the circles the tip can draw on the horizontal sheet at height z, metres.

        Two in general, with the same radius when they coincide only once; none beyond the
        pen's length above or below axis 2.
        """
        height = self.arm.side * (self.arm.to_arm[2, 3] + z)
        pen = abs(self.arm.fore)
        if abs(height) > pen:
            return ()
        reach = np.sqrt(pen**2 - height**2)
        radii = {float(np.hypot(self.arm.offset, self.arm.out + s * reach)) for s in (1, -1)}
        return tuple(sorted(radii, reverse=True))
