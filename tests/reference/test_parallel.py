"""Planar parallel robots against geometry: circles of two legs scanned over phi.

The oracle intersects the circles of legs 1 and 2 for every phi of a fine grid
and brackets the zeros of leg 3's error along both branches. It has no
polynomial, no elimination and no Newton step in common with the solver.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

from autograder.reference import Status
from dhkit.geometry import wrap
from dhm.parallel import ThreeRPR, ThreeRRR

pytestmark = pytest.mark.filterwarnings("error")
CONGRUENT = ThreeRPR(base=[(0, 0), (1, 0), (0, 1)], platform=[(0, 0), (1, 0), (0, 1)])


def random_robot(seed):
    rng = np.random.default_rng(seed)
    return ThreeRPR(rng.uniform(-1, 1, (3, 2)), rng.uniform(-1, 1, (3, 2))), rng


def random_poses(rng, n, reach=0.5):
    return np.column_stack([rng.uniform(-reach, reach, (n, 2)), rng.uniform(-np.pi, np.pi, n)])


def leg_lengths(robot, pose):
    """Distances written out point by point, apart from the library's vectorised form."""
    x, y, phi = pose
    R = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])
    return np.array([np.linalg.norm(np.array([x, y]) + R @ b - a) for a, b in zip(robot.base, robot.platform)])


def pose_gap(found, poses):
    gap = np.abs(found.values - poses[..., None, :])
    gap[..., 2] = np.abs(wrap(gap[..., 2]))
    return np.where(found.exists, gap.max(-1), np.inf)


def third_leg_error(robot, lengths, phi, side):
    """Error of leg 3 with P on the circles of legs 1 and 2; NaN-free, and where it exists."""
    c, s = np.cos(phi)[:, None], np.sin(phi)[:, None]
    turned = [np.concatenate([c * b[0] - s * b[1], s * b[0] + c * b[1]], axis=1) for b in robot.platform]
    centre1, centre2, centre3 = (a - t for a, t in zip(robot.base, turned))
    between = centre2 - centre1
    distance = np.linalg.norm(between, axis=1)
    along = (distance**2 + lengths[0] ** 2 - lengths[1] ** 2) / (2 * distance)
    height = lengths[0] ** 2 - along**2
    real = height >= 0
    unit = between / distance[:, None]
    normal = np.column_stack([-unit[:, 1], unit[:, 0]])
    P = centre1 + along[:, None] * unit + side * np.sqrt(np.maximum(height, 0))[:, None] * normal
    return np.linalg.norm(P - centre3, axis=1) - lengths[2], real, P


def modes_by_circles(robot, lengths, n=20000):
    phi = np.linspace(-np.pi, np.pi, n, endpoint=False) + 1e-4
    modes = []
    for side in (1, -1):
        error, real, _ = third_leg_error(robot, lengths, phi, side)
        crossing = np.flatnonzero(real[:-1] & real[1:] & (error[:-1] * error[1:] < 0))
        for k in crossing:
            root = brentq(
                lambda t: third_leg_error(robot, lengths, np.array([t]), side)[0][0], phi[k], phi[k + 1], xtol=1e-13
            )
            P = third_leg_error(robot, lengths, np.array([root]), side)[2][0]
            modes.append([*P, root])
    return np.array(modes).reshape(-1, 3)


def ends_are_clean(robot, lengths, n=20000):
    """No root hides in the last cell of a branch, where both branches meet."""
    phi = np.linspace(-np.pi, np.pi, n, endpoint=False) + 1e-4
    up, real, _ = third_leg_error(robot, lengths, phi, 1)
    down, _, _ = third_leg_error(robot, lengths, phi, -1)
    edge = real & ~(np.roll(real, 1) & np.roll(real, -1))
    return (up[edge] * down[edge] > 0).all() and (up[[0, -1]] * down[[0, -1]] != 0).all()


def test_inverse_is_the_distance_between_the_joints():
    robot, rng = random_robot(0)
    poses = random_poses(rng, 50)
    lengths = robot.inverse(poses)
    assert np.allclose(lengths, [leg_lengths(robot, p) for p in poses], atol=1e-14)
    assert robot.inverse(poses.reshape(5, 10, 3)).shape == (5, 10, 3)


