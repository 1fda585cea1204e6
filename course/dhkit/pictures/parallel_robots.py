"""A student's result on a planar parallel robot."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle

from ..drawing.parallel import draw_3rpr, draw_3rrr, draw_assembly_modes, draw_leg_lines, platform_points
from ..drawing.planar import mark_target
from ..drawing.style import AXIS_COLOURS, HALO, INK, SOFT
from . import live
from .own_result import called, numbers, numbers_in_rows, own_result


@own_result
def show_platform_joint(answer, base, platform, values: dict[str, float], number: int = 2):
    """Show a formula for a joint of the platform, over the robot in the pose given by `values`.

    The cross belongs on the joint B_number.

    Parameters
    ----------
    answer : 2 entries in x, y, phi, u, v
    base, platform : array-like, shape (3, 2), in metres
    values : dict
        Numbers for x, y (metres) and phi (radians).
    number : int
        1, 2 or 3; the point b of this joint is put in for u, v.

    Returns
    -------
    matplotlib Axes
    """
    point = dict(zip("uv", map(float, platform[number - 1])))
    at = numbers(answer, "joint", (2,), values | point)
    ax = draw_3rpr(base, platform, [values[name] for name in ("x", "y", "phi")])
    return mark_target(ax, at, "your result")


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
def show_singular_poses(jacobian, base, platform, phi, view=(-0.6, 1.6, 0.35, 1.5)):
    """Show where the determinant of a Jacobian changes its sign, for all positions of P at one angle of the platform.

    Parameters
    ----------
    jacobian : function (x, y, phi) -> 3x3 numbers
    base, platform : array-like, shape (3, 2), in metres
    phi : float, in radians
    view : (x_min, x_max, y_min, y_max), in metres

    Returns
    -------
    matplotlib Axes
    """
    xs, ys = np.linspace(*view[:2], 41), np.linspace(*view[2:], 31)
    grid = [[called(jacobian, float(x), float(y), float(phi)) for x in xs] for y in ys]
    determinants = np.linalg.det([[numbers(matrix, "jacobian", (3, 3), {}) for matrix in row] for row in grid])
    ax = plt.subplots(figsize=(5.6, 3.9))[1]
    ax.set_aspect("equal")
    signs = [-np.inf, 0, np.inf]
    ax.contourf(xs, ys, determinants, signs, colors=["#f4f4f4", "#cfcfcf"], zorder=0)
    if determinants.min() < 0 < determinants.max():
        ax.contour(xs, ys, determinants, [0], colors=INK, linewidths=1.8, zorder=2)
    for sign, word in ((determinants > 0, "det > 0"), (determinants < 0, "det < 0")):
        if sign.any():
            row, column = np.argwhere(sign).mean(axis=0).astype(int)
            ax.text(xs[column], ys[row], word, ha="center", va="center", path_effects=HALO, color=INK)
    ax.plot(*np.transpose(base), "o", ms=6, mfc="white", mec=SOFT, mew=1.4, ls="none", clip_on=True)
    ax.set(xlim=view[:2], ylim=view[2:], xlabel="x of P (m)", ylabel="y of P (m)")
    ax.set_title(
        "singular on the line" if determinants.min() < 0 < determinants.max() else "the sign never changes here"
    )
    return ax


@own_result
def show_singular(x, base, platform, y, phi=0.0):
    """Show the leg lines of the pose (x, y, phi): in a singular pose they meet in one point.

    Parameters
    ----------
    x : number, in metres
    base, platform : array-like, shape (3, 2), in metres
    y, phi : float, in metres and radians

    Returns
    -------
    matplotlib Axes
    """
    at = float(numbers(x, "singular", (), {}))
    return draw_leg_lines(
        base, platform, [(at, y, phi)], labels=[f"x = {at:.3f} m, y = {y:g} m"], view=(-0.6, 2.0, -0.3, 1.9)
    )


@own_result
def show_3rrr_postures(postures, base, platform, bars, pose):
    """Show the legs of a 3-RRR in each given posture: the outer bars belong on the corners of the platform.

    Parameters
    ----------
    postures : rows (t1, e1, t2, e2, t3, e3), in radians
    base, platform : array-like, shape (3, 2), in metres
    bars : (float, float), in metres
    pose : (float, float, float)
        x, y (metres), phi (radians).

    Returns
    -------
    matplotlib Axes
    """
    rows = numbers_in_rows(postures, "postures", 6)
    return draw_3rrr(base, platform, bars, pose, rows[:16])
