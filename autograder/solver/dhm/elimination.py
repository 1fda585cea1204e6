"""Three joints that bring a point in place, or a plane: two are eliminated, the third is a root of a polynomial.

Both problems come down to one: a plane vector s whose two projections and whose length are known functions of the last
joint, M s = r(v), |s| = rho(v). If M has its full rank, s follows from v, and |s| leaves a polynomial of four roots in
v; else one row is a polynomial of two roots by itself, and |s| gives two vectors. Source: D. Pieper, "The kinematics
of manipulators under computer control", 1968, for three turns; here for slides in any place too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from . import circle
from .status import Flag

_RANK = 1e-4  # singular value under which the projections say only one thing: the rest is for Newton
_IDENTICAL = 1e-11  # values under which a polynomial is zero everywhere
_STEP = 1e-5  # radians, for the slope at a root
_ONE_SIDE = 1e-12  # half a distance of two solutions that are one, so that each still has its side
_FAR = 1e6  # slides beyond this many sizes of the arm are roots at infinity

Near = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Values, each broadcast to (N,), of the three joints where they are free."""


@dataclass(frozen=True)
class Triples:
    """Values of three joints: first, second, third, each (4, N); valid, flags (4, N), STRETCHED for a double root."""

    first: np.ndarray
    second: np.ndarray
    third: np.ndarray
    valid: np.ndarray
    flags: np.ndarray


