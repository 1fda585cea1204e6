"""Orientation (EPFL and MECA 953 slides): Euler sets, roll-pitch-yaw, wrists, both triples, gimbal lock."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Family, Question, mistake
from autograder.judge.misconceptions import (
    atan2_arguments_exchanged,
    atan_for_atan2,
    degrees,
    extrinsic_for_intrinsic,
    lock_not_switched,
    misprint,
    one_triple_only,
    option,
    symbol_negated,
    symbols_exchanged,
    transposed_rotation,
)
from autograder.reference.orientation import (
    euler_angles,
    euler_matrix,
    rpy,
    rpy_matrix,
)
from dhkit.geometry import rotation, rotation_angle_between

phi, theta, psi, e = sympy.symbols("phi theta psi e")
R = sympy.Matrix(3, 3, lambda i, j: sympy.Symbol(f"r{i + 1}{j + 1}"))


def turn(axis: str, angle) -> sympy.Matrix:
    """Elementary rotation about a coordinate axis."""
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    matrix = sympy.eye(3)
    matrix[j, j] = matrix[k, k] = sympy.cos(angle)
    matrix[k, j], matrix[j, k] = sympy.sin(angle), -sympy.sin(angle)
    return matrix


def turns(axes: str, *angles) -> sympy.Matrix:
    """Rotation of three angles about moving axes."""
    first, second, third = map(turn, axes, angles)
    return first * second * third


QUADRANT_LOST = (
    "**atan loses the quadrant.** A quotient cannot tell an angle from the one half a turn further; a function of two "
    "arguments can."
)

# ---------------------------------------------------------------- roll, pitch, yaw

RPY = turns("zyx", psi, theta, phi)
ENTRIES = [RPY[1, 1], RPY[1, 2]]
REVERSED_RPY = turns("xyz", phi, theta, psi)
GYROSCOPE = turns("zxz", psi, theta, phi)


def orientation(mine) -> np.ndarray:
    """The orientation of the student's own top."""
    return euler_matrix(np.radians([mine.precession, mine.nutation, mine.spin]), "zxz", intrinsic=True)


def both_rpy(mine) -> list:
    return rpy(orientation(mine)).angles.tolist()


def rpy_residual(q, mine):
    return rotation_angle_between(rpy_matrix(*q.T), orientation(mine))


def sign_in_the_pitch_only(found):
    """As printed: the second triple has another pitch, and roll and yaw of the first one."""
    first = found[0]
    return [first, [first[0], np.pi - first[1], first[2]]]


# The top spins on by 30 degrees; the notebook says so.
FORTH, BACK = rotation("z", np.radians(30)), rotation("z", np.radians(-30))


def spun(mine) -> list:
    """One triple (roll, pitch, yaw) of the student's top, turned about its own axle."""
    return rpy(orientation(mine) @ FORTH).angles[0].tolist()


def read_from(change):
    """A step on a triple (roll, pitch, yaw): `change` takes its rotation matrix, and the triple is read from the result."""
    return lambda angles: rpy(change(rpy_matrix(*angles))).angles[0].tolist()


def roll_grows(angles):
    """30 degrees are added to the roll of the top as it was before."""
    roll, pitch, yaw = rpy(rpy_matrix(*angles) @ BACK).angles[0]
    return [roll + np.radians(30), pitch, yaw]


def locked(rng: np.random.Generator) -> dict[str, float]:
    """The four entries at a pitch of 90 degrees."""
    matrix = rpy_matrix(rng.uniform(-3, 3), np.pi / 2, rng.uniform(-3, 3))
    return {f"r{i + 1}{j + 1}": matrix[i, j] for i in (0, 1) for j in (1, 2)}


LEFT_AT_LOCK = sympy.atan2(-R[0, 1], R[1, 1])

# ---------------------------------------------------------------- any wrist, by its letters


def wrist_angles(axes: str) -> list:
    """[first, middle, third] for a set of moving axes, in the entries of R and the sign e of the root."""
    i, j, k = ("xyz".index(axis) for axis in axes)
    m = 3 - i - j
    s = 1 if (j - i) % 3 == 1 else -1
    if i == k:
        root = sympy.sqrt(R[j, i] ** 2 + R[m, i] ** 2)
        return [
            sympy.atan2(e * R[j, i], -s * e * R[m, i]),
            sympy.atan2(e * root, R[i, i]),
            sympy.atan2(e * R[i, j], s * e * R[i, m]),
        ]
    root = sympy.sqrt(R[j, k] ** 2 + R[k, k] ** 2)
    return [
        sympy.atan2(-s * e * R[j, k], e * R[k, k]),
        sympy.atan2(s * R[i, k], e * root),
        sympy.atan2(-s * e * R[i, j], e * R[i, i]),
    ]


