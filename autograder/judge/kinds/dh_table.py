"""DHm tables: right when they describe the same chain, within the freedoms that the question leaves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from dhkit.forms.dh_table import DH_COLUMNS, DHTable

from ..chain import SAME_MODEL, JudgedChain, NotAChain, same_chain
from ..chain.freedoms import Pins
from ..chain.senses import agreeing_cells
from ..decode import Blank
from .base import Comparison, Setting
from .entries import Entries, agreement, depends_on, listed
from .entries import read_entries as read

__all__ = ["compare", "read"]

WIDTH = len(DH_COLUMNS)


def compare(form: DHTable, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Two tables are equal when they describe the same chain without using a freedom that the question pins."""
    cells = _compare_cells(student, other, setting)
    if cells.equal:
        return cells
    mine, theirs = (_chain(entries, form, setting) for entries in (student, other))
    if mine is None or theirs is None:
        return _differing(student, other, setting)
    if not setting.patient and _ends_apart(mine, theirs, setting):
        return cells
    match = same_chain(mine, theirs, pinned=setting.pinned)
    if match.equal:
        still = _sigma_without_joint(student, form, setting) if setting.patient else []
        if still:
            remarks = tuple(f"row {row} holds no joint: its sigma is 0" for row in still)
            return replace(_differing(student, other, setting), remarks=remarks)
        return Comparison(True, 1.0, tuple(f"another {used}" for used in match.freedoms))
    if match.parting:
        return _differing(student, other, setting)
    return Comparison(False, 1.0, match.remarks, "same_chain_other_frames")


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


def _ends_apart(mine: JudgedChain, theirs: JudgedChain, setting: Setting) -> bool:
    """A cheap no: where base, tool and joint variables are pinned, the hands must be in the same place at q = 0."""
    if not setting.pinned >= SAME_MODEL:
        return False
    size = max(1.0, float(np.abs(theirs.end).max()))
    return bool(np.abs(mine.end - theirs.end).max() > 10 * setting.tolerance * size)


def _compare_cells(student: Entries, other: Entries, setting: Setting) -> Comparison:
    is_angle = [name in ("alpha", "theta") for name in DH_COLUMNS] * (len(student.expressions) // WIDTH)
    agree = agreement(student, other, setting, is_angle)
    return Comparison(bool(agree.all()), 0.0)


def _differing(student: Entries, other: Entries, setting: Setting) -> Comparison:
    """What differs in a table of another chain: whichever way its author drew the axes, the fewest cells."""
    if not setting.patient:
        return Comparison(False, 0.0)
    theirs, ours = (entries.values(setting.samples).reshape(-1, len(entries.expressions) // WIDTH, WIDTH)
                    for entries in (student, other))  # fmt: skip
    agree = agreeing_cells(theirs, ours, Pins(setting.pinned), setting.tolerance)
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
