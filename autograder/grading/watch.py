"""``autograder watch``: whose work arrives in ``submitted/``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from threading import Event

import watchfiles

from .course import Course

# Milliseconds without a change after which something has arrived, and after which it is looked at in any case.
QUIET, AT_LAST = 1_000, 10_000
# So many quiet moments later what could not be graded is tried again.
PATIENCE = 60
# Milliseconds between two looks at a folder of which the system does not tell.
LOOK = 3_000


def arrivals(
    course: Course, exercises: Sequence[str], stop: Event | None = None, poll: bool = False
) -> Iterator[dict[str, list[str]]]:
    """First whose work is there, by exercise; then whose has changed, each time when something has arrived and it is quiet again.

    What arrives while the one who asks is busy comes with the next answer. Where nothing arrives for a while, an empty
    answer comes: time to try again what failed. It goes on for ever.

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
    begun, quiet = False, 0
    for changes in watchfiles.watch(
        submitted,
        watch_filter=_counts,
        debounce=AT_LAST,
        step=QUIET,
        stop_event=stop,
        force_polling=poll or None,
        poll_delay_ms=LOOK,
        rust_timeout=QUIET,
        yield_on_timeout=True,
    ):
        if not begun:  # the system is listening now, so nobody falls between what is there and what arrives
            begun = True
            yield _handed_in(course, {exercise: set(course.students(exercise)) for exercise in known})
            continue
        quiet = 0 if changes else quiet + 1
        if quiet == PATIENCE:
            quiet = 0
            yield {}
        found: dict[str, set[str]] = {exercise: set() for exercise in known}
        for _, path in changes:
            student, exercise, *_ = (*Path(path).relative_to(submitted.resolve()).parts, "", "")
            # What is put into a new folder at once is not told: then the folder is all that one hears of.
            for name in [exercise] if exercise else known:
                if name in found:
                    found[name].add(student)
        if there := _handed_in(course, found):
            yield there


def _handed_in(course: Course, found: Mapping[str, set[str]]) -> dict[str, list[str]]:
    """Those of whom there is a file, by exercise."""
    there = {
        exercise: [
            student
            for student in sorted(students & set(course.students(exercise)))
            if any(course.step("submitted", student, exercise).glob("[!.]*"))
        ]
        for exercise, students in found.items()
    }
    return {exercise: students for exercise, students in there.items() if students}


def _counts(change: watchfiles.Change, path: str) -> bool:
    """Whether a change is one of the files that are handed in: not of what is written under a temporary name."""
    return not Path(path).name.startswith(".")
