"""Rounded pi: angles typed or stored with few digits are read as the right angles they stand for, and that is said."""

import warnings

import numpy as np
import pytest
import sympy as sp

from autograder.reference import DHRow, DHTable, Robot, RoundedInput, UrdfJoint, robots, table_from_urdf
from dhm.transforms import exact_angle

pytestmark = pytest.mark.filterwarnings("error")

ROUNDED = [1.5708, 1.57079632679, 3.14159, -1.5708, -3.1416, 4.71239, 6.28319, 1.570796325, 1.5707, 1.57085]


@pytest.mark.parametrize("angle", ROUNDED)
@pytest.mark.parametrize("rest", [0, sp.Symbol("q1")])
def test_a_rounded_right_angle_is_exact_and_says_by_how_much(angle, rest):
    quarter = round(angle / (np.pi / 2))
    with pytest.warns(RoundedInput, match=f"{abs(angle - quarter * np.pi / 2):.2g} rad away"):
        assert exact_angle(angle + rest) == quarter * sp.pi / 2 + rest


@pytest.mark.parametrize("angle", [1.5, 1.571, 3.142, 0.7854, np.pi / 2 + 2e-4, 1e-3, np.pi / 2, -np.pi, 0.0, 0.3])
def test_other_angles_are_what_they_are(angle):
    assert abs(float(exact_angle(angle)) - angle) < 1e-12


def irb120(half, turn):
    rows = [(0, 0, 0, 0.29, None), (0, 0, -half, 0, None), (0, 0.27, 0, 0, None)]
    return [*rows, (0, 0.07, -half, 0.302, None), (0, 0, half, 0, None), (0, 0, -half, 0.072, turn + sp.Symbol("q6"))]


@pytest.mark.parametrize("half, turn", [(1.5708, 3.14159), (1.57079632679, 3.1416)])
def test_a_table_with_rounded_angles_is_solved(half, turn):
    with pytest.warns(RoundedInput, match="alpha = -?1.57|theta = 3.14"):
        robot = Robot(DHTable(irb120(half, turn), "IRB 120"))
    exact = Robot(DHTable(irb120(sp.pi / 2, sp.pi), "IRB 120"))
    q = np.random.default_rng(0).uniform(-3, 3, (20, 6))
    np.testing.assert_array_equal(robot.forward(q), exact.forward(q))
    assert all(len(robot.inverse(T)) >= 2 for T in robot.forward(q))
    with warnings.catch_warnings():  # what was read once is exact: nothing is said again
        warnings.simplefilter("error")
        robot.table.at({"q1": 0.3}).to_classic().to_modified()


def test_a_letter_with_a_rounded_value_is_read_the_same_way():
    table = DHTable([(0, 0, 0, 0, None), (0, 0.3, sp.Symbol("twist"), 0, None)], values={"twist": 3.14159})
    with pytest.warns(RoundedInput, match="alpha = 3.14159 is read as pi"):
        assert table.chain.sin_alpha[1] == 0
    with pytest.warns(RoundedInput, match="theta"):
        assert DHRow(1, 0, 0, sp.Symbol("q1"), 1.5708).theta == sp.pi / 2


def gen3_like(pi):
    """An arm whose URDF turns its axes by rounded multiples of pi, as that of the Kinova Gen3 lite does."""
    half = pi / 2
    joints = [((0, 0, 0.12), (0, 0, 0)), ((0, 0.03, 0.115), (half, 0, 0)), ((0, 0.28, 0), (-pi, 0, 0))]
    joints += [((0, -0.14, 0.02), (half, 0, 0)), ((0, 0, 0.1), (-half, 0, pi)), ((0, 0.1, 0), (half, 0, -half))]
    return [UrdfJoint(xyz, rpy, axis=(0, 0, 1)) for xyz, rpy in joints]


@pytest.mark.parametrize("pi", [3.14159, 3.1416, 2 * 1.57079632679])
def test_a_urdf_with_rounded_pi_has_its_ordinary_table(pi):
    exact = table_from_urdf(gen3_like(np.pi))
    with pytest.warns(RoundedInput, match="read as a multiple of 90 degrees, at most [0-9.e-]+ rad away"):
        rounded = table_from_urdf(gen3_like(pi))
    for row, wanted in zip(rounded.rows, exact.rows, strict=True):
        assert row.alpha == wanted.alpha and abs(row.constant) < 1
    q = np.random.default_rng(1).uniform(-3, 3, (20, 6))
    np.testing.assert_allclose(rounded.forward(q), exact.forward(q), atol=1e-12)


def test_a_urdf_whose_axes_are_rounded_has_its_ordinary_table():
    """The direction itself carries the noise: as an axis, or through two turns that nearly undo each other."""
    for axis, rpy in [((2e-6, -1, 3.7e-6), (0, 0, 0)), ((0, 1, 0), (0.3, 0.4, 0.5))]:
        back = (0, 0, 0)
        if any(rpy):
            turn = UrdfJoint((0, 0, 0), rpy).origin()[:3, :3].T
            back = tuple(
                round(float(a), 6)
                for a in (
                    np.arctan2(turn[2, 1], turn[2, 2]),
                    -np.arcsin(turn[2, 0]),
                    np.arctan2(turn[1, 0], turn[0, 0]),
                )
            )
        joints = [UrdfJoint((0, 0, 0), axis=(0, 1, 0)), UrdfJoint((0.4, 0, 0), rpy, kind="fixed")]
        joints += [UrdfJoint((0, 0, 0), back, axis), UrdfJoint((0.3, 0, 0), axis=(0, 1, 0))]
        with pytest.warns(RoundedInput, match="axes . and . are read as parallel|theta"):
            table = table_from_urdf(joints)
        assert all(abs(row.d) < 1 and sp.sin(row.alpha) == 0 for row in table.rows[1:])


def test_axes_that_are_almost_parallel_are_told():
    joints = [UrdfJoint((0, 0, 0), axis=(0, 0, 1)), UrdfJoint((0.4, 0, 0), (3.142, 0, 0), (0, 0, 1))]
    with pytest.warns(RoundedInput, match="axes 1 and 2 are almost parallel, 0.00041 rad apart"):
        table_from_urdf(joints)


def test_offsets_below_a_nanometre_do_not_open_a_wrist():
    joints = list(robots.KR210_JOINTS)
    joints[4] = UrdfJoint((0.54, 0, 3e-10), axis=(0, 1, 0))
    table = table_from_urdf(joints)
    assert table.rows[4].d == 0 and Robot(table).has_inverse
