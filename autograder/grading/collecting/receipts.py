"""What was collected from whom, with what the platform said: ``downloaded/<exercise>/collected.json``.

`autograder return` sends grades and pages back by it, deadlines take its times, and collecting again compares with it.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from datetime import datetime
from pathlib import Path

import msgspec

from ..errors import CourseError
from ..files import write_whole
from ..roster import Roster
from .platforms import Platform

FILE = "collected.json"


class Receipt(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What one person handed in for one exercise.

    Attributes
    ----------
    platform, number, prefix : str
        How the platform knows the person in this assignment (see `platforms.Sender`).
    name : str
        As the platform writes it.
    late : bool
        Whether the platform marks it as late.
    handed_in : datetime or None
        When it was handed in, if the download says so.
    downloaded : datetime or None
        When the download was written, as its entries say.
    file : str
        Path of the notebook inside the download.
    digest : str
        SHA-256 of the notebook; empty if there is none.
    attempt, upload, answered : int
        Number of the attempt, Canvas's number of the upload, and how many answers there are.
    missing : str
        Why there is no notebook, in words; empty if there is one.
    remarks : tuple of str
        What else is worth knowing.
    """

    platform: Platform
    number: str = ""
    prefix: str = ""
    name: str = ""
    late: bool = False
    handed_in: datetime | None = None
    downloaded: datetime | None = None
    file: str = ""
    digest: str = ""
    attempt: int = 0
    upload: int = 0
    answered: int = 0
    missing: str = ""
    remarks: tuple[str, ...] = ()


def receipts_folder(root: Path, exercise: str) -> Path:
    """Where the receipts of an exercise lie."""
    return root / "downloaded" / exercise


def read_receipts(folder: Path) -> dict[str, Receipt]:
    """What was collected into the folder's exercise, by student's id."""
    path = folder / FILE
    if not path.exists():
        return {}
    try:
        return msgspec.json.decode(path.read_bytes(), type=dict[str, Receipt])
    except msgspec.MsgspecError as error:
        raise CourseError(f"{path} is damaged ({error}); move it away and collect again") from None


def write_receipts(folder: Path, receipts: Mapping[str, Receipt]) -> None:
    """Keep what was collected, as a whole."""
    folder.mkdir(parents=True, exist_ok=True)
    text = msgspec.json.format(msgspec.json.encode(dict(sorted(receipts.items()))), indent=1)
    write_whole(folder / FILE, text)


def teams(receipts: Mapping[str, Receipt], roster: Roster, alone: Container[str]) -> dict[str, str]:
    """The ids of groups that handed in together, by those of their members; who is among `alone` counts for himself."""
    members = {member.id: team for team, one in receipts.items() for member in roster.of_group(one.name)}
    return {member: team for member, team in members.items() if member not in alone}
