"""The term as gradebook, roster, receipts and notebooks tell it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime

from dhkit.public import questions as public_questions
from dhkit.variants import normal_form

from ..cells import answer_id, check_id, question_id
from ..collecting.receipts import read_receipts, receipts_folder, teams
from ..course import Course
from ..entries import note_of
from ..errors import CourseError
from ..gradebook import reading
from ..inert import terminal_text
from ..report.statistics import UNNOTED
from ..roster import Person, Roster, read_roster
from ..store import StoredNotebook, stored_notebooks
from ..submission.reading import MAX_FILE, Unreadable, cell_metadata, plain_bytes
from ..term import deadlines, more_time, read_term
from .answers import Sheet, follows, read_sheets, wrong_answers
from .likeness import Pair, pairs_alike
from .minutes import Minutes, spent, summary
from .standing import OTHERS_NUMBERS, Answer, Exercise, Staying, Student, Work, falling_behind, of_class, staying


@dataclass(frozen=True)
class Borrowed:
    """Answers that are right for another student's numbers, whose id was typed at the top of the notebook."""

    student: str
    typed: str
    questions: tuple[str, ...]


@dataclass(frozen=True)
class Overview:
    """The term at a glance.

    Attributes
    ----------
    exercises : tuple of Exercise
        Those for which anything was graded, by due date, else in the order of the lectures.
    behind : dict
        By student, why one should talk to them.
    pairs : tuple of Pair
        Students with equal wrong answers that chance does not explain; `sources` holds what they typed, by student
        and question.
    """

    exercises: tuple[Exercise, ...]
    students: tuple[Student, ...]
    behind: dict[str, tuple[str, ...]]
    staying: tuple[Staying, ...]
    minutes: tuple[Minutes, ...]
    pairs: tuple[Pair, ...]
    borrowed: tuple[Borrowed, ...]
    sources: dict[tuple[str, str], str]


def overview(course: Course, now: datetime) -> Overview:
    """The term as it stands; `now`, in UTC, says whose time is not over yet.

    Raises
    ------
    CourseError
        If nothing was graded yet.
    """
    roster = read_roster(course.root)
    stored = {name: found for name in _in_order(course) if (found := _stored(course, name))}
    if not stored:
        raise CourseError("nothing was graded yet; run: autograder grade")
    graded: dict[str, dict[str, Work]] = {name: {} for name in stored}
    sheets: dict[tuple[str, str], Sheet] = {}
    borrowed: list[Borrowed] = []
    for name, notebooks in stored.items():
        for student, one in notebooks.items():
            work = _graded(name, one)
            mine, typed = read_sheets(course, student, work)
            graded[name][student] = replace(work, answers=tuple(_as_told(answer, mine) for answer in work.answers))
            sheets |= {(student, question): sheet for question, sheet in mine.items()}
            borrowed += _borrowed(student, typed, work)
    everybody = {person.id for person in roster.people}.union(
        *graded.values(), *(_known(course, one) for one in graded)
    )
    works = {name: _completed(course, name, found, roster, everybody, now) for name, found in graded.items()}
    students = tuple(
        Student(id, name, tuple(one[id] for one in works.values())) for id, name in _people(works, roster).items()
    )
    exercises = tuple(of_class(name, (work for student in students for work in student.works)) for name in works)
    behind = {student.id: signs for student in students if (signs := falling_behind(student, exercises))}
    pairs = pairs_alike(wrong_answers(works, sheets), follows(works))
    shown = {(student, one.question) for pair in pairs for one in pair.shared for student in pair.students}
    return Overview(
        exercises,
        students,
        behind,
        tuple(staying(students, list(works))),
        tuple(_minutes(course, works)),
        tuple(pairs),
        tuple(borrowed),
        {key: sheets[key].source for key in shown if key in sheets},
    )


def _in_order(course: Course) -> list[str]:
    term = read_term(course.root)
    lectures = [path.stem.partition("_")[2] for path in sorted((course.root / "course").glob("*.ipynb"))]

    def place(name: str) -> tuple:
        due = term.utc(term.due[name]) if name in term.due else datetime.max
        return due, lectures.index(name) if name in lectures else len(lectures), name

    return sorted(course.exercises(), key=place)


def _stored(course: Course, exercise: str) -> dict[str, StoredNotebook]:
    """What was graded of an exercise, by student."""
    with reading(course.db_url) as session:
        found = stored_notebooks(session, exercise)
    return {student: one for (student, _), one in found.items() if one.mark is not None}


