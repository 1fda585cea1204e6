"""A serial robot: its table, its direct model, and the inverse model that fits it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from .choice import CLASSES, chosen, misfits
from .elbow import WristedArm
from .inverse import TOLERANCE, InverseModel
from .one_pose import OnePose
from .singularities import jacobian, mobility
from .solutions import Batch, Nearest, Solutions
from .tables import DHTable


@dataclass(frozen=True)
class Robot:
    """A serial robot: a DHm table with values for its letters, and an inverse model.

    Attributes
    ----------
    table : DHTable
        Letters for the lengths as in the documents, and numbers behind them.
    model : subclass of InverseModel, optional
        The class of its closed-form inverse model; by default the one that fits the table, if there is one (`misfits`
        says what each class misses).
    """

    table: DHTable
    model: type[InverseModel] | None = None

    @property
    def name(self) -> str:
        """What the robot is called."""
        return self.table.name

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

    def jacobian(self, q: ArrayLike) -> np.ndarray:
        """Geometric Jacobian (..., 6, n) of the tool point at q (..., n): see `singularities.jacobian`."""
        return jacobian(self.table, q)

    def inverse(
        self, T: ArrayLike, near: ArrayLike | None = None, tol: float = TOLERANCE, limits: bool = False
    ) -> Solutions:
        """Inverse kinematics: all postures for a pose (4, 4) or task coordinates, see `InverseModel.solve`."""
        return self.inverse_model.solve(T, near, tol, limits)

    def postures(self, T: ArrayLike) -> np.ndarray:
        """The joint values (k, n) of all postures of one pose, as `inverse` lists them, without names and reasons.

        For an elbow arm with a spherical wrist in a small part of its time.
        """
        T = np.asarray(T, dtype=float)
        found = self._one_pose(T) if self._one_pose and T.shape == (4, 4) else None
        return self.inverse(T).q if found is None else np.array(found).reshape(-1, 6)

    @cached_property
    def _one_pose(self) -> OnePose | None:
        model = self.inverse_model
        return OnePose(model) if isinstance(model, WristedArm) else None

    def inverse_batch(
        self, T: ArrayLike, near: ArrayLike | None = None, tol: float = TOLERANCE, limits: bool = False
    ) -> Batch:
        """Inverse kinematics of N poses at once: see `InverseModel.solve_batch`."""
        return self.inverse_model.solve_batch(T, near, tol, limits)

    def nearest(self, T: ArrayLike, q0: ArrayLike, tol: float = TOLERANCE, limits: bool = False) -> Nearest:
        """The posture for a pose that is nearest to q0 (n,): see `InverseModel.nearest`."""
        return self.inverse_model.nearest(T, q0, tol, limits)
