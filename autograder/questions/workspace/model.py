"""Workspace of the planar and the elbow arm: clouds, areas and limits of the student's own arm, postures within stops."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import sympy

from autograder.reference import robots
from dhkit.geometry import lies_between
from dhkit.planar_arms import places, sliding_limits, stations, walk_of
from dhm.equations import type8
from dhm.workspace import RRArm

t1, t2, t3, L1, L2 = sympy.symbols("t1 t2 t3 L1 L2")
t1i, t1j, t2i, t2j = sympy.symbols("t1i t1j t2i t2j")

# ---------------------------------------------------------------- the point function

HAND = list(robots.PLANAR_2R.table.symbolic_forward()[:2, 3])
POINT = [entry.subs({t1: t1i, t2: t2j}) for entry in HAND]
ABSOLUTE_POINT = [L1 * f(t1i) + L2 * f(t2j) for f in (sympy.cos, sympy.sin)]

# ---------------------------------------------------------------- the student's own arm


def own_arm(mine) -> RRArm:
    """The arm of the student's lengths and ranges."""
    return RRArm(mine.L1, mine.L2, _range(mine.t1_min, mine.t1_max), _range(mine.t2_min, mine.t2_max))


def _range(low, high) -> tuple[float, float]:
    """A range in degrees, in radians."""
    return tuple(np.radians([low, high]))


def cloud(mine, *, shape="grid", side="right", length=True, ranges="own") -> list[list[float]]:
    """Points [x, y] that the student's arm with a slide reaches.

    `shape` may be ``"diagonal"``, both joints in step; the first step after the base may go to the ``"other"`` `side`; the
    `length` may be forgotten, and the `ranges` be those of a joint that turns in ``"full"``.
    """
    limits = sliding_limits(mine)
    steps = walk_of(mine.slider)
    if ranges == "full":
        turning = next(letter for do, letter in steps if do == "turn")
        limits = limits | {turning: (-np.pi, np.pi)}
    if shape == "diagonal":
        values = [np.linspace(*row, 400) for row in limits.values()]
    else:
        values = [grid.ravel() for grid in np.meshgrid(*(np.linspace(*row, 60) for row in limits.values()))]
    known = dict(zip(limits, values), a=mine.a if length else 0.0)
    if side == "other":
        carried = next(letter for do, letter in steps if do != "turn")
        known[carried] = -known[carried]
    return places(mine.slider, known)[0][-1].tolist()


def area(mine, patch="integrated") -> float:
    """Area in square metres that the student's arm with a slide sweeps; `patch` may be the ``"product"`` of the two widths."""
    limits = sliding_limits(mine)
    ranges = {do == "turn": limits[letter] for do, letter in walk_of(mine.slider) if letter in limits}
    (low, high), (inner, outer) = ranges[True], ranges[False]
    boom = mine.slider.startswith("boom")
    if patch == "product":
        return (high - low) * (outer - inner) * (1 if boom else mine.a)
    if boom:  # the patch grows with the rod; how far it stands aside does not matter
        return (high - low) * (outer**2 - inner**2) / 2
    swept = np.sin(high) - np.sin(low) if mine.slider.endswith("ahead") else np.cos(low) - np.cos(high)
    return float(mine.a * (outer - inner) * swept)


def pallet(mine, *, stops=True, corners=True, depth=True) -> list[float]:
    """The least and the greatest distance of the pallet's near edge from the base, so that every place on it is reached.

    The elbow's `stops`, the far `corners`, or the `depth` of the pallet may be overlooked.
    """
    arm = own_arm(mine)
    ends = np.radians([mine.t2_max, mine.t2_min]) if stops else np.array([np.pi, 0.0])
    least, most = np.abs(arm.l1 + arm.l2 * np.exp(1j * ends))
    aside = mine.wide / 2 if corners else 0.0
    return [float(least), float(np.sqrt(most**2 - aside**2) - (mine.deep if depth else 0.0))]


def base(mine, *, hole=True, stops=True, heights=True, left_out="") -> list[float]:
    """The leftmost and the rightmost place on the wall from which the arm reaches all stations.

    Overlooked may be the `hole` about the base, the elbow's `stops`, the `heights` of the stations above the wall, and one
    station, `left_out`.
    """
    arm = own_arm(mine)
    ends = np.radians([mine.t2_max, mine.t2_min]) if stops else np.array([np.pi, 0.0])
    near, far = np.abs(arm.l1 + arm.l2 * np.exp(1j * ends))
    low, high, holes = -np.inf, np.inf, []
    for name, (x, y) in stations(mine).items():
        if name != left_out:
            height = y if heights else 0.0
            wide = np.sqrt(far**2 - height**2)
            low, high = max(low, x - wide), min(high, x + wide)
            holes += [(x, np.sqrt(max(near**2 - height**2, 0.0)))] if hole else []
    for x, half in holes:
        if half and x - half <= low < x + half:
            low = x + half
    return [float(low), float(high)]


def full_turn_area(mine, how="ring") -> float:
    """Area in square metres with a full turn of joint 1, and an elbow that bends both ways.

    `how` may be ``"sheets added"``, ``"across the fold"`` or ``"no stops"``.
    """
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


def holds_zero(low, high) -> bool:
    return lies_between(0, low, high)


def holds_pi(low, high) -> bool:
    return lies_between(np.pi, low, high)


def reach(l1, l2, low, high, *, stretched=holds_zero, folded=holds_pi) -> list[float]:
    """[smallest, largest] distance of the hand for a range of the elbow.

    `stretched` and `folded` say whether a range holds the stretched and the folded arm.
    """
    angles = [low, high] + [0.0] * bool(stretched(low, high)) + [np.pi] * bool(folded(low, high))
    r = np.sqrt(np.maximum(l1**2 + l2**2 + 2 * l1 * l2 * np.cos(angles), 0))
    return [float(r.min()), float(r.max())]


