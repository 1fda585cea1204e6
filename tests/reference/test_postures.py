"""What `solve` and `nearest` answer: vectors, order, labels, limits, families, messages."""

import inspect
import sys

import numpy as np
import pytest
import sympy as sp

from autograder.reference import DHTable, Robot, robots
from dhm.elbow import WristedArm

pytestmark = pytest.mark.filterwarnings("error")

ZERO = np.zeros(6)


def degrees(answer):
    return np.degrees(answer.q)


def assert_reaches(robot, q, T, atol=1e-9):
    np.testing.assert_allclose(robot.forward(q), np.broadcast_to(T, (len(q), 4, 4)), atol=atol)


def test_rx90_eight_postures():
    answer = robots.RX90.inverse(robots.RX90.forward(np.radians([20, 40, -30, 50, 60, -70])))
    expected = [
        [20, 40, -30, 50, 60, -70],
        [20, 40, -30, -130, -60, 110],
        [20, 100, -150, 43.003, 103.420, -26.997],
        [20, 100, -150, -136.997, -103.420, 153.003],
        [-160, 80, -30, -136.997, 103.420, -26.997],
        [-160, 80, -30, 43.003, -103.420, 153.003],
        [-160, 140, -150, -130, 60, -70],
        [-160, 140, -150, 50, -60, 110],
    ]
    np.testing.assert_allclose(degrees(answer), expected, atol=6e-4)
    assert answer.status == "solved" and answer.free == "" and answer.reason == "8 postures"
    assert answer.labels[0] == "shoulder left, elbow down, wrist unflipped"
    assert answer.labels[3] == "shoulder left, elbow up, wrist flipped"
    assert answer.labels[4] == "shoulder right, elbow up, wrist unflipped"


def test_rx90_pose_typed_with_six_decimals():
    T = np.round(robots.RX90.forward(np.radians([20, 40, -30, 50, 60, -70])), 6)
    answer = robots.RX90.inverse(T)
    assert len(answer) == 8
    np.testing.assert_allclose(degrees(answer)[0], [20, 40, -30, 50, 60, -70], atol=1e-3)


def test_epfl_eight_postures():
    answer = robots.EPFL_ARM.inverse(robots.EPFL_ARM.forward(np.radians([20, 30, 50, -25, 40, 65])))
    expected = [
        [20, 30, 50, -25, 40, 65],
        [20, 30, 50, 155, -40, -115],
        [20, 84.855, -50, -15.895, 82.685, 47.419],
        [20, 84.855, -50, 164.105, -82.685, -132.581],
        [-133.242, -84.855, 50, 141.114, 89.710, 60.935],
        [-133.242, -84.855, 50, -38.886, -89.710, -119.065],
        [-133.242, -30, -50, 130.985, 56.264, 93.288],
        [-133.242, -30, -50, -49.015, -56.264, -86.712],
    ]
    # x1 of its table points against the side that the slides count first.
    np.testing.assert_allclose(degrees(answer)[[4, 5, 6, 7, 0, 1, 2, 3]], expected, atol=6e-4)


def test_s600_two_postures_and_four_over_two_turns():
    target = [0.329212, 0.433322, -0.1, np.radians(60)]
    answer = robots.ADEPT_S600.inverse(target)
    expected = [[30, 50, -0.1, 20], [75.5493, -50, -0.1, -34.4507]]
    for row, wanted in zip(answer.q, expected, strict=True):
        np.testing.assert_allclose(np.degrees(row[[0, 1, 3]]), np.array(wanted)[[0, 1, 3]], atol=1e-3)
        assert row[2] == pytest.approx(-0.1)
    turn = 2 * np.pi
    wide = robots.adept_s600(limits=[(-np.pi, np.pi), (-np.pi, np.pi), (-1, 1), (-turn, turn)])
    four = wide.inverse(target, limits=True)
    np.testing.assert_allclose(np.degrees(four.q[:, 3]), [-340, 20, -34.4507, 325.5493], atol=1e-3)
    assert four.labels == ("elbow right",) * 2 + ("elbow left",) * 2
    assert len(wide.inverse(target)) == 2


