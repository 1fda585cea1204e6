"""The pool of arms: what the kit shows of them is what their tables say, and can be drawn."""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

from autograder import questions
from autograder.questions.shared.described import describe
from autograder.questions.shared.pool import KIT_FILE, arms, for_the_kit
from autograder.questions.shared.pool import shown as as_shown
from dhkit.arms import EXTENDED, arm_of
from dhkit.drawing.arms import draw_arm


def test_the_kit_shows_the_arms_of_the_pool():
    assert KIT_FILE.read_text(encoding="utf-8") == for_the_kit(), "python -m autograder.questions.shared.pool"


def test_the_kit_shows_the_robot_of_each_exercise_on_one():
    for file in Path(questions.__file__).parent.glob("*/robot.toml"):
        kit = KIT_FILE.parent / "questions" / f"{file.parent.name}.json"
        assert json.loads(kit.read_text(encoding="utf-8")) == as_shown(describe(file.read_text(encoding="utf-8"))), kit


@pytest.mark.parametrize("name", arms())
def test_axes_and_end_effector_are_where_the_table_puts_them(name):
    described, shown = arms()[name], arm_of({"arm": name})
    sliding = {joint.name: EXTENDED for joint in shown.joints if joint.slides}
    q = [sliding.get(joint.name, 0.0) for joint in shown.joints]
    numbers = {**described.table.values, **dict(zip(described.joints, q))}
    frame, frames = np.eye(4), []
    for row in described.table.at(numbers).rows:
        frame = frame @ np.array(row.transform(), float)
        frames.append(frame)
    for joint, frame in zip(shown.joints, frames):
        np.testing.assert_allclose(frame[:3, 2], joint.direction, atol=1e-12)
        np.testing.assert_allclose(frame[:3, 3], shown.at(joint.point, sliding), atol=1e-12)
    np.testing.assert_allclose(frames[-1], described.table.forward(q), atol=1e-12)
    np.testing.assert_allclose(frames[-1][:3, 3], shown.at(shown.origin, sliding), atol=1e-12)
    np.testing.assert_allclose(frames[-1][:3, [0, 2]].T, [shown.x, shown.z], atol=1e-12)


@pytest.mark.parametrize("name", arms())
def test_an_arm_is_said_in_words_and_drawn_with_each_joint_and_length(name):
    shown = arm_of({"arm": name})
    said = shown._repr_markdown_()
    assert shown.title in said and said.count("\n| ") == len(shown.joints) + 1
    ax = draw_arm(shown)
    texts = " ".join(text.get_text() for text in ax.texts)
    plt.close(ax.figure)
    for number in range(1, len(shown.joints) + 1):
        assert f"Z_{{{number}}}" in texts
    assert set(shown.letters) == set(shown.lengths), "each length is one that can be seen"


def test_own_lengths_come_before_those_of_the_pool():
    assert arm_of({"arm": "crane", "l1": 0.7}).lengths["l1"] == 0.7
