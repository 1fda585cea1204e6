"""A modified DH table as the judge compares it: frames on the joint axes, at one posture.

A table is only ever evaluated. Its joint entries must be sums of joint variables and constants; their
coefficients and constants are read off from values.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate
from typing import TYPE_CHECKING, Any

import numpy as np

from dhkit import wire
from dhkit.forms.dh_table import DH_COLUMNS
from dhkit.geometry import modified_dh

from ..decode import Expression, Number, decode
from ..evaluate import evaluate, symbols

if TYPE_CHECKING:
    from autograder.reference import DHTable

MAX_JOINTS = 12
MAX_ROWS = 24

_WIDTH = len(DH_COLUMNS)
# Joint values at which entries are evaluated: around the first one the coefficients are read, at the others a
# joint entry that is no sum of variables and constants betrays itself.
_BASE, _CHECKS = 0.37, (-4.19, 9.83)
_EXACT = 1e-7
_HUGE = 1e300


class NotAChain(ValueError):
    """The table describes no chain of revolute and prismatic joints; the message is a sentence for the student."""


@dataclass(frozen=True, eq=False)
class JudgedChain:
    """A serial chain at K sample points of its lengths (one point where all lengths are numbers).

    Attributes
    ----------
    variables : tuple of str
        Names of the m joint variables.
    prismatic : tuple of bool
        For each of the n joints, base first. Constant rows are no joints.
    coupling : (n, m) array
        What the m joint variables contribute to each joint: one entry +1 or -1 per row unless joints are coupled.
    frames : (K, n, 4, 4) array
        Frame of each joint, base first, in metres, with every joint variable zero; its z axis is the joint's axis.
    end : (K, 4, 4) array
        Frame at the end of the table, constant rows after the last joint included.
    """

    variables: tuple[str, ...]
    prismatic: tuple[bool, ...]
    coupling: np.ndarray
    frames: np.ndarray
    end: np.ndarray

    @classmethod
    def of_entries(
        cls, entries: Sequence[object], joints: Sequence[str], samples: Mapping[str, np.ndarray]
    ) -> JudgedChain:
        """From decoded entries, row after row of (sigma, a, alpha, d, theta).

        Parameters
        ----------
        entries : sequence
            Metres and radians.
        joints : sequence of str
            Names of the joint variables, in order.
        samples : mapping
            Values of the other symbols, one (K,) array each; values for joints are not used.

        Raises
        ------
        NotAChain
        """
        count, rest = divmod(len(entries), _WIDTH)
        if rest or not 0 < count <= MAX_ROWS:
            raise NotAChain(f"a table has rows of {_WIDTH} entries, and at most {MAX_ROWS} rows")
        values = _Values(joints, samples)
        rows = [_row(i + 1, entries[_WIDTH * i : _WIDTH * (i + 1)], values) for i in range(count)]
        return cls._of_rows(values.joints, rows)

    @classmethod
    def of_table(cls, table: DHTable, samples: Mapping[str, np.ndarray] | None = None) -> JudgedChain:
        """From a table of the reference solver, base and tool included; by default at the table's own values."""
        samples = samples or {name: np.array([value], float) for name, value in table.values.items()}

        def decoded(value: object) -> list[Expression]:
            rows: Any = decode(wire.encode(value)).value
            return [entry for row in rows for entry in row]

        def transform(matrix: object) -> np.ndarray:
            return np.stack([evaluate(entry, samples).real for entry in decoded(matrix)], axis=-1).reshape(-1, 4, 4)

        entries = decoded([[row.sigma, *row.parameters] for row in table.rows])
        chain = cls.of_entries(entries, [joint.name for joint in table.joints], samples)
        base, tool = transform(table.base), transform(table.tool)
        return replace(chain, frames=base[:, None] @ chain.frames, end=base @ chain.end @ tool)

    @classmethod
    def _of_rows(cls, variables: tuple[str, ...], rows: list[tuple]) -> JudgedChain:
        coefficients = np.array([row[0] for row in rows])
        driven = np.flatnonzero(coefficients.any(axis=1))
        if len(driven) > MAX_JOINTS:
            raise NotAChain(f"the table has {len(driven)} joints; at most {MAX_JOINTS} are compared")
        steps = [modified_dh(*row[2:]) for row in rows]
        each = list(accumulate(steps, np.matmul))
        samples = max(len(frame) for frame in each)
        frames = np.stack([np.broadcast_to(frame, (samples, 4, 4)) for frame in each], axis=1)
        prismatic = tuple(bool(rows[i][1]) for i in driven)
        return cls(variables, prismatic, coefficients[driven], frames[:, driven], frames[:, -1])

    @property
    def joints(self) -> int:
        """Number n of joints."""
        return len(self.prismatic)

    def first(self, count: int) -> JudgedChain:
        """The chain up to and including joint number `count`, its frame the end."""
        used = slice(0, count)
        return JudgedChain(
            self.variables, self.prismatic[used], self.coupling[used], self.frames[:, used], self.frames[:, count - 1]
        )

    @cached_property
    def axes(self) -> np.ndarray:
        """Unit vectors along the joint axes, (K, n, 3)."""
        return np.ascontiguousarray(self.frames[..., :3, 2])

    @cached_property
    def normals(self) -> np.ndarray:
        """Unit vectors X_i, (K, n, 3)."""
        return np.ascontiguousarray(self.frames[..., :3, 0])

    @cached_property
    def origins(self) -> np.ndarray:
        """Points O_i on the joint axes, (K, n, 3)."""
        return np.ascontiguousarray(self.frames[..., :3, 3])

    @cached_property
    def size(self) -> float:
        """The larger of 1 m and the largest coordinate of an origin or of the end, metres."""
        return max(1.0, np.abs(self.end[:, :3, 3]).max(), np.abs(self.origins).max(initial=0))

    @cached_property
    def ends_with_joint(self) -> bool:
        """True if the frame of the last joint is the end of the chain."""
        return bool(np.abs(self.frames[:, -1] - self.end).max() < 1e-12)


