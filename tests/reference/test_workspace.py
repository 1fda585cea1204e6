"""Workspaces: clouds, radii, areas, outlines; exact results against integration and rasters."""

import numpy as np
import pytest

from autograder.reference import workspace as ws
from dhm.equations import type8
from dhm.tables import DHTable
from dhm.workspace import RRArm

pytestmark = [pytest.mark.filterwarnings("error"), pytest.mark.slow]
FULL = (-np.pi, np.pi)
PLANAR = DHTable([(0, 0, 0, 0, None), (0, 1.0, 0, 0, None), (0, 0.6, 0, 0, 0)], name="2R")


def elbow_arm(q):
    """Spatial 3R: base turn, then two links in the vertical plane."""
    rho = 0.5 * np.cos(q[..., 1]) + 0.4 * np.cos(q[..., 1] + q[..., 2])
    z = 0.5 * np.sin(q[..., 1]) + 0.4 * np.sin(q[..., 1] + q[..., 2])
    return np.stack([rho * np.cos(q[..., 0]), rho * np.sin(q[..., 0]), z], axis=-1)


def image_points(arm, n):
    """Forward points of a fine grid, by the formula of the slides and nothing else."""
    t1 = np.linspace(*arm.q1, n)[:, None]
    t2 = np.linspace(*arm.q2, n)[None, :]
    return np.stack(
        [arm.l1 * np.cos(t1) + arm.l2 * np.cos(t1 + t2), arm.l1 * np.sin(t1) + arm.l2 * np.sin(t1 + t2)], axis=-1
    ).reshape(-1, 2)


def measured_area(arm, n=500):
    """Area as the integral of |det J| over the joint ranges, each point counted once.

    det J = l1 l2 sin q2; a point that both elbows reach within the ranges is met
    twice and weighs half. How often it is met comes from solving the arm.
    """
    width = [min(high - low, 2 * np.pi) for low, high in (arm.q1, arm.q2)]
    middle = (np.arange(n) + 0.5) / n
    q1, q2 = np.meshgrid(arm.q1[0] + width[0] * middle, arm.q2[0] + width[1] * middle)
    x = arm.l1 * np.cos(q1) + arm.l2 * np.cos(q1 + q2)
    y = arm.l1 * np.sin(q1) + arm.l2 * np.sin(q1 + q2)
    solved = type8(arm.l1, arm.l2, x, y)
    within = solved.exists.copy()
    for joint, (low, _) in enumerate((arm.q1, arm.q2)):
        within &= np.mod(solved.values[..., joint] - low, 2 * np.pi) <= width[joint]
    times = np.maximum(within.sum(-1), 1)
    return np.mean(arm.l1 * arm.l2 * np.abs(np.sin(q2)) / times) * width[0] * width[1]


def random_arms(seed, n):
    rng = np.random.default_rng(seed)
    return [
        RRArm(
            *rng.uniform(0.3, 1, 2), q1=tuple(np.sort(rng.uniform(-4, 4, 2))), q2=tuple(np.sort(rng.uniform(-4, 4, 2)))
        )
        for _ in range(n)
    ]


# -- clouds -----------------------------------------------------------------------


def test_grid_is_the_image_of_every_pair():
    """p_ij belongs to the i-th value of joint 1 and the j-th of joint 2 (DH-m slides)."""
    limits = [(-1.0, 2.0), (0.3, 0.9)]
    points = ws.grid(PLANAR, limits, (5, 3))
    assert points.shape == (5, 3, 3)
    for i, t1 in enumerate(np.linspace(-1, 2, 5)):
        for j, t2 in enumerate(np.linspace(0.3, 0.9, 3)):
            expected = [np.cos(t1) + 0.6 * np.cos(t1 + t2), np.sin(t1) + 0.6 * np.sin(t1 + t2), 0]
            assert np.allclose(points[i, j], expected, atol=1e-14)


def test_three_ways_to_the_same_points():
    q1, q2 = np.linspace(-3, 3, 301), np.linspace(-2, 2, 211)
    pairs = np.stack(np.meshgrid(q1, q2, indexing="ij"), axis=-1)
    by_table = ws.grid(PLANAR, [(-3, 3), (-2, 2)], (301, 211))[..., :2]
    assert np.abs(ws.rr_grid(1.0, 0.6, q1, q2) - by_table).max() < 1e-14
    assert np.abs(ws.planar_points((1.0, 0.6), pairs) - by_table).max() < 1e-14
    assert not np.allclose(ws.rr_grid(1.0, 1.0, q1, q2), by_table), "l1 for l2, as once printed"


def test_planar_points_of_a_longer_arm_and_blocks():
    rng = np.random.default_rng(0)
    q = rng.uniform(-3, 3, (70_001, 4))
    lengths = np.array([0.4, 0.3, 0.2, 0.1])
    angle = np.cumsum(q, axis=-1)
    expected = np.stack([(lengths * np.cos(angle)).sum(-1), (lengths * np.sin(angle)).sum(-1)], -1)
    assert np.abs(ws.planar_points(lengths, q) - expected).max() < 1e-14
    assert ws.planar_points([1.0], np.zeros((2, 3, 1))).shape == (2, 3, 2)
    with pytest.raises(ValueError, match="2 lengths need"):
        ws.planar_points([1, 2], np.zeros((5, 3)))


