"""A student's table or matrix, and the frames that it describes."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.mathtext import MathTextParser

from .. import drawing
from ..strokes import INK
from .own_result import numbers, own_result

COLUMNS = ("i", r"\sigma_i", r"a_{i-1}", r"\alpha_{i-1}", "d_i", r"\theta_i")


@own_result
def show_table(table, values: dict[str, float], tool=False):
    """A DHm table, typeset, beside the chain of frames that it describes.

    Parameters
    ----------
    table : rows [sigma, a, alpha, d, theta]
        SymPy expressions or numbers; lengths in metres, angles in radians.
    values : dict
        Numbers for the symbols of the table, by name.
    tool : bool
        The last row is the tool: its frame is called E.

    Returns
    -------
    matplotlib Axes (3D)
    """
    rows = [list(row) for row in (table.tolist() if hasattr(table, "tolist") else table)]
    cells = numbers(rows, "table", (None, 5), values)
    frames = [np.eye(4)]
    for _, a, alpha, d, theta in cells:
        frames.append(frames[-1] @ dhm(a, alpha, d, theta))
    figure = plt.figure(figsize=(8.4, 3.6))
    names = [*map(str, range(len(rows))), "E" if tool else str(len(rows))]
    _typeset(figure.add_axes((0, 0.05, 0.44, 0.9)), rows, [*names[1:-1], "tool"] if tool else names[1:])
    ax = figure.add_axes((0.42, -0.12, 0.6, 1.24), projection="3d", computed_zorder=False)
    ax.view_init(elev=24, azim=-66)
    ax.set_proj_type("ortho")
    ax.set_axis_off()
    drawing.draw_frames_3d(frames, names, ax=ax)
    ax.set_box_aspect(None, zoom=1.0)
    return ax


def dhm(a, alpha, d, theta) -> np.ndarray:
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s, 0, a], [s * ca, c * ca, -sa, -d * sa], [s * sa, c * sa, ca, d * ca], [0, 0, 0, 1]])


def _typeset(ax, rows, names):
    """The table as on a slide: header between two rules, one line per row."""
    ax.axis("off")
    lines = [[f"${name}$" for name in COLUMNS]]
    lines += [[name, *map(_formula, row)] for name, row in zip(names, rows)]
    height = 1 / max(len(lines) + 1, 6)
    for j, line in enumerate(lines):
        for k, cell in enumerate(line):
            ax.text(0.07 + 0.165 * k, 0.9 - j * height, cell, ha="center", va="center", fontsize=12)
    for y in (0.9 + height / 2, 0.9 - height / 2, 0.9 - (len(lines) - 0.5) * height):
        ax.plot([0, 0.97], [y, y], color=INK, lw=1)
    ax.set(xlim=(0, 1), ylim=(0, 1))


def _formula(entry) -> str:
    """An entry in mathematical notation, or in plain text where matplotlib cannot set it."""
    text = f"${sympy.latex(sympy.sympify(entry))}$"
    try:
        MathTextParser("agg").parse(text)
    except ValueError:
        return str(entry)
    return text


@own_result
def show_dh_matrix(matrix, values: dict[str, float]):
    """The frame that a general DHm matrix gives, over the four parameters that it should follow.

    Parameters
    ----------
    matrix : 4x4 matrix, SymPy or numbers
    values : dict
        Numbers for a, d (metres), alpha, theta (radians).

    Returns
    -------
    matplotlib Axes (3D)
        X_i belongs on the arrow of theta_i, Z_i on the axis of joint i.
    """
    frame = numbers(matrix, "matrix", (4, 4), values)
    ax = drawing.draw_dh_parameters(*(values[name] for name in ("a", "alpha", "d", "theta")), frame=False)
    drawing.mark_frame(ax, frame, "i", 0.55)
    say_if_not_rigid(ax, frame)
    return ax


def say_if_not_rigid(ax, frame):
    rotation = frame[:3, :3]
    rigid = np.allclose(rotation.T @ rotation, np.eye(3), atol=1e-6) and np.allclose(frame[3], (0, 0, 0, 1), atol=1e-6)
    if not rigid:
        ax.figure.text(0.5, 0.01, "not a rigid displacement: the axes are not orthogonal unit vectors", ha="center")
