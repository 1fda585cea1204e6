"""Pictures of a student's direct models: a blank is said to be one, a right answer lies on the robot, a wrong one beside it."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
from sympy import Matrix, Symbol, cos, sin

from dhkit.drawing import chain_frames
from dhkit.drawing.turns import turn_about
from dhkit.geometry import rotation
from dhkit.pictures import direct_models as pictures

pytestmark = pytest.mark.filterwarnings("error")

SCARA = {"t1": 0.6, "t2": 0.9, "t4": -0.7, "L1": 0.5, "L2": 0.4, "L4": 0.2, "w": 0.12}
ARM = {"t1": 0.3, "t2": -0.5, "t3": -0.7, "t4": 0.4, "t5": -0.8, "t6": 0.5, "D3": 0.2, "L2": 0.5, "D4": 0.6}
ROBOT = {"t1": 0.4, "t2": 0.9, "t3": -0.5, "t4": 0.5, "t5": -0.7, "t6": 0.6, "a3": 0.45, "d3": 0.4}
MINE = {"a3": 0.45, "d3": 0.4, "reach": 0.1, "length": 0.15, "bend": 45}
PRINTED = {"A": Matrix.eye(4), "B": cos(Symbol("t4")) * Matrix.eye(4)}

SHOWS = {
    "turned_hand": lambda answer: pictures.show_turned_hand(answer, SCARA),
    "tool_point": lambda answer: pictures.show_tool_point(answer, SCARA),
    "turns": lambda answer: pictures.show_turns(answer, ARM),
    "wrist": lambda answer: pictures.show_wrist_centre(answer, ARM),
    "marks": lambda answer: pictures.show_marks(answer, PRINTED),
    "on_rx90": lambda answer: pictures.show_on_rx90(answer, ROBOT),
    "rx90_forward": lambda answer: pictures.show_rx90_forward(answer, MINE),
}


@pytest.mark.parametrize("name", SHOWS)
@pytest.mark.parametrize("answer", [..., "nonsense", [1, 2, 3, 4, 5], Symbol("zeta")], ids=str)
def test_no_answer_breaks_a_picture(name, answer):
    text = SHOWS[name](answer if name != "rx90_forward" or answer is not ... else lambda *q: ...).texts[0].get_text()
    assert text == "not attempted yet" if answer is ... else text.startswith("cannot be drawn")


def test_the_hand_turns_about_its_centre_only_with_the_right_column():
    L1, L2, t4 = map(Symbol, ("L1", "L2", "t4"))

    def hand(blanks):
        return min(
            np.hypot(*(line.get_xydata()[0] - (0.9, 0)))
            for line in SHOWS["turned_hand"](blanks).lines
            if line.get_color() == "#a9a9a9"
        )

    assert hand([(L1 + L2) * (1 - cos(t4)), -(L1 + L2) * sin(t4)]) < 1e-9
    assert hand([L1 * (1 - cos(t4)), -L1 * sin(t4)]) > 0.1


def test_links_carried_by_right_turns_end_on_the_hand():
    q = [ARM[f"t{i}"] for i in range(1, 7)]
    centres = ([0, 0, 0], [0, 0, 0], [0, 0, 0.5], [0.2, 0, 0], [0, 0, 1.1], [0.2, 0, 0])
    K = [turn_about(rotation(letter, angle), np.array(centre)) for letter, angle, centre in zip("zxxzxz", q, centres)]

    def gap(K):
        ax = SHOWS["turns"](K)
        (path,) = (line for line in ax.lines if line.get_color() == pictures.YOURS and line.get_linestyle() == "--")
        dots = [
            np.ravel(line.get_data_3d()) for line in ax.lines if line.get_marker() == "o" and line.get_markersize() == 5
        ]
        return np.linalg.norm(np.array(path.get_data_3d())[:, -1] - dots[-1])

    assert gap(K) < 1e-9
    assert gap(K[::-1]) > 0.1


def test_every_mark_gets_a_box():
    marks = np.zeros((2, 4, 4))
    marks[0, 1, 2] = marks[1, 3, 3] = 1
    assert [tuple(box.get_xy()) for box in SHOWS["marks"](marks).patches] == [(1.52, -1.45), (2.52, -8.45)]


def test_the_path_of_a_right_model_ends_on_the_tool():
    tool = [0, MINE["reach"], np.radians(MINE["bend"]), MINE["length"], 0]

    def forward(*q):
        values = dict(zip(("t1", "t2", "t3", "t4", "t5", "t6"), q)) | {"a3": 0.45, "d3": 0.4}
        return chain_frames([*pictures.RX90, tool], values)[-1]

    ax = SHOWS["rx90_forward"](forward)
    paths = [np.array(line.get_data_3d()) for line in ax.lines if np.shape(line.get_data_3d()) == (3, 31)]
    end = np.radians([-30, 65, -40, 25, -50, 40])
    assert len(paths) == 1 and np.allclose(paths[0][:, -1], forward(*end)[:3, 3])
