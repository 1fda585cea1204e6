"""The body of a serial robot: where its joints, links and hand are drawn.

Link i runs from O_i along the common normal to axis i + 1, then along that axis; the joints sit on the way, where a
robot would have them.
"""

from __future__ import annotations

import itertools

import numpy as np

from ..geometry import chain_products, modified_dh
from .bodies import HAND, JOINT, LINK, Bodies


class Robot:
    """Joints, links and hand of a robot, laid out for drawing.

    Parameters
    ----------
    table : ndarray, shape (n, 5)
        Rows [sigma, a, alpha, d, theta] in metres and radians.
    tool : bool
        The last row is the constant displacement to the tool, not a joint.

    Attributes
    ----------
    joints : range
        Numbers of the joints, from 1.
    frames : ndarray, shape (n + 1, 4, 4)
        Frames 0 to n seen from the base; `origins` and `z` are their origins and Z axes, shape (n + 1, 3).
    feet : ndarray, shape (n, 3), in metres
        Where each common normal ends on the axis of joint i + 1.
    centres : dict of ndarray, shape (3,), in metres
        Where the body of each joint is drawn.
    hand : ndarray, shape (3,), or None
        Direction in which the hand points; None where the table does not tell of a hand.
    unit : float, in metres
        Sum of all lengths: the size of the robot.
    """

    def __init__(self, table, tool):
        self.table, self.tool = table, tool
        self.frames = chain_products(modified_dh(*table.T[1:]))
        self.origins, self.z = self.frames[:, :3, 3], self.frames[:, :3, 2]
        self.feet = self.origins[:-1] + table[:, 1:2] * self.frames[:-1, :3, 0]
        self.joints = range(1, len(table) + (0 if tool else 1))
        length = np.abs(table[:, [1, 3]]).sum()
        self.unit = length if length > 0 else 1.0
        self._radius = 0.024 * self.unit
        self._half = 2.0 * self._radius
        reach = np.abs(table[-1, [1, 3]]).sum() if tool else 0.0
        # Of hand and last joint: they share the tool's length.
        self._scale = min(1.0, reach / (7 * self._radius)) if reach > 0 else 1.0
        self.centres = {i: self._centre(i) for i in self.joints}
        self.hand = self._hand()
        self._part_joints()

    def _centre(self, i):
        """Middle of joint i: of the walk d_i, or the guide at its beginning; O_i where d_i is short."""
        foot, origin = self.feet[i - 1], self.origins[i]
        walk = np.linalg.norm(origin - foot)
        if self.table[i - 1, 0] == 1:
            return foot if walk > self._half else origin
        return (foot + origin) / 2 if walk > 3.2 * self._half else origin.copy()

    def _part_joints(self):
        """Move joints that lie on one another apart, along their own axes."""
        last = len(self.joints)
        for i in self.joints:
            if i == last or np.linalg.norm(self.centres[i] - self.centres[i + 1]) > 1.6 * self._half:
                continue
            same_axis = np.linalg.norm(np.cross(self.z[i], self.z[i + 1])) < 1e-6 and self.table[i, 1] == 0
            if i + 1 == last and (i > 1 or same_axis):
                self.centres[last] = (
                    self.origins[last] + self._side_of_last_joint() * self._room_for_last_joint() * self.z[last]
                )
            else:
                self.centres[i] = self.centres[i] - 2.6 * self._half * self.z[i]

    def _side_of_last_joint(self):
        """On which side of its origin, along its axis, the last joint stands: where the hand or a straight tool is."""
        bent = self.tool and (self.table[-1, 1] != 0 or abs(np.sin(self.table[-1, 2])) > 1e-9)
        along = 0 if bent or self.hand is None else self.hand @ self.z[len(self.joints)]
        return -1 if along < 0 else 1

    def _room_for_last_joint(self):
        """How far the last joint may stand before the one it meets: within the tool, if that is short."""
        room = 2.2 * self._half
        return max(0.8 * self._half, room * self._scale) if self.tool and self.table[-1, 3] else room

    def _hand(self):
        n = len(self.table)
        if self.tool:
            a, d = self.table[-1, 1], self.table[-1, 3]
            if abs(d) > 1e-9:
                return np.sign(d) * self.z[n]
            return np.sign(a) * self.frames[n - 1, :3, 0] if abs(a) > 1e-9 else self.z[n]
        if n < 2 or self.table[-1, 1] != 0:
            return None
        if abs(np.sin(self.table[-1, 2])) < 1e-9:
            walks = self.origins[1:] - self.feet
            k = np.flatnonzero(np.linalg.norm(walks, axis=1) > 1e-9)
            along = walks[k[-1]] @ self.z[n] if len(k) else 0.0
            return np.sign(along) * self.z[n] if abs(along) > 1e-9 else self.z[n]
        return self.z[n]

    def build(self, bodies: Bodies):
        """Add base, links, joints and hand to `bodies`."""
        self._build_base(bodies)
        self._build_links(bodies)
        for i in self.joints:
            if self.table[i - 1, 0] == 1:
                self._build_guide(bodies, i)
            else:
                reach = (self._half if i < len(self.joints) else self._half * max(self._scale, 0.4)) * self.z[i]
                bodies.add_tube(self.centres[i] - reach, self.centres[i] + reach, 1.75 * self._radius, JOINT, caps=True)
        if self.hand is not None:
            self._build_jaws(bodies)

    def _build_base(self, bodies):
        """A column and a plate under joint 1."""
        z0 = self.z[0]
        first = (self.centres.get(1, self.origins[0]) - self.origins[0]) @ z0
        lowest = min(first, 0.0, (self.feet[0] - self.origins[0]) @ z0)
        drop = lowest - (0 if first > 2 * self._half else 2.1 * self._half)
        foot = self.origins[0] + drop * z0
        plate = foot + 0.5 * self._radius * z0
        bodies.add_tube(foot, plate, 4.2 * self._radius, 0.92 * LINK, caps=True)
        if drop < 0:
            bodies.add_tube(plate, self.origins[0], 1.2 * self._radius, LINK)

    def _build_links(self, bodies):
        r, n = self._radius, len(self.table)
        stops = {0: self.origins[0]} | self.centres
        for i in range(n):
            ends = [stops[i], self.origins[i], self.feet[i]]
            if i + 1 in self.centres:
                ends.append(stops[i + 1])
            else:
                ends.append(self.origins[i + 1] - (0 if self.hand is None else 2.4 * r) * self.hand)
            thin = i > 0 and self.table[i - 1, 0] == 1
            _add_path(bodies, ends, r, first=0.62 * r if thin else r)
        if not self.tool and len(self.joints):
            _add_path(bodies, [self.centres[n], self.origins[n]], 0.62 * r if self.table[-1, 0] == 1 else r)

    def _build_guide(self, bodies, i):
        """The guide of prismatic joint i and the rod that sticks out of it."""
        # The guide stands still while joint i moves: its edges are those of the frame before.
        r, along, side = self._radius, self.z[i], self.frames[i - 1, :3, 0]
        axes = np.column_stack([side, np.cross(along, side), along])
        bodies.add_box(self.centres[i], axes, (1.75 * r, 1.75 * r, 1.1 * self._half), JOINT)
        over = self.feet[i - 1] - self.origins[i]
        far = np.linalg.norm(over)
        over = over / far if far > 1e-9 else along
        bodies.add_tube(self.centres[i], self.centres[i] + 2.2 * self._half * over, 0.62 * r, LINK, caps=True)

    def _build_jaws(self, bodies):
        """Two fingers that slide along Y of the last frame, O of that frame between their tips."""
        n, r = len(self.table), self._radius * max(self._scale, 0.5)
        tip, side = self.origins[n], self.frames[n, :3, 1]
        palm = tip - 2.4 * r * self.hand
        if not self.tool:
            past = max((self.centres[n] - self.origins[n]) @ self.hand, 0) + self._half
            palm = tip + (past + 1.6 * r) * self.hand
            bodies.add_tube(tip, palm, 0.8 * r, HAND)
        axes = np.column_stack([self.hand, side, np.cross(self.hand, side)])
        bodies.add_box(palm, axes, (0.55 * r, 2.3 * r, 0.8 * r), HAND, cells=2)
        for way in (-1, 1):
            finger = palm + 1.9 * r * self.hand + way * 1.9 * r * side
            bodies.add_box(finger, axes, (1.5 * r, 0.42 * r, 0.7 * r), HAND, cells=2)


def _add_path(bodies, points, radius, first=None):
    """Tubes from point to point, the first of them thinner where `first` says so, with balls at the bends."""
    width = first or radius
    for start, end in itertools.pairwise(points):
        if np.linalg.norm(end - start) > 1e-9:
            bodies.add_tube(start, end, width, LINK)
        width = radius
    for point in points[1:-1]:
        bodies.add_ball(point, radius, LINK)
