"""Collects an exercise from what learning platforms give, and says of everybody what became of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec
import nbformat

from ..course import Course
from ..errors import CourseError
from ..files import digest_of, write_whole
from ..folders import released_path
from ..inert import terminal_text
from ..roster import Roster, read_roster
from ..term import read_term
from ..worksheets import people_of_numbers
from .archives import EMPTY, is_left_out
from .downloads import Piece, pieces, rank
from .owners import Key, owners
from .platforms import attempt
from .receipts import Receipt, read_receipts, receipts_folder, write_receipts
from .recognise import Released

_NAMES_SHOWN = 4


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
        of_download = {path: pieces(path, released, roster, Path(kept)) for path in downloads}
        found = [piece for some in of_download.values() for piece in some]
        groups: dict[Key, list[Piece]] = {}
        for piece in found:
            if piece.has_owner:
                groups.setdefault(piece.sender.key, []).append(piece)
        for key, group in groups.items():
            if (said := people.get(key[1])) and key[0] == "moodle" and said[1]:
                groups[key] = [replace(piece, handed_in=said[1]) for piece in group]
        persons = {number: person for number, (person, _) in people.items()}
        rows = []
        for student, (keys, remarks) in owners(groups, roster, receipts, persons).items():
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
        Row("?", "nobody's", piece.shown, (*_troubles([piece]), *_lost(piece)))
        for piece in found
        if not piece.has_owner and piece.packed.name != EMPTY and not is_left_out(piece.packed.path[1:])
    ]
    rows += [
        Row("?", "nobody's", path.name, ("there is nothing in it",)) for path, some in of_download.items() if not some
    ]
    rows += _absent(course, exercise, roster, receipts)
    return sorted(rows, key=lambda row: (row.student.casefold(), row.student, row.file))


def without_time(course: Course, exercise: str) -> int:
    """Of how many it is not known when they handed in, where there is a due date."""
    if exercise not in read_term(course.root).due:
        return 0
    receipts = read_receipts(receipts_folder(course.root, exercise))
    return sum(bool(one.digest) and one.handed_in is None for one in receipts.values())


def _is_of(receipt: Receipt, keys: Sequence[Key]) -> bool:
    """Whether it is for one of the platform's persons by these keys."""
    return bool(receipt.number) and any((receipt.platform, receipt.number) == key[:2] for key in keys)


def _released(course: Course) -> list[Released]:
    found = []
    for exercise in course.exercises():
        path = released_path(course.app.coursedir, exercise, exercise)
        if path.is_file():
            found.append(Released.of(exercise, nbformat.read(path, as_version=4)))
    return found


def _settle(
    course: Course, exercise: str, student: str, pieces: Sequence[Piece], before: Receipt | None, force: bool
) -> tuple[Row, Receipt]:
    """Put the newest right notebook of a student in place, or say why there is none."""
    ordered = sorted(pieces, key=lambda piece: piece.newest_last)
    right = [piece for piece in ordered if piece.found and piece.found.exercise == exercise and not piece.found.trouble]
    broken = [piece for piece in ordered if piece.found and piece.found.trouble and _may_be(piece, exercise)]
    troubles = _troubles(ordered)
    late = ("marked late",) if any(piece.sender.late for piece in ordered) else ()
    if not right and before is not None and before.answered:
        broken = []  # better what was collected before
    chosen = (right or broken)[-1] if right or broken else None
    receipt = _receipt(chosen or ordered[-1], late)
    if chosen is None:
        status, why = _without(ordered, exercise)
        said = (*why, *troubles, *late)
        if before is not None and before.digest:
            return Row(student, "kept", before.file, (f"{status} this time", *said)), before
        return Row(student, status, ordered[-1].shown, said), msgspec.structs.replace(
            receipt, digest="", answered=0, missing=f"{status}: {'; '.join(said)}"
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


def _troubles(pieces: Iterable[Piece]) -> tuple[str, ...]:
    found = [piece.packed for piece in pieces if piece.packed.trouble]
    said = list(dict.fromkeys(f"{terminal_text(packed.name, 80)}: {packed.trouble}" for packed in found))
    return (
        *said[:_NAMES_SHOWN],
        *([f"and {len(said) - _NAMES_SHOWN} more of this kind"] if len(said) > _NAMES_SHOWN else ()),
    )


def _lost(piece: Piece) -> tuple[str, ...]:
    found = piece.found.exercise if piece.found else None
    return (f"a notebook of {found}, but neither its name nor a folder says whose",) if found else ()


def _may_be(piece: Piece, exercise: str) -> bool:
    """Whether a file that cannot be read was meant as the notebook of this exercise."""
    return (
        piece.found is not None and piece.found.exercise in (None, exercise) and ".ipynb" in piece.packed.name.lower()
    )


def _receipt(piece: Piece, late: Sequence[str]) -> Receipt:
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


def _without(pieces: Sequence[Piece], exercise: str) -> tuple[str, tuple[str, ...]]:
    """Why there is no notebook of the exercise among the files, and which files there are."""
    others = sorted({piece.found.exercise for piece in pieces if piece.found and piece.found.exercise} - {exercise})
    if others:
        return "wrong exercise", (f"it is {' and '.join(others)}",)
    if any(piece.found and piece.found.trouble and _may_be(piece, exercise) for piece in pieces) or all(
        piece.packed.trouble for piece in pieces
    ):
        return "unreadable", ()
    if any(piece.found and not piece.found.trouble for piece in pieces):
        return "no notebook", ("a notebook, but none of this course's", *_why(pieces))
    return "no notebook", _why(pieces)


def _why(pieces: Iterable[Piece]) -> tuple[str, ...]:
    names = list(dict.fromkeys(terminal_text(piece.packed.name, 60) for piece in pieces if not piece.packed.trouble))
    more = f" and {len(names) - _NAMES_SHOWN} more" if len(names) > _NAMES_SHOWN else ""
    return (f"handed in: {', '.join(names[:_NAMES_SHOWN])}{more}",) if names else ()


def _place(
    course: Course, exercise: str, student: str, piece: Piece, before: Receipt | None, force: bool
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
        if rank(moment, before.attempt, before.upload, before.answered) > piece.rank:
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


def _absent(course: Course, exercise: str, roster: Roster, receipts: Mapping[str, Receipt]) -> list[Row]:
    """Those on the roster of whom there is nothing."""
    in_groups = {member.id for one in receipts.values() for member in roster.of_group(one.name)}
    there = receipts.keys() | set(course.students(exercise)) | in_groups
    return [
        Row(person.id, "exempt" if exercise in person.exempt else "missing")
        for person in roster.people
        if person.id not in there
    ]
