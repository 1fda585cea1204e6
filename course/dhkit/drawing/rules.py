"""Drawings of the parameter rules: two axes and their common normal, the four parameters one by one, a gripper's frame."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np

from .. import strokes
from .chains import Bodies, Labels, fill_panel

THIN = (0, (3, 2))


def common_normal(first, second) -> tuple[np.ndarray, str]:
    """Feet of a common normal of two lines, shape (2, 3), and whether they are skew, parallel, intersecting or the same.

    Parameters
    ----------
    first, second : (point, direction), each of shape (3,), in metres

    Where the lines are parallel, the normal through the point of the first is taken.
    """
    (p, u), (q, v) = _as_line(first, "first axis"), _as_line(second, "second axis")
    sine = np.linalg.norm(np.cross(u, v))
    if sine < 1e-9:
        feet = np.array([p, q + ((p - q) @ v) * v])
        return feet, "parallel" if np.linalg.norm(feet[1] - feet[0]) > 1e-9 else "the same"
    s, t = np.linalg.solve([[1, -(u @ v)], [u @ v, -1]], [(q - p) @ u, (q - p) @ v])
    feet = np.array([p + s * u, q + t * v])
    return feet, "skew" if np.linalg.norm(feet[1] - feet[0]) > 1e-9 else "intersecting"


def _as_line(line, what):
    try:
        point, direction = line
    except (TypeError, ValueError):
        raise ValueError(f"{what}: expected a point and a direction, found {line!r}") from None
    point, direction = (
        strokes.as_numbers(point, f"{what}, point", (3,)),
        strokes.as_numbers(direction, f"{what}, direction", (3,)),
    )
    length = np.linalg.norm(direction)
    if length < 1e-12:
        raise ValueError(f"{what}, direction: expected a vector that is not zero")
    return point, direction / length


@strokes.styled
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
    """Two joint axes as lines, the link that joins them, their common normal and the frame that it gives to the first.

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
    first, second = _as_line(first, "first axis"), _as_line(second, "second axis")
    own, ax = ax is None, ax or strokes.new_axes_3d(*view)
    labels = Labels()
    parts = {"normal": normal, "frame": frame, "angle": angle, "body": body, "base": base, "points": points}
    extent = add_two_axes(ax, labels, first, second, names, **parts)
    strokes.fit_3d(ax, extent, own, pad=0.42)
    labels.place(ax)
    return ax


def add_two_axes(ax, labels, first, second, names=("1", "2"), *, normal, frame, angle, body, base=False, points=None):
    """The drawing of two axes; returns the points that a view must hold."""
    feet, _ = common_normal(first, second)
    (p, u), (q, v) = first, second
    spots = np.array([p, q, *feet] + ([np.zeros(3)] if base else []))
    unit = np.linalg.norm(np.ptp(spots, axis=0)) or 1.0
    extent, (i, j) = [spots], names
    if body:
        radius = 0.03 * unit
        bodies = Bodies(ax, unit)
        bodies.tube(p, q, radius, 0.86)
        for at, along in ((p, u), (q, v)):
            bodies.tube(at - 2.2 * radius * along, at + 2.2 * radius * along, 1.9 * radius, 0.97, caps=True)
        bodies.draw(ax)
        extent.append(bodies.points())
    for at, along, foot, name in ((p, u, feet[0], i), (q, v, feet[1], j)):
        places = [(spot - foot) @ along for spot in ((at, foot) if normal or body else (at,))]
        low, high = foot + (min(places) - 0.25 * unit) * along, foot + (max(places) + 0.5 * unit) * along
        ax.plot(*zip(low, high), color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=2)
        add_axis(ax, labels, high - 0.27 * unit * along, along, 0.27 * unit, "z", name)
        labels.avoid(np.linspace(low, high, 12))
        extent.append(np.array([low, high]))
    for at, along, name in zip((p, q), (u, v), points or ()):
        ax.plot(*at[:, None], "o", ms=4.5, color=strokes.INK, zorder=8)
        labels.ask(at, f"${name}$", np.cross(along, towards(ax)), gap=12)
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
        ax.plot(*zip(feet[1], feet[1] + 1.1 * size * u), color=strokes.SOFT, lw=1, ls=THIN, zorder=3)
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
    """X of the link between two axes: along the common normal from the first to the second, or normal to both."""
    feet, kind = common_normal(first, second)
    u, v = (_as_line(line, "axis")[1] for line in (first, second))
    if kind in ("skew", "parallel"):
        x = feet[1] - feet[0]
    elif kind == "intersecting":
        x = np.cross(u, v)
    else:
        x = np.cross(u, np.eye(3)[np.argmin(np.abs(u))])
    return x / np.linalg.norm(x)


