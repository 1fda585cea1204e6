"""Gives a submission back the cells that are not the student's to change.

The released notebook says which cells are tracked by nbgrader, in which order, with which points. A student's
cells keep their order and their sources; every tracked cell is present exactly once in the result, check cells
carry the released source and stand after their answer, and nothing of the student's metadata survives.
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace

from nbformat.notebooknode import NotebookNode
from nbformat.v4 import new_notebook

from ..cells import (
    answer_id,
    check_of_answer,
    grade_id,
    is_check,
    keeps_source,
    notebook_record,
    tracked_cells,
    write_record,
)

MISSING = "This cell was missing from the notebook that was handed in."
MAX_REPAIRS = 6


def restore(submitted: NotebookNode, released: NotebookNode) -> NotebookNode:
    """The notebook to run and to grade.

    Parameters
    ----------
    submitted : NotebookNode
        As `read_submission` returns it.
    released : NotebookNode
        The notebook that was given to the class.

    Returns
    -------
    NotebookNode
        With the released metadata; the ``repairs`` of its record list in words what had to be mended.
    """
    tracked = tracked_cells(released)
    chosen, repairs = _choose(submitted, tracked)
    cells: list[NotebookNode] = []
    for index, cell in enumerate(submitted.cells):
        name = grade_id(cell) or ""
        if name in tracked and chosen.get(name) == index:
            cells.append(_rebuilt(tracked[name], cell))
        elif name not in tracked or keeps_source(tracked[name]) or cell.source != tracked[name].source:
            cells.append(_untracked(cell))
    _put_back(cells, tracked, chosen)
    for number, cell in enumerate(cell for cell in cells if grade_id(cell) is None):
        cell["id"] = f"extra-{number}"
    record = notebook_record(submitted)
    repairs += _kernel_repair(record.kernel, released)
    if len(repairs) > MAX_REPAIRS:
        repairs[MAX_REPAIRS - 1 :] = [f"and {len(repairs) - MAX_REPAIRS + 1} more of this kind"]
    nb = new_notebook(cells=cells, metadata=deepcopy(released.metadata))
    write_record(nb, replace(record, repairs=(*record.repairs, *repairs)))
    return nb


def _choose(submitted: NotebookNode, tracked: dict[str, NotebookNode]) -> tuple[dict[str, int], list[str]]:
    """Which of the student's cells stands for which tracked one, and what is wrong with the others.

    Of several cells with the same id the last counts, as in nbgrader; a check cell only counts where it stands
    after an answer, and the answer is then the last one before it.
    """
    claims: dict[str, list[int]] = {}
    for index, cell in enumerate(submitted.cells):
        if (name := grade_id(cell)) is not None and name in tracked:
            claims.setdefault(name, []).append(index)
    pairs = {name: answer_id(name) for name in tracked if answer_id(name) in tracked}
    gone = {name for name, answer in pairs.items() if name not in claims and answer not in claims}
    chosen: dict[str, int] = {}
    lost = len(gone) == len(pairs) > 1
    repairs = ["no question was found by the ids of its cells; an editor had dropped them"] if lost else []
    for name, cell in tracked.items():
        places = claims.get(name, [])
        if is_check(cell) and (answers := claims.get(answer_id(name), [])):
            places = [place for place in places if place > answers[0]]
            if places:
                chosen[answer_id(name)] = max(place for place in answers if place < places[-1])
        if places:
            chosen[name] = places[-1]
        if lost:
            continue
        if name in gone:
            repairs.append(f"the cells of {_short(name)} were missing (deleted, or asked only later)")
        elif check_of_answer(name) not in gone:
            repairs += _repairs(name, cell, claims.get(name, []), chosen.get(name), submitted)
    return chosen, repairs


def _repairs(name: str, cell: NotebookNode, places: list[int], place: int | None, submitted: NotebookNode) -> list[str]:
    which = _in_words(name, cell)
    if not places:
        return [f"{which} was missing"]
    found = []
    if len(places) > 1:
        found.append(f"{which} was there {len(places)} times")
    if place is None:
        found.append(f"{which} stood before its answer")
    elif not keeps_source(cell) and submitted.cells[place].source != cell.source:
        found.append(f"{which} had been edited")
    return found


def _kernel_repair(kernel: str | None, released: NotebookNode) -> list[str]:
    ours = released.metadata.get("kernelspec", {}).get("name")
    if kernel in (None, ours):
        return []
    return [f"the notebook asked for the kernel {kernel!r}, it was run with {ours}"]


def _in_words(name: str, cell: NotebookNode) -> str:
    short = _short(name)
    if is_check(cell):
        return f"the check cell of {short}"
    if (answered := check_of_answer(short)) is not None:
        return f"the answer cell of {answered}"
    if keeps_source(cell):
        return "the answer to the open problem"
    return f"the locked cell {name}"


def _short(name: str) -> str:
    return name.partition("-")[2] or name


def _rebuilt(original: NotebookNode, submitted: NotebookNode) -> NotebookNode:
    """The tracked cell with what is the student's in it: the text, and the pictures pasted into it."""
    cell = _emptied(original)
    if keeps_source(original):
        cell.source = submitted.source
        if cell.cell_type == "markdown" and "attachments" in submitted:
            cell["attachments"] = submitted.attachments
    return cell


def _emptied(original: NotebookNode) -> NotebookNode:
    cell = deepcopy(original)
    if cell.cell_type == "code":
        cell.outputs, cell.execution_count = [], None
    return cell


def _untracked(cell: NotebookNode) -> NotebookNode:
    cell = _emptied(cell)
    cell["metadata"] = NotebookNode()
    return cell


def _put_back(cells: list[NotebookNode], tracked: dict[str, NotebookNode], chosen: dict[str, int]) -> None:
    """Insert the tracked cells that the submission lacks."""
    previous = ""
    for name, original in tracked.items():
        if name not in chosen:
            where = {found: index for index, cell in enumerate(cells) if (found := grade_id(cell))}
            cell = _emptied(original)
            if is_check(original):
                place = _end_of_region(cells, where.get(answer_id(name), where.get(previous, -1)))
            elif keeps_source(original):
                cell.source = f"# {MISSING}" if cell.cell_type == "code" else MISSING
                check = where.get(check_of_answer(name) or name)
                place = _end_of_region(cells, where.get(previous, -1)) if check is None else check
            else:
                place = where.get(previous, -1) + 1
            cells.insert(place, cell)
        previous = name


def _end_of_region(cells: list[NotebookNode], start: int) -> int:
    """Just behind the last ordinary code cell between tracked cell `start` and the next tracked one.

    A student who deleted an answer cell usually typed the answer into a new cell nearby, which must run first.
    """
    end = start + 1
    for index in range(start + 1, len(cells)):
        if grade_id(cells[index]):
            break
        if cells[index].cell_type == "code":
            end = index + 1
    return end
