"""The kinds of answer: how each is read from decoded values, and how two answers of a kind compare.

A kind is two functions (see `base.Kind`); a new one is written in a module of this folder and listed here.
"""

from dhkit.public import PublicQuestion

from ..decode import Text
from .base import Comparison, Kind, Setting, describe, refuse
from .entries import (
    Entries,
    compare_direction,
    compare_entries,
    compare_matrix,
    compare_transform,
    read_array,
    read_scalar,
    read_vector,
)
from .orientation import compare_orientation, read_orientation
from .point_cloud import compare_cloud, read_cloud
from .solutions import compare_solutions, read_solutions
from .tables import compare_table, read_table

__all__ = ["KINDS", "Comparison", "Entries", "Kind", "Setting", "describe"]


def _read_choice(question: PublicQuestion, value: object) -> str:
    letter = value.value.strip().upper() if isinstance(value, Text) else None
    if letter not in question.options:
        raise refuse(question, repr(value.value[:20]) if isinstance(value, Text) else describe(value))
    return letter


def _compare_choice(question: PublicQuestion, student: str, other: str, setting: Setting) -> Comparison:
    return Comparison(student == other, float(student == other))


KINDS = {
    "number": Kind(read_scalar, compare_entries),
    "expression": Kind(read_scalar, compare_entries),
    "vector": Kind(read_vector, compare_entries),
    "direction": Kind(read_vector, compare_direction),
    "matrix": Kind(read_array, compare_matrix),
    "transform": Kind(read_array, compare_transform),
    "dh_table": Kind(read_table, compare_table),
    "joint_solutions": Kind(read_solutions, compare_solutions),
    "orientation": Kind(read_orientation, compare_orientation),
    "point_cloud": Kind(read_cloud, compare_cloud),
    "choice": Kind(_read_choice, _compare_choice),
}
