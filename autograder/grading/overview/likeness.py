"""Equal wrong answers of two students: how surprising they are, against what chance gives in this class.

Equal right answers say nothing, and so do mistakes that many make. For each question, the wrong answers of the class
say how often each of them comes up; two students who answer wrong independently give the same one now and then, a rare
one hardly ever. The surprise of a pair is the sum of -log p over what they share. Its distribution for two who work
alone follows from the class; the tail beyond the pair's own, times the number of pairs, is how many such pairs chance
alone would give.

What stands to reason counts once: a mistake with a name, wherever the two made it, and an answer that follows from an
earlier one which was equal already.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Literal

import numpy as np

Sameness = Literal["mistake", "answer", "text"]
# At least so many different equal wrong answers, and fewer than so many such pairs expected by chance in the class.
_LEAST, _EXPECTED = 2, 0.05
# Step in which surprise is counted, rounded so that chance never looks smaller than it is.
_STEP = 0.02


@dataclass(frozen=True)
class Wrong:
    """What makes a wrong answer the same as another one's to the same question.

    Attributes
    ----------
    by : str
        ``"mistake"`` with a name, equal ``"answer"``, or equal ``"text"`` of a function.
    key : str or int
        The same for equal answers.
    """

    by: Sameness
    key: str | int


@dataclass(frozen=True)
class Shared:
    """A question that two students answered wrong in the same way, as `count` of `wrong` students did."""

    question: str
    wrong: Wrong
    count: int
    of: int

    @property
    def share(self) -> float:
        return self.count / self.of


@dataclass(frozen=True)
class Pair:
    """Two students with equal wrong answers.

    Attributes
    ----------
    shared : tuple of Shared
        The rarest first.
    both_wrong : int
        Questions that both answered wrong, in ways that can be compared.
    expected : float
        How many such pairs chance gives in a class like this, at most.
    """

    students: tuple[str, str]
    shared: tuple[Shared, ...]
    both_wrong: int
    expected: float


def pairs_alike(answers: Mapping[str, Mapping[str, Wrong]], earlier: Mapping[str, str]) -> list[Pair]:
    """Pairs of students whose equal wrong answers chance does not explain, the most surprising first.

    Parameters
    ----------
    answers : mapping
        Wrong answers by question and student.
    earlier : mapping of str to str
        By question, the earlier one whose answer it follows from.
    """
    counts = {question: Counter(found.values()) for question, found in answers.items()}
    students = sorted({student for found in answers.values() for student in found})
    number = len(students) * (len(students) - 1) / 2
    agreeing: dict[tuple[str, str], list[str]] = {}
    for question, found in answers.items():
        alike: dict[Wrong, list[str]] = {}
        for student, wrong in sorted(found.items()):
            alike.setdefault(wrong, []).append(student)
        for group in alike.values():
            for pair in combinations(group, 2):
                agreeing.setdefault(pair, []).append(question)
    pairs = []
    for (one, other), questions in agreeing.items():
        if len(questions) < _LEAST:
            continue
        shared = sorted(
            (
                Shared(question, wrong := answers[question][one], counts[question][wrong], counts[question].total())
                for question in questions
            ),
            key=lambda found: (found.share, found.question),
        )
        counted = _once(shared, earlier)
        if len(counted) < _LEAST:
            continue
        surprise = -sum(np.log(found.share) for found in counted)
        if number * np.exp(-2 * surprise) >= _EXPECTED:  # chance gives at least that
            continue
        both = {name for name, found in answers.items() if one in found and other in found}
        both -= {found.question for found in shared} - {found.question for found in counted}
        expected = number * _chance([counts[name] for name in both], surprise)
        if expected < _EXPECTED:
            pairs.append(Pair((one, other), tuple(shared), len(both), expected))
    return sorted(pairs, key=lambda pair: (pair.expected, pair.students))


def _chance(questions: Iterable[Counter[Wrong]], surprise: float) -> float:
    """How probable so much surprise is for two who answer these questions wrong independently, as the class does."""
    most = int(surprise / _STEP)
    steps = np.zeros(most + 1)  # probability of each surprise; the last one is all that is as large or larger
    steps[0] = 1
    for counts in questions:
        total, differ, agree = counts.total(), 1.0, np.zeros_like(steps)
        for count, alike in Counter(counts.values()).items():
            probability, more = alike * (count / total) ** 2, math.ceil(-math.log(count / total) / _STEP)
            differ -= probability
            agree[more:] += probability * steps[: most + 1 - more] if more <= most else 0
            agree[-1] += probability * steps[max(0, most + 1 - more) :].sum()
        steps = differ * steps + agree
    return float(steps[-1])


def _once(shared: Sequence[Shared], earlier: Mapping[str, str]) -> list[Shared]:
    """What counts of what is shared, the rarest first: each mistake with a name where it is rarest, and no answer that follows from an equal one."""
    questions = {found.question for found in shared}
    named: set[str | int] = set()
    counted = []
    for found in shared:
        if earlier.get(found.question) in questions or (found.wrong.by == "mistake" and found.wrong.key in named):
            continue
        if found.wrong.by == "mistake":
            named.add(found.wrong.key)
        counted.append(found)
    return counted
