"""Grades a class: notebooks run side by side in their sandboxes, nbgrader's gradebook is written by one thread.

Kernels take nearly all of the time and run in processes of their own, so worker threads only drive them. What
they bring back goes through the very converter that ``nbgrader autograde`` uses, one submission after the other.

A submission is therefore read and restored more than once: here, to run it ahead, and again by the converter, which
takes nothing for granted and finds the run by the submission's fingerprint. That is the price of being nbgrader's
guest: the same plug-ins, in the same order, give the same gradebook whether our command or the stock one is typed.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import closing

import nbformat
from nbgrader.api import Gradebook

from autograder.sandbox import cancel_runs

from .cells import notebook_record
from .course import Course, CourseError, convert
from .inert import terminal_text
from .plugins.converters import (
    FeedbackPages,
    NotReady,
    SubmissionAutograde,
    notebook_names,
    refuse_unless_fit,
    refuse_unless_ready,
    released_path,
    submission,
)
from .plugins.preprocessors import SandboxExecute
from .results import Result, graded_notebooks, read_result
from .submission.execution import Execution, MachineFault
from .submission.reading import fingerprint
from .submission.restore import restore

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
    try:
        refuse_unless_ready(converter)
        names = notebook_names(converter)
        status = {}
        for student in students:
            status[student] = "graded" if force or _is_new(course, student, exercise, names) else "unchanged"
        if "graded" in status.values():
            refuse_unless_fit(converter)
    except NotReady as reason:
        raise CourseError(str(reason)) from None
    runner = SandboxExecute(parent=converter)
    for student in students:
        if status[student] == "unchanged":
            progress(student)

    def run(student: str) -> dict[tuple[str, str], Execution]:
        return {(student, name): _run(course, runner.run, student, exercise, name) for name in names}

    def run_alone(student: str) -> dict[tuple[str, str], Execution]:
        return {(student, name): _run(course, runner.run_alone, student, exercise, name) for name in names}

    failures: dict[str, str] = {}
    with closing(_run_ahead(run, run_alone, [name for name in students if status[name] == "graded"], jobs)) as runs:
        for student, future in runs:
            try:
                _store(course, student, future.result())
            except Exception as error:
                known = isinstance(error, CourseError | MachineFault)
                failures[student] = str(error) if known else f"could not be run: {error!r}"
            progress(student)
    unusable = [_unusable(name, exercise) for name in course.unusable_folders(exercise)]
    with Gradebook(course.app.coursedir.db_url, course.app.coursedir.course_id) as gradebook:
        return unusable + [
            Result(student, exercise, "failed", remarks=(failures[student],))
            if student in failures
            else read_result(course, gradebook, student, exercise, status[student])
            for student in students
        ]


def _unusable(folder: str, exercise: str) -> Result:
    return Result(
        terminal_text(folder), exercise, "failed", remarks=("the folder's name holds control characters; rename it",)
    )


def _is_new(course: Course, student: str, exercise: str, names: list[str]) -> bool:
    notebooks = graded_notebooks(course, student, exercise)
    if len(notebooks) != len(names):
        return True
    folder = course.step("submitted", student, exercise)
    now = {fingerprint(folder, released_path(course.app.coursedir, exercise, name).read_bytes()) for name in names}
    return now != {notebook_record(nb).submission for nb in notebooks}


def _run(course: Course, run: Callable[..., Execution], student: str, exercise: str, name: str) -> Execution:
    released = released_path(course.app.coursedir, exercise, name)
    folder = course.step("submitted", student, exercise)
    nb = restore(submission(folder / f"{name}.ipynb", released), nbformat.read(released, as_version=4))
    return run(nb, folder, released, student, course.root)


def _store(course: Course, student: str, executions: dict[tuple[str, str], Execution]) -> None:
    """Judge what came out of the sandbox, store it in the gradebook and write the feedback page."""
    whose = {"coursedir": course.app.coursedir, "parent": course.app, "students": (student,), "force": True}
    try:
        convert(SubmissionAutograde(executions=executions, **whose))
    except CourseError as reason:
        raise CourseError(f"could not be judged: {reason}") from None
    try:
        convert(FeedbackPages(**whose))
    except CourseError as reason:
        raise CourseError(f"the points are in the gradebook, but there is no feedback page: {reason}") from None


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
