"""Public checks: what can be tested in the student's own session without knowing the answer."""

from __future__ import annotations

import math

import numpy as np
import sympy

from .notice import Line
from .public import PublicQuestion

_TOLERANCE = 1e-6


def run_public_check(question: PublicQuestion, spec: dict, answer) -> Line:
    """Run one ``[[<question>.public]]`` entry on the live answer; a failure inside becomes a failed line."""
    try:
        return _CHECKS[spec["name"]](question, spec, answer)
    except Exception as error:
        return Line(False, f"{spec['says']}: stopped with {type(error).__name__}: {error}")


def _numbers(answer, values: dict[str, float]) -> np.ndarray:
    """The answer as floats, with `values` put in for its symbols (by name)."""
    entries = answer.tolist() if isinstance(answer, sympy.MatrixBase) else answer
    array = np.array(entries, dtype=object)
    return np.vectorize(lambda entry: float(_substitute(entry, values)), otypes=[float])(array)


def _substitute(entry, values: dict[str, float]):
    entry = sympy.sympify(entry)
    return entry.subs({symbol: values[symbol.name] for symbol in entry.free_symbols})


def _value_at(question: PublicQuestion, spec: dict, answer) -> Line:
    values = _numbers(answer, spec["at"])
    entry = spec.get("entry")
    if entry is not None:
        values = values.reshape(-1)[entry[0]] if len(entry) == 1 else values[tuple(entry)]
    holds = np.allclose(values, np.reshape(spec["equals"], np.shape(values)), atol=_TOLERANCE)
    return Line(bool(holds), spec["says"])


def _rigid_transform(question: PublicQuestion, spec: dict, answer) -> Line:
    draw = np.random.default_rng(1)
    values = _numbers(answer, {name: draw.uniform(0.2, 1.3) for name in question.symbols})
    return Line(is_rigid(values), spec["says"])


def is_rigid(matrix: np.ndarray) -> bool:
    """True if the (n, n) matrix is a rotation and a translation: R^T R = I, det R = 1, last row 0 ... 0 1."""
    n = matrix.shape[0] - 1
    rotation = matrix[:n, :n]
    return bool(
        np.allclose(rotation.T @ rotation, np.eye(n), atol=_TOLERANCE)
        and math.isclose(np.linalg.det(rotation), 1, abs_tol=_TOLERANCE)
        and np.allclose(matrix[n], [0] * n + [1], atol=_TOLERANCE)
    )


def _returned(spec: dict, answer):
    result = answer(*spec["args"])
    return None if result is None or result is Ellipsis else result


def _returns(question: PublicQuestion, spec: dict, answer) -> Line:
    result = _returned(spec, answer)
    if result is None:
        return Line.unattempted(spec["says"])
    values = _numbers(result, {})
    holds = "shape" not in spec or values.shape == tuple(spec["shape"])
    if holds and "equals" in spec:
        expected = np.array(spec["equals"], dtype=float)
        holds = values.shape == expected.shape and np.allclose(values, expected, atol=_TOLERANCE)
    return Line(bool(holds), spec["says"])


def _forward_of_inverse(question: PublicQuestion, spec: dict, answer) -> Line:
    result = _returned(spec, answer)
    if result is None:
        return Line.unattempted(spec["says"])
    l1, l2 = spec["lengths"]
    solutions = np.array(_numbers(result, {})).reshape(-1, 2)
    t1, t12 = solutions[:, 0], solutions.sum(axis=1)
    reached = np.stack([l1 * np.cos(t1) + l2 * np.cos(t12), l1 * np.sin(t1) + l2 * np.sin(t12)], axis=1)
    target = spec.get("target", spec["args"][:2])
    return Line(len(solutions) > 0 and np.allclose(reached, target, atol=_TOLERANCE), spec["says"])


_CHECKS = {
    "value_at": _value_at,
    "rigid_transform": _rigid_transform,
    "returns": _returns,
    "forward_of_inverse": _forward_of_inverse,
}
