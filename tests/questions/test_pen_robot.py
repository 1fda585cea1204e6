"""The pen arms of one's own: each that an id can pick has its right answers, its mistakes and its curve; the listing has its faults."""

import json
from pathlib import Path

import nbformat
import numpy as np
import pytest
from answers import evidence

from autograder.grading.release import points
from autograder.judge import Family, judge
from autograder.questions import find
from autograder.questions.pen_robot import own
from autograder.questions.shared.pool import arms
from dhkit.arms import arm_of
from dhkit.curves import same_joints
from dhkit.own_arms import PEN_OFFERS
from dhkit.public import variant_ranges
from dhkit.variants import SETS, OwnNumbers, member, numbers_of_set

ARMS = variant_ranges("pen_robot")["arm"]
STUDENTS = {numbers_of_set("pen_robot", which)["arm"]: member("pen_robot", which) for which in range(SETS)}
NOTEBOOK = nbformat.read(Path(__file__).parents[2] / "solutions/pen_robot/pen_robot.ipynb", as_version=4)
OF_THE_DOCUMENT = ("table", "tip", "linear", "height", "circles", "readings")


def handed_in(question, student, *ways):
    answer = question.answer(student, *ways)
    answer = answer.solutions if isinstance(answer, Family) else answer
    return judge(question, evidence(question, answer, student), student)


def test_a_third_of_the_points_at_most_is_earned_on_the_robot_of_the_document():
    worth = points(NOTEBOOK)
    assert sum(worth.values()) == 20
    assert 3 * sum(worth[f"pen_robot.{name}"] for name in OF_THE_DOCUMENT) <= 20


@pytest.mark.parametrize("name", ["own_tip", "still", "inverse", "follow"])
@pytest.mark.parametrize("arm", ARMS)
def test_every_arm_has_its_right_answer_and_its_mistakes(arm, name):
    question, student = find(f"pen_robot.{name}"), STUDENTS[arm]
    assert handed_in(question, student).note == "right"
    for node in question.mistakes:
        for way in node.ways:
            assert handed_in(question, student, way).note == node.note, way


@pytest.mark.parametrize("arm", ARMS)
def test_the_equal_joints_are_those_whose_axes_are_alike(arm):
    shown = arm_of({"arm": arm})
    first, second, sign = own.same_joints(arm)
    assert same_joints(shown) == (first, second)
    assert np.dot(shown.joints[first].direction, shown.joints[second].direction) == sign


@pytest.mark.parametrize("which", range(SETS))
def test_everybodys_points_and_curve_are_solved(which):
    mine, rng = OwnNumbers(numbers_of_set("pen_robot", which)), np.random.default_rng(which)
    found = [(point, own.inverse(*point, mine=mine)) for point in own.draw_points(rng, mine)]
    off = [point for point, solutions in found if not solutions]
    assert len(off) == sum(abs(beside) > 2 * own.ALLOWED for beside in own.BESIDE)
    for point, solutions in found:
        if solutions:
            assert own.residual(np.array(solutions), *point, mine=mine).max() < own.ALLOWED
    for point in own.draw_curve(rng, mine):
        solutions = own.follow(*point, mine=mine).solutions
        assert own.trace_residual(np.array(solutions), *point, mine=mine).max() < 1e-7


def test_the_listing_is_the_function_in_which_nothing_is_mended():
    listing = next(cell.source for cell in NOTEBOOK.cells if cell.id == "colleague").partition("\n\n\n")[0]
    namespace = {"np": np}
    exec(listing, namespace)
    question, faults = find("pen_robot.mended"), {"signs": (1,), "tilt": own.asin, "first": own.atan}
    with np.errstate(invalid="ignore"):
        for args in question.probes("ada", 7):
            if own.mended(*args):
                np.testing.assert_allclose(namespace["colleague"](*args), own.mended(*args, **faults))
            else:
                assert np.isnan(namespace["colleague"](*args)).any()
        found = judge(question, evidence(question, namespace["colleague"]), "ada")
    assert (found.note, found.share) == ("nothing_mended", 0.0), json.dumps(found.feedback)


def test_the_proposed_robots_differ_from_the_printed_one_and_have_one_to_three_freedoms():
    right = find("pen_robot.freedoms").answer(STUDENTS[ARMS[0]])
    assert sorted(right) == [1, 1, 2, 2, 3, 3] and len(PEN_OFFERS) == 6
    assert arms()["pen_swing"].table.symbolic_forward()[:3, 3].jacobian(own.JOINTS).rank() == 3
