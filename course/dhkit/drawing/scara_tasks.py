"""Side views of SCARAs that are told as walks."""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Rectangle

from ..scara_tasks import JOINTS, SCARAS, describe
from .strokes import draw_axis_arrow, draw_link, leave_room, new_axes, show_plane, write
from .style import INK, POSTURE_SHADES, styled

_UP = np.array([0.0, 1.0])
_MOVES = {"ahead": np.array([1.0, 0.0]), "up": _UP, "down": -_UP}


@styled
def draw_own_scara(arm, values, ax=None, *, words=True):
    """Draw a SCARA from the side, all its turns 0, with every axis z and the letters of its lengths and slides.

    Parameters
    ----------
    arm : str
        A name of `dhkit.scara_tasks.SCARAS`.
    values : dict
        Numbers for its slides and for A, B, H, in metres.
    words : bool
        Tell the steps beside the picture.

    Returns
    -------
    matplotlib Axes
        x0 to the right, z0 upwards.
    """
    ax = ax or new_axes((6.0, 4.2))
    show_plane(ax, labels=("x (m)", "z (m)"))
    at, size, beside = np.zeros(2), 0.12, 0
    for axis, angle in (("x", 0.0), ("z", np.pi / 2)):
        draw_axis_arrow(ax, (0, 0), angle, size, axis, f"{axis}_0")
    for what, letter, axis in SCARAS[arm]:
        if what == "turn":
            joint, beside = JOINTS.index(letter) + 1, beside + 1
            ax.add_patch(Rectangle(at - (0.03, 0.02), 0.06, 0.04, facecolor=POSTURE_SHADES[0], edgecolor=INK, zorder=5))
            _axis(ax, at, axis, joint, size, beside)
            write(ax, at + (-0.055, 0.05), f"$q_{joint}$")
            continue
        move = (1 if axis != "down" else -1) * _UP if what == "slide" else _MOVES[what]
        end = at + values[letter] * move
        if what == "slide":
            joint, beside = JOINTS.index(letter) + 1, beside + 1
            ax.plot(*zip(at, end), color=INK, lw=5, zorder=3, solid_capstyle="butt")
            ax.plot(*zip(at, end), color="white", lw=2.5, zorder=3.1, solid_capstyle="butt")
            _axis(ax, end, axis, joint, size, beside)
            write(ax, (at + end) / 2 + (-0.055, 0), f"$q_{joint}$")
        else:
            draw_link(ax, at, end, POSTURE_SHADES[0])
            write(
                ax,
                (at + end) / 2 + (np.array([0.0, 0.05]) if what == "ahead" else np.array([-0.055, 0.0])),
                f"${letter}$",
            )
        at = end
    if words:
        ax.text(1.04, 1.0, describe(arm), transform=ax.transAxes, va="top", fontsize=10, linespacing=1.6)
    leave_room(ax, 0.12)
    return ax


def _axis(ax, at, axis, joint, size, beside):
    """The arrow z of a joint, a little to the right of its place, so that axes on one line stay apart."""
    place = at + (0.025 * (beside % 2) + 0.03, 0)
    draw_axis_arrow(ax, place, np.pi / 2 if axis == "up" else -np.pi / 2, size, "z", f"z_{joint}")
