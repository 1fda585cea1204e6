"""What goes back to Moodle and Canvas, read as `importziplib.php`, `importgradeslib.php` and `gradebook_importer.rb` read it."""

import csv
import io
import json
import re
import shutil
import zipfile

import pytest
from nbgrader.api import Gradebook

from autograder import cli
from autograder.grading.collecting.receipts import Receipt
from autograder.grading.course import open_course
from autograder.grading.errors import CourseError
from autograder.grading.returning import _Class, return_canvas, return_moodle
from autograder.grading.roster import Person, Roster

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def graded(without_kernels, small, empty_course, released, tmp_path_factory):
    """A class collected from both platforms and graded: Ada 4 points and a bonus, Zoë 4, Ben 0; Cid sent a report, Dan nothing."""
    root = tmp_path_factory.mktemp("return") / "course"
    shutil.copytree(empty_course, root)
    names = {"Ada": ("Lovelace", 4711), "Zoë": ("OBrien", 4712), "Ben": ("Moses", 4713), "Cid": ("Campeador", 4714)}
    moodle, canvas = io.BytesIO(), io.BytesIO()
    with zipfile.ZipFile(moodle, "w") as one, zipfile.ZipFile(canvas, "w") as other:
        for first, (last, number) in names.items():
            nb = json.dumps(small.answered(released, d2_sign="d2_sign = 'B'" if first != "Ben" else "d2_sign = 'A'"))
            file, content = ("scara.ipynb", nb) if first != "Cid" else ("report.pdf", "%PDF")
            one.writestr(f"{first} {last}_{number}_assignsubmission_file_/{file}", content)
            late = "LATE_" if first == "Zoë" else ""
            other.writestr(f"{last.lower()}{first.lower()}_{late}{number - 1000}_{number + 70_000}_{file}", content)
    (root / "students.csv").write_text(
        "id,last_name,first_name,canvas_id,exempt\nAda Lovelace,Lovelace,Ada,3711,\nzoe,O'Brien,Zoë,3712,\n"
        "Ben Moses,Moses,Ben,3713,\nCid Campeador,Campeador,Cid,3714,\nDan,Dare,Dan,3715,scara\n",
        encoding="utf-8",
    )
    with without_kernels():
        courses = {}
        for platform, content in (("moodle", moodle), ("canvas", canvas)):
            course = root.parent / platform
            shutil.copytree(root, course)
            (course / "all.zip").write_bytes(content.getvalue())
            assert cli.main(["collect", "scara", str(course / "all.zip"), "--course", str(course)]) == 0
            assert cli.main(["grade", "scara", "--course", str(course)]) == 0
            with Gradebook(f"sqlite:///{course}/gradebook.db") as gradebook:
                gradebook.find_grade("scara-T04", "scara", "scara", "Ada Lovelace").extra_credit = 1.5
                gradebook.find_grade("scara-d2_sign", "scara", "scara", "Ada Lovelace").manual_score = 20
                gradebook.db.commit()
            courses[platform] = course
        yield courses


WORKSHEET = """Identifier,Full name,Email address,Status,Grade,Maximum grade,Grade can be changed,Last modified (submission),Last modified (grade),Feedback comments
Participant 4711,Ada Lovelace,a@x.org,Submitted for grading,,20.00,Yes,"Tuesday, 13 October 2026, 10:23 PM",-,"keep, this"
Participant 4712,Zoë O'Brien,z@x.org,Submitted for grading,,20.00,Yes,"Tuesday, 13 October 2026, 10:23 PM",-,
Participant 4713,Ben Moses,b@x.org,Submitted for grading,3.00,20.00,Yes,"Tuesday, 13 October 2026, 10:23 PM",-,
Participant 4714,Cid Campeador,c@x.org,Submitted for grading,,20.00,Yes,"Tuesday, 13 October 2026, 10:23 PM",-,
Participant 4715,Dan Dare,d@x.org,No submission,,20.00,Yes,-,-,
"""


