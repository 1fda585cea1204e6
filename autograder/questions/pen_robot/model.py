"""The pen robot of the sheet: table, tip, the surface that it reaches, the readings of its remark; and what it might have been."""

from __future__ import annotations

from functools import cache, lru_cache

import numpy as np
import sympy

from autograder.reference import DHTable, robots
from dhkit.geometry import rotation_2d
from dhkit.own_arms import PEN_OFFERS, pen_offers
from dhm.singularities import chain_mobility

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
# Whatever the entry of row 2 is read as: entry + theta3 is the printed theta2 - pi/2 + theta3 = phi - pi/2.
READINGS = [phi - HALF - (robots.pen(reading=name).table.rows[1].theta - t2) for name in "ABC"]


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


# ---------------------------------------------------------------- freedoms of what it might have been

COUNTED_WRONGLY = {"upright": 3, "ball": 3, "axle": 2, "lifts": 3}
"""Robots of `PEN_OFFERS`, with the freedoms of their tips for somebody who overlooks what is special about them."""


def freedoms(mine, overlooked: str = "") -> list[int]:
    """How many freedoms the tip has for each robot of the student's list; what is special about one may be overlooked."""
    ranks = {**_ranks(), **({overlooked: COUNTED_WRONGLY[overlooked]} if overlooked else {})}
    names = {id(rows): name for name, rows in PEN_OFFERS.items()}
    return [ranks[names[id(rows)]] for rows in pen_offers(mine).values()]


@cache
def _ranks() -> dict[str, int]:
    """The largest rank of the tip's Jacobian."""
    tables = {name: _with_lengths(rows) for name, rows in PEN_OFFERS.items()}
    tables["link"] = robots.PEN_REPAIRED.table
    return {name: chain_mobility(table.chain, rows=3) for name, table in tables.items()}


def _with_lengths(rows) -> DHTable:
    """A robot that was proposed, with some number for each of its lengths."""
    variables = [next(iter(sympy.sympify(row[3 if row[0] else 4]).free_symbols)) for row in rows[:3]]
    letters = {symbol for row in rows for cell in row[1:] for symbol in sympy.sympify(cell).free_symbols}
    sizes = {str(letter): 0.2 + 0.07 * k for k, letter in enumerate(sorted(letters - {*variables}, key=str))}
    return DHTable(rows, joints=variables, values=sizes)
