"""Collects an exercise from what learning platforms give, and says of everybody what became of it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path, PurePath
from tempfile import TemporaryDirectory

import msgspec
import nbformat

from ..course import Course
from ..errors import CourseError
from ..files import digest, digest_of, write_whole
from ..folders import released_path, why_unusable
from ..inert import terminal_text
from ..roster import Person, Roster, read_roster
from ..term import read_term
from ..worksheets import people_of_numbers
from .archives import Packed, is_left_out, unpack
from .platforms import Sender, attempt, sender, upload
from .receipts import Receipt, read_receipts, receipts_folder, write_receipts
from .recognise import Found, Released, recognise

# A download that was written within this time tells when it was written, not when its files were handed in.
_ONE_DOWNLOAD = timedelta(hours=1)
_NAMES_SHOWN = 4
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
        return _rank(self.moment, attempt(self.packed.path), upload(self.packed.path), answered)

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
        groups: dict[tuple[str, str, str], list[_Piece]] = {}
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


def _released(course: Course) -> list[Released]:
    found = []
    for exercise in course.exercises():
        path = released_path(course.app.coursedir, exercise, exercise)
        if path.is_file():
            found.append(Released.of(exercise, nbformat.read(path, as_version=4)))
    return found


def _pieces(download: Path, released: Sequence[Released], roster: Roster, kept: Path) -> list[_Piece]:
    """The files of one download, each with its sender."""
    found: list[_Piece] = []
    senders = 0
    for packed in unpack(download):
        of_platform = sender(packed.path)
        senders += of_platform is not None
        whose, part = of_platform or (Sender("plain", ""), min(1, len(packed.path) - 1))
        what = recognise(packed.name, packed.content, released) if packed.content is not None else None
        stamp = digest(what.content) if what else ""
        copy = kept / stamp if what else None
        if what and copy:
            copy.write_bytes(what.content)
            what = replace(what, content=b"")
        written = packed.written(part)
        found.append(_Piece(replace(packed, content=None), whose, what, copy, stamp, written))
    if not senders:
        names = {one.exercise for one in released} | _NOT_NAMES
        theirs = [piece for piece in found if not is_left_out(piece.packed.path[1:])]
        found = [replace(piece, sender=_plain(piece, names, roster)) for piece in theirs]
    times = [piece.written for piece in found]
    if not times:
        return []
    tells = max(times) - min(times) > _ONE_DOWNLOAD
    return [
        replace(piece, downloaded=max(times), handed_in=piece.written if tells and senders else None) for piece in found
    ]


def _plain(piece: _Piece, not_names: set[str], roster: Roster) -> Sender:
    """Whose file it is where no platform says so: by a folder's or an archive's name, the roster's names first."""
    *folders, name = piece.packed.path
    stems = [re.sub(r"\.zip\Z", "", part, flags=re.IGNORECASE) for part in folders]
    on_roster = next((part for part in (*stems[1:], PurePath(name).stem, *stems[:1]) if roster.named(part)), None)
    typed = piece.found.typed if piece.found else None
    if on_roster is None and typed and roster.named(typed):
        on_roster = typed
    if on_roster is None and piece.packed.trouble and len(piece.packed.path) == 1:
        return piece.sender
    inside = [part for part in stems[1:] if part.lower() not in not_names and part != stems[0]]
    return Sender("plain", on_roster or (inside or stems or [PurePath(name).stem])[0])


def _owners(
    groups: Mapping[tuple[str, str, str], list[_Piece]],
    roster: Roster,
    receipts: Mapping[str, Receipt],
    people: Mapping[str, Person],
) -> dict[str, tuple[list[tuple[str, str, str]], tuple[str, ...]]]:
    """The ids of those who handed in, with the keys of their files and what is to be said about it."""
    known = {(one.platform, one.number): student for student, one in receipts.items() if one.number}
    same_name = Counter((key[0], _first(group).name) for key, group in groups.items())
    owners: dict[str, tuple[list[tuple[str, str, str]], tuple[str, ...]]] = {}
    unsure = []
    for key, group in groups.items():
        whose = _first(group)
        person = people.get(whose.number) if whose.platform == "moodle" else roster.with_canvas_id(whose.number)
        on_roster = roster.named(whose.name)
        if person is None and len(on_roster) == 1 and same_name[key[0], whose.name] == 1:
            person = on_roster[0]
        if person is None and (len(on_roster) > 1 or not whose.name or same_name[key[0], whose.name] > 1):
            unsure.append((key, group, on_roster))
            continue
        student = person.id if person else known.get((whose.platform, whose.number), _as_id(whose))
        remarks: tuple[str, ...] = ()
        if person is None and roster.people:
            members = [member.id for member in roster.of_group(whose.name)]
            remarks = (f"a group: {', '.join(members)}",) if members else ("not on the roster",)
        keys, said = owners.get(student, ([], ()))
        owners[student] = ([*keys, key], tuple(dict.fromkeys((*said, *remarks))))
    claims = {key: _claimed(group, on_roster, roster) for key, group, on_roster in unsure}
    for key, group, _ in unsure:
        whose, claim = _first(group), claims[key]
        before = known.get((whose.platform, whose.number))
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


def _first(group: Sequence[_Piece]) -> Sender:
    return group[0].sender


def _claimed(group: Sequence[_Piece], on_roster: Sequence[Person], roster: Roster) -> str | None:
    """The student of the roster whose id was typed into the newest notebook."""
    typed = [piece.found.typed for piece in sorted(group, key=lambda piece: piece.newest_last) if piece.found]
    found = roster.named(typed[-1]) if typed and typed[-1] else []
    return found[0].id if len(found) == 1 and (not on_roster or found[0] in on_roster) else None


def _as_id(whose: Sender) -> str:
    """The platform's name as the name of a folder."""
    name = re.sub(r"[<>\"&/\\\x00]", "", terminal_text(whose.name, 100)).lstrip(".").strip()
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
        attempt=attempt(piece.packed.path),
        upload=upload(piece.packed.path),
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
