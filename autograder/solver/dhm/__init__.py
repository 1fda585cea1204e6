"""Serial and parallel robots in modified Denavit-Hartenberg: direct and inverse kinematics, every solution or why there is none.

Lengths in metres, angles in radians, arrays batch-first: q (..., n), poses (..., 4, 4). The README is a tour.

>>> import numpy as np
>>> from dhm import DHTable, Robot
>>> half = np.pi / 2
>>> rows = [(0, 0, 0, 0, None), (0, 0, half, 0, None), (0, 0.45, 0, 0, None)]
>>> rows += [(0, 0, -half, 0.45, None), (0, 0, half, 0, None), (0, 0, -half, 0, None)]
>>> arm = Robot(DHTable(rows, name="six axes"))
>>> postures = arm.inverse(arm.forward(np.radians([20, 40, -30, 50, 60, -70])))
>>> len(postures), postures.labels[0]
(8, 'shoulder left, elbow down, wrist unflipped')
"""

from . import equations, orientation, workspace
from .choice import misfits
from .parallel import ThreeRPR, ThreeRRR
from .paul import Derivation, derivation
from .robot import Robot
from .singularities import jacobian, mobility, rank
from .solutions import Batch, Nearest, Solutions
from .status import Failure, Flag, RoundedInput, Status
from .tables import ClassicTable, DHRow, DHTable
from .urdf import UrdfJoint, table_from_urdf
from .urdf_file import table_from_urdf_file

__all__ = [
    "Batch",
    "ClassicTable",
    "DHRow",
    "DHTable",
    "Derivation",
    "Failure",
    "Flag",
    "Nearest",
    "Robot",
    "RoundedInput",
    "Solutions",
    "Status",
    "ThreeRPR",
    "ThreeRRR",
    "UrdfJoint",
    "derivation",
    "equations",
    "jacobian",
    "misfits",
    "mobility",
    "orientation",
    "rank",
    "table_from_urdf",
    "table_from_urdf_file",
    "workspace",
]
