"""Any serial robot from its table of modified DH parameters, as a body in space with axes and frames."""

from __future__ import annotations

import numpy as np
import sympy

from ..geometry import chain_products, modified_dh
from .bodies import Bodies
from .frames import ask_for_frames, merge_axes
from .inputs import as_names, as_table, list_rows
from .labels import Labels
from .robot import Robot
from .strokes_3d import draw_arrow_3d
from .style import AXIS_COLOURS, AXIS_DASHES, CENTRE_LINE, INK, SOFT, styled
from .view import fill_panel, fit_3d, new_axes_3d, view_axes


def chain_frames(rows, values=None) -> np.ndarray:
    """Frames 0 to n of a robot seen from its base.

    Parameters
    ----------
    rows : list of n rows [sigma, a, alpha, d, theta], numbers or SymPy; metres and radians
    values : dict, optional
        Numbers for the symbols, by name.

    Returns
    -------
    ndarray, shape (n + 1, 4, 4)
    """
    return chain_products(modified_dh(*as_table(rows, values).T[1:]))


@styled
def draw_chain(rows, values=None, ax=None, *, tool=False, frames=None, axes=True, normals=False, names=None):
    """Draw a serial robot as a body: links as tubes, revolute joints as cylinders, prismatic joints as boxes.

    Parameters
    ----------
    rows : list of n rows [sigma, a, alpha, d, theta], numbers or SymPy; metres and radians
        Modified DH; symbols need a number in `values`.
    values : dict, optional
        Numbers for the symbols of the table, by name.
    tool : bool
        The last row is the constant displacement to the tool, not a joint.
    frames : sequence of indices, optional
        Frames to draw, by default all; () draws none.
    axes : bool
        Draw the joint axes as centre lines.
    normals : bool
        Draw the common normals and write a and d beside what they measure.
    names : sequence of n + 1 texts, optional
        Names of the frames, by default 0, 1, ..., and E for a tool.

    Returns
    -------
    matplotlib Axes (3D)
    """
    table = as_table(rows, values)
    count = len(table)
    if count == 0 or (tool and count == 1):
        raise ValueError("table: expected at least one joint, found none")
    names = as_names(names, count + 1, [*range(count), "E" if tool else count])
    shown = range(count + 1) if frames is None else _indices(frames, count)
    robot = Robot(table, tool)
    size = robot.unit * 0.15
    own, ax = ax is None, ax or new_axes_3d()
    bodies = Bodies(ax, robot.unit)
    robot.build(bodies)
    bodies.draw(ax)
    labels = Labels()
    extent = [bodies.points()]
    if axes:
        extent += _draw_axes(ax, robot, labels, names, shown, size)
    if shown:
        extent += _draw_frames(ax, robot.frames[list(shown)], [names[i] for i in shown], size, labels)
    if normals:
        _draw_normals(ax, robot, list_rows(rows), labels, names)
    if own:
        fit_3d(ax, np.vstack(extent), own, pad=0.42)
    else:
        fill_panel(ax, np.vstack(extent))
    labels.place(ax)
    return ax


def _indices(frames, count) -> list[int]:
    frames = [int(i) for i in frames]
    if wrong := [i for i in frames if not 0 <= i <= count]:
        raise ValueError(f"frames: expected indices from 0 to {count}, found {wrong[0]}")
    return frames


def _draw_axes(ax, robot, labels, names, shown, size):
    """The joint axes as centre lines, with an arrow at the end for the joints whose frame is not shown."""
    ends = []
    for members, foot, along in _joint_lines(robot):
        stops = (
            [robot.origins[i] for i in members]
            + [robot.centres[i] for i in members]
            + [robot.feet[i - 1] for i in members]
        )
        places = np.array([(stop - foot) @ along for stop in stops])
        low, high = foot + (places.min() - 1.05 * size) * along, foot + (places.max() + 1.5 * size) * along
        ax.plot(*zip(low, high), color=SOFT, lw=1, ls=CENTRE_LINE, zorder=2)
        ends.append(np.array([low, high]))
        hidden = [i for i in members if i not in shown]
        if hidden:
            draw_arrow_3d(ax, high - 0.6 * size * along, high, AXIS_COLOURS["z"], AXIS_DASHES["z"], width=1.4)
            text = ", ".join(f"Z_{{{names[i]}}}" for i in hidden)
            labels.ask(high, f"${text}$", along, AXIS_COLOURS["z"])
    return ends


def _joint_lines(robot) -> list[tuple[list[int], np.ndarray, np.ndarray]]:
    """The joint axes as lines: joints that share one, a point and a direction."""
    lines = []
    for i in robot.joints:
        point, along = robot.origins[i], robot.z[i]
        for members, foot, other in lines:
            parallel = np.linalg.norm(np.cross(other, along)) < 1e-6
            if parallel and np.linalg.norm(np.cross(point - foot, other)) < 1e-6 * robot.unit:
                members.append(i)
                break
        else:
            lines.append(([i], point, along))
    return lines


def _draw_frames(ax, frames, names, size, labels):
    origins = frames[:, :3, 3]
    ax.plot(*origins.T, "o", ms=4, color=INK, ls="none", zorder=7)
    return [origins, *ask_for_frames(ax, labels, merge_axes(frames, names, "xyz"), size, width=1.8)]


def _draw_normals(ax, robot, rows, labels, names):
    """The common normals as ink lines; a and d written beside the walks they measure."""
    for i, row in enumerate(rows):
        _draw_measure(ax, robot, labels, "a", row[1], names[i], robot.origins[i], robot.feet[i], 2.4)
        _draw_measure(ax, robot, labels, "d", row[3], names[i + 1], robot.feet[i], robot.origins[i + 1], 1.2)


def _draw_measure(ax, robot, labels, what, entry, index, start, end, width):
    """One length of the table as a line between two dots, with its letter or its value."""
    if np.linalg.norm(end - start) < 1e-6 * robot.unit:
        return
    ax.plot(*zip(start, end), color=INK, lw=width, zorder=3)
    if getattr(entry, "free_symbols", None):
        text = sympy.latex(entry)
    else:
        text = f"{what}_{{{index}}} = {float(entry):.3g}".replace("-", "\N{MINUS SIGN}")
    for way in (start, end):
        ax.plot(*way[:, None], marker=".", ms=4, color=INK, zorder=3)
    side = np.cross(end - start, view_axes(ax)[2])
    labels.ask((start + end) / 2, f"${text}$", side if np.linalg.norm(side) > 1e-9 else None, gap=10)
    labels.avoid(start + np.outer(np.linspace(0, 1, 9), end - start))
