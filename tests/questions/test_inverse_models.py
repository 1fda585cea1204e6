"""The arms of the inverse models: each that an id can pick has its answers and its mistakes, and four configurations."""

import numpy as np
import pytest
from answers import evidence

from autograder.judge import Family, judge
from autograder.questions import find
from autograder.questions.inverse_models import own
from autograder.questions.shared.pool import arms
from dhkit.public import variant_ranges
from dhkit.variants import SETS, OwnNumbers, member, numbers_of_set

ARMS = variant_ranges("inverse_models")["arm"]
STUDENTS = {numbers_of_set("inverse_models", which)["arm"]: member("inverse_models", which) for which in range(SETS)}


def handed_in(question, student, *ways):
    answer = question.answer(student, *ways)
    answer = answer.solutions if isinstance(answer, Family) else answer
    return judge(question, evidence(question, answer, student), student)


@pytest.mark.parametrize("name", ["own_point", "own_counts", "aligned"])
@pytest.mark.parametrize("arm", ARMS)
def test_every_arm_has_its_right_answer_and_its_mistakes(arm, name):
    question, student = find(f"inverse_models.{name}"), STUDENTS[arm]
    assert handed_in(question, student).note == "right"
    for node in question.mistakes:
        for way in node.ways:
            assert handed_in(question, student, way).note == node.note


@pytest.mark.parametrize("which", range(SETS))
def test_everybodys_point_is_reached_in_four_ways_and_everybodys_pose_is_no_special_one(which):
    mine = OwnNumbers(numbers_of_set("inverse_models", which))
    found = own.list_configurations(mine)
    assert len(found) == 4 and own.residual(np.array(found), mine).max() < 1e-9
    assert abs(own.aligned_pose(mine)[0][2, 2]) < 0.95  # the horizontal is well defined


@pytest.mark.parametrize("name", ARMS)
def test_with_the_wrist_at_zero_axes_4_and_6_are_one_line_of_one_sense(name):
    table, at_zero = arms()[name].table, np.eye(4)
    frames = []
    for row in table.at({**table.values, **dict.fromkeys(arms()[name].joints, 0.0)}).rows:
        at_zero = at_zero @ np.array(row.transform(), float)
        frames.append(at_zero)
    np.testing.assert_allclose(frames[3][:3, 2], frames[5][:3, 2], atol=1e-12)
    np.testing.assert_allclose(np.cross(frames[3][:3, 2], frames[5][:3, 3] - frames[3][:3, 3]), 0, atol=1e-12)
