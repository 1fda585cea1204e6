"""Arms with a group of three joints (UR, Stanford, gantries, oblique wrists, ...) and three joints for a point.

Three contracts: soundness, recovery, completeness. The oracle of completeness is a damped search from many starts on
elementary motions multiplied here with SciPy's rotations; it shares no algebra with the solver.
"""

import numpy as np
import pytest
import sympy as sp
from scipy.spatial.transform import Rotation

from autograder.reference import DHTable, Robot, Status
from dhm.decoupled import Decoupled, PointArm

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("error")]

PI, HALF = np.pi, np.pi / 2
WRIST = [(0, 0, 0, 0, 0), (0, 0, -HALF, 0, 0), (0, 0, HALF, 0.1, 0)]
SKEW = [(0, 0.1, 1, 0.2, 0), (0, 0, -1.2, 0, 0), (0, 0, 1.4, 0.1, 0)]  # three axes through one point, none square
UR5 = [(0, 0, 0, 0.09, 0), (0, 0, HALF, 0, 0), (0, -0.42, 0, 0, 0)]
UR5 += [(0, -0.39, 0, 0.11, 0), (0, 0, HALF, 0.09, 0), (0, 0, -HALF, 0.08, 0)]

ARMS = {
    "UR5": UR5,
    "three parallel axes, no two others meet": [
        *[(0, 0, 0, 0.09, 0), (0, 0.05, HALF, 0, 0), (0, -0.42, 0, 0, 0)],
        *[(0, -0.39, PI, 0.11, 0), (0, 0.1, 1.2, 0.09, 0), (0, 0.06, -HALF, 0.08, 0)],
    ],
    "Stanford": [(0, 0, 0, 0.4, 0), (0, 0, -HALF, 0.15, 0), (1, 0, HALF, 0, 0), *WRIST],
    "cylindrical with wrist": [(0, 0, 0, 0.4, 0), (1, 0, 0, 0.15, 0), (1, 0, HALF, 0, 0), *WRIST],
    "gantry with wrist": [(1, 0, 0, 0.4, 0), (1, 0.1, HALF, 0.15, HALF), (1, 0.2, HALF, 0, 0), *WRIST],
    "lift, turn, slide, wrist": [(1, 0, 0, 0.4, 0), (0, 0.1, 0, 0.15, 0), (1, 0.2, HALF, 0, 0), *WRIST],
    "slide, two turns aslant, wrist": [(1, 0, 0, 0.4, 0), (0, 0.1, 0.8, 0.15, 0), (0, 0.2, 0.9, 0, 0), *SKEW],
    "turn, slide, turn, wrist": [(0, 0, 0, 0.4, 0), (1, 0.1, 1.0, 0.15, 0), (0, 0.2, 0.7, 0, 0), *SKEW],
    "three turns aslant, wrist": [(0, 0, 0, 0.4, 0), (0, 0.1, 0.8, 0.15, 0), (0, 0.2, 0.9, 0.1, 0), *SKEW],
    "first two meet": [(0, 0, 0, 0.4, 0), (0, 0, 0.8, 0.15, 0), (0, 0.2, 0.9, 0.1, 0), *SKEW],
    "first two parallel": [(0, 0, 0, 0.4, 0), (0, 0.3, 0, 0.15, 0), (0, 0.2, 0.9, 0.1, 0), *SKEW],
    "wrist at the base": [
        *[(0, 0, 0, 0.4, 0), (0, 0, 1.1, 0, 0), (0, 0, 0.9, 0, 0)],
        *[(0, 0.1, 1, 0.2, 0), (0, 0.3, -1.2, 0, 0), (0, 0.2, 1.4, 0.1, 0)],
    ],
    "wrist in the middle": [
        *[(0, 0, 0, 0.4, 0), (0, 0.2, 1.1, 0, 0), (0, 0, 0.9, 0, 0)],
        *[(0, 0, 1, 0.2, 0), (0, 0.3, -1.2, 0, 0), (0, 0.2, 1.4, 0.1, 0)],
    ],
    "parallel at the base": [
        *[(0, 0, 0, 0.4, 0), (0, 0.2, 0, 0, 0), (0, 0.1, 0, 0.1, 0)],
        *[(0, 0.1, 1, 0.1, 0), (0, 0.15, -1.2, 0.2, 0), (0, 0.2, 1.4, 0.1, 0)],
    ],
    "parallel at the tool": [
        *[(0, 0, 0, 0.4, 0), (0, 0.2, 1, 0, 0), (0, 0.1, 1.1, 0.1, 0)],
        *[(0, 0.1, 1.3, 0.1, 0), (0, 0.15, 0, 0.2, 0), (0, 0.2, 0, 0.1, 0)],
    ],
    "five axes": [
        (0, 0, 0, 0.4, 0),
        (0, 0.05, -HALF, 0, 0),
        (0, 0.3, 0, 0, 0),
        (0, 0.25, 0, 0, 0),
        (0, 0, -HALF, 0.1, 0),
    ],
    "palletizer": [(0, 0, 0, 0.4, 0), (0, 0.05, -HALF, 0, 0), (0, 0.3, 0, 0, 0), (0, 0.25, 0, 0, 0)],
    "gantry with a turn": [(1, 0, 0, 0.4, 0), (1, 0, -HALF, 0, HALF), (1, 0, HALF, 0, 0), (0, 0, 0, 0, 0)],
    "SCARA, lift first": [(1, 0, 0, 0.2, 0), (0, 0, 0, 0, 0), (0, 0.3, 0, 0, 0), (0, 0.2, 0, 0.1, 0)],
    "SCARA, lift last": [(0, 0, 0, 0.2, 0), (0, 0.4, 0, 0, 0), (0, 0.3, 0, 0, 0), (1, 0, 0, 0.1, 0)],
    "SCARA, axis beside the quill": [(0, 0, 0, 0.2, 0), (0, 0.4, 0, 0, 0), (1, 0.3, 0, 0, 0), (0, 0.1, 0, 0.1, 0)],
    "planar RPR": [(0, 0, 0, 0, 0), (1, 0.1, HALF, 0, 0), (0, 0, -HALF, 0, 0)],
    "planar PRR": [(1, 0, 0, 0, 0), (0, 0.1, HALF, 0, 0.3), (0, 0.3, 0, 0, 0)],
    "planar RRP": [(0, 0, 0, 0, 0), (0, 0.3, 0, 0, 0.3), (1, 0.1, HALF, 0, 0)],
    "planar PPR": [(1, 0, 0, 0, 0), (1, 0, HALF, 0, HALF), (0, 0, HALF, 0, 0)],
}
POINTS = {
    "Cartesian": [(1, 0, 0, 0.3, 0), (1, 0, HALF, 0, HALF), (1, 0, HALF, 0, 0)],
    "cylindrical": [(0, 0, 0, 0, 0), (1, 0, 0, 0, 0), (1, 0, HALF, 0, 0)],
    "spherical": [(0, 0, 0, 0.3, 0), (0, 0, HALF, 0, 0), (1, 0, HALF, 0, 0)],
    "three turns aslant": [(0, 0, 0, 0.3, 0), (0, 0.2, 1, 0.1, 0), (0, 0.3, 1.2, 0.2, 0)],
    "turn, slide, turn": [(0, 0, 0, 0.3, 0), (1, 0.2, 1, 0.1, 0), (0, 0.3, 1.2, 0.2, 0)],
    "slide, turn, slide": [(1, 0, 0, 0.3, 0), (0, 0.2, 1, 0.1, 0), (1, 0.3, 1.2, 0.2, 0)],
}
EVERY = ARMS | POINTS
TOOL = np.array([[0, 0, 1, 0.25], [1, 0, 0, 0.03], [0, 1, 0, 0], [0, 0, 0, 1.0]])  # of the three joints for a point
ROUND = np.radians([0, 30, -30, 45, -45, 90, -90, 180])


