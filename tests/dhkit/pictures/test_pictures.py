"""Pictures of a student's result: they never raise, and they tell apart blank, broken, wrong and right."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
import sympy
from sympy import Matrix, atan2, cos, sin

from dhkit import pictures

t1, t2, t4, a2, a3, d2, L1, L2, x, y = sympy.symbols("t1 t2 t4 a2 a3 d2 L1 L2 x y")
SCARA = {"t1": -0.4, "t2": 1.0, "t4": -0.9, "a2": 0.4, "a3": 0.3, "d2": 0.2}
PLANAR = {"t1": 0.6, "t2": 0.9, "L1": 0.5, "L2": 0.4}
TABLE = [[0, 0, 0, 0, t1], [0, a2, 0, 0, t2], [1, a3, 0, -d2, 0], [0, 0, 0, 0, t4]]
OWN = {
    "arm": "rail", "q1": 0.2, "q2": 0.4, "q3": 0.3, "a": 0.4, "b": 0.3, "c": 0.1, "x": 0.3, "y": 0.4, "phi": 40,
    "L1": 0.5, "L2": 0.3, "belt": 0.1, "speed": 0.3, "start": -1.0, "e": 0.1, "out": 0.6, "back": 0.3, "order": "025314",
}  # fmt: skip
SHOULDER = atan2(y, x) - atan2(L2 * sin(t2), L1 + L2 * cos(t2))
HEADING = t1 + t2 + t4
HAND = Matrix(
    [
        [cos(HEADING), -sin(HEADING), 0, a2 * cos(t1) + a3 * cos(t1 + t2)],
        [sin(HEADING), cos(HEADING), 0, a2 * sin(t1) + a3 * sin(t1 + t2)],
        [0, 0, 1, -d2],
        [0, 0, 0, 1],
    ]
)

pytestmark = pytest.mark.filterwarnings("error")


def scara_forward(t1, t2, d2, t4, a2, a3):
    values = {"t1": t1, "t2": t2, "t4": t4, "a2": a2, "a3": a3, "d2": d2}
    return np.array(HAND.subs(values), dtype=float)


def inverse(x, y, l1, l2):
    c2 = (x**2 + y**2 - l1**2 - l2**2) / (2 * l1 * l2)
    if abs(c2) > 1 + 1e-9:
        return []
    elbow = np.arccos(np.clip(c2, -1, 1))
    bends = [elbow] if abs(c2) > 1 - 1e-9 else [elbow, -elbow]
    return [(np.arctan2(y, x) - np.arctan2(l2 * np.sin(t2), l1 + l2 * np.cos(t2)), t2) for t2 in bends]


SHOWN = {
    "table": (pictures.show_table, TABLE, (SCARA,)),
    "dh_matrix": (pictures.show_dh_matrix, Matrix.eye(4), ({"a": 1, "alpha": 0.7, "d": 1.3, "theta": 0.4},)),
    "scara_frame": (pictures.show_on_scara, HAND, (SCARA,)),
    "scara_model": (pictures.show_on_scara, [HAND[0, 3], HAND[1, 3], -d2, HEADING], (SCARA,)),
    "scara_forward": (pictures.show_scara_forward, scara_forward, ()),
    "planar_model": (pictures.show_on_planar_arm, [L1 * cos(t1), L1 * sin(t1)], (PLANAR,)),
    "planar_frame": (pictures.show_on_planar_arm, Matrix.eye(4), (PLANAR,)),
    "postures": (pictures.show_postures, inverse(0.3, 0.6, 0.5, 0.4), ((0.5, 0.4), (0.3, 0.6))),
    "scara_postures": (pictures.show_postures, [(0.4, 1.2, 0.1, -0.6)], ((0.4, 0.3), (0.35, 0.45), 1.0)),
    "theta1": (pictures.show_theta1, SHOULDER, ((0.5, 0.4), (0.3, 0.6))),
    "belt": (pictures.show_belt, [1.0, 2.0, 3.0, 4.0], (OWN,)),
    "own_transform": (pictures.show_on_walked_arm, Matrix.eye(4), ("rail", OWN)),
    "own_postures": (pictures.show_walked_postures, [(0.1, 0.5, 0.3)], (OWN,)),
    "rods": (pictures.show_rods, lambda x, y, e, least, most: [(np.arctan2(y, x), np.hypot(x, y))], (OWN,)),
    "inverse": (pictures.show_inverse, inverse, ((0.5, 0.3),)),
}


def card(ax) -> str | None:
    """The message of a card, or None for a real picture."""
    messages = [text.get_text() for text in ax.texts]
    return messages[0] if len(messages) == 1 and not ax.axison and not ax.lines else None


def untouched(*args):
    """What is left of a function when its solution is taken out."""


@pytest.mark.slow
@pytest.mark.parametrize("name", SHOWN)
def test_an_answer_is_drawn(name):
    show, answer, rest = SHOWN[name]
    ax = show(answer, *rest)
    assert card(ax) is None
    ax.figure.canvas.draw()


@pytest.mark.parametrize("name", SHOWN)
@pytest.mark.parametrize("blank", [..., None], ids=["dots", "none"])
def test_an_untouched_answer_is_not_attempted(name, blank):
    show, _, rest = SHOWN[name]
    assert card(show(blank, *rest)) == "not attempted yet"


def test_untouched_lists_and_functions_are_not_attempted():
    assert card(pictures.show_table([[...] * 5] * 4, SCARA)) == "not attempted yet"
    assert card(pictures.show_scara_forward(untouched)) == "not attempted yet"
    assert card(pictures.show_inverse(untouched, (0.5, 0.3))) == "not attempted yet"


def test_a_partly_filled_answer_says_so():
    assert "some entries are still ..." in card(pictures.show_table([*TABLE[:3], [...] * 5], SCARA))


@pytest.mark.parametrize(
    ("show", "answer", "rest", "message"),
    [
        (pictures.show_table, [[0, 0, 0, 0]], (SCARA,), "table: expected n x 5 numbers, found 1 x 4"),
        (pictures.show_table, [[0, 0, 0, 0, sympy.Symbol("q1")]], (SCARA,), "the symbol q1 is not one of t1, t2"),
        (pictures.show_on_scara, Matrix.eye(3), (SCARA,), "transform: expected 4 x 4 numbers, found 3 x 3"),
        (pictures.show_on_planar_arm, [sympy.sqrt(-1) * L1, L2], (PLANAR,), "cannot be drawn"),
        (pictures.show_postures, [(1, 2, 3)], ((0.5, 0.4), (0.3, 0.6)), "solutions: expected n x 2"),
        (pictures.show_inverse, 3, ((0.5, 0.3),), "expected a function, found int"),
        (pictures.show_inverse, lambda *q: 1 / 0, ((0.5, 0.3),), "division by zero"),
        (pictures.show_belt, "far", (OWN,), "cannot be drawn"),
    ],
)
def test_a_broken_answer_shows_why(show, answer, rest, message):
    assert message in card(show(answer, *rest))
    assert len(plt.get_fignums()) == 1


def test_a_matrix_that_is_no_displacement_is_drawn_and_named():
    ax = pictures.show_on_scara(2 * Matrix.eye(4), SCARA)
    assert "not a rigid displacement" in ax.figure.texts[0].get_text()


def cross(ax):
    return next(line.get_xydata()[0] for line in ax.lines if line.get_marker() == "+")


def test_the_cross_sits_where_the_answer_says():
    right = pictures.show_on_planar_arm([L1 * cos(t1) + L2 * cos(t1 + t2), L1 * sin(t1) + L2 * sin(t1 + t2)], PLANAR)
    wrong = pictures.show_on_planar_arm([L1 * cos(t1) + L2 * cos(t2), L1 * sin(t1) + L2 * sin(t2)], PLANAR)
    tip = [0.5 * np.cos(0.6) + 0.4 * np.cos(1.5), 0.5 * np.sin(0.6) + 0.4 * np.sin(1.5)]
    assert cross(right) == pytest.approx(tip)
    assert np.hypot(*(cross(wrong) - tip)) > 0.1


def legend(ax) -> set[str]:
    return {text.get_text() for text in ax.get_legend().get_texts()}


def test_the_map_of_an_inverse_model_counts_postures_and_marks_misses():
    assert legend(pictures.show_inverse(inverse, (0.5, 0.3))) == {"0 postures", "1 posture", "2 postures"}
    one_elbow = pictures.show_inverse(lambda *at: inverse(*at)[:1], (0.5, 0.3))
    assert legend(one_elbow) == {"0 postures", "1 posture"}
    degrees = pictures.show_inverse(lambda *at: np.degrees(inverse(*at)), (0.5, 0.3))
    assert "a solution misses" in legend(degrees)


def test_no_solution_is_said_in_the_title():
    assert pictures.show_postures([], (0.5, 0.4), (0.3, 0.6)).get_title() == "no solution given"


def test_a_tool_row_is_named():
    ax = pictures.show_table([[0, 0, 0, 0, t1], [0, L1, 0, 0, t2], [0, L2, 0, 0, 0]], PLANAR, tool=True)
    assert "$X_{E}$" in [text.get_text() for text in ax.texts]
    assert "tool" in [text.get_text() for text in ax.figure.axes[0].texts]
