"""Two joint axes as lines in space: their common normal, and what of it the modified DH convention takes.

A line is a point on it and a direction of any length, each of shape (3,), in metres. Source: parameter rules of the
MECA 953 slides, with X_i along the common normal from Z_i to Z_(i+1), whatever the cross product says.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

Line = tuple[Sequence[float], Sequence[float]]

_PARALLEL = 1e-9  # sine of the angle under which two axes count as parallel
_TOUCHING = 1e-9  # metres under which two axes count as meeting


def common_normal(first: Line, second: Line) -> np.ndarray:
    """Feet of the common normal on both lines, (2, 3); between parallel lines, the one through the point of the first.

    Raises ValueError when a direction is the zero vector.
    """
    (p, u), (q, v) = _unit(first), _unit(second)
    cosine = u @ v
    if np.linalg.norm(np.cross(u, v)) < _PARALLEL:
        return np.array([p, q + ((p - q) @ v) * v])
    s, t = np.linalg.solve([[1, -cosine], [cosine, -1]], [(q - p) @ u, (q - p) @ v])
    return np.array([p + s * u, q + t * v])


def link_axis(first: Line, second: Line) -> np.ndarray:
    """X of the link that holds both axes, (3,): along the common normal from the first axis to the second.

    Where the axes meet, the sense that makes alpha positive. Raises ValueError for axes on one line: X is free there.
    """
    feet = common_normal(first, second)
    way = feet[1] - feet[0]
    if np.linalg.norm(way) < _TOUCHING:
        way = np.cross(_unit(first)[1], _unit(second)[1])
    if np.linalg.norm(way) < _PARALLEL:
        raise ValueError("the axes lie on one line: X may have any direction normal to it")
    return way / np.linalg.norm(way)


def link(first: Line, second: Line) -> tuple[float, float]:
    """(a, alpha) of the link that holds both axes: metres and radians, a >= 0."""
    feet, x = common_normal(first, second), link_axis(first, second)
    u, v = _unit(first)[1], _unit(second)[1]
    return float((feet[1] - feet[0]) @ x), float(np.arctan2(np.cross(u, v) @ x, u @ v))


def link_frame(first: Line, second: Line) -> np.ndarray:
    """Frame of the link that holds both axes, (4, 4): Z along the first axis, X along the common normal, O at its foot."""
    frame = np.eye(4)
    z, x = _unit(first)[1], link_axis(first, second)
    frame[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    frame[:3, 3] = common_normal(first, second)[0]
    return frame


def _unit(line: Line) -> tuple[np.ndarray, np.ndarray]:
    point, direction = (np.asarray(each, dtype=float) for each in line)
    length = np.linalg.norm(direction)
    if length == 0:
        raise ValueError("the direction of an axis is the zero vector")
    return point, direction / length
