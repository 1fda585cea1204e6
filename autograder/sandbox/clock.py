"""Time as it is counted against a notebook: processor time, and the wall clock only while nothing held it up.

On a busy machine a notebook may wait for a processor many times longer than it computes, and that is not its own
doing. A cell that sleeps or waits for ever uses no processor time, so there is a second bound: on the time that went
by while it could have run. A third one, on the plain wall clock, ends what gets no processor at all; who meets it is
graded again, and never loses points by it.
"""

from __future__ import annotations

from dataclasses import dataclass

from .limits import Limits

PATIENCE = 2  # seconds of its own that a cell or a notebook may let go by for each second it may compute
LOAD_FACTOR = 40  # how many times slower than alone a notebook may be let run at all
LONGEST_STEP = 1.0  # seconds between two looks; if more went by, whoever looks was itself held up


@dataclass(frozen=True)
class Observation:
    """What a family of processes looked like at one moment.

    Attributes
    ----------
    processor : float
        Seconds of processor time that it has used, processes that ended included.
    held_up : bool
        Whether part of it stood ready to run, or all of it was stopped from outside.
    """

    processor: float
    held_up: bool


@dataclass(frozen=True)
class Spent:
    """What a family of processes has used up, in seconds.

    Attributes
    ----------
    processor : float
        Processor time of all its processes together.
    own : float
        Time that went by while nothing held it up.
    wall : float
        Time that went by.
    """

    processor: float = 0.0
    own: float = 0.0
    wall: float = 0.0

    def __add__(self, other: Spent) -> Spent:
        return Spent(self.processor + other.processor, self.own + other.own, self.wall + other.wall)

    def __sub__(self, other: Spent) -> Spent:
        return Spent(self.processor - other.processor, self.own - other.own, self.wall - other.wall)


def is_over(taken: Spent, seconds: float) -> bool:
    """Whether `seconds` of its own have gone by, or so many on the wall that nobody waits any longer."""
    return taken.own >= seconds or taken.wall >= LOAD_FACTOR * seconds


class FairClock:
    """Adds up what a family of processes spends, from one observation to the next.

    Parameters
    ----------
    now : float
        The time at its start, in seconds on a clock that never goes back.
    """

    def __init__(self, now: float) -> None:
        self._last = now
        self._seen = 0.0
        self.spent = Spent()

    def tick(self, now: float, seen: Observation) -> None:
        """Take in what was seen at the time `now`."""
        wall = max(0.0, now - self._last)
        # Children that nobody waits for take their processor time out of sight with them; it stays counted.
        processor = max(0.0, seen.processor - self._seen)
        passed = min(wall, LONGEST_STEP)
        own = min(passed, processor) if seen.held_up else passed
        self.spent += Spent(processor, own, wall)
        self._last, self._seen = max(now, self._last), seen.processor


@dataclass(frozen=True)
class TimeUp:
    """A bound on time was met.

    Attributes
    ----------
    message : str
        A sentence about the cell.
    of_notebook : str or None
        A sentence about the notebook, if it was the notebook's time that ran out.
    starved : bool
        Whether it hardly got to run, so that nothing can be said about the notebook.
    """

    message: str
    of_notebook: str | None = None
    starved: bool = False


def time_up(limits: Limits, cell: Spent, notebook: Spent) -> TimeUp | None:
    """Return which bound was met by a cell that has spent `cell` in a notebook that has spent `notebook`, if any."""
    whole = f"{limits.notebook_seconds:g} s"
    if notebook.processor >= limits.notebook_seconds:
        return TimeUp(f"stopped: the notebook's {whole} were used up", f"notebook stopped after {whole}")
    if cell.processor >= limits.cell_seconds:
        return TimeUp(f"stopped after {limits.cell_seconds:g} s")
    if notebook.own >= PATIENCE * limits.notebook_seconds:
        waited = f"{PATIENCE * limits.notebook_seconds:g} s, in which it computed for {notebook.processor:.1f} s"
        return TimeUp(f"stopped: the notebook took {waited}", f"notebook stopped after {waited}")
    if cell.own >= PATIENCE * limits.cell_seconds:
        waited = f"{PATIENCE * limits.cell_seconds:g} s, in which it computed for {cell.processor:.1f} s"
        return TimeUp(f"stopped after {waited}")
    if notebook.wall >= LOAD_FACTOR * limits.notebook_seconds:
        hardly = f"the machine gave it {notebook.processor:.1f} s of processor time in {notebook.wall:.0f} s"
        return TimeUp(f"stopped: {hardly}", f"notebook stopped: {hardly}", starved=True)
    return None
