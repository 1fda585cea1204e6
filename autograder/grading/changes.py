"""Whose points moved when a submission was graded again, and what a lecturer typed by hand: nothing moves unseen."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from nbformat.notebooknode import NotebookNode

from .cells import answer_id, question_id, tracked_cells
from .entries import note_of
from .store import StoredNotebook


def points_given(notebooks: Iterable[NotebookNode]) -> dict[str, float]:
    """The most points of each cell at the time when notebooks were graded; the gradebook only knows those of now."""
    return {
        name: float(cell.metadata.nbgrader["points"])
        for nb in notebooks
        for name, cell in tracked_cells(nb).items()
        if "points" in cell.metadata.nbgrader
    }


def moved(
    before: Mapping[str, StoredNotebook], after: Mapping[str, StoredNotebook], points: Mapping[str, float]
) -> tuple[str, ...]:
    """What moved in a submission that had been graded before, question by question, with the reason."""
    lines = []
    for name, now in after.items():
        was = before.get(name)
        if was is None or was.mark is None:
            continue
        for check in sorted({*was.grades, *now.grades}):
            old, new = was.grades.get(check), now.grades.get(check)
            # Points that were typed by hand stay; `by_hand` says what the judge thinks of them.
            if old is None or new is None or new.manual is not None or (old.auto or 0) == (new.auto or 0):
                continue
            said = [
                note_of(one.comments[answer_id(check)].auto) if answer_id(check) in one.comments else None
                for one in (was, now)
            ]
            why = f"{said[0]} -> {said[1]}" if said[0] != said[1] else f"{said[1]}, which counts otherwise now"
            if (worth := points.get(check)) is not None and worth != new.max_score:
                why = f"{worth:g} -> {new.max_score:g} points" + (f"; {why}" if said[0] != said[1] else "")
            lines.append(f"{_short(check)}: {old.auto or 0:g} -> {new.auto or 0:g} ({why})")
        if round(was.penalty, 2) != round(now.penalty, 2):
            lines.append(f"points off for being late: {was.penalty:g} -> {now.penalty:g}")
    return tuple(lines)


def by_hand(
    before: Mapping[str, StoredNotebook], after: Mapping[str, StoredNotebook], points: Mapping[str, float]
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
            if (worth := points.get(check)) is not None and worth != grade.max_score:
                warnings.append(f"LOOK AGAIN: it was {worth:g} points, now {grade.max_score:g}")
            if grade.manual is not None and old is not None and (old.auto or 0) != (grade.auto or 0):
                warnings.append(f"LOOK AGAIN: the judge gave {old.auto or 0:g}, now {grade.auto or 0:g}")
            lines.append("; ".join([f"{_short(check)}: {', '.join(said)}", *warnings]))
    return tuple(lines)


def _short(check: str) -> str:
    return question_id(check).partition(".")[2]
