"""Judges what a run of a notebook left behind, and says which of its pictures somebody will look at."""

from __future__ import annotations

import threading
from collections.abc import Container, Mapping

from nbformat.notebooknode import NotebookNode

from autograder import questions
from autograder.judge import Evidence, Verdict, is_forgivable, judge

from ..cells import check_name, question_id

_JUDGING = threading.Lock()  # SymPy, which references are made with, is not made for several threads


def verdicts(evidence: Mapping[str, Evidence], student: str) -> dict[str, Verdict]:
    """The verdict on each question of a notebook, by the grade id of its check cell; evidence in the notebook's order."""
    earlier: dict[str, Evidence] = {}
    found = {}
    with _JUDGING:
        for check, one in evidence.items():
            question = questions.find(question_id(check))
            found[check] = judge(question, one, student, earlier)
            if is_forgivable(found[check]):
                earlier[question.id] = one
    return found


def cells_looked_at(nb: NotebookNode, right: Container[str]) -> set[int]:
    """The code cells of a notebook whose pictures matter.

    These are the cells of each question that is not among the `right` ones, by the grade id of its check cell, and what
    follows the last question, which a lecturer marks.
    """
    looked: set[int] = set()
    of_question: set[int] = set()
    for index, cell in enumerate(nb.cells):
        if cell.cell_type == "code":
            of_question.add(index)
        if (check := check_name(cell)) is not None:
            looked |= set() if check in right else of_question
            of_question = set()
    return looked | of_question
