"""Workspace (DH-m slides, Romanian): image of a grid of joint values, limits, area, postures within stops, sections."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    angle_not_summed,
    angles_subtracted,
    misprint,
    option,
    symbols_exchanged,
)
from autograder.reference import robots
from autograder.reference.equations import type8
from autograder.reference.singularities import two_link_determinant
from autograder.reference.workspace import RRArm, planar_points, rr_grid

t1, t2, t3, L1, L2 = sympy.symbols("t1 t2 t3 L1 L2")
t1i, t1j, t2i, t2j = sympy.symbols("t1i t1j t2i t2j")

# ---------------------------------------------------------------- the point function

HAND = list(robots.PLANAR_2R.table.symbolic_forward()[:2, 3])
POINT = [entry.subs({t1: t1i, t2: t2j}) for entry in HAND]


def as_printed(point):
    """The slide: the second length is the first one, the second index too."""
    return [entry.subs({L2: L1, t2j: t2i}) for entry in point]


JACOBIAN = sympy.Matrix(HAND).jacobian([t1, t2])
PRODUCTS_ADDED = JACOBIAN[0, 0] * JACOBIAN[1, 1] + JACOBIAN[0, 1] * JACOBIAN[1, 0]

# ---------------------------------------------------------------- the student's own arm


def own_arm(mine) -> RRArm:
    """The arm of the student's lengths and ranges."""
    return RRArm(mine.L1, mine.L2, _range(mine.t1_min, mine.t1_max), _range(mine.t2_min, mine.t2_max))


def _range(low, high) -> tuple[float, float]:
    """A range in degrees, in radians."""
    return tuple(np.radians([low, high]))


def cloud(mine, shape="grid", ranges="own") -> list[list[float]]:
    """Points of the workspace as rows."""
    arm = own_arm(mine)
    if ranges == "exchanged":
        arm = replace(arm, q1=arm.q2, q2=arm.q1)
    q1, q2 = np.linspace(*arm.q1, 60), np.linspace(*arm.q2, 24)
    if shape == "diagonal":
        together = np.stack([np.linspace(*limits, 400) for limits in (arm.q1, arm.q2)], axis=-1)
        points = planar_points((arm.l1, arm.l2), together)
    elif shape == "absolute":
        first, second = np.meshgrid(q1, q2)
        points = arm.l1 * _direction(first) + arm.l2 * _direction(second)
    else:
        points = rr_grid(arm.l1, arm.l2, q1, q2)
    return points.reshape(-1, 2).tolist()


def _direction(angle):
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def area(mine, turn="own", sheet="integrated") -> float:
    """Area in square metres that the student's arm sweeps with its elbow bent to one side."""
    arm = own_arm(mine)
    low, high = arm.q2
    patch = {"integrated": abs(np.cos(low) - np.cos(high)), "product": high - low}[sheet]
    width = arm.q1[1] - arm.q1[0] if turn == "own" else 2 * np.pi
    return arm.l1 * arm.l2 * width * patch


def full_turn_area(mine, how="ring") -> float:
    """Area with a full turn of joint 1, and an elbow that bends both ways."""
    arm = RRArm(mine.L1, mine.L2, (-np.pi, np.pi), _range(-mine.back, mine.t2_max))
    low, high = arm.q2
    match how:
        case "sheets added":
            return sum(replace(arm, q2=part).area() for part in ((low, 0.0), (0.0, high)))
        case "across the fold":
            return arm.l1 * arm.l2 * 2 * np.pi * abs(np.cos(low) - np.cos(high))
        case "no stops":
            return RRArm(arm.l1, arm.l2).area()
    return arm.area()


# ---------------------------------------------------------------- limits of reach

FAR = 2 * np.pi


def reach(*, stretched=lambda low, high: _holds(0, low, high), folded=lambda low, high: _holds(np.pi, low, high)):
    """A student's reach(L1, L2, t2_min, t2_max); the keywords say when it thinks of the stretched and the folded arm."""

    def limits(l1, l2, low, high):
        angles = [low, high] + [0.0] * bool(stretched(low, high)) + [np.pi] * bool(folded(low, high))
        r = np.sqrt(np.maximum(l1**2 + l2**2 + 2 * l1 * l2 * np.cos(angles), 0))
        return [float(r.min()), float(r.max())]

    return limits


def _holds(angle, low, high):
    """Whether a range holds an angle, modulo full turns."""
    return np.mod(angle - low, FAR) <= high - low


