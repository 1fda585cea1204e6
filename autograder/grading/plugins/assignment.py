"""nbgrader's GenerateAssignment, which changes gradebook and released files together or not at all."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from nbformat.notebooknode import NotebookNode
from nbgrader import utils
from nbgrader.converters import GenerateAssignment
from nbgrader.converters.base import NbGraderException
from nbgrader.preprocessors import NbGraderPreprocessor, SaveCells

from ..errors import CourseError, in_words
from ..exercise import Changes, ReleasedCells, update
from ..files import remove_others, staged
from ..gradebook import make, writing


class GatherCells(NbGraderPreprocessor):
    """Notes which cells the gradebook has to know, in place of nbgrader's SaveCells, which enters them one by one."""

    def preprocess(self, nb: NotebookNode, resources: dict) -> tuple[NotebookNode, dict]:
        cells: ReleasedCells = resources["cells"]
        cells.kernelspec = json.dumps(nb.metadata.get("kernelspec", {}))
        for cell in nb.cells:
            cells.add(cell)
        return nb, resources


class AssignmentRelease(GenerateAssignment):
    """GenerateAssignment that works while submissions depend on the exercise, and leaves nothing half.

    Attributes
    ----------
    changes : Changes
        What the release changed for those who had handed in already.
    beside : mapping of str to bytes
        Files that are put beside the notebooks.
    """

    changes = Changes()
    beside: Mapping[str, bytes] = {}

    def start(self) -> None:
        stock = (SaveCells, "nbgrader.preprocessors.SaveCells")
        configured = self.preprocessors  # type: ignore[has-type]
        self.preprocessors = [GatherCells if one in stock else one for one in configured]
        super().start()

    def convert_notebooks(self) -> None:
        exercise = self.coursedir.assignment_id
        source, target = Path(self._format_source(exercise, ".")), Path(self._format_dest(exercise, "."))
        if target.exists() and not self.force:
            self.log.info("Skipping existing assignment: %s", target)
            return
        try:
            self.run_pre_convert_hook()
            self._release(exercise, source, target)
            self.run_post_convert_hook()
        except Exception as error:
            reason = error if isinstance(error, CourseError) else CourseError(in_words(error))
            self.log.error(str(reason))
            raise NbGraderException(str(reason)) from reason

    def _release(self, exercise: str, source: Path, target: Path) -> None:
        released: dict[str, ReleasedCells] = {}
        files = dict(self.beside)
        for path in sorted(path for paths in self.assignments.values() for path in paths):
            resources: dict[str, Any] = {**self.init_single_notebook_resources(path), "cells": ReleasedCells()}
            text, resources = self.exporter.from_filename(path, resources=resources)
            released[Path(path).stem] = resources["cells"]
            files[Path(path).name] = text.encode()
        for name in utils.find_all_files(str(source), [*self.coursedir.ignore, "*.ipynb"]):
            files[os.path.relpath(name, source)] = Path(name).read_bytes()
        permissions = int(str(self.permissions), 8)
        if self.no_database:
            with staged(target, files, permissions) as put_in_place:
                put_in_place()
        else:
            make(self.coursedir.db_url, self.coursedir.course_id)
            with writing(self.coursedir.db_url) as session:
                self.changes = update(session, exercise, self.coursedir.course_id, released)
                with staged(target, files, permissions) as put_in_place:
                    put_in_place()
        remove_others(target, files)
        if self.coursedir.groupshared:
            self.set_permissions(exercise, ".")
