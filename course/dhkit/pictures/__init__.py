"""Pictures of a student's own result, to be looked at before it is handed in.

Every ``show_*`` function takes the answer first. It never raises on an answer: an untouched one (``...``, ``None``, a
function that returns nothing) shows "not attempted yet", and one that cannot be drawn shows why. The pictures
compare an answer with the robot, they do not judge it.
"""

from .planar import (
    show_cos_theta2,
    show_inverse,
    show_on_planar_arm,
    show_postures,
    show_reach,
    show_theta1,
)
from .scara import (
    show_on_scara,
    show_scara_forward,
)
from .tables import (
    show_dh_matrix,
    show_table,
)

__all__ = [
    "show_cos_theta2",
    "show_dh_matrix",
    "show_inverse",
    "show_on_planar_arm",
    "show_on_scara",
    "show_postures",
    "show_reach",
    "show_scara_forward",
    "show_table",
    "show_theta1",
]
