"""The six-axis arm of the EPFL slides, in its reference position and moved."""

from __future__ import annotations

import numpy as np

from ..geometry import chain_products, rotation
from .bodies import JOINT, LINK, Bodies
from .inputs import as_lengths, as_numbers
from .labels import Labels
from .strokes_3d import draw_angle_3d, draw_arrow_3d, draw_dimension_3d, write_3d
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, FAINT, INK, SOFT, styled
from .turns import turn_about
from .view import fit_3d, new_axes_3d

SIX_AXES = "zxxzxz"  # directions of the axes in the reference position


def six_axis_motions(q, D3, L2, D4) -> np.ndarray:
    """What moves the links 0 to 6 of the six-axis arm out of their reference position: I, K1, K1 K2, ...

    Parameters
    ----------
    q : array-like, shape (6,), in radians
    D3, L2, D4 : float, in metres

    Returns
    -------
    ndarray, shape (7, 4, 4)
    """
    centres = [[0, 0, 0], [0, 0, 0], [0, 0, L2], [D3, 0, L2 + 0.4 * D4], [D3, 0, L2 + D4], [D3, 0, L2 + D4]]
    turns = [turn_about(rotation(letter, angle), at) for letter, angle, at in zip(SIX_AXES, q, centres)]
    return chain_products(turns)


@styled
def draw_six_axes(q=(0, 0, 0, 0, 0, 0), D3=0.2, L2=0.5, D4=0.6, h=0.2, ax=None):
    """Draw the six-axis arm of the EPFL slides: axes, positive senses and, in the reference position, its dimensions.

    Parameters
    ----------
    q : array-like, shape (6,), in radians
        Joint angles; all zero is the reference position.
    D3, L2, D4, h : float, in metres
        Offset along axis 3, distance of axes 2 and 3, of axes 3 and 5, and from the wrist centre to the hand point.

    Returns
    -------
    matplotlib Axes (3D)
    """
    q = as_numbers(q, "t1 to t6", (6,))
    D3, L2, D4, h = as_lengths([D3, L2, D4, h], "D3, L2, D4, h", (4,))
    own, ax = ax is None, ax or new_axes_3d(elev=16, azim=-35)
    arm = _Arm(six_axis_motions(q, D3, L2, D4), D3, L2, D4, h)
    bodies, labels = Bodies(ax, arm.unit), Labels()
    _add_links(ax, bodies, arm)
    points = [*_draw_floor(ax, arm), *_add_joints(ax, bodies, labels, arm)]
    bodies.draw(ax, zorder=2.5)
    if not q.any():
        points += _draw_dimensions(ax, arm)
    fit_3d(ax, points, own, width=5.6, height=6.0)
    labels.place(ax)
    return ax


class _Arm:
    """Points of the arm in its reference position, and the motions of its links."""

    def __init__(self, motions, D3, L2, D4, h):
        self.motions, self.unit = motions, L2 + D4
        self.floor = -0.3 * self.unit
        self.shoulder, self.elbow, self.knee = np.zeros(3), np.array([0, 0, L2]), np.array([D3, 0, L2])
        self.sleeve, self.wrist = np.array([D3, 0, L2 + 0.45 * D4]), np.array([D3, 0, L2 + D4])
        self.hand = np.array([D3, 0, L2 + D4 + h])

    def at(self, link, point):
        """Where a point of link 0 to 6 has moved."""
        return (self.motions[link] @ np.append(point, 1.0))[:3]


def _draw_floor(ax, arm):
    """The floor, the directions of frame 0 in its corner, and its origin; the points that a view must hold."""
    corners = 0.32 * arm.unit * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]])
    ax.plot(*corners.T, arm.floor, color=FAINT, lw=0.8, zorder=0)
    corner = np.array([-0.32 * arm.unit, -0.32 * arm.unit, arm.floor])
    for letter, direction in zip("xyz", np.eye(3)):
        end = 0.3 * arm.unit * direction + corner
        draw_arrow_3d(ax, corner, end, AXIS_COLOURS[letter], AXIS_DASHES[letter])
        write_3d(ax, end + 0.06 * arm.unit * direction, f"${letter}$", color=AXIS_COLOURS[letter])
    write_3d(ax, (-0.05 * arm.unit, -0.05 * arm.unit, -0.02 * arm.unit), "$O$", ha="right")
    return [(*corner, arm.floor) for corner in corners]


