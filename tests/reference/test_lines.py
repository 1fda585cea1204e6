"""Common normals of two axes against minimisation, hand-made cases and the rows of a chain."""

import numpy as np
import pytest
from scipy.optimize import minimize

from autograder.reference.lines import common_normal, link, link_axis, link_frame

UP = (0, 0, 1)


@pytest.mark.parametrize("seed", range(6))
def test_the_normal_carries_the_shortest_segment(seed):
    p, u, q, v = np.random.default_rng(seed).uniform(-1, 1, (4, 3))
    feet = common_normal((p, u), (q, v))
    best = minimize(lambda s: np.sum((p + s[0] * u - q - s[1] * v) ** 2), (0, 0), tol=1e-14)
    assert np.linalg.norm(feet[1] - feet[0]) == pytest.approx(np.sqrt(best.fun), abs=1e-6)
    assert [(feet[1] - feet[0]) @ u, (feet[1] - feet[0]) @ v] == pytest.approx([0, 0], abs=1e-9)
    for foot, point, along in zip(feet, (p, q), (u, v)):
        assert np.cross(foot - point, along) == pytest.approx(np.zeros(3), abs=1e-9)


@pytest.mark.parametrize(
    ("second", "a", "alpha"),
    [
        (((0.5, 1, 0.2), (0, -1, 1)), 0.5, np.pi / 4),
        (((0.5, 1, 0.2), (0, 1, 1)), 0.5, -np.pi / 4),
        (((0.3, 0.4, 7), (0, 0, 2)), 0.5, 0),
        (((0.3, 0.4, 7), (0, 0, -2)), 0.5, np.pi),
        (((0.3, 0, 0.2), (1, 0, 0)), 0, np.pi / 2),
    ],
)
def test_links_that_can_be_seen(second, a, alpha):
    assert link(((0, 0, 0), UP), second) == pytest.approx((a, alpha))


def test_axes_on_one_line_leave_x_free():
    with pytest.raises(ValueError, match="any direction"):
        link_axis(((0, 0, 0), UP), ((0, 0, 1), UP))
    with pytest.raises(ValueError, match="zero vector"):
        common_normal(((0, 0, 0), UP), ((0, 0, 1), (0, 0, 0)))


@pytest.mark.parametrize("seed", range(4))
def test_axes_of_a_chain_give_back_its_links(seed):
    rows = np.random.default_rng(seed).uniform([0.1, -1.4, 0.1, -3], [0.8, 1.4, 0.8, 3], (2, 4))
    frames = [np.eye(4)]
    for a, alpha, d, theta in rows:
        c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
        frames.append(
            frames[-1] @ [[c, -s, 0, a], [s * ca, c * ca, -sa, -sa * d], [s * sa, c * sa, ca, ca * d], [0, 0, 0, 1]]
        )
    axes = [(frame[:3, 3], frame[:3, 2]) for frame in frames]
    for row, frame, first, second in zip(rows, frames, axes, axes[1:]):
        assert link(first, second) == pytest.approx(tuple(row[:2]))
        assert link_frame(first, second) == pytest.approx(frame)
