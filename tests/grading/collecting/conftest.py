"""Downloads as Moodle, Canvas and lecturers' own hands make them, with everything that students upload."""

import io
import json
import re
import shutil
import unicodedata
import zipfile
from copy import deepcopy
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from pathlib import Path
from types import SimpleNamespace

import nbformat
import pytest

from autograder.grading.course import open_course

REPOSITORY = Path(__file__).resolve().parents[3]
START = datetime(2026, 10, 12, 9, 30)


def released(exercise):
    return nbformat.read(REPOSITORY / "exercises" / exercise / f"{exercise}.ipynb", as_version=4)


def answered(exercise, who="nobody", count=99):
    """The released notebook, `count` answers typed by `who`."""
    nb = deepcopy(released(exercise))
    answers = [cell for cell in nb.cells if cell.metadata.get("nbgrader", {}).get("solution")]
    for cell in answers[:count]:
        cell.source = f"x = 1  # {who}"
    for cell in nb.cells:
        if re.match(r"student = \.\.\.", cell.source):
            cell.source = f"student = {who!r}"
    return nb


def as_bytes(nb):
    return json.dumps(nb, ensure_ascii=False).encode()


def without_metadata(nb):
    nb = deepcopy(nb)
    for cell in nb.cells:
        cell.metadata = {}
        cell.pop("id", None)
    return as_bytes({**nb, "metadata": {"colab": {"provenance": []}}, "nbformat_minor": 0})


