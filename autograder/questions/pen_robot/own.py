"""An arm of the student's own with a pen and one joint too many: tip, inverse model, a curve; and a function to mend.

Two of the three joints do the same to the tip, so that it stays on a surface. The inverse model lets the later one rest.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import sympy

from autograder.judge import Family
from autograder.reference import DHTable
from dhkit.arms import arm_of as shown_arm_of
from dhkit.curves import STOPS, arm_path
from dhkit.variants import OwnNumbers

from ..shared.own_arm import transform
from ..shared.pool import arms

LETTERS = ("b", "r", "e", "p")
JOINTS = sympy.symbols("q1 q2 q3")
Point = tuple[float, float, float]
Lengths = tuple[float, float, float, float]


def tip(mine: OwnNumbers) -> list[sympy.Expr]:
    """Where the pen tip is, in letters."""
    return list(transform(mine.arm)[:3, 3])


@cache
def same_joints(name: str) -> tuple[int, int, int]:
    """The places of the two joints that do the same to the tip, and 1 or -1 for the sense of the second one."""
    jacobian = transform(name)[:3, 3].jacobian(JOINTS)
    return next(
        (i, k, sign)
        for i in range(3)
        for k in range(i + 1, 3)
        for sign in (1, -1)
        if sympy.simplify(jacobian[:, i] - sign * jacobian[:, k]).is_zero_matrix
    )


def still(mine: OwnNumbers) -> list[int]:
    """The direction of joint space in which the tip rests."""
    first, second, sign = same_joints(mine.arm)
    direction = [0, 0, 0]
    direction[first], direction[second] = 1, -sign
    return direction


# ---------------------------------------------------------------- the inverse model

Candidate = tuple[float, float, float]
"""What the joint that is found last must make up for; what the rest of the arm does of it; the other joint that acts."""


def _rail(point: Point, sizes: Lengths, sign: int) -> Candidate:
    (x, y, _), (_, r, _, p) = point, sizes
    angle = sign * np.arccos(np.clip((x - r) / p, -1, 1))
    return y, p * np.sin(angle), angle


def _telescope(point: Point, sizes: Lengths, sign: int) -> Candidate:
    (x, y, _), (_, r, e, _) = point, sizes
    ahead = sign * _leg(np.hypot(x, y), e)
    return np.arctan2(y, x), np.arctan2(ahead, e), ahead - r


def _turntables(point: Point, sizes: Lengths, sign: int) -> Candidate:
    (x, y, z), (b, r, e, _) = point, sizes
    beside = sign * _leg(np.hypot(x, y), r)
    return np.arctan2(y, x), np.arctan2(beside, r), np.arctan2(e - beside, z - b)


def _hoist(point: Point, sizes: Lengths, sign: int) -> Candidate:
    (x, _, z), (b, r, e, p) = point, sizes
    return z, b - p, sign * np.arccos(np.clip((x - e) / r, -1, 1))


def _wall(point: Point, sizes: Lengths, sign: int) -> Candidate:
    (x, y, z), (b, r, e, _) = point, sizes
    out = sign * _leg(np.hypot(x - b, z), r)
    return np.arctan2(x - b, z), np.arctan2(r, out), np.arctan2(-y, out - e)


def _lift(point: Point, sizes: Lengths, sign: int) -> Candidate:
    (x, _, z), (b, r, _, p) = point, sizes
    sine = np.clip((x - r) / p, -1, 1)
    angle = np.arctan2(sine, sign * np.sqrt(1 - sine**2))
    return z, b + p * np.cos(angle), angle


def _leg(hypotenuse: float, leg: float) -> float:
    return np.sqrt(max(hypotenuse**2 - leg**2, 0.0))


ARMS: dict[str, tuple[Callable[[Point, Lengths, int], Candidate], int, int]] = {
    "pen_rail": (_rail, 0, 1),
    "pen_telescope": (_telescope, 0, 1),
    "pen_turntables": (_turntables, 0, 2),
    "pen_hoist": (_hoist, 0, 1),
    "pen_wall": (_wall, 0, 1),
    "pen_lift": (_lift, 0, 2),
}
"""How each arm is solved, and the places of the joint that is found last and of the other one."""

ALLOWED = 1e-6  # metres beside the surface, as the statement says


def inverse(*point, mine, signs=(1, -1), rest=1, slack=ALLOWED) -> list[list[float]]:
    """All [q1, q2, q3] of a point with the later of the equal joints at zero, [] off the surface.

    `signs` are those of the root or of the arccosine; `rest` may be -1 where what the rest of the arm does counts with
    the wrong sign, 0 where it is forgotten. Points nearer to the surface than `slack` get solutions.
    """
    return [_solved(point, mine, sign, rest) for sign in _signs(point, mine, signs, slack)]


def _signs(point, mine, signs=(1, -1), slack=ALLOWED) -> list[int]:
    """Those of `signs` that lead to the point."""
    return [s for s in signs if np.linalg.norm(_forward(mine, _solved(point, mine, s))[0] - point) < slack]


def _solved(point, mine, sign, rest=1) -> list[float]:
    solve, last, other = ARMS[mine.arm]
    q = [0.0, 0.0, 0.0]
    goal, done, q[other] = solve(point, _lengths(mine), sign)
    q[last] = goal - rest * done
    return [float(value) for value in q]


def _lengths(mine: OwnNumbers) -> Lengths:
    return tuple(mine[name] for name in LETTERS)


def own_table(mine: OwnNumbers) -> DHTable:
    """The student's arm with the student's lengths."""
    return arms()[mine.arm].table.with_values({name: mine[name] for name in LETTERS})


def _forward(mine: OwnNumbers, *q) -> np.ndarray:
    """Tips, (k, 3), for joint values (k, 3)."""
    return _tip_function(mine.arm)(np.array(q, float), *_lengths(mine))


@cache
def _tip_function(name: str) -> Callable[..., np.ndarray]:
    call = sympy.lambdify([JOINTS, sympy.symbols(LETTERS)], list(transform(name)[:3, 3]))
    return lambda q, *sizes: np.stack(np.broadcast_arrays(*call(q.T, sizes)), axis=-1)


def residual(q, *point, mine) -> np.ndarray:
    """How far the tip is from the point, (k,), for joint values (k, 3), plus how far the resting joint is from zero."""
    _, second, _ = same_joints(mine.arm)
    return np.linalg.norm(_forward(mine, *q) - np.array(point), axis=-1) + np.abs(q[:, second])


BESIDE = (ALLOWED / 10, -ALLOWED / 10, 0.05, -0.01, 3e-3, -4e-4, 2e-4)
"""Metres beside the surface: a tenth of what is allowed for rounding; much; tenths of a millimetre.

