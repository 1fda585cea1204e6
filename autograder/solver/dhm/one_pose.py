"""All postures of one pose, with Python's own numbers: arrays cost more than they hold where there is one pose only.

The formulas are those of `elbow`, which has them for many poses; here without what is special. A pose that is special
(stretched, on an axis, wrist aligned, not quite rigid) is left to them.
"""

from __future__ import annotations

from cmath import phase, rect
from math import atan2, hypot, pi, remainder, sin, sqrt

import numpy as np

from .elbow import WristedArm
from .geometry import COINCIDENT, SAME_LENGTH

_ALIGNED = 1e-9
_RIGID = 1e-9  # a pose that is less rigid is looked at by `rigid.rigid`
_BESIDE = 1e-9  # metres within which a limit of the workspace is special


class OnePose:
    """The inverse model of an elbow arm with a spherical wrist, for one pose at a time."""

    def __init__(self, model: WristedArm) -> None:
        arm, wrist, joints = model.arm, model.wrist, model.map
        self._to_arm = arm.to_arm[:3].tolist()
        self._to_hand = wrist.to_hand[:3].tolist()
        self._side, self._out, self._offset, self._size = arm.side, float(arm.out), float(arm.offset), float(arm.size)
        self._upper, self._reach = float(arm.upper), abs(arm.fore)
        self._bend = phase(arm.fore)
        self._back = rect(1.0, -self._bend)
        self._twist = float(wrist.cos_alpha), float(wrist.sin_alpha)
        self._signs = wrist.signs
        self._maps = [(float(sign), float(offset)) for sign, offset in zip(joints.sign, joints.offset)]
        sign, offset = self._maps[4]
        self._lead = -1.0 if sin(sign * (self._signs[0] * pi / 2 - offset)) < -_ALIGNED else 1.0

    def __call__(self, T: np.ndarray) -> list[list[float]] | None:
        """The postures of a pose (4, 4) in the order of `InverseModel.solve`, radians; None for a special pose."""
        hand = self._hand(T.tolist())
        if hand is None:
            return None
        (sx, nx, ax, px), (sy, ny, ay, py), (sz, nz, az, pz) = hand
        radius = hypot(px, py)
        if radius <= COINCIDENT * self._size or abs(radius - abs(self._offset)) <= _BESIDE + SAME_LENGTH * self._size:
            return None
        if radius < abs(self._offset):
            return []
        along = sqrt((radius - abs(self._offset)) * (radius + abs(self._offset)))
        upper, fore, side = self._upper, self._reach, self._side
        total, gap = upper + fore, abs(upper - fore)
        close = _BESIDE + SAME_LENGTH * total
        columns = (complex(sx, sy), sz), (complex(nx, ny), nz), (complex(ax, ay), az)
        postures: list[list[float]] = []
        for ahead in (along, -along):
            towards = complex(px, py) * complex(ahead, -self._offset) / (radius * radius)
            tip = complex(ahead - self._out, side * pz)
            distance = abs(tip)
            beyond, short = distance - total, gap - distance
            if abs(beyond) <= close or abs(short) <= close:
                return None
            if beyond > 0 or short > 0:
                continue
            outer, inner = -beyond * (total + distance), -short * (gap + distance)
            bend = 2 * atan2(sqrt(outer), sqrt(inner))
            cosine, sine = (inner - outer) / (inner + outer), 2 * sqrt(inner * outer) / (inner + outer)
            first = self._joint(0, phase(towards))
            back = towards.conjugate()
            flat = [(xy * back, side * z) for xy, z in columns]
            for sense in (1.0, -1.0):
                bent = complex(cosine, sense * sine)
                turn = tip * (upper + fore * bent).conjugate() / (distance * distance)
                arm = [first, self._joint(1, phase(turn)), self._joint(2, sense * bend - self._bend)]
                unturned = (turn * bent * self._back).conjugate()
                wrists = self._wrist([(complex(f.real, z) * unturned, -side * f.imag) for f, z in flat])
                if wrists is None:
                    return None
                postures += [arm + wrists[0], arm + wrists[1]]
        return postures

    def _hand(self, T: list[list[float]]) -> list[list[float]] | None:
        """The hand's frame at the wrist centre, seen by the arm, as three rows; None for what is no rigid transform."""
        (a, b, c, x), (d, e, f, y), (g, h, i, z), last = T
        off = (
            abs(a * a + d * d + g * g - 1) + abs(b * b + e * e + h * h - 1) + abs(a * b + d * e + g * h)
            + abs(d * h - g * e - c) + abs(g * b - a * h - f) + abs(a * e - d * b - i)
        )  # fmt: skip
        if not off <= _RIGID or last != [0.0, 0.0, 0.0, 1.0] or not abs(x) + abs(y) + abs(z) < 1e100:
            return None
        rows = []
        (h00, h01, h02, h03), (h10, h11, h12, h13), (h20, h21, h22, h23) = self._to_hand
        for p, q, r, s in self._to_arm:
            u, v, w = p * a + q * d + r * g, p * b + q * e + r * h, p * c + q * f + r * i
            rows.append(
                [
                    u * h00 + v * h10 + w * h20,
                    u * h01 + v * h11 + w * h21,
                    u * h02 + v * h12 + w * h22,
                    u * h03 + v * h13 + w * h23 + p * x + q * y + r * z + s,
                ]
            )
        return rows

    def _wrist(self, columns: list[tuple[complex, float]]) -> tuple[list[float], list[float]] | None:
        """Both triples of the wrist for the hand's axes seen from the forearm; None where outer axes are aligned."""
        ca, sa = self._twist
        (p1, z1), (p2, z2), (p3, z3) = columns
        m13, m23, m33 = p3.real, ca * p3.imag + sa * z3, ca * z3 - sa * p3.imag
        sine = hypot(m13, m23)
        if sine <= _ALIGNED:
            return None
        c4, s4 = m13 / (self._lead * sine), m23 / (self._lead * sine)
        u4, u5 = atan2(s4, c4), atan2(c4 * m13 + s4 * m23, m33)
        u6 = atan2(
            c4 * (ca * p1.imag + sa * z1) - s4 * p1.real,
            c4 * (ca * p2.imag + sa * z2) - s4 * p2.real,
        )
        fifth, sixth = self._signs
        joint = self._joint
        return (
            [joint(3, u4), joint(4, fifth * u5), joint(5, sixth * u6)],
            [joint(3, u4 + pi), joint(4, -fifth * u5), joint(5, sixth * (u6 + pi))],
        )

    def _joint(self, index: int, row: float) -> float:
        sign, offset = self._maps[index]
        angle = remainder(sign * (row - offset), 2 * pi)
        return angle if angle > -pi + 6e-13 else pi
