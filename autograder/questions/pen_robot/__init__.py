"""The pen robot (its sheet, French and English): table, tip, the surface it reaches; then arms with a pen that no lecture shows."""

from __future__ import annotations

from functools import partial

import numpy as np
import sympy

from autograder.judge import Follow, Question, following, mistake
from autograder.judge.misconceptions import columns_exchanged, offset_missing, option, tolerance_too_wide, tool_left_out
from autograder.judge.steps import change_entry, substitute

from . import own
from .model import (
    HALF,
    L2,
    READINGS,
    ROWS,
    TIP,
    TWISTED_TIP,
    circles,
    draw_surface,
    freedoms,
    h2,
    height_squared,
    p1,
    read_twist_as_length,
    t1,
    t2,
)

e, p = sympy.symbols("e p")


def other_sense(direction: list[int]) -> list[int]:
    """A direction of two joints with the second of them the other way."""
    last = max(place for place, entry in enumerate(direction) if entry)
    return [-entry if place == last else entry for place, entry in enumerate(direction)]


def of_other_joints(direction: list[int], places: int, sense: int) -> list[int]:
    """A direction of two joints moved on by some places, the first of the two with another sense."""
    moved = [direction[(place - places) % 3] for place in range(3)]
    first = next(place for place, entry in enumerate(moved) if entry)
    return [sense * entry if place == first else entry for place, entry in enumerate(moved)]


