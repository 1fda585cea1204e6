"""Poses with few decimals are read as the nearest rigid ones, and that is said; what is no pose is refused with its part."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from autograder.reference import RoundedInput, robots

pytestmark = pytest.mark.filterwarnings("error")


def posed(count, seed=0):
    T = np.tile(np.eye(4), (count, 1, 1))
    T[:, :3, :3] = Rotation.random(count, random_state=seed).as_matrix()
    T[:, :3, 3] = np.random.default_rng(seed).uniform(-0.3, 0.3, (count, 3)) + [0.2, 0.1, 0.3]
    return T


def test_poses_with_four_decimals_are_read_as_the_nearest_rigid_ones():
    """SciPy's own projection says which rotation is the nearest and how far the numbers moved."""
    exact = posed(200)
    rounded = exact.round(4)
    nearest = rounded.copy()
    nearest[:, :3, :3] = Rotation.from_matrix(rounded[:, :3, :3]).as_matrix()
    off = np.linalg.svd(rounded[:, :3, :3], compute_uv=False) - 1
    with pytest.warns(RoundedInput, match="200 of 200 poses|1[0-9][0-9] of 200 poses") as said:
        batch = robots.RX90.inverse_batch(rounded)
    moved = float(str(said[0].message).split("by at most ")[1].split()[0])
    assert np.abs(off).max() / 3 < moved < 1e-4
    reached = batch.valid.any(axis=1)
    assert reached.sum() > 150
    T = robots.RX90.forward(batch.q[batch.valid])
    np.testing.assert_allclose(T, np.repeat(nearest, batch.count, axis=0), atol=2e-5)
    np.testing.assert_allclose(T, np.repeat(exact, batch.count, axis=0), atol=2e-4)
    np.testing.assert_allclose(
        T[:, :3, :3] @ T[:, :3, :3].transpose(0, 2, 1), np.tile(np.eye(3), (len(T), 1, 1)), atol=1e-14
    )


def test_one_pose_as_slides_print_it():
    q = np.radians([20, 40, -30, 50, 60, -70])
    with pytest.warns(RoundedInput, match="the pose is read as the nearest rigid one: .* by at most [0-9.]+e-05"):
        answer = robots.RX90.inverse(robots.RX90.forward(q).round(4))
    assert len(answer) == 8 and np.abs(answer.q - q).max(axis=1).min() < 2e-3
    with pytest.warns(RoundedInput):
        assert robots.RX90.nearest(robots.RX90.forward(q).round(4), q).distance < 2e-3
    upright = robots.SCARA.forward([0.4, 0.7, 0.1, 0.3]).round(4)
    with pytest.warns(RoundedInput):
        assert len(robots.SCARA.inverse(upright)) == 2  # it is not tilted by being read


@pytest.mark.parametrize("decimals", [6, 8, 12])
def test_poses_with_more_decimals_are_taken_as_they_are(decimals):
    assert robots.RX90.inverse_batch(posed(50).round(decimals)).valid.any()


BENT = np.eye(4)
BENT[0, 1] = 0.05


@pytest.mark.parametrize(
    "T, message",
    [
        (np.diag([1, 1, 1, 2]), "the last row is 0 0 0 2, not 0 0 0 1"),
        (np.diag([1, 1, 2, 1]), "rotation part .*: column 3 has the length 2, not 1"),
        (np.diag([1.001, 1, 1, 1]), "column 1 has the length 1.001, not 1"),
        (np.diag([1, 1, -1, 1]), "left-handed: its determinant is -1"),
        (BENT, r"columns 1 and 2 are 87.1\d* degrees apart, not 90"),
        (np.zeros((4, 4)), "the last row is 0 0 0 0"),
    ],
)
def test_a_refusal_says_which_part_is_wrong_and_by_how_much(T, message):
    with pytest.raises(ValueError, match=message):
        robots.RX90.inverse(T)
    batch = np.tile(np.eye(4), (5, 1, 1))
    batch[3] = T
    with pytest.raises(ValueError, match="pose 3 of 0 to 4 .*rigid"):
        robots.RX90.inverse_batch(batch)
