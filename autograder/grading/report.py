"""How the class did on one exercise: points and answer notes per question."""

from __future__ import annotations

import csv
from collections import Counter
from dataclasses import dataclass, field
from statistics import mean, median

from nbgrader.api import Gradebook, MissingEntry

from .course import Course, CourseError
from .export import results
from .restore import question_id

UNNOTED = "unnoted"


@dataclass
class QuestionReport:
    """One question over the class: the points earned and how often each note was given."""

    question: str
    points: float
    scores: list[float] = field(default_factory=list)
    notes: Counter = field(default_factory=Counter)

    def summary(self) -> dict[str, object]:
        """One row of the report: plain values, notes by falling frequency."""
        full = sum(score >= self.points for score in self.scores)
        none = sum(score == 0 for score in self.scores)
        return {
            "question": self.question,
            "points": self.points,
            "submissions": len(self.scores),
            "mean": round(mean(self.scores), 2),
            "median": round(median(self.scores), 2),
            "full": full,
            "partial": len(self.scores) - full - none,
            "none": none,
            "notes": "; ".join(f"{note} {count}" for note, count in self.notes.most_common()),
        }


def question_reports(course: Course, exercise: str) -> list[QuestionReport]:
    """One report per question, in the order of their ids; `CourseError` if nothing was graded yet."""
    course.choose(exercise)
    found: dict[str, QuestionReport] = {}
    with Gradebook(course.app.coursedir.db_url, course.app.coursedir.course_id) as gradebook:
        try:
            submissions = gradebook.find_assignment(exercise).submissions
        except MissingEntry:
            submissions = []
        for submission in submissions:
            for name, score, points, note in results(submission):
                entry = found.setdefault(name, QuestionReport(question_id(name), points))
                entry.scores.append(score)
                entry.notes[note or UNNOTED] += 1
    if not found:
        raise CourseError(f"nothing was graded for {exercise} yet; run: autograder grade {exercise}")
    return [found[name] for name in sorted(found)]


def write_csv(reports: list[QuestionReport], path: str) -> None:
    """One line per question and note: question, points, submissions, mean, median, note, count."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(("question", "points", "submissions", "mean", "median", "note", "count"))
        for report in reports:
            row = report.summary()
            about = [row[key] for key in ("question", "points", "submissions", "mean", "median")]
            writer.writerows((*about, note, count) for note, count in report.notes.most_common())
