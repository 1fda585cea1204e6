"""The private half of a question: its reference and its response tree."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from dhkit import public

from .chains import SAME_MODEL

Draw = Callable[[np.random.Generator], dict[str, float]]
Step = Callable[[object], object]


@dataclass(frozen=True)
class Variant:
    """Whose question it is. The id comes from the gradebook, never from the notebook."""

    student: str


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
        Markdown that names the mistake and points at the slide, without giving the answer.
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


@dataclass(frozen=True)
class Question:
    """One question as the judge knows it. The form of the answer is in its public half.

    Attributes
    ----------
    id : str
        ``"<exercise>.<name>"``, as in the public half.
    reference : callable
        Maps a `Variant` to the right answer: anything `dhkit.wire.encode` takes, or a function.
    mistakes : tuple of Mistake
        Tried in order when the answer is not right; the first that matches decides.
    partial : float
        Largest share that right parts of an otherwise unrecognised answer can earn.
    angles : tuple of int
        Entries compared modulo 2 pi (vector entries or joints; ``(0,)`` for a single expression).
    tolerance : float
        Largest accepted difference, relative to the larger of 1 and the reference's size.
    pinned : set of str
        Freedoms of the DHm convention that a right table may not use; the default leaves free what no
        statement fixes: the senses of the axes between base and tool, and origins along parallel axes.
    draw : callable, optional
        Draws one sample point for the symbols; the default draws angles and positive lengths independently.
    probe : callable, optional
        Draws the argument lists sent to a student's function.
    group : callable, optional
        Names the case an argument list belongs to; each case earns the same share.
    """

    id: str
    reference: Callable[[Variant], object]
    mistakes: tuple[Mistake, ...] = ()
    partial: float = 0.5
    angles: tuple[int, ...] = ()
    tolerance: float = 1e-6
    pinned: frozenset[str] = SAME_MODEL
    draw: Draw | None = None
    probe: Callable[[np.random.Generator], list[list[float]]] | None = None
    group: Callable[..., str] = lambda *args: "the values tried"

    @cached_property
    def public(self) -> public.PublicQuestion:
        return public.find(self.id)

    def points(self, count: int = 12) -> dict[str, np.ndarray]:
        """Sample values of the symbols: one (count,) array per symbol, the same at every call."""
        rng = np.random.default_rng(_seed(self.id))
        draw = self.draw or (lambda rng: {name: _independent(name, rng) for name in self.public.symbols})
        draws = [draw(rng) for _ in range(count)]
        return {name: np.array([point[name] for point in draws]) for name in self.public.symbols}

    def probes(self, variant: Variant, seed: int) -> list[list[float]] | None:
        """Argument lists for a function question (JSON-able), None for any other kind."""
        if self.probe is None:
            return None
        return self.probe(np.random.default_rng([seed, _seed(f"{self.id} {variant.student}")]))


def _independent(name: str, rng: np.random.Generator) -> float:
    is_angle = name.startswith(("t", "alpha", "phi", "psi"))
    return rng.uniform(-np.pi, np.pi) if is_angle else rng.uniform(0.2, 1.5)


def _seed(text: str) -> int:
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8])
