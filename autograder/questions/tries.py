"""What the lectures ask to try: the answers, and what usually goes wrong. There are no points, and nothing is kept from anybody."""

from __future__ import annotations

import numpy as np
import sympy
from sympy import Matrix, cos, pi, sin

from autograder.judge import Question, mistake
from autograder.judge.steps import change_cell, negate

a2, a3, d1, d2, t1, t2, t4, theta, L1, L2, L4, D3 = sympy.symbols("a2 a3 d1 d2 t1 t2 t4 theta L1 L2 L4 D3")
d3, r3, r30, theta4 = sympy.symbols("d_3 r_3 r_30 theta_4")

_ROT_Y = Matrix([[cos(theta), 0, sin(theta), 0], [0, 1, 0, 0], [-sin(theta), 0, cos(theta), 0], [0, 0, 0, 1]])
_K4 = Matrix(
    [[cos(t4), -sin(t4), 0, D3 * (1 - cos(t4))], [sin(t4), cos(t4), 0, -D3 * sin(t4)], [0, 0, 1, 0], [0, 0, 0, 1]]
)
_PHI = t1 + t2 + t4
_ARM = (L1 * cos(t1) + L2 * cos(t1 + t2), L1 * sin(t1) + L2 * sin(t1 + t2))
_BEHIND, _FOREARM = 0.35, np.hypot(0.054, 1.5)
"""Of the KR210: axis 2 stands so far before axis 1; the forearm with its offset. The upper arm measures 1.25 m."""

