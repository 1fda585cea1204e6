"""Plain geometry, held against SciPy, brute force and products of elementary moves."""

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from dhkit import geometry
from dhkit.geometry import (
    chain_products,
    classic_dh,
    common_normal,
    lies_between,
    link_axis,
    modified_dh,
    modified_dh_of_cosines,
    perpendicular,
    phasor,
    planar_joints,
    rigid_transform,
    rot,
    rotation,
    rotation_2d,
    rotation_angle_between,
    trans,
    two_link,
    unit_vector,
    wrap,
)

RNG = np.random.default_rng(7)
ROUND = np.radians([-360, -270, -180, -90, -45, 0, 30, 45, 90, 180, 270, 360])


# ---------------------------------------------------------------- angles


@pytest.mark.parametrize(
    ("angle", "expected"),
    [(0, 0), (np.pi, np.pi), (-np.pi, np.pi), (3 * np.pi, np.pi), (-5 * np.pi, np.pi), (4, 4 - 2 * np.pi), (-4, 2 * np.pi - 4)],
)  # fmt: skip
def test_wrap_is_half_open(angle, expected):
    assert wrap(angle) == pytest.approx(expected, abs=1e-12)


def test_wrap_does_not_take_a_huge_number_for_zero():
    assert (np.abs(wrap([1e17, 1e300, 1e308, -1e308])) > 1e-3).all()


def test_what_is_no_number_does_not_change_how_a_huge_one_is_wrapped():
    with np.errstate(invalid="ignore"):
        found = wrap([np.nan, 1e17, 0.5])
    assert np.isnan(found[0]) and found[1] == wrap(1e17) and found[2] == 0.5


def test_wrap_agrees_with_the_angle_of_the_complex_number_and_takes_any_shape():
    angles = RNG.uniform(-50, 50, (4, 5))
    assert np.allclose(wrap(angles), np.angle(np.exp(1j * angles)))
    assert wrap(np.nextafter(-np.pi, 0)) == np.pi  # a rounding neighbour is the same angle
    assert (wrap(ROUND) <= np.pi).all() and (wrap(ROUND) > -np.pi).all()


@pytest.mark.parametrize(
    ("angle", "low", "high", "inside"),
    [(0, -1, 1, True), (2 * np.pi, -1, 1, True), (2, -1, 1, False), (-3, 3, 4, True), (np.pi, 0, 2 * np.pi, True)],
)
def test_a_range_holds_an_angle_modulo_full_turns(angle, low, high, inside):
    assert lies_between(angle, low, high) == inside
    assert lies_between(angle - 4 * np.pi, [low, low], high).tolist() == [inside, inside]


def test_a_range_may_be_missed_by_the_tolerance():
    assert lies_between([0.99, 2.01], 1, 2, 0.02).all() and not lies_between([0.99, 2.01], 1, 2, 0.005).any()


def test_directions_of_the_plane():
    angles = RNG.uniform(-9, 9, (2, 3))
    assert np.allclose(phasor(angles), np.exp(1j * angles))
    assert np.allclose(unit_vector(angles) @ (1, 1j), np.exp(1j * angles))
    assert unit_vector(np.pi / 2) == pytest.approx([0, 1])


@pytest.mark.parametrize("direction", [*np.eye(3), *-np.eye(3), (1, 1, 1), (2, -1, 0.5)])
def test_a_perpendicular_is_a_unit_vector_at_right_angles(direction):
    across = perpendicular(direction)
    assert across @ np.asarray(direction) == pytest.approx(0, abs=1e-15)
    assert np.linalg.norm(across) == pytest.approx(1)


def test_cross_is_the_vector_product():
    first, second = RNG.normal(size=(2, 5, 4, 3))
    assert np.allclose(geometry.cross(first, second), np.cross(first, second))


# ---------------------------------------------------------------- rotations and moves


