"""Grades and answer notes as CSV, for ``nbgrader export`` and ``autograder export``."""

from __future__ import annotations

import csv
from pathlib import Path

from nbgrader.api import Assignment, Gradebook, MissingEntry, Student
from nbgrader.plugins import ExportPlugin
from traitlets import Bool

from ..cells import question_id
from ..entries import read_entries
from ..inert import spreadsheet_cell
from ..roster import read_roster

_ABOUT = ("assignment", "duedate", "timestamp", "student_id", "last_name", "first_name", "email")
_SCORES = ("raw_score", "bonus", "late_submission_penalty", "score", "max_score")


class GradesAndNotes(ExportPlugin):
    """nbgrader's own columns, then the notes in one column and the points of each question.

    The questions' points and the bonus add up to the raw score. Who handed in nothing has no points, rather than none
    of them, as has who is exempt; an exercise that nobody handed in has no lines.
    """

    bom = Bool(False, help="Mark the file as UTF-8, without which Excel does not read accents.").tag(config=True)

    def export(self, gradebook: Gradebook) -> None:
        wanted = set(map(str, self.assignment))
        students = set(map(str, self.student))
        assignments = [
            found for found in gradebook.assignments if found.submissions and (not wanted or found.name in wanted)
        ]
        cells = [cell for found in assignments for book in found.notebooks for cell in book.grade_cells]
        checks = [cell.name for cell in cells if cell.cell_type == "code"]
        roster = read_roster(Path(self.parent.coursedir.root))
        exempt = {(name, person.id) for person in roster.people for name in person.exempt}
        columns = [*_ABOUT, *_SCORES, "notes", *(question_id(check) for check in sorted(checks))]
        target = self.to or "grades.csv"
        self.log.info("Exporting grades to %s", target)
        with open(target, "w", newline="", encoding="utf-8-sig" if self.bom else "utf-8") as file:
            writer = csv.DictWriter(file, columns, restval="")
            writer.writeheader()
            for assignment in assignments:
                for student in sorted(gradebook.students, key=_by_name):
                    if not students or student.id in students:
                        row = _row(gradebook, assignment, student)
                        if (assignment.name, student.id) in exempt:
                            row = {key: row[key] for key in (*_ABOUT, "max_score") if key in row} | {"notes": "exempt"}
                        writer.writerow({key: spreadsheet_cell(value) for key, value in row.items()})


def _by_name(student: Student) -> tuple[str, str, str]:
    return student.last_name or "", student.first_name or "", student.id


def _row(gradebook: Gradebook, assignment: Assignment, student: Student) -> dict:
    row = {key: getattr(student, key) for key in ("last_name", "first_name", "email")}
    row |= {"assignment": assignment.name, "duedate": assignment.duedate, "student_id": student.id}
    try:
        submission = gradebook.find_submission(assignment.name, student.id)
    except MissingEntry:
        return row | {"max_score": assignment.max_score}
    penalty = submission.late_submission_penalty
    row |= {
        "duedate": submission.duedate,
        "timestamp": submission.timestamp,
        "raw_score": submission.score,
        "late_submission_penalty": penalty,
    }
    row |= {"score": max(0.0, submission.score - penalty), "max_score": assignment.max_score}
    notes, bonus = [], submission.score
    for entry in read_entries(submission):
        row[question_id(entry.check)] = entry.score
        bonus -= entry.score
        if entry.note not in (None, "right"):
            notes.append(f"{question_id(entry.check)}: {entry.note}")
    return row | {"bonus": round(bonus, 2) + 0.0, "notes": "; ".join(notes)}
