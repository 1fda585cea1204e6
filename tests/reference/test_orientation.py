"""Orientation against scipy's Rotation, which shares no code with ours."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from autograder.reference import orientation as ori
from dhkit.geometry import rotation, rotation_angle_between, wrap

pytestmark = pytest.mark.filterwarnings("error")
READINGS = [(axes, intrinsic) for axes in ori.EULER_SETS for intrinsic in (True, False)]
ROUND = np.radians([0, 30, -30, 45, -45, 90, -90, 180])


def scipy_matrix(angles, axes, intrinsic):
    letters = axes.upper() if intrinsic else axes
    flat = np.reshape(angles, (-1, 3))
    return Rotation.from_euler(letters, flat).as_matrix().reshape(np.shape(angles)[:-1] + (3, 3))


def random_rotations(seed, n):
    return Rotation.random(n, random_state=np.random.default_rng(seed)).as_matrix()


def round_angles():
    return np.stack(np.meshgrid(ROUND, ROUND, ROUND, indexing="ij"), axis=-1).reshape(-1, 3)


def is_degenerate(axes, middle):
    """The singular middle angles by definition, not by the library's test."""
    return np.abs(np.sin(middle) if axes[0] == axes[2] else np.cos(middle)) < 1e-12


def test_there_are_twelve_sets():
    assert len(set(ori.EULER_SETS)) == 12
    assert {ori.EULER_WRIST, ori.CARDAN_WRIST} < set(ori.EULER_SETS)


@pytest.mark.parametrize("axes, intrinsic", READINGS)
def test_matrix_agrees_with_scipy(axes, intrinsic):
    angles = np.random.default_rng(1).uniform(-np.pi, np.pi, (200, 3))
    assert (
        np.abs(ori.euler_matrix(angles, axes, intrinsic=intrinsic) - scipy_matrix(angles, axes, intrinsic)).max()
        < 1e-14
    )


@pytest.mark.parametrize("axes, intrinsic", READINGS)
def test_both_solutions_are_right_distinct_and_all(axes, intrinsic):
    angles = np.random.default_rng(2).uniform(-np.pi, np.pi, (2000, 3))
    R = scipy_matrix(angles, axes, intrinsic)
    found = ori.euler_angles(R, axes, intrinsic=intrinsic)
    assert found.angles.shape == (2000, 2, 3)
    assert not found.singular.any()
    assert np.abs(scipy_matrix(found.angles, axes, intrinsic) - R[:, None]).max() < 1e-13
    gap = np.abs(wrap(found.angles - angles[:, None])).max(axis=-1)
    assert (gap.min(axis=-1) < 1e-9).all(), "the generating triple is missing"
    assert (gap.max(axis=-1) > 1e-3).all(), "the two solutions coincide"


def test_no_third_solution_by_numeric_multistart():
    """Newton from a grid of starts finds nothing outside the two triples."""
    from scipy.optimize import least_squares

    for axes in ("zxz", "xzy"):
        R = random_rotations(3, 1)[0]
        found = ori.euler_angles(R, axes, intrinsic=True).angles
        hits = set()
        for start in np.stack(np.meshgrid(*[[-2.5, 0.0, 2.5]] * 3), -1).reshape(-1, 3):
            fit = least_squares(lambda q: (scipy_matrix(q, axes, True) - R).ravel(), start)
            if fit.cost < 1e-20:
                gap = np.abs(wrap(found - fit.x)).max(axis=-1)
                assert gap.min() < 1e-6
                hits.add(int(gap.argmin()))
        assert hits == {0, 1}


@pytest.mark.parametrize("axes, intrinsic", READINGS)
def test_round_angles_and_gimbal_lock(axes, intrinsic):
    angles = round_angles()
    R = scipy_matrix(angles, axes, intrinsic)
    found = ori.euler_angles(R, axes, intrinsic=intrinsic)
    assert np.isfinite(found.angles).all()
    assert np.abs(scipy_matrix(found.angles, axes, intrinsic) - R[:, None]).max() < 1e-12
    degenerate = is_degenerate(axes, angles[:, 1])
    assert (found.singular == degenerate).all()

    gap = np.abs(wrap(found.angles - angles[:, None])).max(axis=-1).min(axis=-1)
    assert (gap[~degenerate] < 1e-9).all()

    is_sum = found.sign[degenerate] > 0
    a, c = angles[degenerate, 0], angles[degenerate, 2]
    true = np.where(is_sum, a + c, a - c)
    assert np.abs(wrap(found.combination[degenerate] - true)).max() < 1e-12
    other = np.where(is_sum, a - c, a + c)
    assert np.ptp(other) > 1, "the free combination does vary in this test"


@pytest.mark.parametrize("axes, intrinsic", READINGS)
def test_the_family_of_a_singular_rotation_reproduces_it(axes, intrinsic):
    angles = round_angles()
    angles = angles[is_degenerate(axes, angles[:, 1])]
    R = scipy_matrix(angles, axes, intrinsic)
    found = ori.euler_angles(R, axes, intrinsic=intrinsic)
    for first in (0.0, 0.7, -2.0):
        members = found.family(first)
        assert np.allclose(members[:, 0], first)
        assert np.abs(scipy_matrix(members, axes, intrinsic) - R).max() < 1e-12
    assert np.abs(wrap(found.family(angles[:, 0]) - angles)[:, [0, 2]]).max() < 1e-12


