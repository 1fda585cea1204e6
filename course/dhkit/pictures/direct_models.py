"""A student's direct models: turns of the SCARA and of an arm of their own, marks on matrices, a robot with its tool."""

from __future__ import annotations

from math import radians

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.patches import Rectangle

from ..arms import Arm
from ..drawing.arms import draw_arm, end_frame
from ..drawing.frames import mark_frame, mark_path
from ..drawing.planar import draw_planar_arm, mark_target
from ..drawing.six_axes import draw_six_axes, six_axis_motions
from ..drawing.strokes import draw_arm as draw_links
from ..drawing.strokes import draw_link, draw_target, leave_room, new_axes, show_bare, show_plane, write
from ..drawing.strokes_3d import draw_target_3d
from ..drawing.style import AXIS_COLOURS, DASHED, INK, POSTURE_SHADES, SOFT
from ..drawing.view import fit_3d
from ..geometry import chain_products, classic_dh, modified_dh, planar_joints, rotation_2d, unit_vector
from ..sheets import READINGS, Sheet
from .own_result import attempted, called, entries, numbers, own_result, say_if_not_rigid

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
    draw_links(ax, points[:3], POSTURE_SHADES[0], width=10)
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
def show_pen_tip(answer, values: dict[str, float]):
    """Show the point [x, y, z] on the six-axis arm that holds a pen, joints 4 and 6 locked at zero.

    Parameters
    ----------
    answer : 3 entries, SymPy or numbers
    values : dict
        Numbers for t1, t2, t3, t5 (radians), D3, L2, D4, e, h (metres).

    Returns
    -------
    matplotlib Axes (3D)
        The cross belongs on the tip of the pen.
    """
    at = numbers(answer, "tip", (3,), values)
    q = [values.get(f"t{i}", 0.0) for i in range(1, 7)]
    D3, L2, D4, e, h = (values[name] for name in ("D3", "L2", "D4", "e", "h"))
    ax = draw_six_axes(q, D3, L2, D4, h)
    hand = six_axis_motions(q, D3, L2, D4)[-1]
    foot, tip = (hand @ [x, 0, L2 + D4 + h, 1] for x in (D3, D3 + e))
    ax.plot(*zip(foot[:3], tip[:3]), color=INK, lw=3, zorder=8)
    draw_target_3d(ax, at, YOURS, zorder=9, width=1.6)
    return ax


@own_result
def show_own_turns(K, arm: Arm, q):
    """Show the joints of an arm carried by the products of an answer's turns, over the arm itself.

    Parameters
    ----------
    K : list of n 4x4 matrices, SymPy or numbers
    arm : Arm
        Of n joints that turn.
    q : sequence of n angles, in radians

    Returns
    -------
    matplotlib Axes (3D)
        The dots lie on the joints, and the last one on the end effector, when all are right.
    """
    values = {**arm.lengths, **dict(zip((joint.name for joint in arm.joints), map(float, q), strict=True))}
    moved = chain_products(numbers(K, "K", (len(arm.joints), 4, 4), values))
    points = [*(arm.at(joint.point, {}) for joint in arm.joints), arm.at(arm.origin, {})]
    ax = draw_arm(arm, q, end_effector=False)
    path = np.array([(move @ [*point, 1])[:3] for move, point in zip(moved, points)])
    ax.plot(*path.T, color=YOURS, lw=1.4, ls=DASHED, marker="o", ms=5, zorder=8)
    return ax


