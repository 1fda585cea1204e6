"""Drawings of frames in three dimensions, and of the four parameters that lead from one to the next."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import sympy

from ..geometry import rotation
from .inputs import as_names, as_numbers
from .labels import Labels
from .strokes_3d import draw_angle_3d, draw_arrow_3d, write_3d
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, DASHED, FAINT, INK, SOFT, styled
from .view import fill_panel, fit_3d, new_axes_3d, view_axes


class MergedAxis(NamedTuple):
    """An axis of one frame, or of several whose axes coincide."""

    letter: str
    origin: np.ndarray
    direction: np.ndarray
    owners: list[str]

    @property
    def label(self) -> str:
        """The names of the axis in mathematical notation, such as ``$X_{0}, X_{1}$``."""
        return f"${', '.join(f'{self.letter.upper()}_{{{name}}}' for name in self.owners)}$"


def merge_axes(transforms, names, letters) -> list[MergedAxis]:
    """List the axes of frames, those that coincide once with all their names.

    Parameters
    ----------
    transforms : array-like, shape (n, 4, 4), lengths in metres
    names : sequence of n texts
    letters : str
        Axes to list, "xyz" or a part of it.
    """
    merged: dict[tuple, MergedAxis] = {}
    for transform, name in zip(transforms, names):
        for letter in letters:
            direction = transform[:3, "xyz".index(letter)]
            key = (letter, *np.round(transform[:3, 3], 6) + 0.0, *np.round(direction, 6) + 0.0)
            merged.setdefault(key, MergedAxis(letter, transform[:3, 3], direction, [])).owners.append(name)
    return list(merged.values())


def add_frames(ax, transforms, names, size, letters="xyz"):
    """Draw the axes of frames, `size` metres long, with their names past the tips."""
    for axis in merge_axes(transforms, names, letters):
        colour = AXIS_COLOURS[axis.letter]
        draw_arrow_3d(ax, axis.origin, axis.origin + size * axis.direction, colour, AXIS_DASHES[axis.letter])
        write_3d(ax, axis.origin + 1.28 * size * axis.direction, axis.label, color=colour)


def ask_for_frames(ax, labels, axes, size, width=1.6) -> list[np.ndarray]:
    """Draw axes of frames, `size` metres long, and ask for their names; returns their tips.

    Where axes of two letters lie on one another, the second one is named at its middle.
    """
    tips: list[np.ndarray] = []
    for axis in axes:
        way, colour = size * axis.direction, AXIS_COLOURS[axis.letter]
        end = axis.origin + way
        draw_arrow_3d(ax, axis.origin, end, colour, AXIS_DASHES[axis.letter], width=width)
        if any(np.allclose(end, tip) for tip in tips):
            labels.ask(axis.origin + 0.5 * way, axis.label, np.cross(view_axes(ax)[2], way), colour, gap=7)
        else:
            labels.ask(end, axis.label, axis.direction, colour)
        labels.avoid(np.linspace(axis.origin + 0.1 * way, end, 9))
        tips.append(end)
    return tips


@styled
def draw_frames_3d(transforms, names=None, ax=None, *, size=None, links=True, letters="xyz"):
    """Draw frames in space, joined in their order by grey links.

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
    transforms = as_numbers(
        [t.tolist() if isinstance(t, sympy.MatrixBase) else t for t in transforms], "transforms", (None, 4, 4)
    )
    names = as_names(names, len(transforms), range(len(transforms)))
    origins = transforms[:, :3, 3]
    extent = np.ptp(origins, axis=0).max()
    size = size or (0.22 * extent if extent > 0 else 1.0)
    own, ax = ax is None, ax or new_axes_3d()
    if links:
        ax.plot(*origins.T, color=INK, lw=7, solid_capstyle="round", solid_joinstyle="round", zorder=1)
        ax.plot(*origins.T, color=FAINT, lw=5, solid_capstyle="round", solid_joinstyle="round", zorder=1.1)
    ax.plot(*origins.T, "o", ms=4, color=INK, ls="none", zorder=5)
    labels = Labels()
    ask_for_frames(ax, labels, merge_axes(transforms, names, letters), size)
    ends = (origins[:, None, :] + 1.35 * size * transforms[:, :3, :3].swapaxes(1, 2)).reshape(-1, 3)
    if own:
        fit_3d(ax, np.vstack([origins, ends]), own)
    else:
        fill_panel(ax, np.vstack([origins, ends]))
    labels.place(ax)
    return ax


