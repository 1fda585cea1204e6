"""Collecting once more, names that do not tell, and archives that mean harm."""

import io
import os
import random
import re
import struct
import unicodedata
import zipfile
from datetime import timedelta
from pathlib import Path

import pytest

from autograder import cli
from autograder.grading.collecting import archives
from autograder.grading.collecting.platforms import sender
from autograder.grading.course import open_course
from autograder.grading.errors import CourseError
from autograder.grading.results import without_notebook

pytestmark = pytest.mark.slow


def student(downloads, name, content, file="scara.ipynb", **more):
    return downloads.Upload(name, {file: content}, "collected", wanted=content, **more)


def right(downloads, who="nobody", count=99):
    return downloads.as_bytes(downloads.answered("scara", who, count))


def handed_in(root, who, exercise="scara"):
    path = root / "submitted" / who / exercise / f"{exercise}.ipynb"
    return path.read_bytes() if path.exists() else None


def statuses(rows):
    return {row.student: row.status for row in rows}


def roster(root, *names, more=""):
    lines = [f"s{number},{name.rpartition(' ')[2]},{name.rpartition(' ')[0]}" for number, name in enumerate(names)]
    (root / "students.csv").write_text("\n".join(["id,last_name,first_name", *lines, more]), encoding="utf-8")


@pytest.mark.parametrize(
    "path, name, number, prefix, late",
    [
        ("Ada Lovelace_4711_assignsubmission_file_/scara.ipynb", "Ada Lovelace", "4711", "Ada Lovelace_4711_assignsubmission_file", False),
        ("Ada Lovelace_4711_assignsubmission_file/sub/scara.ipynb", "Ada Lovelace", "4711", "Ada Lovelace_4711_assignsubmission_file", False),
        ("Zoë ONeil_12_assignsubmission_file_my_scara_2.ipynb", "Zoë ONeil", "12", "Zoë ONeil_12_assignsubmission_file", False),
        ("Participant_77_assignsubmission_file_/scara.ipynb", "", "77", "Participant_77_assignsubmission_file", False),
        ("Teilnehmerin_77_assignsubmission_file/scara.ipynb", "", "77", "Teilnehmerin_77_assignsubmission_file", False),
        ("Team 3_9_assignsubmission_file/scara.ipynb", "Team 3", "9", "Team 3_9_assignsubmission_file", False),
        ("Default team_assignsubmission_file/scara.ipynb", "Default team", "", "Default team_assignsubmission_file", False),
        ("Ada Lovelace_4711_assignsubmission_onlinetext/onlinetext.html", "Ada Lovelace", "4711", "Ada Lovelace_4711_assignsubmission_onlinetext", False),
        ("lovelaceada_3143_207797_scara.ipynb", "lovelaceada", "3143", "lovelaceada_3143", False),
        ("obrienjosé_LATE_3143_207797_scara-1.ipynb", "obrienjosé", "3143", "obrienjosé_LATE_3143", True),
        ("submissions/lovelaceada_3143_207797_my_12_3.ipynb", "lovelaceada", "3143", "lovelaceada_3143", False),
        ("lovelaceada_3143_text.html", "lovelaceada", "3143", "lovelaceada_3143", False),
        ("anon_aB3xZ_207797_scara.ipynb", "", "anon_aB3xZ", "anon_aB3xZ", False),
        ("LATE_anon_aB3xZ_207797_scara.ipynb", "", "anon_aB3xZ", "LATE_anon_aB3xZ", True),
        ("lovelaceada_late_3143_207797_scara-1.ipynb", "lovelaceada", "3143", "lovelaceada_late_3143", True),
        ("Group 1-Participant_77_assignsubmission_file_/scara.ipynb", "", "77", "Group 1-Participant_77_assignsubmission_file", False),
    ],
)  # fmt: skip
def test_a_downloaded_file_tells_its_sender(path, name, number, prefix, late):
    whose, _ = sender(path.split("/"))
    assert (whose.name, whose.number, whose.prefix, whose.late) == (name, number, prefix, late)


@pytest.mark.parametrize("path", ["scara.ipynb", "Ada Lovelace/scara.ipynb", "notes_2024.ipynb", "__MACOSX/._x"])
def test_other_names_tell_nothing(path):
    assert sender(path.split("/")) is None