def test_sample_stays_within_the_limits_and_covers_them():
    seen = []

    def forward(q):
        seen.append(q)
        return elbow_arm(q)

    limits = np.array([(-1, 1), (0.2, 0.3), (-2, -1)])
    points = ws.sample(forward, limits, 100_000, np.random.default_rng(1))
    q = np.concatenate(seen)
    assert points.shape == (100_000, 3) and len(q) == 100_000
    assert (q >= limits[:, 0]).all() and (q <= limits[:, 1]).all()
    assert np.abs(q.min(0) - limits[:, 0]).max() < 1e-3
    assert np.abs(q.max(0) - limits[:, 1]).max() < 1e-3
    again = ws.sample(elbow_arm, limits, 100_000, np.random.default_rng(1))
    assert (again == points).all()


def test_cross_section_of_a_spatial_arm():
    limits = [FULL, (0, np.pi / 2), (-np.pi / 2, np.pi / 2)]
    section = ws.cross_section(elbow_arm, limits, 20_000, np.random.default_rng(2))
    assert section.shape == (20_000, 2) and (section[:, 0] >= 0).all()
    cloud = ws.sample(elbow_arm, limits, 20_000, np.random.default_rng(2))
    turned = np.stack([np.hypot(cloud[:, 0], cloud[:, 1]), cloud[:, 2]], axis=-1)
    inside = RRArm(0.5, 0.4, q1=limits[1], q2=limits[2])
    signed = np.stack([section[:, 0], section[:, 1]], -1)
    mirrored = signed * [-1, 1]
    assert (inside.contains(signed) | inside.contains(mirrored)).all()
    reach = [np.linalg.norm(points, axis=-1).max() for points in (section, turned)]
    assert abs(reach[0] - reach[1]) < 1e-2

    def leaning(q):
        return elbow_arm(q)[..., [1, 2, 0]]

    with pytest.raises(ValueError, match="joint 1 does not turn"):
        ws.cross_section(leaning, limits, 100, np.random.default_rng(2))


def test_raster_boundary_of_a_ring_has_both_circles():
    rng = np.random.default_rng(3)
    r, t = np.sqrt(rng.uniform(0.5**2, 1, 400_000)), rng.uniform(-np.pi, np.pi, 400_000)
    raster = ws.cells(np.stack([r * np.cos(t), r * np.sin(t)], -1), 0.02)
    radius = np.linalg.norm(raster.boundary(), axis=1)
    assert ((np.abs(radius - 1) < 0.03) | (np.abs(radius - 0.5) < 0.03)).all()
    assert (radius > 0.75).any() and (radius < 0.75).any()
    assert abs(raster.area - np.pi * 0.75) < 2 * np.pi * 1.5 * 0.02


def test_bad_requests_are_refused():
    rng = np.random.default_rng(0)
    for bad, message in [([(0, 1, 2)], "pairs"), ([(1, 0)], "above its upper"), ([(0, np.inf)], "finite")]:
        with pytest.raises(ValueError, match=message):
            ws.sample(elbow_arm, bad, 10, rng)
    with pytest.raises(ValueError, match="at least one value"):
        ws.grid(elbow_arm, [(0, 1)] * 3, (2, 0, 2))
    with pytest.raises(ValueError, match="at least one point"):
        ws.sample(elbow_arm, [(0, 1)] * 3, 0, rng)
    with pytest.raises(ValueError, match="expected poses"):
        ws.sample(lambda q: q[..., 0], [(0, 1)] * 3, 5, rng)
    with pytest.raises(ValueError, match="positive"):
        ws.cells(np.zeros((3, 2)), 0)


# -- the RR arm, exact ---------------------------------------------------------------


@pytest.mark.parametrize("arm", random_arms(4, 40), ids=lambda arm: "")
def test_area_and_radii_agree_with_integration(arm):
    assert abs(arm.area() - measured_area(arm)) < 2e-3 * (0.1 + arm.area())
    distance = np.linalg.norm(image_points(arm, 1200), axis=-1)
    inner, outer = arm.radii()
    assert np.isclose(distance.min(), inner, atol=2e-5 + 4e-3 * (inner < 0.1))
    assert np.isclose(distance.max(), outer, atol=2e-5)
    assert inner <= distance.min() + 1e-12 and outer >= distance.max() - 1e-12


@pytest.mark.parametrize("arm", random_arms(5, 12), ids=lambda arm: "")
def test_contains_is_the_image_of_the_ranges(arm):
    rng = np.random.default_rng(6)
    q = rng.uniform([arm.q1[0], arm.q2[0]], [arm.q1[1], arm.q2[1]], (20_000, 2))
    assert arm.contains(ws.planar_points((arm.l1, arm.l2), q)).all()
    size = 2 * (arm.l1 + arm.l2) / 120
    raster = ws.cells(image_points(arm, 1500), size)
    away = rng.uniform(-1.7, 1.7, (20_000, 2)) * (arm.l1 + arm.l2) / 1.7
    place = np.floor((away - raster.corner) / size).astype(int)
    padded = np.pad(raster.filled, 300)
    near = np.zeros(len(away), bool)
    for dx in (-1, 0, 1):
        for dy in (-1, 0, 1):
            near |= padded[place[:, 0] + 300 + dx, place[:, 1] + 300 + dy]
    assert not arm.contains(away[~near]).any()


