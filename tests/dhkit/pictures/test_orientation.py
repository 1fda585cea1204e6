"""Pictures of a student's rotations and angles: right ones coincide, wrong ones do not, blanks show a card."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
from mpl_toolkits.mplot3d import Axes3D
from sympy import atan2, cos, sin, sqrt, symbols

from dhkit.attitudes import Camera, Display
from dhkit.drawing import turn_in_steps
from dhkit.pictures.orientation import (
    show_display,
    show_drone,
    show_extraction,
    show_locked,
    show_misses,
    show_rotation,
    show_rpy_entries,
    show_wrist,
    show_wrist_formulas,
)

phi, theta, psi, e, r12, r13, r22, r32, r11 = symbols("phi theta psi e r12 r13 r22 r32 r11")
SAMPLE = {"phi": 0.4, "theta": 0.6, "psi": 0.8}
ORDER = ("psi", "theta", "phi")
ROTATION = turn_in_steps([0.8, 0.6, 0.4], "zyx")[-1]

pytestmark = pytest.mark.filterwarnings("error")


def said(ax) -> str:
    return " ".join(text.get_text() for text in [*ax.texts, *ax.figure.texts])


def apart(ax) -> float:
    """Largest angle between a grey axis and the coloured arrow of the hand it belongs to."""
    grey = [np.array(line.get_data_3d()) for line in ax.lines if line.get_linewidth() == 5]
    hands = [
        np.array(line.get_data_3d()) for line in ax.lines if line.get_linewidth() == 1.6 and line.get_zorder() == 6
    ]
    assert len(grey) == len(hands) > 0
    unit = [(ends[:, -1] - ends[:, 0]) / np.linalg.norm(ends[:, -1] - ends[:, 0]) for ends in grey + hands]
    return max(np.degrees(np.arccos(np.clip(a @ b, -1, 1))) for a, b in zip(unit, unit[len(grey) :]))


def zyz(R):
    R = np.array(R)
    root = np.hypot(R[0, 2], R[1, 2])
    if root < 1e-9:
        return [(0.0, np.arctan2(0.0, R[2, 2]), np.arctan2(-R[2, 2] * R[0, 1], R[1, 1]))]
    return [(np.arctan2(R[1, 2], R[0, 2]), np.arctan2(root, R[2, 2]), np.arctan2(R[2, 1], -R[2, 0]))]


RIGHT_ENTRIES = [
    sin(psi) * sin(theta) * sin(phi) + cos(psi) * cos(phi),
    sin(psi) * sin(theta) * cos(phi) - cos(psi) * sin(phi),
]
RIGHT_WRIST = [atan2(e * r32, e * r22), atan2(-r12, e * sqrt(r32**2 + r22**2)), atan2(e * r13, e * r11)]
CAMERA = Camera("looks ahead", ROTATION)
DISPLAY = Display("I", ((30, 40, 50),), turn_in_steps(np.radians([30, 40, 50]), "yxz")[-1:])
PICTURES = {
    "rotation": (lambda answer: show_rotation(answer, "zyx", SAMPLE, ORDER), ROTATION, ROTATION.T),
    "rpy_entries": (lambda answer: show_rpy_entries(answer, SAMPLE), RIGHT_ENTRIES, RIGHT_ENTRIES[::-1]),
    "drone": (lambda answer: show_drone(answer, CAMERA), [(0.4, 0.6, 0.8)], [(0.8, 0.6, 0.4)]),
    "wrist_formulas": (
        lambda answer: show_wrist_formulas(answer, "xzy"),
        RIGHT_WRIST,
        [atan2(r32, r22), *RIGHT_WRIST[1:]],
    ),
    "hinges": (
        lambda answer: show_wrist_formulas(answer, "x, -z, y"),
        [RIGHT_WRIST[0], atan2(r12, e * sqrt(r32**2 + r22**2)), RIGHT_WRIST[2]],
        RIGHT_WRIST,
    ),
    "wrist": (show_wrist, zyz, lambda R: [(0.0, 0.0, 0.0)]),
    "locked": (
        lambda answer: show_locked(answer, "z, y, -z"),
        lambda R: [-1, np.arctan2(R[1][0], R[0][0])],
        lambda R: [1, np.arctan2(R[1][0], R[0][0])],
    ),
    "display": (
        lambda answer: show_display(answer, DISPLAY),
        lambda *abc: turn_in_steps(np.radians(abc), "yxz")[-1],
        lambda *abc: turn_in_steps(np.radians(abc), "yxz", "fixed")[-1],
    ),
    "extraction": (
        lambda answer: show_extraction(answer, "zyz", {"ahead": (20, 30, 40), "behind": (20, 120, -40)}),
        lambda R: zyz(R)[0],
        lambda R: zyz(R)[0][::-1],
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", PICTURES)
def test_right_answers_coincide_and_wrong_ones_do_not(name):
    show, right, wrong = PICTURES[name]
    assert apart(show(right)) < 0.01
    assert apart(show(wrong)) > 3


@pytest.mark.parametrize(
    ("name", "blank"),
    [
        ("rotation", ...),
        ("rpy_entries", [..., ...]),
        ("drone", None),
        ("wrist", lambda R: None),
        ("display", lambda A, B, C: None),
    ],
)
def test_a_blank_shows_a_card(name, blank):
    ax = PICTURES[name][0](blank)
    assert not isinstance(ax, Axes3D) and "not attempted yet" in said(ax)


@pytest.mark.parametrize(
    ("name", "odd"),
    [
        ("rotation", "R"),
        ("drone", [(1, 2)]),
        ("locked", lambda R: 3.0),
        ("display", lambda A, B, C: np.eye(2)),
        ("extraction", 3),
        ("wrist", lambda R: []),
        ("wrist_formulas", 3),
        ("rpy_entries", [theta, symbols("q")]),
    ],
)
def test_an_answer_that_cannot_be_drawn_says_why(name, odd):
    ax = PICTURES[name][0](odd)
    assert not isinstance(ax, Axes3D) and "cannot be drawn" in said(ax)


def test_triples_by_name_are_drawn_and_the_grey_axes_say_what_they_are():
    ax = show_drone({"yaw": 0.8, "roll": 0.4, "pitch": 0.6}, CAMERA)
    assert apart(ax) < 0.01 and "the camera" in said(ax)


def test_misses_are_written_below_what_a_function_makes_of_poses():
    ax = show_misses([0, np.radians(12.34)], [ROTATION, ROTATION], [ROTATION, ROTATION.T])
    assert "pose 1: 0.0°" in said(ax) and "pose 2: 12.3°" in said(ax) and apart(ax) > 3
    assert "not complete" in said(show_misses([0, ...], [ROTATION] * 2, [ROTATION] * 2))


def test_a_matrix_that_is_no_rotation_is_told():
    assert "no rotation" in said(show_rotation(2 * ROTATION, "zyx", SAMPLE, ORDER))
