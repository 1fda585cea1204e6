"""Drawings of orientation: turns one after the other, nested rings, a tilted top, atan2 and the flip of a wrist.

A set of axes is three letters such as ``"zyz"``, in the order of the angles.
"""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Circle, Rectangle
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .. import strokes
from .frames import draw_frames

ANGLE_NAMES = (r"\psi", r"\vartheta", r"\varphi")


def rotation(axis: str, angle: float) -> np.ndarray:
    """Rotation by `angle` (radians) about the coordinate axis "x", "y" or "z", shape (3, 3)."""
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    turned = np.eye(3)
    turned[j, j] = turned[k, k] = np.cos(angle)
    turned[k, j] = np.sin(angle)
    turned[j, k] = -turned[k, j]
    return turned


def turned(angles, axes: str, about: str = "moving") -> np.ndarray:
    """Orientation after each turn, the first one untouched: shape (len(axes) + 1, 3, 3).

    Parameters
    ----------
    angles : array-like, one per letter, in radians
    axes : str
        Letters x, y, z in the order of the turns.
    about : "moving" or "fixed"
        The axes of the body itself, or those of the base.
    """
    _check_axes(axes)
    if about not in ("moving", "fixed"):
        raise ValueError(f'about: expected "moving" or "fixed", found {about!r}')
    states = [np.eye(3)]
    for axis, angle in zip(axes, strokes.as_numbers(angles, "angles", (len(axes),))):
        turn = rotation(axis, angle)
        states.append(states[-1] @ turn if about == "moving" else turn @ states[-1])
    return np.array(states)


def _check_axes(axes, length=None):
    if not isinstance(axes, str) or not axes or set(axes) - set("xyz") or length not in (None, len(axes)):
        wanted = "letters" if length is None else f"{length} letters"
        raise ValueError(f"axes: expected {wanted} x, y, z, found {axes!r}")


def _axis(letter: str) -> np.ndarray:
    return np.eye(3)["xyz".index(letter)]


def _towards_viewer(ax) -> np.ndarray:
    azim, elev = np.radians([ax.azim, ax.elev])
    return np.array([np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)])


def _to_the_right(ax) -> np.ndarray:
    """Unit vector that points to the right on paper."""
    azim = np.radians(ax.azim)
    return np.array([-np.sin(azim), np.cos(azim), 0.0])


def _outwards(ax, direction) -> np.ndarray:
    """Unit vector in the plane of the paper that points as `direction` is seen, or up where it is seen end on."""
    view = _towards_viewer(ax)
    seen = direction - (direction @ view) * view
    seen = seen if np.linalg.norm(seen) > 0.05 else np.cross(view, _to_the_right(ax))
    return seen / np.linalg.norm(seen)


def _frame(orientation, origin) -> np.ndarray:
    frame = np.eye(4)
    frame[:3, :3], frame[:3, 3] = orientation, origin
    return frame


# ---------------------------------------------------------------- turns one after the other


def _brick(ax, orientation, centre, size=(1.0, 0.7, 0.24), zorder=2.0):
    """A box fixed to a frame; the faces that look away are left out."""
    view = _towards_viewer(ax)
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
                edgecolors=strokes.INK,
                linewidths=0.8,
                zorder=zorder,
            )
            ax.add_collection3d(face, autolim=False)


