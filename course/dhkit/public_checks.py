"""Public checks: what can be tested in the student's own session without knowing the answer.

They look at the answer as it is handed in and as the grader reads it: the arranged node of its form, never the object.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from typing import Annotated, Any

import msgspec
import numpy as np
from msgspec import Meta

from . import wire
from .forms import Form
from .forms.base import Symbolic, Text
from .forms.dh_table import DH_COLUMNS, DHTable
from .forms.function import Function
from .forms.joint_solutions import JointSolutions
from .forms.matrix import Matrix
from .forms.number import Number
from .geometry import wrap
from .nodes import is_blank
from .notice import Line
from .schema import choose
from .values import reals

Index = Annotated[int, Meta(ge=0)]
Tolerance = Annotated[float, Meta(gt=0, le=0.1)]
TOLERANCE = 1e-6


class PublicCheck(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One entry ``[[<question>.public]]``.

    Attributes
    ----------
    says : str
        What is checked, in words: shown with a mark.
    """

    says: Text

    def fit(self, form: Form) -> None:
        """Raise `ValueError`, which begins with the name of a field, if this cannot be checked on answers of `form`."""
        raise NotImplementedError

    def run(self, form: Form, node: object, function: Callable | None) -> Line:
        """Check the arranged `node` of an answer in its form, or the `function` that was handed in."""
        raise NotImplementedError


class ValueAt(PublicCheck, frozen=True, kw_only=True):
    """The answer, or one entry of it, has a known value for given values of its symbols.

    Attributes
    ----------
    at : dict
        A number for every symbol.
    entry : tuple of int, optional
        Place of the entry, counted from zero.
    equals : number or nested lists
    angles : tuple of int
        Entries of a vector that are angles, compared modulo a full turn; ``[0]`` for a single expression. Those of a
        DHm table are known.
    tolerance : float, optional
    """

    at: dict[str, float] = {}
    entry: tuple[Index, ...] | None = None
    equals: Any
    angles: tuple[Index, ...] = ()
    tolerance: Tolerance | None = None

    def fit(self, form: Form) -> None:
        if not isinstance(form, (Number, Symbolic)):
            raise ValueError(f"name: value_at makes no sense for the kind {form.kind}")
        if self.at.keys() != set(form.symbols):
            wanted = ", ".join(form.symbols) or "no symbol"
            raise ValueError(f"at: gives {', '.join(self.at) or 'no symbol'}, wanted is {wanted}")
        _fits("angles", self.angles, _size(form.shape))
        shape = form.shape
        if self.entry is not None:
            sizes = form.shape if len(self.entry) == len(form.shape) else (_size(form.shape),)
            if len(self.entry) != len(sizes) or any(place >= size for place, size in zip(self.entry, sizes)):
                raise ValueError(f"entry: there is no entry {list(self.entry)} in shape {list(form.shape)}")
            shape = ()
        if _array("equals", self.equals).shape != shape:
            raise ValueError(f"equals: expected shape {list(shape)}, found {list(np.shape(self.equals))}")

    def run(self, form: Form, node: object, function: Callable | None) -> Line:
        found, angles = reals(node, self.at), _angles(form, self.angles)
        if self.entry is not None:
            place = self.entry if len(self.entry) == found.ndim else np.unravel_index(self.entry[0], found.shape)
            found, angles = found[place], angles[place]
        return Line(
            _agree(found, np.array(self.equals, dtype=float), angles, _allowed(self.tolerance, form)), self.says
        )


class RigidTransform(PublicCheck, frozen=True, kw_only=True):
    """The matrix is a rotation and a translation, whatever the values of its symbols.

    Attributes
    ----------
    tolerance : float, optional
    """

    tolerance: Tolerance | None = None

    def fit(self, form: Form) -> None:
        if not isinstance(form, Matrix) or len(form.shape) != 2 or form.shape[0] != form.shape[1]:
            raise ValueError(f"name: rigid_transform is for square matrices, not for the kind {form.kind}")

    def run(self, form: Form, node: object, function: Callable | None) -> Line:
        draw = np.random.default_rng(1)
        found = reals(node, {name: draw.uniform(0.2, 1.3) for name in form.symbols})
        return Line(is_rigid(found, _allowed(self.tolerance, form)), self.says)


