"""Decoded answers as plain text, the way one would type them: for people who look at a class.

The text is short and printable whatever was handed in; it is not yet safe for HTML or a spreadsheet, see `plain`.
"""

from __future__ import annotations

import re
from fractions import Fraction

from .decode import Blank, Call, Constant, Expression, Failure, Foreign, Function, Number, Record, Symbol, Text, Value

LIMIT = 1200
# How tightly a text holds together: what binds less than its surroundings demand is put in parentheses.
_SUM, _PRODUCT, _POWER, _ATOM = range(4)
_Part = tuple[str, int]


def written(value: Value, limit: int = LIMIT) -> str:
    """`value` as text of at most `limit` characters; a table or matrix has one line per row, its columns aligned."""
    if isinstance(value, tuple) and value and all(isinstance(row, tuple) for row in value):
        return _cut(_rows(value, limit), limit)
    return _cut(_text(value), limit)


def _rows(rows: tuple, limit: int) -> str:
    share = max(12, limit // max(1, sum(map(len, rows))) - 2)
    texts = [[_cut(_text(entry), share) for entry in row] for row in rows]
    widths = [max((len(row[i]) for row in texts if i < len(row)), default=0) for i in range(max(map(len, texts)))]
    if sum(widths) <= 100:
        texts = [[text.rjust(width) for text, width in zip(row, widths)] for row in texts]
    return "\n".join(f"[{', '.join(row)}]" for row in texts)


def _cut(text: str, limit: int) -> str:
    return text if len(text) <= limit else f"{text[: limit - 3]}..."


def _text(value: Value) -> str:
    match value:
        case tuple():
            return f"[{', '.join(map(_text, value))}]"
        case Record(items):
            return "{" + ", ".join(f"{_quoted(key)}: {_text(item)}" for key, item in items) + "}"
        case Text(text):
            return _quoted(text)
        case Function(name):
            return f"a function {_printable(name)}"
        case Failure(message):
            return f"an error: {_printable(message)}"
        case Blank():
            return "..."
    return _expression(value)[0]


def _printable(text: str) -> str:
    return "".join(character if character.isprintable() else " " for character in text)


def _quoted(text: str) -> str:
    return f'"{_printable(text)}"'


def _expression(value: Expression) -> _Part:
    match value:
        case Number(number):
            return _number(number)
        case Constant(name) | Symbol(name):
            return _printable(name), _ATOM
        case Foreign(type):
            return f"an object of type {_printable(type)}", _ATOM
        case Call("add", args):
            return _sum(args)
        case Call("mul", args):
            return _product(args)
        case Call("pow", (base, exponent)):
            return _power(base, exponent)
        case Call(name, args):
            return f"{name}({', '.join(_expression(arg)[0] for arg in args)})", _ATOM


def _number(number: int | float | complex | Fraction) -> _Part:
    match number:
        case int():
            text = str(number)
        case Fraction(numerator=p, denominator=q):
            text = f"{p}/{q}"
        case float():
            text = f"{number:.6g}"
        case _:
            return f"({number:.6g})", _ATOM
    return text, _SUM if text.startswith("-") else _PRODUCT if "/" in text else _ATOM


def _within(part: _Part, least: int) -> str:
    text, binding = part
    return text if binding >= least else f"({text})"


def _sum(args: tuple) -> _Part:
    """Terms with a minus sign go last."""
    terms = sorted((_expression(arg)[0] for arg in args), key=lambda term: term.startswith("-"))
    return " + ".join(terms).replace("+ -", "- "), _SUM


def _product(args: tuple) -> _Part:
    """Factors with a negative exponent go below the line, one minus sign to the front."""
    above, below, sign = [], [], ""
    for place, arg in enumerate(args):
        match arg:
            case Number(int() | float() | Fraction() as number) if place == 0 and number < 0:
                sign, arg = "-", Number(-number)
        match arg:
            case Number(1) if len(args) > 1:
                continue
            case Number(Fraction(numerator=p, denominator=q)):
                above += [str(p)] if p != 1 else []
                below.append(str(q))
            case Call("pow", (base, Number(int() | Fraction() as exponent))) if exponent < 0:
                below.append(_within(_power(base, Number(-exponent)), _POWER))
            case _:
                above.append(_within(_expression(arg), _PRODUCT))
    text = "*".join(above) or "1"
    if below:
        text += f"/{below[0]}" if len(below) == 1 else f"/({'*'.join(below)})"
    return f"{sign}{text}", _SUM if sign else _PRODUCT


def _power(base, exponent) -> _Part:
    match exponent:
        case Number(1):
            return _expression(base)
        case Number(Fraction(numerator=1, denominator=2)):
            return f"sqrt({_expression(base)[0]})", _ATOM
        case Number(int() | Fraction() as number) if number < 0:
            return f"1/{_within(_power(base, Number(-number)), _POWER)}", _PRODUCT
    return f"{_within(_expression(base), _ATOM)}**{_within(_expression(exponent), _ATOM)}", _POWER


def plain(text: str) -> str:
    """`text` made harmless for Markdown, HTML and terminals, and short."""
    text = re.sub(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069]+", " ", text)[:300]
    return (
        re.sub(r"([\\`*_{}\[\]<>()#+!|$~&])", r"\\\1", text)
        .replace("\\<", "&lt;")
        .replace("\\>", "&gt;")
        .replace("\\&", "&amp;")
    )
