"""Drawings of the course: arms and robots, frames and parameters, workspaces, and what lies behind their models.

Every ``draw_*`` function takes lengths in metres and angles in radians, makes its own figure unless it is
given `ax`, and returns the Axes. Bad input raises `ValueError` with the awaited form in words. ``mark_*`` functions add
to a drawing.

One style for the whole course: x red and solid, y green and dashed, z blue and dash-dotted, all labelled, so
that a grey print and a colour-blind reader lose nothing. Links are grey; darker means a later posture.
"""

from .arms import arm_curve, draw_arm, end_frame, mark_curve
from .chains import chain_frames, draw_chain
from .elbow_workspace import draw_elbow_workspace, draw_section
from .frames import draw_dh_parameters, draw_frames_3d, mark_frame, mark_path
from .gimbal import draw_gimbal
from .gripper import draw_gripper
from .machines import draw_machine
from .orientation import draw_atan2, draw_brick_turns, draw_bricks, draw_flip, draw_top, turn_in_steps
from .parallel import draw_3rpr, draw_3rrr, draw_assembly_modes, draw_coupler_curve, draw_leg_lines, platform_points
from .parameter_steps import draw_parameter_steps
from .pen import PEN_SIZES, draw_pen_robot, draw_pen_sheet, draw_pen_views, pen_tip
from .planar import (
    draw_planar_arm,
    draw_postures,
    draw_triangle_2r,
    draw_workspace_2r,
    mark_frame_2d,
    mark_hands,
    mark_target,
)
from .planar_2r import count_postures, grid_points
from .planar_arms import draw_walked_arm
from .postures import (
    draw_aligned_wrist,
    draw_arm_plane,
    draw_planar_family,
    draw_posture_family,
    draw_posture_gallery,
    draw_shoulder_top,
)
from .scara import draw_scara_3d, draw_scara_projections, draw_scara_side, draw_scara_top, scara_frames
from .scara_s600 import draw_s600_side, draw_s600_top, draw_type8
from .scara_tasks import draw_own_scara
from .scenes import draw_parallel_axes, draw_reading, draw_shelf
from .six_axes import draw_six_axes
from .statements import draw_marks_by_line
from .tables import draw_joint_origins, draw_two_readings
from .transforms import (
    draw_conventions,
    draw_elementary_moves,
    draw_point_in_two_frames,
    draw_two_orders,
    draw_walk,
    mark_shadow,
)
from .turns import draw_arm_turns, draw_turn_about
from .two_axes import draw_axis_cases, draw_two_axes
from .workspace import (
    draw_clouds,
    draw_dexterous,
    draw_joint_grid,
    draw_posture_change,
    draw_posture_count,
    draw_radius,
    draw_sheets,
    mark_edges,
)

__all__ = [
    "PEN_SIZES",
    "arm_curve",
    "chain_frames",
    "count_postures",
    "draw_3rpr",
    "draw_3rrr",
    "draw_aligned_wrist",
    "draw_arm",
    "draw_arm_plane",
    "draw_arm_turns",
    "draw_assembly_modes",
    "draw_atan2",
    "draw_axis_cases",
    "draw_brick_turns",
    "draw_bricks",
    "draw_chain",
    "draw_clouds",
    "draw_conventions",
    "draw_coupler_curve",
    "draw_dexterous",
    "draw_dh_parameters",
    "draw_elbow_workspace",
    "draw_elementary_moves",
    "draw_flip",
    "draw_frames_3d",
    "draw_gimbal",
    "draw_gripper",
    "draw_joint_grid",
    "draw_joint_origins",
    "draw_leg_lines",
    "draw_machine",
    "draw_marks_by_line",
    "draw_own_scara",
    "draw_parallel_axes",
    "draw_parameter_steps",
    "draw_pen_robot",
    "draw_pen_sheet",
    "draw_pen_views",
    "draw_planar_arm",
    "draw_planar_family",
    "draw_point_in_two_frames",
    "draw_posture_change",
    "draw_posture_count",
    "draw_posture_family",
    "draw_posture_gallery",
    "draw_postures",
    "draw_radius",
    "draw_reading",
    "draw_s600_side",
    "draw_s600_top",
    "draw_scara_3d",
    "draw_scara_projections",
    "draw_scara_side",
    "draw_scara_top",
    "draw_section",
    "draw_sheets",
    "draw_shelf",
    "draw_shoulder_top",
    "draw_six_axes",
    "draw_top",
    "draw_triangle_2r",
    "draw_turn_about",
    "draw_two_axes",
    "draw_two_orders",
    "draw_two_readings",
    "draw_type8",
    "draw_walk",
    "draw_walked_arm",
    "draw_workspace_2r",
    "end_frame",
    "grid_points",
    "mark_curve",
    "mark_edges",
    "mark_frame",
    "mark_frame_2d",
    "mark_hands",
    "mark_path",
    "mark_shadow",
    "mark_target",
    "pen_tip",
    "platform_points",
    "scara_frames",
    "turn_in_steps",
]