QUESTIONS = (
    Question(
        "pen_robot.table",
        reference=ROWS,
        mistakes=(
            mistake(
                "twist_read_as_length",
                0.3,
                "**The second printed column is read as a length.** Its header is a misprint: -pi/2 is no length, but an angle "
                "about X from one joint axis to the next.",
                read_twist_as_length,
            ),
            columns_exchanged(
                "a",
                "alpha",
                feedback="**The columns a and alpha are exchanged.** Their heads on the sheet do not help: look at the entries. Which "
                "column can hold a length?",
            ),
            offset_missing(2),
            tool_left_out(
                feedback="**The pen is missing.** The last row must bring the origin from the last joint to the tip."
            ),
        ),
        partial=0.6,
    ),
    Question(
        "pen_robot.tip",
        reference=TIP,
        mistakes=(
            mistake(
                "pen_left_out",
                0.4,
                "**This is the origin of the last frame, not the tip.** The pen reaches p1 further along the last X axis.",
                substitute({p1: 0}),
            ),
            mistake(
                "joint_offset_missing",
                0.6,
                "**The offset of theta2 is missing.** With all angles zero your pen lies; row 2 of the table makes it stand.",
                substitute({t2: t2 + HALF}),
            ),
            mistake(
                "sign_of_alpha",
                0.5,
                "**A sign is turned, as if alpha were +pi/2.** To which side of axis 1 does the pen's plane pass?",
                lambda _: TWISTED_TIP,
            ),
        ),
        follows=Follow("pen_robot.table", lambda rows: following.position(following.product_of_table(rows))),
    ),
    Question(
        "pen_robot.linear",
        reference="C",
        mistakes=(
            option(
                "A",
                "taken_for_linear",
                "**The sheet says so, but the unknowns stand inside sines and cosines, and in products.** Double all angles: does the tip "
                "move twice as far?",
            ),
            option(
                "B",
                "three_unknowns_counted",
                "**Three angles are written, fewer act.** Turn joint 2 forward and joint 3 back by the same angle: where does the tip go?",
                share=0.3,
            ),
            option(
                "D",
                "linear_in_sines_and_cosines",
                "**The sines and cosines are not independent, and they occur in products.** Besides, count how many angles act.",
            ),
        ),
    ),
    Question(
        "pen_robot.height",
        reference=height_squared,
        mistakes=(
            mistake(
                "side_forgotten",
                0.4,
                "**The distance of the pen's plane from axis 1 is forgotten.** Seen from above the arm has a corner: rho is not the "
                "distance from the axis.",
                wrong={"side": 0},
            ),
            mistake(
                "side_added",
                0.5,
                "**A sign is turned under the root.** The distance from axis 1 is the hypotenuse, not a leg.",
                wrong={"sign": 1},
            ),
            mistake(
                "one_offset_only",
                0.6,
                "**Only one of the two lengths along axis 2 is there.** L2 lies on the same line as h2.",
                wrong=[{"side": h2}, {"side": L2}],
            ),
            mistake(
                "arm_forgotten",
                0.4,
                "**The arm L1 is forgotten.** The circle of the pen has its centre on axis 2, not on axis 1.",
                wrong={"out": 0},
            ),
        ),
        draw=draw_surface,
    ),
    Question(
        "pen_robot.circles",
        reference=circles,
        mistakes=(
            mistake(
                "side_forgotten",
                0.5,
                "**These are the two rho, not the radii.** The pen's plane passes axis 1 at a distance.",
                wrong={"side": "none"},
            ),
            mistake(
                "one_offset_only",
                0.6,
                "**Only h2 = {h2} m of the lengths along axis 2 is taken.** L2 lies on the same line.",
                wrong={"side": "h2"},
            ),
            mistake(
                "circles_exchanged",
                0.7,
                "**The two radii are exchanged.** The large one comes first.",
                lambda circles: circles[::-1],
            ),
        ),
    ),
    Question(
        "pen_robot.readings",
        reference=READINGS,
        mistakes=(
            mistake(
                "sign_of_theta1",
                0.5,
                "**theta1 has the wrong sign.** It is subtracted inside the entry: what must theta2 do to make up for it?",
                substitute({t1: -t1}),
            ),
            mistake(
                "sign_of_the_quarter_turn",
                0.5,
                "**A quarter turn has the wrong sign.** Set the angle of row 2 in your reading equal to the printed one, and solve for theta2.",
                lambda found: [found[0], found[1] - sympy.pi, found[2] + sympy.pi],
                change_entry(1, lambda entry: entry - sympy.pi),
                change_entry(2, lambda entry: entry + sympy.pi),
            ),
            mistake(
                "offset_left_in_phi",
                0.4,
                "**phi stands for the angle of row 2 plus theta3; it is larger by a quarter turn.** The printed entry is theta2 - pi/2.",
                lambda found: [entry - HALF for entry in found],
            ),
        ),
        angles=(0, 1, 2),
    ),
    Question(
        "pen_robot.freedoms",
        reference=freedoms,
        mistakes=(
            mistake(
                "joints_counted",
                0.0,
                "**You counted the joints.** A joint counts only if it moves the tip in a way that the others cannot.",
                lambda found: [3] * 6,
            ),
            mistake(
                "axes_on_one_line",
                0.6,
                "**Two axes on one line do the same to the tip.** One of the six robots has them, and you have not seen it.",
                wrong={"overlooked": "upright"},
            ),
            mistake(
                "axes_through_one_point",
                0.6,
                "**Three turns about one point keep the tip at its distance.** One of the six robots has its axes like this.",
                wrong={"overlooked": "ball"},
            ),
            mistake(
                "tip_on_an_axis",
                0.6,
                "**A tip that lies on an axis does not feel the turn about it.** In one of the six robots it does.",
                wrong={"overlooked": "axle"},
            ),
            mistake(
                "slides_of_one_direction",
                0.6,
                "**Slides of one direction add up to one.** In one of the six robots alpha is 0 or pi everywhere.",
                wrong={"overlooked": "lifts"},
            ),
        ),
        partial=0.0,
        places=False,
        depends=("offer",),
    ),
    Question(
        "pen_robot.own_tip",
        reference=own.tip,
        mistakes=(
            mistake(
                "pen_left_out",
                0.4,
                "**The pen is missing.** This is where the pen is held; its tip is p further on.",
                substitute({p: 0}),
            ),
            mistake(
                "offset_forgotten",
                0.5,
                "**The length e is forgotten.** Follow the links in the drawing: it leads from one axis to the next.",
                substitute({e: 0}),
            ),
            mistake(
                "offset_on_the_other_side",
                0.6,
                "**The length e leads to the other side.** Compare the sign with the table of the statement, all joints at zero.",
                substitute({e: -e}),
            ),
            mistake(
                "sense_of_a_joint",
                0.6,
                "**A joint moves in the wrong sense.** Right-hand rule about its arrow; or along its arrow, where it slides. Arrows may "
                "point down, or back.",
                *(substitute({q: -q}) for q in own.JOINTS),
            ),
            mistake(
                "first_joint_left_out",
                0.3,
                "**Joint 1 is not in it.** Seen from the base it moves everything.",
                substitute({own.JOINTS[0]: 0}),
            ),
        ),
        depends=("arm",),
    ),
    Question(
        "pen_robot.still",
        reference=own.still,
        mistakes=(
            mistake(
                "senses_not_seen",
                0.4,
                "**The right two joints, but with this direction the tip moves twice as far.** Look at the senses of their arrows.",
                other_sense,
            ),
            mistake(
                "one_of_them_does_something_else",
                0.0,
                "**These two joints do different things to the tip.** In which of its coordinates does each of them occur?",
                *(partial(of_other_joints, places=places, sense=sense) for places in (1, 2) for sense in (1, -1)),
            ),
        ),
        depends=("arm",),
    ),
    Question(
        "pen_robot.inverse",
        reference=own.inverse,
        mistakes=(
            mistake(
                "second_sign_missed",
                0.6,
                "**Solutions are missing.** A root, and an arccosine, have two signs: some points need the other one, or both.",
                wrong=[{"signs": (1,)}, {"signs": (-1,)}],
            ),
            mistake(
                "surface_not_checked",
                0.4,
                "**Your function answers for points that the pen cannot reach.** Three equations, two unknowns: one equation is left over "
                "as a condition. Put every solution into the model of your tip before you return it.",
                wrong={"slack": np.inf},
            ),
            tolerance_too_wide(
                {"slack": 1e-3},
                {"slack": 5e-3},
                feedback="**Your function answers for points beside the surface.** Some tenths of a millimetre are no rounding: the "
                "statement says how much to allow.",
            ),
            mistake(
                "surface_taken_too_narrow",
                0.7,
                "**Points of the surface come back without a solution.** Rounding moves a point a hair off it: leave the small tolerance of "
                "the statement.",
                wrong=[{"slack": 1e-8}, {"slack": 1e-14}],
            ),
            mistake(
                "rest_of_the_arm_counted_wrongly",
                0.5,
                "**q1 has what the rest of the arm does with the wrong sign.** Seen from joint 1 at zero, where is the tip? Joint 1 makes "
                "up for what is missing.",
                wrong={"rest": -1},
            ),
            mistake(
                "rest_of_the_arm_forgotten",
                0.4,
                "**q1 is taken as if joint 1 did everything alone.** The rest of the arm leads to some place, too: joint 1 only makes up for "
                "the difference.",
                wrong={"rest": 0},
            ),
        ),
        angles=(0, 1, 2),
        probe=own.draw_points,
        residual=own.residual,
    ),
    Question(
        "pen_robot.follow",
        reference=own.follow,
        mistakes=(
            mistake(
                "stops_ignored",
                0.5,
                "**The trace is right, but a joint goes beyond its stop.** Two joints do the same: let them share the work.",
                wrong={"shares": own.ONE_ALONE},
            ),
            mistake(
                "shared_against_each_other",
                0.4,
                "**The two joints work against each other.** Their arrows tell in which sense each of them must go.",
                wrong={"sense": -1},
            ),
            mistake(
                "rest_of_the_arm_counted_wrongly",
                0.5,
                "**q1 has what the rest of the arm does with the wrong sign.** Put one result into your model of the tip.",
                wrong={"rest": -1},
            ),
            mistake(
                "rest_of_the_arm_forgotten",
                0.4,
                "**q1 is taken as if joint 1 did everything alone.** Put one result into your model of the tip.",
                wrong={"rest": 0},
            ),
        ),
        angles=(0, 1, 2),
        tolerance=1e-5,
        probe=own.draw_curve,
        residual=own.trace_residual,
    ),
    Question(
        "pen_robot.mended",
        reference=own.mended,
        mistakes=(
            mistake(
                "nothing_mended",
                0.0,
                "**This is still the colleague's function.** Ask it for points that you have made with the model, in every quadrant, above "
                "and below axis 2.",
                wrong=[
                    {"signs": (1,), "tilt": own.asin, "first": own.atan, "near": near}
                    for near in ("failure", "limit", "nothing")
                ],
            ),
            mistake(
                "over_the_back_missing",
                0.5,
                "**Every point has a second solution.** Half a turn of joint 1, and the arm reaches over its back.",
                wrong={"signs": (1,)},
            ),
            mistake(
                "half_of_the_tilt_lost",
                0.5,
                "**One angle is right on half of its circle only.** Compare your answers for points above and below axis 2.",
                wrong={"tilt": own.asin},
            ),
            mistake(
                "half_of_the_heading_lost",
                0.5,
                "**The direction of a point behind the base is lost.** Compare your answers for points on both sides of the y axis.",
                wrong={"first": own.atan},
            ),
            mistake(
                "next_to_the_axis",
                0.7,
                "**Next to axis 1 there is nothing to find.** The plane of the pen passes it at a distance.",
                wrong=[{"near": "failure"}, {"near": "limit"}],
            ),
        ),
        angles=(0, 1),
        probe=own.draw_swing_points,
        case=own.name_swing_point,
        residual=own.mended_residual,
    ),
)
