"""Geometric Jacobian, determinants in closed form, rank."""

import numpy as np
import pytest
import sympy as sp

from autograder.reference import (
    jacobian,
    mobility,
    rank,
    robots,
    rx90_determinant,
    scara_determinant,
    two_link_determinant,
)


@pytest.mark.parametrize("name", robots.names())
def test_jacobian_is_the_derivative_of_the_direct_model(name):
    robot = getattr(robots, name)
    q = np.random.default_rng(0).uniform(-2, 2, (4, len(robot.table.joints)))
    n, step = q.shape[-1], 1e-6
    shifted = [robot.forward(q[:, None] + sign * step * np.eye(n)) for sign in (1, -1)]
    derivative = (shifted[0] - shifted[1]) / (2 * step)
    rates = robot.jacobian(q)
    assert rates.shape == (4, 6, n)
    np.testing.assert_allclose(rates[:, :3], np.moveaxis(derivative[..., :3, 3], 1, 2), atol=1e-8)
    spin = derivative[..., :3, :3] @ np.swapaxes(robot.forward(q)[:, None, :3, :3], -1, -2)
    omega = np.stack([spin[..., 2, 1], spin[..., 0, 2], spin[..., 1, 0]], axis=1)
    np.testing.assert_allclose(rates[:, 3:], omega, atol=1e-8)


def test_determinants():
    q = np.random.default_rng(1).uniform(-3, 3, (50, 6))
    a3, d3 = 0.4, 0.55
    rx90 = np.linalg.det(robots.rx90(a3, d3).jacobian(q))
    np.testing.assert_allclose(rx90, rx90_determinant(a3, d3, q[:, 1], q[:, 2], q[:, 4]), atol=1e-14)
    two = np.linalg.det(robots.PLANAR_2R.jacobian(q[:, :2])[:, :2])
    np.testing.assert_allclose(two, two_link_determinant(1.0, 0.6, q[:, 1]), atol=1e-14)
    task = [0, 1, 2, 5]
    slides = np.linalg.det(robots.SCARA.jacobian(q[:, :4])[:, task])
    np.testing.assert_allclose(slides, scara_determinant(0.4, 0.3, q[:, 1], slide=-1), atol=1e-14)
    s600 = np.linalg.det(robots.ADEPT_S600.jacobian(q[:, :4])[:, task])
    np.testing.assert_allclose(s600, scara_determinant(0.325, 0.275, q[:, 1], turn=-1), atol=1e-14)
    l1, l2, t2 = sp.symbols("l1 l2 t2")
    assert two_link_determinant(l1, l2, t2) == l1 * l2 * sp.sin(t2)


@pytest.mark.parametrize(
    "degrees, expected",
    [
        ([20, 40, -30, 50, 60, -70], 6),
        ([20, 40, -30, 50, 0, -70], 5),
        ([20, 40, -30, 50, 180, -70], 5),
        ([20, 40, -90, 50, 60, -70], 5),
        ([20, 90, -90, 50, 0, -70], 4),  # straight up: axes 1, 4 and 6 are one line
        ([20, 90, -90, 0, 0, -70], 3),  # and axes 2, 3 and 5 lie parallel in one plane
    ],
)
def test_rank_drops_at_the_singularities_of_the_rx90(degrees, expected):
    assert rank(robots.RX90.table, np.radians(degrees)) == expected


def test_rank_exposes_the_printed_row_of_the_puma_like_table():
    assert mobility(robots.PUMA.table) == 6
    assert mobility(robots.PUMA_PRINTED.table) == 5
    rates = jacobian(robots.PUMA_PRINTED.table, np.random.default_rng(2).uniform(-3, 3, (30, 6)))
    np.testing.assert_allclose(rates[..., 4], rates[..., 5], atol=1e-14)


def test_every_robot_of_the_catalogue_has_the_freedoms_it_should():
    degenerate = {"PUMA_PRINTED": 5, "PEN": 2, "PEN_A": 2, "PEN_B": 2, "PEN_C": 2, "PLANAR_4R": 3}
    for name in robots.names():
        table = getattr(robots, name).table
        assert mobility(table) == degenerate.get(name, min(len(table.joints), 6)), name
