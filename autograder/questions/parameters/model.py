"""Parameter rules: two frames to read, skew, parallel and meeting axes, a gripper, a table rewritten."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import mistake
from dhkit.geometry import common_normal, link_axis, rotation
from dhkit.own_arms import SIGNED_ARMS
from dhm.lines import link, link_frame


def tidy(values) -> np.ndarray:
    """Without rounding noise, and with exact zeros and ones."""
    return np.vectorize(
        lambda value: round(value) if abs(value - round(value)) < 1e-12 else float(value), otypes=[object]
    )(np.round(np.asarray(values, dtype=float), 14))


# ---------------------------------------------------------------- two frames to read


def read_parameters(mine) -> list[float]:
    """[a, alpha, d, theta] between the student's two frames."""
    return [mine.reach, -np.radians(mine.tilt), -mine.drop, np.radians(mine.turn)]


# ---------------------------------------------------------------- two skew axes


def skew_axes(mine):
    """Two lines, each a point and a direction, (3,)."""
    first = np.array([mine.px, 0.1, 0.9]), np.array([0.0, 0, 1])
    second = np.array([mine.qx, mine.qy, mine.qz]), np.array([1.0, mine.m, mine.w])
    return first, second


def find_origin(mine, place="foot") -> list[float]:
    """The origin of frame 1, or another place that is taken for it."""
    first, second = skew_axes(mine)
    feet, (p, u), (q, _) = common_normal(first, second).feet, first, second
    places = {
        "foot": feet[0],
        "other foot": feet[1],
        "joint": p,
        "perpendicular": p + ((q - p) @ u) * u,
        "middle": feet.mean(axis=0),
    }
    return tidy(places[place]).tolist()


def find_x_axis(mine, vector="axis") -> list[float]:
    """The X axis of frame 1, or another vector that is taken for it."""
    first, second = skew_axes(mine)
    feet, (p, u), (q, v) = common_normal(first, second).feet, first, second
    vectors = {
        "axis": link_axis(first, second),
        "wedge": np.cross(u, v),
        "normal": feet[1] - feet[0],
        "between joints": (q - p) / np.linalg.norm(q - p),
    }
    return tidy(vectors[vector]).tolist()


# ---------------------------------------------------------------- parallel axes

JOINTS_AT = 0.20, 0.35  # heights of joints 1 and 2


def find_parallel_link(mine, length="between axes", height="O1") -> list[float]:
    """[a1, z of O1] of two upright axes, or other lengths and heights that are taken for them."""
    (low, high), up = JOINTS_AT, [0, 0, 1]
    first, second = ([0, 0, low], up), ([mine.gap, mine.side, high], up)
    lengths = {
        "between axes": link(first, second)[0],
        "between joints": np.linalg.norm(np.subtract(second[0], first[0])),
        "gap": mine.gap,
        "side": mine.side,
        "gap and side": mine.gap + mine.side,
    }
    heights = {"O1": mine.height, "joint 1": low, "joint 2": high, "above joint 1": mine.height - low}
    return tidy([lengths[length], heights[height]]).tolist()


# ---------------------------------------------------------------- axes that meet, and a gripper


def meeting_axes(mine):
    """Two lines, each a point and a direction, (3,)."""
    along = np.array([mine.lean, 2.0, 4.0])
    return ([mine.cx, 0, 0.5], [0, 1, 0]), (np.array([mine.cx, mine.cy, 0.5]) + 0.1 * along, along)


def find_frame(mine) -> sympy.Matrix:
    """Frame 1 of two axes that meet, (4, 4)."""
    return sympy.Matrix(tidy(link_frame(*meeting_axes(mine))))


def find_gripper(mine, unit=np.pi / 180) -> sympy.Matrix:
    """The frame of the gripper at the shelf, (4, 4); `unit` is that of the yaw angle, in radians."""
    yaw = unit * mine.yaw
    z, y = rotation("z", yaw)[:, 0], np.array([0, 0, 1.0])
    found = np.eye(4)
    found[:3] = np.column_stack([np.cross(y, z), y, z, [0.6, mine.shelf, 0.8]])
    return sympy.Matrix(tidy(found))


def choose_axes(*columns: tuple[int, int]):
    """A step that gives a frame other axes: each of `columns` is (column, sign) of the right one, for X, Y and Z."""

    def step(matrix):
        matrix = sympy.Matrix(matrix)
        axes = [sign * matrix[:3, column] for column, sign in columns]
        return sympy.Matrix.hstack(*axes, matrix[:3, 3]).col_join(matrix[3, :])

    return step


