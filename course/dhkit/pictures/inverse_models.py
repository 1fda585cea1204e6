"""A student's inverse models: postures with their misses, the shoulder from above, singular and free directions."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import sympy

from ..arms import Arm
from ..drawing.arms import draw_arm, end_frame, joint_points
from ..drawing.chains import chain_frames, draw_chain
from ..drawing.frames import mark_frame
from ..drawing.postures import draw_posture_gallery, draw_shoulder_top
from ..drawing.strokes_3d import draw_target_3d
from ..drawing.style import DASHED, INK, SOFT
from ..drawing.view import fit_3d
from ..geometry import rotation_angle_between
from . import live
from .own_result import called, card, entries, numbers, numbers_in_rows, own_result

MOST = 16  # postures drawn
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7")


@own_result
def show_all_postures(solutions, table, target, inverse=None):
    """Show joint solutions of a robot side by side, each with the distance by which it misses the target.

    Parameters
    ----------
    solutions : rows of joint values, in radians
    table : function of the joint values, by their names -> rows [sigma, a, alpha, d, theta]
    target : array-like, shape (3,) or (4, 4)
        A point in metres, or a pose.
    inverse : function of a pose, shape (4, 4) -> rows of joint values, optional
        A live scene asks it for all postures of the hand.

    Returns
    -------
    matplotlib Axes (3D)
    """
    width = table.__code__.co_argcount - len(table.__defaults__ or ())
    rows = numbers_in_rows(solutions, "solutions", width)
    if not len(rows):
        return card("no solution given")
    target = np.array(target, dtype=float)
    tables = [table(*q) for q in rows[:MOST]]
    names = [f"{k}: {_miss(each, target)}" for k, each in enumerate(tables, 1)]
    live.beside(lambda: live.postures(table, rows[:MOST], width, inverse))
    return draw_posture_gallery(tables, names, target if target.shape == (3,) else None)


@own_result
def show_inverse_of_pose(inverse, table, pose, *lengths):
    """Show what a student's function ``inverse(pose, *lengths)`` returns, as `show_all_postures` does."""
    found = called(inverse, np.array(pose, dtype=float), *lengths)
    if not len(found):
        return card("no solution given")
    return show_all_postures(found, table, pose, inverse=lambda hand: inverse(hand, *lengths))


def _miss(table, target) -> str:
    """By how much the hand of a numeric table misses a point or a pose, in words."""
    hand = chain_frames(table)[-1]
    point = target if target.shape == (3,) else target[:3, 3]
    parts = []
    if (far := np.linalg.norm(hand[:3, 3] - point)) > 1e-4:
        parts.append(f"{far:.3f} m off")
    if target.shape == (4, 4):
        turn = np.degrees(rotation_angle_between(hand[:3, :3], target[:3, :3]))
        if turn > 0.05:
            parts.append(f"{turn:.1f}° off")
    return "\n".join(parts) or "on the target"


@own_result
def show_shoulder(expression, offset, target):
    """Show the shoulder of a PUMA-like arm from above, turned as a formula for t1 says, for both signs of A.

    Parameters
    ----------
    expression : SymPy expression in Wx, Wy, d2, A
    offset : float, in metres
    target : (float, float), in metres
        Outside the circle of radius `offset`.

    Returns
    -------
    matplotlib Axes
        Both arms end on the target when the formula is right.
    """
    length = np.sqrt(target[0] ** 2 + target[1] ** 2 - offset**2)
    given = {"Wx": target[0], "Wy": target[1], "d2": offset}
    turns = [(float(numbers(expression, "t1", (), given | {"A": a})), a) for a in (length, -length)]
    return draw_shoulder_top(offset, target, turns)


@own_result
def show_repaired_row(answer, rows, values):
    """Show the robot of a table in which one row is replaced by the answer, with its joint axes.

    Parameters
    ----------
    answer : six entries [row, sigma, a, alpha, d, theta], or a dictionary with these keys
    rows : list of rows [sigma, a, alpha, d, theta], as printed
    values : dict
        Numbers for the symbols.

    Returns
    -------
    matplotlib Axes (3D)
    """
    place, *row = numbers(entries(answer), "row", (6,), values)
    if place not in range(1, len(rows) + 1):
        raise ValueError(f"row: expected a number from 1 to {len(rows)}, found {place:g}")
    table = [numbers(each, "table", (5,), values) for each in rows]
    table[int(place) - 1] = row
    return draw_chain(table, frames=())


