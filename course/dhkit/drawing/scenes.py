"""Scenes to read parameters and frames from: two frames, parallel axes, a gripper at a shelf."""

from __future__ import annotations

import numpy as np

from ..geometry import rotation
from .bodies import Bodies
from .chains import chain_frames
from .inputs import as_lengths
from .labels import Labels
from .style import AXIS_COLOURS, CENTRE_LINE, DASHED, FAINT, INK, SOFT, styled
from .two_axes import add_axis
from .view import fit_3d, new_axes_3d


def new_scene(view=(20, -58)):
    """Space for a scene, with its labels and the points that the view must hold."""
    return new_axes_3d(*view), Labels(), []


def finish_scene(ax, labels, extent):
    """Fit the view to `extent` and place the labels."""
    fit_3d(ax, np.vstack(extent), True, pad=0.45)
    labels.place(ax)
    return ax


def add_frame(ax, labels, frame, name, size, letters="xyz", width=2.0):
    """Add a frame, shape (4, 4), with its labels; returns its points."""
    for letter in letters:
        add_axis(ax, labels, frame[:3, 3], frame[:3, "xyz".index(letter)], size, letter, name, width)
    return np.vstack([frame[:3, 3], frame[:3, 3] + size * frame[:3, :3].T])


def draw_thin_line(ax, start, end):
    """Draw a thin dashed line between two points."""
    ax.plot(*zip(start, end), color=SOFT, lw=1, ls=DASHED, zorder=3)


# ---------------------------------------------------------------- two frames to read


def add_reading(ax, labels, reach, tilt, drop, turn):
    """Add frames 1 and 2 of one link; returns the points of the scene."""
    first, second = chain_frames([[0, reach, -tilt, -drop, turn]])
    foot = np.array([reach, 0, 0])
    size = 0.45 * reach
    z2, x2, origin = second[:3, 2], second[:3, 0], second[:3, 3]
    ends = [origin - 0.25 * reach * z2, foot + 0.75 * reach * z2]
    ax.plot(*zip(*ends), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=1)
    ax.plot(*zip([0, 0, -0.3 * reach], [0, 0, 0.8 * reach]), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=1)
    draw_thin_line(ax, [0, 0, 0], 1.35 * foot)
    for start, end in (([0, 0, 0], foot), (foot, origin)):
        ax.plot(*zip(start, end), color=FAINT, lw=7, zorder=1.5, solid_capstyle="round")
    points = [add_frame(ax, labels, first, "1", size, "xz"), np.array([*ends, origin])]
    add_axis(ax, labels, foot + 0.3 * reach * z2, z2, size, "z", "2")
    add_axis(ax, labels, origin, x2, size, "x", "2")
    labels.ask(np.zeros(3), "$O_{1}$", (-1, 0, -1), gap=6)
    labels.ask(origin, "$O_{2}$", -x2 - z2, gap=6)
    for at in (np.zeros(3), origin):
        ax.plot(*at[:, None], "o", ms=5, color=INK, zorder=8)
    # Helpers for the eye: both X axes and both Z axes from one point each.
    ax.plot(*zip(origin, origin + np.array([1.1 * size, 0, 0])), color=AXIS_COLOURS["x"], lw=1, ls=DASHED, zorder=2)
    ax.plot(*zip(foot, foot + np.array([0, 0, 1.5 * size])), color=AXIS_COLOURS["z"], lw=1, ls=DASHED, zorder=2)
    return np.vstack(
        [
            *points,
            origin + size * x2,
            foot + [0, 0, 1.5 * size],
            1.35 * foot,
            [[0, 0, -0.3 * reach], [0, 0, 0.8 * reach]],
        ]
    )


@styled
def draw_reading(reach=0.5, tilt=np.radians(40), drop=0.3, turn=np.radians(50)):
    """Draw frames 1 and 2 of a link, to read its four parameters from; dashed the directions of X1 and Z1.

    Parameters
    ----------
    reach, drop : float, in metres
        Walks along X1, and against Z2.
    tilt, turn : float, in radians
        Sizes of the turns from Z1 to Z2, and from X1 to X2.

    Returns
    -------
    matplotlib Axes (3D)
    """
    ax, labels, extent = new_scene((20, -50))
    extent.append(add_reading(ax, labels, reach, tilt, drop, turn))
    return finish_scene(ax, labels, extent)


# ---------------------------------------------------------------- parallel axes


