"""Drawings of the pen robot: its tip is where the product of its table is, drawings hold what they promise."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
import sympy
from matplotlib.patches import Circle

from dhkit.arms import arm_of
from dhkit.curves import ARM_CURVES, STOPS, arm_path, same_joints
from dhkit.drawing import arm_curve, chain_frames, end_frame, pen
from dhkit.pictures import pen as pictures
from dhkit.public import variant_ranges

Q = np.radians([35, 20, 45])
HALF = np.pi / 2
PEN_ARMS = variant_ranges("pen_robot")["arm"]

pytestmark = pytest.mark.filterwarnings("error")


@pytest.mark.parametrize("repaired", [False, True])
def test_the_tip_is_the_product_of_the_table(repaired):
    h1, L1, h2, L2, p1 = pen.PEN_SIZES.values()
    last = [0, L2, 0, 0, Q[2]] if repaired else [0, 0, 0, L2, Q[2]]
    rows = [[0, 0, 0, h1, Q[0]], [0, L1, -HALF, h2, Q[1] - HALF], last, [0, p1, 0, 0, 0]]
    assert pen.pen_tip(Q, repaired=repaired) == pytest.approx(chain_frames(rows)[-1][:3, 3])
    (dot,) = [line for line in pen.draw_pen_robot(Q, repaired=repaired).lines if line.get_marker() == "o"]
    assert np.ravel(dot.get_data_3d()) == pytest.approx(pen.pen_tip(Q, repaired=repaired))


def test_the_tip_known_by_hand():
    sizes = {"h1": 0.1, "L1": 0.3, "h2": 0.08, "L2": 0.12, "p1": 0.5}
    assert pen.pen_tip(Q, sizes) == pytest.approx([0.502232, 0.595822, 0.311309], abs=1e-6)
    assert pen.pen_tip(Q + [0, 0.7, -0.7], sizes) == pytest.approx(pen.pen_tip(Q, sizes))


DRAWINGS = {
    "robot": lambda: pen.draw_pen_robot(Q),
    "surface": lambda: pen.draw_pen_robot(Q, surface=(0, 3), names=False),
    "curve": lambda: pen.draw_pen_robot(Q, curve=np.eye(3), trace=np.eye(3) + 0.01),
    "repaired": lambda: pen.draw_pen_robot(Q, repaired=True, sheet=0.1),
    "views": lambda: pen.draw_pen_views(Q),
    "views_pen_inwards": lambda: pen.draw_pen_views((0.3, 0, -1.0)),
    "sheet": lambda: pen.draw_pen_sheet(0.15),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", DRAWINGS)
def test_every_drawing_can_be_shown(name):
    DRAWINGS[name]().figure.canvas.draw()


def test_the_circles_on_the_sheet_are_points_of_the_surface():
    circles = [patch.radius for patch in pen.draw_pen_sheet(0.15).patches if isinstance(patch, Circle)]
    for phi, radius in zip(
        (np.pi - np.arcsin(np.sqrt(1 - (0.15 / 0.22) ** 2)), np.pi + np.arccos(0.15 / 0.22)), circles
    ):
        x, y, z = pen.pen_tip([0.3, phi, 0.0])
        assert (np.hypot(x, y), z) == pytest.approx((radius, 0.15))
    assert not [patch for patch in pen.draw_pen_sheet(0.05).patches if isinstance(patch, Circle)]


@pytest.mark.parametrize(
    ("draw", "words"),
    [
        (lambda: pen.draw_pen_robot(Q[:2]), "expected 3 numbers"),
        (lambda: pen.draw_pen_robot(Q, {"h1": 1}), "a length for L1, L2, h2, p1"),
        (lambda: pen.draw_pen_views(Q, pen.PEN_SIZES | {"p1": -1}), "lengths must be positive"),
        (lambda: pen.draw_pen_robot(Q, curve=[(1, 2)]), "curve: expected n x 3"),
    ],
)
def test_bad_input_is_refused_in_words(draw, words):
    with pytest.raises(ValueError, match=words):
        draw()


# ---------------------------------------------------------------- curves, and pictures of a student's own result


@pytest.mark.parametrize("shape", ARM_CURVES)
@pytest.mark.parametrize("name", PEN_ARMS)
def test_a_curve_can_be_written_by_sharing_the_work_only(name, shape):
    """The first of the equal joints is beyond its stop somewhere, but never beyond those of both; the others never."""
    arm = arm_of({"arm": name})
    first, second = same_joints(arm)
    path, stops = arm_path(arm, shape), np.array([STOPS[joint.slides] for joint in arm.joints])
    shared, same = path.copy(), np.dot(arm.joints[first].direction, arm.joints[second].direction)
    shared[:, first], shared[:, second] = path[:, first] / 2, same * path[:, first] / 2
    assert path[:, first].max() > stops[first] and (np.abs(shared) < stops).all()
    tips = [end_frame(arm, q)[:3, 3] for q in shared]
    np.testing.assert_allclose(arm_curve(shape, arm), tips, atol=1e-12)


def test_there_are_no_other_curves_and_arms():
    with pytest.raises(ValueError, match="one of eight, wave, spiral"):
        arm_path(ARM, "star")
    with pytest.raises(ValueError, match="two joints that do the same, found 0 pairs"):
        arm_path(arm_of({"arm": "pen_swing"}), "eight")


VALUES = pen.PEN_SIZES | {"t1": -0.4, "t2": 0.5, "t3": 1.2}
ARM = arm_of({"arm": "pen_hoist"})
CURVE = arm_curve("eight", ARM, 13)
x, y, p1 = sympy.symbols("x y p1")


def right(px, py, pz, share=0.5):
    """The hoist with its lengths of the pool; the lift takes a share of the height."""
    up = pz - ARM.lengths["b"] + ARM.lengths["p"]
    return share * up, np.arctan2(py, px - ARM.lengths["e"]), -(1 - share) * up


PICTURES = {
    "tip": (pictures.show_tip, (VALUES,), [0.1, 0.2, sympy.Symbol("h1")]),
    "height": (pictures.show_height, (pen.PEN_SIZES,), p1**2 - sympy.sqrt(x**2 + y**2 - 0.05)),
    "circles": (pictures.show_circles, (pen.PEN_SIZES, 0.2), {"small": 0.2, "large": 0.5}),
    "inverse": (pictures.show_reached, (ARM,), lambda *point: [(0.1, 0.2, 0.3)]),
    "follow": (pictures.show_trace, (ARM, CURVE), right),
}


def words(ax):
    labels = ax.get_legend_handles_labels()[1]
    title = ax.figure.get_suptitle()
    return " ".join([title, *(text.get_text() for text in ax.texts), *labels])


@pytest.mark.parametrize("name", PICTURES)
def test_an_answer_is_drawn_and_nothing_is_said_to_be_nothing(name):
    show, given, answer = PICTURES[name]
    show(answer, *given).figure.canvas.draw()
    untouched = (lambda *args: None) if callable(answer) else ...
    assert "not attempted yet" in words(show(untouched, *given))
    assert "cannot be drawn" in words(show("nonsense", *given))


def test_the_trace_is_measured_and_the_stops_are_looked_at():
    said = words(pictures.show_trace(right, ARM, CURVE))
    assert "mm from the curve" in said and "beyond" not in said
    assert "m, beyond the stop" in words(pictures.show_trace(lambda *point: right(*point, share=1.0), ARM, CURVE))
    for far, said in ((0.01, "at most 10 mm"), (0.234, "at most 234 mm")):
        above = lambda *point, far=far: np.array(right(*point)) + [far, 0, 0]  # noqa: E731
        assert said in words(pictures.show_trace(above, ARM, CURVE))


def test_a_solution_that_misses_is_counted():
    assert "a solution misses (40)" in words(pictures.show_reached(lambda *point: [(0.1, 0.2, 0.3)], ARM))
    assert "no solution (40)" in words(pictures.show_reached(lambda *point: [], ARM))
    said = words(pictures.show_reached(lambda *point: [right(*point, share=1.0)], ARM))
    assert "reached (40)" in said and "misses" not in said