def moodle_reads_feedback(content, participants):
    """`is_valid_filename_for_import`: who gets which file; names that Moodle would pass over are told."""
    found, passed_over = {}, []
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        for path in archive.namelist():
            parts = path.split("/")
            for place, part in enumerate(parts):
                info = part.split("_", 4)
                if parts[-1][0] in ".~" or len(info) < 4 or not info[1].isdigit() or info[1] not in participants:
                    continue
                if info[2:4] == ["assignsubmission", "file"]:
                    rest = [*([info[4]] if len(info) > 4 else [""]), *parts[place + 1 :]]
                    found[participants[info[1]]] = ("/".join(rest), archive.read(path))
                    break
            else:
                passed_over.append(path)
    assert not passed_over
    return found


def moodle_reads_grades(content):
    """`assignfeedback_offline_grade_importer` and `process_import_grades`: grades by number, as far as they are taken."""
    header, *rows = csv.reader(io.StringIO(content.decode("utf-8-sig"), newline=""), delimiter=",")
    number, grade, _ = (header.index(name) for name in ("Identifier", "Grade", "Last modified (grade)"))
    taken = {}
    for row in rows:
        assert len(row) == len(header)
        if row[grade] != "" and 0 <= float(row[grade]) <= 20:
            taken[row[number].removeprefix("Participant ")] = float(row[grade])
    return taken, header, rows


def test_moodle_finds_every_page_and_every_grade(graded, tmp_path):
    root = graded["moodle"]
    worksheet = tmp_path / "worksheet.csv"
    worksheet.write_text(WORKSHEET, encoding="utf-8-sig")
    lines = {line.student: line for line in return_moodle(open_course(root), "scara", worksheet, tmp_path, False)}
    names = {"4711": "Ada Lovelace", "4712": "zoe", "4713": "Ben Moses", "4714": "Cid Campeador", "4715": "Dan"}
    pages = moodle_reads_feedback((tmp_path / "scara-feedback.zip").read_bytes(), names)
    assert {student: (name, page) for student, (name, page) in pages.items()} == {
        student: ("/scara.html", (root / f"feedback/{student}/scara/scara.html").read_bytes())
        for student in ("Ada Lovelace", "zoe", "Ben Moses")
    }
    content = (tmp_path / "scara-grades.csv").read_bytes()
    taken, header, rows = moodle_reads_grades(content)
    assert taken == {"4711": 20.0, "4712": 4.0, "4713": 0.0} and content.startswith(b"\xef\xbb\xbf")
    before = list(csv.reader(io.StringIO(WORKSHEET)))
    place = header.index("Grade")
    assert [[cell for at, cell in enumerate(row) if at != place] for row in [header, *rows]] == [
        [cell for at, cell in enumerate(row) if at != place] for row in before
    ]
    assert lines["Ada Lovelace"].remarks == (
        "21.5 is more than Moodle takes; the bonus is cut at 20",
        "1.5 of them extra",
    )
    assert lines["Cid Campeador"] == type(lines["zoe"])("Cid Campeador", None, ("no notebook: handed in: report.pdf",))
    assert lines["Dan"].points is None and lines["zoe"].remarks == ()


def test_a_worksheet_of_another_site_keeps_its_language_and_its_commas(graded, tmp_path):
    worksheet = tmp_path / "feuille.csv"
    worksheet.write_text(
        "Identifiant;Nom complet;Note;Note maximale;Dernière modification (note)\nParticipant 4712;Zoë O'Brien;;20,00;-\n"
    )
    return_moodle(open_course(graded["moodle"]), "scara", worksheet, tmp_path, False)
    assert (tmp_path / "scara-grades.csv").read_text().splitlines() == [
        "Identifiant,Nom complet,Note,Note maximale,Dernière modification (note)", "Participant 4712,Zoë O'Brien,\"4,00\",\"20,00\",-"
    ]  # fmt: skip


