"""Two joint axes as lines in space, and what the modified DH convention takes of their common normal.

A line is a point on it and a direction of any length, each of shape (3,), in metres. Source: parameter rules of the
MECA 953 slides, with X_i along the common normal from Z_i to Z_(i+1), whatever the cross product says.
"""

from __future__ import annotations

import numpy as np

from .geometry import Line, common_normal, link_axis, rigid_transform, unit_line


def link(first: Line, second: Line) -> tuple[float, float]:
    """Parameters of the link that holds both axes.

    Parameters
    ----------
    first, second : Line
        Axes of the joints before and after the link.

    Returns
    -------
    a, alpha : float
        Metres, a >= 0, and radians.

    Raises
    ------
    ValueError
        For axes on one line, where X is free, or a direction that is the zero vector.
    """
    feet, x = common_normal(first, second).feet, link_axis(first, second)
    u, v = unit_line(first)[1], unit_line(second)[1]
    return float((feet[1] - feet[0]) @ x), float(np.arctan2(np.cross(u, v) @ x, u @ v))


def link_frame(first: Line, second: Line) -> np.ndarray:
    """Frame of the link that holds both axes: Z along the first axis, X along the common normal, O at its foot.

    Parameters and errors as for `link`.

    Returns
    -------
    array, shape (4, 4)
    """
    z, x = unit_line(first)[1], link_axis(first, second)
    return rigid_transform(np.column_stack([x, np.cross(z, x), z]), common_normal(first, second).feet[0])
