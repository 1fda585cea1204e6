"""The kinds of answer: one module each, which says what a question of that kind may fix and what is in its form.

A kind is there because its module is: ``vector.py`` defines the kind ``"vector"``. Such a module holds one class derived
from `base.Fields`, `base.Symbolic` or another kind. The class has

* a field, with its type, for everything the table of a question may say about this kind; ``__post_init__`` raises a
  `ValueError` that begins with the field's name where the values do not fit together,
* ``misfit(node)``: what was found in place of the form asked for, in words, or None,
* ``arranged(node)``, if the same answer can be written in several ways (dictionaries, columns): the one way in which
  everybody after it reads it.

Nodes are those of `dhkit.wire`. ``check`` says "the form is right" exactly where ``complaint(node)`` is None, and the
grader calls an answer malformed exactly where it is not. How two answers of the kind compare is defined in the module
of the same name in ``autograder/judge/kinds/``.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from pkgutil import iter_modules

from ..schema import choose
from .base import Form

__all__ = ["KINDS", "Form", "from_table"]


def _defined_in(name: str) -> type[Form]:
    module = import_module(f"{__name__}.{name}")
    own = [thing for thing in vars(module).values() if getattr(thing, "__module__", "") == module.__name__]
    (form,) = (thing for thing in own if isinstance(thing, type) and issubclass(thing, Form))
    return form


KINDS: dict[str, type[Form]] = {
    module.name: _defined_in(module.name) for module in iter_modules(__path__) if module.name != "base"
}


def from_table(table: Mapping[str, object]) -> Form:
    """The form that a question's table describes; `ValueError` names the field that is wrong.

    Parameters
    ----------
    table : mapping
        ``kind``, one of `KINDS`, and the fields of that kind. For a function, ``returns`` is such a table again, and
        what it is expected to return is said by the function's own ``expected`` unless it says so itself.
    """
    returns = table.get("returns")
    if isinstance(returns, Mapping):
        try:
            inner = from_table({"expected": table.get("expected"), **returns})
        except ValueError as error:
            raise ValueError(f"returns.{error}") from None
        table = {**table, "returns": inner}
    return choose(table, "kind", KINDS)
