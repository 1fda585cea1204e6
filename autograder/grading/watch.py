"""``autograder watch``: whose work arrives in ``submitted/``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from threading import Event

import watchfiles

from .course import Course

# Milliseconds without a change after which something has arrived, and after which it is looked at in any case.
QUIET, AT_LAST = 1_000, 10_000
# Milliseconds between two looks at a folder of which the system does not tell.
LOOK = 3_000


def arrivals(
    course: Course, exercises: Sequence[str], stop: Event | None = None, poll: bool = False
) -> Iterator[dict[str, list[str]]]:
    """Whose work has changed, by exercise, each time when something has arrived and it is quiet again; for ever.

    Parameters
    ----------
    exercises : sequence of str
        Only these; all if empty.
    stop : Event, optional
        Ends it.
    poll : bool
        Whether to look again and again; of a folder of the network the system does not tell what others do there.
    """
    submitted = course.step("submitted")
    submitted.mkdir(parents=True, exist_ok=True)
    known = exercises or course.exercises()
    for changes in watchfiles.watch(
        submitted,
        watch_filter=_counts,
        debounce=AT_LAST,
        step=QUIET,
        stop_event=stop,
        force_polling=poll or None,
        poll_delay_ms=LOOK,
    ):
        found: dict[str, set[str]] = {}
        for _, path in changes:
            student, exercise, *more = Path(path).relative_to(submitted.resolve()).parts + ("", "")
            if exercise in known and more[0]:
                found.setdefault(exercise, set()).add(student)
        there = {exercise: sorted(students & set(course.students(exercise))) for exercise, students in found.items()}
        if there := {exercise: students for exercise, students in there.items() if students}:
            yield there


def _counts(change: watchfiles.Change, path: str) -> bool:
    """Whether a change is one of the files that are handed in: not of what is written under a temporary name."""
    return not Path(path).name.startswith(".")
