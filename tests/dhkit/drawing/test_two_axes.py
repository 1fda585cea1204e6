"""Drawings of the parameter rules: the common normal where it belongs, right-handed frames, labels inside the figure."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from mpl_toolkits.mplot3d import proj3d

from dhkit.drawing import draw_axis_cases, draw_gripper, draw_parameter_steps, draw_two_axes
from dhkit.drawing.two_axes import link_direction

UP = (0, 0, 1)
SKEW = ((0, 0, 0.75), UP), ((1, 0.5, 0.25), (0, -1, 1))
CROSSING = ((0, 0, -1), UP), ((0.5, 0, 0.2), (1, 0, 0))
PARALLEL = ((0, 0, 0.4), UP), ((0.3, 0.4, 0.9), UP)
SAME = ((0, 0, 0), UP), ((0, 0, 1), UP)

pytestmark = pytest.mark.filterwarnings("error")


def texts(ax):
    return [text.get_text() for text in ax.texts]


@pytest.mark.parametrize("lines", [SKEW, CROSSING, PARALLEL, SAME])
def test_every_link_has_a_direction_normal_to_both_axes(lines):
    x = link_direction(*lines)
    assert np.linalg.norm(x) == pytest.approx(1) and [x @ line[1] for line in lines] == pytest.approx([0, 0])


def test_normal_is_drawn_between_its_feet_and_named():
    ax = draw_two_axes(*SKEW)
    assert {"$Z_{1}$", "$Z_{2}$", "$X_{1}$", "$Y_{1}$", "$O_{1}$", "$a_{1}$", r"$\alpha_{1}$"} == set(texts(ax))
    assert any(
        np.shape(line.get_data_3d()) == (3, 2)
        and np.transpose(line.get_data_3d()) == pytest.approx(np.array([[0, 0, 0.75], [1, 0, 0.75]]))
        for line in ax.lines
    )


def test_parallel_axes_have_no_angle_and_intersecting_ones_no_length():
    assert r"$\alpha_{1}$" not in texts(draw_two_axes(*PARALLEL))
    assert "$a_{1}$" not in texts(draw_two_axes(*CROSSING))


@pytest.mark.parametrize("draw", [draw_gripper, lambda: draw_two_axes(*SAME, base=True)])
def test_labels_lie_inside_the_figure(draw):
    ax = draw()
    ax.figure.canvas.draw()
    for text in ax.texts:
        x, y, _ = proj3d.proj_transform(*text.get_position_3d(), ax.get_proj())
        across, up = ax.transData.transform((x, y)) / ax.figure.bbox.size
        assert 0.02 < across < 0.98 and 0.02 < up < 0.98, text.get_text()


def test_each_space_names_the_one_parameter_that_it_shows():
    names = ["$a_{i-1}$", r"$\alpha_{i-1}$", "$d_i$", r"$\theta_i$"]
    for panel, name in zip(draw_parameter_steps(), names):
        assert set(texts(panel)) & set(names) == {name}


@pytest.mark.slow
def test_figures_of_several_spaces():
    assert len(draw_axis_cases()) == 3
    panels = draw_parameter_steps(a=0.5, alpha=-0.3, d=-0.4, theta=2.0)
    panels[0].figure.canvas.draw()
    assert len(panels) == 4 and len(panels[0].figure.texts) == 4


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda: draw_two_axes(1, SKEW[1]), "first axis: expected a point and a direction, found 1"),
        (lambda: draw_two_axes(SKEW[0], ((0, 0, 0), (0, 0, 0))), "second axis, direction: .* not zero"),
        (lambda: draw_parameter_steps(a="long"), "a, alpha, d, theta: expected 4 numbers"),
    ],
)
def test_bad_input_is_refused_in_words(draw, message):
    with pytest.raises(ValueError, match=message):
        draw()
    assert not plt.get_fignums()
