"""Is an encoded answer in the form that a question asks for? Says what was expected and what was found."""

from __future__ import annotations

from collections.abc import Sequence

from .public import DH_COLUMNS, PublicQuestion


def is_blank(node: object) -> bool:
    """True where nothing was attempted: ``...``, ``None``, or an array of nothing else."""
    if isinstance(node, list):
        return bool(node) and all(is_blank(item) for item in node)
    return isinstance(node, dict) and "blank" in node


def blanks(node: object) -> int:
    """Number of entries that are still ``...`` or ``None``."""
    if isinstance(node, list):
        return sum(map(blanks, node))
    return int(is_blank(node))


def complaint(question: PublicQuestion, node: object) -> str | None:
    """One sentence on what is wrong with the form of `node`, or None."""
    node = without_keys(question, node)
    found = _wrong_form(question, node)
    if found is None:
        found = _foreign_part(question, node)
    return found and f"expected {question.expected}, found {found}"


def describe(node: object) -> str:
    """What a node is, in words."""
    if isinstance(node, bool):
        return "a truth value"
    if isinstance(node, (int, float)):
        return "a number"
    if isinstance(node, str):
        return "a text"
    if isinstance(node, list):
        shape = array_shape(node)
        if shape is None:
            return "a list whose rows have different lengths"
        return "an empty list" if shape == (0,) else f"an array of shape {' x '.join(map(str, shape))}"
    kind = next(iter(node))
    if kind == "unknown":
        return f"an object of type {node[kind]}"
    if kind == "dict":
        keys = ", ".join(str(key)[:20] for key, _ in node[kind][:6])
        return f"a dictionary with the keys {keys}" if keys else "an empty dictionary"
    return {"function": "a function", "blank": "no answer"}.get(kind, "an expression")


def array_shape(node: object) -> tuple[int, ...] | None:
    """Shape of nested lists or tuples, () for a scalar, None if it is ragged."""
    if not isinstance(node, (list, tuple)):
        return ()
    shapes = {array_shape(item) for item in node}
    if not shapes:
        return (0,)
    if len(shapes) > 1 or None in shapes:
        return None
    return (len(node), *shapes.pop())


def in_order(node: object, names: Sequence[str]) -> object:
    """A dictionary with exactly the keys `names` as a list in their order; anything else as it is."""
    items = node.get("dict") if isinstance(node, dict) else None
    if not items or sorted(key for key, _ in items) != sorted(names):
        return node
    found = dict(items)
    return [found[name] for name in names]


def names_of(question: PublicQuestion) -> Sequence[str]:
    """The keys that a dictionary in the answer may have."""
    return {"dh_table": DH_COLUMNS, "joint_solutions": question.joints}.get(question.kind, question.names)


def without_keys(question: PublicQuestion, node: object) -> object:
    """`node` with dictionaries keyed by names of joints, columns or entries brought into the order asked for."""
    names = names_of(question)
    node = in_order(node, names)
    return [in_order(row, names) for row in node] if isinstance(node, list) else node


def _wrong_form(question: PublicQuestion, node: object) -> str | None:
    kind, shape = question.kind, array_shape(node)
    if kind == "function":
        fits = isinstance(node, dict) and "function" in node
    elif kind == "choice":
        fits = isinstance(node, str) and node.strip().upper() in question.options
        if isinstance(node, str) and not fits:
            return f"{node[:20]!r}, which is none of {', '.join(question.options)}"
    elif kind in ("number", "expression"):
        fits = shape == () and not isinstance(node, str)
    elif kind in ("vector", "direction", "orientation"):
        count = question.shape[0]
        fits = shape in ((count,), (count, 1), (1, count))
    elif kind == "joint_solutions":
        count = len(question.joints)
        fits = shape == (0,) or (shape is not None and shape[-1:] == (count,) and len(shape) in (1, 2))
    elif kind == "point_cloud":
        fits = shape is not None and len(shape) == 2 and shape[1:] == question.shape
    else:
        fits = shape == question.shape
    return None if fits else describe(node)


def _foreign_part(question: PublicQuestion, node: object) -> str | None:
    """A symbol or an object inside the answer which does not belong there."""
    if isinstance(node, list):
        return next(filter(None, (_foreign_part(question, item) for item in node)), None)
    if not isinstance(node, dict):
        return None
    kind, content = next(iter(node.items()))
    if kind == "sym" and content not in question.symbols:
        allowed = ", ".join(question.symbols) or "no symbol (numbers)"
        return f"the symbol {content} where only {allowed} may appear"
    if kind == "unknown":
        return f"an object of type {content}"
    if kind == "float":
        return f"the value {content}"
    if kind == "call":
        return next(filter(None, (_foreign_part(question, item) for item in content[1:])), None)
    return None