@strokes.styled
def draw_turns(angles, axes="zyx", ax=None, *, about="moving"):
    """A brick before and after each of some turns, side by side; the axis of each turn is a long line.

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
    states = turned(angles, axes, about)
    own, ax = ax is None, ax or strokes.new_axes_3d(elev=24, azim=-58)
    step = 2.35 * _to_the_right(ax)
    points = []
    for k, state in enumerate(states):
        centre = k * step
        _brick(ax, state, centre)
        draw_frames(ax, [_frame(state, centre)], [""], 0.8)
        caption = "start"
        if k:
            letter, angle = axes[k - 1], strokes.in_degrees(np.asarray(angles, float)[k - 1])
            line = states[k - 1] @ _axis(letter) if about == "moving" else _axis(letter)
            _turning_axis(ax, centre, line, letter, 1.4)
            caption = f"{k}. about {'its own' if about == 'moving' else 'the fixed'} ${letter}$: {angle}"
        strokes.write_3d(ax, centre + (0, 0, -1.62), caption, fontsize=10)
        points += [centre + corner for corner in np.array([[1, 0, 1.4], [-1, 0, -1.75], [0, 1, 0], [0, -1, 0]])]
    points += [points[0] - 0.6 * step, points[-1] + 0.5 * step]
    strokes.fit_3d(ax, points, own, width=9.6, height=4.2)
    return ax


def _turning_axis(ax, centre, line, letter, length):
    """A centre line along `line` with a round arrow at its end: the right-hand sense of a turn."""
    colour = strokes.AXIS_COLOURS[letter]
    ends = np.array([centre - length * line, centre + length * line])
    ax.plot(*ends.T, color=colour, lw=1.1, ls=strokes.CENTRE_LINE, zorder=1.5)
    _round_arrow(ax, centre + 0.97 * length * line, line, 0.15, colour)


def _round_arrow(ax, centre, line, radius, colour, zorder=8):
    start = np.cross(line, _towards_viewer(ax))
    start = start if np.linalg.norm(start) > 0.1 else np.cross(line, _to_the_right(ax) + (0, 0, 0.1))
    start = start / np.linalg.norm(start)
    turn = np.linspace(-2.6, 2.2, 30)
    arc = centre + radius * (np.outer(np.cos(turn), start) + np.outer(np.sin(turn), np.cross(line, start)))
    ax.plot(*arc[:-3].T, color=colour, lw=1.2, zorder=zorder)
    strokes.arrow_3d(ax, arc[-6], arc[-1], colour, width=1.2, scale=7, zorder=zorder)


# ---------------------------------------------------------------- nested rings


@strokes.styled
def draw_gimbal(angles=(0.0, 0.0, 0.0), axes="zyx", ax=None, *, names=ANGLE_NAMES, captions=(), wanted=None):
    """Three nested hinges that make a set of Euler angles: two rings and, inside, the hand.

    The outer ring turns about an axis that is fixed, the inner ring about an axis of the outer one, the hand about
    an axis of the inner ring. Where two of the three axes fall on one line, a freedom is lost.

    Parameters
    ----------
    angles : array-like, shape (3,) or (n, 3), in radians
        The three angles, from the outer hinge to the inner one; several sets are drawn side by side.
    axes : str
        Three letters, in the same order; neighbours differ.
    names : three texts
        Names of the angles in mathematical notation.
    captions : n texts
        A line under each drawing.
    wanted : array-like, shape (3, 3) or (n, 3, 3), optional
        Orientations to compare the hand with: their axes x, y, z as grey arrows.

    Returns
    -------
    matplotlib Axes (3D)
    """
    _check_axes(axes, 3)
    if axes[0] == axes[1] or axes[1] == axes[2]:
        raise ValueError(f"axes: neighbours must differ, found {axes!r}")
    rows = np.atleast_2d(strokes.as_numbers(angles, "angles", (None,) * np.ndim(angles)))
    if rows.shape[1] != 3:
        raise ValueError(f"angles: expected n x 3 numbers, found {' x '.join(map(str, rows.shape))}")
    if wanted is not None:
        wanted = np.broadcast_to(strokes.as_numbers(wanted, "wanted", (None,) * np.ndim(wanted)), (len(rows), 3, 3))
    own, ax = ax is None, ax or strokes.new_axes_3d(elev=24, azim=-58)
    step = 3.9 * _to_the_right(ax)
    points = []
    for k, row in enumerate(rows):
        centre = k * step
        _rings(ax, centre, row, axes, names)
        if wanted is not None:
            _grey_axes(ax, centre, wanted[k])
        if k < len(captions):
            strokes.write_3d(ax, centre + (0, 0, -2.3), captions[k], fontsize=10)
        points += [centre + s * 1.75 * v for s in (1, -1) for v in np.eye(3)]
        points += [centre + (0, 0, -2.4)] if captions else []
        points += [centre + s * 0.48 * step for s in (1, -1)]
    strokes.fit_3d(ax, points, own, width=4.6 + 3.2 * (len(rows) - 1), height=4.8)
    return ax


def _grey_axes(ax, centre, orientation):
    """Thick grey arrows under those of the hand; they stick out, so that they show where both agree."""
    for letter, direction in zip("xyz", np.asarray(orientation).T):
        ax.plot(*zip(centre, centre + 0.84 * direction), color=strokes.SOFT, lw=5, alpha=0.55, zorder=5.5)
        strokes.write_3d(ax, centre + 0.98 * direction, f"${letter}$", color=strokes.SOFT, fontsize=10)


def gimbal_axes(angles, axes) -> np.ndarray:
    """Directions of the three hinges in the base, shape (3, 3): one row per hinge."""
    states = turned(angles, axes)
    return np.array([state @ _axis(letter) for state, letter in zip(states, axes)])


def _rings(ax, centre, angles, axes, names):
    states = turned(angles, axes)
    lines = gimbal_axes(angles, axes)
    _base_hinge(ax, centre, lines[0])
    for radius, shades, first, second in ((1.3, ("#ebebeb", "#b4b4b4"), 0, 1), (0.98, ("#cfcfcf", "#777777"), 1, 2)):
        _ring(ax, centre, radius, states[second] @ _axis(axes[first]), lines[second], shades)
    for line, inner, outer in ((lines[1], 0.98, 1.3), (lines[2], 0.3, 0.98)):
        for sense in (1, -1):
            _rod(ax, centre + sense * inner * line, centre + sense * outer * line, centre)
    _brick(ax, states[3], centre, (0.62, 0.46, 0.18), zorder=4)
    draw_frames(ax, [_frame(states[3], centre)], [""], 0.62)
    for _n, group in enumerate(_same_lines(lines)):
        line, letter = lines[group[0]], axes[group[0]]
        ends = np.array([centre - 1.52 * line, centre + 1.52 * line])
        ax.plot(*ends.T, color=strokes.AXIS_COLOURS[letter], lw=1.1, ls=strokes.CENTRE_LINE, zorder=1.0)
        for hinge in group:
            _round_arrow(ax, centre + 1.5 * lines[hinge], lines[hinge], 0.12, strokes.AXIS_COLOURS[axes[hinge]])
        for sense in (1, -1):
            owners = [hinge for hinge in group if sense * (lines[hinge] @ line) > 0]
            if owners:
                text = ", ".join(f"{names[hinge]}\\;({axes[hinge]})" for hinge in owners)
                at = centre + sense * 1.58 * line + 0.3 * _outwards(ax, sense * line)
                strokes.write_3d(ax, at, f"${text}$", color=strokes.AXIS_COLOURS[axes[owners[0]]])


def _same_lines(lines) -> list[list[int]]:
    """Hinges grouped by the line they turn about."""
    groups: list[list[int]] = []
    for k, line in enumerate(lines):
        for group in groups:
            if abs(abs(line @ lines[group[0]]) - 1) < 1e-6:
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def _depth(ax, offset) -> float:
    """Drawing order of a piece at `offset` from the centre: nearer pieces later."""
    return 4 + 1.2 * float(offset @ _towards_viewer(ax))


def _ring(ax, centre, radius, first, second, shades, pieces=48):
    """A ring in the plane of two directions, in pieces, so that what is nearer hides what is farther.

    The half on the side of `second` has the darker shade, so that half a turn of the ring can be seen.
    """
    second = second - (second @ first) * first
    second = second / np.linalg.norm(second)
    for k in range(pieces):
        turn = 2 * np.pi * (k + np.array([-0.2, 0, 0.5, 1, 1.2])) / pieces
        arc = radius * (np.outer(np.cos(turn), first) + np.outer(np.sin(turn), second))
        depth = _depth(ax, arc[2])
        shade = shades[int(arc[2] @ second > 0)]
        # The outline is shorter than the filling: else its ends would show as seams between the pieces.
        ax.plot(*(centre + arc[1:-1]).T, color=strokes.INK, lw=6, solid_capstyle="butt", zorder=depth)
        ax.plot(*(centre + arc).T, color=shade, lw=4, solid_capstyle="butt", zorder=depth + 1e-3)


def _rod(ax, start, end, centre, width=4.0):
    depth = _depth(ax, (start + end) / 2 - centre) - 0.05
    ax.plot(*zip(start, end), color=strokes.INK, lw=width, solid_capstyle="butt", zorder=depth)


def _base_hinge(ax, centre, line):
    """The two bearings of the outer ring, hatched: they do not move."""
    across = _to_the_right(ax) if abs(line @ _to_the_right(ax)) < 0.7 else np.array([0, 0, 1.0])
    across = across - (across @ line) * line
    across = across / np.linalg.norm(across)
    for sense in (1, -1):
        foot = centre + sense * 1.42 * line
        _rod(ax, centre + sense * 1.3 * line, foot, centre)
        ax.plot(*zip(foot - 0.16 * across, foot + 0.16 * across), color=strokes.INK, lw=1.4, zorder=3)
        for s in np.linspace(-0.12, 0.16, 5):
            ax.plot(
                *zip(foot + s * across, foot + (s - 0.06) * across + sense * 0.07 * line),
                color=strokes.INK,
                lw=0.8,
                zorder=3,
            )


# ---------------------------------------------------------------- a tilted top


@strokes.styled
def draw_top(angles=(0.8, 0.65, 0.75), axes="zxz", ax=None, *, names=ANGLE_NAMES):
    """The three angles of a set that begins and ends with z, on a top with its axle and disc.

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
    states = turned(strokes.as_numbers(angles, "angles", (3,)), axes)
    x0, y0, z0 = np.eye(3)
    axle, middle = states[2][:, 2], states[1] @ _axis(axes[1])
    own, ax = ax is None, ax or strokes.new_axes_3d(elev=24, azim=35)
    turn = np.linspace(0, 2 * np.pi, 73)
    circle = np.outer(np.cos(turn), x0) + np.outer(np.sin(turn), y0)
    ax.plot(*(1.15 * circle).T, color=strokes.SOFT, lw=0.8, zorder=0.5)
    tilt = np.arccos(np.clip(axle[2], -1, 1))
    tip = 1.25 * np.array([np.sin(tilt), 0, np.cos(tilt)])
    ax.plot(*np.array([rotation("z", t) @ tip for t in turn]).T, color=strokes.SOFT, lw=0.8, ls=(0, (4, 3)), zorder=0.6)

    disc = 0.72 * (circle @ states[2].T)
    ax.add_collection3d(
        Poly3DCollection([disc], facecolors="#e4e4e4", edgecolors=strokes.INK, linewidths=0.9, alpha=0.85, zorder=1),
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
        strokes.write_3d(ax, (length + 0.14) * direction, f"${label}$", color=strokes.AXIS_COLOURS[letter])
    ends = np.outer((-1.15, 1.15), middle)
    ax.plot(*ends.T, color=strokes.INK, lw=0.9, ls=strokes.CENTRE_LINE, zorder=1.4)
    strokes.write_3d(ax, 1.3 * middle, f"${axes[1]}'$")
    if axes == "zyz":
        ax.plot(*np.outer((0, 1.15), states[1][:, 0]).T, color=strokes.SOFT, lw=0.9, ls=(0, (3, 2)), zorder=1.4)
    arcs = (
        (x0, y0, 0.55, angles[0], names[0]),
        (z0, np.cross(middle, z0), 0.8, angles[1], names[1]),
        (states[2][:, 0], states[2][:, 1], 0.62, angles[2], names[2]),
    )
    for start, side, radius, sweep, name in arcs:
        if abs(sweep) > 1e-3:
            strokes.angle_arc_3d(ax, np.zeros(3), start, side, radius, sweep, name, 1.18)
    strokes.fit_3d(ax, [*(1.2 * circle), *(1.1 * disc), (0, 0, 1.55)], own, width=5.6, height=5.0)
    return ax


def _long_arrow(ax, end, letter):
    """From the centre to `end`; the dashes reach the head, however long the arrow."""
    colour = strokes.AXIS_COLOURS[letter]
    ax.plot(*np.outer((0, 0.95), end).T, color=colour, lw=1.6, ls=strokes.AXIS_DASHES[letter], zorder=6)
    strokes.arrow_3d(ax, 0.9 * end, end, colour)


# ---------------------------------------------------------------- in the plane


@strokes.styled
def draw_atan2(n=0.6, m=-0.8, ax=None):
    """The angle of the vector (m, n), and what the quotient n / m makes of it.

    Parameters
    ----------
    n, m : float
        Ordinate and abscissa, as in ``atan2(n, m)``; not both zero.

    Returns
    -------
    matplotlib Axes
    """
    n, m = strokes.as_numbers([n, m], "n and m", (2,))
    length = np.hypot(n, m)
    if length < 1e-12:
        raise ValueError("n and m: the vector (0, 0) has no direction")
    ax = ax or strokes.new_axes((5.0, 4.6))
    strokes.show_bare(ax)
    ax.add_patch(Rectangle((-1.3, -1.3), 1.3, 2.6, facecolor="#ececec", edgecolor="none", zorder=0))
    ax.add_patch(Circle((0, 0), 1, fill=False, ec=strokes.SOFT, lw=0.9, zorder=1))
    for angle, name in ((0, "m"), (np.pi / 2, "n")):
        strokes.arrow(ax, -1.3 * strokes.unit_vector(angle), 1.4 * strokes.unit_vector(angle), strokes.SOFT, width=1.0)
        strokes.write(ax, 1.5 * strokes.unit_vector(angle), f"${name}$")
    tip = np.array([m, n]) / length
    strokes.arrow(ax, (0, 0), tip, width=2.2)
    ax.plot([tip[0], tip[0], 0], [0, tip[1], tip[1]], color=strokes.SOFT, lw=1, ls=(0, (3, 2)), zorder=2)
    angle = np.arctan2(n, m)
    strokes.write(ax, 1.17 * tip, "$(m, n)$", ha="left" if m >= 0 else "right")
    strokes.angle_arc(ax, (0, 0), 0.3, 0, angle, "")
    arc = 0.3 * strokes.unit_vector(angle / 2)
    strokes.write(
        ax, arc + (0.07, 0.1 if n >= 0 else -0.1), f"atan2 = {strokes.in_degrees(angle)}", ha="left", fontsize=10
    )
    if m < 0:
        wrong = np.arctan(n / m)
        strokes.arrow(ax, (0, 0), strokes.unit_vector(wrong), strokes.INK, width=1.6, dashes=(0, (3, 2)), neck=0.95)
        at = 1.06 * strokes.unit_vector(wrong)
        strokes.write(ax, at, f"$\\arctan(n/m)$\n= {strokes.in_degrees(wrong)}", ha="left", fontsize=10)
    strokes.write(ax, (-0.72, -1.12), "here arctan is\nwrong by 180°", fontsize=9)
    ax.set_xlim(-1.6, 1.9)
    ax.set_ylim(-1.4, 1.65)
    return ax


@strokes.styled
def draw_flip(misses=(np.radians(20), np.radians(5), np.radians(1)), ax=None):
    """The first angle of a z, y, z wrist while its hand swings past the singular direction at a steady pace.

    Parameters
    ----------
    misses : array-like, shape (n,), in radians, positive
        Angle by which the swing misses the singular direction.

    Returns
    -------
    matplotlib Axes
    """
    misses = strokes.as_lengths(misses, "misses", (None,))
    ax = ax or strokes.new_axes((6.2, 3.6))
    swing = np.radians(np.linspace(-60, 60, 721))
    for miss, dashes in zip(misses, ("-", (0, (5, 1.5)), (0, (6, 1.5, 1.2, 1.5)), (0, (1, 1)))):
        first = np.arctan2(np.sin(miss), np.sin(swing) * np.cos(miss))
        ax.plot(
            np.degrees(swing), np.degrees(first), color=strokes.INK, lw=1.7, ls=dashes, label=f"{np.degrees(miss):.3g}°"
        )
    ax.grid(True)
    ax.set(
        xlabel="position of the hand on its swing (degrees)", ylabel=r"$\theta_4$ (degrees)",
        xlim=(-60, 60), ylim=(-5, 185), yticks=(0, 45, 90, 135, 180),
    )  # fmt: skip
    ax.legend(title="missed by", loc="lower left")
    return ax