def zipped(files, names_in="utf-8", password=False, times=None):
    """A zip of `files`; `names_in` is the encoding of their names, as tools without the mark for UTF-8 write them."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            written = (times or {}).get(name, START)
            info = zipfile.ZipInfo("placeholder", written.timetuple()[:6])
            info.filename = name if names_in == "utf-8" else name.encode(names_in).decode("cp437")
            info.compress_type = zipfile.ZIP_DEFLATED
            if isinstance(content, Path):  # a link
                info.external_attr, content = 0o120777 << 16, str(content).encode()
            archive.writestr(info, content)
    content = packed.getvalue()
    if password:
        content = encrypted(content)
    return content


def encrypted(content):
    """The zip marked as encrypted in every entry."""
    content = bytearray(content)
    for signature, place in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        start = 0
        while (start := content.find(signature, start)) >= 0:
            content[start + place] |= 1
            start += 4
    return bytes(content)


@dataclass
class Upload:
    """What one student uploads, and what has to become of it."""

    name: str
    files: dict
    status: str
    says: str = ""
    wanted: bytes | None = None
    hours: dict = field(default_factory=dict)


def uploads():
    """A class in which everybody does something else; the exercise is scara."""
    found = []

    def add(name, files, status="collected", says="", wanted=..., hours=()):
        files = {key: value(name) if callable(value) else value for key, value in files.items()}
        if wanted is ...:
            wanted = next(iter(files.values())) if status == "collected" else None
        elif callable(wanted):
            wanted = wanted(name)
        found.append(Upload(name, files, status, says, wanted, dict(hours)))

    def right(name):
        return as_bytes(answered("scara", name))

    def older(name):
        return as_bytes(answered("scara", name, 3))

    def in_zip(*names, **more):
        return lambda name: zipped({one: right(name) for one in names}, **more)

    add("Ada Lovelace", {"scara.ipynb": right})
    add("José O'Brien", {"scara.ipynb": right})
    add("Kwame N'Diaye-Smith", {"scara.ipynb": right})
    add("Nguyễn Thị Hương", {"scara.ipynb": right})
    add("王小明", {"scara.ipynb": right})
    add("Capital Letter", {"Scara.ipynb": right})
    add("Other Name", {"TP4_final.ipynb": right})
    add("Colab Copy", {"Copy of scara.ipynb": right})
    add("French Colab", {"Copie de scara.ipynb": right})
    add("Safari User", {"scara.ipynb.txt": right})
    add("Windows User", {"scara.ipynb.json": right})
    add("Browser Copy", {"scara (1).ipynb": right})
    add("Own Name", {"scara-Own.ipynb": right})
    add("Colab Lost", {"Untitled3.ipynb": lambda name: without_metadata(answered("scara", name))})
    add("With Mark", {"scara.ipynb": lambda name: b"\xef\xbb\xbf" + right(name)})
    add(
        "Old Lines",
        {"scara.ipynb": lambda name: json.dumps(answered("scara", name), indent=1).replace("\n", "\r\n").encode()},
    )
    add(
        "Wide Letters", {"scara.ipynb": lambda name: right(name).decode().encode("utf-16")}, says="UTF-16", wanted=right
    )
    latin = lambda name: right(name + " é").decode().encode("cp1252", "ignore")  # noqa: E731
    add(
        "Latin Letters",
        {"scara.ipynb": latin},
        says="Windows-1252",
        wanted=lambda name: latin(name).decode("cp1252").encode(),
    )
    add("Zipped Folder", {"scara.zip": in_zip("scara/scara.ipynb")}, wanted=right)
    add("Other Zip", {"Rendu TP.zip": in_zip("scara.ipynb")}, wanted=right)
    add("Whole Path", {"scara.zip": in_zip("exercises/scara/scara.ipynb")}, wanted=right)
    add("Sub Folder", {"exercises/scara/scara.ipynb": right})
    add("Zip Inzip", {"a.zip": lambda name: zipped({"b.zip": zipped({"scara.ipynb": right(name)})})}, wanted=right)
    mac = {"__MACOSX/scara/._scara.ipynb": b"\0\x05\x16\x07", "scara/.DS_Store": b"\0"}
    add("Mac User", {"scara.zip": lambda name: zipped({"scara/scara.ipynb": right(name), **mac})}, wanted=right)
    add("Mac Archive", {"Archive.zip": lambda name: zipped({**mac, "scara.ipynb": right(name)})}, wanted=right)
    checkpoint = "scara/.ipynb_checkpoints/scara-checkpoint.ipynb"
    add(
        "Check Point",
        {"scara.zip": lambda name: zipped({checkpoint: older(name), "scara/scara.ipynb": right(name)})},
        wanted=right,
    )
    add("Two Files", {"scara.ipynb": older, "scara (1).ipynb": right}, says="newest of 2", wanted=right,
        hours={"scara.ipynb": 1, "scara (1).ipynb": 30})  # fmt: skip
    add("Twice Same", {"scara.ipynb": right, "scara (2).ipynb": right}, wanted=right)
    add("Blank Later", {"scara.ipynb": right, "scara (1).ipynb": as_bytes(released("scara"))}, wanted=right,
        hours={"scara (1).ipynb": 40})  # fmt: skip
    add("Everything Zipped", {"robots.zip": lambda name: zipped({
        "exercises/scara/scara.ipynb": right(name), "exercises/planar_2r/planar_2r.ipynb": as_bytes(answered("planar_2r", name)),
        "exercises/scara_s600/scara_s600.ipynb": as_bytes(released("scara_s600")), "venv/lib/x.json": b'{"a": 1}'})}, wanted=right)  # fmt: skip
    add("Report Too", {"report.pdf": b"%PDF-1.7", "scara.ipynb": right}, wanted=right)
    add("Odd Names", {"scara.zip": in_zip("élève/scara.ipynb", names_in="cp850")}, wanted=right)
    add("Decomposed Names", {"scara.zip": in_zip(unicodedata.normalize("NFD", "élève/scara.ipynb"))}, wanted=right)
    add("Escape Artist", {"scara.zip": in_zip("../../../../tmp/escaped/scara.ipynb")}, wanted=right)
    add("Absolute Path", {"scara.zip": in_zip("/etc/scara.ipynb")}, wanted=right)
    add("Backslash Path", {"scara.zip": in_zip("..\\..\\scara\\scara.ipynb")}, wanted=right)
    add("Deep Big", {"scara.ipynb": lambda name: right(name)[:-1] + b', "x": "' + b"a" * 3_000_000 + b'"}'})

    add("Wrong Exercise", {"planar_2r.ipynb": as_bytes(answered("planar_2r"))}, "wrong exercise", "planar_2r")
    add("Wrong Renamed", {"scara.ipynb": as_bytes(answered("planar_2r"))}, "wrong exercise", "planar_2r")
    add("Wrong Lost", {"scara.ipynb": without_metadata(answered("tables"))}, "wrong exercise", "tables")
    add("Only Python", {"scara.py": b"print(1)"}, "no notebook", "scara.py")
    add("Only Report", {"rapport.pdf": b"%PDF-1.7", "photo.jpg": b"\xff\xd8\xff"}, "no notebook", "rapport.pdf")
    add("Only Page", {"scara.html": b"<!doctype html>"}, "no notebook", "scara.html")
    add("Only Word", {"scara.docx": zipped({"word/document.xml": b"<x/>"})}, "no notebook", "scara.docx")
    add("Other Notebook", {"homework.ipynb": as_bytes(nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("1 + 1")]))},
        "no notebook", "none of this course's")  # fmt: skip
    add("Empty Zip", {"scara.zip": zipped({"scara/.DS_Store": b""})}, "no notebook", "scara.zip")
    add("Empty File", {"scara.ipynb": b""}, "unreadable", "empty", wanted=b"")
    add(
        "Cut Off",
        {"scara.ipynb": lambda name: right(name)[:5000]},
        "unreadable",
        "cut off",
        wanted=lambda name: right(name)[:5000],
    )
    add("Secret Zip", {"scara.zip": in_zip("scara.ipynb", password=True)}, "unreadable", "password")
    add("Broken Zip", {"scara.zip": lambda name: in_zip("scara.ipynb")(name)[:-40]}, "unreadable", "damaged")
    add("Winrar User", {"scara.rar": b"Rar!\x1a\x07\x01\x00" + b"x" * 50}, "unreadable", "RAR")
    add("Seven Zip", {"scara.zip": b"7z\xbc\xaf\x27\x1c" + b"x" * 50}, "unreadable", "7z")
    add("Link Only", {"scara.zip": zipped({"scara.ipynb": Path("/etc/passwd")})}, "no notebook", "scara.zip")
    return found


def moodle_name(name):
    """As Moodle's clean_filename leaves it."""
    return re.sub(r"[&<>\"'`|:\\/]", "", name.replace("_", " "))


