"""The general equations of Paul and Khalil that closed-form inverse models end in.

S and C are the sine and cosine of an unknown angle, r an unknown length:

====  =================================================  =======================
type  equations                                          solutions, regular case
====  =================================================  =======================
1     X r = Y                                            1
2     X S + Y C = Z                                      2 or 0
3     X1 S + Y1 C = Z1,  X2 S + Y2 C = Z2                1 or 0 (2 if dependent)
4     X1 r S = Y1,  X2 r C = Y2                          2
5     X1 S = Y1 + Z1 r,  X2 C = Y2 + Z2 r                2 or 0
6     W Sj = X Ci + Y Si + Z1,  W Cj = X Si - Y Ci + Z2  2 or 0
7     W1 Cj + W2 Sj = X Ci + Y Si + Z1,                  2 or 0
      W1 Sj - W2 Cj = X Si - Y Ci + Z2
8     X Ci + Y Cij = Z1,  X Si + Y Sij = Z2              2 or 0
====  =================================================  =======================

Types 4 and 5 couple an angle with a length: arms with slides end in them. Type 8 is the planar arm with two revolute
joints.

Every coefficient may be an array; they are broadcast to a batch shape written
``...``. Angles are in radians, in (-pi, pi]. ``tolerance`` is in the unit of
the coefficients (relative to the largest of them where that exceeds 1): a
coefficient below it counts as zero, and two solutions merge when the equation
misses its limit by less. Coefficients that are not finite raise ValueError.

Source: Paul's method as tabulated by Khalil and Kleinfinger (W. Khalil, E. Dombre,
"Modeling, Identification and Control of Robots", 2002, chapter 4), whose numbering the
Adept s600 tutorial uses; its appendix derives type 8.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .geometry import two_link, wrap
from .status import Status


@dataclass(frozen=True)
class Roots:
    """Real solutions of a batch of equations.

    Attributes
    ----------
    values : array, shape (..., m) or (..., m, u)
        m places for solutions, of one unknown or of u. Zero where `exists` is
        False. When there are infinitely many the first is a representative.
    exists : bool array, shape (..., m)
    status : array of `Status`, shape (...)
        BOUNDARY where two solutions merge.
    free : array of str, shape (...)
        what is free, in words, where the status is INFINITE; "" elsewhere.
    """

    values: np.ndarray
    exists: np.ndarray
    status: np.ndarray
    free: np.ndarray

    @property
    def count(self) -> np.ndarray:
        """Number of solutions, shape (...), int; -1 stands for infinitely many."""
        return np.where(self.status == Status.INFINITE, -1, self.exists.sum(axis=-1))

    def listed(self) -> np.ndarray:
        """The solutions of a single problem, shape (count,) or (count, u)."""
        if self.exists.ndim != 1:
            raise ValueError(f"list one problem at a time: this is a batch of shape {self.exists.shape[:-1]}")
        return self.values[self.exists]


def type1(X: ArrayLike, Y: ArrayLike, tolerance: float = 1e-12) -> Roots:
    """X r = Y for the length r: `Roots` with values (..., 1)."""
    (X, Y), accepted = _coefficients(tolerance, X, Y)
    regular = np.abs(X) > accepted
    infinite = ~regular & (np.abs(Y) <= accepted)
    return _roots(_quotient(Y, X, regular)[..., None], regular[..., None], infinite, "r")


def type2(X: ArrayLike, Y: ArrayLike, Z: ArrayLike, tolerance: float = 1e-12) -> Roots:
    """X S + Y C = Z for the angle: `Roots` with values (..., 2).

    With rho = hypot(X, Y) this is ``rho cos(theta - atan2(X, Y)) = Z``: the
    first solution lies ahead of that direction, the second behind it. They
    merge at ``|Z| = rho``; theta is free if all coefficients vanish.
    """
    (X, Y, Z), accepted = _coefficients(tolerance, X, Y, Z)
    rho = np.hypot(X, Y)
    regular = rho > accepted
    margin = rho - np.abs(Z)
    double = regular & (np.abs(margin) <= accepted)
    sine = np.sqrt(np.where(double, 0.0, np.maximum(margin, 0.0)) * (rho + np.abs(Z)))
    ahead = np.arctan2(sine, Z)
    values = wrap(np.arctan2(X, Y)[..., None] + np.stack([ahead, -ahead], axis=-1))
    exists = _twice(regular & (margin >= -accepted))
    return _roots(values, exists, ~regular & (np.abs(Z) <= accepted), "theta", double)


def type3(
    X1: ArrayLike, Y1: ArrayLike, Z1: ArrayLike, X2: ArrayLike, Y2: ArrayLike, Z2: ArrayLike, tolerance: float = 1e-9
) -> Roots:
    """X1 S + Y1 C = Z1 and X2 S + Y2 C = Z2 for one angle: values (..., 2).

    Independent equations give S and C, and one solution if S^2 + C^2 = 1.
    Dependent ones leave the type-2 equation of the larger row, whose solutions
    must satisfy the other row. Here `tolerance` is the accepted residual.
    """
    (X1, Y1, Z1, X2, Y2, Z2), accepted = _coefficients(tolerance, X1, Y1, Z1, X2, Y2, Z2)
    size1, size2 = np.hypot(X1, Y1), np.hypot(X2, Y2)
    det = X1 * Y2 - X2 * Y1
    independent = np.abs(det) > np.maximum(1e-6 * size1 * size2, tolerance**2)
    angle = np.arctan2(_quotient(Z1 * Y2 - Z2 * Y1, det, independent), _quotient(X1 * Z2 - X2 * Z1, det, independent))

    first = size1 >= size2
    X, Y, Z = (np.where(first, a, b) for a, b in [(X1, X2), (Y1, Y2), (Z1, Z2)])
    larger = type2(X, Y, Z, tolerance=1e-12)
    candidates = np.where(independent[..., None], _twice(angle), larger.values)
    exists = np.where(independent[..., None], [True, False], larger.exists)
    S, C = np.sin(candidates), np.cos(candidates)
    for X, Y, Z in [(X1, Y1, Z1), (X2, Y2, Z2)]:
        exists &= np.abs(X[..., None] * S + Y[..., None] * C - Z[..., None]) <= accepted[..., None]
    infinite = np.maximum(size1, size2) <= accepted
    infinite &= np.maximum(np.abs(Z1), np.abs(Z2)) <= accepted
    double = ~independent & (larger.status == Status.BOUNDARY)
    return _roots(candidates, exists, infinite, "theta", double)


def type4(X1: ArrayLike, Y1: ArrayLike, X2: ArrayLike, Y2: ArrayLike, tolerance: float = 1e-12) -> Roots:
    """X1 r S = Y1 and X2 r C = Y2: values (..., 2, 2).

    Returns the pairs (theta, r): a point in polar coordinates, r > 0 first, then r < 0. At r = 0 theta is free. With X1
    or X2 zero one equation is left, if any, and a family; its representative has S = 0 or C = 0.
    """
    (X1, Y1, X2, Y2), accepted = _coefficients(tolerance, X1, Y1, X2, Y2)
    some1, some2 = np.abs(X1) > accepted, np.abs(X2) > accepted
    x, y = _quotient(Y2, X2, some2), _quotient(Y1, X1, some1)
    r = np.hypot(x, y)
    angle = np.arctan2(y, x)
    values = np.stack([np.stack([angle, r], axis=-1), np.stack([wrap(angle + np.pi), -r], axis=-1)], axis=-2)
    fits = (some1 | (np.abs(Y1) <= accepted)) & (some2 | (np.abs(Y2) <= accepted))
    regular = some1 & some2
    central = regular & (r <= accepted)
    free = np.where(some1 | some2, np.where(central, "theta", "theta (r follows)"), "theta and r")
    return _roots(values, _twice(fits), fits & (~regular | central), free)


def type5(
    X1: ArrayLike,
    Y1: ArrayLike,
    Z1: ArrayLike,
    X2: ArrayLike,
    Y2: ArrayLike,
    Z2: ArrayLike,
    tolerance: float = 1e-12,
) -> Roots:
    """X1 S = Y1 + Z1 r and X2 C = Y2 + Z2 r: values (..., 2, 2).

    Returns the pairs (theta, r), the larger r first. (C, S) runs along a straight line with r, and must lie on the unit
    circle: two solutions, one where the line touches the circle. With X1 or X2 zero that equation gives r (the pairs
    then start with the angle ahead, as in type 2), or nothing, and a family. A line that is one point leaves r free.
    """
    (X1, Y1, Z1, X2, Y2, Z2), accepted = _coefficients(tolerance, X1, Y1, Z1, X2, Y2, Z2)
    some1, some2 = np.abs(X1) > accepted, np.abs(X2) > accepted
    both, one = some1 & some2, some1 ^ some2
    # Both equations: where the line (c, s) + (w, u) r meets the circle.
    s, u = _quotient(Y1, X1, both), _quotient(Z1, X1, both)
    c, w = _quotient(Y2, X2, both), _quotient(Z2, X2, both)
    speed = np.hypot(u, w)
    moving = speed > accepted
    distance = np.where(moving, np.abs(_quotient(s * w - c * u, speed, moving)), np.hypot(s, c))
    foot = -_quotient(s * u + c * w, speed**2, moving)
    touching = both & moving & (np.abs(distance - 1) <= accepted)
    half = _quotient(np.sqrt(np.where(touching, 0.0, np.maximum(1 - distance**2, 0.0))), speed, moving)
    r = np.stack([foot + half, foot - half], axis=-1)
    angle = np.arctan2(s[..., None] + u[..., None] * r, c[..., None] + w[..., None] * r)
    # One row without its angle: it gives r, or holds by itself, or never; the other row, X, Y, Z, gives the angle then.
    X, Y, Z, Y0, Z0 = (np.where(some2, p, q) for p, q in [(X2, X1), (Y2, Y1), (Z2, Z1), (Y1, Y2), (Z1, Z2)])
    given = one & (np.abs(Z0) > accepted)
    holds = one & ~given & (np.abs(Y0) <= accepted)
    follows = holds & (np.abs(Z) > accepted)
    alone = np.where(follows, _quotient(X - Y, Z, follows), -_quotient(Y0, Z0, given))
    value = _quotient(Y + Z * alone, X, one)
    edge = one & (np.abs(np.abs(value) - 1) <= accepted)
    turn = np.arctan2(np.sqrt(np.where(edge, 0.0, np.maximum(1 - value**2, 0.0))), value)
    pair = np.stack([turn, -turn], axis=-1)
    angle = np.where(both[..., None], angle, np.where(some2[..., None], pair, np.pi / 2 - pair))
    # No angle at all: the row with the larger factor gives r, if the other one agrees.
    larger = np.abs(Z1) >= np.abs(Z2)
    Y0, Z0 = np.where(larger, Y1, Y2), np.where(larger, Z1, Z2)
    none, length = ~some1 & ~some2, np.abs(Z0) > accepted
    only = -_quotient(Y0, Z0, length)
    agree = none & (np.abs(Y1 + Z1 * only) <= accepted) & (np.abs(Y2 + Z2 * only) <= accepted)
    r = np.where(both[..., None], r, np.where(one, alone, only)[..., None])

    point = both & ~moving & (np.abs(distance - 1) <= accepted)
    exists = (both & moving & (distance <= 1 + accepted)) | point | agree
    exists |= (given | holds) & (np.abs(value) <= 1 + accepted)
    free = np.select(
        [none & length, none, follows, point | holds], ["theta", "theta and r", "theta (r follows)", "r"], ""
    )
    values = np.stack([wrap(angle), r], axis=-1)
    return _roots(values, _twice(exists), exists & (free != ""), free, touching | (given & edge))


def type6(W: ArrayLike, X: ArrayLike, Y: ArrayLike, Z1: ArrayLike, Z2: ArrayLike, tolerance: float = 1e-12) -> Roots:
    """W Sj = X Ci + Y Si + Z1, W Cj = X Si - Y Ci + Z2: values (..., 2, 2).

    Type 7 with theta_j measured from the other axis. Returns the pairs
    (theta_i, theta_j).
    """
    roots = type7(W, 0.0, X, Y, Z1, Z2, tolerance)
    values = roots.values.copy()
    values[..., 1] = np.where(roots.exists, wrap(np.pi / 2 - values[..., 1]), 0.0)
    return Roots(values, roots.exists, roots.status, roots.free)


def type7(
    W1: ArrayLike, W2: ArrayLike, X: ArrayLike, Y: ArrayLike, Z1: ArrayLike, Z2: ArrayLike, tolerance: float = 1e-12
) -> Roots:
    """W1 Cj + W2 Sj = X Ci + Y Si + Z1, W1 Sj - W2 Cj = X Si - Y Ci + Z2.

    Returns the pairs (theta_i, theta_j), values (..., 2, 2). The sum of the
    squares does not contain theta_j and is a type-2 equation in theta_i; then
    Cj and Sj are linear. W1 = W2 = 0 leaves theta_j free, if a theta_i exists.
    """
    (W1, W2, X, Y, Z1, Z2), accepted = _coefficients(tolerance, W1, W2, X, Y, Z1, Z2)
    square = W1**2 + W2**2
    regular = square > accepted**2
    outer = type2(2 * (Z1 * Y + Z2 * X), 2 * (Z1 * X - Z2 * Y), square - X**2 - Y**2 - Z1**2 - Z2**2, tolerance=1e-12)
    alone = type3(Y, X, -Z1, X, -Y, -Z2)
    theta_i = np.where(regular[..., None], outer.values, alone.values)
    C, S = np.cos(theta_i), np.sin(theta_i)
    right1 = X[..., None] * C + Y[..., None] * S + Z1[..., None]
    right2 = X[..., None] * S - Y[..., None] * C + Z2[..., None]
    theta_j = np.where(
        regular[..., None],
        np.arctan2(W2[..., None] * right1 + W1[..., None] * right2, W1[..., None] * right1 - W2[..., None] * right2),
        0.0,
    )
    infinite = np.where(regular, outer.status == Status.INFINITE, alone.status != Status.UNREACHABLE)
    free = np.where(regular, "theta_i", np.where(alone.status == Status.INFINITE, "theta_i and theta_j", "theta_j"))
    exists = outer.exists & regular[..., None]
    return _roots(np.stack([theta_i, theta_j], axis=-1), exists, infinite, free, outer.status == Status.BOUNDARY)


def type8(X: ArrayLike, Y: ArrayLike, Z1: ArrayLike, Z2: ArrayLike, tolerance: float = 1e-12) -> Roots:
    """X Ci + Y Cij = Z1, X Si + Y Sij = Z2: values (..., 2, 2).

    Returns the pairs (theta_i, theta_j) of the two-link arm; for X Y > 0 the first
    has theta_j >= 0, the second theta_j <= 0. With rho = hypot(Z1, Z2): two
    solutions for ``||X| - |Y|| < rho < |X| + |Y|``, one on the limits, none outside.
    Infinitely many when X or Y is zero and rho equals the other, or when rho = 0
    and ``|X| = |Y|``.
    """
    (X, Y, Z1, Z2), accepted = _coefficients(tolerance, X, Y, Z1, Z2)
    target, rho = Z1 + 1j * Z2, np.hypot(Z1, Z2)
    far, near = np.abs(X) + np.abs(Y), np.abs(np.abs(X) - np.abs(Y))
    no_X, no_Y = np.abs(X) <= accepted, np.abs(Y) <= accepted
    one_link = no_X | no_Y
    folded = (rho <= accepted) & (near <= accepted)
    in_reach = (rho <= far + accepted) & (rho >= near - accepted)
    double = (np.abs(rho - far) <= accepted) | (np.abs(rho - near) <= accepted)

    l1, l2 = (np.where(one_link, 1.0, np.abs(length)).ravel() for length in (X, Y))
    arm = two_link(target.ravel(), l1, l2, anchor=0.0, tol=accepted.ravel())
    pairs = np.stack([arm.first, arm.bend], axis=-1).swapaxes(0, 1).reshape(X.shape + (2, 2))
    turned = np.pi * np.stack([X < 0, (X < 0) != (Y < 0)], axis=-1)
    alone = np.stack([np.angle(target * np.where(X + Y < 0, -1, 1)), np.zeros_like(rho)], axis=-1)
    values = np.where(one_link[..., None, None], alone[..., None, :], wrap(pairs + turned[..., None, :]))
    free = np.select(
        [no_X & no_Y, no_X, no_Y], ["theta_i and theta_j", "theta_i (theta_i + theta_j defined)", "theta_j"], "theta_i"
    )
    return _roots(values, _twice(in_reach), in_reach & (one_link | folded), free, double)


def _coefficients(tolerance: ArrayLike, *coefficients: ArrayLike) -> tuple[list[np.ndarray], np.ndarray]:
    """The coefficients as arrays of one shape, and the tolerance scaled to them."""
    arrays = list(np.broadcast_arrays(*(np.asarray(c, float) for c in coefficients)))
    if not all(np.isfinite(a).all() for a in arrays):
        raise ValueError("coefficients are finite numbers, found NaN or infinity")
    return arrays, np.asarray(tolerance) * np.maximum(1.0, np.abs(arrays).max(axis=0))


def _roots(
    values: np.ndarray, exists: np.ndarray, infinite: np.ndarray, free: ArrayLike, double: ArrayLike = False
) -> Roots:
    """`Roots` with one place for double and infinite cases, and the rest blank."""
    exists = exists.copy()
    exists[..., 1:] &= ~(infinite | np.asarray(double))[..., None]
    exists[..., 0] |= infinite
    blank = exists[..., None] if values.ndim > exists.ndim else exists
    status = np.select(
        [infinite, ~exists.any(axis=-1), np.asarray(double)],
        [Status.INFINITE, Status.UNREACHABLE, Status.BOUNDARY],
        Status.SOLVED,
    )
    return Roots(np.where(blank, values, 0.0), exists, status, np.where(infinite, free, ""))


def _twice(mask: np.ndarray) -> np.ndarray:
    return np.stack([mask, mask], axis=-1)


def _quotient(n: np.ndarray, d: np.ndarray, usable: np.ndarray) -> np.ndarray:
    return np.where(usable, n, 0.0) / np.where(usable, d, 1.0)
