"""DH-m slides (Romanian): operators of modified DH, frames, workspace, four example tables."""

from __future__ import annotations

import numpy as np
import sympy as sp

from dhm.equations import type8
from dhm.singularities import mobility
from dhm.tables import DHTable
from dhm.transforms import classic_dh, modified_dh, rot_x, rot_z, trans_x, trans_z
from dhm.workspace import RRArm, planar_points

from .. import catalogue as robots
from .proof import Erratum, against, agree, assembled

DOCUMENT = "DH-m slides (Romanian)"

a, alpha, d, theta, t1, t2 = sp.symbols("a alpha d theta t1 t2")
L1, L2 = sp.symbols("L1 L2")
C, S, HALF = sp.cos, sp.sin, sp.pi / 2
_DHM = modified_dh(a, alpha, d, theta)


def _in_blocks(slide):
    """The four operators as blocks, the second one with translation `slide`."""

    def turn(matrix):
        return assembled([[matrix[:3, :3], sp.zeros(3, 1)], [sp.zeros(1, 3), 1]])

    def shift(vector):
        return assembled([[sp.eye(3), sp.Matrix(vector)], [sp.zeros(1, 3), 1]])

    return turn(rot_x(alpha)) * shift(slide) * turn(rot_z(theta)) * shift([0, 0, d])


def _end_of_the_link(convention):
    """Where frame i of a chain stands: "upstream" on joint i, "downstream" on joint i+1.

    Turning one joint moves everything behind it about the axis of that joint: frame i
    stands on the joint whose axis is its own z axis.
    """
    rows = [(0.3, 0.4, 0.2), (0.25, -0.7, 0.15), (0.35, 0.9, 0.1)]

    def frames(q):
        product, found = sp.eye(4), []
        for row, angle in zip(rows, q):
            product = product * convention(*row, angle)
            found.append(np.array(product.evalf(), float))
        return found

    q = [0.5, -0.3, 0.8]
    here = frames(q)
    for place, joint in (("upstream", 1), ("downstream", 2)):
        turned = list(q)
        turned[joint] += 0.6
        motion = frames(turned)[2] @ np.linalg.inv(here[2])
        frame = here[1]
        on_axis = np.allclose((motion @ frame)[:, 3], frame[:, 3])
        along = np.allclose(motion[:3, :3] @ frame[:3, 2], frame[:3, 2])
        if on_axis and along:
            return place
    return "neither"


def _ends_of_the_links(claim):
    return claim == {"modified": _end_of_the_link(modified_dh), "classic": _end_of_the_link(classic_dh)}


def _holds_the_hand_axes(name):
    """The hand's axes and origin, expressed in frame 0, are the columns of this transform."""
    before = modified_dh(0, 0, 0, t1) * modified_dh(L1, HALF, 0, t2)
    tool = modified_dh(L2, alpha, d, theta)
    columns = sp.Matrix.hstack(*(before * tool[:, j] for j in range(4)))
    return agree(columns, {"nTE": tool, "0TE": before * tool}[name])


_Q1, _Q2 = np.linspace(-0.5, 1.0, 4), np.linspace(0.3, 2.0, 4)
_LENGTHS = (1.0, 0.6)


def _is_the_position(formula):
    """For every pair (i, j), the position of the direct model of the table at L133-136."""
    table = DHTable([(0, 0, 0, 0, None), (0, _LENGTHS[0], 0, 0, None), (0, _LENGTHS[1], 0, 0, 0)])
    return all(
        np.allclose(formula(*_LENGTHS, i, j), table.forward([_Q1[i], _Q2[j]])[:2, 3])
        for i in range(4)
        for j in range(4)
    )


def _printed_position(l1, l2, i, j):
    elbow = _Q1[i] + _Q2[i]
    return (l1 * np.cos(_Q1[i]) + l1 * np.cos(elbow), l1 * np.sin(_Q1[i]) + l1 * np.sin(elbow))


def _corrected_position(l1, l2, i, j):
    elbow = _Q1[i] + _Q2[j]
    return (l1 * np.cos(_Q1[i]) + l2 * np.cos(elbow), l1 * np.sin(_Q1[i]) + l2 * np.sin(elbow))


