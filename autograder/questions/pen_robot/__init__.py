"""The pen robot (its sheet, French and English): table, tip, the surface it reaches, and a curve written on it."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Family, Follow, Question, following, mistake
from autograder.judge.misconceptions import (
    columns_exchanged,
    offset_missing,
    option,
    tool_left_out,
)
from autograder.reference import DHTable, robots
from dhkit.curves import pen_path

t1, t2, t3, phi, x, y = sympy.symbols("t1 t2 t3 phi x y")
h1, L1, h2, L2, p1 = sympy.symbols("h1 L1 h2 L2 p1")
HALF = sympy.pi / 2
LENGTHS = ("h1", "L1", "h2", "L2", "p1")

TABLE = robots.PEN.table
ROWS = [[row.sigma, *row.parameters] for row in TABLE.rows] + [[0, p1, 0, 0, 0]]
TIP = list(TABLE.symbolic_forward()[:3, 3])
TWISTED = DHTable(
    [(row.sigma, row.a, -row.alpha, row.d, row.theta) for row in TABLE.rows], joints=(t1, t2, t3), tool=TABLE.tool
)
TWISTED_TIP = list(TWISTED.symbolic_forward()[:3, 3])
REPAIRED = [robots.PEN_REPAIRED.table.symbolic_forward()[row, 3].subs(t1, 0) for row in (0, 2)]
# Whatever the entry of row 2 is read as: entry + theta3 is the printed theta2 - pi/2 + theta3 = phi - pi/2.
READINGS = [phi - HALF - (robots.pen(reading=name).table.rows[1].theta - t2) for name in "ABC"]


def twist_as_length(rows):
    """The second column, headed like the first, is read as a length too."""
    return [[row[0], row[1] + row[2], 0, *row[3:]] for row in rows]


def substituted(replacements):
    return lambda answer: [sympy.sympify(entry).subs(replacements, simultaneous=True) for entry in answer]


# ---------------------------------------------------------------- the surface


def height_squared(side=h2 + L2, sign=-1, out=L1):
    """(z - h1)^2 on the surface, the pen in front of axis 1; with the defaults right."""
    return p1**2 - (sympy.sqrt(x**2 + y**2 + sign * side**2) - out) ** 2


def point_of_the_surface(rng: np.random.Generator) -> dict[str, float]:
    """A sample point: lengths, and the x and y of a tip in front of axis 1."""
    sizes = dict(zip(LENGTHS, rng.uniform([0.2, 0.3, 0.05, 0.05, 0.1], [0.4, 0.5, 0.2, 0.2, 0.25])))
    q1, angle = rng.uniform(-np.pi, np.pi, 2)
    rho, side = sizes["L1"] + sizes["p1"] * np.sin(angle), sizes["h2"] + sizes["L2"]
    sizes |= {"x": rho * np.cos(q1) - side * np.sin(q1), "y": rho * np.sin(q1) + side * np.cos(q1)}
    return {name: sizes[name] for name in ("x", "y", "L1", "h2", "L2", "p1")}


def circles(mine, side="h2 + L2") -> list[float]:
    """Radii on the sheet, the large one first; `side` is the distance of the pen's plane from axis 1."""
    distance = {"h2 + L2": mine.h2 + mine.L2, "h2": mine.h2, "none": 0.0}[side]
    return list(_robot(mine.h1, mine.L1, distance, 0.0, mine.p1).inverse_model.circles(mine.h1 - mine.drop))


@lru_cache(maxsize=256)
def _robot(h1, L1, h2, L2, p1):
    return robots.pen(h1, L1, h2, L2, p1)


# ---------------------------------------------------------------- the inverse model


def reached(px, py, pz, h1, L1, H, p1):
    """All (theta1, phi) of a point, [] off the surface."""
    return [list(pair) for pair in _robot(h1, L1, H, 0.0, p1).inverse_model.effective((px, py, pz), tol=1e-7)]


def inverse(*, signs=(1, -1), side=1, checked=True, angle=np.arctan2):
    """A student's inverse(x, y, z, h1, L1, H, p1) with one thing done wrong; the default is right."""

    def answer(px, py, pz, h1, L1, H, p1):
        square = px**2 + py**2 - H**2
        found = []
        for sign in signs if square >= 0 else ():
            rho = sign * np.sqrt(square)
            if not checked or abs(np.hypot(rho - L1, pz - h1) - p1) < 1e-6:
                found.append([np.arctan2(py, px) - side * np.arctan2(H, rho), angle(rho - L1, pz - h1)])
        return found

    return answer


