"""Direct models: textbook form, shapes, batches, cross-checks with Pinocchio and the URDF."""

import numpy as np
import pinocchio
import pytest
import sympy as sp

from autograder.reference import robots
from autograder.reference.centres import epfl_centres, rotation_about, scara_centres
from dhm.few_postures import FEW

t1, t2, t3, t4, t5, t6 = t = sp.symbols("t1:7")
C1, C2, C4, C5, C6, C23 = (sp.cos(x) for x in (t1, t2, t4, t5, t6, t2 + t3))
S1, S2, S4, S5, S6, S23 = (sp.sin(x) for x in (t1, t2, t4, t5, t6, t2 + t3))


def test_rx90_comes_out_as_the_twelve_textbook_elements():
    a3, d3 = sp.symbols("a3 d3")
    s = C23 * (C4 * C5 * C6 - S4 * S6) - S23 * S5 * C6
    n = C23 * (-C4 * C5 * S6 - S4 * C6) + S23 * S5 * S6
    textbook = sp.Matrix(
        [
            [C1 * s - S1 * (S4 * C5 * C6 + C4 * S6), C1 * n - S1 * (-S4 * C5 * S6 + C4 * C6)],
            [S1 * s + C1 * (S4 * C5 * C6 + C4 * S6), S1 * n + C1 * (-S4 * C5 * S6 + C4 * C6)],
            [S23 * (C4 * C5 * C6 - S4 * S6) + C23 * S5 * C6, S23 * (-C4 * C5 * S6 - S4 * C6) - C23 * S5 * S6],
        ]
    ).row_join(
        sp.Matrix(
            [
                [C1 * (-C23 * C4 * S5 - S23 * C5) + S1 * S4 * S5, C1 * (a3 * C2 - d3 * S23)],
                [S1 * (-C23 * C4 * S5 - S23 * C5) - C1 * S4 * S5, S1 * (a3 * C2 - d3 * S23)],
                [-S23 * C4 * S5 + C23 * C5, a3 * S2 + d3 * C23],
            ]
        )
    )
    model = robots.RX90.symbolic_forward()
    assert model[:3, :] == textbook
    # sympy.simplify of the naive product, which takes ten seconds, needs 250 operations.
    assert sp.count_ops(model) <= 250


def test_opposite_axes_are_merged_too():
    """The s600's axis 4 points down, so theta4 is subtracted."""
    x_axis = robots.ADEPT_S600.symbolic_forward()[:2, 0]
    assert list(x_axis) == [sp.cos(t1 + t2 - t4), sp.sin(t1 + t2 - t4)]


def test_scara_model_of_the_slides():
    a2, a3, d2 = sp.symbols("a2 a3 d2")
    model = robots.SCARA.symbolic_forward()
    expected = [a2 * C1 + a3 * sp.cos(t1 + t2), a2 * S1 + a3 * sp.sin(t1 + t2), -d2]
    assert list(model[:3, 3]) == expected and model[0, 0] == sp.cos(t1 + t2 + t4)


def test_shapes_and_batches():
    robot = robots.KR210
    q = np.random.default_rng(0).uniform(-3, 3, (5, 3, 6))
    poses = robot.forward(q)
    assert poses.shape == (5, 3, 4, 4)
    np.testing.assert_allclose(robot.forward(q[2, 1]), poses[2, 1], atol=1e-14)
    assert robot.forward(np.empty((0, 6))).shape == (0, 4, 4)
    frames = robot.table.chain.frames(q)
    assert frames.shape == (5, 3, 6, 4, 4)
    np.testing.assert_allclose(
        frames[..., 5, :, :] @ np.array(robot.table.at(robot.table.values).tool, float), poses, atol=1e-14
    )


def test_blocks_of_a_large_batch_agree_with_single_poses():
    q = np.random.default_rng(1).uniform(-3, 3, (9000, 6))
    poses = robots.RX90.forward(q)
    for i in (0, 4095, 4096, 8999):
        np.testing.assert_allclose(poses[i], robots.RX90.forward(q[i]), atol=1e-14)