def _fills_the_workspace(joints_meant):
    """Joint 2 taken through the range of any joint that is meant: no point leaves the workspace."""
    ranges = {1: (_Q1[0], _Q1[-1]), 2: (_Q2[0], _Q2[-1])}
    arm = RRArm(*_LENGTHS, q1=ranges[1], q2=ranges[2])
    for joint in joints_meant:
        q2 = np.linspace(*ranges[joint], 30)
        q = np.stack(np.meshgrid(np.linspace(*ranges[1], 30), q2), axis=-1)
        if not arm.contains(planar_points(_LENGTHS, q)).all():
            return False
    return True


def _is_the_image(cell):
    """Every cell (i, j) of the image holds the position reached with q1_i and q2_j."""
    return all(np.allclose(cell(i, j), planar_points(_LENGTHS, [_Q1[i], _Q2[j]])) for i in range(4) for j in range(4))


def _ends_at_the_tip(rows):
    """Read as DHm, the rows end at (L1 c1 + L2 c12, L1 s1 + L2 s12)."""
    product = sp.eye(4)
    for row in rows:
        product = product * modified_dh(*row)
    return agree(product[:2, 3], sp.Matrix([L1 * C(t1) + L2 * C(t1 + t2), L1 * S(t1) + L2 * S(t1 + t2)]))


ERRORS = (
    Erratum(
        "002-order",
        DOCUMENT,
        "L7-15",
        "the operators are Rx(alpha), Dx(alpha), Rz(theta), Dz(d)",
        "the second is Dx(a)",
        "a translation takes a length; the order is right, Rx and Dx commute, and so do Rz and Dz.",
        against(
            "the product is the DHm matrix printed after it",
            lambda x: agree(rot_x(alpha) * trans_x(x) * rot_z(theta) * trans_z(d), _DHM),
            alpha,
            a,
        ),
    ),
    Erratum(
        "002-block",
        DOCUMENT,
        "L31",
        "the block of the translation along X holds Dx(alpha)",
        "it holds (a, 0, 0), as the last one holds (0, 0, d)",
        "the same letter as in the sequence of operators.",
        against(
            "the product of the four blocks is the DHm matrix",
            lambda slide: agree(_in_blocks(slide), _DHM),
            [alpha, 0, 0],
            [a, 0, 0],
        ),
    ),
    Erratum(
        "002-params",
        DOCUMENT,
        "L37",
        "the matrix depends on (a, a, d, theta)",
        "on (alpha, a, d, theta)",
        "alpha is printed a; two equal letters are three parameters.",
        against(
            "these are the four symbols in the DHm matrix",
            lambda names: set(names) == _DHM.free_symbols,
            (a, a, d, theta),
            (alpha, a, d, theta),
        ),
    ),
    Erratum(
        "002-upstream",
        DOCUMENT,
        "L51",
        "modified DH: frame i on the downstream joint of link i; classic DH: on the upstream one",
        "the reverse: modified DH puts it on joint i (upstream, towards the base), classic DH on "
        "joint i+1 (downstream)",
        "this is the difference between the two conventions, and it is exchanged.",
        against(
            "the joint whose axis is z_i, found by turning it",
            _ends_of_the_links,
            {"modified": "downstream", "classic": "upstream"},
            {"modified": "upstream", "classic": "downstream"},
        ),
    ),
    Erratum(
        "002-nTE-noap",
        DOCUMENT,
        "L63",
        "nTE has the columns n, o, a, p expressed in frame 0",
        "0TE has them",
        "columns expressed in frame 0 belong to the transform from frame 0.",
        against("the hand's axes in frame 0 are its columns", _holds_the_hand_axes, "nTE", "0TE"),
    ),
    Erratum(
        "002-p",
        DOCUMENT,
        "L116, L122",
        "p = l1 (cos q1_i + cos(q1_i + q2_i), ...)",
        "p = (l1 cos q1_i + l2 cos(q1_i + q2_j), ...)",
        "the second link has its own length, and the second joint its own index: with one index "
        "only a curve of the workspace is drawn.",
        against(
            "it is the direct model at every pair of joint values",
            _is_the_position,
            _printed_position,
            _corrected_position,
        ),
    ),
    Erratum(
        "002-q2vec",
        DOCUMENT,
        "L124",
        "q2 runs from q_k,min to q_k,max",
        "from q_2,min to q_2,max",
        "k is no joint here; taken as any joint it carries the range of joint 1 to joint 2.",
        against("all points lie in the workspace of the two ranges", _fills_the_workspace, (1, 2), (2,)),
    ),
    Erratum(
        "002-grid",
        DOCUMENT,
        "L130",
        "image of the grid with joint values q in all but two cells",
        "every cell is p_ij = f(q1_i, q2_j)",
        "the map takes joint values to positions; only two printed cells are positions.",
        against(
            "every cell is the position of its pair",
            _is_the_image,
            lambda i, j: planar_points(_LENGTHS, [_Q1[i], _Q2[j]]) if i == 0 and j < 2 else (_Q1[i], _Q2[j]),
            lambda i, j: _corrected_position(*_LENGTHS, i, j),
        ),
    ),
    Erratum(
        "002-table-2R",
        DOCUMENT,
        "L139-141",
        "planar 2R with DHm header and rows (L1, 0, 0, t1), (L2, 0, 0, t2)",
        "DHm rows (0, 0, 0, t1), (L1, 0, 0, t2) and a tool (L2, 0, 0, 0)",
        "these are classic rows a_i, alpha_i. Read as DHm, axis 1 stands L1 away from the base "
        "and the last link is missing.",
        against(
            "the rows lead to the tip of the planar arm",
            _ends_at_the_tip,
            [(L1, 0, 0, t1), (L2, 0, 0, t2)],
            [(0, 0, 0, t1), (L1, 0, 0, t2), (L2, 0, 0, 0)],
        ),
    ),
    Erratum(
        "002-table-puma",
        DOCUMENT,
        "L147-153",
        "PUMA-like table whose row 6 has alpha = 0",
        "row 6 has alpha = -90 degrees",
        "rows 1 to 5 are DHm, row 6 is the last row of a classic table: axis 6 falls on axis 5.",
        against(
            "the six joints give six freedoms (rank of the Jacobian)",
            lambda robot: mobility(robot.table) == 6,
            robots.PUMA_PRINTED,
            robots.PUMA,
        ),
    ),
)


