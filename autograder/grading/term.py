"""Due dates and what being late costs: ``term.toml`` in the course folder, with more time and exemptions in `roster`.

::

    timezone = "Europe/Zurich"   # of the times here and in downloads; this machine's if it is left out

    [due]
    scara = 2026-10-14T23:59:00  # a day alone means until its end

    [late]
    grace_minutes = 10           # every due date is that much later
    off_per_day = 0.1            # share of the points that is taken off for each day that has begun
    at_most = 0.5                # never more than this share

Without the file due dates and penalties are nbgrader's own (``nbgrader db assignment add --duedate``).
"""

from __future__ import annotations

import math
import re
import tomllib
from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta, tzinfo
from pathlib import Path
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

import msgspec
from nbgrader.api import SubmittedAssignment

from .errors import CourseError
from .roster import Person, Roster, read_roster

FILE = "term.toml"
_DAY = 86400
_MORE = re.compile(r"\+(\d{1,4})\s*([dh])")


class Late(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What being late costs (see above)."""

    grace_minutes: float = 0
    off_per_day: float = 0
    at_most: float = 1

    def __post_init__(self) -> None:
        if self.grace_minutes < 0 or not 0 <= self.off_per_day <= 1 or not 0 <= self.at_most <= 1:
            raise ValueError("minutes must not be negative, off_per_day and at_most are shares from 0 to 1")

    def penalty(self, score: float, seconds: float) -> float:
        """Points that are taken off a score for so many seconds after the due date."""
        return score * min(self.at_most, self.off_per_day * math.ceil(seconds / _DAY))


class Term(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The file; `late` is None if it says nothing about penalties."""

    timezone: str | None = None
    due: dict[str, datetime] = {}
    late: Late | None = None

    def __post_init__(self) -> None:
        if self.timezone is not None:
            try:
                ZoneInfo(self.timezone)
            except (ZoneInfoNotFoundError, ValueError, OSError):
                raise ValueError(f"there is no time zone {self.timezone!r}") from None

    @property
    def zone(self) -> tzinfo | None:
        return ZoneInfo(self.timezone) if self.timezone else None

    def utc(self, local: datetime) -> datetime:
        """A time of the course as the gradebook keeps it: in UTC, without saying so."""
        if local.tzinfo is None and self.zone is not None:
            local = local.replace(tzinfo=self.zone)
        return local.astimezone(UTC).replace(tzinfo=None)


def read_term(root: Path) -> Term:
    """The dates of the course in `root`; none if there is no file.

    Raises
    ------
    CourseError
        If the file makes no sense.
    """
    path = root / FILE
    if not path.exists():
        return Term()
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
        if isinstance(due := content.get("due"), dict):
            content["due"] = {name: _end_of_day(value) for name, value in due.items()}
        return msgspec.convert(content, Term)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, msgspec.MsgspecError, ValueError) as error:
        raise CourseError(f"{path}: {error}") from None


def _end_of_day(value: object) -> object:
    if isinstance(value, date) and not isinstance(value, datetime):
        return datetime.combine(value, time(23, 59, 59))
    return value


@dataclass(frozen=True)
class Deadlines:
    """The due date of one exercise, for everybody."""

    exercise: str
    term: Term
    roster: Roster

    @property
    def due(self) -> datetime | None:
        """When it is due, grace included, as the gradebook keeps it; None if the course does not say."""
        said = self.term.due.get(self.exercise)
        if said is None:
            return None
        return self.term.utc(said) + timedelta(minutes=self.term.late.grace_minutes if self.term.late else 0)

    def extension(self, student: str) -> timedelta | None:
        """How much more time a student has; a group that hands in together has that of its members."""
        person, due = self.roster.get(student), self.due
        if due is None:
            return None
        who = [person] if person else self.roster.of_group(student)
        given = [more_time(one, self.exercise, due, self.term) for one in who]
        return max((more for more in given if more is not None), default=None)

    def had_until(self, student: str) -> str:
        """Until when a student with more time had it, in the course's own time; empty where there is no more."""
        more, due = self.extension(student), self.due
        if not more or due is None:
            return ""
        return f"{(due + more).replace(tzinfo=UTC).astimezone(self.term.zone):%Y-%m-%d %H:%M}"

    def apply(self, submission: SubmittedAssignment) -> None:
        """Enter the dates into a row of the gradebook; what the course does not say stays as it is."""
        if self.due is not None:
            submission.assignment.duedate = self.due
            submission.extension = self.extension(submission.student_id)


def deadlines(root: str | Path, exercise: str) -> Deadlines:
    """The deadlines of an exercise of the course in `root`."""
    return Deadlines(exercise, read_term(Path(root)), read_roster(Path(root)))


def more_time(person: Person, exercise: str, due: datetime, term: Term) -> timedelta | None:
    """The extension that the roster gives: ``scara=+3d``, ``scara=+12h`` or ``scara=2026-10-20 23:59``."""
    for text in person.extensions:
        name, _, until = (part.strip() for part in text.partition("="))
        if name != exercise:
            continue
        if more := _MORE.fullmatch(until):
            return timedelta(**{"days" if more[2] == "d" else "hours": int(more[1])})
        return max(timedelta(0), until_when(until, person.id, term) - due)
    return None


def until_when(text: str, student: str, term: Term) -> datetime:
    """A time that was typed into the roster, as the gradebook keeps it."""
    try:
        found = datetime.fromisoformat(text)
    except ValueError:
        raise CourseError(
            f"the extension {text!r} of {student} is no time; write +3d, +12h or 2026-10-20 23:59"
        ) from None
    if ":" not in text:
        found = datetime.combine(found.date(), time(23, 59, 59))
    return term.utc(found)
