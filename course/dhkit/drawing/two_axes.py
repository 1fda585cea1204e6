"""Two joint axes: the link that joins them, their common normal, and the frame that it gives to the first."""

from __future__ import annotations

import numpy as np

from ..geometry import common_normal, link_axis, perpendicular
from .chains import Bodies, Labels, fill_panel
from .inputs import as_line
from .strokes_3d import arc_points, draw_arrow_3d
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, DASHED, INK, SOFT, styled
from .view import fit_3d, new_axes_3d, new_panels_3d, view_axes


@styled
def draw_two_axes(
    first,
    second,
    ax=None,
    *,
    names=("1", "2"),
    normal=True,
    frame=True,
    angle=True,
    body=True,
    base=False,
    points=None,
    view=(20, -58),
):
    """Draw two joint axes, the link between them, their common normal and the frame that it gives to the first.

    Parameters
    ----------
    first, second : (point, direction), each of shape (3,), in metres
        The points are where the joints are drawn.
    names : (text, text)
        Indices of the two axes.
    normal, frame, angle : bool
        Draw the common normal with its length a; the frame on the first axis; the angle alpha.
    body : bool
        Draw the joints and the link between them.
    base : bool
        Draw the frame in which points and directions are given.
    points : (text, text), optional
        Names of the two points.
    view : (elevation, azimuth), in degrees

    Returns
    -------
    matplotlib Axes (3D)
    """
    first, second = as_line(first, "first axis"), as_line(second, "second axis")
    own, ax = ax is None, ax or new_axes_3d(*view)
    labels = Labels()
    parts = {"normal": normal, "frame": frame, "angle": angle, "body": body, "base": base, "points": points}
    extent = add_two_axes(ax, labels, first, second, names, **parts)
    fit_3d(ax, extent, own, pad=0.42)
    labels.place(ax)
    return ax


def add_two_axes(ax, labels, first, second, names=("1", "2"), *, normal, frame, angle, body, base=False, points=None):
    """Add two joint axes, given as point and unit vector; returns the points that a view must hold."""
    feet = common_normal(first, second).feet
    (p, u), (q, v) = first, second
    spots = np.array([p, q, *feet] + ([np.zeros(3)] if base else []))
    unit = np.linalg.norm(np.ptp(spots, axis=0)) or 1.0
    extent, (i, j) = [spots], names
    if body:
        radius = 0.03 * unit
        bodies = Bodies(ax, unit)
        bodies.add_tube(p, q, radius, 0.86)
        for at, along in ((p, u), (q, v)):
            bodies.add_tube(at - 2.2 * radius * along, at + 2.2 * radius * along, 1.9 * radius, 0.97, caps=True)
        bodies.draw(ax)
        extent.append(bodies.points())
    for at, along, foot, name in ((p, u, feet[0], i), (q, v, feet[1], j)):
        places = [(spot - foot) @ along for spot in ((at, foot) if normal or body else (at,))]
        low, high = foot + (min(places) - 0.25 * unit) * along, foot + (max(places) + 0.5 * unit) * along
        ax.plot(*zip(low, high), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=2)
        add_axis(ax, labels, high - 0.27 * unit * along, along, 0.27 * unit, "z", name)
        labels.avoid(np.linspace(low, high, 12))
        extent.append(np.array([low, high]))
    for at, along, name in zip((p, q), (u, v), points or ()):
        ax.plot(*at[:, None], "o", ms=4.5, color=INK, zorder=8)
        labels.ask(at, f"${name}$", np.cross(along, view_axes(ax)[2]), gap=12)
    if not normal and not frame and not angle:
        return np.vstack([*extent, *_base(ax, labels, base, unit)])
    x = link_direction(first, second)
    if normal:
        _normal(ax, labels, feet, u, v, x, i, unit)
    if frame:
        size = 0.3 * unit
        for letter, along in (("x", x), ("y", np.cross(u, x))):
            add_axis(ax, labels, feet[0], along, size, letter, i)
            extent.append((feet[0] + size * along)[None])
    alpha = np.arctan2(np.cross(u, v) @ x, u @ v)
    if angle and abs(np.sin(alpha)) > 1e-6:
        size = 0.36 * unit
        ax.plot(*zip(feet[1], feet[1] + 1.1 * size * u), color=SOFT, lw=1, ls=DASHED, zorder=3)
        add_arc(ax, labels, feet[1], u, np.cross(x, u), 0.8 * size, alpha, rf"\alpha_{{{i}}}")
        extent.append((feet[1] + 1.1 * size * u)[None])
    return np.vstack([*extent, *_base(ax, labels, base, unit)])