def test_jacobian_is_the_derivative_of_the_inverse():
    robot, rng = random_robot(4)
    poses, step = random_poses(rng, 50), 1e-6
    J = robot.jacobian(poses)
    for k in range(3):
        ahead, behind = (robot.inverse(poses + sign * step * np.eye(3)[k]) for sign in (1, -1))
        assert np.allclose(J[..., k], (ahead - behind) / (2 * step), atol=1e-7)
    on_anchor = robot.base[0] - robot.platform[0]
    assert np.isnan(robot.jacobian([*on_anchor, 0.0])[0]).all()


def test_jacobian_is_singular_where_modes_merge():
    platform = np.array([(-1, 0), (0.2, 0.1), (1, 0)])
    robot = ThreeRPR(base=platform + [(0, 0), (0, 0.3), (0, -0.2)], platform=platform)
    assert abs(np.linalg.det(robot.jacobian([0.0, 1.0, 0.0]))) < 1e-12
    assert abs(np.linalg.det(robot.jacobian([0.05, 1.0, 0.02]))) > 1e-3


@pytest.mark.parametrize("seed", range(6))
def test_direct_is_sound_and_recovers_the_pose(seed):
    robot, rng = random_robot(seed)
    poses = random_poses(rng, 400)
    found = robot.forward(robot.inverse(poses))
    assert np.isfinite(found.values).all() and (found.status != Status.UNREACHABLE).all()
    again = np.abs(robot.inverse(found.values) - robot.inverse(poses)[:, None]).max(-1)
    assert again[found.exists].max() < 1e-11
    assert pose_gap(found, poses).min(-1).max() < 1e-7
    regular = found.status == Status.SOLVED
    assert (found.count[regular] % 2 == 0).all(), "modes come in pairs away from singular poses"


def test_round_poses_with_phi_pi_among_them():
    """tan(phi / 2) is infinite at phi = pi; the solver must not notice."""
    rounded = np.radians([0, 30, -30, 45, -45, 90, -90, 180])
    grid = np.stack(np.meshgrid([-0.5, 0, 0.3, 1], [-0.5, 0, 0.3, 1], rounded), -1).reshape(-1, 3)
    for robot in (ThreeRPR(), random_robot(3)[0]):
        found = robot.forward(robot.inverse(grid))
        assert pose_gap(found, grid).min(-1).max() < 1e-6
        half_turn = np.abs(grid[:, 2] - np.pi) < 1e-12
        leading = robot.polynomial(robot.inverse(grid))
        relative = np.abs(leading[:, 0]) / np.abs(leading).max(-1)
        assert relative[half_turn].max() < 1e-12 < 1e-6 < np.median(relative[~half_turn])


@pytest.mark.parametrize("seed", range(8))
def test_direct_is_complete(seed):
    robot, rng = random_robot(seed)
    for pose in random_poses(rng, 6):
        lengths = leg_lengths(robot, pose)
        found = robot.forward(lengths)
        if found.status == Status.BOUNDARY or not ends_are_clean(robot, lengths):
            continue
        oracle = modes_by_circles(robot, lengths)
        assert len(oracle) == found.count
        for mode in oracle:
            assert pose_gap(found, mode).min() < 1e-8


def test_the_completeness_test_sees_enough_cases():
    """Guards the `continue` above, and shows that 2, 4 and 6 modes all occur."""
    counts = []
    for seed in range(8):
        robot, rng = random_robot(seed)
        poses = random_poses(rng, 6)
        counts += [
            int(robot.forward(robot.inverse(p)).count) for p in poses if ends_are_clean(robot, leg_lengths(robot, p))
        ]
    assert len(counts) > 40 and {2, 4, 6} <= set(counts) <= {2, 4, 6}


