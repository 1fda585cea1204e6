"""The pen robot as printed: three joints of which only two act, on a surface of points.

Axes 2 and 3 of its table are one line (a_2 = alpha_2 = 0), so the pen tip
``P0 = Rot_z(theta1) [L1 + p1 sin(phi), H, h1 + p1 cos(phi)]`` depends on theta1 and on
phi = theta2 + theta3 only (H = h2 + L2). The equations are not linear, as the text says, and
they have a solution only on a surface, a family of postures each time.
"""

from __future__ import annotations

import numpy as np

from dhkit.geometry import wrap

from .elbow import ArmGeometry
from .inverse import Answer, InverseModel, outside_limits, translations
from .marks import FREE_FIRST, FREE_LINE, FREE_PLANE, SIDEWAYS
from .solutions import INSIDE, LIMITED, NOTHING, OFF
from .tables import DHTable


class PenArm(InverseModel):
    """Inverse model of the printed pen robot: points (x, y, z) of its surface.

    Branches in order: pen circle out in front (rho >= 0), then behind (rho <= 0), where rho
    is the distance of the tip from axis 1 along the arm. Each solution is a family: only
    q2 + q3 is defined. It also serves the readings of the text's remark, where joint 2 is
    driven by theta2 - theta1.
    """

    task = "x, y, z"
    joints = 3
    branches = 2
    revolute = [0, 1, 2]
    anchors = {FREE_FIRST: (0,), FREE_PLANE: (1, 2)}
    line = (1, 2, 1, 1)

    def __init__(self, table: DHTable):
        super().__init__(table)
        chain = table.chain
        self.arm = ArmGeometry.of(table, chain.tail(2)[:3, 3])
        drives = chain.coupling[:3]
        expected = [[1, 0, 0], [drives[1, 0], 1, 0], [0, 0, 1]]
        if self.arm.upper or not np.array_equal(drives, expected):
            raise ValueError("the pen robot has axes 2 and 3 on one line, driven by q2 and q3")
        self._table = table
        self._offset = chain.offset[:3]
        self._from_first = drives[1, 0]

    def pose(self, task):
        return translations(task)

    def kernel(self, poses, near, tol):
        point = self.arm.to_arm[:3] @ poses[:, :, 3].T
        anchor = self._offset[0] + (0.0 if near is None else near[0])
        branches, tip = self.arm.in_plane(point, anchor, tol)
        pen = abs(self.arm.fore)
        off = np.abs(np.abs(tip) - pen)
        valid = branches.valid & (off <= tol)
        q = np.zeros((3, 2, len(poses)))
        q[0] = np.angle(branches.turn) - self._offset[0]
        both = np.angle(tip) - np.angle(self.arm.fore) - self._offset[1:].sum()
        both = both - self._from_first * q[0]
        if near is not None:
            q[1] = near[1]
        if pen:
            q[2] = both - q[1]
            marks = branches.marks | FREE_LINE
        else:
            q[2] = 0.0 if near is None else near[2]
            marks = branches.marks | FREE_PLANE
        inside = ~branches.valid[0]
        reached = valid.any(axis=0)
        return Answer(
            q,
            valid,
            np.stack([marks, marks]).astype(np.uint8),
            np.where(reached, 0.0, np.where(inside, branches.inside, off.min(axis=0))),
            np.where(reached, NOTHING, np.where(inside, INSIDE, OFF)),
        )

    def label(self, branch, marks):
        if marks & FREE_FIRST:
            return "tip on axis 1"
        if marks & SIDEWAYS:
            return "tip beside axis 1"
        return "tip behind" if branch else "tip in front"

    def unreachable(self, cause, miss):
        if cause == LIMITED:
            return outside_limits(miss)
        if cause == INSIDE:
            return self.arm.unreachable("tip", cause, miss)
        return f"the point is {miss:.3g} m off the surface that the pen tip can reach"

    def effective(self, point, tol: float = 1e-9) -> list[tuple[float, float]]:
        """All (theta1, theta2 + theta3) that reach a point (3,), radians, in branch order."""
        q = self.solve(point, tol=tol).q
        return [(float(row[0]), float(wrap(row[1] + row[2]))) for row in q]

    def effective_for_pose(self, T, tol: float = 1e-9) -> tuple[float, float] | None:
        """(theta1, theta2 + theta3) for a full pose (4, 4) of the pen, or None.

        A pose fixes both at once, and is possible only if its z axis is horizontal, its
        origin on the surface and its other axes agree; theta2 and theta3 stay inseparable.
        """
        T = np.asarray(T, dtype=float)
        turn = self.arm.to_arm[:3, :3] @ T[:3, :3] @ self._table.chain.tail(2)[:3, :3].T
        side = self.arm.side
        first = np.arctan2(side * turn[0, 2], -side * turn[1, 2]) - self._offset[0]
        both = np.arctan2(side * turn[2, 0], side * turn[2, 1]) - self._offset[1:].sum()
        both = both - self._from_first * first
        if np.abs(self._table.forward([first, 0.0, both]) - T).max() > tol:
            return None
        return float(wrap(first)), float(wrap(both))

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

    @property
    def radii(self) -> tuple[float, float]:
        """Smallest and largest distance of the tip from axis 1, metres."""
        pen, out = abs(self.arm.fore), abs(self.arm.out)
        return (
            float(np.hypot(self.arm.offset, max(out - pen, 0.0))),
            float(np.hypot(self.arm.offset, out + pen)),
        )