The largest comes first: a home that tries a few tells who checks nothing from who allows too much.
"""


def draw_points(rng: np.random.Generator, mine) -> list[list[float]]:
    """Argument lists (x, y, z): points of the surface, and beside it."""
    places = [_draw_place(rng, mine) for _ in range(16 + len(BESIDE))]
    points = [point + beside * normal for (point, normal), beside in zip(places, [0.0] * 16 + [*BESIDE])]
    return [[float(entry) for entry in point] for point in points]


def _draw_place(rng, mine) -> tuple[np.ndarray, np.ndarray]:
    """A point of the surface and the normal there, (3,) each, where no two solutions are about to meet."""
    while True:
        point, normal = _at(mine, *_draw_posture(rng, mine.arm))
        if all(
            inverse(*(point + side * normal), mine=mine, slack=ALLOWED / 2) for side in (ALLOWED / 10, -ALLOWED / 10)
        ):
            return point, normal


def _draw_posture(rng: np.random.Generator, name: str) -> np.ndarray:
    """Joint values with the later of the equal joints at zero, where solutions do not meet."""
    _, second, _ = same_joints(name)
    q = np.where([row.sigma for row in arms()[name].table.moving], rng.uniform(0.02, 0.25, 3), rng.uniform(0.4, 1.2, 3))
    turns = [k for k, row in enumerate(arms()[name].table.moving) if not row.sigma]
    quarters = rng.integers(4, size=3)
    for k in turns:
        # In any quadrant, and away from quarter turns.
        q[k] = (q[k] if quarters[k] % 2 == 0 else np.pi - q[k]) * (1 if quarters[k] < 2 else -1)
    q[second] = 0.0
    return q


def _at(mine, *q) -> tuple[np.ndarray, np.ndarray]:
    """The tip, and the unit vector at right angles to its surface, both (3,)."""
    _, second, _ = same_joints(mine.arm)
    step = 1e-5
    ways = [step * np.eye(3)[k] for k in range(3) if k != second]
    along = [(_forward(mine, q + way) - _forward(mine, q - way))[0] for way in ways]
    normal = np.cross(*along)
    return _forward(mine, q)[0], normal / np.linalg.norm(normal)


# ---------------------------------------------------------------- writing a curve


def draw_curve(rng: np.random.Generator, mine) -> list[list[float]]:
    """Argument lists (x, y, z): points of the student's own curve, drawn along it."""
    path = arm_path(shown_arm_of(mine), mine.curve, 241)
    chosen = np.sort(rng.choice(len(path), 24, replace=False))
    return _forward(mine, *path[chosen]).tolist()


