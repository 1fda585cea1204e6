"""The verdicts on what the lectures ask to try, which are part of the kit: ``python -m autograder.sealing.lectures`` seals them.

Nothing is kept from anybody: each lecture unfolds its answers. So whatever can be sealed is, however short.
"""

from __future__ import annotations

from autograder.questions.tries import TRIES
from dhkit.home.envelopes import OF_LECTURES, SealedExercise, encoded
from dhkit.public import TRY

from .seal import seal_exercise

_SALT = b"answers of the lectures"
_COST = 2**10
"""Of scrypt: there is no secret to guard."""


def seal_lectures() -> SealedExercise:
    """The file of the lectures; the same questions give the same bytes."""
    return seal_exercise(TRY, TRIES, _SALT, cost=_COST, sets=1, least=0)[0]


if __name__ == "__main__":
    OF_LECTURES.write_bytes(encoded(seal_lectures()))
    print(OF_LECTURES)
