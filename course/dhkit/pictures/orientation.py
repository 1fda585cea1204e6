"""A student's rotations and angles, on the rings of a gimbal."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..drawing.gimbal import draw_gimbal
from ..drawing.orientation import turn_in_steps
from .own_result import called, numbers, numbers_in_rows, own_result

JOINT_NAMES = (r"\theta_4", r"\theta_5", r"\theta_6")
COMPARED = "grey: %s; the brick and its coloured axes: %s"


@own_result
def show_rotation(answer, axes: str, values: dict[str, float], order: Sequence[str]):
    """Show the axes of a rotation matrix, in grey, over the rings at the same angles.

    Parameters
    ----------
    answer : 3x3 matrix, SymPy or numbers
    axes : str
        The set of moving axes that the rings stand for.
    values : dict
        Numbers for the symbols of the matrix, in radians.
    order : three texts
        Names of the angles in `values`, outer ring first.

    Returns
    -------
    matplotlib Axes (3D)
        The grey axes belong on those of the brick.
    """
    matrix = numbers(answer, "matrix", (3, 3), values)
    ax = draw_gimbal([values[name] for name in order], axes, wanted=matrix)
    rigid = np.allclose(matrix.T @ matrix, np.eye(3), atol=1e-6) and np.linalg.det(matrix) > 0
    _say(
        ax,
        COMPARED % ("your matrix", "the rings")
        if rigid
        else "your matrix is no rotation: columns of length 1, orthogonal",
    )
    return ax


@own_result
def show_rpy_entries(answer, values: dict[str, float]):
    """Show the matrix of roll, pitch and yaw with two entries [r22, r23] filled in, in grey, over the rings.

    Parameters
    ----------
    answer : 2 entries in phi, theta, psi
    values : dict
        Numbers for phi, theta, psi, in radians.

    Returns
    -------
    matplotlib Axes (3D)
        The grey axes belong on those of the brick.
    """
    r22, r23 = numbers(answer, "r22, r23", (2,), values)
    order = ("psi", "theta", "phi")
    matrix = turn_in_steps([values[name] for name in order], "zyx")[-1]
    matrix[1, 1:] = r22, r23
    return show_rotation(matrix, "zyx", values, order)


@own_result
def show_triples(
    answer, axes: str, rotation, order: Sequence[int] = (0, 1, 2), names=None, grey="the wanted orientation"
):
    """Show triples of angles on the rings, one drawing each, with the axes of another orientation in grey.

    Parameters
    ----------
    answer : a row of three angles, or several, in radians; a row may be a dictionary of roll, pitch and yaw
    axes : str
        The set of moving axes that the rings stand for.
    rotation : (3, 3), the orientation to compare with, as a rule the wanted one
    order : three indices
        Places of the angles in a row, outer ring first.
    names : three texts, optional
        Names of the angles in mathematical notation, outer ring first.
    grey : str
        What `rotation` is, in words.

    Returns
    -------
    matplotlib Axes (3D)
        Every brick belongs on the axes of the wanted orientation.
    """
    rows = numbers_in_rows(answer, "triples", 3)[:4, list(order)]
    named = {} if names is None else {"names": names}
    ax = draw_gimbal(rows, axes, wanted=np.asarray(rotation, float), **named)
    _say(ax, COMPARED % (grey, "your angles"))
    return ax


@own_result
def show_wrist_formulas(answer, axes: str, angles=(0.6, 0.5, 0.4)):
    """Show formulas for the three angles of a wrist, tried on one orientation with both signs e.

    Parameters
    ----------
    answer : three expressions in r11 ... r33 and e
    axes : str
        The set of moving axes.
    angles : array-like, shape (3,), in radians
        Angles of the orientation that is tried.

    Returns
    -------
    matplotlib Axes (3D)
        Both bricks belong on the grey axes.
    """
    rotation = turn_in_steps(angles, axes)[-1]
    values = {f"r{i + 1}{j + 1}": rotation[i, j] for i in range(3) for j in range(3)}
    rows = [numbers(answer, "angles", (3,), values | {"e": sign}) for sign in (1.0, -1.0)]
    ax = draw_gimbal(rows, axes, names=JOINT_NAMES, captions=("e = 1", "e = \N{MINUS SIGN}1"), wanted=rotation)
    _say(ax, COMPARED % ("the wanted orientation", "your angles"))
    return ax


@own_result
def show_wrist(inverse, axes: str = "zyz"):
    """Show what an inverse model of a wrist returns for a bent and for a stretched wrist: the first triple of each.

    Parameters
    ----------
    inverse : function (R: 3x3 nested list) -> list of three angles, in radians
    axes : str
        The set of moving axes.

    Returns
    -------
    matplotlib Axes (3D)
        Every brick belongs on the grey axes.
    """
    tried = {"bent": (1.2, 1.1, 0.4), "stretched": (0.9, 0.0, 0.6), "folded back": (0.9, np.pi, 0.3)}
    wanted = [np.round(turn_in_steps(angles, axes)[-1], 12) + 0.0 for angles in tried.values()]
    found = [called(inverse, matrix.tolist()) for matrix in wanted]
    rows = [numbers([list(row) for row in triples], "triples", (None, 3), {}) for triples in found]
    if not all(len(each) for each in rows):
        raise ValueError("for one of three orientations your function returns no triple")
    captions = [f"{name}: {len(each)} triple{'s' * (len(each) != 1)}" for name, each in zip(tried, rows)]
    ax = draw_gimbal([each[0] for each in rows], axes, names=JOINT_NAMES, captions=captions, wanted=wanted)
    _say(ax, COMPARED % ("the wanted orientation", "your first triple"))
    return ax


def _say(ax, text):
    ax.figure.text(0.5, 0.01, text, ha="center", fontsize=9)
