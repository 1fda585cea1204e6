"""Curves for robots to draw. Numbers only, so that the grader can use them too."""

from __future__ import annotations

import numpy as np

PEN_CURVES = ("eight", "wave", "spiral")


def pen_path(shape: str, count: int = 121) -> np.ndarray:
    """A curve on the surface of the pen robot in the coordinates of that surface.

    Parameters
    ----------
    shape : str
        One of `PEN_CURVES`.
    count : int
        Number of points.

    Returns
    -------
    ndarray, shape (count, 2), in radians
        theta1, and the angle phi = theta2 + theta3 of the pen from the vertical: between 70 and 135 degrees.
    """
    if shape not in PEN_CURVES:
        raise ValueError(f"shape: one of {', '.join(PEN_CURVES)}, found {shape!r}")
    s = np.linspace(0, 2 * np.pi, count)
    if shape == "eight":
        way = 0.36 * np.sin(s), 0.44 * np.sin(2 * s)
    elif shape == "wave":
        way = 0.4 * (s / np.pi - 1), 0.34 * np.sin(3 * s)
    else:
        fade = 1 - 0.4 * s / np.pi
        way = 0.38 * fade * np.cos(2 * s), 0.5 * fade * np.sin(2 * s)
    return np.stack([way[0] - 0.38, way[1] + 1.8], axis=-1)
