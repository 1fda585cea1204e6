"""MECA 953 slides: modified DH, SCARA, RX-90, spherical wrist, and a URDF joint list."""

from __future__ import annotations

import itertools
import math

import numpy as np
import sympy as sp

from dhkit.geometry import rotation_angle_between
from dhm.orientation import euler_matrix
from dhm.transforms import classic_dh, modified_dh, modified_dh_inverse, rot_x, rot_z, trans_x, trans_z
from dhm.urdf import UrdfJoint, table_from_urdf

from .. import catalogue as robots
from .proof import Check, Erratum, Reading, against, agree, assembled

DOCUMENT = "MECA 953 slides"

t1, t2, t3, t4, t5, t6 = sp.symbols("t1:7")
a, alpha, d, theta, q = sp.symbols("a alpha d theta q")
a2, a3, d2, d3, d6, delta = sp.symbols("a2 a3 d2 d3 d6 delta")
C, S, HALF = sp.cos, sp.sin, sp.pi / 2

_SCARA_T04 = sp.Matrix(
    [
        [C(t1 + t2 + t4), -S(t1 + t2 + t4), 0, a3 * C(t1 + t2) + a2 * C(t1)],
        [S(t1 + t2 + t4), C(t1 + t2 + t4), 0, a3 * S(t1 + t2) + a2 * S(t1)],
        [0, 0, 1, -d2],
        [0, 0, 0, 1],
    ]
)
_WRIST_3T6 = sp.Matrix(
    [
        [
            C(t4) * C(t5) * C(t6) - S(t4) * S(t6),
            -C(t4) * C(t5) * S(t6) - S(t4) * C(t6),
            C(t4) * S(t5),
            C(t4) * S(t5) * d6,
        ],
        [
            S(t4) * C(t5) * C(t6) + C(t4) * S(t6),
            -S(t4) * C(t5) * S(t6) + C(t4) * C(t6),
            S(t4) * S(t5),
            S(t4) * S(t5) * d6,
        ],
        [-S(t5) * C(t6), S(t5) * S(t6), C(t5), C(t5) * d6],
        [0, 0, 0, 1],
    ]
)
_WRIST_3T4 = sp.Matrix([[C(t4), 0, -S(t4), 0], [S(t4), 0, C(t4), 0], [0, -1, 0, 0], [0, 0, 0, 1]])


def _product(*matrices):
    result = sp.eye(4)
    for matrix in matrices:
        result = result * matrix
    return result


# -- X_i: cross product or common perpendicular -----------------------------------


def _cross_product(zi, pi, zn, pn, x):
    return np.allclose(np.cross(zi, zn), x)


def _common_perpendicular(zi, pi, zn, pn, x):
    """Along the common perpendicular, from Z_i to Z_{i+1} where they do not meet."""
    if abs(x @ zi) > 1e-9 or abs(x @ zn) > 1e-9:
        return False
    gap = pn - pi
    if np.linalg.norm(np.cross(zi, zn)) < 1e-9:
        away = gap - (gap @ zi) * zi
    else:
        normal = np.cross(zi, zn)
        away = (gap @ normal) * normal
    return np.linalg.norm(away) < 1e-9 or np.allclose(away / np.linalg.norm(away), x)


def _gives_the_x_axes(rule):
    for table in (robots.RX90.table, robots.SCARA.table):
        frames = table.chain.frames(np.linspace(0.3, 1.1, table.chain.joints))
        for this, following in itertools.pairwise(frames):
            if not rule(this[:3, 2], this[:3, 3], following[:3, 2], following[:3, 3], this[:3, 0]):
                return False
    return True


def _keeps_the_robot(change):
    """Two parallel axes and a tool; `change` alters the rows (a, d), named by axis."""

    def tip(a1, d1, a2_, d2_):
        return _product(modified_dh(0, 0, d1, t1), modified_dh(a1, 0, d2_, t2), trans_x(a2_))

    return agree(tip(*change(a2, d2, a3, d3)), tip(a2, d2, a3, d3))


def _base_frame_coincides(named):
    """Setting the named parameters to zero makes 0T1 the identity at q_1 = 0."""
    first = dict(zip(("a_0", "alpha_0", "d_1", "theta_1"), (a, alpha, d, theta)))
    variable = {"revolute": "theta_1", "prismatic": "d_1"}
    return all(
        agree(
            modified_dh(
                *(0 if name in named[kind] or name == variable[kind] else symbol for name, symbol in first.items())
            ),
            sp.eye(4),
        )
        for kind in variable
    )


