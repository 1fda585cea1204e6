"""How far joint solutions are from their target, in metres and radians."""

from __future__ import annotations

import numpy as np

from dhkit.geometry import wrap


def distance_and_turn(hands: np.ndarray, position: tuple[float, float, float], heading: float) -> np.ndarray:
    """Distance to a position plus the angle to a heading about z0, (k,), of hands that turn about z0 only, (k, 4, 4)."""
    turn = np.arctan2(hands[:, 1, 0], hands[:, 0, 0]) - heading
    return np.linalg.norm(hands[:, :3, 3] - position, axis=1) + np.abs(wrap(turn))
