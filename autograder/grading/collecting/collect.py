"""Collects an exercise from what learning platforms give, and says of everybody what became of it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path, PurePath
from tempfile import TemporaryDirectory

import msgspec
import nbformat

from dhkit.variants import normal_form

from ..course import Course
from ..errors import CourseError
from ..files import digest, digest_of, write_whole
from ..folders import released_path, why_unusable
from ..inert import terminal_text
from ..roster import Person, Roster, read_roster
from ..term import read_term
from ..worksheets import people_of_numbers
from .archives import EMPTY, Packed, is_left_out, unpack
from .platforms import Sender, attempt, sender
from .receipts import Receipt, read_receipts, receipts_folder, write_receipts
from .recognise import Found, Released, recognise

# A download that was written within this time tells when it was written, not when its files were handed in.
_ONE_DOWNLOAD = timedelta(hours=1)
_NAMES_SHOWN = 4
# In bytes: a folder's name has 255 at most, and the gradebook's ids 128 letters.
_LONGEST_ID = 100
_Key = tuple[str, str, str]
_NOT_NAMES = {"exercises", "submitted", "submissions", "course", "solutions", "src"}


@dataclass(frozen=True)
class Row:
    """What became of one person's work.

    Attributes
    ----------
    status : str
        ``"collected"``, ``"replaced"``, ``"unchanged"``, ``"kept"``; ``"wrong exercise"``, ``"no notebook"``,
        ``"unreadable"``; ``"missing"``, ``"exempt"``; ``"nobody's"`` for files without an owner.
    file : str
        Which file it is about, by its path in the download.
    """

    student: str
    status: str
    file: str = ""
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Piece:
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
        return _rank(self.moment, attempt(self.packed.name), self.sender.upload, answered)

    @property
    def newest_last(self) -> tuple:
        *rank, answered = self.rank
        return (*rank, self.packed.times[-1], answered, self.packed.path)

    @property
    def shown(self) -> str:
        return terminal_text("/".join(self.packed.path[1:] or self.packed.path), 120)


def collect(
    course: Course, exercise: str, downloads: Sequence[Path], worksheets: Sequence[Path] = (), force: bool = False
) -> list[Row]:
    """Put what was handed in for `exercise` into ``submitted/``.

    Parameters
    ----------
    downloads : sequence of Path
        Zips or unpacked folders of Moodle, Canvas or of no platform at all.
    worksheets : sequence of Path
        Moodle's grading worksheets of the assignment, which say whose numbers its downloads hold.
    force : bool
        Also replace files that were put into ``submitted/`` by hand.

    Returns
    -------
    list of Row
        One for everybody in the downloads and on the roster, by name.
    """
    course.require(exercise)
    for path in downloads:
        if not path.exists():
            raise CourseError(f"there is no {path}")
    released = _released(course)
    if exercise not in {one.exercise for one in released}:
        raise CourseError(f"{exercise} is not released; run: autograder release {exercise}")
    roster = read_roster(course.root)
    people = people_of_numbers(worksheets, roster)
    folder = receipts_folder(course.root, exercise)
    receipts = read_receipts(folder)
    with TemporaryDirectory() as kept:
        pieces = [piece for path in downloads for piece in _pieces(path, released, roster, Path(kept))]
        strays = [piece for piece in pieces if not piece.sender.key[1] and not piece.sender.name]
        groups: dict[_Key, list[_Piece]] = {}
        for piece in pieces:
            if piece not in strays:
                groups.setdefault(piece.sender.key, []).append(piece)
        for key, group in groups.items():
            if (said := people.get(key[1])) and key[0] == "moodle" and said[1]:
                groups[key] = [replace(piece, handed_in=said[1]) for piece in group]
        owners = _owners(groups, roster, receipts, {number: person for number, (person, _) in people.items()})
        rows = []
        for student, (keys, remarks) in owners.items():
            mine = [piece for key in keys for piece in groups[key]]
            for other in [name for name, one in receipts.items() if name != student and _is_of(one, keys)]:
                del receipts[other]
                remarks = (
                    *remarks,
                    f"was collected as {other} before; what is in submitted/{other} is the same person's",
                )
            row, receipt = _settle(course, exercise, student, mine, receipts.get(student), force)
            receipts[student] = receipt
            rows.append(replace(row, remarks=(*row.remarks, *remarks)))
    write_receipts(folder, receipts)
    rows += [
        Row("?", "nobody's", piece.shown, _troubles([piece]))
        for piece in strays
        if not is_left_out(piece.packed.path[1:])
    ]
    rows += _absent(course, exercise, roster, receipts)
    return sorted(rows, key=lambda row: (row.student.casefold(), row.student, row.file))


def _is_of(receipt: Receipt, keys: Sequence[_Key]) -> bool:
    """Whether it is for one of the platform's persons by these keys."""
    return bool(receipt.number) and any((receipt.platform, receipt.number) == key[:2] for key in keys)


