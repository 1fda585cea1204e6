"""Closed form of the shoulder of an elbow arm: axis 1 and the plane of the arm that stands beside it.

Points seen along axis 1 are complex numbers x + iy, so that a rotation is a product. Free of NaN and of warnings: the
limits are clipped, never tested by an exception. Source: "Trouvez q1" of the EPFL slides.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .geometry import COINCIDENT, SAME_LENGTH, phasor
from .status import Flag


class Shoulder(NamedTuple):
    """Directions of an arm plane that stands beside axis 1; the leading axis is the branch.

    Attributes
    ----------
    phasor : (2, N) complex array
        e^{i t1}.
    radius : (2, N) array
        Signed distance of the target along the plane, metres: branch 0 >= 0, branch 1 <= 0.
    valid : (2, N) bool array
    flags : (N,) uint8 array
        `Flag` bits.
    inside : (N,) array
        Metres by which the target is too near to axis 1.
    """

    phasor: np.ndarray
    radius: np.ndarray
    valid: np.ndarray
    flags: np.ndarray
    inside: np.ndarray


def shoulder(xy: np.ndarray, offset: float, size: float, anchor: ArrayLike, tol: float) -> Shoulder:
    """All t1 and radius with e^{i t1} (radius + i offset) = xy.

    Parameters
    ----------
    xy : (N,) complex array
        Targets seen along axis 1, metres.
    offset : float
        Lateral distance of the arm plane from axis 1, metres.
    size : float
        Of the whole arm, metres, for tolerances.
    anchor : array_like, broadcast to (N,)
        t1 to report where it is free (target on axis 1 and no offset), radians.
    tol : float
        Metres by which a target may miss the cylinder that the offset leaves out and still count as on it.
    """
    r = np.abs(xy)
    inside = abs(offset) - r
    free = (r <= COINCIDENT * size) & (abs(offset) <= SAME_LENGTH * size)
    at_limit = free | (inside >= -SAME_LENGTH * size)
    radius = np.empty((2, r.size))
    np.sqrt(np.where(at_limit, 0.0, -inside * (abs(offset) + r)), out=radius[0])
    np.negative(radius[0], out=radius[1])
    towards = xy * (radius - 1j * offset)
    length = np.abs(towards)
    if free.any():
        towards = np.where(free, phasor(anchor), towards)
        length = np.where(free, 1.0, length)
    towards /= np.where(length > 0.0, length, 1.0)
    valid = np.repeat((inside <= tol)[None], 2, axis=0)
    valid[1] &= ~at_limit
    flags = np.where(free, Flag.FREE_FIRST, np.where(at_limit, Flag.SIDEWAYS, 0)).astype(np.uint8)
    return Shoulder(towards, radius, valid, flags, inside)