def canvas_name(name):
    """As Canvas's sanitizers leave the sortable name."""
    first, _, last = name.rpartition(" ")
    return re.sub(r"[^\w]", "", f"{last}, {first}".lower())


def moodle(people, folders=True, first=4711, name=moodle_name, real_times=True):
    files, times = {}, {}
    for number, one in enumerate(people, first):
        for place, (file, content) in enumerate(one.files.items()):
            prefix = f"{name(one.name)}_{number}_assignsubmission_file"
            path = f"{prefix}/{file}" if folders else f"{prefix}_{file.replace('/', '_')}"
            files[path] = content
            hours = one.hours.get(file, number - first + place)
            times[path] = START + (timedelta(hours=hours) if real_times else timedelta(seconds=2 * place))
    return zipped(files, times=times)


def canvas(people, first=3000, late=(), anonymous=False, upload=200_000):
    files = {}
    for number, one in enumerate(people, first):
        for file, content in one.files.items():
            upload += 7
            who = (
                f"anon_a{number}Z"
                if anonymous
                else f"{canvas_name(one.name)}{'_LATE' if one.name in late else ''}_{number}"
            )
            files[f"{who}_{upload}_{file.rpartition('/')[2]}"] = content
    return zipped(files)


@pytest.fixture(scope="session")
def downloads():
    """The helpers of this file, by name."""
    return SimpleNamespace(
        Upload=Upload, uploads=uploads, moodle=moodle, canvas=canvas, zipped=zipped, answered=answered,
        as_bytes=as_bytes, moodle_name=moodle_name, canvas_name=canvas_name, released=released, START=START,
    )  # fmt: skip


@pytest.fixture
def root(tmp_path):
    """A course with all exercises that nobody handed in to."""
    root = tmp_path / "course"
    root.mkdir()
    shutil.copy(REPOSITORY / "nbgrader_config.py", root)
    for step in ("solutions", "exercises"):
        for exercise in ("scara", "planar_2r", "tables", "scara_s600"):
            folder = root / step / exercise
            folder.mkdir(parents=True)
            shutil.copy(REPOSITORY / step / exercise / f"{exercise}.ipynb", folder)
    return root


@pytest.fixture
def collect(root):
    """Collects scara from contents or paths; rows by student."""
    from autograder.grading.collecting import collect as module

    def run(*contents, exercise="scara", worksheets=(), force=False):
        paths = []
        for number, content in enumerate(contents):
            path = content if isinstance(content, Path) else root.parent / f"all-{number}.zip"
            if path is not content:
                path.write_bytes(content)
            paths.append(path)
        return module.collect(open_course(root), exercise, paths, worksheets, force)

    return run