def add_parallel_axes(ax, labels, gap, side, height, joints=(0.2, 0.35)):
    """Add two vertical axes, and a third one that meets the second; returns the points of the scene."""
    up = np.array([0, 0, 1.0])
    first, second = np.array([0, 0, joints[0]]), np.array([gap, side, joints[1]])
    meeting = np.array([gap, side, height])
    across = np.array([-side, gap, 0]) / np.hypot(gap, side)
    unit = np.hypot(gap, side)
    radius = 0.04 * unit
    bodies = Bodies(ax, unit)
    bodies.add_tube(first, second, radius, 0.86)
    bodies.add_tube(second, meeting, radius, 0.86)
    third = meeting + 0.3 * unit * across
    bodies.add_tube(meeting, third, radius, 0.86)
    for at, along in ((first, up), (second, up), (third, across)):
        bodies.add_tube(at - 2 * radius * along, at + 2 * radius * along, 1.8 * radius, 0.97, caps=True)
    bodies.draw(ax)
    points = [bodies.points()]
    high = height + 0.5 * unit
    for at, name in ((first, "1"), (second, "2")):
        ax.plot(*zip(at * (1, 1, 0), at * (1, 1, 0) + high * up), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=2)
        add_axis(ax, labels, at * (1, 1, 0) + (high - 0.28 * unit) * up, up, 0.28 * unit, "z", name)
        points.append(np.array([at * (1, 1, 0), at * (1, 1, 0) + high * up]))
    ends = np.array([meeting - 0.3 * unit * across, meeting + 0.9 * unit * across])
    ax.plot(*ends.T, color=SOFT, lw=1, ls=CENTRE_LINE, zorder=2)
    add_axis(ax, labels, ends[1] - 0.25 * unit * across, across, 0.25 * unit, "z", "3")
    ax.plot(*meeting[:, None], "o", ms=5, color=INK, zorder=8)
    labels.ask(meeting, "$O_{2}$", (-across + 0.3 * up), gap=8)
    draw_thin_line(ax, np.zeros(3), second * (1, 1, 0))
    for k, axis in enumerate("xy"):
        add_axis(ax, labels, np.zeros(3), np.eye(3)[k], 0.3 * unit, axis, "0")
    return np.vstack([*points, ends])


@styled
def draw_parallel_axes(gap=0.4, side=0.3, height=0.7):
    """Draw vertical axes Z1 through (0, 0) and Z2 through (gap, side), and Z3 that meets Z2 at a height. In metres.

    Returns
    -------
    matplotlib Axes (3D)
    """
    gap, side, height = as_lengths([gap, side, height], "gap, side, height", (3,))
    ax, labels, extent = new_scene((20, -70))
    extent.append(add_parallel_axes(ax, labels, gap, side, height))
    return finish_scene(ax, labels, extent)


# ---------------------------------------------------------------- a gripper at a shelf


def add_shelf(ax, labels, yaw, height, x=0.6, depth=0.8):
    """Add a book on a shelf and the point where the jaws should close; returns the points of the scene."""
    axes = rotation("z", yaw)
    forward, aside, up = axes.T
    centre = np.array([x, height, depth])
    board, bodies = Bodies(ax, 1.0), Bodies(ax, 1.0)
    back = centre + 0.17 * forward
    board.add_box(back - 0.14 * up, axes, (0.13, 0.42, 0.015), 0.9)
    board.draw(ax, 0.7)
    for offset, half, shade in ((0.0, 0.028, 0.97), (-0.085, 0.04, 0.72), (0.09, 0.045, 0.72), (0.17, 0.03, 0.8)):
        bodies.add_box(back + offset * aside, axes, (0.1, half, 0.125), shade, cells=4)
    bodies.draw(ax, 0.8)
    draw_thin_line(ax, centre, centre + 0.17 * forward)
    ax.plot(*centre[:, None], "o", ms=4.5, color=INK, zorder=8)
    return np.vstack([board.points(), bodies.points(), centre])


def add_gripper(ax, frame, size=0.24):
    """Add a gripper whose jaws close at the origin of `frame`, Z ahead and Y along the jaws; returns its points."""
    bodies = Bodies(ax, 2.5 * size, fine=20)
    axes, at = frame[:3, :3], frame[:3, 3]
    jaws, ahead = axes[:, 1], axes[:, 2]
    bodies.add_tube(at - 1.6 * size * ahead, at - 0.85 * size * ahead, 0.16 * size, 0.86, caps=True)
    bodies.add_box(at - 0.72 * size * ahead, axes, (0.2 * size, 0.75 * size, 0.14 * size), 0.9, cells=5)
    for way in (-1, 1):
        bodies.add_box(
            at - 0.25 * size * ahead + 0.55 * way * size * jaws,
            axes,
            (0.15 * size, 0.08 * size, 0.36 * size),
            0.68,
            cells=4,
        )
    bodies.draw(ax, 1.2)
    return bodies.points()


@styled
def draw_shelf(yaw=np.radians(35), height=0.4):
    """Draw books on a shelf and the base frame of the robot that shall take the white one.

    Parameters
    ----------
    yaw : float, in radians
        Direction towards the shelf, seen from above, counted from X0.
    height : float, in metres
        y coordinate of the point between the jaws.

    Returns
    -------
    matplotlib Axes (3D)
    """
    ax, labels, extent = new_scene((24, -100))
    extent.append(add_shelf(ax, labels, yaw, height))
    extent.append(add_frame(ax, labels, np.eye(4), "0", 0.25))
    labels.ask(extent[0][-1], "$O_{E}$", (-1, 0.4, 0.6), gap=6)
    return finish_scene(ax, labels, extent)