@pytest.mark.parametrize("axes, intrinsic", READINGS)
@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-8, 1e-10, 1e-13])
def test_beside_gimbal_lock_the_rotation_is_still_reproduced(axes, intrinsic, side, distance):
    angles = np.random.default_rng(4).uniform(-3, 3, (50, 3))
    pole = np.array([0, np.pi]) if axes[0] == axes[2] else np.array([-np.pi / 2, np.pi / 2])
    angles[:, 1] = np.resize(pole, 50) + side * distance
    R = scipy_matrix(angles, axes, intrinsic)
    found = ori.euler_angles(R, axes, intrinsic=intrinsic)
    assert (found.singular == (distance < 1e-9)).all()
    assert np.abs(scipy_matrix(found.angles, axes, intrinsic) - R[:, None]).max() < 2 * 1e-10


@pytest.mark.parametrize("axes, intrinsic", READINGS)
def test_first_solution_agrees_with_scipy(axes, intrinsic):
    R = random_rotations(5, 500)
    letters = axes.upper() if intrinsic else axes
    theirs = Rotation.from_matrix(R).as_euler(letters)
    ours = ori.euler_angles(R, axes, intrinsic=intrinsic).angles[:, 0]
    assert np.abs(wrap(ours - theirs)).max() < 1e-9


def test_confusing_intrinsic_and_extrinsic_is_noticed():
    angles = np.array([0.3, 0.5, -0.8])
    body = ori.euler_matrix(angles, "xzy", intrinsic=True)
    fixed = ori.euler_matrix(angles, "xzy", intrinsic=False)
    assert rotation_angle_between(body, fixed) > 0.1


def test_shapes_follow_the_batch():
    R = random_rotations(6, 24).reshape(2, 3, 4, 3, 3)
    found = ori.euler_angles(R, "zyz", intrinsic=True)
    assert found.angles.shape == (2, 3, 4, 2, 3) and found.status.shape == (2, 3, 4)
    assert ori.euler_angles(np.empty((0, 3, 3)), "zyz", intrinsic=True).angles.shape == (0, 2, 3)


def test_a_singular_pose_names_its_free_direction():
    R = ori.rpy_matrix(0.2, np.pi / 2, 0.5)
    said = ori.rpy(R).describe(("phi", "theta", "psi"))
    assert said == "phi - psi = -0.3 rad, phi + psi free"
    said = ori.rpy(ori.rpy_matrix(0.2, -np.pi / 2, 0.5)).describe(("phi", "theta", "psi"))
    assert said == "phi + psi = 0.7 rad, phi - psi free"
    assert ori.rpy(np.eye(3)).describe() == "two solutions"
    with pytest.raises(ValueError, match="no free angle"):
        ori.rpy(np.eye(3)).family(0.1)
    with pytest.raises(ValueError, match="one rotation at a time"):
        ori.rpy(np.stack([R, R])).describe()


def test_rpy_of_the_documents_vector():
    """EPFL slides: two triples; with the sign lost they describe another rotation."""
    angles = np.radians([20, 35, 50])
    R = ori.rpy_matrix(*angles)
    first, second = np.degrees(ori.rpy(R).angles)
    assert np.allclose(first, [20, 35, 50])
    assert np.allclose(second, [-160, 145, -130])
    sign_lost = ori.rpy_matrix(*np.radians([20, 145, 50]))
    assert rotation_angle_between(R, sign_lost) > 0.5


def test_wrists_of_the_documents_have_the_printed_products():
    p, n, r = 0.4, 1.1, -0.7
    Rx, Rz, Ry = (lambda t: rotation("x", t)), (lambda t: rotation("z", t)), (lambda t: rotation("y", t))
    assert np.allclose(ori.euler_matrix([p, n, r], ori.EULER_WRIST, intrinsic=True), Rz(p) @ Rx(n) @ Rz(r))
    assert np.allclose(ori.euler_matrix([p, n, r], ori.CARDAN_WRIST, intrinsic=True), Rx(p) @ Rz(n) @ Ry(r))


def test_wrong_matrices_are_refused():
    reflection = np.diag([1.0, 1.0, -1.0])
    for bad, message in [
        (reflection, "reflection"),
        (2 * np.eye(3), "orthonormal"),
        (np.full((3, 3), np.nan), "NaN"),
        (np.eye(4), "shape"),
    ]:
        with pytest.raises(ValueError, match=message):
            ori.rpy(bad)
    with pytest.raises(ValueError, match="unknown Euler set"):
        ori.euler_angles(np.eye(3), "zzx", intrinsic=True)
    with pytest.raises(ValueError, match="'x', 'y' or 'z'"):
        rotation("u", 0.1)


def test_small_angles_are_not_lost():
    """arccos((trace - 1)/2) would return 0 or 1.5e-8 here."""
    angle = np.array([1e-9, 3e-9, 1e-7])
    R = rotation("x", angle)
    assert np.allclose(rotation_angle_between(R, np.eye(3)), angle, rtol=1e-7)