def _normal(ax, labels, feet, u, v, x, name, unit):
    """A common normal with its right angles, its length and the origin at its first foot."""
    if np.linalg.norm(feet[1] - feet[0]) > 1e-9:
        ax.plot(*feet.T, color=strokes.INK, lw=2.8, zorder=4, solid_capstyle="round")
        for foot, along, way in ((feet[0], u, x), (feet[1], v, -x)):
            corner = foot + 0.05 * unit * np.array([along, along + way, way])
            ax.plot(*corner.T, color=strokes.INK, lw=0.9, zorder=4)
        labels.ask(feet.mean(axis=0), f"$a_{{{name}}}$", np.cross(x, towards(ax)), gap=7)
        labels.avoid(np.linspace(*feet, 12))
    ax.plot(*feet[0][:, None], "o", ms=5.5, color=strokes.INK, zorder=8)
    labels.ask(feet[0], f"$O_{{{name}}}$", -x - 0.6 * u, gap=7)


def add_axis(ax, labels, origin, along, size, letter, name, width=2.0, out=None):
    """One axis of a frame, with its label past the tip or on the side `out`."""
    end = origin + size * along
    strokes.arrow_3d(ax, origin, end, strokes.AXIS_COLOURS[letter], strokes.AXIS_DASHES[letter], width=width)
    labels.ask(end, f"${letter.upper()}_{{{name}}}$", along if out is None else out, strokes.AXIS_COLOURS[letter])
    labels.avoid(np.linspace(origin, end, 7)[1:])


def towards(ax):
    elev, azim = np.radians([ax.elev, ax.azim])
    return np.array([np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)])


