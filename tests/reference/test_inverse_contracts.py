"""Three contracts for every inverse model: soundness, recovery, completeness.

The poses are random ones and all combinations of round joint angles, where the workspace
limits, the singularities and the quadrant borders are. The oracle of the completeness test
is a multi-start least-squares search on the forward kinematics: it shares no algebra with the
closed forms.
"""

import numpy as np
import pytest

from autograder.reference import DHTable, Robot, Status, robots
from dhm.elbow import ElbowArm
from dhm.pen import PenArm

pytestmark = pytest.mark.filterwarnings("error")

ROUND = np.radians([0, 30, -30, 45, -45, 90, -90, 180])
RANDOM = 2000


def turned(angles, shift):
    """A constant frame to stand a robot on, or to hold as a tool."""
    return robots.spherical_wrist(0.0).forward(angles) + np.pad(np.reshape(shift, (3, 1)), ((0, 1), (3, 0)))


def mounted(robot, **changes):
    """The robot on a tilted base, with a bent tool, and some joints counted the other way."""
    table = robot.table
    backwards = {joint: -joint for joint in table.joints[::2]}
    rows = [(row.sigma, *(entry.subs(backwards, simultaneous=True) for entry in row.parameters)) for row in table.rows]
    rows[-1] = (*rows[-1][:4], rows[-1][4] + 0.3)
    return Robot(
        DHTable(
            rows,
            f"{robot.name}, mounted",
            table.joints,
            base=turned([0.3, 0.8, -1.1], [0.2, -0.1, 0.4]),
            tool=turned([0.9, 0.5, 0.2], [0.05, 0.02, 0.1]),
            values=table.values,
        ),
        robot.model,
    )


def aside(robot):
    """The robot with q5 counted from the posture where its wrist is bent at a right angle."""
    rows = list(robot.table.rows)
    rows[4] = (*[0, 0, rows[4].alpha, 0], rows[4].theta + np.pi / 2)
    return Robot(DHTable(rows, "wrist zero aside", values=robot.table.values), robot.model)


CATALOGUE = {name: getattr(robots, name) for name in robots.names()}
SOLVABLE = {name: robot for name, robot in CATALOGUE.items() if robot.has_inverse} | {
    "2R, equal links": robots.planar_2r(0.5, 0.5),
    "2R, long forearm": robots.planar_2r(0.2, 0.9),
    "3R, equal links": robots.planar_3r(0.4, 0.4, 0.1),
    "5R": robots.planar((0.5, 0.3, 0.2, 0.25, 0.1)),
    "4R, equal links": robots.planar((0.3, 0.3, 0.3, 0.3)),
    "4R, one long link": robots.planar((0.2, 0.9, 0.3, 0.1)),
    "SCARA, equal links": robots.scara(0.3, 0.3),
    "s600, equal links": robots.adept_s600(0.3, 0.3, 0.2),
    "elbow 3R, equal links": robots.elbow_3r(0.5, 0.5),
    "RX-90, unequal": robots.rx90(0.4, 0.5),
    "KR210, round": robots.kr210(0.7, 0.3, 1.0, 0.0, 1.0, 0.3),
    "EPFL, equal, hand": robots.epfl_arm(0.2, 0.5, 0.5, 0.15),
    "EPFL, no offset": robots.epfl_arm(0.0, 0.5, 0.6),
    "PUMA, no a3": robots.puma(0.4, 0.0, 0.15, 0.4),
    "pen, L1 = 0": robots.pen(L1=0.0),
    "pen, on the axis": robots.pen(L1=0.5, h2=0.0, L2=0.0),
    "pen, short": robots.pen(L1=0.5, p1=0.2),
    "RX-90, wrist zero aside": aside(robots.RX90),
    "RX-90, mounted": mounted(robots.RX90),
    "PUMA, mounted": mounted(robots.PUMA),
}


def joint_values(robot, count, seed):
    """Random joint values (count, n)."""
    return np.random.default_rng(seed).uniform(-np.pi, np.pi, (count, robot.inverse_model.joints))


def round_values(name):
    """All combinations of round angles (8^n, n); slides take the same numbers as metres.

    Variants of the six-axis robots of the catalogue take one combination in sixteen, arms without a class of their own
    one in 64: their poses cost more.
    """
    joints = SOLVABLE[name].inverse_model.joints
    combinations = np.stack(np.meshgrid(*[ROUND] * joints), axis=-1).reshape(-1, joints)
    own_class = SOLVABLE[name].model is not None
    if joints == 6 and (name not in robots.names() or not own_class):
        return np.random.default_rng(2).permutation(combinations)[:: 16 if own_class else 64]
    return combinations


def only_a_point(robot) -> bool:
    """Whether the task of the robot is a point, so that the orientation is not compared."""
    return robot.inverse_model.joints == 2 or robot.model in (ElbowArm, PenArm)