def rotation_and_sign(rng: np.random.Generator) -> dict[str, float]:
    """The entries of a rotation, far from the locks of every set, and a sign."""
    while True:
        matrix = euler_matrix(rng.uniform(-np.pi, np.pi, 3), "zyx", intrinsic=True)
        if np.abs(matrix).max() < 0.95:
            break
    found = {f"r{i + 1}{j + 1}": matrix[i, j] for i in range(3) for j in range(3)}
    return found | {"e": rng.choice([-1.0, 1.0])}


def in_each(change):
    """A step on every entry of a vector."""
    return lambda answer: [change(sympy.sympify(entry)) for entry in answer]


def on_each_atan2(about, *places):
    """The mistake about atan2, made in the entries at `places`."""

    def step(answer):
        return [about.steps[0](entry) if place in places else entry for place, entry in enumerate(answer)]

    return step


OUTER, ALL = (0, 2), (0, 1, 2)

# ---------------------------------------------------------------- the spherical wrist as a function


def zyz(rows):
    """All (t4, t5, t6); at the lock one of each kind that students choose."""
    found = euler_angles(np.array(rows), "zyz", intrinsic=True)
    if not found.singular:
        return found.angles.tolist()
    return Family([found.family(0.0).tolist(), found.family(float(found.combination)).tolist()])


def zyz_residual(q, rows):
    return rotation_angle_between(euler_matrix(q, "zyz", intrinsic=True), np.array(rows))


def probes(rng: np.random.Generator) -> list[list]:
    """Rotations of the wrist: bent both ways, by round angles, stretched and folded back. Zeros are clean zeros."""
    bent = [
        [*rng.uniform(-3, 3, 1), sign * rng.uniform(0.1, 3.0), *rng.uniform(-3, 3, 1)]
        for sign in (1, -1)
        for _ in range(4)
    ]
    quarter = np.pi / 2
    bent += [[0, quarter, 0], [quarter, quarter, -quarter], [np.pi, quarter, quarter], [0.7, -quarter, 0.0]]
    stretched = [[0, 0, 0], [0.4, 0, 0.9], [2.0, 0, 2.5], [quarter, 0, quarter]]
    folded = [[0, np.pi, 0], [0.4, np.pi, 0.9], [-2.0, np.pi, 1.1]]
    matrices = euler_matrix(bent + stretched + folded, "zyz", intrinsic=True)
    return [[(np.round(matrix, 12) + 0.0).tolist()] for matrix in matrices]


def where(rows) -> str:
    if np.hypot(rows[0][2], rows[1][2]) > 1e-9:
        return "a bent wrist"
    return "the stretched wrist (t5 = 0)" if rows[2][2] > 0 else "the wrist folded back (t5 = pi)"


def unswitched(rows):
    """The general formulas at the lock, too."""
    matrix = np.array(rows)
    found = []
    for sign in (1, -1):
        root = sign * np.hypot(matrix[0, 2], matrix[1, 2])
        t4, t6 = (
            np.arctan2(sign * matrix[1, 2], sign * matrix[0, 2]),
            np.arctan2(sign * matrix[2, 1], -sign * matrix[2, 0]),
        )
        found.append([t4, np.arctan2(root, matrix[2, 2]), t6])
    return found


def with_results(change):
    """Steps that change what the function returns for a bent wrist; at the lock it gives one triple, of either kind, or both."""

    def step(chosen):
        def mistaken(function, rows):
            found = function(rows)
            found = found.solutions[chosen] if isinstance(found, Family) else found
            return change(found)

        return lambda function: lambda rows: mistaken(function, rows)

    return [step(chosen) for chosen in (slice(0, 1), slice(1, 2), slice(0, 2))]


def sign_in_t5_only(found):
    if len(found) < 2 or abs(np.sin(found[0][1])) < 1e-9:
        return found
    (t4, t5, t6), _ = found
    return [[t4, t5, t6], [t4, -t5, t6]]


