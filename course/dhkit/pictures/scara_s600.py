"""A student's result on the Adept s600."""

from __future__ import annotations

import numpy as np

from ..drawing.planar import draw_postures, mark_hands
from ..drawing.scara_tasks import draw_own_scara
from ..drawing.strokes import draw_axis_arrow, draw_target, leave_room, new_axes, show_plane
from ..drawing.style import INK, in_degrees
from ..geometry import chain_products, classic_dh, wrap
from ..scara_tasks import measured
from .own_result import called, numbers, numbers_in_rows, own_result, say_if_not_rigid
from .planar import show_inverse


@own_result
def show_on_own_scara(transform, arm, values):
    """Show frame 4 of a transform beside a SCARA with all turns 0, seen from the side.

    Parameters
    ----------
    transform : 4x4 matrix, SymPy or numbers
    arm : str
        A name of `dhkit.scara_tasks.SCARAS`.
    values : dict
        Numbers for q1 to q4, A, B, H; those of the joints that turn are 0.

    Returns
    -------
    matplotlib Axes
    """
    return _mark_frame_4(numbers(transform, "transform", (4, 4), values), arm, values)


@own_result
def show_classic(table, arm, values):
    """Show frame 4 at the end of a classic table [a, alpha, d, theta], as `show_on_own_scara` does.

    Parameters
    ----------
    table : four rows of four entries, SymPy or numbers
    arm, values : as for `show_on_own_scara`

    Returns
    -------
    matplotlib Axes
    """
    rows = numbers(table, "table", (4, 4), values)
    return _mark_frame_4(chain_products(classic_dh(*rows.T))[-1], arm, values)


def _mark_frame_4(frame, arm, values):
    ax = draw_own_scara(arm, values, words=False)
    place = frame[[0, 2], 3]
    draw_target(ax, place)
    for letter, column in (("x", 0), ("z", 2)):
        across, up = frame[[0, 2], column]
        if np.hypot(across, up) > 1e-9:
            draw_axis_arrow(ax, place, np.arctan2(up, across), 0.16 * np.hypot(across, up), letter, f"{letter}_4")
    leave_room(ax, 0.1)
    ax.set_title("your frame 4")
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_misfits(lengths, mine):
    """Show how far every measured point is from the model with the lengths of an answer.

    Parameters
    ----------
    lengths : 2 numbers [d2, d3], in metres
    mine : mapping
        The student's numbers.

    Returns
    -------
    matplotlib Axes
        The tracker's origin is placed as well as it can be for these lengths. What is left of a right answer is noise.
    """
    d2, d3 = numbers(lengths, "lengths", (2,), {})
    first, second, x, y = measured(mine).T
    gap = np.column_stack(
        [x - d2 * np.cos(first) - d3 * np.cos(first + second), y - d2 * np.sin(first) - d3 * np.sin(first + second)]
    )
    gap = 1000 * (gap - gap.mean(axis=0))
    ax = new_axes((4.6, 4.2))
    show_plane(ax, labels=("misfit in x (mm)", "misfit in y (mm)"))
    ax.plot(*gap.T, "o", color=INK, ms=4)
    ax.set_title(f"root mean square {np.sqrt((gap**2).sum(axis=1).mean()):.2f} mm")
    return ax


@own_result
def show_mgi(mgi, lengths, r30=-0.05):
    """Show how many arm postures an inverse model returns over the plane, and where one of them misses its target.

    Parameters
    ----------
    mgi : function (x, y, z, omega, d2, d3, r30) -> list of (t1, t2, r3, t4)
    lengths : (float, float), in metres
    r30 : float, in metres

    Returns
    -------
    matplotlib Axes
        The number of poses whose height or direction is missed stands in the title.
    """
    z, omega, missed = -0.12, 0.6, []

    def arm(x, y, l2, l3):
        rows = numbers_in_rows(called(mgi, x, y, z, omega, l2, l3, r30), "mgi", 4)
        turned = wrap(rows[:, 0] + rows[:, 1] - rows[:, 3] - omega)
        if (np.abs(turned) > 1e-6).any() or (np.abs(rows[:, 2] + r30 - z) > 1e-6).any():
            missed.append((x, y))
        return rows[:, :2].tolist()

    # Asked once here: an untouched function shows a card, and an exception its own words.
    arm(0.8 * sum(lengths), 0.1, *lengths)
    missed.clear()
    ax = show_inverse(arm, lengths)
    if missed:
        ax.set_title(f"height or direction missed at {len(missed)} poses")
    return ax


@own_result
def show_configurations(answer, lengths, target, omega):
    """Show configurations of the s600 from above, with the direction of x_4 and the wanted one.

    Parameters
    ----------
    answer : rows (t1, t2, r3, t4), in radians and metres
    lengths, target : (float, float), in metres
    omega : float, in radians
        Wanted direction of x_4.

    Returns
    -------
    matplotlib Axes
    """
    rows = numbers_in_rows(answer, "configurations", 4)
    ax = draw_postures(lengths, rows[:, :2], target)
    notes = [f"$r_3$ = ${row[2]:.3f}$ m,  $\\theta_4$ = {in_degrees(row[3])}" for row in rows]
    hands = [row[0] + row[1] - row[3] for row in rows]
    mark_hands(ax, lengths, rows[:, :2], hands, target, omega, notes, r"\omega")
    return ax
