"""Drawings of displacements: one point in two frames, elementary moves, walks from frame to frame, two conventions."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Rectangle

from ..geometry import chain_products, rot, trans, unit_vector
from .frames import merge_axes
from .inputs import as_number, as_numbers
from .strokes import draw_angle, draw_arrow, draw_axis_arrow, draw_link, new_axes, show_bare, write
from .strokes_3d import draw_angle_3d, draw_arrow_3d, write_3d
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, DASHED, FAINT, INK, SOFT, styled
from .view import add_axes_3d, fit_3d, new_axes_3d

SYMBOLS = {"trans_x": "a", "rot_x": r"\alpha", "trans_z": "d", "rot_z": r"\theta"}
MODIFIED = ("trans_x", "rot_x", "trans_z", "rot_z")
CLASSIC = ("rot_z", "trans_z", "trans_x", "rot_x")
VIEW = {"elev": 20, "azim": -58}


def elementary_move(kind: str, value: float) -> np.ndarray:
    """Matrix of one move "trans_x", "rot_x", "trans_z" or "rot_z", by metres or radians: shape (4, 4)."""
    if kind not in SYMBOLS:
        raise ValueError(f"moves: expected one of {', '.join(SYMBOLS)}, found {kind!r}")
    verb, axis = kind.split("_")
    return (trans if verb == "trans" else rot)(axis, as_number(value, kind))


def walk_frames(moves: Sequence[tuple[str, float]]) -> np.ndarray:
    """The frames of a walk, first the one it starts from: each move along or about the axes reached so far.

    Parameters
    ----------
    moves : sequence of (kind, value)
        Kind "trans_x", "rot_x", "trans_z" or "rot_z"; value in metres or radians.

    Returns
    -------
    ndarray, shape (n + 1, 4, 4)
    """
    return chain_products(np.reshape([elementary_move(kind, value) for kind, value in moves], (-1, 4, 4)))


@styled
def draw_walk(moves, ax=None, *, progress=None, names=("i-1", "i"), labels=None, size=0.5):
    """Draw a walk from frame to frame in space: translations as strokes, rotations as arcs, the frames on the way thin.

    Parameters
    ----------
    moves : sequence of (kind, value)
        Kind "trans_x", "rot_x", "trans_z" or "rot_z"; value in metres or radians.
    progress : float, optional
        How many moves to make; 2.5 stops halfway through the third. By default all. The view does not depend on it.
    names : (text, text)
        Indices of the first frame and of the last.
    labels : sequence of texts, optional
        The name of each value; by default a, alpha, d, theta.
    size : float, in metres
        Length of the axes.

    Returns
    -------
    matplotlib Axes (3D)
    """
    moves = [(kind, as_number(value, str(kind))) for kind, value in moves]
    full = walk_frames(moves)
    labels = [SYMBOLS[kind] for kind, _ in moves] if labels is None else list(labels)
    if len(labels) != len(moves):
        raise ValueError(f"labels: expected {len(moves)}, found {len(labels)}")
    done = len(moves) if progress is None else float(np.clip(as_numbers(progress, "progress", ()), 0, len(moves)))
    own, ax = ax is None, ax or new_axes_3d(**VIEW)
    frame = full[0]
    for k, ((kind, value), label) in enumerate(zip(moves, labels)):
        share = min(max(done - k, 0.0), 1.0)
        if share == 0:
            break
        _leave_frame(ax, frame, size)
        _draw_move(ax, frame, kind, share * value, label, size)
        frame = frame @ elementary_move(kind, share * value)
    moved = done > 0 and not np.allclose(frame, full[0], atol=1e-9)
    ends = [full[0], frame] if moved else [full[0]]
    stroke = moves[0][0][-1] if any(k == f"trans_{moves[0][0][-1]}" for k, _ in moves[:2]) else None
    _name_frames(ax, ends, names, size, stroke)
    for end in ends:
        ax.plot(*end[:3, 3:], "o", ms=4.5, color=INK, zorder=7)
    tips = full[:, None, :3, 3] + 1.45 * size * full[:, :3, :3].swapaxes(1, 2)
    fit_3d(ax, np.vstack([full[:, :3, 3], tips.reshape(-1, 3)]), own)
    return ax


def _name_frames(ax, frames, names, size, stroke):
    """Frames with their labels; on the first frame the axis that carries a `stroke` has its label beside it."""
    for axis in merge_axes(frames, names, "xyz"):
        colour, tip = AXIS_COLOURS[axis.letter], axis.origin + size * axis.direction
        draw_arrow_3d(ax, axis.origin, tip, colour, AXIS_DASHES[axis.letter], zorder=6)
        at = axis.origin + 1.28 * size * axis.direction
        if axis.letter == stroke and axis.owners[0] == names[0]:
            at = tip + 0.24 * size * {"x": frames[0][:3, 2], "z": -frames[0][:3, 0]}[axis.letter]
        write_3d(ax, at, axis.label, color=colour)


def _leave_frame(ax, frame, size):
    """The axes of a frame that the walk has left: thin lines, no labels."""
    for letter, axis in zip("xyz", frame[:3, :3].T):
        ends = zip(frame[:3, 3], frame[:3, 3] + 0.8 * size * axis)
        ax.plot(*ends, color=AXIS_COLOURS[letter], ls=AXIS_DASHES[letter], lw=0.8, alpha=0.6, zorder=3)


def _draw_move(ax, frame, kind, value, label, size):
    x, y, z, origin = frame[:3].T
    if kind.startswith("trans"):
        upright = np.allclose(frame[:3, 2], (0, 0, 1))
        axis, aside = (x, -z) if kind == "trans_x" else (z, x if upright else -y)
        ax.plot(*zip(origin, origin + value * axis), color=INK, lw=3, zorder=4, solid_capstyle="round")
        if abs(value) > 0.3 * size:
            write_3d(ax, origin + 0.5 * value * axis + 0.22 * size * aside, f"${label}$")
    elif abs(value) > 0.03:
        start, side = (z, -y) if kind == "rot_x" else (x, y)
        draw_angle_3d(ax, origin, start, side, 0.72 * size, value, label if abs(value) > 0.15 else "", 1.32)


@styled
def draw_elementary_moves(a=0.75, alpha=np.radians(40), d=0.85, theta=np.radians(50)):
    """Draw the four elementary moves side by side, each from one and the same frame.

    Parameters
    ----------
    a, d : float, in metres
    alpha, theta : float, in radians

    Returns
    -------
    list of 4 matplotlib Axes (3D)
    """
    values = as_numbers([a, alpha, d, theta], "a, alpha, d, theta", (4,))
    figure = plt.figure(figsize=(9.6, 3.1))
    panels = []
    for k, ((kind, symbol), value) in enumerate(zip(SYMBOLS.items(), values)):
        ax = add_axes_3d(figure, (0.25 * k - 0.01, -0.1, 0.28, 1.0), **VIEW)
        draw_walk([(kind, value)], ax, names=("A", "B"), size=0.62)
        _same_view(ax, (-0.35, -0.3, -0.4), (1.5, 0.9, 1.5), 1.4)
        verb, axis = kind.split("_")
        figure.text(0.125 + 0.25 * k, 0.95, rf"$\mathrm{{{verb.title()}}}_{axis}({symbol})$", ha="center", va="center")
        panels.append(ax)
    return panels


def _same_view(ax, low, high, zoom):
    """One view for panels that are compared."""
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    ax.set_box_aspect(np.subtract(high, low), zoom=zoom)


@styled
def draw_two_orders(first=("rot_x", np.radians(60)), second=("trans_z", 0.9)):
    """Draw two moves made in both orders, side by side.

    Parameters
    ----------
    first, second : (kind, value)
        Kind "trans_x", "rot_x", "trans_z" or "rot_z"; value in metres or radians.

    Returns
    -------
    list of 2 matplotlib Axes (3D)
    """
    figure = plt.figure(figsize=(8.6, 4.0))
    orders = [list(moves) for moves in ([first, second], [second, first])]
    frames = np.vstack([walk_frames(moves) for moves in orders])
    tips = (frames[:, None, :3, 3] + 0.72 * frames[:, :3, :3].swapaxes(1, 2)).reshape(-1, 3)
    panels = []
    for k, moves in enumerate(orders):
        ax = add_axes_3d(figure, (0.5 * k, -0.04, 0.5, 0.98), **VIEW)
        draw_walk(moves, ax, names=("A", "B"), size=0.5)
        _same_view(ax, tips.min(axis=0), tips.max(axis=0), 1.3)
        title = r"\;".join(rf"\mathrm{{{kind.split('_')[0].title()}}}_{kind[-1]}({SYMBOLS[kind]})" for kind, _ in moves)
        figure.text(0.25 + 0.5 * k, 0.95, f"${title}$", ha="center", va="center", fontsize=12)
        panels.append(ax)
    return panels


@styled
def draw_point_in_two_frames(shift=(0.7, 0.35), turn=np.radians(30), point=(0.55, 0.3), ax=None):
    """Draw one point read in two frames of a plane: A, and B moved by `shift` and turned by `turn`.

    Parameters
    ----------
    shift : array-like, shape (2,), in metres
        Origin of frame B in frame A.
    turn : float, in radians
        Angle from x_A to x_B.
    point : array-like, shape (2,), in metres
        The point in frame B.

    Returns
    -------
    matplotlib Axes
    """
    shift = as_numbers(shift, "shift", (2,))
    turn = float(as_numbers(turn, "turn", ()))
    point = as_numbers(point, "point", (2,))
    x, y = unit_vector(turn), unit_vector(turn + np.pi / 2)
    seen = shift + point[0] * x + point[1] * y
    ax = ax or new_axes((6.0, 4.4))
    show_bare(ax)
    feet = ((np.array([seen[0], 0]), np.array([0, seen[1]]), "A"), (shift + point[0] * x, shift + point[1] * y, "B"))
    for (foot_x, foot_y, name), (along, up) in zip(feet, ((0, 1), (turn, turn + np.pi / 2))):
        for foot in (foot_x, foot_y):
            ax.plot(*zip(foot, seen), color=SOFT, lw=1, ls=DASHED, zorder=2)
            ax.plot(*foot, "o", ms=3.5, color=INK, zorder=7)
        below, left = unit_vector(along - np.pi / 2), unit_vector(up + np.pi / 2)
        write(ax, foot_x + 0.08 * below, f"${{}}^{name}x$")
        write(ax, foot_y + 0.08 * left, f"${{}}^{name}y$")
    for origin, angle, name, reach in ((np.zeros(2), 0.0, "A", (1.4, 1.05)), (shift, turn, "B", (0.85, 0.6))):
        draw_axis_arrow(ax, origin, angle, reach[0], "x", f"x_{name}", away=0.07, neck=0.96)
        draw_axis_arrow(ax, origin, angle + np.pi / 2, reach[1], "y", f"y_{name}", away=0.1, neck=0.96)
        ax.plot(*origin, "o", ms=4.5, color=INK, zorder=7)
        write(ax, origin - 0.07 * (unit_vector(angle) + unit_vector(angle + np.pi / 2)), f"$O_{name}$")
    draw_arrow(ax, (0, 0), shift, width=1.3, neck=0.94)
    write(ax, 0.5 * shift + (-0.05, 0.07), r"$\mathbf{t}$")
    ax.plot(*zip(shift, shift + (0.4, 0)), color=SOFT, lw=0.9, ls=DASHED, zorder=2)
    draw_angle(ax, shift, 0.3, 0, turn, r"\varphi" if abs(turn) > 0.12 else "", 1.3)
    ax.plot(*seen, "o", ms=7, color=INK, zorder=8)
    write(ax, seen + (0.07, 0.06), "$P$")
    ax.margins(0.06)
    return ax


@styled
def draw_conventions():
    """Draw where the modified and the classic convention put frame i: a link i with its two joints, once for each.

    Returns
    -------
    list of 2 matplotlib Axes
    """
    figure, panels = plt.subplots(2, 1, figsize=(7.6, 6.2))
    for ax, title, place in zip(panels, ("modified (Khalil-Kleinfinger)", "classic (1955)"), (0, 1)):
        show_bare(ax)
        near, far = np.array([0, 0.0]), np.array([1.0, 0.0])
        for x, name in ((near[0], "i"), (far[0], "i+1")):
            ax.plot([x, x], [-0.24, 0.5], color=SOFT, lw=1, ls=CENTRE_LINE, zorder=1)
            write(ax, (x, 0.55), f"axis of joint ${name}$", fontsize=10)
        for start, end, shade, name in (
            ((-0.55, -0.1), (0, -0.1), FAINT, "link $i-1$"),
            ((0, 0), (1, 0), "#f4f4f4", "link $i$"),
            ((1, 0.1), (1.55, 0.1), FAINT, "link $i+1$"),
        ):
            draw_link(ax, start, end, shade, width=15)
            below = 0.11 if start[0] < 1 else -0.11
            write(ax, (np.mean([start[0], end[0]]), start[1] - below), name, fontsize=10)
        for x in (0, 1):
            ax.add_patch(Rectangle((x - 0.035, -0.16), 0.07, 0.32, fc="white", ec=INK, lw=1.4, zorder=5))
        at = (near, far)[place]
        draw_arrow(ax, at, at + (0.36, 0), AXIS_COLOURS["x"], width=2, zorder=8)
        write(ax, at + (0.42, 0), "$x_i$", color=AXIS_COLOURS["x"], zorder=10)
        draw_arrow(ax, at, at + (0, 0.38), AXIS_COLOURS["z"], width=2, dashes=AXIS_DASHES["z"], zorder=8)
        write(ax, at + (0.07, 0.37), "$z_i$", color=AXIS_COLOURS["z"], zorder=10)
        ax.plot(*at, "o", ms=5, color=INK, zorder=11)
        write(ax, at + (-0.08, -0.1), "$O_i$", zorder=11)
        ax.set_title(title, loc="left")
        ax.set(xlim=(-0.75, 1.75), ylim=(-0.42, 0.62))
        ax.annotate("", (-0.62, -0.36), (-0.2, -0.36), arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1})
        ax.annotate("", (1.62, -0.36), (1.2, -0.36), arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1})
        write(ax, (-0.18, -0.36), "base, upstream", ha="left", fontsize=10)
        write(ax, (1.18, -0.36), "end effector, downstream", ha="right", fontsize=10)
    figure.subplots_adjust(hspace=0.12, left=0.02, right=0.98, top=0.95, bottom=0.02)
    return list(panels)


@styled
def mark_shadow(ax, frame, size):
    """Mark a frame, shape (4, 4), as broad grey strokes without labels, to hold another frame against it."""
    frame = as_numbers(frame, "frame", (4, 4))
    for axis in frame[:3, :3].T:
        ends = zip(frame[:3, 3], frame[:3, 3] + size * axis)
        ax.plot(*ends, color=SOFT, alpha=0.45, lw=7, solid_capstyle="butt", zorder=2.5)
    return ax