def from_sine(ahead, up):
    """phi from its sine: the lower half of the circle is lost."""
    return np.arcsin(ahead / np.hypot(ahead, up))


def from_quotient(ahead, up):
    return np.arctan(ahead / up)


SHORT_PEN, LONG_PEN = (0.3, 0.32, 0.18, 0.2), (0.25, 0.15, 0.1, 0.35)  # h1, L1, H, p1


def places(rng: np.random.Generator) -> list[list[float]]:
    """Points of the surface, in front of axis 1 and behind it; beside it; and nearer to the axis than H."""
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
        found.append((0.4 * side, 0.3 * side, height + 0.5 * pen, *sizes))
        if pen > out:
            for angle in -np.pi / 2 + rng.uniform(-0.8, 0.8, 5) * behind:
                found.append((*_point(rng.uniform(-np.pi, np.pi), angle, sizes), *sizes))
    return [[float(value) for value in args] for args in found]


def _point(turn, angle, sizes):
    height, out, side, pen = sizes
    ahead = out + pen * np.sin(angle)
    return (
        ahead * np.cos(turn) - side * np.sin(turn),
        ahead * np.sin(turn) + side * np.cos(turn),
        height + pen * np.cos(angle),
    )


def kind_of_place(px, py, pz, h1, L1, H, p1) -> str:
    square = px**2 + py**2 - H**2
    if square < 0:
        return "points nearer to axis 1 than H"
    residuals = [np.hypot(sign * np.sqrt(square) - L1, pz - h1) - p1 for sign in (1, -1)]
    names = ("points in front of axis 1", "points behind axis 1")
    return next((name for name, residual in zip(names, residuals) if abs(residual) < 1e-6), "points off the surface")


def pair_residual(q, *args):
    """How far the tip is from the point, (k,), for (theta1, phi) (k, 2)."""
    tips = np.stack([_point(turn, angle, args[3:]) for turn, angle in q])
    return np.linalg.norm(tips - np.array(args[:3]), axis=-1)


# ---------------------------------------------------------------- writing a curve

STOP = np.pi / 2


def own_robot(mine):
    return _robot(*(mine[name] for name in LENGTHS))


def curve(rng: np.random.Generator, mine) -> list[list[float]]:
    """Points of the student's own curve, drawn along it."""
    path = pen_path(mine.curve, 241)
    chosen = np.sort(rng.choice(len(path), 24, replace=False))
    turn, angle = path[chosen].T
    points = own_robot(mine).forward(np.stack([turn, angle, 0 * angle], axis=-1))[:, :3, 3]
    return points.tolist()


def follow(*point, mine):
    """Right joint values for a point of the curve: phi shared by both joints in equal parts, and others within the stops."""
    turn, angle = own_robot(mine).inverse_model.effective(point, tol=1e-7)[0]
    return Family([[turn, share * angle, (1 - share) * angle] for share in (0.5, 0.4, 0.6)])


def trace_residual(q, *point, mine):
    """How far the tip is from the point of the curve, plus how far joints 2 and 3 are beyond their stops."""
    tips = own_robot(mine).forward(q)[:, :3, 3]
    beyond = np.maximum(np.abs(q[:, 1:]) - STOP, 0).sum(axis=1)
    return np.linalg.norm(tips - np.array(point), axis=-1) + np.where(beyond > 1e-9, beyond, 0)


def shared(change=lambda row, point: row, shares=(0.5, 0.0, 1.0)):
    """Steps on follow: its row changed, and phi shared by joints 2 and 3 in some ways that students choose."""

    def step(share):
        def taken(follow):
            def wrong(*point):
                turn, second, third = change(_rows(follow(*point))[0], point)
                return [[turn, share * (second + third), (1 - share) * (second + third)]]

            return wrong

        return taken

    return [step(share) for share in shares]


def _rows(answer) -> list:
    return answer.solutions if isinstance(answer, Family) else answer


