"""Grades a class: a crew runs, judges and lays out submissions side by side, one thread writes nbgrader's gradebook.

What a crew does goes through the very plug-ins that ``nbgrader autograde`` uses, in the same order: the stock command
gives the same gradebook.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from contextlib import contextmanager
from dataclasses import replace

from nbgrader import utils
from nbgrader.preprocessors import AssignLatePenalties

from autograder.sandbox import sweep

from .cells import check_cells, counts_for_everybody
from .changes import Given, by_hand, given, moved
from .collecting.receipts import read_receipts, receipts_folder
from .course import Course, convert
from .crew import Crew
from .errors import CourseError, in_words
from .folders import released_notebook, released_path
from .gradebook import GradebookError, reading, writing
from .inert import terminal_text
from .plugins.autograde import Judged, SubmissionAutograde, Turn, notebook_names, refuse_unless_ready
from .plugins.feedback import FeedbackPages, Shown
from .results import Result, graded_notebooks, read_result
from .store import StoredNotebook, refresh_dates, stored_notebooks
from .submission.execution import InDoubt
from .submission.kept import kept_path
from .submission.reading import fingerprint
from .term import deadlines

Progress = Callable[[str], None]


def grade(
    course: Course, exercise: str, students: Sequence[str], crew: Crew, force: bool, progress: Progress
) -> list[Result]:
    """Grade the submissions of `students` for `exercise` and write their feedback.

    Parameters
    ----------
    crew : Crew
        Whoever runs and judges.
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
    to_grade = [student for student, what in status.items() if what == "graded"]
    earlier = {
        student: given(graded_notebooks(course, student, exercise, outputs=False))
        for student in to_grade
        if student in stored
    }
    if to_grade:
        _grade(course, exercise, names, to_grade, crew, failures, progress)
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


def _grade(
    course: Course,
    exercise: str,
    names: Sequence[str],
    students: Sequence[str],
    crew: Crew,
    failures: dict[str, str],
    progress: Progress,
) -> None:
    """Grade submissions and write their pages: the crew does all of it but what changes the gradebook."""
    converter = SubmissionAutograde(coursedir=course.app.coursedir, parent=course.app)
    feedback = FeedbackPages(coursedir=course.app.coursedir, parent=course.app)
    pages: dict[Future[dict[str, bytes]], tuple[str, Shown]] = {}

    def put(done: Iterable[Future]) -> None:
        for future in done:
            student, shown = pages.pop(future)
            with _noting(failures, student):
                try:
                    killed = isinstance(future.exception(), BrokenExecutor)
                    if killed or not feedback.enter(student, shown, future.result()):
                        feedback.convert_student(student)
                    feedback.run_post_convert_hook()
                except GradebookError:
                    raise
                except Exception as reason:
                    said = f"the points are in the gradebook, but there is no feedback page: {in_words(reason)}"
                    raise CourseError(said) from None
            progress(student)

    def submit(student: str, turn: Turn) -> Future[Judged]:
        return crew.judged(exercise, student, names, turn)

    crew.expect(len(students))
    trial = crew.trial(exercise) if _must_run(course, exercise, names, students) else None
    with utils.setenv(NBGRADER_EXECUTION="autograde"):
        for student, future in _judged(submit, students, crew.jobs):
            if trial is not None:
                if isinstance(trial.exception(), BrokenExecutor):
                    trial = crew.trial(exercise)
                trial.result()
            with _noting(failures, student):
                converter.enter(student, future.result())
                converter.run_post_convert_hook()
                shown = feedback.to_show(student)
                pages[crew.pages(exercise, student, shown)] = (student, shown)
            if student in failures:
                progress(student)
            put([future for future in pages if future.done()])
        put(list(pages))


def _must_run(course: Course, exercise: str, names: Sequence[str], students: Sequence[str]) -> bool:
    """Whether a notebook has to run, for all that can be seen without opening one."""
    return any(not kept_path(course.root, exercise, student, name).exists() for student in students for name in names)


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
    nb = released_notebook(released_path(course.app.coursedir, exercise, name))
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
    except BrokenExecutor:
        failures[student] = (
            "the process that worked on it was killed, twice; is there memory enough for so many --jobs?"
        )
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


def _in_doubt(judged: Future) -> bool:
    """Whether a submission has to be done once more, alone: the machine, or a neighbour's notebook, may be to blame."""
    return isinstance(judged.exception(), InDoubt | BrokenExecutor)


def _judged(
    submit: Callable[[str, Turn], Future[Judged]], students: Iterable[str], jobs: int
) -> Iterator[tuple[str, Future[Judged]]]:
    """Yield each student with what came of the submission, in the order in which that is done.

    Few results wait at any time. Whose first run ended in doubt comes last and runs once more, alone.
    """
    waiting = iter(students)
    again: list[str] = []
    running: dict[Future, str] = {}
    try:
        while True:
            while len(running) < 2 * jobs and (student := next(waiting, None)) is not None:
                running[submit(student, "first")] = student
            if not running:
                break
            done, _ = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                student = running.pop(future)
                if _in_doubt(future):
                    again.append(student)
                else:
                    yield student, future
    finally:
        for future in running:
            future.cancel()
    for student in again:
        future = submit(student, "alone")
        wait([future])
        yield student, future
