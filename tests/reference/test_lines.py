"""Links of two axes against hand-made cases and the rows of a chain."""

import numpy as np
import pytest

from dhm.lines import link, link_frame

UP = (0, 0, 1)


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
