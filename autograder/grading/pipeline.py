"""Grades a class: notebooks run side by side in their sandboxes, nbgrader's gradebook is written by one thread.

Kernels take nearly all of the time and run in processes of their own, so worker threads only drive them. What
they bring back goes through the very converter that ``nbgrader autograde`` uses, one submission after the other.

A submission is therefore read and restored more than once: here, to run it ahead, and again by the converter, which
takes nothing for granted and finds the run by the submission's fingerprint. That is the price of being nbgrader's
guest: the same plug-ins, in the same order, give the same gradebook whether our command or the stock one is typed.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Generator, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import closing, contextmanager
from dataclasses import replace

import nbformat
from nbgrader.preprocessors import AssignLatePenalties

from autograder.sandbox import cancel_runs, sweep

from .cells import check_cells, counts_for_everybody
from .changes import Given, by_hand, given, moved
from .collecting.receipts import read_receipts, receipts_folder
from .course import Course, convert
from .errors import CourseError, in_words
from .folders import released_path
from .gradebook import GradebookError, reading, writing
from .inert import terminal_text
from .plugins.autograde import (
    SubmissionAutograde,
    notebook_names,
    refuse_unless_fit,
    refuse_unless_ready,
    submission,
)
from .plugins.feedback import FeedbackPages
from .plugins.preprocessors import SandboxExecute
from .results import Result, graded_notebooks, read_result
from .store import StoredNotebook, refresh_dates, stored_notebooks
from .submission.execution import Execution
from .submission.reading import fingerprint
from .submission.restore import restore
from .term import deadlines

Progress = Callable[[str], None]


def grade(
    course: Course, exercise: str, students: Sequence[str], jobs: int, force: bool, progress: Progress
) -> list[Result]:
    """Grade the submissions of `students` for `exercise` and write their feedback.

    Parameters
    ----------
    jobs : int
        How many notebooks run at the same time.
    force : bool
        Grade also what was graded before and has not changed.
    progress : callable
        Called with the student's id after each submission.

    Returns
    -------
    list of Result
        In the order of `students`; ``status`` tells graded, unchanged and failed ones apart.
    """
    course.choose(exercise)
    converter = SubmissionAutograde(coursedir=course.app.coursedir, parent=course.app)
    refuse_unless_ready(converter)
    sweep()
    names = notebook_names(converter)
    runner = SandboxExecute(parent=converter)
    before = _stored(course, exercise)
    _bring_up_dates(course, exercise, converter)
    stored = _stored(course, exercise)
    status: dict[str, str] = {}
    failures: dict[str, str] = {}
    for student in students:
        status[student] = "unchanged"
        with _noting(failures, student):
            if force or not _is_done(course, stored.get(student, {}), student, exercise, names):
                status[student] = "graded"
            elif not _has_pages(course, stored[student], student, exercise):
                _write_pages(course, student, force=False)
        if status[student] == "unchanged":
            progress(student)
    earlier = {
        student: given(graded_notebooks(course, student, exercise))
        for student, what in status.items()
        if what == "graded" and student in stored
    }
    if "graded" in status.values():
        refuse_unless_fit(converter)

    def run(student: str) -> dict[tuple[str, str], Execution]:
        return {(student, name): _run(course, runner.run, student, exercise, name) for name in names}

    def run_alone(student: str) -> dict[tuple[str, str], Execution]:
        return {(student, name): _run(course, runner.run_alone, student, exercise, name) for name in names}

    with closing(_run_ahead(run, run_alone, [name for name in students if status[name] == "graded"], jobs)) as runs:
        for student, future in runs:
            with _noting(failures, student):
                _store(course, student, future.result())
            progress(student)
    stored = _stored(course, exercise)
    unusable = [
        Result(terminal_text(name), exercise, "failed", remarks=(reason,))
        for name, reason in course.unusable_folders(exercise).items()
    ]
    for_everybody = {check for name in names for check in _for_everybody(course, exercise, name)}
    said = _said_elsewhere(course, exercise)
    results = [
        Result(student, exercise, "failed", remarks=(failures[student],))
        if student in failures
        else _compared(
            read_result(course, stored.get(student, {}), student, exercise, status[student]),
            before.get(student, {}),
            stored.get(student, {}),
            earlier.get(student, {}),
            for_everybody,
        )
        for student in students
    ]
    return unusable + [replace(result, remarks=(*said.get(result.student, ()), *result.remarks)) for result in results]


def _said_elsewhere(course: Course, exercise: str) -> dict[str, tuple[str, ...]]:
    """What the roster and the platform say of students, beside the notebooks."""
    dates = deadlines(course.root, exercise)
    found: dict[str, tuple[str, ...]] = {
        person.id: (
            *(["exempt"] if exercise in person.exempt else []),
            *([f"had until {until}"] if (until := dates.had_until(person.id)) else []),
        )
        for person in dates.roster.people
    }
    for student, receipt in read_receipts(receipts_folder(course.root, exercise)).items():
        if receipt.late and receipt.handed_in is None:
            found[student] = (*found.get(student, ()), "marked late by the platform, which tells no time")
    return found


def _compared(
    result: Result,
    before: Mapping[str, StoredNotebook],
    after: Mapping[str, StoredNotebook],
    earlier: Mapping[str, Given],
    for_everybody: Container[str],
) -> Result:
    """A result with what moved since the time before."""
    kept = by_hand(before, after, earlier) if result.status == "graded" else ()
    return replace(result, moved=moved(before, after, earlier, for_everybody), by_hand=kept)


def _for_everybody(course: Course, exercise: str, name: str) -> set[str]:
    nb = nbformat.read(released_path(course.app.coursedir, exercise, name), as_version=4)
    return {check for check, cell in check_cells(nb).items() if counts_for_everybody(cell)}


def _bring_up_dates(course: Course, exercise: str, converter: SubmissionAutograde) -> None:
    """Due dates, more time and penalties as the course says now, also for what is not graded again."""
    dates = deadlines(course.root, exercise)
    for name in dates.term.due:
        course.require(name)
    if dates.due is None:
        return
    with writing(course.db_url) as session:
        refresh_dates(session, dates, AssignLatePenalties(parent=converter))


@contextmanager
def _noting(failures: dict[str, str], student: str) -> Iterator[None]:
    """Note what goes wrong with one student, so that the class can go on.

    A gradebook that cannot be used concerns everybody: that ends the run.
    """
    try:
        yield
    except GradebookError:
        raise
    except CourseError as error:
        failures[student] = str(error)
    except Exception as error:
        failures[student] = f"could not be run: {in_words(error)}"


def _stored(course: Course, exercise: str) -> dict[str, dict[str, StoredNotebook]]:
    """What the gradebook holds of an exercise, by student and name of the notebook."""
    found: dict[str, dict[str, StoredNotebook]] = {}
    with reading(course.db_url) as session:
        for (student, name), one in stored_notebooks(session, exercise).items():
            found.setdefault(student, {})[name] = one
    return found


def _is_done(
    course: Course, stored: Mapping[str, StoredNotebook], student: str, exercise: str, names: Sequence[str]
) -> bool:
    """True if everything that was handed in is stored as a whole."""
    submitted, graded = course.step("submitted", student, exercise), course.step("autograded", student, exercise)
    if set(names) != stored.keys():
        return False
    return all(
        stored[name].is_graded(
            fingerprint(submitted, released_path(course.app.coursedir, exercise, name).read_bytes()),
            graded / f"{name}.ipynb",
        )
        for name in names
    )


def _has_pages(course: Course, stored: Mapping[str, StoredNotebook], student: str, exercise: str) -> bool:
    """True if every feedback page is there and shows what the gradebook holds."""
    pages = course.step("feedback", student, exercise)
    return all(notebook.has_page(pages / f"{name}.html") for name, notebook in stored.items())


def _run(course: Course, run: Callable[..., Execution], student: str, exercise: str, name: str) -> Execution:
    released = released_path(course.app.coursedir, exercise, name)
    folder = course.step("submitted", student, exercise)
    nb = restore(submission(folder / f"{name}.ipynb", released), nbformat.read(released, as_version=4))
    return run(nb, folder, released, student, course.root)


def _store(course: Course, student: str, executions: dict[tuple[str, str], Execution]) -> None:
    """Judge what came out of the sandbox, store it as a whole and write the feedback page."""
    converter = SubmissionAutograde(
        coursedir=course.app.coursedir, parent=course.app, students=(student,), force=True, executions=executions
    )
    try:
        convert(converter)
    except GradebookError:
        raise
    except CourseError as reason:
        raise CourseError(f"could not be judged: {converter.failures.get(student, reason)}") from None
    _write_pages(course, student, force=True)


def _write_pages(course: Course, student: str, force: bool) -> None:
    """Write the feedback pages of a student, unless they are there already and show what the gradebook holds."""
    converter = FeedbackPages(coursedir=course.app.coursedir, parent=course.app, students=(student,), force=force)
    try:
        convert(converter)
    except GradebookError:
        raise
    except CourseError as reason:
        said = converter.failures.get(student, reason)
        raise CourseError(f"the points are in the gradebook, but there is no feedback page: {said}") from None


def _in_doubt(run: Future) -> bool:
    """Whether the machine, or a neighbour's notebook, may be to blame for what came of a run."""
    return run.exception() is not None or any(execution.doubt for execution in run.result().values())


def _run_ahead(
    run: Callable[[str], dict], run_alone: Callable[[str], dict], students: list[str], jobs: int
) -> Generator[tuple[str, Future]]:
    """Yield each student with the finished run, in the order in which runs end; few results wait at any time.

    Whose run ended in doubt comes last and runs once more, alone.
    """
    waiting = iter(students)
    again: list[str] = []
    running: dict[Future, str] = {}
    with ThreadPoolExecutor(jobs) as pool:
        try:
            while True:
                while len(running) < 2 * jobs and (student := next(waiting, None)) is not None:
                    running[pool.submit(run, student)] = student
                if not running:
                    break
                done, _ = wait(running, return_when=FIRST_COMPLETED)
                for future in done:
                    student = running.pop(future)
                    if _in_doubt(future):
                        again.append(student)
                    else:
                        yield student, future
            for student in again:
                future = pool.submit(run_alone, student)
                wait([future])
                yield student, future
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            cancel_runs()
            raise
