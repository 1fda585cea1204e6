"""Which closed-form inverse model fits a table: the classes there are, and what each of them misses."""

from __future__ import annotations

from .decoupled import Decoupled, PointArm
from .elbow import ElbowArm, WristAlone, WristedArm
from .general import GeneralArm
from .inverse import InverseModel
from .pen import PenArm
from .planar_arms import PlanarArm, Scara
from .redundant import RedundantArm
from .tables import DHTable

CLASSES: dict[str, type[InverseModel]] = {
    "planar arm": PlanarArm,
    "SCARA": Scara,
    "elbow arm": ElbowArm,
    "elbow arm with a spherical wrist": WristedArm,
    "spherical wrist": WristAlone,
    "pen robot": PenArm,
    "arm of three joints for a point": PointArm,
    "decoupled arm": Decoupled,
    "arm of six turns": GeneralArm,
    "arm of seven joints": RedundantArm,
}
"""The classes of robots that have a closed-form inverse model, by their names."""


def misfits(table: DHTable) -> dict[str, str]:
    """Every class of robots with a closed-form inverse model, and what the table lacks to be one; "" where it is one.

    Raises ValueError naming the letters of the table that have no value.
    """
    _ = table.chain  # a table without numbers is no misfit: it says so here
    return {name: _misfit(model, table) for name, model in CLASSES.items()}


def _misfit(model: type[InverseModel], table: DHTable) -> str:
    try:
        model(table)
    except ValueError as error:
        return str(error)
    return ""


def chosen(table: DHTable) -> type[InverseModel] | None:
    """The class that fits a table, None where none does."""
    _ = table.chain
    return next((model for model in CLASSES.values() if not _misfit(model, table)), None)