def test_two_link_vector_and_labels():
    answer = robots.PLANAR_2R.inverse([0.761836, 1.090885])
    np.testing.assert_allclose(degrees(answer), [[30, 70], [80.142, -70]], atol=1e-3)
    assert answer.labels == ("elbow down", "elbow up")


def test_kr210_has_four_postures_when_the_back_is_out_of_reach():
    near_back = robots.KR210.forward(np.radians([25, -40, 30, 15, 50, -20]))
    far = robots.KR210.forward(np.radians([25, 20, -60, 15, 50, -20]))
    assert len(robots.KR210.inverse(near_back)) == 8
    answer = robots.KR210.inverse(far)
    assert len(answer) == 4 and all("shoulder left" in label for label in answer.labels)


def test_task_coordinates_and_poses_say_the_same():
    for robot, task, _q in [
        (robots.PLANAR_3R, [0.6, 0.3, 0.4], None),
        (robots.SCARA, [0.3, 0.4, -0.1, 1.0], None),
        (robots.SCARA_EPFL, [0.3, 0.4, 0.1, 1.0], None),
        (robots.ADEPT_S600, [0.3, 0.4, -0.1, 1.0], None),
    ]:
        answer = robot.inverse(task)
        T = robot.forward(answer.q)
        np.testing.assert_allclose(T[:, :2, 3], np.broadcast_to(task[:2], (2, 2)), atol=1e-12)
        np.testing.assert_allclose(np.arctan2(T[:, 1, 0], T[:, 0, 0]), task[-1], atol=1e-12)
        np.testing.assert_allclose(robot.inverse(T[0]).q, answer.q, atol=1e-12)


@pytest.mark.parametrize(
    "r, count, status",
    [(1.6, 1, "boundary"), (0.4, 1, "boundary"), (1.0, 2, "solved"), (1.7, 0, "unreachable"), (0.3, 0, "unreachable")],
)
def test_two_link_count_inside_on_and_outside_the_limits(r, count, status):
    answer = robots.PLANAR_2R.inverse([r * np.cos(0.7), r * np.sin(0.7)])
    assert (len(answer), answer.status) == (count, status)
    if count == 0:
        assert answer.excess == pytest.approx(0.1)
        assert ("beyond the reach 1.6 m" if r > 1 else "inside the inner limit 0.4 m") in answer.reason
    if status == "boundary":
        assert answer.labels[0] == ("arm stretched" if r > 1 else "arm folded")
        assert degrees(answer)[0, 1] == pytest.approx(0 if r > 1 else 180)


def test_target_at_the_centre_of_an_arm_with_equal_links():
    answer = robots.planar_2r(0.5, 0.5).inverse([0.0, 0.0])
    assert answer.status == "infinite" and answer.free == "q1 free" and len(answer) == 1
    assert np.degrees(answer.q[0, 1]) == pytest.approx(180)
    near = robots.planar_2r(0.5, 0.5).inverse([0.0, 0.0], near=[1.2, 0.0])
    assert near.q[0, 0] == pytest.approx(1.2)
    scara = robots.scara(0.3, 0.3).inverse([0, 0, -0.1, 0.5])
    assert scara.free == "q1 free"
    np.testing.assert_allclose(robots.scara(0.3, 0.3).forward(scara.q[0])[:3, 3], [0, 0, -0.1], atol=1e-12)


def test_tolerance_lets_a_target_miss_the_workspace():
    robot = robots.PLANAR_2R
    assert robot.inverse([1.6 + 5e-10, 0]).status == "boundary"
    assert robot.inverse([1.6 + 1e-6, 0]).status == "unreachable"
    answer = robot.inverse([1.6 + 1e-6, 0], tol=1e-5)
    assert answer.status == "boundary"
    np.testing.assert_allclose(answer.q, [[0, 0]], atol=1e-12)