@pytest.mark.parametrize("name", robots.names())
def test_one_posture_is_that_of_many(name):
    """Scalars and arrays go different ways; a Jacobian is also what differences of poses say."""
    robot = getattr(robots, name)
    q = np.random.default_rng(2).uniform(-2, 2, (3, robot.table.chain.joints))
    for one, pose, J in zip(q, robot.forward(q), robot.jacobian(q)):
        np.testing.assert_allclose(robot.forward(one), pose, atol=1e-14)
        np.testing.assert_allclose(robot.jacobian(one), J, atol=1e-14)
        step = 1e-6 * np.eye(len(one))
        ahead, behind = robot.forward(one + step), robot.forward(one - step)
        np.testing.assert_allclose((ahead - behind)[:, :3, 3].T / 2e-6, J[:3], atol=1e-8)
        turns = (ahead - behind)[:, :3, :3] @ pose[:3, :3].T / 2e-6
        np.testing.assert_allclose(np.stack([turns[:, 2, 1], turns[:, 0, 2], turns[:, 1, 0]]), J[3:], atol=1e-8)


@pytest.mark.parametrize("name", robots.names())
def test_few_postures_are_those_of_many(name):
    """Dozens of postures go a way of their own, slides, coupled joints, bases and tools included."""
    robot = getattr(robots, name)
    q = np.random.default_rng(3).uniform(-2, 2, (FEW + 1, robot.table.chain.joints))
    for few in (q[:0], q[:1], q[:40], q):
        poses, jacobians = robot.table.chain.poses_and_jacobians(few)
        np.testing.assert_allclose(poses, robot.forward(few), atol=1e-14)
        np.testing.assert_allclose(jacobians, robot.jacobian(few), atol=1e-14)


def test_rx90_vector():
    expected = [
        [0.881333, -0.294060, -0.369839, 0.250502],
        [-0.182600, 0.509949, -0.840601, 0.091175],
        [0.435786, 0.808382, 0.395739, 0.732418],
        [0, 0, 0, 1],
    ]
    pose = robots.RX90.forward(np.radians([20, 40, -30, 50, 60, -70]))
    np.testing.assert_allclose(pose, expected, atol=6e-7)


def test_epfl_vector():
    expected = [
        [0.805099, -0.591963, 0.037350, 0.475538],
        [-0.234230, -0.375153, -0.896882, -0.721769],
        [0.544933, 0.713330, -0.440691, 0.537202],
        [0, 0, 0, 1],
    ]
    pose = robots.EPFL_ARM.forward(np.radians([20, 30, 50, -25, 40, 65]))
    np.testing.assert_allclose(pose, expected, atol=6e-7)


def test_kr210_vector():
    expected = [
        [0.606373, -0.646350, 0.463189, 1.120041],
        [0.501520, 0.762891, 0.408013, 0.588569],
        [-0.617082, -0.015110, 0.786754, 1.727872],
        [0, 0, 0, 1],
    ]
    pose = robots.KR210.forward(np.radians([25, -40, 30, 15, 50, -20]))
    np.testing.assert_allclose(pose, expected, atol=6e-7)
    np.testing.assert_allclose(robots.KR210.forward(np.zeros(6))[:3, 3], [2.153, 0, 1.946])


def test_s600_and_pen_vectors():
    pose = robots.ADEPT_S600.forward([*np.radians([30, 50]), -0.1, np.radians(20)])
    np.testing.assert_allclose(pose[:3, 3], [0.329212, 0.433322, -0.1], atol=6e-7)
    np.testing.assert_allclose(np.degrees(np.arctan2(pose[1, 0], pose[0, 0])), 60)
    q = np.radians([35, 20, 45])
    for robot, tip in {
        robots.PEN: (0.502232, 0.595822, 0.311309),
        robots.PEN_A: (0.335818, 0.479297, 0.533013),
        robots.PEN_B: (-0.223673, 0.087537, 0.350000),
        robots.PEN_C: (0.304125, 0.457105, -0.353154),
    }.items():
        np.testing.assert_allclose(robot.forward(q)[:3, 3], tip, atol=6e-7)


