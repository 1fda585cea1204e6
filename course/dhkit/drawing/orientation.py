"""Drawings of orientation: turns one after the other, nested rings, a tilted top, atan2 and the flip of a wrist.

A set of axes is three letters such as ``"zyz"``, in the order of the angles.
"""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Circle, Rectangle
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ..geometry import chain_products, rigid_transform, rotation, unit_vector
from .frames import add_frames
from .inputs import as_axis_letters, as_lengths, as_numbers
from .strokes import draw_angle, draw_arrow, new_axes, show_bare, write
from .strokes_3d import arc_points, draw_angle_3d, draw_arrow_3d, write_3d
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, DASHED, INK, SOFT, in_degrees, styled
from .view import fit_3d, new_axes_3d, view_axes

ANGLE_NAMES = (r"\psi", r"\vartheta", r"\varphi")


def turn_in_steps(angles, axes: str, about: str = "moving") -> np.ndarray:
    """Orientation after each turn, the first one untouched: shape (len(axes) + 1, 3, 3).

    Parameters
    ----------
    angles : array-like, one per letter, in radians
    axes : str
        Letters x, y, z in the order of the turns.
    about : "moving" or "fixed"
        The axes of the body itself, or those of the base.
    """
    as_axis_letters(axes)
    if about not in ("moving", "fixed"):
        raise ValueError(f'about: expected "moving" or "fixed", found {about!r}')
    turns = [rotation(axis, angle) for axis, angle in zip(axes, as_numbers(angles, "angles", (len(axes),)))]
    if about == "moving":
        return chain_products(turns)
    return chain_products([turn.T for turn in turns]).swapaxes(1, 2)


def axis_direction(letter: str) -> np.ndarray:
    """Unit vector of the coordinate axis "x", "y" or "z", shape (3,)."""
    return np.eye(3)["xyz".index(letter)]


# ---------------------------------------------------------------- turns one after the other


def draw_brick(ax, orientation, centre, size=(1.0, 0.7, 0.24), zorder=2.0):
    """Draw a box fixed to a frame; the faces that look away are left out."""
    view = view_axes(ax)[2]
    half = np.array(size) / 2
    for k in range(3):
        u, v = (k + 1) % 3, (k + 2) % 3
        for sense in (1, -1):
            normal = sense * orientation[:, k]
            if normal @ view <= 1e-9:
                continue
            corners = np.zeros((4, 3))
            corners[:, k] = sense * half[k]
            corners[:, u] = np.array([-1, 1, 1, -1]) * half[u]
            corners[:, v] = np.array([-1, -1, 1, 1]) * half[v]
            shade = 0.68 + 0.27 * abs(normal @ np.array([0.3, -0.25, 0.92]))
            face = Poly3DCollection(
                [centre + corners @ orientation.T],
                facecolors=str(shade),
                edgecolors=INK,
                linewidths=0.8,
                zorder=zorder,
            )
            ax.add_collection3d(face, autolim=False)


def draw_grey_axes(ax, centre, orientation):
    """Draw thick grey arrows under those of the hand; they stick out, so that they show where both agree."""
    for letter, direction in zip("xyz", np.asarray(orientation).T):
        ax.plot(*zip(centre, centre + 0.84 * direction), color=SOFT, lw=5, alpha=0.55, zorder=5.5)
        write_3d(ax, centre + 0.98 * direction, f"${letter}$", color=SOFT, fontsize=10)


