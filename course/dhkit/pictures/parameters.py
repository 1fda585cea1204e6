"""A student's frames and parameters, in the scenes of the parameter rules."""

from __future__ import annotations

import numpy as np

from .. import strokes
from ..drawing.chains import Labels, chain_frames, draw_chain, fill_panel
from ..drawing.rules import add_axis, add_two_axes, common_normal, link_direction, panels_3d
from ..drawing.scenes import (
    add_frame,
    finished,
    gripper_at,
    new_scene,
    parallel_scene,
    reading_scene,
    shelf_scene,
    thin_line,
)
from .own_result import called, numbers, own_result
from .tables import say_if_not_rigid


def _mark(ax, labels, at, text, out=(1, 0, 0.6)):
    """The student's point: a cross in a circle."""
    ax.plot(*at[:, None], "o", ms=13, mfc="none", mec=strokes.INK, mew=1.3, zorder=8)
    ax.plot(*at[:, None], "+", ms=18, color=strokes.INK, mew=1.3, zorder=8)
    labels.ask(at, text, out, gap=12)


@own_result
def show_reading(parameters, reach, tilt, drop, turn):
    """Frame 2 where the student's four parameters put it, over the frames that they were read from.

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
    extent.append(reading_scene(ax, labels, reach, tilt, drop, turn))
    frame = chain_frames([[0, a, alpha, d, theta]])[1]
    for letter, column in (("x", 0), ("z", 2)):
        end = frame[:3, 3] + 0.36 * reach * frame[:3, column]
        strokes.arrow_3d(ax, frame[:3, 3], end, strokes.AXIS_COLOURS[letter], width=4.5, scale=18, zorder=4)
        extent.append(end[None])
    _mark(ax, labels, frame[:3, 3], "your frame 2", -frame[:3, 0] + 0.3 * frame[:3, 2])
    extent.append(frame[None, :3, 3])
    return finished(ax, labels, extent)


def _two_axes(first, second, view=(20, -58)):
    ax, labels, extent = new_scene(view)
    (p, u), (q, v) = (tuple(np.asarray(part, dtype=float) for part in line) for line in (first, second))
    u, v = u / np.linalg.norm(u), v / np.linalg.norm(v)
    bare = {"normal": False, "frame": False, "angle": False}
    extent.append(add_two_axes(ax, labels, (p, u), (q, v), body=True, base=True, points=("P", "Q"), **bare))
    return ax, labels, extent, (u, v)


@own_result
def show_origin(origin, first, second):
    """The student's origin O1, on the axes Z1 and Z2.

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
    return finished(ax, labels, [*extent, at[None]])


@own_result
def show_x_axis(x_axis, origin, first, second):
    """The student's X1, leaving from the student's O1 (from P, if there is none), and the line that it lies on.

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
        thin_line(ax, ends[2], ends[3])
    ax.plot(*at[:, None], "o", ms=5.5, color=strokes.INK, zorder=8)
    x = np.round(x, 6) + 0.0
    told = f"length {np.linalg.norm(x):.3f},  $X_1 \\cdot u$ = {round(x @ u, 5) + 0:.3f},  $X_1 \\cdot v$ = {round(x @ v, 5) + 0:.3f}  (u, v of length 1)"
    ax.figure.text(0.5, 0.005, told.replace("-", "\N{MINUS SIGN}"), ha="center", fontsize=9)
    return finished(ax, labels, [*extent, ends])


@own_result
def show_parallel(parallel, gap, side, height):
    """The student's O1 at the height z1, and X1 with the length a1 from there, between two vertical axes.

    Parameters
    ----------
    parallel : [a1, z1], in metres
    gap, side, height : as in `draw_parallel`

    Returns
    -------
    matplotlib Axes (3D)
        The line belongs between Z1 and Z2, and ends where X2 begins.
    """
    a, z = numbers(parallel, "parallel", (2,), {})
    ax, labels, extent = new_scene((20, -70))
    extent.append(parallel_scene(ax, labels, gap, side, height))
    start = np.array([0, 0, z])
    end = start + a * np.array([gap, side, 0]) / np.hypot(gap, side)
    ax.plot(*zip(start, end), color=strokes.INK, lw=2.8, zorder=6, solid_capstyle="round")
    _mark(ax, labels, start, "your $O_{1}$", (-1, 0, 0.3))
    labels.ask((start + end) / 2, "your $a_{1}$", (0, 0, 1), gap=8)
    return finished(ax, labels, [*extent, np.array([start, end])])


@own_result
def show_frame(frame, first, second, view=(18, -22)):
    """The student's frame 1, at the axes Z1 and Z2.

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
    ax.plot(*matrix[:3, 3:], "o", ms=5.5, color=strokes.INK, zorder=8)
    labels.ask(matrix[:3, 3], "your $O_{1}$", -matrix[:3, 0] - matrix[:3, 1], gap=8)
    finished(ax, labels, extent)
    say_if_not_rigid(ax, matrix)
    return ax


