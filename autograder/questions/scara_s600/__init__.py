"""The Adept s600 tutorial: table, product, misprints, type-8 equation, inverse model, classic table, its cousin."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Family, Follow, Question, following, mistake
from autograder.judge.misconceptions import (
    classic_table,
    columns_exchanged,
    degrees,
    misprint,
    posture_missing,
    product,
    reversed_product,
    rows_shifted,
    symbol_negated,
)
from autograder.reference import robots
from autograder.reference.transforms import modified_dh

t1, t2, r3, t4, d2, d3, r30 = sympy.symbols("t1 t2 r3 t4 d2 d3 r30")
X, Y, Z1, Z2, tj = sympy.symbols("X Y Z1 Z2 tj")

TABLE = robots.ADEPT_S600.table
ROWS = [[row.sigma, *row.parameters] for row in TABLE.rows]
TRANSFORMS = TABLE.transforms()
HAND, T14, *_ = TABLE.recursion()
R30 = -0.05

Z4_IS_DOWN = (
    "**z4 points upwards in this answer.** In the drawing it points against z3: how far must z turn about x3 to get there, "
    "and what does that do to y and z of the hand?"
)
CONSTANT = (
    "**The constant r30 is missing.** The motor's zero is not where O3 meets the arm: two lengths lie along z3. The tutorial "
    "leaves it out in one matrix, too."
)
ANGLES_ADDED = (
    "**t4 is counted like t1 and t2.** It turns about an axis that points the other way: look at the hand from above and "
    "turn it about z4."
)


def z4_up(rows):
    return [*rows[:3], [*rows[3][:2], 0, *rows[3][3:]]]


def without_constant(answer):
    """The answer with r30 = 0."""
    if isinstance(answer, (list, tuple)):
        return [without_constant(item) for item in answer]
    return sympy.sympify(answer).subs(r30, 0)


# ---------------------------------------------------------------- the type-8 equation

B1, B2 = X + Y * sympy.cos(tj), Y * sympy.sin(tj)


def solved(b1, b2):
    """[cos, sin] of the angle that carries (b1, b2) onto (Z1, Z2)."""
    norm = b1**2 + b2**2
    return [(Z1 * b1 + Z2 * b2) / norm, (Z2 * b1 - Z1 * b2) / norm]


def consistent_point(rng: np.random.Generator) -> dict[str, float]:
    """Z1, Z2 and tj that belong to one posture."""
    first, second = rng.uniform(0.3, 1.2, 2)
    angles = rng.uniform(-np.pi, np.pi, 2)
    hand = robots.planar_2r(first, second).forward(angles)[:2, 3]
    return {"X": first, "Y": second, "Z1": hand[0], "Z2": hand[1], "tj": angles[1]}


def blamed(right, wrong):
    """A line number taken for another one."""
    return lambda lines: sorted(wrong if line == right else line for line in lines)


# ---------------------------------------------------------------- the inverse model


@lru_cache(maxsize=1024)
def robot(length2, length3, constant):
    return robots.adept_s600(length2, length3, constant)


def mgi(x, y, z, omega, length2, length3, constant):
    """All (t1, t2, r3, t4) for a pose, a `Family` at the centre of an arm with equal links."""
    found = robot(length2, length3, constant).inverse((x, y, z, omega))
    return Family(at_centre(found.q[0])) if found.status == "infinite" else found.q.tolist()


def at_centre(row, firsts=(0.0, -np.pi / 2, np.pi / 2)):
    """Members of the family of a folded arm, by their t1; the direction of the hand stays."""
    return [[first, row[1], row[2], row[3] + first - row[0]] for first in firsts]


def residual(q, *pose, mine):
    """How far the hand is from the pose, (k,), for joint values (k, 4)."""
    x, y, z, omega, length2, length3, constant = pose or own_pose(mine)
    hands = robot(length2, length3, constant).forward(q)
    turn = np.arctan2(hands[:, 1, 0], hands[:, 0, 0]) - omega
    return np.linalg.norm(hands[:, :3, 3] - (x, y, z), axis=1) + np.abs((turn + np.pi) % (2 * np.pi) - np.pi)


def own_pose(mine):
    return mine["x"], mine["y"], mine["z"], np.radians(mine["omega"]), mine["d2"], mine["d3"], R30


def probes(rng: np.random.Generator) -> list[list[float]]:
    """Poses in all quadrants, on both limits, out of reach, and at the centre of an arm with equal links."""
    found = []
    for quadrant in range(4):
        for _ in range(2):
            l2, l3 = rng.uniform(0.25, 0.5, 2)
            r = abs(l2 - l3) + rng.uniform(0.15, 0.9) * (l2 + l3 - abs(l2 - l3))
            angle = quadrant * np.pi / 2 + rng.uniform(0.1, 1.4)
            found.append([r * np.cos(angle), r * np.sin(angle), *pose_rest(rng), l2, l3, rng.uniform(-0.1, 0.1)])
    found += [[0.0, 0.5, -0.1, np.pi / 2, 0.325, 0.275, -0.05], [-0.4, 0.0, -0.2, 0.0, 0.325, 0.275, 0.0]]
    # Binary fractions: on these limits the elbow cosine is exactly 1 or -1 however it is computed.
    found += [[0.75, 0.0, -0.1, 0.5, 0.5, 0.25, 0.0], [0.0, -0.25, -0.1, 0.5, 0.25, 0.5, -0.05]]
    found += [_rounded_outwards(rng) for _ in range(2)]
    found += [[0.5, 0.4, -0.1, 0.5, 0.325, 0.275, 0.0], [0.02, 0.01, -0.1, 0.5, 0.325, 0.275, 0.0]]
    found += [[0.0, 0.0, -0.15, 0.5, 0.5, 0.5, -0.05]]
    return [[float(value) for value in args] for args in found]


def pose_rest(rng):
    return rng.uniform(-0.3, 0.0), rng.uniform(-3, 3)


def elbow_cosine(x, y, l2, l3) -> float:
    return (x * x + y * y - l2 * l2 - l3 * l3) / (2 * l2 * l3)


def _rounded_outwards(rng: np.random.Generator) -> list[float]:
    """A pose on the outer limit whose elbow cosine comes out some rounding errors above 1."""
    while True:
        l2, l3, angle = rng.uniform(0.3, 0.8), rng.uniform(0.3, 0.8), rng.uniform(0.1, 1.4)
        x, y = (l2 + l3) * np.cos(angle), (l2 + l3) * np.sin(angle)
        if elbow_cosine(x, y, l2, l3) > 1 + 4e-16:
            return [x, y, *pose_rest(rng), l2, l3, -0.05]


def where(x, y, z, omega, l2, l3, constant) -> str:
    """The case a pose belongs to."""
    r = np.hypot(x, y)
    if r < 1e-9 and abs(l2 - l3) < 1e-9:
        return "the centre, with equal links"
    if min(abs(r - l2 - l3), abs(r - abs(l2 - l3))) < 1e-9:
        return "poses on a limit"
    return "poses within reach" if abs(l2 - l3) < r < l2 + l3 else "poses out of reach"


def with_results(change):
    """Steps that change the solutions a function returns for a pose; at the centre it gives one member of the family or another."""

    def step(chosen):
        def mistaken(function, pose):
            found = function(*pose)
            found = found.solutions[chosen] if isinstance(found, Family) else found
            return change(found, *pose)

        return lambda function: lambda *pose: mistaken(function, pose)

    return [step(chosen) for chosen in (slice(0, 1), slice(1, 2), slice(2, 3), slice(1, 3))]


def fails_at_centre(function):
    return _failing(function, lambda *pose: where(*pose).startswith("the centre"))


def fails_by_rounding(function):
    """acos or a root without clipping: no value where rounding has pushed the elbow cosine beyond 1."""
    return _failing(function, lambda x, y, z, omega, l2, l3, constant: 1 < abs(elbow_cosine(x, y, l2, l3)) < 1 + 1e-9)


def _failing(function, when):
    def failing(*pose):
        if when(*pose):
            raise ValueError("math domain error")
        return function(*pose)

    return failing


def one_of_two(which):
    return lambda found, *pose: found if len(found) < 2 or where(*pose).startswith("the centre") else [found[which]]


def with_other_t4(found, *pose):
    return [[*row[:3], -row[3]] for row in found]


def with_constant(factor):
    """r3 = z + factor * r30."""
    return lambda found, *pose: [[*row[:2], pose[2] + factor * pose[6], row[3]] for row in found]


def in_degrees(found, *pose):
    return [[np.degrees(row[0]), np.degrees(row[1]), row[2], np.degrees(row[3])] for row in found]


# ---------------------------------------------------------------- all configurations


@lru_cache(maxsize=256)
def configurations(pose):
    """All (t1, t2, r3, t4) with t4 between -2 pi and 2 pi, posture after posture, the smaller |t4| first."""
    found = []
    for row in mgi(*pose):
        other = row[3] - np.copysign(2 * np.pi, row[3])
        found += [[*row[:3], row[3]], [*row[:3], other]]
    return found


def one_turn(found):
    return found[::2]


# ---------------------------------------------------------------- the classic table

CLASSIC = [[*link, *row[3:]] for link, row in zip([row[1:3] for row in ROWS[1:]] + [[0, 0]], ROWS)]


def turned_over(sign):
    """Half a turn already behind joint 2; the height of row 3 with the given sign."""

    def step(rows):
        second, third = list(rows[1]), list(rows[2])
        second[1], third[1] = sympy.pi, 0
        third[2] = sign * third[2]
        return [rows[0], second, third, rows[3]]

    return step


def links_moved(rows):
    """The columns of the links one row further down than in the classic table of the same rows."""
    links = [[0, 0], *([*row[:2]] for row in rows[:-1])]
    return [[*link, *row[2:]] for link, row in zip(links, rows)]


def constant_missing(share=0.7):
    return mistake("constant_missing", share, CONSTANT, without_constant)


QUESTIONS = (
    Question(
        "scara_s600.table",
        reference=ROWS,
        mistakes=(
            mistake("z4_upwards", 0.6, Z4_IS_DOWN, z4_up),
            constant_missing(),
            classic_table(
                feedback="**This is the classic Denavit-Hartenberg table**, as the simulator lists it. In the modified form row i holds d "
                "and alpha of the link *before* joint i."
            ),
            columns_exchanged(
                "a",
                "d",
                note="d_and_r_exchanged",
                feedback="**The columns d and r are exchanged.** In the letters of Khalil and Kleinfinger d is counted along x, from one "
                "joint axis to the next; r along z.",
            ),
            rows_shifted(
                feedback="**The rows are shifted by one.** Row i leads from frame i-1 to frame i. Frames 0 and 1 share their origin and "
                "their z: what does row 1 hold then, and which joint?"
            ),
        ),
        partial=0.6,
    ),
    Question(
        "scara_s600.T14",
        reference=T14,
        mistakes=(
            mistake("z4_upwards", 0.5, Z4_IS_DOWN, lambda _: product([*TRANSFORMS[1:3], modified_dh(0, 0, 0, t4)])),
            symbol_negated(t4, "angles_added", ANGLES_ADDED),
            constant_missing(),
            reversed_product(*TRANSFORMS[1:]),
        ),
        follows=Follow("scara_s600.table", lambda rows: following.product_of_table(rows[:, 1:])),
    ),
    Question(
        "scara_s600.wrong_cell",
        reference=HAND[1, 0],
        mistakes=(
            misprint(
                sympy.sin(t1) * sympy.cos(t2 - t4) - sympy.cos(t1) * sympy.sin(t2 - t4),
                "with it the first column does not have length 1.",
                share=0.3,
            ),
            mistake(
                "another_cell",
                0.2,
                "**This cell is printed rightly.** Square and add the columns of the printed block: which one has not length 1?",
                lambda cell: HAND[0, 0],
                lambda cell: HAND[1, 1],
            ),
            symbol_negated(t4, "angles_added", ANGLES_ADDED, 0.5),
        ),
    ),
    Question(
        "scara_s600.misprints",
        reference=[2, 4, 7],
        mistakes=(
            mistake(
                "system_blamed",
                0.6,
                "**The system (S1) is not to blame.** The lines behind it use the names in the same way; only one line gives them to the "
                "other expressions.",
                blamed(7, 8),
            ),
            mistake(
                "arctangent_blamed",
                0.6,
                "**The line with atan2 holds.** It has the sign and the square; look for the line where they are missing.",
                blamed(4, 5),
            ),
            mistake(
                "squares_blamed",
                0.6,
                "**The sum of the squares holds.** Write out both squares once; then look at what the bracket is said to be.",
                blamed(2, 1),
            ),
        ),
    ),
    Question(
        "scara_s600.linear",
        reference=solved(B1, B2),
        mistakes=(
            misprint(
                solved(B2, B1),
                "at tj = 0 the hand is X + Y ahead and nothing to the left; with the printed names it is the other way round.",
                share=0.4,
            ),
            mistake(
                "determinant_missing",
                0.5,
                "**Cosine and sine are not divided by the determinant.** Square and add them: is it 1?",
                lambda pair: [entry * (B1**2 + B2**2) for entry in pair],
            ),
            mistake(
                "sign_of_the_sine",
                0.5,
                "**The sine has the wrong sign.** Try tj = 0 with the hand straight above the base.",
                lambda pair: [pair[0], -pair[1]],
            ),
        ),
        draw=consistent_point,
    ),
    Question(
        "scara_s600.mgi",
        reference=mgi,
        mistakes=(
            mistake(
                "one_posture_missing",
                0.5,
                posture_missing().feedback,
                *with_results(one_of_two(0)),
                *with_results(one_of_two(1)),
            ),
            mistake("sign_of_theta4", 0.6, ANGLES_ADDED, *with_results(with_other_t4)),
            mistake(
                "constant_missing",
                0.7,
                "**r30 has the wrong sign, or is missing.** z = r3 + r30: solve it for r3.",
                *with_results(with_constant(0)),
                *with_results(with_constant(1)),
            ),
            mistake(
                "unclipped_acos",
                0.6,
                "**On a limit your function fails.** Rounding pushes a cosine a hair above 1, where no sine is left. What must the cosine "
                "be on the limit?",
                fails_by_rounding,
            ),
            mistake(
                "centre_divides_by_zero",
                0.8,
                "**At the centre of an arm with equal links your function fails.** There B1^2 + B2^2 = 0: atan2 needs no division.",
                fails_at_centre,
            ),
            mistake("degrees", 0.4, degrees().feedback, *with_results(in_degrees), turn=360),
        ),
        angles=(0, 1, 3),
        tolerance=1e-4,
        probe=probes,
        case=where,
        residual=residual,
    ),
    Question(
        "scara_s600.configurations",
        reference=lambda mine: configurations(own_pose(mine)),
        mistakes=(
            mistake(
                "one_turn_only",
                0.5,
                "**These are the configurations of a hand that can make one turn.** Here t4 may go from -2 pi to 2 pi: a whole turn more or "
                "less is another position of the motor.",
                one_turn,
                lambda found: [row for row in found if row[3] > 0],
            ),
            posture_missing((0, 1), (2, 3)),
            mistake("sign_of_theta4", 0.5, ANGLES_ADDED, lambda found: [[*row[:3], -row[3]] for row in found]),
            degrees(0, 1, 3),
        ),
        angles=(0, 1),
        tolerance=1e-3,
        residual=residual,
    ),
    Question(
        "scara_s600.classic",
        reference=CLASSIC,
        mistakes=(
            mistake(
                "modified_table",
                0.3,
                "**This is the modified table.** In the classic form a row holds the joint first and the link *behind* it.",
                links_moved,
            ),
            mistake(
                "links_moved_the_wrong_way",
                0.3,
                "**The links have moved down instead of up.** Row 1 of the classic table holds joint 1 and what lies between axes 1 and 2.",
                lambda rows: links_moved(links_moved(rows)),
            ),
            mistake(
                "axis_3_turned_over",
                0.8,
                "**The right robot, with axis 3 turned over.** The question asks for the axes of the modified table, where axis 3 points up.",
                turned_over(-1),
            ),
            mistake(
                "half_turn_too_early",
                0.4,
                "**The half turn comes one row too early.** Behind it z points down: with this d the hand is above the arm.",
                turned_over(1),
            ),
        ),
    ),
    Question(
        "scara_s600.cousin",
        reference=[-(r3 + r30), -t4],
        mistakes=(
            mistake(
                "sign_of_the_height",
                0.5,
                "**The height has kept its sign.** One of the two documents counts upwards, the other one downwards.",
                lambda pair: [-pair[0], pair[1]],
            ),
            mistake(
                "sign_of_theta4",
                0.5,
                "**The last angle has kept its sign.** The two hands turn about axes that point in opposite directions.",
                lambda pair: [pair[0], -pair[1]],
            ),
            constant_missing(),
        ),
        angles=(1,),
    ),
)
