"""Drawings of parallel machines whose legs are driven by rails, cranks and rams."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Polygon

from ..geometry import unit_vector
from ..machines import Leg, Machine
from .inputs import as_numbers
from .parallel import PLATFORM, ROD, platform_points
from .strokes import draw_axis_arrow, draw_joint, draw_link, leave_room, new_axes, show_plane, write
from .style import CENTRE_LINE, INK, SOFT, styled

RAIL = 0.75
"""Metres of a rail that are drawn on each side of its anchor."""
SLIDER = 0.05


@styled
def draw_machine(machine: Machine, pose=None, drives=None, ax=None, *, names=True):
    """Draw a machine: rails, cranks and rams, and the rods from there to the platform.

    Parameters
    ----------
    machine : Machine
    pose : (x, y, phi), optional
        Metres and radians; by default the machine's home.
    drives : three numbers, optional
        Values of the drives, metres and radians; by default those at home.
    names : bool
        Name anchors, drives and joints.

    Returns
    -------
    matplotlib Axes
    """
    pose = as_numbers(machine.home if pose is None else pose, "pose", (3,))
    drives = as_numbers(machine.drives if drives is None else drives, "drives", (3,))
    joints = platform_points(machine.platform, pose)
    ax = ax or new_axes((6.0, 5.6))
    show_plane(ax)
    ax.add_patch(Polygon(joints, facecolor=PLATFORM, edgecolor=INK, lw=1.6, joinstyle="round", zorder=2.5))
    ax.plot(*joints.T, ".", ms=0)
    for i, (leg, q, joint) in enumerate(zip(machine.legs, drives, joints), 1):
        driven = leg.driven(q)
        _draw_drive(ax, leg, driven, joint, i if names else 0)
        draw_joint(ax, joint, 4.5, size=6)
        if names:
            out = joint - joints.mean(axis=0)
            write(ax, joint + 0.075 * out / (np.hypot(*out) or 1), f"$B_{i}$")
    if names:
        draw_axis_arrow(ax, (0, 0), 0, 0.16, "x", "x_0", away=0.3)
        draw_axis_arrow(ax, (0, 0), np.pi / 2, 0.16, "y", "y_0", away=0.3)
        for letter, angle in (("x", pose[2]), ("y", pose[2] + np.pi / 2)):
            draw_axis_arrow(ax, pose[:2], angle, 0.1, letter, f"{letter}_P", away=0.4)
    leave_room(ax, 0.12)
    return ax


def _draw_drive(ax, leg: Leg, driven, joint, number: int) -> None:
    """One leg up to its joint; named if it has a `number`."""
    anchor = np.array(leg.anchor)
    if leg.kind == "rail":
        along = unit_vector(np.radians(leg.rail))
        reach = max(RAIL, abs((driven - anchor) @ along) + 2 * SLIDER)
        ax.plot(*zip(anchor - 0.3 * along, anchor + 0.3 * along), color=SOFT, lw=0)
        ax.plot(*zip(anchor, driven), color=SOFT, lw=5, alpha=0.6, solid_capstyle="butt", zorder=1.2)
        line = ax.plot(
            *zip(anchor - reach * along, anchor + reach * along), color=SOFT, lw=1.2, ls=CENTRE_LINE, zorder=1
        )[0]
        line.set_in_layout(False)
        corners = [
            SLIDER * (a * along + b * np.array([-along[1], along[0]]))
            for a, b in ((1, 0.7), (-1, 0.7), (-1, -0.7), (1, -0.7))
        ]
        ax.add_patch(Polygon(driven + corners, facecolor="white", edgecolor=INK, lw=1.4, zorder=3))
        ax.plot(*anchor, "|", ms=9, mew=1.6, color=INK, zorder=3)
    if leg.kind == "ram":
        draw_link(ax, anchor, joint, ROD, 4.5, 2.8)
        draw_link(ax, anchor, anchor + 0.55 * (joint - anchor), "white", 8, 2.9)
    else:
        draw_link(ax, driven, joint, ROD, 4.5, 2.8)
    if leg.kind == "crank":
        draw_link(ax, anchor, driven, "white", 7, 3)
    if leg.kind != "rail":
        draw_joint(ax, anchor, 4.5, size=6)
    draw_joint(ax, driven, 4.5, size=4.5)
    if number:
        aside = anchor - (driven if leg.kind != "ram" else joint)
        write(ax, anchor + 0.09 * aside / (np.hypot(*aside) or 1), f"$A_{number}$")
        between = (anchor + driven) / 2 if leg.kind != "ram" else 0.4 * anchor + 0.6 * joint
        across = np.array([aside[1], -aside[0]]) / (np.hypot(*aside) or 1)
        write(ax, between + 0.065 * across, f"$q_{number}$")