@pytest.mark.parametrize("axis", "xyz")
def test_rotations_agree_with_scipy(axis):
    angles = np.concatenate([ROUND, RNG.uniform(-9, 9, 20)])
    expected = Rotation.from_euler(axis, angles[:, None]).as_matrix()
    assert np.allclose(rotation(axis, angles), expected, atol=1e-15)
    assert np.allclose(rot(axis, angles.reshape(4, 8))[..., :3, :3].reshape(-1, 3, 3), expected, atol=1e-15)
    assert np.allclose(rot(axis, angles)[:, [3, 3, 3, 3, 0, 1, 2], [0, 1, 2, 3, 3, 3, 3]], [0, 0, 0, 1, 0, 0, 0])


def test_a_plane_turns_as_space_about_z():
    angles = np.append(ROUND, RNG.uniform(-9, 9, 3))
    assert np.allclose(rotation_2d(angles), rotation("z", angles)[:, :2, :2])
    assert rotation_2d(0.3).shape == (2, 2)


@pytest.mark.parametrize("axis", "xyz")
def test_translations_move_along_their_axis(axis):
    distances = RNG.normal(size=(2, 3))
    moved = trans(axis, distances) @ np.array([1.0, 2, 3, 1])
    assert np.allclose(moved[..., :3] - (1, 2, 3), distances[..., None] * np.eye(3)["xyz".index(axis)])


def test_a_rigid_transform_has_the_given_axes_and_origin():
    turns, shifts = rotation("y", RNG.normal(size=(4, 1))), RNG.normal(size=(3, 3))
    frames = rigid_transform(turns, shifts)
    assert frames.shape == (4, 3, 4, 4) and np.allclose(
        frames[2, 1], trans("x", 0) @ rigid_transform(turns[2, 0], shifts[1])
    )
    assert np.allclose(frames[..., :3, 3], shifts) and np.allclose(frames[..., :3, :3], turns)
    assert np.allclose(frames[..., 3, :], (0, 0, 0, 1))


def test_the_angle_between_two_orientations_is_that_of_scipy_also_when_it_is_tiny():
    first, second = Rotation.random(50, RNG), Rotation.random(50, RNG)
    expected = (first.inv() * second).magnitude()
    assert np.allclose(rotation_angle_between(first.as_matrix(), second.as_matrix()), expected)
    assert rotation_angle_between(rotation("x", 0.4 + 1e-9), rotation("x", 0.4)) == pytest.approx(1e-9, rel=1e-6)
    assert rotation_angle_between(rotation("z", np.pi), np.eye(3)) == pytest.approx(np.pi)


def test_a_chain_is_the_product_of_its_steps():
    steps = RNG.normal(size=(3, 4, 4))
    expected = [np.eye(4), steps[0], steps[0] @ steps[1], steps[0] @ steps[1] @ steps[2]]
    assert np.allclose(chain_products(steps), expected)


@pytest.mark.parametrize("make", [rotation, rot, trans])
def test_an_unknown_axis_is_named(make):
    for axis in ("w", "xy", ""):
        with pytest.raises(ValueError, match=f"'x', 'y' or 'z', found '{axis}'"):
            make(axis, 0.3)


# ---------------------------------------------------------------- Denavit-Hartenberg


def dh_rows():
    alpha, theta = np.array(np.meshgrid(ROUND, ROUND)).reshape(2, -1)
    free = RNG.uniform(-4, 4, (2, 50))
    alpha, theta = np.append(alpha, free[0]), np.append(theta, free[1])
    return RNG.normal(size=alpha.shape), alpha, RNG.normal(size=alpha.shape), theta


def test_the_modified_matrix_is_the_product_of_its_four_moves():
    a, alpha, d, theta = dh_rows()
    expected = trans("x", a) @ rot("x", alpha) @ trans("z", d) @ rot("z", theta)
    assert np.allclose(modified_dh(a, alpha, d, theta), expected, atol=1e-14)


def test_the_classic_matrix_is_the_product_of_its_four_moves():
    a, alpha, d, theta = dh_rows()
    expected = rot("z", theta) @ trans("z", d) @ trans("x", a) @ rot("x", alpha)
    assert np.allclose(classic_dh(a, alpha, d, theta), expected, atol=1e-14)


