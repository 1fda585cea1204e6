"""Drawings of frames in three dimensions, and of the four parameters that lead from one to the next."""

from __future__ import annotations

import numpy as np
import sympy

from .. import strokes


def merged_axes(transforms, names, letters):
    """Axis arrows of all frames; arrows that coincide are listed once with all their names."""
    merged: dict[tuple, list] = {}
    for transform, name in zip(transforms, names):
        for letter in letters:
            direction = transform[:3, "xyz".index(letter)]
            key = (letter, *np.round(transform[:3, 3], 6) + 0.0, *np.round(direction, 6) + 0.0)
            merged.setdefault(key, [letter, transform[:3, 3], direction, []])[3].append(name)
    return list(merged.values())


def draw_frames(ax, transforms, names, size, letters="xyz"):
    for letter, origin, direction, owners in merged_axes(transforms, names, letters):
        end = origin + size * direction
        strokes.arrow_3d(ax, origin, end, strokes.AXIS_COLOURS[letter], strokes.AXIS_DASHES[letter])
        label = ", ".join(f"{letter.upper()}_{{{name}}}" for name in owners)
        strokes.write_3d(ax, origin + 1.28 * size * direction, f"${label}$", color=strokes.AXIS_COLOURS[letter])


@strokes.styled
def draw_frames_3d(transforms, names=None, ax=None, *, size=None, links=True, letters="xyz"):
    """Frames in space, joined in their order by grey links.

    Axes of several frames that coincide are drawn once and carry all their names.

    Parameters
    ----------
    transforms : array-like, shape (n, 4, 4), lengths in metres
        Frames seen from the base.
    names : sequence of n texts, optional
        Indices of the frames, by default 0, 1, 2, ...
    size : float, in metres, optional
        Length of the axes; by default from the extent of the chain.
    links : bool
        Join the origins.
    letters : str
        Axes to draw, "xyz" or a part of it.

    Returns
    -------
    matplotlib Axes (3D)
    """
    transforms = strokes.as_numbers(
        [t.tolist() if isinstance(t, sympy.MatrixBase) else t for t in transforms], "transforms", (None, 4, 4)
    )
    names = [str(i) for i in range(len(transforms))] if names is None else list(names)
    if len(names) != len(transforms):
        raise ValueError(f"names: expected {len(transforms)}, found {len(names)}")
    origins = transforms[:, :3, 3]
    extent = np.ptp(origins, axis=0).max()
    size = size or (0.22 * extent if extent > 0 else 1.0)
    own, ax = ax is None, ax or strokes.new_axes_3d()
    if links:
        ax.plot(*origins.T, color=strokes.INK, lw=7, solid_capstyle="round", solid_joinstyle="round", zorder=1)
        ax.plot(*origins.T, color=strokes.FAINT, lw=5, solid_capstyle="round", solid_joinstyle="round", zorder=1.1)
    ax.plot(*origins.T, "o", ms=4, color=strokes.INK, ls="none", zorder=5)
    draw_frames(ax, transforms, names, size, letters)
    ends = (origins[:, None, :] + 1.35 * size * transforms[:, :3, :3].swapaxes(1, 2)).reshape(-1, 3)
    strokes.fit_3d(ax, np.vstack([origins, ends]), own)
    return ax