def _listing_output(value_of_d3):
    """What the listing prints at t1 = t2 = t4 = 0 for its third row."""
    rows = ((0, 0, 0, t1), (a2, 0, 0, t2), (a3, 0, value_of_d3, 0), (0, 0, 0, t4))
    origin = _product(*(modified_dh(*row) for row in rows)) * sp.Matrix([0, 0, 0, 1])
    return origin.subs({t1: 0, t2: 0, t4: 0})


def _slides_along_its_axis(variable):
    """The motion that `variable` makes, seen in frame i, is a translation along Z_i."""
    parameters = (a, alpha, d, theta)
    speed = modified_dh_inverse(*parameters) * modified_dh(*parameters).diff(variable)
    return agree(speed, sp.Matrix(4, 4, lambda i, j: 1 if (i, j) == (2, 3) else 0))


_POSE_ENTRIES = ("Px", "Py", "Pz", "sx", "sy", "sz", "nx", "ny", "nz", "ax", "ay", "az")


def _determines_the_pose(names):
    """Position and direction cosines can all be read off the named entries."""
    selection = np.array([[name == entry for entry in _POSE_ENTRIES] for name in names], float)
    return np.linalg.matrix_rank(selection) == 12 and len(names) == 12


_T45 = modified_dh(0, HALF, 0, t5)
_T56 = modified_dh(0, -HALF, 0, t6)
_T34 = modified_dh(0, -HALF, d3, t4)


def _is_4T6(cell):
    return agree(
        sp.Matrix(
            [
                [C(t5) * C(t6), -C(t5) * S(t6), -S(t5), 0],
                [S(t6), C(t6), 0, 0],
                [cell, -S(t5) * S(t6), C(t5), 0],
                [0, 0, 0, 1],
            ]
        ),
        _T45 * _T56,
    )


def _is_3T6(cells):
    c11, c12, c31, c32 = cells
    return agree(
        sp.Matrix(
            [
                [c11, c12, -C(t4) * S(t5), 0],
                [S(t5) * C(t6), -S(t5) * S(t6), C(t5), d3],
                [c31, c32, S(t4) * S(t5), 0],
                [0, 0, 0, 1],
            ]
        ),
        _T34 * _T45 * _T56,
    )


def _makes_the_wrist(third_row):
    T45 = sp.Matrix([[C(t5), 0, S(t5), 0], [S(t5), 0, -C(t5), 0], third_row, [0, 0, 0, 1]])
    T56 = rot_z(t6) * trans_z(d6)
    return agree(T45[:3, :3].det(), sp.S.One) and agree(_WRIST_3T4 * T45 * T56, _WRIST_3T6)


