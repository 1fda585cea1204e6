"""A student's result on the SCARA."""

from __future__ import annotations

import numpy as np

from ..drawing.frames import mark_frame, mark_path
from ..drawing.scara import draw_scara_3d
from ..geometry import rigid_transform, rotation
from .own_result import called, entries, numbers, own_result, say_if_not_rigid


@own_result
def show_on_scara(answer, values: dict[str, float], base="0"):
    """Show a hand frame, or [x, y, z, theta], beside the SCARA in the posture given by `values`.

    The frame belongs on the tip of the quill.

    Parameters
    ----------
    answer : 4x4 matrix or 4 entries, SymPy or numbers
    values : dict
        Numbers for t1, t2, t4 (radians), a2, a3, d2 (metres).
    base : "0" or "1"
        Frame from which the answer is seen. For "1" the robot is drawn with t1 = 0, so that its base is frame 1.

    Returns
    -------
    matplotlib Axes (3D)
    """
    if len(entries(answer)) == 4:
        x, y, z, theta = numbers(answer, "model", (4,), values)
        frame = rigid_transform(rotation("z", theta), (x, y, z))
    else:
        frame = numbers(answer, "transform", (4, 4), values)
    q = [values["t1"] if base == "0" else 0.0, values["t2"], values["d2"], values["t4"]]
    ax = draw_scara_3d(q, values["a2"], values["a3"], frames=False, dimensions=False)
    mark_frame(ax, frame, "4", 0.28 * (values["a2"] + values["a3"]))
    say_if_not_rigid(ax, frame)
    return ax


@own_result
def show_scara_forward(forward, a2=0.4, a3=0.3):
    """Show the path of the hand that a direct model gives for a motion of all four joints, beside the SCARA at its end.

    Parameters
    ----------
    forward : function (t1, t2, d2, t4, a2, a3) -> 4x4 numbers
    a2, a3 : float, in metres

    Returns
    -------
    matplotlib Axes (3D)
        The path ends on the tip of the quill.
    """
    start, end = np.array([1.25, 0.3, 0.02, 1.0]), np.array([-0.45, 1.0, 0.25, -0.6])
    path = [start + s * (end - start) for s in np.linspace(0, 1, 41)]
    frames = np.array([numbers(called(forward, *map(float, q), a2, a3), "forward", (4, 4), {}) for q in path])
    ax = draw_scara_3d(end, a2, a3, frames=False, dimensions=False)
    mark_path(ax, frames, 0.12 * (a2 + a3))
    say_if_not_rigid(ax, frames[-1])
    return ax
