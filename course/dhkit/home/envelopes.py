"""The file of sealed verdicts beside an exercise: who has made an answer can read what the grader thinks of it.

An envelope holds the key of a text and the numbers of the answer it belongs to, so that the student's own can be
compared with them exactly. All envelopes of a question are of one length, and so are all texts: neither length nor order
tells what is inside.
"""

from __future__ import annotations

import hmac
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TypeVar

import msgspec
import numpy as np
from cryptography.exceptions import InvalidTag
from cryptography.hazmat.primitives.ciphers.aead import AESSIV

from ..forms.base import Sight
from ..public import TRY
from .cells import COST, TAG, Lock

T = TypeVar("T")

SUFFIX = ".sealed"
MOST_BYTES = 8 << 20
OF_LECTURES = Path(__file__).parents[1] / f"tries{SUFFIX}"

_HEAD = struct.Struct("<H32sH")


class SealedQuestion(msgspec.Struct, frozen=True, kw_only=True):
    """What a student's copy holds of one question.

    Attributes
    ----------
    points : float
        What the question is worth.
    why_not : str
        Why there is no verdict at home; empty where there is one.
    sight : Sight
    calls : list
        Argument lists for a function: one list for everybody, or one for each set of numbers.
    cases : list of str
        The case each argument list belongs to, as `calls`.
    personal : bool
        Whether the answer depends on the student's own numbers.
    shared : list of int
        Where not all of these numbers count: for each set of numbers, the place in the lists that belongs to it.
    length : int
        Bytes of an envelope.
    envelopes : list of bytes
        Envelopes, one after the other: for everybody, or for each set of numbers.
    texts : list of bytes
        What the envelopes lead to.
    """

    points: float = 0.0
    why_not: str = ""
    sight: Sight = Sight()
    calls: list[list[list]] = []
    cases: list[list[str]] = []
    personal: bool = False
    shared: list[int] = []
    length: int = 0
    envelopes: list[bytes] = []
    texts: list[bytes] = []

    def place(self, number_set: int) -> int:
        """Where in the lists what belongs to a set of numbers is."""
        return 0 if not self.personal else self.shared[number_set] if self.shared else number_set


class SealedExercise(msgspec.Struct, frozen=True, kw_only=True):
    """The whole file."""

    exercise: str
    salt: bytes
    cost: int = COST
    questions: dict[str, SealedQuestion] = {}

    def of(self, id: str) -> SealedQuestion | None:
        """What is held of the question called `id`."""
        return self.questions.get(id.partition(".")[2])


class Said(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What stands in an envelope.

    Attributes
    ----------
    state : str
        "right", "mistake" or "part".
    note : str
        The grader's key for a mistake; of a part, which one it is.
    share : float
    text : str
        Feedback as Markdown.
    solution : str
        The worked solution, for a right answer.
    left_out : str
        Cases of a function that cannot be tried at home.
    """

    state: str
    note: str = ""
    share: float = 0.0
    text: str = ""
    solution: str = ""
    left_out: str = ""


@dataclass(frozen=True, eq=False)
class Opened:
    """An envelope that was opened: what it says, and the numbers of the answer that it was sealed for."""

    said: Said
    numbers: np.ndarray


def lock_of(sealed: SealedExercise, question: str, part: str, personal: bool, place: int, tolerance: float) -> Lock:
    whose = place if personal else "all"
    return Lock(sealed.salt, f"{question}/{whose}/{part}", tolerance, sealed.cost)


def length_for(count: int) -> int:
    """Bytes of an envelope for answers of at most `count` numbers."""
    return TAG + 16 + _HEAD.size + 4 * count


def seal(tag: bytes, key: bytes, text: int, text_key: bytes, numbers: np.ndarray, length: int) -> bytes:
    """One envelope: it leads to the text of a number, with its key."""
    inside = _HEAD.pack(text, text_key, len(numbers)) + numbers.astype("<f4").tobytes()
    room = length - TAG - 16
    if len(inside) > room:
        raise ValueError(f"an envelope of {length} bytes is too small for {len(numbers)} numbers")
    return tag + AESSIV(key).encrypt(inside.ljust(room, b"\0"), None)


def seal_text(key: bytes, said: Said, size: int) -> bytes:
    return AESSIV(key).encrypt(msgspec.json.encode(said).ljust(size), None)


def open_envelopes(question: SealedQuestion, envelopes: bytes, lock: Lock, numbers: np.ndarray) -> Iterator[Opened]:
    """Every envelope that opens to an answer of these `numbers`."""
    size = question.length
    by_tag: dict[bytes, list[bytes]] = {}
    for start in range(0, len(envelopes), size):
        by_tag.setdefault(envelopes[start : start + TAG], []).append(envelopes[start + TAG : start + size])
    for cell in lock.cells(numbers):
        tag, key = lock.key(cell)
        for sealed in by_tag.get(tag, ()):
            try:
                inside = AESSIV(key).decrypt(sealed, None)
                text, text_key, count = _HEAD.unpack_from(inside)
                said = msgspec.json.decode(AESSIV(text_key).decrypt(question.texts[text], None), type=Said)
            except (InvalidTag, msgspec.DecodeError):
                continue
            yield Opened(said, np.frombuffer(inside, "<f4", count, _HEAD.size).astype(float))


def derived(secret: bytes, what: str) -> bytes:
    """A key that follows from a secret one, for one purpose."""
    return hmac.digest(secret, what.encode(), "sha256")


def find(exercise: str) -> SealedExercise | None:
    """The file of an exercise: beside the notebook, in ``exercises/`` below it or below a folder above; None if there is none.

    That of the lectures is part of the kit.
    """
    if exercise == TRY:
        return _kept(OF_LECTURES, OF_LECTURES.stat().st_mtime_ns) if OF_LECTURES.is_file() else None
    here = Path.cwd()
    name = f"{exercise}{SUFFIX}"
    places = [here / name, *(folder / "exercises" / exercise / name for folder in (here, *here.parents[:3]))]
    path = next((place for place in places if place.is_file()), None)
    return None if path is None else _kept(path, path.stat().st_mtime_ns)


@cache
def _kept(path: Path, changed: int) -> SealedExercise | None:
    return read(path)


def read(path: Path) -> SealedExercise | None:
    """The content of a file; None if there is none, or it cannot be read."""
    try:
        if path.stat().st_size > MOST_BYTES:
            return None
        return msgspec.msgpack.decode(path.read_bytes(), type=SealedExercise)
    except (OSError, msgspec.DecodeError):
        return None


def encoded(sealed: SealedExercise) -> bytes:
    return msgspec.msgpack.encode(sealed)
