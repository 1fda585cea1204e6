"""A student's function: what it returned for the arguments it was asked with, case by case."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from .decode import Decoded, Malformed
from .expected import expect_result, read_result
from .kinds import Comparison
from .kinds import compare as compare_answers
from .question import Question, Way
from .tree import Verdict, nearest, walk


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

    cases: dict[str, list[tuple[list, Comparison]]] = {}
    for args, result in calls:
        cases.setdefault(question.case(*args), []).append((args, compare((), 2 * np.pi, args, result)))
    wrong = {case for case, asked in cases.items() if not all(compared.equal for _, compared in asked)}
    answers = {
        case: {repr(expect_result(question, (), student, args).forms) for args, _ in asked}
        for case, asked in cases.items()
        if case not in wrong
    }
    remarks = tuple(_describe(case, [compared for _, compared in cases[case]]) for case in cases if case in wrong)
    against_reference = Comparison(not wrong, _count(answers.values()) / len(cases), remarks)
    verdict = walk(
        question,
        student,
        against_reference,
        lambda ways, turn: all(compare(ways, turn, *call).equal for call in calls),
    )
    if verdict.note == "nothing_matched" and len(set(results)) == 1:
        return replace(
            verdict, feedback="**Not right.** Your function returns the same for all arguments that were tried."
        )
    return verdict


def compare_result(
    question: Question, student: str, ways: tuple[Way, ...], turn: float, args: list, result: object
) -> Comparison:
    """What a student's function returned for `args` beside what the right one returns, or one with mistakes made."""
    expected = expect_result(question, ways, student, args)
    setting = question.setting() if ways else question.setting(student, *args)
    setting = replace(setting, turn=turn, family=expected.family)

    def beside(other: object) -> Comparison:
        if isinstance(result, Malformed) or isinstance(other, Malformed):
            return Comparison(isinstance(result, Malformed) and isinstance(other, Malformed), 0.0)
        return compare_answers(question.returns, result, other, setting)

    return nearest(beside(other) for other in expected.forms)


def _count(answers: Iterable[set[str]]) -> int:
    """How many of the cases that are right show something; `answers` are the different right answers of each.

    A constant is right now and then, "no solution" wherever there is none: it is right for cases that all have this one
    answer, and they count only beside a case that has another.
    """
    answers = list(answers)
    return len(answers) if len(set().union(*answers)) > 1 else 0


def _describe(case: str, compared: list[Comparison]) -> str:
    """Which case is wrong, and by what at the first argument list that shows it."""
    remark = next((one.remarks[-1] for one in compared if not one.equal and one.remarks), "")
    return f"wrong for {case}" + (f" ({remark})" if remark else "")