def robot_of(name):
    rows = EVERY[name]
    joints = sp.symbols(f"q1:{len(rows) + 1}")
    entries = [(s, a, alpha, d + q * s, theta + q * (1 - s)) for (s, a, alpha, d, theta), q in zip(rows, joints)]
    return Robot(DHTable(entries, name, joints, tool=sp.Matrix(TOOL) if name in POINTS else None))


def forward(name, q):
    """Poses for q (N, n), one motion after the other."""
    T = np.tile(np.eye(4), (len(q), 1, 1))
    for (slide, a, alpha, d, theta), value in zip(EVERY[name], q.T, strict=True):
        link, turn = np.eye(4), np.tile(np.eye(4), (len(q), 1, 1))
        link[:3, :3], link[0, 3] = Rotation.from_euler("x", alpha).as_matrix(), a
        turn[:, :3, :3] = Rotation.from_rotvec(np.outer(theta + value * (1 - slide), [0, 0, 1])).as_matrix()
        turn[:, 2, 3] = d + value * slide
        T = T @ link @ turn
    return T @ TOOL if name in POINTS else T


def off(name, q, T):
    """Largest deviation from poses T (N, 4, 4), (N,)."""
    difference = np.abs(forward(name, q) - T)
    return difference[:, :3, 3].max(axis=1) if name in POINTS else difference.max(axis=(1, 2))


