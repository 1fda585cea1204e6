"""A course folder: where it is, what it holds, and nbgrader opened on it."""

from __future__ import annotations

import logging
import os
import traceback
from dataclasses import dataclass, field
from pathlib import Path

from nbgrader.apps import NbGrader
from nbgrader.converters.base import BaseConverter, NbGraderException
from traitlets.config import Config
from traitlets.config.loader import FileConfigLoader

from .errors import CourseError, in_words
from .folders import student_names, unusable_names
from .host import prepare

CONFIG = "nbgrader_config.py"


def find_root(given: str | None) -> Path:
    """The course root: `given`, or the nearest folder at or above the current one with nbgrader_config.py."""
    if given is None or not os.path.isabs(given):
        try:
            os.getcwd()
        except FileNotFoundError:
            raise CourseError("the current folder was removed; go to the course folder or say --course DIR") from None
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
    settings: Config = field(default_factory=Config)
    """What was configured on top of the course's own file."""

    @property
    def db_url(self) -> str:
        """Where nbgrader keeps the gradebook."""
        return self.app.coursedir.db_url

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

        An exercise for which there are only folders with unusable names comes with an empty list.

        Raises
        ------
        CourseError
            If an exercise or a student does not exist, with those that do; if nobody handed in anything.
        """
        for exercise in exercises:
            self.require(exercise)
        handed_in = {exercise: self.students(exercise) for exercise in exercises or self.exercises()}
        everybody = sorted({name for names in handed_in.values() for name in names})
        unusable = {exercise for exercise in handed_in if self.unusable_folders(exercise)}
        if not everybody and not unusable:
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
        return {exercise: names for exercise, names in wanted.items() if names or exercise in unusable}

    def unusable_folders(self, exercise: str) -> dict[str, str]:
        """Folders with something for `exercise` whose names cannot be students' ids, with the reason."""
        step = self.step("submitted")
        return {name: why for name, why in unusable_names(step).items() if (step / name / exercise).is_dir()}


def open_course(root: Path, config: Config | None = None, verbose: bool = False) -> Course:
    """nbgrader on the course in `root`; `config` comes on top of the course's own configuration."""
    try:
        os.getcwd()
    except FileNotFoundError:
        # nbgrader goes back to the current folder after each step, so there has to be one.
        os.chdir(root)
    prepare()
    app = NbGrader()
    app.load_cwd_config = False
    app.raise_config_file_errors = True
    app.log_level = logging.INFO if verbose else logging.ERROR
    try:
        app.initialize([], root=str(root))
    except Exception as error:
        file = _configuration(error) or root / CONFIG
        raise CourseError(f"{file} cannot be used ({in_words(error)}); mend it or move it away") from error
    for handler in app.log.handlers if not verbose else ():
        handler.setLevel(logging.CRITICAL + 1)
    if config:
        app.update_config(config)
    return Course(root, app, config or Config())


def _configuration(error: Exception) -> str | None:
    """The file of configuration that was being read when `error` came up."""
    found = None
    for frame, _ in traceback.walk_tb(error.__traceback__):
        loader = frame.f_locals.get("self")
        if isinstance(loader, FileConfigLoader):
            found = loader.full_filename
    return found


def convert(converter: BaseConverter) -> None:
    """Run a converter of nbgrader; `CourseError` with its reason if it fails."""
    try:
        converter.start()
    except NbGraderException as error:
        raise error.__cause__ if isinstance(error.__cause__, CourseError) else CourseError(str(error)) from None
