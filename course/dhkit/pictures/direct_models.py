"""A student's direct models: turns of the planar SCARA, of the six-axis arm, and the RX-90 with a tool."""

from __future__ import annotations

from math import radians

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.patches import Rectangle

from ..drawing.chains import chain_frames, draw_chain
from ..drawing.frames import mark_frame, mark_path
from ..drawing.planar import draw_planar_arm, mark_target
from ..drawing.six_axes import draw_six_axes
from ..drawing.strokes import draw_arm, draw_link, draw_target, leave_room, new_axes, show_bare, show_plane, write
from ..drawing.strokes_3d import draw_target_3d
from ..drawing.style import AXIS_COLOURS, DASHED, INK, POSTURE_SHADES, SOFT
from ..drawing.view import fit_3d
from ..geometry import chain_products, planar_joints, rotation_2d, unit_vector
from .own_result import called, numbers, own_result, say_if_not_rigid

YOURS = AXIS_COLOURS["x"]


@own_result
def show_turned_hand(blanks, values: dict[str, float]):
    """Show the hand of the stretched SCARA turned by joint 4, with the last column of K4 as answered.

    Parameters
    ----------
    blanks : 2 entries, SymPy or numbers
    values : dict
        Numbers for t4 (radians), L1, L2 and the length L4 of the hand (metres).

    Returns
    -------
    matplotlib Axes
        The turned hand begins at the marked centre when the answer is right.
    """
    known = {name: values[name] for name in ("t4", "L1", "L2")}
    column = numbers(blanks, "blanks", (2,), known)
    lengths = [values["L1"], values["L2"], values["L4"]]
    points = planar_joints(lengths, np.zeros(3))
    ax = new_axes()
    show_plane(ax)
    draw_arm(ax, points[:3], POSTURE_SHADES[0], width=10)
    ax.plot(*points[2:].T, color=SOFT, lw=1.3, ls=DASHED, zorder=2)
    turned = points[2:] @ rotation_2d(values["t4"]).T + column
    draw_link(ax, *turned, POSTURE_SHADES[1], width=10, zorder=4)
    draw_target(ax, points[2])
    write(ax, points[2] - (0, 0.1 * sum(lengths)), "centre")
    ax.update_datalim(np.vstack([points, turned]))
    leave_room(ax, 0.14 * sum(lengths))
    return ax


@own_result
def show_tool_point(answer, values: dict[str, float]):
    """Show the point [x, y] on a SCARA seen from above whose tool reaches aside.

    Parameters
    ----------
    answer : 2 entries, SymPy or numbers
    values : dict
        Numbers for t1, t2, t4 (radians), L1, L2, L4, w (metres).

    Returns
    -------
    matplotlib Axes
        The cross belongs on the end of the tool.
    """
    at = numbers(answer, "tool point", (2,), values)
    lengths, q = [values[name] for name in ("L1", "L2", "L4")], [values[name] for name in ("t1", "t2", "t4")]
    names = {"length_names": ("L_1", "L_2", "L_4"), "angle_names": (r"\theta_1", r"\theta_2", r"\theta_4")}
    ax = draw_planar_arm(lengths, q, hand="", **names)
    corner = planar_joints(lengths, q)[-1]
    tip = corner + values["w"] * unit_vector(sum(q) + np.pi / 2)
    ax.plot(*zip(corner, tip), color=INK, lw=3, zorder=5)
    ax.plot(*tip, "o", ms=6, color=INK, zorder=6)
    write(ax, (corner + tip) / 2 + 0.07 * sum(lengths) * unit_vector(sum(q)), "$w$")
    mark_target(ax, at, "your result")
    return ax


@own_result
def show_turns(K, values: dict[str, float]):
    """Show the links of the six-axis arm carried by the products of an answer's turns, over the arm itself.

    Parameters
    ----------
    K : six 4x4 matrices, SymPy or numbers
    values : dict
        Numbers for t1 to t6 (radians), D3, L2, D4 (metres).

    Returns
    -------
    matplotlib Axes (3D)
        The dashed line runs inside the arm when all six are right.
    """
    turns = numbers(K, "K", (6, 4, 4), values)
    ax, lengths = _six_axes(values)
    moved = chain_products(turns)
    D3, L2, D4, h = (*lengths, 0.2)
    corners = ((0, (0, 0, 0)), (2, (0, 0, L2)), (3, (D3, 0, L2)), (4, (D3, 0, L2 + D4)), (6, (D3, 0, L2 + D4 + h)))
    path = np.array([(moved[link] @ [*point, 1])[:3] for link, point in corners])
    ax.plot(*path.T, color=YOURS, lw=2, ls=(0, (3, 1.5)), marker="o", ms=4, zorder=8)
    return ax


@own_result
def show_wrist_centre(answer, values: dict[str, float]):
    """Show the point [x, y, z] on the six-axis arm.

    Parameters
    ----------
    answer : 3 entries, SymPy or numbers
    values : dict
        Numbers for t1, t2, t3 (radians), D3, L2, D4 (metres); t4 to t6 if they are there, else 0.

    Returns
    -------
    matplotlib Axes (3D)
        The cross belongs on the first of the two black dots.
    """
    known = {name: values[name] for name in ("t1", "t2", "t3", "D3", "L2", "D4")}
    at = numbers(answer, "wrist", (3,), known)
    ax, _ = _six_axes(values)
    draw_target_3d(ax, at, YOURS, zorder=9, width=1.6)
    return ax