def test_a_worksheet_in_a_language_that_is_not_known(graded, tmp_path):
    worksheet = tmp_path / "arkusz.csv"
    worksheet.write_text(
        "Identyfikator,Imię,Status,Ocena,Maksymalna ocena,Zmiana,Ostatnia modyfikacja (ocena)\n"
        "Uczestnik 4711,Ada Lovelace,x,,20.00,Tak,-\nUczestnik 4712,Zoë O'Brien,x,,20.00,Tak,-\n"
    )
    return_moodle(open_course(graded["moodle"]), "scara", worksheet, tmp_path, False)
    rows = list(csv.reader((tmp_path / "scara-grades.csv").open(encoding="utf-8")))
    assert [row[3] for row in rows] == ["Ocena", "20.00", "4.00"]
    pages = moodle_reads_feedback(
        (tmp_path / "scara-feedback.zip").read_bytes(), {"4711": "ada", "4712": "zoe", "4713": "ben"}
    )
    assert pages.keys() == {"ada", "zoe"}


def test_without_receipts_the_worksheet_tells_the_numbers(graded, tmp_path):
    root = graded["moodle"]
    receipts = root / "downloaded/scara/collected.json"
    kept = receipts.read_bytes()
    receipts.unlink()
    try:
        worksheet = tmp_path / "worksheet.csv"
        worksheet.write_text(WORKSHEET)
        return_moodle(open_course(root), "scara", worksheet, tmp_path, False)
    finally:
        receipts.write_bytes(kept)
    pages = moodle_reads_feedback(
        (tmp_path / "scara-feedback.zip").read_bytes(), {"4711": "ada", "4712": "zoe", "4713": "ben"}
    )
    assert pages.keys() == {"ada", "zoe", "ben"}
    assert moodle_reads_grades((tmp_path / "scara-grades.csv").read_bytes())[0].keys() == {"4711", "4712", "4713"}


def test_of_two_with_one_name_nobody_gets_the_others_points(graded, tmp_path):
    root = graded["moodle"]
    twins = WORKSHEET.replace("Participant 4715,Dan Dare", "Participant 4716,Zoë O'Brien")
    worksheet = tmp_path / "worksheet.csv"
    worksheet.write_text(twins)
    return_moodle(open_course(root), "scara", worksheet, tmp_path, False)
    assert moodle_reads_grades((tmp_path / "scara-grades.csv").read_bytes())[0].keys() == {"4711", "4712", "4713"}
    worksheet.write_text(twins.replace("4712", "4717"))
    lines = {line.student: line for line in return_moodle(open_course(root), "scara", worksheet, tmp_path, False)}
    assert moodle_reads_grades((tmp_path / "scara-grades.csv").read_bytes())[0].keys() == {"4711", "4713"}
    assert "graded, but not found on the platform" in lines["zoe"].remarks


def test_one_page_that_cannot_be_written_does_not_keep_the_others_back(graded, without_kernels, tmp_path):
    root = tmp_path / "course"
    shutil.copytree(graded["moodle"], root)
    (root / "autograded/zoe/scara/scara.ipynb").write_text("{}")
    for student in ("Ben Moses", "zoe"):
        shutil.rmtree(root / "feedback" / student)
    with without_kernels():
        lines = {line.student: line for line in return_moodle(open_course(root), "scara", None, tmp_path, False)}
    pages = moodle_reads_feedback(
        (tmp_path / "scara-feedback.zip").read_bytes(), {"4711": "ada", "4712": "zoe", "4713": "ben"}
    )
    assert pages.keys() == {"ada", "ben"}
    assert "no feedback file" in lines["zoe"].remarks[0] and "autograder grade scara" in lines["zoe"].remarks[0]


