"""Joint limits: a family keeps the members within them, turns are distances, and wide limits stay in memory.

The oracle multiplies elementary motions itself; that a member exists is known because the pose was made from one.
"""

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import minimize

from autograder.reference import DHTable, Robot, robots

pytestmark = pytest.mark.filterwarnings("error")

PI = np.pi


def tip(lengths, q):
    """Tip (x, y) and heading of a planar arm, link after link."""
    heading = np.cumsum(q)
    return np.array([np.dot(lengths, np.cos(heading)), np.dot(lengths, np.sin(heading)), heading[-1]])


def inside(q, limits):
    lower, upper = np.transpose(limits)
    return ((q >= lower - 1e-8) & (q <= upper + 1e-8)).all(axis=-1)


@pytest.mark.parametrize(
    "lengths, limits",
    [
        ((0.4, 0.3, 0.25, 0.15), [(-PI / 2, PI / 2)] * 4),
        ((0.3, 0.3, 0.3, 0.3), [(-0.3, 0.3)] * 4),
        ((0.2, 0.9, 0.3, 0.1), [(0.2, 2.5), (-1, 0), (-2, 2), (-9, 0.1)]),
        ((0.4, 0.3, 0.2, 0.2, 0.1), [(-PI / 2, PI / 2)] * 5),
        ((0.4, 0.3, 0.2, 0.2, 0.1, 0.1), [(-1, 1)] * 6),
    ],
)
def test_a_redundant_arm_finds_a_member_within_its_limits(lengths, limits):
    robot = robots.planar(lengths, limits=limits)
    count = 60 if len(lengths) < 6 else 10
    wanted = np.random.default_rng(3).uniform(*np.transpose(limits), (count, len(lengths)))
    batch = robot.inverse_batch([tip(lengths, q) for q in wanted], limits=True)
    for i, q in enumerate(wanted):
        found = batch[i]
        assert found.status != "unreachable" and inside(found.q, limits).all()
        for member in found.q:
            gap = tip(lengths, member) - tip(lengths, q)
            assert np.abs(np.exp(1j * gap) - 1).max() < 1e-9


@pytest.mark.slow
def test_what_no_member_reaches_within_the_limits_stays_unreachable():
    """SciPy's search within the limits finds none either; limits as wide as the best one found let it in."""
    lengths, limits = (0.4, 0.3, 0.25, 0.15), [(-0.4, 0.4)] * 4
    robot, refused = robots.planar(lengths, limits=limits), 0
    lower, upper = np.transpose(limits)
    for q in np.random.default_rng(5).uniform(-1.2, 1.2, (12, 4)):
        target = tip(lengths, q)
        found = robot.inverse(target, limits=True)
        gaps = [
            minimize(lambda q: ((tip(lengths, q) - target) ** 2).sum(), start, bounds=limits, tol=1e-14).fun
            for start in np.random.default_rng(0).uniform(lower, upper, (3, 4))
        ]
        if min(gaps) > 1e-8:
            assert found.status == "unreachable" and found.excess > 1e-4 and "joint limits" in found.reason
            wide = 0.4 + 1.01 * found.excess
            assert len(robots.planar(lengths, limits=[(-wide, wide)] * 4).inverse(target, limits=True))
            refused += 1
        elif min(gaps) < 1e-16:
            assert len(found)
    assert refused > 3


def test_a_scara_at_its_centre_turns_axis_1_until_the_others_are_within_their_limits():
    limits = [(0.2, 2.5), (-3.2, 3.2), (-1, 1), (-1, 1)]
    robot = robots.scara(0.3, 0.3, limits=limits)
    for turn, quill in np.random.default_rng(4).uniform((0.2, -1), (2.5, 1), (40, 2)):
        T = robot.forward([turn, PI, 0.2, quill])
        found = robot.inverse(T, limits=True)
        assert found.status == "infinite" and inside(found.q, limits).all()
        np.testing.assert_allclose(robot.forward(found.q), np.broadcast_to(T, (len(found), 4, 4)), atol=1e-9)


