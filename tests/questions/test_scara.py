"""The own arms of the SCARA exercise: each that an id can pick has its right answers, its mistakes and its picture."""

from contextlib import suppress

import matplotlib.pyplot as plt
import pytest
from answers import evidence

from autograder.judge import judge
from autograder.questions import find
from dhkit.arms import arm_of
from dhkit.pictures import show_on_arm
from dhkit.public import variant_ranges
from dhkit.variants import SETS, member, numbers_of_set

ARMS = variant_ranges("scara")["arm"]
STUDENTS = {numbers_of_set("scara", which)["arm"]: member("scara", which) for which in range(SETS)}


def handed_in(question, student, *ways):
    return judge(question, evidence(question, question.answer(student, *ways), student), student)


def test_every_arm_of_the_list_is_somebodys():
    assert STUDENTS.keys() == set(ARMS)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["table", "T0E", "model", "measured"])
@pytest.mark.parametrize("arm", ARMS)
def test_every_arm_has_its_right_answer_and_its_mistakes(arm, name):
    question, student = find(f"scara.{name}"), STUDENTS[arm]
    assert handed_in(question, student).note == "right"
    known = [node.note for node in question.mistakes]
    for node in question.mistakes:
        for way in node.ways:
            try:
                found = handed_in(question, student, way).note
            except ValueError as none:
                assert "changes nothing" in str(none)
                continue
            # With some arms two mistakes come to the same, or to nothing: what comes first in the tree has the name.
            assert found == "right" or known.index(found) <= known.index(node.note), (node.note, found)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["table", "T0E", "model", "measured"])
def test_every_mistake_has_its_name_with_some_arm(name):
    question, named = find(f"scara.{name}"), set()
    for student in STUDENTS.values():
        for node in question.mistakes:
            for way in node.ways if node.note not in named else ():
                with suppress(ValueError):
                    named |= {handed_in(question, student, way).note} & {node.note}
    assert named == {node.note for node in question.mistakes}


@pytest.mark.slow
@pytest.mark.parametrize("arm", ARMS)
def test_the_right_answer_lies_on_the_end_effector_as_drawn(arm):
    shown, question = arm_of({"arm": arm}), find("scara.T0E")
    ax = show_on_arm(question.answer(STUDENTS[arm]), shown, [0.3, 0.3, 0.4, 0.5])
    assert "E" in " ".join(text.get_text() for text in ax.texts)
    plt.close(ax.figure)