def test_a_groups_points_go_to_its_members(graded, tmp_path):
    root = tmp_path / "course"
    shutil.copytree(graded["moodle"], root)
    receipts = root / "downloaded/scara/collected.json"
    receipts.write_text(receipts.read_text().replace('"Zoë OBrien"', '"Team 3"').replace('"4712"', '"4715"'))
    people = "id,last_name,first_name,groups\nzoe,Brown,Zed,\ngil,Gamesh,Gil,Team 3\nkid,Enkidu,Kid,Team 3\n"
    (root / "students.csv").write_text(people)
    worksheet = tmp_path / "worksheet.csv"
    names = {4715: "Dan Dare", 4801: "Gil Gamesh", 4802: "Kid Enkidu"}
    lines = "".join(f"Participant {number},{name},,20.00,-\n" for number, name in names.items())
    worksheet.write_text(f"Identifier,Full name,Grade,Maximum grade,Last modified (grade)\n{lines}")
    return_moodle(open_course(root), "scara", worksheet, tmp_path, False)
    assert moodle_reads_grades((tmp_path / "scara-grades.csv").read_bytes())[0] == {"4801": 4.0, "4802": 4.0}
    pages = moodle_reads_feedback(
        (tmp_path / "scara-feedback.zip").read_bytes(), {str(number): name for number, name in names.items()}
    )
    assert pages.keys() == {"Gil Gamesh", "Kid Enkidu"}


def test_another_maximum_is_refused_or_scaled(graded, tmp_path):
    worksheet = tmp_path / "worksheet.csv"
    worksheet.write_text(WORKSHEET.replace("20.00", "10.00"))
    course = open_course(graded["moodle"])
    with pytest.raises(CourseError, match="scara has 20 points, the assignment 10; .*--scale"):
        return_moodle(course, "scara", worksheet, tmp_path, False)
    assert not (tmp_path / "scara-grades.csv").exists()
    return_moodle(course, "scara", worksheet, tmp_path, True)
    assert moodle_reads_grades((tmp_path / "scara-grades.csv").read_bytes())[0] == {
        "4711": 10.0,
        "4712": 2.0,
        "4713": 0.0,
    }


GRADES = """Student,ID,SIS User ID,SIS Login ID,Section,Exercise 3: tables (2216),Exercise 4: SCARA (2217),Exercise 12: SCARA S600 (2218),Final Score
,,,,,,Manual Posting,,
    Points Possible,,,,,20,20,20,(read only)
"Lovelace, Ada",3711,S1,ada@x.org,Section A,12,,,60
"O'Brien, Zoë",3712,S2,zoe@x.org,Section A,,,,
"Moses, Ben",3713,S3,ben@x.org,Section A,,17,,
"Campeador, Cid",3714,S4,cid@x.org,Section A,,,,
"Dare, Dan",3715,S5,dan@x.org,Section A,,,,
"Student, Test",3999,,a94a,Section A,,,,
"""


def canvas_reads_grades(content):
    """`gradebook_importer.rb`: points possible and grades by user and assignment."""
    header, *rows = csv.reader(io.StringIO(content.decode(), newline=""))
    assert len(header) > 3 and "Student" in header[0] and "ID" in header[1]
    about = 3
    if re.match(r"SIS\s+Login\s+ID", header[2]):
        about = 4
    elif re.match(r"SIS\s+User\s+ID", header[2]) and re.match(r"SIS\s+Login\s+ID", header[3]):
        about = 5
    assert "Section" in header[about - 1]
    assignments = [re.fullmatch(r"(.*) \((\d+)\)", name)[2] for name in header[about:]]
    possible, grades = {}, {}
    for row in rows:
        assert len(row) == len(header)
        if "Points Possible" in row[0]:
            possible = dict(zip(assignments, row[about:], strict=True))
        else:
            grades[row[1]] = dict(zip(assignments, row[about:], strict=True))
    return possible, grades