def _base(ax, labels, wanted, unit):
    """The frame in which the lines are given; the points that a view must hold."""
    if not wanted:
        return []
    for letter, along in zip("xyz", np.eye(3)):
        add_axis(ax, labels, np.zeros(3), along, 0.25 * unit, letter, "0")
    return [0.25 * unit * np.eye(3)]


def link_direction(first, second) -> np.ndarray:
    """X of the link between two axes, shape (3,): where they lie on one line, any direction at right angles to it.

    Parameters
    ----------
    first, second : (point, direction), each of shape (3,), in metres
    """
    normal = common_normal(first, second)
    return perpendicular(first[1]) if normal.parallel and normal.meeting else link_axis(first, second)


def _normal(ax, labels, feet, u, v, x, name, unit):
    """A common normal with its right angles, its length and the origin at its first foot."""
    if np.linalg.norm(feet[1] - feet[0]) > 1e-9:
        ax.plot(*feet.T, color=INK, lw=2.8, zorder=4, solid_capstyle="round")
        for foot, along, way in ((feet[0], u, x), (feet[1], v, -x)):
            corner = foot + 0.05 * unit * np.array([along, along + way, way])
            ax.plot(*corner.T, color=INK, lw=0.9, zorder=4)
        labels.ask(feet.mean(axis=0), f"$a_{{{name}}}$", np.cross(x, view_axes(ax)[2]), gap=7)
        labels.avoid(np.linspace(*feet, 12))
    ax.plot(*feet[0][:, None], "o", ms=5.5, color=INK, zorder=8)
    labels.ask(feet[0], f"$O_{{{name}}}$", -x - 0.6 * u, gap=7)


def add_axis(ax, labels, origin, along, size, letter, name, width=2.0, out=None):
    """Add one axis of a frame, with its label past the tip or on the side `out`."""
    end = origin + size * along
    draw_arrow_3d(ax, origin, end, AXIS_COLOURS[letter], AXIS_DASHES[letter], width=width)
    labels.ask(end, f"${letter.upper()}_{{{name}}}$", along if out is None else out, AXIS_COLOURS[letter])
    labels.avoid(np.linspace(origin, end, 7)[1:])


def add_arc(ax, labels, centre, start, side, radius, sweep, label, colour=INK):
    """Add the arc of an angle with its arrow head; the label is placed with the others."""
    arc = arc_points(centre, radius, start, side, np.linspace(0, sweep, 40))
    ax.plot(*arc[:-3].T, color=colour, lw=1.4, zorder=5)
    draw_arrow_3d(ax, arc[-6], arc[-1], colour, width=1.3, scale=9, zorder=5)
    middle = arc[len(arc) // 2]
    labels.ask(middle, f"${label}$", middle - centre, colour, gap=5)
    labels.avoid(arc[::4])


@styled
def draw_axis_cases():
    """Draw the three cases of two neighbouring axes side by side: skew, intersecting, parallel.

    Where the rule leaves a choice, the other choices are drawn thin.

    Returns
    -------
    list of 3 matplotlib Axes (3D)
    """
    z = np.array([0, 0, 1.0])
    cases = (
        ("skew", ((0, 0, 0.1), z), ((0.9, 0.25, 0.35), (0, -0.6, 0.8))),
        ("intersecting", ((0, 0, -0.45), z), ((0.42, 0, -0.25), (0.86, 0, -0.51))),
        ("parallel", ((0, 0, 0), z), ((0.9, 0, 0.2), z)),
    )
    panels = new_panels_3d([kind for kind, *_ in cases], width=3.4, height=4.0)
    for ax, (kind, first, second) in zip(panels, cases):
        first, second = as_line(first, "axis"), as_line(second, "axis")
        labels = Labels()
        extent = [
            add_two_axes(ax, labels, first, second, normal=True, frame=False, angle=kind != "parallel", body=False)
        ]
        feet = common_normal(first, second).feet
        unit = np.linalg.norm(np.ptp(extent[0], axis=0))
        x, size = link_direction(first, second), 0.2 * unit
        add_axis(ax, labels, feet[0], x, size, "x", "1")
        extent.append(feet[:1] + size * x)
        if kind == "intersecting":
            draw_arrow_3d(ax, feet[0], feet[0] - size * x, AXIS_COLOURS["x"], width=0.9)
            labels.ask(feet[0] - size * x, "or", -x, AXIS_COLOURS["x"], fontsize=9)
            extent.append(feet[:1] - size * x)
        if kind == "parallel":
            for rise in (-0.25, 0.22, 0.44):
                ax.plot(*(feet + rise * z).T, color=SOFT, lw=1, ls=DASHED, zorder=3)
                ax.plot(*(feet[0] + rise * z)[:, None], "o", ms=4, mfc="white", mec=SOFT, zorder=7)
        fill_panel(ax, np.vstack(extent))
        labels.place(ax)
    return panels