@pytest.mark.parametrize("matrix", [modified_dh, classic_dh])
def test_parameters_broadcast(matrix):
    theta = RNG.uniform(-3, 3, (5, 2))
    found = matrix(0.4, [0, np.pi / 2], 0.1, theta)
    assert found.shape == (5, 2, 4, 4)
    assert np.allclose(found[3, 1], matrix(0.4, np.pi / 2, 0.1, theta[3, 1]))
    assert matrix(1, 0, 2, 0).shape == (4, 4)


def test_complex_parameters_stay_complex():
    found = modified_dh(0.2, 0.5j, 1, 1 + 0.3j)
    assert found.dtype == complex and found[0, 0] == pytest.approx(np.cos(1 + 0.3j))


def test_known_cosines_are_taken_as_they_are():
    exact = modified_dh_of_cosines(0.4, 0, 1, 0.1, -1, 0)
    assert exact.tolist() == [[-1, 0, 0, 0.4], [0, 0, -1, -0.1], [0, -1, 0, 0], [0, 0, 0, 1]]


# ---------------------------------------------------------------- lines


def nearest(first, second):
    """Nearest points of two lines, found by minimising their distance."""
    (p, u), (q, v) = (tuple(np.asarray(each, float) for each in line) for line in (first, second))
    found = minimize(lambda s: np.sum((p + s[0] * u - q - s[1] * v) ** 2), (0, 0), tol=1e-14)
    return np.array([p + found.x[0] * u, q + found.x[1] * v])


def test_the_common_normal_joins_the_nearest_points():
    for line in RNG.normal(size=(20, 2, 2, 3)):
        normal = common_normal(*line)
        assert np.allclose(normal.feet, nearest(*line), atol=1e-5)
        way = normal.feet[1] - normal.feet[0]
        assert np.abs(line[:, 1] @ way).max() < 1e-12
        assert not normal.parallel and not normal.meeting


def test_common_normals_are_batched():
    lines = RNG.normal(size=(2, 2, 6, 4, 3))
    lines[1, 1, 2] = -3 * lines[0, 1, 2]
    normal = common_normal(*lines)
    assert normal.feet.shape == (6, 4, 2, 3) and normal.parallel.sum() == 4
    for i in np.ndindex(6, 4):
        assert np.allclose(normal.feet[i], common_normal(*lines[:, :, *i]).feet)


@pytest.mark.parametrize(
    ("second", "parallel", "meeting", "feet"),
    [
        (((3, 4, 9), (0, 0, -2)), True, False, [(0, 0, 1), (3, 4, 1)]),
        (((0, 0, 7), (0, 0, 5)), True, True, [(0, 0, 1), (0, 0, 1)]),
        (((4, 0, 6), (-1, 0, 0)), False, True, [(0, 0, 6), (0, 0, 6)]),
        (((4, 2, 6), (-1, 0, 0)), False, False, [(0, 0, 6), (0, 2, 6)]),
    ],
)
def test_special_positions_of_two_lines(second, parallel, meeting, feet):
    normal = common_normal(((0, 0, 1), (0, 0, 3)), second)
    assert (normal.parallel, normal.meeting) == (parallel, meeting)
    assert np.allclose(normal.feet, feet)


def test_a_link_axis_is_normal_to_both_axes_and_leads_to_the_second():
    for first, second in RNG.normal(size=(10, 2, 2, 3)):
        x, feet = link_axis(first, second), common_normal(first, second).feet
        assert np.linalg.norm(x) == pytest.approx(1)
        assert x @ (feet[1] - feet[0]) == pytest.approx(np.linalg.norm(feet[1] - feet[0]))


def test_a_link_axis_of_meeting_axes_makes_alpha_positive():
    z, tilted = (0, 0, 1), (0, np.sin(2), np.cos(2))
    assert link_axis(((0, 0, 5), z), ((0, 0, 0), tilted)) == pytest.approx([-1, 0, 0])
    with pytest.raises(ValueError, match="one line"):
        link_axis(((0, 0, 0), z), ((0, 0, 4), (0, 0, -1)))


