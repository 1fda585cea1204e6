"""Pictures of a student's result on the s600: a right one lies on the robot, a wrong one does not, blanks show a card."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
from mpl_toolkits.mplot3d import Axes3D
from sympy import cos, pi, sin, symbols

from dhkit.pictures.scara_s600 import show_classic, show_configurations, show_linear, show_mgi, show_on_s600

X, Y, Z1, Z2, tj, d2, d3, r3, r30, t1, t2, t4 = symbols("X Y Z1 Z2 tj d2 d3 r3 r30 t1 t2 t4")
SAMPLE = {"t1": -0.4, "t2": 1.0, "r3": -0.1, "t4": 0.6, "d2": 0.325, "d3": 0.275, "r30": -0.08}
CLASSIC = [[d2, 0, 0, t1], [d3, 0, 0, t2], [0, pi, r3 + r30, 0], [0, 0, 0, t4]]
HAND = np.array([0.325 * np.cos(-0.4) + 0.275 * np.cos(0.6), 0.325 * np.sin(-0.4) + 0.275 * np.sin(0.6), -0.18])
LENGTHS, TARGET = (0.325, 0.275), (-0.2, 0.4)

pytestmark = pytest.mark.filterwarnings("error")


def said(ax) -> str:
    return " ".join(text.get_text() for text in [*ax.texts, *ax.figure.texts, ax.title])


def origin_and_z(ax):
    """Origin of the marked frame and the direction of its z axis."""
    origin = next(
        np.array(line.get_data_3d())[:, 0] for line in ax.lines if line.get_marker() == "o" and line.get_zorder() == 7
    )
    arrow = next(line for line in ax.lines if line.get_color() == "#0072B2")
    ends = np.array(arrow.get_data_3d())
    return origin, (ends[:, 1] - ends[:, 0]) / np.linalg.norm(ends[:, 1] - ends[:, 0])


def test_a_right_classic_table_ends_on_the_flange_with_z4_down():
    origin, z = origin_and_z(show_classic(CLASSIC, SAMPLE))
    assert origin == pytest.approx(HAND) and z == pytest.approx([0, 0, -1])
    early = [CLASSIC[0], [d3, pi, 0, t2], [0, 0, r3 + r30, 0], CLASSIC[3]]
    assert origin_and_z(show_classic(early, SAMPLE))[0][2] == pytest.approx(0.18)


def test_a_transform_is_drawn_where_it_is():
    frame = np.diag([1.0, -1.0, -1.0, 1.0])
    frame[:3, 3] = 0.1, 0.2, 0.3
    origin, z = origin_and_z(show_on_s600(frame, SAMPLE, base="1"))
    assert origin == pytest.approx([0.1, 0.2, 0.3]) and z == pytest.approx([0, 0, -1])


def formula(b1, b2):
    return [(Z1 * b1 + Z2 * b2) / (b1**2 + b2**2), (Z2 * b1 - Z1 * b2) / (b1**2 + b2**2)]


def test_linear_puts_both_hands_on_the_target_only_if_right():
    def strokes_to_target(pair):
        ends = [line.get_xydata() for line in show_linear(pair, LENGTHS, TARGET).lines if len(line.get_xydata()) == 2]
        return sum(np.isclose(points, TARGET).all(axis=1).any() for points in ends)

    ahead, left = X + Y * cos(tj), Y * sin(tj)
    assert strokes_to_target(formula(ahead, left)) == 4  # each forearm has an outline and a filling
    assert strokes_to_target(formula(left, ahead)) == 0


def test_linear_tells_when_cosine_and_sine_are_none():
    ahead, left = X + Y * cos(tj), Y * sin(tj)
    assert "= 1 and 1" in show_linear(formula(ahead, left), LENGTHS, TARGET).get_title()
    undivided = [entry * (ahead**2 + left**2) for entry in formula(ahead, left)]
    assert "= 1 and 1" not in show_linear(undivided, LENGTHS, TARGET).get_title()


def solved(x, y, z, omega, l2, l3, constant):
    c2 = (x**2 + y**2 - l2**2 - l3**2) / (2 * l2 * l3)
    if abs(c2) > 1 + 1e-9:
        return []
    bends = (
        {np.arccos(np.clip(c2, -1, 1)), -np.arccos(np.clip(c2, -1, 1))}
        if abs(c2) < 1 - 1e-9
        else {np.arccos(np.sign(c2))}
    )
    first = {bend: np.arctan2(y, x) - np.arctan2(l3 * np.sin(bend), l2 + l3 * np.cos(bend)) for bend in bends}
    return [(first[bend], bend, z - constant, first[bend] + bend - omega) for bend in bends]


def test_mgi_tells_missed_heights_and_counts_postures():
    right = show_mgi(solved, (0.325, 0.2))
    assert right.get_title() == "" and [text.get_text() for text in right.get_legend().get_texts()] == [
        "0 postures",
        "1 posture",
        "2 postures",
    ]
    wrong = show_mgi(lambda *pose: [(*row[:2], row[2] + 0.05, row[3]) for row in solved(*pose)], (0.325, 0.2))
    assert "height or direction missed" in wrong.get_title()


def test_configurations_carry_height_and_angle():
    rows = solved(0.29, 0.26, -0.2, 0.6, *LENGTHS, -0.05)
    legend = show_configurations(rows, LENGTHS, (0.29, 0.26), 0.6).get_legend()
    assert len(legend.get_texts()) == 2 and all("r_3" in text.get_text() for text in legend.get_texts())


@pytest.mark.parametrize(
    "show",
    [
        lambda: show_on_s600(..., SAMPLE),
        lambda: show_classic([[...] * 4] * 4, SAMPLE),
        lambda: show_linear([..., ...], LENGTHS, TARGET),
        lambda: show_mgi(lambda *pose: None, LENGTHS),
        lambda: show_configurations(..., LENGTHS, TARGET, 0.6),
    ],
)
def test_a_blank_shows_a_card(show):
    ax = show()
    assert not isinstance(ax, Axes3D) and "not attempted yet" in said(ax)


@pytest.mark.parametrize(
    "show",
    [
        lambda: show_on_s600([[1, 2], [3, 4]], SAMPLE),
        lambda: show_linear([symbols("q"), 0], LENGTHS, TARGET),
        lambda: show_mgi(lambda *pose: 1 / 0, LENGTHS),
        lambda: show_configurations([(1, 2)], LENGTHS, TARGET, 0.6),
    ],
)
def test_an_answer_that_cannot_be_drawn_says_why(show):
    ax = show()
    assert not isinstance(ax, Axes3D) and "cannot be drawn" in said(ax)
