"""Whose file it is, by the names that learning platforms write into their downloads.

Moodle (``mod/assign/classes/downloader.php``) writes ``<name>_<number>_assignsubmission_<plugin>`` as a folder or in
front of the file's name. In the name ``_`` has become a blank, and ``& < > " ' ` | : \\ /`` are gone; the number is the
participant's in this assignment. Moodles before 4 write ``<group>-`` before the name where groups are separate. Canvas (``lib/content_zipper.rb``) writes ``<name>[_LATE]_<user>_<file>_`` in front of
the file's name, the name in lower case, of word characters only, family name first; without names ``anon_<code>``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

Platform = Literal["moodle", "canvas", "plain"]

_MOODLE = re.compile(r"(?P<name>.+?)(?:_(?P<number>\d+))?_assignsubmission_(?P<plugin>[a-z]+)(?:_(?P<rest>.*))?")
_CANVAS = re.compile(r"(?P<name>\w+?)(?P<late>_(?i:late))?_(?P<number>\d+)_(?:(?P<file>\d+)_.+|text\.html|link\.html)")
_ANONYMOUS = re.compile(r"(?P<late>LATE_)?(?P<number>anon_[0-9A-Za-z]+)_(?:(?P<file>\d+)_.+|text\.html|link\.html)")
# What Moodle calls everybody in blind marking, in some of its languages.
_NOBODY = {"participant", "teilnehmerin", "participante", "partecipante", "deelnemer", "deltagare", "osallistuja"}
_COPY = re.compile(r"(?:\((\d+)\)|-(\d+))(?=\.[^.]*\Z|\Z)")


@dataclass(frozen=True)
class Sender:
    """Who handed a file in, as the platform says.

    Attributes
    ----------
    platform : str
        ``"moodle"``, ``"canvas"`` or ``"plain"``.
    name : str
        As the platform writes it; empty where it hides the name.
    number : str
        The platform's number; empty where there is none.
    prefix : str
        What the platform puts before the names of this person's files, and finds the person by when files come back.
    late : bool
        Whether the platform marks it as late.
    upload : int
        Canvas's number of the uploaded file, which grows with time.
    """

    platform: Platform
    name: str
    number: str = ""
    prefix: str = ""
    late: bool = False
    upload: int = 0

    @property
    def key(self) -> tuple[str, str, str]:
        """The same for all files of one person in one assignment."""
        return (self.platform, self.number, "" if self.number else self.name)


def sender(parts: Sequence[str]) -> tuple[Sender, int] | None:
    """Who handed in a file, and which part of its path in the platform's own archive says so; None if none does.

    The first part that fits is the platform's, and in it what stands first: whatever comes behind was named by those
    who hand in, who may write anybody's name there.
    """
    for place, part in enumerate(parts):
        if found := _moodle(part) or _canvas(part):
            return found, place
    return None


def attempt(name: str) -> int:
    """The number that a platform or a browser wrote behind a file's name: 1 of ``scara (1).ipynb``."""
    found = _COPY.search(name)
    return int((found[1] or found[2])[:9]) if found else 0


def without_attempt(name: str) -> str:
    """A file's name without that number."""
    return _COPY.sub("", name)


def _moodle(part: str) -> Sender | None:
    found, other = _MOODLE.fullmatch(part), _CANVAS.fullmatch(part)
    if found is None or (other is not None and other.start("number") < found.end("name")):
        return None
    prefix = part if found["rest"] is None else part[: found.start("rest")].rstrip("_")
    hidden = re.sub(r"[\W\d]", "", found["name"].rpartition("-")[2]).casefold() in _NOBODY
    name = "" if hidden else found["name"]
    return Sender("moodle", name, found["number"] or "", prefix)


def _canvas(part: str) -> Sender | None:
    found = _ANONYMOUS.fullmatch(part) or _CANVAS.fullmatch(part)
    if found is None:
        return None
    name = found.groupdict().get("name") or ""
    upload = int((found["file"] or "0")[:18])
    return Sender("canvas", name, found["number"], part[: found.end("number")], bool(found["late"]), upload)
