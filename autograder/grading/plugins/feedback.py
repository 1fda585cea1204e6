"""nbgrader's GenerateFeedback, which writes each page as a whole and marks what it shows."""

from __future__ import annotations

import re
from copy import deepcopy
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import nbformat
from jinja2 import BytecodeCache, Environment
from jinja2.bccache import Bucket
from nbconvert.exporters import HTMLExporter, TemplateExporter
from nbformat.notebooknode import NotebookNode
from nbgrader.api import Student
from nbgrader.converters import GenerateFeedback
from nbgrader.converters.base import NbGraderException
from traitlets.config import Config

from ..errors import CourseError
from ..files import MOST_BYTES, digest, remove_others, staged
from ..gradebook import reading, writing
from ..store import StoredNotebook, mark_page, stored_notebooks
from ..submission.reading import plain_bytes
from .autograde import ChosenStudents

TEMPLATES = str(Path(__file__).parent / "templates")
_WITHOUT_TEXT = re.compile(r"<img(?=\s)(?![^>]*\salt=)")
_TEXT = '<img alt="No description has been provided for this image"'
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

    def _preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        """Run the plug-ins; nbconvert would copy and validate around each of them what is ours alone and valid."""
        for plugin in self._preprocessors:
            nb, resources = plugin(nb, resources)
        return nb, resources

    def from_notebook_node(  # type: ignore[override]  # as nbconvert's own do
        self, nb: NotebookNode, resources: dict | None = None, **kw: Any
    ) -> tuple[str, dict]:
        """The page of a notebook, pictures with a text for those who cannot see them.

        HTMLExporter reads every page anew for that text, which takes longer than all the rest.
        """
        page, resources = TemplateExporter.from_notebook_node(self, nb, resources, **kw)
        return _WITHOUT_TEXT.sub(_TEXT, page), resources

    def _create_environment(self) -> Environment:
        environment = super()._create_environment()
        environment.bytecode_cache = _COMPILED
        return environment


@dataclass(frozen=True)
class Shown:
    """What feedback pages show beside the graded notebooks.

    Attributes
    ----------
    whose : str
        The student, in full.
    names : tuple of str
        Of the graded notebooks.
    stored : dict of str to StoredNotebook
        What the gradebook holds, by name of the notebook.
    """

    whose: str
    names: tuple[str, ...]
    stored: dict[str, StoredNotebook]

    def is_done(self, pages: Path) -> bool:
        """True if the pages in a folder show just that."""
        return all(name in self.stored and self.stored[name].has_page(pages / f"{name}.html") for name in self.names)


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
        for _ in range(_TRIES):
            shown = self.to_show(student)
            if not self.force and shown.is_done(Path(self._format_dest(self.coursedir.assignment_id, student))):
                return
            if self.enter(student, shown, self.pages(student, shown)):
                return
        raise CourseError("somebody is marking it at this moment; run the command again")

    def to_show(self, student: str) -> Shown:
        """What the gradebook holds of a student now."""
        exercise = self.coursedir.assignment_id
        with reading(self.coursedir.db_url) as session:
            found = {name: one for (_, name), one in stored_notebooks(session, exercise, student).items()}
            whose = _in_full(session.get(Student, student), student)
        names = tuple(path.stem for path in sorted(self.folder(student).glob("*.ipynb")))
        return Shown(whose, names, found)

    def pages(self, student: str, shown: Shown) -> dict[str, bytes]:
        """The feedback pages of a student, by the names of their files; nothing is stored."""
        return {f"{name}.html": self._page(student, shown.whose, name, shown.stored.get(name)) for name in shown.names}

    def enter(self, student: str, shown: Shown, pages: dict[str, bytes]) -> bool:
        """Put pages in place and mark what they show; False if the gradebook holds something else by now."""
        exercise = self.coursedir.assignment_id
        target = Path(self._format_dest(exercise, student))
        with writing(self.coursedir.db_url) as session:
            now = {name: one for (_, name), one in stored_notebooks(session, exercise, student).items()}
            if any(now[name].shown() != shown.stored[name].shown() for name in shown.names):
                return False
            for name in shown.names:
                mark_page(session, now[name], pages[f"{name}.html"])
            with staged(target, pages, int(str(self.permissions), 8)) as put_in_place:
                put_in_place()
            remove_others(target, pages)
        if self.coursedir.groupshared:
            self.set_permissions(exercise, student)
        return True

    @cached_property
    def _exporter(self) -> FeedbackExporter:
        """The configured exporter with the configured plug-ins, its templates read once."""
        exporter = self.exporter_class(parent=self, config=self.config)
        for plugin in self.preprocessors:
            exporter.register_preprocessor(plugin)
        return exporter

    def _page(self, student: str, whose: str, name: str, stored: StoredNotebook | None) -> bytes:
        """The feedback page of a graded notebook."""
        exercise, path = self.coursedir.assignment_id, self.folder(student) / f"{name}.ipynb"
        graded_again = f"run: autograder grade {exercise}"
        if stored is None:
            raise CourseError(f"the gradebook does not know {path}; {graded_again}")
        content = plain_bytes(path, MOST_BYTES)
        if stored.mark is not None and stored.mark.graded != digest(content):
            raise CourseError(f"{path} is not what the gradebook holds; {graded_again}")
        resources: dict[str, Any] = {"unique_key": name, "output_files_dir": f"{name}_files", "whose": whose}
        resources["metadata"] = {"name": name, "path": str(path.parent)}
        resources["stored"] = stored
        resources["nbgrader"] = {
            "student": student, "assignment": exercise, "notebook": name, "db_url": self.coursedir.db_url
        }  # fmt: skip
        # Whatever is not told apart by its mark may have been written by another program.
        read = nbformat.v4.reads if stored.mark is not None else partial(nbformat.reads, as_version=4)
        page, _ = self._exporter.from_notebook_node(read(content.decode()), resources)
        return page.encode()


def _in_full(student: Student | None, id: str) -> str:
    """The name of a student with the id; the id alone where nobody entered a name."""
    name = " ".join(filter(None, (student.first_name, student.last_name))) if student is not None else ""
    return f"{name} ({id})" if name else id
