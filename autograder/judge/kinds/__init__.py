"""The kinds of answer: how each is held while it is judged, and how two answers of a kind compare.

A kind is there because its module is. Its form is defined in the module of the same name in ``dhkit/forms/``; here
``vector.py`` holds two functions:

* ``read(form, value)`` makes of decoded values what the kind compares. The answer is known to be in the form asked for,
  and arranged: ``form.complaint`` had nothing to say.
* ``compare(form, student, other, setting)`` sets a student's answer against another one, the reference or a mistaken form
  of it, and returns a `Comparison`. Most kinds are made of entries with values at sample points: see `entries`.

A function is judged by what it returns, in the form of that.
"""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

from dhkit import forms
from dhkit.forms import Form

from ..decode import Decoded, Malformed, decode
from .base import Comparison, Kind, Setting
from .entries import Entries

PI_IS_EXACT = "Your decimals were read as multiples of `pi`: write `pi/2`, which is exact."

__all__ = ["KINDS", "Comparison", "Entries", "Kind", "Setting", "compare", "read"]


def _kind(name: str) -> Kind:
    module = import_module(f"{__name__}.{name}")
    return Kind(module.read, module.compare)


KINDS: dict[str, Kind] = {
    module.name: _kind(module.name) for module in iter_modules(__path__) if module.name in forms.KINDS
}


def read(form: Form, answer: Decoded) -> Any:
    """An answer as its kind holds it; `Malformed` where it is not in the form asked for, in the words of `check`."""
    complaint = form.complaint(answer.node)
    if complaint:
        raise Malformed(complaint)
    arranged = form.arranged(answer.node)
    value = answer.value if arranged == answer.node else decode(arranged).value
    return KINDS[form.kind].read(form, value)


def compare(form: Form, student: Any, other: Any, setting: Setting) -> Comparison:
    """A student's answer beside another one, both as `read` returns them; rounded constant angles are read as exact."""
    found = KINDS[form.kind].compare(form, student, other, setting)
    exact = student.meant() if isinstance(student, Entries) and not found.equal else None
    if exact is None:
        return found
    again = KINDS[form.kind].compare(form, exact, other, setting)
    if again.equal:
        return replace(again, aside=PI_IS_EXACT)
    return again if again.share >= found.share else found
