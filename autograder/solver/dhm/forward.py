"""Forward kinematics: symbolic in textbook form, and numeric for arrays of joint values.

Both use the same idea: consecutive parallel axes are merged before anything is multiplied
out. In a run of parallel (or opposite) axes the angles add up, so the run is one plane
displacement, and cos(t2 + t3) appears as such instead of being rediscovered afterwards.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from .few_postures import FEW, FewPostures
from .geometry import modified_dh_of_cosines
from .one_posture import OnePosture
from .transforms import rot_x, trans_x

if TYPE_CHECKING:
    from .tables import DHRow

Vectors = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""The axes x, y, z of a frame and its origin p, each (3, 1) or (3, N)."""

_CYCLES = ((1, 2), (2, 0), (0, 1))  # of a vector product: its first entry is that of rows 1 and 2
_BLOCK = 4096  # poses treated at a time, so that the intermediate arrays stay in the cache


def recursion(rows: Sequence[DHRow], tool: sp.Matrix) -> list[sp.Matrix]:
    """The list [U_0, ..., U_n] with U_n = tool and U_{j-1} = j-1Tj U_j.

    Source: MECA 953 slides, "calcul de U_j". Every U_j is in textbook form: products are
    left factored and sums of angles of parallel axes stay sums.
    """
    below = {len(rows): sp.Matrix(tool)}
    for start in reversed(range(len(rows))):
        end = _end_of_parallel_run(rows, start)
        below[start] = _merge(rows[start:end]) * below[end]
    return [below[j] for j in range(len(rows) + 1)]


def merged_runs(rows: Sequence[DHRow]) -> sp.Matrix:
    """The product of rows in textbook form, 4x4."""
    return recursion(rows, sp.eye(4))[0]


def _end_of_parallel_run(rows: Sequence[DHRow], start: int) -> int:
    end = start + 1
    while end < len(rows) and sp.cos(rows[end].alpha) in (1, -1):
        end += 1
    return end


def _merge(rows: Sequence[DHRow]) -> sp.Matrix:
    """Product of rows whose axes are all parallel or opposite to the first one."""
    first, *others = rows
    angle, x, y, z, up = first.theta, sp.S.Zero, sp.S.Zero, first.d, sp.S.One
    for row in others:
        x += row.a * sp.cos(angle)
        y += row.a * sp.sin(angle)
        up *= sp.cos(row.alpha)
        z += up * row.d
        angle += up * row.theta
    c, s = sp.cos(angle), sp.sin(angle)
    plane = sp.Matrix([[c, -up * s, 0, x], [s, up * c, 0, y], [0, 0, up, z], [0, 0, 0, 1]])
    return trans_x(first.a) * rot_x(first.alpha) * plane