def pose_error(robot, q, T):
    """Largest deviation of the direct model at q (..., n) from poses T, shape (...)."""
    difference = np.abs(robot.forward(q) - T)
    return difference[..., :3, 3].max(-1) if only_a_point(robot) else difference.max((-1, -2))


def distance(robot, q, q0):
    """Largest joint difference, angles modulo a turn, shape (...)."""
    difference = q - q0
    revolute = robot.inverse_model.revolute
    difference[..., revolute] = np.angle(np.exp(1j * difference[..., revolute]))
    return np.abs(difference).max(-1)


def chunks(values, size=20_000):
    return (values[start : start + size] for start in range(0, len(values), size))


def assert_sound(robot, batch, T):
    assert batch.valid.any(axis=1).all(), "a reachable pose is called unreachable"
    assert np.isfinite(batch.q).all() and np.isfinite(batch.excess).all()
    assert (batch.excess == 0).all() and (batch.failure == 0).all()
    angles = batch.q[..., robot.inverse_model.revolute]
    assert (angles > -np.pi).all() and (angles <= np.pi).all()
    errors = pose_error(robot, batch.q[batch.valid], np.repeat(T, batch.count, axis=0))
    assert errors.max(initial=0.0) < 1e-9


def assert_distinct(robot, batch):
    """No two branches of a pose are the same posture."""
    branches = batch.q.shape[1]
    for i in range(branches):
        for j in range(i):
            both = batch.valid[:, i] & batch.valid[:, j]
            regular = both & ((batch.flags[:, i] | batch.flags[:, j]) == 0)
            gaps = distance(robot, batch.q[regular, i], batch.q[regular, j])
            assert gaps.min(initial=1.0) > 1e-7


@pytest.mark.parametrize("name", SOLVABLE)
def test_soundness_and_recovery_on_random_poses(name):
    robot = SOLVABLE[name]
    q = joint_values(robot, RANDOM, seed=1)
    T = robot.forward(q)
    batch = robot.inverse_batch(T)
    assert_sound(robot, batch, T)
    assert_distinct(robot, batch)
    regular = batch.status == Status.SOLVED
    gaps = np.where(batch.valid, distance(robot, batch.q, q[:, None]), np.inf).min(axis=1)
    assert gaps[regular].max(initial=0.0) < 1e-6
    family = robot.inverse_batch(T, near=q)
    assert_sound(robot, family, T)
    gaps = np.where(family.valid, distance(robot, family.q, q[:, None]), np.inf).min(axis=1)
    assert gaps.max() < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("name", SOLVABLE)
def test_soundness_and_recovery_at_round_angles(name):
    robot = SOLVABLE[name]
    for q in chunks(round_values(name)):
        T = robot.forward(q)
        family = robot.inverse_batch(T, near=q)
        assert_sound(robot, family, T)
        gaps = np.where(family.valid, distance(robot, family.q, q[:, None]), np.inf).min(axis=1)
        assert gaps.max() < 1e-6
        # Without near, only what is free is chosen differently.
        infinite = family.status == Status.INFINITE
        batch = robot.inverse_batch(T[infinite])
        assert_sound(robot, batch, T[infinite])
        np.testing.assert_array_equal(batch.status, Status.INFINITE)


def least_squares_search(robot, T, starts, seed, rounds=60):
    """Joint values (M, n) reached from random starts for poses T (N, 4, 4), with their poses.

    Damped Gauss-Newton on the direct model with a finite-difference Jacobian.
    """
    n = robot.inverse_model.joints
    q = np.random.default_rng(seed).uniform(-np.pi, np.pi, (len(T) * starts, n))
    pose = np.repeat(np.arange(len(T)), starts)
    step = 1e-6

    def residual(q, pose):
        difference = (robot.forward(q) - T[pose])[:, :3]
        if only_a_point(robot):
            return difference[:, :, 3]
        return difference.reshape(len(q), 12)

    damping = np.full(len(q), 1e-2)
    error = residual(q, pose)
    found_q, found_pose = [], []
    for _ in range(rounds):
        if not len(q):
            break
        shifted = residual((q[:, None] + step * np.eye(n)).reshape(-1, n), np.repeat(pose, n))
        shifted = shifted.reshape(len(q), n, -1)
        jacobian = (shifted - error[:, None]) / step
        normal = jacobian @ jacobian.transpose(0, 2, 1) + damping[:, None, None] * np.eye(n)
        move = np.linalg.solve(normal, (jacobian @ error[..., None]))[..., 0]
        candidate = q - move
        its_error = residual(candidate, pose)
        better = (its_error**2).sum(1) < (error**2).sum(1)
        q = np.where(better[:, None], candidate, q)
        error = np.where(better[:, None], its_error, error)
        damping = np.clip(np.where(better, damping / 5, damping * 3), 1e-9, 1e3)
        done = np.abs(error).max(1) < 1e-11
        found_q.append(q[done])
        found_pose.append(pose[done])
        q, pose, error, damping = q[~done], pose[~done], error[~done], damping[~done]
    return np.concatenate(found_q), np.concatenate(found_pose)