class Returns(PublicCheck, frozen=True, kw_only=True):
    """A function returns something in its form, perhaps of a known shape or with known values.

    Attributes
    ----------
    args : list
        Its arguments.
    shape : tuple of int, optional
        Of joint solutions, those that are the same but for full turns count once.
    equals : number or nested lists, optional
        Joint solutions are compared without order and but for full turns.
    angles : tuple of int
        Entries of a returned vector that are angles.
    tolerance : float, optional
    """

    args: list[Any]
    shape: tuple[Index, ...] | None = None
    equals: Any = None
    angles: tuple[Index, ...] = ()
    tolerance: Tolerance | None = None

    def fit(self, form: Form) -> None:
        returned = _returned_form(form, "returns")
        _fits("angles", self.angles, _size(returned.shape))
        if self.equals is not None:
            shape = _array("equals", self.equals).shape
            if isinstance(returned, JointSolutions):
                fits = shape == (0,) or shape[1:] == (len(returned.joints),)
            else:
                fits = shape == returned.shape
            if not fits:
                raise ValueError(f"equals: shape {list(shape)} is not what the function returns")

    def run(self, form: Form, node: object, function: Callable | None) -> Line:
        returned = _returned_form(form, "returns")
        tolerance = _allowed(self.tolerance, returned)
        result = _result(self.args, function)
        if is_blank(returned.arranged(result)):
            return Line.unattempted(self.says)
        if complaint := returned.complaint(result):
            return Line(False, f"{self.says}: {complaint}")
        found, angles = reals(returned.arranged(result), {}), _angles(returned, self.angles)
        if isinstance(returned, JointSolutions):
            found = _distinct(found.reshape(-1, len(returned.joints)), tolerance)
        holds = self.shape is None or found.shape == self.shape or (0 in self.shape and found.size == 0)
        if holds and self.equals is not None:
            expected = np.array(self.equals, dtype=float).reshape(-1, *found.shape[1:])
            if isinstance(returned, JointSolutions):
                same = _same(expected, found, tolerance)
                holds = bool(same.any(axis=1).all() and same.any(axis=0).all())
            else:
                holds = _agree(found, np.array(self.equals, dtype=float), angles, tolerance)
        return Line(holds, self.says)


class ForwardOfInverse(PublicCheck, frozen=True, kw_only=True):
    """All joint solutions that a function returns for a planar arm bring the hand back to its target.

    Attributes
    ----------
    args : list
        Its arguments.
    lengths : tuple of float
        The two links, in metres.
    target : tuple of float, optional
        Where the hand should be, in metres; the first two arguments unless it is given.
    tolerance : float
        How far from it the hand may be, in metres; joint angles may be rounded to four decimals.
    """

    args: list[Any]
    lengths: tuple[float, float]
    target: tuple[float, float] | None = None
    tolerance: Tolerance = 1e-3

    def fit(self, form: Form) -> None:
        returned = _returned_form(form, "forward_of_inverse")
        if not isinstance(returned, JointSolutions) or len(returned.joints) != 2:
            raise ValueError("name: forward_of_inverse is for functions that return solutions of two joints")
        if self.target is None and (len(self.args) < 2 or not all(isinstance(x, (int, float)) for x in self.args[:2])):
            raise ValueError("target: missing, and the first two arguments are no point")

    def run(self, form: Form, node: object, function: Callable | None) -> Line:
        returned = _returned_form(form, "forward_of_inverse")
        result = _result(self.args, function)
        if is_blank(returned.arranged(result)):
            return Line.unattempted(self.says)
        if complaint := returned.complaint(result):
            return Line(False, f"{self.says}: {complaint}")
        (l1, l2), solutions = self.lengths, reals(returned.arranged(result), {}).reshape(-1, 2)
        t1, t12 = solutions[:, 0], solutions.sum(axis=1)
        reached = np.stack([l1 * np.cos(t1) + l2 * np.cos(t12), l1 * np.sin(t1) + l2 * np.sin(t12)], axis=1)
        misses = np.linalg.norm(reached - np.array(self.target or self.args[:2]), axis=1)
        return Line(len(solutions) > 0 and bool((misses <= self.tolerance).all()), self.says)


