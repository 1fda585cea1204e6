"""The files of a download, each with who handed it in, when, and what it turned out to be."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path, PurePath

from ..files import digest
from ..inert import terminal_text
from ..roster import Roster
from .archives import EMPTY, Packed, is_left_out, unpack
from .platforms import Sender, attempt, sender, without_attempt
from .recognise import Found, Released, recognise

# A download whose files were written one after the other tells when it was made, not when they were handed in: from
# the first to the last, and half of them, within such a time.
_ONE_DOWNLOAD, _HALF_OF_IT = timedelta(hours=1), timedelta(minutes=10)
# So many names that begin alike, up to a hyphen, begin with the name of a group.
_A_GROUP = 3
_NOT_NAMES = {"exercises", "submitted", "submissions", "course", "solutions", "src"}


@dataclass(frozen=True)
class Piece:
    """One file of a download, and what it turned out to be; `kept` is a copy of what may be a notebook."""

    packed: Packed
    sender: Sender
    found: Found | None
    kept: Path | None
    digest: str
    written: datetime
    """When the platform's entry was written."""
    downloaded: datetime | None = None
    handed_in: datetime | None = None

    @property
    def moment(self) -> datetime:
        return self.handed_in or self.downloaded or self.written

    @property
    def rank(self) -> tuple:
        """A notebook that nobody touched is never better than one with answers, however new it is."""
        answered = self.found.answered if self.found else 0
        return rank(self.moment, attempt(self.packed.name), self.sender.upload, answered)

    @property
    def newest_last(self) -> tuple:
        *rank, answered = self.rank
        return (*rank, self.packed.times[-1], answered, self.packed.path)

    @property
    def has_owner(self) -> bool:
        return bool(self.sender.number or self.sender.name)

    @property
    def shown(self) -> str:
        return terminal_text("/".join(self.packed.path[1:] or self.packed.path), 120)


def pieces(download: Path, released: Sequence[Released], roster: Roster, kept: Path) -> list[Piece]:
    """The files of one download, each with its sender."""
    files = []
    for packed in unpack(download):
        what = recognise(packed.name, packed.content, released) if packed.content is not None else None
        copy = kept / digest(what.content) if what else None
        if what and copy:
            copy.write_bytes(what.content)
            what = replace(what, content=b"")
        files.append((replace(packed, content=None), what, copy))
    level = _platform_level([packed for packed, *_ in files])
    exercises = {one.exercise for one in released}
    names = exercises | _NOT_NAMES | {_stem(download.name).lower()}
    theirs = [packed for packed, *_ in files if packed.name != EMPTY and not is_left_out(packed.path[1:])]
    names |= {part.lower() for part in _wrapping(theirs, names)}
    flat = _flat(files, names, exercises) if level is None else {}
    found = []
    for packed, what, copy in files:
        if level is not None:
            whose, place = sender(packed.level(level)) or (Sender("plain", ""), 0)
            part = min(packed.starts[min(level, len(packed.starts) - 1)] + place, len(packed.path) - 1)
        elif packed.name == EMPTY or is_left_out(packed.path[1:]):
            continue
        else:
            whose, part = _plain(packed, what, names, exercises, flat, roster), min(1, len(packed.path) - 1)
        found.append(Piece(packed, whose, what, copy, copy.name if copy else "", packed.written(part)))
    found = _without_group(found, roster)
    times = [piece.written for piece in found]
    if not times:
        return []
    tells = _tell([piece.written for piece in found if piece.sender.platform == "moodle"])
    return [replace(piece, downloaded=max(times), handed_in=piece.written if tells else None) for piece in found]


def _tell(times: Sequence[datetime]) -> bool:
    """Whether these are the times of handing in, as Moodle's older downloads bear them."""
    ordered = sorted(times)
    quarter = len(ordered) // 4
    return (
        len(ordered) > 1
        and ordered[-1] - ordered[0] > _ONE_DOWNLOAD
        and ordered[-1 - quarter] - ordered[quarter] > _HALF_OF_IT
    )


def _platform_level(files: Sequence[Packed]) -> int | None:
    """How deep in archives the platform's names stand: 0, or 1 where its archive was packed once more; None without any.

    Deeper down names are those that students gave. One archive in the download is the platform's only if all its files
    have senders, so that nobody's own zip in a plain download passes for one.
    """
    if any(sender(packed.level(0)) for packed in files if packed.starts):
        return 0
    inner = [packed for packed in files if len(packed.starts) > 1]
    alone = {packed.path[: packed.starts[1]] for packed in inner} if inner else set()
    others = [packed for packed in files if len(packed.starts) == 1 and not is_left_out(packed.path[1:])]
    if len(alone) >= 1 and not others and all(sender(packed.level(1)) for packed in inner):
        return 1
    return None


