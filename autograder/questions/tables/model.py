"""Tables of printed robots, classic and modified rows, the rank of a table, tables of a wrist and of an arm that the id chooses."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import sympy

from autograder.reference import robots
from dhkit.geometry import modified_dh, rigid_transform

from ..shared.pool import arm_of
from ..shared.tables import list_rows

HALF = sympy.pi / 2
MODIFIED, CLASSIC, MIXED = 1, 2, 3
PRINTED_TABLES = [CLASSIC, MODIFIED, CLASSIC, MODIFIED, MIXED]  # cobot, elbow arm, wrist, seven axes, handling arm

# ---------------------------------------------------------------- planar arms


def planar(lengths, angles, *, base=False, last_link=True, heading="sum", unit=1.0, heading_unit=None) -> list[float]:
    """Tip and heading [x, y, heading] of a planar arm with any number of joints.

    With `base` each angle counts from the x axis; without `last_link` the tip is the last joint; `heading` may be the
    ``"last"`` angle; `unit`, and `heading_unit` where it differs, is that of the angles, in radians.
    """
    if not last_link:
        lengths = [*lengths[:-1], 0.0]
    if base:
        x, y = np.array(lengths) @ np.cos(unit * np.array(angles)), np.array(lengths) @ np.sin(unit * np.array(angles))
    else:
        x, y = robots.planar(lengths).forward(unit * np.array(angles))[:2, 3]
    turned = angles[-1] if heading == "last" else np.sum(angles)
    return [float(x), float(y), float((unit if heading_unit is None else heading_unit) * turned)]


def draw_arms(rng: np.random.Generator) -> list[list]:
    """Argument lists: arms with one to six links."""
    counts = (1, 2, 2, 3, 3, 4, 6)
    return [[rng.uniform(0.1, 0.6, n).round(3).tolist(), rng.uniform(-2.5, 2.5, n).round(3).tolist()] for n in counts]


def name_arm(lengths, angles) -> str:
    """The case an arm belongs to, in words."""
    return "arms with one or two links" if len(lengths) < 3 else "arms with more links"


# ---------------------------------------------------------------- RX-90 in classic rows


RX90_CLASSIC = [list(row.parameters) for row in robots.RX90.table.to_classic().rows]


def move_x_pairs(places: int):
    """A step on rows [a, alpha, d, theta]: a and alpha moved down by some places; zeros follow."""

    def step(rows):
        pairs = [[0, 0]] * places + [row[:2] for row in rows[: len(rows) - places]]
        return [[*pair, *row[2:]] for pair, row in zip(pairs, rows)]

    return step


def leave_alpha(rows):
    """Only a is moved: alpha still stands where the modified table has it."""
    modified = move_x_pairs(1)(rows)
    return [[row[0], below[1], *row[2:]] for row, below in zip(rows, modified)]


def move_z_pairs(rows):
    """d and theta are moved up as well."""
    pairs = [row[2:] for row in rows[1:]] + [[0, 0]]
    return [[*row[:2], *pair] for row, pair in zip(rows, pairs)]


# ---------------------------------------------------------------- the wrist and the PUMA-like arm


def wrist(mine) -> list[list]:
    """The rows of the student's wrist."""
    return list_rows(arm_of(mine).table)


PUMA_ROW = list_rows(robots.PUMA.table)[5]
PUMA_PRINTED_ROW = list_rows(robots.PUMA_PRINTED.table)[5]

# ---------------------------------------------------------------- freedoms of a table of numbers


COUNTS_AS_ZERO = 1e-6  # a singular value, as the statement says


def screws(rows, *, slides=True, early=False, about_tip=False) -> np.ndarray:
    """Columns (Z_i, O_i x Z_i) of turning joints and (0, Z_i) of sliding ones, shape (6, n).

    Without `slides` every joint turns; `early` takes axis i from the frame before it; `about_tip` counts moments about
    the tip.
    """
    rows = np.array(rows, dtype=float)
    frames = [np.eye(4)]
    for step in modified_dh(*rows.T[1:]):
        frames.append(frames[-1] @ step)
    centre = frames[-1][:3, 3] if about_tip else np.zeros(3)
    columns = []
    for row, frame in zip(rows, frames if early else frames[1:]):
        axis, origin = frame[:3, 2], frame[:3, 3]
        sliding = slides and row[0] == 1
        columns.append(np.concatenate([0 * axis, axis] if sliding else [axis, np.cross(origin - centre, axis)]))
    return np.transpose(columns)


def freedoms(
    rows, *, count="rank", part=slice(None), slides=True, early=False, about_tip=False, below=COUNTS_AS_ZERO
) -> int:
    """The rank of the screws of a table, (n, 5), or of a `part` of their six numbers.

    `count` may be ``"joints"``, or ``"joints up to six"``; singular values under `below` count as zero; the other keywords
    are those of `screws`.
    """
    if count != "rank":
        return len(rows) if count == "joints" else min(len(rows), 6)
    found = screws(rows, slides=slides, early=early, about_tip=about_tip)
    return int(np.linalg.matrix_rank(found[part], tol=below))


