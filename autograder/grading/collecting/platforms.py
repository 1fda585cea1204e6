"""Whose file it is, by the names that learning platforms write into their downloads.

Moodle (``mod/assign/classes/downloader.php``) writes ``<name>_<number>_assignsubmission_<plugin>`` as a folder or in
front of the file's name. In the name ``_`` has become a blank, and ``& < > " ' ` | : \\ /`` are gone; the number is the
participant's in this assignment. Canvas (``lib/content_zipper.rb``) writes ``<name>[_LATE]_<user>_<file>_`` in front of
the file's name, the name in lower case, of word characters only, family name first; without names ``anon_<code>``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

Platform = Literal["moodle", "canvas", "plain"]

_MOODLE = re.compile(r"(?P<name>.+?)(?:_(?P<number>\d+))?_assignsubmission_(?P<plugin>[a-z]+)(?:_(?P<rest>.*))?")
_CANVAS = re.compile(r"(?P<name>\w+?)(?P<late>_LATE)?_(?P<number>\d+)_(?:(?P<file>\d+)_.+|text\.html|link\.html)")
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
    """

    platform: Platform
    name: str
    number: str = ""
    prefix: str = ""
    late: bool = False

    @property
    def key(self) -> tuple[str, str, str]:
        """The same for all files of one person in one assignment."""
        return (self.platform, self.number, "" if self.number else self.name)


def sender(path: tuple[str, ...]) -> tuple[Sender, int] | None:
    """Who handed in the file at `path` of a download, and which part of the path says so; None if no platform wrote one."""
    for place, part in enumerate(path):
        if found := _MOODLE.fullmatch(part):
            prefix = part[: found.start("rest")].rstrip("_") if found["rest"] is not None else part
            name = "" if _only_letters(found["name"]) in _NOBODY else found["name"]
            return Sender("moodle", name, found["number"] or "", prefix), place
    for place, part in enumerate(path):
        if found := _ANONYMOUS.fullmatch(part):
            return Sender("canvas", "", found["number"], part[: found.end("number")], bool(found["late"])), place
        if found := _CANVAS.fullmatch(part):
            return Sender(
                "canvas", found["name"], found["number"], part[: found.end("number")], bool(found["late"])
            ), place
    return None


def attempt(path: tuple[str, ...]) -> int:
    """Number of the attempt that a platform or a browser wrote behind a file's name: 1 of ``scara (1).ipynb``."""
    sent = next((part for part in path if _MOODLE.fullmatch(part) or _CANVAS.fullmatch(part)), "")
    found = _COPY.search(path[-1]) or _COPY.search(sent)
    return int((found[1] or found[2])[:9]) if found else 0


def upload(path: tuple[str, ...]) -> int:
    """Canvas's number of the uploaded file, which grows with time; 0 where there is none."""
    for part in path:
        found = _CANVAS.fullmatch(part) or _ANONYMOUS.fullmatch(part)
        if found and found["file"]:
            return int(found["file"][:18])
    return 0


def _only_letters(name: str) -> str:
    return re.sub(r"[\W\d]", "", name).casefold()