def test_collecting_again_changes_nothing_and_a_newer_one_replaces_the_older(downloads, collect, root):
    first = [
        student(downloads, "Ann A", right(downloads, "ann", 3)),
        student(downloads, "Ben B", right(downloads, "ben")),
    ]
    download = downloads.moodle(first)
    assert statuses(collect(download)) == {"Ann A": "collected", "Ben B": "collected"}
    before = {path: path.stat().st_mtime_ns for path in root.glob("submitted/*/*/*")}
    assert statuses(collect(download, download)) == {"Ann A": "unchanged", "Ben B": "unchanged"}
    assert {path: path.stat().st_mtime_ns for path in root.glob("submitted/*/*/*")} == before
    later = [student(downloads, "Ann A", right(downloads, "ann"), hours={"scara.ipynb": 50}), first[1]]
    rows = {row.student: row for row in collect(downloads.moodle(later))}
    assert rows["Ann A"].status == "replaced" and "newer" in rows["Ann A"].remarks[0]
    assert handed_in(root, "Ann A") == later[0].wanted
    rows = {row.student: row for row in collect(download)}
    assert rows["Ann A"].status == "kept" and handed_in(root, "Ann A") == later[0].wanted
    assert "was collected before is newer" in rows["Ann A"].remarks[0]


def test_the_newer_of_two_downloads_counts_where_their_files_bear_no_times(downloads, collect, root):
    old, new = right(downloads, "ann", 3), right(downloads, "ann, again")
    path = "Ann A_1_assignsubmission_file_/scara.ipynb"
    first = downloads.zipped({path: old}, times={path: downloads.START})
    second = downloads.zipped({path: new}, times={path: downloads.START + timedelta(days=2)})
    rows = collect(second, first)
    assert statuses(rows) == {"Ann A": "collected"} and handed_in(root, "Ann A") == new
    assert "the newest of 2" in rows[0].remarks
    assert not (root / "submitted/Ann A/scara/timestamp.txt").exists()


def test_a_later_upload_of_canvas_counts(downloads, collect, root):
    old, new = right(downloads, "ann", 3), right(downloads, "ann")
    files = {"aann_LATE_7_1009_scara-1.ipynb": new, "aann_LATE_7_1002_scara.ipynb": old}
    rows = collect(downloads.zipped(files))
    assert handed_in(root, "aann") == new and rows[0].remarks == ("the newest of 2", "marked late")


def test_a_file_put_there_by_hand_stays(downloads, collect, root):
    own = right(downloads, "the lecturer's")
    folder = root / "submitted/Ann A/scara"
    folder.mkdir(parents=True)
    (folder / "scara.ipynb").write_bytes(own)
    download = downloads.moodle([student(downloads, "Ann A", right(downloads, "ann"))])
    assert statuses(collect(download)) == {"Ann A": "kept"} and handed_in(root, "Ann A") == own
    collect(download)
    assert handed_in(root, "Ann A") == own
    assert statuses(collect(download, force=True)) == {"Ann A": "replaced"}
    assert handed_in(root, "Ann A") == right(downloads, "ann")


def test_a_worse_file_later_does_not_take_what_is_there(downloads, collect, root):
    download = downloads.moodle([student(downloads, "Ann A", right(downloads, "ann"))])
    collect(download)
    (row,) = collect(downloads.moodle([student(downloads, "Ann A", b"%PDF", "report.pdf")]))
    assert row.status == "kept" and "no notebook this time" in row.remarks[0]
    assert handed_in(root, "Ann A") == right(downloads, "ann")


def test_times_of_handing_in_become_time_stamps(downloads, collect, root):
    people = [student(downloads, f"Ann {letter}", right(downloads, letter)) for letter in "abc"]
    collect(downloads.moodle(people))
    stamps = [(root / f"submitted/Ann {letter}/scara/timestamp.txt").read_text() for letter in "abc"]
    assert len(set(stamps)) == 3 and all(re.fullmatch(r"2026-10-1\d \d\d:\d\d:\d\d UTC\n", stamp) for stamp in stamps)


def test_times_that_only_tell_of_the_download_become_none(downloads, collect, root):
    collect(downloads.canvas([student(downloads, f"Ann {letter}", right(downloads, letter)) for letter in "abc"]))
    assert not list(root.rglob("timestamp.txt"))


