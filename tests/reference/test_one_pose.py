"""The postures of one pose, found with Python's own numbers, are those of the arrays."""

import numpy as np
import pytest

from autograder.reference import DHTable, RoundedInput, robots

pytestmark = pytest.mark.filterwarnings("error")

ARMS = ["RX90", "KR210", "PUMA", "EPFL_ARM"]


def agree(robot, T):
    """The same postures in the same order; beside the aligned wrist both err by the quotient of rounding and sine."""
    usual = robot.inverse(T).q
    found = robot.postures(T)
    assert found.shape == usual.shape
    np.testing.assert_allclose(found, usual, atol=1e-7)


@pytest.mark.parametrize("name", ARMS)
def test_random_poses(name):
    robot = getattr(robots, name)
    for T in robot.forward(np.random.default_rng(1).uniform(-np.pi, np.pi, (200, 6))):
        agree(robot, T)


@pytest.mark.parametrize("name", ARMS)
def test_round_poses_where_something_is_special(name):
    robot = getattr(robots, name)
    for T in robot.forward(np.random.default_rng(2).choice(np.radians([0, 30, 45, -45, 90, 180]), (100, 6))):
        agree(robot, T)


def test_tables_in_another_sense_and_with_base_and_tool():
    turned = robots.spherical_wrist(0.2).forward([0.3, 0.8, -1.1])
    puma = robots.PUMA
    rows = [(row.sigma, row.a, row.alpha, row.d, -row.theta + 0.3) for row in puma.table.rows]
    robot = type(puma)(DHTable(rows, "puma", base=turned, tool=turned, values=puma.table.values))
    for T in robot.forward(np.random.default_rng(3).uniform(-np.pi, np.pi, (100, 6))):
        agree(robot, T)


def test_what_is_out_of_reach_has_none_and_what_is_no_pose_is_refused():
    robot, far = robots.RX90, np.eye(4)
    far[0, 3] = 5.0
    assert robot.postures(far).shape == (0, 6)
    with pytest.raises(ValueError, match="column 1 has the length 2"):
        robot.postures(np.diag([2.0, 1, 1, 1]))
    with pytest.raises(ValueError, match="finite"):
        robot.postures(np.full((4, 4), np.nan))
    with pytest.raises(ValueError, match="expected poses"):
        robot.postures(np.eye(3))
    rounded = np.round(robot.forward([0.3, 0.4, 0.5, 0.6, 0.7, 0.8]), 4)
    with pytest.warns(RoundedInput):
        assert len(robot.postures(rounded)) == 8


def test_other_robots_have_them_too():
    np.testing.assert_array_equal(
        robots.SCARA.postures([0.3, 0.4, -0.1, 1.0]), robots.SCARA.inverse([0.3, 0.4, -0.1, 1.0]).q
    )
