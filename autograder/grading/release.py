"""Makes the students' notebooks from the solutions: ``nbgrader generate_assignment`` for one exercise, and its sealed verdicts."""

from __future__ import annotations

import secrets
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import nbformat
from nbgrader.api import Assignment
from nbgrader.utils import is_grade, is_task
from sqlalchemy import select

from autograder import questions
from autograder.sealing import Decision, seal_exercise
from dhkit.home import envelopes

from .cells import answer_id, check_cells, question_id, tracked_cells
from .course import Course, convert
from .exercise import Changes, asked_before
from .gradebook import is_made, reading
from .plugins.assignment import AssignmentRelease

Home = Literal["sealed", "form"]

_BEGIN, _END = "### BEGIN SOLUTION", "### END SOLUTION"


@dataclass(frozen=True)
class Released:
    """What a release did.

    Attributes
    ----------
    changes : Changes
        For those who had handed in already.
    decisions : list of Decision
        Which questions have a verdict at home; none where the exercise has no sealed verdicts.
    """

    changes: Changes
    decisions: tuple[Decision, ...] = ()


def release(
    course: Course,
    exercise: str,
    home: Home = "sealed",
    anew: bool = False,
    told: Callable[[str], None] = lambda question: None,
) -> Released:
    """Write ``exercises/<exercise>`` and enter it in the gradebook, both or neither.

    Parameters
    ----------
    course : Course
    exercise : str
    home : str
        "sealed": the students' copies tell whether an answer is right; "form": only whether its form is.
    anew : bool
        Whether everything is sealed with a new salt; otherwise with the one of the release that is there.
    told : callable
        Told each question that is sealed.

    Raises
    ------
    CourseError
        If there is no such solution, or it cannot be released.
    """
    course.choose(exercise)
    converter = AssignmentRelease(coursedir=course.app.coursedir, parent=course.app)
    converter.force = True
    made: list[Decision] = []
    asked = questions.of_exercise(exercise) if home == "sealed" else ()
    if asked:
        name = f"{exercise}{envelopes.SUFFIX}"
        present = envelopes.read(course.step("release", ".", exercise) / name)
        salt = secrets.token_bytes(16) if anew or present is None else present.salt
        notebook = nbformat.read(course.step("source", ".", exercise) / f"{exercise}.ipynb", as_version=4)
        sealed, made = seal_exercise(exercise, asked, salt, solutions(notebook), points(notebook), told=told)
        converter.beside = {name: envelopes.encoded(sealed)}
    convert(converter)
    return Released(converter.changes, tuple(made))


def changes_ahead(course: Course, exercise: str) -> Changes:
    """What a release would change for those who handed in already.

    Raises
    ------
    CourseError
        If there is no such exercise.
    """
    course.require(exercise)
    if not is_made(course.db_url):
        return Changes()
    after = {
        name
        for path in course.step("source", ".", exercise).glob("*.ipynb")
        for name, cell in tracked_cells(nbformat.read(path, as_version=4)).items()
        if is_grade(cell) or is_task(cell)
    }
    with reading(course.db_url) as session:
        assignment = session.scalars(select(Assignment).where(Assignment.name == exercise)).one_or_none()
        if assignment is None:
            return Changes()
        before = asked_before(assignment)
        count = len(assignment.submissions)
    return Changes(count, tuple(sorted(after - before)), tuple(sorted(before - after)))


def points(notebook: nbformat.NotebookNode) -> dict[str, float]:
    """What each question of an exercise is worth, by its id."""
    return {question_id(name): float(cell.metadata.nbgrader.points) for name, cell in check_cells(notebook).items()}


def solutions(notebook: nbformat.NotebookNode) -> dict[str, str]:
    """The worked solution of each question as Markdown, by its id: what stands in its answer cell."""
    cells = tracked_cells(notebook)
    found = {}
    for name in check_cells(notebook):
        answer = cells.get(answer_id(name))
        source = answer.source if answer is not None else ""
        if _BEGIN in source:
            worked = source.partition(_BEGIN)[2].partition(_END)[0].strip("\n")
            found[question_id(name)] = f"```python\n{worked}\n```"
    return found