CHECKS: dict[str, type[PublicCheck]] = {
    "value_at": ValueAt,
    "rigid_transform": RigidTransform,
    "returns": Returns,
    "forward_of_inverse": ForwardOfInverse,
}


def from_tables(tables: object, form: Form) -> tuple[PublicCheck, ...]:
    """The public checks of a question; `ValueError` names the field that is wrong."""
    if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
        raise ValueError("public: expected a list of tables, [[<question>.public]]")
    return tuple(_check(f"public[{place}]", table, form) for place, table in enumerate(tables))


def _check(where: str, table: dict[str, object], form: Form) -> PublicCheck:
    try:
        check = choose(table, "name", CHECKS)
        check.fit(form)
    except ValueError as error:
        raise ValueError(f"{where}.{error}") from None
    return check


def run_public_check(check: PublicCheck, form: Form, node: object, function: Callable | None = None) -> Line:
    """Run one check; a failure inside becomes a failed line."""
    try:
        return check.run(form, node, function)
    except (Exception, SystemExit) as error:
        return Line(False, f"{check.says}: stopped with {wire.failure(error)}")


def is_rigid(matrix: np.ndarray, tolerance: float = TOLERANCE) -> bool:
    """True if the (n, n) matrix is a rotation and a translation: R^T R = I, det R = 1, last row 0 ... 0 1."""
    n = matrix.shape[0] - 1
    rotation = matrix[:n, :n]
    return bool(
        np.allclose(rotation.T @ rotation, np.eye(n), atol=tolerance)
        and abs(np.linalg.det(rotation) - 1) <= tolerance
        and np.allclose(matrix[n], [0] * n + [1], atol=tolerance)
    )


def _returned_form(form: Form, name: str) -> Form:
    if not isinstance(form, Function):
        raise ValueError(f"name: {name} is for functions, not for the kind {form.kind}")
    if form.returns.symbols:
        raise ValueError(f"name: {name} is for functions that return numbers")
    return form.returns


def _result(args: list, function: Callable | None) -> object:
    """The node of what a function returns; it gets arguments of its own, which it may change."""
    if function is None:
        raise ValueError("no function was handed in")
    return wire.encode(function(*copy.deepcopy(args)))


def _allowed(given: float | None, form: Form) -> float:
    """Unless it is given: two units of the last decimal that is asked for, as several rounded numbers meet."""
    if given is not None:
        return given
    return TOLERANCE if form.decimals is None else 2 * 10.0**-form.decimals


def _size(shape: Sequence[int]) -> int:
    return int(np.prod(shape))


def _fits(field: str, places: tuple[int, ...], size: int) -> None:
    if any(place >= size for place in places):
        raise ValueError(f"{field}: there are only {size} entries")


def _array(field: str, value: object) -> np.ndarray:
    try:
        return np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{field}: expected numbers") from None


def _angles(form: Form, places: tuple[int, ...]) -> np.ndarray:
    """Which entries are angles, in the shape of the answer."""
    if isinstance(form, DHTable):
        return np.broadcast_to([name in ("alpha", "theta") for name in DH_COLUMNS], form.shape)
    return np.isin(np.arange(_size(form.shape)), places).reshape(form.shape)


def _agree(found: np.ndarray, expected: np.ndarray, angles: np.ndarray, tolerance: float) -> bool:
    gap = np.asarray(found - expected)
    return bool(np.all(np.abs(np.where(angles, wrap(gap), gap)) <= tolerance * np.maximum(1, np.abs(expected))))


def _same(a: np.ndarray, b: np.ndarray, tolerance: float) -> np.ndarray:
    """Which of the (m, n) solutions `a` are the same as which of the (k, n) solutions `b` but for full turns: (m, k)."""
    return (np.abs(wrap(a[:, None] - b[None])) <= tolerance).all(axis=-1)


def _distinct(solutions: np.ndarray, tolerance: float) -> np.ndarray:
    """Each of the (m, n) solutions once."""
    same = _same(solutions, solutions, tolerance)
    return solutions[[i for i in range(len(solutions)) if not same[i, :i].any()]]