def _released(course: Course) -> list[Released]:
    found = []
    for exercise in course.exercises():
        path = released_path(course.app.coursedir, exercise, exercise)
        if path.is_file():
            found.append(Released.of(exercise, nbformat.read(path, as_version=4)))
    return found


def _pieces(download: Path, released: Sequence[Released], roster: Roster, kept: Path) -> list[_Piece]:
    """The files of one download, each with its sender."""
    files = []
    for packed in unpack(download):
        what = recognise(packed.name, packed.content, released) if packed.content is not None else None
        copy = kept / digest(what.content) if what else None
        if what and copy:
            copy.write_bytes(what.content)
            what = replace(what, content=b"")
        files.append((replace(packed, content=None), what, copy))
    names = {one.exercise for one in released} | _NOT_NAMES
    level = _platform_level([packed for packed, *_ in files])
    found = []
    for packed, what, copy in files:
        if level is not None:
            whose, place = sender(packed.level(level)) or (Sender("plain", ""), 0)
            part = min(packed.starts[min(level, len(packed.starts) - 1)] + place, len(packed.path) - 1)
        elif packed.name == EMPTY or is_left_out(packed.path[1:]):
            continue
        else:
            whose, part = _plain(packed, what, names, roster), min(1, len(packed.path) - 1)
        found.append(_Piece(packed, whose, what, copy, copy.name if copy else "", packed.written(part)))
    times = [piece.written for piece in found]
    if not times:
        return []
    tells = level is not None and max(times) - min(times) > _ONE_DOWNLOAD
    return [replace(piece, downloaded=max(times), handed_in=piece.written if tells else None) for piece in found]


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


def _plain(packed: Packed, what: Found | None, not_names: set[str], roster: Roster) -> Sender:
    """Whose file it is where no platform says so: by a folder's or an archive's name, the roster's names first."""
    *folders, name = packed.path
    stems = [re.sub(r"\.zip\Z", "", part, flags=re.IGNORECASE) for part in folders]
    own = packed.starts[1] if len(packed.starts) > 1 else len(packed.path)
    outside = (*stems[1:own], *([PurePath(name).stem] if own == len(packed.path) else []), *stems[:1])
    on_roster = next((part for part in outside if roster.named(part)), None)
    if on_roster is None and what and what.typed and roster.named(what.typed):
        on_roster = what.typed
    if on_roster is None and packed.trouble and len(packed.path) == 1:
        return Sender("plain", "")
    inside = [part for part in stems[1:own] if part.lower() not in not_names and part != stems[0]]
    return Sender("plain", on_roster or (inside or stems or [PurePath(name).stem])[0])


@dataclass(frozen=True)
class _Owner:
    """Who one person of a platform is in the course, with what is to be said about it."""

    student: str
    remarks: tuple[str, ...] = ()
    sure: bool = False
    """Whether a number says so, not only a name."""


def _owners(
    groups: Mapping[_Key, list[_Piece]], roster: Roster, receipts: Mapping[str, Receipt], people: Mapping[str, Person]
) -> dict[str, tuple[list[_Key], tuple[str, ...]]]:
    """The ids of those who handed in, with the keys of their files and what is to be said about it."""
    known: dict[tuple[str, str], str] = {
        (one.platform, one.number): student for student, one in receipts.items() if one.number
    }
    found = {key: _owner(_first(group), roster, people) for key, group in groups.items()}
    unsure = [key for key, owner in found.items() if owner is None or _is_taken(key, owner, found)]
    claims = {key: _claimed(groups[key], roster) for key in unsure}
    owners: dict[str, tuple[list[_Key], tuple[str, ...]]] = {}
    for key, owner in found.items():
        if owner is not None and key not in unsure:
            keys, said = owners.get(owner.student, ([], ()))
            owners[owner.student] = ([*keys, key], tuple(dict.fromkeys((*said, *owner.remarks))))
    for key in unsure:
        whose, claim, before = _first(groups[key]), claims[key], known.get(key[:2])
        if claim and claim not in owners and list(claims.values()).count(claim) == 1:
            owners[claim] = ([key], ("the platform does not say who it is; taken for the id typed in the notebook",))
        elif before and before not in owners:
            owners[before] = ([key], ())
        else:
            student = f"{_as_id(whose) if whose.name else 'Participant'} {whose.number}".strip()
            why = "several have this name" if whose.name else "the platform hides the name"
            owners[student] = (
                [key],
                (f"{why}; the grading worksheet with names, given beside the zip, tells who it is",),
            )
    return owners


