"""From evidence to verdict: what came out of the sandbox is decoded, compared and named."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from dhkit import public
from dhkit.forms import Form
from dhkit.nodes import is_blank
from dhkit.variants import NOBODY, normal_form

from .almost import find_almost, verdict_on
from .blind import beyond_guessing
from .decode import Decoded, Failure, Malformed, decode_answer, decode_probes, decode_student
from .expected import expect_answer
from .kinds import Comparison, Entries, Setting, read
from .kinds import compare as compare_answers
from .kinds.entries import depends_on
from .probing import judge_results
from .question import Question, Way
from .slips import explain_answer, locate
from .tree import Verdict, nearest, walk
from .written import plain

UNTOLD = "not all of it is right; which part is not, is just what the question asks"
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


def judge(
    question: Question, evidence: Evidence, student: str, earlier: Mapping[str, Evidence] | None = None
) -> Verdict:
    """The verdict on one question. Never raises on anything a student can send.

    `student` is the id in the gradebook. `earlier` holds the evidence of those earlier questions of the notebook whose
    errors are forgivable, by id: they are not counted here again.
    """
    if evidence.packet is None:
        return _explain_silence(evidence)
    try:
        answer = decode_answer(evidence.packet, question.id)
        typed = decode_student(evidence.packet)
        if _is_blank(question.form, answer):
            return _explain_blank(evidence)
        with np.errstate(all="ignore"):  # whatever is not finite is wrong, and needs no warning
            verdict = _judge_answer(question, evidence, answer, student, earlier or {})
        if verdict.share < 1 and typed is not None and normal_form(typed) != normal_form(student):
            return _judge_for_another(question, evidence, answer, typed) or verdict
        return verdict
    except Malformed as fault:
        return Verdict(0.0, "malformed", f"**Not in the form asked for.** {plain(str(fault))}.")


def _judge_answer(
    question: Question, evidence: Evidence, answer: Decoded, student: str, earlier: Mapping[str, Evidence]
) -> Verdict:
    if question.form.kind == "function":
        return _judge_function(question, evidence, answer, student)
    return _judge_data(question, answer, student, earlier)


def _judge_for_another(question: Question, evidence: Evidence, answer: Decoded, typed: str) -> Verdict | None:
    """The verdict where the answer is right for the numbers of the id that was typed, which is not the student's own."""
    if _judge_answer(question, evidence, answer, typed, {}).note != "right":
        return None
    whose = "nobody: no id was typed at the top of the notebook" if typed == NOBODY else f"the id {plain(typed)}"
    feedback = f"**Right, but for the numbers of another student**: for those of {whose}. Type your own id at the top, and answer with your numbers."
    return Verdict(0.0, "numbers_of_another_student", feedback)


_TROUBLE = {
    "error": "**Your code stopped with an error.**",
    "timeout": "**Your code ran too long and was stopped.**",
    "output_limit": "**Your code printed without end and was stopped.**",
    "memory": "**Your code asked for more memory than it may have.**",
    "died": "**The Python process ended while this was running.**",
    "unreadable": "**The notebook file could not be read.**",
    "not_run": "**This cell was not run.**",
}


def _explain_silence(evidence: Evidence) -> Verdict:
    """The verdict where no answer came out of the cell."""
    if evidence.status == "ok":
        return Verdict(
            0.0, "no_answer", "**No answer was handed in.** The check cell ran, but `check` displayed nothing."
        )
    said = f" {plain(evidence.trouble)}" if evidence.trouble else ""
    return Verdict(0.0, evidence.status, _TROUBLE.get(evidence.status, "**No answer was handed in.**") + said)


def _explain_blank(evidence: Evidence) -> Verdict:
    """The verdict where the stub was left as it is, by choice or because the cell did not end well."""
    if evidence.status != "ok":
        return _explain_silence(evidence)
    return Verdict(0.0, "not_attempted", "Not attempted.")


