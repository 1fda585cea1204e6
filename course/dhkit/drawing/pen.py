"""Drawings of the pen robot: as its table is printed, with joints 2 and 3 on one line, and with a link between them."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, Wedge
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ..geometry import rotation, unit_vector, wrap
from .bodies import HAND, JOINT, LINK, Bodies
from .inputs import as_lengths, as_numbers
from .labels import Labels
from .strokes import (
    draw_angle,
    draw_arm,
    draw_arrow,
    draw_axis_arrow,
    draw_dimension,
    draw_joint,
    draw_link,
    leave_room,
    show_plane,
    write,
)
from .strokes_3d import arc_points, draw_angle_3d, draw_prism
from .style import AXIS_COLOURS, CENTRE_LINE, DASHED, HALO, INK, LIMIT_DASHES, POSTURE_SHADES, SOFT, WANTED, styled
from .view import fit_3d, new_axes_3d

# The sheet gives no numbers; these make the surface easy to see. Metres.
PEN_SIZES = {"h1": 0.30, "L1": 0.30, "h2": 0.12, "L2": 0.10, "p1": 0.22}


def _sizes(sizes) -> dict[str, float]:
    """`sizes` as positive floats, in the order of the table."""
    return dict(zip(PEN_SIZES, as_lengths(_in_order(sizes), "sizes", (len(PEN_SIZES),)).tolist()))


def _in_order(sizes) -> list:
    missing = sorted(PEN_SIZES.keys() - set(sizes))
    if missing:
        raise ValueError(f"sizes: expected a length for {', '.join(missing)}, found none")
    return [sizes[name] for name in PEN_SIZES]


def pen_tip(q, sizes=PEN_SIZES, *, repaired=False) -> np.ndarray:
    """The pen tip P0 for joint angles q (..., 3) in radians: points (..., 3) in metres.

    `repaired` takes L2 for the length of a link between joints 2 and 3, not for an offset along their common axis.
    """
    h1, L1, h2, L2, p1 = as_numbers(_in_order(sizes), "sizes", (len(PEN_SIZES),))
    t1, t2, t3 = np.moveaxis(np.asarray(q, float), -1, 0)
    side = h2 if repaired else h2 + L2
    out = L1 + p1 * np.sin(t2 + t3) + (L2 * np.sin(t2) if repaired else 0)
    up = h1 + p1 * np.cos(t2 + t3) + (L2 * np.cos(t2) if repaired else 0)
    points = np.stack(np.broadcast_arrays(out, side, up), axis=-1)
    return (rotation("z", t1) @ points[..., None])[..., 0]


def _joints_in_space(q, sizes, repaired):
    """Points of the robot by name, and its directions x1, y1, x2, x3."""
    h1, L1, h2, L2, p1 = sizes.values()
    t1, t2, t3 = q
    x1, y1, z = rotation("z", t1).T
    x2, x3 = unit_vector([t2, t2 + t3]) @ [z, x1]
    o1 = h1 * z
    elbow = o1 + L1 * x1
    o2 = elbow + h2 * y1
    o3 = o2 + L2 * (x2 if repaired else y1)
    return {"O1": o1, "A": elbow, "O2": o2, "O3": o3, "P": o3 + p1 * x3, "x1": x1, "y1": y1, "x2": x2, "x3": x3}


def _build(bodies, at, sizes, unit, repaired):
    z, r = np.array([0, 0, 1.0]), 0.022 * unit
    bodies.add_tube(-0.015 * unit * z, 0.012 * unit * z, 0.085 * unit, 0.7, caps=True)
    bodies.add_tube((0, 0, 0), at["O1"], r, LINK)
    low = 0.35 * sizes["h1"]
    bodies.add_tube(low * z, (low + 0.09 * unit) * z, 1.7 * r, JOINT, caps=True)
    bodies.add_ball(at["O1"], r, LINK)
    bodies.add_tube(at["O1"], at["A"], r, LINK)
    bodies.add_ball(at["A"], r, LINK)
    bodies.add_tube(at["A"], at["O2"], r, LINK)
    for centre in [at["A"] + 0.5 * sizes["h2"] * at["y1"], (at["O3"] if repaired else (at["O2"] + at["O3"]) / 2)]:
        half = min(0.028 * unit, 0.3 * (sizes["h2"] if centre is not at["O3"] else unit)) * at["y1"]
        bodies.add_tube(centre - half, centre + half, 1.75 * r, JOINT, caps=True)
    if repaired:
        bodies.add_ball(at["O2"], r, LINK)
        bodies.add_tube(at["O2"], at["O3"], r, LINK)
    else:
        bodies.add_tube(at["O2"], at["O3"], r, LINK)
        # A lever on link 2: the only thing that shows theta2 by itself.
        bodies.add_tube(at["O2"], at["O2"] + 0.085 * unit * at["x2"], 0.35 * r, HAND)
        bodies.add_ball(at["O2"] + 0.085 * unit * at["x2"], 0.6 * r, HAND)
    bodies.add_ball(at["O3"], 0.8 * r, HAND)
    length = sizes["p1"]
    bodies.add_tube(at["O3"], at["O3"] + 0.72 * length * at["x3"], 0.75 * r, HAND, caps=True)
    bodies.add_tube(at["O3"] + 0.72 * length * at["x3"], at["P"], 0.3 * r, 0.3)


@styled
def draw_pen_robot(
    q=(np.radians(-25), np.radians(30), np.radians(75)),
    sizes=PEN_SIZES,
    ax=None,
    *,
    repaired=False,
    names=True,
    surface=None,
    sheet=None,
    curve=None,
    trace=None,
):
    """Draw the pen robot as a body, with its surface, a sheet of paper and a drawn curve, as wanted.

    Parameters
    ----------
    q : array-like, shape (3,), in radians
        theta1, theta2, theta3.
    sizes : dict
        h1, L1, h2, L2, p1 in metres.
    repaired : bool
        L2 is the length of a link between joints 2 and 3.
    names : bool
        Write the lengths and angles.
    surface : (low, high), in radians, optional
        Range of theta1 over which the surface of the pen tip is drawn.
    sheet : float, in metres, optional
        Height of a horizontal sheet of paper, on a table in front of the robot.
    curve, trace : array-like, shape (k, 3), in metres, optional
        A wanted curve (broad, light) and what the tip has drawn (thin, dark).

    Returns
    -------
    matplotlib Axes (3D)
    """
    q = as_numbers(q, "q", (3,))
    sizes = _sizes(sizes)
    unit = sum(sizes.values())
    at = _joints_in_space(q, sizes, repaired)
    own, ax = ax is None, ax or new_axes_3d(elev=22, azim=-55 if sheet is None else -80)
    extent = [np.array([at[name] for name in ("O1", "A", "O2", "O3", "P")]), np.array([[0, 0, -0.02 * unit]])]
    if surface is not None:
        extent.append(_draw_surface(ax, as_numbers(surface, "surface", (2,)), sizes))
    if sheet is not None:
        extent.append(_draw_sheet(ax, float(sheet), sizes, repaired))
    for points, pen, name in (
        (curve, {"color": WANTED, "lw": 4.5, "alpha": 0.7}, "curve"),
        (trace, {"color": INK, "lw": 1.3}, "trace"),
    ):
        if points is not None:
            points = as_numbers(points, name, (None, 3))
            ax.plot(*points.T, zorder=3, **pen)
            extent.append(points)
    bodies = Bodies(ax, unit)
    _build(bodies, at, sizes, unit, repaired)
    bodies.draw(ax, zorder=2)
    ax.plot(*at["P"][:, None], "o", ms=4, color=INK, zorder=6)
    extent.append(bodies.points())
    labels = Labels()
    if names:
        extent += _name_lengths(ax, labels, at, q, sizes, unit, repaired)
    fit_3d(ax, np.vstack(extent), own, pad=0.35)
    labels.place(ax)
    return ax


def _name_lengths(ax, labels, at, q, sizes, unit, repaired):
    z, x1, y1 = np.array([0, 0, 1.0]), at["x1"], at["y1"]
    blue = AXIS_COLOURS["z"]
    pen = {"color": SOFT, "lw": 0.9, "ls": CENTRE_LINE, "zorder": 3}
    ends = [at["O1"] + 0.17 * unit * z]
    ax.plot(*zip(at["O1"], ends[0]), **pen)
    labels.ask(ends[0], "axis 1", z, blue, 10)
    last = at["O2"] if repaired else at["O3"]
    tip = last + 0.3 * unit * y1  # beyond the arc of the pen
    ax.plot(*zip(at["A"] - 0.1 * unit * y1, tip), **pen)
    labels.ask(tip, "axis 2" if repaired else "axes 2 and 3", y1, blue, 10)
    ends += [tip, at["A"] - 0.1 * unit * y1]
    if repaired:
        ends.append(at["O3"] + 0.14 * unit * y1)
        ax.plot(*zip(at["O3"], ends[-1]), **pen)
        labels.ask(ends[-1], "axis 3", y1, blue, 10)
    for start, end, name in (
        ((0, 0, 0), at["O1"], "h_1"), (at["O1"], at["A"], "L_1"), (at["A"], at["O2"], "h_2"),
        (at["O2"], at["O3"], "L_2"), (at["O3"], at["P"], "p_1"),
    ):  # fmt: skip
        steps = np.linspace(0, 1, 12)[:, None]
        labels.avoid(np.asarray(start) + steps * (np.asarray(end) - start))
        aside = np.array([-1.0, 0, 0]) if name == "h_1" else z
        labels.ask((np.asarray(start) + end) / 2 + 0.042 * unit * aside, f"${name}$", aside, gap=5, fontsize=12)
    labels.ask(at["P"], "$P$", at["x3"])
    if not repaired:
        radius = 0.19 * unit
        ax.plot(*zip(at["O3"], at["O3"] + 1.15 * radius * z), color=SOFT, lw=0.9, ls=DASHED, zorder=3)
        phi = wrap(q[1] + q[2])
        if abs(phi) > 0.1:
            draw_angle_3d(ax, at["O3"], z, x1, radius, phi, "")
            middle = arc_points(at["O3"], radius, z, x1, phi / 2)
            labels.avoid(arc_points(at["O3"], radius, z, x1, np.linspace(0, phi, 40)))
            labels.ask(middle, r"$\theta_2 + \theta_3$", middle - at["O3"])
    return [np.array(ends)]


def _draw_surface(ax, turn, sizes):
    """The points of the tip for theta1 in the range `turn` and all phi, as a net; returns them."""
    t1 = np.linspace(*turn, max(3, int(np.ptp(turn) / 0.13)))
    phi = np.linspace(0, 2 * np.pi, 37)
    q = np.stack(np.broadcast_arrays(t1[:, None], phi[None, :], 0.0), axis=-1)
    net = pen_tip(q, sizes)
    cells = np.stack([net[:-1, :-1], net[1:, :-1], net[1:, 1:], net[:-1, 1:]], axis=2).reshape(-1, 4, 3)
    paint = {"facecolors": "#dfe9f1", "edgecolors": "#b7c7d4", "linewidths": 0.35, "alpha": 0.6, "zorder": 0.5}
    ax.add_collection3d(Poly3DCollection(cells, **paint), autolim=False)
    for edge in (net[0], net[-1]):
        ax.plot(*edge.T, color="#6c7f8d", lw=1.1, zorder=0.6)
    return net.reshape(-1, 3)


def _draw_sheet(ax, height, sizes, repaired):
    """A table whose top is the sheet, in front of the robot."""
    reach = sizes["L1"] + sizes["p1"] + (sizes["L2"] if repaired else 0)
    near, far, half = 0.3 * reach, 1.0 * reach, 0.55 * reach
    outline = np.array([(near, -half), (far, -half), (far, half), (near, half)])
    draw_prism(ax, outline, 0.0, height, shade=0.97, zorder=0.4)
    return np.column_stack([np.tile(outline, (2, 1)), np.repeat([0.0, height], 4)])


@styled
def draw_pen_views(q=(np.radians(30), 0, np.radians(65)), sizes=PEN_SIZES, ax=None):
    """Draw the pen robot from above, and in the plane of its pen: the two triangles behind its inverse model.

    Parameters
    ----------
    q : array-like, shape (3,), in radians
        theta1, theta2, theta3.
    sizes : dict
        h1, L1, h2, L2, p1 in metres.
    ax : two Axes, optional

    Returns
    -------
    matplotlib Axes
        The one of the pen plane; the view from above is to its left.
    """
    q, sizes = as_numbers(q, "q", (3,)), _sizes(sizes)
    above, plane = plt.subplots(1, 2, figsize=(9.2, 4.2), layout="constrained")[1] if ax is None else np.ravel(ax)
    _draw_from_above(above, q[0], q[1] + q[2], sizes)
    _draw_pen_plane(plane, q[1] + q[2], sizes)
    return plane


def _draw_from_above(ax, turn, phi, sizes):
    """The right-angled triangle of rho, H and r."""
    L1, p1, side = sizes["L1"], sizes["p1"], sizes["h2"] + sizes["L2"]
    unit, rho = L1 + p1 + side, L1 + p1 * np.sin(phi)
    along, across = unit_vector(turn), unit_vector(turn + np.pi / 2)
    elbow, tip = L1 * along, rho * along + side * across
    show_plane(ax)
    ax.set_title("from above", fontsize=10)
    draw_arm(ax, [np.zeros(2), elbow], POSTURE_SHADES[0], width=9)
    draw_link(ax, elbow, elbow + side * across, POSTURE_SHADES[0], 9)
    draw_link(ax, elbow + side * across, tip, POSTURE_SHADES[1], 6)
    for start, end in ((np.zeros(2), rho * along), (rho * along, tip)):
        ax.plot(*zip(start, end), color=INK, lw=1.1, ls=(0, (4, 2)), zorder=2)
    ax.plot(*zip((0, 0), tip), color=INK, lw=1.2, ls=CENTRE_LINE, zorder=5)
    away = 0.055 * unit
    if abs(rho) > 1e-9:
        draw_dimension(ax, (0, 0), rho * along, r"\rho", -np.sign(rho) * 2.4 * away)
    write(ax, rho * along + 0.5 * side * across + away * np.sign(p1 * np.sin(phi) or 1) * along, "$H$")
    write(ax, 0.5 * tip + away * unit_vector(np.arctan2(*tip[::-1]) + np.pi / 2), "$r$")
    write(ax, tip + 1.4 * away * unit_vector(np.arctan2(*tip[::-1])), "$(x, y)$")
    draw_angle(ax, (0, 0), 0.3 * L1, 0, turn, r"\theta_1", 1.4)
    for letter, angle in (("x", 0), ("y", np.pi / 2)):
        draw_axis_arrow(ax, (0, 0), angle, 0.24 * unit, letter, f"{letter}_0")
    ax.plot(*tip, "o", ms=6, color=INK, zorder=7)
    leave_room(ax, 0.13 * unit)


def _draw_pen_plane(ax, phi, sizes):
    """The pen as a radius of its circle about axis 3."""
    L1, p1, h1 = sizes["L1"], sizes["p1"], sizes["h1"]
    unit, rho, z = L1 + p1 + sizes["h2"] + sizes["L2"], L1 + p1 * np.sin(phi), h1 + p1 * np.cos(phi)
    show_plane(ax, labels=(r"$\rho$ (m)", "$z$ (m)"))
    ax.set_title("in the plane of the pen", fontsize=10)
    ax.plot([0, 0], [0, h1 + 1.25 * p1], color=AXIS_COLOURS["z"], lw=1.3, ls=CENTRE_LINE, zorder=2)
    write(ax, (0, h1 + 1.38 * p1), "axis 1", color=AXIS_COLOURS["z"], fontsize=10)
    ax.add_patch(Circle((L1, h1), p1, fill=False, edgecolor=INK, lw=1.3, ls=LIMIT_DASHES, zorder=1.5))
    ax.plot([0, 0, L1], [0, h1, h1], color=SOFT, lw=5, solid_joinstyle="round", zorder=1.8)
    draw_link(ax, (L1, h1), (rho, z), POSTURE_SHADES[1], 7)
    draw_joint(ax, (L1, h1))
    ax.plot(rho, z, "o", ms=6, color=INK, zorder=7)
    ax.plot([L1, L1], [h1, h1 + 0.85 * p1], color=SOFT, lw=1, ls=CENTRE_LINE, zorder=2)
    draw_angle(ax, (L1, h1), 0.55 * p1, np.pi / 2, -phi, r"\varphi", 1.25)
    write(ax, (rho + 0.06 * unit, z + 0.05 * unit), r"$(\rho, z)$", ha="left")
    write(ax, ((L1 + rho) / 2 + 0.03 * unit, (h1 + z) / 2 - 0.05 * unit), "$p_1$")
    draw_dimension(ax, (0, 0), (0, h1), "h_1", 0.1 * unit)
    draw_dimension(ax, (0, h1), (L1, h1), "L_1", -0.1 * unit)
    leave_room(ax, 0.09 * unit)


@styled
def draw_pen_sheet(height, sizes=PEN_SIZES, ax=None):
    """Draw what the printed pen robot can draw on a horizontal sheet: section of its surface, and the sheet from above.

    Parameters
    ----------
    height : float, in metres
        Height z of the sheet.
    sizes : dict
        h1, L1, h2, L2, p1 in metres.
    ax : two Axes, optional

    Returns
    -------
    matplotlib Axes
        Of the sheet; the section is to its left.
    """
    sizes, height = _sizes(sizes), float(as_numbers(height, "height", ()))
    L1, p1, h1, side = sizes["L1"], sizes["p1"], sizes["h1"], sizes["h2"] + sizes["L2"]
    section, paper = plt.subplots(1, 2, figsize=(9.0, 4.3), layout="constrained")[1] if ax is None else np.ravel(ax)
    phi = np.linspace(0, 2 * np.pi, 200)
    r, z = np.hypot(side, L1 + p1 * np.sin(phi)), h1 + p1 * np.cos(phi)
    radii = [np.hypot(side, L1 + s * np.sqrt(max(p1**2 - (height - h1) ** 2, 0))) for s in (1, -1)]
    radii = radii if abs(height - h1) <= p1 else []
    show_plane(section, labels=("distance $r$ from axis 1 (m)", "$z$ (m)"))
    section.set_title("section of the surface", fontsize=10)
    section.plot(r, z, color=INK, lw=1.8)
    section.plot([0, 0], [0, h1 + 1.2 * p1], color=AXIS_COLOURS["z"], lw=1.3, ls=CENTRE_LINE)
    section.plot([0, 1.12 * r.max()], [height] * 2, color="#c79100", lw=1.6, ls=LIMIT_DASHES)
    section.annotate(
        "sheet",
        (1.12 * r.max(), height),
        xytext=(0, 4),
        textcoords="offset points",
        ha="right",
        path_effects=HALO,
    )
    section.axvline(side, color=SOFT, lw=1, ls=(0, (2, 2)), zorder=0.5)
    section.annotate("$H$", (side, 0), xytext=(3, 3), textcoords="offset points")
    show_plane(paper)
    paper.set_title(f"the sheet at $z$ = {height:.2f} m, from above".replace("-", "\N{MINUS SIGN}"), fontsize=10)
    inner, outer = r.min(), r.max()
    paper.add_patch(
        Wedge((0, 0), outer, 0, 360, width=outer - inner, facecolor="#eeeeee", edgecolor="none", zorder=0.5)
    )
    for k, radius in enumerate(radii):
        section.plot(radius, height, "o", ms=8, mfc="white", mec=INK, mew=1.6, zorder=5)
        paper.add_patch(
            Circle((0, 0), radius, fill=False, edgecolor=INK, lw=2.2, ls="-" if k == 0 else LIMIT_DASHES, zorder=3)
        )
        end = radius * unit_vector(np.radians((35, 145)[k]))
        draw_arrow(paper, (0, 0), end, width=1, zorder=2)
        write(paper, 0.55 * end + (0, 0.07 * outer), f"{radius:.3f} m", fontsize=9)
    if not radii:
        write(paper, (0, 0.6 * outer), "no point of this sheet\nis reached")
    draw_joint(paper, (0, 0))
    paper.set_xlim(-1.08 * outer, 1.08 * outer)
    paper.set_ylim(-1.08 * outer, 1.08 * outer)
    section.set_xlim(-0.06 * outer, 1.16 * outer)
    return paper
