"""``autograder return``: grades and feedback pages as Moodle and Canvas take them back.

* Moodle's "upload multiple feedback files in a zip" (``mod/assign/feedback/file/importziplib.php``) finds a person by the
  number in ``<name>_<number>_assignsubmission_file_/``. Its grading worksheet (``feedback/offline``) is read with commas in
  UTF-8; a grade above the maximum is passed over there, so it is cut, and that is said.
* Canvas's grade table (``gradebook_importer.rb``) finds a person by ``ID``, and an assignment by the number behind its name;
  ``EX`` excuses. Its upload of graded submissions finds them by the two numbers in ``<name>_<user>_<file>_``.
"""

from __future__ import annotations

import csv
import io
import re
import zipfile
from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from dhkit.variants import normal_form

from .collecting.receipts import Receipt, read_receipts, receipts_folder, teams
from .course import Course, convert
from .errors import CourseError
from .files import staged
from .gradebook import GradebookError, reading
from .plugins.feedback import FeedbackPages
from .roster import Person, Roster, read_roster, read_table
from .store import StoredNotebook, stored_notebooks
from .worksheets import MoodleTable, canvas_numbers, is_canvas_student, people_of_numbers, read_moodle

# One date for all entries: the same grades make the same zip.
_EPOCH = (1980, 1, 1, 0, 0, 0)
_HUNDREDTH = 0.005


@dataclass(frozen=True)
class Grade:
    """What a student has for an exercise; the bonus is part of the score, and the penalty is taken off it."""

    score: float
    bonus: float
    penalty: float
    max_score: float

    @classmethod
    def of(cls, notebooks: Iterable[StoredNotebook]) -> Grade:
        found = list(notebooks)
        penalty = sum(one.penalty for one in found)
        return cls(
            max(0.0, sum(one.score for one in found) - penalty),
            sum(one.bonus for one in found),
            penalty,
            sum(one.max_score for one in found),
        )


@dataclass(frozen=True)
class Returned:
    """One line of what goes back: the points as the platform gets them, None if none go."""

    student: str
    points: float | None
    remarks: tuple[str, ...] = ()


@dataclass
class _Class:
    """What is known of everybody who is to get something back."""

    exercise: str
    grades: dict[str, Grade]
    pages: dict[str, Path]
    receipts: dict[str, Receipt]
    roster: Roster
    remarks: dict[str, list[str]] = field(default_factory=dict)

    def remark(self, student: str, said: str) -> None:
        self.remarks.setdefault(student, []).append(said)

    @cached_property
    def teams(self) -> dict[str, str]:
        """The groups that handed in together, by the ids of their members who did not hand in alone and are not exempt."""
        exempt = {person.id for person in self.roster.people if self.is_exempt(person.id)}
        return teams(self.receipts, self.roster, self.grades.keys() | exempt)

    def called(self, text: str) -> str | None:
        """The one who was graded under this id, however it is written."""
        found = [student for student in self.grades if normal_form(student) == normal_form(text)]
        return found[0] if len(found) == 1 else None

    def is_exempt(self, student: str) -> bool:
        person = self.roster.get(student)
        return person is not None and self.exercise in person.exempt

    def points(self, student: str, maximum: float | None, scale: bool) -> float | None:
        """Points as the platform counts them, by its own maximum; None where there are none to give."""
        grade = self.grades.get(student)
        if grade is None or self.is_exempt(student):
            return None
        points = grade.score
        if maximum is not None and grade.max_score and abs(maximum - grade.max_score) > _HUNDREDTH:
            if not scale:
                raise CourseError(
                    f"{self.exercise} has {grade.max_score:g} points, the assignment {maximum:g}; "
                    "change it there, or say --scale"
                )
            points *= maximum / grade.max_score
        return round(points, 2)


def return_moodle(course: Course, exercise: str, worksheet: Path | None, folder: Path, scale: bool) -> list[Returned]:
    """Write the zip of feedback files, and the grading worksheet filled in, into `folder`.

    Parameters
    ----------
    worksheet : Path or None
        As downloaded from the assignment; without it there are feedback files only.
    scale : bool
        Whether points are counted in the assignment's own maximum where it is another one.
    """
    known = _class(course, exercise)
    table = read_moodle(worksheet) if worksheet else None
    if worksheet and (table is None or not {"identifier", "grade"} <= table.columns.keys()):
        raise CourseError(
            f"{worksheet} is no grading worksheet: it has no column for participants' numbers or for grades"
        )
    owners = _owners_on_moodle(known, table)
    prefixes = _prefixes(known, table)
    pages = {
        f"{prefixes[number]}_/{exercise}.html": student for number, student in owners.items() if student in known.pages
    }
    files = {f"{exercise}-feedback.zip": _feedback_zip(known, pages)}
    points: dict[str, float | None] = {student: grade.score for student, grade in known.grades.items()}
    if table is not None:
        points = {}
        files[f"{exercise}-grades.csv"] = _filled_in(table, owners, known, scale, points)
    return _write(known, folder, files, points, set(pages.values()))