def always(low, high) -> bool:
    return True


def never(low, high) -> bool:
    return False


def draw_ranges(rng: np.random.Generator) -> list[list[float]]:
    """Argument lists (L1, L2, t2_min, t2_max): lengths in both orders, ranges of the elbow with and without its straight angles, round ones too."""
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


def name_range(l1, l2, low, high) -> str:
    """The case a range belongs to, in words."""
    names = [
        name for name, held in (("the stretched arm", holds_zero), ("the folded arm", holds_pi)) if held(low, high)
    ]
    return "ranges with " + (" and ".join(names) or "neither the stretched nor the folded arm")


# ---------------------------------------------------------------- postures within stops


@lru_cache(maxsize=4096)
def _postures(x, y, l1, l2):
    return type8(l1, l2, x, y).listed()


def hold_modulo_turns(q, limits) -> bool:
    return all(lies_between(angle, *row) for angle, row in zip(q, limits))


def hold_as_they_come(q, limits) -> bool:
    """Angles compared without removing full turns."""
    return all(low <= angle <= high for angle, (low, high) in zip(q, limits))


def hold_turns_of(joint: int):
    """Full turns are removed for one joint only, 0 or 1."""
    other = 1 - joint
    return lambda q, limits: lies_between(q[joint], *limits[joint]) and limits[other][0] <= q[other] <= limits[other][1]


def count(
    x, y, lengths, limits, *, allowed=hold_modulo_turns, elbows=slice(None), wrapped=True, needs_first=False
) -> int:
    """How many postures within the stops bring the hand to (x, y).

    `allowed` says whether limits (2, 2) hold two angles, `elbows` which of both postures are seen, in this order. Not
    `wrapped`, theta1 is the difference of two atan2, anywhere in (-2 pi, 2 pi). With `needs_first` the second posture is
    looked at only if the first one is allowed.
    """
    postures = _postures(x, y, *lengths)[elbows]
    if not wrapped:
        postures = [(_theta1(x, y, *lengths, bend), bend) for _, bend in postures]
    held = [bool(allowed(q, limits)) for q in postures]
    return 0 if needs_first and held[:1] != [True] else int(sum(held))


def _theta1(x, y, l1, l2, bend) -> float:
    return np.arctan2(y, x) - np.arctan2(l2 * np.sin(bend), l1 + l2 * np.cos(bend))


def draw_places(rng: np.random.Generator) -> list[list]:
    """Argument lists (x, y, lengths, limits): points that two, one or no posture reaches, well away from every edge."""
    kinds = {
        "two": 5,
        "one elbow 0": 3,
        "one elbow 1": 3,
        "forbidden": 5,
        "beyond": 5,
        "turned joint 0": 3,
        "turned joint 1": 3,
    }
    found = []
    for kind, number in kinds.items():
        while number:
            place = _draw_place(rng, turned=kind)
            if _kind(*place) == kind and _clear_of_edges(*place):
                number -= 1
                found.append(place)
    return found


def _draw_place(rng: np.random.Generator, turned: str) -> list:
    lengths = [float(rng.uniform(0.4, 0.6)), float(rng.uniform(0.2, 0.38))]
    low, bent = rng.uniform(-2.0, -0.5), [-rng.uniform(0.4, 1.6), rng.uniform(1.5, 2.7)]
    if turned == "turned joint 0":
        low = rng.uniform(1.2, 1.9)
    elif turned == "turned joint 1":
        bent = [rng.uniform(1.3, 1.8), rng.uniform(4.4, 4.9)]
    elif rng.random() < 0.5:
        bent = [-bent[1], -bent[0]]
    limits = [[float(value) for value in row] for row in ([low, low + rng.uniform(2.6, 3.3)], bent)]
    r, angle = rng.uniform(0.05, 1.1) * sum(lengths), rng.uniform(-np.pi, np.pi)
    return [float(r * np.cos(angle)), float(r * np.sin(angle)), lengths, limits]


def _kind(x, y, lengths, limits) -> str:
    """Which elbow is the one that is allowed, or which joint needs its full turns removed, beside the case of a place."""
    case = _classify(x, y, lengths, limits)
    if case == "one":
        return f"one elbow {0 if count(x, y, lengths, limits, elbows=slice(0, 1)) else 1}"
    if case == "turned":
        missed = [
            j
            for j in (0, 1)
            if count(x, y, lengths, limits, allowed=hold_turns_of(1 - j)) < count(x, y, lengths, limits)
        ]
        return f"turned joint {missed[0]}" if len(missed) == 1 else "turned"
    return case


def _classify(x, y, lengths, limits) -> str:
    postures, number = _postures(x, y, *lengths), count(x, y, lengths, limits)
    if len(postures) == 0:
        return "beyond"
    if number and number != count(x, y, lengths, limits, allowed=hold_as_they_come):
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


def name_place(x, y, lengths, limits) -> str:
    """The case a point belongs to, in words."""
    return CASES[_classify(x, y, lengths, limits)]


# ---------------------------------------------------------------- the elbow arm

ELBOW_HAND = robots.ELBOW_3R.table.symbolic_forward()[:3, 3].subs(t1, 0)
SECTION = [sympy.simplify(ELBOW_HAND[0]), sympy.simplify(ELBOW_HAND[2])]
ABSOLUTE_SECTION = [L1 * f(t2) + L2 * f(t3) for f in (sympy.cos, sympy.sin)]
