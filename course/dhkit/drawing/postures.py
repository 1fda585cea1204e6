"""What an inverse model answers: the postures of one pose side by side, families, arm plane, shoulder, wrist."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Circle, Rectangle

from ..geometry import planar_joints, unit_vector, wrap
from .chains import chain_frames
from .inputs import as_lengths, as_names, as_numbers, as_rows
from .strokes import (
    draw_arm,
    draw_axis_arrow,
    draw_ground,
    draw_joint,
    draw_link,
    draw_target,
    keep_in_view,
    leave_room,
    new_axes,
    show_plane,
    write,
)
from .strokes_3d import arc_points, draw_angle_3d, draw_arrow_3d, draw_target_3d, write_3d
from .style import (
    AXIS_COLOURS,
    AXIS_DASHES,
    CENTRE_LINE,
    FAINT,
    INK,
    LIMIT_DASHES,
    POSTURE_SHADES,
    SOFT,
    in_degrees,
    styled,
)
from .view import fit_3d, new_axes_3d, view_axes

ALIGNED_STYLE = {"color": SOFT, "lw": 1, "ls": CENTRE_LINE}


def _frames_and_path(table):
    """Frames of a DHm table of numbers, and the way that its links take: each common normal, then along the axis."""
    frames = chain_frames(table)
    feet = [before[:3, 3] + float(row[1]) * before[:3, 0] for before, row in zip(frames, table)]
    path = [frames[0][:3, 3]]
    for foot, frame in zip(feet, frames[1:]):
        path += [foot, frame[:3, 3]]
    return frames, np.array(path)


def _size(path) -> float:
    return np.linalg.norm(np.diff(path, axis=0), axis=1).sum()


def _draw_arm(ax, table, shade, shift=(0, 0, 0), size=None, width=7.0, zorder=3.0, base=True):
    """One arm moved by `shift`: column, links, joints, and with six joints the wrist's axis 5 and the hand.

    Returns the points that the view must hold.
    """
    frames, path = _frames_and_path(table)
    size = size or _size(path)
    shift, towards = np.asarray(shift, float), view_axes(ax)[2]
    foot = np.array([0, 0, -0.3 * size])
    points = [shift + (foot if base else 0), *(shift + path)]
    if base:
        turn = np.linspace(0, 2 * np.pi, 40)
        disc = arc_points(np.zeros(3), 0.13 * size, *np.eye(3)[:2], turn)
        ax.plot(*(shift + foot + disc).T, color=INK, lw=1, zorder=zorder - 0.5)
        ax.plot(*(shift + 1.8 * disc + foot).T, color=FAINT, lw=0.8, zorder=zorder - 0.5)
        points += list(shift + foot + 1.8 * disc[::10])
        # X1 halfway up the column: which way joint 1 has turned.
        nose = shift + 0.5 * foot
        arrow_end = nose + 0.16 * size * frames[1][:3, 0]
        draw_arrow_3d(ax, nose, arrow_end, width=1.6, zorder=zorder + 0.55, scale=8)
    # Far parts first: mplot3d does not hide what lies behind.
    segments = list(zip([foot, *path] if base else path, path if base else path[1:]))
    segments = [(start, end) for start, end in segments if np.linalg.norm(end - start) > 1e-9]
    depths = [(start + end) @ towards / 2 for start, end in segments]
    low, spread = min(depths), max(np.ptp(depths), 1e-9)
    for (start, end), depth in zip(segments, depths):
        layer = zorder + 0.6 * (depth - low) / spread
        for pen, colour in ((width, INK), (width - 2.2, shade)):
            ax.plot(*zip(shift + start, shift + end), color=colour, lw=pen, solid_capstyle="round", zorder=layer)
    joints = np.unique(np.round(frames[1:, :3, 3], 9), axis=0)
    for at in joints:
        ax.plot(*(shift + at)[:, None], "o", ms=0.75 * width, mfc="white", mec=INK, mew=1.1, zorder=zorder + 0.7)
    if len(frames) >= 7:
        points += _draw_wrist_and_hand(ax, frames, shift, 0.17 * size, zorder + 0.8)
    return points


def _draw_wrist_and_hand(ax, frames, shift, reach, zorder):
    """Axis Z5 through the wrist centre, the hand with the axis X of the last frame."""
    last, centre = frames[-1], shift + frames[5][:3, 3]
    hand = shift + last[:3, 3]
    tip = hand + 0.75 * reach * last[:3, 2]
    ax.plot(*zip(centre, tip), color=INK, lw=3, solid_capstyle="butt", zorder=zorder)
    jaw, ahead = 0.3 * reach * last[:3, 1], 0.4 * reach * last[:3, 2]
    ax.plot(*zip(tip + jaw + ahead, tip + jaw, tip - jaw, tip - jaw + ahead), color=INK, lw=2, zorder=zorder)
    ends = []
    for origin, direction, letter in ((centre, frames[5][:3, 2], "z"), (tip, last[:3, 0], "x")):
        ends.append(origin + reach * direction)
        colour, dashes = AXIS_COLOURS[letter], AXIS_DASHES[letter]
        draw_arrow_3d(ax, origin, ends[-1], colour, dashes, width=1.5, zorder=zorder + 0.1, scale=9)
    return [tip + ahead, tip + jaw, tip - jaw, *ends]


def _tables(tables) -> list:
    tables = list(tables)
    if not tables:
        raise ValueError("tables: expected at least one table, found none")
    return [as_numbers(table, f"table {k + 1}", (None, 5)) for k, table in enumerate(tables)]


@styled
def draw_posture_gallery(tables, names=None, target=None, ax=None, *, columns=4, elev=18.0, azim=-62.0):
    """Draw postures of one robot side by side, all from the same view and at the same scale.

    The arrow on the column is X1: which way joint 1 has turned. A six-axis arm shows its hand with X6 (red, solid) and
    axis Z5 of the wrist (blue, dash-dotted), which tells the two postures of a wrist apart.

    Parameters
    ----------
    tables : sequence of array-likes, shape (n, 5)
        One DHm table of numbers per posture, rows [sigma, a, alpha, d, theta], in metres and radians.
    names : sequence of texts, optional
        Written under the postures; by default 1, 2, 3, ...
    target : array-like, shape (3,), in metres, optional
        A point to mark in every picture.
    columns : int
        Postures per row.
    elev, azim : float, in degrees
        Direction of view.

    Returns
    -------
    matplotlib Axes (3D)
    """
    tables = _tables(tables)
    names = as_names(names, len(tables), range(1, len(tables) + 1))
    own, ax = ax is None, ax or new_axes_3d(elev, azim)
    right, up, _ = view_axes(ax)
    chains = [_frames_and_path(table) for table in tables]
    scale = max(_size(path) for _, path in chains)
    # Room that any of the arms needs, measured in the plane of the paper.
    reach = [np.vstack([path, frames[-1, :3, 3] + 0.2 * scale * frames[-1, :3, :3].T]) for frames, path in chains]
    if target is not None:
        target = as_numbers(target, "target", (3,))
        reach.append(target[None])
    seen = np.vstack(reach) @ np.array([right, up]).T
    wide = max(np.ptp(seen[:, 0]), 0.5 * scale) + 0.22 * scale
    foot = min(seen[:, 1].min(), -0.42 * scale)
    high = seen[:, 1].max() - foot + 0.3 * scale
    points = []
    for k, (table, name) in enumerate(zip(tables, names)):
        row, column = divmod(k, columns)
        shift = column * wide * right - row * high * up
        points += _draw_arm(ax, table, POSTURE_SHADES[1], shift, scale)
        if target is not None:
            draw_target_3d(ax, shift + target)
            points.append(shift + target)
        at = shift + (foot - 0.1 * scale) * up
        write_3d(ax, at, name, fontsize=9.5)
        points += [at - 0.08 * scale * up + side * 0.4 * wide * right for side in (-1, 1)]
    used = min(columns, len(tables))
    fit_3d(ax, points, own, width=2.35 * used + 0.4, height=2.9 * -(-len(tables) // columns) + 0.4, pad=0.1)
    return ax


@styled
def draw_posture_family(tables, ax=None, *, elev=20.0, azim=-62.0):
    """Draw members of one family of postures over each other: the hand stays, the arm moves. Darker means later.

    Parameters
    ----------
    tables : sequence of array-likes, shape (n, 5)
        One DHm table of numbers per member, rows [sigma, a, alpha, d, theta].
    elev, azim : float, in degrees
        Direction of view.

    Returns
    -------
    matplotlib Axes (3D)
    """
    tables = _tables(tables)
    own, ax = ax is None, ax or new_axes_3d(elev, azim)
    points, greys = [], np.linspace(0.93, 0.5, len(tables))
    for k, (table, grey) in enumerate(zip(tables, greys)):
        last = k == len(tables) - 1
        points += _draw_arm(ax, table, str(grey), zorder=3 + k, base=last)
    fit_3d(ax, points, own, width=5.2, height=4.6)
    return ax


@styled
def draw_arm_plane(lengths, solutions, target=None, ax=None):
    """Draw an elbow arm in its own vertical plane, which holds axis 1: the point in front, the arm in all its postures.

    To the right is the side of the target. A posture whose joint 1 has turned half round reaches it backwards.

    Parameters
    ----------
    lengths : array-like, shape (2,), in metres
        Upper arm and forearm.
    solutions : array-like, shape (k, 3), in radians
        Rows (t1, t2, t3), elevations counted upwards from the horizontal; joint 1 turned in this plane.
    target : array-like, shape (3,), in metres, optional
        By default the point that the first solution reaches.

    Returns
    -------
    matplotlib Axes
        Horizontal: distance from axis 1; vertical: z.
    """
    lengths = as_lengths(lengths, "lengths", (2,))
    rows = as_rows(solutions, "solutions", 3)
    if target is None and not len(rows):
        raise ValueError("target: expected 3 numbers where no solution is given")
    ax = ax or new_axes((6.2, 4.4))
    show_plane(ax, labels=("distance from axis 1 (m)", "z (m)"))
    total = lengths.sum()
    if target is not None:
        goal = as_numbers(target, "target", (3,))
        ahead = np.arctan2(goal[1], goal[0])
        goal = np.array([np.hypot(*goal[:2]), goal[2]])
    else:
        flat = planar_joints(lengths, rows[0, 1:])[2]
        ahead = rows[0, 0] + (0 if flat[0] >= 0 else np.pi)
        goal = np.array([abs(flat[0]), flat[1]])
    top = max(goal[1], 0.4 * total, *(planar_joints(lengths, row[1:])[:, 1].max() for row in rows)) + 0.15 * total
    ax.plot([0, 0], [-0.5 * total, top], zorder=1, **ALIGNED_STYLE)
    write(ax, (0, top + 0.06 * total), "axis 1", fontsize=9)
    ax.plot([0, 0], [-0.5 * total, 0], color=INK, lw=9, zorder=2, solid_capstyle="butt")
    ax.plot([0, 0], [-0.5 * total, 0], color=FAINT, lw=6.6, zorder=2.1, solid_capstyle="butt")
    draw_ground(ax, (0, -0.5 * total), 0.34 * total, 0.05 * total)
    boxes, labels, elbows = [], [], {}
    for k, (t1, t2, t3) in enumerate(rows):
        back = np.cos(t1 - ahead) < 0
        points = planar_joints(lengths, (t2, t3)) * (-1 if back else 1, 1)
        fill = POSTURE_SHADES[k % len(POSTURE_SHADES)]
        draw_arm(ax, points, fill, zorder=3 + k)
        elbows.setdefault(tuple(np.round(points[1:].ravel(), 6)), []).append(str(k + 1))
        boxes.append(Rectangle((0, 0), 1, 1, facecolor=fill, edgecolor=INK))
        names = zip(("t_1", "t_2", "t_3"), (t1, t2, t3))
        labels.append(f"{k + 1}:  " + ",  ".join(f"${name}$ = {in_degrees(wrap(t))}" for name, t in names))
    for (*elbow, x, y), owners in elbows.items():
        out = np.array(elbow) - 0.5 * np.array([x, y])
        write(ax, elbow + 0.13 * total * out / (np.hypot(*out) or 1), ", ".join(owners), fontweight="bold", zorder=20)
    draw_target(ax, goal)
    leave_room(ax, 0.16 * total)
    if boxes:
        ax.legend(boxes, labels, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, handlelength=1.4)
    return ax


@styled
def draw_shoulder_top(offset, target, turns=None, ax=None, *, offset_name="d_2"):
    """Draw a laterally offset arm from above: its planes keep a distance from axis 1, by default through the target.

    Parameters
    ----------
    offset : float, in metres, positive
        Distance of the arm's plane from axis 1, to the left of the direction t1.
    target : array-like, shape (2,), in metres
        The point to reach, seen from above, outside the circle of radius `offset`.
    turns : array-like, shape (k, 2), optional
        Rows (t1, A): direction of the plane in radians, and how far the arm goes in it, in metres.
    offset_name : text in LaTeX

    Returns
    -------
    matplotlib Axes
    """
    offset = float(as_lengths([offset], "offset", (1,))[0])
    goal = as_numbers(target, "target", (2,))
    r = np.hypot(*goal)
    if r <= offset:
        raise ValueError(f"target: expected a point outside the circle of radius {offset:.3g}, found one at {r:.3g}")
    ahead, length = np.arctan2(*goal[::-1]), np.sqrt(r**2 - offset**2)
    both = [(ahead - np.arctan2(offset, a), a) for a in (length, -length)]
    turns = both if turns is None else as_numbers(turns, "turns", (None, 2))
    ax = ax or new_axes((5.4, 4.6))
    show_plane(ax)
    ax.add_patch(Circle((0, 0), offset, facecolor="#eeeeee", edgecolor=INK, lw=1.2, ls=LIMIT_DASHES, zorder=1))
    ax.plot(*zip((0, 0), goal), color=INK, lw=1.1, ls=CENTRE_LINE, zorder=2)
    for k, (t1, a) in enumerate(turns):
        out, along = unit_vector(t1 + np.pi / 2), np.sign(a) * unit_vector(t1)
        foot = offset * out
        fill = POSTURE_SHADES[k % len(POSTURE_SHADES)]
        draw_link(ax, (0, 0), foot, fill, width=10, zorder=3)
        draw_link(ax, foot, foot + abs(a) * along, fill, width=10, zorder=3.2)
        corner = 0.26 * offset
        ax.plot(
            *zip(foot + corner * along, foot + corner * (along - out), foot - corner * out),
            color=INK,
            lw=0.9,
            zorder=2,
        )
        write(ax, foot + 0.5 * abs(a) * along + 0.32 * offset * out, f"{k + 1}", fontweight="bold")
        write(ax, foot / 2 - 0.24 * offset * along, f"${offset_name}$")
    draw_joint(ax, (0, 0), zorder=6)
    draw_target(ax, goal)
    write(ax, goal + 0.4 * offset * unit_vector(ahead), "$(W_x, W_y)$", ha="left", zorder=10)
    write(ax, 0.52 * goal + 0.16 * offset * unit_vector(ahead + np.pi / 2), "$r$")
    for letter, angle in (("x", 0), ("y", np.pi / 2)):
        draw_axis_arrow(ax, (0, 0), angle, 1.7 * offset, letter, f"{letter}_0", away=0.14)
    leave_room(ax, 0.8 * offset)
    keep_in_view(ax, goal, 1.6 * offset)
    return ax


@styled
def draw_aligned_wrist(angles, total=0.0, ax=None):
    """Draw a spherical wrist with axis 6 on axis 4: forearm and hand stay while the wrist turns between them.

    Parameters
    ----------
    angles : array-like, shape (k,), in radians
        Values of t4; the last one is drawn darkest.
    total : float, in radians
        The value of t4 + t6 that the hand keeps.

    Returns
    -------
    matplotlib Axes (3D)
    """
    angles = as_numbers(angles, "angles", (None,))
    if not len(angles):
        raise ValueError("angles: expected at least one value of t4, found none")
    total = float(as_numbers(total, "total", ()))
    own, ax = ax is None, ax or new_axes_3d(elev=24, azim=-58)
    along, side, up = np.eye(3)  # axes 4 and 6 along x
    ax.plot(*zip(-1.75 * along, 2.2 * along), zorder=1, **ALIGNED_STYLE)
    write_3d(ax, 2.42 * along, "$Z_4, Z_6$", color=AXIS_COLOURS["z"])
    for width, colour, rim in ((22, INK, 0.02), (19, POSTURE_SHADES[0], 0)):
        ends = (-1.6 - rim) * along, (-0.42 + rim) * along
        ax.plot(*zip(*ends), color=colour, lw=width, solid_capstyle="butt", zorder=2)
    write_3d(ax, -1.2 * along - 0.45 * up, "forearm", fontsize=9)
    greys = [str(grey) for grey in np.linspace(0.8, 0.25, len(angles))]
    for k, (t4, grey) in enumerate(zip(angles, greys)):
        axis5 = unit_vector(t4) @ [side, up]
        last = k == len(angles) - 1
        colour = AXIS_COLOURS["z"] if last else grey
        ax.plot(*zip(-0.75 * axis5, (0, 0, 0)), color=grey, lw=5 if last else 3, zorder=3 + 0.1 * k)
        draw_arrow_3d(ax, 0 * along, 0.95 * axis5, colour, AXIS_DASHES["z"] if last else "-", zorder=3.05 + 0.1 * k)
        if last:
            write_3d(ax, 1.14 * axis5, "$Z_5$", color=colour)
    ax.plot([0], [0], [0], "o", ms=11, mfc="white", mec=INK, mew=1.4, zorder=4.5)
    ax.plot(*zip(0.1 * along, 1.35 * along), color=INK, lw=4, solid_capstyle="butt", zorder=4)
    x6, jaw = unit_vector([total, total + np.pi / 2]) @ [side, up]  # the jaw slides along Y6
    tip = 1.35 * along
    ax.plot(*zip(tip + 0.32 * jaw + 0.35 * along, tip + 0.32 * jaw, tip - 0.32 * jaw, tip - 0.32 * jaw + 0.35 * along),
            color=INK, lw=2.6, zorder=4)  # fmt: skip
    draw_arrow_3d(ax, tip, tip + 0.8 * x6, AXIS_COLOURS["x"], zorder=5)
    write_3d(ax, tip + 1.0 * x6, "$X_6$", color=AXIS_COLOURS["x"])
    draw_angle_3d(ax, -0.95 * along, side, up, 0.55, 1.9, "")
    draw_angle_3d(ax, 0.85 * along, side, up, 0.45, -1.9, "")
    write_3d(ax, -0.95 * along + 0.85 * up, r"$+\delta$ at joint 4")
    write_3d(ax, 0.85 * along - 0.72 * up, r"$-\delta$ at joint 6")
    points = [-1.8 * along, 2.7 * along, *(1.25 * sign * v for sign in (-1, 1) for v in (side, up)), tip + 1.1 * x6]
    fit_3d(ax, points, own, width=5.6, height=3.8)
    return ax


@styled
def draw_planar_family(lengths, solutions, target, ax=None):
    """Draw many postures of a planar arm of n links that all reach one point. Darker means later.

    Parameters
    ----------
    lengths : array-like, shape (n,), in metres
    solutions : array-like, shape (k, n), in radians
    target : array-like, shape (2,), in metres

    Returns
    -------
    matplotlib Axes
    """
    lengths = as_lengths(lengths, "lengths", (None,))
    rows = as_numbers(solutions, "solutions", (None, len(lengths)))
    goal = as_numbers(target, "target", (2,))
    ax = ax or new_axes((5.2, 4.2))
    show_plane(ax)
    for k, (row, grey) in enumerate(zip(rows, np.linspace(0.93, 0.5, max(len(rows), 1)))):
        draw_arm(ax, planar_joints(lengths, row), str(grey), zorder=3 + k, width=9)
    draw_target(ax, goal)
    leave_room(ax, 0.12 * lengths.sum())
    return ax
