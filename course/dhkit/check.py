"""``check`` hands an answer in; ``hint`` helps on the way.

``check`` never knows the right answer. It says whether the answer has the form that was asked for,
runs the question's public checks, and leaves the encoded answer in the notebook for the grader.
"""

from __future__ import annotations

import json
from collections.abc import Callable

from . import public, variants, wire
from .nodes import blanks, is_blank
from .notice import Line, Notice, show
from .public_checks import run_public_check

_functions: dict[str, Callable] = {}


def check(id: str, answer: object = ...) -> None:
    """Hand in `answer` to question `id` and show what can be said about it here.

    Parameters
    ----------
    id : str
        The question, for example ``"scara.T04"``.
    answer : object
        The answer: numbers, nested lists, NumPy arrays, SymPy expressions and matrices, or a function.
        ``...`` or ``None`` means "not attempted yet".

    Raises
    ------
    KeyError
        If there is no such question; the message names the nearest ones.
    """
    question = public.find(id)
    node = wire.encode(answer)
    function = answer if callable(answer) else None
    if function is not None:
        _functions[id] = function
    student = variants.typed(question.exercise)
    whose = {} if student is None else {"student": wire.encode(student)}
    show(_notice(question, node, function), {wire.MIME: wire.packet(id, answer=node, **whose)})


def hint(id: str, level: int = 1) -> None:
    """Show hint number `level` of question `id`: 1 is the lightest."""
    question = public.find(id)
    if not question.hints:
        lines = [Line(None, "there is no hint for this question")]
    elif not 1 <= level <= len(question.hints):
        lines = [Line(None, f"hints are numbered 1 to {len(question.hints)}")]
    else:
        lines = [Line(None, question.hints[level - 1])]
        if level < len(question.hints):
            lines.append(Line(None, f'more: hint("{id}", {level + 1})'))
    show(Notice(f"Hint: {question.title}", "", tuple(lines)))


def answer_probes(id: str, arguments: str) -> None:
    """Call the function handed in for `id` with each argument list and display what it returns.

    The grader runs this after the check cell, with fresh arguments.

    Parameters
    ----------
    id : str
        The question.
    arguments : str
        JSON list of argument lists.
    """
    function = _functions[id]
    answers = []
    for args in json.loads(arguments):
        try:
            answers.append(wire.encode(function(*args)))
        except (Exception, SystemExit) as error:
            answers.append({"error": wire.failure(error)})
    show(Notice("", "", ()), {wire.MIME: wire.packet(id, probes=answers)})


def _notice(question: public.PublicQuestion, node: object, function: Callable | None) -> Notice:
    arranged = question.form.arranged(node)
    if is_blank(arranged):
        return Notice(question.title, "not attempted yet", ())
    if complaint := question.form.complaint(node):
        return Notice(question.title, "not in the form asked for", (Line(False, complaint),))
    if left := blanks(arranged):
        said = f"{left} {'entry is' if left == 1 else 'entries are'} still ..."
        return Notice(question.title, "partly attempted", (Line(False, said),))
    lines = [Line(True, f"the form is right: {question.form.expected}")]
    lines += [run_public_check(check, question.form, arranged, function) for check in question.public]
    if any(line.blank for line in lines):
        return Notice(question.title, "not attempted yet", ())
    missed = sum(line.holds is False for line in lines)
    status = "handed in" if not missed else f"handed in, but {missed} of {len(lines)} checks fail"
    return Notice(question.title, status, tuple(lines))
