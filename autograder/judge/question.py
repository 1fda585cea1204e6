"""The private half of a question: its reference and its response tree."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from inspect import Parameter, signature
from itertools import chain
from typing import Any

import numpy as np
import sympy

from dhkit import public
from dhkit.forms import Form
from dhkit.forms.dh_table import DH_COLUMNS
from dhkit.forms.function import Function
from dhkit.variants import OwnNumbers, normal_form, numbers

from .chain import SAME_MODEL
from .kinds import Setting

EXACT = 1e-6
"""Largest accepted difference of what is not rounded: whole numbers, and expressions at sample points."""

Draw = Callable[[np.random.Generator], dict[str, float]]
Answer = Any
"""Anything `dhkit.wire.encode` takes, or a `Family`; a function for a question that is probed."""

Step = Callable[[Answer], Answer]
Wrong = Mapping[str, object]


@dataclass(frozen=True, eq=False)
class Way:
    """One way to make a mistake: the reference called with the keywords of `wrong`, or `step` taken on what it returns."""

    wrong: Wrong | None = None
    step: Step | None = None


@dataclass(frozen=True, eq=False)
class Mistake:
    """A node of the response tree: the reference with one thing done wrong.

    Attributes
    ----------
    note : str
        Stable key for class statistics, for example ``"sign_of_d2"``.
    share : float
        Share of the points, 0 to 1.
    feedback : str
        Markdown that names the mistake and points at the slide, without giving the answer. ``{name}`` stands for
        the student's own number of that name.
    steps : tuple of callable
        Each takes an answer and returns it with the mistake made, in one of its forms. The answer of a probed question
        is what the function returns.
    wrong : tuple of mapping
        Each holds keywords of the question's reference that make it compute the mistaken answer, in one of its forms.
    turn : float
        A full turn in the unit of the mistaken answer's joint angles.
    """

    note: str
    share: float
    feedback: str
    steps: tuple[Step, ...] = ()
    wrong: tuple[Wrong, ...] = ()
    turn: float = 2 * np.pi

    @cached_property
    def ways(self) -> tuple[Way, ...]:
        """Every form of the mistake."""
        return (*(Way(wrong=wrong) for wrong in self.wrong), *(Way(step=step) for step in self.steps))


def mistake(
    note: str,
    share: float,
    feedback: str,
    *steps: Step,
    wrong: Wrong | Sequence[Wrong] = (),
    turn: float = 2 * np.pi,
) -> Mistake:
    """A `Mistake`, made on the way to the answer or on the answer itself.

    ``mistake("bend_in_degrees", 0.6, "...", wrong={"bend": "degrees"})`` calls the reference as
    ``reference(mine, bend="degrees")``; ``mistake("x_and_y_exchanged", 0.5, "...", lambda point: point[::-1])`` changes
    what it returns. A mistake of several forms gives several steps, or a list of such keywords.
    """
    return Mistake(note, share, feedback, steps, (wrong,) if isinstance(wrong, Mapping) else tuple(wrong), turn)


@dataclass(frozen=True)
class Family:
    """Infinitely many joint solutions, by some of them. Every solution that reaches the target is right.

    Who makes a mistake gives one of these representatives, or some, with the mistake in each.
    """

    solutions: list


@dataclass(frozen=True)
class Follow:
    """An error that was made, and paid for, in an earlier question is forgiven in a later one.

    Attributes
    ----------
    earlier : str
        Id of the earlier question; its symbols are among those of the later one.
    model : callable
        What follows from the student's own earlier answer: takes its values at the N sample points, an array
        (N, *shape), and returns the values of the answer that would be right then, (N, ...).
    """

    earlier: str
    model: Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class Question:
    """One question as the judge knows it. The form of the answer is in its public half.

    Attributes
    ----------
    id : str
        ``"<exercise>.<name>"``, as in the public half.
    reference : answer or callable
        The right answer: anything `dhkit.wire.encode` takes, or a `Family`. Where it depends on the student's own
        numbers, or where mistakes are made on the way to it, a function that returns it: its parameter ``mine`` holds
        the student's numbers (``mine.L1``), each other one is a keyword that makes one thing wrong, and whose default
        is right. Of a probed question the right function itself, with such keywords behind its arguments.
    mistakes : tuple of Mistake
        Tried in order when the answer is not right; the first that matches decides.
    partial : float
        Largest share that right parts of an otherwise unrecognised answer can earn.
    position_share : float
        Share of the position among the parts of a transform; 0 where the statement gives it.
    columns : tuple of str
        The letters that the statement puts over the columns of a DHm table.
    places : bool
        Whether feedback may tell which parts of an answer are wrong; not where just this is the answer.
    angles : tuple of int
        Entries compared modulo 2 pi (vector entries, joints, cells of a matrix row after row; ``(0,)`` for a single
        expression).
    tolerance : float, optional
        Largest accepted difference, relative to the larger of 1 and the reference's size; metres for a point cloud. It
        is one unit of the last decimal that the public half asks for, unless it is given.
    pinned : set of str
        Freedoms of the DHm convention that a right table may not use; the default leaves free what no
        statement fixes: the senses of the axes between base and tool, and origins along parallel axes.
    draw : callable, optional
        Draws one sample point for the symbols; the default draws angles and positive lengths independently.
    probe : callable, optional
        Draws the argument lists sent to a student's function: ``probe(rng)``, or ``probe(rng, mine)``.
    case : callable, optional
        Names the case an argument list belongs to; each case earns the same share.
    residual : callable, optional
        For joint solutions: ``residual(q, *args)`` puts solutions q, (k, n), through the direct model and returns how
        far they are from the target, (k,), in metres and radians. `args` are the arguments of a probed function; a
        parameter ``mine`` holds the student's numbers.
    follows : Follow, optional
        The earlier question whose error is not counted a second time.
    depends : tuple of str, optional
        Of a personal question, those of the student's numbers that change anything; all of them by default.
    """

    id: str
    reference: Answer
    mistakes: tuple[Mistake, ...] = ()
    partial: float = 0.5
    position_share: float = 0.5
    columns: tuple[str, ...] = DH_COLUMNS
    places: bool = True
    angles: tuple[int, ...] = ()
    tolerance: float | None = None
    pinned: frozenset[str] = SAME_MODEL
    draw: Draw | None = None
    probe: Callable[..., list[list]] | None = None
    case: Callable[..., str] = lambda *args: "the values tried"
    residual: Callable[..., np.ndarray] | None = None
    follows: Follow | None = None
    depends: tuple[str, ...] | None = None

    def __post_init__(self) -> None:
        parameters = _parameters(self.reference) if _is_function(self.reference) else {}
        known = {name for name, one in parameters.items() if one.default is not Parameter.empty and name != "mine"}
        needed = [name for name, one in parameters.items() if name != "mine" and name not in known]
        if needed and self.probe is None:
            raise ValueError(
                f"{self.id}: the reference takes {', '.join(needed)}, but is given the student's numbers alone, as mine"
            )
        for node in self.mistakes:
            unknown = set(chain.from_iterable(node.wrong)) - known
            if unknown:
                takes = f"takes {', '.join(sorted(known))}" if known else "takes no keyword"
                raise ValueError(f"{self.id}: {node.note} sets {', '.join(sorted(unknown))}, but the reference {takes}")

    @cached_property
    def public(self) -> public.PublicQuestion:
        return public.find(self.id)

    @property
    def form(self) -> Form:
        """The form in which the answer is asked for."""
        return self.public.form

    @property
    def returns(self) -> Form:
        """The form of what the function returns that is asked for."""
        assert isinstance(self.form, Function)
        return self.form.returns

    @cached_property
    def accuracy(self) -> float:
        """Largest accepted difference (see `tolerance`)."""
        if self.tolerance is not None:
            return self.tolerance
        form = self.returns if isinstance(self.form, Function) else self.form
        return EXACT if form.decimals is None else 10.0**-form.decimals

    @property
    def exercise(self) -> str:
        return self.id.partition(".")[0]

    @property
    def personal(self) -> bool:
        """Whether the right answer depends on the student's own numbers."""
        return _is_function(self.reference) and "mine" in _parameters(self.reference)

    def numbers(self, student: str) -> OwnNumbers:
        """The student's own numbers for the exercise. `student` is the id in the gradebook, never the one in the notebook."""
        return OwnNumbers(numbers(self.exercise, student))

    def answer(self, student: str, *ways: Way) -> Answer:
        """The right answer for a student; with `ways`, the one of somebody who makes these mistakes, in this order.

        A function for a probed question.
        """
        wrong = {name: value for way in ways for name, value in (way.wrong or {}).items()}
        steps = [way.step for way in ways if way.step is not None]
        made = self.compute(student, wrong)
        if self.form.kind == "function":
            return lambda *args: take(steps, made(*args))
        return take(steps, made)

    def compute(self, student: str, wrong: Wrong) -> Answer:
        """What the reference gives for a student when it goes wrong as told."""
        if not _is_function(self.reference):
            return self.reference
        reference = partial(_with_own(self.reference, self.numbers(student)), **wrong)
        return reference if self.form.kind == "function" else reference()

    @cached_property
    def samples(self) -> dict[str, np.ndarray]:
        """Sample values of the symbols: one (12,) array per symbol, the same at every call."""
        rng = np.random.default_rng(_seed(self.id))
        draw = self.draw or (lambda rng: {name: _independent(name, rng) for name in self.form.symbols})
        draws = [draw(rng) for _ in range(12)]
        return {name: np.array([sample[name] for sample in draws]) for name in self.form.symbols}

    def probes(self, student: str, seed: int) -> list[list] | None:
        """Argument lists for a function question (JSON-able), None for any other kind."""
        if self.probe is None:
            return None
        rng = np.random.default_rng([seed, _seed(f"{self.id} {normal_form(student)}")])
        return _with_own(self.probe, self.numbers(student))(rng)

    def setting(self, student: str | None = None, *args) -> Setting:
        """How answers are compared; without a student nobody asks how far a solution is from its target."""
        residual = None
        if self.residual is not None and student is not None:
            own = _with_own(self.residual, self.numbers(student))
            residual = lambda q: own(q, *args)  # noqa: E731
        return Setting(
            self.samples,
            self.angles,
            self.accuracy,
            self.pinned,
            residual=residual,
            position_share=self.position_share,
            columns=self.columns,
        )


def take(steps: Sequence[Step], answer: Answer) -> Answer:
    """The answer after some steps, the first one first; of a family they take all representatives."""
    if steps and isinstance(answer, Family):
        answer = answer.solutions
    for step in steps:
        answer = step(answer)
    return answer


def _is_function(reference: Answer) -> bool:
    """SymPy's symbols can be called too, but they are values."""
    return callable(reference) and not isinstance(reference, sympy.Basic)


def _parameters(function: Callable) -> Mapping[str, Parameter]:
    try:
        return signature(function).parameters
    except ValueError:  # built into Python, like max
        return {}


def _with_own(function: Callable, mine: OwnNumbers) -> Callable:
    """`function` with the student's numbers for its parameter ``mine``, where it has one."""
    return partial(function, mine=mine) if "mine" in _parameters(function) else function


def _independent(name: str, rng: np.random.Generator) -> float:
    is_angle = name.startswith(("t", "alpha", "beta", "gamma", "phi", "psi", "q", "omega"))
    return rng.uniform(-np.pi, np.pi) if is_angle else rng.uniform(0.2, 1.5)


def _seed(text: str) -> int:
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8])