ERRORS = (
    Erratum(
        "000-def-Xi",
        DOCUMENT,
        "L69",
        "X_i is the vector product of Z_i and Z_{i+1}, always",
        "X_i lies on the common perpendicular and points from Z_i to Z_{i+1}",
        "Z_i x Z_{i+1} = sin(alpha_i) X_i: it vanishes for parallel axes and points backwards "
        "for alpha_i < 0, as in the slides' own RX-90 table. Where axes meet, the sign is free.",
        against(
            "X_i of every frame of the RX-90 and SCARA tables obeys the rule",
            _gives_the_x_axes,
            _cross_product,
            _common_perpendicular,
        ),
    ),
    Erratum(
        "000-step3-origin",
        DOCUMENT,
        "L224",
        "for parallel axes, the place of Z_i is arbitrary",
        "for parallel axes, the place of the origin O_i along Z_i is arbitrary",
        "Z_i is the axis of the joint and cannot be moved; sliding O_i along it only moves a "
        "length between d_i and d_{i+1}, which is how one of them is made zero.",
        against(
            "moving it by delta leaves the robot what it is",
            _keeps_the_robot,
            lambda a1, d1, a2, d2: (a1 + delta, d1, a2 - delta, d2),
            lambda a1, d1, a2, d2: (a1, d1 + delta, a2, d2 - delta),
        ),
    ),
    Erratum(
        "000-step6",
        DOCUMENT,
        "L255",
        "R_0 = R_1 at q_1 = 0 gives d_0 = alpha_0 = 0, and r_1 = 0 or theta_1 = 0",
        "it gives a_0 = alpha_0 = 0, and d_1 = 0 (revolute) or theta_1 = 0 (prismatic)",
        "d and r are the letters of Khalil and Kleinfinger for what these slides call a and d; "
        "with the slides' letters there is no d_0 and no r_1, and a_0 and d_1 stay free.",
        against(
            "with these parameters zero, 0T1 is the identity at q_1 = 0",
            _base_frame_coincides,
            {"revolute": ("d_0", "alpha_0", "r_1"), "prismatic": ("d_0", "alpha_0", "theta_1")},
            {"revolute": ("a_0", "alpha_0", "d_1"), "prismatic": ("a_0", "alpha_0", "theta_1")},
        ),
    ),
    Erratum(
        "000-cmp-T-classic",
        DOCUMENT,
        "L345",
        "classic transform with last column (d cos theta, d sin theta, a)",
        "last column (a cos theta, a sin theta, d)",
        "a and d are exchanged with respect to their definitions in the same comparison.",
        against(
            "the matrix is Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha)",
            lambda m: agree(m, _product(rot_z(theta), trans_z(d), trans_x(a), rot_x(alpha))),
            classic_dh(d, alpha, a, theta),
            classic_dh(a, alpha, d, theta),
        ),
    ),
    Erratum(
        "000-cmp-Tinv-classic",
        DOCUMENT,
        "L346",
        "inverse of the classic transform with last column (-d, -a sin alpha, -a cos alpha)",
        "last column (-a, -d sin alpha, -d cos alpha)",
        "the same exchange as in the direct matrix: it inverts that matrix, not the classic one.",
        against(
            "multiplied with the classic transform it gives the identity",
            lambda column: agree(
                assembled([[classic_dh(a, alpha, d, theta)[:3, :3].T, sp.Matrix(column)], [sp.zeros(1, 3), 1]])
                * classic_dh(a, alpha, d, theta),
                sp.eye(4),
            ),
            (-d, -a * S(alpha), -a * C(alpha)),
            (-a, -d * S(alpha), -d * C(alpha)),
        ),
    ),
    Erratum(
        "000-scara-table2",
        DOCUMENT,
        "L458-462",
        "second SCARA table with d_3 = +d_2",
        "d_3 = -d_2, as in the first table",
        "d_2 is the depth of the quill, measured downwards: every matrix printed after the table "
        "and the result z = -d_2 need the minus sign.",
        against(
            "the product of the four transforms is the printed 0T4",
            lambda value: agree(
                _product(
                    *(modified_dh(*row) for row in ((0, 0, 0, t1), (a2, 0, 0, t2), (a3, 0, value, 0), (0, 0, 0, t4)))
                ),
                _SCARA_T04,
            ),
            d2,
            -d2,
        ),
    ),
    Erratum(
        "000-code-output",
        DOCUMENT,
        "L505-540",
        "the listing sets d3 to +d2 and is shown to print -d2",
        "it must set d3 = -d2 to print what is shown",
        "the listing follows the second table, its output the first.",
        against(
            "the listing prints (a2 + a3, 0, -d2, 1)",
            lambda value: agree(_listing_output(value), sp.Matrix([a2 + a3, 0, -d2, 1])),
            d2,
            -d2,
        ),
    ),
    Erratum(
        "000-mgd-qi",
        DOCUMENT,
        "L426",
        "the variable of a prismatic joint is a_i",
        "it is d_i",
        "a prismatic joint slides along its axis Z_i, which d_i measures; a is a constant along X. "
        "The slides say so themselves at L283-285.",
        against("changing it slides frame i along Z_i", _slides_along_its_axis, a, d),
    ),
    Erratum(
        "000-X-cosines",
        DOCUMENT,
        "L436",
        "pose vector of eleven entries, (.., nx, ny, az, ay, az)",
        "twelve entries, (.., nx, ny, nz, ax, ay, az)",
        "nz is missing and ax is printed az.",
        against(
            "the twelve entries of the pose are all in the vector",
            _determines_the_pose,
            ("Px", "Py", "Pz", "sx", "sy", "sz", "nx", "ny", "az", "ay", "az"),
            _POSE_ENTRIES,
        ),
    ),
    Erratum(
        "000-rx90-T56",
        DOCUMENT,
        "L594",
        "5T6 of the RX-90 with rows (0, 0, -1, 0) and (S6, C6, 0, 0)",
        "rows (0, 0, 1, 0) and (-S6, -C6, 0, 0)",
        "the printed matrix has alpha = +90 degrees, row 6 of the table -90.",
        against(
            "the matrix is row 6 of the table",
            lambda m: agree(m, _T56),
            sp.Matrix([[C(t6), -S(t6), 0, 0], [0, 0, -1, 0], [S(t6), C(t6), 0, 0], [0, 0, 0, 1]]),
            sp.Matrix([[C(t6), -S(t6), 0, 0], [0, 0, 1, 0], [-S(t6), -C(t6), 0, 0], [0, 0, 0, 1]]),
        ),
    ),
    Erratum(
        "000-rx90-U4",
        DOCUMENT,
        "L602",
        "cell (3, 1) of U4 is S5 S6",
        "it is S5 C6",
        "the first column of 4T5 5T6; the printed cell does not even leave columns 1 and 2 orthogonal.",
        against("the matrix is 4T5 5T6", _is_4T6, S(t5) * S(t6), S(t5) * C(t6)),
    ),
    Erratum(
        "000-rx90-U3",
        DOCUMENT,
        "L604",
        "U3 with C4 C5 S4 C6, -C4 C5 S6, -S4 S5 S6 - C4 S6, S4 C5 S6 in rows 1 and 3",
        "C4 C5 C6 - S4 S6, -C4 C5 S6 - S4 C6, -S4 C5 C6 - C4 S6, S4 C5 S6 - C4 C6",
        "lost terms and two wrong letters; the final 0T6 of the slides is right.",
        against(
            "the matrix is 3T4 4T5 5T6",
            _is_3T6,
            (
                C(t4) * C(t5) * S(t4) * C(t6),
                -C(t4) * C(t5) * S(t6),
                -S(t4) * S(t5) * S(t6) - C(t4) * S(t6),
                S(t4) * C(t5) * S(t6),
            ),
            (
                C(t4) * C(t5) * C(t6) - S(t4) * S(t6),
                -C(t4) * C(t5) * S(t6) - S(t4) * C(t6),
                -S(t4) * C(t5) * C(t6) - C(t4) * S(t6),
                S(t4) * C(t5) * S(t6) - C(t4) * C(t6),
            ),
        ),
    ),
    Erratum(
        "000-wrist-table",
        DOCUMENT,
        "L645-648",
        "spherical wrist with (a, alpha) = (0, -90), (0, 90), (0, 0) degrees under a DHm header",
        "in DHm the twists are 0 (or the arm's alpha_3), -90, +90 degrees",
        "these are classic rows (a_i, alpha_i). Read as DHm, alpha_5 = 0 puts axis 6 on axis 5 "
        "and there is no spherical wrist.",
        against(
            "read as DHm, the rows give the printed 3T6",
            lambda twists: agree(
                _product(
                    *(
                        modified_dh(0, twist, length, angle)
                        for twist, length, angle in zip(twists, (0, 0, d6), (t4, t5, t6))
                    )
                ),
                _WRIST_3T6,
            ),
            (-HALF, HALF, 0),
            (0, -HALF, HALF),
        ),
    ),
    Erratum(
        "000-wrist-T45",
        DOCUMENT,
        "L654",
        "third row (0, -1, 0, 0) of 4T5",
        "third row (0, 1, 0, 0)",
        "with the minus sign the determinant is -1: a reflection, not a rotation.",
        against(
            "4T5 is a rotation and completes the printed product 3T6", _makes_the_wrist, [0, -1, 0, 0], [0, 1, 0, 0]
        ),
    ),
)


