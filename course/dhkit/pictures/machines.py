"""A student's result on a parallel machine of the student's own."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon

from ..drawing.machines import draw_machine
from ..drawing.parallel import PLATFORM, draw_leg_lines, platform_points
from ..drawing.strokes import draw_joint, show_bare, write
from ..drawing.style import AXIS_COLOURS, INK, SOFT
from ..machines import Machine, machine_of, ways_of
from .own_result import called, numbers, own_result

MOTIONS = ("along $x_0$", "along $y_0$", "turning")
STEP = 1e-5
"""Metres and radians, for differences of a student's drives."""


def _drives(drives, pose) -> np.ndarray:
    return numbers(called(drives, *map(float, pose)), "drives", (3,), {})


@own_result
def show_drives(drives, machine: Machine, pose):
    """Show a machine with its platform in a pose and its drives at the values that a function gives for it.

    Parameters
    ----------
    drives : function (x, y, phi) -> three values, metres and radians
    machine : Machine
    pose : (x, y, phi)

    Returns
    -------
    matplotlib Axes
        Its title says by how much the ends of the rods miss the platform.
    """
    q = _drives(drives, pose)
    ax = draw_machine(machine, pose, q)
    off = []
    for i, (leg, value, joint) in enumerate(zip(machine.legs, q, platform_points(machine.platform, pose)), 1):
        length = np.hypot(*(joint - leg.driven(value)))
        error = abs(length - (value if leg.kind == "ram" else leg.rod))
        if error > 1e-3:
            off.append(f"leg {i} by {error:.3f} m")
    ax.set_title("every rod fits" if not off else "too long or too short: " + ", ".join(off))
    return ax


@own_result
def show_rates(rates, drives, pose):
    """Show the columns of a matrix of rates beside differences of the drives that the student's own function gives.

    Parameters
    ----------
    rates : function (x, y, phi) -> 3x3 numbers
    drives : function (x, y, phi) -> three values
    pose : (x, y, phi)

    Returns
    -------
    matplotlib Axes
        For each motion of the platform the rates of the three drives, twice.
    """
    matrix = numbers(called(rates, *map(float, pose)), "rates", (3, 3), {})
    around = [[_drives(drives, np.add(pose, sign * step)) for sign in (1, -1)] for step in STEP * np.eye(3)]
    differences = np.array([(ahead - behind + np.pi) % (2 * np.pi) - np.pi for ahead, behind in around]) / (2 * STEP)
    figure, axes = plt.subplots(1, 3, figsize=(7.2, 2.7), sharey=True)
    places = np.arange(1, 4)
    for ax, motion, own, seen in zip(axes, MOTIONS, matrix.T, differences):
        ax.axhline(0, color=INK, lw=0.8)
        ax.bar(places - 0.18, own, 0.34, color=AXIS_COLOURS["z"], label="your matrix")
        ax.bar(
            places + 0.18, seen, 0.34, color="white", edgecolor=INK, hatch="//", label="your drives, a little further"
        )
        ax.set(title=motion, xticks=places, xticklabels=[f"$q_{i}$" for i in places])
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", bbox_to_anchor=(0.5, -0.1), ncols=2)
    return axes[0]


@own_result
def show_singular_machine(x, drives, machine: Machine):
    """Show the lines of the rods for P at (x, machine.line) and phi = 0: in a singular pose they meet in one point.

    Parameters
    ----------
    x : number, in metres
    drives : function (x, y, phi) -> three values
        The student's own: it says where the rods begin.
    machine : Machine

    Returns
    -------
    matplotlib Axes
    """
    pose = (float(numbers(x, "singular", (), {})), machine.line, 0.0)
    begin = [leg.driven(value) for leg, value in zip(machine.legs, _drives(drives, pose))]
    label = f"x = {pose[0]:.3f} m, y = {machine.line:g} m"
    return draw_leg_lines(begin, machine.platform, [pose], labels=[label], letters="", view=(-0.7, 1.7, -0.6, 1.8))


@own_result
def show_ways(crossings, mine):
    """Show the six ways of the student's machine, each with the number that a function gives for it.

    Parameters
    ----------
    crossings : function (x1, y1, phi1, x2, y2, phi2) -> number
    mine : mapping

    Returns
    -------
    matplotlib Axes
        The platform at the start (dark), at the end (light), and in between.
    """
    platform = machine_of(mine).platform
    answers = [float(numbers(called(crossings, *start, *end), "crossings", (), {})) for start, end in ways_of(mine)]
    axes = plt.subplots(2, 3, figsize=(7.2, 5.2))[1]
    for number, (ax, (start, end), answer) in enumerate(zip(axes.flat, ways_of(mine), answers), 1):
        show_bare(ax)
        for share in np.linspace(0, 1, 9):
            corners = platform_points(platform, (1 - share) * np.array(start) + share * np.array(end))
            face = {0.0: "#9a9a9a", 1.0: PLATFORM}.get(float(share), "none")
            solid = share in (0, 1)
            patch = Polygon(
                corners, facecolor=face, edgecolor=INK if solid else SOFT, lw=1.5 if solid else 0.7, alpha=0.9
            )
            patch.set_zorder(3 if solid else 2)
            ax.add_patch(patch)
        for pose in (start, end):
            draw_joint(ax, pose[:2], 4, size=4)
        ax.set(xlim=(0, 1), ylim=(0, 1))
        write(ax, (0.5, -0.02), f"{number}:  {answer:g}")
    return axes[0, 0]
