"""Drawings of orientation: the turns are the right ones, hinges that meet share a line, bad input is refused."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest

from dhkit.drawing import draw_atan2, draw_brick_turns, draw_flip, draw_gimbal, draw_top, turn_in_steps
from dhkit.drawing.gimbal import gimbal_axes

ANGLES = np.radians([50, 35, 20])

pytestmark = pytest.mark.filterwarnings("error")


def texts(ax) -> list[str]:
    return [text.get_text() for text in ax.texts]


def test_moving_axes_in_one_order_are_fixed_axes_in_the_other():
    moving, fixed = turn_in_steps(ANGLES, "zyx"), turn_in_steps(ANGLES[::-1], "xyz", "fixed")
    assert moving[-1] == pytest.approx(fixed[-1])
    assert not np.allclose(moving[1], fixed[1])
    assert moving[-1][2] == pytest.approx(
        [-np.sin(ANGLES[1]), np.cos(ANGLES[1]) * np.sin(ANGLES[2]), np.cos(ANGLES[1]) * np.cos(ANGLES[2])]
    )


def test_hinges_of_the_second_solution_carry_the_same_hand():
    psi, theta, phi = ANGLES
    other = [psi + np.pi, np.pi - theta, phi + np.pi]
    assert turn_in_steps(other, "zyx")[-1] == pytest.approx(turn_in_steps(ANGLES, "zyx")[-1])
    assert gimbal_axes(other, "zyx")[1] == pytest.approx(-gimbal_axes(ANGLES, "zyx")[1])


@pytest.mark.slow
def test_locked_rings_show_two_lines_and_free_rings_three():
    def lines(angles, axes):
        return sum(len(line.get_xdata()) == 2 and line.get_zorder() == 1.0 for line in draw_gimbal(angles, axes).lines)

    assert lines(ANGLES, "zyx") == 3
    assert lines([0.3, np.pi / 2, 0.4], "zyx") == 2
    assert lines([0.3, 0.0, 0.4], "zyz") == 2
    assert r"$\psi\;(z), \varphi\;(z)$" in texts(draw_gimbal([0.3, 0.0, 0.4], "zyz"))


def test_turns_name_every_step():
    assert texts(draw_brick_turns(ANGLES, "zyx", about="fixed")).count("1. about the fixed $z$: 50°") == 1
    assert sum("about" in text for text in texts(draw_brick_turns(ANGLES[:2], "xz"))) == 2


def test_top_marks_the_axle_and_the_three_angles():
    assert {"$z_0$", "$z$", "$x'$", r"$\psi$", r"$\vartheta$", r"$\varphi$"} <= set(texts(draw_top()))
    assert "$z_0, z$" in texts(draw_top((0.4, 0.0, 0.3)))


def test_atan2_shows_the_angle_and_the_wrong_quotient_only_where_it_is_wrong():
    assert "atan2 = 135°" in texts(draw_atan2(1, -1)) and any("−45°" in text for text in texts(draw_atan2(1, -1)))
    assert not any("arctan(n/m)" in text for text in texts(draw_atan2(1, 1)))


def test_flip_falls_from_half_a_turn_through_a_quarter():
    line = draw_flip([np.radians(1)]).lines[0]
    assert line.get_ydata()[[0, 360, -1]] == pytest.approx([180, 90, 0], abs=1.5)


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda: draw_brick_turns([1, 2], "zyx"), "angles: expected 3 numbers, found 2"),
        (lambda: draw_brick_turns([1], "q"), "axes: expected letters x, y, z, found 'q'"),
        (lambda: draw_brick_turns([1], "z", about="own"), 'about: expected "moving" or "fixed"'),
        (lambda: draw_gimbal([1, 2, 3], "zzy"), "axes: neighbours must differ"),
        (lambda: draw_gimbal([1, 2], "zyx"), "angles: expected n x 3 numbers"),
        (lambda: draw_top(axes="xyz"), 'axes: expected "zxz" or "zyz"'),
        (lambda: draw_atan2(0, 0), "no direction"),
        (lambda: draw_flip([0.1, -0.1]), "misses: lengths must be positive"),
    ],
)
def test_bad_input_is_refused_in_words(draw, message):
    with pytest.raises(ValueError, match=message):
        draw()
    assert not plt.get_fignums()
