"""The pen robot: table, tip, the surface that it reaches, both models, a curve written on a sheet."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Family
from autograder.reference import DHTable, robots
from dhkit.curves import pen_path
from dhkit.geometry import rotation, rotation_2d

from ..shared.tables import list_rows

t1, t2, t3, phi, x, y = sympy.symbols("t1 t2 t3 phi x y")
h1, L1, h2, L2, p1 = sympy.symbols("h1 L1 h2 L2 p1")
HALF = sympy.pi / 2
LENGTHS = ("h1", "L1", "h2", "L2", "p1")

TABLE = robots.PEN.table
ROWS = [*list_rows(TABLE), [0, p1, 0, 0, 0]]
TIP = list(TABLE.symbolic_forward()[:3, 3])
TWISTED = DHTable(
    [(row.sigma, row.a, -row.alpha, row.d, row.theta) for row in TABLE.rows], joints=(t1, t2, t3), tool=TABLE.tool
)
TWISTED_TIP = list(TWISTED.symbolic_forward()[:3, 3])
REPAIRED = [robots.PEN_REPAIRED.table.symbolic_forward()[row, 3].subs(t1, 0) for row in (0, 2)]
# Whatever the entry of row 2 is read as: entry + theta3 is the printed theta2 - pi/2 + theta3 = phi - pi/2.
READINGS = [phi - HALF - (robots.pen(reading=name).table.rows[1].theta - t2) for name in "ABC"]
ABSOLUTE_REPAIRED = [
    L1 + L2 * sympy.sin(t2) + p1 * sympy.sin(t3),
    h1 + L2 * sympy.cos(t2) + p1 * sympy.cos(t3),
]


def read_twist_as_length(rows):
    """The second column, headed like the first, is read as a length too."""
    return [[row[0], row[1] + row[2], 0, *row[3:]] for row in rows]


# ---------------------------------------------------------------- the surface


def height_squared(side=h2 + L2, sign=-1, out=L1) -> sympy.Expr:
    """(z - h1)^2 on the surface, the pen in front of axis 1.

    `side` is the distance of the pen's plane from axis 1, `sign` that of its square, `out` the length of the arm.
    """
    return p1**2 - (sympy.sqrt(x**2 + y**2 + sign * side**2) - out) ** 2


def draw_surface(rng: np.random.Generator) -> dict[str, float]:
    """A sample point: lengths, and the x and y of a tip in front of axis 1."""
    sizes = dict(zip(LENGTHS, rng.uniform([0.2, 0.3, 0.05, 0.05, 0.1], [0.4, 0.5, 0.2, 0.2, 0.25])))
    q1, angle = rng.uniform(-np.pi, np.pi, 2)
    rho, side = sizes["L1"] + sizes["p1"] * np.sin(angle), sizes["h2"] + sizes["L2"]
    sizes |= dict(zip(("x", "y"), rotation_2d(q1) @ [rho, side]))
    return {name: sizes[name] for name in ("x", "y", "L1", "h2", "L2", "p1")}


def circles(mine, side="h2 + L2") -> list[float]:
    """Radii on the sheet, the large one first; `side` is the distance of the pen's plane from axis 1."""
    distance = {"h2 + L2": mine.h2 + mine.L2, "h2": mine.h2, "none": 0.0}[side]
    return list(robot(mine.h1, mine.L1, distance, 0.0, mine.p1).inverse_model.circles(mine.h1 - mine.drop))


@lru_cache(maxsize=256)
def robot(h1, L1, h2, L2, p1):
    return robots.pen(h1, L1, h2, L2, p1)


# ---------------------------------------------------------------- the inverse model


ALLOWED = 1e-6  # metres beside the surface, as the statement says


def inverse(px, py, pz, h1, L1, H, p1, *, signs=(1, -1), side=1, slack=ALLOWED, angle=np.arctan2) -> list[list[float]]:
    """All [theta1, phi] of a point, [] off the surface.

    `signs` are those of rho, `side` is that of the arm beside the tip; points nearer to the surface than `slack` get
    solutions; `angle` finds phi from the ways ahead and up.
    """
    square = px**2 + py**2 - H**2
    found = []
    for sign in signs if square >= 0 else ():
        rho = sign * np.sqrt(square)
        if abs(np.hypot(rho - L1, pz - h1) - p1) < slack:
            found.append([np.arctan2(py, px) - side * np.arctan2(H, rho), angle(rho - L1, pz - h1)])
    return found


def asin(ahead, up) -> float:
    """phi from its sine: the lower half of the circle is lost."""
    return np.arcsin(ahead / np.hypot(ahead, up))


def atan(ahead, up) -> float:
    """phi from a quotient: the lower half of the circle is lost."""
    return np.arctan(ahead / up)


SHORT_PEN, LONG_PEN = (0.3, 0.32, 0.18, 0.2), (0.25, 0.15, 0.1, 0.35)  # h1, L1, H, p1


