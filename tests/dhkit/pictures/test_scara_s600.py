"""Pictures of a student's result on the s600: a right one lies on the robot, a wrong one does not, blanks show a card."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
from sympy import pi, symbols

from dhkit.drawing import draw_own_scara
from dhkit.pictures.scara_s600 import show_classic, show_configurations, show_mgi, show_misfits, show_on_own_scara
from dhkit.scara_tasks import SCARAS, measured
from dhkit.variants import variant

q1, q2, q3, q4, A, B, H = symbols("q1 q2 q3 q4 A B H")
SAMPLE = {"q1": 0.1, "q2": 0.0, "q3": 0.0, "q4": 0.0, "A": 0.4, "B": 0.3, "H": 0.5}
COLUMN = [[0, 0, q1 + H, 0], [A, 0, 0, q2], [B, pi, 0, q3], [0, 0, 0, q4]]
LENGTHS, TARGET = (0.325, 0.275), (-0.2, 0.4)
MINE = variant("scara_s600", "ada")

pytestmark = pytest.mark.filterwarnings("error")


def said(ax) -> str:
    return " ".join(text.get_text() for text in [*ax.texts, *ax.figure.texts, ax.title])


def cross(ax):
    return next(line.get_xydata()[0] for line in ax.lines if line.get_marker() == "+")


def test_a_right_classic_table_ends_at_the_end_of_the_arm():
    assert cross(show_classic(COLUMN, "column", SAMPLE)) == pytest.approx([0.7, 0.6])
    assert cross(show_classic([[0, 0, 0, 0]] * 4, "column", SAMPLE)) == pytest.approx([0, 0])


def test_a_transform_is_drawn_where_it_is():
    frame = np.diag([1.0, -1.0, -1.0, 1.0])
    frame[:3, 3] = 0.1, 0.2, 0.3
    assert cross(show_on_own_scara(frame, "ceiling", SAMPLE)) == pytest.approx([0.1, 0.3])
    assert "not a rigid displacement" in said(show_on_own_scara(2 * frame, "ceiling", SAMPLE))


@pytest.mark.parametrize("arm", SCARAS)
def test_every_scara_is_drawn_with_its_letters_and_axes(arm):
    texts = [text.get_text() for text in draw_own_scara(arm, SAMPLE).texts]
    assert {"$A$", "$B$", "$H$", *(f"$q_{i}$" for i in range(1, 5)), *(f"$z_{i}$" for i in range(5))} <= set(texts)


def test_the_right_lengths_leave_the_noise_and_those_of_the_data_sheet_do_not():
    first, second, x, y = measured(MINE).T
    columns = [(np.cos(t) - np.cos(t).mean(), np.sin(t) - np.sin(t).mean()) for t in (first, first + second)]
    design = np.array([np.concatenate(column) for column in columns]).T
    fit = np.linalg.lstsq(design, np.concatenate([x - x.mean(), y - y.mean()]), rcond=None)[0]
    left = [float(show_misfits(pair, MINE).get_title().split()[3]) for pair in (fit, [MINE.d2, MINE.d3])]
    assert left[0] < 1 < 5 < left[1]


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
        lambda: show_on_own_scara(..., "column", SAMPLE),
        lambda: show_classic([[...] * 4] * 4, "column", SAMPLE),
        lambda: show_misfits([..., ...], MINE),
        lambda: show_mgi(lambda *pose: None, LENGTHS),
        lambda: show_configurations(..., LENGTHS, TARGET, 0.6),
    ],
)
def test_a_blank_shows_a_card(show):
    ax = show()
    assert "not attempted yet" in said(ax)


@pytest.mark.parametrize(
    "show",
    [
        lambda: show_on_own_scara([[1, 2], [3, 4]], "column", SAMPLE),
        lambda: show_misfits([symbols("q"), 0], MINE),
        lambda: show_mgi(lambda *pose: 1 / 0, LENGTHS),
        lambda: show_configurations([(1, 2)], LENGTHS, TARGET, 0.6),
    ],
)
def test_an_answer_that_cannot_be_drawn_says_why(show):
    ax = show()
    assert "cannot be drawn" in said(ax)
