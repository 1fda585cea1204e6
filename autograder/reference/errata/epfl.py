"""EPFL slides: models by rotations about centres, Euler angles, planar and parallel inverse."""

from __future__ import annotations

import numpy as np
import sympy as sp

from dhkit.geometry import rotation
from dhm.orientation import euler_matrix, rpy_matrix
from dhm.parallel import ThreeRPR, ThreeRRR
from dhm.transforms import modified_dh

from .. import catalogue as robots
from .proof import Erratum, against, agree, assembled

DOCUMENT = "EPFL slides"

t1, t2 = sp.symbols("t1 t2")
L1, L2, L4, D, L, alpha, theta = sp.symbols("L1 L2 L4 D L alpha theta")
C, S = sp.cos, sp.sin


def _turn(angle):
    return sp.Matrix([[C(angle), -S(angle)], [S(angle), C(angle)]])


def _has_a_nutation(axes):
    """The middle angle is the angle between the first axis and the last axis of the body."""
    rng = np.random.default_rng(0)
    angles = rng.uniform(0.1, 3, (20, 3))
    R = euler_matrix(angles, axes, intrinsic=True)
    first, last = ("xyz".index(axes[n]) for n in (0, 2))
    return np.allclose(np.arccos(np.clip(R[:, first, last], -1, 1)), angles[:, 1])


def _printed_rpy(R, e):
    """The sign acts on the second angle only."""
    return (
        np.arctan2(R[2, 1], R[2, 2]),
        np.arctan2(-R[2, 0], e * np.hypot(R[2, 1], R[2, 2])),
        np.arctan2(R[1, 0], R[0, 0]),
    )


def _corrected_rpy(R, e):
    return (
        np.arctan2(e * R[2, 1], e * R[2, 2]),
        np.arctan2(-R[2, 0], e * np.hypot(R[2, 1], R[2, 2])),
        np.arctan2(e * R[1, 0], e * R[0, 0]),
    )


def _extracts_rpy(extract):
    """Both signs give angles of the rotation they were taken from."""
    angles = np.random.default_rng(1).uniform(-3, 3, (20, 3))
    return all(np.allclose(rpy_matrix(*extract(R, e)), R) for R in rpy_matrix(*angles.T) for e in (1, -1))


def _points_along(angle):
    """angle(n, m) is the direction of the vector (m, n), in every quadrant."""
    return all(
        np.allclose(np.hypot(n, m) * np.array([np.cos(angle(n, m)), np.sin(angle(n, m))]), (m, n))
        for n in (-0.7, 0.4)
        for m in (-1.2, 0.9)
    )


ERRORS = (
    Erratum(
        "001-euler-axes",
        DOCUMENT,
        "L255",
        "precession, nutation, proper rotation turn about body axes x, y, z",
        "about body axes z, x, z",
        "nutation is the tilt of the spinning axis against the precession axis, so both are the "
        "same axis of the body; the slides print z, x, z a few lines below.",
        against("the second angle is the tilt between first and last axis", _has_a_nutation, "xyz", "zxz"),
    ),
    Erratum(
        "001-rpy-extract",
        DOCUMENT,
        "L314-318",
        "one phi and one psi for both signs of the root in theta",
        "the sign e = +-1 goes into all three: phi = Atan2(e r32, e r33), "
        "theta = Atan2(-r31, e sqrt(r32^2 + r33^2)), psi = Atan2(e r21, e r11)",
        "the second solution is (phi + pi, pi - theta, psi + pi). At cos theta = 0 only psi - phi "
        "or psi + phi is defined.",
        against("the angles of both signs give the rotation back", _extracts_rpy, _printed_rpy, _corrected_rpy),
    ),
    Erratum(
        "001-atan2",
        DOCUMENT,
        "L320",
        "Atan2(x, y) = Arctan(x / y)",
        "Atan2(n, m) is the angle of the vector (m, n), in (-pi, pi]; Arctan(n / m) only for m > 0",
        "the quotient forgets the signs: half of all directions come out turned by pi.",
        against(
            "it is the direction of the vector in all four quadrants",
            _points_along,
            lambda n, m: np.arctan(n / m),
            np.arctan2,
        ),
    ),
    Erratum(
        "001-2R-y",
        DOCUMENT,
        "L363",
        "y = L1 c1 + L2 s1 c2 + L2 c1 s2",
        "y = L1 s1 + L2 s1 c2 + L2 c1 s2",
        "cosine for sine in the first term of the expansion.",
        against(
            "it is L1 s1 + L2 s12",
            lambda y: agree(y, L1 * S(t1) + L2 * S(t1 + t2)),
            L1 * C(t1) + L2 * S(t1) * C(t2) + L2 * C(t1) * S(t2),
            L1 * S(t1) + L2 * S(t1) * C(t2) + L2 * C(t1) * S(t2),
        ),
    ),
)