def dh_axes(alpha, theta) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Directions between two frames of the modified convention, seen from frame i - 1, each of shape (3,).

    Parameters
    ----------
    alpha, theta : float, in radians

    Returns
    -------
    X_i, the direction at right angles to X_{i-1} from which theta is counted towards, and Z_i.
    """
    twist = rotation("x", alpha)
    return twist @ rotation("z", theta)[:, 0], twist[:, 1], twist[:, 2]


@styled
def draw_dh_parameters(a=1.0, alpha=np.radians(40), d=1.3, theta=np.radians(50), ax=None, *, frame=True):
    """Draw the four parameters of the modified DH convention between frames i-1 and i, in space.

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
    a, alpha, d, theta = as_numbers([a, alpha, d, theta], "a, alpha, d, theta", (4,))
    (x0, _, z0), (x1, side, z1) = np.eye(3), dh_axes(alpha, theta)
    foot = a * x0
    origin = foot + d * z1
    size = 0.55
    own, ax = ax is None, ax or new_axes_3d(elev=20, azim=-58)
    for base, axis, low, high in (((0, 0, 0), z0, -0.35, 1.25), (foot, z1, -0.4, d + 0.9)):
        ax.plot(*zip(base + low * axis, base + high * axis), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=1)
    ax.plot(*zip(-0.2 * x0, foot + 0.75 * x0), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=1)
    ax.plot(*zip((0, 0, 0), foot), color=INK, lw=3, zorder=3)
    ax.plot(*zip(foot, origin), color=INK, lw=3, zorder=3)
    for base, axis, letter, name in (
        ((0, 0, 0), z0, "z", "Z_{i-1}"), (foot * 0, x0, "x", "X_{i-1}"),
        (origin, z1, "z", "Z_i"), (origin, x1, "x", "X_i"),
    ):  # fmt: skip
        if name in ("Z_i", "X_i") and not frame:
            continue
        end = np.asarray(base) + size * axis
        draw_arrow_3d(ax, base, end, AXIS_COLOURS[letter], AXIS_DASHES[letter], width=2.1)
        aside = 0.12 * z0 if name == "X_{i-1}" else 0.25 * size * axis
        write_3d(ax, end + aside, f"${name}$", color=AXIS_COLOURS[letter])
    ax.plot(*zip(foot, foot + 0.62 * z0), color=SOFT, lw=0.9, ls=DASHED, zorder=2)
    ax.plot(*zip(origin, origin + 0.5 * x0), color=SOFT, lw=0.9, ls=DASHED, zorder=2)
    draw_angle_3d(ax, foot, z0, -np.array([0, 1.0, 0]), 0.5, alpha, r"\alpha_{i-1}", 1.32)
    draw_angle_3d(ax, origin, x0, side, 0.36, theta, r"\theta_i")
    write_3d(ax, foot * 0.72 + (0, 0, -0.13), "$a_{i-1}$")
    write_3d(ax, foot + 0.62 * d * z1 - (0.12, 0, 0), "$d_i$")
    for at, name, away in (((0, 0, 0), "O_{i-1}", (-0.14, 0, -0.09)), (origin, "O_i", (-0.13, 0, 0.02))):
        ax.plot(*[[c] for c in at], "o", ms=5, color=INK, zorder=6)
        write_3d(ax, np.asarray(at) + away, f"${name}$")
    ends = [
        -0.2 * x0,
        foot + 0.75 * x0,
        -0.35 * z0,
        1.25 * z0,
        foot - 0.4 * z1,
        foot + (d + 0.9) * z1,
        origin + 1.3 * size * x1,
    ]
    fit_3d(ax, ends, own)
    return ax


@styled
def mark_frame(ax, frame, name, size):
    """Mark a frame, shape (4, 4), in a 3D drawing, with axes of length `size` in metres."""
    frame = as_numbers(frame, "frame", (4, 4))
    ax.plot(*frame[:3, 3:], "o", ms=5, color=INK, zorder=7)
    add_frames(ax, [frame], [name], size)
    return ax


@styled
def mark_path(ax, frames, size, stations=6):
    """Mark the path of a moving frame, shape (n, 4, 4), with its X and Y axes at some stations."""
    frames = as_numbers(frames, "frames", (None, 4, 4))
    ax.plot(*frames[:, :3, 3].T, color=INK, lw=1.6, zorder=5)
    for frame in frames[np.linspace(0, len(frames) - 1, stations).astype(int)]:
        for letter, column in (("x", 0), ("y", 1)):
            draw_arrow_3d(
                ax,
                frame[:3, 3],
                frame[:3, 3] + size * frame[:3, column],
                AXIS_COLOURS[letter],
                AXIS_DASHES[letter],
            )
    return ax
