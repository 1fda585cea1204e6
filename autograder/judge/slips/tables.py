"""Slips in tables of Denavit-Hartenberg parameters: whole columns, single cells, and two slips in one table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations, permutations

import numpy as np

from dhkit.geometry import wrap

from ..tree import Slip
from .base import together

_ANGLES = ("alpha", "theta")


@dataclass(frozen=True)
class Table:
    """Values of a table at the sample points, (N, n, m), under the names of its columns; `constants` are its values with all joints at zero.

    `names` are those of `dhkit.forms.dh_table.DH_COLUMNS`, or the last four; `letters` what the statement calls them.
    """

    values: np.ndarray
    constants: np.ndarray
    names: tuple[str, ...]
    letters: tuple[str, ...]
    tolerance: float

    def agrees(self, other: np.ndarray) -> np.ndarray:
        """Which cells of `other` agree with these, (n, m); angles modulo a turn."""
        return self._agree(other, self.values)

    def _agree(self, student: np.ndarray, right: np.ndarray) -> np.ndarray:
        angles = np.array([name in _ANGLES for name in self.names])
        with np.errstate(all="ignore"):
            gap = student - right
            gap = np.where(angles, wrap(gap.real) + 1j * gap.imag, gap)
            return np.asarray((np.abs(gap) <= self.tolerance * np.maximum(1, np.abs(right))).all(axis=0))

    def column(self, name: str) -> int:
        return self.names.index(name)

    def place(self, row: int, column: int) -> str:
        return f"row {row + 1}, column {self.letters[column]}"


def explain(student: np.ndarray, table: Table) -> Slip | None:
    """One slip, or two, that make the right `table` into the student's values (N, n, m); None if nothing is certain."""
    for slip, wrong in _whole(table):
        if _same(student, wrong, table):
            return slip
    wrong_cells = ~table.agrees(student)
    if (found := _explain_cells(student, table, wrong_cells, most=2)) is not None:
        return found
    for slip, wrong in _whole(table):
        variant = Table(wrong, table.constants, table.names, table.letters, table.tolerance)
        differing = ~variant.agrees(student)
        if differing.sum() <= 4 and differing.sum() < wrong_cells.sum():
            rest = _explain_cells(student, variant, differing, most=1)
            if rest is not None:
                return together(slip, rest)
    return None


def _same(student: np.ndarray, wrong: np.ndarray, table: Table) -> bool:
    return bool(table._agree(student, wrong).all())


# ---------------------------------------------------------------- the whole table


def _whole(table: Table) -> Iterator[tuple[Slip, np.ndarray]]:
    """Slips that change many cells at once, and the values they lead to."""
    values, a, alpha = table.values, table.column("a"), table.column("alpha")
    rows = values.shape[1]
    if "sigma" in table.names:
        for size in (1, 0):  # with the pair of the last row, or without one
            moved = values.copy()
            moved[:, :-1, [a, alpha]] = values[:, 1:, [a, alpha]]
            moved[:, -1, [a, alpha]] = 0 if size else values[:, -1, [a, alpha]]
            yield (
                Slip(
                    "classic_table",
                    0.3,
                    "**This is the classic Denavit-Hartenberg table.** In the modified form row i holds the length and the twist of the link "
                    "*before* joint i.",
                ),
                moved,
            )
        reversed_sigma = values.copy()
        reversed_sigma[..., 0] = 1 - values[..., 0]
        yield (
            Slip(
                "sigma_reversed", 0.6, "**sigma is reversed.** 0 stands for a joint that turns, 1 for one that slides."
            ),
            reversed_sigma,
        )
    columns = [k for k, name in enumerate(table.names) if name != "sigma"]
    for order in permutations(columns):
        if order == tuple(columns):
            continue
        moved = values.copy()
        moved[..., columns] = values[..., list(order)]
        changed = [table.letters[k] for k, source in zip(columns, order) if k != source]
        exchanged = len(changed) == 2
        yield (
            Slip(
                f"{'_and_'.join(sorted(changed))}_exchanged" if exchanged else "columns_in_another_order",
                0.3,
                f"**The columns {changed[0]} and {changed[1]} are exchanged.** Look at the order that the question asks for, and at what each "
                "is counted along or about."
                if exchanged
                else "**The columns stand in another order than asked for.** Look at the heads that the question gives them.",
            ),
            moved,
        )
    yield Slip("degrees", 0.6, _DEGREES), _constants_in_degrees(table)
    if rows > 1:
        for shift in (1, -1):
            yield (
                Slip("rows_shifted", 0.3, "**The rows are shifted by one.** Row i leads from frame i-1 to frame i."),
                np.roll(values, shift, axis=1),
            )
        yield (
            Slip("rows_reversed", 0.3, "**The rows stand in the reverse order.** Row 1 is the one next to the base."),
            values[:, ::-1],
        )


