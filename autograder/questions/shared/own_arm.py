"""Questions about the arm of the pool that a student's id picks: its table, its transform, where its end effector is."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial

import sympy

from autograder.judge import Follow, Mistake, Question, following, mistake
from autograder.judge.chain import SAME_SENSES
from autograder.judge.misconceptions import (
    classic_table,
    columns_exchanged,
    degrees_in_table,
    offset_missing,
    product,
    revolute_everywhere,
    rows_shifted,
    sign_of,
    transposed_rotation,
)
from autograder.judge.question import Step
from dhm.transforms import classic_dh

from .pool import arm_of, arms
from .tables import list_rows

ARM = ("arm",)
"""What answers about an arm in letters depend on."""


def table_of_own_arm(id: str, joints: int) -> Question:
    """The DHm table, of frames whose Z axes the statement shows; for arms of so many joints."""
    rows = range(1, joints + 1)
    return Question(
        id,
        reference=lambda mine: list_rows(arm_of(mine).table),
        mistakes=tuple(
            map(
                _where_it_shows,
                (
                    classic_table(),
                    sign_of("a", *rows),
                    sign_of("alpha", *rows),
                    sign_of("d", *rows),
                    offset_missing(*rows),
                    columns_exchanged("a", "d"),
                    columns_exchanged("a", "alpha"),
                    columns_exchanged("alpha", "theta"),
                    revolute_everywhere(),
                    rows_shifted(),
                    degrees_in_table(),
                ),
            )
        ),
        partial=0.6,
        pinned=SAME_SENSES,
        depends=ARM,
    )


def transform_of_own_arm(id: str, table: str) -> Question:
    """The transform from base to end effector, which follows from the table of an earlier question."""
    return Question(
        id,
        reference=lambda mine, factors="right": transform(mine.arm, factors),
        mistakes=(
            mistake(
                "reversed_product",
                0.3,
                "**The matrices are multiplied in the reverse order.** From left to right: base first, end effector last.",
                wrong={"factors": "reversed"},
            ),
            mistake(
                "classic_matrices",
                0.3,
                "**These are the matrices of classic Denavit-Hartenberg.** The modified form begins with the step along and about "
                "X, and ends with the step along and about Z.",
                wrong={"factors": "classic"},
            ),
            mistake(
                "one_step_short",
                0.4,
                "**One step of the chain is missing.** Count the matrices: every frame between the two ends takes one.",
                wrong=[{"factors": "without the first"}, {"factors": "without the last"}],
            ),
            transposed_rotation(),
        ),
        follows=Follow(table, following.product_of_table),
        depends=ARM,
    )


def position_of_own_arm(id: str, transform_id: str) -> Question:
    """Where the end effector is, which follows from the transform of an earlier question."""
    return Question(
        id,
        reference=lambda mine, factors="right": list(transform(mine.arm, factors)[:3, 3]),
        mistakes=(
            mistake(
                "seen_from_frame_1",
                0.3,
                "**The first joint is not in it.** Seen from the base, the end effector moves when joint 1 does.",
                wrong={"factors": "without the first"},
            ),
            mistake(
                "last_row_for_last_column",
                0.3,
                "**These three entries are no position.** The position is the last *column* of the matrix, from frame 0 to O4.",
                wrong={"factors": "inverse"},
            ),
        ),
        partial=0.7,
        follows=Follow(transform_id, following.position),
        depends=ARM,
    )


def _where_it_shows(mistake: Mistake) -> Mistake:
    """The mistake, which nobody can make with an arm where it changes nothing."""

    def taken(step: Step, rows: list[list]) -> list[list]:
        found = step(rows)
        if found == rows:
            raise ValueError(f"{mistake.note} changes nothing in the table of this arm")
        return found

    return replace(mistake, steps=tuple(partial(taken, step) for step in mistake.steps))


@cache
def transform(name: str, factors: str = "right") -> sympy.ImmutableMatrix:
    """The transform from base to end effector of an arm of the pool, or what becomes of it with other factors."""
    table = arms()[name].table
    right = table.transforms()
    found = {
        "right": lambda: product(right),
        "reversed": lambda: product(right[::-1]),
        "without the first": lambda: product(right[1:]),
        "without the last": lambda: product(right[:-1]),
        "classic": lambda: product([classic_dh(*row.parameters) for row in table.rows]),
        "inverse": lambda: product(table.inverse_transforms()[::-1]),
    }
    return sympy.ImmutableMatrix(found[factors]())