def test_polynomial_vanishes_at_the_modes_only():
    robot, rng = random_robot(5)
    pose = random_poses(rng, 1)[0]
    lengths = robot.inverse(pose)
    p = robot.polynomial(lengths)
    assert p.shape == (7,)
    relative = np.abs(np.polyval(p, np.tan(robot.forward(lengths).listed()[:, 2] / 2)))
    assert relative.max() < 1e-10 * np.abs(p).max()
    assert abs(np.polyval(p, np.tan((pose[2] + 0.1) / 2))) > 1e-6 * np.abs(p).max()


def test_legs_too_short_close_nowhere():
    found = ThreeRPR().forward([[0.01, 0.01, 0.01], [0.0, 0.0, 0.0]])
    assert (found.count == 0).all() and (found.status == Status.UNREACHABLE).all()


def test_congruent_platform_moves_along_a_circle():
    found = CONGRUENT.forward([0.5, 0.5, 0.5])
    assert found.status == Status.INFINITE and found.count == -1 and found.free == "P along a circle"
    x, y, phi = found.listed()[0]
    assert np.isclose(np.hypot(x, y), 0.5) and phi == 0
    turned = np.linspace(0, 6, 20)
    circle = np.column_stack([0.5 * np.cos(turned), 0.5 * np.sin(turned), 0 * turned])
    assert np.allclose(CONGRUENT.inverse(circle), 0.5), "the motion does keep the lengths"
    assert CONGRUENT.forward([0.5, 0.6, 0.5]).count > 0


def test_platform_pinned_at_one_point_turns_freely():
    """Anchors and platform points such that q1 = 0 lets the platform turn about A1."""
    robot = ThreeRPR(base=[(0, 0), (0, 0), (1, 0)], platform=[(0, 0), (1, 0), (0, 0)])
    found = robot.forward([0.0, 1.0, 1.0])
    assert found.status == Status.INFINITE and found.free == "phi"
    assert np.allclose(robot.inverse(found.listed()[0]), [0, 1, 1])
    phi = np.linspace(-3, 3, 7)
    assert np.allclose(robot.inverse(np.column_stack([0 * phi, 0 * phi, phi])), [0, 1, 1])


def test_two_modes_with_the_same_phi():
    """Both linear equations describe one line: the leg-1 circle is met twice."""
    robot = ThreeRPR(base=[(0, 0), (1, 0), (2, 0)], platform=[(0, 0), (0.5, 0), (1.0, 0)])
    pose = np.array([0.4, 0.7, 0.3])
    found = robot.forward(robot.inverse(pose))
    assert pose_gap(found, pose).min() < 1e-9
    phis = np.sort(found.listed()[:, 2])
    assert found.count == 4
    assert np.allclose(phis[0::2], phis[1::2], atol=1e-9)


def test_a_singular_pose_is_called_merging():
    """Three parallel legs: the platform can start to move sideways with its legs locked."""
    platform = np.array([(-1, 0), (0.2, 0.1), (1, 0)])
    robot = ThreeRPR(base=platform + [(0, 0), (0, 0.3), (0, -0.2)], platform=platform)
    pose = np.array([0.0, 1.0, 0.0])
    found = robot.forward(robot.inverse(pose))
    assert found.status == Status.BOUNDARY and pose_gap(found, pose).min() < 1e-6
    beside = robot.forward(robot.inverse(pose + [0.05, 0, 0.02]))
    assert beside.status == Status.SOLVED and beside.count % 2 == 0


def test_scaling_the_robot_scales_the_modes():
    robot, rng = random_robot(7)
    pose = random_poses(rng, 30)
    large = ThreeRPR(1000 * robot.base, 1000 * robot.platform)
    small, big = robot.forward(robot.inverse(pose)), large.forward(1000 * robot.inverse(pose))
    assert (small.count == big.count).all()
    assert np.abs(big.values[..., :2] - 1000 * small.values[..., :2]).max() < 1e-4