class _Values:
    """Evaluates entries at the sample points, for several values of the joint variables at a time."""

    def __init__(self, joints: Sequence[str], samples: Mapping[str, np.ndarray]) -> None:
        self.joints = tuple(joints)
        self.samples = {name: np.asarray(value, float) for name, value in samples.items() if name not in self.joints}
        size = len(next(iter(self.samples.values()), np.zeros(1)))
        count = len(self.joints)
        steps = np.full((count + 1 + len(_CHECKS), count), _BASE)
        steps[1 : count + 1] += np.eye(count)
        # Different values for different joints, so that errors of two joints cannot cancel.
        steps[count + 1 :] = np.outer(_CHECKS, 1 + 0.31 * np.arange(count))
        self.steps = steps
        self.sweep = {name: np.tile(value, len(steps)) for name, value in self.samples.items()}
        self.sweep |= {name: np.repeat(steps[:, j], size) for j, name in enumerate(self.joints)}

    def affine(self, entry: Expression) -> tuple[np.ndarray, np.ndarray] | None:
        """Coefficients (m,) of the joint variables and the constant (K,); None if `entry` is no such sum."""
        nothing = np.zeros(len(self.joints))
        if isinstance(entry, Number) and isinstance(entry.value, (int, float)) and abs(entry.value) < _HUGE:
            return nothing, np.array([float(entry.value)])
        names = symbols(entry)
        if names.isdisjoint(self.joints):
            constant = evaluate(entry, self.samples if names else {})
            return (nothing, constant.real) if _real(constant) else None
        values = evaluate(entry, self.sweep).reshape(len(self.steps), -1)
        if not _real(values):
            return None
        values = values.real
        count = len(self.joints)
        slopes = (values[1 : count + 1] - values[0]).T
        coefficients = slopes[0]
        constant = values[0] - slopes @ self.steps[0]
        expected = constant + (self.steps @ coefficients)[:, None]
        if np.abs(values - expected).max() > _EXACT * (1 + np.abs(values).max()):
            return None
        whole = np.round(coefficients)
        return np.where(np.abs(coefficients - whole) < _EXACT, whole, coefficients), constant


def _real(values: np.ndarray) -> bool:
    return bool(np.isfinite(values).all() and np.abs(values.imag).max() < _EXACT)


def _row(number: int, entries: Sequence[object], values: _Values) -> tuple:
    """(coefficients, prismatic, a, alpha, d, theta) of one row, the last four with the joint variables zero."""
    read = []
    for column, entry in zip(DH_COLUMNS, entries, strict=True):
        if not isinstance(entry, Expression):
            raise NotAChain(f"row {number}: {column} is not filled in")
        sum_of = values.affine(entry)
        if sum_of is None:
            raise NotAChain(f"row {number}: {column} is not a sum of joint variables and constants")
        read.append(sum_of)
    (moved_sigma, sigma), (moved_a, a), (moved_alpha, alpha), (moved_d, d), (moved_theta, theta) = read
    prismatic = round(float(sigma[0]))
    if moved_sigma.any() or prismatic not in (0, 1) or np.abs(sigma - prismatic).max() > _EXACT:
        raise NotAChain(f"row {number}: sigma is neither 0 nor 1")
    for column, moved in (("a", moved_a), ("alpha", moved_alpha)):
        if moved.any():
            raise NotAChain(f"row {number}: a joint variable stands in column {column}")
    variable, other = (moved_d, moved_theta) if prismatic else (moved_theta, moved_d)
    if other.any():
        kind, column = ("prismatic", "theta") if prismatic else ("revolute", "d")
        raise NotAChain(f"row {number}: sigma says {kind}, but a joint variable stands in column {column}")
    return variable, prismatic, a, alpha, d, theta
