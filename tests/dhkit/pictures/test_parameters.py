"""Scenes and pictures of the parameter exercise: a right answer lies on the scene, a wrong one beside it, none raises."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from sympy import pi, symbols

from dhkit.drawing import draw_parallel_axes, draw_reading, draw_shelf
from dhkit.pictures import parameters as pictures

READING = (0.5, np.radians(40), 0.3, np.radians(50))
SKEW = ([0.2, 0.1, 0.9], [0, 0, 1]), ([0.9, 0.15, 0.4], [1, 2, 1])
t1, t2, t3, t4, t5, t6, a3, d3 = symbols("t1 t2 t3 t4 t5 t6 a3 d3")
PRINTED = [
    [0, 0, 0, 0, t1], [0, 0, pi / 2, 0, t2], [0, a3, 0, 0, t3],
    [0, 0, -pi / 2, d3, t4], [0, 0, pi / 2, 0, t5], [0, 0, -pi / 2, 0, t6],
]  # fmt: skip
POSE = {"t1": 0, "t2": 1.3, "t3": -2.3, "t4": 0.3, "t5": -0.7, "t6": 0.3, "a3": 0.45, "d3": 0.45}

SHOWN = {
    "reading": (pictures.show_reading, [0.5, -0.7, -0.3, 0.87], READING),
    "origin": (pictures.show_origin, [0.2, 0.1, 0.26], SKEW),
    "x_axis": (pictures.show_x_axis, [0.894, -0.447, 0], ([0.2, 0.1, 0.26], *SKEW)),
    "parallel": (pictures.show_parallel_axes, [0.5, 0.7], (0.4, 0.3, 0.7)),
    "frame": (pictures.show_frame, np.eye(4), SKEW),
    "rewritten": (pictures.show_rewritten, PRINTED, (PRINTED, POSE)),
    "gripper": (pictures.show_gripper_at_shelf, np.eye(4), (0.5, 0.4)),
    "link": (pictures.show_link, lambda P, u, Q, v: [0.8, 0.0], ()),
}

pytestmark = pytest.mark.filterwarnings("error")


def told(ax) -> str:
    axes = ax if isinstance(ax, list) else [ax]
    return " ".join(text.get_text() for each in axes for text in each.texts)


def marks(ax) -> np.ndarray:
    return np.array([np.ravel(line.get_data_3d()) for line in ax.lines if line.get_marker() == "+"])


@pytest.mark.parametrize("draw", [draw_reading, draw_parallel_axes, draw_shelf])
def test_scenes_can_be_drawn(draw):
    ax = draw()
    ax.figure.canvas.draw()
    assert ax.texts


@pytest.mark.slow
@pytest.mark.parametrize("name", SHOWN)
def test_an_answer_is_drawn(name):
    show, answer, given = SHOWN[name]
    ax = show(answer, *given)
    (ax[0] if isinstance(ax, list) else ax).figure.canvas.draw()
    assert len(plt.get_fignums()) == 1 and "cannot be drawn" not in told(ax)


@pytest.mark.parametrize("name", SHOWN)
@pytest.mark.parametrize("blank", [..., "text", [[1, 2], 3]])
def test_nothing_raises(name, blank):
    show, _, given = SHOWN[name]
    answer = (lambda *axes: blank) if name == "link" else blank
    card = told(show(answer, *given))
    assert card == "not attempted yet" if blank is ... else "cannot be drawn" in card


def test_a_frame_is_marked_where_the_parameters_put_it():
    reach, tilt, drop, turn = READING
    right = marks(pictures.show_reading([reach, -tilt, -drop, turn], *READING))
    wrong = marks(pictures.show_reading([reach, tilt, drop, turn], *READING))
    assert right == pytest.approx(np.array([[reach, -drop * np.sin(tilt), -drop * np.cos(tilt)]]))
    assert np.linalg.norm(right - wrong) > 0.1


def test_an_origin_and_a_height_are_marked():
    assert marks(pictures.show_origin([0.1, 0.2, 0.3], *SKEW)) == pytest.approx(np.array([[0.1, 0.2, 0.3]]))
    assert marks(pictures.show_parallel_axes([0.5, 0.6], 0.4, 0.3, 0.7)) == pytest.approx(np.array([[0, 0, 0.6]]))


def test_x_starts_in_p_while_there_is_no_origin():
    def lines(origin):
        return [
            np.round(np.transpose(line.get_data_3d()), 6).tolist()
            for line in pictures.show_x_axis([1, 0, 0], origin, *SKEW).lines
        ]

    assert [[0.2, 0.1, 0.9]] in lines(...) and [[0.5, 0.5, 0.5]] in lines([0.5, 0.5, 0.5])


def test_another_robot_looks_different():
    alphas_only = [[*row[:2], abs(row[2]), *row[3:]] for row in PRINTED]
    same, other = (pictures.show_rewritten(table, PRINTED, POSE) for table in (PRINTED, alphas_only))
    assert same[0].get_zlim() == pytest.approx(same[1].get_zlim())
    assert other[0].get_zlim() != pytest.approx(other[1].get_zlim())


def test_a_frame_that_is_none_is_told():
    ax = pictures.show_gripper_at_shelf(2 * np.eye(4), 0.5, 0.4)
    assert any("not a rigid displacement" in text.get_text() for text in ax.figure.texts)