# -- ambiguities ----------------------------------------------------------------------


def _stands_on_the_floor(sign):
    """Every joint origin at q = 0 lies above the base plane."""
    return bool((sign * np.cumsum([joint.xyz for joint in robots.KR210_JOINTS], axis=0)[:, 2] > 0).all())


def _is_the_dhm_robot(axes):
    """The joint list with these axes moves like the DHm table of the catalogue."""
    *moving, gripper = (joint.xyz for joint in robots.KR210_JOINTS)
    joints = [UrdfJoint(xyz, axis=tuple(np.eye(3)["xyz".index(axis)])) for xyz, axis in zip(moving, axes)]
    listed = table_from_urdf([*joints, UrdfJoint(gripper, kind="fixed")])
    poses = np.random.default_rng(0).uniform(-1, 1, (5, 6))
    return np.allclose(robots.KR210.forward(poses), listed.forward(poses))


def _shortest_connection(p, u, w, v):
    """How many lines carry a shortest segment between the lines p + s u and w + t v."""
    hessian = np.array([[u @ u, -u @ v], [-u @ v, v @ v]])
    if np.linalg.matrix_rank(hessian, tol=1e-9) < 2:
        return "infinitely many"
    s, t = np.linalg.solve(hessian, [u @ (w - p), v @ (p - w)])
    segment = w + t * v - p - s * u
    return "one line" if np.linalg.norm(segment) > 1e-9 else "a segment of length zero"


