"""A gripper and its frame."""

from __future__ import annotations

import numpy as np

from .chains import Bodies, Labels
from .inputs import as_numbers
from .strokes_3d import draw_arrow_3d
from .style import INK, styled
from .two_axes import add_axis
from .view import fit_3d, new_axes_3d


@styled
def draw_gripper(opening=0.5, ax=None):
    """Draw a gripper over a part, with its frame: Z towards the part, Y along the way of the jaws, X normal to both.

    Parameters
    ----------
    opening : float from 0 to 1

    Returns
    -------
    matplotlib Axes (3D)
    """
    opening = float(np.clip(as_numbers(opening, "opening", ()), 0, 1))
    own, ax = ax is None, ax or new_axes_3d(20, -38)
    bodies = Bodies(ax, 1.3, fine=24)
    z, y = np.array([0, 0, -1.0]), np.array([0, -1.0, 0])
    x = np.cross(y, z)
    axes = np.column_stack([x, y, z])
    gap = 0.11 + 0.22 * opening
    bodies.add_tube((0, 0, 1.0), (0, 0, 0.62), 0.09, 0.86, caps=True)
    bodies.add_box(np.array([0, 0, 0.52]), axes, (0.12, 0.5, 0.1), 0.9, cells=6)
    for way in (-1, 1):
        bodies.add_box(np.array([0, way * (gap + 0.05), 0.16]), axes, (0.09, 0.05, 0.26), 0.68, cells=5)
    bodies.add_box(np.array([0, 0, -0.42]), axes, (0.1, 0.1, 0.1), 0.97)
    bodies.draw(ax)
    labels = Labels()
    for letter, along, size in (("x", x, 0.5), ("y", y, 0.72), ("z", z, 0.38)):
        add_axis(ax, labels, np.zeros(3), along, size, letter, "E", width=2.2)
    ax.plot(0, 0, 0, "o", ms=5.5, color=INK, zorder=8)
    labels.ask(np.zeros(3), "$O_{E}$", -x + 0.3 * z, gap=8)
    for way in (-1, 1):
        foot = np.array([0.12, way * (gap + 0.05), 0.3])
        draw_arrow_3d(ax, foot, foot + way * np.array([0, 0.2, 0]), width=1.4)
        draw_arrow_3d(ax, foot, foot - way * np.array([0, 0.12, 0]), width=1.4)
    labels.ask(np.array([0.12, gap + 0.25, 0.3]), "jaws slide", -y, fontsize=10, gap=8)
    labels.ask(np.array([0.1, 0.1, -0.42]), "part", -y, fontsize=10, gap=10)
    fit_3d(ax, np.vstack([bodies.points(), 0.75 * np.vstack([x, y, z, -x])]), own, pad=0.42)
    labels.place(ax)
    return ax
