"""Turns about a centre, and an arm brought to its joint angles by one turn after the other."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np

from ..geometry import planar_joints, rotation_2d
from .inputs import as_lengths, as_number, as_numbers
from .strokes import (
    draw_angle,
    draw_arm,
    draw_arrow,
    draw_axis_arrow,
    draw_joint,
    draw_link,
    draw_target,
    leave_room,
    new_axes,
    show_plane,
    write,
)
from .style import DASHED, INK, POSTURE_SHADES, SOFT, styled


def turn_about(turn, centre) -> np.ndarray:
    """The turn about a centre as a homogeneous transform, [R, (I - R) p; 0, 1].

    Parameters
    ----------
    turn : ndarray, shape (n, n)
        Rotation matrix R of the plane or of space.
    centre : array-like, shape (n,), in metres
        The point p.

    Returns
    -------
    ndarray, shape (n + 1, n + 1)
    """
    n, centre = len(turn), np.asarray(centre, float)
    matrix = np.eye(n + 1)
    matrix[:n, :n], matrix[:n, n] = turn, centre - turn @ centre
    return matrix


def _turned(points, angle, centre):
    return points @ rotation_2d(angle).T + turn_about(rotation_2d(angle), centre)[:2, 2]


@styled
def draw_turn_about(angle=np.radians(55), centre=(0.6, 0.0), reach=0.5, ax=None):
    """Draw a link turned about a centre p, in two steps: about the origin first, then moved over by (I - R) p.

    Parameters
    ----------
    angle : float, in radians
    centre : array-like, shape (2,), in metres
        The point p; the link begins there and points along x in its reference position.
    reach : float, in metres
        Length of the link.

    Returns
    -------
    matplotlib Axes
    """
    angle = as_number(angle, "angle")
    p = as_numbers(centre, "centre", (2,))
    reach = float(as_lengths(reach, "length of the link", ()))
    ax = ax or new_axes((6.4, 5.0))
    show_plane(ax)
    before = np.array([p, p + (reach, 0)])
    about_origin, about_p = _turned(before, angle, np.zeros(2)), _turned(before, angle, p)
    unit = np.hypot(*p) + reach
    draw_link(ax, *before, "#f4f4f4", width=11, zorder=2)
    ax.plot(*about_origin.T, color=SOFT, lw=11, solid_capstyle="round", zorder=2.2)
    ax.plot(*about_origin.T, color="white", lw=9, solid_capstyle="round", zorder=2.3)
    draw_link(ax, *about_p, POSTURE_SHADES[1], width=11, zorder=4)
    for foot in (p, before[1]):
        sweep = np.linspace(0, angle, 60)
        path = np.array([_turned(foot, part, np.zeros(2)) for part in sweep])
        ax.plot(*path.T, color=SOFT, lw=0.9, ls=DASHED, zorder=1.5)
    for start, end in zip(about_origin, about_p):
        if np.hypot(*(end - start)) > 0.02 * unit:
            draw_arrow(ax, start, end, INK, width=1.5, zorder=7)
    draw_joint(ax, p, zorder=8)
    if np.hypot(*(p - about_origin[0])) > 0.15 * unit:
        write(ax, (about_p[1] + about_origin[1]) / 2 + (0.13 * unit, 0), r"$(I - R)\,p$")
        write(ax, about_origin[0] + np.array([-0.06, 0.03]) * unit, "$R\\,p$")
    write(ax, p + np.array([0.0, -0.08]) * unit, "$p$")
    write(ax, before[1] + np.array([0.0, -0.08]) * unit, "$P$")
    write(ax, about_origin[1] + np.array([0.0, 0.08]) * unit, "$R\\,P$", color=SOFT)
    write(ax, about_p[1] + np.array([0.03, 0.08]) * unit, "$P'$", ha="left")
    if np.hypot(*p) > 0.05 * unit:
        draw_angle(ax, p, 0.42 * reach, 0, angle, r"\theta", 1.25)
        draw_angle(ax, (0, 0), 0.22 * unit, 0, angle, r"\theta", 1.25)
    for letter, heading in (("x", 0), ("y", np.pi / 2)):
        draw_axis_arrow(ax, (0, 0), heading, 0.2 * unit, letter, f"{letter}_0")
    leave_room(ax, 0.14 * unit)
    return ax


@styled
def draw_arm_turns(lengths=(0.5, 0.4, 0.2), q=(np.radians(40), np.radians(55), np.radians(-70)), *, hand_first=True):
    """Draw the stretched arm brought to its joint angles by one turn per picture: from the hand, or from the base.

    From the hand every centre is still where it was in the reference position; from the base the centres move.

    Parameters
    ----------
    lengths : array-like, shape (3,), in metres
        L1, L2 and the length L4 of the tool.
    q : array-like, shape (3,), in radians
        t1, t2, t4.
    hand_first : bool

    Returns
    -------
    ndarray of 3 matplotlib Axes, in the order of the turns
    """
    lengths = as_lengths(lengths, "lengths", (3,))
    q = as_numbers(q, "t1, t2, t4", (3,))
    points = planar_joints(lengths, np.zeros(3))
    reach = lengths.sum()
    _figure, panels = plt.subplots(1, 3, figsize=(10.5, 3.9), sharex=True, sharey=True, layout="constrained")
    centre_names = (
        ("[0, 0]", "[L_1, 0]", "[L_1 + L_2, 0]")
        if hand_first
        else ("[0, 0]", r"p_1(\theta_1)", r"p_2(\theta_1, \theta_2)")
    )
    seen = [points]
    for step, (ax, joint) in enumerate(zip(panels, (2, 1, 0) if hand_first else (0, 1, 2))):
        before, centre = points.copy(), points[joint]
        points = np.vstack([points[: joint + 1], _turned(points[joint + 1 :], q[joint], centre)])
        seen.append(points)
        show_plane(ax, labels=("x (m)", "y (m)" if step == 0 else ""))
        ax.plot(*before[joint:].T, color=SOFT, lw=1.3, ls=DASHED, zorder=2)
        draw_arm(ax, points, POSTURE_SHADES[0], width=9)
        ax.plot(*points[-1], "o", ms=5, color=INK, zorder=6)
        draw_target(ax, centre)
        heading = np.arctan2(*(before[joint + 1] - centre)[::-1])
        name = rf"\theta_{(1, 2, 4)[joint]}"
        draw_angle(ax, centre, 0.8 * lengths[joint], heading, q[joint], name, 1 + 0.09 * reach / lengths[joint])
        ax.set_title(rf"{step + 1}.  ${name}$ about ${centre_names[joint]}$")
    low, high = np.min(seen, axis=(0, 1)) - 0.12 * reach, np.max(seen, axis=(0, 1)) + 0.12 * reach
    panels[0].set_xlim(low[0], high[0])
    panels[0].set_ylim(low[1], high[1])
    return panels
