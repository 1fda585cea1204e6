"""From evidence to verdict: what came out of the sandbox is decoded, compared and named."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from itertools import permutations, product
from types import FunctionType

import numpy as np

from dhkit import public, wire
from dhkit.variants import NOBODY

from .decode import Blank, Failure, Function, Malformed, Value, decode_answer, decode_probes, decode_student
from .kinds import KINDS, Comparison, Entries, Kind, Setting, describe
from .question import Family, Mistake, Question, Step, Variant

Matches = Callable[[tuple[Step, ...], float], bool]


UNEXPLAINED = frozenset({"nothing_matched", "partly_right", "one_cell", "malformed"})
"""Notes of wrong answers in which no misconception was found."""

# What a wrong step may run into: a mistaken function fails where the student's does, some steps exclude each other.
_IMPOSSIBLE = (ArithmeticError, AttributeError, IndexError, KeyError, TypeError, ValueError)

FORGIVEN = "**Right for your own earlier answer.** What went wrong there has been counted there; from it you went on correctly."


@dataclass(frozen=True)
class Evidence:
    """What the sandbox found for one question. None of it is trusted.

    Attributes
    ----------
    packet : object
        The JSON value displayed under `dhkit.wire.MIME` by the check cell, None if there was none.
    probes : tuple or None
        For a function: the argument lists that were sent, and the JSON value that came back (or None).
    trouble : str or None
        Why the cell did not end well, in one sentence.
    status : str
        ``"ok"``, or how the cell ended: ``"error"``, ``"timeout"``, ``"memory"``, ``"unreadable"`` ...
    """

    packet: object | None
    probes: tuple[list, object | None] | None = None
    trouble: str | None = None
    status: str = "ok"


@dataclass(frozen=True)
class Verdict:
    """Share of the points (0 to 1), answer note (a stable key) and feedback (Markdown)."""

    share: float
    note: str
    feedback: str


def judge(
    question: Question, evidence: Evidence, variant: Variant, earlier: Mapping[str, Evidence] | None = None
) -> Verdict:
    """The verdict on one question. Never raises on anything a student can send.

    `earlier` holds the evidence of those earlier questions of the notebook whose errors are forgivable, by id: they are
    not counted here again.
    """
    if evidence.packet is None:
        return _nothing_came(evidence)
    try:
        value = decode_answer(evidence.packet, question.id)
        typed = decode_student(evidence.packet)
        if question.public.kind != "function" and _is_blank(value):
            return _not_attempted(evidence)
        found = _judged(question, evidence, value, variant, earlier or {})
        if found.share < 1 and typed is not None and typed != variant.student:
            return _of_another(question, evidence, value, typed) or found
        return found
    except Malformed as fault:
        return Verdict(0.0, "malformed", f"**Not in the form asked for.** {plain(str(fault))}.")


def _judged(
    question: Question, evidence: Evidence, value: Value, variant: Variant, earlier: Mapping[str, Evidence]
) -> Verdict:
    if question.public.kind == "function":
        return _judge_function(question, evidence, value, variant)
    return _judge_value(question, value, variant, earlier)


def _of_another(question: Question, evidence: Evidence, value: Value, typed: str) -> Verdict | None:
    """The verdict where the answer is right for the numbers of the id that was typed, which is not the student's own."""
    if _judged(question, evidence, value, Variant(typed), {}).note != "right":
        return None
    whose = "nobody: no id was typed at the top of the notebook" if typed == NOBODY else f"the id {plain(typed)}"
    feedback = f"**Right, but for the numbers of another student**: for those of {whose}. Type your own id at the top, and answer with your numbers."
    return Verdict(0.0, "numbers_of_another_student", feedback)


def is_forgivable(verdict: Verdict) -> bool:
    """Whether what follows from an answer may earn points although the answer is wrong.

    The mistake has a name, or most of the answer is right: from a guess, or from a table of zeros, everything and
    nothing follows.
    """
    return verdict.share >= 0.5 or (verdict.share > 0 and verdict.note not in UNEXPLAINED)


def plain(text: str) -> str:
    """`text` made harmless for Markdown, HTML and terminals, and short."""
    text = re.sub(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069]+", " ", text)[:300]
    return (
        re.sub(r"([\\`*_{}\[\]<>()#+!|$~&])", r"\\\1", text)
        .replace("\\<", "&lt;")
        .replace("\\>", "&gt;")
        .replace("\\&", "&amp;")
    )


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
        return Verdict(
            0.0, "no_answer", "**No answer was handed in.** The check cell ran, but `check` displayed nothing."
        )
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


