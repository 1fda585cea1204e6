"""The account of one verdict, for a lecturer who is asked about it: what was read, and what it was compared with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from dhkit import wire

from .decode import Decoded, Malformed, decode, decode_answer, decode_probes
from .expected import read_result
from .kinds.base import Comparison
from .probing import compare_result
from .question import Answer, Family, Question
from .tree import Verdict
from .verdict import FORGIVEN, Evidence, judge
from .written import written

LIMIT = 600


@dataclass(frozen=True)
class Call:
    """One list of arguments that a student's function was called with.

    Attributes
    ----------
    case : str
        Which case of the question it belongs to.
    returned, expected : str
        What came back, and what the right function returns, as text.
    right : bool
        Whether they agree.
    remarks : tuple of str
        What differs, in words.
    """

    arguments: tuple[str, ...]
    case: str
    returned: str
    expected: str
    right: bool
    remarks: tuple[str, ...]


@dataclass(frozen=True)
class Account:
    """How a verdict came about.

    Attributes
    ----------
    read : str
        The answer as it was decoded; empty if none was handed in.
    asked : str
        The form that the question asks for, in words.
    tree : tuple of (str, float, bool)
        Notes and shares of the nodes that were tried, in their order, and whether the verdict has the note.
    calls : tuple of Call
        Of a function.
    expected : str
        The right answer; of a function empty, see `calls`.
    numbers : mapping
        The student's own.
    earlier : str or None
        The earlier question that errors may be carried over from.
    carried_over : bool
        Whether they were.
    """

    verdict: Verdict
    read: str
    asked: str
    tree: tuple[tuple[str, float, bool], ...]
    calls: tuple[Call, ...]
    expected: str
    numbers: Mapping[str, float | str]
    earlier: str | None
    carried_over: bool


def account(question: Question, evidence: Evidence, student: str, earlier: Mapping[str, Evidence]) -> Account:
    """The account of ``judge(question, evidence, student, earlier)``. Never raises on anything a student can send."""
    verdict = judge(question, evidence, student, earlier)
    notes = verdict.note.split("+")
    is_function = question.form.kind == "function"
    return Account(
        verdict,
        _read(question, evidence),
        question.form.expected,
        (("right", 1.0, verdict.note == "right"),)
        + tuple((node.note, node.share, node.note in notes) for node in question.mistakes),
        _calls(question, evidence, student) if is_function else (),
        "" if is_function else _text(question.answer(student)),
        dict(question.numbers(student)) if question.personal else {},
        question.follows.earlier if question.follows else None,
        verdict.feedback == FORGIVEN,
    )


def _read(question: Question, evidence: Evidence) -> str:
    if evidence.packet is None:
        return ""
    try:
        return written(decode_answer(evidence.packet, question.id).value, LIMIT)
    except Malformed as fault:
        return f"cannot be read: {fault}"


def _calls(question: Question, evidence: Evidence, student: str) -> tuple[Call, ...]:
    if evidence.probes is None or evidence.probes[1] is None:
        return ()
    arguments, raw = evidence.probes
    try:
        results = decode_probes(raw, question.id, len(arguments))
    except Malformed:
        return ()
    right = question.answer(student)
    return tuple(_call(question, student, right, args, result) for args, result in zip(arguments, results, strict=True))


def _call(question: Question, student: str, right: Answer, args: list, result: Decoded) -> Call:
    found = read_result(question.returns, result)
    try:
        compared = compare_result(question, student, (), 2 * np.pi, args, found)
    except Malformed as fault:
        compared = Comparison(False, 0.0, (str(fault),))
    remarks = (str(found),) if isinstance(found, Malformed) and not compared.equal else compared.remarks
    shown = tuple(_text(one) for one in args)
    returned = written(result.value, LIMIT)
    return Call(
        shown, question.case(*args), returned, _returned(right, args), compared.equal, () if compared.equal else remarks
    )


def _returned(right: Answer, args: list) -> str:
    try:
        return _text(right(*args))
    except (ArithmeticError, LookupError, TypeError, ValueError) as error:
        return f"no value: {error}"


def _text(answer: Answer) -> str:
    """An answer of the question's own, written as a student's would be."""
    if isinstance(answer, Family):
        return f"infinitely many, for example {_text(answer.solutions)}"
    return written(decode(wire.encode(answer)).value, LIMIT)
