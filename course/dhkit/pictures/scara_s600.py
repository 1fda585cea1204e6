"""A student's result on the Adept s600."""

from __future__ import annotations

from itertools import product

import numpy as np

from ..drawing.chains import draw_chain
from ..drawing.frames import mark_frame
from ..drawing.planar import draw_postures, mark_hands
from ..drawing.style import in_degrees
from ..drawing.view import fit_3d
from ..geometry import chain_products, classic_dh, two_link, wrap
from .own_result import called, numbers, numbers_in_rows, own_result, say_if_not_rigid
from .planar import show_inverse


def _table(values):
    return [
        [0, 0, 0, 0, values["t1"]],
        [0, values["d2"], 0, 0, values["t2"]],
        [1, values["d3"], 0, values["r3"] + values["r30"], 0],
        [0, 0, np.pi, 0, values["t4"]],
    ]


@own_result
def show_on_s600(answer, values: dict[str, float], base="0"):
    """Show a hand frame beside the s600 in the posture given by `values`: it belongs on the flange, with Z_4 down.

    Parameters
    ----------
    answer : 4x4 matrix, SymPy or numbers
    values : dict
        Numbers for t1, t2, t4 (radians), r3, d2, d3, r30 (metres).
    base : "0" or "1"
        Frame from which the answer is seen. For "1" the robot is drawn with t1 = 0, so that its base is frame 1.

    Returns
    -------
    matplotlib Axes (3D)
    """
    return _mark_hand(numbers(answer, "transform", (4, 4), values), values | ({"t1": 0.0} if base == "1" else {}))


@own_result
def show_classic(table, values: dict[str, float]):
    """Show the hand frame that a classic table [a, alpha, d, theta] leads to, beside the s600.

    Parameters
    ----------
    table : four rows of four entries, SymPy or numbers
    values : dict
        As for `show_on_s600`.

    Returns
    -------
    matplotlib Axes (3D)
    """
    rows = numbers(table, "table", (4, 4), values)
    return _mark_hand(chain_products(classic_dh(*rows.T))[-1], values)


def _mark_hand(frame, values):
    size = 0.28 * (values["d2"] + values["d3"])
    ax = draw_chain(_table(values), frames=(), axes=False)
    mark_frame(ax, frame, "4", size)
    robot = np.array(list(product(ax.get_xlim(), ax.get_ylim(), ax.get_zlim())))
    fit_3d(ax, np.vstack([robot, frame[:3, 3] + 1.35 * size * frame[:3, :3].T]), True)
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_linear(answer, lengths, target):
    """Show both arms that a formula for the cosine and the sine of t1 gives for one target, t2 being right.

    Parameters
    ----------
    answer : two expressions [cos_i, sin_i] in X, Y, Z1, Z2, tj
    lengths, target : (float, float), in metres
        The target lies between the limits of reach.

    Returns
    -------
    matplotlib Axes
        Both arms end on the target; the lengths of (cos, sin) stand in the title.
    """
    (l2, l3), (x, y) = lengths, target
    bends = two_link(x + 1j * y, l2, l3).bend
    given = {"X": l2, "Y": l3, "Z1": x, "Z2": y}
    pairs = [numbers(answer, "cos_i, sin_i", (2,), given | {"tj": bend}) for bend in bends]
    rows = [(np.arctan2(pair[1], pair[0]), bend) for pair, bend in zip(pairs, bends)]
    ax = draw_postures(lengths, rows, target)
    ax.set_title("cos² + sin² = " + " and ".join(f"{pair @ pair:.4g}" for pair in pairs))
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
