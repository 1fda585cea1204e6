"""The public half of every question: what is asked, in which form, with which hints.

The data lie in ``dhkit/questions/<exercise>.toml``, one table per question, and hold no answer. The table
``[variant]`` is no question: it says which numbers are the student's own (see `dhkit.variants`).
"""

from __future__ import annotations

import difflib
import tomllib
from dataclasses import dataclass, field
from functools import cache
from importlib import resources

KINDS = (
    "number",
    "expression",
    "vector",
    "direction",
    "matrix",
    "transform",
    "dh_table",
    "joint_solutions",
    "orientation",
    "point_cloud",
    "function",
    "choice",
)

VARIANT = "variant"

DH_COLUMNS = ("sigma", "a", "alpha", "d", "theta")


@dataclass(frozen=True)
class PublicQuestion:
    """What a student may know of a question.

    Attributes
    ----------
    id : str
        ``"<exercise>.<name>"``, for example ``"scara.T04"``.
    kind : str
        One of `KINDS`.
    expected : str
        The awaited form in words, used in messages.
    shape : tuple of int
        Shape of an array answer; empty where the kind has none.
    symbols : tuple of str
        Names of the symbols the answer may contain; empty for a numeric answer.
    joints : tuple of str
        Names and order of the joint variables (kinds ``dh_table`` and ``joint_solutions``).
    names : tuple of str
        Names of the entries of a vector or an orientation: the answer may then be a dictionary, too.
    axes, frames : str
        Kind ``orientation``: letters of the three axes in the order of the angles, for example ``"zyx"``, and whether
        they are axes of the ``"moving"`` or of the ``"fixed"`` frame.
    options : tuple of str
        Letters of a choice.
    returns : PublicQuestion or None
        Form of what a function returns (kind ``function``).
    public : tuple of dict
        Checks run in the student's own session.
    hints : tuple of str
        Hints, from the lightest to the strongest.
    minutes : int
        Expected time, in minutes, for a student who has followed the lecture.
    """

    id: str
    title: str
    kind: str
    expected: str
    units: str = ""
    shape: tuple[int, ...] = ()
    symbols: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    axes: str = ""
    frames: str = "moving"
    options: tuple[str, ...] = ()
    returns: PublicQuestion | None = None
    public: tuple[dict, ...] = field(default=(), repr=False)
    hints: tuple[str, ...] = field(default=(), repr=False)
    minutes: int = 0

    @property
    def exercise(self) -> str:
        return self.id.partition(".")[0]


def _question(id: str, table: dict) -> PublicQuestion:
    """One question from its TOML table; `ValueError` names what is wrong with the table."""
    table = dict(table)
    returns = table.pop("returns", None)
    known = PublicQuestion.__dataclass_fields__.keys() - {"id", "returns"}
    unknown = table.keys() - known
    if unknown:
        raise ValueError(f"question {id}: unknown field {sorted(unknown)}; known: {sorted(known)}")
    if table.get("kind") not in KINDS:
        raise ValueError(f"question {id}: kind {table.get('kind')!r} is none of {', '.join(KINDS)}")
    lists = {key: tuple(value) for key, value in table.items() if isinstance(value, list)}
    if returns is not None:
        returns = _question(f"{id}()", {"title": table["title"], "expected": table["expected"], **returns})
    return PublicQuestion(id=id, returns=returns, **{**table, **lists})


@cache
def _files() -> dict[str, dict]:
    """The tables of every exercise, by its name."""
    files = sorted(resources.files("dhkit.questions").iterdir(), key=lambda file: file.name)
    texts = {
        file.name.removesuffix(".toml"): file.read_text(encoding="utf-8")
        for file in files
        if file.name.endswith(".toml")
    }
    return {exercise: tomllib.loads(text) for exercise, text in texts.items()}


@cache
def questions() -> dict[str, PublicQuestion]:
    """All questions by id, in the order of their files."""
    return {
        f"{exercise}.{name}": _question(f"{exercise}.{name}", table)
        for exercise, tables in _files().items()
        for name, table in tables.items()
        if name != VARIANT
    }


def variant_ranges(exercise: str) -> dict[str, tuple]:
    """What differs from student to student in `exercise`: by name, ``(lowest, highest, step)`` or the texts to pick from.

    Raises ValueError if a range makes no sense; it names the entry.
    """
    ranges = {name: tuple(value) for name, value in _files().get(exercise, {}).get(VARIANT, {}).items()}
    for name, range_ in ranges.items():
        texts = bool(range_) and all(isinstance(value, str) for value in range_)
        if not texts and not (len(range_) == 3 and range_[0] < range_[1] and range_[2] > 0):
            raise ValueError(
                f"{exercise}.toml: {VARIANT}.{name} is neither [lowest, highest, step] nor a list of texts"
            )
    return ranges


def find(id: str) -> PublicQuestion:
    """The question called `id`; a `KeyError` names the nearest ones."""
    try:
        return questions()[id]
    except KeyError:
        near = difflib.get_close_matches(id, questions(), n=3) or list(questions())[:3]
        raise KeyError(f"there is no question {id!r}; did you mean {' or '.join(near)}?") from None
