"""Forward kinematics as rotations about centres (EPFL slides): no frames, only fixed points.

Every joint turns the whole arm about a point that is known in the reference posture. The
matrices multiply with the last joint nearest to the point, so that each turn finds its
centre still in the reference position: ``P = K1 K2 ... Kn P0``.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from dhm.transforms import Entry, rot_x, rot_z


def rotation_about(turn: sp.Matrix, centre: Sequence[Entry]) -> sp.Matrix:
    """A rotation about a centre instead of the origin: [R, p - R p; 0, 1].

    Parameters
    ----------
    turn : 3x3 or 2x2 matrix
        A rotation.
    centre : three or two entries
        Metres.

    Returns
    -------
    4x4 or 3x3 matrix

    Source: turns about centres, EPFL slides.
    """
    size = turn.rows
    centre = sp.Matrix(centre)
    return turn.row_join(centre - turn * centre).col_join(sp.Matrix([[0] * size + [1]]))


def scara_centres(joints: Sequence[Entry], lengths: Sequence[Entry]) -> list[sp.Matrix]:
    """The planar 3x3 rotations of the SCARA; their product times [L1 + L2 + L4, 0, 1] is the tool point.

    Parameters
    ----------
    joints : (t1, t2, t4)
        Radians.
    lengths : (L1, L2)
        Metres.

    Source: SCARA of the EPFL slides.
    """
    (l1, l2), reached, matrices = lengths, sp.S.Zero, []
    for joint, length in zip(joints, (l1, l2, 0)):
        turn = rot_z(joint)[:2, :2]
        matrices.append(rotation_about(turn, [reached, 0]))
        reached += length
    return matrices


def epfl_centres(joints: Sequence[Entry], D3: Entry, L2: Entry, D4: Entry) -> list[sp.Matrix]:
    """[K1, ..., K6] of the six-axis arm, 4x4; joints t1 to t6, lengths in metres.

    In the reference posture the axes point along z, x, x, z, x, z through the origin, the
    origin, [0, 0, L2], [D3, 0, .], [., 0, L2 + D4] and [D3, 0, .]. The figure with the sense
    of rotation is lost: positive about +z and +x, as in the printed K5 and K6.
    """
    centres: list[list[Entry]] = [[0, 0, 0], [0, 0, 0], [0, 0, L2], [D3, 0, 0], [0, 0, L2 + D4], [D3, 0, 0]]
    turns = (rot_z, rot_x, rot_x, rot_z, rot_x, rot_z)
    return [rotation_about(turn(joint)[:3, :3], centre) for turn, joint, centre in zip(turns, joints, centres)]