@pytest.mark.parametrize("platform", ["moodle", "canvas"])
def test_a_file_that_was_added_to_a_download_later_makes_nobody_late(platform, downloads, collect, root):
    people = [student(downloads, f"Ann {letter}", right(downloads, letter)) for letter in "abcdefgh"]
    packed = downloads.moodle(people, real_times=False) if platform == "moodle" else downloads.canvas(people)
    path = "Ben B_4800_assignsubmission_file_/scara.ipynb" if platform == "moodle" else "bben_4800_9_scara.ipynb"
    later = downloads.zipped({path: right(downloads)}, times={path: downloads.START + timedelta(days=3)})
    made = zipfile.ZipFile(file := io.BytesIO(packed), "a")
    with zipfile.ZipFile(io.BytesIO(later)) as other:
        made.writestr(other.infolist()[0], other.read(path))
    made.close()
    assert len(collect(file.getvalue())) == 9
    assert not list(root.rglob("timestamp.txt"))


def test_an_unreadable_file_later_does_not_take_what_is_there(downloads, collect, root):
    collect(downloads.moodle([student(downloads, "Ann A", right(downloads, "ann"))]))
    (row,) = collect(downloads.moodle([student(downloads, "Ann A", b"{", hours={"scara.ipynb": 99})]))
    assert row.status == "kept" and "unreadable this time" in row.remarks[0]
    assert handed_in(root, "Ann A") == right(downloads, "ann")


def test_a_download_that_went_through_a_mac(downloads, collect, root):
    (root / "students.csv").write_text("id,last_name,first_name\nfrançois,Élie,François\n", encoding="utf-8")
    name = unicodedata.normalize("NFD", "François Élie")
    assert statuses(collect(downloads.moodle([student(downloads, name, right(downloads))]))) == {
        "françois": "collected"
    }
    (root / "students.csv").unlink()
    assert unicodedata.normalize("NFC", name) in statuses(
        collect(downloads.moodle([student(downloads, name, right(downloads))], first=9))
    )


def test_names_that_make_the_same_folder_stay_two(downloads, collect, root):
    contents = [right(downloads, who) for who in "ab"]
    made = downloads.zipped({"class/Ann <A>/scara.ipynb": contents[0], "class/Ann A/scara.ipynb": contents[1]})
    rows = collect(made)
    assert len({row.student for row in rows}) == 2
    assert {handed_in(root, row.student) for row in rows} == set(contents)


WORKSHEET = """Identifier,Full name,Email address,Status,Grade,Maximum grade,Grade can be changed,Last modified (submission),Last modified (grade)
Participant 4711,José García,jose1@x.org,Submitted for grading,,20.00,Yes,"Tuesday, 13 October 2026, 10:23 PM",-
Participant 4712,José García,jose2@x.org,Submitted for grading,,20.00,Yes,"Wednesday, 14 October 2026, 8:05 AM",-
"""


def test_two_of_one_name_are_told_apart_by_the_worksheet(downloads, collect, root):
    people = [student(downloads, "José García", right(downloads, who)) for who in ("one", "two")]
    table = root.parent / "worksheet.csv"
    table.write_text(WORKSHEET, encoding="utf-8-sig")
    (root / "students.csv").write_text(
        "id,last_name,first_name,email\ngarcia1,García,José,jose1@x.org\ngarcia2,García,José,jose2@x.org\n"
    )
    rows = collect(downloads.moodle(people), worksheets=[table])
    assert statuses(rows) == {"garcia1": "collected", "garcia2": "collected"}
    assert [handed_in(root, who) for who in ("garcia1", "garcia2")] == [one.wanted for one in people]
    assert (root / "submitted/garcia1/scara/timestamp.txt").exists()


def test_two_of_one_name_are_told_apart_by_what_they_typed(downloads, collect, root):
    people = [student(downloads, "José García", right(downloads, who)) for who in ("garcia 2", "GARCIA1")]
    (root / "students.csv").write_text("id,last_name,first_name\ngarcia1,García,José\ngarcia2,García,José\n")
    assert statuses(collect(downloads.moodle(people))) == {"garcia1": "collected", "garcia2": "collected"}
    assert [handed_in(root, who) for who in ("garcia2", "garcia1")] == [one.wanted for one in people]


def test_two_of_one_name_whom_nothing_tells_apart_are_both_there_and_told(downloads, collect, root):
    people = [student(downloads, "José García", right(downloads, who)) for who in ("one", "two")]
    for _ in range(2):
        rows = collect(downloads.moodle(people))
        assert statuses(rows).keys() == {"José García 4711", "José García 4712"}
    assert [handed_in(root, f"José García {number}") for number in (4711, 4712)] == [one.wanted for one in people]