def test_tilted_and_displaced_poses_are_refused():
    tilted = robots.RX90.forward(np.radians([0, 90, -90, 0, 10, 0]))
    assert "tilted" in robots.SCARA.inverse(tilted).reason
    assert "tilted" in robots.PLANAR_3R.inverse(tilted).reason
    raised = np.eye(4)
    raised[:3, 3] = 0.5, 0.2, 0.3
    answer = robots.PLANAR_3R.inverse(raised)
    assert answer.status == "unreachable" and answer.excess == pytest.approx(0.3)
    assert "out of the arm's plane" in answer.reason
    wrist = robots.SPHERICAL_WRIST.inverse(raised)
    assert "away from where the three axes meet" in wrist.reason


def test_wrist_singularity_touches_only_the_postures_it_concerns():
    """RX-90 at q = 0: two of the four arm postures are families, the others keep both wrists."""
    T = robots.RX90.forward(ZERO)
    answer = robots.RX90.inverse(T)
    assert answer.status == "infinite" and answer.free == "q4 + q6 = const"
    assert len(answer) == 6 and answer.free_by_row.count("q4 + q6 = const") == 2
    np.testing.assert_allclose(answer.q[0], ZERO, atol=1e-12)
    assert answer.labels[0] == "shoulder left, elbow down, wrist straight"
    assert_reaches(robots.RX90, answer.q, T)


def test_folded_wrist_defines_the_difference():
    T = robots.RX90.forward(np.radians([10, 20, 30, 40, 180, 15]))
    answer = robots.RX90.inverse(T)
    row = answer.free_by_row.index("q4 - q6 = const")
    assert np.degrees(answer.q[row, 3] - answer.q[row, 5]) == pytest.approx(25)
    assert "wrist folded" in answer.labels[row]


def test_straight_wrist_is_straight_whatever_the_table_counts():
    """The EPFL arm's table turns its last frames by half turns; q5 = 0 is still straight."""
    q = np.radians([20, 30, 50, -25, 0, 65])
    answer = robots.EPFL_ARM.inverse(robots.EPFL_ARM.forward(q))
    row = answer.free_by_row.index("q4 + q6 = const")
    assert "wrist straight" in answer.labels[row]
    assert np.degrees(answer.q[row, 3] + answer.q[row, 5]) == pytest.approx(40)


def test_free_direction_speaks_of_joints_as_the_table_counts_them():
    table = robots.RX90.table
    t6 = table.joints[5]
    rows = [*table.rows[:5], (*[0, 0, table.rows[5].alpha, 0], -t6)]
    robot = Robot(DHTable(rows, joints=table.joints, values=table.values), WristedArm)
    q = np.radians([20, 40, -30, 25, 0, 15])
    answer = robot.inverse(robot.forward(q))
    assert "q4 - q6 = const" in answer.free
    row = answer.free_by_row.index("q4 - q6 = const")
    assert np.degrees(answer.q[row, 3] - answer.q[row, 5]) == pytest.approx(10)


def test_shoulder_singularity_frees_joint_one():
    q = np.radians([70, 60, 0, 20, 30, 40])
    q[2] = np.arcsin(np.cos(q[1])) - q[1]  # C2 a3 = S23 d3: wrist centre on axis 1
    T = robots.RX90.forward(q)
    assert np.hypot(*T[:2, 3]) < 1e-12
    answer = robots.RX90.inverse(T)
    assert answer.status == "infinite" and answer.free == "q1 free" and len(answer) == 4
    assert (answer.q[:, 0] == 0).all()
    assert_reaches(robots.RX90, answer.q, T)
    exact = robots.RX90.inverse(T, near=q)
    assert np.abs(exact.q - q).max(axis=1).min() < 1e-9
    nearest = robots.RX90.nearest(T, q)
    assert nearest.distance < 1e-8 and nearest.free == "q1 free"


