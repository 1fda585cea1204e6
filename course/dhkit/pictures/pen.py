"""A student's result on arms with a pen: the tip, its surface, circles on a sheet, an inverse model, a written curve."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import sympy

from ..arms import Arm, Axis, said_letter
from ..curves import STOPS
from ..drawing.arms import draw_arm, end_frame, mark_curve
from ..drawing.pen import PEN_SIZES, draw_pen_robot, pen_tip
from ..drawing.strokes import show_plane
from ..drawing.strokes_3d import draw_target_3d, write_3d
from ..drawing.style import AXIS_COLOURS, INK, SOFT
from ..drawing.view import fit_3d
from ..geometry import unit_vector, wrap
from .own_result import called, entries, numbers, numbers_in_rows, own_result


@own_result
def show_tip(tip, values: dict[str, float]):
    """Show the pen robot in the posture given by `values`, and a point [x, y, z] of an answer.

    The cross belongs on the end of the pen.

    Parameters
    ----------
    tip : 3 entries [x, y, z], SymPy or numbers
    values : dict
        Numbers for t1, t2, t3 (radians), h1, L1, h2, L2, p1 (metres).

    Returns
    -------
    matplotlib Axes (3D)
    """
    at = numbers(tip, "tip", (3,), values)
    sizes = {name: values[name] for name in PEN_SIZES}
    if np.linalg.norm(at) > 10 * sum(sizes.values()):
        raise ValueError(f"your tip is {np.linalg.norm(at):.3g} m away, far outside the picture")
    q = [values[name] for name in ("t1", "t2", "t3")]
    ax = draw_pen_robot(q, sizes, names=False, curve=[at, at])
    draw_target_3d(ax, at, zorder=8, size=15)
    write_3d(ax, np.array(at) + (0, 0, -0.05 * sum(sizes.values())), "your result", fontsize=10)
    return ax


@own_result
def show_height(height, sizes: dict[str, float]):
    """Show (z - h1)^2 of an answer against the distance from axis 1, over tips of random postures.

    Parameters
    ----------
    height : SymPy expression in x, y, L1, h2, L2, p1
    sizes : dict
        h1, L1, h2, L2, p1 in metres.

    Returns
    -------
    matplotlib Axes
    """
    given = {name: sizes[name] for name in ("L1", "h2", "L2", "p1")}
    numbers(height, "height", (), given | {"x": 1.0, "y": 0.4})  # refuses another form in words
    tips = pen_tip(np.random.default_rng(5).uniform(-np.pi, np.pi, (400, 3)), sizes)
    distance = np.hypot(tips[:, 0], tips[:, 1])
    ax = plt.subplots(figsize=(5.8, 3.5))[1]
    ax.plot(distance, (tips[:, 2] - sizes["h1"]) ** 2, ".", ms=4, color=SOFT, label="tips of random postures")
    r = np.linspace(0, 1.15 * distance.max(), 300)
    symbols = [sympy.Symbol(name) for name in ("x", "y", *given)]
    function = sympy.lambdify(symbols, height, "numpy")
    with np.errstate(invalid="ignore"):
        values = np.broadcast_to(np.asarray(function(r * np.cos(0.6) + 0j, r * np.sin(0.6), *given.values())), r.shape)
    values = np.where(np.abs(values.imag) < 1e-9, values.real, np.nan)
    if np.isnan(values).all():
        raise ValueError("your expression has no real value at any distance of the tip")
    ax.plot(r, values, color=INK, lw=1.8, label="your expression")
    limit = sizes["p1"] ** 2
    ax.set(xlabel="distance of the tip from axis 1 (m)", ylabel="$(z - h_1)^2$ (m²)", ylim=(-0.3 * limit, 1.5 * limit))
    ax.axhline(0, color=SOFT, lw=0.8)
    ax.legend(loc="upper left", fontsize=9)
    return ax


@own_result
def show_circles(radii, sizes: dict[str, float], height: float):
    """Show two radii as circles, over tips of random postures that come within 4 mm of a horizontal sheet.

    Parameters
    ----------
    radii : 2 numbers, in metres
    sizes : dict
        h1, L1, h2, L2, p1 in metres.
    height : float, in metres
        Height of the sheet.

    Returns
    -------
    matplotlib Axes
    """
    radii = numbers(radii, "circles", (2,), {})
    tips = pen_tip(np.random.default_rng(6).uniform(-np.pi, np.pi, (30000, 3)), sizes)
    near = tips[np.abs(tips[:, 2] - height) < 0.004]
    ax = plt.subplots(figsize=(4.7, 4.7))[1]
    ax.plot(near[:, 0], near[:, 1], ".", ms=3, color=SOFT, label="tips near the sheet")
    turn = np.linspace(0, 2 * np.pi, 200)
    for radius, dashes in zip(radii, ("-", (0, (5, 2)))):
        ax.plot(*(radius * unit_vector(turn)).T, color=INK, lw=1.5, ls=dashes, label=f"your {radius:.3f} m")
    show_plane(ax)
    ax.margins(0.06)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3, columnspacing=1.2, handlelength=1.6)
    return ax


@own_result
def show_reached(inverse, arm: Arm):
    """Show points that the end effector of an arm reaches, and where it goes with what an inverse model returns for them.

    Parameters
    ----------
    inverse : function (x, y, z) -> list of joint values
    arm : Arm

    Returns
    -------
    matplotlib Axes (3D)
    """
    wanted = np.array([end_frame(arm, q)[:3, 3] for q in _random_postures(arm)])
    reached, missed, nothing = [], [], 0
    for point in wanted:
        rows = numbers_in_rows(called(inverse, *map(float, point)), "inverse", len(arm.joints))
        nothing += not len(rows)
        for q in rows:
            tip = end_frame(arm, q)[:3, 3]
            (reached if np.linalg.norm(tip - point) < 1e-5 else missed).append((point, tip))
    ax = draw_arm(arm, end_effector=False)
    corners = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()]).T
    ax.plot(*wanted.T, "o", ms=7, mfc="none", mec=SOFT, zorder=8, label=f"{len(wanted)} points")
    red = AXIS_COLOURS["x"]
    if reached:
        tips = np.array([tip for _, tip in reached])
        ax.plot(*tips.T, ".", ms=5, color=INK, zorder=9, label=f"reached ({len(reached)})")
    if missed:
        for ends in missed:
            ax.plot(*zip(*ends), color=red, lw=0.7, zorder=9)
        tips = np.array([tip for _, tip in missed])
        ax.plot(*tips.T, "x", ms=6, color=red, zorder=9, label=f"a solution misses ({len(missed)})")
    if nothing:
        ax.plot([], [], [], " ", label=f"no solution ({nothing})")
    fit_3d(ax, np.vstack([corners, wanted, *(tip[None] for _, tip in missed)]), True, pad=0.5)
    ax.figure.legend(*ax.get_legend_handles_labels(), loc="lower center", bbox_to_anchor=(0.5, -0.06), ncols=3)
    return ax


def _random_postures(arm: Arm, count: int = 40) -> np.ndarray:
    """Joint values (count, n): turns anywhere, slides of up to 0.3 m."""
    least = [0.02 if joint.slides else -np.pi for joint in arm.joints]
    most = [0.3 if joint.slides else np.pi for joint in arm.joints]
    return np.random.default_rng(5).uniform(least, most, (count, len(arm.joints)))


@own_result
def show_trace(follow, arm: Arm, curve):
    """Show an arm that writes a curve with the joint values that a function returns, and measure its trace.

    Parameters
    ----------
    follow : function (x, y, z) -> (q1, q2, q3)
    arm : Arm
        Its joints have the stops of `dhkit.curves.STOPS`.
    curve : array-like, shape (k, 3), in metres

    Returns
    -------
    matplotlib Axes (3D)
    """
    curve = np.asarray(curve, float)
    rows = np.array([numbers(entries(called(follow, *map(float, point))), "follow", (3,), {}) for point in curve])
    trace = np.array([end_frame(arm, q)[:3, 3] for q in rows])
    away = 1000 * np.linalg.norm(trace - curve, axis=1).max()
    ax = mark_curve(draw_arm(arm, rows[len(rows) // 3], end_effector=False), curve, trace)
    size = f"{away:.2g}" if away < 100 else f"{away:.0f}"
    said = [f"trace at most {size} mm from the curve" if away < 1e4 else "trace far from the curve"]
    said += [_largest(joint, values) for joint, values in zip(arm.joints, rows.T, strict=True)]
    ax.figure.suptitle("\n".join(said), fontsize=10, y=1.02, va="bottom")
    return ax


def _largest(joint: Axis, values) -> str:
    """How far a joint has moved, and whether it went beyond its stop, in words."""
    stop = STOPS[joint.slides]
    most = np.abs(values if joint.slides else wrap(values)).max()
    size = f"{most:.3f} m" if joint.slides else f"{np.degrees(most):.0f}°"
    return f"largest ${said_letter(joint.name)}$: {size}" + (", beyond the stop" if most > stop + 1e-6 else "")