@pytest.mark.parametrize("platform", ["moodle", "canvas"])
def test_hidden_names_are_taken_from_the_notebooks(platform, downloads, collect, root):
    people = [student(downloads, name, right(downloads, name)) for name in ("Ann A", "Ben B", "nobody at all")]
    roster(root, "Ann A", "Ben B", "Cid C")
    made = downloads.moodle(people, name=lambda name: "Participant") if platform == "moodle" else downloads.canvas(people, anonymous=True)  # fmt: skip
    found = statuses(collect(made))
    stranger = "Participant 4713" if platform == "moodle" else "Participant anon_a3002Z"
    assert found == {"s0": "collected", "s1": "collected", "s2": "missing", stranger: "collected"}
    assert [handed_in(root, who) for who in ("s0", "s1", stranger)] == [one.wanted for one in people]


def test_nobody_takes_anothers_place_by_typing_the_id(downloads, collect, root):
    people = [student(downloads, name, right(downloads, "Ann A")) for name in ("x", "y")]
    roster(root, "Ann A")
    rows = statuses(collect(downloads.moodle(people, name=lambda name: "Participant")))
    assert rows == {"s0": "missing", "Participant 4711": "collected", "Participant 4712": "collected"}


def test_people_who_are_not_on_the_roster_are_collected_and_told(downloads, collect, root):
    roster(root, "Ann A")
    rows = {row.student: row for row in collect(downloads.moodle([student(downloads, "Guest G", right(downloads))]))}
    assert rows["Guest G"].remarks == ("not on the roster",) and rows["s0"].status == "missing"


def test_canvas_finds_people_by_number(downloads, collect, root):
    (root / "students.csv").write_text("id,last_name,first_name,canvas_id\nada,King,Augusta,3000\n")
    assert statuses(collect(downloads.canvas([student(downloads, "Ada Lovelace", right(downloads))]))) == {
        "ada": "collected"
    }


def test_a_group_hands_in_for_its_members(downloads, collect, root):
    (root / "students.csv").write_text("id,groups\nada,Team 3\nben,Team 3; Tuesday\ncid,\n")
    rows = {row.student: row for row in collect(downloads.moodle([student(downloads, "Team 3", right(downloads))]))}
    assert rows["Team 3"].remarks == ("a group: ada, ben",) and rows.keys() == {"Team 3", "cid"}


def test_a_group_on_canvas_is_not_taken_for_its_representative(downloads, collect, root):
    (root / "students.csv").write_text(
        "id,last_name,first_name,canvas_id,groups\nada,Lovelace,Ada,3000,Team 3\nben,Moses,Ben,3001,Team 3\ncid,Moon,Cid,3002,\n"
    )
    names = {"Team 3": 3000, "Moon Cid": 3002}
    made = downloads.zipped(
        {
            f"{name.replace(' ', '').lower()}_{number}_{number + 70_000}_scara.ipynb": right(downloads, name)
            for name, number in names.items()
        }
    )
    rows = {row.student: row for row in collect(made)}
    assert rows.keys() == {"team3", "cid"} and rows["team3"].remarks == ("a group: ada, ben",)


@pytest.mark.parametrize("listed", [True, False])
def test_the_group_before_the_name_in_older_moodles_is_no_part_of_it(listed, downloads, collect, root):
    names = ["Ada Lovelace", "Anne-Marie Moses", "Cid C"]
    if listed:
        roster(root, *names)
    people = [student(downloads, f"TP-2-{name}", right(downloads, name)) for name in names]
    made = downloads.moodle(people)
    rows = statuses(collect(made))
    assert rows == dict.fromkeys([f"s{number}" for number in range(3)] if listed else names, "collected")


def test_one_alone_of_a_group_is_found_on_the_roster(downloads, collect, root):
    roster(root, "Ada Lovelace", "Ben B")
    made = downloads.moodle([student(downloads, "TP 2-Ada Lovelace", right(downloads, "ada"))])
    assert statuses(collect(made)) == {"s0": "collected", "s1": "missing"}


def test_members_of_several_groups_are_found_behind_their_groups(downloads, collect, root):
    lines = ["ada,Lovelace,Ada,Team A", "ben,B,Ben,Team B; Tuesday", "cid,C,Cid,", "ann,Curie,Anne-Marie,Anne"]
    (root / "students.csv").write_text("\n".join(["id,last_name,first_name,groups", *lines]))
    names = ["Team A-Ada Lovelace", "Team B-Ben B", "Cid C", "Anne-Marie Curie"]
    made = downloads.moodle([student(downloads, name, right(downloads, name)) for name in names])
    assert statuses(collect(made)) == dict.fromkeys(["ada", "ben", "cid", "ann"], "collected")


