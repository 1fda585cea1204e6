"""``check`` hands an answer in; ``hint`` helps on the way.

``check`` never knows the right answer. It says whether the answer has the form that was asked for,
runs the question's public checks, and leaves the encoded answer in the notebook for the grader.
"""

from __future__ import annotations

import json
from collections.abc import Mapping

from . import public, variants, wire
from .forms import blanks, complaint, is_blank, names_of
from .notice import Line, Notice, show
from .public_checks import run_public_check

_functions: dict[str, object] = {}


def check(id: str, answer=...) -> None:
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
    if question.kind == "function" and callable(answer):
        _functions[id] = answer
    student = variants.typed(question.exercise)
    whose = {} if student is None else {"student": wire.encode(student)}
    show(_notice(question, node, answer), {wire.MIME: wire.packet(id, answer=node, **whose)})


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
        except Exception as error:
            answers.append({"error": f"{type(error).__name__}: {error}"[:300]})
    show(Notice("", "", ()), {wire.MIME: wire.packet(id, probes=answers)})


def _in_order(question: public.PublicQuestion, answer):
    """An answer keyed by names as a list in the order asked for, for the public checks; anything else as it is."""
    if isinstance(answer, Mapping):
        return [answer[name] for name in names_of(question)]
    if isinstance(answer, (list, tuple)):
        return [_in_order(question, row) if isinstance(row, Mapping) else row for row in answer]
    return answer


def _notice(question: public.PublicQuestion, node: object, answer) -> Notice:
    if is_blank(node):
        return Notice(question.title, "not attempted yet", ())
    wrong_form = complaint(question, node)
    if wrong_form:
        return Notice(question.title, "not in the form asked for", (Line(False, wrong_form),))
    if blanks(node):
        return Notice(question.title, "partly attempted", (Line(False, f"{blanks(node)} entries are still ..."),))
    lines = [Line(True, f"the form is right: {question.expected}")]
    lines += [run_public_check(question, spec, _in_order(question, answer)) for spec in question.public]
    if question.kind == "function" and any(line.blank for line in lines):
        return Notice(question.title, "not attempted yet", ())
    missed = sum(line.holds is False for line in lines)
    status = "handed in" if not missed else f"handed in, but {missed} of {len(lines)} checks fail"
    return Notice(question.title, status, tuple(lines))