def _judge_value(question: Question, value: Value, variant: Variant, earlier: Mapping[str, Evidence]) -> Verdict:
    kind, form = KINDS[question.public.kind], question.public
    student = kind.read(form, value)
    setting = _setting(question, variant)

    def compare(steps: tuple[Step, ...], turn: float) -> Comparison:
        other, family = _own(question, steps, variant)
        unit = replace(setting, turn=turn, family=family and not steps, patient=not steps)
        return kind.compare(form, student, other, unit)

    against_reference = compare((), setting.turn)
    if not against_reference.equal and _follows(question, student, setting, earlier):
        return Verdict(1.0, "right_from_earlier", FORGIVEN)
    return _walk(question, variant, against_reference, lambda steps, turn: compare(steps, turn).equal)


def _follows(question: Question, student: object, setting: Setting, earlier: Mapping[str, Evidence]) -> bool:
    """Whether the answer is what follows from the student's own answer to the earlier question."""
    if question.follows is None or question.follows.earlier not in earlier:
        return False
    before = public.find(question.follows.earlier)
    try:
        answer = KINDS[before.kind].read(before, decode_answer(earlier[before.id].packet, before.id))
    except Malformed:
        return False
    values = answer.values(question.samples)
    if not np.isfinite(values).all():
        return False
    with np.errstate(all="ignore"):
        expected = np.asarray(question.follows.model(values.reshape(len(values), *before.shape)), complex)
    following = Entries(known=expected.reshape(len(values), -1))
    return KINDS[question.public.kind].compare(question.public, student, following, setting).equal


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
    kind = KINDS[form.kind]
    students = [_read_or_complaint(kind, form, result) for result in results]
    if all(isinstance(student, Malformed) for student in students):
        raise students[0]
    probes = list(zip(arguments, students, strict=True))

    def compare(steps: tuple[Step, ...], turn: float, args: list, student: object) -> Comparison:
        other, family = _returned(question, steps, variant, args)
        if isinstance(student, Malformed) or isinstance(other, Malformed):
            return Comparison(isinstance(student, Malformed) and isinstance(other, Malformed), 0.0)
        setting = _setting(question, variant, args if not steps else None)
        return kind.compare(form, student, other, replace(setting, turn=turn, family=family and not steps))

    cases: dict[str, list[Comparison]] = {}
    for args, student in probes:
        cases.setdefault(question.group(*args), []).append(compare((), 2 * np.pi, args, student))
    wrong = tuple(_wrong_case(case, found) for case, found in cases.items() if not all(one.equal for one in found))
    found = _walk(
        question,
        variant,
        Comparison(not wrong, 1 - len(wrong) / len(cases), wrong),
        lambda steps, turn: all(compare(steps, turn, *probe).equal for probe in probes),
    )
    # A constant is right now and then: "no solution" wherever there is none. It shows no understanding of any case.
    if found.share > 0 and wrong and len(set(results)) == 1:
        return Verdict(
            0.0, "nothing_matched", "**Not right.** Your function returns the same for all arguments that were tried."
        )
    return found


def _wrong_case(case: str, found: list[Comparison]) -> str:
    """Which case is wrong, and by what at the first argument list that shows it."""
    said = next((one.remarks[-1] for one in found if not one.equal and one.remarks), "")
    return f"wrong for {case}" + (f" ({said})" if said else "")


def _returned(question: Question, steps: tuple[Step, ...], variant: Variant, args: list) -> tuple[object, bool]:
    """What the reference, or a mistaken function, returns for `args`, read as a student's answer is."""
    form = question.public.returns
    try:
        answer, family = _unwrapped(_function(question, steps, variant)(*args))
    except _IMPOSSIBLE as error:
        return Malformed(f"no value: {error}"), False
    return _read_or_complaint(KINDS[form.kind], form, _decoded(form, answer)), family


@lru_cache(maxsize=4096)
def _function(question: Question, steps: tuple[Step, ...], variant: Variant) -> Callable:
    return _taken(steps, _function(question, (), variant)) if steps else _remembering(question.reference(variant))


