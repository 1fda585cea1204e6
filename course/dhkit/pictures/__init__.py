"""Pictures of a student's own result, to be looked at before it is handed in.

Every ``show_*`` function takes the answer first. It never raises on an answer: an untouched one (``...``, ``None``, a
function that returns nothing) shows "not attempted yet", and one that cannot be drawn shows why. The pictures
compare an answer with the robot, they do not judge it.
"""

from .arms import show_distances, show_on_arm, show_points, show_ranks, show_seen_from, show_zeros
from .direct_models import (
    RX90,
    show_end_effector,
    show_from_frame_2,
    show_marks,
    show_own_forward,
    show_own_turns,
    show_pen_tip,
    show_tool_point,
    show_turned_hand,
)
from .inverse_models import (
    show_all_postures,
    show_determinant,
    show_free_direction,
    show_inverse_of_pose,
    show_own_configurations,
    show_repaired_row,
    show_shoulder,
)
from .orientation import show_rotation, show_rpy_entries, show_triples, show_wrist, show_wrist_formulas
from .parallel_robots import (
    show_3rrr_postures,
    show_leg_lengths,
    show_modes,
    show_platform_joint,
    show_singular,
    show_singular_poses,
)
from .parameters import (
    show_frame,
    show_gripper_at_shelf,
    show_link,
    show_origin,
    show_parallel_axes,
    show_reading,
    show_rewritten,
    show_x_axis,
)
from .pen import show_circles, show_height, show_pen_inverse, show_tip, show_trace
from .planar import show_inverse, show_on_planar_arm, show_postures, show_theta1
from .planar_arms import show_belt, show_on_walked_arm, show_rods, show_walked_postures
from .scara import show_on_scara, show_scara_forward
from .scara_s600 import show_classic, show_configurations, show_mgi, show_misfits, show_on_own_scara
from .tables import (
    show_chain,
    show_classic_rows,
    show_dh_matrix,
    show_freedoms,
    show_gripper_frame,
    show_on_origins,
    show_planar,
    show_table,
)
from .transforms import show_classic_matrix, show_own_dhm, show_parameters, show_point, show_walk, show_way_to_part
from .workspace import show_area, show_cloud, show_count, show_point_function, show_reach_range, show_section

__all__ = [
    "RX90",
    "show_3rrr_postures",
    "show_all_postures",
    "show_area",
    "show_belt",
    "show_chain",
    "show_circles",
    "show_classic",
    "show_classic_matrix",
    "show_classic_rows",
    "show_cloud",
    "show_configurations",
    "show_count",
    "show_determinant",
    "show_dh_matrix",
    "show_distances",
    "show_end_effector",
    "show_frame",
    "show_free_direction",
    "show_freedoms",
    "show_from_frame_2",
    "show_gripper_at_shelf",
    "show_gripper_frame",
    "show_height",
    "show_inverse",
    "show_inverse_of_pose",
    "show_leg_lengths",
    "show_link",
    "show_marks",
    "show_mgi",
    "show_misfits",
    "show_modes",
    "show_on_arm",
    "show_on_origins",
    "show_on_own_scara",
    "show_on_planar_arm",
    "show_on_scara",
    "show_on_walked_arm",
    "show_origin",
    "show_own_configurations",
    "show_own_dhm",
    "show_own_forward",
    "show_own_turns",
    "show_parallel_axes",
    "show_parameters",
    "show_pen_inverse",
    "show_pen_tip",
    "show_planar",
    "show_platform_joint",
    "show_point",
    "show_point_function",
    "show_points",
    "show_postures",
    "show_ranks",
    "show_reach_range",
    "show_reading",
    "show_repaired_row",
    "show_rewritten",
    "show_rods",
    "show_rotation",
    "show_rpy_entries",
    "show_scara_forward",
    "show_section",
    "show_seen_from",
    "show_shoulder",
    "show_singular",
    "show_singular_poses",
    "show_table",
    "show_theta1",
    "show_tip",
    "show_tool_point",
    "show_trace",
    "show_triples",
    "show_turned_hand",
    "show_walk",
    "show_walked_postures",
    "show_way_to_part",
    "show_wrist",
    "show_wrist_formulas",
    "show_x_axis",
    "show_zeros",
]
