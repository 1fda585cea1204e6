"""How far an exercise is: every question, what is known of it here, and the points that are sure."""

from __future__ import annotations

import html
from dataclasses import dataclass

from .. import public
from .envelopes import find
from .verdict import Verdict

SAID = {
    "right": "right",
    "mistake": "not right yet",
    "partly": "not right yet",
    "not_right": "not right yet",
    "undecided": "handed in, the grader decides",
    "form": "not in the form asked for",
    "blank": "not attempted",
}

_latest: dict[str, Verdict] = {}


def note(id: str, found: Verdict) -> None:
    """Keep the latest verdict of a question."""
    _latest[id] = found


def latest(id: str) -> Verdict | None:
    """The latest verdict in this session, None if the question was not handed in."""
    return _latest.get(id)


@dataclass(frozen=True)
class Row:
    """One question: its title, what is known of it, its points and minutes."""

    title: str
    state: str
    points: float
    minutes: int

    @property
    def said(self) -> str:
        return SAID[self.state]


@dataclass(frozen=True)
class Progress:
    """An exercise as it stands; a table with a bar in Jupyter, lines elsewhere.

    Attributes
    ----------
    rows : tuple of Row
    """

    exercise: str
    rows: tuple[Row, ...]

    @property
    def sure(self) -> float:
        """Points of the questions that are right."""
        return sum(row.points for row in self.rows if row.state == "right")

    @property
    def with_grader(self) -> float:
        """Points of what was handed in and is decided by the grader."""
        return sum(row.points for row in self.rows if row.state == "undecided")

    @property
    def points(self) -> float:
        return sum(row.points for row in self.rows)

    @property
    def minutes_left(self) -> int:
        """Expected minutes for the questions that are neither right nor with the grader."""
        return sum(row.minutes for row in self.rows if row.state not in ("right", "undecided"))

    def _summary(self) -> str:
        grader = f", {self.with_grader:g} with the grader" if self.with_grader else ""
        left = f"; about {self.minutes_left} minutes left" if self.minutes_left else ""
        return f"{self.exercise}: {self.sure:g} of {self.points:g} points sure{grader}{left}"

    def __repr__(self) -> str:
        width = max((len(row.title) for row in self.rows), default=0)
        lines = [f"  {row.title:<{width}}  {row.points:>4g}  {row.said}" for row in self.rows]
        return "\n".join([self._summary(), *lines])

    def _repr_html_(self) -> str:
        whole = self.points or 1
        bar = "".join(
            f'<div style="width:{100 * part / whole:.1f}%;background:{colour};height:100%"></div>'
            for part, colour in ((self.sure, "#009E73"), (self.with_grader, "#56B4E9"))
        )
        rows = "".join(
            f'<tr><td style="text-align:left">{html.escape(row.title)}</td><td>{row.points:g}</td>'
            f'<td style="text-align:left">{html.escape(row.said)}</td><td>{row.minutes} min</td></tr>'
            for row in self.rows
        )
        return (
            f"<div><b>{html.escape(self._summary())}</b>"
            f'<div style="display:flex;height:0.7em;max-width:30em;border:1px solid #888;margin:0.4em 0">{bar}</div>'
            "<table><thead><tr><th style='text-align:left'>question</th><th>points</th>"
            "<th style='text-align:left'>state</th><th>expected time</th></tr></thead>"
            f"<tbody>{rows}</tbody></table></div>"
        )


def progress(exercise: str | None = None) -> Progress:
    """How far `exercise` is, by what was checked in this session.

    Parameters
    ----------
    exercise : str, optional
        By default the one whose questions were checked last.

    Raises
    ------
    KeyError
        If there is no such exercise, or nothing was checked yet.
    """
    known = dict.fromkeys(question.exercise for question in public.questions().values())
    chosen = exercise or next((id.partition(".")[0] for id in reversed(_latest)), None)
    if chosen not in known:
        which = "nothing was checked yet; name the exercise" if chosen is None else f"there is no exercise {chosen!r}"
        raise KeyError(f"{which}: {', '.join(known)}")
    sealed = find(chosen)
    rows = []
    for id, question in public.questions().items():
        if question.exercise != chosen:
            continue
        here = None if sealed is None else sealed.of(id)
        found = latest(id)
        rows.append(
            Row(question.title, found.state if found else "blank", here.points if here else 0.0, question.minutes)
        )
    return Progress(chosen, tuple(rows))