def test_wrist_centre_on_the_shoulder_frees_two_joints():
    q = np.radians([35, 25, 90, 20, 30, 40])
    answer = robots.RX90.inverse(robots.RX90.forward(q))
    assert answer.free == "q1 free, q2 free"
    near = robots.RX90.inverse(robots.RX90.forward(q), near=q)
    assert np.abs(near.q - q).max(axis=1).min() < 1e-9


@pytest.mark.parametrize("offset", [0.4, -0.9])
def test_nearest_uses_the_free_direction(offset):
    """The best member of a family is better than any representative; checked by brute force."""
    q = np.radians([70, 60, 0, 20, 30, 40])
    q[2] = np.arcsin(np.cos(q[1])) - q[1]
    T = robots.RX90.forward(q)
    q0 = q + offset * np.array([1, 0.1, 0, -1, 0.5, 0.3])
    nearest = robots.RX90.nearest(T, q0)
    scan = np.tile(q0, (20001, 1))
    scan[:, 0] = np.linspace(-np.pi, np.pi, len(scan))
    batch = robots.RX90.inverse_batch(np.repeat(T[None], len(scan), axis=0), near=scan)
    gaps = np.angle(np.exp(1j * (batch.q - q0)))
    best = np.where(batch.valid, np.linalg.norm(gaps, axis=-1), np.inf).min()
    assert nearest.distance <= best + 1e-12 and nearest.distance > best - 1e-4
    assert_reaches(robots.RX90, nearest.q[None], T)


def test_nearest_on_a_line_of_the_wrist_is_the_foot_of_the_perpendicular():
    T = robots.RX90.forward(np.radians([20, 40, -30, 25, 0, 15]))
    q0 = np.radians([20, 40, -30, 50, 0, 50])
    nearest = robots.RX90.nearest(T, q0)
    np.testing.assert_allclose(np.degrees(nearest.q), [20, 40, -30, 20, 0, 20], atol=1e-9)
    assert nearest.free == "q4 + q6 = const"


def test_nearest_counts_angles_modulo_a_turn():
    robot = robots.PLANAR_2R
    T = robot.forward([3.1, 0.5])
    assert robot.nearest(T, [-3.1, 0.5]).distance == pytest.approx(2 * np.pi - 6.2)
    nothing = robot.nearest([5.0, 0.0], [0, 0])
    assert nothing.q is None and nothing.distance == np.inf and "3.4 m beyond" in nothing.reason


def test_redundant_arm_keeps_its_first_joints_where_it_can():
    robot = robots.planar((0.4, 0.3, 0.25, 0.2, 0.1))
    q = np.array([0.3, -0.5, 0.8, 0.4, -0.2])
    T = robot.forward(q)
    answer = robot.inverse(T, near=q)
    assert answer.free == "q1 and q2 free" and answer.status == "infinite"
    assert np.abs(answer.q - q).max(axis=1).min() < 1e-9
    assert 1 <= len(robot.inverse(T)) <= 2
    stretched = robot.inverse(robot.forward([0.4, 0, 0, 0, 0.3]))
    assert stretched.status == "boundary" and stretched.labels == ("arm stretched",)
    np.testing.assert_allclose(stretched.q, [[0.4, 0, 0, 0, 0.3]], atol=1e-7)


@pytest.mark.parametrize("power", range(1, 17))
@pytest.mark.parametrize("joint, round_value", [(4, 0), (4, 180), (2, 0), (2, -180), (2, 90), (1, 90)])
def test_approaching_a_singularity_stays_sound(power, joint, round_value):
    """Wrist straight and folded, elbow limits, wrist centre near the shoulder and axis 1."""
    q = np.radians([20.0, 40, -30, 50, 60, -70])
    q[joint] = np.radians(round_value) + 10.0**-power
    for robot in (robots.RX90, robots.KR210, robots.EPFL_ARM, robots.PUMA):
        T = robot.forward(q)
        answer = robot.inverse(T)
        assert len(answer) > 0
        assert_reaches(robot, answer.q, T, atol=2e-9)
        near = robot.inverse(T, near=q)
        gaps = np.abs(np.angle(np.exp(1j * (near.q - q)))).max(axis=1)
        assert gaps.min() < 3e-6


