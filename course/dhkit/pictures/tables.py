"""A student's table or matrix, and the frames that it describes."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.mathtext import MathTextParser

from ..drawing.chains import chain_frames, draw_chain
from ..drawing.frames import draw_dh_parameters, draw_frames_3d, mark_frame
from ..drawing.inputs import list_rows
from ..drawing.strokes import draw_arm, draw_arrow, draw_target, keep_in_view, new_axes, show_plane
from ..drawing.style import INK, POSTURE_SHADES
from ..drawing.tables import draw_joint_origins
from ..drawing.view import add_axes_3d
from ..geometry import chain_products, classic_dh, modified_dh, planar_joints, unit_vector
from . import live
from .own_result import called, numbers, own_result, say_if_not_rigid

COLUMNS = ("i", r"\sigma_i", r"a_{i-1}", r"\alpha_{i-1}", "d_i", r"\theta_i")


@own_result
def show_table(table, values: dict[str, float], tool=False):
    """Show a DHm table, typeset, beside the chain of frames that it describes.

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
    rows = list_rows(table)
    cells = numbers(rows, "table", (None, 5), values)
    figure = plt.figure(figsize=(8.4, 3.6))
    names = [*map(str, range(len(rows))), "E" if tool else str(len(rows))]
    _typeset(figure.add_axes((0, 0.05, 0.44, 0.9)), rows, [*names[1:-1], "tool"] if tool else names[1:])
    ax = add_axes_3d(figure, (0.45, 0, 0.55, 1), elev=24, azim=-66)
    draw_frames_3d(chain_products(modified_dh(*cells.T[1:])), names, ax)
    live.beside(lambda: live.robot(rows, values))
    return ax


def _typeset(ax, rows, names):
    """The table as in a book: header between two rules, one line per row."""
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
    """Show the frame that a general DHm matrix gives, over the four parameters that it should follow.

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
    ax = draw_dh_parameters(*(values[name] for name in ("a", "alpha", "d", "theta")), frame=False)
    mark_frame(ax, frame, "i", 0.55)
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_chain(table, values: dict[str, float], names=None, frames=(), tool=False):
    """Show the robot that a DHm table describes, as a body with its joint axes.

    Parameters
    ----------
    table : rows [sigma, a, alpha, d, theta]
    values : dict
        Numbers for the symbols of the table, by name.
    names, frames, tool
        As for `dhkit.drawing.draw_chain`.

    Returns
    -------
    matplotlib Axes (3D)
    """
    ax = draw_chain(numbers(table, "table", (None, 5), values), names=names, frames=frames, tool=tool)
    live.beside(lambda: live.robot(list_rows(table), values, names=names))
    return ax


@own_result
def show_classic_rows(rows, table, values: dict[str, float]):
    """Show the last frame of a classic table beside the robot of a modified one.

    Parameters
    ----------
    rows : classic rows [a, alpha, d, theta]
    table : modified rows [sigma, a, alpha, d, theta]
        The robot as it is.
    values : dict
        Numbers for the symbols of both, by name.

    Returns
    -------
    matplotlib Axes (3D)
        The frame belongs where the robot's last frame is: Z along the hand.
    """
    cells = numbers(rows, "rows", (None, 4), values)
    frame = chain_products(classic_dh(*cells.T))[-1]
    robot = numbers(table, "table", (None, 5), values)
    ax = draw_chain(robot, frames=())
    size = 0.16 * np.abs(robot[:, [1, 3]]).sum()
    mark_frame(ax, frame, str(len(cells)), size)
    return ax


@own_result
def show_planar(planar, lengths, angles):
    """Show the tip and the heading that a direct model gives, beside the planar arm.

    Parameters
    ----------
    planar : function (lengths, angles) -> x, y, phi
    lengths : list of n numbers, in metres
    angles : list of n numbers, in radians

    Returns
    -------
    matplotlib Axes
        The cross belongs on the tip, the arrow along the last link.
    """
    x, y, phi = numbers(called(planar, list(lengths), list(angles)), "x, y, phi", (3,), {})
    ax = new_axes((5.6, 4.2))
    show_plane(ax)
    draw_arm(ax, planar_joints(lengths, angles), POSTURE_SHADES[0])
    reach = 0.3 * sum(lengths)
    draw_arrow(ax, (x, y), (x, y) + reach * unit_vector(phi), width=2, dashes=(0, (4, 2)))
    draw_target(ax, (x, y))
    ax.autoscale_view()
    for at in ((x, y), (x, y) + reach * unit_vector(phi)):
        keep_in_view(ax, at, 0.1 * sum(lengths))
    return ax


@own_result
def show_freedoms(freedoms, tables: dict[str, list]):
    """Show what a function counts for some robots, as a table.

    Parameters
    ----------
    freedoms : function (rows) -> number
    tables : dict
        Rows [sigma, a, alpha, d, theta] of numbers, by the name of the robot.

    Returns
    -------
    matplotlib Axes
    """
    counts = [numbers(called(freedoms, [list(row) for row in rows]), "freedoms", (), {}) for rows in tables.values()]
    ax = plt.subplots(figsize=(5.6, 0.32 * (len(tables) + 2)))[1]
    ax.axis("off")
    lines = [("robot", "joints", "your freedoms")]
    lines += [(name, str(len(rows)), f"{count:g}") for (name, rows), count in zip(tables.items(), counts)]
    for j, line in enumerate(lines):
        for x, text in zip((0.02, 0.66, 0.88), line):
            ax.text(x, -j, text, ha="left" if x < 0.1 else "center", va="center")
    for y in (0.5, -0.5, 0.5 - len(lines)):
        ax.plot([0, 1], [y, y], color=INK, lw=1)
    ax.set(xlim=(0, 1), ylim=(0.5 - len(lines), 0.5))
    return ax


@own_result
def show_on_origins(table, origins, axes, values: dict[str, float]):
    """Show the frames of a DHm table at zero, over the joint origins of a list, seen from the side (along y).

    Parameters
    ----------
    table : rows [sigma, a, alpha, d, theta]
    origins : array-like, shape (n, 3), in metres
    axes : sequence of n texts
        Direction of each joint axis, "x", "y" or "z"; "" where no joint is.
    values : dict
        Numbers for the symbols of the table, by name.

    Returns
    -------
    matplotlib Axes
    """
    rows = numbers(table, "table", (None, 5), values)
    return draw_joint_origins(origins, axes, names=[*range(1, len(axes)), "gripper"], frames=chain_frames(rows))


@own_result
def show_gripper_frame(transform, name: str):
    """Show the gripper frame beside the last frame of an arm.

    Parameters
    ----------
    transform : 4x4 matrix, lengths in metres
    name : str
        Index of the arm's frame.

    Returns
    -------
    matplotlib Axes (3D)
    """
    frame = numbers(transform, "transform", (4, 4), {})
    ax = draw_frames_3d([np.eye(4), frame], [name, "g"], size=0.12)
    say_if_not_rigid(ax, frame)
    return ax
