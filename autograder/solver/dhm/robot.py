"""A serial robot: its table, its direct model, and the inverse model that fits it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from . import exchange
from .choice import CLASSES, chosen, misfits
from .elbow import WristedArm
from .exchange import as_poses
from .inverse import TOLERANCE, InverseModel
from .markdown import Markdown, latex
from .one_pose import OnePose
from .singularities import jacobian, mobility
from .solutions import Batch, Nearest, Solutions
from .tables import DHTable
from .urdf_file import table_from_urdf_file, urdf_of


@dataclass(frozen=True, repr=False)
class Robot:
    """A serial robot: a table in modified DH with numbers for its letters, and an inverse model.

    Lengths are in metres, angles in radians. Notebooks show it as its table; `to_markdown` has that in degrees and
    millimetres.

    Attributes
    ----------
    table : DHTable
        Letters for the lengths as one likes, and numbers behind them.
    model : subclass of InverseModel, optional
        The class of its inverse model; by default the one that fits the table, if there is one (`misfits` says what
        each class misses).

    Examples
    --------
    Rows are (sigma, a, alpha, d, theta), sigma 0 for a joint that turns and 1 for one that slides:

    >>> arm = Robot.from_table([(0, 0, 0, 0, None), (0, 500, 0, 0, None)], tool=(400, 0, 0), millimetres=True)
    >>> arm.forward([0, np.pi / 2])[:2, 3].round(3)
    array([0.5, 0.4])
    >>> arm.inverse([0.5, 0.4])
    solved: 2 postures
        0.0000   1.5708  elbow down
        1.3495  -1.5708  elbow up
    """

    table: DHTable
    model: type[InverseModel] | None = None

    @classmethod
    def from_table(
        cls,
        rows: Iterable[Sequence[Any]],
        name: str = "",
        *,
        classic: bool = False,
        degrees: bool = False,
        millimetres: bool = False,
        tool: ArrayLike | None = None,
        **options: Any,
    ) -> Robot:
        """A robot from the rows of its table, as a data sheet has them.

        Parameters
        ----------
        rows : iterable of (sigma, a, alpha, d, theta)
            ``None`` where the joint acts, or an offset plus a symbol. Modified DH: a and alpha belong to the axis before.
        name : str
        classic : bool
            The rows are classic DH: a and alpha lead to the next axis.
        degrees, millimetres : bool
            The unit of the angles and lengths in the rows, tool and limits.
        tool : (4, 4) or (3,) array_like, optional
            Where the tool is in the last frame: a pose, or a point.
        options
            base, limits, joints, values: as for `DHTable`; base and limits in the units that are told, values in metres.

        Raises
        ------
        ValueError
            As `DHTable`, naming the row.
        """
        angle, length = (sp.pi / 180 if degrees else 1), (sp.Rational(1, 1000) if millimetres else 1)
        units = (1, length, angle, length, angle)
        scaled = [
            [entry if entry is None else _scaled(entry, unit) for entry, unit in zip(row, units, strict=True)]
            if len(row) == len(units)
            else row
            for row in map(list, rows)
        ]
        ends = {"tool": tool, "base": options.pop("base", None)}
        ends = {key: None if end is None else _pose(end, length) for key, end in ends.items()}
        made = DHTable.from_classic if classic else DHTable
        limits = options.pop("limits", None)
        table = made(scaled, name=name, **ends, **options)
        if limits is not None:
            moved = [length if table.rows[i].sigma else angle for i in range(len(table.joints))]
            scaled_limits = [
                (float(low * unit), float(high * unit)) for (low, high), unit in zip(limits, moved, strict=True)
            ]
            table = table.with_values(table.values, scaled_limits)
        return cls(table)

    @classmethod
    def from_urdf(cls, path: str | Path, base: str | None = None, tip: str | None = None) -> Robot:
        """A robot from a URDF file: the chain from link `base` to link `tip`, see `table_from_urdf_file`."""
        return cls(table_from_urdf_file(path, base, tip))

    @classmethod
    def from_roboticstoolbox(cls, model: Any) -> Robot:
        """A robot from one of Peter Corke's Robotics Toolbox, see `exchange.from_roboticstoolbox`."""
        return cls(exchange.from_roboticstoolbox(model))

    @classmethod
    def from_pinocchio(cls, model: Any, frame: str | None = None) -> Robot:
        """A robot from a `pinocchio.Model`, up to a frame, see `exchange.from_pinocchio`."""
        return cls(exchange.from_pinocchio(model, frame))

    def to_urdf(self) -> str:
        """The text of a URDF file, see `urdf_file.urdf_of`."""
        return urdf_of(self.table)

    def to_roboticstoolbox(self) -> Any:
        """`roboticstoolbox.DHRobot`, see `exchange.to_roboticstoolbox`."""
        return exchange.to_roboticstoolbox(self.table)

    def to_pinocchio(self) -> Any:
        """`pinocchio.Model`, see `exchange.to_pinocchio`."""
        return exchange.to_pinocchio(self.table)

    def __repr__(self) -> str:
        return f"Robot({self.name or 'without name'}: {self.kind})"

    def to_markdown(self, degrees: bool = False, millimetres: bool = False) -> Markdown:
        """Name, kind and table, which notebooks show typeset, in radians and metres unless told otherwise."""
        factor, unit = (1000, "mm") if millimetres else (1, "m")
        parts = [f"**{self.name or 'Robot'}**: {self.kind}", self.table.to_markdown(degrees, millimetres)]
        lengths = {sp.Symbol(name): value * factor for name, value in self.table.values.items()}
        if lengths:
            parts.append(", ".join(f"${latex(letter)} = {value:.6g}$ {unit}" for letter, value in lengths.items()))
        return Markdown("\n\n".join(parts))

    def _repr_markdown_(self) -> str:
        return self.to_markdown()

    @property
    def name(self) -> str:
        """What the robot is called."""
        return self.table.name

    @property
    def kind(self) -> str:
        """The joints, R for one that turns and P for one that slides, and the class of the inverse model in words."""
        letters = "".join("RP"[row.sigma] for row in self.table.rows if row.variable.has(*self.table.joints))
        model = self.model or chosen(self.table)
        names = [kind for kind, each in CLASSES.items() if each is model]
        return f"{letters}, {names[0] if names else 'no inverse model'}"

    @property
    def has_inverse(self) -> bool:
        """Whether there is a closed-form inverse model of the robot."""
        return (self.model or chosen(self.table)) is not None

    @cached_property
    def inverse_model(self) -> InverseModel:
        """The inverse model. Raises ValueError, which says why, when the robot has none."""
        model = self.model or chosen(self.table)
        if model is not None:
            return model(self.table)
        joints, freedoms = self.table.chain.joints, mobility(self.table)
        found = [
            f"it is no {kind} ({lacking})"
            for kind, lacking in misfits(self.table).items()
            if CLASSES[kind].expected_joints in (None, joints)
        ]
        where = " in closed form"
        if freedoms < min(joints, 6):
            where = ""
            found.insert(0, f"its {joints} joints give {freedoms} freedoms only")
        raise ValueError(f"{self.name or 'this robot'} has no inverse model{where}: {', '.join(found)}")

    def forward(self, q: ArrayLike) -> np.ndarray:
        """Forward kinematics: poses (..., 4, 4) for joint values q (..., n), radians or metres."""
        return self.table.forward(q)

    def symbolic_forward(self) -> sp.Matrix:
        """Forward kinematics, 4x4, with letters for joints and lengths, in textbook form."""
        return self.table.symbolic_forward()

    def symbolic_jacobian(self) -> sp.Matrix:
        """Geometric Jacobian, 6 x n, with letters for joints and lengths: see `DHTable.symbolic_jacobian`."""
        return self.table.symbolic_jacobian()

    def jacobian(self, q: ArrayLike) -> np.ndarray:
        """Geometric Jacobian (..., 6, n) of the tool point at q (..., n): see `singularities.jacobian`."""
        return jacobian(self.table, q)

    def inverse(
        self, T: ArrayLike, near: ArrayLike | None = None, tol: float = TOLERANCE, limits: bool = False
    ) -> Solutions:
        """Inverse kinematics: all postures for one pose, or why there is none.

        Parameters
        ----------
        T : (4, 4) or (m,) array_like
            A rigid transform (an SE3 of spatialmath or Pinocchio too), or m task coordinates where the robot has them
            (a planar arm: x, y; a SCARA: x, y, z, omega). Metres, radians.
        near : (n,) array_like, optional
            Joint values that choose the member of a family, where a joint is free.
        tol : float
            Metres by which the pose may miss the workspace and still count as on its limit.
        limits : bool
            Only postures within the joint limits, in every full turn that they allow.

        Raises
        ------
        ValueError
            For a robot without inverse model, or a pose that is none; it says what is wrong.
        """
        return self.inverse_model.solve(as_poses(T), near, tol, limits)

    def postures(self, T: ArrayLike) -> np.ndarray:
        """The joint values (k, n) of all postures of one pose, as `inverse` lists them, without names and reasons.

        For an elbow arm with a spherical wrist in a small part of its time.
        """
        T = np.asarray(as_poses(T), dtype=float)
        found = self._one_pose(T) if self._one_pose and T.shape == (4, 4) else None
        return self.inverse(T).q if found is None else np.array(found).reshape(-1, 6)

    @cached_property
    def _one_pose(self) -> OnePose | None:
        model = self.inverse_model
        return OnePose(model) if isinstance(model, WristedArm) else None

    def inverse_batch(
        self, T: ArrayLike, near: ArrayLike | None = None, tol: float = TOLERANCE, limits: bool = False
    ) -> Batch:
        """Inverse kinematics of N poses (N, 4, 4) or (N, m) at once, as arrays; parameters as for `inverse`.

        ``near`` may be (N, n). Item i of the result is what `inverse` says of pose i.
        """
        return self.inverse_model.solve_batch(as_poses(T), near, tol, limits)

    def nearest(self, T: ArrayLike, q0: ArrayLike, tol: float = TOLERANCE, limits: bool = False) -> Nearest:
        """The posture for a pose that is nearest to q0 (n,): Euclidean over angle differences (radians) and slides (metres).

        Other parameters as for `inverse`. Without limits, angles count modulo 2 pi.
        """
        return self.inverse_model.nearest(as_poses(T), q0, tol, limits)


def _scaled(entry: Any, unit: sp.Expr | int) -> Any:
    """An entry in SI units: of an expression only the constant part is a number in the unit, joints are not."""
    if unit == 1 or not isinstance(entry, Real | sp.Expr):
        return entry
    entry = sp.sympify(entry)
    constant, rest = entry.as_independent(*entry.free_symbols, as_Add=True) if entry.free_symbols else (entry, 0)
    return rest + float(sp.Rational(str(constant)) * unit)


def _pose(end: ArrayLike, length: sp.Expr | int) -> sp.Matrix:
    """A constant transform from a pose (4, 4) or a point (3,) with lengths in a unit."""
    numbers = np.array(end, dtype=object)
    if numbers.shape == (3,):
        numbers = np.block([[np.eye(3, dtype=object), numbers[:, None]], [np.array([[0, 0, 0, 1]], dtype=object)]])
    pose = sp.Matrix(numbers)
    pose[:3, 3] = pose[:3, 3].applyfunc(lambda entry: _scaled(entry, length))
    return pose