def _owner(whose: Sender, roster: Roster, people: Mapping[str, Person]) -> _Owner | None:
    """Who that is, by the platform's number or by a name that only one person has; None if neither tells."""
    person = people.get(whose.number) if whose.platform == "moodle" else roster.with_canvas_id(whose.number)
    if person is not None:
        return _Owner(person.id, sure=True)
    on_roster = roster.named(whose.name)
    if len(on_roster) > 1 or not whose.name:
        return None
    if on_roster:
        return _Owner(on_roster[0].id)
    members = [member.id for member in roster.of_group(whose.name)]
    if members:
        return _Owner(_as_id(whose), (f"a group: {', '.join(members)}",))
    return _Owner(_as_id(whose), ("not on the roster",) if roster.people else ())


def _is_taken(key: _Key, owner: _Owner, found: Mapping[_Key, _Owner | None]) -> bool:
    """Whether somebody else on the same platform is the same for the course, so that a name does not tell."""
    return not owner.sure and any(
        other != key
        and other[0] == key[0]
        and one is not None
        and normal_form(one.student) == normal_form(owner.student)
        for other, one in found.items()
    )


def _first(group: Sequence[_Piece]) -> Sender:
    return group[0].sender


def _claimed(group: Sequence[_Piece], roster: Roster) -> str | None:
    """The student of the roster whose id was typed into the newest notebook, if that fits the platform's name."""
    on_roster = roster.named(_first(group).name)
    typed = [piece.found.typed for piece in sorted(group, key=lambda piece: piece.newest_last) if piece.found]
    found = roster.named(typed[-1]) if typed and typed[-1] else []
    return found[0].id if len(found) == 1 and (not on_roster or found[0] in on_roster) else None


def _as_id(whose: Sender) -> str:
    """The platform's name as the name of a folder."""
    name = re.sub(r"[<>\"&/\\]", "", terminal_text(whose.name)).strip(" .\u00a0")
    while len(name.encode()) > _LONGEST_ID:
        name = name[:-1]
    return name if name and why_unusable(name) is None else f"{whose.platform} {whose.number}".strip()


def _settle(
    course: Course, exercise: str, student: str, pieces: Sequence[_Piece], before: Receipt | None, force: bool
) -> tuple[Row, Receipt]:
    """Put the newest right notebook of a student in place, or say why there is none."""
    ordered = sorted(pieces, key=lambda piece: piece.newest_last)
    right = [piece for piece in ordered if piece.found and piece.found.exercise == exercise and not piece.found.trouble]
    broken = [piece for piece in ordered if piece.found and piece.found.trouble and _may_be(piece, exercise)]
    troubles = _troubles(ordered)
    late = ("marked late",) if any(piece.sender.late for piece in ordered) else ()
    chosen = (right or broken)[-1] if right or broken else None
    receipt = _receipt(chosen or ordered[-1], ordered, late)
    if chosen is None:
        status, why = _without(ordered, exercise)
        said = (*why, *troubles, *late)
        if before is not None and before.digest:
            return Row(student, "kept", before.file, (f"{status} this time", *said)), before
        return Row(student, status, ordered[-1].shown, said), msgspec.structs.replace(
            receipt, missing=f"{status}: {'; '.join(said)}"
        )
    others = {piece.digest for piece in right if piece.digest != chosen.digest}
    remarks = (*(chosen.found.remarks if chosen.found else ()), *troubles, *late)
    if others:
        remarks = (f"the newest of {len(others) + 1}", *remarks)
    if not right and chosen.found:
        remarks = (f"unreadable: {chosen.found.trouble}", *remarks)
    status, more = _place(course, exercise, student, chosen, before, force)
    if status == "kept" and before is not None:
        return Row(student, status, before.file, (*more, *remarks)), before
    if not right and status != "kept":
        status = "unreadable"
    return Row(student, status, chosen.shown, (*more, *remarks)), receipt


