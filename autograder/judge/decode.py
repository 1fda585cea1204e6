"""Reads an answer packet that came out of a student's kernel. Nothing in it is trusted.

The result is made of our own frozen nodes only. No text is evaluated, no SymPy object is built, and the
work is bounded before it is done: number of nodes, depth, digits, length of text.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from fractions import Fraction

from dhkit.wire import ARITIES, FORMAT, MAX_ASSUMED, MAX_DEPTH, MAX_DIGITS, MAX_NODES, MAX_TEXT

NO_ANSWER = "What arrived is not what check hands in"


class Malformed(ValueError):
    """The packet breaks the wire format; the message is a sentence for the student."""


@dataclass(frozen=True)
class Number:
    """A real or complex constant; exact where the wire was exact."""

    value: int | float | complex | Fraction


@dataclass(frozen=True)
class Constant:
    """``pi``, ``E`` or ``I``."""

    name: str


@dataclass(frozen=True)
class Symbol:
    name: str


@dataclass(frozen=True)
class Call:
    """An operation (`add`, `mul`, `pow`) or a function of the whitelist, applied to expressions."""

    function: str
    args: tuple[Expression, ...]


@dataclass(frozen=True)
class Text:
    value: str


@dataclass(frozen=True)
class Record:
    """A dictionary with text keys."""

    items: tuple[tuple[str, Value], ...]


@dataclass(frozen=True)
class Function:
    """The student handed in a function of this name; it is judged by probing."""

    name: str


@dataclass(frozen=True)
class Foreign:
    """An object with no place on the wire; only the name of its type is known. As part of an expression it has no value."""

    type: str


@dataclass(frozen=True)
class Failure:
    """A probe of a student's function raised this error."""

    message: str


@dataclass(frozen=True)
class Blank:
    """Not attempted."""


Expression = Number | Constant | Symbol | Call | Foreign
Value = Expression | Text | Record | Function | Failure | Blank | tuple


@dataclass(frozen=True)
class Decoded:
    """An answer that was found to be within the bounds: what it says, the node it was, the symbols assumed to be positive."""

    value: Value
    node: object = field(compare=False, repr=False)
    assumed: tuple[str, ...] = field(default=(), compare=False)


def decode(node: object) -> Decoded:
    """One node; `Malformed` if it breaks the wire format or is beyond its bounds."""
    return Decoded(_Reader().value(node), node)


def decode_answer(packet: object, question: str) -> Decoded:
    """The answer inside a packet of `dhkit.check`; `Malformed` if it is not one for `question`."""
    answer = decode(_content(packet, question, "answer"))
    assumed = packet.get("assumed", []) if isinstance(packet, dict) else []
    if not isinstance(assumed, list) or len(assumed) > MAX_ASSUMED:
        raise Malformed("the answer was not handed in by check()")
    return replace(answer, assumed=tuple(map(_text, assumed)))


def decode_student(packet: object) -> str | None:
    """The id that was typed in the notebook an answer came from, None if it has no numbers of its own."""
    typed = packet.get("student") if isinstance(packet, dict) else None
    return None if typed is None else _text(typed)


def decode_probes(packet: object, question: str, count: int) -> tuple[Decoded, ...]:
    """The `count` results inside a packet of `dhkit.check.answer_probes`."""
    content = _content(packet, question, "probes")
    if not isinstance(content, list) or len(content) != count:
        raise Malformed("the function's answers do not match the arguments that were sent")
    reader = _Reader()
    return tuple(Decoded(reader.value(item), item) for item in content)


def _content(packet: object, question: str, key: str) -> object:
    if not isinstance(packet, dict) or packet.keys() - {"student", "assumed"} != {"format", "question", key}:
        raise Malformed("the answer was not handed in by check()")
    if type(packet["format"]) is not int or packet["format"] != FORMAT:
        raise Malformed("the answer was written by another version of dhkit")
    if packet["question"] != question:
        raise Malformed("the answer belongs to another question")
    return packet[key]


