"""Who is in the course: ``students.csv``, one line per student, read and written here and nowhere else.

The file is a table that a spreadsheet opens. Only the column ``id`` is needed; it is what students type into their
notebooks, the name of their folder in ``submitted/`` and their id in the gradebook. Ids, names and addresses are
compared in the normal form of ids, so that accents, case, blanks and apostrophes never matter.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from pathlib import Path
from typing import Any

from dhkit.variants import normal_form

from .encodings import decoded
from .errors import CourseError
from .folders import why_unusable
from .inert import from_spreadsheet, spreadsheet_cell

FILE = "students.csv"
_LONGEST_CELL = 16 << 20
_WORKBOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")
# What Excel wants to be told in the first line, and keeps to itself when it reads.
_SEPARATOR = re.compile(r"sep=(.)[;,\t]*\r?\n", re.IGNORECASE)
_LISTS = ("groups", "extensions", "exempt")


@dataclass(frozen=True)
class Person:
    """A student of the course.

    Attributes
    ----------
    id : str
        As typed into notebooks; the name of the folder in ``submitted/``.
    last_name, first_name, email : str
        For lists and the gradebook.
    canvas_id : str
        Canvas's number of the user, which stands in its downloads and grade tables.
    sis_user_id, login, section : str
        What Canvas's grade table says beside it.
    id_number : str
        Moodle's "ID number".
    groups : tuple of str
        Groups of the platform.
    extensions : tuple of str
        More time: ``scara=2026-10-20 23:59`` or ``scara=+3d``.
    exempt : tuple of str
        Exercises that do not count for this student.
    """

    id: str
    last_name: str = ""
    first_name: str = ""
    email: str = ""
    canvas_id: str = ""
    sis_user_id: str = ""
    login: str = ""
    section: str = ""
    id_number: str = ""
    groups: tuple[str, ...] = ()
    extensions: tuple[str, ...] = ()
    exempt: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The name in full, as one says it; the id where no name is known."""
        return f"{self.first_name} {self.last_name}".strip() or self.id

    @cached_property
    def names(self) -> frozenset[str]:
        """The normal forms of everything a platform may call this student."""
        said = (self.id, f"{self.first_name} {self.last_name}", f"{self.last_name} {self.first_name}")
        more = (self.email, self.login, self.sis_user_id, self.id_number)
        return frozenset(normal_form(text) for text in (*said, *more) if text.strip())


COLUMNS = tuple(column.name for column in fields(Person))


@dataclass(frozen=True)
class Roster:
    """The students of a course; without any where there is no file."""

    people: tuple[Person, ...] = ()
    path: Path = field(default=Path(FILE), compare=False)

    @cached_property
    def _by_name(self) -> dict[str, list[Person]]:
        found: dict[str, list[Person]] = {}
        for person in self.people:
            for name in person.names:
                found.setdefault(name, []).append(person)
        return found

    def named(self, text: str) -> list[Person]:
        """Those whose id, name, address or number this is."""
        return self._by_name.get(normal_form(text), []) if text.strip() else []

    def with_canvas_id(self, number: str) -> Person | None:
        """The student with this number on Canvas."""
        return next((person for person in self.people if number and person.canvas_id == number), None)

    def of_group(self, name: str) -> list[Person]:
        """The members of a group."""
        wanted = normal_form(name)
        return [person for person in self.people if wanted in map(normal_form, person.groups)]

    def get(self, id: str) -> Person | None:
        """The student with this very id."""
        return next((person for person in self.people if person.id == id), None)


def read_roster(root: Path) -> Roster:
    """The roster of the course in `root`; an empty one if there is none.

    Raises
    ------
    CourseError
        If the file makes no sense; the message names the line.
    """
    path = root / FILE
    if not path.exists():
        return Roster((), path)
    rows = read_table(path)
    header = [name.strip().casefold().replace(" ", "_") for name in rows[0]] if rows else []
    if "id" not in header:
        raise CourseError(
            f"{path} needs a first line with names of columns, one of them id; known: {', '.join(COLUMNS)}"
        )
    people: list[Person] = []
    seen: dict[str, str] = {}
    for number, row in enumerate(rows[1:], 2):
        cells = dict(zip(header, row, strict=False))
        if not any(cells.values()):
            continue
        person = _person(cells)
        if not person.id or (why := why_unusable(person.id)):
            why = why.replace("the folder's name", "the id") if person.id and why else "the id is missing"
            raise CourseError(f"{path}, line {number}: {why}")
        form = normal_form(person.id)
        if form in seen:
            raise CourseError(
                f"{path}, line {number}: the id {person.id} is the same as {seen[form]}'s, for notebooks; change one"
            )
        seen[form] = person.id
        people.append(person)
    return Roster(tuple(people), path)


def _person(cells: dict[str, str]) -> Person:
    values: dict[str, Any] = {name: from_spreadsheet(cells.get(name, "").strip()) for name in COLUMNS}
    for name in _LISTS:
        values[name] = tuple(filter(None, map(str.strip, values[name].split(";"))))
    return Person(**values)


def gradebook_names(person: Person) -> dict[str, str | None]:
    """What nbgrader's table of students holds beside the id."""
    return {name: getattr(person, name) or None for name in ("last_name", "first_name", "email")}


def roster_text(people: Iterable[Person]) -> str:
    """The roster as the text of its file."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(COLUMNS)
    for person in people:
        values = (getattr(person, name) for name in COLUMNS)
        writer.writerow(spreadsheet_cell("; ".join(value) if isinstance(value, tuple) else value) for value in values)
    return file.getvalue()


def read_table(path: Path) -> Sequence[list[str]]:
    """The rows of a table of text, as spreadsheets and platforms write them: UTF-8 or UTF-16 or Windows-1252, with
    commas, semicolons or tabs.

    Raises
    ------
    CourseError
        If there is no such file, or it is no table.
    """
    if not path.is_file():
        raise CourseError(f"there is no {path}")
    content = path.read_bytes()
    if content.startswith(_WORKBOOKS):
        raise CourseError(f"{path} is a workbook or a zip; save it as CSV")
    text = decoded(content)
    if told := _SEPARATOR.match(text):
        text = text[told.end() :]
    csv.field_size_limit(_LONGEST_CELL)  # a worksheet may hold whole texts that students typed
    try:
        return list(csv.reader(io.StringIO(text, newline=""), delimiter=told[1] if told else delimiter(text)))
    except csv.Error as error:
        raise CourseError(f"{path} is no table: {error}") from None


def delimiter(text: str) -> str:
    """What stands between the columns of a table: the most frequent in its first line."""
    first = text.partition("\n")[0]
    return max(",;\t", key=first.count)
