"""One gauge for all tables of a robot: axes that lie along each other point the same way, and their links are positive.

The modified DH convention leaves the sense of every Z_i and X_i free, so one arm has many tables: a quill that points
down, an elbow with alpha = 180 degrees, a link of negative length. The inverse models read a table after `canonical`,
which flips frames between base and tool. Joint variables stay the user's: what a flip does to them stands in the
chain's coupling and offsets. The `demand_...` functions say in words what a table lacks, in its own numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .forward import Chain

_ZERO = 1e-12  # sine or cosine under which two axes count as parallel or square
_TURN_OVER = np.diag([1.0, -1.0, -1.0, 1.0])
_KINDS = ("revolute", "prismatic")


def canonical(chain: Chain) -> Chain:
    """The same robot with the same joint variables: parallel axes alike in sense, links between them not negative.

    Tables that are so already come back as they are.
    """
    moving = range(1, min(chain.joints, len(chain.a)))
    for row in moving:
        if is_parallel(chain, row) and chain.cos_alpha[row] < 0:
            chain = _with_z_flipped(chain, row)
    for row in moving:
        if is_parallel(chain, row) and chain.a[row] < 0:
            chain = _with_x_flipped(chain, row - 1)
    return chain


def is_parallel(chain: Chain, row: int) -> bool:
    """Whether the axis of a row (counted from 0) lies along the one before, in either sense."""
    return abs(chain.sin_alpha[row]) < _ZERO


def is_square(chain: Chain, row: int) -> bool:
    """Whether the axis of a row (counted from 0) is at a right angle to the one before."""
    return abs(chain.cos_alpha[row]) < _ZERO


def _with_z_flipped(chain: Chain, row: int) -> Chain:
    """Frame `row` turned by half a turn about its X: Z points the other way, d and theta change their signs."""
    sense = np.where(np.arange(len(chain.a)) == row, -1.0, 1.0)
    last = row + 1 == len(chain.a)
    twist = sense if last else sense * np.roll(sense, 1)
    return replace(
        chain,
        cos_alpha=twist * chain.cos_alpha,
        sin_alpha=twist * chain.sin_alpha,
        fixed=sense * chain.fixed,
        coupling=sense[:, None] * chain.coupling,
        offset=sense * chain.offset,
        tool=_TURN_OVER @ chain.tool if last else chain.tool,
    )


def _with_x_flipped(chain: Chain, row: int) -> Chain:
    """Frame `row` turned by half a turn about its Z: X points the other way, the next a and alpha change their signs."""
    sense = np.where(np.arange(len(chain.a)) == row + 1, -1.0, 1.0)
    turn = np.zeros(len(chain.a))
    turn[row : row + 2] = np.pi, -np.pi
    return replace(
        chain,
        a=sense * chain.a,
        sin_alpha=sense * chain.sin_alpha,
        fixed=chain.fixed + np.where(chain.prismatic, turn, 0.0),
        offset=chain.offset + np.where(chain.prismatic, 0.0, turn),
    )


def demand_kinds(chain: Chain, kinds: Sequence[int], first: int = 0) -> None:
    """Raises ValueError unless the joints from row `first` on are revolute (0) or prismatic (1) as told."""
    for row, kind in enumerate(kinds, start=first):
        if chain.prismatic[row] != kind:
            raise ValueError(f"joint {row + 1} is {_KINDS[not kind]}, not {_KINDS[kind]}")


def demand_parallel(chain: Chain, row: int) -> None:
    """Raises ValueError unless the axis of a row (counted from 0) lies along the one before."""
    if not is_parallel(chain, row):
        raise ValueError(f"axes {row} and {row + 1} are not parallel: {_twist(chain, row)}")


def demand_square(chain: Chain, row: int) -> None:
    """Raises ValueError unless the axis of a row (counted from 0) is at a right angle to the one before."""
    if not is_square(chain, row):
        raise ValueError(f"axes {row} and {row + 1} are not at a right angle: {_twist(chain, row)}")


def demand_length(length: float, what: str, letter: str) -> None:
    """Raises ValueError for a link that has no length, named in words and by its letter."""
    if not length:
        raise ValueError(f"{what} has no length: {letter} = 0")


def _twist(chain: Chain, row: int) -> str:
    return f"alpha_{row} = {np.degrees(np.arctan2(chain.sin_alpha[row], chain.cos_alpha[row])):.6g} degrees"
