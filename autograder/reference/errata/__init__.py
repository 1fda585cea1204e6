"""Errors and ambiguities of the five course documents, as data with proofs.

>>> from autograder.reference import errata
>>> erratum = errata.find("004-app-sin")
>>> erratum.printed, erratum.corrected, erratum.why
>>> erratum.prove().detail

`ERRORS` are wrong as printed; `AMBIGUITIES` are right under one reading only. For an
ambiguity "printed fails" means that the readings said to be wrong are wrong.
"""

from . import adept_s600, dhm_slides, epfl, meca953, pen_robot
from .page import as_html
from .proof import Check, Erratum, Proof, Reading

_DOCUMENTS = (meca953, epfl, dhm_slides, pen_robot, adept_s600)

ERRORS: tuple[Erratum, ...] = tuple(e for d in _DOCUMENTS for e in d.ERRORS)
"""34 statements that are wrong as printed."""

AMBIGUITIES: tuple[Erratum, ...] = tuple(e for d in _DOCUMENTS for e in d.AMBIGUITIES)
"""27 statements that are ambiguous, inconsistent or damaged."""


def find(id: str) -> Erratum:
    """The erratum of that id. Raises KeyError, listing the ids, when there is none."""
    known = {erratum.id: erratum for erratum in ERRORS + AMBIGUITIES}
    if id not in known:
        raise KeyError(f"no erratum {id!r}; there are {', '.join(sorted(known))}")
    return known[id]


__all__ = ["AMBIGUITIES", "ERRORS", "Check", "Erratum", "Proof", "Reading", "as_html", "find"]
