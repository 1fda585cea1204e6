"""A student's rotations and angles, on the rings of a gimbal."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..attitudes import Camera, Display, hinges
from ..drawing.gimbal import draw_gimbal
from ..drawing.orientation import draw_bricks, turn_in_steps
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
def show_drone(answer, camera: Camera):
    """Show a drone that flies with some triples of roll, pitch and yaw, beside the axes of its camera.

    Parameters
    ----------
    answer : a row of roll, pitch and yaw, or several, in radians; a row may be a dictionary
    camera : Camera

    Returns
    -------
    matplotlib Axes (3D)
        The grey axes should hang on every brick as the camera hangs on the drone.
    """
    rows = numbers_in_rows(answer, "triples", 3)[:4]
    drones = [turn_in_steps(row, "xyz", "fixed")[-1] for row in rows]
    captions = [f"triple {k}" for k in range(1, len(rows) + 1)]
    ax = draw_bricks(drones, [camera.rotation] * len(rows), captions)
    _say(ax, COMPARED % ("the camera", "your drone"))
    return ax


@own_result
def show_wrist_formulas(answer, wrist: str, angles=(0.6, 0.5, 0.4)):
    """Show formulas for the three angles of a wrist, tried on one orientation with both signs e.

    Parameters
    ----------
    answer : three expressions in r11 ... r33 and e
    wrist : str
        The axes of its hinges, such as ``"z, -x, y"``.
    angles : array-like, shape (3,), in radians
        Angles of the orientation that is tried.

    Returns
    -------
    matplotlib Axes (3D)
        Both bricks belong on the grey axes.
    """
    axes, senses = hinges(wrist)
    rotation = turn_in_steps(np.multiply(senses, angles), axes)[-1]
    values = {f"r{i + 1}{j + 1}": rotation[i, j] for i in range(3) for j in range(3)}
    rows = [numbers(answer, "angles", (3,), values | {"e": sign}) for sign in (1.0, -1.0)]
    captions = ("e = 1", "e = \N{MINUS SIGN}1")
    ax = draw_gimbal(senses * np.array(rows), axes, names=_signed(senses), captions=captions, wanted=rotation)
    _say(ax, COMPARED % ("the wanted orientation", "your angles"))
    return ax


def _signed(senses) -> tuple[str, ...]:
    """Names of the joints, with a minus where the joint turns about the opposite of the axis that is drawn."""
    return tuple(name if sense > 0 else f"-{name}" for sense, name in zip(senses, JOINT_NAMES))


@own_result
def show_locked(locked, wrist: str, angles=(0.9, 0.5)):
    """Show two triples of a locked wrist that have the sum, or difference, of outer angles which a function returns.

    Parameters
    ----------
    locked : function (R: 3x3 nested list) -> [k, angle], in radians
    wrist : str
        The axes of its hinges, such as ``"z, -x, y"``.
    angles : array-like, shape (2,), in radians
        First and third angle of the orientation that is tried.

    Returns
    -------
    matplotlib Axes (3D)
        Both bricks belong on the grey axes.
    """
    axes, senses = hinges(wrist)
    middle = 0.0 if axes[0] == axes[2] else np.pi / 2
    rotation = np.round(turn_in_steps(np.multiply(senses, [angles[0], middle, angles[1]]), axes)[-1], 12) + 0.0
    k, combined = numbers(called(locked, rotation.tolist()), "[k, angle]", (2,), {})
    rows = np.array([(combined - k * third, middle, third) for third in (0.0, 1.2)])
    captions = (r"third angle $0\degree$", r"third angle $69\degree$")
    ax = draw_gimbal(senses * rows, axes, names=_signed(senses), captions=captions, wanted=rotation)
    _say(ax, COMPARED % ("the locked wrist", "two triples with your k and your angle"))
    return ax


@own_result
def show_display(reading, display: Display):
    """Show a reading of a controller's numbers on the poses of its log.

    Parameters
    ----------
    reading : function (A, B, C: numbers in degrees) -> 3x3 matrix
    display : Display

    Returns
    -------
    matplotlib Axes (3D)
        Both bricks belong on the grey axes.
    """
    found = [numbers(called(reading, *shown), "matrix", (3, 3), {}) for shown in display.shown]
    captions = [f"A, B, C = {', '.join(map(str, shown))}".replace("-", "\N{MINUS SIGN}") for shown in display.shown]
    ax = draw_bricks(found, display.measured, captions)
    _say(ax, COMPARED % ("as measured", "as you read the numbers"))
    return ax


@own_result
def show_misses(answer, found, wanted):
    """Show by how much a function misses orientations: a brick as it says, and below it the angle.

    Parameters
    ----------
    answer : k angles in radians
    found, wanted : (k, 3, 3)
        Orientations that belong to the angles which the function returns, and those that it was given.

    Returns
    -------
    matplotlib Axes (3D)
        A brick that lies on the grey axes has the angle zero.
    """
    angles = numbers(answer, "angles", (len(wanted),), {})
    ax = draw_bricks(
        found, wanted, [f"pose {k}: {np.degrees(angle):.1f}\N{DEGREE SIGN}" for k, angle in enumerate(angles, 1)]
    )
    _say(ax, COMPARED % ("the pose", "what the function makes of it"))
    return ax


@own_result
def show_extraction(extract, axes: str, tried: dict[str, Sequence[float]]):
    """Show the triples that a function takes out of some orientations.

    Parameters
    ----------
    extract : function (R: 3x3 nested list) -> three angles, in radians
    axes : str
        The set of moving axes.
    tried : dict
        Three angles in degrees by a caption.

    Returns
    -------
    matplotlib Axes (3D)
        Every brick belongs on the grey axes.
    """
    wanted = [np.round(turn_in_steps(np.radians(angles), axes)[-1], 12) + 0.0 for angles in tried.values()]
    rows = [numbers(called(extract, matrix.tolist()), "angles", (3,), {}) for matrix in wanted]
    ax = draw_bricks([turn_in_steps(row, axes)[-1] for row in rows], wanted, list(tried))
    _say(ax, COMPARED % ("the orientation", "your angles"))
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