def test_textbook_area_of_one_sheet():
    arm = RRArm(1.0, 0.6, q1=(-0.5, 1.0), q2=(0.3, 2.0))
    by_hand = 1.0 * 0.6 * 1.5 * (np.cos(0.3) - np.cos(2.0))
    assert np.isclose(arm.sheet_area(), by_hand) and np.isclose(arm.area(), by_hand)
    mirrored = RRArm(1.0, 0.6, q1=(-0.5, 1.0), q2=(-2.0, -0.3))
    assert np.isclose(mirrored.area(), by_hand)
    touching = RRArm(1.0, 0.6, q1=(-0.5, 1.0), q2=(0.0, np.pi))
    assert np.isclose(touching.sheet_area(), touching.area())


@pytest.mark.parametrize("q2", [(-0.5, 1.0), (-1.0, 1.0), (2.5, 4.0), (-4.0, 4.0)])
def test_overlapping_sheets_are_refused_or_counted_once(q2):
    arm = RRArm(1.0, 0.6, q1=(-0.5, 1.0), q2=q2)
    with pytest.raises(ValueError, match="use area"):
        arm.sheet_area()
    lower = RRArm(1.0, 0.6, q1=arm.q1, q2=(q2[0], min(0.0, q2[1]) if q2[0] < 0 else np.pi))
    upper = RRArm(1.0, 0.6, q1=arm.q1, q2=(max(0.0, q2[0]) if q2[0] < 0 else np.pi, q2[1]))
    if q2 != (-4.0, 4.0):
        assert arm.area() < lower.area() + upper.area() - 1e-3, "the sheets do overlap here"
        assert arm.area() > max(lower.area(), upper.area())


def test_full_turn_gives_the_ring():
    for l1, l2 in [(1.0, 0.6), (0.6, 1.0), (0.5, 0.5)]:
        arm = RRArm(l1, l2)
        assert np.isclose(arm.area(), np.pi * ((l1 + l2) ** 2 - (l1 - l2) ** 2))
        assert np.allclose(arm.radii(), (abs(l1 - l2), l1 + l2))
        inner, outer = RRArm(l1, l2, q2=(0.4, 1.2)).radii()
        assert np.isclose(RRArm(l1, l2, q2=(0.4, 1.2)).area(), np.pi * (outer**2 - inner**2))
        assert np.isclose(RRArm(l1, l2, q1=(-9, 9), q2=(0.4, 1.2)).area(), np.pi * (outer**2 - inner**2)), (
            "a wider range is still one turn"
        )


def test_radii_follow_the_range_of_the_elbow():
    assert np.allclose(RRArm(1.0, 0.6, q2=(0.3, 3.0)).radii(), np.sqrt(1.36 + 1.2 * np.cos([3.0, 0.3])))
    assert np.isclose(RRArm(1.0, 0.6, q2=(-0.2, 1.0)).radii()[1], 1.6)
    assert np.isclose(RRArm(1.0, 0.6, q2=(3.0, 3.5)).radii()[0], 0.4)
    assert np.isclose(RRArm(1.0, 0.6, q2=(6.0, 6.5)).radii()[1], 1.6), "0 modulo a turn"


@pytest.mark.parametrize("arm", random_arms(7, 10) + [RRArm(1.0, 0.6), RRArm(0.5, 0.5)], ids=lambda arm: "")
def test_boundary_separates_inside_from_outside(arm):
    curves = arm.boundary(step=0.02)
    points = np.concatenate(curves)
    assert arm.contains(points, tolerance=1e-6).all()
    around = np.exp(1j * np.linspace(0, 2 * np.pi, 24, endpoint=False)) * 2e-3
    beside = points[:, None] + np.stack([around.real, around.imag], -1)
    assert (~arm.contains(beside).all(axis=1)).mean() > 0.99
    raster = ws.cells(image_points(arm, 1500), 0.02)
    distance = np.linalg.norm(raster.boundary()[:, None] - points, axis=-1).min(axis=1)
    assert np.quantile(distance, 0.99) < 0.03, "a part of the outline is missing"


def test_a_half_line_and_a_point_have_no_area():
    assert RRArm(1.0, 0.6, q1=(0.3, 0.3), q2=(0.2, 0.9)).area() == 0
    assert RRArm(1.0, 0.6, q1=(0.3, 0.9), q2=(0.2, 0.2)).area() == 0


def test_bad_arms_are_refused():
    for arguments, message in [
        ((0, 1), "l1 is a positive"),
        ((1, -1), "l2 is a positive"),
        ((1, 1, (1, 0)), "q1 is a range"),
        ((1, 1, FULL, (0, np.nan)), "q2 is a range"),
    ]:
        with pytest.raises(ValueError, match=message):
            RRArm(*arguments)
