"""Arms that a student's id chooses: their tables lead where the statement says."""

import numpy as np
import pytest

from autograder.questions import find
from autograder.reference import DHTable
from dhkit.geometry import rigid_transform, rot
from dhkit.own_arms import CLASSIC_ARMS, JOINT_LISTS, SIGNED_ARMS, joint_list
from dhkit.variants import OwnNumbers, numbers

AHEAD_AND_DOWN = np.array([(0, 0, 1), (0, -1, 0), (1, 0, 0)]) @ np.diag([-1, -1, 1])
"""The gripper at zero: z ahead, x down."""
POINTS = {"ahead": (1, 0, 0), "up": (0, 0, 1), "along $+y$": (0, 1, 0), "along $-y$": (0, -1, 0)}


def own(file):
    return OwnNumbers({**numbers("tables", "ada"), "file": file})


def frames(rows, q):
    """The frames of a table of the reference at joint values q, shape (n, 4, 4)."""
    table = DHTable(rows)
    found = [np.eye(4)]
    for row in table.at(dict(zip(map(str, table.joints), q))).rows:
        found.append(found[-1] @ np.array(row.transform(), float))
    return np.array(found[1:])


@pytest.mark.parametrize("file", JOINT_LISTS)
def test_the_table_of_a_list_leads_where_the_list_leads(file):
    mine, q = own(file), [0.3, -0.5, 0.7, 1.1, -0.4]
    there = np.diff([np.zeros(3), *joint_list(mine).origins], axis=0)
    along_list = np.eye(4)
    for line, step, value in zip(joint_list(mine).lines, there, q):
        slide = value * np.eye(3)["xyz".index(line.axis)] if line.slides else 0
        along_list = along_list @ rigid_transform(np.eye(3), step + slide)
        along_list = along_list if line.slides else along_list @ rot(line.axis, value)
    along_list = along_list @ rigid_transform(AHEAD_AND_DOWN, there[-1])
    rows, gripper = (find(f"tables.{name}").reference(mine) for name in ("arm", "gripper"))
    np.testing.assert_allclose(frames(rows, q)[-1] @ np.array(gripper, float), along_list, atol=1e-12)


@pytest.mark.parametrize("file", JOINT_LISTS)
def test_frames_stand_as_the_list_tells(file):
    mine = own(file)
    for line, origin, frame in zip(
        JOINT_LISTS[file], joint_list(mine).origins, frames(find("tables.arm").reference(mine), [0] * 5)
    ):
        z = np.eye(3)["xyz".index(line.axis)]
        np.testing.assert_allclose(frame[:3, [0, 2]].T, [POINTS[line.X], z], atol=1e-12)
        np.testing.assert_allclose(np.cross(frame[:3, 3] - origin, z), 0, atol=1e-12)
        assert abs(frame[1, 3]) < 1e-12


def test_the_list_is_said_with_ones_own_numbers():
    said = joint_list(own("lift"))._repr_markdown_()
    assert "| 1 | slides | 0 | 0 | 0.36 | $z$ | ahead |" in said and said.count("\n| ") == 7


@pytest.mark.parametrize("arm", CLASSIC_ARMS)
def test_the_modified_table_of_a_classic_arm_ends_in_the_same_place(arm):
    values = {"a1": 0.2, "a2": 0.5, "a3": 0.4, "d1": 0.6, "d2": 0.15}
    mine = OwnNumbers({**numbers("transforms", "ada"), "arm": arm})
    q = [0.4, -0.8, 0.3]
    rows = [[cell.subs(values) if hasattr(cell, "subs") else cell for cell in row] for row in CLASSIC_ARMS[arm]]
    classic = np.eye(4)
    for (sigma, a, alpha, d, theta), value in zip(rows, q):
        theta, d = (float(theta), value) if sigma else (value, float(d))
        screw_z = rot("z", theta) @ rigid_transform(np.eye(3), (0, 0, d))
        classic = classic @ screw_z @ rigid_transform(np.eye(3), (float(a), 0, 0)) @ rot("x", float(alpha))
    modified = find("transforms.convert").reference(mine)
    modified = [[cell.subs(values) if hasattr(cell, "subs") else cell for cell in row] for row in modified]
    np.testing.assert_allclose(frames(modified, q)[-1], classic, atol=1e-12)


@pytest.mark.parametrize("arm", SIGNED_ARMS)
def test_a_table_without_negative_twists_ends_in_the_same_place(arm):
    mine = OwnNumbers({**numbers("parameters", "ada"), "arm": arm})
    values = dict(zip(("a1", "a2", "a3", "a4", "d1", "d3", "d4", "d5"), (0.25, 0.4, 0.15, 0.3, 0.4, 0.3, 0.35, 0.2)))
    printed, rewritten = SIGNED_ARMS[arm], find("parameters.flip").reference(mine)
    ends = []
    for rows in (printed, rewritten):
        rows = [[cell.subs(values) if hasattr(cell, "subs") else cell for cell in row] for row in rows]
        ends.append(frames(rows, [0.4, -0.8, 0.3, 0.9, -0.2])[-1])
    np.testing.assert_allclose(*ends, atol=1e-12)
    assert sum(row[2].is_negative for row in printed) == 2 and not any(row[2].is_negative for row in rewritten)
