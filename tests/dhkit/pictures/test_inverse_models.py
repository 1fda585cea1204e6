"""Pictures of a student's inverse models: blank and broken answers give a card, wrong ones say by how much they miss."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
import sympy

from dhkit.arms import arm_of
from dhkit.drawing import chain_frames, end_frame
from dhkit.drawing.arms import joint_points
from dhkit.pictures import inverse_models as pictures

H = np.pi / 2
ARM = (0.4, 0.7, -0.9)
Wx, Wy, d2, A = sympy.symbols("Wx Wy d2 A")
t2, t3, L1, L2 = sympy.symbols("t2 t3 L1 L2")


def arm(t1, t2, t3):
    return [[0, 0, 0, 0, t1], [0, 0, H, 0, t2], [0, 0.5, 0, 0, t3], [0, 0.4, 0, 0, 0]]


def rx90(t1, t2, t3, t4, t5, t6, a3=0.45, d3=0.45):
    return [
        [0, 0, 0, 0, t1],
        [0, 0, H, 0, t2],
        [0, a3, 0, 0, t3],
        [0, 0, -H, d3, t4],
        [0, 0, H, 0, t5],
        [0, 0, -H, 0, t6],
    ]


PRINTED = [[0, 0, 0, 0, 0.1], [0, 0, H, 0, 0.4], [0, 0.5, 0, 0, 0.3]]
POINT = chain_frames(arm(*ARM))[-1][:3, 3]
POSE = chain_frames(rx90(*ARM, 0.2, 0.0, 0.3))[-1]
OWN = arm_of({"arm": "sideways"})
CENTRE = joint_points(OWN, [*ARM, 0, 0, 0])[4]
ALIGNED = end_frame(OWN, [*ARM, 0.2, 0.0, 0.3])
SHOWN = {
    "own": lambda answer: pictures.show_own_configurations(answer, OWN, CENTRE),
    "wrist": lambda answer: pictures.show_own_configurations(answer, OWN, ALIGNED, ARM),
    "postures": lambda answer: pictures.show_all_postures(answer, arm, POINT),
    "poses": lambda answer: pictures.show_all_postures(answer, rx90, POSE),
    "function": lambda answer: pictures.show_inverse_of_pose(answer, rx90, POSE, 0.45, 0.45),
    "shoulder": lambda answer: pictures.show_shoulder(answer, 0.15, (-0.25, 0.4)),
    "row": lambda answer: pictures.show_repaired_row(answer, PRINTED, {}),
    "determinant": lambda answer: pictures.show_determinant(answer, (0.5, 0.4)),
    "direction": lambda answer: pictures.show_free_direction(answer, OWN, [*ARM, 0.2, 0.0, 0.3]),
}

pytestmark = pytest.mark.filterwarnings("error")


def said(ax) -> str:
    return "\n".join(text.get_text() for text in [*ax.texts, *ax.figure.texts])


@pytest.mark.parametrize("name", SHOWN)
def test_a_blank_shows_that_nothing_was_attempted(name):
    blank = (lambda *args: None) if name == "function" else ...
    assert "not attempted yet" in said(SHOWN[name](blank))


@pytest.mark.parametrize("name", SHOWN)
@pytest.mark.parametrize(
    "answer", ["a sentence", {"a": 1}, [[1, 2], [3]], sympy.Symbol("foreign"), lambda *args: 1 / 0, 1j, np.nan]
)
def test_no_answer_raises(name, answer):
    ax = SHOWN[name](answer)
    ax.figure.canvas.draw()
    assert "cannot be drawn" in said(ax)


def test_every_posture_says_whether_it_reaches_the_point():
    ax = SHOWN["postures"]([ARM, {"t3": ARM[2], "t2": ARM[1], "t1": ARM[0] + 2 * np.pi}, (0.4, 0.7, -0.8)])
    assert [text.get_text().partition(": ")[2] for text in ax.texts] == [
        "on the target",
        "on the target",
        "0.040 m off",
    ]
    for alone in (ARM, np.array(ARM), sympy.Matrix([ARM]), dict(zip(("t1", "t2", "t3"), ARM))):
        assert said(SHOWN["postures"](alone)) == "1: on the target"


def test_a_pose_is_missed_in_metres_and_degrees():
    ax = SHOWN["function"](lambda U, a3, d3: [(*ARM, 0.2, 0.0, 0.3), (*ARM, 0.1, 0.0, 0.3), (*ARM, 0.25, 0.0, 0.25)])
    assert [text.get_text() for text in ax.texts] == ["1: on the target", "2: 5.7° off", "3: on the target"]
    assert "no solution given" in said(SHOWN["function"](lambda *args: []))


def test_both_shoulders_end_where_the_formula_says():
    right = sympy.atan2(Wy, Wx) - sympy.atan2(d2, A)
    for formula, hits in ((right, 2), (sympy.atan2(Wy, Wx) - sympy.asin(d2 / sympy.sqrt(Wx**2 + Wy**2)), 1)):
        ends = [line.get_xydata()[-1] for line in SHOWN["shoulder"](formula).lines if line.get_linewidth() == 10]
        assert sum(np.allclose(end, (-0.25, 0.4)) for end in ends) == hits


def test_the_free_direction_is_told_from_one_that_moves_the_hand():
    assert "the end effector stays" in said(SHOWN["direction"]([0, 0, 0, 2, 0, -2]))
    assert "the end effector moves" in said(SHOWN["direction"]([0, 0, 0, 1, 0, 1]))


def test_the_determinant_vanishes_on_ink_lines():
    ax = SHOWN["determinant"](-L1 * L2 * sympy.sin(t3) * (L1 * sympy.cos(t2) + L2 * sympy.cos(t2 + t3)))
    assert len(ax.collections) >= 2
    assert len(SHOWN["determinant"](1 + L1).collections) == 1


def test_a_row_outside_the_table_is_refused_in_words():
    assert "expected a number from 1 to 3, found 7" in said(SHOWN["row"]([7, 0, 0, 0, 0, 0]))


def test_configurations_of_an_arm_say_how_far_they_are_off_the_target():
    assert "off the target: 1: 0 mm, 2: " in said(SHOWN["own"]([ARM, (0.4, 0.7, -0.8)]))
    assert "1: 0 mm and 0.0°, 2: 0 mm and 5.7°" in said(SHOWN["wrist"]([(0.5, 0.0, 0.0), (0.4, 0.0, 0.0)]))
