"""Whose points moved when a submission was graded again, and what a lecturer typed by hand: nothing moves unseen."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping
from dataclasses import dataclass

from nbformat.notebooknode import NotebookNode

from .cells import answer_id, check_record, counts_for_everybody, question_id, tracked_cells
from .entries import note_of, score
from .store import StoredNotebook


@dataclass(frozen=True)
class Given:
    """What a cell was worth when a notebook was graded, and what the judge gave for it; the gradebook only knows of now."""

    points: float
    score: float = 0.0
    note: str = ""


def given(notebooks: Iterable[NotebookNode]) -> dict[str, Given]:
    """What was given in graded notebooks, by the ids of the cells that earn points."""
    found = {}
    for nb in notebooks:
        for name, cell in tracked_cells(nb).items():
            if "points" in cell.metadata.nbgrader:
                points, record = float(cell.metadata.nbgrader["points"]), check_record(cell)
                share = 1.0 if record and counts_for_everybody(cell) else record.share if record else 0.0
                found[name] = Given(points, score(share, points), record.note if record else "")
    return found


def moved(
    before: Mapping[str, StoredNotebook],
    after: Mapping[str, StoredNotebook],
    earlier: Mapping[str, Given],
    for_everybody: Container[str],
) -> tuple[str, ...]:
    """What moved in a submission that had been graded before, question by question, with the reason.

    Parameters
    ----------
    before, after : mapping of str to StoredNotebook
        What the gradebook held and holds.
    earlier : mapping of str to Given
        What was given the time before; empty where nothing was graded again.
    for_everybody : container of str
        Cells whose points all who hand in get now.
    """
    if not any(was.mark for was in before.values()):
        return ()
    now = {check: grade for one in after.values() for check, grade in one.grades.items()}
    lines = [
        f"{_short(check)}: {earlier[check].score:g} -> no longer asked"
        for check in sorted(earlier.keys() - now.keys())
        if earlier[check].note
    ]
    for name, one in after.items():
        was = before.get(name)
        if was is None or was.mark is None:
            continue
        for check, grade in sorted(one.grades.items()):
            note = _note(one, check)
            old = was.grades.get(check)
            if earlier and check not in earlier:
                lines.append(
                    f"{_short(check)}: new, {grade.auto or 0:g} of {grade.max_score:g}" + (f" ({note})" if note else "")
                )
            # Points that were typed by hand stay; `by_hand` says what the judge thinks of them.
            elif old is not None and grade.manual is None and (old.auto or 0) != (grade.auto or 0):
                worth = earlier[check].points if check in earlier else grade.max_score
                why = [f"{worth:g} -> {grade.max_score:g} points"] if worth != grade.max_score else []
                if check in for_everybody:
                    why.append("full points for everybody")
                elif note != (said := _note(was, check)):
                    why.append(f"{said} -> {note}")
                lines.append(
                    f"{_short(check)}: {old.auto or 0:g} -> {grade.auto or 0:g} "
                    f"({'; '.join(why) or f'{note}, which counts otherwise now'})"
                )
        if round(was.penalty, 2) != round(one.penalty, 2):
            lines.append(f"points off for being late: {was.penalty:g} -> {one.penalty:g}")
    return tuple(lines)


def _note(stored: StoredNotebook, check: str) -> str | None:
    found = stored.comments.get(answer_id(check))
    return note_of(found.auto) if found else None


def by_hand(
    before: Mapping[str, StoredNotebook], after: Mapping[str, StoredNotebook], earlier: Mapping[str, Given]
) -> tuple[str, ...]:
    """What was typed by hand and was kept, with a warning where it may not fit any more."""
    lines = []
    for name, now in after.items():
        was = before.get(name)
        for check, grade in sorted(now.grades.items()):
            comment = next(
                (one.manual for key in (answer_id(check), check) if (one := now.comments.get(key)) and one.manual), None
            )
            if grade.manual is None and not grade.extra and not comment:
                continue
            old = was.grades.get(check) if was else None
            said = [f"{grade.manual:g} of {grade.max_score:g}"] if grade.manual is not None else []
            said += [f"{grade.extra:g} extra"] if grade.extra else []
            said += ["a comment"] if comment else []
            warnings = []
            if check in earlier and (worth := earlier[check].points) != grade.max_score:
                warnings.append(f"LOOK AGAIN: it was {worth:g} points, now {grade.max_score:g}")
            if grade.manual is not None and old is not None and (old.auto or 0) != (grade.auto or 0):
                warnings.append(f"LOOK AGAIN: the judge gave {old.auto or 0:g}, now {grade.auto or 0:g}")
            lines.append("; ".join([f"{_short(check)}: {', '.join(said)}", *warnings]))
    return tuple(lines)


def _short(check: str) -> str:
    return question_id(check).partition(".")[2]