QUESTIONS = (
    Question(
        "pen_robot.table",
        reference=ROWS,
        mistakes=(
            mistake(
                "twist_read_as_length",
                0.3,
                "**The second printed column is read as a length.** Its header is a misprint: -pi/2 is no length, but an angle "
                "about X from one joint axis to the next.",
                twist_as_length,
            ),
            columns_exchanged(
                "a",
                "alpha",
                feedback="**The columns a and alpha are exchanged.** Their heads on the sheet do not help: look at the entries. Which "
                "column can hold a length?",
            ),
            offset_missing(2),
            tool_left_out(
                feedback="**The pen is missing.** The last row must bring the origin from the last joint to the tip."
            ),
        ),
        partial=0.6,
    ),
    Question(
        "pen_robot.tip",
        reference=TIP,
        mistakes=(
            mistake(
                "pen_left_out",
                0.4,
                "**This is the origin of the last frame, not the tip.** The pen reaches p1 further along the last X axis.",
                substituted({p1: 0}),
            ),
            mistake(
                "joint_offset_missing",
                0.6,
                "**The offset of theta2 is missing.** With all angles zero your pen lies; row 2 of the table makes it stand.",
                substituted({t2: t2 + HALF}),
            ),
            mistake(
                "sign_of_alpha",
                0.5,
                "**A sign is turned, as if alpha were +pi/2.** To which side of axis 1 does the pen's plane pass?",
                lambda _: TWISTED_TIP,
            ),
        ),
        follows=Follow("pen_robot.table", lambda rows: following.position(following.product_of_table(rows))),
    ),
    Question(
        "pen_robot.linear",
        reference="C",
        mistakes=(
            option(
                "A",
                "taken_for_linear",
                "**The sheet says so, but the unknowns stand inside sines and cosines, and in products.** Double all angles: does the tip "
                "move twice as far?",
            ),
            option(
                "B",
                "three_unknowns_counted",
                "**Three angles are written, fewer act.** Turn joint 2 forward and joint 3 back by the same angle: where does the tip go?",
                share=0.3,
            ),
            option(
                "D",
                "linear_in_sines_and_cosines",
                "**The sines and cosines are not independent, and they occur in products.** Besides, count how many angles act.",
            ),
        ),
    ),
    Question(
        "pen_robot.height",
        reference=height_squared,
        mistakes=(
            mistake(
                "side_forgotten",
                0.4,
                "**The distance of the pen's plane from axis 1 is forgotten.** Seen from above the arm has a corner: rho is not the "
                "distance from the axis.",
                wrong={"side": 0},
            ),
            mistake(
                "side_added",
                0.5,
                "**A sign is turned under the root.** The distance from axis 1 is the hypotenuse, not a leg.",
                wrong={"sign": 1},
            ),
            mistake(
                "one_offset_only",
                0.6,
                "**Only one of the two lengths along axis 2 is there.** L2 lies on the same line as h2.",
                wrong=[{"side": h2}, {"side": L2}],
            ),
            mistake(
                "arm_forgotten",
                0.4,
                "**The arm L1 is forgotten.** The circle of the pen has its centre on axis 2, not on axis 1.",
                wrong={"out": 0},
            ),
        ),
        draw=point_of_the_surface,
    ),
    Question(
        "pen_robot.circles",
        reference=circles,
        mistakes=(
            mistake(
                "side_forgotten",
                0.5,
                "**These are the two rho, not the radii.** The pen's plane passes axis 1 at a distance.",
                wrong={"side": "none"},
            ),
            mistake(
                "one_offset_only",
                0.6,
                "**Only h2 = {h2} m of the lengths along axis 2 is taken.** L2 lies on the same line.",
                wrong={"side": "h2"},
            ),
            mistake(
                "circles_exchanged",
                0.7,
                "**The two radii are exchanged.** The large one comes first.",
                lambda circles: circles[::-1],
            ),
        ),
        tolerance=1e-4,
    ),
    Question(
        "pen_robot.inverse",
        reference=reached,
        mistakes=(
            mistake(
                "points_behind_missed",
                0.6,
                "**Points behind axis 1 get no solution.** A long pen reaches over the axis: rho may be negative.",
                lambda _: inverse(signs=(1,)),
            ),
            mistake(
                "surface_not_checked",
                0.4,
                "**Your function answers for points that the pen cannot reach.** Three equations, two unknowns: one equation is left over "
                "as a condition. Put every solution into the direct model before you return it.",
                lambda _: inverse(checked=False),
                lambda _: inverse(checked=False, signs=(1,)),
            ),
            mistake(
                "sign_of_the_side",
                0.5,
                "**theta1 is turned the wrong way.** The tip lies to the left of the arm: does the arm point to the right or to the left of "
                "the tip?",
                lambda _: inverse(side=-1),
                lambda _: inverse(side=0),
            ),
            mistake(
                "half_of_the_circle_lost",
                0.5,
                "**phi is right on half of its circle only.** A sine, or a quotient, does not tell the whole angle; you know sine and cosine.",
                lambda _: inverse(angle=from_sine),
                lambda _: inverse(angle=from_quotient),
            ),
        ),
        angles=(0, 1),
        tolerance=1e-5,
        probe=places,
        case=kind_of_place,
        residual=pair_residual,
    ),
    Question(
        "pen_robot.follow",
        reference=follow,
        mistakes=(
            mistake(
                "stops_ignored",
                0.5,
                "**The trace is right, but a joint goes beyond its stop.** Only the sum of theta2 and theta3 is fixed: share it.",
                *shared(shares=(0.0, 1.0)),
            ),
            mistake(
                "heading_of_the_tip",
                0.4,
                "**theta1 is the direction of the tip, which is not the direction of the arm.** The pen's plane passes beside axis 1.",
                *shared(lambda row, point: [np.arctan2(point[1], point[0]), *row[1:]]),
                *shared(lambda row, point: [2 * np.arctan2(point[1], point[0]) - row[0], *row[1:]]),
            ),
            mistake(
                "measured_from_the_horizontal",
                0.4,
                "**phi is counted from the horizontal.** With theta2 = theta3 = 0 the pen stands upright.",
                *shared(lambda row, point: [row[0], np.pi / 2 - row[1] - row[2], 0.0]),
            ),
        ),
        angles=(0, 1, 2),
        tolerance=1e-6,
        probe=curve,
        case=lambda px, py, pz: (
            "the left half of the curve (y > 0)" if py > 0 else "the right half of the curve (y < 0)"
        ),
        residual=trace_residual,
    ),
    Question(
        "pen_robot.readings",
        reference=READINGS,
        mistakes=(
            mistake(
                "sign_of_theta1",
                0.5,
                "**theta1 has the wrong sign.** It is subtracted inside the entry: what must theta2 do to make up for it?",
                substituted({t1: -t1}),
            ),
            mistake(
                "sign_of_the_quarter_turn",
                0.5,
                "**A quarter turn has the wrong sign.** Set the angle of row 2 in your reading equal to the printed one, and solve for theta2.",
                lambda found: [found[0], found[1] - sympy.pi, found[2] + sympy.pi],
                lambda found: [found[0], found[1] - sympy.pi, found[2]],
                lambda found: [found[0], found[1], found[2] + sympy.pi],
            ),
            mistake(
                "offset_left_in_phi",
                0.4,
                "**phi stands for the angle of row 2 plus theta3; it is larger by a quarter turn.** The printed entry is theta2 - pi/2.",
                lambda found: [entry - HALF for entry in found],
            ),
        ),
        angles=(0, 1, 2),
    ),
    Question(
        "pen_robot.repaired",
        reference=REPAIRED,
        mistakes=(
            mistake(
                "link_left_out",
                0.3,
                "**This is the robot as printed.** Now L2 is a link between joints 2 and 3, and moves with theta2.",
                substituted({L2: 0}),
            ),
            mistake(
                "angle_not_summed",
                0.4,
                "**The pen is placed as if theta3 were measured from the vertical.** It goes from link 2 to the pen.",
                lambda _: [
                    L1 + L2 * sympy.sin(t2) + p1 * sympy.sin(t3),
                    h1 + L2 * sympy.cos(t2) + p1 * sympy.cos(t3),
                ],
            ),
            mistake(
                "sine_and_cosine_exchanged",
                0.5,
                "**Sine and cosine are exchanged.** With both angles zero the robot stands upright.",
                substituted({t2: HALF - t2, t3: -t3}),
            ),
        ),
    ),
)
