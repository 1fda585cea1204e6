"""The inverse model of a robot, written out as one does it by hand: step by step, with the type of each equation.

>>> from dhm import Robot, derivation
>>> arm = Robot.from_table([(0, 0, 0, 0, None), (0, 0.5, 0, 0, None)], "two links", tool=(0.4, 0, 0))
>>> found = derivation(arm)
>>> [(step.kind, step.unknowns) for step in found.steps]
[(8, (theta_2, theta_1))]
>>> "C_{1}" in found.to_markdown()
True
>>> program = {}
>>> exec(found.to_python(), program)
>>> program["postures"](arm.forward([0.3, 0.8])).round(3)
array([[ 0.3  ,  0.8  ],
       [ 1.006, -0.8  ]])
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..general import GeneralArm
from ..markdown import Markdown
from ..redundant import RedundantArm
from ..robot import Robot
from ..tables import DHTable
from . import program, words
from .closure import Closure, Equation, Solved, Step
from .setting import Setting, setting_of

__all__ = ["Derivation", "Equation", "Solved", "Step", "derivation"]


@dataclass(frozen=True)
class Derivation:
    """The inverse model of a robot by Paul's method. Notebooks show it typeset.

    Attributes
    ----------
    setting : Setting
        The table in letters, and what is given.
    steps : tuple of Step
        In the order in which they are done; empty where the method ends before all joints are found.
    why : str
        Why there are no steps, in words; "" where there are.
    """

    setting: Setting
    steps: tuple[Step, ...]
    why: str = ""

    @property
    def kinds(self) -> tuple[int, ...]:
        """The types of the equations, 1 to 8, step by step."""
        return tuple(step.kind for step in self.steps)

    def to_markdown(self) -> Markdown:
        """All of it in Markdown with LaTeX."""
        return Markdown(words.written(self.setting, self.steps, self.why))

    def _repr_markdown_(self) -> str:
        return self.to_markdown()

    def to_python(self) -> str:
        """A Python program that runs alone, with NumPy: ``postures(T)`` returns all joint values (k, n) for a pose (4, 4).

        Of a family it gives the members whose free angle is ``free``, by default 0; there may be none with that one.

        Raises ValueError where there are no steps, or letters without value.
        """
        if not self.steps:
            raise ValueError(self.why)
        return program.written(self.setting, self.steps)


def derivation(robot: Robot | DHTable) -> Derivation:
    """The inverse model of a robot by Paul's method.

    Parameters
    ----------
    robot : Robot or DHTable
        With numbers; those in the table get letters (a_2, d_4, ...).

    Returns
    -------
    Derivation
        Without steps, and with the reason, for robots that are solved by elimination only: no equations of types 1 to 8
        lead to their joints.

    Raises
    ------
    ValueError
        For a robot without inverse model, or whose joints move several rows.
    """
    robot = Robot(robot) if isinstance(robot, DHTable) else robot
    model = robot.inverse_model
    setting = setting_of(robot.table, point=model.task in ("x, y", "x, y, z"))
    if isinstance(model, GeneralArm | RedundantArm):
        return Derivation(setting, (), f"{robot.name or 'This robot'} {_NUMERIC[type(model)]}")
    try:
        return Derivation(setting, tuple(Closure(setting.rows, setting.unknowns, setting.tip).steps()))
    except ValueError as error:
        return Derivation(setting, (), f"{robot.name or 'This robot'} is solved by elimination only: {error}.")


_NUMERIC: Mapping[type, str] = {
    GeneralArm: "is solved by elimination only: its joints are the roots of a polynomial of degree up to 16, which has no "
    "closed form.",
    RedundantArm: "has seven joints for six freedoms: one of them is chosen, and the others follow by elimination.",
}