def _graded(exercise: str, stored: StoredNotebook) -> Work:
    order = list(public_questions())
    answers = [
        Answer(question_id(check), grade.score, grade.max_score, _note(stored, check))
        for check, grade in stored.grades.items()
        if grade.cell_type == "code"
    ]
    answers.sort(key=lambda one: (order.index(one.question) if one.question in order else len(order), one.question))
    bonus = (f"{stored.bonus:g} extra",) if stored.bonus else ()
    score = max(0.0, stored.score - stored.penalty)
    return Work(exercise, "graded", score, stored.max_score, tuple(answers), stored.lateness, remarks=bonus)


def _note(stored: StoredNotebook, check: str) -> str:
    found = stored.comments.get(answer_id(check))
    return (note_of(found.auto) if found else None) or UNNOTED


def _as_told(answer: Answer, sheets: Mapping[str, Sheet]) -> Answer:
    sheet = sheets.get(answer.question)
    return replace(answer, told=sheet.told) if sheet else answer


def _borrowed(student: str, typed: str | None, work: Work) -> list[Borrowed]:
    others = tuple(answer.question for answer in work.answers if answer.note == OTHERS_NUMBERS)
    if not others or not typed or normal_form(typed) == normal_form(student):
        return []
    return [Borrowed(student, terminal_text(typed, 80), others)]


def _known(course: Course, exercise: str) -> set[str]:
    """Who handed in anything for an exercise, graded or not."""
    return {*read_receipts(receipts_folder(course.root, exercise)), *course.students(exercise)}


def _completed(
    course: Course, exercise: str, graded: Mapping[str, Work], roster: Roster, everybody: Iterable[str], now: datetime
) -> dict[str, Work]:
    """The exercise for everybody: also for members of teams, who is exempt, has time left, or is missing."""
    receipts, handed_in = read_receipts(receipts_folder(course.root, exercise)), set(course.students(exercise))
    in_teams = teams(receipts, roster, graded)
    nothing = Work(exercise, "missing", max_score=max((work.max_score for work in graded.values()), default=0.0))
    found = {}
    for id in everybody:
        person, team, receipt = roster.get(id), in_teams.get(id), receipts.get(id)
        if person and exercise in person.exempt:
            found[id] = replace(nothing, status="exempt")
        elif id in graded:
            found[id] = graded[id]
        elif team and team in graded:
            found[id] = replace(graded[team], team=team)
        elif id in handed_in:
            found[id] = replace(nothing, status="not graded")
        elif receipt and receipt.missing:
            found[id] = replace(nothing, status="no notebook", remarks=(terminal_text(receipt.missing, 120),))
        elif _has_time(course, exercise, person, now):
            found[id] = replace(nothing, status="open")
        else:
            found[id] = nothing
    return found


def _has_time(course: Course, exercise: str, person: Person | None, now: datetime) -> bool:
    dates = deadlines(course.root, exercise)
    if dates.due is None:
        return False
    more = more_time(person, exercise, dates.due, dates.term) if person else None
    return now < dates.due + more if more else now < dates.due


def _people(works: Mapping[str, Mapping[str, Work]], roster: Roster) -> dict[str, str]:
    """Everybody, with names: the roster, and who handed in without being on it; no teams, whose members have lines."""
    found = {person.id: person.name for person in roster.people}
    in_teams = {work.team for one in works.values() for work in one.values()}
    others = {id for one in works.values() for id in one} - found.keys() - in_teams
    found |= {id: id for id in others}
    return dict(sorted(found.items(), key=lambda item: (item[0].casefold(), item[0])))


def _minutes(course: Course, works: Mapping[str, Mapping[str, Work]]) -> list[Minutes]:
    public = public_questions()
    measured = []
    for exercise, one in works.items():
        expected = [name for name in public if name.startswith(f"{exercise}.")]
        checks = [check_id(name) for name in expected]
        for student, work in one.items():
            if work.status != "graded" or work.team:
                continue
            try:
                content = plain_bytes(course.step("submitted", student, exercise) / f"{exercise}.ipynb", MAX_FILE)
            except (Unreadable, OSError):
                continue
            if b'"shell.execute_reply"' in content or b'"executionInfo"' in content:
                measured.append(
                    {question_id(check): took for check, took in spent(cell_metadata(content), checks).items()}
                )
    minutes = {name: question.minutes for one in works for name, question in public.items() if question.exercise == one}
    return summary(minutes, measured)
