"""Pictures of a student's direct models: a blank is said to be one, a right answer lies on the robot, a wrong one beside it."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
from sympy import Matrix, Symbol, cos, sin

from dhkit.arms import arm_of
from dhkit.drawing.arms import end_frame
from dhkit.drawing.turns import turn_about
from dhkit.geometry import modified_dh, rotation
from dhkit.pictures import direct_models as pictures
from dhkit.sheets import ARMS, sheet_of
from dhkit.variants import OwnNumbers

pytestmark = pytest.mark.filterwarnings("error")

SCARA = {"t1": 0.6, "t2": 0.9, "t4": -0.7, "L1": 0.5, "L2": 0.4, "L4": 0.2, "w": 0.12}
PEN = {"t1": 0.3, "t2": -0.5, "t3": -0.7, "t5": -0.8, "D3": 0.2, "L2": 0.5, "D4": 0.6, "e": 0.1, "h": 0.3}
BENCH, LEANING = arm_of({"arm": "bench"}), [0.5, -0.6, 0.8, 0.5, -0.7]
MINE = {"reach": 0.1, "length": 0.15, "bend": 45}
PRINTED = {"A": Matrix.eye(4), "B": cos(Symbol("t4")) * Matrix.eye(4)}
WORK = [0.4, -0.5, 0.6, 0.5, -0.7, 0.6]


def own(name, sheet="I"):
    """A sheet and the arm that it is of."""
    return sheet_of(OwnNumbers(robot=name, sheet=sheet)), arm_of({"arm": name})


SHOWS = {
    "turned_hand": lambda answer: pictures.show_turned_hand(answer, SCARA),
    "tool_point": lambda answer: pictures.show_tool_point(answer, SCARA),
    "locked": lambda answer: pictures.show_pen_tip(answer, PEN),
    "turns": lambda answer: pictures.show_own_turns(answer, BENCH, LEANING),
    "marks": lambda answer: pictures.show_marks(answer, PRINTED),
    "end_effector": lambda answer: pictures.show_end_effector(answer, BENCH, LEANING),
    "from_frame_2": lambda answer: pictures.show_from_frame_2(answer, "A", *own("kr6"), WORK),
    "reading": lambda answer: pictures.show_from_frame_2(np.eye(4), answer, *own("kr6"), WORK),
    "forward": lambda answer: pictures.show_own_forward(answer, own("kr6")[1], MINE),
}


@pytest.mark.parametrize("name", SHOWS)
@pytest.mark.parametrize("answer", [..., "nonsense", [1, 2, 3, 4, 5], Symbol("zeta")], ids=str)
def test_no_answer_breaks_a_picture(name, answer):
    text = SHOWS[name](answer if name != "forward" or answer is not ... else lambda *q: ...).texts[0].get_text()
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


FIVE = ("bench", "painter", "sorter", "wall", "loader", "mast", "snake", "ceiling", "shoulder")


@pytest.mark.parametrize("name", FIVE)
def test_joints_carried_by_right_turns_end_on_the_end_effector(name):
    arm, K = arm_of({"arm": name}), []
    for joint, angle in zip(arm.joints, LEANING):
        side = "xyz"[int(np.argmax(np.abs(joint.direction)))]
        K.append(turn_about(rotation(side, angle * sum(joint.direction)), arm.at(joint.point, {})))

    def gap(K):
        ax = pictures.show_own_turns(K, arm, LEANING)
        (path,) = (line for line in ax.lines if line.get_color() == pictures.YOURS and line.get_marker() == "o")
        return np.linalg.norm(np.array(path.get_data_3d())[:, -1] - end_frame(arm, LEANING)[:3, 3])

    assert gap(K) < 1e-9
    assert gap(K[::-1]) > 0.05


def test_the_pen_is_drawn_where_its_tip_is():
    t1, t2, t3, t5, D3, L2, D4, e, h = PEN.values()
    lean = -(L2 * np.sin(t2) + D4 * np.sin(t2 + t3) + h * np.sin(t2 + t3 + t5))
    up = L2 * np.cos(t2) + D4 * np.cos(t2 + t3) + h * np.cos(t2 + t3 + t5)
    tip = rotation("z", t1) @ [D3 + e, lean, up]
    ends = [np.array(line.get_data_3d())[:, -1] for line in SHOWS["locked"](tip).lines if line.get_linewidth() == 3]
    assert any(np.allclose(end, tip) for end in ends)


@pytest.mark.parametrize(("name", "letter"), list(zip(ARMS, "ABCDABCDA")))
def test_a_robot_is_drawn_from_frame_2_in_any_reading(name, letter):
    drawn = pictures.show_from_frame_2(np.eye(4), letter, *own(name), WORK)
    assert not drawn.texts[0].get_text().startswith("cannot be drawn")


def test_a_reading_that_there_is_not_is_told():
    said = pictures.show_from_frame_2(np.eye(4), "E", *own("kr6"), WORK).texts[0].get_text()
    assert "one of A, B, C, D" in said


@pytest.mark.parametrize("name", ARMS)
def test_a_right_answer_lies_on_the_end_effector(name):
    arm = arm_of({"arm": name})
    for answer in (end_frame(arm, WORK), end_frame(arm, WORK)[:3, 3]):
        lines = pictures.show_end_effector(answer, arm, WORK).lines
        dots = [np.ravel(line.get_data_3d()) for line in lines if line.get_marker() in ("o", "+")]
        assert any(np.allclose(dot, end_frame(arm, WORK)[:3, 3]) for dot in dots)


def test_every_mark_gets_a_box():
    marks = np.zeros((2, 4, 4))
    marks[0, 1, 2] = marks[1, 3, 3] = 1
    assert [tuple(box.get_xy()) for box in SHOWS["marks"](marks).patches] == [(1.52, -1.45), (2.52, -8.45)]


@pytest.mark.parametrize("name", ARMS)
def test_the_path_of_a_right_model_ends_on_the_tool(name):
    arm = arm_of({"arm": name})
    tool = modified_dh(MINE["reach"], np.radians(MINE["bend"]), MINE["length"], 0.0)
    ax = pictures.show_own_forward(lambda *q: end_frame(arm, q) @ tool, arm, MINE)
    lines = [np.array(line.get_data_3d()) for line in ax.lines]
    (path,) = (line for line in lines if line.shape == (3, 31))
    (drawn,) = (line for line in lines if line.shape == (3, 3))
    np.testing.assert_allclose(path[:, -1], drawn[:, -1], atol=1e-9)