# -- ambiguities ------------------------------------------------------------------------


def _turns_about_the_origin(blocks):
    matrix = assembled(blocks)
    expected = sp.Matrix([[C(t1), -S(t1), 0], [S(t1), C(t1), 0], [0, 0, 1]])
    return matrix is not None and agree(matrix, expected)


def _gives_the_offset(centre):
    """p1 - R2 p1 can be formed and is L1 (c1 - c12, s1 - s12)."""
    R2 = _turn(t2)
    if centre.rows != R2.cols:
        return False
    return agree(centre - R2 * centre, L1 * sp.Matrix([C(t1) - C(t1 + t2), S(t1) - S(t1 + t2)]))


def _are_the_points(points):
    """P(t1, t2) of the reference points at L1 + L2 + L4 and at L1 + L2 on the x axis."""
    R2, p1 = _turn(t2), _turn(t1) * sp.Matrix([L1, 0])
    about_p1 = assembled([[R2, p1 - R2 * p1], [sp.zeros(1, 2), 1]])
    turn = assembled([[_turn(t1), sp.zeros(2, 1)], [sp.zeros(1, 2), 1]])
    return all(
        agree((about_p1 * turn * sp.Matrix([reach, 0, 1]))[:2, :], point)
        for reach, point in zip((L1 + L2 + L4, L1 + L2), points)
    )


def _at(length):
    return sp.Matrix([L1 * C(t1) + length * C(t1 + t2), L1 * S(t1) + length * S(t1 + t2)])


def _leaves_only_the_slide(fixed):
    """With these parameters fixed, the joint can only translate."""
    R = modified_dh(L, alpha, D, theta)[:3, :3]
    return R.free_symbols <= fixed


def _angle_is_extracted(named):
    """The matrix page's middle angle, extracted as on the next page, is the angle named there.

    `named` says which symbol stands in the matrix and which in the extraction.
    """
    in_matrix, in_extraction = named
    values = {symbol: 0.3 + 0.4 * n for n, symbol in enumerate(dict.fromkeys((in_matrix, in_extraction)))}
    R = rpy_matrix(0.2, values[in_matrix], 0.5)
    found = np.arctan2(-R[2, 0], np.hypot(R[2, 1], R[2, 2]))
    return bool(np.isclose(found, values[in_extraction]))


def _is_the_matrix_page(axes):
    """R_psi R_vartheta R_phi about these axes is the printed Rz Ry Rx, entry by entry."""
    phi, vartheta, psi = 0.3, -0.5, 0.8
    c, s = np.cos, np.sin
    printed = {
        (0, 0): c(psi) * c(vartheta),
        (1, 0): s(psi) * c(vartheta),
        (2, 0): -s(vartheta),
        (0, 1): c(psi) * s(vartheta) * s(phi) - s(psi) * c(phi),
        (0, 2): c(psi) * s(vartheta) * c(phi) + s(psi) * s(phi),
        (2, 1): c(vartheta) * s(phi),
        (2, 2): c(vartheta) * c(phi),
    }
    about = [rotation(axis, angle) for axis, angle in zip(axes, (phi, vartheta, psi))]
    R = about[2] @ about[1] @ about[0]
    return all(np.isclose(R[place], value) for place, value in printed.items())


def _counts_the_postures(claim):
    """(hand poses, arm postures, postures with the wrist) of the six-joint arm, one target."""
    arm = robots.EPFL_ARM
    q = arm.inverse(arm.forward(np.radians([20, 30, 50, -25, 40, 65]))).q
    poses = {tuple(pose) for pose in np.round(arm.forward(q), 9).reshape(len(q), 16) + 0.0}
    arms = {tuple(row) for row in np.round(q[:, :3], 9)}
    return claim == (len(poses), len(arms), len(q))


def _is_the_largest_count(bound):
    """Largest number of postures among many random poses of a six-joint arm with a wrist."""
    arm = robots.EPFL_ARM
    q = np.random.default_rng(2).uniform(-np.pi, np.pi, (500, 6))
    return bool(arm.inverse_batch(arm.forward(q)).count.max() == bound)


