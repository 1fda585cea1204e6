"""What all kinds of answer share: the words a form is said in, and entries in the symbols of a question."""

from __future__ import annotations

from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta

from .. import nodes
from ..geometry import phasor
from ..schema import unique
from ..values import values

Text = Annotated[str, Meta(min_length=1)]
Size = Annotated[int, Meta(ge=1, le=1000)]
Names = tuple[Text, ...]


class Sight(msgspec.Struct, frozen=True, kw_only=True):
    """How an answer is looked at when its numbers count: what a question says of comparing, without its answer.

    Attributes
    ----------
    points : tuple of mapping
        Values of the symbols, one mapping for each point at which an answer is evaluated.
    angles : tuple of int
        Entries, or joints, that are angles: equal modulo a full turn.
    tolerance : float
        Largest difference between equal answers, relative to the larger of 1 and the value.
    pins : tuple of str
        What a question fixes of the frames of a DHm table between base and tool: "z", "x", "origin".
    """

    points: tuple[dict[str, float], ...] = ({},)
    angles: tuple[int, ...] = ()
    tolerance: float = 1e-6
    pins: tuple[str, ...] = ()


Parts = dict[str, np.ndarray]
"""Numbers (m,) by which answers are told apart, of the whole answer ("") and of parts that can be right alone."""


class Form:
    """The form in which an answer is asked for, as everybody sees it who reads answers.

    Attributes
    ----------
    expected : str
        The awaited form in words, used in messages.
    units : str
        Units, for the reader.
    decimals : int or None
        Decimals that numbers are asked for; None for expressions and whole numbers.
    """

    expected: str
    units: str
    decimals: int | None

    @property
    def kind(self) -> str:
        """The kind of answer: the name of the module that defines it."""
        return type(self).__module__.rpartition(".")[2]

    @property
    def symbols(self) -> Names:
        """Names of the symbols the answer may contain; none for a numeric answer."""
        return ()

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the answer as an array; () for a kind that has no fixed one."""
        return ()

    def arranged(self, node: object) -> object:
        """`node` in the one arrangement that public checks and the grader go on with; not in this form: as it is."""
        return node

    def misfit(self, node: object) -> str | None:
        """What was found, in words, where the arranged `node` is not in this form; None where it is."""
        raise NotImplementedError

    def invariants(self, node: object, sight: Sight) -> Parts:
        """Numbers that do not depend on what the kind leaves free, such as order, turns or the sense of an axis.

        Those of equal answers differ by at most ``sight.tolerance``. Nothing is returned for an answer that is not
        defined at some point, and by kinds whose answers cannot be told apart by numbers.

        Parameters
        ----------
        node : object
            An answer without complaint, arranged.
        sight : Sight
        """
        return {}

    def witness(self, node: object, sight: Sight) -> np.ndarray:
        """All that is needed to compare two answers exactly, (m,)."""
        return self.invariants(node, sight).get("", np.zeros(0))

    def essential(self, witness: np.ndarray) -> np.ndarray:
        """What of a right answer's witness another one must share to be right; to be a mistake that has a name, all of it."""
        return witness

    def agree(self, first: np.ndarray, second: np.ndarray, sight: Sight) -> bool:
        """Whether two answers are equal, by what `witness` says of them."""
        return first.shape == second.shape and bool((np.abs(first - second) <= sight.tolerance).all())

    def complaint(self, node: object) -> str | None:
        """One sentence on what is wrong with the form of an answer, None if nothing is.

        `node` is what `dhkit.wire.encode` makes of the answer. Entries that are still blank are no fault where a part of
        the answer can be looked at without them.
        """
        found = self.misfit(self.arranged(node))
        return found and f"expected {self.expected}, found {found}"


class Fields(Form, msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A form made of the fields that a question's table gives: these, and those of the kind."""

    expected: Text
    units: str = ""
    decimals: Annotated[int, Meta(ge=1, le=6)] | None = None


class Symbolic(Fields, frozen=True, kw_only=True):
    """A form whose entries are numbers or expressions.

    Attributes
    ----------
    symbols : tuple of str
        Names of the symbols the answer may contain; empty for a numeric answer.
    """

    symbols: Names = ()

    def __post_init__(self) -> None:
        unique("symbols", self.symbols)
        if self.symbols and self.decimals is not None:
            raise ValueError("decimals: expressions in symbols have none")

    def misfit(self, node: object) -> str | None:
        if nodes.array_shape(node) != self.shape:
            return nodes.describe(node)
        return nodes.alien(node, self.symbols)

    def invariants(self, node: object, sight: Sight) -> Parts:
        found = seen(node, sight)
        return {} if found is None else {"": squeezed(found, sight.angles)}


def seen(node: object, sight: Sight) -> np.ndarray | None:
    """Real values of m entries at N points, (N, m); None if one is not defined."""
    found = np.array([values(node, point).ravel() for point in sight.points])
    real = np.abs(found.imag) <= sight.tolerance * np.maximum(1, np.abs(found.real))
    return found.real if np.isfinite(found).all() and real.all() else None


def squeezed(found: np.ndarray, angles: tuple[int, ...] = ()) -> np.ndarray:
    """Values (N, m) as numbers whose absolute error is the relative one of large values; angles as cosine and sine."""
    turns = [i for i in range(found.shape[1]) if i in angles]
    lengths = [i for i in range(found.shape[1]) if i not in angles]
    circle = phasor(found[:, turns])
    return np.concatenate([np.arcsinh(found[:, lengths]), circle.real, circle.imag], axis=1).ravel()
