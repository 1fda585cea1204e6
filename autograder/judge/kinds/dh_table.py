"""DHm tables: right when they describe the same chain, within the freedoms that the question leaves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from dhkit.forms.dh_table import DH_COLUMNS, DHTable

from ..chain import SAME_MODEL, JudgedChain, NotAChain, same_chain
from .base import Comparison, Setting
from .entries import Entries, agreement, depends_on
from .entries import read_entries as read

__all__ = ["compare", "read"]

WIDTH = len(DH_COLUMNS)


def compare(form: DHTable, student: Entries, other: Entries, setting: Setting) -> Comparison:
    """Two tables are equal when they describe the same chain without using a freedom that the question pins."""
    cells = _compare_cells(student, other, setting)
    if cells.equal:
        return cells
    mine, theirs = (_chain(entries, form, setting) for entries in (student, other))
    if mine is None or theirs is None or (not setting.patient and _ends_apart(mine, theirs, setting)):
        return cells
    match = same_chain(mine, theirs, pinned=setting.pinned)
    if match.equal:
        still = _sigma_without_joint(student, form, setting) if setting.patient else []
        if still:
            return replace(cells, remarks=tuple(f"row {row} holds no joint: its sigma is 0" for row in still))
        return Comparison(True, 1.0, tuple(f"another {used}" for used in match.freedoms))
    if match.parting:
        where = f"joint {match.parting.joint}: {match.parting.quantity} differs"
        remarks = cells.remarks if cells.note else (where,)
        return replace(cells, remarks=remarks)
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
    agree = agreement(student, other, setting, is_angle).reshape(-1, WIDTH)
    remarks = tuple(
        f"row {i + 1}: {', '.join(name for name, same in zip(DH_COLUMNS, row, strict=True) if not same)}"
        for i, row in enumerate(agree)
        if not row.all()
    )
    if (~agree).sum() == 1:
        remarks = (f"only one cell differs, {remarks[0].replace(':', ', column')}",)
    right = agree.all(axis=1)
    note = "one_cell" if (~agree).sum() == 1 else ""
    return Comparison(bool(right.all()), float(right.mean()), remarks, note, slip=int((~right).sum()) == 1)