def _troubles(pieces: Iterable[_Piece]) -> tuple[str, ...]:
    found = [piece.packed for piece in pieces if piece.packed.trouble]
    said = list(dict.fromkeys(f"{terminal_text(packed.name, 80)}: {packed.trouble}" for packed in found))
    return (
        *said[:_NAMES_SHOWN],
        *([f"and {len(said) - _NAMES_SHOWN} more of this kind"] if len(said) > _NAMES_SHOWN else ()),
    )


def _may_be(piece: _Piece, exercise: str) -> bool:
    """Whether a file that cannot be read was meant as the notebook of this exercise."""
    return (
        piece.found is not None and piece.found.exercise in (None, exercise) and ".ipynb" in piece.packed.name.lower()
    )


def _receipt(piece: _Piece, pieces: Sequence[_Piece], late: Sequence[str]) -> Receipt:
    whose = piece.sender
    return Receipt(
        platform=whose.platform,
        number=whose.number,
        prefix=whose.prefix,
        name=whose.name,
        late=bool(late),
        handed_in=piece.handed_in,
        downloaded=piece.downloaded,
        file=piece.shown,
        digest=piece.digest,
        attempt=attempt(piece.packed.name),
        upload=whose.upload,
        answered=piece.found.answered if piece.found else 0,
    )


def _without(pieces: Sequence[_Piece], exercise: str) -> tuple[str, tuple[str, ...]]:
    """Why there is no notebook of the exercise among the files, and which files there are."""
    others = sorted({piece.found.exercise for piece in pieces if piece.found and piece.found.exercise} - {exercise})
    if others:
        return "wrong exercise", (f"it is {' and '.join(others)}",)
    if all(piece.packed.trouble for piece in pieces):
        return "unreadable", ()
    if any(piece.found and not piece.found.trouble for piece in pieces):
        return "no notebook", ("a notebook, but none of this course's", *_why(pieces))
    return "no notebook", _why(pieces)


def _why(pieces: Iterable[_Piece]) -> tuple[str, ...]:
    names = list(dict.fromkeys(terminal_text(piece.packed.name, 60) for piece in pieces if not piece.packed.trouble))
    more = f" and {len(names) - _NAMES_SHOWN} more" if len(names) > _NAMES_SHOWN else ""
    return (f"handed in: {', '.join(names[:_NAMES_SHOWN])}{more}",) if names else ()


def _place(
    course: Course, exercise: str, student: str, piece: _Piece, before: Receipt | None, force: bool
) -> tuple[str, tuple[str, ...]]:
    """Put a notebook into ``submitted/``, unless what is there is newer or a lecturer's own."""
    assert piece.kept is not None
    folder = course.step("submitted", student, exercise)
    path = folder / f"{exercise}.ipynb"
    there = digest_of(path)
    status = "collected"
    remarks: tuple[str, ...] = ()
    if there == piece.digest:
        status = "unchanged"
    elif there is not None and not force:
        if before is None or before.digest != there:
            return "kept", ("a file that was put there by hand stays; --force takes the platform's",)
        moment = before.handed_in or before.downloaded or datetime.min
        if _rank(moment, before.attempt, before.upload, before.answered) > piece.rank:
            return "kept", ("what was collected before is newer",)
        status, remarks = "replaced", ("newer than what was collected before",)
    elif there is not None:
        status = "replaced"
    folder.mkdir(parents=True, exist_ok=True)
    if status != "unchanged":
        write_whole(path, piece.kept.read_bytes())
    stamp = folder / "timestamp.txt"
    if piece.handed_in is not None:
        text = f"{read_term(course.root).utc(piece.handed_in):%Y-%m-%d %H:%M:%S} UTC\n".encode()
        if not stamp.is_file() or stamp.read_bytes() != text:
            write_whole(stamp, text)
    elif status == "replaced":
        stamp.unlink(missing_ok=True)
    return status, remarks


def _rank(moment: datetime, attempt: int, upload: int, answered: int) -> tuple:
    return (answered > 0, moment, attempt, upload, answered)


def _absent(course: Course, exercise: str, roster: Roster, receipts: Mapping[str, Receipt]) -> list[Row]:
    """Those on the roster of whom there is nothing."""
    in_groups = {member.id for one in receipts.values() for member in roster.of_group(one.name)}
    there = receipts.keys() | set(course.students(exercise)) | in_groups
    return [
        Row(person.id, "exempt" if exercise in person.exempt else "missing")
        for person in roster.people
        if person.id not in there
    ]
