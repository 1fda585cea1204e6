"""What a function is asked with meets all that its statement demands: slips that are right nearly everywhere are seen."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from answers import STUDENT, verdict

from autograder.questions import exercises, find
from dhm.transforms import modified_dh

SOLUTIONS = Path(__file__).parents[2] / "solutions"
ALMOST = [
    ("scara_s600.mgi", {"slack": 0.02}, None),
    ("scara_s600.mgi", {"slack": 1e-11}, "limit_taken_for_out_of_reach"),
    ("inverse_models.rx90", {"slack": 0.02}, "tolerance_too_wide"),
    ("inverse_models.rx90", {"slack": 1e-11}, "limit_taken_for_out_of_reach"),
    ("pen_robot.inverse", {"slack": 0.0005}, None),
    ("pen_robot.inverse", {"slack": 0.002}, "tolerance_too_wide"),
    ("pen_robot.inverse", {"slack": 1e-9}, "surface_taken_too_narrow"),
    ("tables.freedoms", {"below": 1e-15}, "tolerance_of_the_rank"),
    ("tables.freedoms", {"below": 1e-3}, "tolerance_of_the_rank"),
    ("orientation.zyz", {"lock": 1e-8 * 2}, "lock_seen_too_early"),
    ("orientation.zyz", {"lock": 3e-3}, "lock_seen_too_early"),
    ("orientation.mended", {"lock": 0.01}, None),
    ("orientation.mended", {"lock": 0.13}, "lock_seen_too_early"),
    ("parameters.link", {"slack": 1e-7}, "tolerance_too_wide"),
    ("workspace.count", {"needs_first": True}, "second_posture_only_after_the_first"),
]


@pytest.mark.parametrize(("id", "wrong", "note"), ALMOST, ids=[f"{id} {wrong}" for id, wrong, _ in ALMOST])
def test_a_function_that_is_right_nearly_everywhere_is_not_right(id, wrong, note):
    question = find(id)
    found = verdict(question, question.compute(STUDENT, wrong))
    assert found.note == (note or found.note) and found.share < 1


@pytest.mark.parametrize("id", [q.id for qs in exercises().values() for q in qs if q.form.kind == "function"])
def test_every_tolerance_that_a_statement_promises_is_tried(id):
    """Where a statement of a function tells a size for rounding, a slip at that size stands in the table above."""
    exercise, _, name = id.partition(".")
    cells = json.loads((SOLUTIONS / exercise / f"{exercise}.ipynb").read_text())["cells"]
    names = [cell["metadata"].get("nbgrader", {}).get("grade_id") for cell in cells]
    before = names.index(f"{exercise}-{name}-answer")
    statement = next("".join(cell["source"]) for cell in cells[before - 1 :: -1] if cell["cell_type"] == "markdown")
    assert not re.search(r"10\^\{-\d+\}", statement) or id in {known for known, *_ in ALMOST}


@pytest.mark.parametrize("alpha", [0, 1, -1, 2, -2])
@pytest.mark.parametrize("theta", [0, 1, -1, 2])
def test_parameters_are_read_from_every_special_twist(alpha, theta):
    """The reference is right there, and the probes have each special twist."""
    question = find("transforms.parameters")
    row = (0.3, alpha * np.pi / 2, 0.4, theta * np.pi / 2)
    a, twist, d, turn = question.answer(STUDENT)(
        (np.round(np.array(modified_dh(*row), dtype=float), 12) + 0.0).tolist()
    )
    assert np.allclose([a, d, *np.exp([1j * twist, 1j * turn])], [0.3, 0.4, *np.exp([1j * row[1], 1j * row[3]])])
    probed = np.array([args[0] for args in question.probes(STUDENT, 7)])
    assert (np.hypot(probed[:, 1, 2] + np.sin(row[1]), probed[:, 2, 2] - np.cos(row[1])) < 1e-9).any()
    assert (np.hypot(probed[:, 0, 1] + np.sin(row[3]), probed[:, 0, 0] - np.cos(row[3])) < 1e-9).any()


@pytest.mark.parametrize("student", ["ada", "bob", "m17"])
def test_postures_are_counted_with_every_elbow_and_turns_of_both_joints(student):
    question = find("workspace.count")
    limits = np.array([args[3] for args in question.probes(student, 3)])
    assert (limits[:, :, 1] > np.pi + 0.1).any(axis=0).all()
    for wrong in ({"needs_first": True}, {"needs_first": True, "elbows": slice(None, None, -1)}):
        count, right = question.compute(student, wrong), question.answer(student)
        assert any(count(*args) != right(*args) for args in question.probes(student, 3))
