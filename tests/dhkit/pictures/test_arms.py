"""Pictures of results on an arm: a blank is said to be one, the right end effector lies on the drawn one, a wrong one beside it."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from sympy import Matrix, Symbol, cos, sin

from dhkit.arms import EXTENDED, arm_from
from dhkit.pictures import arms as pictures

pytestmark = pytest.mark.filterwarnings("error")

# Two links in a plane, and a slide for the tool.
ARM = arm_from(
    {
        "title": "two links",
        "joints": [
            {"name": "q1", "slides": False, "point": [{}, {}, {}], "direction": [0, 0, 1]},
            {"name": "q2", "slides": True, "point": [{"l": 1, "q2": 1}, {}, {}], "direction": [1, 0, 0]},
        ],
        "end": {"point": [{"l": 1, "q2": 1}, {}, {"": 0.1}], "direction": [1, 0, 0], "x": [0, 0, 1], "frame": "E"},
        "lengths": {"l": 0.4},
    }
)
q1, q2, length = map(Symbol, ("q1", "q2", "l"))
HAND = Matrix(
    [
        [0, sin(q1), cos(q1), (length + q2) * cos(q1)],
        [0, -cos(q1), sin(q1), (length + q2) * sin(q1)],
        [1, 0, 0, 0.1],
        [0, 0, 0, 1],
    ]
)
CLOUD = np.random.default_rng(0).uniform(-0.3, 0.3, (50, 3))
VALUES = {"q1": 0.3, "q2": 0.2, "l": 0.4}
SHOWS = {
    "seen_from": (lambda answer: pictures.show_seen_from(answer, VALUES, ("1", "E")), HAND),
    "on_arm": (lambda answer: pictures.show_on_arm(answer, ARM), HAND),
    "points": (lambda answer: pictures.show_points(answer, ARM), CLOUD),
    "distances": (lambda answer: pictures.show_distances(answer, CLOUD), [0.1, 0.3]),
    "ranks": (
        lambda answer: pictures.show_ranks(
            answer, [[0.3, 0.2]], lambda *q: [[0, 0, 0, 0.2, q[0]], [1, 0.3, 0, q[1], 0]]
        ),
        [2],
    ),
    "zeros": (lambda answer: pictures.show_zeros(answer, VALUES, "q1"), length * sin(q1)),
}


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.mark.parametrize("name", SHOWS)
@pytest.mark.parametrize("answer", [..., "nonsense", [1, 2, 3, 4, 5], Symbol("zeta")], ids=str)
def test_no_answer_breaks_a_picture(name, answer):
    text = SHOWS[name][0](answer).texts[0].get_text()
    assert text == "not attempted yet" if answer is ... else text.startswith("cannot be drawn")


@pytest.mark.parametrize("name", SHOWS)
def test_a_right_answer_is_drawn(name):
    show, answer = SHOWS[name]
    assert not any("cannot be drawn" in text.get_text() for text in show(answer).texts)


@pytest.mark.parametrize(
    ("pose", "right"), [(HAND, True), (HAND.subs(length, 2 * length), False)], ids=["right", "wrong"]
)
def test_the_frame_of_a_right_pose_lies_on_the_end_effector(pose, right):
    ax = pictures.show_on_arm(pose, ARM)
    marks = [np.array(line.get_data_3d())[:, 0] for line in ax.lines if line.get_marker() == "o"]
    end = ARM.at(ARM.origin, {"q2": EXTENDED})
    assert any(np.allclose(mark, end) for mark in marks) is right


def test_the_zeros_of_a_determinant_are_marked():
    ax = SHOWS["zeros"][0](length * sin(q1 - 1))
    found = sorted(line.get_xdata()[0] for line in ax.lines if line.get_marker() == "o")
    assert found == pytest.approx([np.degrees(1) - 180, np.degrees(1)], abs=0.6)