def _describes_common_normals(claim):
    x, y, z, o = np.eye(3)[0], np.eye(3)[1], np.eye(3)[2], np.zeros(3)
    pairs = {"skew": (o, z, x, y), "parallel": (o, z, x, z), "meeting": (o, z, o, x)}
    return claim == {kind: _shortest_connection(*pair) for kind, pair in pairs.items()}


def _is_a_prismatic_last_frame(length):
    """d_n as a function of q: the joint moves, and O_n is on x_{n-1} at q = 0."""
    T = modified_dh(a, alpha, length, 0)
    moves = not agree(T.diff(q), sp.zeros(4))
    return moves and agree(T.subs(q, 0)[:3, 3], sp.Matrix([a, 0, 0]))


def _completes_to_a_product(complete):
    """The four elementary matrices multiply to the 4x4 transform."""
    parts = [complete(full[:3, :3], full[:3, 3]) for full in (trans_x(a), rot_x(alpha), trans_z(d), rot_z(theta))]
    return all(part.shape == (4, 4) for part in parts) and agree(_product(*parts), modified_dh(a, alpha, d, theta))


_DIRECT = modified_dh(a, alpha, d, theta)


def _is_the_inverse(blocks):
    matrix = assembled(blocks)
    return matrix is not None and matrix.shape == (4, 4) and agree(matrix * _DIRECT, sp.eye(4))


def _measures_a(sense):
    """Signed distance along x_i between O_i and the foot of x_i on z_{i-1} is a_i of the matrix."""
    for value in (0.3, -0.2):
        T = classic_dh(a, alpha, d, theta).subs({a: value, alpha: 0.7, d: 0.4, theta: 0.9})
        T = np.array(T, float)
        origin, x = T[:3, 3], T[:3, 0]
        foot = np.array([0, 0, origin[2]])
        if not np.isclose(sense(origin, foot) @ x, value):
            return False
    return True


def _accepts_symbols(modules):
    """After these star imports in this order, cos() of a symbol is an expression."""
    namespace = {}
    for module in modules:
        namespace |= {"cos": module.cos}
    try:
        return namespace["cos"](t1) == sp.cos(t1)
    except TypeError:
        return False


def _understood(axes_of_the_reader):
    """A reader who turns about these fixed axes finds the orientation that was meant.

    The writer means phi about x, theta about y, psi about z of the base, in this order.
    """
    angles = np.array([0.3, -0.5, 0.8])
    meant = euler_matrix(angles, "xyz", intrinsic=False)
    read = euler_matrix(angles, axes_of_the_reader, intrinsic=False)
    return rotation_angle_between(meant, read) < 1e-9


_BACK = sp.Matrix([-a * C(theta), a * S(theta), -d])