@dataclass(frozen=True)
class PointProblem:
    """Z(first) L1 Z(second) L2 Z(third) w = t, lengths in units of the arm's size.

    Attributes
    ----------
    slides : three bool
    link : (4, 4) array
        L1, a constant of the arm.
    """

    slides: tuple[bool, bool, bool]
    link: np.ndarray

    def solve(self, L2: np.ndarray, w: np.ndarray, t: np.ndarray, near: Near) -> Triples:
        """All solutions for L2 (N, 4, 4) and points w, t (3, N)."""
        count = max(len(L2), w.shape[1], t.shape[1])
        turn, shift = self.link[:3, :3], self.link[:3, 3]

        def carried(v: np.ndarray) -> np.ndarray:
            """L2 Z(v) w, (3, ..., N), for v (..., N)."""
            point = _moved(self.slides[2], v, w)
            return np.einsum("nij,j...n->i...n", L2[:, :3, :3], point) + _column(L2[:, :3, 3].T, point.ndim)

        def at(v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            y = carried(v)
            goal = _column(t, y.ndim)
            if self.slides[0]:
                r = goal[:2] - _column(shift[:2, None], y.ndim) - np.multiply.outer(turn[:2, 2], y[2])
            else:
                lift = goal[2] - shift[2] - turn[2, 2] * y[2]
                along = (goal**2).sum(0) - shift @ shift - (y**2).sum(0)
                r = np.stack([lift, along / 2 - (turn.T @ shift)[2] * y[2]])
            return r, y[0] ** 2 + y[1] ** 2

        if self.slides[1]:
            third, second, valid, flags = self._with_slide(carried, t, count, near)
        else:
            rows = turn[:2, :2] if self.slides[0] else np.stack([turn[2, :2], (turn.T @ shift)[:2]])
            s, third, valid, flags = plane_vectors(rows, at, self.slides[2], count, near[2])
            y = carried(third)
            length, reach = np.hypot(*s), np.hypot(y[0], y[1])
            free = reach <= _no_direction(flags)
            second = np.where(free, near[1], np.arctan2(s[1], s[0]) - np.arctan2(y[1], y[0]))
            valid &= ~free | (length <= circle.DOUBLE)
            flags |= np.where(free, Flag.FREE_PLANE, 0).astype(np.uint8)
        x = np.einsum("ij,jkn->ikn", turn, _moved(self.slides[1], second, carried(third))) + shift[:, None, None]
        goal = _column(t, 3)
        if self.slides[0]:
            first = goal[2] - x[2]
        else:
            free = np.hypot(x[0], x[1]) <= _no_direction(flags)
            first = np.where(free, near[0], np.arctan2(goal[1], goal[0]) - np.arctan2(x[1], x[0]))
            flags |= np.where(free, Flag.FREE_FIRST, 0).astype(np.uint8)
        return Triples(np.broadcast_to(first, (4, count)), second, third, valid, flags)

    def _with_slide(
        self, carried: Callable[[np.ndarray], np.ndarray], t: np.ndarray, count: int, near: Near
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Third and second joint, a slide, with `valid` and `flags`, (4, N) each."""
        turn, shift = self.link[:3, :3], self.link[:3, 3]
        way = turn[:, 2]
        known = np.array([[1.0], [1.0], [0.0]] if self.slides[0] else [[0.0], [0.0], [1.0]])

        def before(v: np.ndarray) -> np.ndarray:
            """The point with the second joint at zero; coordinates that the first cannot change count from the goal."""
            y = carried(v)
            x = np.einsum("ij,j...->i...", turn, y) + _column(shift[:, None], y.ndim)
            return x - _column(known * t, y.ndim)

        square = (t**2).sum(0) - t[2] ** 2
        across = np.hypot(way[0], way[1])
        if self.slides[0]:  # both coordinates must vanish
            third, valid, flags = _solved(
                lambda v: way[0] * before(v)[1] - way[1] * before(v)[0], self.slides[2], 1, count, near[2]
            )
            x = before(third)
            second = -(way[0] * x[0] + way[1] * x[1]) / across**2
            return _twice(third, second, second, valid, flags)
        if abs(way[2]) > _RANK:

            def radius(v: np.ndarray) -> np.ndarray:
                x = before(v)
                slide = -x[2] / way[2]
                return (x[0] + slide * way[0]) ** 2 + (x[1] + slide * way[1]) ** 2 - square

            third, valid, flags = _solved(radius, self.slides[2], 2, count, near[2])
            return third, -before(third)[2] / way[2], valid, flags
        third, valid, flags = _solved(lambda v: before(v)[2], self.slides[2], 1, count, near[2])
        x = before(third)
        foot = -(x[0] * way[0] + x[1] * way[1])
        aside = x[0] * way[1] - x[1] * way[0]
        half, double = _half(square - aside**2)
        return _twice(third, foot - half, foot + half, valid, flags | double)


def plane_vectors(
    rows: np.ndarray,
    at: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]],
    slide: bool,
    count: int,
    near: np.ndarray,
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """All s and v with rows s = r(v) and |s|^2 = square(v).

    Parameters
    ----------
    rows : (2, 2) array
    at : function
        From v (..., N) to r (2, ..., N), affine in the motion, and to the square (..., N).
    slide : bool
        Whether v is a slide, else an angle.
    count : int
        N.
    near : array_like
        v where it is free.

    Returns
    -------
    s : (2, 4, N) array
    v, valid, flags : (4, N) arrays
    """
    left, sizes, right = np.linalg.svd(rows)
    if sizes[1] > _RANK:

        def excess(v: np.ndarray) -> np.ndarray:
            r, square = at(v)
            r = np.einsum("ji,j...->i...", left, r)
            return (r[0] * sizes[1] / sizes[0]) ** 2 + r[1] ** 2 - sizes[1] ** 2 * square

        v, valid, flags = _solved(excess, slide, 2, count, near, sizes[1] ** 2)
        r, square = at(v)
        s = np.einsum("ji,jkn->ikn", left, r) / sizes[:, None, None]
    else:
        v, valid, flags = _solved(lambda v: np.einsum("j,j...->...", left[:, 1], at(v)[0]), slide, 1, count, near)
        r, square = at(v)
        along = np.einsum("j,j...->...", left[:, 0], r) / sizes[0]
        half, double = _half(square - along**2)
        flags = flags | double
        v, half, along_twice, valid, flags = (
            np.repeat(v, 2, axis=0),
            np.stack([half, -half], axis=1).reshape(4, -1),
            np.repeat(along, 2, axis=0),
            np.repeat(valid, 2, axis=0),
            np.repeat(flags, 2, axis=0),
        )
        s = np.stack([along_twice, half])
    return np.einsum("ij,ikn->jkn", right, s), v, valid, flags


def _solved(
    residual: Callable[[np.ndarray], np.ndarray],
    slide: bool,
    degree: int,
    count: int,
    near: np.ndarray,
    scale: float = 1.0,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Roots v (2 degree, N) of a residual of v, whether they count, and FREE_CHAIN where every v is one."""
    where = circle.angles(degree)[:, None]

    def value(angle: np.ndarray) -> np.ndarray:
        weight = ((1 + np.cos(angle)) / 2) ** degree if slide else 1.0
        return weight * residual(np.tan(angle / 2) if slide else angle)

    values = np.broadcast_to(value(where), (len(where), count))
    angle, valid, double = circle.roots(values)
    for _ in range(2):  # simple roots keep all digits of the residual, not of its coefficients only
        here = value(angle)
        slope = (value(angle + _STEP) - value(angle - _STEP)) / (2 * _STEP)
        simple = valid & ~double & (np.abs(here) < _STEP * np.abs(slope))
        angle = angle - np.where(simple, here / np.where(simple, slope, 1.0), 0.0)
    free = np.abs(values).max(axis=0) <= _IDENTICAL * max(scale, _IDENTICAL)
    v = np.clip(np.tan(angle / 2), -_FAR, _FAR) if slide else angle
    if slide:
        valid = valid & (np.abs(v) < _FAR)
    v = np.where(free, near, v)
    valid = np.where(free, np.arange(len(v))[:, None] == 0, valid)
    return v, valid, np.where(free, Flag.FREE_CHAIN, np.where(double, Flag.STRETCHED, 0)).astype(np.uint8)


def _no_direction(flags: np.ndarray) -> np.ndarray:
    """Length under which a vector has no direction: of a double root it is known to half of its digits."""
    return np.where(flags & Flag.STRETCHED, circle.DOUBLE, circle.ZERO)


def _half(square: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Half the distance between two solutions from its square, and STRETCHED where they are one; never quite zero."""
    half = np.sqrt(np.maximum(square, _ONE_SIDE**2))
    return half, np.where(half <= circle.DOUBLE, Flag.STRETCHED, 0).astype(np.uint8)


def _twice(
    third: np.ndarray, one: np.ndarray, other: np.ndarray, valid: np.ndarray, flags: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Two values of the second joint for each of the third."""
    second = np.stack([one, other], axis=1).reshape(4, -1)
    return np.repeat(third, 2, axis=0), second, np.repeat(valid, 2, axis=0), np.repeat(flags, 2, axis=0)


def _moved(slide: bool, v: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Points (3, ..., N) moved about (slide: along) z by v (..., N)."""
    x, y, z = _column(point, np.ndim(v) + 1)
    if slide:
        return np.stack(np.broadcast_arrays(x, y, z + v))
    c, s = np.cos(v), np.sin(v)
    return np.stack(np.broadcast_arrays(c * x - s * y, s * x + c * y, z))


def _column(point: np.ndarray, dimensions: int) -> np.ndarray:
    """Points (3, N), or already (3, ..., N), with as many dimensions as asked for."""
    return point if point.ndim == dimensions else point.reshape(len(point), *[1] * (dimensions - 2), -1)