TRIES = (
    Question(
        "try.parameters.normal",
        [0.5, 0.6, 0.8, 0.0],
        (
            mistake(
                "between_the_points",
                0.5,
                "**This joins the two given points.** A common normal is perpendicular to both axes: leave out what runs along them.",
                lambda _: [1.06**0.5, *(np.array([0.3, 0.4, 0.9]) / 1.06**0.5)],
            ),
            mistake(
                "not_a_unit_vector",
                0.5,
                "**X is a direction: its length is 1.**",
                lambda _: [0.5, 0.3, 0.4, 0.0],
            ),
        ),
    ),
    Question(
        "try.transforms.rot_y",
        _ROT_Y,
        (
            mistake(
                "sense_turned",
                0.5,
                "**It turns the other way.** A small positive turn about Y carries Z towards X: the third column gets a positive first entry.",
                lambda right: right.T,
            ),
        ),
    ),
    Question(
        "try.transforms.mixture",
        [L1 + L2, -d1, 0],
        (
            mistake(
                "where_it_should_be",
                0.5,
                "**This is where the hand should be.** The modified matrix twists *before* it goes along Z.",
                lambda _: [L1 + L2, 0, d1],
            ),
            mistake(
                "sign_of_d1", 0.5, "**The sign of d1.** Where does Z point after a twist of a quarter turn?", negate(1)
            ),
        ),
    ),
    Question(
        "try.scara.down",
        [[1, a3, pi, d2, 0], [0, 0, 0, 0, -t4]],
        (
            mistake(
                "turn_forgotten",
                0.5,
                "**Joint 4 turns about the new arrow too.** What was counter-clockwise about the old $Z_4$ is clockwise about the new one.",
                change_cell(2, "theta", lambda _: t4),
            ),
            mistake(
                "depth_against_the_arrow",
                0.5,
                "**The depth is counted along the new arrow.** It points down, as the quill goes.",
                change_cell(1, "d", lambda d: -d),
            ),
            mistake(
                "no_half_turn",
                0.5,
                "**The arrow turned over: between $Z_2$ and $Z_3$ is half a turn about $X_2$.**",
                change_cell(1, "alpha", lambda _: 0),
            ),
            mistake(
                "half_turn_twice",
                0.5,
                "**$Z_3$ and $Z_4$ point the same way.** Only the step to $Z_3$ turns over.",
                change_cell(2, "alpha", lambda _: pi),
            ),
        ),
        angles=(2, 7),
    ),
    Question(
        "try.scara.quarter_turn",
        [0, a2 + a3, -d2],
        (
            mistake("depth_upwards", 0.5, "**d2 is a depth**, positive downwards.", negate(2)),
            mistake("not_turned", 0.3, "**This is the arm before the turn.**", lambda _: [a2 + a3, 0, -d2]),
            mistake(
                "turned_back", 0.3, "**It turned clockwise.** The right hand's thumb points up, along $Z_1$.", negate(1)
            ),
        ),
    ),
    Question(
        "try.direct_models.sideways",
        [_ARM[0] - L4 * sin(_PHI), _ARM[1] + L4 * cos(_PHI)],
        (
            mistake(
                "straight_tool",
                0.3,
                "**This is the first tool, which reaches straight on.**",
                lambda _: [_ARM[0] + L4 * cos(_PHI), _ARM[1] + L4 * sin(_PHI)],
            ),
            mistake(
                "other_side",
                0.5,
                "**The tool is on the other side.** A quarter turn counter-clockwise makes $(\\cos, \\sin)$ into $(-\\sin, \\cos)$.",
                lambda _: [_ARM[0] + L4 * sin(_PHI), _ARM[1] - L4 * cos(_PHI)],
            ),
        ),
    ),
    Question(
        "try.direct_models.K4",
        _K4,
        (
            mistake(
                "centre_as_translation",
                0.3,
                "**The last column is the centre itself.** It is what $R$ takes away from it: $p - Rp$.",
                lambda right: Matrix(right[:, :3]).row_join(Matrix([D3, 0, 0, 1])),
            ),
            mistake(
                "sign_of_the_column",
                0.5,
                "**The last column has the wrong sign**: $p - Rp$, not $Rp - p$.",
                lambda right: Matrix(right[:, :3]).row_join(Matrix([*(-right[:3, 3]), 1])),
            ),
        ),
    ),
    Question(
        "try.recursion.upright",
        [np.pi / 2, -np.pi / 2],
        (
            mistake("degrees", 0.5, "**In radians, please.**", np.degrees),
            mistake(
                "absolute_angles",
                0.3,
                "**$\\theta_3$ is counted from the upper arm.** And look at row 3 of the table: what does the arm look like at $\\theta_3 = 0$?",
                lambda _: [np.pi / 2, 0],
            ),
        ),
        angles=(0, 1),
    ),
    Question(
        "try.orientation.fixed_x",
        [[0, -1, 0], [0, 0, -1], [1, 0, 0]],
        (
            mistake(
                "other_side",
                0.3,
                "**This is a turn about the brick's own x.** A turn about a fixed axis is multiplied on the left.",
                lambda _: [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
            ),
            mistake("transposed", 0.3, "**The matrix is transposed.**", lambda right: np.transpose(right).tolist()),
        ),
    ),
    Question(
        "try.orientation.quadrants",
        [45, 135, -135, -45],
        (
            mistake(
                "by_the_quotient",
                0.3,
                "**These are the angles of the quotients**, which forget two quadrants.",
                lambda _: [45, -45, 45, -45],
            ),
            mistake(
                "positive_angles", 0.5, "**atan2 ends at 180°**, and comes from -180°.", lambda _: [45, 135, 225, 315]
            ),
        ),
    ),
    Question(
        "try.planar_2r.elbow_back",
        [0.6, 1.0],
        (
            mistake(
                "absolute_angle",
                0.3,
                "**$\\theta_2$ is counted from link 1**, not from $x_0$.",
                lambda _: [0.0, 0.4],
            ),
            mistake("exchanged", 0.5, "**x and y are exchanged.**", lambda right: right[::-1]),
            mistake("other_elbow", 0.5, "**This is the elbow for +90°.**", negate(0)),
        ),
    ),
    Question(
        "try.planar_2r.towards_centre",
        [-90, 0],
        (
            mistake("other_elbow", 0.5, "**This is the other elbow.**", lambda _: [90, 180]),
            mistake(
                "direction_of_the_target",
                0.3,
                "**This is the direction of the target.** Between it and link 1 lies $\\gamma$.",
                lambda _: [0, 90],
            ),
        ),
    ),
    Question(
        "try.singularities.kr210_reach",
        [1.25 + _FOREARM - _BEHIND, 1.25 + _FOREARM + _BEHIND],
        (
            mistake(
                "from_axis_2",
                0.3,
                "**Distances are counted from axis 1.** Axis 2 stands 0.35 m before it.",
                lambda _: [1.25 + _FOREARM] * 2,
            ),
        ),
    ),
    Question(
        "try.workspace.encoder",
        [1801, 1301],
        (
            mistake(
                "steps_for_values",
                0.5,
                "**These are the steps.** Both ends of a range are values too.",
                lambda _: [1800, 1300],
            ),
        ),
    ),
    Question(
        "try.workspace.third_link",
        [0.2, 0.8],
        (
            mistake(
                "diameter", 0.3, "**It must bridge the radius of the hole**, not its diameter.", lambda _: [0.4, 0.8]
            ),
        ),
    ),
    Question(
        "try.parallel_robots.legs",
        [4, 0],
        (
            mistake("one_leg_less", 0.3, "**A stretched leg still has one posture.**", lambda _: [0, 0]),
            mistake(
                "others_remain",
                0.3,
                "**The numbers of the legs are multiplied**: what follows from one zero?",
                lambda _: [4, 4],
            ),
        ),
    ),
    Question(
        "try.scara_s600.down",
        [[1, d3, pi, -(r3 + r30), 0], [0, 0, 0, 0, theta4]],
        (
            mistake(
                "turn_of_joint_4",
                0.5,
                "**$z_4$ points down as before**: $\\theta_4$ keeps its sign.",
                change_cell(2, "theta", lambda turn: -turn),
            ),
            mistake(
                "along_the_arrow",
                0.5,
                "**The new arrow runs the other way**: the same step counts negative.",
                change_cell(1, "d", lambda d: -d),
            ),
            mistake(
                "half_turn_stays",
                0.5,
                "**The half turn moved up by one row.**",
                lambda right: [[*right[0][:2], 0, *right[0][3:]], [0, 0, pi, 0, theta4]],
            ),
            mistake("constant_forgotten", 0.5, "**$r_{30}$ is gone.**", change_cell(1, "d", lambda _: -r3)),
        ),
        angles=(2, 7),
    ),
)
"""In the order of the lectures."""
