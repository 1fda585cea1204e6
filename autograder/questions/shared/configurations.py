"""Of a described arm: a configuration to come back to, its pose, and every solution for it."""

from __future__ import annotations

from functools import cache

import numpy as np

from autograder.judge import Family
from autograder.reference import Robot, Status, jacobian
from dhkit.geometry import rotation_angle_between

from .described import Described

_MOST_SOLUTIONS = 16
_REPRESENTATIVES = 4
_WELL_AWAY = 0.03  # smallest of the largest singular value: far from what is singular, so that rounding does not hurt
_TRIES = 60


@cache
def robot_of(arm: Described) -> Robot:
    """The arm with its inverse model, made once."""
    return arm.robot


@cache
def turning(arm: Described) -> tuple[int, ...]:
    """The places of the joints that turn, from 0."""
    return tuple(i for i, row in enumerate(arm.table.moving) if not row.sigma)


@cache
def task_rows(arm: Described) -> int:
    """How many rows of the Jacobian count: 3, the position, where every joint is needed for it, else 6."""
    q = _drawn(arm, np.random.default_rng(1), 8)
    position = jacobian(arm.table, q)[:, :3]
    return 3 if int(_ranks(position).max()) == len(arm.joints) else 6


@cache
def configuration(arm: Described) -> tuple[float, ...]:
    """The joint values whose pose is asked back: those of the file, or else some in general position."""
    if arm.posture:
        return arm.posture
    drawn = _in_general_position(arm, 0)
    reached = (q for q in drawn if not robot_of(arm).has_inverse or len(robot_of(arm).inverse(arm.table.forward(q))))
    return tuple(next(reached, drawn[0]).tolist())


@cache
def standing(arm: Described) -> tuple[float, ...]:
    """Other joint values in general position: statements tell them, so they must not be those whose pose is asked back."""
    return tuple(_in_general_position(arm, 1)[0].tolist())


def _in_general_position(arm: Described, seed: int) -> np.ndarray:
    """Joint values (k, n), k at least 1, far from what is singular where the arm has such."""
    drawn = _drawn(arm, np.random.default_rng(seed), _TRIES)
    J = jacobian(arm.table, drawn)[:, : task_rows(arm)]
    values = np.linalg.svd(J, compute_uv=False)
    good = drawn[values[:, int(_ranks(J).max()) - 1] > _WELL_AWAY * values[:, 0]]
    return good if len(good) else drawn


def _drawn(arm: Described, rng: np.random.Generator, count: int) -> np.ndarray:
    """Joint values (count, n) of one decimal, slides of two; none of them is zero."""
    turns = np.isin(np.arange(len(arm.joints)), turning(arm))
    angles = rng.integers(2, 16, (count, len(turns))) / 10 * rng.choice([-1, 1], (count, len(turns)))
    return np.where(turns, angles, rng.integers(8, 32, (count, len(turns))) / 100)


def _ranks(J: np.ndarray) -> np.ndarray:
    values = np.linalg.svd(J, compute_uv=False)
    return (values > 1e-9 * np.maximum(values[..., :1], 1e-12)).sum(axis=-1)


@cache
def target(arm: Described) -> np.ndarray:
    """The pose (4, 4) that is asked back."""
    return arm.table.forward(configuration(arm))


@cache
def all_solutions(arm: Described) -> list[list[float]] | Family | None:
    """All joint values for the pose that is asked back, or a family of them; None where there is no inverse model."""
    if not robot_of(arm).has_inverse:
        return None
    found = robot_of(arm).inverse(target(arm), near=configuration(arm))
    if not 0 < len(found) <= _MOST_SOLUTIONS:
        return None
    if found.status is Status.INFINITE:
        reaching = [row for row in found.q if residual(arm, row[None]) < 1e-6]
        return Family([row.tolist() for row in reaching[:_REPRESENTATIVES]])
    return found.q.tolist()


def why_not(arm: Described) -> str:
    """Why the inverse model of an arm is not asked for, in words."""
    try:
        found = robot_of(arm).inverse(target(arm))
    except ValueError as error:
        return str(error)
    return f"its pose is {found.status.value}: {found.reason}"


@cache
def is_for_point(arm: Described) -> bool:
    """Whether only the position can be asked back: an arm with few joints does not reach it with the same orientation twice."""
    if not robot_of(arm).has_inverse:
        return task_rows(arm) == 3
    return bool((_turned(arm, robot_of(arm).inverse(target(arm)).q) > 1e-6).any())


def residual(arm: Described, q: np.ndarray) -> np.ndarray:
    """How far the end effector is from the target, (k,), for joint values (k, n): metres, and radians where they count."""
    far = np.linalg.norm(arm.table.forward(q)[:, :3, 3] - target(arm)[:3, 3], axis=1)
    return far if is_for_point(arm) else far + _turned(arm, q)


def _turned(arm: Described, q: np.ndarray) -> np.ndarray:
    """Angle between the end effector and its target, (k,), in radians."""
    return rotation_angle_between(arm.table.forward(q)[:, :3, :3], target(arm)[:3, :3])