def test_joint_limits_filter():
    limits = np.radians([(-160, 160), (-137, 137), (-142, 142), (-270, 270), (-105, 120), (-270, 270)])
    robot = robots.rx90(limits=limits)
    rng = np.random.default_rng(0)
    q = rng.uniform(*limits.T, (300, 6))
    T = robot.forward(q)
    everything, allowed = robot.inverse_batch(T), robot.inverse_batch(T, limits=True)
    assert allowed.valid.any(axis=1).all()
    chosen = allowed.q[allowed.valid]
    assert (chosen >= limits[:, 0] - 1e-8).all() and (chosen <= limits[:, 1] + 1e-8).all()
    np.testing.assert_allclose(robot.forward(chosen), np.repeat(T, allowed.count, axis=0), atol=1e-9)
    for i in range(len(T)):
        turns = [[2 * np.pi * k for k in (-1, 0, 1)] if j in (3, 5) else [0] for j in range(6)]
        shifts = np.stack(np.meshgrid(*turns), -1).reshape(-1, 6)
        options = (everything.q[i][everything.valid[i]][:, None] + shifts).reshape(-1, 6)
        inside = ((options >= limits[:, 0]) & (options <= limits[:, 1])).all(axis=1)
        assert inside.sum() == allowed.count[i]
        assert np.abs(allowed.q[i][allowed.valid[i]] - q[i]).max(axis=1).min() < 1e-7


def test_joint_limits_say_by_how_much():
    robot = robots.planar_2r(limits=[(-0.5, 0.5), (-1, 1)])
    answer = robot.inverse(robot.forward([0.8, 0.9]), limits=True)
    assert answer.status == "unreachable" and answer.excess == pytest.approx(0.3)
    assert "joint limits" in answer.reason
    with pytest.raises(ValueError, match="no joint limits"):
        robots.PLANAR_2R.inverse([1, 0], limits=True)


def test_a_family_is_moved_into_the_joint_limits():
    limits = [(-3, 3)] * 3 + [(0.9, 1.1), (-2, 2), (-3, 3)]
    robot = robots.rx90(limits=limits)
    q = np.array([0.3, 0.5, -0.4, 1.0, 0.0, 0.7])
    answer = robot.inverse(robot.forward(q), limits=True)
    assert "q4 + q6 = const" in answer.free
    row = answer.free_by_row.index("q4 + q6 = const")
    assert 0.9 <= answer.q[row, 3] <= 1.1
    assert_reaches(robot, answer.q, robot.forward(q))


@pytest.mark.parametrize(
    "T, message",
    [
        (np.eye(3), "expected poses of shape"),
        (np.diag([1, 1, 2, 1]), "rigid"),
        (np.diag([1, 1, -1, 1]), "rigid"),
        (np.diag([1, 1, 1, 2]), "rigid"),
        (np.full((4, 4), np.nan), "finite"),
    ],
)
def test_what_is_not_a_pose_is_refused(T, message):
    with pytest.raises(ValueError, match=message):
        robots.RX90.inverse(T)


def test_other_bad_arguments_are_refused():
    with pytest.raises(ValueError, match="expected joint values of shape"):
        robots.RX90.inverse(np.eye(4), near=[0, 0])
    with pytest.raises(ValueError, match="x, y, phi"):
        robots.PLANAR_3R.inverse([0.1, 0.2])
    with pytest.raises(AttributeError, match="no robot R2D2: there are PLANAR_2R"):
        robots.R2D2


