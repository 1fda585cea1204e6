"""``autograder points``: what a question is worth, changed where it is said, in the solution's notebook."""

from __future__ import annotations

import re
from dataclasses import dataclass

import nbformat
from nbformat.notebooknode import NotebookNode

from .cells import FOR_EVERYBODY, check_id, check_name, counts_for_everybody, question_id
from .course import Course
from .errors import CourseError
from .files import write_whole

_TITLE = re.compile(r"\((\d+(?:\.\d+)?) points?\)")


@dataclass(frozen=True)
class Worth:
    """What a question is worth: the most points, and whether everybody who hands in gets them."""

    points: float
    for_everybody: bool


def set_worth(course: Course, question: str, points: float | None, for_everybody: bool | None) -> Worth:
    """Change what a question is worth; None leaves it as it is. The title of the question follows.

    Raises
    ------
    CourseError
        If there is no such question.
    """
    exercise = question.partition(".")[0]
    course.require(exercise)
    path = course.step("source", ".", exercise) / f"{exercise}.ipynb"
    nb = nbformat.read(path, as_version=4)
    names = [check_name(cell) for cell in nb.cells]
    if check_id(question) not in names:
        known = ", ".join(question_id(name) for name in names if name)
        raise CourseError(f"there is no question {question!r}; there are: {known}")
    place = names.index(check_id(question))
    cell = nb.cells[place]
    if points is not None:
        cell.metadata.nbgrader.points = int(points) if points == int(points) else points
        _retitle(nb, names, place, points)
    if for_everybody is not None:
        cell.metadata.pop(FOR_EVERYBODY, None)
        if for_everybody:
            cell.metadata[FOR_EVERYBODY] = True
    write_whole(path, f"{nbformat.writes(nb).rstrip()}\n".encode())
    return Worth(float(cell.metadata.nbgrader.points), counts_for_everybody(cell))


def _retitle(nb: NotebookNode, names: list[str | None], place: int, points: float) -> None:
    """Say the points in the title of the question, the nearest that stands between it and the question before."""
    for number in range(place - 1, -1, -1):
        if names[number] is not None:
            return
        cell = nb.cells[number]
        if cell.cell_type == "markdown" and _TITLE.search(cell.source):
            said = f"({points:g} point{'' if points == 1 else 's'})"
            cell.source = _TITLE.sub(said, cell.source, count=1)
            return
