"""The private half of every exercise: one module each, with references and response trees.

A module lists its questions in ``QUESTIONS``; being in this folder is all the registration there is.
"""

from __future__ import annotations

import difflib
import importlib
import pkgutil
from functools import lru_cache

from autograder.judge import Question


@lru_cache(maxsize=None)
def exercises() -> dict[str, tuple[Question, ...]]:
    """The questions of every exercise, in the order of their module."""
    names = sorted(module.name for module in pkgutil.iter_modules(__path__))
    return {name: importlib.import_module(f"{__name__}.{name}").QUESTIONS for name in names}


def find(id: str) -> Question:
    """The question called `id`; a `KeyError` names the nearest ones."""
    known = {question.id: question for questions in exercises().values() for question in questions}
    try:
        return known[id]
    except KeyError:
        near = difflib.get_close_matches(id, known, n=3) or list(known)
        raise KeyError(f"there is no question {id!r}; there are {', '.join(near)}") from None
