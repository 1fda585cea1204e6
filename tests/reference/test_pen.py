"""The pen robot: a surface instead of a volume, two effective angles instead of three."""

import numpy as np
import pytest

from autograder.reference import mobility, robots
from dhm.pen import PenArm

pytestmark = pytest.mark.filterwarnings("error")

READINGS = {"printed": robots.PEN, "A": robots.PEN_A, "B": robots.PEN_B, "C": robots.PEN_C}


def test_vector():
    tip = np.array([0.502232, 0.595822, 0.311309])
    model = robots.PEN.inverse_model
    assert isinstance(model, PenArm)
    exact = robots.PEN.forward(np.radians([35, 20, 45]))[:3, 3]
    np.testing.assert_allclose(exact, tip, atol=6e-7)
    np.testing.assert_allclose(np.degrees(model.effective(exact)), [[35, 65]], atol=1e-9)
    np.testing.assert_allclose(np.degrees(model.effective(tip, tol=1e-5)), [[35, 65]], atol=1e-3)
    outside = robots.PEN.inverse(exact * [1.05, 1.05, 1])
    assert outside.status == "unreachable" and "off the surface" in outside.reason


@pytest.mark.parametrize(
    "reading, shown",
    [
        ("printed", lambda phi, t1: phi),
        ("A", lambda phi, t1: phi + t1),
        ("B", lambda phi, t1: phi + t1 + np.pi / 2),
        ("C", lambda phi, t1: phi - np.pi / 2),
    ],
)
def test_readings_of_the_remark_shift_the_sum_only(reading, shown):
    """All readings have the printed robot's surface and count; theta2 + theta3 is shifted."""
    q = np.random.default_rng(0).uniform(-np.pi, np.pi, (50, 3))
    for point in robots.PEN.forward(q)[:, :3, 3]:
        ((t1, phi),) = robots.PEN.inverse_model.effective(point)
        ((its_t1, total),) = READINGS[reading].inverse_model.effective(point)
        assert np.angle(np.exp(1j * (its_t1 - t1))) == pytest.approx(0, abs=1e-9)
        assert np.angle(np.exp(1j * (total - shown(phi, t1)))) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("name", READINGS)
def test_only_two_of_three_joints_act(name):
    jacobians = READINGS[name].jacobian(np.random.default_rng(1).uniform(-3, 3, (20, 3)))
    assert (np.linalg.matrix_rank(jacobians[:, :3]) == 2).all()
    assert mobility(READINGS[name].table) == 2
    assert mobility(robots.PEN_REPAIRED.table) == 3


def test_any_member_of_the_family_reaches_the_point():
    answer = robots.PEN.inverse(robots.PEN.forward([0.4, 0.3, 0.9]))
    assert answer.free == "q2 + q3 = const" and answer.status == "infinite"
    members = answer.q[0] + np.linspace(-3, 3, 7)[:, None] * [0, 1, -1]
    np.testing.assert_allclose(np.ptp(robots.PEN.forward(members)[:, :3, 3], axis=0), 0, atol=1e-14)
    near = robots.PEN.nearest(robots.PEN.forward([0.4, 0.3, 0.9]), [0.4, 0.8, 0.8])
    np.testing.assert_allclose(near.q, [0.4, 0.6, 0.6], atol=1e-9)


def test_number_of_solutions():
    """Counts of (theta1, phi), special cases included."""
    h, p = 0.2, 0.5

    def count(robot, theta1, phi):
        return len(robot.inverse_model.effective(robot.forward([theta1, phi, 0])[:3, 3]))

    assert count(robots.pen(h2=h, L2=0, p1=p), 0.4, 0.7) == 1
    assert count(robots.pen(L1=0, h2=h, L2=0, p1=p), 0.4, 0.7) == 2
    # rho = 0: tip beside axis 1 at the distance H.
    phi = np.arcsin(-0.3 / 0.5)
    assert count(robots.pen(L1=0.3, h2=h, L2=0, p1=p), 0.4, phi) == 1
    on_axis = robots.pen(L1=0.3, h2=0, L2=0, p1=p)
    answer = on_axis.inverse(on_axis.forward([0.4, phi, 0]))
    assert answer.free == "q1 free, q2 + q3 = const" and answer.labels == ("tip on axis 1",)
    no_pen = robots.pen(p1=0.0)
    answer = no_pen.inverse(no_pen.forward([0.4, 0.2, 0.1]))
    assert answer.free == "q2 and q3 free"


@pytest.mark.parametrize("height", [0.1, 0.35, -0.2])
def test_two_circles_on_a_sheet(height):
    model = robots.PEN.inverse_model
    h1, L1, H, p1 = 0.1, 0.3, 0.2, 0.5
    reach = np.sqrt(p1**2 - (height - h1) ** 2)
    expected = sorted((np.hypot(H, L1 + s * reach) for s in (1, -1)), reverse=True)
    radii = model.circles(height)
    np.testing.assert_allclose(radii, expected, atol=1e-12)
    for radius in radii:
        point = [radius * np.cos(0.8), radius * np.sin(0.8), height]
        assert len(model.effective(point)) == 1
    assert model.effective([np.mean(radii), 0, height]) == []


def test_sheet_beyond_the_pen_and_touching_it():
    model = robots.PEN.inverse_model
    assert model.circles(0.7) == ()
    np.testing.assert_allclose(model.circles(0.6), [np.hypot(0.2, 0.3)])
