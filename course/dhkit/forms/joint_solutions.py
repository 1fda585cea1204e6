"""All ways to reach a target."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .. import nodes
from ..geometry import wrap
from ..schema import unique
from ..values import reals, values
from .base import Fields, Names, Parts, Sight, squeezed

MAX_SOLUTIONS = 100
"""Sets of solutions are compared pair by pair; a general six-axis arm has at most 16."""


class JointSolutions(Fields, frozen=True, kw_only=True):
    """A list of joint positions; an empty one says that there is no solution.

    Each is a list in the order of the joints or a dictionary keyed by their names; one alone may stand without the list
    around it, or as a column matrix, and several may be a dictionary of columns.

    Attributes
    ----------
    joints : tuple of str
        Names and order of the joint variables.
    """

    joints: Names

    def __post_init__(self) -> None:
        unique("joints", self.joints)
        if not self.joints:
            raise ValueError("joints: none is named")

    def arranged(self, node: object) -> object:
        node = nodes.rows_in_order(nodes.listed(node), self.joints)
        shape, count = nodes.array_shape(node), len(self.joints)
        if shape == (count, 1) != (1, 1):
            return [list(nodes.entries(node))]
        return [node] if shape == (count,) else node

    def misfit(self, node: object) -> str | None:
        shape = nodes.array_shape(node)
        if not isinstance(node, list) or (shape != (0,) and (shape is None or shape[1:] != (len(self.joints),))):
            turned = shape is not None and len(shape) == 2 and shape[0] == len(self.joints)
            return nodes.describe(node) + (": each solution is a row, not a column" if turned else "")
        if len(node) > MAX_SOLUTIONS:
            return f"{len(node)} solutions, more than any robot has"
        return nodes.alien(node, ()) or unreal(node)

    def invariants(self, node: object, sight: Sight) -> Parts:
        rows = self._rows(node)
        found = rows[distinct(rows, sight.angles, sight.tolerance)]
        alone = {f"solution {i + 1}": squeezed(row[None], sight.angles) for i, row in enumerate(found)}
        return {"": np.array([len(found), *_sums(found, sight)]), **alone}

    def witness(self, node: object, sight: Sight) -> np.ndarray:
        return self._rows(node).ravel()

    def agree(self, first: np.ndarray, second: np.ndarray, sight: Sight) -> bool:
        mine, theirs = first.reshape(-1, len(self.joints)), second.reshape(-1, len(self.joints))
        same = close(mine, theirs, sight.angles, sight.tolerance)
        return bool(same.any(axis=1).all() and same.any(axis=0).all())

    def _rows(self, node: object) -> np.ndarray:
        return reals(node, {}).reshape(-1, len(self.joints))


def close(
    a: np.ndarray, b: np.ndarray, angles: Sequence[int], tolerance: float | np.ndarray, turn: float = 2 * np.pi
) -> np.ndarray:
    """Which of the (m, n) solutions `a` are the same as which of the (k, n) solutions `b`, (m, k) booleans.

    Parameters
    ----------
    a, b : ndarray
    angles : sequence of int
        Joints that are equal modulo a turn.
    tolerance : float or ndarray, shape (k, n)
        Largest difference between equal joint values.
    turn : float
        In the unit of the angles.
    """
    gap = np.abs(a[:, None] - b[None])
    gap[..., list(angles)] = np.abs(wrap(gap[..., list(angles)] * (2 * np.pi / turn)))
    return (gap <= tolerance).all(axis=-1)


def distinct(solutions: np.ndarray, angles: Sequence[int], tolerance: float, turn: float = 2 * np.pi) -> list[int]:
    """Places of the solutions (k, n) that stand for all of them, each once."""
    kept: list[int] = []
    for i, same in enumerate(close(solutions, solutions, angles, tolerance, turn)):
        if not same[kept].any():
            kept.append(i)
    return kept


FREQUENCIES = (
    (1, 1, 1, 1, 1, 1), (1, -1, 2, 1, -1, 1), (2, 1, -1, 1, 1, -1), (1, 2, 1, -1, 2, 1),
    (-1, 1, 1, 2, 1, 1), (1, 1, -2, 1, -1, 2), (2, -1, 1, 1, 2, -1), (1, -2, -1, -1, 1, 1),
)  # fmt: skip
"""Whole numbers of turns, joint after joint and from the first again: no wave tells 2 pi more or less."""


def _sums(solutions: np.ndarray, sight: Sight) -> list[float]:
    """Means over the solutions of waves in their joints: without order, and modulo a turn where joints are angles."""
    waves = []
    for number, pattern in enumerate(FREQUENCIES):
        turns = np.resize(np.array(pattern, float), solutions.shape[1])
        lengths = [joint for joint in range(len(turns)) if joint not in sight.angles]
        turns[lengths] *= 1.37  # no period that a length could have by chance
        # A cosine of a cosine: plain waves cancel between solutions that are half a turn apart.
        wave = np.cos(2 * np.cos(solutions @ turns + number) + number)
        waves.append(float(wave.mean() / (2 * np.abs(turns).sum())) if len(solutions) else 0.0)
    return waves


def unreal(node: list) -> str | None:
    """What keeps an array of constant expressions from being one of real numbers, in words; None if nothing does."""
    if nodes.blanks(node):
        return "an entry that is not filled in"
    found = values(node, {})
    if not np.isfinite(found).all():
        return "a value that is not finite"
    return "a complex number" if np.abs(found.imag).max(initial=0) > 1e-9 else None