def _remembering(function: Callable) -> Callable:
    """`function`, asked once for the same arguments: all mistakes of a tree are made from the same right results.

    An object that can be called stays as it is, for steps that change what it is made of.
    """
    if not isinstance(function, FunctionType):
        return function
    known: dict[str, object] = {}

    def answer(*args):
        key = repr(args)
        if key not in known:
            if len(known) >= 256:
                known.clear()
            known[key] = function(*args)
        return known[key]

    return answer


def _walk(question: Question, variant: Variant, against_reference: Comparison, matches: Matches) -> Verdict:
    """The response tree: right, then each mistake, then two mistakes at once, then the parts that are right.

    `matches` tells whether the student's answer is the reference after the given wrong steps, angles modulo a turn.
    """
    if against_reference.equal:
        used = ", ".join(against_reference.remarks)
        return Verdict(1.0, "right", "**Right.**" + (f" The same chain as ours, with {used}." if used else ""))
    told = partial(_feedback, question, variant)
    for node in question.mistakes:
        if any(_possible(matches, (step,), node.turn) for step in node.steps):
            return Verdict(node.share, node.note, told(node))
    for first, second in permutations(question.mistakes, 2):
        turn = max(first.turn, second.turn)
        if any(_possible(matches, steps, turn) for steps in product(first.steps, second.steps)):
            note = "+".join(sorted((first.note, second.note)))
            return Verdict(first.share * second.share, note, f"{told(first)}\n\n{told(second)}")
    share = min(question.partial, against_reference.share)
    what = "; ".join(against_reference.remarks) or "the answer differs from the right one"
    note = against_reference.note or ("partly_right" if share > 0 else "nothing_matched")
    return Verdict(share, note, f"**{'Partly right' if share > 0 else 'Not right'}.** {what[0].upper()}{what[1:]}.")


def _feedback(question: Question, variant: Variant, node: Mistake) -> str:
    """The feedback of a mistake with the student's own numbers in it."""
    numbers = variant.numbers(question.exercise)
    return re.sub(
        r"\{(\w+)\}", lambda found: f"{numbers[found[1]]}" if found[1] in numbers else found[0], node.feedback
    )


def _possible(matches: Matches, steps: tuple[Step, ...], turn: float) -> bool:
    """`matches`, but False where a step cannot be taken: after another one, or with this student's numbers."""
    try:
        return matches(steps, turn)
    except _IMPOSSIBLE:
        return False


def _setting(question: Question, variant: Variant, args: list | tuple | None = ()) -> Setting:
    """How answers are compared; without `args` nobody asks how far a solution misses its target."""
    asked = question.misses is not None and args is not None
    misses = (lambda q: question.misses(q, variant, *args)) if asked else None
    return Setting(question.samples, question.angles, question.tolerance, question.pinned, misses=misses)


@lru_cache(maxsize=4096)
def _reference(question: Question, variant: Variant) -> object:
    """The right answer; steps make new ones of it and leave it as it is."""
    return question.reference(variant)


@lru_cache(maxsize=16384)
def _own(question: Question, steps: tuple[Step, ...], variant: Variant) -> tuple[object, bool]:
    """The reference after wrong steps, taken through the same wire and reader as a student's answer; whether it is a family."""
    answer, family = _unwrapped(_reference(question, variant))
    return _read(question, json.dumps(wire.encode(_taken(steps, answer)))), family


@lru_cache(maxsize=16384)
def _read(question: Question, sent: str) -> object:
    """An answer as the wire carries it, read: two wrong steps mostly come to the same whichever is taken first."""
    form = question.public
    return KINDS[form.kind].read(form, decode_answer(wire.packet(form.id, answer=json.loads(sent)), form.id))


def _unwrapped(answer: object) -> tuple[object, bool]:
    return (answer.solutions, True) if isinstance(answer, Family) else (answer, False)


def _taken(steps: tuple[Step, ...], answer: object) -> object:
    for step in steps:
        answer = step(answer)
    return answer


def _decoded(form, answer: object) -> Value:
    return decode_answer(wire.packet(form.id, answer=wire.encode(answer)), form.id)


def _read_or_complaint(kind: Kind, form, result: Value) -> object:
    try:
        answer = kind.read(form, result)
    except Malformed as fault:
        return fault
    # nan is how numpy fails: as an exception would, it says that there is no value.
    failed = isinstance(answer, Entries) and not answer.finite()
    return Malformed(f"expected {form.expected}, found a value that is not finite") if failed else answer
