"""The formulas behind the wrist question agree with the reference solver, for every wrist that a student can get."""

import numpy as np
import pytest
from dhkit.public import variant_ranges

from autograder.questions.orientation import R, e, rotation_and_sign, wrist_angles
from autograder.reference.orientation import EULER_SETS, euler_angles


@pytest.mark.parametrize("axes", EULER_SETS)
def test_wrist_formulas_give_both_solutions_of_the_reference_solver(axes):
    values = {name: value for name, value in rotation_and_sign(np.random.default_rng(5)).items() if name != "e"}
    matrix = np.array([values[str(entry)] for entry in R]).reshape(3, 3)
    found = [[float(angle.subs(values | {"e": sign})) for angle in wrist_angles(axes)] for sign in (1, -1)]
    assert found == pytest.approx(euler_angles(matrix, axes, intrinsic=True).angles, abs=1e-9)
    assert all(angle.has(e) for angle in wrist_angles(axes))


def test_wrists_of_the_class_are_euler_sets_and_not_those_of_other_questions():
    assert set(variant_ranges("orientation")["wrist"]) <= set(EULER_SETS) - {"zyz", "zyx"}
