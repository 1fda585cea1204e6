"""Who restores, runs, judges and lays out: threads of this process, or processes for a class and many cores.

What is done to one submission is the same everywhere (`Desk`): nothing of it touches the gradebook, which the caller
alone writes. Processes start as copies of one that has imported what they need, have a warm parent of kernels each (some
200 MB), stay for all exercises of a command, and end with it, however it ends: their kernels with them.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import BrokenExecutor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from functools import cache, partial
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from traitlets.config import Config

from autograder.sandbox import cancel_runs

from .course import Course, open_course
from .errors import CourseError, in_words
from .plugins.autograde import Judged, SubmissionAutograde, Turn, refuse_unless_fit
from .plugins.feedback import FeedbackPages, Shown
from .submission.elsewhere import MustRun
from .submission.execution import InDoubt

FEW = 8
"""So many submissions are done before processes would have started."""
ONE_SUFFICES = 3
"""So many notebooks at a time this process can look after by itself: a third of the work on each is its own."""
_END_SECONDS = 10.0


class Desk:
    """What is needed to work on the submissions of one exercise, in one process."""

    def __init__(self, course: Course, exercise: str) -> None:
        self._course, self._exercise = course, exercise
        self._autograde = SubmissionAutograde(coursedir=course.app.coursedir, parent=course.app)
        self._pages = FeedbackPages(coursedir=course.app.coursedir, parent=course.app)
        self._laying_out = threading.Lock()

    def trial(self) -> None:
        """`NotReady` if this machine cannot run what notebooks of this exercise need."""
        self._course.choose(self._exercise)
        refuse_unless_fit(self._autograde)

    def judged(
        self, student: str, names: Sequence[str], turn: Turn, brought: Mapping[str, bytes] | None = None
    ) -> Judged:
        """See `SubmissionAutograde.judged`."""
        self._course.choose(self._exercise)
        try:
            self._autograde.run_pre_convert_hook()
            return self._autograde.judged(student, names, turn, brought)
        except (InDoubt, MustRun, CourseError):
            raise
        except Exception as error:
            raise CourseError(f"could not be judged: {in_words(error)}") from error

    def pages(self, student: str, shown: Shown) -> dict[str, bytes]:
        """See `FeedbackPages.pages`."""
        self._course.choose(self._exercise)
        with self._laying_out:
            self._pages.run_pre_convert_hook()
            return self._pages.pages(student, shown)


class Crew:
    """Works on submissions, several at the same time.

    Parameters
    ----------
    course : Course
    jobs : int
        How many notebooks run at the same time.
    """

    def __init__(self, course: Course, jobs: int) -> None:
        self.jobs = jobs
        self._hands = jobs
        self._course = course
        self._desk = cache(partial(Desk, course))
        self._threads = ThreadPoolExecutor(jobs)
        self._processes: ProcessPoolExecutor | None = None
        self._stop: Connection | None = None

    def __enter__(self) -> Crew:
        return self

    def __exit__(self, *error: object) -> None:
        if error[0] is not None:
            self.cancel()
        for pool in filter(None, (self._threads, self._processes)):
            pool.shutdown(cancel_futures=True)

    def expect(self, count: int) -> None:
        """Get ready for so many submissions."""
        if self._processes is None and count > FEW and self._hands > ONE_SUFFICES:
            self._start()

    def _start(self) -> None:
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload([__name__])
        theirs, self._stop = context.Pipe(duplex=False)
        given = (self._course.root, self._course.settings, theirs)
        self._processes = ProcessPoolExecutor(self._hands, context, _sit_down, given)

    def trial(self, exercise: str) -> Future[None]:
        """See `Desk.trial`."""
        return self._submit(Desk.trial, exercise)

    def judged(self, exercise: str, student: str, names: Sequence[str], turn: Turn) -> Future[Judged]:
        """Restore, run and judge a submission."""
        return self._submit(Desk.judged, exercise, student, names, turn)

    def pages(self, exercise: str, student: str, shown: Shown) -> Future[dict[str, bytes]]:
        """Lay out the feedback pages of a student."""
        return self._submit(Desk.pages, exercise, student, shown)

    def _submit(self, work: Callable, exercise: str, *about: Any) -> Future:
        if self._processes is None:
            return self._threads.submit(work, self._desk(exercise), *about)
        try:
            return self._processes.submit(_at_my_desk, work, exercise, *about)
        except BrokenExecutor:
            # One of them was killed, and with it went all.
            self._start()
            return self._processes.submit(_at_my_desk, work, exercise, *about)

    def cancel(self) -> None:
        """Give up what is being done and what waits."""
        for pool in filter(None, (self._threads, self._processes)):
            pool.shutdown(wait=False, cancel_futures=True)
        if self._stop is not None:
            self._stop.close()
            self._stop = None
        cancel_runs()


_desks: Callable[[str], Desk]  # in a process of a crew
_working = threading.Lock()


def _sit_down(root: Path, settings: Config, stop: Connection) -> None:
    """Begin to work, as a process: until the other end of `stop` is closed, or its holder ends."""
    global _desks
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)  # whoever gives out the work decides when to stop
    os.environ["NBGRADER_EXECUTION"] = "autograde"
    _desks = cache(partial(Desk, open_course(root, settings)))
    threading.Thread(target=_leave_after, args=(stop,), daemon=True).start()


def _at_my_desk(work: Callable, exercise: str, *about: Any) -> Any:
    with _working:
        return work(_desks(exercise), *about)


def _leave_after(stop: Connection) -> None:
    """End the run under way, then the process, once nobody holds the other end of `stop`."""
    stop.poll(None)
    give_up = time.monotonic() + _END_SECONDS
    while not _working.acquire(timeout=0.1) and time.monotonic() < give_up:
        cancel_runs()
    os._exit(0)