_DEGREES = "**Angles of your table are in degrees.** The question counts in radians: a quarter turn is pi/2."


def _constants_in_degrees(table: Table, *, turn: float = 180 / np.pi) -> np.ndarray:
    wrong = table.values.copy()
    for name in _ANGLES:
        k = table.column(name)
        wrong[..., k] += table.constants[..., k] * (turn - 1)
    return wrong


# ---------------------------------------------------------------- single cells


def _explain_cells(student: np.ndarray, table: Table, differing: np.ndarray, most: int) -> Slip | None:
    """Slips at single places that explain all differing cells, at most so many; the same kind in one column counts once."""
    places = [(row, column) for row, column in np.argwhere(differing).tolist()]
    if not places or len(places) > 3 * most + 2:
        return None
    found: list[tuple[frozenset, Slip]] = list(_local(student, table, places))
    wanted = frozenset(places)
    for cells, slip in found:
        if cells == wanted:
            return slip
    if most > 1:
        for (cells, slip), (others, another) in combinations(found, 2):
            if cells | others == wanted and not cells & others:
                return together(slip, another)
    return None


def _local(
    student: np.ndarray, table: Table, places: Sequence[tuple[int, int]]
) -> Iterator[tuple[frozenset[tuple[int, int]], Slip]]:
    """Slips at the differing places: which cells each explains."""
    theirs = lambda place: student[:, place[0], place[1]]  # noqa: E731
    ours = lambda place: table.values[:, place[0], place[1]]  # noqa: E731
    fixed = lambda place: table.constants[:, place[0], place[1]]  # noqa: E731
    same = partial(_close, tolerance=table.tolerance)
    zero = np.zeros(len(student))
    alike: dict[tuple[str, int], list[tuple[int, int]]] = {}

    for place in places:
        column = place[1]
        name, value, right, constant = table.names[column], theirs(place), ours(place), fixed(place)
        angle = name in _ANGLES
        if name == "sigma":
            alike.setdefault(("sigma_reversed", column), []).append(place)
            continue
        offset, moves = constant, not same(right, constant)
        if same(value, -right, angle=angle and moves) or (not moves and same(value, -right)):
            alike.setdefault(("sign", column), []).append(place)
        elif moves and not same(offset, zero) and same(value, right - 2 * offset):
            alike.setdefault(("sign_of_offset", column), []).append(place)
        elif moves and not same(offset, zero) and same(value, right - offset, angle=True):
            alike.setdefault(("offset_missing", column), []).append(place)
        elif moves and same(value, 2 * offset - right):
            alike.setdefault(("sign_of_joint", column), []).append(place)
        elif angle and not same(offset, zero) and same(value, right + offset * (180 / np.pi - 1)):
            alike.setdefault(("degrees", column), []).append(place)
        elif angle and (same(value, right + np.pi / 2, angle=True) or same(value, right - np.pi / 2, angle=True)):
            alike.setdefault(("quarter_turn", column), []).append(place)
        elif angle and same(value, right + np.pi, angle=True):
            alike.setdefault(("half_turn", column), []).append(place)
        elif not same(right, zero) and same(value, zero):
            alike.setdefault(("left_out", column), []).append(place)
        elif any(same(value, factor * right) for factor in (10, 0.1, 100, 0.01, 1000, 0.001)) and not same(right, zero):
            alike.setdefault(("decimal", column), []).append(place)
        elif any(same(value, factor * right) for factor in (2, 0.5)) and not same(right, zero):
            alike.setdefault(("factor_two", column), []).append(place)
    for (kind, _), cells in alike.items():
        yield frozenset(cells), _LOCAL[kind](table, cells)
        if len(cells) > 1:
            yield from ((frozenset([cell]), _LOCAL[kind](table, [cell])) for cell in cells)
    yield from _moved(student, table, places, same)


def _close(a: np.ndarray, b: np.ndarray, *, tolerance: float, angle: bool = False) -> bool:
    with np.errstate(all="ignore"):
        gap = a - b
        gap = wrap(gap.real) + 1j * gap.imag if angle else gap
        return bool((np.abs(gap) <= tolerance * np.maximum(1, np.abs(b))).all())


