"""The private half of a question: its reference and its response tree."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from inspect import signature

import numpy as np

from dhkit import public, variants

from .chain import SAME_MODEL

Draw = Callable[[np.random.Generator], dict[str, float]]
Step = Callable[[object], object]


@dataclass(frozen=True)
class Variant:
    """Whose question it is. The id comes from the gradebook, never from the notebook."""

    student: str

    def numbers(self, exercise: str) -> dict[str, float | str]:
        """The student's own numbers for an exercise, as `dhkit.variants` derives them."""
        return variants.numbers(exercise, self.student)


@dataclass(frozen=True)
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
        Each takes an answer and returns it with the mistake made, in one of its forms. Where two mistakes
        meet in one answer, the step of one is applied to what the step of the other returns.
    turn : float
        A full turn in the unit of the mistaken answer's joint angles.
    """

    note: str
    share: float
    feedback: str
    steps: tuple[Step, ...]
    turn: float = 2 * np.pi


def mistake(note: str, share: float, feedback: str, *steps: Step, turn: float = 2 * np.pi) -> Mistake:
    """A `Mistake`; give its steps, each a function from an answer to the mistaken answer."""
    return Mistake(note, share, feedback, steps, turn)


class Made(list):
    """A right answer that remembers what it was made of, for wrong steps that go wrong on the way to it.

    ``Made(cloud, arm=arm)`` is the list ``cloud(arm=arm)``; ``but(arm=shorter)`` makes it again with something changed.
    """

    def __init__(self, make: Callable[..., list], **of) -> None:
        super().__init__(make(**of))
        self.make, self.of = make, of

    def but(self, **change) -> Made:
        return Made(self.make, **self.of | change)


@dataclass(frozen=True)
class Family:
    """Infinitely many joint solutions: some representatives of them. Every solution that reaches the target is right."""

    solutions: object


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


@dataclass(frozen=True)
class Question:
    """One question as the judge knows it. The form of the answer is in its public half.

    Attributes
    ----------
    id : str
        ``"<exercise>.<name>"``, as in the public half.
    reference : callable
        Maps a `Variant` to the right answer: anything `dhkit.wire.encode` takes, a function, or a `Family`.
    mistakes : tuple of Mistake
        Tried in order when the answer is not right; the first that matches decides.
    partial : float
        Largest share that right parts of an otherwise unrecognised answer can earn.
    angles : tuple of int
        Entries compared modulo 2 pi (vector entries or joints; ``(0,)`` for a single expression).
    tolerance : float
        Largest accepted difference, relative to the larger of 1 and the reference's size; metres for a point cloud.
    pinned : set of str
        Freedoms of the DHm convention that a right table may not use; the default leaves free what no
        statement fixes: the senses of the axes between base and tool, and origins along parallel axes.
    draw : callable, optional
        Draws one sample point for the symbols; the default draws angles and positive lengths independently.
    probe : callable, optional
        Draws the argument lists sent to a student's function; takes ``(rng)``, or ``(rng, variant)`` where they depend
        on whose question it is.
    group : callable, optional
        Names the case an argument list belongs to; each case earns the same share.
    misses : callable, optional
        For joint solutions: ``misses(q, variant, *args)`` puts solutions q, (k, n), through the direct model and returns
        how far they are from the target, (k,), in metres and radians. `args` are the arguments of a probed function.
    follows : Follow, optional
        The earlier question whose error is not counted a second time.
    """

    id: str
    reference: Callable[[Variant], object]
    mistakes: tuple[Mistake, ...] = ()
    partial: float = 0.5
    angles: tuple[int, ...] = ()
    tolerance: float = 1e-6
    pinned: frozenset[str] = SAME_MODEL
    draw: Draw | None = None
    probe: Callable[..., list[list[float]]] | None = None
    group: Callable[..., str] = lambda *args: "the values tried"
    misses: Callable[..., np.ndarray] | None = None
    follows: Follow | None = None

    @cached_property
    def public(self) -> public.PublicQuestion:
        return public.find(self.id)

    @property
    def exercise(self) -> str:
        return self.id.partition(".")[0]

    @cached_property
    def samples(self) -> dict[str, np.ndarray]:
        """Sample values of the symbols: one (12,) array per symbol, the same at every call."""
        rng = np.random.default_rng(_seed(self.id))
        draw = self.draw or (lambda rng: {name: _independent(name, rng) for name in self.public.symbols})
        draws = [draw(rng) for _ in range(12)]
        return {name: np.array([point[name] for point in draws]) for name in self.public.symbols}

    def probes(self, variant: Variant, seed: int) -> list[list[float]] | None:
        """Argument lists for a function question (JSON-able), None for any other kind."""
        if self.probe is None:
            return None
        rng = np.random.default_rng([seed, _seed(f"{self.id} {variant.student}")])
        return self.probe(rng) if len(signature(self.probe).parameters) == 1 else self.probe(rng, variant)


def _independent(name: str, rng: np.random.Generator) -> float:
    is_angle = name.startswith(("t", "alpha", "beta", "gamma", "phi", "psi", "q", "omega"))
    return rng.uniform(-np.pi, np.pi) if is_angle else rng.uniform(0.2, 1.5)


def _seed(text: str) -> int:
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8])