RX90 = np.radians([(-160, 160), (-137, 137), (-142, 142), (-270, 270), (-105, 120), (-270, 270)])
NARROW = np.radians([(-60, 60), (-137, 137), (-142, 142), (-60, 60), (-60, 60), (-60, 60)])


@pytest.mark.slow
@pytest.mark.parametrize("limits", [RX90, NARROW])
def test_an_arm_over_axis_1_finds_a_member_within_its_limits(limits):
    robot = robots.rx90(limits=limits)
    q = np.random.default_rng(6).uniform(*limits.T, (60, 6))
    q[:, 2] = np.arcsin(np.cos(q[:, 1])) - q[:, 1]  # the wrist centre on axis 1
    q = q[inside(q, limits)]
    T = robot.forward(q)
    batch = robot.inverse_batch(T, limits=True)
    assert len(q) > 10 and batch.valid.any(axis=1).all() and inside(batch.q[batch.valid], limits).all()
    np.testing.assert_allclose(robot.forward(batch.q[batch.valid]), np.repeat(T, batch.count, axis=0), atol=1e-9)
    for i in range(0, len(q), 12):
        nearest = robot.nearest(T[i], q[i], limits=True)
        assert nearest.distance < 1e-6 and np.abs(nearest.q - q[i]).max() < 1e-6
        away = robot.nearest(T[i], np.clip(q[i] + 0.1, *limits.T), limits=True)
        assert away.q is not None and inside(away.q, limits) and away.distance <= 0.1 * np.sqrt(6) + 1e-9


@pytest.mark.slow
def test_the_member_that_is_near_is_reported_where_it_is_within_the_limits():
    lengths, limits = (0.4, 0.3, 0.25, 0.15), [(-PI / 2, PI / 2)] * 4
    robot = robots.planar(lengths, limits=limits)
    for q in np.random.default_rng(8).uniform(-PI / 2, PI / 2, (20, 4)):
        found = robot.inverse(tip(lengths, q), near=q, limits=True)
        assert np.abs(found.q - q).max(axis=1).min() < 1e-6
        assert robot.nearest(tip(lengths, q), q, limits=True).distance < 1e-6


@pytest.mark.parametrize("sign", [1, -1])
def test_the_nearest_posture_within_wide_limits_is_in_the_nearest_turn(sign):
    limits = [(-2 * PI, 2 * PI)] * 6
    robot = robots.rx90(limits=limits)
    q = sign * np.array([0.86, -1.4, -2.8, -3, 1.9, 2.5])
    found = robot.nearest(robot.forward(q), q, limits=True)
    np.testing.assert_allclose(found.q, q, atol=1e-9)
    assert found.distance < 1e-9
    previous = q
    for turn in np.radians(np.arange(0, 360, 15)):  # joint 6 winds on past 180 degrees, without a jump
        moved = np.array([*q[:5], np.clip(q[5] - sign * turn, -2 * PI, 2 * PI)])
        previous = robot.nearest(robot.forward(moved), previous, limits=True).q
        np.testing.assert_allclose(previous, moved, atol=1e-9)


def test_distance_within_limits_is_the_true_distance():
    robot = robots.planar_2r(limits=[(-1, 1), (-9, -4)])  # joint 2 must stay a turn away
    q0 = np.array([0.3, 0.5])
    found = robot.nearest(robot.forward(q0), q0, limits=True)
    np.testing.assert_allclose(found.q, [0.3, 0.5 - 2 * PI], atol=1e-9)
    assert found.distance == pytest.approx(2 * PI)
    far = robots.planar_2r(limits=[(99, 101), (0, 1)])
    np.testing.assert_allclose(far.inverse(far.forward([100, 0.5]), limits=True).q, [[100, 0.5]], atol=1e-9)


