"""Writes the sample class: a course folder with the submissions of students who never were.

python tests/sample_class/write.py FOLDER [--short] [--harmless] [--exercise NAME]
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
from pathlib import Path

from edits import (
    FILE_EDITS,
    NOTEBOOK_EDITS,
    Files,
    Notebook,
    answer,
    as_file,
    position,
    released,
    signed,
    solved,
    undrawn,
)
from expected import HERE, Submission, submissions

REPOSITORY = HERE.parents[1]
MARK = "SAMPLE_CLASS"
COPIED = ("nbgrader_config.py", "solutions", "exercises")


class NotOurs(Exception):
    """The folder holds something that is not a sample class; the message is for the person who typed its name."""


def solution(exercise: str) -> Notebook:
    """The instructor's notebook of an exercise, as JSON data."""
    return json.loads((REPOSITORY / "solutions" / exercise / f"{exercise}.ipynb").read_text(encoding="utf-8"))


def hand_in(submission: Submission, source: Notebook, course: Path = Path("/course")) -> Files:
    """The files a student hands in, made from the instructor's notebook `source` by the submission's edits."""
    name = f"{submission.exercise}.ipynb"
    nb = signed(_answered(submission, source), submission.student)
    for question, code in submission.answers.items():
        nb = answer(nb, source, f"{submission.exercise}-{question}-answer", _placed(code, course))
    steps = [{key: _placed(value, course) for key, value in edit.items()} for edit in submission.edits]
    for step in steps:
        if step["do"] in NOTEBOOK_EDITS:
            nb = NOTEBOOK_EDITS[step["do"]](nb, **_arguments(step))
    files = {name: as_file(nb)}
    for step in steps:
        if step["do"] in FILE_EDITS:
            files = FILE_EDITS[step["do"]](files, **_arguments(step))
        elif step["do"] not in NOTEBOOK_EDITS:
            raise ValueError(f"{submission.student}: there is no edit {step['do']!r}")
    return files


def _answered(submission: Submission, source: Notebook) -> Notebook:
    """The notebook with the instructor's answers to those questions that the student answered."""
    nb = solved(source)
    if submission.answered is None:
        return nb
    stubs = released(source)
    for cell in stubs["cells"]:
        name = cell["metadata"].get("nbgrader", {}).get("grade_id", "")
        question = name.removeprefix(f"{submission.exercise}-").removesuffix("-answer")
        if name.endswith("-answer") and question not in submission.answered:
            nb["cells"][position(nb, name)]["source"] = cell["source"]
    return nb


def _placed(value: object, course: Path) -> object:
    if not isinstance(value, str):
        return value
    return value.replace("@COURSE@", str(course)).replace("@REPOSITORY@", str(REPOSITORY)).strip("\n")


def _arguments(step: dict) -> dict:
    return {key: value for key, value in step.items() if key != "do"}


def write_class(
    folder: Path, harmless: bool = False, short: bool = False, sparse: bool = False, exercise: str | None = None
) -> list[Submission]:
    """Make `folder` a course with the sample class in it; an earlier sample class there is replaced.

    Parameters
    ----------
    folder : Path
        New, empty, or an earlier sample class. Grades and feedback that are there already stay.
    harmless : bool
        Leave out what could do harm on a machine without a sandbox.
    short : bool
        Write only one right notebook and one with named mistakes for every exercise, and one submission of every other kind.
    sparse : bool
        Let only the submissions of the short class draw; in the others, cells that do nothing else are missing. Drawing is
        most of what running a notebook costs.
    exercise : str, optional
        The only exercise of which submissions are written.

    Returns
    -------
    list of Submission
        Those that were written.

    Raises
    ------
    NotOurs
        If the folder holds something else; nothing is changed then.
    """
    folder = folder.resolve()
    if folder.exists() and not (folder / MARK).is_file() and (not folder.is_dir() or any(folder.iterdir())):
        raise NotOurs(f"{folder} is not empty and not a sample class; give a new folder, or empty this one first")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / MARK).write_text("Written by tests/sample_class/write.py, which may replace everything in here.\n")
    for name in (*COPIED, "submitted"):
        _forget(folder / name)
    for name in COPIED:
        if (REPOSITORY / name).is_dir():
            shutil.copytree(REPOSITORY / name, folder / name, ignore=shutil.ignore_patterns(".ipynb_checkpoints"))
        elif (REPOSITORY / name).is_file():
            shutil.copyfile(REPOSITORY / name, folder / name)
    chosen = [submission for submission in submissions() if not (harmless and submission.harmful)]
    if exercise is not None:
        chosen = [one for one in chosen if one.exercise == exercise]
    if short:
        chosen = [one for one in chosen if _is_in_short_class(one)]
    sources = {exercise: solution(exercise) for exercise in {submission.exercise for submission in chosen}}
    for submission in chosen:
        place = folder / "submitted" / submission.student / submission.exercise
        place.mkdir(parents=True)
        source = sources[submission.exercise]
        if sparse and not _is_in_short_class(submission):
            source = undrawn(source)
        for name, content in hand_in(submission, source, folder).items():
            (place / name).write_bytes(content)
    return chosen


def _is_in_short_class(submission: Submission) -> bool:
    return submission.stock or submission.student in ("right", "mistakes-1")


def _forget(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def main() -> int:
    parser = argparse.ArgumentParser(description="Write the sample class: a course folder with submissions to grade.")
    parser.add_argument("folder", type=Path, help="new, empty, or an earlier sample class, which is replaced")
    parser.add_argument("--harmless", action="store_true", help="leave out what could do harm without a sandbox")
    parser.add_argument("--short", action="store_true", help="write a part of the class: one submission of every kind")
    parser.add_argument("--exercise", help="write the submissions of this exercise only")
    options = parser.parse_args()
    try:
        written = write_class(options.folder, options.harmless, options.short, exercise=options.exercise)
    except NotOurs as reason:
        print(f"write.py: {reason}", file=sys.stderr)
        return 2
    students = len({submission.student for submission in written})
    print(f"{options.folder}: {len(written)} submissions of {students} students")
    return 0


if __name__ == "__main__":
    sys.exit(main())
