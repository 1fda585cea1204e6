"""A student's frames and parameters, in the scenes of the parameter rules."""

from __future__ import annotations

import numpy as np

from ..drawing.chains import chain_frames, draw_chain
from ..drawing.inputs import as_line
from ..drawing.labels import Labels
from ..drawing.scenes import (
    add_frame,
    add_gripper,
    add_parallel_axes,
    add_reading,
    add_shelf,
    draw_thin_line,
    finish_scene,
    new_scene,
)
from ..drawing.strokes_3d import draw_arrow_3d, draw_target_3d
from ..drawing.style import AXIS_COLOURS, INK
from ..drawing.two_axes import add_axis, add_two_axes, link_direction
from ..drawing.view import fill_panel, new_panels_3d
from ..geometry import common_normal, rigid_transform
from .own_result import called, numbers, own_result, say_if_not_rigid


def _mark(ax, labels, at, text, out=(1, 0, 0.6)):
    """The student's point: a cross in a circle."""
    draw_target_3d(ax, at, zorder=8)
    labels.ask(at, text, out, gap=12)


@own_result
def show_reading(parameters, reach, tilt, drop, turn):
    """Show frame 2 where the student's four parameters put it, over the frames that they were read from.

    Parameters
    ----------
    parameters : [a, alpha, d, theta], in metres and radians
    reach, tilt, drop, turn : as in `draw_reading`

    Returns
    -------
    matplotlib Axes (3D)
        The thick arrows belong on the drawn frame 2.
    """
    a, alpha, d, theta = numbers(parameters, "reading", (4,), {})
    ax, labels, extent = new_scene((20, -50))
    extent.append(add_reading(ax, labels, reach, tilt, drop, turn))
    frame = chain_frames([[0, a, alpha, d, theta]])[1]
    for letter, column in (("x", 0), ("z", 2)):
        end = frame[:3, 3] + 0.36 * reach * frame[:3, column]
        draw_arrow_3d(ax, frame[:3, 3], end, AXIS_COLOURS[letter], width=4.5, scale=18, zorder=4)
        extent.append(end[None])
    _mark(ax, labels, frame[:3, 3], "your frame 2", -frame[:3, 0] + 0.3 * frame[:3, 2])
    extent.append(frame[None, :3, 3])
    return finish_scene(ax, labels, extent)


def _two_axes(first, second, view=(20, -58)):
    ax, labels, extent = new_scene(view)
    first, second = as_line(first, "first axis"), as_line(second, "second axis")
    bare = {"normal": False, "frame": False, "angle": False}
    extent.append(add_two_axes(ax, labels, first, second, body=True, base=True, points=("P", "Q"), **bare))
    return ax, labels, extent, (first[1], second[1])


@own_result
def show_origin(origin, first, second):
    """Show the student's origin O1, on the axes Z1 and Z2.

    Parameters
    ----------
    origin : 3 numbers, in metres
    first, second : (point, direction)

    Returns
    -------
    matplotlib Axes (3D)
    """
    at = numbers(origin, "origin", (3,), {})
    ax, labels, extent, _ = _two_axes(first, second)
    _mark(ax, labels, at, "your $O_{1}$", (-1, 0, 0.3))
    return finish_scene(ax, labels, [*extent, at[None]])


@own_result
def show_x_axis(x_axis, origin, first, second):
    """Show the student's X1, leaving from the student's O1 (from P, if there is none), and the line that it lies on.

    Parameters
    ----------
    x_axis : 3 numbers
    origin : 3 numbers, in metres, or ...
    first, second : (point, direction)

    Returns
    -------
    matplotlib Axes (3D)
        The dashed line belongs on Z2, and the arrow on the side of Z2.
    """
    x = numbers(x_axis, "x_axis", (3,), {})
    try:
        at = numbers(origin, "origin", (3,), {})
    except Exception:
        at = np.asarray(first[0], dtype=float)
    ax, labels, extent, (u, v) = _two_axes(first, second)
    size = 0.3 * np.linalg.norm(np.subtract(second[0], first[0]))
    ends = np.array([at, at + size * x])
    add_axis(ax, labels, at, x, size, "x", "1", width=2.4)
    if np.linalg.norm(x) > 1e-9:
        way = x / np.linalg.norm(x)
        ends = np.vstack([ends, at - 3.2 * size * way, at + 3.2 * size * way])
        draw_thin_line(ax, ends[2], ends[3])
    ax.plot(*at[:, None], "o", ms=5.5, color=INK, zorder=8)
    x = np.round(x, 6) + 0.0
    along_u, along_v = (round(x @ along, 5) + 0 for along in (u, v))
    told = f"length {np.linalg.norm(x):.3f},  $X_1 \\cdot u$ = {along_u:.3f},  $X_1 \\cdot v$ = {along_v:.3f}"
    told += "  (u, v of length 1)"
    ax.figure.text(0.5, 0.005, told.replace("-", "\N{MINUS SIGN}"), ha="center", fontsize=9)
    return finish_scene(ax, labels, [*extent, ends])


