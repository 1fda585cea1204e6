"""The response tree: right, then each mistake, then two mistakes at once, then the parts that are right."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import permutations, product

from .kinds import Comparison
from .question import Question, Way

Matches = Callable[[tuple[Way, ...], float], bool]

UNEXPLAINED = frozenset({"nothing_matched", "partly_right", "one_cell", "malformed"})
"""Notes of wrong answers in which no misconception was found."""

# What a mistake may run into: it fails where the student's function does, some mistakes exclude each other.
IMPOSSIBLE = (ArithmeticError, AttributeError, IndexError, KeyError, TypeError, ValueError)


@dataclass(frozen=True)
class Verdict:
    """Share of the points (0 to 1), answer note (a stable key) and feedback (Markdown).

    `slip`: without a name for it, all but one row or entry is right.
    """

    share: float
    note: str
    feedback: str
    slip: bool = False


@dataclass(frozen=True)
class Slip:
    """A wrong step that may happen in any question of a kind: its note, its share of the points, its feedback."""

    note: str
    share: float
    feedback: str


def is_forgivable(verdict: Verdict) -> bool:
    """Whether what follows from an answer may earn points although the answer is wrong.

    The mistake has a name, or stands in one row or entry: from a guess, or from rows that happen to be right,
    everything and nothing follows.
    """
    return verdict.share > 0 and (verdict.note not in UNEXPLAINED or verdict.slip)


def walk(
    question: Question,
    student: str,
    against_reference: Comparison,
    matches: Matches,
    explain: Callable[[], Slip | None] = lambda: None,
) -> Verdict:
    """The verdict of the first node that fits: a mistake of the question, a slip of its kind, two mistakes of the question.

    Parameters
    ----------
    against_reference : Comparison
        The student's answer beside the right one.
    matches : callable
        Whether the student's answer is the one with mistakes made in the given ways; angles modulo the given turn.
    explain : callable
        The slip that may happen in any question of the kind, if it is one.
    """
    if against_reference.equal:
        used = ", ".join(against_reference.remarks)
        said = f"The same chain as ours, with {used}." if used else ""
        return Verdict(1.0, "right", " ".join(filter(None, ("**Right.**", said, against_reference.aside))))
    numbers = question.numbers(student)
    for node in question.mistakes:
        if any(_is_match(matches, (way,), node.turn) for way in node.ways):
            return Verdict(node.share, node.note, _fill_in(node.feedback, numbers))
    share = min(question.partial, against_reference.share)
    slip = _explained(explain)
    # A name never costs points.
    explained = slip and Verdict(max(share, slip.share), slip.note, slip.feedback)
    if explained and "+" not in explained.note:
        return explained
    for pair in permutations(range(_pairable(question)), 2):
        first, second = (question.mistakes[place] for place in pair)
        turn = max(first.turn, second.turn)
        ways = product(first.ways, second.ways)
        # The other order was tried already if the second stands first in the tree; it makes a difference for two steps only.
        new = (both for both in ways if pair[0] < pair[1] or all(way.step for way in both))
        if any(_is_match(matches, both, turn) for both in new):
            note = "+".join(sorted((first.note, second.note)))
            feedback = "\n\n".join(_fill_in(node.feedback, numbers) for node in (first, second))
            return Verdict(first.share * second.share, note, feedback)
    if explained:
        return explained
    what = "; ".join(against_reference.remarks) or "the answer differs from the right one"
    note = against_reference.note or ("partly_right" if share > 0 else "nothing_matched")
    feedback = f"**{'Partly right' if share > 0 else 'Not right'}.** {what[0].upper()}{what[1:]}."
    return Verdict(share, note, feedback, against_reference.slip)


def _explained(explain: Callable[[], Slip | None]) -> Slip | None:
    """What `explain` finds; nothing where a slip cannot be made on what was handed in."""
    try:
        return explain()
    except IMPOSSIBLE:
        return None


def _pairable(question: Question) -> int:
    """How many of the mistakes may meet another one: none where the answer is one number, which two may give by chance."""
    return 0 if question.form.kind == "number" else len(question.mistakes)


def nearest(comparisons: Iterable[Comparison]) -> Comparison:
    """The comparison with the form that the student's answer has; the last one where it has none of them."""
    for comparison in comparisons:
        if comparison.equal:
            break
    return comparison


def _is_match(matches: Matches, ways: tuple[Way, ...], turn: float) -> bool:
    """`matches`, but False where a mistake cannot be made: after another one, or with this student's numbers."""
    try:
        return matches(ways, turn)
    except IMPOSSIBLE:
        return False


def _fill_in(feedback: str, numbers: dict) -> str:
    """The feedback of a mistake with the student's own numbers in it."""
    return re.sub(r"\{(\w+)\}", lambda found: f"{numbers[found[1]]}" if found[1] in numbers else found[0], feedback)