def draw_tables(rng: np.random.Generator) -> list[list]:
    """Argument lists: tables of robots at random postures, with sliding joints, with two joints on one line, and sound ones."""
    tables = [
        robots.RX90,
        robots.PUMA,
        robots.PUMA_PRINTED,
        robots.SCARA,
        robots.SPHERICAL_WRIST,
        robots.PLANAR_3R,
        robots.KR210,
    ]
    found = []
    for robot in tables:
        table = robot.table.at(robot.table.values)
        joints = {joint: rng.uniform(0.2, 1.2) for joint in table.joints}
        found.append(
            [[float(cell) for cell in (row.sigma, *(p.subs(joints) for p in row.parameters))] for row in table.rows]
        )
    a, d, t = rng.uniform(0.2, 0.6, 3)
    half = np.pi / 2
    found.append([[1, 0, 0, d, 0], [1, 0, half, a, half], [1, 0, half, t, 0]])  # a gantry
    found.append([[0, 0, 0, 0, t], [1, 0, 0, d, 0], [0, a, 0, 0, t], [1, 0, 0, a, 0]])  # two parallel slides
    found.append([[0, 0, -half, 0, t], [0, 0, half, 0, a], [0, 0, 0, d, t]])  # the wrist as printed, read as modified
    found = [[[round(cell, 6) for cell in row] for row in rows] for rows in found]
    # Two axes almost on one line: the smallest singular value is a tenth, then ten times, of what counts as zero.
    for size in (COUNTS_AS_ZERO / 10, 10 * COUNTS_AS_ZERO):
        apart = float(size * np.sqrt(2))
        found += [[[0, 0, 0, 0, t], [0, apart, 0, 0, 0]], [[0, 0, 0, d, 0], [0, apart, 0, 0, 0], [1, 0, 0, 0.2, 0]]]
    return [[rows] for rows in found]


def name_table(rows) -> str:
    """The case a table belongs to, in words."""
    if any(row[0] == 1 for row in rows):
        return "tables with a sliding joint"
    near = any(0 < abs(row[1]) < 1e-3 for row in rows)
    if near or freedoms(rows) < min(len(rows), 6):
        return "tables with two joints on one line, or almost"
    return "sound tables of turning joints"


# ---------------------------------------------------------------- a table from a list of joint origins


q1, q2, q3, q4, q5 = sympy.symbols("q1:6")

Added = Callable[..., float]


def first(*lengths: float) -> float:
    """The first of several lengths along one axis, for their sum."""
    return lengths[0]


def last(*lengths: float) -> float:
    return lengths[-1]


def total(*lengths: float) -> float:
    return round(sum(lengths), 9)


def arm(mine, *, added: Added = total, a1=lambda mine: mine.x2, d5=lambda mine: 0, offsets=slice(None)) -> list[list]:
    """The rows of the student's arm.

    `added` makes one d of the lengths that the list has along one axis, `a1` and `d5` take a length from the list, and of the
    joint offsets only `offsets` are there.
    """
    height = added(mine.z1, mine.z2)
    rows = {
        "welder": [
            [0, 0, 0, height, q1],
            [0, a1(mine), -HALF, 0, q2 - HALF],
            [0, mine.l3, 0, 0, q3 + HALF],
            [0, mine.x4, 0, 0, q4 - HALF],
            [0, 0, -HALF, d5(mine), q5 - HALF],
        ],
        "roller": [
            [0, 0, 0, height, q1],
            [0, a1(mine), -HALF, 0, q2 - HALF],
            [0, 0, -HALF, added(mine.l3, mine.x4), q3],
            [0, 0, HALF, 0, q4],
            [0, mine.z4, -HALF, d5(mine), q5 + HALF],
        ],
        "lift": [
            [1, 0, 0, q1 + height, 0],
            [0, a1(mine), -HALF, 0, q2],
            [0, mine.l3, 0, 0, q3],
            [0, mine.x4, HALF, mine.z4, q4 + HALF],
            [0, 0, HALF, d5(mine), q5 + HALF],
        ],
    }[mine.file]
    constant = [i for i, row in enumerate(rows) if row[4] not in (0, q1, q2, q3, q4, q5)]
    kept = constant[offsets]
    return [
        [*row[:4], row[4] if i in kept or i not in constant else sum(sympy.sympify(row[4]).free_symbols)]
        for i, row in enumerate(rows)
    ]


DOWN = {"welder": (0, -1, 0), "roller": (0, 1, 0), "lift": (-1, 0, 0)}
"""The direction down in frame 5 of each arm, all joints at zero."""


def gripper(mine, *, down=1, ahead=(0, 0, 1), turned=True, rows=("x5", "xg")) -> list[list]:
    """Transform from frame 5 to the gripper as nested lists.

    `down` is 1, or -1 for up; `ahead` the direction of the way to the gripper's origin, and `rows` are those of the list on
    this way; not `turned`, it has the axes of frame 5.
    """
    x = down * np.array(DOWN[mine.file])
    turn = np.column_stack([x, np.cross((0, 0, 1), x), (0, 0, 1)]) if turned else np.eye(3)
    matrix = rigid_transform(turn, np.array(ahead) * sum(mine[row] for row in rows))
    return [[int(cell) if cell == int(cell) else float(cell) for cell in row] for row in matrix]
