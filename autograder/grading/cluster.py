"""Notebooks on many machines: a crew that sends them to the workers of a Dask scheduler.

Restoring, judging and the gradebook stay here; a worker gets one notebook with its files and gives back what came out of
the sandbox, as JSON. `autograder worker` starts one.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from typing import Any

import msgspec

from .course import Course
from .crew import Crew, Desk
from .errors import CourseError
from .plugins.autograde import Judged, NotReady, SubmissionAutograde, Turn
from .plugins.preprocessors import SandboxExecute
from .submission.elsewhere import MustRun, run_parcel, try_out
from .submission.execution import InDoubt

_ANSWER_SECONDS = 30
_TRIALS = 3
_THREADS = 4
"""Notebooks that one process of a worker looks after, all of them with one warm parent."""


class ClusterCrew(Crew):
    """A crew whose notebooks run on the workers of a Dask scheduler.

    Parameters
    ----------
    course : Course
    jobs : int
        How many processes judge here.
    scheduler : str
        Its address, for example ``"tcp://host:8786"``.

    Raises
    ------
    CourseError
        If Dask is not installed, the scheduler does not answer, or no worker has come to it.
    """

    def __init__(self, course: Course, jobs: int, scheduler: str) -> None:
        super().__init__(course, jobs)
        self._dask = _dask()
        try:
            self._client = self._dask.Client(scheduler, timeout=_ANSWER_SECONDS, set_as_default=False)
            self._client.run_on_scheduler(tell_every_death)
        except (OSError, ValueError) as error:
            raise CourseError(
                f"the scheduler {scheduler} does not answer ({error}); start one with: dask scheduler"
            ) from None
        self.jobs = sum(self._client.nthreads().values())
        if not self.jobs:
            self._client.close()
            raise CourseError(f"no worker has come to {scheduler}; start one with: autograder worker {scheduler}")
        self._messengers = ThreadPoolExecutor(2 * self.jobs)

    def __exit__(self, *error: object) -> None:
        super().__exit__(*error)
        self._messengers.shutdown()
        self._client.close()

    def cancel(self) -> None:
        self._messengers.shutdown(wait=False, cancel_futures=True)
        self._client.close()
        super().cancel()

    def trial(self, exercise: str) -> Future[None]:
        return self._messengers.submit(self._trial)

    def judged(self, exercise: str, student: str, names: Sequence[str], turn: Turn) -> Future[Judged]:
        return self._messengers.submit(self._judged, exercise, student, names, turn)

    def _trial(self) -> None:
        converter = SubmissionAutograde(coursedir=self._course.app.coursedir, parent=self._course.app)
        runner = SandboxExecute(parent=converter)
        settings = {"notebook": "", "files": [], "student": "", "limits": runner.limits, "mode": runner.mode}
        for _ in range(_TRIALS):
            # A neighbour's notebook may end the worker under it.
            with suppress(InDoubt):
                said = self._elsewhere(try_out, msgspec.json.encode({**settings, "alone": False}), "first")
                if fault := said[:1000].decode(errors="replace"):
                    raise NotReady(f"on a worker of the scheduler: {fault}")
                return
        raise NotReady(f"{_TRIALS} workers of the scheduler ended while they ran a trial notebook; look at their logs")

    def _judged(self, exercise: str, student: str, names: Sequence[str], turn: Turn) -> Judged:
        brought: dict[str, bytes] = {}
        while True:
            try:
                return self._submit(Desk.judged, exercise, student, names, turn, brought).result()
            except MustRun as missing:
                brought[missing.name] = self._elsewhere(run_parcel, missing.parcel, turn)

    def _elsewhere(self, work: Callable[[bytes], bytes], parcel: bytes, turn: Turn) -> bytes:
        """What a worker makes of a parcel. One that ends costs a second try, alone; who ends two is set aside."""
        try:
            reply = self._client.submit(work, parcel, pure=False).result()
        except self._dask.scheduler.KilledWorker:
            if turn == "first":
                raise InDoubt("the worker that ran it ended") from None
            raise CourseError(
                "set aside: two workers ended while they ran it, the second with nothing else to do"
            ) from None
        except (self._dask.client.FutureCancelledError, self._dask.CancelledError, OSError) as error:
            raise CourseError(f"the scheduler was lost ({error}); grade again") from None
        if not isinstance(reply, bytes):
            raise CourseError("a worker answered with something else than bytes")
        return reply


def tell_every_death(dask_scheduler: Any) -> None:
    """Make a scheduler say that a worker ended, in place of trying three others: the pipeline tries again, alone."""
    dask_scheduler.allowed_failures = 0


def worker_command(scheduler: str, jobs: int) -> list[str]:
    """The command line of a worker that runs so many notebooks at the same time."""
    _dask()
    processes = -(-jobs // _THREADS)
    return [
        sys.executable, "-m", "distributed.cli.dask_worker", scheduler, "--nworkers", str(processes),
        "--nthreads", str(-(-jobs // processes)), "--memory-limit", "0", "--no-dashboard", "--preload", __name__,
    ]  # fmt: skip


def _dask() -> Any:
    try:
        import distributed
    except ImportError:
        raise CourseError("Dask is not installed; run: pip install 'autograder[cluster]'") from None
    return distributed
