"""Workspaces of one's own: what each arm with a slide covers, and from where a base reaches its stations, found another way."""

import numpy as np
import pytest

from autograder.questions import find
from autograder.questions.workspace.model import area, base, cloud, own_arm
from dhkit.planar_arms import SLIDING, places, sliding_limits, sliding_outline, stations
from dhkit.public import variant_ranges
from dhkit.variants import SETS, OwnNumbers, numbers_of_set

OWN = [OwnNumbers(numbers_of_set("workspace", which)) for which in range(SETS)]


def test_every_sliding_arm_is_in_the_class():
    assert (*SLIDING,) == variant_ranges("workspace")["slider"]
    assert {mine.slider for mine in OWN} == set(SLIDING)


@pytest.mark.parametrize("which", range(0, SETS, 3))
def test_area_is_that_within_the_outline(which):
    x, y = sliding_outline(OWN[which], 2000).T
    assert area(OWN[which]) == pytest.approx(abs(x @ np.roll(y, 1) - y @ np.roll(x, 1)) / 2, rel=1e-4)


@pytest.mark.parametrize("which", range(0, SETS, 5))
def test_the_cloud_is_where_the_walk_ends(which):
    mine = OWN[which]
    limits = [np.linspace(*row, 60) for row in sliding_limits(mine).values()]
    walked = [places(mine.slider, {"a": mine.a, "q1": q1, "q2": q2})[0][-1] for q2 in limits[1] for q1 in limits[0]]
    np.testing.assert_allclose(cloud(mine), walked, atol=1e-12)


@pytest.mark.parametrize("which", range(SETS))
def test_a_base_reaches_its_stations_from_one_interval(which):
    mine = OWN[which]
    arm, fine = own_arm(mine), np.linspace(-2.5, 2.5, 50001)
    near, far = (abs(arm.l1 + arm.l2 * np.exp(1j * bend)) for bend in arm.q2[::-1])
    distances = [np.hypot(fine - x, y) for x, y in stations(mine).values()]
    allowed = np.all([(near <= r) & (r <= far) for r in distances], axis=0)
    assert np.abs(np.diff(allowed.astype(int))).sum() == 2, "one interval"
    assert [fine[allowed].min(), fine[allowed].max()] == pytest.approx(base(mine), abs=2e-4)
    assert np.ptp(base(mine)) > 0.05


@pytest.mark.parametrize("which", range(SETS))
def test_no_mistake_about_a_base_looks_right_or_like_another(which):
    ways = [way.wrong for node in find("workspace.base").mistakes for way in node.ways]
    found = np.array([base(OWN[which]), *(base(OWN[which], **wrong) for wrong in ways)])
    apart = np.abs(found[:, None] - found).max(axis=2) + np.eye(len(found))
    assert apart.min() > 5 * find("workspace.base").accuracy
