"""From evidence to verdict: what came out of the sandbox is decoded, compared and named."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import permutations, product

from dhkit import wire

from .decode import Blank, Failure, Function, Malformed, Value, decode_answer, decode_probes
from .kinds import KINDS, Comparison, Kind, Setting, describe
from .question import Question, Step, Variant


Matches = Callable[[tuple[Step, ...], float], bool]


@dataclass(frozen=True)
class Evidence:
    """What the sandbox found for one question. None of it is trusted.

    Attributes
    ----------
    bundle : object
        The JSON value displayed under `dhkit.wire.MIME` by the check cell, None if there was none.
    probes : tuple or None
        For a function: the argument lists that were sent, and the JSON value that came back (or None).
    trouble : str or None
        Why the cell did not end well, in one sentence.
    status : str
        ``"ok"``, or how the cell ended: ``"error"``, ``"timeout"``, ``"memory"``, ``"unreadable"`` ...
    """

    bundle: object | None
    probes: tuple[list, object | None] | None = None
    trouble: str | None = None
    status: str = "ok"


@dataclass(frozen=True)
class Verdict:
    """Share of the points (0 to 1), answer note (a stable key) and feedback (Markdown)."""

    share: float
    note: str
    feedback: str


def judge(question: Question, evidence: Evidence, variant: Variant) -> Verdict:
    """The verdict on one question. Never raises on anything a student can send."""
    if evidence.bundle is None:
        return _nothing_came(evidence)
    try:
        value = decode_answer(evidence.bundle, question.id)
        if question.public.kind == "function":
            return _judge_function(question, evidence, value, variant)
        if _is_blank(value):
            return _not_attempted(evidence)
        return _judge_value(question, value, variant)
    except Malformed as fault:
        return Verdict(0.0, "malformed", f"**Not in the form asked for.** {plain(str(fault))}.")


def plain(text: str) -> str:
    """`text` made harmless for Markdown, HTML and terminals, and short."""
    text = re.sub(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069]+", " ", text)[:300]
    return re.sub(r"([\\`*_{}\[\]<>()#+!|$~&])", r"\\\1", text).replace("\\<", "&lt;").replace("\\>", "&gt;").replace("\\&", "&amp;")


_TROUBLE = {
    "error": "**Your code stopped with an error.**",
    "timeout": "**Your code ran too long and was stopped.**",
    "output_limit": "**Your code printed without end and was stopped.**",
    "memory": "**Your code asked for more memory than it may have.**",
    "died": "**The Python process ended while this was running.**",
    "unreadable": "**The notebook file could not be read.**",
    "not_run": "**This cell was not run.**",
}


def _nothing_came(evidence: Evidence) -> Verdict:
    if evidence.status == "ok":
        return Verdict(0.0, "no_answer", "**No answer was handed in.** The check cell ran, but `check` displayed nothing.")
    said = f" {plain(evidence.trouble)}" if evidence.trouble else ""
    return Verdict(0.0, evidence.status, _TROUBLE.get(evidence.status, "**No answer was handed in.**") + said)


def _not_attempted(evidence: Evidence) -> Verdict:
    if evidence.status != "ok":
        return _nothing_came(evidence)
    return Verdict(0.0, "not_attempted", "Not attempted.")


def _is_blank(value: Value) -> bool:
    if isinstance(value, tuple):
        return bool(value) and all(map(_is_blank, value))
    return isinstance(value, Blank)


def _judge_value(question: Question, value: Value, variant: Variant) -> Verdict:
    kind, form = KINDS[question.public.kind], question.public
    student = kind.read(form, value)
    setting = _setting(question)

    def compare(steps: tuple[Step, ...], turn: float) -> Comparison:
        return kind.compare(form, student, _own(question, steps, variant), replace(setting, turn=turn))

    return _walk(question, compare((), setting.turn), lambda steps, turn: compare(steps, turn).equal)


def _judge_function(question: Question, evidence: Evidence, value: Value, variant: Variant) -> Verdict:
    if _is_blank(value):
        return _not_attempted(evidence)
    if not isinstance(value, Function):
        raise Malformed(f"expected {question.public.expected}, found {describe(value)}")
    if evidence.probes is None or evidence.probes[1] is None:
        return _nothing_came(evidence)
    arguments, raw = evidence.probes
    results = decode_probes(raw, question.id, len(arguments))
    if all(map(_is_blank, results)):
        return _not_attempted(evidence)
    if all(isinstance(result, Failure) for result in results):
        return Verdict(0.0, "error", f"{_TROUBLE['error']} {plain(results[0].message)}")
    form = question.public.returns
    kind, setting = KINDS[form.kind], _setting(question)
    students = [_read_or_complaint(kind, form, result) for result in results]
    if all(isinstance(student, Malformed) for student in students):
        raise students[0]

    def rights(steps: tuple[Step, ...], turn: float) -> Iterator[bool]:
        unit, function = replace(setting, turn=turn), _taken(steps, question.reference(variant))
        for args, student in zip(arguments, students, strict=True):
            other = _read_or_complaint(kind, form, _decoded(form, function(*args)))
            unusable = [isinstance(answer, Malformed) for answer in (student, other)]
            yield all(unusable) or (not any(unusable) and kind.compare(form, student, other, unit).equal)

    cases: dict[str, list[bool]] = {}
    for args, right in zip(arguments, rights((), setting.turn), strict=True):
        cases.setdefault(question.group(*args), []).append(right)
    wrong = tuple(f"wrong for {case}" for case, right in cases.items() if not all(right))
    return _walk(question, Comparison(not wrong, 1 - len(wrong) / len(cases), wrong), lambda *mistaken: all(rights(*mistaken)))


def _walk(question: Question, against_reference: Comparison, matches: Matches) -> Verdict:
    """The response tree: right, then each mistake, then two mistakes at once, then the parts that are right.

    `matches` tells whether the student's answer is the reference after the given wrong steps, angles modulo a turn.
    """
    if against_reference.equal:
        used = ", ".join(against_reference.remarks)
        return Verdict(1.0, "right", "**Right.**" + (f" The same chain as ours, with {used}." if used else ""))
    for node in question.mistakes:
        if any(matches((step,), node.turn) for step in node.steps):
            return Verdict(node.share, node.note, node.feedback)
    for first, second in permutations(question.mistakes, 2):
        turn = max(first.turn, second.turn)
        if any(_possible(matches, steps, turn) for steps in product(first.steps, second.steps)):
            note = "+".join(sorted((first.note, second.note)))
            return Verdict(first.share * second.share, note, f"{first.feedback}\n\n{second.feedback}")
    share = min(question.partial, against_reference.share)
    what = "; ".join(against_reference.remarks) or "the answer differs from the right one"
    note = against_reference.note or ("partly_right" if share > 0 else "nothing_matched")
    return Verdict(share, note, f"**{'Partly right' if share > 0 else 'Not right'}.** {what[0].upper()}{what[1:]}.")


def _possible(matches: Matches, steps: tuple[Step, ...], turn: float) -> bool:
    """`matches`, but False where the second step cannot be taken after the first."""
    try:
        return matches(steps, turn)
    except (ArithmeticError, IndexError, TypeError, ValueError):
        return False


def _setting(question: Question) -> Setting:
    return Setting(question.points(), question.angles, question.tolerance, question.pinned)


@lru_cache(maxsize=4096)
def _own(question: Question, steps: tuple[Step, ...], variant: Variant) -> object:
    """The reference after wrong steps, taken through the same wire and reader as a student's answer."""
    answer = _taken(steps, question.reference(variant))
    return KINDS[question.public.kind].read(question.public, _decoded(question.public, answer))


def _taken(steps: tuple[Step, ...], answer: object) -> object:
    for step in steps:
        answer = step(answer)
    return answer


def _decoded(form, answer: object) -> Value:
    return decode_answer(wire.bundle(form.id, answer=wire.encode(answer)), form.id)


def _read_or_complaint(kind: Kind, form, result: Value) -> object:
    try:
        return kind.read(form, result)
    except Malformed as fault:
        return fault