def first_of_two(found):
    return found[:1] if abs(np.sin(found[0][1])) > 1e-9 else found


def second_of_two(found):
    return found[-1:] if abs(np.sin(found[0][1])) > 1e-9 else found


def wanted_in_degrees(found):
    return np.degrees(found).tolist()


QUESTIONS = (
    Question(
        "orientation.own_fixed",
        reference="B",
        mistakes=(
            option(
                "A",
                "moving_for_fixed",
                "**Here the second axis moves with the brick.** The statement says the *fixed* x: the axis is painted on the floor.",
            ),
            option(
                "C",
                "same_result_believed",
                "**The order of two factors matters.** Try it with a book: a turn about its own z, then about the fixed x; then with "
                "both axes on the book.",
            ),
            option(
                "D",
                "angles_exchanged",
                "**The angles have changed their axes.** Which axis does the first turn use, and by which angle?",
            ),
        ),
    ),
    Question(
        "orientation.rpy_entries",
        reference=ENTRIES,
        mistakes=(
            mistake(
                "order_of_turns_reversed",
                0.4,
                "**These entries belong to the product in the reverse order.** Fixed axes x, y, z: the roll is applied first, so it "
                "stands rightmost.",
                lambda _: [REVERSED_RPY[1, 1], REVERSED_RPY[1, 2]],
            ),
            mistake(
                "row_and_column_exchanged",
                0.5,
                "**The second entry is r32.** The first index counts rows, the second one columns.",
                lambda entries: [entries[0], RPY[2, 1]],
            ),
            symbols_exchanged(
                phi,
                psi,
                "letters_exchanged",
                "**phi and psi have changed places.** The two pages of the slides use the letters for different axes; here phi turns "
                "about x and psi about z.",
                0.5,
            ),
            symbol_negated(
                psi,
                "sign_of_yaw",
                "**The yaw turns the wrong way.** Which of the two sines in Rot_z carries the minus, the upper or the lower one?",
            ),
        ),
    ),
    Question(
        "orientation.zxz",
        reference=GYROSCOPE,
        mistakes=(
            misprint(
                turns("xyz", psi, theta, phi),
                "with body axes x, y, z the middle angle is not the tilt of the axle. Compare with the page on the three-axis wrist.",
                share=0.4,
            ),
            symbols_exchanged(
                psi,
                phi,
                "extrinsic_for_intrinsic",
                "**The turns are multiplied in the reverse order.** The axes move with the body: the precession, which comes first, "
                "stands on the left.",
                0.5,
            ),
            mistake(
                "nutation_about_y",
                0.5,
                "**The nutation turns about the wrong axis.** The line of nodes is where the body's x axis has come to lie.",
                lambda _: turns("zyz", psi, theta, phi),
            ),
            transposed_rotation(),
        ),
    ),
    Question(
        "orientation.nutation",
        reference="C",
        mistakes=(
            option(
                "A",
                "slide_misprint",
                "**This is the form printed on the slide; it is an erratum.** With x, y, z the entry r33 is a product of two cosines, and "
                "the middle angle is not the angle between axle and vertical.",
            ),
            option(
                "B",
                "reversed_axes_believed",
                "**The order of the letters does not save it.** With three different axes the first and the third turn go about different "
                "lines of the body; the precession and the spin of an upright top do not.",
            ),
            option(
                "D",
                "wrist_of_the_arm",
                "**These are the axes of the spherical wrist.** The middle angle would be a tilt there too; but which axis of the body "
                "lies on the line of nodes of the classical top?",
                0.3,
            ),
        ),
    ),
    Question(
        "orientation.rpy_both",
        reference=both_rpy,
        mistakes=(
            one_triple_only(),
            misprint(
                sign_in_the_pitch_only,
                "roll and yaw come from pairs that carry the cosine of the pitch, and that has changed its sign. Put your second "
                "triple back into the matrix: is it the same one?",
            ),
            extrinsic_for_intrinsic(
                feedback="**The angles come in the reverse order.** Asked for are (roll, pitch, yaw): about x, about y, about z."
            ),
            degrees(0, 1, 2),
        ),
        angles=(0, 1, 2),
        tolerance=1e-3,
        residual=rpy_residual,
    ),
    Question(
        "orientation.spun",
        reference=spun,
        mistakes=(
            mistake(
                "fixed_for_moving",
                0.5,
                "**Your top has turned about the vertical of the room.** More yaw does just that, and so does a factor on the left. Look "
                "at the axle: may a turn about the axle move it?",
                read_from(lambda matrix: FORTH @ matrix @ BACK),
            ),
            mistake(
                "added_to_the_roll",
                0.4,
                "**Your top has turned about its own x axis.** More roll does just that. The letter of the proper rotation is the "
                "letter of the roll here, but the axis is another one.",
                roll_grows,
            ),
            mistake(
                "transposed_rotation",
                0.4,
                "**These are the angles of the transposed matrix.** r32 stands in row 3, column 2.",
                read_from(np.transpose),
            ),
            extrinsic_for_intrinsic(
                feedback="**The angles come in the reverse order.** Asked for are (roll, pitch, yaw): about x, about y, about z."
            ),
            degrees(0, 1, 2),
        ),
        tolerance=1e-3,
    ),
    Question(
        "orientation.printed",
        reference="D",
        mistakes=(
            option(
                "A",
                "nothing_found",
                "**Neither line stands as printed.** Put the angles for the minus sign back into the matrix, and compare Arctg(n/m) with the "
                "direction of a vector that points to the left.",
            ),
            option(
                "B",
                "extraction_taken_for_right",
                "**The minus sign has not been tried.** Roll and yaw are computed from pairs that carry the cosine of the pitch: what happens to "
                "them when that is negative?",
                0.3,
            ),
            option(
                "C",
                "quotient_taken_for_right",
                "**A quotient forgets both signs.** Where does Arctg(n/m) send a vector with a negative m?",
                0.3,
            ),
        ),
    ),
    Question(
        "orientation.lock",
        reference=LEFT_AT_LOCK,
        mistakes=(
            mistake(
                "roll_minus_yaw",
                0.6,
                "**This is roll - yaw.** Look at the sign of the sine in the matrix.",
                lambda angle: -angle,
            ),
            atan_for_atan2(feedback=QUADRANT_LOST),
            atan2_arguments_exchanged(),
        ),
        angles=(0,),
        draw=locked,
    ),
    Question(
        "orientation.wrist",
        reference=lambda mine: wrist_angles(mine.wrist),
        mistakes=(
            misprint(
                lambda answer: [answer[0].subs(e, 1), answer[1], answer[2].subs(e, 1)],
                "the outer angles come from pairs that carry the root as a factor. Put the angles for e = -1 back into the matrix.",
                share=0.6,
            ),
            mistake(
                "atan_for_atan2",
                0.5,
                QUADRANT_LOST,
                on_each_atan2(atan_for_atan2(), *OUTER),
                on_each_atan2(atan_for_atan2(), *ALL),
            ),
            mistake(
                "atan2_arguments_exchanged",
                0.4,
                atan2_arguments_exchanged().feedback,
                on_each_atan2(atan2_arguments_exchanged(), *ALL),
                on_each_atan2(atan2_arguments_exchanged(), *OUTER),
            ),
            extrinsic_for_intrinsic(
                feedback="**First and third angle have changed places.** Your wrist is {wrist}, axes that move: the first letter is the "
                "joint nearest to the arm."
            ),
            mistake(
                "transposed_rotation",
                0.4,
                "**Rows and columns are exchanged.** These are the angles of the transposed matrix: r12 stands in row 1, column 2.",
                in_each(
                    lambda entry: entry.subs({R[i, j]: R[j, i] for i in range(3) for j in range(3)}, simultaneous=True)
                ),
            ),
        ),
        partial=0.6,
        angles=ALL,
        draw=rotation_and_sign,
    ),
    Question(
        "orientation.zyz",
        reference=zyz,
        mistakes=(
            mistake(
                "one_triple_only",
                0.5,
                one_triple_only().feedback,
                *with_results(first_of_two),
                *with_results(second_of_two),
            ),
            lock_not_switched(unswitched),
            mistake(
                "slide_misprint",
                0.5,
                "**As on the slide, the sign of the root acts on the middle angle only.** Put your second triple back into the matrix: "
                "is it the same one?",
                *with_results(sign_in_t5_only),
            ),
            mistake("degrees", 0.4, degrees().feedback, *with_results(wanted_in_degrees), turn=360),
        ),
        angles=(0, 1, 2),
        tolerance=1e-4,
        probe=probes,
        case=where,
        residual=zyz_residual,
    ),
)