AMBIGUITIES = (
    Erratum(
        "000-urdf-heading",
        DOCUMENT,
        "L3",
        "the joint list gives the location of joint i-1 relative to joint i",
        "each row is the origin of joint i (child) in the frame of joint i-1 (parent)",
        "the columns of parent and child links settle it; read literally, every sign is reversed.",
        against("the robot stands above its base plane", _stands_on_the_floor, -1, +1),
    ),
    Erratum(
        "000-urdf-table",
        DOCUMENT,
        "L5-12",
        "joint origins without joint axes",
        "with axes z, y, y, x, y, x (the public KR210 model) the DHm table follows: d_1 = 0.75, "
        "a_1 = 0.35, a_2 = 1.25, a_3 = -0.054, d_4 = 1.5, hand 0.303",
        "a robot is its axes; the same origins with other axes are another robot.",
        Check(
            "the joint list moves like that DHm table",
            _is_the_dhm_robot,
            (
                Reading("all axes z", "zzzzzz", False),
                Reading("axes z, y, y, z, y, z", "zyyzyz", False),
                Reading("axes z, y, y, x, y, x", "zyyxyx", True),
            ),
        ),
    ),
    Erratum(
        "000-def-normal",
        DOCUMENT,
        "L79",
        "two lines have a common normal, carrying the shortest segment between them",
        "one for skew lines; any of infinitely many for parallel lines; for lines that meet, the normal to their plane",
        "for parallel lines the shortest segment is not unique, for lines that meet it has no direction.",
        against(
            "the number of shortest connections, computed for each kind of pair",
            _describes_common_normals,
            {"skew": "one line", "parallel": "one line", "meeting": "one line"},
            {"skew": "one line", "parallel": "infinitely many", "meeting": "a segment of length zero"},
        ),
    ),
    Erratum(
        "000-step7",
        DOCUMENT,
        "L263-265",
        "last frame on a prismatic joint: O_n on x_{n-1}, so that r_n = 0",
        "theta_n = 0, and O_n on the line x_{n-1} in the position d_n = 0",
        "r_n should read d_n, and d_n is the variable of that joint: it is zero at q_n = 0 only.",
        against("the joint moves and O_n is on x_{n-1} at q_n = 0", _is_a_prismatic_last_frame, sp.S.Zero, q),
    ),
    Erratum(
        "000-el-shape",
        DOCUMENT,
        "L299-305",
        "elementary transforms in the short form [I t], [R 0]",
        "append the row (0 0 0 1)",
        "the short forms are 3x4; they are set equal to 4x4 matrices and cannot be multiplied.",
        against(
            "the four matrices multiply to the DHm transform",
            _completes_to_a_product,
            lambda R, t: R.row_join(t),
            lambda R, t: R.row_join(t).col_join(sp.Matrix([[0, 0, 0, 1]])),
        ),
    ),
    Erratum(
        "000-inv-matrix",
        DOCUMENT,
        "L327",
        "inverse transform in a layout of four rows, beginning with [R^T, -a cos theta]",
        "[[R^T, (-a cos theta, a sin theta, -d)], [0 0 0, 1]]",
        "the entries are right, the layout is broken: its blocks do not fit together.",
        against(
            "the blocks fit and invert the DHm transform",
            _is_the_inverse,
            [[_DIRECT[:3, :3].T, _BACK[0]], [0, _BACK[1]], [0, _BACK[2]], [0, 0, 1]],
            [[_DIRECT[:3, :3].T, _BACK], [sp.zeros(1, 3), 1]],
        ),
    ),
    Erratum(
        "000-cmp-a-classic",
        DOCUMENT,
        "L341",
        "classic a_i: distance from O_i to the intersection of z_{i-1} and x_i, along x_i",
        "from that intersection to O_i",
        "as an unsigned length it is the same; as the signed parameter of the matrix the printed sense gives -a_i.",
        against(
            "the signed distance is the a_i of the matrix",
            _measures_a,
            lambda origin, foot: foot - origin,
            lambda origin, foot: origin - foot,
        ),
    ),
    Erratum(
        "000-scara-geom",
        DOCUMENT,
        "L570-586",
        "z = q_3 in the geometric check of the SCARA",
        "q_3 stands for d_3 = -d_2, which counts upwards",
        "with q_3 = d_2, the depth of the tables, the sign of z would be wrong; x, y and theta "
        "agree with l_12 = a_2, l_23 = a_3.",
        against("z is that of the printed 0T4", lambda q3: agree(q3, _SCARA_T04[2, 3]), d2, -d2),
    ),
    Erratum(
        "000-code-imports",
        DOCUMENT,
        "L487-489",
        "star imports of math and of sympy in one listing",
        "import sympy only",
        "both bring a cos; the listing works only because the sympy import stands last.",
        Check(
            "cos() of a symbol is an expression",
            _accepts_symbols,
            (
                Reading("math last", (sp, math), False),
                Reading("sympy last, as printed", (math, sp), True),
                Reading("sympy only", (sp,), True),
            ),
        ),
    ),
    Erratum(
        "000-X-rpy",
        DOCUMENT,
        "L440",
        "pose vector with three angles (phi, theta, psi) and no word on their axes",
        "say which axis each angle belongs to, and the order: here x, y, z, fixed axes",
        "two readers with two conventions find two orientations; the EPFL slides alone use two.",
        Check(
            "the reader finds the orientation that was meant",
            _understood,
            (
                Reading("roll about y, pitch about x, yaw about z", "yxz", False),
                Reading("about z, y, x", "zyx", False),
                Reading("about x, y, z", "xyz", True),
            ),
        ),
    ),
    Erratum(
        "000-wrist-T34",
        DOCUMENT,
        "L654",
        "3T4 of the wrist as the matrix of a DHm row",
        "it is the classic matrix of that row",
        "in DHm the row (0, -90 degrees, 0, t4) gives [[c4, -s4, 0], [0, 0, 1], [-s4, -c4, 0]].",
        against(
            "the row has the printed matrix",
            lambda convention: agree(convention(0, -HALF, 0, t4), _WRIST_3T4),
            modified_dh,
            classic_dh,
        ),
    ),
)