# -- ambiguities ------------------------------------------------------------------------


def _counts_the_solutions(claim):
    """Solutions of the planar 2R for targets inside, on the limit, outside, at the centre."""
    found = [int(type8(l1, l2, x, 0).count) for l1, l2, x in [(1, 0.6, 1), (1, 0.6, 1.6), (1, 0.6, 2), (1, 1, 0)]]
    return claim == tuple(found)


def _contains_the_cloud(quantifier):
    """Every point of the slides' cloud can be reached with `quantifier` (any, all) orientations."""
    lengths = (0.5, 0.4, 0.2)
    q = np.stack(np.meshgrid(*[np.linspace(-2, 2, 6)] * 3), axis=-1).reshape(-1, 3)
    cloud = planar_points(lengths, q)
    # The orientations of the cloud's own postures are among those tried.
    angles = np.unique(np.round(q.sum(axis=-1), 12))
    wrist = cloud[:, None] - lengths[2] * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    reached = type8(lengths[0], lengths[1], wrist[..., 0], wrist[..., 1]).count != 0
    return bool(quantifier(reached, axis=1).all())


AMBIGUITIES = (
    Erratum(
        "002-dk-ik",
        DOCUMENT,
        "L79-90",
        "the inverse model as a function f^-1 that is usually computed numerically",
        "a relation: none, one, several or infinitely many joint values; often in closed form",
        "f is not one-to-one. Arms with a spherical wrist have closed forms.",
        against(
            "number of solutions of a 2R: inside, on the limit, outside, folded on the centre",
            _counts_the_solutions,
            (1, 1, 1, 1),
            (2, 1, 0, -1),
        ),
    ),
    Erratum(
        "002-workspace-def",
        DOCUMENT,
        "L94",
        "the workspace is what the end effector can reach, no word on orientation",
        "points reached with at least one orientation (reachable workspace)",
        "the construction that follows collects positions; few of them can be reached with every "
        "orientation (dexterous workspace).",
        against("the cloud of a planar 3R lies in it", _contains_the_cloud, np.all, np.any),
    ),
)
