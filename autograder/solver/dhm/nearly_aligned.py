"""Wrists that are nearly aligned on arms that are nearly singular: rounding makes a line of what are isolated postures.

A stretched elbow, or a wrist centre beside axis 1, gives the forearm's turn to a millionth only, as the root of a length's
rounding. A wrist that is aligned to a millionth turns that into any angle of joint 4. All of these postures reach the pose
to the last digit, so that the wished joint values may choose among them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .geometry import wrap
from .settling import Task
from .solutions import Batch
from .status import Flag

if TYPE_CHECKING:
    from .elbow import WristedArm

_NEARLY = 1e-3  # sine of the angle between axes 4 and 6, under which rounding can move them visibly
_ALIGNED = 1e-9  # the same, under which it has no side
_EXACT = 1e-12  # of the arm's size, by which a pose may be missed that counts as reached to the last digit
_SAME = 1e-6  # radians between two postures that are one


def slide(model: WristedArm, batch: Batch, near: np.ndarray) -> None:
    """Move postures whose axes 4 and 6 are nearly aligned towards near (6, N), as far as they reach their poses as well."""
    bend = np.asarray(model.map.row(4, batch.q.transpose(2, 1, 0))).T
    side = np.sin(model.map.row(4, near))[:, None]
    chosen = (np.abs(side) <= _ALIGNED) | (np.sin(bend) * side > 0)  # the wrist branch of near's side, if it has one
    flat = (np.abs(np.sin(bend)) < _NEARLY) & ((batch.flags & Flag.FREE_LINE) == 0)
    pose, branch = np.nonzero(batch.valid & flat & chosen)
    if not len(pose):
        return
    q, wished, bend = batch.q[pose, branch], near[:, pose].T, bend[pose, branch]
    started = model.slid(q, wished, np.cos(bend) < 0)
    slid, error, _ = Task(model.chain, model.arm.size, 6).approached(started, model.chain.forward(q))
    slid = wrap(slid)
    moved, off, wrong = (np.abs(wrap(each)) for each in (slid - q, slid - wished, q - wished))
    taken = (error <= _EXACT * model.arm.size) & (off.max(axis=1) < wrong.max(axis=1))
    taken &= (moved[:, [0, 1, 2, 4]].max(axis=1) < _NEARLY) & (np.sin(bend) * np.sin(model.map.row(4, slid.T)) > 0)
    for i in np.flatnonzero(taken):  # one after the other, so that no two postures of a pose become one
        known = batch.q[pose[i], batch.valid[pose[i]]]
        if np.abs(wrap(known - slid[i])).max(axis=1).min() > _SAME:
            batch.q[pose[i], branch[i]] = slid[i]
