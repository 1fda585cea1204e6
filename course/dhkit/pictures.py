"""Pictures of a student's own result, to be looked at before it is handed in.

Every ``show_*`` function takes the answer first. It never raises on an answer: an untouched one (``...``, ``None``, a
function that returns nothing) shows "not attempted yet", and one that cannot be drawn shows why. The pictures
compare an answer with the robot, they do not judge it.
"""

from __future__ import annotations

from functools import wraps

import matplotlib.pyplot as plt
import numpy as np
import sympy
from matplotlib.mathtext import MathTextParser
from matplotlib.patches import Circle, Rectangle

from . import drawing
from .drawing import planar_points
from .strokes import AXIS_COLOURS, INK, SOFT, as_numbers, in_degrees, styled

COLUMNS = ("i", r"\sigma_i", r"a_{i-1}", r"\alpha_{i-1}", "d_i", r"\theta_i")


class NotAttempted(Exception):
    """The answer, or a part of it, is still ``...`` or ``None``."""


def _own_result(show):
    """Turn everything that can go wrong with an answer into a card with one sentence."""

    @wraps(show)
    @styled
    def picture(answer, *args, **kwargs):
        before = set(plt.get_fignums())
        try:
            return show(_attempted(answer), *args, **kwargs)
        except NotAttempted as blank:
            message = str(blank)
        except Exception as error:
            message = f"cannot be drawn\n{error or type(error).__name__}"
        for number in set(plt.get_fignums()) - before:
            plt.close(number)
        return _card(message)

    return picture


def _card(message: str):
    """An empty frame with a message, in place of a picture."""
    ax = plt.subplots(figsize=(5.2, 1.5))[1]
    ax.axis("off")
    ax.add_patch(
        Rectangle((0, 0), 1, 1, transform=ax.transAxes, fill=False, clip_on=False, edgecolor=SOFT, ls=(0, (4, 3)))
    )
    ax.text(0.5, 0.5, message[:300], transform=ax.transAxes, ha="center", va="center", wrap=True, parse_math=False)
    return ax


def _attempted(answer):
    """`answer` as it is, unless nothing, or only a part, has been filled in."""
    blanks = [entry is None or entry is Ellipsis for entry in _entries(answer)]
    if blanks and all(blanks):
        raise NotAttempted("not attempted yet")
    if any(blanks):
        raise NotAttempted("not complete: some entries are still ...")
    return answer


def _entries(answer) -> list:
    if isinstance(answer, (sympy.MatrixBase, np.ndarray)):
        return _entries(answer.tolist())
    if isinstance(answer, (list, tuple)):
        return [entry for item in answer for entry in _entries(item)]
    return [answer]


def _numbers(answer, what: str, shape: tuple, values: dict[str, float]) -> np.ndarray:
    """The answer as floats, with `values` put in for its symbols by name."""

    def number(entry):
        if isinstance(entry, (list, tuple)):
            return [number(item) for item in entry]
        entry = sympy.sympify(entry)
        foreign = sorted(symbol.name for symbol in entry.free_symbols if symbol.name not in values)
        if foreign:
            raise ValueError(
                f"{what}: the symbol {foreign[0]} is not one of {', '.join(values) or 'the given numbers'}"
            )
        return float(entry.subs({symbol: values[symbol.name] for symbol in entry.free_symbols}))

    nested = answer.tolist() if isinstance(answer, (sympy.MatrixBase, np.ndarray)) else answer
    array = np.array(number(nested))
    if len(shape) == 1 and array.ndim == 2 and 1 in array.shape:
        array = array.reshape(-1)
    return as_numbers(array, what, shape)


def _called(function, *arguments):
    """What a student's function returns; returning nothing counts as not attempted."""
    result = _function(function)(*arguments)
    return [] if isinstance(result, (list, tuple, np.ndarray)) and len(result) == 0 else _attempted(result)


def _function(answer):
    if not callable(answer):
        raise ValueError(f"expected a function, found {type(answer).__name__}")
    return answer


# ---------------------------------------------------------------- tables and frames