def return_canvas(
    course: Course, exercise: str, grades: Path, assignment: str | None, folder: Path, scale: bool
) -> list[Returned]:
    """Write Canvas's grade table with the points of one assignment, and the zip of feedback files, into `folder`.

    Parameters
    ----------
    grades : Path
        The grade table as exported.
    assignment : str or None
        Its column; None if the exercise's name stands in it.
    """
    known = _class(course, exercise)
    header, *rows = read_table(grades) or [[]]
    if header[:2] not in (["Student", "ID"], ["LastName", "FirstName"]) or "Section" not in header:
        raise CourseError(f"{grades} is no grade table of Canvas: its first columns are not Student and ID")
    column = _assignment_column(header, exercise, assignment)
    about = header.index("Section") + 1
    possible = next((row for row in rows if "Points Possible" in row[0]), [])
    maximum = _number(possible[column]) if column < len(possible) else None
    numbers = {
        one.number: student for student, one in known.receipts.items() if one.platform == "canvas" and one.number
    }
    points: dict[str, float | None] = {}
    kept = []
    for row in rows:
        if not is_canvas_student(header, row):
            continue
        student = _owner_on_canvas(header, row, known, numbers)
        points[student] = known.points(student, maximum, scale)
        if known.is_exempt(student):
            kept.append([*row[:about], "EX"])
        elif (found := points[student]) is not None:
            kept.append([*row[:about], f"{found:g}"])
    table = [[*header[:about], header[column]], *([[*possible[:about], possible[column]]] if possible else []), *kept]
    pages = {
        f"{one.prefix}_{one.upload}_{exercise}.html": student
        for student, one in known.receipts.items()
        if one.platform == "canvas" and one.upload and student in known.pages
    }
    files = {f"{exercise}-grades.csv": _csv(table, b""), f"{exercise}-feedback.zip": _feedback_zip(known, pages)}
    return _write(known, folder, files, points, set(pages.values()))


def _class(course: Course, exercise: str) -> _Class:
    course.choose(exercise)
    with reading(course.db_url) as session:
        stored = stored_notebooks(session, exercise)
    graded: dict[str, list[StoredNotebook]] = {}
    for (student, _), one in stored.items():
        if one.mark is not None:
            graded.setdefault(student, []).append(one)
    if not graded:
        raise CourseError(f"nothing was graded for {exercise} yet; run: autograder grade {exercise}")
    converter = FeedbackPages(
        coursedir=course.app.coursedir, parent=course.app, students=tuple(sorted(graded)), force=False
    )
    try:
        convert(converter)
    except GradebookError:
        raise
    except CourseError:
        if not converter.failures:
            raise
    fit = graded.keys() - converter.failures.keys()
    pages = {student: course.step("feedback", student, exercise) / f"{exercise}.html" for student in fit}
    return _Class(
        exercise,
        {student: Grade.of(found) for student, found in graded.items()},
        {student: page for student, page in pages.items() if page.is_file()},
        read_receipts(receipts_folder(course.root, exercise)),
        read_roster(course.root),
        {student: [f"no feedback file: {reason}"] for student, reason in converter.failures.items()},
    )


def _owners_on_moodle(known: _Class, table: MoodleTable | None) -> dict[str, str]:
    """Students' ids by the numbers of the participants.

    A group's number in a download is no participant's: its members are found by their names.
    """
    collected = {
        one.number: student for student, one in known.receipts.items() if one.platform == "moodle" and one.number
    }
    if table is None:
        return {number: student for number, student in collected.items() if student not in known.teams.values()}
    owners: dict[str, str] = {}
    named: dict[str, list[str]] = {}
    people = people_of_numbers([table.path], known.roster)
    for number, (person, _) in people.items():
        student = collected.get(number)
        if student and _fits(known.receipts[student], person):
            owners[number] = student
        elif team := known.teams.get(person.id):
            owners[number] = team
        elif student := known.called(person.id):
            named.setdefault(student, []).append(number)
    # Where two have the name, it does not say which of them it is.
    alone = {
        numbers[0]: student
        for student, numbers in named.items()
        if len(numbers) == 1 and student not in owners.values()
    }
    numbers = collected.keys() & set(map(table.number, table.rows)) - people.keys()
    unnamed = {number: collected[number] for number in numbers if collected[number] not in known.teams.values()}
    return {**unnamed, **alone, **owners}


def _fits(receipt: Receipt, person: Person) -> bool:
    """Whether a number of a download and one of a worksheet are the same person's, as far as names tell."""
    return not receipt.name or normal_form(receipt.name) in person.names