def apart(name, q, other):
    """Largest joint difference, angles modulo a turn."""
    slides = np.array([row[0] for row in EVERY[name]], dtype=bool)
    return np.abs(np.where(slides, q - other, np.angle(np.exp(1j * (q - other))))).max(axis=-1)


def assert_sound(name, batch, T):
    assert batch.valid.any(axis=1).all(), "a reachable pose is called unreachable"
    pose, branch = np.nonzero(batch.valid)
    assert off(name, batch.q[pose, branch], T[pose]).max() < 2e-9


def assert_recovered(name, batch, q, within):
    assert np.where(batch.valid, apart(name, batch.q, q[:, None]), np.inf).min(axis=1).max() < within


@pytest.mark.parametrize("name", EVERY)
def test_random_poses_are_solved_and_their_postures_recovered(name):
    robot = robot_of(name)
    assert isinstance(robot.inverse_model, PointArm if name in POINTS else Decoupled)
    q = np.random.default_rng(1).uniform(-PI, PI, (300, len(EVERY[name])))
    T = forward(name, q)
    batch = robot.inverse_batch(T)
    assert_sound(name, batch, T)
    assert_recovered(name, batch, q, 1e-6)
    for one, other in zip(*np.triu_indices(batch.q.shape[1], 1)):
        both = batch.valid[:, one] & batch.valid[:, other]
        assert apart(name, batch.q[both, one], batch.q[both, other]).min(initial=1) > 1e-7


@pytest.mark.parametrize("name", EVERY)
def test_round_poses_are_solved_whatever_is_singular_there(name):
    """With the posture itself as `near`, of a family it is the member; where branches merge, digits are lost."""
    robot = robot_of(name)
    q = np.random.default_rng(0).choice(ROUND, (150, len(EVERY[name])))
    T = forward(name, q)
    batch = robot.inverse_batch(T, near=q)
    assert_sound(name, batch, T)
    assert_recovered(name, batch, q, 1e-3)
    regular = batch.status == Status.SOLVED
    slides = np.array([row[0] for row in EVERY[name]], dtype=bool)
    found = robot.inverse_batch(T)
    assert_sound(name, found, T)
    assert_recovered(name, robot.inverse_batch(T[regular]), q[regular], 1e-6)
    assert (found.q[..., ~slides] <= PI).all() and (found.q[..., ~slides] > -PI).all()


def searched(name, T, starts=120, rounds=80):
    """Postures for a pose, from random starts by damped steps with differences for derivatives."""
    rows = EVERY[name]
    q = np.random.default_rng(7).uniform(-4, 4, (starts, len(rows)))

    def missing(q):
        difference = (forward(name, q) - T)[:, :3]
        return difference[:, :, 3] if name in POINTS else difference.reshape(len(q), 12)

    error, damping = missing(q), np.full(starts, 1e-2)
    for _ in range(rounds):
        J = np.stack([(missing(q + 1e-6 * way) - error) / 1e-6 for way in np.eye(len(rows))], axis=1)
        normal = J @ J.swapaxes(1, 2) + damping[:, None, None] * np.eye(len(rows))
        tried = q - np.linalg.solve(normal, J @ error[..., None])[..., 0]
        left = missing(tried)
        better = (left**2).sum(1) < (error**2).sum(1)
        q, error = np.where(better[:, None], tried, q), np.where(better[:, None], left, error)
        damping = np.clip(np.where(better, damping / 5, damping * 3), 1e-12, 1e3)
    return q[np.abs(error).max(axis=1) < 1e-9]


@pytest.mark.parametrize("name", EVERY)
def test_a_search_from_many_starts_finds_no_posture_that_is_missing(name):
    robot, n = robot_of(name), len(EVERY[name])
    for q in np.random.default_rng(3).uniform(-2, 2, (3, n)):
        T = forward(name, q[None])[0]
        found, postures = robot.inverse(T), searched(name, T)
        assert len(postures)
        assert np.stack([apart(name, found.q, one) for one in postures]).min(axis=1).max() < 1e-5


