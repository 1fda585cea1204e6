"""Writes the class report into a folder: one page to look at, three tables to compute with."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from autograder.judge.written import written

from ..errors import CourseError
from ..inert import spreadsheet_cell
from . import plots
from .statistics import ClassReport

PAGE = "report.html"
_SHOWN_STUDENTS, _SHOWN_CLUSTERS = 12, 12


def write_report(report: ClassReport, folder: Path) -> Path:
    """Write ``report.html`` and the CSV tables into `folder`, which is made if need be; returns the page's path."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        raise CourseError(f"{folder} is not a folder; say --to FOLDER") from None
    for name, rows in tables(report).items():
        _write_csv(folder / name, rows)
    page = folder / PAGE
    page.write_text(as_html(report), encoding="utf-8")
    return page


def as_html(report: ClassReport) -> str:
    """The report as one page that needs nothing else and in which nothing acts."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    environment.filters |= {
        "written": written,
        "students": _students,
        "percent": lambda share: f"{share:.0%}",
    }
    # Data URIs of our own plots: base64, which needs no escaping.
    drawn = {
        "overview": Markup(plots.overview(report)),
        "plots": [Markup(plots.question_plot(q)) for q in report.questions],
    }
    return environment.get_template("report.html.j2").render(report=report, shown=_SHOWN_CLUSTERS, **drawn)


def _students(names: Sequence[str]) -> str:
    more = len(names) - _SHOWN_STUDENTS
    return ", ".join(names[:_SHOWN_STUDENTS]) + (f" and {more} more" if more > 0 else "")


def tables(report: ClassReport) -> dict[str, list[Sequence]]:
    """Rows of each CSV file, the names of the columns first."""
    about = (
        "question",
        "title",
        "max_score",
        "submissions",
        "answered",
        "mean",
        "median",
        "full",
        "not_attempted",
        "unexplained",
    )
    questions: list[Sequence] = [(*about, "discrimination")]
    notes: list[Sequence] = [("question", "note", "count")]
    answers: list[Sequence] = [("question", "size", "compared_by", "students", "said", "answer")]
    for question in report.questions:
        numbers = [
            value if isinstance(value, str) else round(value, 4)
            for value in (getattr(question, name) for name in about)
        ]
        questions.append((*numbers, "" if question.discrimination is None else round(question.discrimination, 3)))
        notes += [(question.question, note, count) for note, count in question.notes.most_common()]
        for cluster in question.clusters:
            students = "; ".join(cluster.students)
            answer = cluster.attempts[0].answer
            text = "" if answer is None else written(answer.value).replace("\n", " ")
            answers.append(
                (
                    question.question,
                    cluster.size,
                    "answer" if cluster.alike else "words",
                    students,
                    cluster.feedback,
                    text,
                )
            )
    return {"questions.csv": questions, "notes.csv": notes, "answers.csv": answers}


def _write_csv(path: Path, rows: Iterable[Sequence]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([spreadsheet_cell(value) for value in row] for row in rows)