@own_result
def show_rewritten(table, printed, values: dict[str, float]):
    """Two robots side by side: the printed table, and the student's.

    Parameters
    ----------
    table, printed : rows [sigma, a, alpha, d, theta], numbers or SymPy; metres and radians
    values : dict
        Numbers for the symbols of the tables, by name.

    Returns
    -------
    list of 2 matplotlib Axes (3D)
        The bodies belong in the same place; X3 and X5 may differ.
    """
    rows = [list(row) for row in (table.tolist() if hasattr(table, "tolist") else table)]
    cells = numbers(rows, "table", (None, 5), values)
    panels = panels_3d(["printed", "yours"], width=4.2, height=4.6)
    for ax, robot in zip(panels, (printed, cells)):
        draw_chain(robot, values, ax, frames=(3, 5))
    return panels


@own_result
def show_gripper(frame, yaw, height):
    """A gripper that sits on the student's frame E, at the shelf.

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
    extent.append(shelf_scene(ax, labels, yaw, height))
    extent.append(gripper_at(ax, matrix))
    extent.append(add_frame(ax, labels, matrix, "E", 0.3, width=2.4))
    extent.append(add_frame(ax, labels, np.eye(4), "0", 0.25))
    finished(ax, labels, extent)
    say_if_not_rigid(ax, matrix)
    return ax


PAIRS = (
    ("skew", ([0, 0, 0.5], [0, 0, 1]), ([0.8, 0.3, 0.4], [0, 0.6, 0.8])),
    ("parallel", ([0, 0, 0.2], [0, 0, 1]), ([0.7, 0.2, 0.4], [0, 0, 1])),
    ("meeting", ([0, 0, -0.3], [0, 0, 1]), ([0.5, 0, 0.3], [1, 0, 0.2])),
)


@own_result
def show_link(link):
    """Z2 where the student's a and alpha put it, over the right axis, for three pairs of axes.

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
    panels = panels_3d(
        [f"{kind}:  a = {a:.3f},  α = {np.degrees(alpha):.1f}°" for (kind, *_), (a, alpha) in zip(PAIRS, found)]
    )
    for ax, (_, first, second), (a, alpha) in zip(panels, PAIRS, found):
        labels = Labels()
        lines = [tuple(np.asarray(part, dtype=float) for part in line) for line in (first, second)]
        (p, u), (q, v) = [(point, along / np.linalg.norm(along)) for point, along in lines]
        frame = _frame_of_link((p, u), (q, v))
        parts = {"normal": True, "frame": False, "angle": False, "body": False}
        extent = add_two_axes(ax, labels, (p, u), (q, v), **parts)
        theirs = frame @ chain_frames([[0, a, alpha, 0, 0]])[1]
        ends = theirs[:3, 3] + np.outer([-0.3, 0.55], theirs[:3, 2])
        ax.plot(*ends.T, color=strokes.INK, lw=4.5, alpha=0.55, zorder=3)
        fill_panel(ax, np.vstack([extent, ends]))
        labels.place(ax)
    return panels


def _frame_of_link(first, second) -> np.ndarray:
    frame = np.eye(4)
    x, z = link_direction(first, second), first[1]
    frame[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    frame[:3, 3] = common_normal(first, second)[0][0]
    return frame