def test_two_scaras_are_related_by_the_sense_of_axis_4():
    first = robots.scara(0.325, 0.275).forward([0.4, 0.9, 0.1, 0.7])
    second = robots.ADEPT_S600.forward([0.4, 0.9, -0.1, -0.7])
    np.testing.assert_allclose(first @ np.diag([1, -1, -1, 1]), second, atol=1e-15)


@pytest.mark.parametrize("h", [0.0, 0.15])
def test_epfl_arm_as_rotations_about_centres(h):
    """P = K1 .. K6 P0 and R = R1 .. R6 are the DHm model of the same arm."""
    q = np.random.default_rng(2).uniform(-3, 3, 6)
    product = sp.eye(4)
    for centre in epfl_centres(q, 0.2, 0.5, 0.6):
        product = product * centre
    reference = sp.eye(4)
    reference[0, 3], reference[2, 3] = 0.2, 0.5 + 0.6 + h
    np.testing.assert_allclose(np.array(product * reference, dtype=float), robots.epfl_arm(h=h).forward(q), atol=1e-14)


def test_printed_centres():
    D3, L2, D4 = sp.symbols("D3 L2 D4")
    *_, k5, k6 = epfl_centres(t, D3, L2, D4)
    assert sp.expand(k6[:3, 3] - sp.Matrix([D3 * (1 - C6), -D3 * S6, 0])) == sp.zeros(3, 1)
    assert sp.expand(k5[:3, 3] - sp.Matrix([0, (L2 + D4) * S5, (L2 + D4) * (1 - C5)])) == sp.zeros(3, 1)
    turn = sp.Matrix([[C1, -S1], [S1, C1]])
    assert rotation_about(turn, [0, 0])[:2, :2] == turn


def test_scara_as_rotations_about_centres_in_the_plane():
    L1, L2, L4 = sp.symbols("L1 L2 L4")
    k1, k2, k4 = scara_centres((t1, t2, t4), (L1, L2))
    assert sp.expand(k4[:2, 2] - sp.Matrix([(L1 + L2) * (1 - C4), -(L1 + L2) * S4])) == sp.zeros(2, 1)
    point = k1 * k2 * k4 * sp.Matrix([L1 + L2 + L4, 0, 1])
    expected = robots.SCARA_EPFL.symbolic_forward()[:2, 3]
    assert sp.simplify(sp.expand_trig(point[:2, :] - expected)) == sp.zeros(2, 1)


def pinocchio_forward(placements, models, tool, q):
    model = pinocchio.Model()
    joint = 0
    for i, (placement, kind) in enumerate(zip(placements, models)):
        joint = model.addJoint(joint, kind, pinocchio.SE3(placement), f"joint_{i}")
    data = model.createData()
    poses = []
    for row in q:
        pinocchio.forwardKinematics(model, data, row)
        poses.append(data.oMi[joint].homogeneous @ tool)
    return np.array(poses)


def test_kr210_agrees_with_pinocchio_on_the_urdf_joints():
    q = np.random.default_rng(3).uniform(-np.pi, np.pi, (500, 6))
    *moving, gripper = robots.KR210_JOINTS
    kinds = {(0, 0, 1): pinocchio.JointModelRZ, (0, 1, 0): pinocchio.JointModelRY, (1, 0, 0): pinocchio.JointModelRX}
    poses = pinocchio_forward(
        [joint.origin() for joint in moving], [kinds[joint.axis]() for joint in moving], gripper.origin(), q
    )
    np.testing.assert_allclose(robots.KR210.forward(q), poses, atol=1e-12)


def test_rx90_agrees_with_pinocchio():
    """Joint placements written down from the figure: turns by +-90 degrees about x, no DH."""
    up, down = np.eye(4), np.eye(4)
    up[:3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
    down[:3, :3] = up[:3, :3].T
    upper_arm = np.eye(4)
    upper_arm[0, 3] = 0.45
    forearm = down.copy()
    forearm[1, 3] = 0.45
    q = np.random.default_rng(4).uniform(-np.pi, np.pi, (500, 6))
    poses = pinocchio_forward(
        [np.eye(4), up, upper_arm, forearm, up, down], [pinocchio.JointModelRZ() for _ in range(6)], np.eye(4), q
    )
    np.testing.assert_allclose(robots.RX90.forward(q), poses, atol=1e-12)
