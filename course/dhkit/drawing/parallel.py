"""Drawings of planar parallel robots: three legs that carry one platform.

A robot is given by its anchors A_i on the base, shape (3, 2), and by the points b_i of its platform, shape (3, 2), seen
from the platform's frame. A pose of the platform is (x, y, phi). Metres and radians throughout.
"""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Circle, Polygon, Rectangle

from ..geometry import planar_joints, rotation_2d, unit_vector
from .inputs import as_lengths, as_numbers, as_rows
from .strokes import (
    draw_angle,
    draw_axis_arrow,
    draw_ground,
    draw_joint,
    draw_link,
    leave_room,
    new_axes,
    show_bare,
    show_plane,
    write,
)
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, FAINT, INK, SOFT, in_degrees, styled

PLATFORM = "#dcdcdc"
ROD = "#a9a9a9"
PLANE_STEPS = 1440  # of the platform's angle along a coupler curve


def platform_points(platform, pose) -> np.ndarray:
    """The joints B_i of a platform in a pose.

    Parameters
    ----------
    platform : array-like, shape (3, 2), in metres
        Points b_i in the platform's frame.
    pose : array-like, shape (3,)
        x, y (metres), phi (radians).

    Returns
    -------
    ndarray, shape (3, 2), in metres
    """
    platform = as_numbers(platform, "platform", (3, 2))
    x, y, phi = as_numbers(pose, "pose", (3,))
    return platform @ rotation_2d(phi).T + (x, y)


@styled
def draw_3rpr(base, platform, pose, ax=None, *, names=True, lengths=False, view=None):
    """Draw a 3-RPR: three legs of controlled length between the base and a platform, with the platform's frame.

    Parameters
    ----------
    base, platform : array-like, shape (3, 2), in metres
    pose : array-like, shape (3,)
        x, y (metres), phi (radians).
    names : bool
        Name anchors, joints, legs, and the angle phi.
    lengths : bool
        Write the lengths of the legs above the picture.
    view : (x_min, x_max, y_min, y_max), in metres, optional
        What the picture shows; by default what the pose needs.

    Returns
    -------
    matplotlib Axes
    """
    base = as_numbers(base, "base", (3, 2))
    joints = platform_points(platform, pose)
    at, phi = np.array(pose[:2], float), float(pose[2])
    size = np.ptp(np.vstack([base, joints]), axis=0).max()
    ax = ax or new_axes((5.6, 4.8))
    show_plane(ax)
    for foot in base:
        draw_ground(ax, foot - (0, 0.02 * size), 0.13 * size, 0.035 * size)
    _robot(ax, base, joints)
    draw_axis_arrow(ax, (0, 0), 0, 0.2 * size, "x", "x_0", away=0.22)
    draw_axis_arrow(ax, (0, 0), np.pi / 2, 0.2 * size, "y", "y_0", away=0.22)
    for letter, angle in (("x", phi), ("y", phi + np.pi / 2)):
        draw_axis_arrow(ax, at, angle, 0.16 * size, letter, f"{letter}_P", away=0.3)
    if names:
        ax.plot(*zip(at, at + (0.34 * size, 0)), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=5)
        draw_angle(ax, at, 0.3 * size, 0, phi, r"\varphi", 1.17)
        write(ax, at + 0.07 * size * unit_vector(phi - np.pi / 4), "$P$")
        centre = np.vstack([base, joints]).mean(axis=0)
        for i, (foot, joint) in enumerate(zip(base, joints), start=1):
            leg = (joint - foot) / (np.hypot(*(joint - foot)) or 1)
            across = np.array([-leg[1], leg[0]])
            across = across * (np.sign(across @ ((foot + joint) / 2 - centre)) or 1)
            write(ax, foot + 0.38 * (joint - foot) + 0.065 * size * across, f"$q_{i}$")
            write(ax, foot - 0.085 * size * leg + 0.02 * size * across, f"$A_{i}$")
            out = joint - joints.mean(axis=0)
            write(ax, joint + 0.075 * size * out / (np.hypot(*out) or 1), f"$B_{i}$")
    if lengths:
        written = (f"$q_{i}$ = {q:.3f} m" for i, q in enumerate(np.hypot(*(joints - base).T), start=1))
        ax.set_title(",   ".join(written))
    if view is None:
        leave_room(ax, 0.12 * size)
    else:
        _look_at(ax, view)
    return ax


def _look_at(ax, view):
    x_min, x_max, y_min, y_max = as_numbers(view, "view", (4,))
    ax.set_xlim(x_min, x_max)
    ax.set_ylim(y_min, y_max)


