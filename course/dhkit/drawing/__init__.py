"""Drawings of the course: planar arms, workspaces, kinematic sketches and frames in three dimensions.

Every ``draw_*`` function takes lengths in metres and angles in radians, makes its own figure unless it is
given `ax`, and returns the Axes. Bad input raises `ValueError` with the awaited form in words. ``mark_*`` functions add
to a drawing.

One style for the whole course: x red and solid, y green and dashed, z blue and dash-dotted, all labelled, so
that a grey print and a colour-blind reader lose nothing. Links are grey; darker means a later posture.
"""

from .frames import (
    draw_dh_parameters,
    draw_frames_3d,
    mark_frame,
    mark_path,
)
from .planar import (
    draw_planar_arm,
    draw_postures,
    draw_triangle_2r,
    draw_workspace_2r,
    mark_frame_2d,
    mark_hands,
    mark_target,
    planar_points,
)
from .scara import (
    draw_scara_3d,
    draw_scara_projections,
    draw_scara_side,
    draw_scara_top,
    scara_frames,
)

__all__ = [
    "draw_dh_parameters",
    "draw_frames_3d",
    "draw_planar_arm",
    "draw_postures",
    "draw_scara_3d",
    "draw_scara_projections",
    "draw_scara_side",
    "draw_scara_top",
    "draw_triangle_2r",
    "draw_workspace_2r",
    "mark_frame",
    "mark_frame_2d",
    "mark_hands",
    "mark_path",
    "mark_target",
    "planar_points",
    "scara_frames",
]
