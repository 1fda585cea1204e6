"""The public half of every question: what is asked, in which form, with which hints.

The data lie in ``dhkit/questions/<exercise>.toml``, one table per question, and hold no answer. The table
``[variant]`` is no question: it says which numbers are the student's own (see `dhkit.variants`). A table that does not
fit is refused with its file, its question and its field.

``dhkit/tries.toml`` holds what the lectures ask to try, by lecture: no points, nothing to hand in.
"""

from __future__ import annotations

import difflib
import math
import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from . import forms, public_checks
from .forms.base import Form, Text
from .public_checks import PublicCheck
from .schema import convert, unique

VARIANT = "variant"
TRY = "try"
"""In the place of an exercise: what a lecture asks to try, for example ``"try.scara.down"``."""


class Heading(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the table of a question says besides the form of the answer.

    Attributes
    ----------
    title : str
        What stands above every message.
    hints : tuple of str
        Hints, from the lightest to the strongest.
    minutes : int
        Expected time, in minutes, for a student who has followed the lecture.
    home : str
        "sealed": the student's own copy says whether an answer is right; "form": only whether its form is. What could
        be found by trying is never sealed.
    """

    title: Text
    hints: tuple[Text, ...] = ()
    minutes: Annotated[int, Meta(ge=0)] = 0
    home: Literal["sealed", "form"] = "sealed"


class PublicQuestion(Heading, frozen=True, kw_only=True):
    """What a student may know of a question.

    Attributes
    ----------
    id : str
        ``"<exercise>.<name>"``, for example ``"scara.T04"``.
    form : Form
        The form in which the answer is asked for.
    public : tuple of PublicCheck
        Checks run in the student's own session.
    """

    id: str
    form: Form
    public: tuple[PublicCheck, ...] = ()

    @property
    def exercise(self) -> str:
        return self.id.partition(".")[0]


def from_table(id: str, table: Mapping[str, object]) -> PublicQuestion:
    """One question from its table; `ValueError` names the field that is wrong."""
    heading = {key: value for key, value in table.items() if key in Heading.__struct_fields__}
    about_form = {key: value for key, value in table.items() if key not in heading and key != "public"}
    form = forms.from_table(about_form)
    checks = public_checks.from_tables(table.get("public", []), form)
    return PublicQuestion(id=id, form=form, public=checks, **msgspec.structs.asdict(convert(heading, Heading)))


@cache
def _files() -> dict[str, dict[str, object]]:
    """The tables of every exercise, by its name."""
    files = sorted(resources.files("dhkit.questions").iterdir(), key=lambda file: file.name)
    return {
        file.name.removesuffix(".toml"): _tables(file.name, file.read_text(encoding="utf-8"))
        for file in files
        if file.name.endswith(".toml")
    }


def _tables(file: str, text: str) -> dict[str, object]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"{file}: {error}") from None


@cache
def questions() -> dict[str, PublicQuestion]:
    """All questions by id, in the order of their files. `ValueError` names file, question and field that are wrong."""
    return {
        f"{exercise}.{name}": _question(f"{exercise}.toml", exercise, name, table)
        for exercise, tables in _files().items()
        for name, table in tables.items()
        if name != VARIANT
    }


def _question(file: str, exercise: str, name: str, table: object) -> PublicQuestion:
    try:
        if not name.isidentifier():
            raise ValueError("a name is made of letters, digits and underscores")
        if not isinstance(table, dict):
            raise ValueError(f"a question is a table, [{name}]")
        return from_table(f"{exercise}.{name}", table)
    except ValueError as error:
        raise ValueError(f"{file}: question {name}: {error}") from None


@cache
def tries() -> dict[str, PublicQuestion]:
    """What the lectures ask to try, by id. `ValueError` names question and field that are wrong."""
    file = "tries.toml"
    tables = _tables(file, resources.files("dhkit").joinpath(file).read_text(encoding="utf-8"))
    return {
        f"{TRY}.{lecture}.{name}": _question(file, f"{TRY}.{lecture}", name, table)
        for lecture, named in tables.items()
        for name, table in named.items()  # type: ignore[attr-defined]
    }


def variant_ranges(exercise: str) -> dict[str, tuple]:
    """What differs from student to student in `exercise`: by name, ``(lowest, highest, step)`` or the texts to pick from.

    Raises ValueError if a range makes no sense; it names the entry.
    """
    table = _files().get(exercise, {}).get(VARIANT, {})
    if not isinstance(table, dict):
        raise ValueError(f"{exercise}.toml: {VARIANT} is no table")
    return {name: _range(f"{exercise}.toml: {VARIANT}.{name}", value) for name, value in table.items()}


def _range(where: str, value: object) -> tuple:
    if not isinstance(value, list) or not value:
        raise ValueError(f"{where}: expected [lowest, highest, step] or a list of texts")
    if all(isinstance(text, str) for text in value):
        unique(where, value)
        return tuple(value)
    if len(value) != 3 or not all(type(number) in (int, float) and math.isfinite(number) for number in value):
        raise ValueError(f"{where}: expected three numbers [lowest, highest, step] or a list of texts")
    lowest, highest, step = value
    if not lowest < highest or not 0 < step <= highest - lowest + 1e-9:
        raise ValueError(f"{where}: {step} is no step from {lowest} to {highest}")
    steps = (highest - lowest) / step
    if abs(steps - round(steps)) > 1e-6:
        raise ValueError(f"{where}: steps of {step} from {lowest} do not end at {highest}")
    return tuple(value)


def find(id: str) -> PublicQuestion:
    """The question called `id`; a `KeyError` names the nearest ones."""
    known = tries() if id.startswith(f"{TRY}.") else questions()
    try:
        return known[id]
    except KeyError:
        near = difflib.get_close_matches(id, known, n=3) or list(known)[:3]
        raise KeyError(f"there is no question {id!r}; did you mean {' or '.join(near)}?") from None
