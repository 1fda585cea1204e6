"""Pictures of a student's own tables: drawn where the table says, and a card where there is nothing to draw."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest

from dhkit.pictures import tables as pictures

HALF = np.pi / 2
RX90 = [
    [0, 0, 0, 0, 0.3],
    [0, 0, HALF, 0, 0.9],
    [0, 0.45, 0, 0, -0.8],
    [0, 0, -HALF, 0.45, 0.4],
    [0, 0, HALF, 0, 0.7],
    [0, 0, -HALF, 0, 0.2],
]
CLASSIC = [[*below[1:3], *row[3:]] for row, below in zip(RX90, [*RX90[1:], [0] * 5])]
ORIGINS, AXES = [(0, 0, 0.3), (0.2, 0, 0.8), (1.0, 0, 0.8)], ["z", "y", ""]

pytestmark = pytest.mark.filterwarnings("error")


def place(ax, text) -> np.ndarray:
    return np.array(next(t for t in ax.texts if t.get_text() == text).get_position())


def marked(ax, marker) -> np.ndarray:
    return np.ravel(next(line for line in ax.lines if line.get_marker() == marker).get_data())


def frame_6(rows) -> np.ndarray:
    ax = pictures.show_classic_rows(rows, RX90, {})
    dots = [line.get_data_3d() for line in ax.lines if line.get_marker() == "o" and line.get_markersize() == 5]
    return np.ravel(dots[-1])


def test_right_classic_rows_put_frame_6_into_the_wrist_centre_and_copied_ones_do_not():
    centre = np.array([np.cos(0.3), np.sin(0.3), 0]) * (0.45 * np.cos(0.9) - 0.45 * np.sin(0.1)) + [
        0,
        0,
        0.45 * np.sin(0.9) + 0.45 * np.cos(0.1),
    ]
    assert frame_6(CLASSIC) == pytest.approx(centre)
    assert np.linalg.norm(frame_6([row[1:] for row in RX90]) - centre) > 0.1


def test_the_tip_is_marked_where_the_function_says():
    ax = pictures.show_planar(lambda lengths, angles: [0.3, 0.4, 1.0], [0.5, 0.4], [0.2, 0.3])
    assert marked(ax, "+") == pytest.approx([0.3, 0.4])


def test_freedoms_are_listed_as_the_function_counts_them():
    ax = pictures.show_freedoms(lambda rows: len(rows) - 1, {"RX-90": RX90, "two": RX90[:2]})
    assert [text.get_text() for text in ax.texts[3:]] == ["RX-90", "6", "5", "two", "2", "1"]


def test_frames_of_a_table_stand_over_the_joint_origins():
    rows = [[0, 0, 0, 0.8, 0], [0, 0.2, -HALF, 0, -HALF]]
    ax = pictures.show_on_origins(rows, ORIGINS, AXES, {})
    assert place(ax, "$X_2$") == pytest.approx([0.2, 1.08], abs=0.15)
    assert place(ax, "$Z_1$") == pytest.approx([0.0, 1.08], abs=0.15)


@pytest.mark.parametrize(
    ("cell", "value", "says"),
    [((2, 2), -1, "left-handed"), ((0, 1), 0.5, "not orthogonal"), ((3, 0), 1, "not orthogonal")],
)
def test_what_no_motor_does_is_said_below_the_frame(cell, value, says):
    assert not pictures.show_gripper_frame(np.eye(4), "5").figure.texts
    wrong = np.eye(4)
    wrong[cell] = value
    assert says in pictures.show_gripper_frame(wrong, "5").figure.texts[0].get_text()


BLANK = [[...] * 5] * 3


@pytest.mark.parametrize(
    ("picture", "says"),
    [
        (lambda: pictures.show_chain(BLANK, {}), "not attempted yet"),
        (lambda: pictures.show_chain([*RX90[:5], [...] * 5], {}), "not complete"),
        (lambda: pictures.show_classic_rows([[...] * 4] * 6, RX90, {}), "not attempted yet"),
        (lambda: pictures.show_planar(lambda lengths, angles: None, [0.5], [0.1]), "not attempted yet"),
        (lambda: pictures.show_planar(lambda lengths, angles: [1, 2], [0.5], [0.1]), "expected 3 numbers, found 2"),
        (lambda: pictures.show_freedoms(lambda rows: None, {"RX-90": RX90}), "not attempted yet"),
        (lambda: pictures.show_on_origins(BLANK, ORIGINS, AXES, {}), "not attempted yet"),
        (lambda: pictures.show_gripper_frame(..., "5"), "not attempted yet"),
    ],
)
def test_what_cannot_be_drawn_is_said_on_a_card(picture, says):
    assert says in picture().texts[0].get_text()
