"""DHm tables: right when they describe the same chain, within the freedoms that the question leaves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from dhkit.forms.dh_table import DH_COLUMNS, DHTable

from ..chain import SAME_MODEL, JudgedChain, NotAChain, same_chain
from ..chain.freedoms import Pins
from ..chain.senses import agreeing, best_senses, in_senses
from ..decode import Blank
from .base import Comparison, Setting
from .entries import Entries, agreement, depends_on, listed
from .entries import read_entries as read

__all__ = ["compare", "read"]

WIDTH = len(DH_COLUMNS)
IN_OUR_FRAMES = "in our frames"


def compare(form: DHTable, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Two tables are equal when they describe the same chain without using a freedom that the question pins.

    A mistaken table (not ``setting.patient``) is met cell by cell, as it is written or in the senses in which the student's
    is nearest to the right one: another mistake may well give the same chain.
    """
    cells = _compare_cells(student, other, setting)
    if cells.equal:
        return cells
    if not setting.patient:
        ours = student.kept(IN_OUR_FRAMES, setting.samples)
        return Comparison(
            ours is not None and bool(agreeing(ours, rows_of(other, setting), setting.tolerance).all()), 0.0
        )
    mine, theirs = (_chain(entries, form, setting) for entries in (student, other))
    if mine is None or theirs is None:
        return _differing(student, other, setting)
    match = same_chain(mine, theirs, pinned=setting.pinned)
    if match.equal:
        still = _sigma_without_joint(student, form, setting)
        if still:
            remarks = tuple(f"row {row} holds no joint: its sigma is 0" for row in still)
            return replace(_differing(student, other, setting), remarks=remarks)
        return Comparison(True, 1.0, tuple(f"another {used}" for used in match.freedoms))
    differing = _differing(student, other, setting)
    if match.parting:
        return differing
    moved = any(used.freedom in SAME_MODEL for used in match.pinned)
    remarks = (*match.remarks, *(differing.remarks if moved else ()))
    return Comparison(False, 1.0, remarks, "same_chain_other_frames")


def rows_of(entries: Entries, setting: Setting) -> np.ndarray:
    """The values of a table, (N, n, 5)."""
    return entries.values(setting.samples).reshape(-1, len(entries.expressions) // WIDTH, WIDTH)


def _sigma_without_joint(entries: Entries, form: DHTable, setting: Setting) -> list[int]:
    """Numbers of the rows whose sigma says that they slide although nothing in them moves."""
    rows = [entries.expressions[start : start + WIDTH] for start in range(0, len(entries.expressions), WIDTH)]
    sigma = entries.values(setting.samples)[:, ::WIDTH]
    slides = np.abs(sigma).max(axis=0) > setting.tolerance
    return [
        number
        for number, (row, slid) in enumerate(zip(rows, slides, strict=True), start=1)
        if slid and depends_on(Entries(row), setting.samples).isdisjoint(form.joints)
    ]


def _chain(entries: Entries, form: DHTable, setting: Setting) -> JudgedChain | None:
    def read() -> JudgedChain | None:
        try:
            chain = JudgedChain.of_entries(entries.expressions, form.joints, setting.samples)
        except NotAChain:
            return None
        return chain if chain.joints else None

    return entries.once("chain", setting.samples, read)


def _compare_cells(student: Entries, other: Entries, setting: Setting) -> Comparison:
    is_angle = [name in ("alpha", "theta") for name in DH_COLUMNS] * (len(student.expressions) // WIDTH)
    agree = agreement(student, other, setting, is_angle)
    return Comparison(bool(agree.all()), 0.0)


def _differing(student: Entries, other: Entries, setting: Setting) -> Comparison:
    """What differs in a table of another chain: whichever way its author drew the axes, the fewest cells."""
    theirs, ours = rows_of(student, setting), rows_of(other, setting)
    senses = best_senses(theirs, ours, Pins(setting.pinned), setting.tolerance)
    theirs = student.once(IN_OUR_FRAMES, setting.samples, lambda: in_senses(theirs, senses))
    agree = agreeing(theirs, ours, setting.tolerance)
    blank = np.array([isinstance(entry, Blank) for entry in student.expressions]).reshape(agree.shape)
    right = agree.all(axis=1)
    note = "one_cell" if (~agree).sum() == 1 else ""
    slip = int((~right).sum()) == 1
    return Comparison(False, float(right.mean()), (_places(~agree, blank, setting.columns),), note, slip)


def _places(wrong: np.ndarray, blank: np.ndarray, columns: Sequence[str]) -> str:
    """The cells that differ, row by row; rows that nobody filled in apart."""
    empty = [f"row {i + 1} is not filled in" for i in np.flatnonzero(blank.all(axis=1))]
    rows = [(i + 1, [columns[k] for k in np.flatnonzero(wrong[i]).tolist()])
            for i in np.flatnonzero(wrong.any(axis=1) & ~blank.all(axis=1))]  # fmt: skip
    places = [f"row {row}, column{'s' * (len(names) > 1)} {listed(names)}" for row, names in rows]
    if not empty and wrong.sum() == 1:
        return f"only one cell differs: {places[0]}"
    differ = [f"what differs: {'; '.join(places)}"] if places else []
    return "; ".join([*empty, *differ])
