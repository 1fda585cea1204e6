"""An arm of the student's own with a spherical wrist: configurations for its wrist centre, how many, and an aligned wrist."""

from __future__ import annotations

from functools import cache

import numpy as np
import sympy

from autograder.judge import Family
from autograder.reference import DHTable, Robot
from dhkit.variants import OwnNumbers

from ..shared.described import Described
from ..shared.pool import arm_of

Rows = list[list[float]]


@cache
def robot_to_wrist(arm: Described) -> Robot:
    """The first three joints; the row behind them, without its joint, leads to the wrist centre."""
    rows = [(row.sigma, *row.parameters) for row in arm.table.rows[:4]]
    rows = [*rows[:3], (*rows[3][:4], 0)]
    used = {str(letter) for row in rows for cell in row[1:] for letter in sympy.S(cell).free_symbols}
    lengths = {letter: value for letter, value in arm.table.values.items() if str(letter) in used}
    return Robot(DHTable(rows, arm.title, arm.table.joints[:3], values=lengths))


def size(arm: Described) -> float:
    """Upper arm and forearm, in metres."""
    return float(arm.table.values["a2"]) + float(arm.table.values["d4"])


@cache
def height_of_axis_2(arm: Described) -> float:
    """Above frame 0, in metres."""
    first_two = arm.table.at(dict(arm.table.values) | dict.fromkeys(arm.joints, 0)).rows[:2]
    return float((first_two[0].transform() * first_two[1].transform())[2, 3])


def wrist_centre(mine: OwnNumbers, at: tuple[float, float, float] | None = None) -> np.ndarray:
    """The student's point, (3,); or another one, `at` multiples of the arm's size from where axis 1 passes axis 2."""
    arm = arm_of(mine)
    return size(arm) * np.array(at or (mine.x, mine.y, mine.z)) + [0, 0, height_of_axis_2(arm)]


def list_configurations(mine: OwnNumbers) -> Rows:
    """All [q1, q2, q3] that bring the wrist centre to the student's point, those with one q1 together."""
    found = robot_to_wrist(arm_of(mine)).inverse(wrist_centre(mine)).q
    first = np.angle(np.exp(1j * (found[:, 0] - found[0, 0])))
    return found[np.argsort(np.abs(first) > 1e-6, kind="stable")].tolist()


def residual(q: np.ndarray, mine: OwnNumbers) -> np.ndarray:
    """Distance of the wrist centre from the student's point, (k,), for joint values (k, 3)."""
    return np.linalg.norm(robot_to_wrist(arm_of(mine)).forward(q)[:, :3, 3] - wrist_centre(mine), axis=-1)


# ---------------------------------------------------------------- how many

POINTS = {"a": (0.36, 0.48, 0.2), "b": (0.612, 0.816, 0.0), "c": (0.012, 0.016, 0.7)}


def counts(mine: OwnNumbers) -> list[int]:
    """Of the arm without its wrist for the points a, b and c; of the whole arm for a and a general orientation."""
    robot = robot_to_wrist(arm_of(mine))
    found = [len(robot.inverse(wrist_centre(mine, at))) for at in POINTS.values()]
    return [*found, 2 * found[0]]


# ---------------------------------------------------------------- the aligned wrist


def aligned_pose(mine: OwnNumbers) -> tuple[np.ndarray, np.ndarray]:
    """Frame 6 with the wrist at zero, and the same turned about Z6 until its X is `roll` above the horizontal, (4, 4)."""
    straight = arm_of(mine).table.forward([mine.t1, mine.t2, mine.t3, 0, 0, 0])
    approach = straight[:3, 2]
    level = np.cross([0, 0, 1], approach) / np.linalg.norm(np.cross([0, 0, 1], approach))
    x_axis = np.cos(mine.roll) * level + np.sin(mine.roll) * np.cross(approach, level)
    target = straight.copy()
    target[:3, :3] = np.column_stack([x_axis, np.cross(approach, x_axis), approach])
    return straight, target


def align(mine: OwnNumbers, sign=1, offset=0.0, unit=1.0) -> Family:
    """[q4, 0, q6] of the aligned wrist: with q4 = 0, with q6 = 0, with both equal. Only the sum is fixed.

    The sum may have another `sign`, an `offset` in radians, and another `unit`.
    """
    straight, target = aligned_pose(mine)
    x, y = straight[:3, :2].T @ target[:3, 0]
    total = unit * (sign * float(np.arctan2(y, x)) + offset)
    return Family([[share * total, 0.0, (1 - share) * total] for share in (0.0, 1.0, 0.5)])


def aligned_residual(q: np.ndarray, mine: OwnNumbers) -> np.ndarray:
    """Distance plus angle of frame 6 from the student's pose, (k,), for wrists (k, 3)."""
    joints = np.concatenate([np.broadcast_to([mine.t1, mine.t2, mine.t3], (len(q), 3)), q], axis=1)
    gap = arm_of(mine).table.forward(joints) - aligned_pose(mine)[1]
    return np.linalg.norm(gap[:, :3, 3], axis=-1) + np.linalg.norm(gap[:, :3, :3], axis=(-2, -1)) / np.sqrt(2)
