"""A student's function: what it returned for the arguments it was asked with, case by case."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .almost import Almost, find_almost, verdict_on, worst
from .decode import Decoded, Failure, Malformed
from .expected import expect_result, read_result
from .kinds import Comparison, Setting
from .kinds import compare as compare_answers
from .question import Question, Way
from .slips import explain_results
from .tree import Verdict, nearest, walk
from .written import plain, written

# Characters of an argument list that is told with all its digits, and at all, and of what came back.
MOST_DIGITS, MOST_ARGUMENTS, MOST_RETURNED = 40, 400, 200


def judge_results(question: Question, arguments: list[list], results: Sequence[Decoded], student: str) -> Verdict:
    """The verdict on a function that returned `results` for the argument lists `arguments`.

    Raises `Malformed` if none of the results has the form asked for.
    """
    form = question.returns
    found = [read_result(form, result) for result in results]
    complaints = [result for result in found if isinstance(result, Malformed)]
    if len(complaints) == len(found):
        raise complaints[0]
    calls = list(zip(arguments, found, strict=True))

    def compare(ways: tuple[Way, ...], turn: float, args: list, result: object) -> Comparison:
        return compare_result(question, student, ways, turn, args, result)

    def beside(args: list, result: object, other: object | None) -> Comparison:
        if other is None:
            return compare((), 2 * np.pi, args, result)
        return _compare_with(question, result, other, question.setting(student, *args))

    cases: dict[str, list[Call]] = {}
    for args, raw, result in zip(arguments, results, found, strict=True):
        call = Call(args, raw, result, compare((), 2 * np.pi, args, result))
        cases.setdefault(question.case(*args), []).append(call)
    # The first call of each case that shows what is wrong.
    wrong = {
        case: next(call for call in asked if not call.compared.equal)
        for case, asked in cases.items()
        if not all(call.compared.equal for call in asked)
    }
    answers = [
        {repr(expect_result(question, (), student, call.args).forms) for call in asked}
        for case, asked in cases.items()
        if case not in wrong
    ]
    if wrong and (almost := worst(_almost(question, student, call) for call in _not_equal(cases))):
        return verdict_on(form, almost)
    remarks = tuple(_describe(case, call) for case, call in wrong.items())
    verdict = walk(
        question,
        student,
        Comparison(not wrong, _count(answers) / len(cases), remarks, _common_note(cases)),
        lambda ways, turn: all(compare(ways, turn, *call).equal for call in calls),
        lambda: explain_results(question, calls, student, beside),
    )
    if not wrong:
        return verdict
    if verdict.note == "nothing_matched" and len(set(results)) == 1:
        feedback = "**Not right.** Your function returns the same for all arguments that were tried."
        return replace(verdict, feedback=feedback)
    return replace(verdict, feedback=f"{verdict.feedback}\n\n{_examples(list(wrong.values()))}")


@dataclass(frozen=True)
class Call:
    """One list of arguments, what the student's function returned for it, as it came and as it was read, and how that compares."""

    args: list
    raw: Decoded
    result: object
    compared: Comparison


def compare_result(
    question: Question, student: str, ways: tuple[Way, ...], turn: float, args: list, result: object
) -> Comparison:
    """What a student's function returned for `args` beside what the right one returns, or one with mistakes made."""
    expected = expect_result(question, ways, student, args)
    setting = question.setting() if ways else question.setting(student, *args)
    setting = replace(setting, turn=turn, family=expected.family)

    return nearest(_compare_with(question, result, other, setting) for other in expected.forms)


def _compare_with(question: Question, result: object, other: object, setting: Setting) -> Comparison:
    if isinstance(result, Malformed) or isinstance(other, Malformed):
        return Comparison(isinstance(result, Malformed) and isinstance(other, Malformed), 0.0)
    return compare_answers(question.returns, result, other, setting)


def _not_equal(cases: Mapping[str, list[Call]]) -> Iterator[Call]:
    return (call for asked in cases.values() for call in asked if not call.compared.equal)


def _almost(question: Question, student: str, call: Call) -> Almost | None:
    """What keeps a result from being right that is not right as it is."""
    expected = expect_result(question, (), student, call.args)
    others = [other for other in expected.forms if not isinstance(other, Malformed)]
    if isinstance(call.result, Malformed) or not others:
        return None
    setting = replace(question.setting(student, *call.args), family=expected.family)

    def beside(given: object, asked: Setting) -> Comparison:
        return nearest(compare_answers(question.returns, given, other, asked) for other in others)

    return find_almost(question.returns, call.result, setting, beside)


def _count(answers: list[set[str]]) -> int:
    """How many of the cases that are right show something; `answers` are the different right answers of each.

    A constant is right now and then, "no solution" wherever there is none: it is right for cases that all have this one
    answer, and they count only beside a case that has another.
    """
    return len(answers) if len(set().union(*answers)) > 1 else 0


def _common_note(cases: Mapping[str, list[Call]]) -> str:
    """The name of a difference that all wrong results share, if they do."""
    notes = {call.compared.note for asked in cases.values() for call in asked if not call.compared.equal}
    return notes.pop() if len(notes) == 1 else ""


def _describe(case: str, call: Call) -> str:
    """Which case is wrong, and by what at the first argument list that shows it."""
    remark = "; ".join(call.compared.remarks)
    return f"wrong for {case}" + (f" ({remark})" if remark else "")


EXAMPLES = "For example, with"
MOST_EXAMPLES = 3


def _examples(calls: list[Call]) -> str:
    """With which arguments it went wrong, and what came back: enough to try it at home, and nothing of the right result."""
    return (
        f"{EXAMPLES} "
        + "; with ".join(f"`{_told(call.args)}` {_came_back(call)}" for call in calls[:MOST_EXAMPLES])
        + "."
    )


def _came_back(call: Call) -> str:
    if isinstance(call.raw.value, Failure):
        return f"it stopped: {plain(call.raw.value.message)}"
    if isinstance(call.result, Malformed):
        return f"what it returned is not in the form asked for: {plain(str(call.result))}"
    return f"it returned {plain(written(call.raw.value, MOST_RETURNED))}"


def _told(args: list) -> str:
    """Arguments as one would type them: with all digits where there are few, else rounded."""
    text = ", ".join(map(json.dumps, args))
    if len(text) > MOST_DIGITS:
        text = ", ".join(json.dumps(_rounded(arg)) for arg in args)
    return text if len(text) <= MOST_ARGUMENTS else f"{text[: MOST_ARGUMENTS - 3]}..."


def _rounded(arg: object) -> object:
    if isinstance(arg, list):
        return [_rounded(item) for item in arg]
    return float(f"{arg:.5g}") if isinstance(arg, float) else arg