@pytest.mark.parametrize("bent", [1e-1, 1e-3, 1e-5, 1e-7, 1e-8, 1e-10, 1e-13, 0.0])
def test_beside_the_wrist_singularity_of_a_ur5(bent):
    rng = np.random.default_rng(5)
    q = rng.uniform(-PI, PI, (30, 6))
    q[:, 4] = rng.choice([0, PI], 30) + bent
    T = forward("UR5", q)
    batch = robot_of("UR5").inverse_batch(T, near=q)
    assert_sound("UR5", batch, T)
    assert_recovered("UR5", batch, q, 1e-3)
    if not bent:
        assert (batch.status == Status.INFINITE).all() and "q6 free" in batch[0].free_by_row


@pytest.mark.parametrize("offset", [1e-9, 1e-7, 1e-6, 1e-5, 1e-4])
def test_axes_that_meet_all_but_exactly(offset):
    """Axes 5 and 6 of a UR5, with the noise of a URDF file between them."""
    rows = [(*row[:1], row[1] + offset * (i == 5), *row[2:]) for i, row in enumerate(UR5)]
    joints = sp.symbols("q1:7")
    robot = Robot(DHTable([(s, a, al, d, th + q) for (s, a, al, d, th), q in zip(rows, joints)], joints=joints))
    q = np.random.default_rng(6).uniform(-3, 3, (100, 6))
    T = robot.forward(q)
    batch = robot.inverse_batch(T)
    pose, branch = np.nonzero(batch.valid)
    assert np.abs(robot.forward(batch.q[pose, branch]) - T[pose]).max() < 2e-9
    assert_recovered("UR5", batch, q, 1e-5)


def test_a_ur5_with_its_wrist_straight_names_the_free_joint_and_keeps_within_limits():
    robot = robot_of("UR5")
    table = DHTable(robot.table.rows, "UR5", robot.table.joints, limits=[(-2.5, 2.5)] * 6)
    q = np.array([0.3, -1.0, 1.2, 0.4, 0.0, 2.0])
    T = forward("UR5", q[None])[0]
    inside = Robot(table).inverse(T, limits=True)
    assert len(inside) and (np.abs(inside.q) <= 2.5 + 1e-9).all()
    assert "q6 free" in inside.free and inside.status == Status.INFINITE
    assert Robot(table).nearest(T, q).distance < 1e-6


def test_what_is_out_of_reach_says_how_far_the_nearest_posture_found_stays_away():
    T = np.eye(4)
    T[:3, 3] = 3.0, 0.2, 0.1
    answer = robot_of("UR5").inverse(T)
    assert answer.status == Status.UNREACHABLE and 1.5 < answer.excess < 3.0
    assert "no posture reaches the pose, the nearest one found misses it by" in answer.reason
    point = robot_of("three turns aslant").inverse([2.0, 0, 0])
    assert point.status == Status.UNREACHABLE and "misses it by" in point.reason
    tilted = forward("SCARA, lift first", np.array([[0.1, 0.2, 0.3, 0.4]]))[0] @ TOOL
    assert robot_of("SCARA, lift first").inverse(tilted).status == Status.UNREACHABLE


def test_a_stretched_arm_is_on_its_limit():
    q = np.array([0.3, -0.7, 0.0, 0.5, 0.9, 0.2])
    answer = robot_of("UR5").inverse(forward("UR5", q[None])[0])
    assert answer.status == Status.BOUNDARY and len(answer) < 8
    assert any("at a limit" in label for label in answer.labels)


@pytest.mark.parametrize("name", ["UR5", "Stanford", "palletizer", "spherical"])
def test_no_pose_has_no_posture(name):
    assert len(robot_of(name).inverse_batch(np.empty((0, 4, 4)))) == 0


@pytest.mark.parametrize("unit", [1e-3, 1e3])
def test_the_unit_of_length_does_not_matter(unit):
    rows = [(s, a * unit, alpha, d * unit, theta) for s, a, alpha, d, theta in ARMS["Stanford"]]
    joints = sp.symbols("q1:7")
    entries = [(s, a, al, d + q * s, th + q * (1 - s)) for (s, a, al, d, th), q in zip(rows, joints)]
    robot = Robot(DHTable(entries, joints=joints))
    q = np.array([0.3, -0.7, 0.4, 0.5, 0.9, 0.2])
    scaled = q * np.where(np.arange(6) == 2, unit, 1)
    answer = robot.inverse(robot.forward(scaled))
    assert len(answer) == 8 and np.abs(answer.q - scaled).max(axis=1).min() < 1e-9 * max(unit, 1)
