"""What the commands show in a terminal: progress, class table, report."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from datetime import datetime

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from autograder.sealing import Decision
from autograder.sealing.plausible import SECONDS_A_KEY, years

from .collecting.collect import Row
from .course import Course
from .enrolment import Enrolled
from .inert import terminal_text
from .overview.reading import Overview
from .report.statistics import ENOUGH, ClassReport, QuestionReport
from .results import Result, relative
from .returning import Returned

# So many notes of a question stand in the report's table; the page shows all.
_NOTES = 4


@contextmanager
def progress_bar(what: str, count: int) -> Iterator[Callable[[str], None]]:
    """A bar on stderr; call what it gives with each student, or question, that is done."""
    last = TextColumn("{task.fields[last]}")
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(), last)
    with Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task(what, total=count, last="")
        yield lambda done: bar.update(task, advance=1, last=escape(terminal_text(done, 30)))


def roster_table(lines: Sequence[Enrolled]) -> None:
    """Who is in the course, with the id to be typed into notebooks."""
    table = Table("id", "name", "e-mail", "groups", "", title=None)
    for line in lines:
        one = line.person
        table.add_row(*map(_cell, (one.id, one.name, one.email, "; ".join(one.groups), line.status)))
    _console().print(table)
    _print_counts(line.status for line in lines)


def collect_table(rows: Sequence[Row]) -> None:
    """What became of everybody's work, and how many there are of each kind."""
    table = Table("student", "what became of it", "file", "remarks", title=None)
    for row in rows:
        table.add_row(*map(_cell, (row.student, row.status, row.file, "; ".join(row.remarks))))
    _console().print(table)
    _print_counts(row.status for row in rows)


def returned_table(lines: Sequence[Returned]) -> None:
    """What goes back to the platform, and of whom nothing does."""
    table = Table("student", "points", "remarks", title=None)
    table.columns[1].justify = "right"
    for line in lines:
        points = "-" if line.points is None else f"{line.points:g}"
        table.add_row(*map(_cell, (line.student, points, "; ".join(line.remarks))))
    _console().print(table)


def class_table(results: Sequence[Result]) -> None:
    """The class table: student, exercise, score and what was found."""
    table = Table("student", "exercise", "score", "found", title=None)
    table.columns[2].justify = "right"
    for result in results:
        score = "-" if result.score is None else f"{result.score:g}/{result.max_score:g}"
        table.add_row(*map(_cell, (result.student, result.exercise, score, result.found())))
    _console().print(table)


def result_line(result: Result, now: datetime) -> str:
    """One submission on one line, with what moved."""
    score = "-" if result.score is None else f"{result.score:g}/{result.max_score:g}"
    moved = f"; moved: {', '.join(result.moved)}" if result.moved else ""
    parts = (result.student, result.exercise, score, f"{result.found()}{moved}")
    return "  ".join((f"{now:%H:%M}", *(terminal_text(part, 400) for part in parts)))


def changes_table(results: Sequence[Result]) -> None:
    """Whose points moved and why, and what was typed by hand and kept; nothing if there is neither."""
    for title, column in (("moved since it was graded before", "moved"), ("typed by hand, and kept", "by_hand")):
        rows = [(result.student, result.exercise, line) for result in results for line in getattr(result, column)]
        if rows:
            table = Table("student", "exercise", title)
            for row in rows:
                table.add_row(*map(_cell, row))
            _console().print(table)


def sealed_table(decisions: Sequence[Decision]) -> None:
    """What a student's copy tells of each question, and the arithmetic: answers to try, and years to try half of them."""
    table = Table("question", "answers to try", "years on one core", "mistakes", "parts", "at home")
    for column in table.columns[1:5]:
        column.justify = "right"
    for one in decisions:
        sealed = not one.why_not
        time = f"{years(one.bits, SECONDS_A_KEY):.2g}" if sealed else ""
        counts = (str(one.mistakes), str(one.parts)) if sealed else ("", "")
        table.add_row(one.question, f"2^{one.bits:.0f}", time, *counts, "sealed" if sealed else one.why_not)
    _console().print(table)


def summary(course: Course, results: Sequence[Result]) -> None:
    """How many were graded, left alone or failed, and where the feedback is."""
    counts = Counter(result.status for result in results)
    words = [f"{counts['graded']} graded"]
    if counts["unchanged"]:
        words.append(f"{counts['unchanged']} unchanged since they were graded (--force grades them again)")
    if counts["failed"]:
        words.append(f"{counts['failed']} could not be judged")
    if counts["no notebook"]:
        words.append(f"{counts['no notebook']} handed in no notebook of it")
    print("; ".join(words))
    pages = [result.feedback for result in results if result.feedback]
    if pages:
        step = course.step("feedback", "*", "*")
        print(f"feedback: {relative(step, course.root)}/*.html, for example {terminal_text(pages[0], 1000)}")


def report_table(report: ClassReport) -> None:
    """One line per question: points, what it tells, the most frequent notes, and where a misconception may be missing."""
    table = Table("question", "mean", "full", "discrimination", "notes", "look at")
    for column in table.columns[1:4]:
        column.justify = "right"
    for question in report.questions:
        notes = question.notes.most_common()
        said = "; ".join(f"{note} {count}" for note, count in notes[:_NOTES])
        more = f"; and {len(notes) - _NOTES} more" if len(notes) > _NOTES else ""
        table.add_row(
            *map(_cell, (question.question, f"{question.mean:.2f}/{question.max_score:g}", f"{question.full:.0%}")),
            _discrimination(question),
            _cell(f"{said}{more}"),
            _look_at(question),
        )
    _console().print(table)


def term_table(found: Overview) -> None:
    """Who is falling behind, and how much else the pages tell."""
    if found.behind:
        table = Table("falling behind", "why")
        for student, signs in found.behind.items():
            table.add_row(_cell(student), _cell("; ".join(signs)))
        _console().print(table)
    off = sum(bool(one.off) for one in found.minutes)
    print(
        f"{len(found.behind)} of {len(found.students)} falling behind; {len(found.staying)} mistakes that stay; "
        f"{off} questions whose minutes are wrong; {len(found.pairs)} pairs with equal wrong answers; "
        f"{len(found.borrowed)} with another's numbers"
    )


def _discrimination(question: QuestionReport) -> str:
    if question.discrimination is not None:
        return f"{question.discrimination:.2f}"
    return "too few" if question.answered < ENOUGH else "no spread"


def _look_at(question: QuestionReport) -> str:
    if not question.look_at:
        return ""
    return f"{question.unexplained} unexplained" + (f", {question.alike} alike" if question.alike > 1 else "")


def _print_counts(statuses: Iterable[str]) -> None:
    print("; ".join(f"{count} {status}" for status, count in Counter(statuses).most_common()) or "nobody")


def _console() -> Console:
    console = Console()
    # Piped into a file or a pager a table must not be cut at 80 columns.
    return console if console.is_terminal else Console(width=200)


def _cell(text: str) -> str:
    return escape(terminal_text(text, 400))
