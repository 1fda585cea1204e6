"""Arms of the student's own: one by its axes, turned about them and put in a table, and one by its data sheet."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, lru_cache, reduce

import numpy as np
import sympy

from autograder.judge import Mistake
from dhkit.geometry import modified_dh
from dhkit.variants import OwnNumbers
from dhm.transforms import rigid_inverse, rot_z

from ..shared.arm import turning
from ..shared.described import Described
from ..shared.pool import arm_of
from ..shared.sheets import factors, reading_of, robot_of
from ..shared.tables import list_rows

# ---------------------------------------------------------------- an arm of five turns, by its axes


@cache
def axes_at_zero(arm: Described) -> tuple[sympy.Matrix, ...]:
    """Frames whose Z are the joint axes while all angles are zero, 4x4 each."""
    at_zero, frame, frames = dict.fromkeys(arm.table.joints, 0), sympy.eye(4), []
    for transform in arm.table.transforms():
        frame = (frame * transform.subs(at_zero)).applyfunc(sympy.expand)
        frames.append(frame)
    return tuple(frames)


def turn_about(frame: sympy.Matrix, angle: sympy.Expr, column: str = "p - R p", before: sympy.Matrix | None = None):
    """The turn by an angle about the Z axis of a frame; `column` is what stands in its last one.

    `before` is the frame of the joint before it, from which ``"step"`` counts the centre.
    """
    turn = (frame * rot_z(angle) * rigid_inverse(frame)).applyfunc(sympy.expand)
    centre = frame[:3, 3]
    if column == "step":
        centre = centre - (before[:3, 3] if before is not None else sympy.zeros(3, 1))
    rotation = turn[:3, :3]
    turn[:3, 3] = {
        "p - R p": centre - rotation * centre,
        "step": centre - rotation * centre,
        "R p - p": rotation * centre - centre,
        "p": centre,
        "0": sympy.zeros(3, 1),
    }[column]
    return turn


def turns(mine: OwnNumbers, column: str = "p - R p", sense: int = 1, senses: bool = True) -> list:
    """The matrices K of the student's arm, as lists.

    `column` may be wrong, `sense` -1 turns every joint backwards, and without `senses` every axis points along an axis
    of frame 0, none against it.
    """
    return [matrix.tolist() for matrix in _turns(arm_of(mine), column, sense, senses)]


@lru_cache(maxsize=64)
def _turns(arm: Described, column: str = "p - R p", sense: int = 1, senses: bool = True) -> list[sympy.Matrix]:
    found, before = [], None
    for frame, joint in zip(axes_at_zero(arm), arm.table.joints):
        against = min(frame[:3, 2]) < 0
        angle = -joint if (against and not senses) else sense * joint
        found.append(turn_about(frame, angle, column, before))
        before = frame
    return found


def end_point(mine: OwnNumbers, order: str = "hand first", sense: int = 1, senses: bool = True) -> list[sympy.Expr]:
    """Where the end effector's origin goes, three expressions; `order` may be ``"base first"``, with centres that stay."""
    arm = arm_of(mine)
    factors_, start = _turns(arm, sense=sense, senses=senses), axes_at_zero(arm)[-1][:, 3]
    for matrix in factors_ if order == "base first" else factors_[::-1]:
        start = (matrix * start).applyfunc(sympy.expand)
    return list(start[:3, 0])


def rows(mine: OwnNumbers) -> list[list]:
    """The table of the student's arm."""
    return list_rows(arm_of(mine).table)


def in_rows(about: Mistake, column: int, change) -> Mistake:
    """A mistake in the cells of one column that it changes, all of them at once, or the first, or the last."""

    def step(chosen: slice):
        def changed(table):
            places = [i for i, row in enumerate(table) if not _same(row[column], change(row[column]))][chosen]
            return [
                [change(cell) if k == column and i in places else cell for k, cell in enumerate(row)]
                for i, row in enumerate(table)
            ]

        return changed

    return replace(about, steps=tuple(map(step, (slice(None), slice(1), slice(-1, None)))))


def without_constant(cell) -> sympy.Expr:
    """A joint angle without what stands beside its variable."""
    return cell - cell.subs(dict.fromkeys(cell.free_symbols, 0))


def _same(one, other) -> bool:
    """Whether two cells are equal; a half turn is one in both senses."""
    return (one - other) % (2 * sympy.pi) == 0


# ---------------------------------------------------------------- a robot by its data sheet


def reading(mine: OwnNumbers) -> str:
    """How the student's sheet is read, a letter."""
    return reading_of(mine.robot, mine.sheet)


def other_letter(convention: bool, columns: bool):
    """A step on the letter of a reading: the other convention, the other order of the lengths, or both."""
    return lambda letter: "ABCD"["ABCD".index(letter) ^ columns ^ 2 * convention]


def product(
    mine: OwnNumbers,
    after: int = 0,
    order: str = "base first",
    columns: bool = True,
    convention: bool = True,
) -> sympy.Matrix:
    """Frame 6 seen from frame `after`, from the sheet; read wrongly, or multiplied in the wrong `order`."""
    chosen = factors(mine.robot, mine.sheet, columns, convention)[after:]
    return reduce(sympy.Matrix.multiply, chosen if order == "base first" else chosen[::-1])


def from_frame_2(mine: OwnNumbers, after: int = 2, order: str = "base first", columns=True, convention=True):
    """U2 = 2T6 of the student's robot."""
    return product(mine, after, order, columns, convention)


# ---------------------------------------------------------------- its tool


def forward(*q, mine: OwnNumbers, tool="right", bend="radians", angles="radians", convention=True) -> np.ndarray:
    """The pose of the student's tool on the robot, (4, 4), for six joint values, radians and metres.

    `tool` may be ``"left"``, multiplied from the left, or ``"none"``; the tool's `bend` and the joint `angles` may be
    taken in ``"degrees"``, and the sheet read in the other `convention`.
    """
    arm = robot_of(mine)
    if angles == "degrees":
        q = [np.radians(value) if i in turning(arm) else value for i, value in enumerate(q)]
    pose = arm.table.forward(q) if convention else _misread(mine, q)
    if tool == "none":
        return pose
    step = modified_dh(mine.reach, mine.bend if bend == "degrees" else np.radians(mine.bend), mine.length, 0.0)
    return step @ pose if tool == "left" else pose @ step


def _misread(mine: OwnNumbers, q) -> np.ndarray:
    arm = robot_of(mine)
    values = {str(letter): value for letter, value in arm.table.values.items()} | dict(zip(arm.joints, q))
    matrices = (matrix.subs(values) for matrix in factors(mine.robot, mine.sheet, convention=False))
    return reduce(np.matmul, (np.array(matrix, float) for matrix in matrices))


def draw_joint_values(rng: np.random.Generator, mine: OwnNumbers) -> list[list[float]]:
    """Argument lists for `forward`: any joint values, then quarter turns."""
    angles = turning(robot_of(mine))
    pick = lambda angle, length: [float(angle() if i in angles else length()) for i in range(6)]  # noqa: E731
    any_values = [pick(lambda: rng.uniform(-3, 3), lambda: rng.uniform(0.05, 0.6)) for _ in range(6)]
    quarters = [pick(lambda: rng.integers(-2, 3) * np.pi / 2, lambda: rng.integers(1, 6) / 10) for _ in range(3)]
    return [*any_values, *quarters]


def name_case(*q) -> str:
    """The case a list of joint values belongs to, in words: joints 4 to 6 of every robot turn."""
    quarters = np.divide(q[3:], np.pi / 2)
    return "quarter turns" if np.allclose(quarters, quarters.round()) else "any joint values"