def add_arc(ax, labels, centre, start, side, radius, sweep, label, colour=strokes.INK):
    """Arc of an angle with its arrow head; the label is placed with the others."""
    turn = np.linspace(0, sweep, 40)
    arc = centre + radius * (np.outer(np.cos(turn), start) + np.outer(np.sin(turn), side))
    ax.plot(*arc[:-3].T, color=colour, lw=1.4, zorder=5)
    strokes.arrow_3d(ax, arc[-6], arc[-1], colour, width=1.3, scale=9, zorder=5)
    middle = arc[len(arc) // 2]
    labels.ask(middle, f"${label}$", middle - centre, colour, gap=5)
    labels.avoid(arc[::4])


# ---------------------------------------------------------------- several small spaces in one figure


def panels_3d(titles, width=3.5, height=3.6, columns=None, view=(20, -58)):
    """Spaces side by side in one figure, a title over each; `width` and `height` of each in inches."""
    count = len(titles)
    columns = columns or count
    rows = -(-count // columns)
    figure = plt.figure(figsize=(width * columns, height * rows))
    axes = []
    for k, title in enumerate(titles):
        left, bottom = (k % columns) / columns, 1 - (k // columns + 1) / rows
        ax = figure.add_axes(
            (left, bottom, 1 / columns, (1 - 0.32 / height) / rows), projection="3d", computed_zorder=False
        )
        ax.view_init(*view)
        ax.set_proj_type("ortho")
        ax.set_axis_off()
        ax.set_clip_on(False)
        figure.text(
            left + 0.5 / columns, bottom + (1 - 0.12 / height) / rows, title, ha="center", va="top", fontsize=11
        )
        axes.append(ax)
    return axes


@strokes.styled
def draw_axis_cases():
    """The three cases of two neighbouring axes side by side: skew, intersecting, parallel.

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
    panels = panels_3d([kind for kind, *_ in cases], width=3.4, height=4.0)
    for ax, (kind, first, second) in zip(panels, cases):
        first, second = _as_line(first, "axis"), _as_line(second, "axis")
        labels = Labels()
        extent = [
            add_two_axes(ax, labels, first, second, normal=True, frame=False, angle=kind != "parallel", body=False)
        ]
        feet, _ = common_normal(first, second)
        unit = np.linalg.norm(np.ptp(extent[0], axis=0))
        x, size = link_direction(first, second), 0.2 * unit
        add_axis(ax, labels, feet[0], x, size, "x", "1")
        extent.append(feet[:1] + size * x)
        if kind == "intersecting":
            strokes.arrow_3d(ax, feet[0], feet[0] - size * x, strokes.AXIS_COLOURS["x"], width=0.9)
            labels.ask(feet[0] - size * x, "or", -x, strokes.AXIS_COLOURS["x"], fontsize=9)
            extent.append(feet[:1] - size * x)
        if kind == "parallel":
            for rise in (-0.25, 0.22, 0.44):
                ax.plot(*(feet + rise * z).T, color=strokes.SOFT, lw=1, ls=THIN, zorder=3)
                ax.plot(*(feet[0] + rise * z)[:, None], "o", ms=4, mfc="white", mec=strokes.SOFT, zorder=7)
        fill_panel(ax, np.vstack(extent))
        labels.place(ax)
    return panels


# ---------------------------------------------------------------- the four parameters, one at a time

STEPS = ("a", "alpha", "d", "theta")


@strokes.styled
def draw_parameter(step, a=1.0, alpha=np.radians(40), d=0.9, theta=np.radians(50), ax=None):
    """One of the four parameters between two frames: what it is measured from, to, and along or about.

    Parameters
    ----------
    step : "a", "alpha", "d" or "theta"
    a, d : float, in metres
    alpha, theta : float, in radians

    Returns
    -------
    matplotlib Axes (3D)
    """
    if step not in STEPS:
        raise ValueError(f"step: expected one of {', '.join(STEPS)}, found {step!r}")
    values = strokes.as_numbers([a, alpha, d, theta], "a, alpha, d, theta", (4,))
    own, ax = ax is None, ax or strokes.new_axes_3d(20, -58)
    labels = Labels()
    extent = _parameter(ax, labels, step, *values)
    strokes.fit_3d(ax, extent, own, pad=0.42)
    labels.place(ax)
    return ax


@strokes.styled
def draw_parameter_steps(a=1.0, alpha=np.radians(40), d=0.9, theta=np.radians(50)):
    """The four parameters between two frames, in four spaces: what each is measured from, to, and along or about.

    Parameters
    ----------
    a, d : float, in metres
    alpha, theta : float, in radians

    Returns
    -------
    list of 4 matplotlib Axes (3D)
    """
    values = strokes.as_numbers([a, alpha, d, theta], "a, alpha, d, theta", (4,))
    titles = (
        r"$a_{i-1}$: from $Z_{i-1}$ to $Z_i$ along $X_{i-1}$",
        r"$\alpha_{i-1}$: from $Z_{i-1}$ to $Z_i$ about $X_{i-1}$",
        r"$d_i$: from $X_{i-1}$ to $X_i$ along $Z_i$",
        r"$\theta_i$: from $X_{i-1}$ to $X_i$ about $Z_i$",
    )
    panels = panels_3d(titles, width=4.2, height=3.9, columns=2)
    for ax, step in zip(panels, STEPS):
        labels = Labels()
        fill_panel(ax, _parameter(ax, labels, step, *values), share=0.8)
        labels.place(ax)
    return panels


def _parameter(ax, labels, step, a, alpha, d, theta):
    x0, z0 = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    z1 = np.array([0, -np.sin(alpha), np.cos(alpha)])
    side = np.cross(z1, x0)
    x1 = np.cos(theta) * x0 + np.sin(theta) * side
    foot, size = a * x0, 0.5
    origin = foot + d * z1
    lines = (
        (np.zeros(3), z0, -0.3, 1.0), (foot, z1, min(d, 0) - 0.35, max(d, 0) + 0.75), (np.zeros(3), x0, min(a, 0) - 0.2, max(a, 0) + 0.5)
    )  # fmt: skip
    extent = []
    for base, along, low, high in lines:
        ends = np.array([base + low * along, base + high * along])
        ax.plot(*ends.T, color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=1)
        extent.append(ends)
    for start, end in ((np.zeros(3), foot), (foot, origin)):
        ax.plot(*zip(start, end), color=strokes.FAINT, lw=6, zorder=1.5, solid_capstyle="round")
    for at, letter, along, name, length in (
        (np.zeros(3), "z", z0, "i-1", 1.0), (np.zeros(3), "x", x0, "i-1", size), (origin, "z", z1, "i", 0.7), (origin, "x", x1, "i", size)
    ):  # fmt: skip
        asked = letter == ("z" if step in ("a", "alpha") else "x")
        out = -z0 if (letter, name) == ("x", "i-1") else None
        add_axis(ax, labels, at, along, length, letter, name, 2.4 if asked else 1.3, out)
        extent.append((at + length * along)[None])
    for at, name, out in ((np.zeros(3), "i-1", -x0 - z0), (origin, "i", side - x1)):
        ax.plot(*at[:, None], "o", ms=5, color=strokes.INK, zorder=7)
        labels.ask(at, f"$O_{{{name}}}$", out, gap=6)
    if step == "a":
        _measure(ax, labels, np.zeros(3), foot, "a_{i-1}", z0)
    elif step == "alpha":
        ax.plot(*zip(foot, foot + 0.85 * z0), color=strokes.AXIS_COLOURS["z"], lw=1, ls=THIN, zorder=2)
        add_arc(ax, labels, foot, z0, -np.array([0, 1.0, 0]), 0.6, alpha, r"\alpha_{i-1}")
        extent.append((foot + 0.85 * z0)[None])
    elif step == "d":
        _measure(ax, labels, foot, origin, "d_i", x0)
    else:
        ax.plot(*zip(origin, origin + 0.62 * x0), color=strokes.AXIS_COLOURS["x"], lw=1, ls=THIN, zorder=2)
        add_arc(ax, labels, origin, x0, side, 0.42, theta, r"\theta_i")
        extent.append((origin + 0.62 * x0)[None])
    return np.vstack(extent)


def _measure(ax, labels, start, end, label, aside):
    """A length as a bold arrow from where it is measured to where."""
    if np.linalg.norm(end - start) < 1e-9:
        return
    strokes.arrow_3d(ax, start, end, strokes.INK, width=3, scale=15, zorder=5)
    labels.ask((start + end) / 2, f"${label}$", aside, gap=8)
    labels.avoid(np.linspace(start, end, 10))


# ---------------------------------------------------------------- a gripper


@strokes.styled
def draw_gripper(opening=0.5, ax=None):
    """A gripper over a part, with its frame: Z towards the part, Y along the sliding of the jaws, X normal to both.

    Parameters
    ----------
    opening : float from 0 to 1

    Returns
    -------
    matplotlib Axes (3D)
    """
    opening = float(np.clip(strokes.as_numbers(opening, "opening", ()), 0, 1))
    own, ax = ax is None, ax or strokes.new_axes_3d(20, -38)
    bodies = Bodies(ax, 1.3, fine=24)
    z, y = np.array([0, 0, -1.0]), np.array([0, -1.0, 0])
    x = np.cross(y, z)
    axes = np.column_stack([x, y, z])
    gap = 0.11 + 0.22 * opening
    bodies.tube((0, 0, 1.0), (0, 0, 0.62), 0.09, 0.86, caps=True)
    bodies.box(np.array([0, 0, 0.52]), axes, (0.12, 0.5, 0.1), 0.9, cells=6)
    for way in (-1, 1):
        bodies.box(np.array([0, way * (gap + 0.05), 0.16]), axes, (0.09, 0.05, 0.26), 0.68, cells=5)
    bodies.box(np.array([0, 0, -0.42]), axes, (0.1, 0.1, 0.1), 0.97)
    bodies.draw(ax)
    labels = Labels()
    for letter, along, size in (("x", x, 0.5), ("y", y, 0.72), ("z", z, 0.38)):
        add_axis(ax, labels, np.zeros(3), along, size, letter, "E", width=2.2)
    ax.plot(0, 0, 0, "o", ms=5.5, color=strokes.INK, zorder=8)
    labels.ask(np.zeros(3), "$O_{E}$", -x + 0.3 * z, gap=8)
    for way in (-1, 1):
        foot = np.array([0.12, way * (gap + 0.05), 0.3])
        strokes.arrow_3d(ax, foot, foot + way * np.array([0, 0.2, 0]), width=1.4)
        strokes.arrow_3d(ax, foot, foot - way * np.array([0, 0.12, 0]), width=1.4)
    labels.ask(np.array([0.12, gap + 0.25, 0.3]), "jaws slide", -y, fontsize=10, gap=8)
    labels.ask(np.array([0.1, 0.1, -0.42]), "part", -y, fontsize=10, gap=10)
    strokes.fit_3d(ax, np.vstack([bodies.points(), 0.75 * np.vstack([x, y, z, -x])]), own, pad=0.42)
    labels.place(ax)
    return ax
