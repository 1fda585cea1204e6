"""Practice: a question again with other numbers, as often as one likes, with verdicts and without points."""

from __future__ import annotations

from .. import public, variants
from ..notice import Line, Notice, show
from ..variants import OwnNumbers
from ..words import plain
from .envelopes import find
from .verdict import Verdict, verdict

_rounds: dict[str, int] = {}
_streaks: dict[str, int] = {}


class Practice:
    """A question with numbers to practise with.

    Attributes
    ----------
    numbers : OwnNumbers
        By name, in place of one's own: ``task.numbers["L1"]``.
    """

    def __init__(self, question: public.PublicQuestion, student: str) -> None:
        self._question, self._student, self._counted = question, student, False
        self.numbers = OwnNumbers(variants.numbers(question.exercise, student))
        self.numbers.__dict__["student"] = "practice"

    def check(self, answer: object = ...) -> Verdict:
        """The verdict on `answer` for these numbers; right at the first try of a task makes the streak longer."""
        found = verdict(self._question.id, answer, self._student)
        if found.state not in ("blank", "form"):
            streak = _streaks.get(self._question.id, 0)
            if found.state != "right":
                _streaks[self._question.id] = 0
            elif not self._counted:
                _streaks[self._question.id] = streak + 1
            self._counted = True
        row = _streaks.get(self._question.id, 0)
        lines = [Line(found.state == "right", found.text or found.state)]
        if row > 1:
            lines.append(Line(None, f"{row} in a row"))
        show(Notice(f"Practice: {self._question.title}", "", tuple(lines)))
        return found

    def _repr_markdown_(self) -> str:
        numbers = ", ".join(f"{name} = {value}" for name, value in self.numbers.items())
        return f"Practice, **{self._question.title}**: {numbers}. Then `task.check(your answer)`."

    def __repr__(self) -> str:
        return plain(self._repr_markdown_())


def practice(id: str) -> Practice:
    """New numbers for question `id`, never one's own; the question is the same as in its exercise.

    Raises
    ------
    ValueError
        If the answer does not depend on numbers of one's own, or is decided by the grader alone.
    """
    question = public.find(id)
    sealed = find(question.exercise)
    here = None if sealed is None else sealed.of(id)
    if here is None or here.why_not:
        raise ValueError(f"{id} has no verdict here, so there is nothing to practise with")
    if not here.personal:
        raise ValueError(f"{id} is the same for everybody; practise it as it stands")
    own = variants.number_set(question.exercise, variants.typed(question.exercise) or variants.NOBODY)
    sets = range(len(here.shared) or len(here.envelopes))
    others = [which for which in sets if here.place(which) != here.place(own)]
    turn = _rounds.get(id, 0)
    _rounds[id] = turn + 1
    which = others[(own + 11 * turn) % len(others)]
    return Practice(question, variants.member(question.exercise, which))
