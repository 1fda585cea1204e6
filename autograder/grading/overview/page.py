"""Writes the term into a folder: the class, what is alike, and a page for each student that can be forwarded."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from urllib.parse import quote

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from dhkit.public import questions as public_questions

from ..errors import CourseError
from ..files import staged
from .reading import Overview
from .standing import Student

PAGE, ALIKE, STUDENTS = "index.html", "alike.html", "students"
_PAIRS, _STAYING = 50, 20
# Shares of the points from which on a cell has the next colour.
_STEPS = (0.25, 0.5, 0.75, 0.999)


def write_pages(found: Overview, folder: Path) -> Path:
    """Write all pages into `folder`, which is made if need be; returns the path of the page about the class."""
    try:
        with staged(folder, {name: text.encode() for name, text in as_html(found).items()}, 0o644) as put_in_place:
            put_in_place()
    except (FileExistsError, NotADirectoryError):
        raise CourseError(f"{folder} is not a folder; say --to FOLDER") from None
    return folder / PAGE


def as_html(found: Overview) -> Mapping[str, str]:
    """Every page by its path; they need nothing else, and nothing in them acts."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    titles = {name: question.title for name, question in public_questions().items()}
    environment.filters |= {
        "percent": lambda share: f"{share:.0%}",
        "width": lambda share: f"{100 * min(1.0, max(0.0, share)):.0f}%",
        "step": lambda share: sum(share >= least for least in _STEPS),
        "points": lambda points: f"{round(points, 2):g}",
        "words": lambda note: note.replace("_", " "),
        "address": lambda id: quote(f"{STUDENTS}/{id}.html"),
        "title": lambda question: titles.get(question, question),
        "once_in": _once_in,
    }
    names = {student.id: student.name for student in found.students}
    classes = {one.name: one for one in found.exercises}
    shown = {"found": found, "names": names, "alike": ALIKE, "pairs": found.pairs[:_PAIRS]}
    pages = {
        PAGE: environment.get_template("class.html.j2").render(**shown, staying=found.staying[:_STAYING]),
        ALIKE: environment.get_template("alike.html.j2").render(**shown),
    }
    student_page = environment.get_template("student.html.j2")
    pages |= {
        f"{STUDENTS}/{student.id}.html": student_page.render(student=student, classes=classes, back=_back(student))
        for student in found.students
    }
    return pages


def _back(student: Student) -> dict[str, str]:
    """What the student was told about each mistake that came back, the last time."""
    said = {}
    for work in student.works:
        for answer in work.answers:
            for note in answer.mistakes:
                if note in student.stays:
                    said[note] = answer.told
    return said


def _once_in(expected: float) -> str:
    """How often chance gives what is expected so many times in a class."""
    if expected < 1e-6:
        return "less than once in a million classes"
    return f"at most once in {float(f'{1 / expected:.1g}'):,.0f} classes"
