"""Drawings of the pen robot: its tip is where the product of its table is, drawings hold what they promise."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from dhkit.drawing import pen
from dhkit.drawing.chains import chain_frames
from matplotlib.patches import Circle

Q = np.radians([35, 20, 45])
HALF = np.pi / 2

pytestmark = pytest.mark.filterwarnings("error")


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.mark.parametrize("repaired", [False, True])
def test_the_tip_is_the_product_of_the_table(repaired):
    h1, L1, h2, L2, p1 = pen.SIZES.values()
    last = [0, L2, 0, 0, Q[2]] if repaired else [0, 0, 0, L2, Q[2]]
    rows = [[0, 0, 0, h1, Q[0]], [0, L1, -HALF, h2, Q[1] - HALF], last, [0, p1, 0, 0, 0]]
    assert pen.pen_tip(Q, repaired=repaired) == pytest.approx(chain_frames(rows)[-1][:3, 3])
    at = pen._joints_in_space(Q, pen.SIZES, repaired)
    assert at["P"] == pytest.approx(pen.pen_tip(Q, repaired=repaired))


def test_the_tip_known_by_hand():
    sizes = {"h1": 0.1, "L1": 0.3, "h2": 0.08, "L2": 0.12, "p1": 0.5}
    assert pen.pen_tip(Q, sizes) == pytest.approx([0.502232, 0.595822, 0.311309], abs=1e-6)
    assert pen.pen_tip(Q + [0, 0.7, -0.7], sizes) == pytest.approx(pen.pen_tip(Q, sizes))


DRAWINGS = {
    "robot": lambda: pen.draw_pen_robot(Q),
    "surface": lambda: pen.draw_pen_robot(Q, surface=(0, 3), names=False),
    "curve": lambda: pen.draw_pen_robot(Q, curve=np.eye(3), trace=np.eye(3) + 0.01),
    "repaired": lambda: pen.draw_pen_robot(Q, repaired=True, sheet=0.1),
    "views": lambda: pen.draw_pen_views(Q),
    "views_pen_inwards": lambda: pen.draw_pen_views((0.3, 0, -1.0)),
    "sheet": lambda: pen.draw_pen_sheet(0.15),
}


@pytest.mark.parametrize("name", DRAWINGS)
def test_every_drawing_can_be_shown(name):
    DRAWINGS[name]().figure.canvas.draw()


def test_the_circles_on_the_sheet_are_points_of_the_surface():
    circles = [patch.radius for patch in pen.draw_pen_sheet(0.15).patches if isinstance(patch, Circle)]
    for phi, radius in zip((np.pi - np.arcsin(np.sqrt(1 - (0.15 / 0.22) ** 2)), np.pi + np.arccos(0.15 / 0.22)), circles):
        x, y, z = pen.pen_tip([0.3, phi, 0.0])
        assert (np.hypot(x, y), z) == pytest.approx((radius, 0.15))
    assert not [patch for patch in pen.draw_pen_sheet(0.05).patches if isinstance(patch, Circle)]


@pytest.mark.parametrize(
    ("draw", "words"),
    [
        (lambda: pen.draw_pen_robot(Q[:2]), "expected 3 numbers"),
        (lambda: pen.draw_pen_robot(Q, {"h1": 1}), "a length for L1, L2, h2, p1"),
        (lambda: pen.draw_pen_views(Q, pen.SIZES | {"p1": -1}), "lengths must be positive"),
        (lambda: pen.draw_pen_robot(Q, curve=[(1, 2)]), "curve: expected n x 3"),
    ],
)
def test_bad_input_is_refused_in_words(draw, words):
    with pytest.raises(ValueError, match=words):
        draw()