def canvas_reads_feedback(content):
    """`infer_comment_context_from_filename`: user and attachment are the first two numbers between underscores."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {
            tuple([part for part in name.split("_") if part.isdigit()][:2]): archive.read(name)
            for name in archive.namelist()
        }


def test_canvas_finds_every_grade_and_every_page(graded, tmp_path):
    root = graded["canvas"]
    table = tmp_path / "grades.csv"
    table.write_text(GRADES, encoding="utf-8-sig")
    lines = {
        line.student: line
        for line in return_canvas(open_course(root), "scara", table, "Exercise 4: SCARA (2217)", tmp_path, False)
    }
    possible, grades = canvas_reads_grades((tmp_path / "scara-grades.csv").read_bytes())
    assert possible == {"2217": "20"}
    assert grades == {"3711": {"2217": "21.5"}, "3712": {"2217": "4"}, "3713": {"2217": "0"}, "3715": {"2217": "EX"}}
    pages = canvas_reads_feedback((tmp_path / "scara-feedback.zip").read_bytes())
    assert pages == {
        (number, upload): (root / f"feedback/{student}/scara/scara.html").read_bytes()
        for number, upload, student in (
            ("3711", "74711", "Ada Lovelace"),
            ("3712", "74712", "zoe"),
            ("3713", "74713", "Ben Moses"),
        )
    }
    assert lines["Dan"].remarks == ("exempt",) and lines["Cid Campeador"].points is None


def test_an_assignment_that_cannot_be_told_is_asked_for(graded, tmp_path):
    table = tmp_path / "grades.csv"
    table.write_text(GRADES)
    with pytest.raises(
        CourseError, match=r"several columns fit scara; .*SCARA \(2217\); Exercise 12: SCARA S600 \(2218\)"
    ):
        return_canvas(open_course(graded["canvas"]), "scara", table, None, tmp_path, False)


def test_other_tables_are_refused(graded, tmp_path, capsys):
    table = tmp_path / "x.csv"
    table.write_text("a,b\n1,2\n")
    for option in ("--moodle", "--canvas"):
        assert cli.main(["return", "scara", option, str(table), "--course", str(graded["moodle"])]) == 2
        assert f"{table} is no grad" in capsys.readouterr().err


def test_the_command_says_what_it_wrote_and_who_gets_nothing(graded, tmp_path, capsys):
    assert cli.main(["return", "scara", "--moodle", "--to", str(tmp_path), "--course", str(graded["moodle"])]) == 0
    said = capsys.readouterr().out
    assert str(tmp_path / "scara-feedback.zip") in said and re.search(r"Cid Campeador .*report\.pdf", said)
    assert re.search(r"Ada Lovelace +│ +21\.5", said)


def test_the_table_of_grades_adds_up_and_invents_no_zeros(graded, tmp_path):
    root, target = graded["moodle"], tmp_path / "grades.csv"
    with Gradebook(f"sqlite:///{root}/gradebook.db") as gradebook:
        if "dan" not in {student.id for student in gradebook.students}:
            gradebook.add_student("dan")
            gradebook.add_assignment("later")
    assert cli.main(["export", "--to", str(target), "--bom", "--course", str(root)]) == 0
    content = target.read_bytes()
    rows = {row["student_id"]: row for row in csv.DictReader(io.StringIO(content.decode("utf-8-sig")))}
    assert content.startswith(b"\xef\xbb\xbf") and {row["assignment"] for row in rows.values()} == {"scara"}
    questions = [name for name in rows["zoe"] if name.startswith("scara.")]
    assert len(questions) == 3
    for student in ("Ada Lovelace", "zoe", "Ben Moses"):
        row = rows[student]
        assert sum(float(row[name]) for name in [*questions, "bonus"]) == float(row["raw_score"])
    assert rows["dan"]["score"] == rows["dan"]["raw_score"] == ""
    assert cli.main(["export", "--to", str(target), "--course", str(root)]) == 0
    assert not target.read_bytes().startswith(b"\xef\xbb\xbf")


def test_who_is_exempt_gets_no_points_of_the_team():
    people = (Person("ada", groups=("Team 3",), exempt=("scara",)), Person("ben", groups=("Team 3",)))
    known = _Class("scara", {}, {}, {"Team 3": Receipt(platform="moodle", name="Team 3")}, Roster(people))
    assert known.teams == {"ben": "Team 3"}