class _Reader:
    """Counts nodes over one packet, so that breadth and depth together stay bounded."""

    def __init__(self) -> None:
        self.left = MAX_NODES

    def value(self, node: object, depth: int = 0) -> Value:
        self.left -= 1
        if self.left < 0 or depth > MAX_DEPTH:
            raise Malformed("the answer is far larger than any answer to this question")
        if isinstance(node, bool):
            return Number(int(node))
        if isinstance(node, (int, float)):
            return Number(_bounded(node))
        if isinstance(node, str):
            return Text(_text(node))
        if isinstance(node, list):
            return tuple(self.value(item, depth + 1) for item in node)
        if not isinstance(node, dict) or len(node) != 1:
            raise Malformed(NO_ANSWER)
        ((kind, content),) = node.items()
        read = getattr(self, f"_{kind}", None) if kind in _TAGGED else None
        if read is None:
            raise Malformed(NO_ANSWER)
        return read(content, depth)

    def _blank(self, content: object, depth: int) -> Blank:
        return Blank()

    def _int(self, content: object, depth: int) -> Number:
        digits = _text(content)
        if len(digits) > MAX_DIGITS or not digits.removeprefix("-").isascii() or not digits.removeprefix("-").isdigit():
            raise Malformed("an integer of the answer is out of bounds")
        return Number(int(digits))

    def _float(self, content: object, depth: int) -> Number:
        if content not in ("nan", "inf", "-inf"):
            raise Malformed(NO_ANSWER)
        return Number(float(content))

    def _complex(self, content: object, depth: int) -> Number:
        real, imaginary = self._pair(content, depth)
        try:
            return Number(complex(real, imaginary))
        except OverflowError:
            raise Malformed("a number of the answer is out of bounds") from None

    def _rat(self, content: object, depth: int) -> Number:
        numerator, denominator = self._pair(content, depth)
        if not isinstance(numerator, int) or not isinstance(denominator, int) or denominator == 0:
            raise Malformed(NO_ANSWER)
        return Number(Fraction(numerator, denominator))

    def _pair(self, content: object, depth: int) -> tuple[int | float | Fraction, int | float | Fraction]:
        if not isinstance(content, list) or len(content) != 2:
            raise Malformed(NO_ANSWER)
        first, second = (self._real(item, depth + 1) for item in content)
        return first, second

    def _real(self, node: object, depth: int) -> int | float | Fraction:
        part = self.value(node, depth)
        if not isinstance(part, Number) or isinstance(part.value, complex):
            raise Malformed(NO_ANSWER)
        return part.value

    def _const(self, content: object, depth: int) -> Constant:
        if content not in ("pi", "E", "I"):
            raise Malformed(NO_ANSWER)
        return Constant(content)

    def _sym(self, content: object, depth: int) -> Symbol:
        return Symbol(_text(content))

    def _call(self, content: object, depth: int) -> Call:
        if not isinstance(content, list) or len(content) < 2 or not isinstance(content[0], str):
            raise Malformed(NO_ANSWER)
        if content[0] not in ARITIES:
            raise Malformed("the answer uses a function that is not known here")
        arity = ARITIES[content[0]]
        if arity is not None and len(content) != arity + 1:
            raise Malformed(f"{content[0]} has the wrong number of arguments")
        if content[0] == "Piecewise" and len(content) % 2 == 0:
            raise Malformed("Piecewise has a value without its condition")
        args = [self.value(item, depth + 1) for item in content[1:]]
        expressions = tuple(arg for arg in args if isinstance(arg, Expression))
        if len(expressions) < len(args):
            raise Malformed("there is a list, a text or a gap inside an expression")
        return Call(content[0], expressions)

    def _dict(self, content: object, depth: int) -> Record:
        if not isinstance(content, list) or not all(isinstance(item, list) and len(item) == 2 for item in content):
            raise Malformed(NO_ANSWER)
        return Record(tuple((_text(key), self.value(item, depth + 1)) for key, item in content))

    def _set(self, content: object, depth: int) -> Value:
        if not isinstance(content, list):
            raise Malformed(NO_ANSWER)
        return tuple(self.value(item, depth + 1) for item in content)

    def _function(self, content: object, depth: int) -> Function:
        return Function(_text(content))

    def _large(self, content: object, depth: int) -> Foreign:
        return Foreign(_text(content))

    def _unknown(self, content: object, depth: int) -> Foreign:
        return Foreign(_text(content))

    def _error(self, content: object, depth: int) -> Failure:
        return Failure(_text(content))


_TAGGED = (
    "blank",
    "int",
    "float",
    "complex",
    "rat",
    "const",
    "sym",
    "call",
    "dict",
    "set",
    "function",
    "large",
    "unknown",
    "error",
)


def _text(content: object) -> str:
    if not isinstance(content, str) or len(content) > MAX_TEXT:
        raise Malformed(NO_ANSWER)
    return content


def _bounded(number: int | float) -> int | float:
    if isinstance(number, int) and number.bit_length() > MAX_DIGITS * 4:
        raise Malformed("an integer of the answer is out of bounds")
    if isinstance(number, float) and not math.isfinite(number):
        raise Malformed(NO_ANSWER)
    return number