@pytest.mark.parametrize("bent", [0.0, PI])
def test_aligned_joints_come_as_near_as_the_limits_allow(bent):
    limits = [(-3, 3)] * 3 + [(-7, 7), (-4, 4), (-7, 1)]
    robot = robots.rx90(limits=limits)
    q, rng = np.array([0.3, 0.5, -0.4, 1.0, bent, 0.7]), np.random.default_rng(2)
    T, sense = robot.forward(q), 1 if bent == 0 else -1
    for _ in range(10):
        q0 = q + np.array([0, 0, 0, *rng.uniform(-9, 9, 3) * [1, 0, 1]])
        found = robot.nearest(T, q0, limits=True)
        np.testing.assert_allclose(robot.forward(found.q), T, atol=1e-9)
        assert inside(found.q, limits)
        line = q[3] + sense * q[5] + 2 * PI * np.arange(-4, 5)[:, None]
        q4 = np.linspace(-7, 7, 4001)
        q6 = sense * (line - q4)
        gaps = np.where((q6 >= -7) & (q6 <= 1), np.hypot(q4 - q0[3], q6 - q0[5]), np.inf)
        assert found.distance <= gaps.min() + 1e-9


def test_wide_limits_are_listed_in_every_turn_or_refused_but_never_fill_the_memory():
    turn = [(-2 * PI, 2 * PI)] * 6
    robot = robots.rx90(limits=turn)
    T = robot.forward(np.random.default_rng(9).uniform(-3, 3, (300, 6)))
    batch = robot.inverse_batch(T[:20], limits=True)
    assert (batch.count >= 64).all() and batch.q.nbytes < 20 * 8 * 2**6 * 6 * 8 * 1.01
    assert inside(batch.q[batch.valid], turn).all()
    assert len(np.unique(batch[0].q.round(9), axis=0)) == len(batch[0])
    wide = robots.rx90(limits=[(-20, 20)] * 6)
    with pytest.raises(ValueError, match="too many to list: ask for fewer poses at a time"):
        wide.inverse_batch(T, limits=True)
    assert wide.nearest(T[0], np.full(6, 12.0), limits=True).distance < 14


def test_the_two_ends_of_a_full_circle_are_one_posture():
    robot = robots.rx90(limits=[(-PI, PI)] * 6)
    q = np.array([PI, 0.4, -0.3, PI, 0.8, 0.5])
    assert len(robot.inverse(robot.forward(q), limits=True)) == len(robot.inverse(robot.forward(q))) == 8


def test_endless_joints_have_infinite_limits():
    q = sp.symbols("q1:3")
    rows = [(0, 0, 0, 0, q[0]), (0, 0.5, 0, 0, q[1]), (0, 0.4, 0, 0, 0)]
    robot = Robot(DHTable(rows, limits=[(-np.inf, np.inf), (0, np.inf)]))
    answer = robot.inverse([0.3, 0.5], limits=True)
    assert (answer.q[:, 1] >= 0).all() and len(answer) == 2 * 7 * 7
    assert robot.nearest(robot.forward([40.0, 30.0]), [40.0, 30.0], limits=True).distance < 1e-9


@pytest.mark.parametrize("lengths", [(0.4, 0.3, 0.25, 0.15), (0.3, 0.3, 0.3, 0.3), (0.5, 0.3), (0.5, 0.3, 0.2)])
@pytest.mark.parametrize("lower", [0, -1])
def test_a_posture_with_joints_at_their_limits_is_found(lengths, lower):
    """Straight arms too, whose angles are known to the root of what lengths are known to."""
    n, rng = len(lengths), np.random.default_rng(1)
    limits = [(lower, lower + 1)] * n
    robot = robots.planar(lengths, limits=limits)
    q = rng.uniform(lower, lower + 1, (80, n))
    q = np.where(rng.random((80, n)) < 0.6, rng.choice([lower, lower + 1], (80, n)), q)
    q[:20, 1:] = 0
    T = robot.forward(q)
    batch = robot.inverse_batch(T, limits=True)
    found = batch.q[batch.valid]
    assert batch.valid.any(axis=1).all() and (np.abs(found - lower - 0.5) <= 0.5 + 1e-7).all()
    np.testing.assert_allclose(
        robot.forward(batch.q[batch.valid])[:, :2, 3], np.repeat(T, batch.count, 0)[:, :2, 3], atol=1e-9
    )
    for i in (0, 5, 30):
        assert robot.nearest(T[i], q[i], limits=True).distance < 1e-6