def _robot(ax, base, joints, zorder=3.0, width=9.0):
    """Platform, telescopic legs and joints."""
    ax.add_patch(Polygon(joints, facecolor=PLATFORM, edgecolor=INK, lw=1.6, joinstyle="round", zorder=zorder))
    for foot, joint in zip(base, joints):
        draw_link(ax, foot, joint, ROD, 0.45 * width, zorder + 0.1)
        draw_link(ax, foot, foot + 0.55 * (joint - foot), "white", width, zorder + 0.2)
    for point in (*base, *joints):
        draw_joint(ax, point, zorder + 0.5, size=0.75 * width)


@styled
def draw_assembly_modes(base, platform, modes, ax=None, *, columns=3, view=None):
    """Draw all poses of a platform that given leg lengths allow, side by side on one scale.

    Parameters
    ----------
    base, platform : array-like, shape (3, 2), in metres
    modes : array-like, shape (k, 3)
        Rows x, y (metres), phi (radians); an empty list says that the legs do not close.
    columns : int
        Pictures in a row.
    view : (x_min, x_max, y_min, y_max), in metres, optional
        What one picture shows; by default what the modes need. A fixed view keeps the pictures of a slider still.

    Returns
    -------
    matplotlib Axes
    """
    base = as_numbers(base, "base", (3, 2))
    modes = as_rows(modes, "modes", 3)
    robots = [platform_points(platform, pose) for pose in modes]
    labels = [f"{k}:  {label}" for k, label in enumerate(_angle_labels(modes), start=1)]

    def picture(k, ax, shift):
        ax.add_patch(Polygon(base + shift, fill=False, edgecolor=SOFT, lw=1, ls=(0, (4, 3)), zorder=1))
        _robot(ax, base + shift, robots[k] + shift, width=6.5)

    return _gallery(ax, picture, [np.vstack([base, joints]) for joints in robots], labels, columns, view, base)


def _angle_labels(poses) -> list[str]:
    return [f"$\\varphi$ = {in_degrees(phi)}" for *_, phi in poses]


