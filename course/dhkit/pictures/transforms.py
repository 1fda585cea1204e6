"""A student's transforms: points, walks, the way back, and numbers read out of a matrix."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..drawing.strokes import keep_in_view, write
from ..drawing.style import INK
from ..drawing.transforms import CLASSIC, MODIFIED, draw_point_in_two_frames, draw_walk, mark_shadow, walk_frames
from ..drawing.view import fit_3d
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
def show_way_back(inverse, values: dict[str, float]):
    """Show the walk from frame i-1 to frame i, and where the given inverse leads from there.

    Parameters
    ----------
    inverse : 4x4 matrix in a, alpha, d, theta
    values : dict
        Numbers for a, d (metres), alpha, theta (radians).

    Returns
    -------
    matplotlib Axes (3D)
        The grey shadow belongs on frame i-1.
    """
    back = numbers(inverse, "inverse", (4, 4), values)
    moves = _moves(MODIFIED, values)
    ax = _with_shadow(moves, walk_frames(moves)[-1] @ back, "grey: where your inverse leads from frame i")
    say_if_not_rigid(ax, back)
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
    shown = np.vstack(
        [frame[:3, 3] + reach * frame[:3, :3].T for frame in (*walk_frames(moves), shadow) for reach in (0, 0.75)]
    )
    fit_3d(ax, shown, own=True, pad=0.4)
    ax.figure.text(0.5, 0.02, caption, ha="center", fontsize=9)
    return ax
