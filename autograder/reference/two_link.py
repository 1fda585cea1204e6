"""Closed forms shared by every inverse model: the two-link arm in its plane and the shoulder.

Points of a plane are complex numbers, so that a rotation is a product and the two-link arm
reads ``p = l1 e^{i t1} + l2 e^{i (t1 + t2)}``. Everything is vectorised, free of NaN and of
warnings: the limits are clipped, never tested by an exception.

Sources: "Trouvez q1" and the two-link arm of the EPFL slides, type-8 equation of the s600
tutorial, RX-90 of the MECA 953 slides.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

# What is special about a posture, as bits that can be combined.
FREE_FIRST = 1  # the target lies on axis 1: the first joint is free
FREE_PLANE = 2  # the target lies on the two-link arm's own first joint: that joint is free
FREE_LINE = 4  # two joints act as one (aligned axes): only a sum or difference is defined
FOLDED_LINE = 8  # of such two axes, the second points backwards: the difference is defined
FREE_CHAIN = 16  # more joints than the task needs
STRETCHED = 32  # the arm is straight: on the outer limit
FOLDED = 64  # the arm is folded back: on the inner limit
SIDEWAYS = 128  # the target touches the cylinder that the lateral offset leaves out
FREE = FREE_FIRST | FREE_PLANE | FREE_LINE | FREE_CHAIN
LIMIT = STRETCHED | FOLDED | SIDEWAYS

# Fractions of the arm's size. On a limit, an angle errs by the root of a length's error; at a
# point where an angle is free, by its quotient. Both choices keep that error below 1e-6 rad.
TOUCHING = 1e-12  # two lengths count as equal
COINCIDENT = 1e-10  # a target counts as lying on the axis that it makes free


def wrap(angle) -> np.ndarray:
    """The same angle in (-pi, pi], radians; -pi and its rounding neighbours become pi."""
    turns = np.ceil((np.asarray(angle) - np.pi) * (0.5 / np.pi) - 1e-13)
    return np.minimum(angle - turns * (2 * np.pi), np.pi)


def unit(angle) -> np.ndarray:
    """e^{i angle}."""
    angle = np.asarray(angle, dtype=float)
    result = np.empty(angle.shape, dtype=complex)
    np.cos(angle, out=result.real)
    np.sin(angle, out=result.imag)
    return result


class TwoLink(NamedTuple):
    """Postures of a two-link arm; the axis before the last (length 2) is the elbow branch.

    first, bend: t1 and t2, radians, shape (..., 2, N); branch 0 has t2 >= 0. The rotations
    e^{i t1} and e^{i t2} are given too. valid: (..., 2, N). marks: bits, shape (..., N).
    beyond, short: metres outside the outer limit and inside the inner one, shape (..., N).
    """

    first: np.ndarray
    bend: np.ndarray
    first_turn: np.ndarray
    bend_turn: np.ndarray
    valid: np.ndarray
    marks: np.ndarray
    beyond: np.ndarray
    short: np.ndarray


def two_link(p, l1: float, l2: float, anchor, tol: float) -> TwoLink:
    """All (t1, t2) with l1 e^{i t1} + l2 e^{i (t1 + t2)} = p.

    p: complex targets, metres, shape (..., N). l1, l2 > 0. anchor: t1 to report where it is
    free (p = 0 with l1 = l2), broadcastable to (..., N). tol: metres by which a target may
    miss the annulus and still count as on its limit.

    tan(t2/2) = sqrt(outer/inner) with outer = (l1+l2)^2 - r^2, inner = r^2 - (l1-l2)^2: exact
    at both limits, where acos loses half of the digits.
    """
    r = np.abs(p)
    total, gap = l1 + l2, abs(l1 - l2)
    beyond, short = r - total, gap - r
    free = (r <= COINCIDENT * total) & (gap <= TOUCHING * total)
    stretched = beyond >= -TOUCHING * total
    folded = free | (short >= -TOUCHING * total)
    outer = np.where(stretched, 0.0, -beyond * (total + r))
    inner = np.where(folded, 0.0, -short * (gap + r))
    root_outer, root_inner = np.sqrt(outer), np.sqrt(inner)

    shape = (*r.shape[:-1], 2, r.shape[-1])
    bend = np.empty(shape)
    np.multiply(np.arctan2(root_outer, root_inner), 2.0, out=bend[..., 0, :])
    np.negative(bend[..., 0, :], out=bend[..., 1, :])
    bend_turn = np.empty(shape, dtype=complex)
    scale = 1.0 / (inner + outer)
    bend_turn.real = ((inner - outer) * scale)[..., None, :]
    bend_turn.imag[..., 0, :] = 2.0 * root_inner * root_outer * scale
    np.negative(bend_turn.imag[..., 0, :], out=bend_turn.imag[..., 1, :])

    first_turn = p[..., None, :] * np.conj(l1 + l2 * bend_turn)
    size = np.abs(first_turn)
    if free.any():
        anchored = np.broadcast_to(unit(anchor), r.shape)[..., None, :]
        first_turn = np.where(free[..., None, :], anchored, first_turn)
        size = np.where(free[..., None, :], 1.0, size)
    first_turn /= np.where(size > 0.0, size, 1.0)
    first = np.arctan2(first_turn.imag, first_turn.real)

    reached = (beyond <= tol) & (short <= tol)
    valid = np.repeat(reached[..., None, :], 2, axis=-2)
    valid[..., 1, :] &= ~(stretched | folded)
    marks = np.where(stretched, STRETCHED, 0) | np.where(folded & ~free, FOLDED, 0)
    marks |= np.where(free, FREE_PLANE, 0)
    return TwoLink(first, bend, first_turn, bend_turn, valid, marks.astype(np.uint8), beyond, short)


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
    free = (r <= COINCIDENT * size) & (abs(offset) <= TOUCHING * size)
    at_limit = free | (inside >= -TOUCHING * size)
    radius = np.empty((2, r.size))
    np.sqrt(np.where(at_limit, 0.0, -inside * (abs(offset) + r)), out=radius[0])
    np.negative(radius[0], out=radius[1])
    turn = xy * (radius - 1j * offset)
    length = np.abs(turn)
    if free.any():
        turn = np.where(free, unit(anchor), turn)
        length = np.where(free, 1.0, length)
    turn /= np.where(length > 0.0, length, 1.0)
    valid = np.repeat((inside <= tol)[None], 2, axis=0)
    valid[1] &= ~at_limit
    marks = np.where(free, FREE_FIRST, np.where(at_limit, SIDEWAYS, 0)).astype(np.uint8)
    return Shoulder(turn, radius, valid, marks, inside)
