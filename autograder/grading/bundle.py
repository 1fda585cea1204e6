"""The zip that students get: lectures, exercises and the kit, and nothing of the instructor's."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Iterable
from pathlib import Path

from dhkit.home.envelopes import SUFFIX
from dhkit.variants import LIST, mark

from .errors import CourseError
from .roster import read_roster

FOLDERS = ("course", "exercises")
FOR_LECTURERS = ("course/15_errata.ipynb",)
"""Notebooks that stay with the lecturer: they answer "find the slide's error" and import the autograder."""

IDS = f"course/dhkit/{LIST}"
"""With it the kit tells who types an id that is not on the roster; it names nobody."""

_LEFT_OUT = {"build", "node_modules", "__pycache__", ".ipynb_checkpoints", ".pytest_cache"}
_MARKS = ("BEGIN SOLUTION", "END SOLUTION", "BEGIN HIDDEN TESTS")
_EPOCH = (1980, 1, 1, 0, 0, 0)

README = """\
# Modified Denavit-Hartenberg robots: lectures and exercises

You need Python 3.11 or newer. In this folder:

    python3 -m venv .venv
    .venv/bin/pip install -r course/requirements.txt ./course
    .venv/bin/jupyter lab

(On Windows: `.venv\\Scripts\\pip` and `.venv\\Scripts\\jupyter`.)

* `course/` holds the lecture notebooks, to be read in their order.
* `exercises/` holds one folder per exercise. Fill in the answer cells, run everything from top to bottom, and
  hand in the notebook under its own name. `hint(...)` helps you on.
* `check(...)` says at once where an answer is right, or which mistake it shows; `solution(...)` unfolds once yours is
  right, `progress()` counts, `practice("scara.postures")` gives other numbers to try with. The right answers are in no
  file: yours opens a verdict that was sealed for it. Some answers would be found by trying; these the grader decides.
  The points are given by the instructor.
* In Google Colab, upload `<exercise>.sealed` beside the notebook, and install the kit: `%pip install ./course`.
"""


def write_bundle(root: Path, target: Path) -> list[str]:
    """Write the zip `target` from the course in `root`; returns the names inside.

    Raises
    ------
    CourseError
        If there is nothing to hand out, or a file would give a solution away; nothing is written then.
    """
    files = {path.relative_to(root).as_posix(): path for folder in FOLDERS for path in _files(root / folder)}
    files = {name: path for name, path in files.items() if name not in FOR_LECTURERS}
    if not any(name.startswith("exercises/") and name.endswith(".ipynb") for name in files):
        raise CourseError("there are no exercises to hand out; run: autograder release")
    for name, path in files.items():
        if path.suffix == ".ipynb":
            _refuse_leak(name, path)
    top = target.stem
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(zipfile.ZipInfo(f"{top}/README.md", _EPOCH), README + _unsealed(files), zipfile.ZIP_DEFLATED)
        for name, path in files.items():
            archive.writestr(zipfile.ZipInfo(f"{top}/{name}", _EPOCH), path.read_bytes(), zipfile.ZIP_DEFLATED)
        if people := read_roster(root).people:
            marks = "".join(sorted(f"{mark(person.id)}\n" for person in people))
            archive.writestr(zipfile.ZipInfo(f"{top}/{IDS}", _EPOCH), marks, zipfile.ZIP_DEFLATED)
    return ["README.md", *files, *([IDS] if people else [])]


def _unsealed(files: Iterable[str]) -> str:
    """A line on the exercises whose copies tell the form only; nothing if there are none."""
    folders = {name.split("/")[1] for name in files if name.startswith("exercises/")}
    sealed = {name.split("/")[1] for name in files if name.endswith(SUFFIX)}
    told = ", ".join(sorted(folders - sealed))
    return f"* Without verdicts at home, form only: {told}.\n" if told else ""


def _files(folder: Path) -> list[Path]:
    return [
        path
        for path in sorted(folder.rglob("*"))
        if path.is_file()
        and not path.is_symlink()
        and not any(part in _LEFT_OUT or part.endswith(".egg-info") for part in path.relative_to(folder).parts)
    ]


def _refuse_leak(name: str, path: Path) -> None:
    """`CourseError` if an exercise is not as it was released, or a lecture holds a solution's marks."""
    from nbformat import from_dict
    from nbgrader.utils import compute_checksum, is_solution

    notebook = json.loads(path.read_text(encoding="utf-8"))
    for cell in notebook["cells"]:
        source = "".join(cell["source"])
        if any(mark in source for mark in _MARKS):
            raise CourseError(f"{name} holds a solution; run: autograder release")
        cell = from_dict({**cell, "source": source})
        if is_solution(cell) and cell.metadata.nbgrader.get("checksum") != compute_checksum(cell):
            where = f"{name}: cell {cell.metadata.nbgrader.grade_id}"
            raise CourseError(f"{where} is not as it was released; run: autograder release")