@own_result
def show_parallel_axes(parallel, gap, side, height):
    """Show the student's O1 at the height z1, and X1 with the length a1 from there, between two vertical axes.

    Parameters
    ----------
    parallel : [a1, z1], in metres
    gap, side, height : as in `draw_parallel_axes`

    Returns
    -------
    matplotlib Axes (3D)
        The line belongs between Z1 and Z2, and ends where X2 begins.
    """
    a, z = numbers(parallel, "parallel", (2,), {})
    ax, labels, extent = new_scene((20, -70))
    extent.append(add_parallel_axes(ax, labels, gap, side, height))
    start = np.array([0, 0, z])
    end = start + a * np.array([gap, side, 0]) / np.hypot(gap, side)
    ax.plot(*zip(start, end), color=INK, lw=2.8, zorder=6, solid_capstyle="round")
    _mark(ax, labels, start, "your $O_{1}$", (-1, 0, 0.3))
    labels.ask((start + end) / 2, "your $a_{1}$", (0, 0, 1), gap=8)
    return finish_scene(ax, labels, [*extent, np.array([start, end])])


@own_result
def show_frame(frame, first, second, view=(18, -22)):
    """Show the student's frame 1, at the axes Z1 and Z2.

    Parameters
    ----------
    frame : 4x4 numbers
    first, second : (point, direction)
    view : (elevation, azimuth), in degrees

    Returns
    -------
    matplotlib Axes (3D)
    """
    matrix = numbers(frame, "frame", (4, 4), {})
    ax, labels, extent, _ = _two_axes(first, second, view)
    extent.append(add_frame(ax, labels, matrix, "1", 0.3 * np.linalg.norm(np.subtract(second[0], first[0])), "xy", 2.4))
    ax.plot(*matrix[:3, 3:], "o", ms=5.5, color=INK, zorder=8)
    labels.ask(matrix[:3, 3], "your $O_{1}$", -matrix[:3, 0] - matrix[:3, 1], gap=8)
    finish_scene(ax, labels, extent)
    say_if_not_rigid(ax, matrix)
    return ax


@own_result
def show_rewritten(table, printed, values: dict[str, float]):
    """Show two robots side by side: the printed table, and the student's.

    Parameters
    ----------
    table, printed : rows [sigma, a, alpha, d, theta], numbers or SymPy; metres and radians
    values : dict
        Numbers for the symbols of the tables, by name.

    Returns
    -------
    list of 2 matplotlib Axes (3D)
        The bodies belong in the same place; X axes may point the other way.
    """
    cells = numbers(table, "table", (None, 5), values)
    panels = new_panels_3d(["printed", "yours"], width=4.2, height=4.6)
    for ax, robot in zip(panels, (printed, cells)):
        draw_chain(robot, values, ax, frames=(1, 2, 3))
    return panels


@own_result
def show_gripper_at_shelf(frame, yaw, height):
    """Show a gripper that sits on the student's frame E, at the shelf.

    Parameters
    ----------
    frame : 4x4 numbers
    yaw, height : as in `draw_shelf`

    Returns
    -------
    matplotlib Axes (3D)
    """
    matrix = numbers(frame, "gripper", (4, 4), {})
    ax, labels, extent = new_scene((24, -100))
    extent.append(add_shelf(ax, labels, yaw, height))
    extent.append(add_gripper(ax, matrix))
    extent.append(add_frame(ax, labels, matrix, "E", 0.3, width=2.4))
    extent.append(add_frame(ax, labels, np.eye(4), "0", 0.25))
    finish_scene(ax, labels, extent)
    say_if_not_rigid(ax, matrix)
    return ax


PAIRS = (
    ("skew", ([0, 0, 0.5], [0, 0, 1]), ([0.8, 0.3, 0.4], [0, 0.6, 0.8])),
    ("parallel", ([0, 0, 0.2], [0, 0, 1]), ([0.7, 0.2, 0.4], [0, 0, 1])),
    ("meeting", ([0, 0, -0.3], [0, 0, 1]), ([0.5, 0, 0.3], [1, 0, 0.2])),
)


@own_result
def show_link(link):
    """Show Z2 where the student's a and alpha put it, over the right axis, for three pairs of axes.

    Parameters
    ----------
    link : function (P, u, Q, v) -> [a, alpha]

    Returns
    -------
    list of 3 matplotlib Axes (3D)
        The thick dark line belongs on the axis Z2.
    """
    found = []
    for _, (p, u), (q, v) in PAIRS:
        found.append(numbers(called(link, *map(list, (p, u, q, v))), "link", (2,), {}))
    panels = new_panels_3d(
        [f"{kind}:  a = {a:.3f},  α = {np.degrees(alpha):.1f}°" for (kind, *_), (a, alpha) in zip(PAIRS, found)]
    )
    for ax, (_, first, second), (a, alpha) in zip(panels, PAIRS, found):
        labels = Labels()
        first, second = as_line(first, "Z1"), as_line(second, "Z2")
        x, z = link_direction(first, second), first[1]
        frame = rigid_transform(np.column_stack([x, np.cross(z, x), z]), common_normal(first, second).feet[0])
        parts = {"normal": True, "frame": False, "angle": False, "body": False}
        extent = add_two_axes(ax, labels, first, second, **parts)
        theirs = frame @ chain_frames([[0, a, alpha, 0, 0]])[1]
        ends = theirs[:3, 3] + np.outer([-0.3, 0.55], theirs[:3, 2])
        ax.plot(*ends.T, color=INK, lw=4.5, alpha=0.55, zorder=3)
        fill_panel(ax, np.vstack([extent, ends]))
        labels.place(ax)
    return panels
