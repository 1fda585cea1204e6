"""Orientation triples: three angles of a set that the question names, equal when they give the same rotation."""

from __future__ import annotations

import numpy as np

from dhkit.forms.orientation import Orientation
from dhkit.geometry import rotation_angle_between
from dhm.orientation import euler_matrix

from .base import Comparison, Setting
from .entries import Entries
from .entries import read_entries as read

__all__ = ["compare", "read"]


def compare(form: Orientation, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Compared in SO(3): both triples of a rotation are right, and at gimbal lock every one of the family is.

    The tolerance is in radians.
    """
    theirs, ours = (entries.values(setting.samples) for entries in (student, other))
    if not np.isfinite(theirs).all() or np.abs(theirs.imag).max() > 1e-9:
        return Comparison(False, 0.0, ("the angles are not real numbers everywhere",))
    unit = 2 * np.pi / setting.turn
    rotations = [
        euler_matrix(values.real * unit, form.axes, intrinsic=form.frames != "fixed") for values in (theirs, ours)
    ]
    error = float(np.max(rotation_angle_between(*rotations)))
    if error <= max(setting.tolerance, 1e-7) + np.sum(setting.slack):
        return Comparison(True, 1.0)
    where = " at the values tried" if form.symbols else ""
    return Comparison(False, 0.0, (f"the rotation is off by up to {np.degrees(error):.3g} deg{where}",))