def test_a_double_name_is_no_group_and_a_name(downloads, collect, root):
    people = [student(downloads, name, right(downloads, name)) for name in ("Anne-Marie A", "Anne-Sophie B", "Ben C")]
    assert statuses(collect(downloads.moodle(people))).keys() == {"Anne-Marie A", "Anne-Sophie B", "Ben C"}


@pytest.mark.parametrize("content", [b"", b"<!doctype html><title>Log in</title>", b"hello"])
def test_what_is_no_download_is_nobodys_and_told(content, downloads, collect, root):
    (row,) = collect(content)
    assert (row.student, row.status) == ("?", "nobody's") and "neither a zip nor a notebook" in row.remarks[0]
    assert not (root / "submitted").exists()


def test_a_download_with_nothing_in_it_is_told(downloads, collect, root):
    (row,) = collect(downloads.zipped({}))
    assert (row.student, row.status) == ("?", "nobody's") and "nothing in it" in row.remarks[0]


def test_plain_zips_and_folders(downloads, collect, root):
    notebook = {name: right(downloads, name) for name in ("Ann A", "Ben B", "Cid C", "Dan D", "Eve E")}
    roster(root, *notebook)
    inner = downloads.zipped({"scara/scara.ipynb": notebook["Cid C"], "readme.txt": b"x"})
    files = {
        "class/Ann A/scara.ipynb": notebook["Ann A"],
        "class/Ben B.ipynb": notebook["Ben B"],
        "class/Cid C.zip": inner,
    }
    folder = root.parent / "unpacked"
    (folder / "s3/scara").mkdir(parents=True)
    (folder / "s3/scara/scara.ipynb").write_bytes(notebook["Dan D"])
    (folder / "s3/scara/link.ipynb").symlink_to("/etc/passwd")
    alone = root.parent / "whatever.ipynb"
    alone.write_bytes(notebook["Eve E"])
    rows = statuses(collect(downloads.zipped(files), folder, alone))
    assert rows == {f"s{number}": "collected" for number in range(5)}
    assert [handed_in(root, f"s{number}") for number in range(5)] == list(notebook.values())


def test_a_folder_with_odd_names_and_files_that_cannot_be_read(downloads, collect, root, monkeypatch):
    folder = root.parent / "unpacked"
    for number, name in enumerate([b"Ann A_1_assignsubmission_file", b"Jos\xe9 B_2_assignsubmission_file"]):
        place = os.path.join(os.fsencode(folder), name)
        os.makedirs(place)
        with open(os.path.join(place, b"scara.ipynb"), "wb") as file:
            file.write(right(downloads, str(number)))
    os.mkfifo(folder / "pipe")
    rows = collect(folder)
    assert statuses(rows) == {"Ann A": "collected", "Jos\ufffd B": "collected", "?": "nobody's"}
    whole = Path.open

    def opened(path, *more, **options):
        if path.name == "scara.ipynb" and "Ann" in str(path) and "unpacked" in str(path):
            raise PermissionError(13, "Permission denied", str(path))
        return whole(path, *more, **options)

    monkeypatch.setattr(Path, "open", opened)
    rows = {row.student: row for row in collect(folder)}
    assert "cannot be read here (Permission denied)" in " ".join(rows["Ann A"].remarks)


def test_a_download_packed_once_more(downloads, collect, root):
    people = [student(downloads, name, right(downloads, name)) for name in ("Ann A", "Ben B")]
    twice = downloads.zipped({"Downloads/all.zip": downloads.moodle(people), "__MACOSX/Downloads/._all.zip": b"x"})
    assert statuses(collect(twice)) == {"Ann A": "collected", "Ben B": "collected"}


def test_a_download_that_cannot_be_read_is_named_and_the_others_are_collected(downloads, collect, root):
    people = [student(downloads, "Ann A", right(downloads))]
    rows = collect(b"PK\x03\x04 and no more", downloads.moodle(people))
    assert statuses(rows) == {"?": "nobody's", "Ann A": "collected"}
    assert "damaged" in rows[0].remarks[0]


