"""Answers that are right but for too few decimals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from dhkit.forms import Form

from .angles import ENOUGH, FEWEST
from .kinds import Comparison, Entries, Setting
from .tree import Verdict

NOTE = "rounded_too_far"
SHARE, SHARE_OF_ONE_DECIMAL = 0.8, 0.4

_WORDS = {1: "one decimal", 2: "two decimals", 3: "three decimals", 4: "four decimals", 5: "five decimals"}


def decimals_kept(
    form: Form, answer: object, setting: Setting, compare: Callable[[object, Setting], Comparison]
) -> int | None:
    """To how many decimals an answer is right that was rounded too far; None if it is wrong, or not rounded.

    Parameters
    ----------
    answer : object
        As its kind holds it.
    setting : Setting
        How it was compared when it was found not to be right.
    compare : callable
        Compares an answer with the right one in a given setting.
    """
    if form.symbols and isinstance(answer, Entries):
        for places in range(ENOUGH - 1, FEWEST - 1, -1):
            # Products of sines of rounded quarter turns differ from 1 in the sixth decimal.
            wider = replace(setting, tolerance=max(setting.tolerance, 1e-5))
            if (exact := answer.meant(places)) is not None and compare(exact, wider).equal:
                return places
    values = _values(answer, setting)
    if form.decimals is None or values is None:
        return None
    for places in range(form.decimals - 1, 0, -1):
        rounded = values == values.round(places)
        # With one decimal much comes near: then all of the answer must look like it.
        if (rounded.any() if places > 1 else rounded.all()) and values.size:
            slack = np.where(rounded, 0.5001 * 10.0**-places, 0.0)
            if compare(answer, replace(setting, slack=slack)).equal:
                return places
    return None


def rounded_too_far(form: Form, places: int) -> Verdict:
    """The verdict on an answer that is right to so many decimals."""
    what = f"It is right to {_WORDS[places]}; give {_WORDS[form.decimals or ENOUGH]}."
    if form.symbols:
        what = "A constant angle has too few decimals; write `pi/2`, which is exact."
    feedback = f"**Right, but rounded too far.** {what}"
    return Verdict(SHARE if places > 1 else SHARE_OF_ONE_DECIMAL, NOTE, feedback)


def _values(answer: object, setting: Setting) -> np.ndarray | None:
    if isinstance(answer, Entries):
        return answer.values(setting.samples)[0].real if not setting.samples else None
    return answer if isinstance(answer, np.ndarray) else None