def draw_places(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists (x, y, z, h1, L1, H, p1): points of the surface, in front of axis 1 and behind it; beside it; and nearer to the axis than H."""
    found = []
    for sizes in (SHORT_PEN, LONG_PEN):
        height, out, side, pen = sizes
        behind = np.arccos(min(out / pen, 1.0))  # half of the range of phi in which the tip is behind axis 1
        for _ in range(5):
            found.append((*_point(rng.uniform(-np.pi, np.pi), rng.uniform(0.1, np.pi - 0.1), sizes), *sizes))
        for angle in (-0.25, np.pi - 0.2, np.pi + 0.25):
            found.append((*_point(rng.uniform(-np.pi, np.pi), angle, sizes), *sizes))
        for turn in (rng.uniform(-np.pi, np.pi), rng.uniform(-np.pi, np.pi)):
            px, py, pz = _point(turn, rng.uniform(0.2, 2.9), sizes)
            found += [(1.04 * px, 1.04 * py, pz, *sizes), (px, py, pz + 0.01, *sizes)]
        # A tenth of what is allowed for rounding; then some tenths of a millimetre, and ten times as much.
        for beside in (ALLOWED / 10, -ALLOWED / 10, 2e-4, -4e-4, 3e-3):
            longer = (height, out, side, pen + beside)
            found.append((*_point(rng.uniform(-np.pi, np.pi), rng.uniform(0.3, 2.8), longer), *sizes))
        found.append((0.4 * side, 0.3 * side, height + 0.5 * pen, *sizes))
        if pen > out:
            for angle in -np.pi / 2 + rng.uniform(-0.8, 0.8, 5) * behind:
                found.append((*_point(rng.uniform(-np.pi, np.pi), angle, sizes), *sizes))
    return [[float(value) for value in args] for args in found]


def _point(turn, angle, sizes):
    height, out, side, pen = sizes
    return rotation("z", turn) @ [out + pen * np.sin(angle), side, height + pen * np.cos(angle)]


def name_place(px, py, pz, h1, L1, H, p1) -> str:
    """The case a point belongs to, in words."""
    square = px**2 + py**2 - H**2
    if square < 0:
        return "points nearer to axis 1 than H"
    residuals = [np.hypot(sign * np.sqrt(square) - L1, pz - h1) - p1 for sign in (1, -1)]
    names = ("points in front of axis 1", "points behind axis 1")
    return next((name for name, residual in zip(names, residuals) if abs(residual) < ALLOWED), "points off the surface")


def pair_residual(q, *args) -> np.ndarray:
    """How far the tip is from the point, (k,), for pairs (theta1, phi), (k, 2)."""
    tips = np.stack([_point(turn, angle, args[3:]) for turn, angle in q])
    return np.linalg.norm(tips - np.array(args[:3]), axis=-1)


# ---------------------------------------------------------------- writing a curve

STOP = np.pi / 2


def own_robot(mine) -> robots.Robot:
    return robot(*(mine[name] for name in LENGTHS))


def draw_curve(rng: np.random.Generator, mine) -> list[list[float]]:
    """Argument lists (x, y, z): points of the student's own curve, drawn along it."""
    path = pen_path(mine.curve, 241)
    chosen = np.sort(rng.choice(len(path), 24, replace=False))
    turn, angle = path[chosen].T
    points = own_robot(mine).forward(np.stack([turn, angle, 0 * angle], axis=-1))[:, :3, 3]
    return points.tolist()


UPRIGHT = 0.5, 0.4, 0.6
COMMON_SHARES = 0.5, 0.0, 1.0


def follow(*point, mine, heading="arm", zero="upright", shares=UPRIGHT) -> Family | list:
    """Joint values [t1, t2, t3] for a point of the curve: phi shared by joints 2 and 3 in some ways; [] off the surface.

    `heading` may be that of the ``"tip"``, or its ``"mirror"`` image; `zero` may be ``"horizontal"``.
    """
    found = own_robot(mine).inverse_model.effective(point, tol=1e-7)
    if not found:
        return []
    turn, angle = found[0]
    tip = np.arctan2(point[1], point[0])
    turn = {"arm": turn, "tip": tip, "mirror": 2 * tip - turn}[heading]
    angle = angle if zero == "upright" else np.pi / 2 - angle
    return Family([[turn, share * angle, (1 - share) * angle] for share in shares])


def name_half(px, py, pz) -> str:
    """The case a point of the curve belongs to, in words."""
    return "the left half of the curve (y > 0)" if py > 0 else "the right half of the curve (y < 0)"


def trace_residual(q, *point, mine) -> np.ndarray:
    """How far the tip is from the point of the curve, plus how far joints 2 and 3 are beyond their stops."""
    tips = own_robot(mine).forward(q)[:, :3, 3]
    beyond = np.maximum(np.abs(q[:, 1:]) - STOP, 0).sum(axis=1)
    return np.linalg.norm(tips - np.array(point), axis=-1) + np.where(beyond > 1e-9, beyond, 0)


def pen_for_circle(mine, *, side=True, sheet=True) -> list[float]:
    """[p1, small]: the pen whose large circle on the student's sheet has the student's radius, and its small circle.

    The distance of the pen's plane from axis 1, or the depth of the sheet, may be forgotten.
    """
    beside = mine.h2 + mine.L2 if side else 0.0
    ahead = np.sqrt(mine.radius**2 - beside**2) - mine.L1
    return [float(np.hypot(ahead, mine.drop if sheet else 0.0)), float(np.hypot(mine.L1 - ahead, beside))]
