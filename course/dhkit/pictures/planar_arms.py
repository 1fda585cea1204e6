"""A student's result on the planar arms that are told as walks, on the belt, and with the telescopic arm."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Circle

from ..drawing.planar import mark_frame_2d
from ..drawing.planar_arms import draw_walked_arm, draw_walked_postures
from ..drawing.strokes import draw_arrow, draw_joint, draw_target, leave_room, new_axes, show_plane, write
from ..drawing.style import INK, POSTURE_SHADES, SOFT
from ..geometry import phasor, unit_vector
from ..planar_arms import telescope_targets
from .own_result import called, numbers, numbers_in_rows, own_result


@own_result
def show_belt(times, mine):
    """Show where the part on the belt is at four times, and the limits of reach.

    Parameters
    ----------
    times : 4 numbers, in seconds
    mine : mapping
        L1, L2, belt, start in metres; speed in metres per second.

    Returns
    -------
    matplotlib Axes
        Every mark belongs on one of the circles.
    """
    found = numbers(times, "belt", (4,), {})
    at = mine["start"] + mine["speed"] * found
    ax = new_axes((6.4, 4.4))
    show_plane(ax)
    for radius, dashes in ((mine["L1"] + mine["L2"], "-"), (abs(mine["L1"] - mine["L2"]), (0, (5, 2)))):
        ax.add_patch(Circle((0, 0), radius, fill=False, ec=INK, lw=1, ls=dashes))
        ax.update_datalim([(-radius, -radius), (radius, radius)])
    draw_joint(ax, (0, 0))
    draw_arrow(ax, (mine["start"], mine["belt"]), (max(-mine["start"], *at), mine["belt"]), SOFT, 2.2)
    for place, name, aside in zip(at, ("enters", "lost", "found", "gone"), (0, -0.12, 0.12, 0)):
        draw_target(ax, (place, mine["belt"]))
        write(ax, (place + aside, mine["belt"] + 0.12), name)
    leave_room(ax, 0.1)
    return ax


@own_result
def show_on_walked_arm(transform, arm, values):
    """Show the frame of a transform, 4x4, on a planar arm: it belongs on frame E of the arm.

    Parameters
    ----------
    transform : 4x4 matrix of SymPy expressions or numbers
    arm : str
        A name of `dhkit.planar_arms.ARMS`.
    values : dict
        Numbers for q1, q2, q3, a, b, c, in metres and radians.

    Returns
    -------
    matplotlib Axes
    """
    frame = numbers(transform, "transform", (4, 4), values)
    ax = draw_walked_arm(arm, values, letters=False, words=False)
    draw_target(ax, frame[:2, 3])
    mark_frame_2d(ax, frame, "E", 0.16)
    ax.set_title("your frame E")
    return ax


@own_result
def show_walked_postures(solutions, mine):
    """Show joint solutions of one's own planar arm, and the pose that they should reach.

    Parameters
    ----------
    solutions : rows (q1, q2, q3), in radians and metres
    mine : mapping
        arm; a, b, c, x, y in metres; phi in degrees.

    Returns
    -------
    matplotlib Axes
        Each arm should end on the target, with the frame E.
    """
    rows = numbers_in_rows(solutions, "postures", 3)
    lengths = {name: mine[name] for name in "abc"}
    ax = draw_walked_postures(mine["arm"], lengths, rows, (mine["x"], mine["y"], np.radians(mine["phi"])))
    if not len(rows):
        ax.set_title("no solution given")
    return ax


@own_result
def show_rods(inverse, mine):
    """Show what a function gives for the six targets of the telescopic arm.

    Parameters
    ----------
    inverse : function (x, y, e, d_min, d_max) -> list of (t1, d2)
    mine : mapping
        e, out, back in metres, and the order of the targets.

    Returns
    -------
    matplotlib Axes
        The rod of each solution, and the six targets with their numbers.
    """
    offset, targets = mine["e"], telescope_targets(mine)
    answers = [
        numbers_in_rows(called(inverse, *at, offset, -mine["back"], mine["out"]), "inverse", 2) for at in targets
    ]
    ax = new_axes((5.4, 5.0))
    show_plane(ax)
    ax.add_patch(Circle((0, 0), offset, fill=False, ec=SOFT, lw=1, ls=(0, (5, 2))))
    for number, (at, rows) in enumerate(zip(targets, answers), 1):
        for k, (t1, d2) in enumerate(rows):
            sleeve, end = ((length + 1j * offset) * phasor(t1) for length in (0.0, d2))
            ax.plot(*zip((0, 0), (sleeve.real, sleeve.imag), (end.real, end.imag)), color=INK, lw=3, zorder=3)
            ax.plot(
                *zip((0, 0), (sleeve.real, sleeve.imag), (end.real, end.imag)),
                color=POSTURE_SHADES[k % 2],
                lw=1.4,
                zorder=3.1,
            )
        draw_target(ax, at)
        write(ax, np.array(at) + 0.07 * unit_vector(np.arctan2(at[1], at[0])), f"{number}")
    draw_joint(ax, (0, 0))
    leave_room(ax, 0.1)
    return ax
