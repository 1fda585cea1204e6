"""Answers that are right but for one thing that no understanding hangs on: too few decimals, columns in place of rows."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from dhkit.forms import Form

from .angles import ENOUGH, FEWEST
from .kinds import Comparison, Entries, Setting
from .tree import Verdict

ROUNDED, TURNED, ASSUMED = "rounded_too_far", "columns_in_place_of_rows", "sign_assumed"
SHARE, SHARE_OF_ONE_DECIMAL = 0.8, 0.4

_WORDS = {1: "one decimal", 2: "two decimals", 3: "three decimals", 4: "four decimals", 5: "five decimals"}

Compare = Callable[[object, Setting], Comparison]


@dataclass(frozen=True)
class Almost:
    """What keeps an answer from being right: its note, and of two with the same note the `rank` of the better one."""

    note: str
    rank: int = 0


def find_almost(
    form: Form, answer: object, setting: Setting, compare: Compare, assumed: Sequence[str] = ()
) -> Almost | None:
    """What keeps an answer from being right; None if it is simply wrong.

    Parameters
    ----------
    answer : object
        As its kind holds it.
    setting : Setting
        How it was compared when it was found not to be right.
    compare : callable
        Compares an answer with the right one in a given setting.
    assumed : sequence of str
        Symbols of which the student told SymPy that they are positive.
    """
    if (places := _decimals_kept(form, answer, setting, compare)) is not None:
        return Almost(ROUNDED, places)
    if isinstance(answer, np.ndarray) and _may_be_turned(form, answer) and compare(answer.T, setting).equal:
        return Almost(TURNED)
    known = {name: np.abs(setting.samples[name]) for name in assumed if name in setting.samples}
    if known and compare(answer, replace(setting, samples={**setting.samples, **known})).equal:
        return Almost(ASSUMED)
    return None


def worst(found: Iterable[Almost | None]) -> Almost | None:
    """What keeps several results from being right that are all kept from it by the same."""
    some = list(found)
    kept = [one for one in some if one is not None]
    alike = len(kept) == len(some) and len({one.note for one in kept}) == 1
    return min(kept, key=lambda one: one.rank) if alike else None


def verdict_on(form: Form, almost: Almost, assumed: Sequence[str] = ()) -> Verdict:
    """Most of the points, and what to do about it."""
    if almost.note == TURNED:
        feedback = "**Rows and columns are exchanged.** The numbers are right, but a solution is a row: one list with all its joints."
        return Verdict(SHARE, TURNED, feedback)
    if almost.note == ASSUMED:
        names = ", ".join(sorted(assumed))
        feedback = (
            f"**Right only where {names} {'is' if len(assumed) == 1 else 'are'} positive.** You declared that, so SymPy simplified "
            f"with it: it turns `atan2(y, x)` into `atan(y/x)`, for example. Declare plain symbols, without `positive=True`."
        )
        return Verdict(SHARE, ASSUMED, feedback)
    what = f"It is right to {_WORDS[almost.rank]}; give {_WORDS[form.decimals or ENOUGH]}."
    if form.symbols:
        what = "A constant angle has too few decimals; write `pi/2`, which is exact."
    share = SHARE if almost.rank > 1 else SHARE_OF_ONE_DECIMAL
    return Verdict(share, ROUNDED, f"**Right, but rounded too far.** {what}")


def _may_be_turned(form: Form, answer: np.ndarray) -> bool:
    """Whether columns in place of rows are in the form asked for: as many solutions as joints."""
    return form.kind == "joint_solutions" and answer.shape[0] == answer.shape[1]


def _decimals_kept(form: Form, answer: object, setting: Setting, compare: Compare) -> int | None:
    """To how many decimals an answer is right that was rounded too far; None if it is wrong, or not rounded."""
    if form.symbols and isinstance(answer, Entries):
        for places in range(ENOUGH - 1, FEWEST - 1, -1):
            # Products of sines of rounded quarter turns differ from 1 in the sixth decimal.
            wider = replace(setting, tolerance=max(setting.tolerance, 1e-5))
            if (exact := answer.meant(places)) is not None and compare(exact, wider).equal:
                return places
    values = _values(answer, setting)
    if form.decimals is None or values is None or not values.size:
        return None
    for places in range(form.decimals - 1, 0, -1):
        rounded = values == values.round(places)
        # With one decimal much comes near: then all of the answer must look like it.
        if rounded.any() if places > 1 else rounded.all():
            # Digits may have been cut off, too.
            off = 1.0001 if places > 1 else 0.5001
            slack = np.where(rounded, off * 10.0**-places, 0.0)
            if compare(answer, replace(setting, slack=slack)).equal:
                return places
    return None


def _values(answer: object, setting: Setting) -> np.ndarray | None:
    if isinstance(answer, Entries):
        return answer.values(setting.samples)[0].real if not setting.samples else None
    return answer if isinstance(answer, np.ndarray) else None
