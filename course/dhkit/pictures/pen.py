"""A student's result on the pen robot: the tip, its surface, circles on a sheet, an inverse model, a written curve."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import sympy

from ..drawing.pen import PEN_SIZES, draw_pen_robot, pen_tip
from ..drawing.strokes import show_plane
from ..drawing.strokes_3d import draw_target_3d, write_3d
from ..drawing.style import AXIS_COLOURS, INK, SOFT
from ..geometry import rotation, unit_vector, wrap
from . import live
from .own_result import called, entries, numbers, numbers_in_rows, own_result


@own_result
def show_tip(tip, values: dict[str, float], *, repaired=False):
    """Show the pen robot in the posture given by `values`, and a point [x, y, z] or [rho, z] of an answer.

    The cross belongs on the end of the pen.

    Parameters
    ----------
    tip : 3 entries [x, y, z], or 2 entries [rho, z] in the plane of the pen, SymPy or numbers
    values : dict
        Numbers for t1, t2, t3 (radians), h1, L1, h2, L2, p1 (metres).
    repaired : bool
        L2 is a link between joints 2 and 3.

    Returns
    -------
    matplotlib Axes (3D)
    """
    if len(entries(tip)) == 2:
        rho, z = numbers(tip, "repaired", (2,), values)
        side = values["h2"] + (0 if repaired else values["L2"])
        at = rotation("z", values["t1"]) @ [rho, side, z]
    else:
        at = numbers(tip, "tip", (3,), values)
    sizes = {name: values[name] for name in PEN_SIZES}
    if np.linalg.norm(at) > 10 * sum(sizes.values()):
        raise ValueError(f"your tip is {np.linalg.norm(at):.3g} m away, far outside the picture")
    q = [values[name] for name in ("t1", "t2", "t3")]
    ax = draw_pen_robot(q, sizes, repaired=repaired, names=False, curve=[at, at])
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
def show_pen_inverse(inverse, sizes: dict[str, float]):
    """Show points of the surface from above, and where the pen goes with what an inverse model returns for them.

    Parameters
    ----------
    inverse : function (x, y, z, h1, L1, H, p1) -> list of (theta1, phi)
    sizes : dict
        h1, L1, h2, L2, p1 in metres.

    Returns
    -------
    matplotlib Axes
    """
    grid = [(turn, phi, 0.0) for turn in np.arange(-3, 3.2, 0.75) for phi in (0.5, 1.5, 2.6, -0.5, -1.4, -2.6)]
    wanted = pen_tip(grid, sizes)
    others = (sizes["h1"], sizes["L1"], sizes["h2"] + sizes["L2"], sizes["p1"])
    reached, missed, nothing = [], [], 0
    for point in wanted:
        answer = called(inverse, *map(float, point), *others)
        rows = numbers_in_rows(answer, "inverse", 2)
        nothing += not len(rows)
        for turn, phi in rows:
            tip = pen_tip([turn, phi, 0.0], sizes)
            (reached if np.linalg.norm(tip - point) < 1e-5 else missed).append((point, tip))
    ax = plt.subplots(figsize=(5.0, 5.0))[1]
    ax.plot(wanted[:, 0], wanted[:, 1], "o", ms=8, mfc="none", mec=SOFT, label=f"{len(wanted)} points of the surface")
    if reached:
        ax.plot(*np.array([tip[:2] for _, tip in reached]).T, ".", ms=6, color=INK, label=f"reached ({len(reached)})")
    for point, tip in missed:
        ax.plot(*zip(point[:2], tip[:2]), color=AXIS_COLOURS["x"], lw=0.7)
    if missed:
        ends = np.array([tip[:2] for _, tip in missed]).T
        ax.plot(*ends, "x", ms=6, color=AXIS_COLOURS["x"], label=f"a solution misses ({len(missed)})")
    if nothing:
        ax.plot([], [], " ", label=f"no solution ({nothing})")
    show_plane(ax)
    ax.margins(0.08)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, columnspacing=1.2, handletextpad=0.3)
    return ax


@own_result
def show_trace(follow, curve, sizes: dict[str, float], stop=np.pi / 2):
    """Show the pen robot writing a curve with the joint angles that a function returns, and measure its trace.

    Parameters
    ----------
    follow : function (x, y, z) -> (theta1, theta2, theta3)
    curve : array-like, shape (k, 3), in metres
    sizes : dict
        h1, L1, h2, L2, p1 in metres.
    stop : float, in radians
        Largest theta2 and theta3 to either side.

    Returns
    -------
    matplotlib Axes (3D)
    """
    curve = np.asarray(curve, float)
    rows = [numbers(entries(called(follow, *map(float, point))), "follow", (3,), {}) for point in curve]
    trace = pen_tip(rows, sizes)
    away = 1000 * np.linalg.norm(trace - curve, axis=1).max()
    largest = np.degrees(np.abs(wrap(np.array(rows)[:, 1:])).max(axis=0))
    live.beside(lambda: live.pen(sizes, rows))
    ax = draw_pen_robot(rows[len(rows) // 3], sizes, names=False, curve=curve, trace=trace)
    said = f"trace at most {away:.2g} mm from the curve" if away < 1e4 else "trace far from the curve"
    beyond = " and ".join(rf"$\theta_{k + 2}$" for k in (0, 1) if largest[k] > np.degrees(stop) + 1e-6)
    joints = rf"largest $|\theta_2|$, $|\theta_3|$: {largest[0]:.0f}°, {largest[1]:.0f}°"
    ax.figure.suptitle(
        f"{said}\n{joints}" + (f": {beyond} beyond the stop" if beyond else ""), fontsize=10, y=1.02, va="bottom"
    )
    return ax
