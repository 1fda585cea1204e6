"""Six turns about any axes: soundness, recovery, completeness, and what is special at round poses."""

import numpy as np
import pytest
import sympy as sp

from autograder.reference import DHTable, Robot, Status, misfits
from dhm.general import GeneralArm

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("error")]

PI, HALF = np.pi, np.pi / 2
ARMS = {
    "offset wrist": [
        *[(0, 0, 0, 0.24, 0), (0, 0, HALF, 0.03, 0), (0, 0.28, PI, 0.02, 0)],
        *[(0, 0, HALF, 0.245, 0), (0, 0, HALF, 0.057, 0), (0, 0, -HALF, 0.235, 0)],
    ],
    "wrist offset along axis 5": [
        *[(0, 0, 0, 0.2, 0), (0, 0, -HALF, 0, 0), (0, 0.54, PI, 0, 0)],
        *[(0, 0, -HALF, -0.54, 0), (0, 0, HALF, 0.15, 0), (0, 0, -HALF, -0.16, 0)],
    ],
    "nothing meets": [
        *[(0, 0, 0, 0.2, 0), (0, 0.1, -HALF, 0, 0), (0, 0.54, 0, 0, 0)],
        *[(0, 0.1, -HALF, 0.54, 0), (0, 0.05, HALF, 0.15, 0), (0, 0.06, -HALF, 0.16, 0)],
    ],
    "sixteen postures": [
        *[(0, 0, 0, 0, 0), (0, 0.3, HALF, 0, 0), (0, 1, 0.0174, 0, 0)],
        *[(0, 0, HALF, 0.2, 0), (0, 1.5, 0.0174, 0, 0), (0, 0, HALF, 0, 0)],
    ],
    "bent UR5": [
        *[(0, 0, 0, 0.09, 0), (0, 0, HALF, 0, 0), (0, -0.42, 0, 0, 0)],
        *[(0, -0.39, 0.2, 0.11, 0), (0, 0, HALF, 0.09, 0), (0, 0, -HALF, 0.08, 0)],
    ],
}
ROUND = np.radians([0, 30, -30, 45, -45, 90, -90, 180])


def table(rows, **options):
    joints = sp.symbols(f"q1:{len(rows) + 1}")
    entries = [(s, a, alpha, d + q * s, theta + q * (1 - s)) for (s, a, alpha, d, theta), q in zip(rows, joints)]
    return DHTable(entries, joints=joints, **options)


def gaps(q, wanted):
    return np.abs(np.angle(np.exp(1j * (q - wanted)))).max(axis=-1)


def assert_sound(robot, batch, T):
    assert batch.valid.any(axis=1).all(), "a reachable pose is called unreachable"
    pose, branch = np.nonzero(batch.valid)
    assert np.abs(robot.forward(batch.q[pose, branch]) - T[pose]).max() < 2e-9


@pytest.mark.parametrize("name", ARMS)
def test_random_poses_have_all_their_postures(name):
    """Those that led to the pose, an even number, and what a search from beside them finds: the arm's other postures."""
    robot = Robot(table(ARMS[name], name=name))
    assert isinstance(robot.inverse_model, GeneralArm)
    q = np.random.default_rng(1).uniform(-PI, PI, (100, 6))
    T = robot.forward(q)
    batch = robot.inverse_batch(T)
    assert_sound(robot, batch, T)
    assert np.where(batch.valid, gaps(batch.q, q[:, None]), 9).min(axis=1).max() < 1e-6
    assert (batch.count % 2 == 0).all() and batch.count.max() >= 8
    # Every posture is as good as the first: each of a pose's postures leads back to the same list.
    again = robot.inverse_batch(robot.forward(batch.q[:, 0]))
    np.testing.assert_array_equal(again.count, batch.count)


def test_sixteen_postures_are_possible_and_all_found():
    robot = Robot(table(ARMS["sixteen postures"]))
    batch = robot.inverse_batch(robot.forward(np.random.default_rng(2).uniform(-PI, PI, (200, 6))))
    assert batch.count.max() == 16
    assert all(np.diff(each.q[:, 0]).min(initial=0) >= 0 for each in map(batch.__getitem__, range(20)))


