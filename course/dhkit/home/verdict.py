"""The verdict at home: the student's own answer opens the envelope that was sealed for it."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from .. import public, variants, wire
from ..angles import meant
from ..forms import Form
from ..forms.base import Parts
from ..forms.function import Function
from ..nodes import blanks, is_blank
from .envelopes import Opened, SealedExercise, SealedQuestion, find, lock_of, open_envelopes

State = Literal["right", "mistake", "partly", "not_right", "undecided", "form", "blank"]

UNDECIDED = "whether it is right is decided by the grader"
SOLUTION = "solution"
MOST_PARTS = 8
"""Parts of a wrong answer that are tried."""


@dataclass(frozen=True)
class Verdict:
    """What can be said at home of an answer.

    Attributes
    ----------
    state : str
        "right", "mistake" (one that has a name), "partly", "not_right", "undecided" (the grader decides), "form" (not in
        the form asked for) or "blank" (not attempted).
    note : str
        The grader's key for a mistake.
    share : float or None
        Share of the points that the grader gives, where it is known.
    text : str
        Feedback, Markdown.
    solution : str
        The worked solution, once the answer is right.
    """

    state: State
    note: str = ""
    share: float | None = None
    text: str = ""
    solution: str = field(default="", repr=False)


def verdict(id: str, answer: object, student: str | None = None) -> Verdict:
    """The verdict on `answer` to question `id`, without a network and without the answer in any file.

    Parameters
    ----------
    id : str
        For example ``"scara.T04"``.
    answer : object
        As for ``check``.
    student : str, optional
        Whose numbers count; the id typed in this session by default.
    """
    question = public.find(id)
    node = wire.encode(answer)
    return judge_at_home(question, node, answer if callable(answer) else None, student)


def judge_at_home(
    question: public.PublicQuestion, node: object, function: Callable | None, student: str | None = None
) -> Verdict:
    """`verdict` on an encoded answer, or on the function that was handed in."""
    arranged = question.form.arranged(node)
    if is_blank(arranged):
        return Verdict("blank")
    if complaint := question.form.complaint(node):
        return Verdict("form", text=complaint)
    if left := blanks(arranged):
        return Verdict("partly", text=f"{left} {'entry is' if left == 1 else 'entries are'} still ...")
    sealed = find(question.exercise)
    here = None if sealed is None else sealed.of(question.id)
    if sealed is None or here is None:
        return Verdict("undecided", text=UNDECIDED)
    if here.why_not:
        return Verdict("undecided", text=f"{UNDECIDED}: {here.why_not}")
    whose = student if student is not None else variants.typed(question.exercise) or variants.NOBODY
    number_set = variants.number_set(question.exercise, whose)
    if function is None:
        found = _of_data(question, sealed, here, arranged, number_set)
        exact = meant(arranged) if question.form.symbols and found.state in ("not_right", "partly") else arranged
        return found if exact == arranged else _of_data(question, sealed, here, exact, number_set)
    return _of_function(question, sealed, here, function, number_set)


def _of_data(
    question: public.PublicQuestion, sealed: SealedExercise, here: SealedQuestion, node: object, number_set: int
) -> Verdict:
    form = question.form
    parts = form.invariants(node, here.sight)
    mine = form.witness(node, here.sight) if parts else np.zeros(0)
    return _opened(question, sealed, here, parts, number_set, lambda theirs: form.agree(mine, theirs, here.sight))


def _of_function(
    question: public.PublicQuestion, sealed: SealedExercise, here: SealedQuestion, function: Callable, number_set: int
) -> Verdict:
    form = question.form
    assert isinstance(form, Function)
    place = here.place(number_set)
    calls, cases = here.calls[place], here.cases[place]
    results, trouble = call(function, form.returns, calls)
    if all(is_blank(result) for result in results):
        return Verdict("blank")
    parts = function_parts(form.returns, results, cases, here)
    mine = parts.get("", np.zeros(0))
    found = _opened(
        question,
        sealed,
        here,
        parts,
        number_set,
        lambda theirs: mine.shape == theirs.shape and bool((np.abs(mine - theirs) <= here.sight.tolerance).all()),
    )
    if found.state in ("not_right", "partly") and trouble:
        return Verdict(found.state, found.note, found.share, "; ".join(filter(None, (found.text, trouble))))
    return found


def call(function: Callable, form: Form, calls: Sequence[list]) -> tuple[list, str]:
    """What a function returns for each argument list, as nodes, and the first thing that went wrong, in words."""
    results, trouble = [], ""
    for args in calls:
        try:
            node = wire.encode(function(*copy.deepcopy(args)))
            complaint = None if is_blank(form.arranged(node)) else form.complaint(node)
        except (Exception, SystemExit) as error:
            node, complaint = {"error": ""}, wire.failure(error)
        if complaint and not trouble:
            trouble = f"for the arguments {_short(args)[1:-1]}: {complaint}"
        results.append(node)
    return results, trouble


def _short(value: object) -> str:
    """Numbers and lists of them, to four digits."""
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_short, value))}]"
    return f"{value:.4g}" if isinstance(value, float) else f"{value}"


def function_parts(form: Form, results: Sequence, cases: Sequence[str], here: SealedQuestion) -> Parts:
    """Numbers by which functions are told apart: of all results, and of those of each case."""
    seen: list[np.ndarray | None] = []
    for result in results:
        fits = not is_blank(form.arranged(result)) and form.complaint(result) is None
        seen.append(form.invariants(form.arranged(result), here.sight).get("") if fits else None)
    parts: Parts = {}
    for part in ("", *dict.fromkeys(cases)):
        wanted = [one for one, case in zip(seen, cases, strict=True) if part in ("", case)]
        chosen = [one for one in wanted if one is not None]
        if len(chosen) == len(wanted) > 0:
            parts[part] = np.concatenate(chosen)
    return parts


def _opened(
    question: public.PublicQuestion,
    sealed: SealedExercise,
    here: SealedQuestion,
    parts: Parts,
    number_set: int,
    agrees: Callable[[np.ndarray], bool],
) -> Verdict:
    """The verdict in the envelope of the whole answer, or what the envelopes of its parts say."""
    place = here.place(number_set)

    def opened(part: str) -> Iterator[Opened]:
        lock = lock_of(sealed, question.id, kind_of(part), here.personal, place, here.sight.tolerance)
        return open_envelopes(here, here.envelopes[place], lock, parts[part])

    near = False
    for one in opened("") if "" in parts else ():
        if agrees(one.numbers):
            said = one.said
            if said.left_out:
                return Verdict(
                    "undecided",
                    text=f"right for all that was tried here; the grader also tries {said.left_out}",
                    solution=said.solution,
                )
            state: State = "right" if said.state == "right" else "mistake"
            return Verdict(state, said.note, said.share, _filled(said.text, question, number_set), said.solution)
        near |= one.said.state == "right"
    if near:
        return Verdict("partly", text="nearly right: give more decimals")
    others = [part for part in parts if part][:MOST_PARTS]
    right = [part for part in others if any(opened(part))]
    if not right:
        return Verdict("not_right")
    if kind_of(right[0]) == SOLUTION:
        are = "is" if len(right) == 1 else "are"
        return Verdict("partly", text=f"{len(right)} of your {len(others)} solutions {are} right")
    return Verdict("partly", text=f"right already: {', '.join(right)}")


def kind_of(part: str) -> str:
    """The name under which a part is sealed: solutions have no order."""
    return SOLUTION if part.startswith(f"{SOLUTION} ") else part


def _filled(text: str, question: public.PublicQuestion, number_set: int) -> str:
    """A text with the student's own numbers in place of their names."""
    for name, value in variants.numbers_of_set(question.exercise, number_set).items():
        text = text.replace(f"{{{name}}}", f"{value}")
    return text
