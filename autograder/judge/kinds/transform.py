"""Homogeneous transforms."""

from __future__ import annotations

import numpy as np

from dhkit.forms.transform import Transform
from dhkit.geometry import rotation_angle_between

from .base import Comparison, Setting
from .entries import Entries, agreement, differing_cells
from .entries import read_entries as read

__all__ = ["compare", "read"]


def compare(form: Transform, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Block by block, rotation and position; errors in degrees and metres."""
    agree = agreement(student, other, setting, np.zeros(len(student.expressions))).reshape(form.shape)
    blocks = agree[:-1, :-1].all(), agree[:-1, -1].all()
    share = float(np.dot(blocks, (1 - setting.position_share, setting.position_share)))
    share = share if agree[-1].all() else share / 2
    if agree.all():
        return Comparison(True, 1.0)
    where = " at the values tried" if form.symbols else ""
    theirs, ours = (entries.values(setting.samples).reshape(-1, *form.shape) for entries in (student, other))
    remarks = list(differing_cells(agree))
    if not blocks[0]:
        remarks.append(_rotation_error(theirs[:, :-1, :-1], ours[:, :-1, :-1], where))
    if not blocks[1]:
        with np.errstate(all="ignore"):
            miss = np.linalg.norm(theirs[:, :-1, -1] - ours[:, :-1, -1], axis=1).max()
        remarks.append(
            f"the position is off by up to {miss:.3g} m{where}" if np.isfinite(miss) else "the position is not defined"
        )
    remarks += [f"the {name} is right" for name, right in zip(("rotation", "position"), blocks, strict=True) if right]
    if not agree[-1].all():
        remarks.append("the last row of a transform is 0 ... 0 1")
    return Comparison(False, share, tuple(remarks), slip=int((~agree).sum()) == 1)


def _rotation_error(theirs: np.ndarray, ours: np.ndarray, where: str) -> str:
    with np.errstate(all="ignore"):
        products = np.swapaxes(theirs, 1, 2) @ theirs
        lengths = np.abs(np.diagonal(products, axis1=1, axis2=2) - 1)
        mixed = np.abs(products - np.eye(theirs.shape[-1])).max()
        angle = rotation_angle_between(theirs.real, ours.real).max()
        left_handed = (np.linalg.det(theirs).real < 0).any()
    if not mixed < 1e-4:
        which = "not all of length 1" if not lengths.max() < 1e-4 else "not at right angles to each other"
        return f"its rotation block is no rotation: its columns are {which}"
    if left_handed:
        return "its rotation block is no rotation: its axes are left-handed"
    return f"the rotation is off by up to {np.degrees(angle):.3g} deg{where}"