def move_to_joint(matrix):
    """The origin on the point by which Z_1 was given."""
    matrix = sympy.Matrix(matrix).copy()
    matrix[1, 3] = 0
    return matrix


LEFT_HANDED = mistake(
    "left_handed_frame",
    0.5,
    "**Your frame is left-handed.** The order of a cross product matters: turned round, it gives the opposite axis. Use the right "
    "hand: X along the thumb, Y along the index finger, Z along the middle finger.",
    choose_axes((0, -1), (1, 1), (2, 1)),
    choose_axes((0, 1), (1, -1), (2, 1)),
)

# ---------------------------------------------------------------- a table rewritten


def rewrite(mine, *, turned=True, before=True, after=True, lengths=True) -> list[list]:
    """The table of the student's arm with each X turned around about which a twist is negative.

    Not `turned`, it stays as it was; without `before` or `after` the half turn is left out in the row before the twist or in
    its own; without `lengths` those along the X that are turned around keep their sign.
    """
    printed = SIGNED_ARMS[mine.arm]
    rows = [list(row) for row in printed]
    for i, row in enumerate(printed):
        if turned and row[2].is_negative:
            rows[i - 1][4] += sympy.pi if before else 0
            rows[i][1:3] = [-row[1] if lengths else row[1], -row[2]]
            rows[i][4] += sympy.pi if after else 0
    return rows


# ---------------------------------------------------------------- a and alpha of any two axes


ALLOWED = 1e-9  # for rounding, as the statement says


def find_link(P, u, Q, v, *, distance="lines", scaled=True, parallel=True, slack=ALLOWED) -> list[float]:
    """[a, alpha] of two axes, each a point and a direction, (3,).

    `distance` may be that of the ``"points"``; not `scaled`, it grows with the directions. Without `parallel` the
    function divides by the length of the cross product, whatever it is. Below `slack` the axes are taken for parallel, or
    for meeting.
    """
    size = np.linalg.norm(np.cross(u, v))
    if not parallel and not size:
        raise ZeroDivisionError("the axes are parallel")
    a, alpha = link((P, u), (Q, v))
    if not parallel and size < ALLOWED:
        a = float(abs(np.subtract(Q, P) @ np.cross(u, v)) / size)
    if slack > ALLOWED:
        if size < slack:
            a = float(np.linalg.norm(np.cross(np.subtract(Q, P), u)) / np.linalg.norm(u))
        alpha = abs(alpha) if a < slack else alpha
    if distance == "points":
        a = float(np.linalg.norm(np.subtract(Q, P)))
    return [a if scaled or size <= 1e-9 else a * size, alpha]


def name_axes(P, u, Q, v) -> str:
    """The case two axes belong to, in words."""
    if np.linalg.norm(np.cross(u, v)) < 1e-9:
        return "parallel axes"
    return "axes that meet" if find_link(P, u, Q, v)[0] < 1e-9 else "skew axes"


def draw_axes(rng: np.random.Generator) -> list[list]:
    """Argument lists (P, u, Q, v): skew axes with twists of both signs, parallel ones of both senses, ones that meet."""

    def vector():
        return rng.uniform(-1, 1, 3)

    pairs = [(vector(), vector(), vector(), vector()) for _ in range(8)]
    pairs.append(([0, 0, 0], [0, 0, 2], [0.4, 0, 0.1], [0, 1, 0]))
    for stretch in (1.0, -2.0, 0.5):
        # Eighths and powers of two: the cross product is exactly zero, for everyone who computes it.
        u = rng.integers(1, 8, 3) / 8
        pairs.append((vector(), u, vector(), stretch * u))
    pairs.append(([0, 0, 0], [0, 0, 1], [0.3, 0.4, 0.7], [0, 0, -1]))
    for _ in range(3):
        p, u, v = vector(), vector(), vector()
        q = p + rng.uniform(0.5, 1) * u + rng.uniform(0.5, 1) * v
        pairs.append((p, u, q, v))
    pairs.append(([0, 0, 1], [0, 0, 1], [0, 0.5, 0], [0, 3, 0]))
    for angle in (10 * ALLOWED, ALLOWED / 10):  # ten times, and a tenth of, what the statement takes for parallel
        pairs.append(([0, 0, 0], [1, 0, 0], [0.1, 0.3, 0.4], [1, 0, angle]))
    for way in (10 * ALLOWED, ALLOWED / 10):  # the same for axes that meet; seen along the way, the twist is negative
        pairs.append(([0, 0, 0], [1, 0, 0], [0, 0, way], [0.8, -0.6, 0]))
    return [[np.asarray(part, dtype=float).tolist() for part in pair] for pair in pairs]