def test_a_direction_must_not_be_zero():
    with pytest.raises(ValueError, match="zero vector"):
        common_normal(((0, 0, 0), (0, 0, 1)), ((1, 0, 0), (0, 0, 0)))


# ---------------------------------------------------------------- planar arms


def test_joints_of_a_planar_arm_are_sums_of_its_links():
    lengths, q = [0.5, 0.4, 0.2], RNG.uniform(-3, 3, (2, 4, 3))
    points = planar_joints(lengths, q)
    assert points.shape == (2, 4, 4, 2)
    for i in np.ndindex(2, 4):
        at, heading = 0j, 0.0
        for k, length in enumerate(lengths):
            heading += q[i][k]
            at += length * np.exp(1j * heading)
            assert points[i][k + 1] == pytest.approx([at.real, at.imag])
    assert not points[..., 0, :].any()


@pytest.mark.parametrize("lengths", [(0.5, 0.3), (0.3, 0.5), (0.4, 0.4)])
def test_both_postures_of_a_two_link_arm_reach_its_target(lengths):
    q = RNG.uniform(-np.pi, np.pi, (200, 2))
    target = planar_joints(lengths, q)[:, -1] @ (1, 1j)
    arm = two_link(target, *lengths)
    assert arm.valid.all() and (arm.bend[0] >= 0).all() and (arm.bend[1] <= 0).all()
    for k in range(2):
        reached = planar_joints(lengths, np.stack([arm.first[k], arm.bend[k]], axis=-1))[:, -1] @ (1, 1j)
        assert np.abs(reached - target).max() < 1e-12
    # The posture that made the target is one of the two.
    gap = np.abs(wrap(np.stack([arm.first, arm.bend], axis=-1) - q)).max(axis=-1).min(axis=0)
    assert gap.max() < 1e-7
    assert np.allclose(arm.first_turn, np.exp(1j * arm.first)) and np.allclose(arm.bend_turn, np.exp(1j * arm.bend))


@pytest.mark.parametrize("direction", ROUND)
def test_limits_of_reach_have_one_posture(direction):
    for r, stretched, folded, bend in ((0.8, True, False, 0), (0.2, False, True, np.pi)):
        arm = two_link(r * np.exp(1j * direction), 0.5, 0.3)
        assert (arm.stretched, arm.folded) == (stretched, folded)
        assert arm.valid.tolist() == [True, False]
        assert arm.bend[0] == bend
        assert wrap(arm.first[0] - direction) == pytest.approx(0, abs=1e-12)


def test_beyond_the_limits_there_is_no_posture_but_the_nearest_one_is_told():
    arm = two_link([0.9j, 0.1j, 0.81j], 0.5, 0.3, tol=[0, 0, 0.02])
    assert arm.valid.tolist() == [[False, False, True], [False, False, False]]
    assert arm.beyond[0] == pytest.approx(0.1) and arm.short[1] == pytest.approx(0.1)
    assert np.isfinite(arm.first).all() and arm.first[0, 0] == pytest.approx(np.pi / 2)


def test_an_arm_folded_on_itself_turns_freely():
    arm = two_link([0, 0.4], 0.4, 0.4, anchor=[1.2, 3])
    assert arm.free.tolist() == [True, False]
    assert arm.first[0, 0] == pytest.approx(1.2) and arm.bend[0, 0] == np.pi
    assert np.isfinite(arm.first).all()


def test_lengths_of_links_may_differ_from_target_to_target():
    target, lengths = RNG.uniform(0.1, 0.4, (3, 4)) + 0.3j, RNG.uniform(0.4, 0.6, (2, 3, 4))
    arm = two_link(target, *lengths)
    for i in np.ndindex(3, 4):
        alone = two_link(target[i], *lengths[:, *i])
        assert np.allclose(arm.first[:, *i], alone.first) and (arm.valid[:, *i] == alone.valid).all()
