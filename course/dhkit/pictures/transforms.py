"""A student's transforms: points, walks, the way back, and numbers read out of a matrix."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..drawing.frames import draw_frames_3d
from ..drawing.strokes import keep_in_view, write
from ..drawing.style import DASHED, INK, SOFT
from ..drawing.transforms import CLASSIC, MODIFIED, draw_point_in_two_frames, draw_walk, mark_shadow, walk_frames
from ..drawing.view import fit_3d
from ..geometry import modified_dh, rigid_transform, rotation
from .own_result import called, numbers, own_result, say_if_not_rigid

SIZE = 0.5


@own_result
def show_point(point, shift, turn, in_B):
    """Show the coordinates of a point in frame A, as a cross beside the two frames and the point.

    Parameters
    ----------
    point : 2 entries, in metres
    shift, in_B : (float, float), in metres
        Origin of frame B in A; the point in B.
    turn : float, in radians

    Returns
    -------
    matplotlib Axes
        The cross belongs on P.
    """
    found = numbers(point, "point", (2,), {})
    ax = draw_point_in_two_frames(shift, turn, in_B)
    ax.plot(*found, marker="x", ms=15, mew=2.4, color=INK, zorder=9)
    write(ax, found + (-0.09, -0.07), "yours", fontsize=10)
    keep_in_view(ax, found, 0.2)
    return ax


@own_result
def show_walk(arguments, kinds: Sequence[str], values: dict[str, float]):
    """Show the walk that four moves with the given arguments make, over the frame where it should end.

    Parameters
    ----------
    arguments : 4 entries in a, alpha, d, theta
    kinds : sequence of 4 texts
        "trans_x", "rot_x", "trans_z" or "rot_z", in the order of the walk.
    values : dict
        Numbers for a, d (metres), alpha, theta (radians).

    Returns
    -------
    matplotlib Axes (3D)
        Frame i belongs on the grey shadow.
    """
    moves = list(zip(kinds, numbers(arguments, "arguments", (4,), values)))
    goal = walk_frames(_moves(MODIFIED, values))[-1]
    return _with_shadow(moves, goal, "colour: your walk; grey: where it should end")


@own_result
def show_way_to_part(transform, mine):
    """Show base, camera, gripper and part, and where the given transform leads from the gripper.

    Parameters
    ----------
    transform : 4x4 matrix
        The part, seen from the gripper.
    mine : dict
        The numbers of the statement: lengths in metres, angles in degrees.

    Returns
    -------
    matplotlib Axes (3D)
        The grey shadow belongs on the frame of the part.
    """
    found = numbers(transform, "transform", (4, 4), {})
    camera = rigid_transform([[0, 1, 0], [1, 0, 0], [0, 0, -1]], [mine[name] for name in ("cx", "cy", "cz")])
    in_camera = rigid_transform(rotation("z", np.radians(mine["psi"])), [mine[name] for name in "uvw"])
    gripper = modified_dh(mine["a"], np.radians(mine["alpha"]), mine["d"], np.radians(mine["theta"]))
    frames = [np.eye(4), camera, gripper, camera @ in_camera]
    ax = draw_frames_3d(frames, ["0", "C", "G", "P"], size=0.25, links=False)
    for start, end in ((0, 2), (0, 1), (1, 3)):
        ax.plot(*zip(frames[start][:3, 3], frames[end][:3, 3]), color=SOFT, lw=1, ls=DASHED, zorder=2)
    mark_shadow(ax, gripper @ found, 0.25)
    fit_3d(ax, _ends([*frames, gripper @ found], 0.3), own=True, pad=0.3)
    ax.figure.text(
        0.5,
        0.02,
        "dashed: the ways that are known; grey: where your matrix leads from the gripper",
        ha="center",
        fontsize=9,
    )
    say_if_not_rigid(ax, found)
    return ax


@own_result
def show_own_dhm(my_dhm, row: Sequence[float], q: float):
    """Show the walk of one row at a joint value, and the frame of a function of one's own.

    Parameters
    ----------
    my_dhm : function (row, q) -> 4x4 matrix
    row : [sigma, a, alpha, d, theta]
    q : float

    Returns
    -------
    matplotlib Axes (3D)
        The grey shadow belongs on frame i.
    """
    frame = numbers(called(my_dhm, list(row), q), "my_dhm", (4, 4), {})
    sigma, a, alpha, d, theta = row
    values = {"a": a, "alpha": alpha, "d": d + sigma * q, "theta": theta + (1 - sigma) * q}
    ax = _with_shadow(_moves(MODIFIED, values), frame, "colour: the walk of the row; grey: your function")
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_classic_matrix(matrix, values: dict[str, float]):
    """Show the classic walk from frame i-1 to frame i, and the frame of a classic matrix.

    Parameters
    ----------
    matrix : 4x4 matrix in a, alpha, d, theta
    values : dict
        Numbers for a, d (metres), alpha, theta (radians).

    Returns
    -------
    matplotlib Axes (3D)
        The grey shadow belongs on frame i.
    """
    frame = numbers(matrix, "matrix", (4, 4), values)
    ax = _with_shadow(_moves(CLASSIC, values), frame, "colour: the classic walk; grey: your matrix")
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_parameters(parameters, values: dict[str, float]):
    """Show the walk with the four numbers that a function reads out of a matrix, over the frame of that matrix.

    Parameters
    ----------
    parameters : function (T: 4x4 nested list) -> a, alpha, d, theta
    values : dict
        The a, alpha, d, theta that T is made of.

    Returns
    -------
    matplotlib Axes (3D)
        Frame i belongs on the grey shadow.
    """
    goal = walk_frames(_moves(MODIFIED, values))[-1]
    found = numbers(called(parameters, goal.tolist()), "a, alpha, d, theta", (4,), {})
    return _with_shadow(list(zip(MODIFIED, found)), goal, "colour: the walk with your four numbers; grey: the matrix")


def _moves(kinds, values):
    return [
        (kind, values[{"trans_x": "a", "rot_x": "alpha", "trans_z": "d", "rot_z": "theta"}[kind]]) for kind in kinds
    ]


def _with_shadow(moves, shadow, caption):
    """A walk, and a frame as a grey shadow, both in view."""
    ax = draw_walk(moves, size=SIZE)
    mark_shadow(ax, shadow, SIZE)
    fit_3d(ax, _ends([*walk_frames(moves), shadow], 0.75), own=True, pad=0.4)
    ax.figure.text(0.5, 0.02, caption, ha="center", fontsize=9)
    return ax


def _ends(frames, size):
    """Origins of frames and the tips of their axes, shape (n, 3)."""
    return np.vstack([frame[:3, 3] + reach * frame[:3, :3].T for frame in frames for reach in (0, size)])
