"""A student's result on a planar parallel robot."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Circle

from ..drawing.parallel import draw_3rpr, draw_3rrr, draw_assembly_modes, platform_points
from ..drawing.style import AXIS_COLOURS
from . import live
from .own_result import called, numbers, numbers_in_rows, own_result


@own_result
def show_leg_lengths(leg_lengths, base, platform, pose):
    """Show circles with the radii that an inverse model returns, about the anchors of a 3-RPR in that pose.

    Parameters
    ----------
    leg_lengths : function (x, y, phi) -> three lengths in metres
    base, platform : array-like, shape (3, 2), in metres
    pose : (float, float, float)
        x, y (metres), phi (radians).

    Returns
    -------
    matplotlib Axes
        Each circle passes through the joint of its leg.
    """
    radii = numbers(called(leg_lengths, *map(float, pose)), "leg_lengths", (3,), {})
    ax = draw_3rpr(base, platform, pose)
    for i, (foot, radius) in enumerate(zip(base, radii)):
        dashes, name = ("-", (0, (5, 1.5)), (0, (6, 1.5, 1.2, 1.5)))[i], f"your $q_{i + 1}$ = {radius:.3f} m"
        colour = tuple(AXIS_COLOURS.values())[i]
        ax.add_patch(Circle(foot, abs(radius), fill=False, ec=colour, lw=1.4, ls=dashes, zorder=2.5))
        ax.plot([], [], color=colour, lw=1.4, ls=dashes, label=name)
    ax.set_xlim(ax.get_xlim()[0] - 0.2, ax.get_xlim()[1] + 0.2)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=3, columnspacing=1.2, handlelength=2.2)
    return ax


@own_result
def show_modes(modes, base, platform, lengths):
    """Show assembly modes side by side; below each one the largest error of its legs.

    Parameters
    ----------
    modes : rows x, y (metres), phi (radians)
    base, platform : array-like, shape (3, 2), in metres
    lengths : three numbers, in metres
        What the legs should measure.

    Returns
    -------
    matplotlib Axes
    """
    rows = numbers_in_rows(modes, "modes", 3)
    ax = draw_assembly_modes(base, platform, rows)
    off = [np.abs(np.hypot(*(platform_points(platform, row) - base).T) - lengths).max() for row in rows]
    for text, error in zip(ax.texts, off):
        verdict = "legs fit" if error < 1e-3 else f"a leg is off by {error:.3f} m"
        text.set_text(f"{text.get_text()},  {verdict}")
        text.set_fontsize(9)
    live.beside(lambda: live.modes(base, platform, rows))
    return ax


@own_result
def show_3rrr_postures(postures, base, platform, bars, pose):
    """Show the legs of a 3-RRR in each given posture: the outer bars belong on the corners of the platform.

    Parameters
    ----------
    postures : rows (t1, e1, t2, e2, t3, e3), in radians
    base, platform : array-like, shape (3, 2), in metres
    bars : (float, float), or three of them, in metres
    pose : (float, float, float)
        x, y (metres), phi (radians).

    Returns
    -------
    matplotlib Axes
    """
    rows = numbers_in_rows(postures, "postures", 6)
    return draw_3rrr(base, platform, bars, pose, rows[:16])
