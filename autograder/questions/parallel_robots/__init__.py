"""Planar parallel robots: of the EPFL slides the 3-RPR both ways; a 3-RRR with stops; a machine that the id chooses."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import degrees, option
from autograder.judge.steps import substitute
from dhkit.geometry import wrap

from .machine import NONE, ONE, crossings, draw_reached, draw_ways, drives, failing, rates, singular
from .model import (
    GAP_SQUARED,
    count_elbows_from_x0,
    draw_poses,
    leg_lengths,
    list_modes,
    list_postures,
    mode_residual,
    move_to_joint_1,
    phi,
    posture_residual,
    q1,
    q2,
)

BACKWARDS = (
    "**The platform is turned the other way.** Draw it with a small positive phi: on which side of x0 does x_P then lie, "
    "and does the point u = 1, v = 0 move up or down?"
)
NOT_TURNED = "**The platform is not turned.** The points b are given along the axes of the platform: they turn with it when phi changes."

QUESTIONS = (
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
        "parallel_robots.postures",
        reference=list_postures,
        depends=("x", "y", "phi", "stop"),
        mistakes=(
            mistake(
                "stops_ignored",
                0.5,
                "**The motors have stops.** You list every way to hold the platform: which of them does each motor reach?",
                wrong={"stops": False},
            ),
            mistake(
                "one_posture_only",
                0.4,
                "**This is one configuration; there are more.** Every leg has two elbows to choose from, and the stops forbid some of them only.",
                *(lambda postures, k=k: postures[k : k + 1] for k in range(2)),
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
        "parallel_robots.drives",
        reference=drives,
        mistakes=(
            mistake(
                "slider_on_the_other_side",
                0.6,
                "**A slider is on the wrong side of its joint.** Pythagoras leaves two places for it: which of them does your table say is built?",
                wrong={"other": "rail"},
            ),
            mistake(
                "pin_on_the_other_side",
                0.6,
                "**A crank is bent the wrong way.** Look from A along the way to B: on which side is the pin to be, and on which is yours?",
                wrong={"other": "crank"},
            ),
            mistake(
                "other_working_mode",
                0.4,
                "**Your legs are built another way.** They reach the platform, but sliders and pins are not where the table has them.",
                wrong={"other": "both"},
            ),
            mistake("turned_backwards", 0.5, BACKWARDS, wrong={"turn": -1}),
            mistake("platform_not_turned", 0.3, NOT_TURNED, wrong={"turn": 0}),
            mistake(
                "rod_left_out",
                0.3,
                "**The rods are missing.** Your sliders stand beside their joints and your cranks point at them: the length of the rod must come in.",
                wrong={"halves": False},
            ),
            mistake(
                "crank_in_degrees",
                0.6,
                "**The angle of a crank is in degrees.** The question asks for radians; values of rails and rams are lengths.",
                wrong={"unit": 180 / np.pi},
                turn=360,
            ),
        ),
        angles=(0, 1, 2),  # of a length nobody gives 2 pi metres more
        probe=draw_reached,
    ),
    Question(
        "parallel_robots.rates",
        reference=rates,
        mistakes=(
            mistake(
                "rods_alone",
                0.5,
                "**These are speeds of the joints B along their rods.** A rod passes on only the part of the motion that lies along it, at its "
                "other end, too: how fast does that end move along the rod when the drive runs at 1?",
                wrong={"gain": ""},
            ),
            mistake(
                "crank_of_one_metre",
                0.6,
                "**The length of the crank is missing.** At a rate of 1 rad/s its pin moves as fast as the crank is long.",
                wrong={"gain": "angle"},
            ),
            mistake(
                "inverted",
                0.4,
                "**This is the inverse matrix.** It tells how the platform moves when the drives run; the question goes the other way.",
                wrong={"inverted": True},
            ),
            mistake(
                "sign_of_turning",
                0.6,
                "**The third column has the wrong sign.** Turn the platform a little in the positive sense: does B move along its rod, or against it?",
                wrong={"sign": -1},
            ),
            mistake(
                "arms_from_the_origin",
                0.5,
                "**The arms are counted from the origin of the base.** The platform turns about P.",
                wrong={"centre": "origin"},
            ),
        ),
        probe=draw_reached,
    ),
    Question(
        "parallel_robots.singular",
        reference=singular,
        depends=("machine",),
        mistakes=(
            mistake(
                "meeting_point_for_p",
                0.5,
                "**This is where the lines of the rods meet.** The question asks for the platform's own P in that pose.",
                wrong={"point": "meeting"},
            ),
            mistake(
                "joint_for_p",
                0.5,
                "**This is x of a joint of the platform.** P is another point of it.",
                wrong=[{"point": point} for point in "123"],
            ),
            mistake(
                "lines_from_the_anchors",
                0.3,
                "**Here the lines from the anchors meet.** What holds the platform is the rod alone: with its drive locked, which way does it point?",
                wrong={"anchors": True},
            ),
        ),
    ),
    Question(
        "parallel_robots.faults",
        reference=failing,
        places=False,
        depends=("order",),
        mistakes=(
            mistake(
                "safe_way_blamed",
                0.6,
                "**One of these ways passes through no singular pose, and the function says so.** Follow the determinant along it.",
                wrong=[{"instead": place} for place in NONE],
            ),
            mistake(
                "one_crossing_blamed",
                0.6,
                "**Of one of these ways the function is right: its ends have different signs.** How often does the sign change between them?",
                wrong={"instead": ONE},
            ),
        ),
    ),
    Question(
        "parallel_robots.crossings",
        reference=crossings,
        depends=("machine",),
        mistakes=(
            mistake(
                "as_it_was_given",
                0.0,
                "**This is the function as it was given.** It looks at the ends of a way; what happens in between?",
                wrong={"looked_at": 2},
            ),
            mistake(
                "once_at_most",
                0.4,
                "**Your function says that there is a singular pose, not how many.** On some ways the sign changes, and changes back.",
                wrong={"most": 1},
            ),
            mistake(
                "platform_not_turned",
                0.3,
                "**The platform keeps its first angle on your way.** x, y and phi all run from start to end.",
                wrong={"turning": False},
            ),
            mistake("no_crossing_at_all", 0.0, "**Your function finds no singular pose on any way.**", lambda _: 0),
        ),
        probe=draw_ways,
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