def exact_reach(l1, l2, low, high):
    return list(RRArm(l1, l2, q2=(low, high)).radii())


def ranges(rng: np.random.Generator) -> list[list[float]]:
    """Lengths in both orders, ranges of the elbow with and without its straight angles, round ones too."""
    found = [
        *[(rng.uniform(0.1, 1.2), rng.uniform(1.4, 3.0)) for _ in range(3)],
        *[(-rng.uniform(1.5, 3.0), -rng.uniform(0.1, 1.3)) for _ in range(2)],
        *[(-rng.uniform(0.3, 1.4), rng.uniform(1.5, 2.9)) for _ in range(2)],
        *[(-rng.uniform(1.5, 2.9), rng.uniform(0.3, 1.4)) for _ in range(2)],
        *[(rng.uniform(0.5, 2.5), rng.uniform(3.5, 5.5)) for _ in range(3)],
        *[(rng.uniform(3.4, 5.0), rng.uniform(6.5, 7.5)) for _ in range(2)],
        (-5.0, -2.0),
        (-5.5, 0.5),
        (0.0, np.pi),
        (-np.pi, 0.0),
        (np.pi / 2, np.pi),
        (-np.pi, np.pi),
    ]
    return [
        [float(rng.uniform(0.3, 0.7)), float(rng.uniform(0.2, 0.6)), float(low), float(high)] for low, high in found
    ]


def kind_of_range(l1, l2, low, high) -> str:
    names = [
        name for angle, name in ((0.0, "the stretched arm"), (np.pi, "the folded arm")) if _holds(angle, low, high)
    ]
    return "ranges with " + (" and ".join(names) or "neither the stretched nor the folded arm")


# ---------------------------------------------------------------- postures within stops


@lru_cache(maxsize=4096)
def _postures(x, y, l1, l2):
    return type8(l1, l2, x, y).listed()


def count(*, allowed=None, elbows=slice(None)):
    """A student's count(x, y, lengths, limits); `allowed` says which angles a range holds, `elbows` which postures it sees."""
    allowed = allowed or (lambda q, limits: all(_holds(angle, *row) for angle, row in zip(q, limits)))

    def number(x, y, lengths, limits):
        return int(sum(bool(allowed(q, limits)) for q in _postures(x, y, *lengths)[elbows]))

    return number


def without_turns(q, limits):
    """Angles compared as they come, in (-pi, pi]."""
    return all(low <= angle <= high for angle, (low, high) in zip(q, limits))


def raw_count(x, y, lengths, limits):
    """As `without_turns`, but theta1 as the difference of two atan2 comes: anywhere in (-2 pi, 2 pi)."""
    found = 0
    for _, bend in _postures(x, y, *lengths):
        first = np.arctan2(y, x) - np.arctan2(lengths[1] * np.sin(bend), lengths[0] + lengths[1] * np.cos(bend))
        found += without_turns((first, bend), limits)
    return found


def places(rng: np.random.Generator) -> list[list]:
    """Points that two, one or no posture reaches, well away from every edge."""
    wanted = dict.fromkeys(("two", "one", "forbidden", "beyond"), 5) | {"turned": 5}
    found = []
    while any(wanted.values()):
        lengths = [float(rng.uniform(0.4, 0.6)), float(rng.uniform(0.2, 0.38))]
        turned = rng.random() < 0.3
        low = rng.uniform(1.2, 1.9) if turned else rng.uniform(-2.0, -0.5)
        limits = [[low, low + rng.uniform(2.6, 3.3)], [-rng.uniform(0.4, 1.6), rng.uniform(1.5, 2.7)]]
        limits = [[float(value) for value in row] for row in limits]
        r, angle = rng.uniform(0.05, 1.1) * sum(lengths), rng.uniform(-np.pi, np.pi)
        x, y = float(r * np.cos(angle)), float(r * np.sin(angle))
        name = _where(x, y, lengths, limits)
        if wanted.get(name) and _clear_of_edges(x, y, lengths, limits):
            wanted[name] -= 1
            found.append([x, y, lengths, limits])
    return found


def _where(x, y, lengths, limits) -> str:
    postures, number = _postures(x, y, *lengths), count()(x, y, lengths, limits)
    if len(postures) == 0:
        return "beyond"
    if number and number != count(allowed=without_turns)(x, y, lengths, limits):
        return "turned"
    return ("forbidden", "one", "two")[number]


