"""The wrist formulas agree with the reference solver, and mistakes differ from right answers, whatever numbers a student gets."""

from itertools import product

import numpy as np
import pytest

from autograder.questions import find
from autograder.questions.orientation.model import R, draw_rotation_and_sign, e, wrist_angles
from dhkit.geometry import rotation_angle_between
from dhkit.public import variant_ranges
from dhkit.variants import OwnNumbers
from dhm.orientation import EULER_SETS, euler_angles, rpy_matrix


@pytest.mark.parametrize("axes", EULER_SETS)
def test_wrist_formulas_give_both_solutions_of_the_reference_solver(axes):
    values = {name: value for name, value in draw_rotation_and_sign(np.random.default_rng(5)).items() if name != "e"}
    matrix = np.array([values[str(entry)] for entry in R]).reshape(3, 3)
    found = [[float(angle.subs(values | {"e": sign})) for angle in wrist_angles(axes)] for sign in (1, -1)]
    assert found == pytest.approx(euler_angles(matrix, axes, intrinsic=True).angles, abs=1e-9)
    assert all(angle.has(e) for angle in wrist_angles(axes))


def test_wrists_of_the_class_are_euler_sets_and_not_those_of_other_questions():
    assert set(variant_ranges("orientation")["wrist"]) <= set(EULER_SETS) - {"zyz", "zyx"}


def test_no_top_of_the_class_makes_a_mistake_look_right():
    question, names = find("orientation.spun"), ("precession", "nutation", "spin")
    ranges = [variant_ranges("orientation")[name] for name in names]
    for own in product(*(np.arange(low, high + step / 2, step) for low, high, step in ranges)):
        right = question.reference(mine=OwnNumbers(zip(names, own)))
        wrong = rpy_matrix(*np.transpose([node.steps[0](right) for node in question.mistakes]))
        assert rotation_angle_between(wrong, rpy_matrix(*right)).min() > 2 * question.accuracy, own