@dataclass(frozen=True)
class Chain:
    """A DHm table as plain numbers, ready for vectorised evaluation.

    The variable of row i (theta_i when sigma = 0, d_i when sigma = 1) is
    ``(coupling @ q + offset)[i]``, which covers joint offsets, reversed joints
    (d_3 = -d_2 of the SCARA), constant tool rows and coupled joints.

    Attributes
    ----------
    a, cos_alpha, sin_alpha : (rows,) arrays
        Metres; cosine and sine of alpha.
    fixed : (rows,) array
        The constant one of d_i and theta_i, metres or radians.
    prismatic : (rows,) bool array
    coupling : (rows, n) array
    offset : (rows,) array
        Radians or metres.
    base, tool : (4, 4) arrays
    """

    a: np.ndarray
    cos_alpha: np.ndarray
    sin_alpha: np.ndarray
    fixed: np.ndarray
    prismatic: np.ndarray
    coupling: np.ndarray
    offset: np.ndarray
    base: np.ndarray
    tool: np.ndarray

    @property
    def joints(self) -> int:
        """Number n of joint variables."""
        return self.coupling.shape[1]

    def row_matrix(self, row: int, variable: float) -> np.ndarray:
        """The 4x4 transform of one row (counted from 0) for a value of its variable."""
        slide, turn = self.fixed[row], variable
        if self.prismatic[row]:
            slide, turn = turn, slide
        twist = self.cos_alpha[row], self.sin_alpha[row]
        return modified_dh_of_cosines(self.a[row], *twist, slide, np.cos(turn), np.sin(turn))

    def tail(self, row: int) -> np.ndarray:
        """What follows a row (counted from 0) up to the tool, 4x4, for constant rows."""
        result = np.eye(4)
        for i in range(row + 1, len(self.a)):
            result = result @ self.row_matrix(i, self.offset[i])
        return result @ self.tool

    def forward(self, q: ArrayLike) -> np.ndarray:
        """Poses of the tool for joint values.

        Parameters
        ----------
        q : array_like, shape (..., n)
            Radians (revolute) or metres (prismatic).

        Returns
        -------
        array, shape (..., 4, 4)

        Raises
        ------
        ValueError
            When the last axis of q is not n or a value is not finite.
        """
        q = self._checked(q)
        if q.ndim == 1:
            return self._one.forward(q.tolist())
        columns = q.reshape(-1, self.joints)
        poses = np.empty((len(columns), 4, 4))
        poses[:, 3] = (0.0, 0.0, 0.0, 1.0)
        for start in range(0, len(columns), _BLOCK):
            block = slice(start, start + _BLOCK)
            *_, (x, y, z, p) = self._walk(columns[block])
            for j, column in enumerate(self._with_tool(x, y, z, p)):
                poses[block, :3, j] = column.T
        return poses.reshape(*q.shape[:-1], 4, 4)

    def frames(self, q: ArrayLike) -> np.ndarray:
        """Frames of all rows in the world: q (..., n) -> (..., rows, 4, 4)."""
        q = self._checked(q)
        columns = q.reshape(-1, self.joints)
        frames = np.zeros((len(columns), len(self.a), 4, 4))
        frames[..., 3, 3] = 1.0
        for i, vectors in enumerate(self._walk(columns, every_frame=True)):
            for j, column in enumerate(vectors):
                frames[:, i, :3, j] = column.T
        return frames.reshape(*q.shape[:-1], len(self.a), 4, 4)

    def jacobian(self, q: ArrayLike) -> np.ndarray:
        """Geometric Jacobians of the tool point in the base's axes: q (..., n) -> (..., 6, n); errors as for `forward`."""
        q = self._checked(q)
        if q.ndim == 1:
            return self._one.jacobian(q.tolist())
        columns = q.reshape(-1, self.joints)
        found = np.empty((len(columns), 6, self.joints))
        plain = np.array_equal(self.coupling, np.eye(*self.coupling.shape))
        for start in range(0, len(columns), _BLOCK):
            block = slice(start, start + _BLOCK)
            of_rows, _ = self._jacobian_of_rows(columns[block])
            if plain:
                found[block] = np.moveaxis(of_rows[:, : self.joints], 2, 0)
            else:
                found[block] = np.moveaxis(of_rows, 2, 0) @ self.coupling
        return found.reshape(*q.shape[:-1], 6, self.joints)

    def poses_and_jacobians(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """`forward` and `jacobian` of postures (N, n) in one go."""
        if len(q) <= FEW:
            return self._few.poses_and_jacobians(q)
        of_rows, vectors = self._jacobian_of_rows(q)
        poses = np.zeros((len(q), 4, 4))
        poses[:, 3, 3] = 1.0
        for j, column in enumerate(vectors):
            poses[:, :3, j] = column.T
        return poses, np.moveaxis(of_rows, 2, 0) @ self.coupling

    def _jacobian_of_rows(self, q: np.ndarray) -> tuple[np.ndarray, Vectors]:
        """The Jacobian with respect to the variable of each row, (6, rows, N), and the tool's frame."""
        axes: list[tuple[np.ndarray, np.ndarray]] = []
        *_, (x, y, z, p) = self._walk(q, axes=axes)
        tool = self._with_tool(x, y, z, p)
        end = tool[3]
        columns = np.empty((6, len(axes), len(q)))
        product = np.empty(len(q))
        for i, (axis, point) in enumerate(axes):
            speed, turn = columns[:3, i], columns[3:, i]
            if self.prismatic[i]:
                speed[:], turn[:] = axis, 0.0
                continue
            turn[:] = axis
            if point is end:  # as of a wrist whose centre is the tool
                speed[:] = 0.0
                continue
            arm = end - point
            for j, (k, m) in enumerate(_CYCLES):
                np.multiply(axis[k], arm[m], out=speed[j])
                np.multiply(axis[m], arm[k], out=product)
                speed[j] -= product
        return columns, tool

    def _checked(self, q: ArrayLike) -> np.ndarray:
        q = np.asarray(q, dtype=float)
        if q.ndim == 0 or q.shape[-1] != self.joints:
            raise ValueError(f"expected q of shape (..., {self.joints}), found {q.shape}")
        if not np.isfinite(q).all():
            raise ValueError("joint values must be finite numbers")
        return q

    @cached_property
    def _one(self) -> OnePosture:
        return OnePosture.of(self)

    @cached_property
    def _few(self) -> FewPostures:
        return FewPostures.of(self)

    @cached_property
    def _variables(self) -> list[list[tuple[int, float]]]:
        """For each row the joints that act on it, with their coefficients."""
        return [[(int(j), row[j]) for j in np.flatnonzero(row)] for row in self.coupling]

    def _walk(
        self, q: np.ndarray, every_frame: bool = False, axes: list[tuple[np.ndarray, np.ndarray]] | None = None
    ) -> Iterator[Vectors]:
        """Yield the axes and origin (x, y, z, p) of frames, each (3, 1) or (3, N), base first.

        A frame is yielded at the end of each run of parallel axes, where it is needed to go
        on, or after every row when ``every_frame`` is set. The list ``axes`` gets direction and a point of each row's
        axis, each (3, 1) or (3, N).
        """
        x, y, z, p = (self.base[:3, j : j + 1] for j in range(4))
        values = np.ascontiguousarray(q.T)
        angle = 0.0  # turned about the common axis since the start of the run
        along = x  # the x axis of the last row of the run
        up = 1.0  # -1 when the axis of the last row is opposite to the run's
        last = len(self.a) - 1
        for i in range(last + 1):
            if self.a[i]:
                p = p + self.a[i] * along
            if self.sin_alpha[i]:
                y, z = (
                    self.cos_alpha[i] * y + self.sin_alpha[i] * z,
                    self.cos_alpha[i] * z - self.sin_alpha[i] * y,
                )
            else:
                up = up * self.cos_alpha[i]
            if axes is not None:
                axes.append((z if up == 1.0 else up * z, p))
            variable = self.offset[i]
            for joint, coefficient in self._variables[i]:
                turn = values[joint] if coefficient == 1.0 else coefficient * values[joint]
                variable = turn + variable if np.ndim(variable) or variable else turn
            slide, turn = self.fixed[i], variable
            if self.prismatic[i]:
                slide, turn = turn, slide
            if np.ndim(slide) or slide:
                p = p + (up * slide) * z
            angle = angle + up * turn if np.ndim(angle) or angle else up * turn
            run_ends = i == last or self.sin_alpha[i + 1] != 0.0
            if not (run_ends or every_frame or self.a[i + 1]):
                continue
            c, s = np.cos(angle), np.sin(angle)
            along = c * x + s * y
            if not (run_ends or every_frame):
                continue
            across = c * y - s * x
            yield along, up * across, up * z, p
            if run_ends:
                x, y, z = along, up * across, up * z
                angle, up = 0.0, 1.0

    def _with_tool(self, x: np.ndarray, y: np.ndarray, z: np.ndarray, p: np.ndarray) -> Vectors:
        if np.array_equal(self.tool, np.eye(4)):
            return x, y, z, p
        t = self.tool
        along = [t[0, j] * x + t[1, j] * y + t[2, j] * z for j in range(4)]
        return along[0], along[1], along[2], along[3] + p
