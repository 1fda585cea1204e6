"""Who in the course handed in what: by the platform's numbers, by names that only one person has, by what was typed."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from dhkit.variants import normal_form

from ..folders import why_unusable
from ..inert import terminal_text
from ..roster import Person, Roster
from .downloads import Piece
from .platforms import Sender
from .receipts import Receipt

Key = tuple[str, str, str]
"""See `platforms.Sender.key`."""

# In bytes: a folder's name has 255 at most, and the gradebook's ids 128 letters.
_LONGEST_ID = 100


@dataclass(frozen=True)
class _Owner:
    """Who one person of a platform is in the course, with what is to be said about it."""

    student: str
    remarks: tuple[str, ...] = ()
    sure: bool = False
    """Whether a number says so, not only a name."""


def owners(
    groups: Mapping[Key, list[Piece]], roster: Roster, receipts: Mapping[str, Receipt], people: Mapping[str, Person]
) -> dict[str, tuple[list[Key], tuple[str, ...]]]:
    """The ids of those who handed in, with the keys of their files and what is to be said about it."""
    known: dict[tuple[str, str], str] = {
        (one.platform, one.number): student for student, one in receipts.items() if one.number
    }
    found = {key: _owner(_first(group), roster, people) for key, group in groups.items()}
    count = Counter((key[0], normal_form(owner.student)) for key, owner in found.items() if owner is not None)
    unsure = [
        key
        for key, owner in found.items()
        if owner is None or (not owner.sure and count[key[0], normal_form(owner.student)] > 1)
    ]
    claims = {key: _claimed(groups[key], roster) for key in unsure}
    owned: dict[str, tuple[list[Key], tuple[str, ...]]] = {}
    for key, owner in found.items():
        if owner is not None and key not in unsure:
            keys, said = owned.get(owner.student, ([], ()))
            owned[owner.student] = ([*keys, key], tuple(dict.fromkeys((*said, *owner.remarks))))
    for key in unsure:
        whose, claim, before = _first(groups[key]), claims[key], known.get(key[:2])
        if claim and claim not in owned and list(claims.values()).count(claim) == 1:
            owned[claim] = ([key], ("the platform does not say who it is; taken for the id typed in the notebook",))
        elif before and before not in owned:
            owned[before] = ([key], ())
        else:
            student = f"{_as_id(whose) if whose.name else 'Participant'} {whose.number}".strip()
            while student in owned:
                student += "'"
            why = "several have this name" if whose.name else "the platform hides the name"
            owned[student] = (
                [key],
                (f"{why}; the grading worksheet with names, given beside the zip, tells who it is",),
            )
    return owned


def _owner(whose: Sender, roster: Roster, people: Mapping[str, Person]) -> _Owner | None:
    """Who that is, by the platform's number or by a name that only one person has; None if neither tells."""
    person = people.get(whose.number) if whose.platform == "moodle" else roster.with_canvas_id(whose.number)
    members = [member.id for member in roster.of_group(whose.name)]
    # Canvas gives the work of a group the number of one of its members.
    if person is not None and not (members and normal_form(whose.name) not in person.names):
        return _Owner(person.id, sure=True)
    on_roster = roster.named(whose.name)
    if len(on_roster) > 1 or not whose.name:
        return None
    if on_roster:
        return _Owner(on_roster[0].id)
    if members:
        return _Owner(_as_id(whose), (f"a group: {', '.join(members)}",))
    return _Owner(_as_id(whose), ("not on the roster",) if roster.people else ())


def _first(group: Sequence[Piece]) -> Sender:
    return group[0].sender


def _claimed(group: Sequence[Piece], roster: Roster) -> str | None:
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
