"""An exercise in the gradebook: its notebooks and cells, brought up to a new release in one transaction.

nbgrader refuses to add or remove a cell once somebody handed in. Here the rows of submissions follow: what was graded
stays where its question is still asked, a new question is added to each submission as one that is yet to be graded.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from nbformat.notebooknode import NotebookNode
from nbgrader import utils
from nbgrader.api import Assignment, BaseCell, GradeCell, Notebook, SolutionCell, SourceCell, TaskCell
from sqlalchemy import select
from sqlalchemy.orm import Session

from .store import complete


@dataclass
class ReleasedCells:
    """The cells of a released notebook that nbgrader follows, by id.

    Attributes
    ----------
    grades, tasks : dict
        Most points and type of each cell that earns points.
    solutions : set of str
        Cells that hold an answer.
    sources : dict
        Type, lock, source and checksum of each cell.
    """

    kernelspec: str = "{}"
    grades: dict[str, dict] = field(default_factory=dict)
    tasks: dict[str, dict] = field(default_factory=dict)
    solutions: set[str] = field(default_factory=set)
    sources: dict[str, dict] = field(default_factory=dict)

    def add(self, cell: NotebookNode) -> None:
        """Take up a cell of the instructor's notebook, as nbgrader's SaveCells does."""
        if not (utils.is_grade(cell) or utils.is_solution(cell) or utils.is_locked(cell) or utils.is_task(cell)):
            return
        marks = cell.metadata.nbgrader
        name = marks["grade_id"]
        worth = {"max_score": float(marks["points"]), "cell_type": cell.cell_type} if "points" in marks else {}
        if utils.is_grade(cell):
            self.grades[name] = worth
        if utils.is_task(cell):
            self.tasks[name] = worth
        if utils.is_solution(cell):
            self.solutions.add(name)
        self.sources[name] = {
            "cell_type": cell.cell_type,
            "locked": utils.is_locked(cell),
            "source": cell.source,
            "checksum": marks.get("checksum"),
        }


@dataclass(frozen=True)
class Changes:
    """What a release changed for those who had handed in already: questions by the id of their cell."""

    submissions: int = 0
    added: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()


def asked_before(assignment: Assignment) -> set[str]:
    """Ids of the cells that earn points, as the gradebook knows them."""
    return {cell.name for notebook in assignment.notebooks for cell in (*notebook.grade_cells, *notebook.task_cells)}


def update(session: Session, exercise: str, course_id: str, released: Mapping[str, ReleasedCells]) -> Changes:
    """Enter an exercise in the gradebook, or bring it up to what is released now.

    Parameters
    ----------
    session : Session
        Of `gradebook.writing`.
    released : mapping of str to ReleasedCells
        By the name of each notebook.
    """
    assignment = session.scalars(select(Assignment).where(Assignment.name == exercise)).one_or_none()
    if assignment is None:
        assignment = Assignment(name=exercise, course_id=course_id)
        session.add(assignment)
        session.flush()
    before = asked_before(assignment)
    for notebook in list(assignment.notebooks):
        if notebook.name not in released:
            _remove(session, notebook)
    session.flush()
    session.refresh(assignment)
    present = {notebook.name: notebook for notebook in assignment.notebooks}
    for name, cells in released.items():
        notebook = present.get(name)
        if notebook is None:
            notebook = Notebook(name=name, assignment_id=assignment.id)
            session.add(notebook)
            session.flush()
        notebook.kernelspec = cells.kernelspec
        _update_cells(session, notebook, cells)
    session.flush()
    session.expire_all()
    for submission in assignment.submissions:
        complete(session, submission, assignment.notebooks)
    after = {name for cells in released.values() for name in (*cells.grades, *cells.tasks)}
    return Changes(len(assignment.submissions), tuple(sorted(after - before)), tuple(sorted(before - after)))


def _update_cells(session: Session, notebook: Notebook, cells: ReleasedCells) -> None:
    wanted: dict[type[BaseCell], dict[str, dict]] = {
        GradeCell: cells.grades,
        TaskCell: cells.tasks,
        SolutionCell: {name: {} for name in sorted(cells.solutions)},
    }
    present: dict[type[BaseCell], list[BaseCell]] = {
        GradeCell: notebook.grade_cells,
        TaskCell: notebook.task_cells,
        SolutionCell: notebook.solution_cells,
    }
    for kind, found in present.items():
        _remove_cells(session, (cell for cell in found if cell.name not in wanted[kind]))
        rows = {cell.name: cell for cell in found}
        for name, values in wanted[kind].items():
            _set(session, rows.get(name) or kind(name=name, notebook_id=notebook.id), values)
    sources = {cell.name: cell for cell in notebook.source_cells}
    for name, source in sources.items():
        if name not in cells.sources:
            session.delete(source)
    for name, values in cells.sources.items():
        _set(session, sources.get(name) or SourceCell(name=name, notebook_id=notebook.id), values)


def _set(session: Session, row: BaseCell | SourceCell, values: Mapping[str, object]) -> None:
    for name, value in values.items():
        setattr(row, name, value)
    session.add(row)


def _remove(session: Session, notebook: Notebook) -> None:
    """Remove a notebook with all that was stored for it."""
    _remove_cells(session, (*notebook.grade_cells, *notebook.task_cells, *notebook.solution_cells))
    for row in (*notebook.source_cells, *notebook.submissions):
        session.delete(row)
    session.flush()
    session.delete(notebook)


def _remove_cells(session: Session, cells: Iterable[BaseCell]) -> None:
    for cell in list(cells):
        # A cell that earns points has no comments, one that holds an answer no points.
        for row in (*(cell.grades or ()), *(cell.comments or ())):
            session.delete(row)
        session.flush()
        session.delete(cell)
