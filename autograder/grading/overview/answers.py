"""Wrong answers as graded notebooks hold them, and what makes two of them the same."""

from __future__ import annotations

import io
import tokenize
from collections.abc import Mapping
from dataclasses import dataclass

from autograder import questions
from autograder.judge import Question
from autograder.judge.clusters import equal_answers, is_unexplained, recall
from autograder.judge.decode import Decoded
from autograder.judge.probing import EXAMPLES

from ..cells import answer_id, check_cells, check_id, check_record, tracked_cells
from ..collecting.recognise import typed_id
from ..course import Course
from ..report.statistics import told
from ..results import graded_notebooks
from .likeness import Wrong
from .standing import OTHERS_NUMBERS, Work

_SOURCE = 4000


@dataclass(frozen=True)
class Sheet:
    """A wrong answer as it stands in a graded notebook: what was typed, what was told, and the answer if it was kept."""

    source: str
    told: str
    answer: Decoded | None


def read_sheets(course: Course, student: str, work: Work) -> tuple[dict[str, Sheet], str | None]:
    """A student's wrong answers of an exercise, by question, and the id that was typed."""
    wanted = [answer for answer in work.answers if answer.is_wrong]
    notebooks = graded_notebooks(course, student, work.exercise) if wanted else []
    found, typed = {}, None
    for nb in notebooks:
        checks, cells, typed = check_cells(nb), tracked_cells(nb), typed_id(nb) or typed
        for answer in wanted:
            check = check_id(answer.question)
            if (cell := checks.get(check)) is None:
                continue
            record, source = check_record(cell), cells.get(answer_id(check))
            found[answer.question] = Sheet(
                source.source[:_SOURCE] if source else "",
                told(cell.outputs).partition(EXAMPLES)[0].strip(),
                recall(answer.question, record and record.answer) if is_unexplained(answer.note) else None,
            )
    return found, typed


def wrong_answers(
    works: Mapping[str, Mapping[str, Work]], sheets: Mapping[tuple[str, str], Sheet]
) -> dict[str, dict[str, Wrong]]:
    """The wrong answers that can be compared, by question and student."""
    notes: dict[str, dict[str, str]] = {}
    for one in works.values():
        for student, work in one.items():
            for answer in () if work.team else work.answers:
                if answer.is_wrong and answer.note != OTHERS_NUMBERS:
                    notes.setdefault(answer.question, {})[student] = answer.note
    found: dict[str, dict[str, Wrong]] = {}
    for name, of_students in notes.items():
        question = _question(name)
        named = {student: Wrong("mistake", note) for student, note in of_students.items() if not is_unexplained(note)}
        unnamed = [
            student for student, note in of_students.items() if is_unexplained(note) and (student, name) in sheets
        ]
        if question is not None and question.form.kind == "function":
            named |= {
                student: Wrong("text", text) for student in unnamed if (text := _tokens(sheets[student, name].source))
            }
        elif question is not None:
            groups = equal_answers(question, [sheets[student, name].answer for student in unnamed])
            named |= {unnamed[i]: Wrong("answer", number) for number, group in enumerate(groups) for i in group}
        found[name] = named
    return found


def _tokens(source: str) -> str:
    """A program without comments and blanks, so that only what it does is compared; empty if it is none."""
    left_out = (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.ENDMARKER)
    try:
        found = [
            str(token.type) if token.type in (tokenize.INDENT, tokenize.DEDENT) else token.string
            for token in tokenize.generate_tokens(io.StringIO(source).readline)
            if token.type not in left_out
        ]
    except (tokenize.TokenError, SyntaxError):
        return " ".join(source.split())
    return " ".join(found)


def _question(name: str) -> Question | None:
    try:
        return questions.find(name)
    except KeyError:
        return None


def follows(works: Mapping[str, Mapping[str, Work]]) -> dict[str, str]:
    """By question, the earlier one whose answer it follows from."""
    names = {answer.question for one in works.values() for work in one.values() for answer in work.answers}
    found = {name: _question(name) for name in names}
    return {name: one.follows.earlier for name, one in found.items() if one and one.follows}