def _clear_of_edges(x, y, lengths, limits, room=0.03) -> bool:
    r = np.hypot(x, y)
    if min(abs(r - sum(lengths)), abs(r - abs(lengths[0] - lengths[1]))) < room:
        return False
    gaps = [
        np.angle(np.exp(1j * (q[k] - edge))) for q in _postures(x, y, *lengths) for k in (0, 1) for edge in limits[k]
    ]
    return not gaps or min(map(abs, gaps)) > room


CASES = {
    "two": "points that both postures reach",
    "one": "points that one posture reaches",
    "forbidden": "points that only the stops forbid",
    "beyond": "points out of reach",
    "turned": "ranges that go beyond a half turn",
}


def kind_of_place(x, y, lengths, limits) -> str:
    return CASES[_where(x, y, lengths, limits)]


# ---------------------------------------------------------------- the elbow arm

ELBOW_HAND = robots.ELBOW_3R.table.symbolic_forward()[:3, 3].subs(t1, 0)
SECTION = [sympy.simplify(ELBOW_HAND[0]), sympy.simplify(ELBOW_HAND[2])]


QUESTIONS = (
    Question(
        "workspace.point",
        reference=POINT,
        mistakes=(
            misprint(
                as_printed,
                "with one index for both joints only a curve is drawn, and the forearm has its own length.",
                share=0.2,
            ),
            mistake(
                "one_index_for_both_joints",
                0.5,
                "**Both joints still share one index.** With n values each, your function gives n points on a curve; all pairs "
                "are wanted.",
                lambda point: [entry.subs(t2j, t2i) for entry in point],
                lambda point: [entry.subs(t1i, t1j) for entry in point],
            ),
            mistake(
                "second_length_not_repaired",
                0.5,
                "**The forearm still has the length of the upper arm.** The next page of the slides speaks of two lengths.",
                lambda point: [entry.subs(L2, L1) for entry in point],
            ),
            angle_not_summed([L1 * f(t1i) + L2 * f(t2j) for f in (sympy.cos, sympy.sin)]),
        ),
    ),
    Question(
        "workspace.cloud",
        reference=cloud,
        mistakes=(
            mistake(
                "one_index_for_both_joints",
                0.3,
                "**Your points lie on one curve.** Both joints march in step; take every value of joint 2 for every value of "
                "joint 1.",
                wrong={"shape": "diagonal"},
            ),
            mistake(
                "ranges_exchanged",
                0.4,
                "**Each joint has the other's range.** Joint 1 goes from {t1_min} to {t1_max} degrees.",
                wrong={"ranges": "exchanged"},
            ),
            mistake(
                "angle_not_summed",
                0.3,
                "**The forearm is drawn as if theta2 were measured from the x axis.** It goes from the upper arm to the forearm.",
                wrong={"shape": "absolute"},
            ),
        ),
        tolerance=0.04,
    ),
    Question(
        "workspace.reach",
        reference=exact_reach,
        mistakes=(
            mistake(
                "ends_of_the_range_only",
                0.4,
                "**Only the ends of the range are looked at.** Between them the arm may pass through a posture that is longer, or "
                "shorter, than both.",
                lambda _: reach(stretched=lambda *_: False, folded=lambda *_: False),
            ),
            mistake(
                "folded_arm_forgotten",
                0.6,
                "**The folded arm is forgotten.** The stretched one is there; what is the shortest arm, and when does the range hold it?",
                lambda _: reach(folded=lambda *_: False),
            ),
            mistake(
                "a_turn_further_forgotten",
                0.7,
                "**A range may hold the straight arm a turn further on.** 2 pi is as good as 0, and -pi as pi.",
                lambda _: reach(
                    stretched=lambda low, high: low <= 0 <= high, folded=lambda low, high: low <= np.pi <= high
                ),
                lambda _: reach(
                    stretched=lambda low, high: low <= 0 <= high,
                    folded=lambda low, high: low <= np.pi <= high or low <= -np.pi <= high,
                ),
            ),
            mistake(
                "stops_ignored",
                0.3,
                "**This is the reach without stops.** The elbow cannot always be straight.",
                lambda _: reach(stretched=lambda *_: True, folded=lambda *_: True),
            ),
        ),
        probe=ranges,
        case=kind_of_range,
    ),
    Question(
        "workspace.det",
        reference=two_link_determinant(L1, L2, t2),
        mistakes=(
            mistake(
                "columns_exchanged",
                0.6,
                "**The sign is turned: rows or columns of the Jacobian are exchanged.** Rows x, y; columns t1, t2.",
                lambda det: -det,
            ),
            mistake(
                "angle_not_summed",
                0.4,
                "**This is the determinant of an arm whose angles are both measured from the x axis.** A turn of joint 1 takes the "
                "forearm along: differentiate x and y once more by t1.",
                lambda det: det.subs(t2, t2 - t1),
            ),
            mistake(
                "permanent_for_determinant",
                0.4,
                "**The two products are added.** A determinant is a difference: does yours vanish for the stretched arm?",
                lambda _: PRODUCTS_ADDED,
            ),
        ),
    ),
    Question(
        "workspace.area",
        reference=area,
        mistakes=(
            mistake(
                "degrees",
                0.5,
                "**The width of the range of theta1 is in degrees.** An arc has the length r times the angle in radians.",
                np.degrees,
            ),
            mistake(
                "full_turn",
                0.5,
                "**This is the area for a full turn of joint 1.** Its range is narrower.",
                wrong={"turn": "full"},
            ),
            mistake(
                "sine_not_integrated",
                0.3,
                "**The patches do not all have the same size.** You multiplied the two widths; the determinant depends on theta2 and "
                "must be integrated.",
                wrong={"sheet": "product"},
            ),
        ),
        tolerance=5e-4,
    ),
    Question(
        "workspace.full_turn",
        reference=full_turn_area,
        mistakes=(
            mistake(
                "sheets_added",
                0.4,
                "**The areas of the two sheets are added.** Where they lie on each other a point counts once.",
                wrong={"how": "sheets added"},
            ),
            mistake(
                "formula_across_the_fold",
                0.3,
                "**The formula for one sheet was used across the stretched arm.** There the sine of theta2 changes its sign: the patches "
                "of one side were subtracted from those of the other.",
                wrong={"how": "across the fold"},
            ),
            mistake(
                "stops_ignored",
                0.4,
                "**This is the ring without stops.** Your elbow cannot be folded: what is its smallest distance from the base?",
                wrong={"how": "no stops"},
            ),
        ),
        tolerance=5e-4,
    ),
    Question(
        "workspace.count",
        reference=count(),
        mistakes=(
            mistake(
                "stops_ignored",
                0.3,
                "**The stops are not looked at.** These are the postures of an arm without limits.",
                lambda _: count(allowed=lambda q, limits: True),
            ),
            mistake(
                "only_the_elbow_has_stops",
                0.5,
                "**Only the stop of joint 2 is looked at.** Each posture needs a theta1 that joint 1 can take.",
                lambda _: count(allowed=lambda q, limits: _holds(q[1], *limits[1])),
            ),
            mistake(
                "one_posture_missing",
                0.5,
                "**You count one sense of the elbow only.** A cosine alone does not tell the sign of its angle.",
                lambda _: count(elbows=slice(0, 1)),
                lambda _: count(elbows=slice(1, 2)),
            ),
            mistake(
                "turns_not_removed",
                0.6,
                "**Angles are compared without removing full turns.** Where the range goes beyond a half turn, -100 degrees and 260 "
                "degrees are one direction.",
                lambda _: count(allowed=without_turns),
                lambda _: raw_count,
            ),
        ),
        probe=places,
        case=kind_of_place,
    ),
    Question(
        "workspace.section",
        reference=SECTION,
        mistakes=(
            angle_not_summed([L1 * f(t2) + L2 * f(t3) for f in (sympy.cos, sympy.sin)]),
            angles_subtracted(t3),
            mistake(
                "rho_and_z_exchanged",
                0.5,
                "**Distance and height are exchanged.** With t2 = 0 the upper arm is horizontal.",
                lambda section: section[::-1],
            ),
            symbols_exchanged(
                L1, L2, "lengths_exchanged", "**The two lengths are exchanged.** L1 is the upper arm, next to the base."
            ),
        ),
    ),
    Question(
        "workspace.aspects",
        reference="C",
        mistakes=(
            option(
                "A",
                "singularities_not_seen",
                "**The arm cannot go everywhere without a singular posture.** Find the factors of its determinant.",
            ),
            option(
                "B",
                "one_factor_only",
                "**You see one singular posture of two.** The straight elbow is one; what happens when the hand comes onto axis 1?",
            ),
            option(
                "D",
                "lengths_counted_as_factor",
                "**One factor too many.** A factor that never changes its sign cuts nothing; this arm has no wrist.",
            ),
        ),
    ),
)