def _is_blank(form: Form, answer: Decoded) -> bool:
    return is_blank(form.arranged(answer.node))


def _judge_data(question: Question, decoded: Decoded, student: str, earlier: Mapping[str, Evidence]) -> Verdict:
    form, setting = question.form, question.setting(student)
    answer = read(form, decoded)

    def beside_reference(given: object, asked: Setting) -> Comparison:
        expected = expect_answer(question, (), student)
        # A table is met in any frames only where it is compared with patience.
        asked = replace(asked, family=expected.family, patient=form.kind == "dh_table")
        return nearest(compare_answers(form, given, other, asked) for other in expected.forms)

    def compare(ways: tuple[Way, ...], turn: float) -> Comparison:
        if ways and not np.size(answer):
            return Comparison(False, 0.0)  # no solution at all is what no mistake leaves of some
        expected = expect_answer(question, ways, student)
        asked = replace(setting, turn=turn, family=expected.family, patient=not ways)
        return nearest(compare_answers(form, answer, other, asked) for other in expected.forms)

    against_reference = compare((), setting.turn)
    against_reference = replace(against_reference, share=beyond_guessing(question, student, against_reference))
    if not question.places and not against_reference.equal:
        against_reference = replace(against_reference, remarks=(UNTOLD,))
    if not against_reference.equal and _follows(question, answer, setting, student, earlier):
        return Verdict(1.0, "right_from_earlier", FORGIVEN)
    if not against_reference.equal and (
        almost := find_almost(form, answer, setting, beside_reference, decoded.assumed)
    ):
        return verdict_on(form, almost, tuple(map(plain, decoded.assumed)))
    silent = not against_reference.equal and not against_reference.remarks
    if silent and question.places and (place := locate(question, answer, student, setting)):
        against_reference = replace(against_reference, remarks=(place,))
    return walk(
        question,
        student,
        against_reference,
        lambda ways, turn: compare(ways, turn).equal,
        lambda: explain_answer(question, answer, student, setting, lambda changed: beside_reference(changed, setting)),
    )


def _follows(
    question: Question, answer: object, setting: Setting, student: str, earlier: Mapping[str, Evidence]
) -> bool:
    """Whether the answer is what follows from the student's own answer to the earlier question.

    It must depend on all that the right one depends on: where a length or a joint got lost on the way, there is less to
    do than was asked for.
    """
    if question.follows is None or question.follows.earlier not in earlier:
        return False
    (right,) = expect_answer(question, (), student).forms
    if not isinstance(answer, Entries) or not isinstance(right, Entries):
        return False
    if not depends_on(right, setting.samples) <= depends_on(answer, setting.samples):
        return False
    before = public.find(question.follows.earlier)
    try:
        start = read(before.form, decode_answer(earlier[before.id].packet, before.id))
    except Malformed:
        return False
    values = start.values(question.samples)
    if not np.isfinite(values).all():
        return False
    with np.errstate(all="ignore"):
        expected = np.asarray(question.follows.model(values.reshape(len(values), *before.form.shape)), complex)
    following = Entries(known=expected.reshape(len(values), -1))
    return compare_answers(question.form, answer, following, setting).equal


def _judge_function(question: Question, evidence: Evidence, answer: Decoded, student: str) -> Verdict:
    if complaint := question.form.complaint(answer.node):
        raise Malformed(complaint)
    if evidence.probes is None or evidence.probes[1] is None:
        return _explain_silence(evidence)
    arguments, raw = evidence.probes
    results = decode_probes(raw, question.id, len(arguments))
    if all(_is_blank(question.returns, result) for result in results):
        return _explain_blank(evidence)
    failures = [result.value for result in results if isinstance(result.value, Failure)]
    if len(failures) == len(results):
        return Verdict(0.0, "error", f"{_TROUBLE['error']} {plain(failures[0].message)}")
    return judge_results(question, arguments, results, student)