def _six_axes(values):
    """The arm in the posture of `values`, and its lengths."""
    lengths = [values[name] for name in ("D3", "L2", "D4")]
    return draw_six_axes([values.get(f"t{i}", 0.0) for i in range(1, 7)], *lengths), lengths


@own_result
def show_marks(marks, matrices):
    """Show printed matrices with a box around every cell that an answer marks as wrong.

    Parameters
    ----------
    marks : list of n arrays of 0 and 1, shape (4, 4) each
    matrices : dict of n SymPy matrices by name, 4x4

    Returns
    -------
    matplotlib Axes
    """
    marks = numbers(marks, "marks", (len(matrices), 4, 4), {})
    ax = plt.subplots(figsize=(7.4, 1.75 * len(matrices)))[1]
    show_bare(ax)
    ax.set_aspect("auto")
    for n, (name, matrix) in enumerate(matrices.items()):
        top = -5.0 * n
        ax.text(-0.75, top - 1.5, f"${name}$", ha="center", va="center", fontsize=13)
        for i in range(4):
            for j in range(4):
                ax.text(j, top - i, f"${sympy.latex(_short(matrix[i, j]))}$", ha="center", va="center", fontsize=10)
                if marks[n, i, j]:
                    ax.add_patch(Rectangle((j - 0.48, top - i - 0.45), 0.96, 0.9, fill=False, ec=YOURS, lw=1.6))
        for x in (-0.5, 3.5):
            inward = 0.08 if x < 0 else -0.08
            ax.plot([x + inward, x, x, x + inward], [top + 0.5, top + 0.5, top - 3.5, top - 3.5], color=INK, lw=1)
    ax.set(xlim=(-1.2, 3.6), ylim=(-5.0 * len(matrices) + 1.3, 0.7))
    return ax


def _short(entry):
    """cos(t4) written C4."""
    names = {}
    for call in sympy.sympify(entry).atoms(sympy.cos, sympy.sin):
        letter = "C" if call.func is sympy.cos else "S"
        names[call] = sympy.Symbol(f"{letter}_{str(call.args[0])[1:]}")
    return sympy.sympify(entry).subs(names)


t1, t2, t3, t4, t5, t6, a3, d3 = sympy.symbols("t1 t2 t3 t4 t5 t6 a3 d3")
RX90 = [
    [0, 0, 0, 0, t1],
    [0, 0, sympy.pi / 2, 0, t2],
    [0, a3, 0, 0, t3],
    [0, 0, -sympy.pi / 2, d3, t4],
    [0, 0, sympy.pi / 2, 0, t5],
    [0, 0, -sympy.pi / 2, 0, t6],
]
"""DHm table of the RX-90, for drawing."""


@own_result
def show_on_rx90(answer, values: dict[str, float], base=0):
    """Show a hand frame on the RX-90 in the posture given by `values`, seen from frame `base`.

    Parameters
    ----------
    answer : 4x4 matrix, SymPy or numbers
    values : dict
        Numbers for t1 to t6 (radians), a3, d3 (metres).
    base : int
        Frame from which the answer is seen; the robot is drawn from there on.

    Returns
    -------
    matplotlib Axes (3D)
        The frame belongs on the wrist, with Z along the hand.
    """
    frame = numbers(answer, "transform", (4, 4), values)
    ax = draw_chain(RX90[base:], values, frames=[0], names=[str(i) for i in range(base, 7)], axes=False)
    mark_frame(ax, frame, "6", 0.22 * (values["a3"] + values["d3"]))
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_rx90_forward(forward, mine):
    """Show the path that a direct model gives for the tool in a motion of all joints, beside the RX-90 at its end.

    Parameters
    ----------
    forward : function (t1, ..., t6) -> 4x4 numbers
    mine : dict
        Numbers a3, d3, reach, length (metres) and bend (degrees).

    Returns
    -------
    matplotlib Axes (3D)
        The path ends on the tool point, its frames stand as the tool does.
    """
    start, end = np.radians([60, 25, -75, 0, 40, 0]), np.radians([-30, 65, -40, 25, -50, 40])
    path = [start + s * (end - start) for s in np.linspace(0, 1, 31)]
    frames = np.array([numbers(called(forward, *map(float, q)), "forward", (4, 4), {}) for q in path])
    rows = [*RX90, [0, mine["reach"], radians(mine["bend"]), mine["length"], 0]]
    values = dict(zip(("t1", "t2", "t3", "t4", "t5", "t6"), end)) | {name: mine[name] for name in ("a3", "d3")}
    ax = draw_chain(rows, values, frames=(), axes=False, tool=True)
    mark_path(ax, frames, 0.08 * (mine["a3"] + mine["d3"]), stations=4)
    points = np.vstack([frames[:, :3, 3], chain_frames(rows, values)[:, :3, 3], [(0, 0, -0.2)]])
    fit_3d(ax, points, own=True, pad=0.7)
    say_if_not_rigid(ax, frames[-1])
    return ax
