"""The drawings of direct models put links where the models put them."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest

from dhkit.drawing import draw_arm_turns, draw_six_axes, draw_turn_about
from dhkit.drawing.turns import turn_about
from dhkit.geometry import planar_joints, rotation, rotation_2d

pytestmark = pytest.mark.filterwarnings("error")


def test_a_turn_leaves_its_centre_alone():
    K = turn_about(rotation_2d(0.7), (0.3, -0.2))
    assert np.allclose(K @ [0.3, -0.2, 1], [0.3, -0.2, 1])
    assert np.allclose(K @ [1.3, -0.2, 1], [0.3 + np.cos(0.7), -0.2 + np.sin(0.7), 1])
    assert np.allclose(turn_about(rotation("x", 0.7), (1, 2, 3)) @ [5, 2, 3, 1], [5, 2, 3, 1])


@pytest.mark.parametrize("hand_first", [True, False])
def test_both_orders_of_the_turns_end_in_the_same_posture(hand_first):
    lengths, q = (0.5, 0.4, 0.2), (0.6, 0.9, -1.1)
    panels = draw_arm_turns(lengths, q, hand_first=hand_first)
    hands = [
        line.get_xydata()[0] for line in panels[-1].lines if line.get_marker() == "o" and line.get_markersize() == 5
    ]
    assert np.allclose(hands, [planar_joints(lengths, q)[-1]])
    centres = [ax.lines[-1].get_xydata()[0] for ax in panels]
    fixed = [(0.9, 0), (0.5, 0), (0, 0)]
    assert np.allclose(centres, fixed) == hand_first


def dots(ax):
    return [np.ravel(line.get_data_3d()) for line in ax.lines if line.get_marker() == "o"]


def test_the_six_axis_arm_is_drawn_where_its_closed_form_says():
    assert np.allclose(dots(draw_six_axes()), [(0.2, 0, 1.1), (0.2, 0, 1.3)])
    wrist, hand = dots(draw_six_axes(np.radians([20, 30, 50, -25, 40, 65]), h=0.1))
    assert np.allclose(wrist, (0.475538, -0.721769, 0.537202), atol=1e-6)
    assert np.allclose(hand - wrist, 0.1 * np.array([0.037350, -0.896882, -0.440691]), atol=1e-6)


def test_dimensions_stand_in_the_reference_position_only():
    names = {text.get_text() for text in draw_six_axes().texts}
    assert {"$L_2$", "$D_3$", "$D_4$", "$h$", r"$\theta_6$"} <= names
    names = {text.get_text() for text in draw_six_axes((0, 0.5, 0, 0, 0, 0)).texts}
    assert r"$\theta_6$" in names and "$L_2$" not in names


@pytest.mark.parametrize(
    "draw, said",
    [
        (lambda: draw_turn_about(0.5, (1, 2, 3)), "centre: expected 2 numbers"),
        (lambda: draw_arm_turns((1, 1, -1)), "lengths must be positive"),
        (lambda: draw_six_axes((0, 0, 0)), "t1 to t6: expected 6 numbers"),
    ],
)
def test_bad_input_is_refused_in_words(draw, said):
    with pytest.raises(ValueError, match=said):
        draw()
