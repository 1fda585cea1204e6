"""Planar parallel robots: where inverse kinematics are the easy ones, and where they are not.

Three legs join anchors ``A_i`` of the base to points ``B_i = P + R(phi) b_i`` of
a platform with pose (x, y, phi), P = (x, y). The legs of the 3-RPR have a
controlled length: inverse kinematics have one solution, forward kinematics up to
six, the assembly modes. The legs of the 3-RRR are two-bar arms driven at the
base: its inverse kinematics already have 2^3 = 8 solutions.

Lengths in metres, angles in radians, batch shape written ``...``.

Source: EPFL slides, which state for parallel robots in general what holds for
the 3-RPR; the architecture of their figure is not named.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from .equations import Roots, type8
from .geometry import rotation_2d, wrap
from .status import Status

# In lengths scaled to 1. An error e of a merged mode shows as e^2 in the leg lengths: hence
# the square between the first two.
_MERGED = 1e-6  # assembly modes nearer than this are one
_CLOSED = 1e-12  # a pose closes the legs when no length is off by more
_CONGRUENT = 1e-9
_SINGULAR = 1e-6  # determinant of the scaled constraint Jacobian at merging modes


_BASE = ((0.0, 0.0), (1.0, 0.0), (0.4, 0.9))
_PLATFORM = ((-0.2, -0.1), (0.25, -0.15), (0.0, 0.2))


@dataclass(frozen=True, init=False, eq=False)
class ThreeRPR:
    """Planar 3-RPR: three legs of variable length between pin joints.

    base : array_like, shape (3, 2), the anchors A_i in the base frame, metres
    platform : array_like, shape (3, 2), the points b_i in the platform frame, metres

    Raises ValueError when two legs coincide, or when all three anchors or all
    three platform points do: the platform could then turn freely.
    """

    base: np.ndarray
    platform: np.ndarray

    def __init__(self, base: ArrayLike = _BASE, platform: ArrayLike = _PLATFORM) -> None:
        self.__dict__.update(zip(("base", "platform"), _triangles(base, platform)))

    def inverse(self, pose: ArrayLike) -> np.ndarray:
        """Inverse kinematics: leg lengths (..., 3) of a pose (..., 3) = (x, y, phi). One solution."""
        return np.linalg.norm(_legs(self, pose), axis=-1)

    def jacobian(self, pose: ArrayLike) -> np.ndarray:
        """Rates of the leg lengths, q' = J (x', y', phi'): (..., 3) -> (..., 3, 3).

        Row i is (u_x, u_y, r x u): u the direction of leg i, r from P to B_i. Singular where the
        three leg lines pass through one point or are parallel. NaN for a leg of length zero.

        Source: C. Gosselin, J. Angeles, "Singularity analysis of closed-loop kinematic chains", 1990,
        doi:10.1109/70.56660.
        """
        legs = _legs(self, pose)
        lengths = np.linalg.norm(legs, axis=-1, keepdims=True)
        along = legs / np.where(lengths > 0, lengths, np.nan)
        arms = _rotated(np.asarray(pose, float)[..., 2], self.platform)
        return np.concatenate([along, _cross(arms, along)[..., None]], axis=-1)

    def polynomial(self, lengths: ArrayLike) -> np.ndarray:
        """Degree-6 polynomial in t = tan(phi / 2) whose real roots carry the assembly modes.

        Leg 1 subtracted from legs 2 and 3 gives two equations linear in (x, y);
        eliminating them from leg 1 gives a trigonometric polynomial of degree 3
        in phi. phi = pi is a root when the first coefficient vanishes.

        Parameters
        ----------
        lengths : array_like, shape (..., 3), metres

        Returns
        -------
        array, shape (..., 7), highest power first
        """
        checked = _lengths(lengths)
        return self._polynomial(checked, np.zeros(checked.shape[:-1]))

    def forward(self, lengths: ArrayLike) -> Roots:
        """Forward kinematics: all assembly modes of given leg lengths.

        Parameters
        ----------
        lengths : array_like, shape (..., 3), metres, not negative

        Returns
        -------
        Roots
            values (..., 6, 3) = (x, y, phi), by increasing phi in (-pi, pi]. Status
            BOUNDARY: at least two modes merge, a singular pose. INFINITE: a platform
            congruent to its base with three equal legs moves along a circle; phi is
            free when the legs pin the platform to a point it turns about.

        Raises
        ------
        ValueError
            For a wrong shape, a negative or a non-finite length.
        """
        checked = _lengths(lengths)
        shape = checked.shape[:-1]
        lengths = checked.reshape(-1, 3)
        scale = np.maximum(lengths.max(axis=-1, initial=0), self._size)
        start, vanishing = self._start_angle(lengths, scale)
        phi = np.concatenate([self._root_angles(lengths, start), self._parallel_lines(len(lengths))], axis=-1)
        candidates = self._on_first_leg(lengths, phi)
        candidates, closed, singular = self._polish(lengths, scale, candidates)
        accepted = closed & _first_of_equals(candidates, closed, scale)
        poses = self._platform_pose(candidates)

        order = np.argsort(np.where(accepted, poses[..., 2], np.inf), axis=-1, kind="stable")[:, :6]
        exists = np.take_along_axis(accepted, order, axis=-1)
        values = np.where(exists[..., None], np.take_along_axis(poses, order[..., None], axis=-2), 0.0)

        circle, circle_pose = self._circular_motion(lengths, scale)
        infinite = circle | vanishing
        values[circle, 0] = circle_pose[circle]
        exists[circle, 0] = True
        exists[infinite, 1:] = False
        values[infinite, 1:] = 0.0
        status = np.select(
            [infinite & exists[:, 0], ~exists.any(axis=-1), (accepted & singular).any(axis=-1)],
            [Status.INFINITE, Status.UNREACHABLE, Status.BOUNDARY],
            Status.SOLVED,
        )
        free = np.where(status == Status.INFINITE, np.where(circle, "P along a circle", "phi"), "")
        return Roots(
            values.reshape(shape + (6, 3)), exists.reshape(shape + (6,)), status.reshape(shape), free.reshape(shape)
        )

    # The rest works with B_1 as platform origin and A_1 as base origin. There
    # leg 1 reads |p| = q1 and leg i reads |p + d_i| = q_i, d_i = R b_i - A_i.

    @property
    def _size(self) -> float:
        return max(np.ptp(self.base, axis=0).max(), np.ptp(self.platform, axis=0).max())

    def _offsets(self, phi: np.ndarray) -> np.ndarray:
        """d_2 and d_3 for angles of any shape: (..., 2, 2)."""
        return _rotated(phi, self.platform[1:] - self.platform[0]) - (self.base[1:] - self.base[0])

    def _linear(self, lengths: np.ndarray, phi: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """d_i and w_i of the linear equations 2 p . d_i = w_i; lengths (N, 3), phi (N, m)."""
        d = self._offsets(phi)
        squares = lengths**2
        return d, (squares[:, 1:] - squares[:, :1])[:, None] - np.sum(d**2, axis=-1)

    def _eliminant(self, lengths: np.ndarray, phi: np.ndarray) -> np.ndarray:
        """|w2 d3 - w3 d2|^2 - 4 q1^2 (d2 x d3)^2: zero at the assembly modes."""
        d, w = self._linear(lengths, phi)
        mixed = w[..., 0, None] * d[..., 1, :] - w[..., 1, None] * d[..., 0, :]
        return np.sum(mixed**2, axis=-1) - 4 * lengths[:, :1] ** 2 * _cross(d[..., 0, :], d[..., 1, :]) ** 2

    def _polynomial(self, lengths: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Coefficients in tan((phi - start) / 2), highest power first.

        The harmonics c_k of the eliminant come from samples; then
        ``e^(i k phi) (1 + t^2)^3 = (1 + i t)^(3 + k) (1 - i t)^(3 - k)``.
        """
        shape = lengths.shape[:-1]
        lengths, start = lengths.reshape(-1, 3), start.reshape(-1, 1)
        nodes = 2 * np.pi * np.arange(8) / 8
        harmonics = np.fft.fft(self._eliminant(lengths, start + nodes), axis=-1) / 8
        coefficients = sum(harmonics[:, k, None] * _HALF_ANGLE[k + 3] for k in range(-3, 4))
        return coefficients.real.reshape(shape + (7,))

    def _start_angle(self, lengths: np.ndarray, scale: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Angle opposite to the largest eliminant, and where the eliminant vanishes throughout.

        Measured from there, the first coefficient of the polynomial is large and no
        root is near infinity, whatever phi is.
        """
        nodes = 2 * np.pi * np.arange(16) / 16
        sampled = np.abs(self._eliminant(lengths, np.broadcast_to(nodes, (len(lengths), 16))))
        return (nodes[np.argmax(sampled, axis=-1)] - np.pi, sampled.max(axis=-1, initial=0) <= 1e-12 * scale**6)

    def _root_angles(self, lengths: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Angles of the six roots (N, 6), real parts of complex ones included.

        A pair of complex roots beside the real axis is a merged root split by
        rounding; what is not a solution is refused by the leg lengths later.
        """
        p = self._polynomial(lengths, start)
        largest = np.abs(p).max(axis=-1, keepdims=True)
        p = np.where(largest > 0, p, np.eye(7)[0]) / np.where(largest > 0, largest, 1.0)
        companion = np.zeros((len(p), 6, 6))
        companion[:, 1:, :-1] = np.eye(5)
        companion[:, 0, :] = -p[:, 1:] / p[:, :1]
        return start[:, None] + 2 * np.arctan(np.linalg.eigvals(companion).real)

    def _parallel_lines(self, n: int) -> np.ndarray:
        """Angles (n, 2) at which the two linear equations describe parallel lines.

        There two modes share one phi, a double root of the polynomial.
        """
        b, a = self.platform[1:] - self.platform[0], self.base[1:] - self.base[0]
        sine = np.sum(b[0] * a[1]) - np.sum(a[0] * b[1])
        cosine = -_cross(b[0], a[1]) - _cross(a[0], b[1])
        constant = _cross(b[0], b[1]) + _cross(a[0], a[1])
        middle = np.arctan2(sine, cosine)
        size = np.hypot(sine, cosine)
        away = np.arccos(np.clip(-constant / size, -1, 1)) if size > 0 else 0.0
        return np.broadcast_to([middle + away, middle - away], (n, 2))

    def _on_first_leg(self, lengths: np.ndarray, phi: np.ndarray) -> np.ndarray:
        """Both points of the circle of leg 1 on the line of the longer d: (N, 2m, 3)."""
        d, w = self._linear(lengths, phi)
        size = np.linalg.norm(d, axis=-1)
        second = size[..., 1] > size[..., 0]
        d = np.where(second[..., None], d[..., 1, :], d[..., 0, :])
        w, size = np.where(second, w[..., 1], w[..., 0]), size.max(axis=-1)
        usable = size > 0
        unit = d / np.where(usable, size, 1.0)[..., None]
        along = np.where(usable, w, 0.0) / np.where(usable, 2 * size, 1.0)
        limit = lengths[:, :1]
        along = np.clip(along, -limit, limit)
        across = np.sqrt((limit - along) * (limit + along))
        normal = np.stack([-unit[..., 1], unit[..., 0]], axis=-1)
        points = [along[..., None] * unit + side * across[..., None] * normal for side in (1, -1)]
        return np.concatenate([np.concatenate([p, phi[..., None]], axis=-1) for p in points], axis=1)

    def _polish(
        self, lengths: np.ndarray, scale: np.ndarray, candidates: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Newton's method on the three leg equations, from (N, m, 3) candidates (p, phi).

        Returns the candidates, best first, whether they close the legs, and whether
        they are singular.
        """
        scale = scale[:, None]
        for _ in range(12):
            errors, J = self._closure(lengths, scale, candidates)
            normal = np.swapaxes(J, -1, -2) @ J + 1e-15 * np.eye(3)
            gradient = np.swapaxes(J, -1, -2) @ errors[..., None]
            step = np.clip(np.linalg.solve(normal, gradient)[..., 0], -0.2, 0.2)
            step[..., :2] *= scale[..., None]
            candidates = candidates - step
        reached = np.linalg.norm(self._leg_vectors(candidates), axis=-1)
        off = np.abs(reached - lengths[:, None]).max(axis=-1)
        best = np.argsort(off, axis=-1, kind="stable")
        candidates = np.take_along_axis(candidates, best[..., None], axis=1)
        closed = np.take_along_axis(off <= _CLOSED * scale, best, axis=1)
        _, J = self._closure(lengths, scale, candidates)
        return candidates, closed, np.abs(np.linalg.det(J)) < _SINGULAR

    def _leg_vectors(self, candidates: np.ndarray) -> np.ndarray:
        p, d = candidates[..., None, :2], self._offsets(candidates[..., 2])
        return np.concatenate([p, p + d], axis=-2)

    def _closure(self, lengths: np.ndarray, scale: np.ndarray, candidates: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Half the errors of the squared lengths and their Jacobian, in lengths scaled to 1."""
        legs = self._leg_vectors(candidates) / scale[..., None, None]
        errors = (np.sum(legs**2, axis=-1) - (lengths[:, None] / scale[..., None]) ** 2) / 2
        turning = _rotated(candidates[..., 2] + np.pi / 2, self.platform - self.platform[0])
        turning = turning / scale[..., None, None]
        return errors, np.concatenate([legs, np.sum(legs * turning, axis=-1)[..., None]], axis=-1)

    def _platform_pose(self, candidates: np.ndarray) -> np.ndarray:
        P = candidates[..., :2] + self.base[0] - _rotated(candidates[..., 2], self.platform[:1])[..., 0, :]
        return np.concatenate([P, wrap(candidates[..., 2:])], axis=-1)

    def _circular_motion(self, lengths: np.ndarray, scale: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where the platform covers the base and the legs are equal, and one such pose."""
        b, a = self.platform[1:] - self.platform[0], self.base[1:] - self.base[0]
        phi = np.arctan2(np.sum(_cross(b, a)), np.sum(b * a))
        covers = np.abs(self._offsets(phi)).max() <= _CONGRUENT * self._size
        equal = np.ptp(lengths, axis=-1) <= _CONGRUENT * scale
        long = lengths[:, 0] > _CONGRUENT * scale
        pose = np.stack([lengths[:, 0], np.zeros(len(lengths)), np.full(len(lengths), phi)], -1)
        return covers & equal & long, self._platform_pose(pose)


@dataclass(frozen=True, init=False, eq=False)
class ThreeRRR:
    """Planar 3-RRR: three two-bar legs, driven at the base anchors.

    base, platform : as for `ThreeRPR`
    proximal, distal : array_like, shape (3,), lengths of the bars, from the base, metres
    """

    base: np.ndarray
    platform: np.ndarray
    proximal: np.ndarray
    distal: np.ndarray

    def __init__(
        self,
        base: ArrayLike = _BASE,
        platform: ArrayLike = _PLATFORM,
        proximal: ArrayLike = (0.5, 0.5, 0.5),
        distal: ArrayLike = (0.45, 0.45, 0.45),
    ) -> None:
        anchors, points = _triangles(base, platform)
        self.__dict__.update(
            base=anchors, platform=points, proximal=_bars(proximal, "proximal"), distal=_bars(distal, "distal")
        )

    def inverse(self, pose: ArrayLike) -> Roots:
        """Inverse kinematics: all postures of the legs for a pose.

        Parameters
        ----------
        pose : array_like, shape (..., 3) = (x, y, phi)

        Returns
        -------
        Roots
            values (..., 8, 6): (drive angle, elbow angle) of legs 1, 2, 3. Each
            leg is a type-8 equation; place number 4 e1 + 2 e2 + e3 has leg i with
            elbow angle >= 0 for e_i = 0 and <= 0 for e_i = 1. 8 solutions inside
            the reach of all legs, half as many for each stretched or folded leg.
        """
        target = _legs(self, pose)
        legs = type8(self.proximal, self.distal, target[..., 0], target[..., 1])
        choices = np.array(list(product((0, 1), repeat=3)))
        number = np.arange(3)
        exists = np.asarray(legs.exists[..., number, choices].all(axis=-1))
        values = legs.values[..., number, choices, :].reshape(exists.shape + (6,))
        unsolved = [Status.UNREACHABLE, Status.INFINITE, Status.BOUNDARY]
        status = np.select(
            [(legs.status == each).any(-1) for each in unsolved],
            unsolved,
            Status.SOLVED,
        )
        free = np.where(status == Status.INFINITE, "drive angle of a folded leg", "")
        return Roots(np.where(exists[..., None], values, 0.0), exists, status, free)


def _half_angle_basis() -> np.ndarray:
    plus, minus = np.array([1j, 1]), np.array([-1j, 1])
    rows = []
    for k in range(-3, 4):
        polynomial = np.array([1.0 + 0j])
        for factor in [plus] * (3 + k) + [minus] * (3 - k):
            polynomial = np.convolve(polynomial, factor)
        rows.append(polynomial)
    return np.array(rows)


_HALF_ANGLE = _half_angle_basis()


def _triangles(base: ArrayLike, platform: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    triangles = []
    for name, corners in (("base", base), ("platform", platform)):
        points = np.asarray(corners, float)
        if points.shape != (3, 2) or not np.isfinite(points).all():
            raise ValueError(f"{name} is three points of the plane, shape (3, 2)")
        if np.ptp(points, axis=0).max() == 0:
            raise ValueError(f"the three points of the {name} coincide: nothing fixes phi")
        triangles.append(points)
    if len(np.unique(np.concatenate(triangles, axis=-1), axis=0)) < 3:
        raise ValueError("two legs join the same two points: one of them controls nothing")
    return triangles[0], triangles[1]


def _bars(lengths: ArrayLike, name: str) -> np.ndarray:
    bars = np.asarray(lengths, float)
    if bars.shape != (3,) or not (bars > 0).all():
        raise ValueError(f"{name} is three positive lengths, found {lengths!r}")
    return bars


def _legs(robot: ThreeRPR | ThreeRRR, pose: ArrayLike) -> np.ndarray:
    """Vectors A_i B_i of a pose: (..., 3) -> (..., 3, 2)."""
    pose = np.asarray(pose, float)
    if pose.shape[-1:] != (3,) or not np.isfinite(pose).all():
        raise ValueError(f"a pose is three finite numbers (x, y, phi), found shape {pose.shape}")
    return pose[..., None, :2] + _rotated(pose[..., 2], robot.platform) - robot.base


def _lengths(lengths: ArrayLike) -> np.ndarray:
    lengths = np.asarray(lengths, float)
    if lengths.shape[-1:] != (3,):
        raise ValueError(f"three leg lengths are needed, found shape {lengths.shape}")
    if not np.isfinite(lengths).all() or (lengths < 0).any():
        raise ValueError("leg lengths are finite and not negative")
    return lengths


def _rotated(phi: np.ndarray, points: np.ndarray) -> np.ndarray:
    """R(phi) applied to points (m, 2): phi of any shape (...) -> (..., m, 2)."""
    return points @ np.swapaxes(rotation_2d(phi), -1, -2)


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _first_of_equals(candidates: np.ndarray, closed: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """True for candidates (N, m, 3) with no closed one before them at the same pose."""
    gap = np.abs(candidates[:, :, None] - candidates[:, None])
    gap[..., :2] /= scale[:, None, None, None]
    gap[..., 2] = np.abs(wrap(gap[..., 2]))
    near = (gap < _MERGED).all(axis=-1) & closed[:, None, :]
    return ~np.tril(near, k=-1).any(axis=-1)
