"""A student's results on an arm that is known by its axes: frames, the end effector, points reached, freedoms, a determinant."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import sympy

from ..arms import EXTENDED, Arm
from ..drawing.arms import draw_arm
from ..drawing.frames import draw_frames_3d, mark_frame
from ..drawing.inputs import as_numbers
from ..drawing.postures import draw_posture_gallery
from ..drawing.style import AXIS_COLOURS, DASHED, INK, SOFT
from ..drawing.view import fit_3d
from .own_result import called, entries, numbers, own_result, say_if_not_rigid


@own_result
def show_seen_from(transform, values: dict[str, float], names):
    """Show the frame of a transform beside the one from which it is seen.

    Parameters
    ----------
    transform : 4x4 matrix
    values : dict
        Numbers for its symbols, by name.
    names : two texts
        Of the frame that looks, and of the one that is seen.

    Returns
    -------
    matplotlib Axes (3D)
    """
    frame = numbers(transform, "transform", (4, 4), values)
    ax = draw_frames_3d([np.eye(4), frame], list(names))
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_on_arm(pose, arm: Arm, q=None):
    """Show the end effector of a transform, of a position, or of a forward model, over the drawing of the arm.

    Parameters
    ----------
    pose : 4x4 matrix or [x, y, z] in the joint variables and lengths, or function of the joint values that returns numbers
    arm : Arm
    q : sequence of float, optional
        Joint values, in radians and metres; by default those of the drawing in the statement.

    Returns
    -------
    matplotlib Axes (3D)
        Right where the frame E, or the cross of a position, lies on the end effector as drawn.
    """
    at = [EXTENDED if joint.slides else 0.0 for joint in arm.joints] if q is None else [float(value) for value in q]
    values = {**arm.lengths, **dict(zip((joint.name for joint in arm.joints), at, strict=True))}
    found = called(pose, *at) if callable(pose) else pose
    if len(entries(found)) == 3:
        point = numbers(found, "point", (3,), values)
        ax = draw_arm(arm, at, end_effector=False)
        ax.plot(*point[:, None], "x", ms=13, mew=2.5, color=INK, zorder=10)
        return ax
    frame = numbers(found, "pose", (4, 4), values)
    ax = draw_arm(arm, at, end_effector=q is None)
    corners = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()]).T
    size = 0.32 * np.ptp(corners, axis=0).max()  # longer than the axes of the drawing: the names do not meet
    mark_frame(ax, frame, "E", size)
    fit_3d(ax, [*corners, frame[:3, 3] - size, frame[:3, 3] + size], True, pad=0.5)
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_points(cloud, arm: Arm):
    """Show points of the end effector over the drawing of the arm, with every turning joint at zero.

    Parameters
    ----------
    cloud : array-like, shape (k, 3), in metres
    arm : Arm

    Returns
    -------
    matplotlib Axes (3D)
    """
    points = as_numbers(cloud, "cloud", (None, 3))
    ax = draw_arm(arm)
    corners = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()]).T
    ax.scatter(*points.T, s=2, color=AXIS_COLOURS["x"], alpha=0.5, depthshade=False)
    fit_3d(ax, np.vstack([corners, points]), True, pad=0.5)
    ax.figure.text(0.5, 0.01, f"your {len(points)} points", ha="center")
    return ax


@own_result
def show_distances(reach, cloud):
    """Show a smallest and a largest distance from Z0 beside the points of a cloud.

    Parameters
    ----------
    reach : two numbers, in metres
    cloud : array-like, shape (k, 3), in metres

    Returns
    -------
    matplotlib Axes
        Right where both lines touch the points.
    """
    limits = numbers(entries(reach), "reach", (2,), {})
    ax = plt.subplots(figsize=(5.4, 4.0))[1]
    points = as_numbers(cloud, "cloud", (None, 3))
    ax.scatter(np.hypot(points[:, 0], points[:, 1]), points[:, 2], s=2, color=SOFT)
    for limit, name in zip(limits, ("smallest", "largest")):
        ax.axvline(limit, color=INK, lw=1.3, ls=DASHED)
        ax.annotate(f"{name} {limit:.3f}", (limit, 1), xycoords=("data", "axes fraction"), ha="center", va="bottom")
    ax.set(xlabel="distance from $Z_0$ (m)", ylabel="z (m)", aspect="equal")
    return ax


@own_result
def show_ranks(ranks, configurations, table):
    """Show an arm in several configurations, each with the freedoms that an answer leaves it.

    Parameters
    ----------
    ranks : whole numbers, one for each configuration
    configurations : rows of joint values
    table : function of the joint values -> rows [sigma, a, alpha, d, theta] of numbers

    Returns
    -------
    matplotlib Axes (3D)
    """
    found = numbers(entries(ranks), "ranks", (len(configurations),), {})
    names = [f"{letter}: {value:g} freedom{'' if value == 1 else 's'}" for letter, value in zip("ABCDEFGH", found)]
    return draw_posture_gallery([table(*q) for q in configurations], names)


@own_result
def show_zeros(determinant, values: dict[str, float], joint: str):
    """Show a determinant over one joint, with the values at which it vanishes.

    Parameters
    ----------
    determinant : SymPy expression
    values : dict
        Numbers for its symbols, by name; the joint's own does not count.
    joint : str
        The joint that turns from -180 to 180 degrees.

    Returns
    -------
    matplotlib Axes
    """
    numbers(determinant, "determinant", (), values)  # refuses another form in words
    expression = sympy.sympify(determinant)
    held = {symbol: values[symbol.name] for symbol in expression.free_symbols if symbol.name != joint}
    turning = next((symbol for symbol in expression.free_symbols if symbol.name == joint), sympy.Symbol(joint))
    angle = np.linspace(-np.pi, np.pi, 721)
    found = np.broadcast_to(sympy.lambdify([turning], expression.subs(held), "numpy")(angle), angle.shape)
    ax = plt.subplots(figsize=(5.4, 3.4))[1]
    ax.plot(np.degrees(angle), found, color=INK)
    ax.axhline(0, color=SOFT, lw=0.8)
    for place in np.flatnonzero(np.signbit(found[1:]) != np.signbit(found[:-1])):
        ax.plot(np.degrees(angle[place]), 0, "o", ms=6, mfc="white", mec=INK)
        ax.annotate(
            f"{np.degrees(angle[place]):.0f}°", (np.degrees(angle[place]), 0), xytext=(4, 6), textcoords="offset points"
        )
    ax.set(xlabel=f"{joint} (degrees)", ylabel="your determinant", xticks=range(-180, 181, 90))
    return ax