@strokes.styled
def draw_dh_parameters(a=1.0, alpha=np.radians(40), d=1.3, theta=np.radians(50), ax=None, *, frame=True):
    """The four parameters of the modified DH convention between frames i-1 and i, in space.

    Parameters
    ----------
    a, d : float, in metres
    alpha, theta : float, in radians
    frame : bool
        Draw the axes of frame i.

    Returns
    -------
    matplotlib Axes (3D)
    """
    a, alpha, d, theta = strokes.as_numbers([a, alpha, d, theta], "a, alpha, d, theta", (4,))
    z0, x0 = np.array([0, 0, 1.0]), np.array([1.0, 0, 0])
    z1 = np.array([0, -np.sin(alpha), np.cos(alpha)])
    side = np.array([0, np.cos(alpha), np.sin(alpha)])
    x1 = np.cos(theta) * x0 + np.sin(theta) * side
    foot = a * x0
    origin = foot + d * z1
    size = 0.55
    own, ax = ax is None, ax or strokes.new_axes_3d(elev=20, azim=-58)
    for base, axis, low, high in (((0, 0, 0), z0, -0.35, 1.25), (foot, z1, -0.4, d + 0.9)):
        ax.plot(*zip(base + low * axis, base + high * axis), color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=1)
    ax.plot(*zip(-0.2 * x0, foot + 0.75 * x0), color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=1)
    ax.plot(*zip((0, 0, 0), foot), color=strokes.INK, lw=3, zorder=3)
    ax.plot(*zip(foot, origin), color=strokes.INK, lw=3, zorder=3)
    for base, axis, letter, name in (
        ((0, 0, 0), z0, "z", "Z_{i-1}"), (foot * 0, x0, "x", "X_{i-1}"),
        (origin, z1, "z", "Z_i"), (origin, x1, "x", "X_i"),
    ):  # fmt: skip
        if name in ("Z_i", "X_i") and not frame:
            continue
        end = np.asarray(base) + size * axis
        strokes.arrow_3d(ax, base, end, strokes.AXIS_COLOURS[letter], strokes.AXIS_DASHES[letter], width=2.1)
        aside = 0.12 * z0 if name == "X_{i-1}" else 0.25 * size * axis
        strokes.write_3d(ax, end + aside, f"${name}$", color=strokes.AXIS_COLOURS[letter])
    ax.plot(*zip(foot, foot + 0.62 * z0), color=strokes.SOFT, lw=0.9, ls=(0, (3, 2)), zorder=2)
    ax.plot(*zip(origin, origin + 0.5 * x0), color=strokes.SOFT, lw=0.9, ls=(0, (3, 2)), zorder=2)
    strokes.angle_arc_3d(ax, foot, z0, -np.array([0, 1.0, 0]), 0.5, alpha, r"\alpha_{i-1}", 1.32)
    strokes.angle_arc_3d(ax, origin, x0, side, 0.36, theta, r"\theta_i")
    strokes.write_3d(ax, foot * 0.72 + (0, 0, -0.13), "$a_{i-1}$")
    strokes.write_3d(ax, foot + 0.62 * d * z1 - (0.12, 0, 0), "$d_i$")
    for at, name, away in (((0, 0, 0), "O_{i-1}", (-0.14, 0, -0.09)), (origin, "O_i", (-0.13, 0, 0.02))):
        ax.plot(*[[c] for c in at], "o", ms=5, color=strokes.INK, zorder=6)
        strokes.write_3d(ax, np.asarray(at) + away, f"${name}$")
    ends = [
        -0.2 * x0,
        foot + 0.75 * x0,
        -0.35 * z0,
        1.25 * z0,
        foot - 0.4 * z1,
        foot + (d + 0.9) * z1,
        origin + 1.3 * size * x1,
    ]
    strokes.fit_3d(ax, ends, own)
    return ax


@strokes.styled
def mark_frame(ax, frame, name, size):
    """A frame, shape (4, 4), in a 3D drawing, with axes of length `size` in metres."""
    frame = strokes.as_numbers(frame, "frame", (4, 4))
    ax.plot(*frame[:3, 3:], "o", ms=5, color=strokes.INK, zorder=7)
    draw_frames(ax, [frame], [name], size)
    return ax


@strokes.styled
def mark_path(ax, frames, size, stations=6):
    """The path of a moving frame, shape (n, 4, 4), with its X and Y axes at some stations."""
    frames = strokes.as_numbers(frames, "frames", (None, 4, 4))
    ax.plot(*frames[:, :3, 3].T, color=strokes.INK, lw=1.6, zorder=5)
    for frame in frames[np.linspace(0, len(frames) - 1, stations).astype(int)]:
        for letter, column in (("x", 0), ("y", 1)):
            strokes.arrow_3d(
                ax,
                frame[:3, 3],
                frame[:3, 3] + size * frame[:3, column],
                strokes.AXIS_COLOURS[letter],
                strokes.AXIS_DASHES[letter],
            )
    return ax
