"""Workspace: reachable points under joint limits, their outline, exact areas of the RR arm.

A robot is anything with ``forward(q)``, or that function itself: q of shape
(..., n) to poses (..., 4, 4) or directly to points (..., 2) or (..., 3).
Joint limits are pairs (lower, upper), shape (n, 2). Lengths in metres, angles
in radians. Every array is ready to plot: ``plt.scatter(*points.T)``.

Sources: DH-m slides (Romanian), where the workspace is the image of a grid of
joint values and the RR arm the example; what they leave open is the area.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from .geometry import lies_between, two_link


class HasForward(Protocol):
    """A robot with forward kinematics."""

    def forward(self, q: ArrayLike, /) -> np.ndarray:
        """Poses (..., 4, 4) or points (..., 2 or 3) for joint values q (..., n)."""
        ...


ForwardModel: TypeAlias = HasForward | Callable[[np.ndarray], np.ndarray]

_BLOCK = 1 << 15  # joint vectors at a time: bounds the memory, keeps the work in the cache


def grid(robot: ForwardModel, limits: ArrayLike, counts: ArrayLike) -> np.ndarray:
    """Image of a regular grid of joint values, both limits included.

    Parameters
    ----------
    robot : object with ``forward``, or the function
    limits : array_like, shape (n, 2)
    counts : n numbers of values per joint

    Returns
    -------
    array, shape (counts[0], ..., counts[n-1], 2 or 3): the point p_{i,j,...}
    belongs to the i-th value of joint 1 and the j-th value of joint 2.
    """
    ranges = _limits(limits)
    shape = tuple(int(c) for c in np.broadcast_to(counts, len(ranges)))
    if min(shape) < 1:
        raise ValueError(f"every joint needs at least one value, found counts {shape}")
    values = [np.linspace(low, high, c) for (low, high), c in zip(ranges, shape)]

    def joints(block: slice) -> np.ndarray:
        places = np.unravel_index(np.arange(block.start, block.stop), shape)
        return np.stack([v[p] for v, p in zip(values, places)], axis=-1)

    return _in_blocks(robot, joints, int(np.prod(shape))).reshape((*shape, -1))


def sample(robot: ForwardModel, limits: ArrayLike, count: int, rng: np.random.Generator) -> np.ndarray:
    """Points of `count` joint vectors drawn uniformly between the limits.

    Parameters
    ----------
    robot : object with ``forward``, or the function
    limits : array_like, shape (n, 2)
    count : int
    rng : numpy.random.Generator

    Returns
    -------
    array, shape (count, 2 or 3), metres
    """
    low, high = _limits(limits).T

    def joints(block: slice) -> np.ndarray:
        return rng.uniform(low, high, (block.stop - block.start, len(low)))

    return _in_blocks(robot, joints, count)


def planar_points(lengths: ArrayLike, q: ArrayLike) -> np.ndarray:
    """End point of a planar arm with n parallel revolute joints.

    It costs its 2n cosines and sines per point and little else.

    Parameters
    ----------
    lengths : array_like, shape (n,), metres
    q : array_like, shape (..., n), radians
        Each angle from the link before.

    Returns
    -------
    array, shape (..., 2), metres
    """
    lengths, q = np.asarray(lengths, float), np.asarray(q, float)
    if q.shape[-1:] != lengths.shape:
        raise ValueError(f"{len(lengths)} lengths need q of shape (..., {len(lengths)}), found {q.shape}")
    columns = q.reshape(-1, len(lengths))
    points = np.empty((len(columns), 2))
    for block in _blocks(len(columns)):
        angle = np.zeros(block.stop - block.start)
        x, y, part = np.zeros_like(angle), np.zeros_like(angle), np.empty_like(angle)
        for length, turn in zip(lengths, columns[block].T):
            angle += turn
            x += np.multiply(np.cos(angle, out=part), length, out=part)
            y += np.multiply(np.sin(angle, out=part), length, out=part)
        points[block, 0], points[block, 1] = x, y
    return points.reshape(q.shape[:-1] + (2,))


def rr_grid(l1: float, l2: float, q1: ArrayLike, q2: ArrayLike) -> np.ndarray:
    """All points p_ij of the RR arm for q1 (n,) and q2 (m,): shape (n, m, 2).

    As complex numbers ``p_ij = e^{i q1_i} (l1 + l2 e^{i q2_j})``: an outer product,
    with n + m cosines and sines where the formula of the slides takes n + n m.
    """
    phasor = np.exp(1j * np.asarray(q1, float))
    arm = l1 + l2 * np.exp(1j * np.asarray(q2, float))
    return np.multiply.outer(phasor, arm).view(float).reshape(phasor.size, arm.size, 2)


def cross_section(robot: ForwardModel, limits: ArrayLike, count: int, rng: np.random.Generator) -> np.ndarray:
    """Half-plane section (rho, z) of a spatial arm whose joint 1 turns about base axis z.

    The workspace is this section turned about z through the range of joint 1 (all of it where that is a full turn).

    Parameters
    ----------
    robot : object with ``forward``, or the function
    limits : array_like, shape (n, 2)
    count : int
    rng : numpy.random.Generator

    Returns
    -------
    array, shape (count, 2)
        Of random postures, metres.

    Raises
    ------
    ValueError
        If joint 1 changes rho or z: the section would depend on it.
    """
    ranges = _limits(limits)
    probe = np.tile(ranges.mean(axis=1), (2, 1))
    probe[1, 0] += 1.0
    held = ranges.copy()
    held[0] = ranges[0, 0]
    start = rng.bit_generator.state
    tried = _section(_positions(robot, probe))
    rng.bit_generator.state = start
    if np.abs(tried[0] - tried[1]).max() > 1e-9 * (1 + np.abs(tried).max()):
        raise ValueError("joint 1 does not turn about the base axis z: no common cross-section")
    return _section(sample(robot, held, count, rng))


@dataclass(frozen=True)
class Cells:
    """A plane cloud on a square raster.

    corner : array (2,), lower left corner; size : edge of a cell in metres;
    filled : bool array (nx, ny), cells that hold a point.
    """

    corner: np.ndarray
    size: float
    filled: np.ndarray

    @property
    def area(self) -> float:
        """Area of the filled cells, square metres: about half a cell too wide all around."""
        return float(self.filled.sum() * self.size**2)

    def boundary(self) -> np.ndarray:
        """Centres of the filled cells beside an empty one, shape (k, 2): outline and holes."""
        padded = np.pad(self.filled, 1)
        enclosed = padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
        return self.corner + (np.argwhere(self.filled & ~enclosed) + 0.5) * self.size


def cells(points: ArrayLike, size: float) -> Cells:
    """Raster of a plane cloud (..., 2), or of (rho, z), with square cells of `size` metres.

    Take enough points (ten per cell) or the raster has holes that the workspace has not.
    """
    points = np.asarray(points, float).reshape(-1, 2)
    if not size > 0:
        raise ValueError(f"the size of a cell is positive, found {size}")
    corner = np.floor(points.min(axis=0) / size) * size
    places = np.floor((points - corner) / size).astype(int)
    filled = np.zeros(places.max(axis=0) + 1, bool)
    filled[places[:, 0], places[:, 1]] = True
    return Cells(corner, float(size), filled)


@dataclass(frozen=True)
class RRArm:
    """Exact workspace of the planar arm with two revolute joints and joint ranges.

    l1, l2 : link lengths, positive metres
    q1, q2 : (lower, upper), radians; wider than a turn counts as a full turn

    A point at radius r is met by up to two sheets, elbow angle +s and -s with
    ``r^2 = l1^2 + l2^2 + 2 l1 l2 cos s``. Where the range of q2 reaches both, the
    sheets may overlap; `area` counts such points once.

    Raises ValueError for a length that is not positive or an empty range.
    """

    l1: float
    l2: float
    q1: tuple[float, float] = (-np.pi, np.pi)
    q2: tuple[float, float] = (-np.pi, np.pi)

    def __post_init__(self) -> None:
        for name in ("l1", "l2"):
            if not 0 < getattr(self, name) < np.inf:
                raise ValueError(f"{name} is a positive length, found {getattr(self, name)}")
        for name in ("q1", "q2"):
            low, high = getattr(self, name)
            if not -np.inf < low <= high < np.inf:
                raise ValueError(f"{name} is a range (lower, upper), found {(low, high)}")

    def radii(self) -> tuple[float, float]:
        """Inner and outer radius of the workspace, exact."""
        r = self._radius(np.array(self._corners()))
        return float(r.min()), float(r.max())

    def sheet_area(self) -> float:
        """Area by the textbook formula ``l1 l2 (q1max - q1min) |cos q2min - cos q2max|``.

        Raises
        ------
        ValueError
            When the range of q2 has 0 or pi (modulo 2 pi) inside: then there are two
            sheets, which overlap unless the range of q1 is too small; use `area`.
        """
        low, high = self.q2
        if (np.floor(low / np.pi) + 1) * np.pi < high:
            raise ValueError(
                "the range of q2 has a stretched or folded arm inside: two sheets that may overlap, use area()"
            )
        return float(self.l1 * self.l2 * self._span * abs(np.cos(self.q2[0]) - np.cos(self.q2[1])))

    def area(self) -> float:
        """Exact area in square metres, points met by both sheets counted once.

        At radius r one sheet covers an arc of the width W of the range of q1. Two
        sheets are turned by +psi and -psi, psi = atan2(l2 sin s, l1 + l2 cos s), and
        together cover ``2 W - (W - 2 psi)+ - (W - 2 pi + 2 psi)+``. Between the ends
        of the ranges and the angles where a bracket changes sign this is linear in
        psi, and ``psi r dr`` has an elementary integral.
        """
        ends, middles = self._pieces()
        total = 0.0
        for low, high, s in zip(ends[:-1], ends[1:], middles):
            sheets = sum(self._sheets(s))
            arc, slope = sheets * self._span, 0.0
            if sheets == 2:
                psi = self._psi(s)
                if self._span > 2 * psi:
                    arc, slope = arc - self._span, slope + 2
                if self._span > 2 * np.pi - 2 * psi:
                    arc, slope = arc - self._span + 2 * np.pi, slope - 2
            total += arc * self.l1 * self.l2 * (np.cos(low) - np.cos(high)) + slope * (
                self._psi_integral(high) - self._psi_integral(low)
            )
        return float(total)

    def contains(self, points: ArrayLike, tolerance: float = 1e-9) -> np.ndarray:
        """Whether points (..., 2) can be reached, within `tolerance` radians and metres."""
        target = np.asarray(points, float) @ (1, 1j)
        arm = two_link(target, self.l1, self.l2, tol=tolerance)
        first = lies_between(arm.first, *self.q1, tolerance) | (np.abs(target) <= tolerance)
        return arm.valid[0] & (lies_between(arm.bend, *self.q2, tolerance) & first).any(axis=0)

    def boundary(self, step: float = 0.01) -> list[np.ndarray]:
        """Outline of the workspace: list of curves (k, 2), points at most `step` radians apart.

        The arcs of the joint limits and of the stretched and folded arm, without the
        parts that lie inside the workspace.
        """
        inner = [s for s in (0.0, np.pi) if lies_between(s, *self.q2)]
        curves: list[tuple[ArrayLike, ArrayLike]]
        curves = [(self._ramp(self.q1, step), q2) for q2 in dict.fromkeys([*self.q2, *inner])]
        if self._span < 2 * np.pi:
            curves += [(q1, self._ramp(self.q2, step)) for q1 in self.q1]
        outline = []
        for q1, q2 in curves:
            q = np.stack(np.broadcast_arrays(q1, q2), axis=-1)
            points = planar_points((self.l1, self.l2), q)
            edge = self._on_edge(points)
            cuts = np.flatnonzero(np.diff(edge)) + 1
            outline += [
                run for run, kept in zip(np.split(points, cuts), np.split(edge, cuts)) if kept[0] and len(run) > 1
            ]
        return outline

    @property
    def _span(self) -> float:
        """Range of joint 1, at most a full turn."""
        return min(self.q1[1] - self.q1[0], 2 * np.pi)

    def _corners(self) -> list[float]:
        """Elbow angles in [0, pi] between which the radius is extreme or a sheet ends."""
        ends = [abs(float(np.angle(np.exp(1j * q)))) for q in self.q2]
        return ends + [s for s in (0.0, np.pi) if lies_between(s, *self.q2, 1e-12)]

    def _pieces(self) -> tuple[np.ndarray, np.ndarray]:
        """Ends and middles of the elbow angles between which `area` has one formula."""
        ends = {0.0, np.pi, *self._corners()}
        for psi in (self._span / 2, np.pi - self._span / 2):
            lean = self.l1 * np.sin(psi) / self.l2
            if abs(lean) <= 1:
                ends |= {psi + np.arcsin(lean), psi + np.pi - np.arcsin(lean)}
        inside = np.array(sorted(s for s in ends if 0 <= s <= np.pi))
        apart = inside[np.append(True, np.diff(inside) > 1e-12)]
        return apart, (apart[:-1] + apart[1:]) / 2

    def _sheets(self, s: float) -> tuple[bool, bool]:
        return bool(lies_between(s, *self.q2)), bool(lies_between(-s, *self.q2))

    def _radius(self, s: float | np.ndarray) -> np.ndarray:
        return np.sqrt(np.maximum(self.l1**2 + self.l2**2 + 2 * self.l1 * self.l2 * np.cos(s), 0))

    def _psi(self, s: float) -> float:
        return np.arctan2(self.l2 * np.sin(s), self.l1 + self.l2 * np.cos(s))

    def _psi_integral(self, s: float) -> float:
        """Integral of psi l1 l2 sin(s) ds."""
        return (self.l2**2 * s + self.l1 * self.l2 * np.sin(s) - self._psi(s) * self._radius(s) ** 2) / 2

    def _on_edge(self, points: np.ndarray) -> np.ndarray:
        """Whether a point of some limit curve has unreachable points beside it."""
        around = np.exp(1j * np.arange(16) * np.pi / 8) * 1e-6 * (self.l1 + self.l2)
        beside = points[:, None] + np.stack([around.real, around.imag], axis=-1)
        return np.asarray(~self.contains(beside).all(axis=1))

    @staticmethod
    def _ramp(limits: tuple[float, float], step: float) -> np.ndarray:
        low, high = limits[0], min(limits[1], limits[0] + 2 * np.pi)
        return np.linspace(low, high, max(2, int(np.ceil((high - low) / step)) + 1))


def _limits(limits: ArrayLike) -> np.ndarray:
    limits = np.asarray(limits, float)
    if limits.ndim != 2 or limits.shape[1] != 2 or not np.isfinite(limits).all():
        raise ValueError(f"limits are finite pairs (lower, upper), one per joint, found shape {limits.shape}")
    if (limits[:, 0] > limits[:, 1]).any():
        raise ValueError("a lower joint limit is above its upper one")
    return limits


def _blocks(total: int) -> list[slice]:
    return [slice(start, min(start + _BLOCK, total)) for start in range(0, total, _BLOCK)]


def _in_blocks(robot: ForwardModel, joints: Callable[[slice], np.ndarray], total: int) -> np.ndarray:
    if total < 1:
        raise ValueError(f"at least one point is needed, found {total}")
    return np.concatenate([_positions(robot, joints(block)) for block in _blocks(total)])


def _positions(robot: ForwardModel, q: np.ndarray) -> np.ndarray:
    """Points of poses (..., 4, 4), or the points themselves."""
    forward: Any = getattr(robot, "forward", robot)
    result = np.asarray(forward(q))
    if result.shape == q.shape[:-1] + (4, 4):
        return result[..., :3, 3]
    if result.shape[:-1] == q.shape[:-1] and result.shape[-1] in (2, 3):
        return result
    raise ValueError(
        f"forward gives shape {result.shape} for q of shape {q.shape}: expected "
        "poses (..., 4, 4) or points (..., 2 or 3)"
    )


def _section(points: np.ndarray) -> np.ndarray:
    return np.stack([np.hypot(points[..., 0], points[..., 1]), points[..., 2]], axis=-1)