@pytest.mark.parametrize("name", ARMS)
def test_a_search_from_many_starts_finds_no_posture_that_is_missing(name):
    """Damped steps with differences for derivatives, on the forward model alone."""
    robot = Robot(table(ARMS[name]))
    for T in robot.forward(np.random.default_rng(5).uniform(-PI, PI, (2, 6))):
        q = np.random.default_rng(7).uniform(-PI, PI, (250, 6))
        error, damping = (robot.forward(q) - T)[:, :3].reshape(-1, 12), np.full(len(q), 1e-2)
        for _ in range(80):
            moved = robot.forward(q[:, None] + 1e-6 * np.eye(6))[:, :, :3].reshape(-1, 6, 12)
            J = (moved - (error + T[:3].reshape(12))[:, None]) / 1e-6
            normal = J @ J.swapaxes(1, 2) + damping[:, None, None] * np.eye(6)
            tried = q - np.linalg.solve(normal, J @ error[..., None])[..., 0]
            left = (robot.forward(tried) - T)[:, :3].reshape(-1, 12)
            better = (left**2).sum(1) < (error**2).sum(1)
            q, error = np.where(better[:, None], tried, q), np.where(better[:, None], left, error)
            damping = np.clip(np.where(better, damping / 5, damping * 3), 1e-12, 1e3)
        postures = q[np.abs(error).max(axis=1) < 1e-9]
        found = robot.inverse(T)
        assert len(postures) and gaps(found.q[:, None], postures).min(axis=0).max() < 1e-5


@pytest.mark.parametrize("name", ARMS)
def test_round_poses_keep_the_posture_that_was_asked_for(name):
    """Roots coincide there, arms are straight, wrists aligned: every pose stays reachable, and `near` is found."""
    robot = Robot(table(ARMS[name]))
    q = np.random.default_rng(0).choice(ROUND, (80, 6))
    T = robot.forward(q)
    for batch in (robot.inverse_batch(T), robot.inverse_batch(T, near=q)):
        assert_sound(robot, batch, T)
    assert np.where(batch.valid, gaps(batch.q, q[:, None]), 9).min(axis=1).max() < 1e-6


def test_a_posture_that_moves_without_its_tool_is_told():
    """A UR5, taken for any six turns: axis 6 along axes 2 to 4 makes a family."""
    rows = [(*row[:2], 0, *row[3:]) if i == 3 else row for i, row in enumerate(ARMS["bent UR5"])]
    model = GeneralArm(table(rows))
    q = np.array([0.3, -1.0, 1.2, 0.4, 0.0, 2.0])
    answer = model.solve(model.chain.forward(q), near=q)
    row = gaps(answer.q, q).argmin()
    assert gaps(answer.q[row], q) < 1e-9 and answer.status == Status.INFINITE
    assert answer.free_by_row[row] == answer.free == "several joints can move together"


def test_far_away_says_how_far():
    T = np.eye(4)
    T[:3, 3] = 4, 0, 0
    answer = Robot(table(ARMS["offset wrist"])).inverse(T)
    assert answer.status == Status.UNREACHABLE and 2.5 < answer.excess < 4


def test_slides_and_lost_freedoms_are_refused_in_words():
    slide = [*ARMS["nothing meets"][:3], (1, 0.1, 0.5, 0, 0.2), *ARMS["nothing meets"][4:]]
    assert misfits(table(slide))["arm of six turns"] == "joint 4 is prismatic, not revolute"
    assert misfits(table(slide))["decoupled arm"].startswith("no three neighbouring axes")
    with pytest.raises(ValueError, match=r"no arm of six turns \(joint 4 is prismatic"):
        Robot(table(slide)).inverse(np.eye(4))
    assert misfits(table(ARMS["nothing meets"]))["arm of six turns"] == ""