@pytest.mark.slow
@pytest.mark.parametrize("name", SOLVABLE)
def test_completeness_against_a_numeric_search(name):
    robot = SOLVABLE[name]
    joints = robot.inverse_model.joints
    poses, starts = (200, 24) if joints < 6 else (200, 60)
    q = joint_values(robot, poses, seed=3)
    T = robot.forward(q)
    found, pose = least_squares_search(robot, T, starts, seed=4)
    assert len(found) > poses, "the search itself must succeed"
    batch = robot.inverse_batch(T[pose], near=found)
    gaps = np.where(batch.valid, distance(robot, batch.q, found[:, None]), np.inf)
    assert gaps.min(axis=1).max() < 1e-5, "the search found a posture that solve does not list"
    regular = robot.inverse_batch(T)
    if (regular.status == Status.SOLVED).all():
        branch = gaps.argmin(axis=1)
        hit = np.zeros_like(regular.valid)
        hit[pose, branch] = True
        assert hit[regular.valid].mean() > 0.85, "the search must reach most branches itself"


@pytest.mark.parametrize("name", SOLVABLE)
def test_poses_out_of_reach_are_refused_with_a_reason(name):
    robot = SOLVABLE[name]
    T = robot.forward(joint_values(robot, 50, seed=5))
    T[:, :3, 3] += 30.0 * np.array([0.6, 0.48, 0.64])
    batch = robot.inverse_batch(T)
    assert not batch.valid.any() and not batch.q.any()
    assert (batch.excess > 1.0).all()
    answer = batch[0]
    assert answer.status == "unreachable" and answer.q.shape == (0, robot.inverse_model.joints)
    assert f"{answer.excess:.3g}" in answer.reason and answer.labels == ()


@pytest.mark.slow
@pytest.mark.parametrize("name", SOLVABLE)
def test_nearest_is_the_nearest_of_all_solutions(name):
    robot = SOLVABLE[name]
    q, q0 = joint_values(robot, 20, seed=6), joint_values(robot, 20, seed=7)
    T = robot.forward(q)
    found = [robot.nearest(*each) for each in zip(T, q0, strict=True)]
    gaps = np.array([one.distance for one in found])
    assert pose_error(robot, np.array([one.q for one in found]), T).max() < 1e-9
    assert all(one.label for one in found)
    everything = robot.inverse_batch(T)
    difference = everything.q - q0[:, None]
    revolute = robot.inverse_model.revolute
    difference[..., revolute] = np.angle(np.exp(1j * difference[..., revolute]))
    norms = np.where(everything.valid, np.linalg.norm(difference, axis=-1), np.inf)
    assert (gaps <= norms.min(axis=1) + 1e-9).all()
    if (everything.status == Status.SOLVED).all():
        np.testing.assert_allclose(gaps, norms.min(axis=1), atol=1e-9)


@pytest.mark.parametrize("model", dict.fromkeys(robot.model for robot in SOLVABLE.values() if robot.model))
def test_models_refuse_tables_of_other_robots(model):
    for robot in SOLVABLE.values():
        if robot.model is not model:
            with pytest.raises(ValueError):
                model(robot.table)


@pytest.mark.parametrize("name", ["RX90", "KR210", "EPFL_ARM", "PUMA"])
@pytest.mark.parametrize("aside", [1e-3, 1e-5, 1e-7])
def test_beside_several_singularities_near_is_found_again(name, aside):
    """Where arm and wrist are singular together, rounding makes a line of what are points: near chooses on it.

    It may fail where two limits of the arm meet there too: two of 11,520 poses.
    """
    robot, rng = getattr(robots, name), np.random.default_rng(0)
    q = rng.choice(ROUND, (720, 6)) + aside * rng.normal(size=(720, 6)) * rng.integers(0, 2, (720, 6))
    T = robot.forward(q)
    batch = robot.inverse_batch(T, near=q)
    gap = np.abs(np.angle(np.exp(1j * (batch.q - q[:, None])))).max(axis=-1)
    assert (np.where(batch.valid, gap, 9).min(axis=1) > 1e-3).sum() <= 1
    pose, branch = np.nonzero(batch.valid)
    assert np.abs(robot.forward(batch.q[pose, branch]) - T[pose]).max() < 2e-9
    apart = np.abs(np.angle(np.exp(1j * (batch.q[:, :, None] - batch.q[:, None])))).max(axis=-1) + 9 * np.eye(8)
    twice = (apart < 1e-6) & batch.valid[:, :, None] & batch.valid[:, None]
    assert not twice.any(), "a posture is listed twice"