def test_a_robot_without_inverse_model_says_why():
    assert not robots.PUMA_PRINTED.has_inverse
    with pytest.raises(ValueError, match="printed has no inverse model: its 6 joints give 5 freedoms only"):
        robots.PUMA_PRINTED.inverse(np.eye(4))
    half = np.pi / 2
    rows = [(0, 0, 0, 0.1, None), (0, 0.2, 1, 0, None), (1, 0.3, 1, None, 0), (0, 0.1, 1, 0, None)]
    rows += [(1, 0.2, 1, None, 0), (0, 0.1, half, 0.09, None)]
    with pytest.raises(ValueError, match="two slides has no inverse model in closed form: .*three neighbouring axes"):
        Robot(DHTable(rows, "two slides"), None).inverse(np.eye(4))


def test_lengths_may_be_letters_or_numbers_by_place_or_name():
    k = sp.Symbol("k")
    robot = robots.scara(k / 2, a3=0.5, limits=[(-1, 1)] * 4)
    assert robot.table.rows[1].a == k / 2 and robot.table.values == {"a3": 0.5}
    assert robot.table.limits == ((-1, 1),) * 4
    assert list(inspect.signature(robots.scara).parameters) == ["a2", "a3", "limits"]
    with pytest.raises(TypeError, match="a5"):
        robots.scara(a5=0.2)


def test_empty_batch():
    batch = robots.RX90.inverse_batch(np.empty((0, 4, 4)))
    assert batch.q.shape == (0, 8, 6) and len(batch) == 0


def test_scalar_and_batch_agree():
    q = np.random.default_rng(8).uniform(-3, 3, (3000, 6))
    T = robots.KR210.forward(q)
    batch = robots.KR210.inverse_batch(T)
    for i in (0, 1023, 1024, 2999):
        one = robots.KR210.inverse(T[i])
        np.testing.assert_allclose(one.q, batch[i].q, atol=1e-12)
        assert one.labels == batch[i].labels and one.status == batch.status[i]


@pytest.mark.skipif(sys.version_info >= (3, 14), reason="EAIK has no wheel for this Python yet")
@pytest.mark.parametrize("name", ["RX90", "KR210"])
def test_same_solution_sets_as_eaik(name):
    """EAIK, a C++ solver for spherical wrists built from axes and points, no DH table."""
    from eaik.IK_HP import HPRobot

    robot = getattr(robots, name)
    frames = robot.table.chain.frames(ZERO)
    home = robot.forward(ZERO)
    points = np.vstack([frames[:, :3, 3], home[:3, 3]])
    peer = HPRobot(frames[:, :3, 2], np.diff(points, axis=0, prepend=np.zeros((1, 3))))
    q = np.random.default_rng(9).uniform(-np.pi, np.pi, (400, 6))
    T = robot.forward(q)
    batch = robot.inverse_batch(T)
    for i in range(len(T)):
        pose = T[i].copy()
        pose[:3, :3] = pose[:3, :3] @ home[:3, :3].T
        np.testing.assert_allclose(peer.fwdKin(q[i]), pose, atol=1e-12)
        answer = peer.IK(pose)
        theirs = np.asarray(answer.Q)[~np.asarray(answer.is_LS)]
        ours = batch.q[i][batch.valid[i]]
        gaps = np.abs(np.angle(np.exp(1j * (ours[:, None] - theirs)))).max(axis=-1)
        assert gaps.shape == (len(ours), len(ours))
        assert gaps.min(axis=0).max() < 1e-6 and gaps.min(axis=1).max() < 1e-6


def test_of_two_conditions_the_one_that_is_missed_by_more_is_told():
    """High above axis 1 a PUMA's cylinder is missed by centimetres, its reach by metres."""
    T = np.eye(4)
    T[2, 3] = 50.0
    answer = robots.PUMA.inverse(T)
    assert "beyond the reach" in answer.reason and answer.excess == pytest.approx(50 - 0.06 - 0.86, abs=0.01)
    T[2, 3] = 0.5
    assert "inside the cylinder" in robots.PUMA.inverse(T).reason