@own_result
def show_end_effector(answer, arm: Arm, q):
    """Show a point, or a frame, on an arm: it belongs on the end effector.

    Parameters
    ----------
    answer : [x, y, z] or 4x4 matrix, SymPy or numbers
        In the letters of the arm, lengths in metres.
    arm : Arm
    q : sequence of float
        Joint values, in radians and metres.

    Returns
    -------
    matplotlib Axes (3D)
    """
    values = {**arm.lengths, **dict(zip((joint.name for joint in arm.joints), map(float, q), strict=True))}
    ax = draw_arm(arm, q, end_effector=False)
    if len(entries(answer)) == 3:
        draw_target_3d(ax, numbers(answer, "point", (3,), values), YOURS, zorder=9, width=1.6)
        return ax
    _mark_frames(ax, {arm.frame: numbers(answer, "transform", (4, 4), values)}, 0.12 * sum(arm.lengths.values()))
    return ax


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
def show_from_frame_2(answer, reading: str, sheet: Sheet, arm: Arm, q):
    """Show frame 6 on the robot: where frame 2 is by the student's reading of the sheet, and frame 6 seen from there.

    Parameters
    ----------
    answer : 4x4 matrix, SymPy or numbers
        Frame 6 seen from frame 2.
    reading : str
        How the sheet is read, one of `dhkit.sheets.READINGS`.
    sheet : Sheet
    arm : Arm
        The robot of the sheet.
    q : sequence of float
        Joint values, in radians and metres.

    Returns
    -------
    matplotlib Axes (3D)
        Frame 6 belongs on the end effector.
    """
    values = {**sheet.lengths, **dict(zip(sheet.joints, map(float, q), strict=True))}
    letter = str(attempted(reading)).strip().upper()
    if letter not in READINGS:
        raise ValueError(f"the reading of the sheet is one of {', '.join(READINGS)}; found {reading!r}")
    first, second, alpha, theta = np.array([[float(cell.subs(values)) for cell in row] for row in sheet.rows[:2]]).T
    a, d = (first, second) if letter in "AC" else (second, first)
    frame_2 = chain_products((modified_dh if letter in "AB" else classic_dh)(a, alpha, d, theta))[-1]
    frame = frame_2 @ numbers(answer, "transform", (4, 4), values)
    ax = draw_arm(arm, q, end_effector=False)
    _mark_frames(ax, {"2": frame_2, arm.frame: frame}, 0.12 * sum(arm.lengths.values()))
    return ax


@own_result
def show_own_forward(forward, arm: Arm, mine):
    """Show the path that a direct model gives for the tool in a motion of all joints, with the robot at its end.

    Parameters
    ----------
    forward : function (q1, ..., q6) -> 4x4 numbers
    arm : Arm
        The robot that holds the tool.
    mine : dict
        Numbers reach, length (metres) and bend (degrees) of the tool.

    Returns
    -------
    matplotlib Axes (3D)
        The path ends on the tip of the tool, its frames stand as the tool does.
    """
    slides = np.array([joint.slides for joint in arm.joints])
    start = np.where(slides, 0.1, np.radians([60, 25, -75, 0, 40, 0]))
    end = np.where(slides, 0.35, np.radians([-30, 65, -40, 25, -50, 40]))
    path = [start + s * (end - start) for s in np.linspace(0, 1, 31)]
    frames = np.array([numbers(called(forward, *map(float, q)), "forward", (4, 4), {}) for q in path])
    ax = draw_arm(arm, end, end_effector=False)
    hand = end_frame(arm, end)
    elbow = hand @ [mine["reach"], 0, 0, 1]
    tip = hand @ modified_dh(mine["reach"], radians(mine["bend"]), mine["length"], 0.0)
    ax.plot(*np.array([hand[:3, 3], elbow[:3], tip[:3, 3]]).T, color=INK, lw=3, zorder=6)
    size = 0.08 * sum(arm.lengths.values())
    mark_path(ax, frames, size, stations=4)
    _hold(ax, [*frames[:, :3, 3], tip[:3, 3]])
    say_if_not_rigid(ax, frames[-1])
    return ax


def _mark_frames(ax, frames, size):
    """Mark frames by name; the last one is an answer, which may be no frame."""
    for name, frame in frames.items():
        mark_frame(ax, frame, name, size)
    _hold(ax, [frame[:3, 3] + size * axis for frame in frames.values() for axis in frame[:3, :3].T])
    say_if_not_rigid(ax, frame)


def _hold(ax, points):
    """Widen the view until it holds these points, too."""
    corners = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()]).T
    fit_3d(ax, np.vstack([*points, *corners]), own=True, pad=0.6)
