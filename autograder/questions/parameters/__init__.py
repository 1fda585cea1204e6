"""Parameter rules (MECA 953 slides): axes, common normals, frames, the four parameters and their signs."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.chain import Freedom
from autograder.judge.misconceptions import (
    degrees,
    degrees_in_table,
    option,
    transposed_rotation,
)
from autograder.reference import robots
from autograder.reference.lines import link, link_frame
from dhkit.geometry import common_normal, link_axis


class Found(list):
    """A vector that knows the scene it was found in: `scene` maps names to what a wrong step may take instead."""

    def __init__(self, values, **scene):
        super().__init__(tidy(values).tolist())
        self.scene = scene


def instead(name):
    """A step that takes another part of the scene for the answer."""
    return lambda found: np.asarray(found.scene[name], dtype=float).tolist()


def tidy(values):
    """Without rounding noise, and with exact zeros and ones."""
    return np.vectorize(
        lambda value: round(value) if abs(value - round(value)) < 1e-12 else float(value), otypes=[object]
    )(np.round(np.asarray(values, dtype=float), 14))


def with_entry(index, change):
    """A step that changes one entry; `change` takes the entry and the scene."""
    return lambda found: Found([*found[:index], change(found[index], found.scene), *found[index + 1 :]], **found.scene)


# ---------------------------------------------------------------- two frames to read


def reading(mine):
    return [mine.reach, -np.radians(mine.tilt), -mine.drop, np.radians(mine.turn)]


def negated(*places):
    return lambda values: [-value if i in places else value for i, value in enumerate(values)]


def exchanged(first, second):
    order = {first: second, second: first}
    return lambda values: [values[order.get(i, i)] for i in range(len(values))]


# ---------------------------------------------------------------- two skew axes


def skew_axes(mine):
    first = np.array([mine.px, 0.1, 0.9]), np.array([0.0, 0, 1])
    second = np.array([mine.qx, mine.qy, mine.qz]), np.array([1.0, mine.m, mine.w])
    return first, second


def origin(mine):
    first, second = skew_axes(mine)
    feet, (p, u), (q, _) = common_normal(first, second).feet, first, second
    return Found(feet[0], other_foot=feet[1], joint=p, dropped=p + ((q - p) @ u) * u, middle=feet.mean(axis=0))


def x_axis(mine):
    first, second = skew_axes(mine)
    feet, (p, u), (q, v) = common_normal(first, second).feet, first, second
    return Found(
        link_axis(first, second), wedge=np.cross(u, v), normal=feet[1] - feet[0], joints=(q - p) / np.linalg.norm(q - p)
    )


def reversed_vector(found):
    return [-value for value in found]


# ---------------------------------------------------------------- parallel axes

JOINTS_AT = 0.20, 0.35  # heights of joints 1 and 2


def parallel(mine):
    up, (low, high) = [0, 0, 1], JOINTS_AT
    first, second = ([0, 0, low], up), ([mine.gap, mine.side, high], up)
    return Found(
        [link(first, second)[0], mine.height],
        straight=np.linalg.norm(np.subtract(second[0], first[0])),
        coordinates=(mine.gap, mine.side, mine.gap + mine.side),
        rise=mine.height - low,
    )


# ---------------------------------------------------------------- axes that meet, and a gripper


def meeting_axes(mine):
    along = np.array([mine.lean, 2.0, 4.0])
    return ([mine.cx, 0, 0.5], [0, 1, 0]), (np.array([mine.cx, mine.cy, 0.5]) + 0.1 * along, along)


def frame(mine):
    return sympy.Matrix(tidy(link_frame(*meeting_axes(mine))))


def gripper(mine):
    yaw = np.radians(mine.yaw)
    z, y = np.array([np.cos(yaw), np.sin(yaw), 0]), np.array([0, 0, 1.0])
    found = np.eye(4)
    found[:3] = np.column_stack([np.cross(y, z), y, z, [0.6, mine.shelf, 0.8]])
    return sympy.Matrix(tidy(found))


def turned(*columns):
    """A step that gives a frame other axes: each of `columns` is (column, sign) of the right one, for X, Y and Z."""

    def step(matrix):
        matrix = sympy.Matrix(matrix)
        axes = [sign * matrix[:3, column] for column, sign in columns]
        return sympy.Matrix.hstack(*axes, matrix[:3, 3]).col_join(matrix[3, :])

    return step


def at_joint(matrix):
    """The origin on the point by which Z_1 was given."""
    matrix = sympy.Matrix(matrix).copy()
    matrix[1, 3] = 0
    return matrix


def yaw_in_degrees(matrix):
    """The angle of the shelf taken as radians; only where the jaws still stand upright and the hand still goes forward."""
    matrix = sympy.Matrix(matrix).copy()
    if abs(matrix[2, 1]) != 1 or not matrix[0, 2] > 0:
        raise ValueError("another mistake has moved the axes")
    yaw = float(sympy.atan2(matrix[1, 2], matrix[0, 2]))
    more = np.degrees(yaw) - yaw
    c, s = np.cos(more), np.sin(more)
    matrix[:3, :3] = sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]]) * matrix[:3, :3]
    return matrix


# ---------------------------------------------------------------- the RX-90 rewritten

PRINTED = [[row.sigma, *row.parameters] for row in robots.RX90.table.rows]
HALF_TURNS = (0, 0, 1, 1, 1, 1)
FLIPPED = [
    [sigma, a, sympy.Abs(alpha), d, theta + half * sympy.pi]
    for (sigma, a, alpha, d, theta), half in zip(PRINTED, HALF_TURNS)
]


def without_half_turns(*rows):
    """A step that leaves out the half turn in the theta of these rows."""

    def step(table):
        return [[*row[:4], row[4] - (sympy.pi if i in rows else 0)] for i, row in enumerate(table, start=1)]

    return step


# ---------------------------------------------------------------- a and alpha of any two axes


def link_of(P, u, Q, v):
    return list(link((P, u), (Q, v)))


def group(P, u, Q, v):
    if np.linalg.norm(np.cross(u, v)) < 1e-9:
        return "parallel axes"
    return "axes that meet" if link_of(P, u, Q, v)[0] < 1e-9 else "skew axes"


def probes(rng):
    """Pairs of axes: skew ones with twists of both signs, parallel ones of both senses, ones that meet."""
    vector = lambda: rng.uniform(-1, 1, 3)  # noqa: E731
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
    return [[np.asarray(part, dtype=float).tolist() for part in pair] for pair in pairs]


def unit(vector):
    return np.asarray(vector, dtype=float) / np.linalg.norm(vector)


def only_skew_and_meeting(function):
    """Divides by the length of the cross product, whatever it is."""

    def restricted(P, u, Q, v):
        if np.linalg.norm(np.cross(unit(u), unit(v))) < 1e-9:
            raise ZeroDivisionError("the axes are parallel")
        return function(P, u, Q, v)

    return restricted


def between_joints(function):
    return lambda P, u, Q, v: [float(np.linalg.norm(np.subtract(Q, P))), function(P, u, Q, v)[1]]


def along_unscaled_normal(function):
    """The projection on u x v, not divided by its length."""

    def scaled(P, u, Q, v):
        a, alpha = function(P, u, Q, v)
        size = np.linalg.norm(np.cross(u, v))
        return [a * (size if size > 1e-9 else 1), alpha]

    return scaled


# ---------------------------------------------------------------- questions

LEFT_HANDED = mistake(
    "left_handed_frame",
    0.5,
    "**Your frame is left-handed.** The order of a cross product matters: turned round, it gives the opposite axis. Use the right "
    "hand: X along the thumb, Y along the index finger, Z along the middle finger.",
    turned((0, -1), (1, 1), (2, 1)),
    turned((0, 1), (1, -1), (2, 1)),
)

QUESTIONS = (
    Question(
        "parameters.variable",
        reference="C",
        mistakes=(
            option(
                "A",
                "slide_believed",
                "**The printed line cannot stand.** Take the quill of the SCARA: which of its four numbers changes when it goes down? "
                "The page on joint variables, a little earlier in the same slides, has it right.",
            ),
            option(
                "B",
                "revolute_line_doubted",
                "**The line for revolute joints is right.** A revolute joint turns about Z_i, and the angle about Z_i is counted from X_(i-1) "
                "to X_i. Look at the other line.",
            ),
            option(
                "D",
                "twist_taken_for_variable",
                "**alpha belongs to a link**: it is the angle between two axes that are cast into the same piece of metal. No motor "
                "changes it.",
            ),
        ),
    ),
    Question(
        "parameters.reading",
        reference=reading,
        mistakes=(
            mistake(
                "signs_dropped",
                0.4,
                "**Signs are missing.** All four parameters are counted along or about an arrow, and may be negative: which walk goes against "
                "its arrow, which turn looks clockwise when the arrow points at your eye?",
                lambda values: [abs(value) for value in values],
            ),
            mistake(
                "sign_turned",
                0.7,
                "**One sign is turned.** Go through the four sentences once more: with the arrow of the guide or against it? Right hand, thumb along the "
                "guide: do the fingers curl from the first axis to the second, or the other way?",
                negated(1),
                negated(2),
                negated(3),
                negated(0),
            ),
            mistake(
                "alpha_and_theta_exchanged",
                0.3,
                "**alpha and theta are exchanged.** alpha1 compares two Z axes, about X1; theta2 compares two X axes, about Z2.",
                exchanged(1, 3),
            ),
            degrees(1, 3, share=0.5),
        ),
        angles=(1, 3),
        tolerance=1e-3,
    ),
    Question(
        "parameters.origin",
        reference=origin,
        mistakes=(
            mistake(
                "other_foot",
                0.5,
                "**This is the foot on the other axis.** The common normal meets both axes; O1 belongs to link 1 and lies on Z1.",
                instead("other_foot"),
            ),
            mistake(
                "origin_at_joint",
                0.2,
                "**This is the point by which Z1 was given.** The origin is not where the joint sits, it is where the common normal "
                "of Z1 and Z2 leaves Z1. See the section on common mistakes of the lecture.",
                instead("joint"),
            ),
            mistake(
                "perpendicular_from_joint",
                0.3,
                "**You dropped a perpendicular from joint 2 onto Z1.** It meets Z1 at a right angle, but not Z2: the common normal is "
                "perpendicular to both.",
                instead("dropped"),
            ),
            mistake(
                "middle_of_normal",
                0.3,
                "**This is the middle of the common normal.** It is the right line; the origin is where this line meets Z1.",
                instead("middle"),
            ),
        ),
        partial=0.3,
        tolerance=1e-3,
    ),
    Question(
        "parameters.x_axis",
        reference=x_axis,
        mistakes=(
            mistake(
                "wedge_for_normal",
                0.4,
                "**This is Z1 x Z2, or its direction, and here it leads away from Z2.** The printed rule gives sin(alpha1) X1: what is its sense when "
                "alpha1 is negative? X1 leads from Z1 to Z2.",
                reversed_vector,
                instead("wedge"),
            ),
            mistake(
                "not_a_unit_vector",
                0.7,
                "**Right line, right sense, but not of length 1.** An axis of a frame is a unit vector.",
                instead("normal"),
            ),
            mistake(
                "along_the_metal",
                0.2,
                "**This leads from joint to joint, along the metal.** X1 is perpendicular to both axes: test it with two dot products.",
                instead("joints"),
            ),
        ),
        partial=0.0,
        tolerance=1e-3,
    ),
    Question(
        "parameters.parallel",
        reference=parallel,
        mistakes=(
            mistake(
                "hypotenuse_for_length",
                0.5,
                "**a1 is not the distance of the two joints.** It is the distance of two vertical lines: seen from above, {gap} m one way and "
                "{side} m the other count, and the heights of the joints do not.",
                with_entry(0, lambda a, scene: scene["straight"]),
            ),
            mistake(
                "one_coordinate_only",
                0.4,
                "**a1 is not a coordinate, nor their sum.** Seen from above, Z1 and Z2 are two points: how far apart are they in a straight line?",
                *(with_entry(0, lambda a, scene, k=k: scene["coordinates"][k]) for k in range(3)),
            ),
            mistake(
                "origin_at_joint",
                0.5,
                "**With this height d2 does not vanish.** You put O1 where a joint sits. O1 is free along Z1; the question asks for the one place "
                "that makes d2 = 0.",
                *(with_entry(1, lambda z, scene, height=height: height) for height in JOINTS_AT),
            ),
            mistake(
                "height_above_joint",
                0.6,
                "**z1 is counted from joint 1.** The question asks for the coordinate of O1, from the floor.",
                with_entry(1, lambda z, scene: scene["rise"]),
            ),
        ),
        tolerance=1e-3,
    ),
    Question(
        "parameters.frame",
        reference=frame,
        mistakes=(
            mistake(
                "alpha_negative",
                0.6,
                "**X1 points the other way.** Both senses obey the rule for axes that meet, but the question asks for the one with a positive alpha1: "
                "right hand, thumb along X1, and the fingers must curl from Z1 to Z2.",
                turned((0, -1), (1, -1), (2, 1)),
            ),
            mistake(
                "origin_at_joint",
                0.5,
                "**O1 is not where the two axes meet.** You took the point by which Z1 was given. Where is the point that lies on both lines?",
                at_joint,
            ),
            LEFT_HANDED,
            transposed_rotation(),
        ),
        tolerance=1e-3,
    ),
    Question(
        "parameters.flip",
        reference=FLIPPED,
        mistakes=(
            mistake(
                "not_rewritten",
                0.0,
                "**This is the table as it was.** Two of its twists are negative; the question asks for a table of the same robot without a "
                "negative twist.",
                lambda _: PRINTED,
            ),
            mistake(
                "half_turn_forgotten",
                0.3,
                "**You changed the twists and nothing else: that is another robot.** With X_i turned around, the angles before and after it are "
                "counted from or to another arrow. Compare the two drawings.",
                without_half_turns(3, 4, 5, 6),
            ),
            mistake(
                "half_turn_on_one_side",
                0.5,
                "**The half turn is put in, but not taken out again.** An X that is turned around ends the angle of its own row and "
                "begins the angle of the next row.",
                without_half_turns(4, 6),
                without_half_turns(3, 5),
                without_half_turns(3, 4),
                without_half_turns(5, 6),
            ),
            degrees_in_table(),
        ),
        pinned=frozenset(Freedom),
    ),
    Question(
        "parameters.gripper",
        reference=gripper,
        mistakes=(
            mistake(
                "approach_reversed",
                0.5,
                "**Z_E points back at the arm.** It points the way the hand moves towards the book.",
                turned((0, -1), (1, 1), (2, -1)),
            ),
            mistake(
                "jaws_and_approach_exchanged",
                0.4,
                "**Y_E and Z_E are exchanged.** Z_E is the way of the hand, Y_E the way of the jaws.",
                turned((0, -1), (2, 1), (1, 1)),
                turned((0, 1), (2, 1), (1, 1)),
            ),
            LEFT_HANDED,
            mistake(
                "degrees",
                0.5,
                "**The angle went into cos and sin in degrees.** numpy and sympy count in radians.",
                yaw_in_degrees,
            ),
        ),
        tolerance=1e-3,
    ),
    Question(
        "parameters.link",
        reference=link_of,
        mistakes=(
            mistake(
                "alpha_without_sign",
                0.5,
                "**alpha has lost its sign.** arccos, and the turn about u x v, only know the size of an angle. X leads from the first axis to the "
                "second: about *this* X the turn may be negative.",
                lambda function: lambda P, u, Q, v: [function(P, u, Q, v)[0], abs(function(P, u, Q, v)[1])],
            ),
            mistake(
                "parallel_axes_forgotten",
                0.6,
                "**Parallel axes make your function fail.** u x v is zero there and has no direction. What is the distance of two parallel "
                "lines?",
                only_skew_and_meeting,
            ),
            mistake(
                "distance_of_the_points",
                0.3,
                "**a is the distance of the two points.** It is the distance of the two lines, and must not change when a point slides along its line.",
                between_joints,
            ),
            mistake(
                "normal_not_scaled",
                0.5,
                "**a changes with the lengths of u and v.** Divide the cross product by its length before you measure along it.",
                along_unscaled_normal,
            ),
        ),
        probe=probes,
        case=group,
        angles=(1,),
        tolerance=1e-6,
    ),
)