def _without_group(found: Sequence[Piece], roster: Roster) -> list[Piece]:
    """Without the name of a group that Moodle wrote before a name."""
    names = {piece.sender.name for piece in found if piece.sender.platform == "moodle" and piece.sender.name}
    common = _common_group(names, roster)
    alone = {name: name.removeprefix(common or _own_group(name, roster)) for name in names}
    return [
        replace(piece, sender=replace(piece.sender, name=alone[piece.sender.name]))
        if piece.sender.name in alone
        else piece
        for piece in found
    ]


def _common_group(names: Set[str], roster: Roster) -> str:
    """The group before every name: too often for chance, or the roster knows it, or those behind it."""
    first = min(names, default="")
    parts = [first[: hyphen.end()] for hyphen in re.finditer("-", first)]
    group = next((part for part in reversed(parts) if all(name.startswith(part) for name in names)), "")
    known = roster.of_group(group.rstrip("-")) or all(roster.named(name.removeprefix(group)) for name in names)
    return group if group and not any(map(roster.named, names)) and (len(names) >= _A_GROUP or known) else ""


def _own_group(name: str, roster: Roster) -> str:
    """The group before a name, where the roster knows its member by the rest."""
    for hyphen in () if roster.named(name) else re.finditer("-", name):
        members = roster.of_group(name[: hyphen.start()])
        if any(member in members for member in roster.named(name[hyphen.end() :])):
            return name[: hyphen.end()]
    return ""


def _flat(
    files: Sequence[tuple[Packed, Found | None, Path | None]], not_names: set[str], exercises: Iterable[str]
) -> dict[tuple[str, ...], str]:
    """Names in the files' own names, where notebooks of several people lie side by side in one folder."""
    loose = [(packed, what) for packed, what, _ in files if what and what.exercise and len(packed.starts) == 1]
    names = {packed.path: _besides(packed.name, exercises) for packed, _ in loose}
    typed = {what.typed for _, what in loose}
    if any(part.lower() not in not_names for packed, _ in loose for part in _folders(packed)) or len(loose) < 2:
        return {}
    one_each = all(names.values()) and len(set(names.values())) == len(loose)
    return names if one_each and (None in typed or len(typed) == len(loose)) else {}


def _besides(name: str, exercises: Iterable[str]) -> str:
    """What stands in a file's name besides the exercise, the ending and the number of a copy."""
    text = re.sub(r"[\W_]+", " ", PurePath(without_attempt(name)).stem)
    for exercise in sorted(exercises, key=len, reverse=True):
        text = re.sub(rf"(?<!\S){exercise.replace('_', ' ')}(?!\S)", " ", text, flags=re.IGNORECASE)
    return " ".join(text.split())


def _plain(
    packed: Packed,
    what: Found | None,
    not_names: set[str],
    exercises: Iterable[str],
    flat: Mapping[tuple[str, ...], str],
    roster: Roster,
) -> Sender:
    """Whose file it is where no platform says so: by a folder's or an archive's name, the roster's names first."""
    name = PurePath(packed.name).stem
    own = [name, _besides(packed.name, exercises)] if len(packed.starts) == 1 else []
    outside = (*_folders(packed), *own, _stem(packed.path[0]))
    on_roster = next((part for part in outside if roster.named(part)), None)
    if on_roster is None and what and what.typed and roster.named(what.typed):
        on_roster = what.typed
    if on_roster is None and packed.trouble and len(packed.path) == 1:
        return Sender("plain", "")
    if on_roster is None and packed.path in flat:
        return Sender("plain", flat[packed.path])
    inside = [part for part in _folders(packed) if part.lower() not in not_names]
    return Sender("plain", on_roster or (*inside, *([_stem(packed.path[0])] if len(packed.path) > 1 else []), name)[0])


def _folders(packed: Packed) -> list[str]:
    """The folders and the archive in a download that a file lies in, outermost first; not what stands in the archive."""
    own = packed.starts[1] if len(packed.starts) > 1 else len(packed.path) - 1
    return [_stem(part) for part in packed.path[1:own]]


def _stem(part: str) -> str:
    return re.sub(r"\.zip\Z", "", part, flags=re.IGNORECASE)


def _wrapping(files: Sequence[Packed], not_names: set[str]) -> set[str]:
    """Folders of a plain download that are nobody's: those around everything, where a name stands further in."""
    found = {packed.path: [part for part in _folders(packed) if part.lower() not in not_names] for packed in files}
    around = set()
    while (
        found and all(len(names) > 1 for names in found.values()) and len({names[0] for names in found.values()}) == 1
    ):
        around.add(next(iter(found.values()))[0])
        found = {path: names[1:] for path, names in found.items()}
    return around


def rank(moment: datetime, attempt: int, upload: int, answered: int) -> tuple:
    """What makes one notebook count more than another; one that nobody touched never does."""
    return (answered > 0, moment, attempt, upload, answered)
