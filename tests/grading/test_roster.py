"""Lists of students as Moodle and Canvas export them become one roster, whatever is done to it in between."""

from dataclasses import replace

import pytest
from nbgrader.api import Student

from autograder import cli
from autograder.grading.course import open_course
from autograder.grading.enrolment import _read, merged
from autograder.grading.errors import CourseError
from autograder.grading.gradebook import reading
from autograder.grading.roster import Person, Roster, read_roster, roster_text
from autograder.grading.worksheets import read_canvas, read_moodle

PARTICIPANTS = """"First name","Last name","ID number","Email address",Groups
Ada,Lovelace,s-1,ada@x.org,"Team 1, Tuesday"
José,García,s-2,jose1@x.org,
José,García,s-3,jose2@x.org,
Zoë,"O'Brien",s-4,zoe@x.org,
"""
WORKSHEET = """Identifiant,Nom complet,Numéro d’identification,Adresse de courriel,Statut,Note,Note maximale,La note peut être modifiée,Dernière modification (travail remis),Dernière modification (note)
Participant 4711,Ada Lovelace,s-1,ada@x.org,Remis,"18,50","20,00",Oui,"lundi 12 octobre 2026, 10:23",-
Participant 4712,Zoë O'Brien,s-4,zoe@x.org,,,"20,00",Oui,-,-
"""
GRADES = """Student,ID,SIS User ID,SIS Login ID,Section,Exercise 4: SCARA (2217),Final Score
,,,,,Manual Posting,
    Points Possible,,,,,20,(read only)
"Lovelace, Ada",3143,S1,ada@x.org,Section A,,0
"García, José",3150,S2,jose1@x.org,Section A,,0
"Student, Test",3999,,a94a8fe5ccb19ba61c4c0873d391e987982fbbd3,Section A,,0
"""


def saved(folder, name, text, encoding="utf-8"):
    path = folder / name
    path.write_bytes(text.encode(encoding))
    return path


def table(people):
    return Roster(tuple(people))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_participants_of_moodle_in_any_usual_form(tmp_path, encoding, delimiter):
    text = PARTICIPANTS.replace(",", delimiter).replace(f"Team 1{delimiter}", "Team 1,")
    found = read_moodle(saved(tmp_path, "participants.csv", text, encoding))
    people = [found.person(row) for row in found.rows]
    assert [person.id for person in people] == ["Ada Lovelace", "José García", "José García", "Zoë O'Brien"]
    assert people[0] == Person(
        "Ada Lovelace", "Lovelace", "Ada", "ada@x.org", id_number="s-1", groups=("Team 1", "Tuesday")
    )


def test_a_worksheet_in_another_language(tmp_path):
    found = read_moodle(saved(tmp_path, "worksheet.csv", WORKSHEET))
    assert [found.number(row) for row in found.rows] == ["4711", "4712"]
    assert found.cell(found.rows[0], "grade") == "18,50" and found.cell(found.rows[0], "maximum") == "20,00"
    assert found.person(found.rows[1]).email == "zoe@x.org"


def test_a_worksheet_with_long_texts(tmp_path):
    text = f'Identifier,Full name,Online text,Grade\nParticipant 1,Ada Lovelace,"{"x" * 200_000}",\n'
    assert read_moodle(saved(tmp_path, "worksheet.csv", text)).rows[0][1] == "Ada Lovelace"


def test_a_grade_table_of_canvas_without_its_other_rows(tmp_path):
    people = read_canvas(saved(tmp_path, "grades.csv", GRADES, "utf-8-sig"))
    assert people == [
        Person("Ada Lovelace", "Lovelace", "Ada", "", "3143", "S1", "ada@x.org", "Section A"),
        Person("José García", "García", "José", "", "3150", "S2", "jose1@x.org", "Section A"),
    ]


def test_the_roster_survives_its_own_file(tmp_path):
    people = (
        Person("ada", "Lovelace", "Ada", groups=("a", "b"), extensions=("scara=+3d",)),
        Person("=x, y", exempt=("tables",)),
    )
    saved(tmp_path, "students.csv", roster_text(people), "utf-8-sig")
    assert read_roster(tmp_path).people == people
    assert '\n"\'=x, y",' in roster_text(people), "a spreadsheet takes no name for a formula"


def test_two_platforms_make_one_line_and_the_lecturers_columns_stay(tmp_path):
    moodle = read_moodle(saved(tmp_path, "participants.csv", PARTICIPANTS))
    first = merged(Roster(), [[moodle.person(row) for row in moodle.rows]])
    assert [(line.person.id, line.status) for line in first] == [
        ("Ada Lovelace", "new"), ("José García", "new"), ("José García 2", "new"), ("Zoë O'Brien", "new")
    ]  # fmt: skip
    people = [
        replace(line.person, id="ada", extensions=("scara=+3d",)) if line.person.id == "Ada Lovelace" else line.person
        for line in first
    ]
    second = merged(table(people), [read_canvas(saved(tmp_path, "grades.csv", GRADES))])
    ada, jose, other, _ = second
    assert (ada.person.id, ada.person.canvas_id, ada.person.email, ada.person.extensions) == (
        "ada",
        "3143",
        "ada@x.org",
        ("scara=+3d",),
    )
    assert (jose.person.canvas_id, jose.person.id, other.person.canvas_id) == ("3150", "José García", "")
    assert [line.status for line in second] == ["changed", "changed", "not in the files", "not in the files"]
    third = merged(table([line.person for line in second]), [read_canvas(saved(tmp_path, "grades.csv", GRADES))])
    assert [line.person for line in third] == [line.person for line in second]
    assert {line.status for line in third} == {"as before", "not in the files"}


