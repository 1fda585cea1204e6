"""Two chains to be laid on one another, and what that may use."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .frames import JudgedChain
from .freedoms import Freedom, Price
from .linear import transposed


@dataclass(frozen=True, eq=False)
class Problem:
    """Lay the links of `student` on those of `reference`, joint types being the same. Joints count from 0.

    Attributes
    ----------
    student, reference : JudgedChain
    prescribed : (n,) array
        +1 or -1 where the sense of an axis is prescribed, 0 where it is not.
    price : Price
    tolerance : float
        Radians, and lengths relative to the larger of 1 m and the robot.
    """

    student: JudgedChain
    reference: JudgedChain
    prescribed: np.ndarray
    price: Price
    tolerance: float

    def price_at(self, freedom: Freedom, joint: int) -> float:
        """The price of a freedom at a joint."""
        return self.price(freedom, joint + 1)

    def is_free(self, freedom: Freedom, joint: int) -> bool:
        """Whether a freedom may be used at a joint."""
        return bool(np.isfinite(self.price_at(freedom, joint)))

    @property
    def price_of_base(self) -> float:
        """The price of another base frame."""
        return self.price(Freedom.BASE, 0)

    @property
    def price_of_tool(self) -> float:
        """The price of another tool frame."""
        return self.price(Freedom.TOOL, 0)

    @cached_property
    def length_tolerance(self) -> float:
        """Metres."""
        return self.tolerance * self.reference.size

    @cached_property
    def motor_senses(self) -> np.ndarray:
        """+1 where a joint variable turns both joints the same way about their own axes, -1 or 0 otherwise, (n,)."""
        return np.sign((self.student.coupling * self.reference.coupling).sum(axis=1))

    def is_end(self, joint: int) -> bool:
        """Whether the frame of a joint is the end of both tables: it then is the tool frame that changes with it."""
        last = joint == self.reference.joints - 1
        return last and self.student.ends_with_joint and self.reference.ends_with_joint

    @cached_property
    def end_rotation(self) -> np.ndarray:
        """Rotation of the hand that leaves the tool frame as it is, (K, 3, 3)."""
        return self.reference.end[:, :3, :3] @ transposed(self.student.end[:, :3, :3])

    def agree(self, rotations: np.ndarray, others: np.ndarray) -> np.ndarray:
        """Where rotations (or unit vectors) are equal within the tolerance: (c, K, ...) -> bool (c,)."""
        return (np.abs(rotations - others) <= self.tolerance).all(axis=tuple(range(1, rotations.ndim)))
