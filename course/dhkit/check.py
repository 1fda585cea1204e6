"""``check`` hands an answer in; ``hint`` helps on the way; ``solution`` shows how it goes, once the answer is right.

``check`` never knows the right answer. It says whether the answer has the form that was asked for, runs the question's
public checks, opens the verdict that was sealed for this very answer if there is one (`dhkit.home`), and leaves the
encoded answer in the notebook for the grader.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace

from . import public, variants, wire
from .forms import Form
from .forms.function import Function
from .home.progress import latest, note
from .home.verdict import Verdict, judge_at_home
from .nodes import blanks
from .notice import Line, Notice, show
from .public_checks import run_public_check
from .values import reals

_ASSUMED = "declared as positive: {}; SymPy simplifies with that, and turns atan2(y, x) into atan(y/x)"

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
    node, assumed = wire.encode_with_assumptions(answer)
    function = answer if callable(answer) else None
    if function is not None:
        _functions[id] = function
    student = variants.typed(question.exercise)
    whose = {} if student is None else {"student": wire.encode(student)}
    if assumed:
        whose["assumed"] = assumed
    found = judge_at_home(question, node, function)
    note(id, found)
    notice = _notice(question, node, function, found)
    if assumed and found.state not in ("right", "blank", "form"):
        notice = replace(notice, lines=(*notice.lines, Line(None, _ASSUMED.format(", ".join(assumed)))))
    show(notice, {wire.MIME: wire.packet(id, answer=node, **whose)})


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


def solution(id: str) -> None:
    """Show the worked solution of question `id`, once the answer handed in is right."""
    from IPython.display import Markdown, display

    question, found = public.find(id), latest(id)
    if found is not None and found.solution:
        display(Markdown(f"**Solution: {question.title}**\n\n{found.solution}"))
        return
    if found is not None and found.state == "undecided":
        said = "the grader decides about this question, so its solution stays with the lecturer"
    elif found is not None and found.state == "right":
        said = "there is no worked solution for this question"
    else:
        said = f'it unfolds when your answer is right: check("{id}", ...)'
    show(Notice(f"Solution: {question.title}", "", (Line(None, said),)))


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


def _notice(question: public.PublicQuestion, node: object, function: Callable | None, found: Verdict) -> Notice:
    if found.state == "blank":
        return Notice(question.title, "not attempted yet", ())
    if found.state == "form":
        return Notice(question.title, "not in the form asked for", (Line(False, found.text),))
    arranged = question.form.arranged(node)
    if blanks(arranged):
        return Notice(question.title, "partly attempted", (Line(False, found.text),))
    lines = [run_public_check(check, question.form, arranged, function) for check in question.public]
    if any(line.blank for line in lines):
        return Notice(question.title, "not attempted yet", ())
    if found.state == "right":
        how = (
            f'how it goes: solution("{question.id}")'
            if question.exercise != public.TRY
            else "unfold the answer to compare"
        )
        return Notice(question.title, "right", (Line(True, how),))
    lines = [Line(None, f"the form is right: {question.form.expected}{_precision(question.form)}"), *lines]
    if found.state == "undecided":
        missed = sum(line.holds is False for line in lines)
        status = "handed in" if not missed else f"handed in, but {missed} of {len(lines)} checks fail"
        return Notice(question.title, status, (*lines, Line(None, found.text)))
    if _is_rounded(question.form, arranged):
        lines.append(Line(None, f"there are numbers with fewer than {question.form.decimals} decimals"))
    if found.text:
        lines.append(Line(False if found.state == "mistake" else None, found.text))
    return Notice(question.title, "not right yet", tuple(lines))


def _is_rounded(form: Form, node: object) -> bool:
    """Whether some numbers have fewer decimals than are asked for, and are not whole."""
    if form.decimals is None:
        return False
    found = reals(node, {})
    return bool(((found == found.round(form.decimals - 1)) & (found != found.round())).any())


def _precision(form: Form) -> str:
    decimals = form.returns.decimals if isinstance(form, Function) else form.decimals
    return f", to {decimals} decimals" if decimals else ""
