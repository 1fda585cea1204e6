"""Workspace (DH-m slides, Romanian): image of a grid of joint values, limits, area, postures within stops, sections."""

from __future__ import annotations

import numpy as np

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    angle_not_summed,
    angles_subtracted,
    misprint,
    option,
    symbols_exchanged,
)
from autograder.judge.steps import substitute
from dhkit.geometry import lies_between

from .model import (
    ABSOLUTE_POINT,
    ABSOLUTE_SECTION,
    L1,
    L2,
    POINT,
    SECTION,
    always,
    area,
    base,
    cloud,
    count,
    draw_places,
    draw_ranges,
    full_turn_area,
    hold_as_they_come,
    hold_turns_of,
    name_place,
    name_range,
    never,
    pallet,
    reach,
    t1i,
    t1j,
    t2i,
    t2j,
    t3,
)

QUESTIONS = (
    Question(
        "workspace.point",
        reference=POINT,
        mistakes=(
            misprint(
                substitute({L2: L1, t2j: t2i}),
                "with one index for both joints only a curve is drawn, and the forearm has its own length.",
                share=0.2,
            ),
            mistake(
                "one_index_for_both_joints",
                0.5,
                "**Both joints still share one index.** With n values each, your function gives n points on a curve; all pairs "
                "are wanted.",
                substitute({t2j: t2i}),
                substitute({t1i: t1j}),
            ),
            mistake(
                "second_length_not_repaired",
                0.5,
                "**The forearm still has the length of the upper arm.** The next page of the slides speaks of two lengths.",
                substitute({L2: L1}),
            ),
            angle_not_summed(ABSOLUTE_POINT),
        ),
    ),
    Question(
        "workspace.cloud",
        reference=cloud,
        mistakes=(
            mistake(
                "one_index_for_both_joints",
                0.3,
                "**Your points lie on one curve.** Both joints march in step; take every value of joint 2 for every value of "
                "joint 1.",
                wrong={"shape": "diagonal"},
            ),
            mistake(
                "other_side",
                0.4,
                "**The first step from the base goes to the wrong side.** Look at the walk of your arm: the *{slider}*.",
                wrong={"side": "other"},
            ),
            mistake(
                "length_forgotten",
                0.2,
                "**The length a is not in it.** Your arm does not come to an end where its joints do.",
                wrong={"length": False},
            ),
            mistake(
                "stops_ignored",
                0.2,
                "**The joint that turns has stops.** Your points go all the way round.",
                wrong={"ranges": "full"},
            ),
        ),
        tolerance=0.04,
    ),
    Question(
        "workspace.reach",
        reference=reach,
        mistakes=(
            mistake(
                "ends_of_the_range_only",
                0.4,
                "**Only the ends of the range are looked at.** Between them the arm may pass through a posture that is longer, or "
                "shorter, than both.",
                wrong={"stretched": never, "folded": never},
            ),
            mistake(
                "folded_arm_forgotten",
                0.6,
                "**The folded arm is forgotten.** The stretched one is there; what is the shortest arm, and when does the range hold it?",
                wrong={"folded": never},
            ),
            mistake(
                "a_turn_further_forgotten",
                0.7,
                "**A range may hold the straight arm a turn further on.** 2 pi is as good as 0, and -pi as pi.",
                wrong=[
                    {
                        "stretched": lambda low, high: low <= 0 <= high,
                        "folded": lambda low, high: low <= np.pi <= high,
                    },
                    {
                        "stretched": lambda low, high: low <= 0 <= high,
                        "folded": lambda low, high: low <= np.pi <= high or low <= -np.pi <= high,
                    },
                ],
            ),
            mistake(
                "stops_ignored",
                0.3,
                "**This is the reach without stops.** The elbow cannot always be straight.",
                wrong={"stretched": always, "folded": always},
            ),
        ),
        probe=draw_ranges,
        case=name_range,
    ),
    Question(
        "workspace.pallet",
        reference=pallet,
        mistakes=(
            mistake(
                "stops_ignored",
                0.4,
                "**The elbow has stops.** Yours goes from {t2_min} to {t2_max} degrees: it is never straight and never folded.",
                wrong={"stops": False},
            ),
            mistake(
                "corners_overlooked",
                0.6,
                "**The far corners are further away than the middle of the far edge.** Half of {wide} m lies to either side.",
                wrong={"corners": False},
            ),
            mistake(
                "far_edge_for_near_edge",
                0.6,
                "**This is how far the *far* edge may be.** Asked is the near one, {deep} m before it.",
                wrong={"depth": False},
            ),
        ),
    ),
    Question(
        "workspace.area",
        reference=area,
        mistakes=(
            mistake(
                "degrees",
                0.5,
                "**An angle is in degrees.** The width of a range that turns, and the argument of a sine, are in radians.",
                np.degrees,
            ),
            mistake(
                "patches_alike",
                0.3,
                "**The patches do not all have the same size.** You multiplied the two widths; the determinant depends on one of your "
                "joints and must be integrated over it.",
                wrong={"patch": "product"},
            ),
        ),
    ),
    Question(
        "workspace.base",
        reference=base,
        mistakes=(
            mistake(
                "hole_overlooked",
                0.5,
                "**A station may be too near.** From one of your places the end effector would have to come closer to the base than your elbow "
                "bends.",
                wrong={"hole": False},
            ),
            mistake(
                "stops_ignored",
                0.4,
                "**The elbow has stops.** Yours goes from {t2_min} to {t2_max} degrees: it is never straight and never folded.",
                wrong={"stops": False},
            ),
            mistake(
                "heights_overlooked",
                0.3,
                "**The distance from the base is not the distance along the wall.** The stations stand before the wall: Pythagoras.",
                wrong={"heights": False},
            ),
            mistake(
                "station_forgotten",
                0.5,
                "**One station is out of reach from one of your places.** Try all three from both ends.",
                wrong={"left_out": "B"},
            ),
        ),
        depends=("L1", "L2", "t2_min", "t2_max"),
    ),
    Question(
        "workspace.full_turn",
        reference=full_turn_area,
        mistakes=(
            mistake(
                "sheets_added",
                0.4,
                "**The areas of the two sheets are added.** Where they lie on each other a point counts once.",
                wrong={"how": "sheets added"},
            ),
            mistake(
                "formula_across_the_fold",
                0.3,
                "**The formula for one sheet was used across the stretched arm.** There the sine of theta2 changes its sign: the patches "
                "of one side were subtracted from those of the other.",
                wrong={"how": "across the fold"},
            ),
            mistake(
                "stops_ignored",
                0.4,
                "**This is the ring without stops.** Your elbow cannot be folded: what is its smallest distance from the base?",
                wrong={"how": "no stops"},
            ),
        ),
    ),
    Question(
        "workspace.count",
        reference=count,
        mistakes=(
            mistake(
                "stops_ignored",
                0.3,
                "**The stops are not looked at.** These are the postures of an arm without limits.",
                wrong={"allowed": lambda q, limits: True},
            ),
            mistake(
                "only_the_elbow_has_stops",
                0.5,
                "**Only the stop of joint 2 is looked at.** Each posture needs a theta1 that joint 1 can take.",
                wrong=[
                    {"allowed": lambda q, limits: lies_between(q[1], *limits[1])},
                    {"allowed": lambda q, limits: limits[1][0] <= q[1] <= limits[1][1]},
                ],
            ),
            mistake(
                "one_posture_missing",
                0.5,
                "**You count one sense of the elbow only.** A cosine alone does not tell the sign of its angle.",
                wrong=[{"elbows": slice(0, 1)}, {"elbows": slice(1, 2)}],
            ),
            mistake(
                "turns_not_removed",
                0.6,
                "**Angles are compared without removing full turns.** Where the range goes beyond a half turn, -100 degrees and 260 "
                "degrees are one direction.",
                wrong=[{"allowed": hold_as_they_come}, {"allowed": hold_as_they_come, "wrapped": False}],
            ),
            mistake(
                "turns_of_one_joint_removed",
                0.7,
                "**Full turns are removed for one of the joints only.** The range of either may go beyond a half turn: 200 degrees and -160 "
                "degrees are one direction.",
                wrong=[{"allowed": hold_turns_of(0)}, {"allowed": hold_turns_of(1)}],
            ),
            mistake(
                "second_posture_only_after_the_first",
                0.6,
                "**The second posture is looked at only where the first one is allowed.** The stops may forbid either of them and leave the "
                "other.",
                wrong=[{"needs_first": True}, {"needs_first": True, "elbows": slice(None, None, -1)}],
            ),
        ),
        probe=draw_places,
        case=name_place,
    ),
    Question(
        "workspace.section",
        reference=SECTION,
        mistakes=(
            angle_not_summed(ABSOLUTE_SECTION),
            angles_subtracted(t3),
            mistake(
                "rho_and_z_exchanged",
                0.5,
                "**Distance and height are exchanged.** With t2 = 0 the upper arm is horizontal.",
                lambda section: section[::-1],
            ),
            symbols_exchanged(
                L1, L2, "lengths_exchanged", "**The two lengths are exchanged.** L1 is the upper arm, next to the base."
            ),
        ),
    ),
    Question(
        "workspace.aspects",
        reference="C",
        mistakes=(
            option(
                "A",
                "singularities_not_seen",
                "**The arm cannot go everywhere without a singular posture.** Find the factors of its determinant.",
            ),
            option(
                "B",
                "one_factor_only",
                "**You see one singular posture of two.** The straight elbow is one; what happens when the hand comes onto axis 1?",
            ),
            option(
                "D",
                "lengths_counted_as_factor",
                "**One factor too many.** A factor that never changes its sign cuts nothing; this arm has no wrist.",
            ),
        ),
    ),
)
