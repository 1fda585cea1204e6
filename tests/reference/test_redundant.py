"""Seven joints: every pose has a family, whose members the named joint chooses."""

import numpy as np
import pytest
import sympy as sp

from autograder.reference import DHTable, Robot, Status
from dhm.redundant import RedundantArm

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("error")]

PI, HALF = np.pi, np.pi / 2
ARMS = {
    "iiwa": [
        *[(0, 0, 0, 0.34, 0), (0, 0, -HALF, 0, 0), (0, 0, HALF, 0.4, 0), (0, 0, HALF, 0, 0)],
        *[(0, 0, -HALF, 0.4, 0), (0, 0, -HALF, 0, 0), (0, 0, HALF, 0.126, 0)],
    ],
    "Panda": [
        *[(0, 0, 0, 0.333, 0), (0, 0, -HALF, 0, 0), (0, 0, HALF, 0.316, 0), (0, 0.0825, HALF, 0, 0)],
        *[(0, -0.0825, -HALF, 0.384, 0), (0, 0, HALF, 0, 0), (0, 0.088, HALF, 0.107, 0)],
    ],
    "nothing meets": [
        *[(0, 0, 0, 0.333, 0), (0, 0.1, -HALF, 0, 0), (0, 0.05, HALF, 0.316, 0), (0, 0.0825, HALF, 0, 0)],
        *[(0, -0.0825, -HALF, 0.384, 0), (0, 0.03, HALF, 0.02, 0), (0, 0.088, HALF, 0.107, 0)],
    ],
    "on a rail": [
        *[(1, 0, 0, 0, 0), (0, 0, HALF, 0.09, 0), (0, 0, HALF, 0, 0), (0, -0.42, 0, 0, 0)],
        *[(0, -0.39, 0, 0.11, 0), (0, 0, HALF, 0.09, 0), (0, 0, -HALF, 0.08, 0)],
    ],
}
FREE = {"iiwa": "q3 free", "Panda": "q7 free", "nothing meets": "q3 free", "on a rail": "q1 free"}


def robot_of(name, **options):
    joints = sp.symbols("q1:8")
    entries = [(s, a, alpha, d + q * s, theta + q * (1 - s)) for (s, a, alpha, d, theta), q in zip(ARMS[name], joints)]
    return Robot(DHTable(entries, name, joints, **options))


def gaps(name, q, wanted):
    slides = np.array([row[0] for row in ARMS[name]], dtype=bool)
    return np.abs(np.where(slides, q - wanted, np.angle(np.exp(1j * (q - wanted))))).max(axis=-1)


@pytest.mark.parametrize("choice", ["random", "round"])
@pytest.mark.parametrize("name", ARMS)
def test_members_reach_the_pose_and_the_one_near_a_member_is_that(name, choice):
    robot, rng = robot_of(name), np.random.default_rng(1)
    q = rng.uniform(-PI, PI, (25, 7)) if choice == "random" else rng.choice(np.radians([0, 30, -45, 90, 180]), (25, 7))
    T = robot.forward(q)
    for near in (None, q):
        batch = robot.inverse_batch(T, near=near)
        assert batch.valid.any(axis=1).all() and (batch.status == Status.INFINITE).all()
        pose, branch = np.nonzero(batch.valid)
        assert np.abs(robot.forward(batch.q[pose, branch]) - T[pose]).max() < 2e-9
    assert np.where(batch.valid, gaps(name, batch.q, q[:, None]), 9).min(axis=1).max() < 1e-6
    assert all(FREE[name] in text for text in batch[0].free_by_row)


def test_limits_and_the_nearest_member():
    robot = robot_of("iiwa", limits=[(-2.6, 2.6)] * 7)
    q = np.random.default_rng(4).uniform(-2, 2, 7)
    T = robot.forward(q)
    inside = robot.inverse(T, limits=True)
    assert len(inside) and (np.abs(inside.q) <= 2.6 + 1e-6).all()
    assert np.abs(robot.forward(inside.q) - T).max() < 2e-9
    assert robot.nearest(T, q).distance < 1e-6


def test_the_free_joint_gives_a_curve_of_postures():
    """The iiwa's elbow goes round while its hand stays where it is."""
    robot, q = robot_of("iiwa"), np.array([0.2, 0.5, 0.0, 1.2, 0.3, 0.8, -0.4])
    T = robot.forward(q)
    members = [robot.inverse(T, near=[*q[:2], value, *q[3:]]).q for value in (-0.1, 0.1)]
    assert all(np.abs(each[:, 2] - value).max() < 1e-9 for each, value in zip(members, (-0.1, 0.1)))
    elbows = [robot.table.chain.frames(each[gaps("iiwa", each, q).argmin()])[3, :3, 3] for each in members]
    assert np.linalg.norm(elbows[0] - elbows[1]) > 0.005
    with pytest.raises(ValueError, match="no arm of seven joints"):
        rows = [(0, 0.1 * i, 0.3 * i, 0.1, None) for i in range(1, 5)] + [(1, 0.1, i, None, 0.1) for i in (1, 2, 0.7)]
        Robot(DHTable(rows)).inverse(np.eye(4))


def test_held_joints_choose_an_arm_that_is_solved():
    assert isinstance(robot_of("iiwa").inverse_model, RedundantArm) and robot_of("Panda").inverse_model.free_joint == 6
