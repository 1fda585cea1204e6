"""Planar parallel robots (EPFL slides): the 3-RPR both ways, its singular poses, the 3-RRR as counter-example."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import degrees, option, symbol_negated
from autograder.judge.steps import in_each_row, negate, substitute
from dhkit.geometry import wrap

from .model import (
    BASE,
    GAP_SQUARED,
    JOINT,
    MEETING_X,
    MOVED_BEFORE_TURNED,
    PLATFORM,
    SINGULAR_X,
    count_elbows_from_x0,
    draw_poses,
    jacobian,
    leg_lengths,
    list_modes,
    list_postures,
    mode_residual,
    move_to_joint_1,
    phi,
    posture_residual,
    q1,
    q2,
    u,
    v,
    x,
    y,
)

BACKWARDS = (
    "**The platform is turned the other way.** Draw it with a small positive phi: on which side of x0 does x_P then lie, "
    "and does the point u = 1, v = 0 move up or down?"
)
NOT_TURNED = "**The platform is not turned.** The points b are given along the axes of the platform: they turn with it when phi changes."

QUESTIONS = (
    Question(
        "parallel_robots.joint",
        reference=JOINT,
        mistakes=(
            symbol_negated(phi, "turned_backwards", BACKWARDS, 0.5),
            mistake("platform_not_turned", 0.3, NOT_TURNED, lambda _: [x + u, y + v]),
            mistake(
                "moved_before_turned",
                0.4,
                "**P is turned, too.** The platform turns about P, so P itself stays: which vector does the rotation act on?",
                lambda _: MOVED_BEFORE_TURNED,
            ),
        ),
    ),
    Question(
        "parallel_robots.leg_lengths",
        reference=leg_lengths,
        mistakes=(
            mistake(
                "turned_backwards",
                0.5,
                BACKWARDS + " (If your points are rows: which way does `b @ R` turn them?)",
                wrong={"turn": -1},
            ),
            mistake("platform_not_turned", 0.3, NOT_TURNED, wrong={"turn": 0}),
            mistake(
                "squared_lengths",
                0.6,
                "**These are the squares of the lengths.** The sum of two squares is not yet the distance.",
                lambda lengths: np.square(lengths).tolist(),
            ),
            mistake(
                "anchors_left_out",
                0.4,
                "**The anchors are missing.** You measure from the origin of the base; only leg 1 starts there.",
                wrong={"anchored": False},
            ),
        ),
        probe=draw_poses,
    ),
    Question(
        "parallel_robots.w2",
        reference=q2**2 - q1**2 - GAP_SQUARED,
        mistakes=(
            mistake(
                "sign_of_d_squared",
                0.5,
                "**The sign of |d|^2 is turned.** It stands on the side of p in the expanded square: what happens when it "
                "changes sides?",
                lambda w: w + 2 * GAP_SQUARED,
            ),
            mistake(
                "sign_of_cosine",
                0.5,
                "**The term with cos(phi) has the wrong sign.** Check with phi = 0 and c = L: then d vanishes, and its square must, too.",
                substitute({phi: sympy.pi - phi}),
            ),
            mistake(
                "leg_1_not_subtracted",
                0.5,
                "**The equation of leg 1 is not subtracted.** |p|^2 has to cancel, and it is not zero.",
                lambda w: w + q1**2,
            ),
            mistake(
                "mixed_term_missing",
                0.4,
                "**The square of a difference has three terms.** d is a difference of two vectors: their product belongs to its square.",
                substitute({sympy.cos(phi): 0}),
            ),
        ),
    ),
    Question(
        "parallel_robots.most",
        reference="C",
        mistakes=(
            option(
                "A",
                "two_circles",
                "**Two circles meet twice, but here one of the two curves is no circle.** With legs 1 and 2 locked, B3 still moves: "
                "look at its path in the lecture.",
            ),
            option(
                "B",
                "product_of_degrees",
                "**Two to the power of three bounds three quadratic equations in x, y and one more unknown; it is not reached.** Count "
                "the powers of cos(phi) and sin(phi) after the elimination.",
            ),
            option(
                "D",
                "intersections_at_infinity",
                "**Twelve counts the meeting points of circle and coupler curve with those at infinity.** Half of them can never be drawn.",
            ),
        ),
    ),
    Question(
        "parallel_robots.modes",
        reference=list_modes,
        mistakes=(
            mistake(
                "one_mode_only",
                0.2,
                "**This is one assembly mode; there are more.** A method that starts somewhere and walks to a solution tells nothing "
                "about the others. Look for *all* zeros of the equation for phi.",
                *(lambda modes, k=k: modes[k : k + 1] for k in range(6)),
            ),
            mistake(
                "half_angle",
                0.5,
                "**These are the arctangents of t.** t stands for tan(phi/2): which angle has half its tangent there?",
                lambda modes: [[px, py, wrap(turn) / 2] for px, py, turn in modes],
            ),
            mistake(
                "joint_1_for_p",
                0.6,
                "**x and y are those of the joint B1.** The pose asks for P: one turned vector is missing on the way from B1 to P.",
                move_to_joint_1,
            ),
            degrees(2),
        ),
        partial=0.6,
        angles=(2,),
        residual=mode_residual,
    ),
    Question(
        "parallel_robots.jacobian",
        reference=jacobian,
        mistakes=(
            mistake(
                "legs_not_unit_vectors",
                0.6,
                "**The rows are not divided by the length of their leg.** u is a unit vector. (The determinant vanishes at the same "
                "poses, but its rows are no rates of lengths.)",
                wrong={"unit": False},
            ),
            mistake(
                "arms_from_the_origin",
                0.5,
                "**The arms are counted from the origin of the base.** The platform turns about P: r goes from P to the joint.",
                wrong={"centre": "origin"},
            ),
            mistake(
                "sign_of_turning",
                0.6,
                "**The third column has the wrong sign.** r x u, not u x r: turn the platform a little in the positive sense and see "
                "whether the leg gets longer.",
                in_each_row(negate(2)),
            ),
            mistake(
                "arms_not_turned",
                0.4,
                "**The arms are not turned with the platform.** b is given along the axes of the platform, u along those of the base.",
                wrong={"turned": False},
            ),
        ),
        probe=draw_poses,
    ),
    Question(
        "parallel_robots.singular",
        reference=SINGULAR_X,
        mistakes=(
            mistake(
                "meeting_point_for_p",
                0.5,
                "**This is where the leg lines meet.** The question asks for the platform's own P in that pose.",
                lambda _: MEETING_X,
            ),
            mistake(
                "joint_for_p",
                0.5,
                "**This is x of a joint of the platform.** P is another point of it.",
                *(lambda px, bx=bx: px + bx for bx, _ in PLATFORM),
            ),
            mistake(
                "one_leg_upright",
                0.1,
                "**Here one leg stands upright.** It then does not notice a small shift along x0, but the other two do: all three "
                "must be blind to one and the same motion.",
                *(lambda _, upright=a[0] - b[0]: upright for a, b in zip(BASE, PLATFORM)),
            ),
        ),
    ),
    Question(
        "parallel_robots.postures",
        reference=list_postures,
        mistakes=(
            mistake(
                "one_posture_only",
                0.2,
                "**This is one posture; there are more.** Every leg has two elbows to choose from.",
                *(lambda postures, k=k: postures[k : k + 1] for k in range(8)),
            ),
            mistake(
                "same_elbow_in_all_legs",
                0.4,
                "**The legs need not bend to the same side.** The choice of one elbow leaves the other two free: in how many ways can "
                "they be combined?",
                lambda postures: [postures[0], postures[-1]],
            ),
            mistake(
                "elbows_from_x0",
                0.5,
                "**The elbow angles are measured from the x axis.** The question counts them from the driven bar, zero for a stretched leg.",
                count_elbows_from_x0,
            ),
            degrees(*range(6)),
        ),
        angles=tuple(range(6)),
        residual=posture_residual,
    ),
    Question(
        "parallel_robots.slogan",
        reference="B",
        mistakes=(
            option(
                "A",
                "slogan_taken_as_a_law",
                "**One robot does not make a law.** You have counted the inverse solutions of a second parallel robot yourself: how many?",
            ),
            option(
                "C",
                "negative_lengths_counted",
                "**A leg has no negative length.** The square root has two signs, but the three distances are what they are.",
            ),
            option(
                "D",
                "direct_model_of_3rrr",
                "**With its drives locked, the 3-RRR is left with three bars of fixed length between fixed points and the platform.** "
                "You know that problem: how many solutions can it have?",
            ),
        ),
    ),
)