def _moved(student: np.ndarray, table: Table, places, same) -> Iterator[tuple[frozenset, Slip]]:
    """A value, or the constant beside a joint, that stands in another cell than its own."""
    theirs = lambda place: student[:, place[0], place[1]]  # noqa: E731
    ours = lambda place: table.values[:, place[0], place[1]]  # noqa: E731
    fixed = lambda place: table.constants[:, place[0], place[1]]  # noqa: E731
    for source, target in permutations(places, 2):
        neighbours = source[1] == target[1] or source[0] == target[0]
        if not neighbours or "sigma" in (table.names[source[1]], table.names[target[1]]):
            continue
        if same(theirs(source), ours(target)) and same(theirs(target), ours(source)):
            yield frozenset((source, target)), _exchanged(table, source, target)
        constant = fixed(source)
        if not same(constant, np.zeros(len(student))):
            without, added = ours(source) - constant, ours(target) + constant
            if same(theirs(source), without) and same(theirs(target), added):
                yield (
                    frozenset((source, target)),
                    _misplaced(table, source, target, offset=not same(without, 0 * without)),
                )


def _in(table: Table, cells: Sequence[tuple[int, int]]) -> str:
    """Where, in words: one cell, or some rows of one column."""
    if len(cells) == 1:
        return table.place(*cells[0])
    rows = [str(row + 1) for row, _ in cells]
    return f"rows {', '.join(rows[:-1])} and {rows[-1]}, column {table.letters[cells[0][1]]}"


def _letter(table: Table, cells) -> str:
    return table.letters[cells[0][1]]


_LOCAL = {
    "sigma_reversed": lambda table, cells: Slip(
        "sigma_reversed", 0.7, f"**sigma is not that of the joint: {_in(table, cells)}.** What does its motor change, an angle or a distance?"
    ),
    "sign": lambda table, cells: Slip(
        f"sign_of_{_letter(table, cells)}", 0.6, f"**A sign is turned: {_in(table, cells)}.** Along which arrow, or about which, is it counted?"
    ),
    "sign_of_offset": lambda table, cells: Slip(
        "sign_of_joint_offset", 0.6, f"**The constant beside the joint variable has the wrong sign: {_in(table, cells)}.** Draw both axes at q = 0."
    ),
    "sign_of_joint": lambda table, cells: Slip(
        "sign_of_joint", 0.6, f"**The joint counts the other way: {_in(table, cells)}.** The variable itself has a minus that it should not have, or lacks one."
    ),
    "offset_missing": lambda table, cells: Slip(
        "joint_offset_missing",
        0.6,
        f"**A joint offset is missing: {_in(table, cells)}.** At q = 0 the frames of your table do not stand as they should: what has to turn before "
        "the joint has moved at all?",
    ),
    "degrees": lambda table, cells: Slip("degrees", 0.6, f"{_DEGREES} Look at {_in(table, cells)}."),
    "quarter_turn": lambda table, cells: Slip(
        "quarter_turn_off", 0.6, f"**An angle is a quarter turn off: {_in(table, cells)}.** Draw the two axes that it is measured between."
    ),
    "half_turn": lambda table, cells: Slip(
        "half_turn_off", 0.6, f"**An angle is half a turn off: {_in(table, cells)}.** One of the two axes that it is measured between points the other way."
    ),
    "left_out": lambda table, cells: Slip(
        "entry_left_out", 0.6, f"**Something is missing: {_in(table, cells)}.** Your entry is zero: is there really no way, or no turn, between the two axes?"
    ),
    "decimal": lambda table, cells: Slip(
        "decimal_slip", 0.8, f"**The decimal point has slipped: {_in(table, cells)}.** Your number is ten, a hundred or a thousand times the right one, or such a part of it."
    ),
    "factor_two": lambda table, cells: Slip(
        "factor_two", 0.6, f"**A factor of two: {_in(table, cells)}.** Your entry is twice the right one, or half of it."
    ),
}  # fmt: skip


def _exchanged(table: Table, source: tuple[int, int], target: tuple[int, int]) -> Slip:
    return Slip(
        "entries_exchanged",
        0.5,
        f"**Two entries stand in each other's place: {table.place(*source)}, and {table.place(*target)}.**",
    )


def _misplaced(table: Table, source: tuple[int, int], target: tuple[int, int], offset: bool) -> Slip:
    if source[1] != target[1]:
        return Slip(
            "entry_in_another_column",
            0.5,
            f"**An entry of row {source[0] + 1} stands in column {table.letters[target[1]]}, and belongs into another one.** a and d are ways, along "
            "X and along Z; alpha and theta are turns, about X and about Z.",
        )
    if offset:
        return Slip(
            "joint_offset_misplaced",
            0.5,
            f"**A joint offset stands in the wrong row: {table.place(*target)}.** Draw X before and behind each joint at q = 0: where do they differ?",
        )
    where = "low" if target[0] > source[0] else "high"
    return Slip(
        "entry_in_another_row",
        0.5,
        f"**An entry stands in a row too {where}: {table.place(*target)}.** In row i, a and alpha belong to the link before joint i, d and theta "
        "to the joint itself.",
    )