def _prefixes(known: _Class, table: MoodleTable | None) -> dict[str, str]:
    """What Moodle writes before the names of files, by the numbers of the participants."""
    collected = {one.number: one.prefix for one in known.receipts.values() if one.platform == "moodle" and one.prefix}
    if table is None:
        return collected
    names = {table.number(row): table.cell(row, "name") or "Participant" for row in table.rows}
    plain = {number: re.sub(r"[&<>\"'`|:\\/_]", " ", name) for number, name in names.items() if number}
    return collected | {number: f"{name}_{number}_assignsubmission_file" for number, name in plain.items()}


def _owner_on_canvas(header: Sequence[str], row: Sequence[str], known: _Class, numbers: Mapping[str, str]) -> str:
    """The id of the student whom a row of Canvas's table is about; the name there if nobody is known by it."""
    cells = dict(zip(header, row, strict=False))
    number, *texts = canvas_numbers(cells)
    if number in numbers:
        return numbers[number]
    if person := known.roster.with_canvas_id(number):
        return known.teams.get(person.id, person.id)
    for text in texts:
        if len(found := known.roster.named(text)) == 1:
            return known.teams.get(found[0].id, found[0].id)
        if student := known.called(text):
            return student
    return texts[0]


def _assignment_column(header: Sequence[str], exercise: str, assignment: str | None) -> int:
    after = header.index("Section") + 1
    wanted = normal_form(assignment or exercise)
    names = [name for name in header[after:] if re.search(r"\(\d+\)\Z", name)]
    found = [name for name in names if wanted == normal_form(name)] or [
        name for name in names if wanted in normal_form(name)
    ]
    if len(found) != 1:
        which = "several columns fit" if found else "no column fits"
        raise CourseError(
            f"{which} {assignment or exercise}; say --assignment with one of: {'; '.join(found or names)}"
        )
    return header.index(found[0])


def _filled_in(
    table: MoodleTable, owners: Mapping[str, str], known: _Class, scale: bool, points: dict[str, float | None]
) -> bytes:
    """The worksheet with the grades that are there; every other cell as it was."""
    place = table.columns["grade"]
    rows = []
    for row in table.rows:
        cells = list(row)
        student = owners.get(table.number(row))
        said = table.cell(row, "maximum")
        maximum = _number(said)
        found = known.points(student, maximum, scale) if student else None
        if student and found is not None and place < len(cells):
            if maximum is not None and found > maximum:
                known.remark(student, f"{found:g} is more than Moodle takes; the bonus is cut at {maximum:g}")
                found = maximum
            points[student] = found
            cells[place] = f"{found:.2f}".replace(".", "," if "," in said else ".")
        rows.append(cells)
    return _csv(
        [table.header, *rows], "\ufeff".encode() if table.path.read_bytes().startswith(b"\xef\xbb\xbf") else b""
    )


def _number(text: str) -> float | None:
    """A number with a point or a comma, None if it is none."""
    try:
        return float(text.strip().replace(",", "."))
    except ValueError:
        return None


def _csv(rows: Iterable[Iterable[str]], start: bytes) -> bytes:
    file = io.StringIO(newline="")
    csv.writer(file, lineterminator="\r\n").writerows(rows)
    return start + file.getvalue().encode()


def _feedback_zip(known: _Class, entries: Mapping[str, str]) -> bytes:
    """The feedback pages of students, by the names under which the platform finds them."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, student in sorted(entries.items()):
            content = known.pages[student].read_bytes()
            archive.writestr(zipfile.ZipInfo(name, _EPOCH), content, zipfile.ZIP_DEFLATED)
    return file.getvalue()


def _write(
    known: _Class, folder: Path, files: Mapping[str, bytes], points: Mapping[str, float | None], reached: Container[str]
) -> list[Returned]:
    """Write what goes back, and say of everybody who was graded or handed in something what that is."""
    with staged(folder, files, 0o644) as put_in_place:
        put_in_place()
    everybody = {*known.grades, *points, *known.receipts, *(person.id for person in known.roster.people)}
    lines = []
    for student in sorted(everybody, key=lambda name: (name.casefold(), name)):
        remarks = known.remarks.get(student, [])
        receipt = known.receipts.get(student)
        if known.is_exempt(student):
            remarks.append("exempt")
        elif student in known.grades and points.get(student) is None:
            remarks.append("graded, but not found on the platform")
        if student in known.pages and student not in reached:
            remarks.append("no feedback file: the platform's number is not known; collect its download")
        if student not in known.grades and not remarks:
            remarks.append(receipt.missing if receipt and receipt.missing else "not graded")
        if (grade := known.grades.get(student)) and grade.bonus:
            remarks.append(f"{grade.bonus:g} of them extra")
        if grade and grade.penalty:
            remarks.append(f"late: {grade.penalty:g} points taken off")
        lines.append(Returned(student, points.get(student), tuple(remarks)))
    return lines