@_own_result
def show_table(table, values: dict[str, float], tool=False):
    """A DHm table, typeset, beside the chain of frames that it describes.

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
    rows = [list(row) for row in (table.tolist() if hasattr(table, "tolist") else table)]
    numbers = _numbers(rows, "table", (None, 5), values)
    frames = [np.eye(4)]
    for _, a, alpha, d, theta in numbers:
        frames.append(frames[-1] @ _dhm(a, alpha, d, theta))
    figure = plt.figure(figsize=(8.4, 3.6))
    names = [*map(str, range(len(rows))), "E" if tool else str(len(rows))]
    _typeset(figure.add_axes((0, 0.05, 0.44, 0.9)), rows, [*names[1:-1], "tool"] if tool else names[1:])
    ax = figure.add_axes((0.42, -0.12, 0.6, 1.24), projection="3d", computed_zorder=False)
    ax.view_init(elev=24, azim=-66)
    ax.set_proj_type("ortho")
    ax.set_axis_off()
    drawing.draw_frames_3d(frames, names, ax=ax)
    ax.set_box_aspect(None, zoom=1.0)
    return ax


def _dhm(a, alpha, d, theta) -> np.ndarray:
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s, 0, a], [s * ca, c * ca, -sa, -d * sa], [s * sa, c * sa, ca, d * ca], [0, 0, 0, 1]])


def _typeset(ax, rows, names):
    """The table as on a slide: header between two rules, one line per row."""
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


@_own_result
def show_dh_matrix(matrix, values: dict[str, float]):
    """The frame that a general DHm matrix gives, over the four parameters that it should follow.

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
    frame = _numbers(matrix, "matrix", (4, 4), values)
    ax = drawing.draw_dh_parameters(*(values[name] for name in ("a", "alpha", "d", "theta")), frame=False)
    drawing.mark_frame(ax, frame, "i", 0.55)
    _say_if_not_rigid(ax, frame)
    return ax


def _say_if_not_rigid(ax, frame):
    rotation = frame[:3, :3]
    rigid = np.allclose(rotation.T @ rotation, np.eye(3), atol=1e-6) and np.allclose(frame[3], (0, 0, 0, 1), atol=1e-6)
    if not rigid:
        ax.figure.text(0.5, 0.01, "not a rigid displacement: the axes are not orthogonal unit vectors", ha="center")


# ---------------------------------------------------------------- results on the robot


@_own_result
def show_on_scara(answer, values: dict[str, float], base="0"):
    """A hand frame, or [x, y, z, theta], beside the SCARA in the posture given by `values`.

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
    if len(_entries(answer)) == 4:
        x, y, z, theta = _numbers(answer, "model", (4,), values)
        frame = _dhm(0, 0, 0, theta)
        frame[:3, 3] = x, y, z
    else:
        frame = _numbers(answer, "transform", (4, 4), values)
    q = [values["t1"] if base == "0" else 0.0, values["t2"], values["d2"], values["t4"]]
    ax = drawing.draw_scara_3d(q, values["a2"], values["a3"], frames=False, dimensions=False)
    drawing.mark_frame(ax, frame, "4", 0.28 * (values["a2"] + values["a3"]))
    _say_if_not_rigid(ax, frame)
    return ax


@_own_result
def show_scara_forward(forward, a2=0.4, a3=0.3):
    """The path of the hand that a direct model gives for a motion of all four joints, beside the SCARA at its end.

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
    frames = np.array([_numbers(_called(forward, *map(float, q), a2, a3), "forward", (4, 4), {}) for q in path])
    ax = drawing.draw_scara_3d(end, a2, a3, frames=False, dimensions=False)
    drawing.mark_path(ax, frames, 0.12 * (a2 + a3))
    _say_if_not_rigid(ax, frames[-1])
    return ax


@_own_result
def show_on_planar_arm(answer, values: dict[str, float]):
    """A point [x, y], or a hand frame, on the planar 2R arm in the posture given by `values`.

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
    if len(_entries(answer)) == 2:
        at, frame = _numbers(answer, "model", (2,), values), None
    else:
        frame = _numbers(answer, "transform", (4, 4), values)
        at = frame[:2, 3]
    ax = drawing.draw_planar_arm(lengths, q, hand="")
    drawing.mark_target(ax, at, "your result")
    if frame is not None:
        drawing.mark_frame_2d(ax, frame, "E", 0.24 * sum(lengths))
    return ax


# ---------------------------------------------------------------- inverse models


@_own_result
def show_postures(solutions, lengths, target, heading=None):
    """Joint solutions of a planar 2R arm, or of a SCARA seen from above, with the point that they should reach.

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
    width = 2 if heading is None else 4
    if len(_entries(solutions)) == width:
        solutions = [_entries(solutions)]
    rows = _numbers(solutions, "solutions", (None, width), {}) if _entries(solutions) else np.empty((0, width))
    ax = drawing.draw_postures(lengths, rows[:, :2], target)
    if heading is not None:
        notes = [f"$d_2$ = {row[2]:.3f} m,  $t_4$ = {in_degrees(row[3])}" for row in rows]
        hands = [row[0] + row[1] + row[3] for row in rows]
        drawing.mark_hands(ax, lengths, rows[:, :2], hands, target, heading, notes)
    if not len(rows):
        ax.set_title("no solution given")
    return ax


