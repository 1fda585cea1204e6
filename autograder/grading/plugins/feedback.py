"""nbgrader's GenerateFeedback, which writes each page as a whole and marks what it shows."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

from jinja2 import BytecodeCache, Environment
from jinja2.bccache import Bucket
from nbconvert.exporters.html import HTMLExporter
from nbgrader.api import Student
from nbgrader.converters import GenerateFeedback
from nbgrader.converters.base import NbGraderException
from traitlets.config import Config

from ..errors import CourseError
from ..files import digest_of, remove_others, staged
from ..gradebook import reading, writing
from ..store import StoredNotebook, mark_page, stored_notebooks
from .autograde import ChosenStudents

TEMPLATES = str(Path(__file__).parent / "templates")
# How often a page is written again because somebody marked the submission meanwhile.
_TRIES = 5


class _Compiled(BytecodeCache):
    """Templates that this process has compiled: nbconvert would compile them anew for every student."""

    def __init__(self) -> None:
        self.kept: dict[str, bytes] = {}

    def load_bytecode(self, bucket: Bucket) -> None:
        if (kept := self.kept.get(bucket.key)) is not None:
            bucket.bytecode_from_string(kept)

    def dump_bytecode(self, bucket: Bucket) -> None:
        self.kept[bucket.key] = bucket.bytecode_to_string()


_COMPILED = _Compiled()


class FeedbackExporter(HTMLExporter):
    """The feedback page: nbgrader's, with a summary on top, and nothing that is loaded or runs: it can be read offline."""

    def __init__(self, config: Config | None = None, **kw: Any) -> None:
        own = deepcopy(config or Config())
        # nbgrader configures HTMLExporter for pages of its own; a section of the subclass goes before that.
        own.FeedbackExporter.template_name = "feedback_page"
        nbgrader_templates = own.HTMLExporter.get("extra_template_basedirs", [])
        own.FeedbackExporter.extra_template_basedirs = [TEMPLATES, *nbgrader_templates]
        own.FeedbackExporter.extra_template_paths = [
            *own.HTMLExporter.get("extra_template_paths", []),
            *nbgrader_templates,
        ]
        super().__init__(config=own, **kw)

    def _create_environment(self) -> Environment:
        environment = super()._create_environment()
        environment.bytecode_cache = _COMPILED
        return environment


class FeedbackPages(ChosenStudents, GenerateFeedback):
    """GenerateFeedback for given students; a page that shows what the gradebook holds is passed over unless forced."""

    def init_notebooks(self) -> None:
        exercise = self.coursedir.assignment_id
        self.notebooks = ["*"]
        if not self.chosen():
            message = f"nothing was graded for {exercise} yet; run: autograder grade {exercise}"
            self.log.error(message)
            raise NbGraderException(message)

    def chosen(self) -> list[str]:
        return [student for student in super().chosen() if any(self.folder(student).glob("*.ipynb"))]

    def convert_student(self, student: str) -> None:
        exercise = self.coursedir.assignment_id
        target = Path(self._format_dest(exercise, student))
        for _ in range(_TRIES):
            with reading(self.coursedir.db_url) as session:
                found = {name: one for (_, name), one in stored_notebooks(session, exercise, student).items()}
                whose = _in_full(session.get(Student, student), student)
            names = [path.stem for path in sorted(self.folder(student).glob("*.ipynb"))]
            if not self.force and all(
                name in found and found[name].has_page(target / f"{name}.html") for name in names
            ):
                return
            pages = {f"{name}.html": self._page(student, whose, name, found.get(name)) for name in names}
            with writing(self.coursedir.db_url) as session:
                now = {name: one for (_, name), one in stored_notebooks(session, exercise, student).items()}
                if any(now[name].shown() != found[name].shown() for name in names):
                    continue
                for name in names:
                    mark_page(session, now[name], pages[f"{name}.html"])
                with staged(target, pages, int(str(self.permissions), 8)) as put_in_place:
                    put_in_place()
                remove_others(target, pages)
            if self.coursedir.groupshared:
                self.set_permissions(exercise, student)
            return
        raise CourseError("somebody is marking it at this moment; run the command again")

    def _page(self, student: str, whose: str, name: str, stored: StoredNotebook | None) -> bytes:
        """The feedback page of a graded notebook."""
        exercise, path = self.coursedir.assignment_id, self.folder(student) / f"{name}.ipynb"
        graded_again = f"run: autograder grade {exercise}"
        if stored is None:
            raise CourseError(f"the gradebook does not know {path}; {graded_again}")
        if stored.mark is not None and stored.mark.graded != digest_of(path):
            raise CourseError(f"{path} is not what the gradebook holds; {graded_again}")
        resources: dict[str, Any] = {"unique_key": name, "output_files_dir": f"{name}_files", "whose": whose}
        resources["stored"] = replace(stored, mark=None)
        resources["nbgrader"] = {
            "student": student, "assignment": exercise, "notebook": name, "db_url": self.coursedir.db_url
        }  # fmt: skip
        page, _ = self.exporter.from_filename(str(path), resources=resources)
        return page.encode()


def _in_full(student: Student | None, id: str) -> str:
    """The name of a student with the id; the id alone where nobody entered a name."""
    name = " ".join(filter(None, (student.first_name, student.last_name))) if student is not None else ""
    return f"{name} ({id})" if name else id
