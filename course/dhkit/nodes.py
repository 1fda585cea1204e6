"""Walks over the nodes of an answer (see `dhkit.wire`): what is blank, which shape it has, what does not belong there.

Nodes come from `wire.encode`, or have been accepted by the grader's decoder: they are within the bounds of the wire.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence


def is_blank(node: object) -> bool:
    """True where nothing was attempted: ``...``, ``None``, or an array of nothing else."""
    if isinstance(node, list):
        return bool(node) and all(map(is_blank, node))
    return isinstance(node, dict) and "blank" in node


def blanks(node: object) -> int:
    """Number of entries that are still ``...`` or ``None``."""
    return sum(map(is_blank, entries(node)))


def entries(node: object) -> Iterator[object]:
    """Everything in nested lists that is no list itself, row after row."""
    if isinstance(node, list):
        for item in node:
            yield from entries(item)
    else:
        yield node


def array_shape(node: object) -> tuple[int, ...] | None:
    """Shape of nested lists or tuples, () for a scalar, None where rows have different lengths."""
    if not isinstance(node, (list, tuple)):
        return ()
    shapes = {array_shape(item) for item in node}
    if not shapes:
        return (0,)
    inner = shapes.pop()
    return None if shapes or inner is None else (len(node), *inner)


def keyed(node: object) -> dict[str, object] | None:
    """The items of a dictionary node, None for any other node and where a key stands twice."""
    if not isinstance(node, dict) or "dict" not in node:
        return None
    items = dict(node["dict"])
    return items if len(items) == len(node["dict"]) else None


def alone(node: object) -> object:
    """What stands alone in lists or dictionaries, however many are around it; any other node as it is."""
    while True:
        match node:
            case [only] | {"set": [only]} | {"dict": [[_, only]]}:
                node = only
            case _:
                return node


def listed(node: object) -> object:
    """A set as a list, for a form that wants no order; any other node as it is."""
    return node["set"] if isinstance(node, dict) and "set" in node else node


def in_order(node: object, names: Sequence[str]) -> object:
    """A dictionary with exactly the keys `names` as a list in their order; anything else as it is."""
    items = keyed(node)
    return [items[name] for name in names] if items and items.keys() == set(names) else node


def rows_in_order(node: object, names: Sequence[str]) -> object:
    """Rows of a table as lists in the order of its columns `names`.

    They may be dictionaries keyed by these names, or the whole table a dictionary of equally long columns.
    """
    if isinstance(node, list):
        return [in_order(row, names) for row in node]
    columns = in_order(node, names)
    if not isinstance(columns, list) or not all(isinstance(column, list) for column in columns):
        return columns
    equally_long = len({len(column) for column in columns}) == 1
    return [list(row) for row in zip(*columns, strict=True)] if equally_long else node


def describe(node: object) -> str:
    """What a node is, in words."""
    match node:
        case bool():
            return "a truth value"
        case int() | float():
            return "a number"
        case str():
            return f"the text {quoted(node)}"
        case list():
            shape = array_shape(node)
            if shape is None:
                return "a list whose rows have different lengths"
            return "an empty list" if shape == (0,) else f"an array of shape {' x '.join(map(str, shape))}"
        case {"set": _}:
            return "a set, which has no order"
        case {"dict": []}:
            return "an empty dictionary"
        case {"dict": items}:
            return f"a dictionary with the keys {', '.join(str(key)[:20] for key, _ in items[:6])}"
        case {"function": _}:
            return "a function"
        case {"blank": _}:
            return "no answer"
        case {"large": words}:
            return str(words)
        case {"unknown": kind}:
            return f"an object of type {str(kind).rpartition('.')[2]}"
        case {"error": message}:
            return f"an error ({message})"
    return "an expression"


def quoted(text: str) -> str:
    """A text in quotation marks, cut to twenty characters."""
    return f'"{text[:20]}{"..." if len(text) > 20 else ""}"'


def alien(node: object, symbols: Sequence[str]) -> str | None:
    """The first part of an answer that is neither blank nor a finite expression in `symbols`, in words; None if all are."""
    if isinstance(node, list):
        return next(filter(None, (alien(item, symbols) for item in node)), None)
    match node:
        case bool() | int() | float() | {"blank": _} | {"int": _} | {"rat": _} | {"const": _}:
            return None
        case str():
            return f"the text {quoted(node)}: write {node.strip()[:20]} without quotation marks"
        case {"complex": parts}:
            return alien(parts, symbols)
        case {"float": value}:
            return f"the value {value}"
        case {"sym": name}:
            allowed = ", ".join(symbols) or "no symbol (numbers)"
            return None if name in symbols else f"the symbol {name} where only {allowed} may appear"
        case {"call": [_, *args]}:
            inside = next((arg for arg in args if isinstance(arg, list) or is_blank(arg)), None)
            return alien(args, symbols) if inside is None else f"{describe(inside)} inside an expression"
    return describe(node)
