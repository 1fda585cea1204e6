"""How long questions took, where notebooks tell: Colab writes when each cell ran, JupyterLab does with *Record timing*.

A cell keeps the time of its last run only. What passed between the runs of two checks in a row is the time of the later
question; where everything was run once more at the end, or somebody had dinner in between, nothing is told. Students
are not looked at one by one: the median of the class is.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from statistics import median

# In minutes: shorter is a second run of all cells, longer is a break.
_SHORTEST, _LONGEST = 0.5, 120
# From so many notebooks on the median is set against the minutes that were expected, and so far off is wrong.
ENOUGH = 5
_LONG, _SHORT = 1.5, 0.5


@dataclass(frozen=True)
class Minutes:
    """The time of one question: expected, median of the class, and how many notebooks tell."""

    question: str
    expected: int
    median: float
    count: int

    @property
    def off(self) -> str:
        """How it differs from what was expected; empty if it does not, or too few notebooks tell."""
        if self.count < ENOUGH or not self.expected:
            return ""
        ratio = self.median / self.expected
        return "takes longer" if ratio >= _LONG else "takes less" if ratio <= _SHORT else ""


def spent(metadata: Iterable[Mapping], checks: Sequence[str]) -> dict[str, float]:
    """Minutes before the run of each check of a notebook, by its id.

    Parameters
    ----------
    metadata : iterable of mapping
        Of the notebook's cells, in order.
    checks : sequence of str
        Ids of the check cells in order.
    """
    times: dict[str, datetime] = {}
    first: datetime | None = None
    for found in metadata:
        if (moment := _ran_at(found)) is None:
            continue
        marks = found.get("nbgrader")
        name = marks.get("grade_id") if isinstance(marks, dict) else None
        if isinstance(name, str) and name in checks:
            times[name] = moment
        elif not times and (first is None or moment < first):
            first = moment
    found_minutes = {}
    for before, check in zip((None, *checks), checks, strict=False):
        start = first if before is None else times.get(before)
        if start is not None and check in times:
            minutes = (times[check] - start).total_seconds() / 60
            if _SHORTEST <= minutes <= _LONGEST:
                found_minutes[check] = minutes
    return found_minutes


def summary(expected: Mapping[str, int], measured: Iterable[Mapping[str, float]]) -> list[Minutes]:
    """The class's median for each question that any notebook tells about.

    Parameters
    ----------
    expected : mapping of str to int
        Minutes by question.
    measured : iterable of mapping
        For each notebook, minutes by question.
    """
    all_of: dict[str, list[float]] = {}
    for notebook in measured:
        for question, minutes in notebook.items():
            all_of.setdefault(question, []).append(minutes)
    return [
        Minutes(question, expected[question], median(all_of[question]), len(all_of[question]))
        for question in expected
        if question in all_of
    ]


def _ran_at(metadata: Mapping) -> datetime | None:
    """When a cell ran last, as JupyterLab or Colab writes it."""
    execution, colab = metadata.get("execution"), metadata.get("executionInfo")
    try:
        if isinstance(execution, dict) and isinstance(said := execution.get("shell.execute_reply"), str):
            moment = datetime.fromisoformat(said)
            return moment if moment.tzinfo else moment.replace(tzinfo=UTC)
        if isinstance(colab, dict) and isinstance(said := colab.get("timestamp"), int):
            return datetime.fromtimestamp(said / 1000, UTC)
    except (ValueError, OverflowError, OSError):
        pass
    return None
