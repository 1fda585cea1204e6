"""Drawings of the s600: the hand is where the model says, and an axis that points down turns clockwise."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.patches import Polygon

from dhkit.drawing.scara_s600 import LENGTHS, draw_s600_side, draw_s600_top, draw_type8

Q = np.radians([30, 50, 20])

pytestmark = pytest.mark.filterwarnings("error")


def texts(ax) -> list[str]:
    return [text.get_text() for text in ax.texts]


def label_at(ax, name):
    return next(np.array(text.get_position()) for text in ax.texts if text.get_text() == name)


def test_side_view_names_the_axes_and_the_signs_of_the_heights():
    shown = set(texts(draw_s600_side()))
    assert {"$z_0, z_1$", "$z_2$", "$z_3$", "$z_4$", "$d_2$", "$d_3$", "$r_{30} < 0$", "$r_3 < 0$"} <= shown
    raised = draw_s600_side(r3=0.1, r30=-0.2)
    assert "$r_3 > 0$" in texts(raised)
    assert label_at(raised, "$z_4$")[1] < label_at(raised, "$x_3, x_4$")[1]


@pytest.mark.parametrize("down", [True, False])
def test_top_view_turns_the_hand_clockwise_where_z4_points_down(down):
    ax = draw_s600_top(Q, down=down)
    hand = np.array([0.329212, 0.433322])
    x4 = label_at(ax, "$x_4$") - hand
    assert np.degrees(np.arctan2(x4[1], x4[0])) == pytest.approx(60 if down else 100, abs=0.01)


def test_type8_triangle_has_its_corner_ahead_and_the_hand_to_the_left():
    triangle = next(patch for patch in draw_type8(Q[:2]).patches if isinstance(patch, Polygon)).get_xy()
    ahead, hand = triangle[1], triangle[2]
    assert np.hypot(*ahead) == pytest.approx(LENGTHS[0] + LENGTHS[1] * np.cos(Q[1]))
    assert hand == pytest.approx([0.329212, 0.433322], abs=1e-6)
    assert ahead @ (hand - ahead) == pytest.approx(0)


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda: draw_s600_side(d2=-0.1), "d2 and d3: lengths must be positive"),
        (lambda: draw_s600_top([1, 2]), "t1, t2, t4: expected 3 numbers, found 2"),
        (lambda: draw_type8([1, 2, 3]), "t1 and t2: expected 2 numbers, found 3"),
    ],
)
def test_bad_input_is_refused_in_words(draw, message):
    with pytest.raises(ValueError, match=message):
        draw()
    assert not plt.get_fignums()