def _add_links(ax, bodies, arm):
    bars = (
        (0, (0, 0, arm.floor), arm.shoulder), (2, arm.shoulder, arm.elbow), (3, arm.elbow, arm.knee),
        (3, arm.knee, arm.sleeve), (4, arm.sleeve, arm.wrist), (6, arm.wrist, arm.hand),
    )  # fmt: skip
    for link, start, end in bars:
        bodies.add_tube(arm.at(link, start), arm.at(link, end), 0.02 * arm.unit, LINK)
        bodies.add_ball(arm.at(link, end), 0.02 * arm.unit, LINK)
    for point in (arm.wrist, arm.hand):
        ax.plot(*arm.at(6, point)[:, None], "o", ms=5, color=INK, zorder=8)


def _add_joints(ax, bodies, labels, arm):
    """The joints with their axes and positive senses; the points that a view must hold."""
    unit, points = arm.unit, []
    # Where each joint's body sits, and where, seen from there along the axis, its angle is shown.
    middles = ((0, 0, -0.16 * unit), arm.shoulder, arm.elbow, arm.sleeve, arm.wrist, (arm.wrist + arm.hand) / 2)
    shown_at = np.array([0.26, 0.24, 0.30, 0.15, 0.24, 0.24]) * unit
    for i, (letter, middle) in enumerate(zip(SIX_AXES, middles)):
        along = arm.motions[i][:3, "xyz".index(letter)]
        aside = arm.motions[i][:3, 1]
        middle = arm.at(i, middle)
        ends = np.array([middle - 0.14 * unit * along, middle + 1.25 * shown_at[i] * along])
        ax.plot(*ends.T, color=SOFT, lw=1, ls=CENTRE_LINE, zorder=2)
        half = 0.045 * unit * along
        bodies.add_tube(middle - half, middle + half, 0.036 * unit, JOINT, caps=True)
        place, ring = middle + shown_at[i] * along, 0.055 * unit
        draw_angle_3d(ax, place, aside, np.cross(along, aside), ring, 1.6 * np.pi, "", 1)
        up = np.array([0, 0, 1.0]) if abs(along[2]) < 0.7 else aside
        labels.ask(place + 1.1 * ring * up, rf"$\theta_{i + 1}$", up)
        labels.avoid(place + ring * np.array([aside, -aside, np.cross(along, aside), np.cross(aside, along)]))
        points += list(ends)
    return points


def _draw_dimensions(ax, arm):
    """The four lengths in the reference position; the points that a view must hold."""
    unit, aside = arm.unit, np.array([0, 0.25 * arm.unit, 0])
    draw_dimension_3d(ax, arm.shoulder, arm.elbow, -aside, "L_2")
    draw_dimension_3d(ax, arm.knee, arm.wrist, 1.4 * aside, "D_4")
    draw_dimension_3d(ax, arm.wrist, arm.hand, 1.4 * aside, "h")
    # D3 is short: its name stands beside the arrow.
    for foot in (arm.elbow, arm.knee):
        ax.plot(*zip(foot, foot - (0, 0, 0.22 * unit)), color=SOFT, lw=0.7, zorder=4)
    below = [foot - (0, 0, 0.2 * unit) for foot in (arm.elbow, arm.knee)]
    draw_arrow_3d(ax, *below, width=0.9, style="<|-|>", scale=8)
    write_3d(ax, (arm.elbow + arm.knee) / 2 - (0, 0, 0.26 * unit), "$D_3$")
    return [arm.hand + 1.6 * aside, -1.3 * aside]
