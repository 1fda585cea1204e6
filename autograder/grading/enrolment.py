"""``autograder roster`` and ``autograder allow``: from the lists that platforms export to ``students.csv``, and to the names in the gradebook."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path

from nbgrader.api import Student

from dhkit.variants import normal_form

from .course import Course
from .errors import CourseError
from .files import write_whole
from .folders import student_names
from .gradebook import is_made, writing
from .roster import Person, Roster, gradebook_names, read_roster, roster_text
from .term import more_time, read_term
from .worksheets import read_canvas, read_moodle

# What a platform's list settles; extensions and exemptions are the lecturer's.
_SETTLED = ("last_name", "first_name", "email", "canvas_id", "sis_user_id", "login", "section", "id_number", "groups")
# What nobody else has; platforms call the same thing by different names.
_SAME = (("canvas_id",), ("email", "login"), ("sis_user_id", "id_number"))


@dataclass(frozen=True)
class Enrolled:
    """One line of the roster, and what became of it: ``"new"``, ``"changed"``, ``"as before"`` or ``"not in the files"``."""

    person: Person
    status: str


def enrol(course: Course, files: Sequence[Path]) -> list[Enrolled]:
    """Bring ``students.csv`` up to what platforms export, and the gradebook's names to ``students.csv``.

    Raises
    ------
    CourseError
        If a file is not a list of students; nothing is changed then.
    """
    roster = read_roster(course.root)
    lines = merged(roster, [_read(file) for file in files], student_names(course.step("submitted")))
    if files:
        write_whole(roster.path, roster_text(line.person for line in lines).encode())
    if is_made(course.db_url):
        _enter_names(course, (line.person for line in lines))
    return lines


def allow(course: Course, student: str, exercise: str, until: str | None, exempt: bool) -> Person:
    """Give a student more time for an exercise, or exempt the student; with neither, take back what was given.

    Parameters
    ----------
    until : str or None
        ``+3d``, ``+12h`` or a time.
    """
    course.require(exercise)
    roster = read_roster(course.root)
    named = [one] if (one := roster.get(student)) else roster.named(student)
    if len(named) != 1:
        known = (
            ", ".join(person.id for person in named or roster.people)
            or f"nobody; make {roster.path} with autograder roster"
        )
        raise CourseError(f"{'several are' if named else 'nobody is'} called {student!r}; there are: {known}")
    (before,) = named
    others = tuple(text for text in before.extensions if text.partition("=")[0].strip() != exercise)
    spared = tuple(name for name in before.exempt if name != exercise)
    after = replace(
        before,
        extensions=(*others, f"{exercise}={until}") if until else others,
        exempt=(*spared, exercise) if exempt else spared,
    )
    if until:
        more_time(after, exercise, datetime.max, read_term(course.root))
    people = [after if person == before else person for person in roster.people]
    write_whole(roster.path, roster_text(people).encode())
    return after


def _read(file: Path) -> list[Person]:
    if (people := read_canvas(file)) is not None:
        return people
    table = read_moodle(file)
    if table is None or not ({"name", "last_name"} & table.columns.keys()):
        raise CourseError(
            f"{file} is neither Moodle's list of participants or grading worksheet nor Canvas's grade table: "
            "it has no columns for names; write First name, Surname and Email address above them"
        )
    return [person for row in table.rows if (person := table.person(row)).id]


def merged(roster: Roster, lists: Iterable[Sequence[Person]], folders: Sequence[str] = ()) -> list[Enrolled]:
    """The roster brought up to what platforms say of its people; whom it does not know comes at the end.

    Parameters
    ----------
    lists : iterable of sequence of Person
        What each list says; two lines of one list are two people.
    folders : sequence of str
        Ids under which work was collected before there was a roster: a new student keeps the own one.
    """
    people, status = list(roster.people), ["not in the files"] * len(roster.people)
    for found in lists:
        taken: set[int] = set()
        for said in found:
            place = _known(people, said, taken)
            if place is None:
                taken.add(len(people))
                people.append(replace(said, id=_new_id(said, people, folders)))
                status.append("new")
                continue
            taken.add(place)
            before = people[place]
            settled = {name: value for name in _SETTLED if (value := getattr(said, name))}
            people[place] = replace(before, **settled)
            if status[place] != "new":
                changed = people[place] != before or status[place] == "changed"
                status[place] = "changed" if changed else "as before"
    return [Enrolled(person, what) for person, what in zip(people, status, strict=True)]


def _known(people: Sequence[Person], said: Person, taken: Container[int]) -> int | None:
    """The one whom a platform speaks of: by a number or an address, else by a name that only one person has.

    Who has been spoken of, `taken`, is not meant by the name again. Where only names tell, people of one name are
    spoken of in their order.
    """
    numbers = False
    for names in _SAME:
        told = _values(said, names)
        numbers |= bool(told)
        if same := [place for place, one in enumerate(people) if told & _values(one, names)]:
            return same[0]
    named = [place for place, one in enumerate(people) if normal_form(said.id) in one.names]
    # Of the same name, but with another number or address: somebody else.
    same = [place for place in named if place not in taken and not _contradict(people[place], said)]
    return same[0] if len(same) == 1 or (same and not numbers) else None


def _values(person: Person, names: Sequence[str]) -> set[str]:
    return {normal_form(value) for name in names if (value := getattr(person, name))}


def _contradict(one: Person, other: Person) -> bool:
    pairs = ((_values(one, [name]), _values(other, [name])) for names in _SAME for name in names)
    return any(first and second and first != second for first, second in pairs)


def _new_id(said: Person, people: Sequence[Person], folders: Sequence[str]) -> str:
    taken = {normal_form(one.id) for one in people}
    for folder in folders:
        if normal_form(folder) in said.names and normal_form(folder) not in taken:
            return folder
    name = re.sub(r"[<>\"&/\\]", "", "".join(filter(str.isprintable, said.id))).strip(" .") or "student"
    ids = (name, *(f"{name} {number}" for number in range(2, len(people) + 3)))
    return next(one for one in ids if normal_form(one) not in taken)


def _enter_names(course: Course, people: Iterable[Person]) -> None:
    with writing(course.db_url) as session:
        for person in people:
            session.merge(Student(id=person.id, **gradebook_names(person)))