@own_result
def show_determinant(expression, lengths):
    """Show the determinant of an elbow arm over t2 and t3; the lines on which it vanishes are drawn in ink.

    Parameters
    ----------
    expression : SymPy expression in t1, t2, t3, L1, L2
    lengths : (float, float), in metres

    Returns
    -------
    matplotlib Axes
    """
    turn = np.linspace(-0.98, 0.98, 121) * np.pi
    given = {"t1": 0.4, "L1": lengths[0], "L2": lengths[1]}
    # Translated once: a substitution for each point of the grid would take a minute.
    expression = sympy.sympify(expression)
    foreign = sorted(symbol.name for symbol in expression.free_symbols if symbol.name not in {*given, "t2", "t3"})
    if foreign:
        raise ValueError(f"determinant: the symbol {foreign[0]} is not one of t1, t2, t3, L1, L2")
    by_name = {symbol.name: symbol for symbol in expression.free_symbols}
    expression = expression.subs({by_name[name]: value for name, value in given.items() if name in by_name})
    function = sympy.lambdify([by_name.get(name, sympy.Symbol(name)) for name in ("t2", "t3")], expression, "numpy")
    t2, t3 = np.meshgrid(turn, turn, indexing="ij")
    values = np.broadcast_to(np.asarray(function(t2, t3), dtype=float), t2.shape)
    ax = plt.subplots(figsize=(5.0, 4.2))[1]
    size = max(abs(values).max(), 1e-12)
    shade = ax.contourf(np.degrees(t2), np.degrees(t3), values, np.linspace(-size, size, 13), cmap="gray", alpha=0.55)
    ax.figure.colorbar(shade, ax=ax, label="your determinant (m³)")
    if values.min() < 0 < values.max():
        ax.contour(np.degrees(t2), np.degrees(t3), values, [0], colors=INK, linewidths=2)
    ax.axhline(0, color=SOFT, lw=0.8, ls=DASHED)
    ticks = (-180, -90, 0, 90, 180)
    ax.set(xlabel=r"$\theta_2$ (degrees)", ylabel=r"$\theta_3$ (degrees)", xticks=ticks, yticks=ticks)
    return ax


@own_result
def show_free_direction(direction, arm: Arm, q):
    """Show an arm moved to and fro along a direction of its joint space, and how far the end effector goes with it.

    Parameters
    ----------
    direction : as many entries as joints
    arm : Arm
    q : joint values to start from, in radians and metres

    Returns
    -------
    matplotlib Axes (3D)
    """
    step = numbers(direction, "direction", (len(q),), {})
    if not step.any():
        raise ValueError("direction: expected numbers that are not all zero")
    step = step / np.linalg.norm(step)
    slides = any(joint.slides for joint, part in zip(arm.joints, step) if part)
    moved = [np.array(q) + share * (0.15 if slides else 0.6) * step for share in (-1, -1 / 3, 1 / 3, 1)]
    hands = np.array([end_frame(arm, each) for each in moved])
    far = np.linalg.norm(hands[:, :3, 3] - hands[0, :3, 3], axis=1).max()
    turn = np.degrees(rotation_angle_between(hands[:, :3, :3], hands[0, :3, :3])).max()
    ax = draw_arm(arm, q, end_effector=False)
    lines = [joint_points(arm, each) for each in moved]
    for line, colour in zip(lines, _COLOURS):
        ax.plot(*line.T, color=colour, lw=2, zorder=8)
    for hand in hands:
        mark_frame(ax, hand, arm.frame, 0.12 * sum(arm.lengths.values()))
    _hold(ax, np.vstack(lines))
    rest = far < 1e-6 and turn < 1e-3
    said = "the end effector stays" if rest else f"the end effector moves: by {far:.3f} m and {turn:.0f}°"
    ax.figure.text(0.5, 0.01, said, ha="center")
    return ax


@own_result
def show_own_configurations(solutions, arm: Arm, target, placed=()):
    """Show joint solutions of an arm as lines from joint to joint, each with the distance by which it misses its target.

    Parameters
    ----------
    solutions : rows of joint values, in radians
        Of the first three joints for a point: lines then end in the wrist centre, where axes 4 and 5 meet. For a pose of
        all joints, or of those behind the `placed` ones.
    arm : Arm
        Of six joints that turn.
    target : array-like, shape (3,) or (4, 4)
        A point for the wrist centre in metres, or a pose of the end effector.
    placed : sequence of float
        Values of the first joints, where they are given.

    Returns
    -------
    matplotlib Axes (3D)
        Every line should end in the cross.
    """
    target = np.array(target, dtype=float)
    centre, count = target.shape == (3,), len(arm.joints)
    rows = numbers_in_rows(solutions, "solutions", 3 if centre else count - len(placed))
    if not len(rows):
        return card("no solution given")
    rows = [[*placed, *row, *[0.0] * (count - len(placed) - len(row))] for row in rows[:MOST]]
    ax = draw_arm(arm, rows[0], end_effector=False)
    goal, lines, misses = (target if centre else target[:3, 3]), [], []
    for k, q in enumerate(rows):
        colour, line = _COLOURS[k % len(_COLOURS)], joint_points(arm, q)[: 5 if centre else None]
        lines.append(line)
        ax.plot(*line.T, color=colour, lw=2, marker="o", ms=4, zorder=8 + k)
        miss = f"{k + 1}: {1000 * np.linalg.norm(line[-1] - goal):.0f} mm"
        if not centre:
            miss += f" and {np.degrees(rotation_angle_between(end_frame(arm, q)[:3, :3], target[:3, :3])):.1f}°"
        misses.append(miss)
    draw_target_3d(ax, goal, INK, zorder=30, width=1.6)
    _hold(ax, np.vstack(lines))
    ax.figure.text(0.5, 0.01, "off the target: " + ", ".join(misses), ha="center")
    return ax


def _hold(ax, points):
    """Widen the view until it holds these points, too."""
    corners = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()]).T
    fit_3d(ax, np.vstack([points, corners]), own=True, pad=0.5)
