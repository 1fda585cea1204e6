"""A course folder: where it is, what it holds, and nbgrader opened on it."""

from __future__ import annotations

import logging
import os
from dataclasses import dataclass
from pathlib import Path

from nbgrader.apps import NbGrader
from nbgrader.converters.base import BaseConverter, NbGraderException
from traitlets.config import Config

from .host import prepare
from .plugins.converters import student_names

CONFIG = "nbgrader_config.py"


class CourseError(Exception):
    """The command cannot do what was asked; the message is for the person who typed it."""


def find_root(given: str | None) -> Path:
    """The course root: `given`, or the nearest folder at or above the current one with nbgrader_config.py."""
    if given is not None:
        root = Path(given).resolve()
        if not (root / CONFIG).is_file():
            raise CourseError(f"{root} is not a course folder: it has no {CONFIG}")
        return root
    here = Path.cwd()
    for root in (here, *here.parents):
        if (root / CONFIG).is_file():
            return root
    raise CourseError(
        f"neither {here} nor a folder above it has a {CONFIG}; go to the course folder or say --course DIR"
    )


@dataclass(frozen=True)
class Course:
    """nbgrader's application, configured by the course's own file, and the folders it works on."""

    root: Path
    app: NbGrader

    def step(self, name: str, student: str = ".", exercise: str = "") -> Path:
        """Folder of a step: ``source``, ``release``, ``submitted``, ``autograded`` or ``feedback``."""
        directory = getattr(self.app.coursedir, f"{name}_directory")
        return Path(self.app.coursedir.format_path(directory, student, exercise))

    def exercises(self) -> list[str]:
        """Exercises that have a solution notebook."""
        return sorted({path.parent.name for path in self.step("source").glob("*/*.ipynb")})

    def require(self, exercise: str) -> None:
        """`CourseError` with the exercises that exist if `exercise` is none of them."""
        known = self.exercises()
        if exercise not in known:
            raise CourseError(f"there is no exercise {exercise!r}; there are: {', '.join(known) or 'none'}")

    def choose(self, exercise: str) -> None:
        """Tell nbgrader which exercise its converters work on; `CourseError` if there is no such exercise."""
        self.require(exercise)
        self.app.coursedir.assignment_id = exercise

    def students(self, exercise: str) -> list[str]:
        """Students with a folder for `exercise` among the submissions."""
        submitted = self.step("submitted")
        return [name for name in student_names(submitted) if self.step("submitted", name, exercise).is_dir()]

    def submissions(self, exercises: list[str], students: list[str]) -> dict[str, list[str]]:
        """Who is to be graded, by exercise; an empty list means all exercises, or everybody.

        Raises
        ------
        CourseError
            If an exercise or a student does not exist, with those that do; if nobody handed in anything.
        """
        for exercise in exercises:
            self.require(exercise)
        handed_in = {exercise: self.students(exercise) for exercise in exercises or self.exercises()}
        everybody = sorted({name for names in handed_in.values() for name in names})
        if not everybody:
            raise CourseError(
                f"nobody handed in anything: {self.step('submitted', '*', ' or '.join(handed_in))} is empty"
            )
        for name in students:
            if name not in everybody:
                which = " or ".join(handed_in)
                raise CourseError(f"{name!r} handed in nothing for {which}; handed in: {', '.join(everybody)}")
        wanted = {
            exercise: [name for name in names if not students or name in students]
            for exercise, names in handed_in.items()
        }
        return {exercise: names for exercise, names in wanted.items() if names}

    def unusable_folders(self, exercise: str) -> list[str]:
        """Names of submission folders that hold line breaks or other characters that nbgrader cannot work with."""
        step = self.step("submitted")
        names = os.listdir(step) if step.is_dir() else []
        return sorted(name for name in names if not name.isprintable() and (step / name / exercise).is_dir())


def open_course(root: Path, config: Config | None = None, verbose: bool = False) -> Course:
    """nbgrader on the course in `root`; `config` comes on top of the course's own configuration."""
    prepare()
    app = NbGrader()
    app.load_cwd_config = False
    app.log_level = logging.INFO if verbose else logging.ERROR
    app.initialize([], root=str(root))
    for handler in app.log.handlers if not verbose else ():
        handler.setLevel(logging.CRITICAL + 1)
    if config:
        app.update_config(config)
    return Course(root, app)


def convert(converter: BaseConverter) -> None:
    """Run a converter of nbgrader; `CourseError` with its reason if it fails."""
    kept = _Kept()
    converter.log.addHandler(kept)
    try:
        converter.start()
    except NbGraderException as error:
        raise CourseError(kept.reason() or str(error)) from None
    finally:
        converter.log.removeHandler(kept)


class _Kept(logging.Handler):
    """Keeps what nbgrader logs as errors: the exceptions it raises do not say what went wrong."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(record.getMessage().strip())

    def reason(self) -> str | None:
        with_traceback = [message for message in self.messages if message.startswith("Traceback")]
        return next((message.splitlines()[-1] for message in with_traceback + self.messages), None)
