"""A student's result on the planar arm."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle

from ..drawing.planar import draw_planar_arm, draw_postures, mark_frame_2d, mark_hands, mark_target
from ..drawing.style import AXIS_COLOURS, INK, SOFT, in_degrees
from ..geometry import planar_joints, two_link, unit_vector
from . import live
from .own_result import called, entries, numbers, numbers_in_rows, own_result


@own_result
def show_on_planar_arm(answer, values: dict[str, float]):
    """Show a point [x, y], or a hand frame, on the planar 2R arm in the posture given by `values`.

    The cross belongs on the end of the arm.

    Parameters
    ----------
    answer : 2 entries or a 4x4 matrix, SymPy or numbers
    values : dict
        Numbers for t1, t2 (radians), L1, L2 (metres).

    Returns
    -------
    matplotlib Axes
    """
    lengths, q = (values["L1"], values["L2"]), (values["t1"], values["t2"])
    if len(entries(answer)) == 2:
        at, frame = numbers(answer, "model", (2,), values), None
    else:
        frame = numbers(answer, "transform", (4, 4), values)
        at = frame[:2, 3]
    ax = draw_planar_arm(lengths, q, hand="")
    mark_target(ax, at, "your result")
    if frame is not None:
        mark_frame_2d(ax, frame, "E", 0.24 * sum(lengths))
    return ax


@own_result
def show_postures(solutions, lengths, target, heading=None):
    """Show joint solutions of a planar 2R arm, or of a SCARA seen from above, with the point that they should reach.

    Parameters
    ----------
    solutions : rows (t1, t2) or (t1, t2, d2, t4), in radians and metres
    lengths : (float, float), in metres
    target : (float, float), in metres
    heading : float, in radians, optional
        Wanted direction of the hand, for rows of four.

    Returns
    -------
    matplotlib Axes
    """
    rows = numbers_in_rows(solutions, "solutions", 2 if heading is None else 4)
    ax = draw_postures(lengths, rows[:, :2], target)
    if heading is not None:
        notes = [f"$d_2$ = {row[2]:.3f} m,  $t_4$ = {in_degrees(row[3])}" for row in rows]
        hands = [row[0] + row[1] + row[3] for row in rows]
        mark_hands(ax, lengths, rows[:, :2], hands, target, heading, notes)
    if not len(rows):
        ax.set_title("no solution given")
    elif heading is None:
        live.beside(lambda: live.planar_arm(lengths, rows))
    return ax


@own_result
def show_theta1(expression, lengths, target):
    """Show both arms that a formula for t1 gives for one target, t2 being right.

    Parameters
    ----------
    expression : SymPy expression in x, y, L1, L2, t2
    lengths, target : (float, float), in metres
        The target lies between the limits of reach.

    Returns
    -------
    matplotlib Axes
        Both arms end on the target when the formula is right.
    """
    (l1, l2), (x, y) = lengths, target
    given = {"x": x, "y": y, "L1": l1, "L2": l2}
    bends = two_link(x + 1j * y, l1, l2).bend
    rows = [(float(numbers(expression, "t1", (), given | {"t2": t2})), t2) for t2 in bends]
    return draw_postures(lengths, rows, target)


@own_result
def show_inverse(inverse, lengths):
    """Show how many postures an inverse model returns over the plane, and where one of them misses its target.

    Parameters
    ----------
    inverse : function (x, y, L1, L2) -> list of (t1, t2)
    lengths : (float, float), in metres

    Returns
    -------
    matplotlib Axes
    """
    l1, l2 = lengths
    side = np.linspace(-1.15, 1.15, 21) * (l1 + l2)
    grid = [(x, y) for x in side for y in side if np.hypot(x, y) > 1e-9]
    around = unit_vector(np.arange(12) * np.pi / 6 + 0.1)
    circles = [point for r in (l1 + l2, abs(l1 - l2)) if r > 1e-9 for point in r * around]
    kinds = [_posture_count(inverse, x, y, lengths) for x, y in (*grid, *circles)]
    points = np.array([*grid, *circles])
    ax = plt.subplots(figsize=(5.0, 5.0))[1]
    ax.set_aspect("equal")
    marks = {
        "0": (".", 4, SOFT), "1": ("D", 6, "white"), "2": ("o", 6, "#a9a9a9"), "more": ("s", 7, "#a9a9a9"),
        "misses": ("x", 7, AXIS_COLOURS["x"]),
    }  # fmt: skip
    for kind, (marker, size, fill) in marks.items():
        chosen = points[[found == kind for found in kinds]]
        if len(chosen):
            edge = fill if kind in ("0", "misses") else INK
            name = "a solution misses" if kind == "misses" else f"{kind} posture{'s' * (kind != '1')}"
            ax.plot(*chosen.T, marker, ms=size, mfc=fill, mec=edge, ls="none", label=name)
    for radius, dashes in ((l1 + l2, "-"), (abs(l1 - l2), (0, (5, 2)))):
        ax.add_patch(Circle((0, 0), radius, fill=False, ec=INK, lw=0.9, ls=dashes, zorder=1))
    live.beside(lambda: live.planar_arm(lengths, inverse=lambda hand: inverse(*map(float, hand[:2, 3]), l1, l2)))
    ax.set(xlabel="x (m)", ylabel="y (m)")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=4, columnspacing=1.2, handletextpad=0.3)
    return ax


def _posture_count(inverse, x, y, lengths) -> str:
    """ "0", "1", "2", "more", or "misses" if a returned posture does not reach (x, y)."""
    answer = called(inverse, float(x), float(y), *lengths)
    rows = numbers(answer, "inverse", (None, 2), {}) if len(answer) else []
    if any(np.hypot(*(planar_joints(lengths, row)[2] - (x, y))) > 1e-6 for row in rows):
        return "misses"
    return str(len(rows)) if len(rows) <= 2 else "more"
