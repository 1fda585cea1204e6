"""What follows from a student's own earlier answer, for `question.Follow`: arrays of values in, arrays of values out."""

from __future__ import annotations

import numpy as np

from dhkit.geometry import modified_dh


def product_of_table(rows: np.ndarray) -> np.ndarray:
    """The transform of a whole DHm table: rows (N, n, 5) -> (N, 4, 4)."""
    result = np.eye(4)
    for row in np.moveaxis(rows, 1, 0):
        result = result @ modified_dh(*row.T[1:])
    return result


def position(matrices: np.ndarray) -> np.ndarray:
    """The position of a transform: (N, 4, 4) -> (N, 3)."""
    return matrices[:, :3, 3]


def heading(matrices: np.ndarray) -> np.ndarray:
    """The angle of a transform that turns about z only: (N, 4, 4) -> (N,)."""
    return np.arctan2(matrices[:, 1, 0].real, matrices[:, 0, 0].real)
