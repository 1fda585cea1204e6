"""Reference solver: modified DH tables, direct and inverse models of the course's robots.

``DHTable`` describes a robot, ``robots`` holds those of the documents. Lengths in metres,
angles in radians, arrays batch-first: q (..., n), poses (..., 4, 4).
"""

from . import catalogue as robots
from .catalogue import Robot
from .centres import epfl_centres, rotation_about, scara_centres
from .singularities import jacobian, mobility, rank
from .solutions import STATUS, Batch, Nearest, Solutions
from .tables import ClassicTable, DHRow, DHTable
from .urdf import UrdfJoint, table_from_urdf

__all__ = [
    "STATUS",
    "Batch",
    "ClassicTable",
    "DHRow",
    "DHTable",
    "Nearest",
    "Robot",
    "Solutions",
    "UrdfJoint",
    "epfl_centres",
    "jacobian",
    "mobility",
    "rank",
    "robots",
    "rotation_about",
    "scara_centres",
    "table_from_urdf",
]
