"""Tables that learning platforms give out and take back, with their columns as the platforms name them.

Moodle's "grading worksheet" (``mod/assign/gradingtable.php``, read back by ``mod/assign/feedback/offline``) and its list
of participants have headings in the language of the site; Canvas's grade table (``gradebook_exporter.rb``, read back by
``gradebook_importer.rb``) has English ones.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from .errors import CourseError
from .roster import Person, Roster, read_table

# English, French, German, Spanish, Italian, Portuguese, Dutch.
_NAMES = {
    "identifier": ("identifier", "identifiant", "id", "identificador", "identificativo", "idnummer"),
    "name": ("full name", "nom complet", "vollständiger name", "nombre completo", "cognome nome", "volledige naam"),
    "first_name": ("first name", "prénom", "vorname", "nombre", "nome", "voornaam"),
    "last_name": ("last name", "surname", "nom de famille", "nom", "nachname", "apellido(s)", "apellidos", "cognome", "sobrenome", "achternaam"),
    "email": ("email address", "adresse de courriel", "e-mail-adresse", "dirección de correo", "indirizzo email", "endereço de email", "e-mailadres", "email", "courriel"),
    "id_number": ("id number", "numéro d’identification", "numéro d'identification", "id-nummer", "número de id", "codice identificativo"),
    "groups": ("groups", "group", "groupes", "groupe", "gruppen", "gruppe", "grupos", "grupo", "gruppi", "gruppo"),
    "grade": ("grade", "note", "bewertung", "calificación", "valutazione", "nota", "cijfer"),
    "maximum": ("maximum grade", "note maximale", "beste bewertung", "calificación máxima", "valutazione massima", "nota máxima", "maximumcijfer"),
    "submitted": ("last modified (submission)", "dernière modification (travail remis)", "zuletzt geändert (abgabe)", "última modificación (envío)"),
    "graded": ("last modified (grade)", "dernière modification (note)", "zuletzt geändert (bewertung)", "última modificación (calificación)"),
}  # fmt: skip
_PARTICIPANT = re.compile(r"[^\d]+(\d+)\Z")
_CANVAS = {"canvas_id": "ID", "sis_user_id": "SIS User ID", "login": "SIS Login ID", "section": "Section"}
_TIMES = ("%A, %d %B %Y, %I:%M %p", "%A, %d %B %Y, %H:%M", "%A, %B %d, %Y, %I:%M %p")


@dataclass(frozen=True)
class MoodleTable:
    """A grading worksheet or a list of participants: its rows, and the index of each column that is known."""

    path: Path
    header: list[str]
    rows: Sequence[list[str]]
    columns: dict[str, int]

    def cell(self, row: list[str], column: str) -> str:
        """What stands in a column of a row; empty if there is no such column."""
        place = self.columns.get(column)
        return row[place].strip() if place is not None and place < len(row) else ""

    def number(self, row: list[str]) -> str:
        """The number of the participant, as in the downloads of the assignment."""
        found = _PARTICIPANT.fullmatch(self.cell(row, "identifier"))
        return found[1] if found else ""

    def handed_in(self, row: list[str]) -> datetime | None:
        """When the row's work was handed in, where the worksheet says so in English."""
        for form in _TIMES:
            try:
                return datetime.strptime(self.cell(row, "submitted"), form)
            except ValueError:
                pass
        return None

    def person(self, row: list[str]) -> Person:
        """Who a row is about, with the id that the name makes."""
        first, last = self.cell(row, "first_name"), self.cell(row, "last_name")
        full = self.cell(row, "name")
        if full and not last:
            first, _, last = full.rpartition(" ")
        groups = tuple(filter(None, map(str.strip, re.split(r"[;,]", self.cell(row, "groups")))))
        email, number = self.cell(row, "email"), self.cell(row, "id_number")
        return Person(full or f"{first} {last}".strip(), last, first, email, id_number=number, groups=groups)


def read_moodle(path: Path) -> MoodleTable | None:
    """A table of Moodle's, None if the file is another one."""
    header, *rows = read_table(path) or [[]]
    plain = [name.strip().casefold() for name in header]
    columns = {
        column: plain.index(next(name for name in names if name in plain))
        for column, names in _NAMES.items()
        if any(name in plain for name in names)
    }
    table = MoodleTable(path, header, [row for row in rows if any(row)], columns)
    if not any(map(table.number, table.rows)):
        columns["identifier"] = 0  # in whatever language: Moodle puts it first, and the most points behind the grade
    if not any(map(table.number, table.rows)):
        del columns["identifier"]
    elif "grade" not in columns and (place := _same_number(table)) > 1:
        columns |= {"grade": place - 1, "maximum": place}
    known = columns.keys() >= {"last_name", "first_name"} or "name" in columns or "identifier" in columns
    return table if known else None


def _same_number(table: MoodleTable) -> int:
    """The first column in which everybody has one and the same number; 0 if there is none."""
    for place in range(1, len(table.header)):
        cells = {row[place].strip() if place < len(row) else "" for row in table.rows}
        if len(cells) == 1 and re.fullmatch(r"\d+([.,]\d+)?", cells.pop()):
            return place
    return 0


def read_canvas(path: Path) -> list[Person] | None:
    """The students of a grade table of Canvas, None if the file is another one."""
    header, *rows = read_table(path) or [[]]
    if header[:2] not in (["Student", "ID"], ["LastName", "FirstName"]):
        return None
    return [_canvas_person(dict(zip(header, row, strict=False))) for row in rows if is_canvas_student(header, row)]


def is_canvas_student(header: Sequence[str], row: Sequence[str]) -> bool:
    """False for the rows of Canvas's grade table about points, posting, and its test student."""
    cells = dict(zip(header, row, strict=False))
    return cells.get("ID", "").strip().isdigit() and cells.get("Student", "") != "Student, Test"


def canvas_numbers(cells: Mapping[str, str]) -> tuple[str, str, str, str]:
    """What a row of Canvas's grade table says of its student: ``ID``, login, SIS id, and the name."""
    person = _canvas_person(cells)
    return person.canvas_id, person.login, person.sis_user_id, person.name


def _canvas_person(cells: Mapping[str, str]) -> Person:
    if "Student" in cells:
        last, _, first = (part.strip() for part in cells["Student"].partition(","))
    else:
        last, first = cells["LastName"].strip(), cells["FirstName"].strip()
    numbers: dict[str, Any] = {name: cells.get(column, "").strip() for name, column in _CANVAS.items()}
    return Person(f"{first} {last}".strip(), last, first, **numbers)


def people_of_numbers(worksheets: Sequence[Path], roster: Roster) -> dict[str, tuple[Person, datetime | None]]:
    """Who the participants of an assignment are, by their numbers in its grading worksheets, and when they handed in."""
    found: dict[str, tuple[Person, datetime | None]] = {}
    for path in worksheets:
        table = read_moodle(path)
        if table is None or "identifier" not in table.columns:
            raise CourseError(f"{path} is no grading worksheet of Moodle: it has no column of participants' numbers")
        for row in table.rows:
            said = table.person(row)
            known = _on_roster(said, roster)
            if (number := table.number(row)) and (known or said.id):
                found[number] = (known or said, table.handed_in(row))
    return found


def _on_roster(said: Person, roster: Roster) -> Person | None:
    """The one student of the roster whom a table speaks of: by address and numbers first, names may be shared."""
    for text in (said.email, said.id_number, said.id):
        if len(found := roster.named(text)) == 1:
            return found[0]
    return None