def test_batch_shapes_and_bad_input():
    robot = ThreeRPR()
    assert robot.forward(np.ones((2, 4, 3))).values.shape == (2, 4, 6, 3)
    assert robot.forward(np.empty((0, 3))).values.shape == (0, 6, 3)
    assert robot.forward([1.0, 1.0, 1.0]).exists.shape == (6,)
    for bad, message in [([1, 1], "three leg lengths"), ([1, 1, -1], "not negative"), ([1, 1, np.nan], "finite")]:
        with pytest.raises(ValueError, match=message):
            robot.forward(bad)
    with pytest.raises(ValueError, match="a pose is"):
        robot.inverse([1, 2])
    with pytest.raises(ValueError, match="two legs join"):
        ThreeRPR(base=[(0, 0), (0, 0), (1, 0)], platform=[(0, 0), (0, 0), (1, 1)])
    with pytest.raises(ValueError, match="coincide"):
        ThreeRPR(platform=[(1, 1)] * 3)
    with pytest.raises(ValueError, match="three points of the plane"):
        ThreeRPR(base=[(0, 0), (1, 0)])


# -- 3-RRR: the counter-example ---------------------------------------------------


def leg_tips(robot, postures):
    """Ends of the two-bar legs: postures (..., 6) -> (..., 3, 2)."""
    drive, elbow = postures[..., 0::2], postures[..., 1::2]
    l1, l2 = robot.proximal, robot.distal
    return robot.base + np.stack(
        [l1 * np.cos(drive) + l2 * np.cos(drive + elbow), l1 * np.sin(drive) + l2 * np.sin(drive + elbow)], axis=-1
    )


def platform_points(robot, poses):
    x, y, phi = np.moveaxis(poses, -1, 0)
    c, s = np.cos(phi)[..., None], np.sin(phi)[..., None]
    bx, by = robot.platform.T
    return np.stack([x[..., None] + c * bx - s * by, y[..., None] + s * bx + c * by], axis=-1)


def test_3rrr_has_eight_inverse_solutions():
    robot = ThreeRRR()
    rng = np.random.default_rng(20)
    poses = np.column_stack([rng.uniform(0.3, 0.6, 500), rng.uniform(0.2, 0.9, 500), rng.uniform(-0.5, 0.5, 500)])
    found = robot.inverse(poses)
    assert set(found.count.tolist()) == {0, 8} and (found.count == 8).mean() > 0.5
    gap = np.abs(leg_tips(robot, found.values) - platform_points(robot, poses)[:, None]).max((-1, -2))
    assert gap[found.exists].max() < 1e-12
    eight = found.values[found.count == 8]
    distance = np.abs(wrap(eight[:, :, None] - eight[:, None])).max(-1) + np.eye(8)
    assert distance.min() > 1e-6, "two of the eight coincide"


def test_3rrr_order_limits_and_refusals():
    robot = ThreeRRR()
    found = robot.inverse([0.45, 0.3, 0.1])
    signs = np.array([[1 - 2 * (k >> n & 1) for n in (2, 1, 0)] for k in range(8)])
    assert (np.sign(found.values[:, 1::2]) == signs).all()

    out_of_reach = robot.inverse([0.45, 1.5, 0.1])
    assert out_of_reach.status == Status.UNREACHABLE and out_of_reach.count == 0
    one_stretched = ThreeRRR(base=[(0, 0), (1, 0), (1, 0.5)], platform=[(0, 0), (0.5, 0.1), (0.5, 0.6)]).inverse(
        [0.95, 0.0, 0.0]
    )
    assert one_stretched.status == Status.BOUNDARY and one_stretched.count == 4
    folded = ThreeRRR(
        proximal=[0.5] * 3,
        distal=[0.5, 0.4, 0.4],
        base=[(0, 0), (1, 0), (0.4, 0.9)],
        platform=[(0, 0), (0.4, 0.1), (0.1, 0.3)],
    ).inverse([0.0, 0.0, 0.0])
    assert folded.status == Status.INFINITE and folded.count == -1
    with pytest.raises(ValueError, match="three positive lengths"):
        ThreeRRR(proximal=[0.5, 0.5, 0.0])


def test_the_slides_statement_is_not_general():
    """One inverse solution for the 3-RPR, eight for the 3-RRR, on the same platform and pose."""
    pose = [0.45, 0.3, 0.1]
    assert ThreeRPR().inverse(pose).shape == (3,)
    assert ThreeRRR().inverse(pose).count == 8
    assert ThreeRPR().forward(ThreeRPR().inverse(pose)).count > 1
