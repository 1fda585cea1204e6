"""The private half of every exercise: a package each, with references and response trees.

A package lists its questions in ``QUESTIONS``; being in this folder is all the registration there is. What several
exercises need stands in `shared`, which asks nothing.
"""

from __future__ import annotations

import difflib
import importlib
import pkgutil
from functools import cache

from autograder.judge import Question


def names() -> list[str]:
    """The exercises there are."""
    return sorted(name for name in _modules() if of_exercise(name))


@cache
def of_exercise(name: str) -> tuple[Question, ...]:
    """The questions of one exercise, in the order of its package; none where there is no package, or it asks nothing."""
    if name not in _modules():
        return ()
    return getattr(importlib.import_module(f"{__name__}.{name}"), "QUESTIONS", ())


def exercises() -> dict[str, tuple[Question, ...]]:
    """The questions of every exercise."""
    return {name: of_exercise(name) for name in names()}


def find(id: str) -> Question:
    """The question called `id`; a `KeyError` names the nearest ones."""
    exercise = id.partition(".")[0]
    known = {question.id: question for question in of_exercise(exercise)}
    try:
        return known[id]
    except KeyError:
        near = difflib.get_close_matches(id, known or names(), n=3) or list(known) or names()
        raise KeyError(f"there is no question {id!r}; there are {', '.join(near)}") from None


def _modules() -> list[str]:
    return [module.name for module in pkgutil.iter_modules(__path__)]