def _gallery(ax, picture, points, labels, columns, view, base, inches=2.6):
    """Pictures on one scale in one Axes: ``picture(k, ax, shift)`` draws number k, moved by `shift`.

    `points[k]` are the places that picture k must show, `labels[k]` is written below it; a picture is `inches` large.
    """
    seen = np.vstack([base, *points])
    low, high = seen.min(axis=0), seen.max(axis=0)
    middle, size = (low + high) / 2, (high - low) * 1.14
    if view is not None:
        low, high = as_numbers(view, "view", (4,)).reshape(2, 2).T
        middle, size = (low + high) / 2, high - low
    rows = max(1, -(-len(points) // columns))
    step = size + (0.04 * size.max(), 0.13 * size.max())
    across = min(columns, max(1, len(points)))
    if ax is None:
        width, height = inches * step / size.max()
        ax = new_axes((across * width + 0.2, rows * height + 0.2))
    show_bare(ax)
    for k, label in enumerate(labels):
        shift = np.array([k % columns, -(k // columns)]) * step - middle
        picture(k, ax, shift)
        below = shift + middle - (0, 0.5 * size[1] + 0.045 * size.max())
        write(ax, below, label, fontsize=10)
    if not labels:
        write(ax, (0, 0), "no way to close the legs")
    ends = np.array([[-0.5, 0.5], [across - 0.5, -rows + 0.5]]) * step
    ax.set_xlim(ends[0, 0], ends[1, 0])
    ax.set_ylim(ends[1, 1] - 0.02 * size.max(), ends[0, 1])
    return ax


def coupler_curve(base, platform, lengths) -> list[np.ndarray]:
    """The closed paths of B_3 while legs 1 and 2 are locked and leg 3 is taken off.

    Parameters
    ----------
    base, platform : array-like, shape (3, 2), in metres
    lengths : array-like, shape (2 or more,), in metres
        Of legs 1 and 2.

    Returns
    -------
    list of ndarrays, shape (n, 2), in metres
        Empty where the legs cannot close.
    """
    base = as_numbers(base, "base", (3, 2))
    platform = as_numbers(platform, "platform", (3, 2))
    q1, q2, *_ = as_lengths(lengths, "leg lengths", (None,))
    phi = np.linspace(-np.pi, np.pi, PLANE_STEPS, endpoint=False)
    turned = (platform - platform[0]) @ rotation_2d(phi).swapaxes(1, 2)  # B_i - B_1 for every phi
    # B_1 lies on the circle of leg 1, and on a circle of radius q2 about A_2 moved back by B_2 - B_1.
    between = base[1] - turned[:, 1] - base[0]
    apart = np.maximum(np.hypot(*between.T), 1e-12)
    along = (apart**2 + q1**2 - q2**2) / (2 * apart)
    height = q1**2 - along**2
    unit = between / apart[:, None]
    middle = base[0] + along[:, None] * unit + turned[:, 2]
    offset = np.sqrt(np.maximum(height, 0))[:, None] * np.column_stack([-unit[:, 1], unit[:, 0]])
    if (height >= 0).all():
        return [np.vstack([path, path[:1]]) for path in (middle + offset, middle - offset)]
    return [
        np.vstack([(middle + offset)[run], (middle - offset)[run[::-1]], (middle + offset)[run[:1]]])
        for run in _cyclic_runs(height >= 0)
    ]


def _cyclic_runs(true) -> list[np.ndarray]:
    """Indices of each run of True on a circle, with the False before and after it."""
    n = len(true)
    starts = np.flatnonzero(true & ~np.roll(true, 1))
    ends = np.flatnonzero(true & ~np.roll(true, -1))
    return [np.arange(a - 1, a + (ends[(ends - a) % n == ((ends - a) % n).min()][0] - a) % n + 2) % n for a in starts]


@styled
def draw_coupler_curve(base, platform, lengths, modes=(), ax=None, *, view=None):
    """Draw the curve on which B_3 runs with leg 3 taken off: where the circle of leg 3 cuts it, a pose fits.

    Parameters
    ----------
    base, platform : array-like, shape (3, 2), in metres
    lengths : array-like, shape (3,), in metres
    modes : array-like, shape (k, 3)
        Poses x, y, phi of the assembly modes: their B_3 are numbered, and the first one is drawn with its legs.
    view : (x_min, x_max, y_min, y_max), in metres, optional
        What the picture shows. A fixed view keeps the picture of a slider still.

    Returns
    -------
    matplotlib Axes
    """
    base = as_numbers(base, "base", (3, 2))
    lengths = as_lengths(lengths, "leg lengths", (3,))
    modes = as_rows(modes, "modes", 3)
    ax = ax or new_axes((5.8, 5.4))
    show_plane(ax)
    for k, path in enumerate(coupler_curve(base, platform, lengths)):
        ax.plot(*path.T, color=INK, lw=1.8, zorder=4, label=None if k else "path of $B_3$ (legs 1 and 2 locked)")
    dashes = AXIS_DASHES["z"]
    circle = Circle(base[2], lengths[2], fill=False, ec=AXIS_COLOURS["z"], lw=1.8, ls=dashes, zorder=3.8)
    ax.add_patch(circle)
    ax.plot([], [], color=AXIS_COLOURS["z"], lw=1.8, ls=dashes, label="circle of leg 3")
    size = lengths.max() + np.ptp(base, axis=0).max()
    if len(modes):
        _robot(ax, base, platform_points(platform, modes[0]), zorder=2, width=6.5)
    else:
        for foot in base:
            draw_joint(ax, foot)
    for i, foot in enumerate(base, start=1):
        write(ax, foot + 0.05 * size * unit_vector(-np.pi / 2), f"$A_{i}$")
    labels = []
    for k, pose in enumerate(modes, start=1):
        point = platform_points(platform, pose)[2]
        ax.plot(*point, "o", ms=7, mfc="white", mec=INK, mew=1.5, zorder=7)
        out = 0.05 * size * (point - base[2]) / (np.hypot(*(point - base[2])) or 1)
        crowded = any(np.hypot(*(point + out - other)) < 0.06 * size for other in labels)
        labels.append(point - out if crowded else point + out)
        write(ax, labels[-1], str(k), fontweight="bold")
    if view is None:
        leave_room(ax, 0.05 * size)
    else:
        _look_at(ax, view)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, handlelength=2.6, columnspacing=1.6)
    return ax


@styled
def draw_leg_lines(base, platform, poses, ax=None, *, labels=None, letters="q", view=None):
    """Draw a 3-RPR in several poses with its leg lines prolonged, and the points where two of them meet.

    Where the three lines meet in one point, the platform can begin to turn about it with its legs locked.

    Parameters
    ----------
    base, platform : array-like, shape (3, 2), in metres
    poses : array-like, shape (k, 3)
        Rows x, y (metres), phi (radians).
    labels : sequence of k texts, optional
        Written below the pictures; by default the angle phi.
    letters : str
        What the legs are called, with their numbers; empty for no names.
    view : (x_min, x_max, y_min, y_max), in metres, optional
        What one picture shows; by default the robot in all poses, with room around it.

    Returns
    -------
    matplotlib Axes
    """
    base = as_numbers(base, "base", (3, 2))
    poses = as_rows(poses, "poses", 3)
    robots = [platform_points(platform, pose) for pose in poses]
    labels = _angle_labels(poses) if labels is None else list(labels)
    if len(labels) != len(poses):
        raise ValueError(f"labels: expected {len(poses)}, found {len(labels)}")
    seen = np.vstack([base, *robots])
    if view is None:
        low, high = seen.min(axis=0), seen.max(axis=0)
        room = 0.35 * (high - low).max()
        view = low[0] - room, high[0] + room, low[1] - room, high[1] + room
    corner, size = np.array([view[0], view[2]]), np.array([view[1] - view[0], view[3] - view[2]])

    def picture(k, ax, shift):
        window = Rectangle(corner + shift, *size, fill=False, edgecolor=FAINT, lw=1, zorder=1)
        ax.add_patch(window)
        far = 3 * size.max()
        for i, (foot, joint) in enumerate(zip(base, robots[k]), start=1):
            leg = (joint - foot) / (np.hypot(*(joint - foot)) or 1)
            ends = np.array([foot - far * leg, joint + far * leg]) + shift
            line = ax.plot(*ends.T, color=SOFT, lw=1.1, ls=CENTRE_LINE, zorder=2)[0]
            line.set_clip_path(window)
            aside = 0.045 * size.max() * np.array([-leg[1], leg[0]])
            if letters:
                write(ax, (foot + joint) / 2 + aside + shift, f"${letters}_{i}$")
        _robot(ax, base + shift, robots[k] + shift, width=6.5)
        for i in range(3):
            meeting = _meeting_point(base, robots[k], i, (i + 1) % 3)
            if meeting is not None and ((meeting > corner) & (meeting < corner + size)).all():
                ax.plot(*(meeting + shift), "o", ms=9, mfc="none", mec=AXIS_COLOURS["x"], mew=1.8, zorder=8)

    return _gallery(ax, picture, [np.vstack([base, joints]) for joints in robots], labels, 2, view, base, inches=3.6)


def _meeting_point(base, joints, i, j):
    """Where the lines of two legs meet; None when they are parallel."""
    legs = joints - base
    across = legs[i, 0] * legs[j, 1] - legs[i, 1] * legs[j, 0]
    if abs(across) < 1e-9 * max(1e-12, np.hypot(*legs[i]) * np.hypot(*legs[j])):
        return None
    gap = base[j] - base[i]
    return base[i] + (gap[0] * legs[j, 1] - gap[1] * legs[j, 0]) / across * legs[i]


@styled
def draw_3rrr(base, platform, bars, pose, solutions, ax=None, *, columns=4):
    """Draw all ways in which the legs of a 3-RRR reach one pose of the platform, side by side on one scale.

    Parameters
    ----------
    base, platform : array-like, shape (3, 2), in metres
    bars : (float, float), or three of them, in metres
        Lengths of the driven bar and of the bar that carries the platform, the same in the three legs or for each leg.
    pose : array-like, shape (3,)
        x, y (metres), phi (radians).
    solutions : array-like, shape (k, 6), in radians
        Rows (drive, elbow) of legs 1, 2, 3; the elbow angle is measured from the driven bar.

    Returns
    -------
    matplotlib Axes
    """
    base = as_numbers(base, "base", (3, 2))
    bars = np.broadcast_to(as_lengths(bars, "bars", (2,) if np.ndim(bars) < 2 else (3, 2)), (3, 2))
    solutions = as_rows(solutions, "solutions", 6)
    joints = platform_points(platform, pose)
    chains = [
        [foot + planar_joints(bars[i], row[2 * i : 2 * i + 2]) for i, foot in enumerate(base)] for row in solutions
    ]
    labels = [f"{k}:  elbows {_signs(row[1::2])}" for k, row in enumerate(solutions, start=1)]

    def picture(k, ax, shift):
        patch = Polygon(joints + shift, facecolor=PLATFORM, edgecolor=INK, lw=1.6, joinstyle="round", zorder=2)
        ax.add_patch(patch)
        for chain in chains[k]:
            draw_link(ax, *(chain[1:] + shift), ROD, 4.5, 3)
            draw_link(ax, *(chain[:2] + shift), "white", 6.5, 3.2)
            for point in chain + shift:
                draw_joint(ax, point, 3.8, size=5)

    return _gallery(ax, picture, [np.vstack([*chain, joints]) for chain in chains], labels, columns, None, base)


def _signs(angles) -> str:
    return " ".join("+" if angle > 0 else "\N{MINUS SIGN}" for angle in angles)