@styled
def draw_bricks(orientations, wanted, captions=(), ax=None, *, columns=3):
    """Draw a brick in each of some orientations, with the axes of the wanted one in grey.

    Parameters
    ----------
    orientations, wanted : array-like, shape (n, 3, 3)
    captions : n texts
        A line under each drawing.
    columns : int
        How many stand side by side.

    Returns
    -------
    matplotlib Axes (3D)
    """
    orientations, wanted = (
        as_numbers(each, name, (None, 3, 3)) for each, name in ((orientations, "orientations"), (wanted, "wanted"))
    )
    own, ax = ax is None, ax or new_axes_3d(elev=24, azim=-58)
    right, up, _ = view_axes(ax)
    points = []
    for k, (orientation, grey) in enumerate(zip(orientations, wanted)):
        centre = 2.5 * (k % columns) * right - 2.7 * (k // columns) * up
        draw_brick(ax, orientation, centre, (0.62, 0.46, 0.18), zorder=4)
        add_frames(ax, [rigid_transform(orientation, centre)], [""], 0.62)
        draw_grey_axes(ax, centre, grey)
        if k < len(captions):
            write_3d(ax, centre - 1.25 * up, captions[k], fontsize=10)
        points += [centre + step for step in (1.15 * right, -1.15 * right, 1.1 * up, -1.4 * up)]
    rows, wide = -(-len(orientations) // columns), min(columns, len(orientations))
    fit_3d(ax, points, own, width=0.6 + 2.6 * wide, height=0.3 + 2.7 * rows)
    return ax


@styled
def draw_brick_turns(angles, axes="zyx", ax=None, *, about="moving"):
    """Draw a brick before and after each of some turns, side by side; the axis of each turn is a long line.

    Parameters
    ----------
    angles : array-like, one per letter, in radians
    axes : str
        Letters x, y, z in the order of the turns.
    about : "moving" or "fixed"
        Turn about the axes of the brick itself, or about those of the base.

    Returns
    -------
    matplotlib Axes (3D)
    """
    states = turn_in_steps(angles, axes, about)
    own, ax = ax is None, ax or new_axes_3d(elev=24, azim=-58)
    step = 2.35 * view_axes(ax)[0]
    points = []
    for k, state in enumerate(states):
        centre = k * step
        draw_brick(ax, state, centre)
        add_frames(ax, [rigid_transform(state, centre)], [""], 0.8)
        caption = "start"
        if k:
            letter, angle = axes[k - 1], in_degrees(np.asarray(angles, float)[k - 1])
            line = states[k - 1] @ axis_direction(letter) if about == "moving" else axis_direction(letter)
            _turning_axis(ax, centre, line, letter, 1.4)
            caption = f"{k}. about {'its own' if about == 'moving' else 'the fixed'} ${letter}$: {angle}"
        write_3d(ax, centre + (0, 0, -1.62), caption, fontsize=10)
        points += [centre + corner for corner in np.array([[1, 0, 1.4], [-1, 0, -1.75], [0, 1, 0], [0, -1, 0]])]
    points += [points[0] - 0.6 * step, points[-1] + 0.5 * step]
    fit_3d(ax, points, own, width=9.6, height=4.2)
    return ax


def _turning_axis(ax, centre, line, letter, length):
    """A centre line along `line` with a round arrow at its end: the right-hand sense of a turn."""
    colour = AXIS_COLOURS[letter]
    ends = np.array([centre - length * line, centre + length * line])
    ax.plot(*ends.T, color=colour, lw=1.1, ls=CENTRE_LINE, zorder=1.5)
    draw_round_arrow(ax, centre + 0.97 * length * line, line, 0.15, colour)


def draw_round_arrow(ax, centre, line, radius, colour, zorder=8):
    """Draw an arrow round the direction `line`, in its positive sense."""
    start = np.cross(line, view_axes(ax)[2])
    start = start if np.linalg.norm(start) > 0.1 else np.cross(line, view_axes(ax)[0] + (0, 0, 0.1))
    start = start / np.linalg.norm(start)
    turn = np.linspace(-2.6, 2.2, 30)
    arc = arc_points(centre, radius, start, np.cross(line, start), turn)
    ax.plot(*arc[:-3].T, color=colour, lw=1.2, zorder=zorder)
    draw_arrow_3d(ax, arc[-6], arc[-1], colour, width=1.2, scale=7, zorder=zorder)


# ---------------------------------------------------------------- a tilted top


@styled
def draw_top(angles=(0.8, 0.65, 0.75), axes="zxz", ax=None, *, names=ANGLE_NAMES):
    """Draw the three angles of a set that begins and ends with z, on a top with its axle and disc.

    The first angle turns about the fixed Z_0, the second tilts the axle away from it, the third spins the disc.

    Parameters
    ----------
    angles : array-like, shape (3,), in radians
    axes : "zxz" or "zyz"
    names : three texts
        Names of the angles in mathematical notation.

    Returns
    -------
    matplotlib Axes (3D)
    """
    if axes not in ("zxz", "zyz"):
        raise ValueError(f'axes: expected "zxz" or "zyz", found {axes!r}')
    states = turn_in_steps(as_numbers(angles, "angles", (3,)), axes)
    x0, y0, z0 = np.eye(3)
    axle, middle = states[2][:, 2], states[1] @ axis_direction(axes[1])
    own, ax = ax is None, ax or new_axes_3d(elev=24, azim=35)
    turn = np.linspace(0, 2 * np.pi, 73)
    circle = arc_points(np.zeros(3), 1, x0, y0, turn)
    ax.plot(*(1.15 * circle).T, color=SOFT, lw=0.8, zorder=0.5)
    tilt = np.arccos(np.clip(axle[2], -1, 1))
    tip = 1.25 * rotation("y", tilt)[:, 2]
    ax.plot(*(rotation("z", turn) @ tip).T, color=SOFT, lw=0.8, ls=(0, (4, 3)), zorder=0.6)

    disc = 0.72 * (circle @ states[2].T)
    ax.add_collection3d(
        Poly3DCollection([disc], facecolors="#e4e4e4", edgecolors=INK, linewidths=0.9, alpha=0.85, zorder=1),
        autolim=False,
    )
    for letter, name, direction, length in (
        ("x", "x_0", x0, 1.15), ("y", "y_0", y0, 1.15), ("z", "z_0", z0, 1.3),
        ("z", "z", axle, 1.3), ("x", "x", states[3][:, 0], 0.92), ("y", "y", states[3][:, 1], 0.92),
    ):  # fmt: skip
        if name == "z" and tilt < 1e-6:
            continue
        _long_arrow(ax, length * direction, letter)
        label = "z_0, z" if name == "z_0" and tilt < 1e-6 else name
        write_3d(ax, (length + 0.14) * direction, f"${label}$", color=AXIS_COLOURS[letter])
    ends = np.outer((-1.15, 1.15), middle)
    ax.plot(*ends.T, color=INK, lw=0.9, ls=CENTRE_LINE, zorder=1.4)
    write_3d(ax, 1.3 * middle, f"${axes[1]}'$")
    if axes == "zyz":
        ax.plot(*np.outer((0, 1.15), states[1][:, 0]).T, color=SOFT, lw=0.9, ls=DASHED, zorder=1.4)
    arcs = (
        (x0, y0, 0.55, angles[0], names[0]),
        (z0, np.cross(middle, z0), 0.8, angles[1], names[1]),
        (states[2][:, 0], states[2][:, 1], 0.62, angles[2], names[2]),
    )
    for start, side, radius, sweep, name in arcs:
        if abs(sweep) > 1e-3:
            draw_angle_3d(ax, np.zeros(3), start, side, radius, sweep, name, 1.18)
    fit_3d(ax, [*(1.2 * circle), *(1.1 * disc), (0, 0, 1.55)], own, width=5.6, height=5.0)
    return ax


def _long_arrow(ax, end, letter):
    """From the centre to `end`; the dashes reach the head, however long the arrow."""
    colour = AXIS_COLOURS[letter]
    ax.plot(*np.outer((0, 0.95), end).T, color=colour, lw=1.6, ls=AXIS_DASHES[letter], zorder=6)
    draw_arrow_3d(ax, 0.9 * end, end, colour)


# ---------------------------------------------------------------- in the plane


@styled
def draw_atan2(n=0.6, m=-0.8, ax=None):
    """Draw the angle of the vector (m, n), and what the quotient n / m makes of it.

    Parameters
    ----------
    n, m : float
        Ordinate and abscissa, as in ``atan2(n, m)``; not both zero.

    Returns
    -------
    matplotlib Axes
    """
    n, m = as_numbers([n, m], "n and m", (2,))
    length = np.hypot(n, m)
    if length < 1e-12:
        raise ValueError("n and m: the vector (0, 0) has no direction")
    ax = ax or new_axes((5.0, 4.6))
    show_bare(ax)
    ax.add_patch(Rectangle((-1.3, -1.3), 1.3, 2.6, facecolor="#ececec", edgecolor="none", zorder=0))
    ax.add_patch(Circle((0, 0), 1, fill=False, ec=SOFT, lw=0.9, zorder=1))
    for angle, name in ((0, "m"), (np.pi / 2, "n")):
        draw_arrow(ax, -1.3 * unit_vector(angle), 1.4 * unit_vector(angle), SOFT, width=1.0)
        write(ax, 1.5 * unit_vector(angle), f"${name}$")
    tip = np.array([m, n]) / length
    draw_arrow(ax, (0, 0), tip, width=2.2)
    ax.plot([tip[0], tip[0], 0], [0, tip[1], tip[1]], color=SOFT, lw=1, ls=DASHED, zorder=2)
    angle = np.arctan2(n, m)
    write(ax, 1.17 * tip, "$(m, n)$", ha="left" if m >= 0 else "right")
    draw_angle(ax, (0, 0), 0.3, 0, angle, "")
    arc = 0.3 * unit_vector(angle / 2)
    write(ax, arc + (0.07, 0.1 if n >= 0 else -0.1), f"atan2 = {in_degrees(angle)}", ha="left", fontsize=10)
    if m < 0:
        wrong = np.arctan(n / m)
        draw_arrow(ax, (0, 0), unit_vector(wrong), INK, width=1.6, dashes=DASHED, neck=0.95)
        at = 1.06 * unit_vector(wrong)
        write(ax, at, f"$\\arctan(n/m)$\n= {in_degrees(wrong)}", ha="left", fontsize=10)
    write(ax, (-0.72, -1.12), "here arctan is\nwrong by 180°", fontsize=9)
    ax.set_xlim(-1.6, 1.9)
    ax.set_ylim(-1.4, 1.65)
    return ax


@styled
def draw_flip(misses=(np.radians(20), np.radians(5), np.radians(1)), ax=None):
    """Draw the first angle of a z, y, z wrist while its hand swings past the singular direction at a steady pace.

    Parameters
    ----------
    misses : array-like, shape (n,), in radians, positive
        Angle by which the swing misses the singular direction.

    Returns
    -------
    matplotlib Axes
    """
    misses = as_lengths(misses, "misses", (None,))
    ax = ax or new_axes((6.2, 3.6))
    swing = np.radians(np.linspace(-60, 60, 721))
    for miss, dashes in zip(misses, ("-", (0, (5, 1.5)), (0, (6, 1.5, 1.2, 1.5)), (0, (1, 1)))):
        first = np.arctan2(np.sin(miss), np.sin(swing) * np.cos(miss))
        ax.plot(np.degrees(swing), np.degrees(first), color=INK, lw=1.7, ls=dashes, label=f"{np.degrees(miss):.3g}°")
    ax.grid(True)
    ax.set(
        xlabel="position of the end effector on its swing (degrees)", ylabel=r"$\theta_4$ (degrees)",
        xlim=(-60, 60), ylim=(-5, 185), yticks=(0, 45, 90, 135, 180),
    )  # fmt: skip
    ax.legend(title="missed by", loc="lower left")
    return ax
