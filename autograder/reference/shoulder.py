"""Closed form of the shoulder of an elbow arm: axis 1 and the plane of the arm that stands beside it.

Points seen along axis 1 are complex numbers x + iy, so that a rotation is a product. Free of NaN and of warnings: the
limits are clipped, never tested by an exception. Source: "Trouvez q1" of the EPFL slides.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dhkit.geometry import COINCIDENT, SAME_LENGTH, phasor

from .marks import FREE_FIRST, SIDEWAYS


class Shoulder(NamedTuple):
    """Directions of an arm plane that stands beside axis 1; the leading axis is the branch.

    turn: e^{i t1}, shape (2, N). radius: signed distance of the target along the plane,
    metres, (2, N): branch 0 >= 0, branch 1 <= 0. valid: (2, N). marks: bits (N,). inside:
    metres by which the target is too near to axis 1, (N,).
    """

    turn: np.ndarray
    radius: np.ndarray
    valid: np.ndarray
    marks: np.ndarray
    inside: np.ndarray


def shoulder(xy, offset: float, size: float, anchor, tol: float) -> Shoulder:
    """All t1 and radius with e^{i t1} (radius + i offset) = xy.

    xy: complex targets seen along axis 1, metres, (N,). offset: lateral distance of the arm
    plane from axis 1, metres. size: of the whole arm, for tolerances. anchor: t1 to report
    where it is free (target on axis 1 and no offset). tol: as in two_link.
    """
    r = np.abs(xy)
    inside = abs(offset) - r
    free = (r <= COINCIDENT * size) & (abs(offset) <= SAME_LENGTH * size)
    at_limit = free | (inside >= -SAME_LENGTH * size)
    radius = np.empty((2, r.size))
    np.sqrt(np.where(at_limit, 0.0, -inside * (abs(offset) + r)), out=radius[0])
    np.negative(radius[0], out=radius[1])
    turn = xy * (radius - 1j * offset)
    length = np.abs(turn)
    if free.any():
        turn = np.where(free, phasor(anchor), turn)
        length = np.where(free, 1.0, length)
    turn /= np.where(length > 0.0, length, 1.0)
    valid = np.repeat((inside <= tol)[None], 2, axis=0)
    valid[1] &= ~at_limit
    marks = np.where(free, FREE_FIRST, np.where(at_limit, SIDEWAYS, 0)).astype(np.uint8)
    return Shoulder(turn, radius, valid, marks, inside)