def test_files_without_an_owner_are_named(downloads, collect, root):
    made = zipfile.ZipFile(file := io.BytesIO(downloads.moodle([student(downloads, "Ann A", right(downloads))])), "a")
    made.writestr("notes.txt", "for myself")
    made.writestr("late.ipynb", right(downloads))
    made.close()
    lost, notes = (row for row in collect(file.getvalue()) if row.status == "nobody's")
    assert (notes.student, notes.file, notes.remarks) == ("?", "notes.txt", ())
    assert lost.file == "late.ipynb" and "a notebook of scara, but" in lost.remarks[0]


def bomb(size):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("scara.ipynb", "w") as entry:
        entry.write(b"{")
        for _ in range(size >> 20):
            entry.write(b" " * (1 << 20))
    return file.getvalue()


def nested(downloads, content, depth):
    for _ in range(depth):
        content = downloads.zipped({"again.zip": content})
    return content


def many(count):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for number in range(count):
            archive.writestr(f"{number}.txt", "")
    return file.getvalue()


def lying_directory(content):
    """A zip that says its list of names is 200 MB long."""
    place = content.rindex(b"PK\x05\x06") + 12
    return content[:place] + struct.pack("<L", 200 << 20) + content[place + 4 :]


def damaged(rng, content):
    """The content with some bytes changed, left out or put in, most of them where a zip keeps its names."""
    content = bytearray(content)
    for _ in range(rng.choice([1, 1, 2, 5, 20])):
        place = rng.randrange(0 if rng.random() < 0.4 else max(0, len(content) - 400), len(content))
        few = rng.randrange(1, 9)
        content[place : place + rng.choice([few, 0, 1])] = rng.randbytes(rng.choice([few, 0, 1]))
    return bytes(content)


def test_a_damaged_archive_is_told_whatever_is_damaged(downloads, tmp_path):
    rng = random.Random(4)
    inner = downloads.zipped({"scara/scara.ipynb": b'{"cells": []}' * 50, "é/": b"", "b.txt": b"x"})
    outer = downloads.zipped({"Ada_1_assignsubmission_file_/x.zip": inner, "Ben_2_assignsubmission_file_/": b""})
    path = tmp_path / "all.zip"
    for _ in range(600):
        path.write_bytes(
            rng.choice(
                [damaged(rng, outer), downloads.zipped({"Eve_3_assignsubmission_file_/y.zip": damaged(rng, inner)})]
            )
        )
        assert list(archives.unpack(path)), "somebody vanished"


@pytest.mark.parametrize(
    "make, said",
    [
        (lambda downloads: bomb(110 << 20), "larger than"),
        (lambda downloads: nested(downloads, downloads.zipped({"scara.ipynb": b"{}"}), 5), "deep"),
        (lambda downloads: many(2100), "more than 2000 files"),
        (lambda downloads: lying_directory(many(3)), "too many files"),
    ],
    ids=["size", "nesting", "number", "list of names"],
)
def test_archives_that_mean_harm_cost_little_and_name_the_student(make, said, downloads, collect, root, monkeypatch):
    monkeypatch.setattr(archives, "MAX_FILE", 20 << 20)
    people = [student(downloads, "Eve E", make(downloads), "scara.zip"), student(downloads, "Ann A", right(downloads))]
    rows = {row.student: row for row in collect(downloads.moodle(people))}
    assert rows["Ann A"].status == "collected" and handed_in(root, "Eve E") is None
    assert rows["Eve E"].status in ("unreadable", "no notebook") and said in " ".join(rows["Eve E"].remarks)


def test_what_comes_out_of_one_archive_is_bounded_as_a_whole(downloads, collect, root, monkeypatch):
    monkeypatch.setattr(archives, "MAX_FILE", 1 << 20)
    monkeypatch.setattr(archives, "MAX_RATIO", 1)
    blank = downloads.zipped({f"{number}.ipynb": b"{" + b" " * 900_000 for number in range(5)})
    (row,) = collect(downloads.moodle([student(downloads, "Eve E", blank, "scara.zip")]))
    assert "larger than" in " ".join(row.remarks)


