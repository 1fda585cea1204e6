"""How the class did on one exercise: points, answer notes, what each question tells, and which mistakes have no name yet."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import StatisticsError, correlation, mean, median

from nbformat.notebooknode import NotebookNode
from nbgrader.api import MissingEntry

from autograder import questions
from autograder.judge import Question
from autograder.judge.clusters import Attempt, Cluster, cluster, is_unexplained, recall, right_answer
from autograder.judge.decode import Decoded
from dhkit.public import questions as public_questions

from ..cells import check_cells, check_record, question_id
from ..course import Course
from ..entries import read_entries
from ..errors import CourseError
from ..gradebook import stock_gradebook
from ..inert import terminal_text, without_markdown
from ..results import graded_notebooks

UNNOTED = "unnoted"
RIGHT = ("right", "right_from_earlier")
NOTHING_CAME = (
    "not_attempted", "no_answer", "error", "timeout", "output_limit", "memory", "died", "unreadable", "not_run", UNNOTED
)  # fmt: skip

# With fewer submissions a correlation says more about chance than about the question.
ENOUGH = 5
# From here on a question tells students apart, and tells them apart well.
TELLS, TELLS_WELL = 0.2, 0.4
# From here on a question is marked: this share of the class, or this many students with one and the same wrong answer.
_MANY, _ALIKE = 1 / 6, 3


@dataclass(frozen=True)
class QuestionReport:
    """One question over the class.

    Attributes
    ----------
    scores : tuple of float
        Points of each submission with an answer to any question: the others tell nothing about this one.
    notes : Counter
        Their answer notes.
    submissions : int
        All submissions, those without any answer too.
    discrimination : float or None
        Correlation of the points with those of the other questions, None where it says nothing.
    clusters : tuple of Cluster
        Wrong answers that no misconception explains, the largest cluster first.
    """

    question: str
    title: str
    max_score: float
    scores: tuple[float, ...]
    notes: Counter[str]
    submissions: int
    discrimination: float | None = None
    clusters: tuple[Cluster, ...] = ()

    @property
    def answered(self) -> int:
        return len(self.scores)

    @property
    def mean(self) -> float:
        return mean(self.scores)

    @property
    def median(self) -> float:
        return median(self.scores)

    @property
    def full(self) -> float:
        """Share of submissions with all points."""
        return sum(score >= self.max_score for score in self.scores) / len(self.scores)

    @property
    def not_attempted(self) -> float:
        """Share of submissions that left the question untouched."""
        return self.notes["not_attempted"] / len(self.scores)

    @property
    def unexplained(self) -> int:
        """Wrong answers in which no misconception was found."""
        return sum(count for note, count in self.notes.items() if is_unexplained(note))

    @property
    def alike(self) -> int:
        """Size of the largest cluster of equal wrong answers."""
        return max((cluster.size for cluster in self.clusters if cluster.alike), default=0)

    @property
    def right(self) -> Decoded | None:
        """The right answer, if some answers are unexplained and it is the same for all of them."""
        answers = {repr(attempt.right): attempt.right for cluster in self.clusters for attempt in cluster.attempts}
        return next(iter(answers.values())) if len(answers) == 1 else None

    @property
    def look_at(self) -> bool:
        """True if so many wrong answers are unexplained that a misconception may be missing."""
        return self.unexplained >= max(2, _MANY * len(self.scores)) or self.alike >= _ALIKE

    def discrimination_in_words(self) -> str:
        """What the discrimination says, in one sentence."""
        if self.answered < ENOUGH:
            return f"too few submissions with answers ({self.answered}; {ENOUGH} are needed)."
        if self.discrimination is None:
            return "no spread: everybody has the same points, here or in all other questions."
        if self.discrimination < 0:
            return (
                "turned round: those who did well elsewhere lost points here. Read the question and its answer again."
            )
        if self.discrimination < TELLS:
            return "weak: points here have little to do with points elsewhere. Too easy, too hard, or about something else."
        if self.discrimination < TELLS_WELL:
            return "fair: those who did well elsewhere did somewhat better here."
        return "good: those who did well elsewhere did well here, the others did not."


@dataclass(frozen=True)
class ClassReport:
    """One exercise over the class.

    `totals` holds the points of each submission with an answer to any question, `nothing` counts those without.
    """

    exercise: str
    totals: tuple[float, ...]
    nothing: int
    questions: tuple[QuestionReport, ...]

    @property
    def max_score(self) -> float:
        """The most points that can be had."""
        return sum(question.max_score for question in self.questions)


def discrimination(scores: Sequence[float], rests: Sequence[float]) -> float | None:
    """Corrected item-total correlation; where a question is all or nothing, the point-biserial one.

    Parameters
    ----------
    scores, rests : sequence of float
        For each submission the points of the question, and those of all other questions together.

    Returns
    -------
    float or None
        From -1 to 1; None for fewer than `ENOUGH` submissions or if one side is the same for all.
    """
    if len(scores) < ENOUGH:
        return None
    try:
        return correlation(scores, [round(rest, 6) for rest in rests])
    except StatisticsError:
        return None


def class_report(course: Course, exercise: str) -> ClassReport:
    """What the gradebook and the graded notebooks say about `exercise`; `CourseError` if nothing was graded yet."""
    course.choose(exercise)
    rows: dict[str, dict[str, tuple[float, str]]] = {}
    max_scores: dict[str, float] = {}
    with stock_gradebook(course.db_url, course.app.coursedir.course_id) as gradebook:
        try:
            submissions = gradebook.find_assignment(exercise).submissions
        except MissingEntry:
            submissions = []
        for submission in submissions:
            for entry in read_entries(submission):
                if entry.max_score > 0:
                    rows.setdefault(submission.student.id, {})[entry.check] = entry.score, entry.note or UNNOTED
                    max_scores[entry.check] = entry.max_score
    if not rows:
        raise CourseError(f"nothing was graded for {exercise} yet; run: autograder grade {exercise}")
    attempts = _attempts(course, exercise, rows)
    order = list(public_questions())
    names = sorted(
        max_scores,
        key=lambda name: (order.index(question_id(name)) if question_id(name) in order else len(order), name),
    )
    found = [_question_report(name, max_scores[name], rows, attempts.get(name, [])) for name in names]
    answered = _answered(rows)
    totals = tuple(sum(score for score, _ in row.values()) for row in answered)
    return ClassReport(exercise, totals, len(rows) - len(answered), tuple(found))


def _answered(rows: dict[str, dict]) -> list[dict]:
    """The submissions with an answer to any question; all of them where there is none, as nobody would be left."""
    found = [row for row in rows.values() if any(note not in NOTHING_CAME for _, note in row.values())]
    return found or list(rows.values())


def _question_report(name: str, max_score: float, rows: dict[str, dict], attempts: list[Attempt]) -> QuestionReport:
    rows = {student: row for student, row in rows.items() if name in row}
    answered = _answered(rows)
    scores = tuple(row[name][0] for row in answered)
    rests = [sum(score for other, (score, _) in row.items() if other != name) for row in answered]
    notes = Counter(row[name][1] for row in answered)
    question, public = _question(name), public_questions().get(question_id(name))
    return QuestionReport(
        question_id(name),
        public.title if public else name,
        max_score,
        scores,
        notes,
        len(rows),
        discrimination(scores, rests),
        cluster(question, attempts) if question else (),
    )


def _question(name: str) -> Question | None:
    try:
        return questions.find(question_id(name))
    except KeyError:
        return None


def _attempts(course: Course, exercise: str, rows: dict[str, dict[str, tuple[float, str]]]) -> dict[str, list[Attempt]]:
    """The unexplained answers of the class by question, as the graded notebooks hold them."""
    found: dict[str, list[Attempt]] = {}
    for student, row in rows.items():
        wanted = {name for name, (_, note) in row.items() if is_unexplained(note)}
        notebooks = graded_notebooks(course, student, exercise) if wanted else []
        checks = {check: cell for nb in notebooks for check, cell in check_cells(nb).items()}
        for name in sorted(wanted & checks.keys()):
            question, cell = _question(name), checks[name]
            record = check_record(cell)
            answer = recall(question_id(name), record and record.answer)
            right = right_answer(question, student) if question else None
            found.setdefault(name, []).append(Attempt(student, told(cell.outputs), answer, right))
    return found


def told(outputs: Iterable[NotebookNode]) -> str:
    """What the judge said on a check cell, without Markdown."""
    feedback = next(
        (output.data.get("text/plain", "") for output in outputs if output.output_type == "display_data"), ""
    )
    return terminal_text(without_markdown(feedback), 400)