SHARES = 0.5, 0.46, 0.54
ONE_ALONE = 1.0, 0.0


def follow(*point, mine, rest=1, shares=SHARES, sense=1) -> Family | list:
    """Joint values for a point of the curve, the work of the equal joints shared in some ways; [] off the surface.

    `rest` is that of `inverse`; `sense` may be -1 where the second of the equal joints works against the first.
    """
    first, second, same = same_joints(mine.arm)
    signs = _signs(point, mine)
    if not signs:
        return []
    sign = min(signs, key=lambda s: abs(_solved(point, mine, s)[first]))
    whole = _solved(point, mine, sign, rest)
    work, family = whole[first], []
    for share in shares:
        q = list(whole)
        q[first], q[second] = share * work, sense * same * (1 - share) * work
        family.append(q)
    return Family(family)


def _stops(mine) -> list[float]:
    return [STOPS[bool(row.sigma)] for row in arms()[mine.arm].table.moving]


def trace_residual(q, *point, mine) -> np.ndarray:
    """How far the tip is from the point of the curve, plus how far the joints are beyond their stops."""
    turned = np.array([not row.sigma for row in arms()[mine.arm].table.moving])
    values = np.where(turned, np.angle(np.exp(1j * q)), q)
    beyond = np.maximum(np.abs(values) - _stops(mine), 0).sum(axis=1)
    return np.linalg.norm(_forward(mine, *q) - np.array(point), axis=-1) + np.where(beyond > 1e-9, beyond, 0)


# ---------------------------------------------------------------- a function to mend


def mended(
    px, py, pz, b, r, e, *, signs=(1, -1), tilt=np.arctan2, first=np.arctan2, near="nothing"
) -> list[list[float]] | None:
    """All [q1, q2, q3], q3 not negative, of the column whose pen swings and slides out.

    `tilt` finds q2 from the ways ahead and up, `first` the direction of the point from y and x; for points nearer to axis 1
    than `e` there is ``"nothing"``, what comes out for the circle of that radius, ``"limit"``, or a ``"failure"``.
    """
    square = px**2 + py**2 - e**2
    if square < 0 and near != "limit":
        return [] if near == "nothing" else None
    found = []
    for sign in signs:
        ahead = sign * np.sqrt(max(square, 0.0))
        out = np.hypot(ahead - r, pz - b)
        found.append([first(py, px) + np.arctan2(e, ahead), tilt(ahead - r, pz - b), out])
    return found


def asin(ahead, up) -> float:
    """An angle from its sine: half of the circle is lost."""
    return np.arcsin(ahead / np.hypot(ahead, up))


def atan(ordinate, abscissa) -> float:
    """An angle from a quotient: half of the circle is lost."""
    return np.arctan(ordinate / abscissa)


def mended_residual(q, *args) -> np.ndarray:
    """How far the tip is from the point, (k,), for joint values (k, 3), plus how far the pen is slid in."""
    tips = np.array(_swing()(q.T, args[3:]), float).T
    return np.linalg.norm(tips - np.array(args[:3]), axis=-1) + np.maximum(-q[:, 2], 0)


@cache
def _swing() -> Callable:
    return sympy.lambdify([JOINTS, sympy.symbols("b r e")], list(transform("pen_swing")[:3, 3]))


def draw_swing_points(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists (x, y, z, b, r, e): points all round the column, above axis 2 and below it, and next to axis 1."""
    found = []
    for quarter in range(4):
        for up in (1, -1):
            for _ in range(2):
                b, r, e = rng.uniform((0.4, 0.2, 0.06), (0.5, 0.3, 0.14))
                turn, far = (quarter + rng.uniform(0.15, 0.85)) * np.pi / 2, rng.uniform(1.2 * e, 0.6)
                found.append((far * np.cos(turn), far * np.sin(turn), b + up * rng.uniform(0.05, 0.3), b, r, e))
    for _ in range(4):
        b, r, e = rng.uniform((0.4, 0.2, 0.06), (0.5, 0.3, 0.14))
        turn, far = rng.uniform(-np.pi, np.pi), rng.uniform(0.2, 0.9) * e
        found.append((far * np.cos(turn), far * np.sin(turn), rng.uniform(0.2, 0.7), b, r, e))
    return [[float(value) for value in args] for args in found]


def name_swing_point(px, py, pz, b, r, e) -> str:
    """The case a point belongs to, in words."""
    if np.hypot(px, py) < e:
        return "points nearer to axis 1 than e"
    return f"points {'above' if pz > b else 'below'} axis 2, with {'positive' if px > 0 else 'negative'} x"