def test_the_command_shows_one_table(downloads, root, capsys):
    people = [student(downloads, "Ann A", right(downloads)), student(downloads, "Ben B", b"%PDF", "report.pdf")]
    path = root.parent / "all.zip"
    path.write_bytes(downloads.moodle(people))
    assert cli.main(["collect", "scara", str(path), "--course", str(root)]) == 0
    said = capsys.readouterr().out
    assert re.search(r"Ann A .*collected .*scara\.ipynb", said) and re.search(
        r"Ben B .*no notebook .*report\.pdf", said
    )
    assert "1 collected; 1 no notebook" in said and "not late" not in said
    (root / "term.toml").write_text("[due]\nscara = 2026-10-14\n")
    assert cli.main(["collect", "scara", str(path), "--course", str(root)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert ("when 1 of them handed in is not in the download" in said) == (not list(root.rglob("timestamp.txt")))


def test_who_handed_in_something_else_has_a_line_in_the_class_table(downloads, collect, root):
    people = [student(downloads, "Ann A", right(downloads)), student(downloads, "Ben B", b"%PDF", "report.pdf")]
    collect(downloads.moodle(people))
    (line,) = without_notebook(open_course(root), "scara")
    assert (line.student, line.score, line.found()) == ("Ben B", None, "no notebook: handed in: report.pdf")


def test_what_is_no_notebook_of_it_is_told_again_and_again(downloads, collect, root):
    people = [
        student(downloads, "Ann A", downloads.as_bytes(downloads.answered("planar_2r"))),
        student(downloads, "Ben B", b"%PDF", "report.pdf"),
        student(downloads, "Cid C", b"{", "scara.ipynb"),
    ]
    first = collect(downloads.moodle(people))
    again = collect(downloads.moodle(people))
    assert statuses(first) == {"Ann A": "wrong exercise", "Ben B": "no notebook", "Cid C": "unreadable"}
    assert statuses(again) == statuses(first)
    assert "unreadable" in again[2].remarks[0]
    right_now = [student(downloads, one.name, right(downloads, one.name), hours={"scara.ipynb": 99}) for one in people]
    assert statuses(collect(downloads.moodle(right_now))) == {
        "Ann A": "collected",
        "Ben B": "collected",
        "Cid C": "replaced",
    }


def test_what_cannot_be_collected_is_said(downloads, collect, root):
    with pytest.raises(CourseError, match=r"there is no .*/missing\.zip"):
        collect(root / "missing.zip")
    with pytest.raises(CourseError, match="there is no exercise 'sacra'"):
        collect(b"", exercise="sacra")
    (root / "exercises/scara/scara.ipynb").unlink()
    with pytest.raises(CourseError, match="autograder release scara"):
        collect(b"")


def test_nobody_can_pack_a_file_under_anothers_name(downloads, collect, root):
    """Whatever stands inside of what Eve uploads is Eve's."""
    roster(root, "Ada Lovelace", "Eve E")
    own, forged = right(downloads, "ada", 3), right(downloads, "eve")
    inner = downloads.zipped(
        {"Ada Lovelace_4711_assignsubmission_file_/scara.ipynb": forged, "lovelaceada_3000_999999_scara.ipynb": forged}
    )
    people = [student(downloads, "Ada Lovelace", own), student(downloads, "Eve E", inner, "x.zip", hours={"x.zip": 90})]
    flat = student(downloads, "Eve E", forged, "Ada Lovelace_4711_assignsubmission_file_scara.ipynb")
    plain = downloads.zipped({"Ada Lovelace/scara.ipynb": own, "Eve E.zip": inner})
    for made in (
        downloads.moodle(people), downloads.moodle([people[0], flat], folders=False), downloads.canvas(people),
        downloads.canvas([people[0], flat]), plain, downloads.zipped({"all.zip": downloads.canvas(people)}),
    ):  # fmt: skip
        assert statuses(collect(made, force=True)).keys() == {"s0", "s1"}
        assert (handed_in(root, "s0"), handed_in(root, "s1")) == (own, forged)


def test_the_name_of_the_download_itself_tells_nothing(downloads, collect, root):
    path = root.parent / "submissions_2026_10_12.zip"
    path.write_bytes(downloads.moodle([student(downloads, "Ann A", right(downloads))]))
    assert statuses(collect(path)) == {"Ann A": "collected"}


@pytest.mark.parametrize("names", [("José García", "Jose Garcia"), ("Ann A", "ann a"), ("Ann A", "A. Nna")])
def test_two_whose_names_are_the_same_for_the_roster_stay_two(names, downloads, collect, root):
    (root / "students.csv").write_text(
        f"id,last_name,first_name\nthis,{names[0].split()[1]},{names[0].split()[0]}\n", encoding="utf-8"
    )
    people = [student(downloads, name, right(downloads, str(number))) for number, name in enumerate(names)]
    for made in (downloads.moodle(people), downloads.canvas(people)):
        rows = collect(made)
        found = {row.student for row in rows if row.status != "missing"}
        assert len(found) == 2
        assert {handed_in(root, who) for who in found} == {one.wanted for one in people}


def test_who_was_collected_under_another_name_before_is_told(downloads, collect, root):
    download = downloads.moodle([student(downloads, "Ann A", right(downloads, "ann"))])
    collect(download)
    roster(root, "Ann A")
    (row,) = collect(download)
    assert row.student == "s0" and "was collected as Ann A before" in row.remarks[-1]
    (row,) = collect(download)
    assert row.status == "unchanged" and not row.remarks


def test_an_empty_folder_is_told(downloads, collect, root):
    made = zipfile.ZipFile(file := io.BytesIO(downloads.moodle([student(downloads, "Ann A", right(downloads))])), "a")
    made.writestr("Ben B_4800_assignsubmission_file_/", "")
    made.writestr("Ann A_4711_assignsubmission_file/", "")
    made.close()
    rows = {row.student: row for row in collect(file.getvalue())}
    assert rows["Ben B"].status == "no notebook" and "empty folder" in rows["Ben B"].remarks[0]
    assert rows["Ann A"].status == "collected" and not rows["Ann A"].remarks


def test_names_on_the_roster_are_found_in_names_of_files(downloads, collect, root):
    roster(root, "Ada Lovelace", "Ben B", "Cid C")
    names = ["ada_lovelace_scara.ipynb", "scara (Ben B).ipynb", "TP/Scara-cid-c-2.ipynb"]
    made = downloads.zipped({name: right(downloads, name) for name in names})
    assert statuses(collect(made)) == {"s0": "collected", "s1": "collected", "s2": "collected"}


@pytest.mark.parametrize("name", ["x" * 300, "王" * 120, "a\u202eb\u0007c", "Ann ..", "~", "CON", "-rf", "Ann\u00a0A"])
def test_odd_names_become_folders(name, downloads, collect, root):
    made = downloads.zipped({f"{name}_1_assignsubmission_file/scara.ipynb": (content := right(downloads))})
    (row,) = collect(made)
    assert row.status == "collected" and handed_in(root, row.student) == content
    assert row.student == row.student.strip() and row.student.isprintable()


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be", "utf-8-sig", "cp1252"])
def test_encodings_of_editors_are_read(encoding, downloads, collect, root):
    text = right(downloads, "é").decode()
    collect(downloads.moodle([student(downloads, "Ann A", text.encode(encoding, "ignore"))]))
    found = handed_in(root, "Ann A").decode("utf-8-sig")
    assert found == text.encode(encoding, "ignore").decode(encoding).removeprefix("\ufeff")


@pytest.mark.parametrize(
    "download, paths, names",
    [
        ("all.zip", ["Ann A/scara.ipynb", "Ben B/scara.ipynb"], ["Ann A", "Ben B"]),
        ("all.zip", ["class/Ann A/scara.ipynb", "class/Ben B/x/scara.ipynb"], ["Ann A", "Ben B"]),
        ("all.zip", ["2026/class/Ann A/scara.ipynb", "2026/class/Ben B/scara.ipynb"], ["Ann A", "Ben B"]),
        ("all.zip", ["submitted/ann/scara/scara.ipynb", "submitted/ben/scara/scara.ipynb"], ["ann", "ben"]),
        ("all.zip", ["scara/Ann A/scara.ipynb", "scara/Ben B/scara.ipynb"], ["Ann A", "Ben B"]),
        ("Ann A.zip", ["scara/scara.ipynb"], ["Ann A"]),
        ("Ann A.zip", ["exercises/scara/scara.ipynb"], ["Ann A"]),
        ("Ann A.zip", ["scara.ipynb"], ["Ann A"]),
        ("all.zip", ["Ann A/scara/scara.ipynb"], ["Ann A"]),
        ("all.zip", ["all/Ann A/scara.ipynb"], ["Ann A"]),
        ("all.zip", ["Ann A.ipynb", "Ben B.ipynb"], ["Ann A", "Ben B"]),
        ("all.zip", ["ann_scara.ipynb", "scara-ben (1).ipynb"], ["ann", "ben"]),
        ("Ann A.zip", ["scara.ipynb", "scara (1).ipynb", "scara_final.ipynb"], ["Ann A"]),
    ],
)
def test_a_plain_zip_is_read_by_its_folders(download, paths, names, downloads, collect, root):
    path = root.parent / download
    path.write_bytes(downloads.zipped({one: right(downloads, one) for one in paths}))
    assert statuses(collect(path)) == dict.fromkeys(names, "collected")
