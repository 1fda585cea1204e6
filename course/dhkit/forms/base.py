"""What all kinds of answer share: the words a form is said in, and entries in the symbols of a question."""

from __future__ import annotations

from typing import Annotated

import msgspec
from msgspec import Meta

from .. import nodes
from ..schema import unique

Text = Annotated[str, Meta(min_length=1)]
Size = Annotated[int, Meta(ge=1, le=1000)]
Names = tuple[Text, ...]


class Form:
    """The form in which an answer is asked for, as everybody sees it who reads answers.

    Attributes
    ----------
    expected : str
        The awaited form in words, used in messages.
    units : str
        Units, for the reader.
    """

    expected: str
    units: str

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

    def complaint(self, node: object) -> str | None:
        """One sentence on what is wrong with the form of an answer, None if nothing is.

        `node` is what `dhkit.wire.encode` makes of the answer. Entries that are still blank are no fault where a part of
        the answer can be looked at without them.
        """
        found = self.misfit(self.arranged(node))
        return found and f"expected {self.expected}, found {found}"


class Fields(Form, msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A form made of the fields that a question's table gives: these two, and those of the kind."""

    expected: Text
    units: str = ""


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

    def misfit(self, node: object) -> str | None:
        if nodes.array_shape(node) != self.shape:
            return nodes.describe(node)
        return nodes.alien(node, self.symbols)
