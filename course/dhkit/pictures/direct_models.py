"""A student's direct models: turns of the planar SCARA, of the six-axis arm, and the RX-90 with a tool."""

from __future__ import annotations

from math import radians

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.patches import Rectangle

from .. import drawing, strokes
from ..drawing.chains import chain_frames, draw_chain
from ..drawing.direct import draw_six_axes, turn_about
from .own_result import called, numbers, own_result
from .tables import say_if_not_rigid

YOURS = strokes.AXIS_COLOURS["x"]


@own_result
def show_turned_hand(blanks, values: dict[str, float]):
    """The hand of the stretched SCARA turned by joint 4, with the last column of K4 as answered.

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
    points = drawing.planar_points(lengths, np.zeros(3))
    ax = strokes.new_axes()
    strokes.show_plane(ax)
    strokes.arm(ax, points[:3], strokes.POSTURE_SHADES[0], width=10)
    ax.plot(*points[2:].T, color=strokes.SOFT, lw=1.3, ls=(0, (3, 2)), zorder=2)
    turned = points[2:] @ turn_about(values["t4"], np.zeros(2))[:2, :2].T + column
    strokes.link(ax, *turned, strokes.POSTURE_SHADES[1], width=10, zorder=4)
    strokes.target_mark(ax, points[2])
    strokes.write(ax, points[2] - (0, 0.1 * sum(lengths)), "centre")
    ax.update_datalim(np.vstack([points, turned]))
    strokes.leave_room(ax, 0.14 * sum(lengths))
    return ax


@own_result
def show_tool_point(answer, values: dict[str, float]):
    """The point [x, y] on a SCARA seen from above whose tool reaches aside.

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
    ax = drawing.draw_planar_arm(lengths, q, hand="", **names)
    corner = drawing.planar_points(lengths, q)[-1]
    tip = corner + values["w"] * strokes.unit_vector(sum(q) + np.pi / 2)
    ax.plot(*zip(corner, tip), color=strokes.INK, lw=3, zorder=5)
    ax.plot(*tip, "o", ms=6, color=strokes.INK, zorder=6)
    strokes.write(ax, (corner + tip) / 2 + 0.07 * sum(lengths) * strokes.unit_vector(sum(q)), "$w$")
    drawing.mark_target(ax, at, "your result")
    return ax


@own_result
def show_turns(K, values: dict[str, float]):
    """The links of the six-axis arm carried by the products of an answer's turns, over the arm itself.

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
    K = [matrix.tolist() if isinstance(matrix, (sympy.MatrixBase, np.ndarray)) else matrix for matrix in K]
    turns = numbers(K, "K", (6, 4, 4), values)
    ax, lengths = _six_axes(values)
    moved = [np.eye(4)]
    for turn in turns:
        moved.append(moved[-1] @ turn)
    D3, L2, D4, h = (*lengths, 0.2)
    corners = ((0, (0, 0, 0)), (2, (0, 0, L2)), (3, (D3, 0, L2)), (4, (D3, 0, L2 + D4)), (6, (D3, 0, L2 + D4 + h)))
    path = np.array([(moved[link] @ [*point, 1])[:3] for link, point in corners])
    ax.plot(*path.T, color=YOURS, lw=2, ls=(0, (3, 1.5)), marker="o", ms=4, zorder=8)
    return ax


@own_result
def show_wrist(answer, values: dict[str, float]):
    """The point [x, y, z] on the six-axis arm.

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
    _mark_in_space(ax, at)
    return ax


def _six_axes(values):
    """The arm in the posture of `values`, and its lengths."""
    lengths = [values[name] for name in ("D3", "L2", "D4")]
    return draw_six_axes([values.get(f"t{i}", 0.0) for i in range(1, 7)], *lengths), lengths


def _mark_in_space(ax, at):
    ax.plot(*np.array(at)[:, None], marker="o", ms=13, mfc="none", mec=YOURS, mew=1.6, zorder=9)
    ax.plot(*np.array(at)[:, None], marker="+", ms=19, color=YOURS, mew=1.6, zorder=9)


@own_result
def show_marks(marks, matrices):
    """Printed matrices with a box around every cell that an answer marks as wrong.

    Parameters
    ----------
    marks : list of n arrays of 0 and 1, shape (4, 4) each
    matrices : dict of n SymPy matrices by name, 4x4

    Returns
    -------
    matplotlib Axes
    """
    marks = [mark.tolist() if isinstance(mark, (sympy.MatrixBase, np.ndarray)) else mark for mark in marks]
    marks = numbers(marks, "marks", (len(matrices), 4, 4), {})
    ax = plt.subplots(figsize=(7.4, 1.75 * len(matrices)))[1]
    strokes.show_bare(ax)
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
            ax.plot(
                [x + inward, x, x, x + inward], [top + 0.5, top + 0.5, top - 3.5, top - 3.5], color=strokes.INK, lw=1
            )
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
    """A hand frame on the RX-90 in the posture given by `values`, seen from frame `base`.

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
    drawing.mark_frame(ax, frame, "6", 0.22 * (values["a3"] + values["d3"]))
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_rx90_forward(forward, mine):
    """The path of the tool that a direct model gives for a motion of all joints, beside the RX-90 with that tool at its end.

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
    drawing.mark_path(ax, frames, 0.08 * (mine["a3"] + mine["d3"]), stations=4)
    points = np.vstack([frames[:, :3, 3], chain_frames(rows, values)[:, :3, 3], [(0, 0, -0.2)]])
    strokes.fit_3d(ax, points, own=True, pad=0.7)
    say_if_not_rigid(ax, frames[-1])
    return ax