def _counts_the_inverses(claim):
    pose = [0.45, 0.3, 0.1]
    found = {"3-RPR": np.atleast_2d(ThreeRPR().inverse(pose)).shape[0], "3-RRR": int(ThreeRRR().inverse(pose).count)}
    return claim == found


AMBIGUITIES = (
    Erratum(
        "001-P1",
        DOCUMENT,
        "L91-102",
        "rotation about the origin in blocks [R1; 0'; 1]",
        "[[R1, 0], [0', 1]]",
        "the numbers are right, the blocks are stacked and do not fit.",
        against(
            "the blocks fit and give the printed numbers",
            _turns_about_the_origin,
            [[_turn(t1)], [sp.zeros(1, 2)], [1]],
            [[_turn(t1), sp.zeros(2, 1)], [sp.zeros(1, 2), 1]],
        ),
    ),
    Erratum(
        "001-p1",
        DOCUMENT,
        "L108",
        "centre p1 = (L1 c1, L1 s1, 1) in p1 - R2 p1",
        "p1 = (L1 c1, L1 s1)",
        "a homogeneous vector of three entries cannot meet the 2x2 matrix R2.",
        against(
            "p1 - R2 p1 exists and is L1 (c1 - c12, s1 - s12)",
            _gives_the_offset,
            sp.Matrix([L1 * C(t1), L1 * S(t1), 1]),
            sp.Matrix([L1 * C(t1), L1 * S(t1)]),
        ),
    ),
    Erratum(
        "001-P12",
        DOCUMENT,
        "L112-114",
        "one symbol P(t1, t2) for the images of L1 + L2 + L4 and of L1 + L2",
        "two points: the tool point, c1 L1 + c12 (L2 + L4), and the wrist centre, c1 L1 + c12 L2",
        "the text passes from the first to the second without a word; what follows is the wrist centre.",
        against("the two products are these points", _are_the_points, (_at(L2), _at(L2)), (_at(L2 + L4), _at(L2))),
    ),
    Erratum(
        "001-dh-general",
        DOCUMENT,
        "L211",
        "prismatic joint: D varies, the angle alpha is fixed",
        "D varies, the angle theta is fixed",
        "alpha and L are constants of every joint; what distinguishes a prismatic joint is that theta does not turn.",
        against("nothing but a translation is left free", _leaves_only_the_slide, {L, alpha}, {L, alpha, theta}),
    ),
    Erratum(
        "001-euler-letters",
        DOCUMENT,
        "L270-316",
        "the middle angle is written in three shapes: Delta, a script I, vartheta",
        "one letter, vartheta",
        "a damaged character; the angle that the extraction names is the one in the matrix.",
        against(
            "the extraction returns the angle of the matrix",
            _angle_is_extracted,
            ("script I", "vartheta"),
            ("vartheta", "vartheta"),
        ),
    ),
    Erratum(
        "001-rpy-letters",
        DOCUMENT,
        "L288-310",
        "phi, vartheta, psi turn about y, x, z (wrist page) and about x, y, z (matrix page)",
        "with the printed matrix: phi about x, vartheta about y, psi about z",
        "the letters change axes between two pages.",
        against(
            "the rotations about these axes give the printed matrix",
            _is_the_matrix_page,
            ("y", "x", "z"),
            ("x", "y", "z"),
        ),
    ),
    Erratum(
        "001-postures",
        DOCUMENT,
        "L386-408",
        "four equivalent outputs for four sets of joint values",
        "one output (a pose of the hand), four arm postures, eight with the wrist",
        "the words for input and output are exchanged, and the wrist doubles the number.",
        against("(poses, arm postures, postures) of one target", _counts_the_postures, (4, 4, 4), (1, 4, 8)),
    ),
    Erratum(
        "001-nsol",
        DOCUMENT,
        "L382, L439",
        "the number of inverse solutions is not known in general",
        "six joints with a spherical wrist: at most 8 (any six revolute joints: at most 16, a "
        "bound known from the literature and not computed here)",
        "for the arm of these slides the number is known and reached.",
        against("the largest count over random poses is the bound", _is_the_largest_count, float("inf"), 8),
    ),
    Erratum(
        "001-parallel",
        DOCUMENT,
        "L442-480",
        "parallel robots have one inverse solution",
        "true for the leg lengths of a 3-RPR; a 3-RRR has 2^3 = 8",
        "the architecture is not named and the figure is lost; each two-bar leg can bend both ways.",
        against(
            "number of inverse solutions of each architecture",
            _counts_the_inverses,
            {"3-RPR": 1, "3-RRR": 1},
            {"3-RPR": 1, "3-RRR": 8},
        ),
    ),
)