def test_who_was_collected_before_there_was_a_roster_keeps_the_id():
    found = merged(Roster(), [[Person("Ada Lovelace", "Lovelace", "Ada", canvas_id="3143")]], ["lovelaceada", "x"])
    assert found[0].person.id == "lovelaceada"


@pytest.mark.parametrize(
    "text, said",
    [
        ("name\nada\n", "names of columns, one of them id"),
        ("id\nada\n\n ADA'\n", "line 4: the id ADA' is the same as ada's"),
        ("id,email\n,ada@x.org\n", "line 2: the id is missing"),
        ("id\n.ada\n", "line 2: the id starts with a dot"),
        ("PK\x03\x04", "save it as CSV"),
    ],
)
def test_a_roster_that_makes_no_sense_is_refused_with_its_line(tmp_path, text, said):
    saved(tmp_path, "students.csv", text)
    with pytest.raises(CourseError, match=said):
        read_roster(tmp_path)


def test_the_command_enters_names_into_the_gradebook(course_copy, tmp_path, capsys):
    path = saved(tmp_path, "participants.csv", PARTICIPANTS)
    assert cli.main(["roster", str(path), "--course", str(course_copy)]) == 0
    assert "4 new" in capsys.readouterr().out
    with reading(open_course(course_copy).db_url) as session:
        found = {one.id: (one.last_name, one.first_name, one.email) for one in session.query(Student)}
    assert found["José García 2"] == ("García", "José", "jose2@x.org") and len(found) == 4
    assert cli.main(["roster", "--course", str(course_copy)]) == 0


def test_another_table_is_refused_and_nothing_changes(course_copy, tmp_path, capsys):
    path = saved(tmp_path, "x.csv", "a,b\n1,2\n")
    assert cli.main(["roster", str(path), "--course", str(course_copy)]) == 2
    assert "no columns for names" in capsys.readouterr().err and not (course_copy / "students.csv").exists()


@pytest.mark.parametrize(
    "content",
    [
        "sep=;\r\nFirst name;Surname;Email address\r\nZoë;Élie;z@x.org\r\n".encode(),
        "First name\tSurname\tEmail address\nZoë\tÉlie\tz@x.org\n".encode("utf-16-le"),
        "First name\tSurname\tEmail address\nZoë\tÉlie\tz@x.org\n".encode("utf-16-be"),
    ],
)
def test_what_excel_makes_of_a_table_is_read(content, tmp_path):
    (path := tmp_path / "list.csv").write_bytes(content)
    assert [person.id for person in _read(path)] == ["Zoë Élie"]


@pytest.mark.parametrize(
    "content, said",
    [
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "workbook"),
        ("Imię,Nazwisko\nAda,L\n".encode(), "write First name, Surname and Email address above them"),
    ],
)
def test_a_table_that_is_not_read_says_what_to_do(content, said, tmp_path):
    (path := tmp_path / "list.csv").write_bytes(content)
    with pytest.raises(CourseError, match=said):
        _read(path)


def test_two_of_one_name_in_one_list_are_two_also_the_next_time():
    twins = [Person("Ann B", "B", "Ann"), Person("Ann B", "B", "Ann")]
    first = merged(Roster(), [twins])
    assert [line.person.id for line in first] == ["Ann B", "Ann B 2"]
    again = merged(Roster(tuple(line.person for line in first)), [twins])
    assert [(line.person.id, line.status) for line in again] == [("Ann B", "as before"), ("Ann B 2", "as before")]
    (one,) = merged(Roster(), [[twins[0]], [twins[1]]])  # in two lists it is one and the same
    assert one.person.id == "Ann B"


@pytest.mark.parametrize("name", [".", " . ", "..Ann", "\u200b", "<>"])
def test_whatever_a_platform_calls_somebody_the_roster_can_be_read_again(name, tmp_path):
    (line,) = merged(Roster(), [[Person(name, name, "")]])
    (tmp_path / "students.csv").write_text(roster_text([line.person]), encoding="utf-8")
    assert len(read_roster(tmp_path).people) == 1


def test_headings_of_the_roster_may_be_written_large(tmp_path):
    (tmp_path / "students.csv").write_text("ID;Last Name\nada;Lovelace\n")
    assert read_roster(tmp_path).people == (Person("ada", "Lovelace"),)
