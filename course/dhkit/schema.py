"""Tables of the questions' files made into typed objects; what is wrong with one is said with the name of its field."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypeVar, get_args, get_origin, get_type_hints

import msgspec

T = TypeVar("T")

_SAID = re.compile(r"(?P<what>.*?)(?: - at `\$\.?(?P<path>.*?)`)?$", re.S)


def convert(table: Mapping[str, object], kind: type[T]) -> T:
    """`table` as an object of the msgspec structure `kind`. `ValueError` names the field that does not fit."""
    try:
        return msgspec.convert(table, kind)
    except msgspec.ValidationError as error:
        raise ValueError(_in_words(str(error), kind)) from None


def choose(table: Mapping[str, object], key: str, kinds: Mapping[str, type[T]]) -> T:
    """`table` as an object of the structure that its entry `key` names."""
    rest = dict(table)
    name = rest.pop(key, None)
    if not isinstance(name, str) or name not in kinds:
        found = "missing" if name is None else f"{name!r} is unknown"
        raise ValueError(f"{key}: {found}; known: {', '.join(kinds)}")
    return convert(rest, kinds[name])


def unique(field: str, names: Sequence[object]) -> None:
    """Refuse a list in which something stands twice."""
    twice = next((name for i, name in enumerate(names) if name in names[:i]), None)
    if twice is not None:
        raise ValueError(f"{field}: {twice} stands twice")


def _in_words(message: str, kind: Any) -> str:
    found = _SAID.fullmatch(message)
    what, path = (found["what"], found["path"] or "") if found else (message, "")
    prefix = f"{path}." if path else ""
    if named := re.fullmatch(r"Object missing required field `(\w+)`", what):
        return f"{prefix}{named[1]}: missing"
    if named := re.fullmatch(r"Object contains unknown field `(.+)`", what):
        known = ", ".join(kind.__struct_fields__)
        return f"{prefix}{named[1]}: unknown field" + (f"; known: {known}" if not path else "")
    if named := re.fullmatch(r"Invalid enum value (.+)", what):
        hint = get_type_hints(kind).get(path)
        allowed = f", only {' or '.join(get_args(hint))}" if get_origin(hint) is Literal else ""
        return f"{path}: {named[1]} is not allowed{allowed}"
    return f"{path}: {what[0].lower()}{what[1:].replace('`', '').replace(', got ', ', found ')}" if path else what