@_own_result
def show_cos_theta2(expression, lengths):
    """The cosine of the elbow angle against the distance of the target, with the range of a cosine.

    Parameters
    ----------
    expression : SymPy expression in x, y, L1, L2
    lengths : (float, float), in metres

    Returns
    -------
    matplotlib Axes
    """
    l1, l2 = lengths
    distance = np.linspace(0, 1.25 * (l1 + l2), 101)
    values = [
        _numbers(expression, "cos(t2)", (), {"x": r * np.cos(0.7), "y": r * np.sin(0.7), "L1": l1, "L2": l2})
        for r in distance
    ]
    ax = plt.subplots(figsize=(5.6, 3.4))[1]
    ax.axhspan(-1, 1, color="#eeeeee", zorder=0)
    ax.plot(distance, values, color=INK, lw=1.8)
    for r, name in ((abs(l1 - l2), "$|L_1 - L_2|$"), (l1 + l2, "$L_1 + L_2$")):
        ax.axvline(r, color=SOFT, lw=1, ls=(0, (5, 2)))
        ax.annotate(name, (r, -2.75), xytext=(4, 0), textcoords="offset points", va="center")
    ax.set(
        xlabel="distance from base to target (m)",
        ylabel=r"your $\cos\theta_2$",
        ylim=(-3.2, 3.2),
        xlim=(0, distance[-1]),
    )
    ax.annotate("a cosine lives here", (0, 0.6), xytext=(10, 0), textcoords="offset points", va="center")
    return ax


@_own_result
def show_theta1(expression, lengths, target):
    """Both arms that a formula for t1 gives for one target, t2 being right.

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
    elbow = np.arccos((x**2 + y**2 - l1**2 - l2**2) / (2 * l1 * l2))
    given = {"x": x, "y": y, "L1": l1, "L2": l2}
    rows = [(float(_numbers(expression, "t1", (), given | {"t2": t2})), t2) for t2 in (elbow, -elbow)]
    return drawing.draw_postures(lengths, rows, target)


@_own_result
def show_reach(limits, lengths):
    """The circles [r_min, r_max] of an answer over points that the arm really reaches.

    Parameters
    ----------
    limits : 2 entries in L1, L2
    lengths : (float, float), in metres

    Returns
    -------
    matplotlib Axes
    """
    inner, outer = _numbers(limits, "reach", (2,), {"L1": lengths[0], "L2": lengths[1]})
    random = np.random.default_rng(7)
    t1, t2 = random.uniform(-np.pi, np.pi, (2, 2500))
    x = lengths[0] * np.cos(t1) + lengths[1] * np.cos(t1 + t2)
    y = lengths[0] * np.sin(t1) + lengths[1] * np.sin(t1 + t2)
    ax = plt.subplots(figsize=(4.6, 4.6))[1]
    ax.set_aspect("equal")
    ax.plot(x, y, ".", ms=2.5, color=SOFT, label="random postures")
    turn = np.linspace(0, 2 * np.pi, 200)
    for radius, dashes, name in (
        (outer, "-", "your $r_\\mathrm{max}$"),
        (inner, (0, (5, 2)), "your $r_\\mathrm{min}$"),
    ):
        ax.plot(
            radius * np.cos(turn), radius * np.sin(turn), color=INK, lw=1.8, ls=dashes, label=f"{name} = {radius:.2f} m"
        )
    ax.margins(0.06)
    ax.set(xlabel="x (m)", ylabel="y (m)")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3, columnspacing=1.2, handlelength=1.6)
    return ax


@_own_result
def show_inverse(inverse, lengths):
    """How many postures an inverse model returns over the plane, and where one of them misses its target.

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
    turns = np.arange(12) * np.pi / 6 + 0.1
    circles = [(r * np.cos(t), r * np.sin(t)) for r in (l1 + l2, abs(l1 - l2)) if r > 1e-9 for t in turns]
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
    ax.set(xlabel="x (m)", ylabel="y (m)")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=4, columnspacing=1.2, handletextpad=0.3)
    return ax


def _posture_count(inverse, x, y, lengths) -> str:
    """ "0", "1", "2", "more", or "misses" if a returned posture does not reach (x, y)."""
    answer = _called(inverse, float(x), float(y), *lengths)
    rows = _numbers(answer, "inverse", (None, 2), {}) if len(answer) else []
    if any(np.hypot(*(planar_points(lengths, row)[2] - (x, y))) > 1e-6 for row in rows):
        return "misses"
    return str(len(rows)) if len(rows) <= 2 else "more"
